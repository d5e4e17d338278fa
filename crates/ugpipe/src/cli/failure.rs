//! The errors that end a program.

use std::error::Error;
use std::fmt;
use std::io;
use std::path::Path;

use crate::remedies::look_alike;

/// The error that ended a run. [`crate::main`] prints it and sets the exit status.
///
/// The operator `?` converts any library error to [`Failure::Failed`]. For errors in the command
/// line, write `.map_err(Failure::usage)?`.
#[derive(Debug)]
#[non_exhaustive]
pub enum Failure {
    /// The command line is invalid. Status 2.
    Usage(String),
    /// Any other error, described in one sentence. Status 1.
    Failed(String),
    /// Rendered diagnostics with their own locations and headings, printed as they are. They may
    /// contain terminal styles, which are removed if the output is not a terminal. Status 1.
    Report(String),
    /// An input cannot be read. Status 1.
    Read {
        /// The name of the input for messages.
        name: String,
        /// The message of the system.
        error: io::Error,
    },
    /// An output cannot be written. Status 1; but if the reading end of a pipe was closed, the
    /// program dies of SIGPIPE without a message.
    Write {
        /// The name of the output for messages.
        name: String,
        /// The message of the system.
        error: io::Error,
    },
}

impl Failure {
    /// A [`Failure::Usage`] with the message of `error`.
    pub fn usage(error: impl fmt::Display) -> Self {
        Self::Usage(error.to_string())
    }

    /// A [`Failure::Failed`] with the message of `error`.
    pub fn failed(error: impl fmt::Display) -> Self {
        Self::Failed(error.to_string())
    }

    /// The failure of a run by an error.
    pub fn of(error: impl Words) -> Self {
        match error.report() {
            Some(report) => Self::Report(report),
            None if error.is_usage() => Self::Usage(error.words()),
            None => Self::Failed(error.words()),
        }
    }

    /// True if the reading end of the output pipe was closed.
    pub fn is_closed_pipe(&self) -> bool {
        matches!(self, Self::Write { error, .. } if error.kind() == io::ErrorKind::BrokenPipe)
    }
}

/// An error or a note as a command line words it.
///
/// The `Display` of a library's error says what is wrong. Only the command line knows the options
/// that correct it.
pub trait Words {
    /// The error, and the options that correct it.
    fn words(&self) -> String;

    /// True if the command line is wrong, whatever the input.
    fn is_usage(&self) -> bool {
        false
    }

    /// Rendered diagnostics, if these are what is wrong.
    fn report(&self) -> Option<String> {
        None
    }
}

/// `Failure` itself does not implement [`Error`], so that `?` can convert every error to it.
impl<E: Error> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::failed(error)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Usage(text) | Self::Failed(text) | Self::Report(text) => f.write_str(text),
            Self::Read { name, error } if error.kind() == io::ErrorKind::IsADirectory => {
                write!(f, "`{name}` is a directory; name a file in it")
            }
            Self::Read { name, error } => {
                write!(f, "cannot read `{name}`: {}", reason(error))?;
                // As word processors write the hyphen of an option.
                match look_alike(name.get(..3).unwrap_or_default()) {
                    Some(remedy) => write!(f, "; {remedy}"),
                    None => Ok(()),
                }
            }
            Self::Write { name, error } if error.kind() == io::ErrorKind::NotFound => {
                let folder =
                    Path::new(name).parent().filter(|folder| !folder.as_os_str().is_empty());
                match folder {
                    Some(folder) => {
                        write!(
                            f,
                            "cannot write `{name}`: there is no folder `{}`",
                            folder.display()
                        )
                    }
                    None => write!(f, "cannot write `{name}`: {}", reason(error)),
                }
            }
            Self::Write { name, error } => write!(f, "cannot write `{name}`: {}", reason(error)),
        }
    }
}

/// The system's error message, without the error number that Rust appends.
pub(crate) fn reason(error: &io::Error) -> String {
    let text = error.to_string();
    match text.rsplit_once(" (os error ") {
        Some((words, _)) => words.to_owned(),
        None => text,
    }
}
