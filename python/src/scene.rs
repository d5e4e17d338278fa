//! Scenes: read, moved, coloured.

use std::collections::HashMap;
use std::ffi::OsString;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use clap::Parser;
use numpy::{PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use ugfilm::{Error, FilmItem, Note, ParsedCommand, Program, ProgramError};
use ugparse::{Diagnostics, Origins, Parsed, Source, pipe};
use ugpipe::{CommonArgs, Context, Input, MAX_INPUT, ToolArgs, Words, parse_words};
use ugscene::{BodyBoxes, CameraOptions, Provenance, Scene, StatedSky, TooManyPolygons};

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
    /// What it, or the scene from which programs made it, was read from.
    origin: Arc<ReadFrom>,
    /// The time of the picture, of a scene whose positions are as seen, even if nothing moves.
    time: Option<f64>,
    /// What was noticed when it was made.
    #[pyo3(get)]
    notes: Vec<String>,
    /// The warning for a picture of it in which moving bodies have their shapes at rest.
    #[pyo3(get)]
    warning: Option<String>,
}

/// All that a scene was read from, with which it can be read again.
struct ReadFrom {
    /// Options of reading.
    words: Vec<String>,
    path: Option<PathBuf>,
    /// The text; `None` if it is that of `source`, in which nothing was included.
    text: Option<Vec<u8>>,
    source: Arc<Source>,
    /// Files that it named, and the output of programs.
    files: Vec<Input>,
}

/// A file in memory, or anything with its name.
type NamedBytes = (String, Vec<u8>);

/// The arguments with which a scene is read again.
type ReadAgain<'py> =
    (Vec<String>, Option<PathBuf>, Bound<'py, PyBytes>, Vec<(String, Bound<'py, PyBytes>)>);

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
pub fn words_of_system(words: &[String], file: Option<&Path>) -> Vec<OsString> {
    let words = words.iter().map(OsString::from);
    words.chain(file.into_iter().flat_map(|file| ["--".into(), file.into()])).collect()
}

/// A text in memory: that of a file, or as a program reads it from standard input.
pub fn input(path: Option<&Path>, text: Vec<u8>) -> Input {
    let name = path.map_or_else(|| "<stdin>".to_owned(), |path| path.display().to_string());
    Input { name, text }
}

/// Files in memory.
pub fn inputs(files: Vec<NamedBytes>) -> Vec<Input> {
    files.into_iter().map(|(name, text)| Input { name, text }).collect()
}

/// The findings on a scene in text, one each.
fn notes_on(findings: Diagnostics) -> Vec<String> {
    let text = findings.worded().render(false);
    text.split("\n\n").filter(|note| !note.is_empty()).map(str::to_owned).collect()
}

#[pymethods]
impl PyScene {
    /// Reads a file, or the text of one. `words`: options of reading. `files`: those that the text
    /// names, in memory.
    #[staticmethod]
    #[pyo3(signature = (words, path=None, text=None, files=Vec::new(), threads=None))]
    fn read(
        py: Python<'_>,
        words: Vec<String>,
        path: Option<PathBuf>,
        text: Option<Vec<u8>>,
        files: Vec<NamedBytes>,
        threads: Option<usize>,
    ) -> PyResult<Self> {
        let read = move |call: &Arc<Call>| Self::open(words, path, text, files, call);
        call::run(py, None, threads, read)?.map_err(|refused| refused.exception(py))
    }

    /// The scene as a program makes it. `camera`: the name of the camera that its words choose.
    #[pyo3(signature = (words, camera=None, progress=None, threads=None))]
    fn filtered(
        &self,
        py: Python<'_>,
        words: Vec<String>,
        camera: Option<&str>,
        progress: Option<Py<PyAny>>,
        threads: Option<usize>,
    ) -> PyResult<Self> {
        let filter = |call: &Arc<Call>| self.filter(&words, camera, call);
        call::run(py, progress, threads, filter)?.map_err(|refused| refused.exception(py))
    }

