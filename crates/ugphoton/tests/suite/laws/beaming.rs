//! The light of moving bodies and lamps: Doppler factor, beaming, black bodies, irradiance.

use std::f64::consts::PI;

use glam::DVec3;
use ugphoton::{Config, Lens, MotionOptions};
use ugphysics::{Brightness, srgb_encode};

use crate::laws::drawing::{HEAD, by_law, config, drawn, surroundings};

#[track_caller]
fn check(found: f64, expected: f64, tolerance: f64) {
    assert!((found / expected - 1.0).abs() < tolerance, "{found} {expected}");
}

/// The mean over all directions of a number in a panorama whose poles are ±`pole`, a unit vector.
fn mean(
    text: &str,
    pole: DVec3,
    size: [u32; 2],
    base: Config,
    of: impl Fn([f32; 4]) -> f64,
) -> f64 {
    let mut config =
        Config { picture: config(size, pole.any_orthonormal_vector(), 60.0).picture, ..base };
    config.picture.camera.up = Some(pole);
    config.lens = Lens::Panorama;
    let frame = drawn(text, &config);
    let (width, height) = (size[0] as usize, f64::from(size[1]));
    let edge = |row: usize| libm::sin(PI * (0.5 - row as f64 / height));
    let rows = frame.pixels().chunks(width).enumerate().map(|(row, pixels)| {
        let sum: f64 = pixels.iter().map(|pixel| of(*pixel)).sum();
        0.5 * (edge(row) - edge(row + 1)) * sum / width as f64
    });
    rows.sum()
}

/// T21: the energy of an isotropic sky around a moving camera, in panoramas along and across the
/// motion.
#[test]
fn panoramas_have_the_energy_of_the_sky() {
    let text = format!("{HEAD}{}", surroundings("s", 1e3, "white 1"));
    for (beta, energies) in
        [(0.5, [1.0, 1.154_700_538, 1.444_444_444]), (0.9, [1.0, 2.294_157_339, 6.684_210_526])]
    {
        let along = DVec3::new(0.48, 0.6, 0.64);
        let motion =
            || MotionOptions { camera_velocity: Some(beta * along), ..MotionOptions::default() };
        let law = |law| Config { motion: motion(), ..by_law(law) };
        let linear = |pixel: [f32; 4]| f64::from(pixel[1]);
        let number = |pixel: [f32; 4]| srgb_encode(linear(pixel));
        let across = along.any_orthonormal_vector();
        for (pole, size, tolerance) in [(along, [2, 4000], 1e-5), (across, [240, 120], 2e-3)] {
            let of = |brightness| mean(&text, pole, size, law(brightness), linear);
            let squares = mean(&text, pole, size, law(Brightness::Report), |pixel| {
                number(pixel) * number(pixel)
            });
            check(squares, energies[0], tolerance);
            check(of(Brightness::Photon), energies[1], tolerance);
            check(of(Brightness::Bolometric), energies[2], tolerance);
        }
    }
}
