//! Films.

use std::path::PathBuf;
use std::sync::Arc;

use pyo3::prelude::*;
use ugpipe::{Context, ToolArgs, parse_command};

use crate::call::{self, Call};
use crate::error::Refused;
use crate::scene::{input, words_of_system};

/// Draws a film. `words`: those of the program, which name the output. Returns the notes.
#[pyfunction]
#[pyo3(signature = (words, path=None, text=None, progress=None))]
pub fn film(
    py: Python<'_>,
    words: Vec<String>,
    path: Option<PathBuf>,
    text: Option<Vec<u8>>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Vec<String>> {
    let draw = move |call: &Arc<Call>| {
        let (args, line): (ugfilm::Args, _) = parse_command(words_of_system(&words, path))?;
        let given = text.map(input);
        let mut context = Context::hosted(args.common(), "ugfilm", line, given, call.clone());
        let outcome = ugfilm::run(&args, &mut context);
        context.end(outcome)?;
        Ok(call.take_notes())
    };
    call::run(py, progress, draw)?.map_err(|refused: Refused| refused.exception(py))
}