    /// What it, or the scene from which programs made it, was read from: the options, path, text
    /// and files with which [`Self::read`] reads it again.
    fn origin<'py>(&self, py: Python<'py>) -> ReadAgain<'py> {
        let ReadFrom { words, path, text, source, files } = &*self.origin;
        let bytes = |bytes: &[u8]| PyBytes::new(py, bytes);
        let files = files.iter().map(|file| (file.name.clone(), bytes(&file.text))).collect();
        let text = bytes(text.as_ref().unwrap_or(&source.text));
        (words.clone(), path.clone(), text, files)
    }

    /// The scene as text.
    fn text<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let text = call::run(py, None, None, |_| {
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
        let rows = call::run(py, None, None, |_| {
            ugscene::measure(scene, ugscene::eye(scene, None), time)
        })?;
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

    fn open(
        words: Vec<String>,
        path: Option<PathBuf>,
        text: Option<Vec<u8>>,
        files: Vec<NamedBytes>,
        call: &Arc<Call>,
    ) -> Result<Self, Refused> {
        let Reading { common } = parse_words(words_of_system(&words, path.as_deref()))?;
        let options = pipe::options(&common)?;
        let given = text.map(|text| input(path.as_deref(), text));
        let context = Context::hosted(&common, "read", String::new(), given, call.clone());
        let mut context = context.beside(inputs(files));
        let input = pipe::input(&mut context, &options)?;
        let text = input.text.clone();
        let mut files: Vec<Input> = Vec::new();
        let mut keep = |name: String, text: &[u8]| {
            if files.iter().all(|file| file.name != name) {
                files.push(Input { name, text: text.to_vec() });
            }
        };
        let source = ugparse::include(input, &options, |request| {
            let answer = pipe::load(request, &context)?;
            keep(request.path.display().to_string(), &answer);
            Ok(answer)
        })?;
        let source = Arc::new(source);
        let mut parsed = ugparse::read(&source, &options, None)?;
        parsed.scene.head.files.extend(context.take_files_read());
        // Pictures read it; if it cannot be read, they say so.
        if let Some(StatedSky { file, .. }) = &parsed.scene.sky
            && let Ok(text) = context.read_named(Path::new(file), MAX_INPUT)
        {
            keep(file.clone(), &text);
        }
        let warning =
            ugparse::rest_shapes_warning(&parsed).map(|found| Diagnostics::one(&source, found));
        let warning = warning.map(|found| found.worded().render(false));
        let mut notes = call.take_notes();
        notes.extend(notes_on(parsed.warnings.clone()));
        let text = (text != source.text).then_some(text);
        let origin = Arc::new(ReadFrom { words, path, text, source: source.clone(), files });
        Ok(Self {
            parsed: Arc::new(parsed),
            polygons: OnceLock::new(),
            source,
            origin,
            time: None,
            notes,
            warning,
        })
    }

    /// The files that the scene named when it was read.
    pub fn files(&self) -> Vec<Input> {
        self.origin.files.clone()
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
            origin: self.origin.clone(),
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

/// Where rows of arrays stand in the text of a scene: a line mark names them in place of a file,
/// with the number of the first one. `of`: the mesh that they are in, of several.
fn mark_rows(text: &mut String, array: &str, of: &str) {
    let _ = writeln!(text, "# 0 \"<{array}{of}>\"");
}

/// The text of a mesh of arrays: positions (n, 3); the corners of all faces, and the number of
/// corners of each; for each face a colour, display-encoded with alpha, and a velocity; for each
/// vertex a colour and texture coordinates. Rows of NaN are left out. `prefix`: of the names of
/// vertices. `own`: the name of the colour of all faces. The arrays have been checked.
#[pyfunction]
#[pyo3(signature = (vertices, corners, sizes, colors=None, velocities=None, vertex_colors=None,
                    coordinates=None, prefix="", own=None))]
