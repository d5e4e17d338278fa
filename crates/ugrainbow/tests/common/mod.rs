//! Pictures of scenes given as text.
#![allow(dead_code, clippy::unwrap_used, reason = "each test uses a part; a test fails by panicking")]

use ugimage::{Format, Frame};
use ugparse::Source;
use ugrainbow::{Config, Output, PictureOptions, render, run};

/// The scene of a text. Without a camera the eye is at the origin.
#[track_caller]
pub fn scene(text: &str) -> ugscene::Scene {
    let source = Source::new("test.ug", text);
    let mut scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
    if scene.cameras.is_empty() && scene.stage.seen_geometry().is_none() {
        scene.cameras.push(ugscene::Camera { eye: Some(glam::DVec3::ZERO), ..Default::default() });
    }
    scene
}

/// The picture of a text.
#[track_caller]
pub fn draw(text: &str, config: &Config) -> Frame {
    render(&scene(text), config).unwrap().into_frame().unwrap()
}

/// Options of a square picture.
pub fn config(side: u32, samples: u32) -> Config {
    Config {
        picture: PictureOptions { size: [side, side], samples, ..PictureOptions::default() },
        ..Config::default()
    }
}

/// A file of the picture of a text.
#[track_caller]
pub fn file(text: &str, config: &Config) -> Vec<u8> {
    run(config, &Source::new("test.ug", text)).unwrap().bytes
}

/// Linear red, green and blue of every pixel, out of a PFM file.
#[track_caller]
pub fn light(text: &str, config: &Config) -> Vec<[f32; 3]> {
    let file = file(
        text,
        &Config {
            picture: PictureOptions { output: Output::Color(Format::Pfm), ..config.picture.clone() },
            ..config.clone()
        },
    );
    let [width, height] = config.picture.size.map(|side| side as usize);
    let data = file[file.len() - 12 * width * height..].as_chunks::<4>().0;
    let numbers: Vec<f32> = data.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect();
    numbers.chunks(3 * width).rev().flat_map(|row| row.as_chunks::<3>().0.to_vec()).collect()
}
