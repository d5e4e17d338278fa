//! Files whose names differ in the case of letters alone, as on systems that ignore it.

use std::error::Error;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// The cause of an [`io::Error`]: there is no file of this name, but one whose name differs in the
/// case of letters alone.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OtherCase {
    /// The path of the file that is there, with as many components as the one that is not.
    pub path: PathBuf,
}

impl OtherCase {
    /// The error of a file that is not there.
    pub fn error(path: PathBuf) -> io::Error {
        io::Error::new(io::ErrorKind::NotFound, Self { path })
    }

    /// The file that is there instead, if that is the cause of an error: a name with as many
    /// components as `name`.
    pub fn instead_of(name: &str, error: &io::Error) -> Option<String> {
        let Self { path } = error.get_ref()?.downcast_ref()?;
        let n_before =
            path.components().count().checked_sub(Path::new(name).components().count())?;
        let found: PathBuf = path.components().skip(n_before).collect();
        found.to_str().map(str::to_owned)
    }
}

impl fmt::Display for OtherCase {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = self.path.file_name().unwrap_or_default().to_string_lossy();
        write!(f, "No such file or directory, but `{name}` is there")
    }
}

impl Error for OtherCase {}
