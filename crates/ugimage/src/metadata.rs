//! The text written beside the pixels.

use crate::PanoramaArea;

/// The record in a file of its origin.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Metadata {
    /// Name and version of the program.
    pub software: String,
    /// How the image was made: the command lines of the pipe, one per line.
    pub comment: String,
    /// Pixels in an inch. PNG files state it, and PDF, SVG, PostScript and EPS have that size.
    pub per_inch: Option<f64>,
    /// Of a panorama, what viewers of 360° pictures read. It is written to PNG files alone.
    pub panorama: Option<PanoramaArea>,
    /// From the scene to the axes of the camera, and to normalized device coordinates: matrices for
    /// row vectors, row after row. They are written to EXR files alone.
    pub camera: Option<Box<[[f64; 16]; 2]>>,
}

impl Metadata {
    /// The size in points of a picture with these pixels, rounded to whole points. Without a number
    /// of pixels in an inch a pixel is a point.
    pub(crate) fn points(&self, size: [u32; 2]) -> [u32; 2] {
        let per_point = self.per_inch.map_or(1.0, |per_inch| per_inch / 72.0);
        size.map(|side| ((f64::from(side) / per_point).round() as u32).max(1))
    }
}
