//! The light of moving bodies and lamps: Doppler factor, beaming, black bodies, irradiance.

use std::f64::consts::PI;

use glam::DVec3;
use ugphoton::{Config, Lens, MotionOptions};
use ugphysics::{Brightness, linear_srgb_to_xyz, srgb_encode};

use crate::laws::drawing::{HEAD, by_law, by_spectra, config, drawn, seen_with, square, surroundings, value};

fn gamma(beta: f64) -> f64 {
    1.0 / ((1.0 - beta) * (1.0 + beta)).sqrt()
}

#[track_caller]
fn check(found: f64, expected: f64, tolerance: f64) {
    assert!((found / expected - 1.0).abs() < tolerance, "{found} {expected}");
}

/// D of a white body around the eye, with velocity β along x, for light at an angle to it.
fn doppler(beta: f64, cos: f64) -> f64 {
    let text = format!("{HEAD}{}", surroundings("s", 1e3, &format!("white 1 <{beta} 0 0>")));
    let toward = -DVec3::new(cos, (1.0 - cos * cos).sqrt(), 0.0);
    value(&text, toward, by_law(Brightness::Report))
}

/// T19: bodies that approach, recede, and pass.
#[test]
fn frequencies_are_those_of_the_doppler_effect() {
    for (beta, approaching, receding, passing) in [
        (0.5, 1.732_050_808, 0.577_350_269_2, 0.866_025_403_8),
        (0.6, 2.0, 0.5, 0.8),
        (0.8, 3.0, 1.0 / 3.0, 0.6),
        (0.9, 4.358_898_944, 0.229_415_733_9, 0.435_889_894_4),
        (0.99, 14.106_735_98, 0.070_888_120_5, 0.141_067_359_8),
    ] {
        check(doppler(beta, 1.0), approaching, 1e-6);
        check(doppler(beta, -1.0), receding, 1e-6);
        check(doppler(beta, 0.0), passing, 1e-6);
    }
    for (cos, expected) in
        [(1.0, 2.0), (0.846_153_846_2, 1.625), (0.6, 1.25), (0.142_857_142_9, 0.875), (-1.0, 0.5)]
    {
        check(doppler(0.6, cos), expected, 1e-6);
    }
    for (beta, degrees) in [(0.5, 74.457_731_78_f64), (0.9, 51.186_383_44), (0.99, 29.818_063_85)] {
        check(doppler(beta, libm::cos(degrees.to_radians())), 1.0, 1e-6);
    }
    // √((2 − 10⁻¹²)/10⁻¹²)
    check(doppler(0.999_999_999_999, 1.0), 1_414_213.562, 1e-6);
}

/// T19: D is γ for light that is transverse in the frame of its source, which is seen ahead of it;
/// and a camera that moves sees it there, too.
#[test]
fn transverse_light_depends_on_the_frame() {
    for beta in [0.5, 0.9] {
        let law = || by_law(Brightness::Report);
        let lamp = |motion: &str| {
            format!("{HEAD}{}", square("l", DVec3::NEG_Z, DVec3::Z, 1e-3, &format!("white 1 {motion}")))
        };
        // At time 0 the lamp is abreast of the eye; it was seen where it was γ before.
        let moving = lamp(&format!("<{beta} 0 0>"));
        let behind = DVec3::new(-gamma(beta) * beta, 0.0, -1.0);
        check(value(&moving, behind, law()), gamma(beta), 1e-6);
        assert_eq!(value(&moving, DVec3::NEG_Z, law()), 0.0);
        let camera_velocity = Some(DVec3::X * beta);
        let motion = MotionOptions { camera_velocity, ..MotionOptions::default() };
        let ahead = DVec3::new(gamma(beta) * beta, 0.0, -1.0);
        check(value(&lamp(""), ahead, Config { motion, ..law() }), gamma(beta), 1e-6);
    }
}

