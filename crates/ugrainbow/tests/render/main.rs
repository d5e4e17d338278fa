//! Pictures of small scenes against geometry, closed forms and published numbers.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

mod color;
#[path = "../common/mod.rs"]
mod common;
mod geometry;
mod light;
mod messages;

use common::scene;
use ugphysics::Hsv;
use ugpipe::Words;
use ugrainbow::{Config, PictureOptions, render};

const BLACK: Hsv = Hsv { hue: 0.0, saturation: 0.0, value: 0.0 };

/// One sample at the centre of each pixel.
fn plain(width: u32, height: u32) -> Config {
    Config {
        picture: PictureOptions { size: [width, height], samples: 1, ..PictureOptions::default() },
        ..Config::default()
    }
}

#[track_caller]
fn notes(text: &str, config: &Config) -> Vec<String> {
    render(&scene(text), config).unwrap().notes.iter().map(Words::words).collect()
}

/// Eye ten units above the plane z = 0, +y up; orthographic, and 8 units of the plane across the
/// picture.
fn map(width: u32, height: u32) -> (String, Config) {
    let angle = 2.0 * libm::atan(4.0 / 10.0).to_degrees();
    (format!("cam -ep 0 0 10 -vc 0 0 0 -ud 0 1 0 -og -va {angle} {angle};"), plain(width, height))
}

const SQUARE: &str = "v a -4 -4 0; v b 4 -4 0; v c 4 4 0; v d -4 4 0;";

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

#[test]
fn every_number_of_threads_draws_the_same() {
    let mut text = String::from("c a .9 20; c b .8 200 .5; l .2; l .8 1 -2 3;");
    for k in 0..400 {
        let angle = f64::from(k) * 2.4;
        let [x, y, z] = [libm::cos(angle), libm::sin(angle), libm::sin(1.7 * angle)].map(|u| 3.0 * u);
        text += &format!(
            "v p{k} {x} {y} {z}; v q{k} {} {} {} a; v r{k} {y} {z} {x}; f (p{k} q{k} r{k}) b; w (p{k} r{k});",
            -z, x, y
        );
    }
    text += "cam -ep 0 -12 1;";
    let scene = scene(&text);
    let config = Config {
        picture: PictureOptions { size: [320, 240], samples: 3, ..PictureOptions::default() },
        ..Config::default()
    };
    let with_threads = |n_threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
        let rendering = pool.install(|| render(&scene, &config).unwrap());
        (rendering.notes.clone(), rendering.into_frame().unwrap())
    };
    let (notes, frame) = with_threads(1);
    for n_threads in [2, 3, 7] {
        assert!(with_threads(n_threads) == (notes.clone(), frame.clone()), "{n_threads} threads");
    }
    assert!(frame.pixels().iter().filter(|pixel| pixel[0] > 0).count() > 10_000);
}
