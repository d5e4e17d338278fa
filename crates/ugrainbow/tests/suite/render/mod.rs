//! Pictures of small scenes against geometry, closed forms and published numbers.

mod color;
mod geometry;
mod light;
mod messages;

use ugphysics::Hsv;
use ugpipe::Words;
use ugrainbow::{Config, render};

use crate::common::{from_above, scene, with};

const BLACK: Hsv = Hsv { hue: 0.0, saturation: 0.0, value: 0.0 };

/// One sample at the centre of each pixel.
fn plain(width: u32, height: u32) -> Config {
    with(&Config::default(), |picture| (picture.size, picture.samples) = ([width, height], 1))
}

#[track_caller]
fn notes(text: &str, config: &Config) -> Vec<String> {
    render(&scene(text), config).unwrap().notes.iter().map(Words::words).collect()
}

fn map(width: u32, height: u32) -> (String, Config) {
    (from_above(), plain(width, height))
}

fn level(encoded: f64) -> u8 {
    (255.0 * encoded).round() as u8
}

#[track_caller]
fn assert_near(pixel: [u8; 4], expected: [f64; 3]) {
    for (ours, exact) in pixel.iter().zip(expected) {
        // Half a level for rounding, and a little for single precision.
        assert!((f64::from(*ours) - 255.0 * exact).abs() < 0.51, "{pixel:?} for {expected:?}");
    }
}
