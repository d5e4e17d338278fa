//! Size and colours of text and lines.

use uglabel::{Rgb, ink_on};
use ugphysics::{srgb_decode, srgb_encode};

use crate::config::Output;

/// Least size of text in pixels; smaller letters cannot be read.
const LEAST: f64 = 9.0;

/// Text is as many times smaller than the picture.
const PER_SIZE: f64 = 40.0;

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
    /// Width of a thin line.
    pub hairline: f64,
}

impl Style {
    /// That of a picture. `ground`: light as it is displayed; on a clear ground ink is made for white paper.
    pub fn new(size: [u32; 2], ground: Option<[f32; 3]>, output: Output) -> Self {
        let [width, height] = size.map(f64::from);
        let size = (libm::sqrt(width * height) / PER_SIZE).round().max(LEAST);
        let byte = |part: f64| (255.0 * srgb_encode(part.clamp(0.0, 1.0))).round() as u8;
        let ground = ground.map_or([255; 3], |light| light.map(|part| byte(f64::from(part))));
        let ink = ink_on(ground);
        let light = |level: u8| srgb_decode(f64::from(level) / 255.0);
        let faint = [0, 1, 2].map(|i| byte(0.65 * light(ground[i]) + 0.35 * light(ink[i])));
        // Pixels cannot show what is thinner than they are.
        let thinnest = if matches!(output, Output::Vector(_)) { 0.0 } else { 1.0 };
        Self { size, ink, faint, ground, hairline: (size / 16.0).max(thinnest) }
    }

    /// Left and right of text.
    pub fn margin(&self) -> f64 {
        0.8 * self.size
    }
}
