//! The light of moving bodies and lamps: Doppler factor, beaming, black bodies, irradiance.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use ugphoton::{Config, Lens, MotionOptions};
use ugphysics::spectrum::Spectrum;
use ugphysics::{Brightness, linear_srgb_to_xyz, srgb_encode};

use crate::laws::drawing::{
    HEAD, boost, by_law, by_spectra, config, drawn, grey_light, seen_with, square, surroundings, value,
    velocity,
};

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

/// T20: the powers of D of photon radiance, radiance, and radiance per unit of wavelength.
#[test]
fn radiances_change_by_powers_of_the_doppler_factor() {
    for (beta, toward, powers) in [
        (0.5, DVec3::NEG_X, [5.196_152_423, 9.0, 15.588_457_27]),
        (0.5, DVec3::X, [0.192_450_089_7, 0.111_111_111_1, 0.064_150_029_91]),
        (0.9, DVec3::NEG_X, [82.819_079_93, 361.0, 1_573.562_519]),
        (0.9, DVec3::X, [0.012_074_512_31, 0.002_770_083_102, 0.000_635_500_647_8]),
        (0.9, DVec3::Y, [0.082_819_079_93, 0.0361, 0.015_735_625_19]),
    ] {
        let text =
            |color: &str| format!("{HEAD}{color}{}", surroundings("s", 1e3, &format!("own 1 <{beta} 0 0>")));
        let [photons, energy, per_wavelength] = powers;
        check(grey_light(&text("c own 1;"), toward, by_law(Brightness::Photon)), photons, 1e-5);
        check(grey_light(&text("c own 1;"), toward, by_law(Brightness::Bolometric)), energy, 1e-5);
        // The same radiance at every wavelength.
        let light = seen_with(&text("c_spd own 1 1 1000000 1;"), toward, by_spectra());
        check(linear_srgb_to_xyz(light.to_array())[1], per_wavelength, 1e-4);
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

/// T24: the dipole of the cosmic background, in a panorama of a black body a thousand times hotter.
#[test]
fn the_motion_of_the_sun_makes_a_dipole() {
    const KELVIN: f64 = 2725.48;
    let beta = 369.82 / 299_792.458;
    let text = format!("{HEAD}c_bb hot {KELVIN};{}", surroundings("s", 1e3, "hot 1"));
    let direction = DVec3::new(-0.48, 0.6, 0.64);
    let motion = MotionOptions { camera_velocity: Some(beta * direction), ..MotionOptions::default() };
    let base = Config { motion, ..by_spectra() };
    let mut config = Config { picture: config([48, 24], direction, 60.0).picture, ..base };
    config.lens = Lens::Panorama;
    let frame = drawn(&text, &config);
    let up = config.picture.camera.up.unwrap();
    let right = direction.cross(up).normalize();
    let up = right.cross(direction);
    let mut coldest = (f64::INFINITY, DVec3::ZERO);
    let mut hottest = (0.0, DVec3::ZERO);
    for (at, pixel) in frame.pixels().iter().enumerate() {
        let (column, row) = ((at % 48) as f64 + 0.5, (at / 48) as f64 + 0.5);
        let (sin, cos) = libm::sincos(TAU * (column / 48.0 - 0.5));
        let (rise, run) = libm::sincos(PI * (0.5 - row / 24.0));
        let toward = run * (cos * direction + sin * right) + rise * up;
        let [red, green, blue, _] = pixel.map(f64::from);
        let found = temperature(linear_srgb_to_xyz([red, green, blue])[1], KELVIN);
        let expected = KELVIN / (gamma(beta) * (1.0 - beta * toward.dot(direction)));
        assert!((found - expected).abs() < 2e-3, "{toward} {found} {expected}");
        if found > hottest.0 {
            hottest = (found, toward);
        }
        if found < coldest.0 {
            coldest = (found, toward);
        }
    }
    // The pixels nearest to the poles are half a pixel away from them.
    let cos = hottest.1.dot(direction);
    assert!(cos > 0.99 && coldest.1.dot(direction) < -0.99);
    let half = 0.5 * (hottest.0 - coldest.0) / cos;
    check(half, 3.362_118_538, 5e-4);
}

/// The temperature of a black body with a luminance relative to that of another.
fn temperature(luminance: f64, reference: f64) -> f64 {
    let (mut low, mut high) = (0.9 * reference, 1.1 * reference);
    let of_reference = Spectrum::blackbody(reference, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if of_reference.seen(middle / reference)[1] < luminance { low = middle } else { high = middle }
    }
    low
}

/// T25: a point lamp of power 1, seen from a surface at rest at distance 2. Levels of lamps do not
/// decrease with distance, so the level states 1/(4π r'²), r' the distance in the frame of the
/// lamp.
#[test]
fn moving_lamps_light_by_powers_of_their_doppler_factor() {
    let place = DVec3::NEG_Z;
    for (speed, toward_lamp, expected) in [
        // Head-on, published; then P D⁴/(4π r²).
        (0.5, DVec3::Z, Some(0.179_049_311)),
        (0.9, DVec3::Z, Some(7.181_866_807)),
        (-0.5, DVec3::Z, None),
        (0.8, DVec3::new(0.6, 0.0, 0.8), None),
        (-0.7, DVec3::new(0.0, -0.6, 0.8), None),
    ] {
        let v = DVec3::NEG_Z * speed;
        let doppler = 1.0 / (gamma(speed) * (1.0 + v.dot(toward_lamp)));
        let distance = 2.0;
        let energy = doppler * doppler * doppler * doppler / (4.0 * PI * distance * distance);
        check(energy, expected.unwrap_or(energy), 1e-8);
        // The light reaches the surface at time −1. The frame of the lamp has its origin at the
        // eye.
        let emission = (place + distance * toward_lamp).extend(-1.0 - distance);
        let to_lamp = boost(-v);
        let at = (to_lamp * emission).truncate();
        let lamp_distance = (to_lamp * (emission - place.extend(-1.0))).truncate().length();
        let level = 1.0 / (4.0 * PI * lamp_distance * lamp_distance);
        let text = |color: &str| {
            let surface = square("s", place, toward_lamp, 1e-2, "white");
            format!(
                "c white 1; c_spd flat 1 1 1000000 1; l {level} {} {} {} 0 {color} {};\n{surface}",
                at.x,
                at.y,
                at.z,
                velocity(v).replace('>', " -at 0 0 0>")
            )
        };
        check(grey_light(&text("white"), place, by_law(Brightness::Bolometric)), energy, 1e-6);
        check(grey_light(&text("white"), place, by_law(Brightness::Photon)), energy / doppler, 1e-6);
        let light = seen_with(&text("flat"), place, by_spectra());
        check(linear_srgb_to_xyz(light.to_array())[1], energy * doppler, 1e-3);
    }
}
