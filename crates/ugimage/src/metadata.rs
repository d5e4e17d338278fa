//! The text written beside the pixels.

use crate::PanoramaArea;

/// The record in a file of its origin.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Metadata {
    /// Name and version of the program.
    pub software: String,
    /// How the image was made: the command lines of the pipe, one per line.
    pub comment: String,
    /// Pixels in an inch. It is written to PNG files alone.
    pub per_inch: Option<f64>,
    /// Of a panorama, what viewers of 360° pictures read. It is written to PNG files alone.
    pub panorama: Option<PanoramaArea>,
    /// From the scene to the axes of the camera, and to normalized device coordinates: matrices for
    /// row vectors, row after row. They are written to EXR files alone.
    pub camera: Option<Box<[[f64; 16]; 2]>>,
}
