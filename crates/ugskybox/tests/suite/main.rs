//! Skies: aberration, the light of stars and of lamps that stand for a sky, and lists of stars.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

mod lists;

use core::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use glam::{DQuat, DVec3};
use uglight::{ColorShift, HueShift};
use ugphysics::{Brightness, Velocity, luminance, srgb_decode};
use ugsky::{Basis, Extent, Panorama, SkyColors, Star, StarLight, StarOptions, Texels};
use ugskybox::{BuiltIn, Opened, SkyAround, SkyLamps, sky_colors};

fn near(what: &str, got: f64, want: f64, tolerance: f64) {
    assert!((got - want).abs() <= tolerance * want.abs().max(1e-3), "{what}: {got}, not {want}");
}

fn velocity(x: f64, y: f64, z: f64) -> Velocity {
    Velocity::from_beta(DVec3::new(x, y, z)).unwrap()
}

/// A sky of one light, given by direction.
fn panorama(light: impl Fn(DVec3) -> f32) -> Opened {
    const SIZE: [u32; 2] = [256, 128];
    let texel = |idx: u32| {
        let [column, row] = [idx % SIZE[0], idx / SIZE[0]].map(|at| f64::from(at) + 0.5);
        let (x, y) = libm::sincos(2.0 * PI * column / f64::from(SIZE[0]) - PI);
        let (sin, cos) = libm::sincos(FRAC_PI_2 - PI * row / f64::from(SIZE[1]));
        let light = light(DVec3::new(cos * x, cos * y, sin));
        [light, light, light, 1.0]
    };
    let texels = Texels::Light((0..SIZE[0] * SIZE[1]).map(texel).collect());
    Opened {
        panorama: Some(Panorama::new(SIZE, texels, Extent::FULL).unwrap()),
        ..Opened::default()
    }
}

fn around(opened: Opened, turn: DQuat, v: Velocity, colors: SkyColors) -> SkyAround {
    SkyAround::new(Arc::new(opened), turn, v, colors, true).unwrap()
}

fn hues(doppler: bool, law: Brightness) -> SkyColors {
    sky_colors(ColorShift::Hues(HueShift { doppler, law }), Basis::Mixture)
}

fn directions() -> impl Iterator<Item = DVec3> {
    (0..60).map(|step| {
        let z = 1.0 - (f64::from(step) + 0.5) / 30.0;
        let (sin, cos) = libm::sincos(2.4 * f64::from(step));
        DVec3::new((1.0 - z * z).sqrt() * sin, (1.0 - z * z).sqrt() * cos, z)
    })
}

/// Aberration: cos θ = (cos θ' + β)/(1 + β cos θ'), θ' being the angle to the motion at which a
/// direction is at rest with the sky. The light of each place is that at rest if only directions
/// change. A turned sky is seen turned.
#[test]
fn directions_are_aberrated() {
    let wave = |d: DVec3| 0.5 + 0.3 * libm::sin(2.0 * d.x + d.y - 1.5 * d.z);
    for (beta, turn) in [(0.0, 0.0), (0.6, 0.0), (0.9, 1.1), (0.6, -2.0)] {
        let turn = DQuat::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), turn);
        let sky = panorama(|d| wave(d) as f32);
        let unchanged = hues(false, Brightness::None);
        let sky = around(sky, turn, velocity(0.0, beta, 0.0), unchanged);
        for seen in directions() {
            // Back to the sky: the same with −β.
            let cos = (seen.y - beta) / (1.0 - beta * seen.y);
            let across = DVec3::new(seen.x, 0.0, seen.z).normalize_or_zero();
            let rest = cos * DVec3::Y + (1.0 - cos * cos).max(0.0).sqrt() * across;
            let [red, _, _, covered] = sky.rays().light(seen, 1e-3, 1.0);
            near("light", f64::from(red), wave(turn.inverse() * rest), 6e-3);
            near("covered", covered.into(), 1.0, 1e-6);
        }
    }
}

/// The value of a grey sky is multiplied by the power of D of the brightness law, D = 1/(γ (1 −
/// β cos θ)), also where a mirror has changed the frequency of the ray before.
#[test]
fn brightness_follows_the_doppler_factor() {
    let v = velocity(0.0, 0.6, 0.0);
    for (law, power) in [(Brightness::Photon, 3.0), (Brightness::Bolometric, 4.0)] {
        let sky = around(panorama(|_| 0.2), DQuat::IDENTITY, v, hues(true, law));
        for seen in directions() {
            for frequency in [1.0, 0.5, 2.0] {
                let doppler = 1.0 / (v.gamma() * (1.0 - 0.6 * seen.y)) / frequency;
                let [red, ..] = sky.rays().light(seen, 1e-3, frequency);
                near("light", red.into(), 0.2 * libm::pow(doppler, power), 2e-3);
            }
        }
    }
    // The law of 1988 multiplies encoded values by D.
    let sky = around(panorama(|_| 0.2), DQuat::IDENTITY, v, hues(true, Brightness::Report));
    let [red, ..] = sky.rays().light(DVec3::NEG_Y, 1e-3, 1.0);
    let expected = srgb_decode(0.5 * ugphysics::srgb_encode(0.2));
    near("law of 1988", red.into(), expected, 5e-3);
}

