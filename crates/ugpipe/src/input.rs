//! Reading the whole input into memory.

use std::fs;
use std::io::{self, IsTerminal, Read};
use std::path::Path;

use crate::failure::Failure;
use crate::text;

/// An input, read completely.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Input {
    /// Name for messages: the file as the user named it, or `<stdin>`.
    pub name: String,
    /// Its bytes.
    pub text: Vec<u8>,
}

const STDIN: &str = "<stdin>";

/// Reads a file, or standard input if `path` is `None`.
pub(crate) fn read(path: Option<&Path>) -> Result<Input, Failure> {
    let (name, text) = match path {
        Some(path) => (text::path(path), fs::read(path)),
        None => (STDIN.to_owned(), read_stdin()),
    };
    match text {
        Ok(text) => Ok(Input { name, text }),
        Err(error) => Err(Failure::Read { name, error }),
    }
}

fn read_stdin() -> io::Result<Vec<u8>> {
    let mut text = Vec::new();
    io::stdin().lock().read_to_end(&mut text)?;
    Ok(text)
}

/// True if standard input is a terminal, so that the user may not know that the program waits for
/// input.
pub(crate) fn stdin_is_terminal() -> bool {
    io::stdin().is_terminal()
}
