//! Films.

use std::path::PathBuf;
use std::sync::Arc;

use pyo3::prelude::*;
use ugpipe::{Context, ToolArgs, parse_command};

use crate::call::{self, Call};
use crate::error::Refused;
use crate::scene::{input, inputs, words_of_system};

/// Draws a film. `words`: those of the program, which name the output. `files`: those that the
/// scene names, in memory. Returns the notes.
#[pyfunction]
#[pyo3(signature = (words, path=None, text=None, files=Vec::new(), progress=None, threads=None))]
pub fn film(
    py: Python<'_>,
    words: Vec<String>,
    path: Option<PathBuf>,
    text: Option<Vec<u8>>,
    files: Vec<(String, Vec<u8>)>,
    progress: Option<Py<PyAny>>,
    threads: Option<usize>,
) -> PyResult<Vec<String>> {
    let draw = move |call: &Arc<Call>| {
        let (args, line): (ugfilm::Args, _) =
            parse_command(words_of_system(&words, path.as_deref()))?;
        let given = text.map(|text| input(path.as_deref(), text));
        let context = Context::hosted(args.common(), "ugfilm", line, given, call.clone());
        let mut context = context.beside(inputs(files));
        let outcome = ugfilm::run(&args, &mut context);
        context.end(outcome)?;
        Ok(call.take_notes())
    };
    call::run(py, progress, threads, draw)?.map_err(|refused: Refused| refused.exception(py))
}
