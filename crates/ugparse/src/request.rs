//! Requests of a scene for other texts, which the caller answers.

use std::io;
use std::path::{Component, Path, PathBuf};

use ugscene::Scene;

/// The kind of a requested text or picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RequestKind {
    /// `include`: the bytes of a file.
    Include,
    /// `-path` of a motion: the bytes of a file, a table of events.
    Path,
    /// `c_tex`: the bytes of a picture.
    Image,
    /// `sky`: nothing. Its name becomes a path from the current folder; renderers read the file.
    Sky,
    /// `execute`: the standard output of a program.
    Execute,
}

/// A text requested by a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Request<'r> {
    /// A file, or the output of a program.
    pub kind: RequestKind,
    /// The file or program, relative to the current folder.
    pub path: &'r Path,
    /// The largest allowed size in bytes; of a longer text, only one byte more has to be read.
    pub room: u64,
}

/// Failure of a [`Request`].
#[derive(Debug)]
#[non_exhaustive]
pub enum RequestError {
    /// The file cannot be read, or the program cannot be run.
    System(io::Error),
    /// The program has run, and failed.
    Failed {
        /// Its exit status: `exit status: 3`.
        status: String,
        /// The first line of its standard error; may be empty.
        complaint: String,
    },
}

impl From<io::Error> for RequestError {
    fn from(error: io::Error) -> Self {
        Self::System(error)
    }
}

/// The path of `name`, relative to the folder of `file`.
pub(crate) fn relative_to(file: &str, name: &str) -> PathBuf {
    without_dots(&Path::new(file).parent().unwrap_or(Path::new("")).join(name))
}

/// Names the pictures of a mesh, which are files beside it or within it, by paths from the current
/// folder. Those within a mesh from standard input have no name.
pub fn name_pictures(scene: &mut Scene, mesh: &str) {
    let is_named = !mesh.starts_with('<');
    for image in scene.textures.iter_mut().map(|texture| &mut texture.image) {
        let beside = |file: String| relative_to(mesh, &file).to_string_lossy().into_owned();
        let within = || (is_named && image.row.is_some()).then(|| mesh.to_owned());
        let path = image.file.take().map(beside).or_else(within);
        image.file = path.filter(|path| !path.contains(['"', '\n']));
    }
}

/// The path without `.`; a path of nothing else is `.`. A `..` stays: after a link, it is not the
/// folder of the link. So does a `/` at the end, with which no file is found.
pub(crate) fn without_dots(path: &Path) -> PathBuf {
    let whole: PathBuf =
        path.components().filter(|component| *component != Component::CurDir).collect();
    let name = path.as_os_str().as_encoded_bytes();
    match whole.as_os_str().is_empty() {
        true => ".".into(),
        false if name.ends_with(b"/") || name.ends_with(b"/.") => whole.join(""),
        false => whole,
    }
}
