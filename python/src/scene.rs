//! Scenes: read, moved, coloured.

use std::ffi::OsString;
use std::fmt::Write;
use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

use clap::Parser;
use numpy::{PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use ugfilm::{Error, FilmItem, Note, ParsedCommand, Program, ProgramError};
use ugparse::{Diagnostics, Origins, Parsed, Source, pipe};
use ugpipe::{CommonArgs, Context, Failure, Input, ToolArgs, Words, parse_words};
use ugscene::{BodyBoxes, CameraOptions, Provenance, Scene, TooManyPolygons};

use crate::call::{self, Call};
use crate::error::{Refused, wrong};

/// A scene, and what its errors are about.
#[pyclass(frozen, module = "uglorentz._core", name = "Scene")]
pub struct PyScene {
    parsed: Arc<Parsed>,
    /// The same with its round faces as polygons, for arrays; nothing of a scene without them.
    polygons: OnceLock<Result<Scene, TooManyPolygons>>,
    /// The text it was read from; of one that a program made, nothing.
    source: Arc<Source>,
    /// The time of the picture, of a scene whose positions are as seen, even if nothing moves.
    time: Option<f64>,
    /// What was noticed when it was made.
    #[pyo3(get)]
    notes: Vec<String>,
    /// The warning for a picture of it in which moving bodies have their shapes at rest.
    #[pyo3(get)]
    warning: Option<String>,
}

/// The options of reading.
#[derive(Clone, Debug, Parser)]
#[command(name = "read", version)]
struct Reading {
    #[command(flatten)]
    common: CommonArgs,
}

impl ToolArgs for Reading {
    const ESSENTIAL: &'static [&'static str] = &[];

    fn common(&self) -> &CommonArgs {
        &self.common
    }
}

/// The words of a command line, of which the first is the name of a program.
pub fn words_of_system(words: &[String], file: Option<PathBuf>) -> Vec<OsString> {
    let words = words.iter().map(OsString::from);
    words.chain(file.into_iter().flat_map(|file| ["--".into(), file.into_os_string()])).collect()
}

/// A text in memory, as a program reads it from standard input.
pub fn input(text: Vec<u8>) -> Input {
    Input { name: "<stdin>".to_owned(), text }
}

/// The findings on a scene in text, one each.
fn notes_on(findings: Diagnostics) -> Vec<String> {
    let text = findings.worded().render(false);
    text.split("\n\n").filter(|note| !note.is_empty()).map(str::to_owned).collect()
}

#[pymethods]
impl PyScene {
    /// Reads a file, or the text of one. `words`: options of reading.
    #[staticmethod]
    #[pyo3(signature = (words, path=None, text=None))]
    fn read(
        py: Python<'_>,
        words: Vec<String>,
        path: Option<PathBuf>,
        text: Option<Vec<u8>>,
    ) -> PyResult<Self> {
        let words = words_of_system(&words, path);
        let read = move |call: &Arc<Call>| Self::open(words, text.map(input), call);
        call::run(py, None, read)?.map_err(|refused| refused.exception(py))
    }

    /// The scene as a program makes it. `camera`: the name of the camera that its words choose.
    #[pyo3(signature = (words, camera=None, progress=None))]
    fn filtered(
        &self,
        py: Python<'_>,
        words: Vec<String>,
        camera: Option<&str>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let filter = |call: &Arc<Call>| self.filter(&words, camera, call);
        call::run(py, progress, filter)?.map_err(|refused| refused.exception(py))
    }

