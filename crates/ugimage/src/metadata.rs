//! The text written beside the pixels.

/// What a file records about its origin.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Metadata {
    /// Name and version of the program.
    pub software: String,
    /// How the image was made: the command lines of the pipe, one per line.
    pub comment: String,
}
