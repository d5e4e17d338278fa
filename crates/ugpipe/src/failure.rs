//! Why a program ends without having done its work.

use std::error::Error;
use std::fmt;
use std::io;

/// Why a run ended early. [`crate::main`] prints it and sets the exit status.
///
/// Any error of a library turns into [`Failure::Failed`] by `?`; where the command line
/// is to blame, say `.map_err(Failure::usage)?`.
#[derive(Debug)]
pub enum Failure {
    /// The command line asks for something impossible. Status 2.
    Usage(String),
    /// The work cannot be done, in one sentence. Status 1.
    Failed(String),
    /// Finished diagnostics with their own places and headings, printed as they are.
    /// They may carry terminal styles, which are left out where they do not belong.
    /// Status 1.
    Report(String),
    /// An input cannot be read. Status 1.
    Read {
        /// The input as shown to the user.
        name: String,
        /// What the system said.
        error: io::Error,
    },
    /// An output cannot be written. Status 1; but when the reader of a pipe has left,
    /// the program dies of SIGPIPE without a word.
    Write {
        /// The output as shown to the user.
        name: String,
        /// What the system said.
        error: io::Error,
    },
}

impl Failure {
    /// The command line is to blame for `error`.
    pub fn usage(error: impl fmt::Display) -> Self {
        Self::Usage(error.to_string())
    }

    /// The work cannot be done because of `error`.
    pub fn failed(error: impl fmt::Display) -> Self {
        Self::Failed(error.to_string())
    }

    /// The reader of our output has closed the pipe.
    pub fn is_closed_pipe(&self) -> bool {
        matches!(self, Self::Write { error, .. } if error.kind() == io::ErrorKind::BrokenPipe)
    }
}

/// `Failure` itself is no [`Error`], so that every error can become one by `?`.
impl<E: Error> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::failed(error)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Usage(text) | Self::Failed(text) | Self::Report(text) => f.write_str(text),
            Self::Read { name, error } => write!(f, "cannot read `{name}`: {}", reason(error)),
            Self::Write { name, error } => write!(f, "cannot write `{name}`: {}", reason(error)),
        }
    }
}

/// The system's words without the number Rust adds to them.
pub(crate) fn reason(error: &io::Error) -> String {
    let text = error.to_string();
    match text.rsplit_once(" (os error ") {
        Some((words, _)) => words.to_owned(),
        None => text,
    }
}
