//! Pictures of scenes given as text.
#![allow(dead_code, clippy::unwrap_used, reason = "each test uses a part; a test fails by panicking")]

use ugimage::Frame;
use ugrainbow::{Config, render};

/// The scene of a text.
#[track_caller]
pub fn scene(text: &str) -> ugparse::Scene {
    let source = ugparse::Source::new("test.ug", text);
    ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene
}

/// The picture of a text.
#[track_caller]
pub fn draw(text: &str, config: &Config) -> Frame {
    render(&scene(text), config).unwrap().0
}

/// Of a square picture.
pub fn config(side: u32, samples: u32) -> Config {
    Config { size: [side, side], samples, ..Config::default() }
}
