//! Size and colours of text and lines.

use ugimage::figure::Rgb;
use ugimage::label::ink_on;
use ugphysics::{srgb_decode, srgb_encode};

use crate::options::PictureOptions;
use crate::output::Output;

/// Least size of text in pixels; smaller letters cannot be read.
const LEAST: f64 = 9.0;

/// Least size of text in pixels where there is room for it: letters that are easy to read.
const CLEAR: f64 = 12.0;

/// Least size of text in points, where a file states its resolution: what journals accept.
const LEAST_POINTS: f64 = 6.0;

/// Ratio of the geometric mean of the picture's sides to the text size.
const PER_SIZE: f64 = 40.0;

/// The same for text of at most [`CLEAR`].
const PER_SMALL_SIZE: f64 = 32.0;

/// Size and colours of text and lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Em size of text in pixels.
    pub size: f64,
    /// Black or white, whichever contrasts more with the background.
    pub ink: Rgb,
    /// Colour of lines in the background, such as a grid.
    pub faint: Rgb,
    /// Colour of the margin around lines, so that they stand out from everything.
    pub background: Rgb,
    /// Width of a thin line.
    pub hairline: f64,
}

impl Style {
    /// The style of a picture. `background`: light as displayed; on a transparent background the
    /// ink suits white paper.
    /// `size`: columns and rows of the picture with its strips; `options`: of the picture or of the
    /// part with the scene.
    pub fn new(size: [u32; 2], options: &PictureOptions, background: Option<[f32; 3]>) -> Self {
        let [width, height] = size.map(f64::from);
        let least = options.per_inch.map_or(LEAST, |inch| (LEAST_POINTS / 72.0 * inch).max(LEAST));
        let mean = libm::sqrt(width * height);
        let size = (mean / PER_SIZE).max(CLEAR.min(mean / PER_SMALL_SIZE));
        let size = options.annotations.text_size.unwrap_or_else(|| size.max(least).round());
        let byte = |part: f64| (255.0 * srgb_encode(part.clamp(0.0, 1.0))).round() as u8;
        let background =
            background.map_or([255; 3], |light| light.map(|part| byte(f64::from(part))));
        let ink = ink_on(background);
        let light = |level: u8| srgb_decode(f64::from(level) / 255.0);
        let faint = [0, 1, 2].map(|i| byte(0.65 * light(background[i]) + 0.35 * light(ink[i])));
        // A line thinner than a pixel would only look faint.
        let thinnest = if matches!(options.output, Output::Vector(_)) { 0.0 } else { 1.0 };
        Self { size, ink, faint, background, hairline: (size / 16.0).max(thinnest) }
    }

    /// Margin left and right of text.
    pub fn margin(&self) -> f64 {
        0.8 * self.size
    }
}
