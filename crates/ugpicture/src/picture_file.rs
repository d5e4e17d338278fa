//! What a renderer makes of a scene.

use ugparse::Diagnostics;

/// A picture as a file.
#[derive(Clone, Debug)]
pub struct PictureFile {
    /// The whole file.
    pub bytes: Vec<u8>,
    /// Notes for the user, one sentence each.
    pub notes: Vec<String>,
    /// Warnings about the text of the scene.
    pub warnings: Diagnostics,
}