/// The mean over all directions of a number in a panorama whose poles are ±`pole`, a unit vector.
fn mean(text: &str, pole: DVec3, size: [u32; 2], base: Config, of: impl Fn([f32; 4]) -> f64) -> f64 {
    let mut config = Config { picture: config(size, pole.any_orthonormal_vector(), 60.0).picture, ..base };
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
        let motion = || MotionOptions { camera_velocity: Some(beta * along), ..MotionOptions::default() };
        let law = |law| Config { motion: motion(), ..by_law(law) };
        let linear = |pixel: [f32; 4]| f64::from(pixel[1]);
        let number = |pixel: [f32; 4]| srgb_encode(linear(pixel));
        let across = along.any_orthonormal_vector();
        for (pole, size, tolerance) in [(along, [2, 4000], 1e-5), (across, [240, 120], 2e-3)] {
            let of = |brightness| mean(&text, pole, size, law(brightness), linear);
            let squares =
                mean(&text, pole, size, law(Brightness::Report), |pixel| number(pixel) * number(pixel));
            check(squares, energies[0], tolerance);
            check(of(Brightness::Photon), energies[1], tolerance);
            check(of(Brightness::Bolometric), energies[2], tolerance);
        }
    }
}

/// The luminance and the chromaticity of a black body around the eye.
fn black_body(kelvin: f64, beta: f64) -> (f64, [f64; 2]) {
    let body = surroundings("s", 1e3, &format!("hot 1 <{beta} 0 0>"));
    let light = seen_with(&format!("{HEAD} c_bb hot {kelvin};{body}"), DVec3::NEG_X, by_spectra());
    let [x, y, z] = linear_srgb_to_xyz(light.to_array());
    (y, [x, y].map(|part| part / (x + y + z)))
}

/// T22: a black body of 5800 K is seen as one of D times this temperature.
#[test]
fn moving_black_bodies_stay_black_bodies() {
    let (at_rest, _) = black_body(5800.0, 0.0);
    for (beta, luminance, [x, y]) in [
        (0.0, 1.0, [0.325_982_6, 0.335_319_1]),
        (0.5, 7.127_772, [0.280_381_3, 0.287_989_8]),
        (0.9, 49.434_003, [0.252_352_6, 0.251_986_8]),
    ] {
        let (found, chromaticity) = black_body(5800.0, beta);
        check(found / at_rest, luminance, 1e-3);
        assert!((chromaticity[0] - x).abs() < 1e-4 && (chromaticity[1] - y).abs() < 1e-4, "{chromaticity:?}");
    }
    // Of a receding one only the luminance is published.
    check(black_body(5800.0, -0.5).0 / at_rest, 0.038_710_5, 1e-3);
}

/// T23: a lattice that glows at 1000 °C, from a camera that flies through it with 0.9 c: "1.7
/// million times brighter" ahead, "4e22 times weaker" behind (spacetimetravel.org).
#[test]
fn a_glowing_lattice_is_brighter_ahead() {
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/lattice.ug");
    let scene =
        std::fs::read_to_string(scene).unwrap().replace("c green 0.95 120 0.75", "c_bb green 1273.15");
    // Each face has a light level of its own, and there are no lamps.
    let mut text = String::new();
    for line in scene.lines().filter(|line| !line.starts_with("l ") && !line.starts_with("cam ")) {
        text += &if line.starts_with("f ") { line.replace(';', " green 1 ;") } else { line.to_owned() };
        text.push('\n');
    }
    text += "l 0;";
    let luminance = |camera: f64| {
        let motion = MotionOptions { camera_velocity: Some(DVec3::Y * camera), ..MotionOptions::default() };
        let picture = config([48, 36], DVec3::Y, 60.0).picture;
        let frame = drawn(&text, &Config { motion, picture, ..by_spectra() });
        let all = frame.pixels().iter().map(|pixel| {
            let [red, green, blue, _] = pixel.map(f64::from);
            linear_srgb_to_xyz([red, green, blue])[1]
        });
        all.sum::<f64>()
    };
    let at_rest = luminance(0.0);
    let (ahead, behind) = (luminance(0.9) / at_rest, luminance(-0.9) / at_rest);
    // A picture averages over angles, and we do not know which: this compares orders of magnitude.
    for (found, published) in [(ahead, 1.7e6), (behind, 1.0 / 4e22)] {
        assert!((0.1..10.0).contains(&(found / published)), "{found:e}");
    }
}
