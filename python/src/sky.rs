//! Panoramas and stars.

use std::path::PathBuf;
use std::sync::Arc;

use pyo3::prelude::*;
use ugpipe::{Context, Input, ToolArgs, parse_command};

use crate::call::{self, Call};
use crate::error::Refused;
use crate::scene::{input, words_of_system};

/// A sky that was read, with the files that were read for it in the record of a picture.
#[pyclass(frozen, module = "uglorentz._core", name = "Sky")]
pub struct PySky {
    opened: Arc<ugwarp::Opened>,
    files: Vec<String>,
    /// What was noticed when it was read.
    #[pyo3(get)]
    notes: Vec<String>,
}

#[pymethods]
impl PySky {
    /// Reads a picture or a list of stars from files, of which the first may be in memory.
    /// `words`: those of the program that draws it, whose options say how it is read.
    #[staticmethod]
    #[pyo3(signature = (words, paths, data=None, threads=None))]
    fn read(
        py: Python<'_>,
        words: Vec<String>,
        paths: Vec<PathBuf>,
        data: Option<Vec<u8>>,
        threads: Option<usize>,
    ) -> PyResult<Self> {
        let data = data.map(|data| input(None, data));
        let open = move |call: &Arc<Call>| Self::open(&words, paths, data, call);
        call::run(py, None, threads, open)?.map_err(|refused| refused.exception(py))
    }
}

impl PySky {
    fn open(
        words: &[String],
        paths: Vec<PathBuf>,
        given: Option<Input>,
        call: &Arc<Call>,
    ) -> Result<Self, Refused> {
        let mut words = words_of_system(words, None);
        if !paths.is_empty() {
            words.push("--".into());
            words.extend(paths.into_iter().map(PathBuf::into_os_string));
        }
        let (args, line): (ugwarp::Args, _) = parse_command(words)?;
        let mut context = Context::hosted(args.common(), "ugwarp", line, given, call.clone());
        let input = context.input()?;
        let opened = args.open(&input, &context)?;
        let mut notes = call.take_notes();
        notes.extend(opened.notes.iter().cloned());
        Ok(Self { opened: Arc::new(opened), files: context.take_record(&input), notes })
    }

    /// The sky, and the record of the files that were read for it.
    pub fn subject(&self) -> (Arc<ugwarp::Opened>, Vec<String>) {
        (self.opened.clone(), self.files.clone())
    }
}
