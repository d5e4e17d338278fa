//! Size and colours of text and lines.

use uglabel::Rgb;
use ugphysics::{luminance, srgb_decode, srgb_encode};

use crate::config::{Background, Config};

/// Least size of text in pixels; smaller letters cannot be read.
const LEAST: f64 = 9.0;

/// A ground that is lighter than this has black ink: it contrasts with both black and white by the same ratio.
const MIDDLE: f64 = 0.179;

/// Size and colours of text and lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Of the em of text, in pixels; a whole number.
    pub size: f64,
    /// Black or white, what contrasts more with the ground.
    pub ink: Rgb,
    /// Of lines that shall not be loud.
    pub faint: Rgb,
    /// What stands round lines so that they are seen on everything.
    pub ground: Rgb,
}

impl Style {
    /// That of a picture. On a clear ground it is made for white paper.
    pub fn new(config: &Config) -> Self {
        let [width, height] = config.size.map(f64::from);
        let size = (libm::sqrt(width * height) / 40.0).round().max(LEAST);
        let ground = match config.background {
            Background::Clear => [1.0; 3],
            Background::Color(color) => color.to_rgb().map(srgb_decode),
        };
        let ink = if luminance(ground) > MIDDLE { 0.0 } else { 1.0 };
        let bytes = |light: [f64; 3]| light.map(|part| (255.0 * srgb_encode(part)).round() as u8);
        Self {
            size,
            ink: bytes([ink; 3]),
            faint: bytes(ground.map(|part| 0.65 * part + 0.35 * ink)),
            ground: bytes(ground),
        }
    }

    /// Left and right of text.
    pub fn margin(&self) -> f64 {
        0.8 * self.size
    }

    /// Width of a thin line.
    pub fn hairline(&self) -> f64 {
        (self.size / 16.0).max(1.0)
    }
}