/// The light of a star, added up over all directions that see it, is its irradiance, at rest and in
/// motion, wherever it is and whatever the width of its disc.
#[test]
fn a_star_keeps_its_irradiance() {
    let colors = hues(true, Brightness::Photon);
    for (beta, kelvin, width) in [(0.0, 5800.0, 1.7), (0.6, 4000.0, 1.7), (0.6, 9000.0, 4.0)] {
        let star = Star { direction: DVec3::new(0.6, 0.0, 0.8), magnitude: -3.0, kelvin };
        let options = StarOptions { width, ..StarOptions::default() };
        let v = velocity(0.0, 0.0, beta);
        let opened = Opened { stars: vec![star], ..Opened::default() };
        let sky = around(opened, DQuat::IDENTITY, v, colors).with_stars(options);
        // Where it is seen, and its Doppler factor there.
        let cos = (0.8 + beta) / (1.0 + beta * 0.8);
        let seen = DVec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
        let doppler = 1.0 / (v.gamma() * (1.0 - beta * cos));
        let pixel = 2e-3;
        let (one, other) =
            (seen.any_orthonormal_vector(), seen.cross(seen.any_orthonormal_vector()));
        let step = 0.4 * pixel * width / 1.7;
        let mut sum = 0.0;
        let mut rays = sky.rays();
        for idx in 0..61 * 61 {
            let [across, down] = [idx % 61 - 30, idx / 61 - 30].map(|at| f64::from(at) * step);
            let toward = (seen + across * one + down * other).normalize();
            let [red, green, blue, _] = rays.light(toward, pixel, 1.0).map(f64::from);
            sum += luminance([red, green, blue]) * step * step;
        }
        let table = StarLight::new(&[star], colors.parts(), 2.0);
        let irradiance = luminance(table.irradiance(&star, doppler));
        near("irradiance", sum, options.scale() * irradiance, 2e-2);
        let behind = rays.light(-seen, pixel, 1.0);
        assert_eq!(behind[..3], [0.0; 3]);
    }
}

/// Lamps that stand for a sky: a white surface that faces a uniform one gets its radiance times π,
/// normalised to a white surface of level 1; each set alone is as bright as the whole.
#[test]
fn lamps_of_a_sky_have_its_irradiance() {
    let normals = [DVec3::X, DVec3::Z, DVec3::new(-0.6, 0.0, 0.8)];
    let expected = |what: &str, light: &dyn Fn(DVec3) -> f64, normal: DVec3, got: f64| {
        // ∫ L max(0, n·l) dω/π
        let n = 20_000;
        let part = |step: i32| {
            let z = 1.0 - (f64::from(step) + 0.5) * 2.0 / f64::from(n);
            let (sin, cos) = libm::sincos(2.399_963 * f64::from(step));
            let d = DVec3::new((1.0 - z * z).sqrt() * sin, (1.0 - z * z).sqrt() * cos, z);
            light(d) * normal.dot(d).max(0.0) * 4.0 / f64::from(n)
        };
        near(what, got, (0..n).map(part).sum(), 0.06);
    };
    type Light = fn(DVec3) -> f64;
    let skies: [(&str, Light); 2] =
        [("uniform", |_| 0.5), ("one side", |d| if d.x > 0.3 { 1.0 } else { 0.1 })];
    for (what, light) in skies {
        let opened = panorama(|d| light(d) as f32);
        let turn = DQuat::from_rotation_z(FRAC_PI_2);
        let lamps = SkyLamps::new(&opened, turn, [4, 512]).unwrap();
        assert!(lamps.stars.is_empty());
        for normal in normals {
            let level = |set: usize| -> f64 {
                let points = &lamps.points[lamps.set(set)];
                points.iter().map(|lamp| lamp.linear[0] * normal.dot(lamp.toward).max(0.0)).sum()
            };
            let mean = (0..4).map(level).sum::<f64>() / 4.0;
            expected(what, &|d| light(turn.inverse() * d), normal, mean);
        }
    }
    // A black sky lights nothing.
    assert!(SkyLamps::new(&panorama(|_| 0.0), DQuat::IDENTITY, [1, 64]).is_none());
}

#[test]
fn skies_without_a_file_have_their_names_and_light() {
    for sky in BuiltIn::ALL {
        assert_eq!(BuiltIn::from_name(sky.name()), Some(sky));
    }
    assert_eq!(BuiltIn::from_name("night"), None);
    // White is the light of a white level surface: sun and sky together have level 1.
    for sky in [BuiltIn::Day, BuiltIn::Dusk] {
        let lamps = SkyLamps::new(&sky.open(), DQuat::IDENTITY, [1, 1024]).unwrap();
        let all = lamps.stars.iter().chain(&lamps.points);
        let level: f64 = all.map(|lamp| luminance(lamp.linear) * lamp.toward.z.max(0.0)).sum();
        near(sky.name(), level, 1.0, 0.1);
    }
    // Those of the Bright Star Catalogue that an eye sees: unit vectors, from Sirius on.
    let stars = BuiltIn::Stars.open().stars;
    assert!(stars.len() > 4000, "{}", stars.len());
    assert!(stars.iter().all(|star| (star.direction.length() - 1.0).abs() < 1e-9));
    let brightest = stars.iter().min_by(|a, b| a.magnitude.total_cmp(&b.magnitude)).unwrap();
    assert!((brightest.magnitude + 1.46).abs() < 0.05, "{brightest:?}");
    // Right ascension 101.29 degrees, declination −16.72.
    assert!((libm::asin(brightest.direction.z).to_degrees() + 16.72).abs() < 0.05);
}