    /// The scene as text.
    fn text<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let text = call::run(py, None, |_| {
            ugparse::write_with(&self.parsed.scene, &self.parsed.passed_on)
        })?;
        Ok(PyBytes::new(py, &text))
    }

    /// Numbers of vertices, faces and wires.
    fn counts(&self) -> PyResult<[usize; 3]> {
        let scene = self.polygons()?;
        Ok([scene.vertices.len(), scene.faces.len(), scene.wires.len()])
    }

    /// True for positions as seen, and for colours as seen.
    fn stage(&self) -> [bool; 2] {
        let stage = &self.parsed.scene.stage;
        [self.time.is_some() || stage.seen_geometry().is_some(), stage.seen_colors().is_some()]
    }

    /// The names of the cameras.
    fn cameras(&self) -> Vec<Option<&str>> {
        let scene = &self.parsed.scene;
        scene.cameras.iter().map(|camera| camera.name.map(|name| scene.names.get(name))).collect()
    }

    /// The names of the vertices.
    fn names(&self) -> PyResult<Vec<&str>> {
        let scene = self.polygons()?;
        Ok(scene.vertices.iter().map(|vertex| scene.names.get(vertex.name)).collect())
    }

    /// The positions of the vertices, (n, 3).
    fn vertices<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let vertices = &self.polygons()?.vertices;
        let rows = vertices.iter().flat_map(|vertex| vertex.position.to_array()).collect();
        table(py, rows, 3)
    }

    /// The corners of all faces, one contour after the other, and the number of corners of each
    /// contour; the number of contours of each face.
    fn faces<'py>(&self, py: Python<'py>) -> PyResult<[Bound<'py, PyArray1<u32>>; 3]> {
        let scene = self.polygons()?;
        let (mut corners, mut sizes, mut contours) = (Vec::new(), Vec::new(), Vec::new());
        for face in &scene.faces {
            contours.push(face.contours.len() as u32);
            for row in face.contours.clone() {
                let contour = scene.contours.get(row);
                corners.extend(contour.iter().map(|corner| corner.0));
                sizes.push(contour.len() as u32);
            }
        }
        Ok([corners, sizes, contours].map(|column| PyArray1::from_vec(py, column)))
    }

    /// Measurements at the vertices of a scene as seen.
    fn measurements<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (scene, time) = (self.polygons()?, self.time.unwrap_or(0.0));
        let rows =
            call::run(py, None, |_| ugscene::measure(scene, ugscene::eye(scene, None), time))?;
        let measured = PyDict::new(py);
        measured.set_item("position", self.vertices(py)?)?;
        let velocities = rows.iter().flat_map(|row| row.velocity.to_array()).collect();
        measured.set_item("velocity", table(py, velocities, 3)?)?;
        for (column, name) in ugscene::Measurement::SCALARS.iter().enumerate() {
            let numbers = rows.iter().map(|row| row.scalars()[column]).collect();
            measured.set_item(name, PyArray1::from_vec(py, numbers))?;
        }
        Ok(measured)
    }
}

/// Numbers as a table of some columns.
fn table(
    py: Python<'_>,
    numbers: Vec<f64>,
    n_columns: usize,
) -> PyResult<Bound<'_, PyArray2<f64>>> {
    use numpy::PyArrayMethods;

    let n_rows = numbers.len() / n_columns;
    PyArray1::from_vec(py, numbers).reshape([n_rows, n_columns])
}

impl PyScene {
    /// The scene as arrays show it: with polygons in the place of round faces.
    fn polygons(&self) -> PyResult<&Scene> {
        let scene = &self.parsed.scene;
        if !scene.has_rounds() {
            return Ok(scene);
        }
        let polygons = self.polygons.get_or_init(|| {
            let mut cut = scene.clone();
            let eye = cut.camera().and_then(|camera| camera.eye);
            ugscene::cut_rounds_at_rest(&mut cut, eye).map(|()| cut)
        });
        polygons.as_ref().map_err(|error| wrong(error.to_string()))
    }

    fn open(words: Vec<OsString>, given: Option<Input>, call: &Arc<Call>) -> Result<Self, Refused> {
        let Reading { common } = parse_words(words)?;
        let options = pipe::options(&common)?;
        let mut context = Context::hosted(&common, "read", String::new(), given, call.clone());
        let input = pipe::input(&mut context, &options)?;
        let source = pipe::follow(input, &options, &context)?;
        let mut parsed = ugparse::read(&source, &options, None)?;
        parsed.scene.head.files.extend(context.take_files_read());
        let warning =
            ugparse::rest_shapes_warning(&parsed).map(|found| Diagnostics::one(&source, found));
        let warning = warning.map(|found| found.worded().render(false));
        let mut notes = call.take_notes();
        notes.extend(notes_on(parsed.warnings.clone()));
        Ok(Self {
            parsed: Arc::new(parsed),
            polygons: OnceLock::new(),
            source: Arc::new(source),
            time: None,
            notes,
            warning,
        })
    }

    /// The scene whose camera is the one of this name.
    pub fn with_camera(&self, name: Option<&str>) -> Result<Arc<Parsed>, Refused> {
        let Some(name) = name else { return Ok(self.parsed.clone()) };
        let mut parsed = (*self.parsed).clone();
        // Spans of the cameras of a scene that a program made are not known.
        parsed.origins.cameras.resize(parsed.scene.cameras.len(), ugparse::Span::default());
        parsed.choose_camera(&self.source, name)?;
        Ok(Arc::new(parsed))
    }

