//! The text written beside the pixels.

/// The record in a file of its origin.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Metadata {
    /// Name and version of the program.
    pub software: String,
    /// How the image was made: the command lines of the pipe, one per line.
    pub comment: String,
}
