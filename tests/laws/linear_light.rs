//! Laws that name a quantity (P12) hold in linear light: powers of D and cosines, through the pipe
//! and by rays. Sums over lamps are in `tests/src/worlds/light.rs`.

use glam::DVec3;
use ugphoton::{CameraOptions, PictureOptions};
use ugphysics::{
    Brightness, Hsv, Velocity, attenuation, doppler_at, hue_to_wavelength, rest_position,
    seen_position, srgb_decode, wavelength_to_hue,
};
use ugtests::pipe::{doppler, lorentz};
use ugtests::scenes;

/// The laws that name a quantity, with the powers of D.
const LAWS: [(Brightness, i32); 2] = [(Brightness::Photon, 3), (Brightness::Bolometric, 4)];

/// The ways to a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Engine {
    /// `uglorentz | ugdoppler | ugrainbow`: the renderer lights.
    Pipe,
    /// The same with `ugdoppler -li`.
    LitPipe,
    /// `uglorentz | ugrainbow -xc`
    Exact,
    /// `ugphoton`
    Rays,
}

pub const ENGINES: [Engine; 4] = [Engine::Pipe, Engine::LitPipe, Engine::Exact, Engine::Rays];

/// Renderers that draw with lamps in motion.
pub const WITH_MOVING_LAMPS: [Engine; 2] = [Engine::LitPipe, Engine::Rays];

/// Linear light seen in a direction from the origin, in a picture of one sample.
pub fn seen(engine: Engine, text: &str, toward: DVec3, law: Brightness, shifts: bool) -> DVec3 {
    let up = if toward.z.abs() < 0.9 * toward.length() { DVec3::Z } else { DVec3::X };
    let camera = CameraOptions {
        eye: Some(DVec3::ZERO),
        center: Some(toward),
        up: Some(up),
        view_angle: Some((1e-5, None)),
        ..CameraOptions::default()
    };
    let picture = PictureOptions { size: [1, 1], samples: 1, camera, ..PictureOptions::default() };
    let shift = uglight::ColorShift::hues(shifts, law);
    let frame = if engine == Engine::Rays {
        let config = ugphoton::Config { picture, shift, ..ugphoton::Config::default() };
        ugphoton::light(scenes::parse(text.as_bytes()), &config).unwrap()
    } else {
        let config = uglorentz::Config { eye: Some(DVec3::ZERO), ..uglorentz::Config::default() };
        let seen = lorentz(text.as_bytes(), &config);
        let exact = (engine == Engine::Exact).then_some(shift);
        let light = engine == Engine::LitPipe;
        let tolerance = 0.0;
        let config = ugdoppler::Config {
            shift,
            keep: true,
            light,
            tolerance,
            ..ugdoppler::Config::default()
        };
        let colored = if exact.is_some() { seen } else { doppler(&seen, &config) };
        let config = ugrainbow::Config { picture, exact, ..ugrainbow::Config::default() };
        ugrainbow::light(&scenes::parse(&colored), &config).unwrap()
    };
    let [red, green, blue, _] = frame.pixels()[0];
    DVec3::new(red.into(), green.into(), blue.into())
}

/// A small square that moves with `v` and is seen in the direction `toward`, at the distance 9 in
/// its own frame. `normal`: in its own frame, on the side of the eye. `rest`: what follows the
/// corners.
pub fn square(v: DVec3, toward: DVec3, normal: Option<DVec3>, rest: &str) -> String {
    let center = place(v, toward);
    let (e1, e2) = normal.unwrap_or(-center).normalize().any_orthonormal_pair();
    let corners = [e1 + e2, e2 - e1, -e1 - e2, e1 - e2].map(|corner| center + 1e-3 * corner);
    let vertex = |(at, p): (usize, &DVec3)| format!("v s{at} {:?} {:?} {:?};\n", p.x, p.y, p.z);
    let vertices: String = corners.iter().enumerate().map(vertex).collect();
    format!("{vertices}f (s0 s1 s2 s3) {rest} <{:?} {:?} {:?}>;\n", v.x, v.y, v.z)
}

/// The place of the square in its own frame.
pub fn place(v: DVec3, toward: DVec3) -> DVec3 {
    9.0 * rest_position(toward, Velocity::from_beta(v).unwrap()).normalize()
}

#[track_caller]
pub fn assert_light(found: DVec3, expected: DVec3, tolerance: f64, what: &str) {
    let size = expected.abs().max_element();
    assert!(
        (found - expected).abs().max_element() <= tolerance * size,
        "{what}: {found}, not {expected}"
    );
}

