//! Pictures of scenes given as text.

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
    with(&Config::default(), |picture| (picture.size, picture.samples) = ([side, side], samples))
}

/// A file of the picture of a text.
#[track_caller]
pub fn file(text: &str, config: &Config) -> Vec<u8> {
    run(config, &Source::new("test.ug", text)).unwrap().bytes
}

/// Linear red, green and blue of every pixel, out of a PFM file.
#[track_caller]
pub fn light(text: &str, config: &Config) -> Vec<[f32; 3]> {
    let file = file(text, &with(config, |picture| picture.output = Output::Color(Format::Pfm)));
    let [width, height] = config.picture.size.map(|side| side as usize);
    let data = file[file.len() - 12 * width * height..].as_chunks::<4>().0;
    let numbers: Vec<f32> = data.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect();
    numbers.chunks(3 * width).rev().flat_map(|row| row.as_chunks::<3>().0.to_vec()).collect()
}

/// The same with other options of the picture.
pub fn with(config: &Config, change: impl FnOnce(&mut PictureOptions)) -> Config {
    let mut config = config.clone();
    change(&mut config.picture);
    config
}

/// Corners of a square that fills the view from above.
pub const SQUARE: &str = "v a -4 -4 0; v b 4 -4 0; v c 4 4 0; v d -4 4 0;";

/// A camera ten units above the plane z = 0, +y up; orthographic, and 8 units of the plane across
/// the picture.
pub fn from_above() -> String {
    let angle = 2.0 * libm::atan(4.0 / 10.0).to_degrees();
    format!("cam -ep 0 0 10 -vc 0 0 0 -ud 0 1 0 -og -va {angle} {angle};")
}
