//! Pictures, as files and as arrays.

use std::sync::Arc;

use numpy::ndarray::Array3;
use numpy::{IntoPyArray, PyArray3, ToPyArray};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use ugfilm::{FilmSubject, Note, ParsedCommand, Pipe};
use ugimage::{LinearFrame, Samples};
use ugparse::Parsed;
use ugpicture::Rendering;
use ugpipe::{Context, Input};
use ugscene::{BodyBoxes, TimesInView};

use crate::call::{self, Call};
use crate::error::{Refused, wrong};
use crate::scene::PyScene;
use crate::sky::PySky;

/// A picture that was drawn with the words of one command line.
#[pyclass(frozen, module = "uglorentz._core")]
pub struct Drawing {
    rendering: Rendering,
    /// What was noticed when it was drawn.
    #[pyo3(get)]
    notes: Vec<String>,
    /// The command line that its file records.
    #[pyo3(get)]
    line: String,
}

/// The subject of a picture.
enum Subject {
    /// A scene, and the files that it named.
    Scene(Arc<Parsed>, Vec<Input>),
    Sky(Arc<ugwarp::Opened>, Vec<String>),
}

#[pymethods]
impl Drawing {
    /// Draws a scene or a sky. `camera`: the name of the camera that the words choose.
    #[new]
    #[pyo3(signature = (subject, words, camera=None, progress=None, threads=None))]
    fn new(
        py: Python<'_>,
        subject: &Bound<'_, PyAny>,
        words: Vec<String>,
        camera: Option<&str>,
        progress: Option<Py<PyAny>>,
        threads: Option<usize>,
    ) -> PyResult<Self> {
        let subject = match subject.cast::<PyScene>() {
            Ok(scene) => {
                let chosen = scene.get().with_camera(camera);
                let chosen = chosen.map_err(|refused| refused.exception(py))?;
                Subject::Scene(chosen, scene.get().files())
            }
            Err(_) => {
                let (opened, origin) = subject.cast::<PySky>()?.get().subject();
                Subject::Sky(opened, origin)
            }
        };
        let draw = |call: &Arc<Call>| Self::draw(&subject, &words, call);
        call::run(py, progress, threads, draw)?.map_err(|refused| refused.exception(py))
    }

    /// The bytes of its file.
    fn file<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let file = call::run(py, None, None, |_| self.rendering.clone().into_file())?;
        Ok(PyBytes::new(py, &file))
    }

    /// Its pixels, (height, width, 3 or 4), display-encoded with 8 bits.
    fn pixels<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let frame = self.rendering.clone().into_frame().ok_or_else(|| wrong(NO_PIXELS))?;
        let n_channels = if frame.is_opaque() { 3 } else { 4 };
        let shape = [frame.height() as usize, frame.width() as usize, n_channels];
        array(py, shape, frame.pixels().iter().map(|pixel| &pixel[..n_channels]))
    }

    /// Its linear light, (height, width, 3 or 4).
    fn light<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f32>>> {
        let frame = self.linear()?;
        let n_channels = if frame.is_opaque() { 3 } else { 4 };
        let shape = [frame.height() as usize, frame.width() as usize, n_channels];
        array(py, shape, frame.pixels().iter().map(|pixel| &pixel[..n_channels]))
    }

    /// Its other channels, (height, width) each.
    fn planes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let frame = self.linear()?;
        let shape = [frame.height() as usize, frame.width() as usize];
        let planes = PyDict::new(py);
        for plane in frame.planes() {
            match &plane.samples {
                Samples::Float(numbers) => {
                    planes.set_item(&plane.name, reshaped(numbers.to_pyarray(py), shape)?)?
                }
                Samples::Whole(numbers) => {
                    planes.set_item(&plane.name, reshaped(numbers.to_pyarray(py), shape)?)?
                }
            }
        }
        Ok(planes)
    }
}

const NO_PIXELS: &str = "vector graphics have no pixels";

fn reshaped<'py, T: numpy::Element>(
    column: Bound<'py, numpy::PyArray1<T>>,
    shape: [usize; 2],
) -> PyResult<Bound<'py, numpy::PyArray2<T>>> {
    use numpy::PyArrayMethods;

    column.reshape(shape)
}

/// An array of the channels of pixels.
fn array<'py, 'p, T: numpy::Element + Copy + 'p>(
    py: Python<'py>,
    shape: [usize; 3],
    pixels: impl Iterator<Item = &'p [T]>,
) -> PyResult<Bound<'py, PyArray3<T>>> {
    let mut numbers = Vec::with_capacity(shape.iter().product());
    pixels.for_each(|pixel| numbers.extend_from_slice(pixel));
    let array = Array3::from_shape_vec(shape, numbers).map_err(|error| wrong(error.to_string()))?;
    Ok(array.into_pyarray(py))
}

/// When bodies are in a picture in which nothing is, of a program that moves them.
fn when_in_view(pipe: &Pipe, subject: FilmSubject<'_>) -> Option<TimesInView> {
    let (FilmSubject::Scene(scene), [program]) = (subject, pipe.programs()) else { return None };
    let boxes = BodyBoxes::new(scene);
    boxes.times_in_view(&program.motion()?, &pipe.picture.camera, pipe.picture.size).ok()?
}

impl Drawing {
    fn draw(subject: &Subject, words: &[String], call: &Arc<Call>) -> Result<Self, Refused> {
        let ParsedCommand { program, line, common, .. } = ParsedCommand::from_words(words)?;
        let name = program.provenance().program;
        let mut pipe = Pipe::new(vec![program]);
        if let Some(sky) = pipe.sky() {
            let mut context = Context::hosted(&common, name, line.clone(), None, call.clone());
            if let Subject::Scene(parsed, files) = subject {
                sky.or_stated(parsed.scene.sky.as_ref());
                context = context.beside(files.clone());
            }
            sky.open(&common, &context)?;
            pipe.files = context.take_files_read();
            if let Subject::Scene(parsed, _) = subject {
                // A program reads scene and sky at once, and records each file once.
                pipe.files.retain(|file| !parsed.scene.head.files.contains(file));
            }
        }
        pipe.lines = vec![line.clone()];
        let subject = match subject {
            Subject::Scene(parsed, _) => FilmSubject::Scene(&parsed.scene),
            Subject::Sky(opened, files) => FilmSubject::Panorama(opened, files),
        };
        let (rendering, notes) = pipe.draw_with(subject, &**call).map_err(Refused::of)?;
        let mut words: Vec<String> = notes.iter().flat_map(Note::words).collect();
        if notes.iter().filter_map(Note::of_picture).any(ugpicture::Note::is_of_empty) {
            words.extend(
                when_in_view(&pipe, subject)
                    .map(|when| format!("what moves is in it with -ti {when}")),
            );
        }
        Ok(Self { rendering, notes: words, line })
    }

    fn linear(&self) -> PyResult<LinearFrame> {
        self.rendering
            .clone()
            .into_light()
            .ok_or_else(|| wrong("the picture holds no linear light"))
    }
}