/// Approaching, receding, at right angles, and in between.
const MOTIONS: [(DVec3, DVec3); 5] = [
    (DVec3::new(-0.6, 0.0, 0.0), DVec3::X),
    (DVec3::new(0.6, 0.0, 0.0), DVec3::X),
    (DVec3::new(0.0, 0.6, 0.0), DVec3::X),
    (DVec3::new(-0.3, 0.5, 0.2), DVec3::new(0.8, -0.6, 0.0)),
    (DVec3::new(0.1, 0.9, -0.1), DVec3::new(0.1, -0.2, 0.7)),
];

const COLORS: [Hsv; 4] = [
    Hsv { hue: 0.0, saturation: 0.0, value: 0.3 },
    Hsv { hue: 130.0, saturation: 0.6, value: 0.5 },
    Hsv { hue: 95.0, saturation: 1.0, value: 1.0 },
    Hsv { hue: 200.0, saturation: 0.9, value: 0.08 },
];

#[test]
fn light_is_multiplied_by_a_power_of_d() {
    for (v, toward) in MOTIONS {
        let factor = doppler_at(toward, Velocity::from_beta(v).unwrap());
        for color in COLORS {
            let Hsv { hue, saturation, value } = color;
            let text =
                format!("c own {value} {hue} {saturation};\n{}", square(v, toward, None, "own 1"));
            for (law, power) in LAWS {
                for (engine, shifts) in
                    ENGINES.iter().flat_map(|&engine| [(engine, false), (engine, true)])
                {
                    let nm = hue_to_wavelength(hue) / if shifts { factor } else { 1.0 };
                    let shown =
                        Hsv { hue: wavelength_to_hue(nm), ..color }.attenuated(attenuation(nm));
                    let rest = DVec3::from_array(shown.to_rgb().map(srgb_decode));
                    let what = format!("{engine:?} {law:?} {color:?} at {v}, {shifts}");
                    let found = seen(engine, &text, toward, law, shifts);
                    // Near the ends of the visible range the pipe's attenuation is a table.
                    let expected = libm::pow(factor, f64::from(power)) * rest;
                    let off = (found - expected).abs().max_element();
                    assert!(
                        off < 1e-4 * expected.max_element() + 1e-6,
                        "{what}: {found}, not {expected}"
                    );
                }
            }
        }
    }
}

#[test]
fn light_falls_with_the_cosine() {
    let (v, toward) = MOTIONS[3];
    let normal = -place(v, toward).normalize();
    let aside = normal.any_orthonormal_vector();
    for (law, power) in LAWS {
        let factor = doppler_at(toward, Velocity::from_beta(v).unwrap());
        for engine in ENGINES {
            for degrees in [0.0_f64, 20.0, 45.0, 60.0, 85.0, 100.0] {
                let (sin, cos) = (libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians()));
                let to = cos * normal + sin * aside;
                let lamp = format!("l 0.6 {:?} {:?} {:?};", to.x, to.y, to.z);
                let text =
                    format!("c own 0.5;\n{}\n{lamp}", square(v, toward, Some(normal), "own"));
                let expected =
                    libm::pow(factor, f64::from(power)) * 0.6 * cos.max(0.0) * srgb_decode(0.5);
                let found = seen(engine, &text, toward, law, true);
                assert_light(
                    found,
                    DVec3::splat(expected),
                    1e-5,
                    &format!("{engine:?} {law:?} {degrees}"),
                );
            }
        }
    }
}

/// Without `-hd`, light that is too bright is clipped to the brightest of its hue and saturation.
#[test]
fn clipping_keeps_hue_and_saturation() {
    let (v, toward) = MOTIONS[0];
    let text = format!("c own 0.5 130 0.6;\n{}", square(v, toward, None, "own 1"));
    let seen_text = lorentz(text.as_bytes(), &uglorentz::Config::default());
    let shift = uglight::ColorShift::hues(false, Brightness::Photon);
    let config = ugdoppler::Config { shift, ..ugdoppler::Config::default() };
    let scene = scenes::parse(&doppler(&seen_text, &config));
    let color = &scene.colors[scene.vertices[0].color.unwrap().index()];
    let shown = DVec3::from_array(uglight::hsv(&scene, color).to_rgb().map(srgb_decode));
    let rest = Hsv { hue: 130.0, saturation: 0.6, value: 0.5 }.to_rgb().map(srgb_decode);
    assert_light(shown, DVec3::from_array(rest) / srgb_decode(0.5), 1e-12, "clipped");
}

/// The direction in which the square is seen is that of its middle.
#[test]
fn squares_are_where_they_are_seen() {
    for (v, toward) in MOTIONS {
        let seen = seen_position(place(v, toward), Velocity::from_beta(v).unwrap());
        assert!(seen.angle_between(toward) < 1e-12);
    }
}
