//! The file of a picture, with notes and warnings.

use ugparse::Diagnostics;

use crate::note::Note;

/// A picture as a file.
#[derive(Clone, Debug)]
pub struct PictureFile {
    /// The whole file.
    pub bytes: Vec<u8>,
    /// Notes on it.
    pub notes: Vec<Note>,
    /// Warnings about the text of the scene.
    pub warnings: Diagnostics,
}
