//! The text written beside the pixels.

use crate::PanoramaArea;

/// The record in a file of its origin.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Metadata {
    /// Name and version of the program.
    pub software: String,
    /// How the image was made: the command lines of the pipe, one per line.
    pub comment: String,
    /// Of a panorama, what viewers of 360° pictures read. It is written to PNG files alone.
    pub panorama: Option<PanoramaArea>,
}