#[expect(clippy::too_many_arguments, reason = "an argument for each array")]
pub fn text_from_arrays<'py>(
    py: Python<'py>,
    vertices: PyReadonlyArray2<'py, f64>,
    corners: PyReadonlyArray1<'py, i64>,
    sizes: PyReadonlyArray1<'py, i64>,
    colors: Option<PyReadonlyArray2<'py, f64>>,
    velocities: Option<PyReadonlyArray2<'py, f64>>,
    vertex_colors: Option<PyReadonlyArray2<'py, f64>>,
    coordinates: Option<PyReadonlyArray2<'py, f64>>,
    prefix: &str,
    own: Option<&str>,
) -> PyResult<Bound<'py, PyBytes>> {
    let mut text = String::new();
    let of = prefix.strip_suffix('_').map_or_else(String::new, |mesh| format!(" of {mesh}"));
    mark_rows(&mut text, "colors", &of);
    let mut palette = Palette { prefix, numbers: HashMap::new() };
    let of_faces = palette.rows(&mut text, rows(colors.as_ref())?);
    let of_vertices = palette.rows(&mut text, rows(vertex_colors.as_ref())?);
    let velocities = rows::<3>(velocities.as_ref())?;
    let coordinates = rows::<2>(coordinates.as_ref())?;
    mark_rows(&mut text, "vertices", &of);
    for (row, [x, y, z]) in rows(Some(&vertices))?.into_iter().enumerate() {
        // Writing to a string cannot fail.
        let _ = write!(text, "v {prefix}v{row} {x:?} {y:?} {z:?}");
        if let Some(Some(color)) = of_vertices.get(row) {
            let _ = write!(text, " {prefix}c{color}");
        }
        if let Some([u, v]) = coordinates.get(row).filter(|numbers| !is_nothing(&numbers[..])) {
            let _ = write!(text, " ({u:?} {v:?})");
        }
        text.push_str(";\n");
    }
    mark_rows(&mut text, "faces", &of);
    let mut corners = corners.as_slice()?.iter();
    for (row, &size) in sizes.as_slice()?.iter().enumerate() {
        text.push_str("f (");
        for corner in corners.by_ref().take(usize::try_from(size).unwrap_or(0)) {
            let _ = write!(text, " {prefix}v{corner}");
        }
        text.push(')');
        match (of_faces.get(row), own) {
            (Some(Some(color)), _) => {
                let _ = write!(text, " {prefix}c{color}");
            }
            (_, Some(own)) => {
                let _ = write!(text, " {own}");
            }
            _ => {}
        }
        if let Some([x, y, z]) = velocities.get(row).filter(|velocity| **velocity != [0.0; 3]) {
            let _ = write!(text, " <{x:?} {y:?} {z:?}>");
        }
        text.push_str(";\n");
    }
    Ok(PyBytes::new(py, text.as_bytes()))
}

/// The rows of an array (n, N).
fn rows<const N: usize>(array: Option<&PyReadonlyArray2<'_, f64>>) -> PyResult<Vec<[f64; N]>> {
    let Some(array) = array else { return Ok(Vec::new()) };
    if array.shape()[1] != N {
        return Err(wrong(format!("an array has not {N} columns")));
    }
    Ok(array.as_slice()?.as_chunks().0.to_vec())
}

/// True of the row of what has none of this property.
fn is_nothing(row: &[f64]) -> bool {
    row.iter().all(|number| number.is_nan())
}

/// Colours that have statements already.
struct Palette<'p> {
    prefix: &'p str,
    numbers: HashMap<[u64; 4], usize>,
}

impl Palette<'_> {
    /// The numbers of the colours of some rows. New ones are added to the text.
    fn rows(&mut self, text: &mut String, rows: Vec<[f64; 4]>) -> Vec<Option<usize>> {
        let number = |color: [f64; 4]| {
            if is_nothing(&color) {
                return None;
            }
            let next = self.numbers.len();
            Some(*self.numbers.entry(color.map(f64::to_bits)).or_insert_with(|| {
                let ([red, green, blue, alpha], prefix) = (color, self.prefix);
                let _ = write!(text, "c_rgb {prefix}c{next} {red:?} {green:?} {blue:?}");
                if alpha < 1.0 {
                    let _ = write!(text, " {:?}", 1.0 - alpha);
                }
                text.push_str(";\n");
                next
            }))
        };
        rows.into_iter().map(number).collect()
    }
}
