//! Reading the whole input into memory.

use std::fs::File;
use std::io::{self, IsTerminal};
use std::path::Path;

use crate::cli::failure::Failure;
use crate::cli::files::read_file_up_to;

/// An input, read completely.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Input {
    /// The file as the user named it, or `<stdin>`. Bytes that are not UTF-8 are replaced.
    pub name: String,
    /// Its bytes.
    pub text: Vec<u8>,
}

const STDIN: &str = "<stdin>";

/// Reads a file, or standard input if `path` is `None`: at most `limit` bytes.
pub(crate) fn read(path: Option<&Path>, limit: u64) -> Result<Input, Failure> {
    let (name, text) = match path {
        Some(path) => (
            path.display().to_string(),
            File::open(path).and_then(|file| read_file_up_to(file, limit)),
        ),
        None => (STDIN.to_owned(), stdin().and_then(|file| read_file_up_to(file, limit))),
    };
    match text {
        Ok(text) => Ok(Input { name, text }),
        Err(error) => Err(Failure::Read { name, error }),
    }
}

/// Standard input as a file. `io::Stdin` reads nothing, without an error, if its descriptor is not
/// open for reading.
#[cfg(unix)]
fn stdin() -> io::Result<File> {
    use std::os::fd::AsFd;
    crate::cli::at_start::require_stdin()?;
    Ok(io::stdin().as_fd().try_clone_to_owned()?.into())
}

#[cfg(not(unix))]
fn stdin() -> io::Result<File> {
    Err(io::ErrorKind::Unsupported.into())
}

/// True if standard input is a pipe, so that a program upstream writes it.
#[cfg(unix)]
pub(crate) fn stdin_is_pipe() -> bool {
    use std::os::unix::fs::FileTypeExt;
    stdin().and_then(|file| file.metadata()).is_ok_and(|data| data.file_type().is_fifo())
}

#[cfg(not(unix))]
pub(crate) fn stdin_is_pipe() -> bool {
    false
}

/// True if standard input is a terminal, so that the user may not know that the program waits for
/// input.
pub(crate) fn stdin_is_terminal() -> bool {
    io::stdin().is_terminal()
}