    fn filter(
        &self,
        words: &[String],
        camera: Option<&str>,
        call: &Arc<Call>,
    ) -> Result<Self, Refused> {
        let ParsedCommand { program, line, .. } = ParsedCommand::from_words(words)?;
        let at_rest = self.with_camera(camera)?;
        let item = FilmItem::Scene(Box::new(at_rest.scene.clone()));
        let made = program.run(item, &**call).map_err(|error| self.refused(error))?;
        let Some((FilmItem::Scene(mut scene), told)) = made else {
            return Err(Refused::of(Error::Subject));
        };
        scene.head.record(Provenance { command: Some(&line), ..program.provenance() });
        let mut notes: Vec<String> = told.iter().flat_map(Note::words).collect();
        let mut time = self.time;
        if let Program::Lorentz(config) = &program {
            time = Some(config.time);
            if ugscene::may_miss_motion(&scene, &config.camera, config.size) {
                let camera = CameraOptions { eye: config.eye, ..config.camera.clone() };
                let note = BodyBoxes::new(&at_rest.scene).note(
                    &scene,
                    &config.motion(),
                    &camera,
                    config.size,
                );
                notes.extend(note.map(|note| note.words()));
            }
        }
        let source = Source::new("<scene>", "");
        let parsed = Parsed {
            scene: *scene,
            passed_on: at_rest.passed_on.clone(),
            origins: Origins::default(),
            bent: Vec::new(),
            warnings: Diagnostics::new(&source, Vec::new()),
        };
        Ok(Self {
            parsed: Arc::new(parsed),
            polygons: OnceLock::new(),
            source: Arc::new(source),
            time,
            notes,
            warning: None,
        })
    }

    /// The error of a filter, at its place in the text if there is one.
    fn refused(&self, error: ProgramError) -> Refused {
        match error {
            ProgramError::Lorentz(error) => {
                match error.diagnostics(&self.source, &self.parsed.origins) {
                    Some(findings) => findings.into(),
                    None => Refused::of(error),
                }
            }
            error => Refused::of(error),
        }
    }
}

/// The text of a scene of arrays: positions (n, 3); the corners of all faces, and the number of
/// corners of each; for each face a colour, display-encoded, and a velocity; for each vertex a
/// colour. The shapes have been checked.
#[pyfunction]
#[pyo3(signature = (vertices, corners, sizes, colors=None, velocities=None, vertex_colors=None))]
pub fn text_from_arrays<'py>(
    py: Python<'py>,
    vertices: PyReadonlyArray2<'py, f64>,
    corners: PyReadonlyArray1<'py, i64>,
    sizes: PyReadonlyArray1<'py, i64>,
    colors: Option<PyReadonlyArray2<'py, f64>>,
    velocities: Option<PyReadonlyArray2<'py, f64>>,
    vertex_colors: Option<PyReadonlyArray2<'py, f64>>,
) -> PyResult<Bound<'py, PyBytes>> {
    let mut text = String::new();
    let mut palette = Palette::default();
    let of_faces = palette.rows(&mut text, rows(colors.as_ref())?);
    let of_vertices = palette.rows(&mut text, rows(vertex_colors.as_ref())?);
    let velocities = rows(velocities.as_ref())?;
    for (row, [x, y, z]) in rows(Some(&vertices))?.into_iter().enumerate() {
        let color = of_vertices.get(row).map_or_else(String::new, |color| format!(" c{color}"));
        // Writing to a string cannot fail.
        let _ = writeln!(text, "v v{row} {x:?} {y:?} {z:?}{color};");
    }
    let (mut corners, n_vertices) = (corners.as_slice()?.iter(), vertices.shape()[0]);
    for (row, &size) in sizes.as_slice()?.iter().enumerate() {
        text.push_str("f (");
        for corner in corners.by_ref().take(usize::try_from(size).unwrap_or(0)) {
            if usize::try_from(*corner).map_or(true, |corner| corner >= n_vertices) {
                let what = format!("faces[{row}]: there is no vertex {corner} among {n_vertices}");
                return Err(Refused::Failure(Failure::Failed(what)).exception(py));
            }
            let _ = write!(text, " v{corner}");
        }
        text.push(')');
        if let Some(color) = of_faces.get(row) {
            let _ = write!(text, " c{color}");
        }
        if let Some([x, y, z]) = velocities.get(row).filter(|velocity| **velocity != [0.0; 3]) {
            let _ = write!(text, " <{x:?} {y:?} {z:?}>");
        }
        text.push_str(";\n");
    }
    Ok(PyBytes::new(py, text.as_bytes()))
}

/// The rows of an array (n, 3).
fn rows(array: Option<&PyReadonlyArray2<'_, f64>>) -> PyResult<Vec<[f64; 3]>> {
    let Some(array) = array else { return Ok(Vec::new()) };
    if array.shape()[1] != 3 {
        return Err(wrong("an array has not three columns"));
    }
    Ok(array.as_slice()?.as_chunks().0.to_vec())
}

/// Colours that have statements already.
#[derive(Default)]
struct Palette(std::collections::HashMap<[u64; 3], usize>);

impl Palette {
    /// The numbers of the colours of some rows. New ones are added to the text.
    fn rows(&mut self, text: &mut String, rows: Vec<[f64; 3]>) -> Vec<usize> {
        let number = |rgb: [f64; 3]| {
            let next = self.0.len();
            *self.0.entry(rgb.map(f64::to_bits)).or_insert_with(|| {
                let [red, green, blue] = rgb;
                let _ = writeln!(text, "c_rgb c{next} {red:?} {green:?} {blue:?};");
                next
            })
        };
        rows.into_iter().map(number).collect()
    }
}
