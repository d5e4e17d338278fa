//! Films at growing speed: constant proper acceleration along a line.

use std::process::Command;

use glam::DVec3;
use uglight::{ColorShift, ScatteringTime, SurfaceElement};
use ugscene::{Anchor, CameraOptions, ColorValue, MotionOptions, PlacedBodies, RestFrames};
use ugtests::{pipe, programs, scenes};

/// Velocities of 1 g, 9.80665 m/s², in light years and Julian years.
const PER_YEAR: f64 = 9.806_65 * 31_557_600.0 / 299_792_458.0;

/// The velocities along y of the frames of a film, as its commands say.
fn velocities(n_frames: u32, last: f64) -> Vec<f64> {
    let program = programs::folder().join("ugfilm");
    let moving = format!("0 0 0 .. 0 {last} 0");
    let output = Command::new(program)
        .args(["-warp", "-frames", &n_frames.to_string(), "-cv", &moving])
        .args(["-fo", "f_%d.png", "--print", "stars.csv"])
        .current_dir(scenes::root().join("scenes"))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let commands = String::from_utf8(output.stdout).unwrap();
    let velocity = |command: &str| -> f64 {
        let (_, rest) = command.split_once(" -cv 0 ").unwrap();
        rest.split(' ').next().unwrap().parse().unwrap()
    };
    commands.lines().map(velocity).collect()
}

/// Velocity, distance and time of a traveller at 1 g after whole years of proper time, published
/// for relativistic rockets: v = tanh aτ, t = sinh(aτ)/a, x = (cosh(aτ) − 1)/a.
#[test]
fn equal_steps_are_constant_proper_acceleration() {
    const N: usize = 2001;
    let found = velocities(N as u32, 0.968_317_848_7);
    assert_eq!(found.len(), N);
    let step = 2.0 / (N - 1) as f64;
    let (mut time, mut distance) = (0.0, 0.0);
    for (idx, ends) in found.windows(2).enumerate() {
        // dt = γ dτ and dx = γβ dτ.
        let gamma = |beta: f64| 1.0 / (1.0 - beta * beta).sqrt();
        let [from, to] = [ends[0], ends[1]];
        time += 0.5 * step * (gamma(from) + gamma(to));
        distance += 0.5 * step * (from * gamma(from) + to * gamma(to));
        let year = (idx + 1) as f64 * step;
        let expected = libm::tanh(PER_YEAR * year);
        assert!((to - expected).abs() < 1e-8, "{year}: {to}, not {expected}");
        let published = match idx + 1 {
            1000 => [0.774_827_262_6, 1.187_312_402, 0.563_642_465_1],
            2000 => [0.968_317_848_7, 3.756_289_45, 2.910_475_472],
            _ => continue,
        };
        for (found, expected) in [to, time, distance].into_iter().zip(published) {
            assert!((found - expected).abs() < 1e-5, "{year}: {found}, not {expected}");
        }
    }
}

/// A sun and a sky on a motion light an event as their body moves at the time of the event in the
/// frame of the scene, whoever looks. The sun rests at time 0; at −5 its rapidity is −asinh 1.5,
/// and D = γ(1 − β·n). So is the light on a body that accelerates itself.  Eq. (P14)
#[test]
fn a_sun_on_a_motion_shines_by_the_clock_of_the_scene() {
    let toward = DVec3::new(0.6, -1.0, 0.0).normalize();
    let of_sun = |doppler: f64| (-toward.y / doppler, doppler);
    for (time, expected) in [
        (0.0, of_sun(1.0)),
        (-5.0, of_sun(3.25_f64.sqrt() + 1.5 * toward.x)),
        (5.0, of_sun(3.25_f64.sqrt() - 1.5 * toward.x)),
    ] {
        let mut skies = Vec::new();
        for distance in [5.0, 10.0, 20.0, 40.0] {
            for camera in [DVec3::ZERO, DVec3::new(0.0, 0.6, 0.0), DVec3::new(-0.3, 0.5, 0.7)] {
                let text = format!(
                    "motion m -acc .3 0 0 -4 4; motion still -acc 0 0 .1 100 101; v a -2 0 -2; v b 2 0 -2;
                     v c 2 0 2; v d -2 0 2; f (a b c d); f (a b c d) <still>; l sun 1 .6 -1 0 <m>; l 1 <m>;
                     cam -ep 0 -{distance} 0 -vc 0 0 0 -va 10;"
                );
                let source = ugparse::Source::new("sun.ug", text);
                let mut scene =
                    ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
                // The camera sees the event at the origin: it has moved on by then.
                let v = ugphysics::Velocity::from_beta(camera).unwrap();
                let gamma = v.gamma();
                let late = time + distance;
                let eye = DVec3::new(0.0, -distance, 0.0) - camera * late;
                scene.cameras[0].eye = Some(eye);
                let options = MotionOptions {
                    camera_velocity: Some(camera),
                    anchor: Some(Anchor::Origin),
                    time: late / gamma,
                    ..MotionOptions::default()
                };
                let placed = PlacedBodies::move_to_camera_frame(
                    &mut scene,
                    &options,
                    &CameraOptions::default(),
                    [64, 64],
                )
                .unwrap();
                let frames = RestFrames::new(&scene);
                let lamps = uglight::Lamps::new(&scene, placed.eye, false);
                for face in &scene.faces {
                    let body = face.body;
                    let (point, time) = match frames.world_line(body) {
                        Some(_) => (-placed.eye, ScatteringTime::Own(time)),
                        // In the rest frame, relative to the event of the eye.
                        None => (DVec3::new(0.0, distance, 0.0), ScatteringTime::Delay(0.0)),
                    };
                    let element = SurfaceElement { point, time, normal: DVec3::NEG_Y, body };
                    let light = element.irradiances(&lamps, &frames);
                    let sun = light.iter().find(|light| light.lamp == 0).unwrap();
                    let off = [sun.level - expected.0, sun.doppler - expected.1];
                    let frame = frames.world_line(body).is_some();
                    assert!(
                        off.iter().all(|off| off.abs() < 1e-9),
                        "{time:?} {distance} {camera} {frame}: {sun:?}"
                    );
                    let sky: f64 = light
                        .iter()
                        .filter(|light| light.lamp == 1)
                        .map(|light| light.level * light.doppler)
                        .sum();
                    skies.push(sky);
                }
            }
        }
        // The sky is integrated to 3·10⁻³.
        assert!(skies.iter().all(|sky| (sky - skies[0]).abs() < 3e-3), "{skies:?}");
    }
}

/// From about 18 years on, β of a camera at 1 g rounds to 1. A body at rest at the angle θ from the
/// motion is seen at tan ½θ' = e^{−η} tan ½θ, with D = e^η cos² ½θ + e^{−η} sin² ½θ. A black body
/// of 5800 K/D has the chromaticity of one of 5800 K.
#[test]
fn a_flight_of_many_years_shows_aberration_and_doppler() {
    const DEG: f64 = std::f64::consts::PI / 180.0;
    for years in [10.0, 19.0, 28.0, 48.0] {
        let eta = PER_YEAR * years;
        let shrink = libm::exp(-eta);
        let ahead = (libm::cosh(eta) - 1.0) / PER_YEAR;
        // θ' of the corners, and of the point where D = 1.
        for middle in [20.0 * DEG, 90.0 * DEG, 2.0 * shrink.sqrt()] {
            let seen = [0.8, 1.0, 1.2].map(|part| part * middle);
            // ½(π − θ), and the places of the corners behind the start.
            let half = seen.map(|angle| libm::atan(shrink / libm::tan(0.5 * angle)));
            let (sin, cos) = libm::sincos(half[1]);
            let doppler = libm::exp(eta) * sin * sin + shrink * cos * cos;
            let behind = 100.0 * ahead;
            let across = half.map(|half| (behind + ahead) * libm::tan(2.0 * half));
            let corner = |row: usize| format!("v p{row} {:e} {:e} 0", across[row], -behind);
            let text = format!(
                "motion ship -acc 0 {PER_YEAR} 0; c_bb star {}; {}; {}; {};
                 v up {:e} {:e} {:e}; f (p0 p1 p2 up) star;
                 l 1; cam -ep 0 0 0 -vc 0 1 0 -va {} <ship>;",
                5800.0 / doppler,
                corner(0),
                corner(1),
                corner(2),
                across[1],
                -behind,
                0.3 * across[1],
                (2.8 * middle / DEG).min(150.0),
            );
            let config = uglorentz::Config {
                time: years,
                pieces: uglorentz::Pieces::PerEdge(1),
                ..Default::default()
            };
            let lorentz = pipe::lorentz(text.as_bytes(), &config);
            let scene = scenes::parse(&lorentz);
            assert_eq!(ugparse::write(&scene), lorentz, "the text reads back to itself");
            for (row, angle) in seen.into_iter().enumerate() {
                let place = scene.vertices[row].position;
                let found = libm::atan2(place.x, place.y);
                assert!((found / angle - 1.0).abs() < 1e-9, "{years}: {found}, not {angle}");
            }
            // The ring of D = 1 is 4·10⁻¹¹ wide after 48 years.
            if (doppler - 1.0).abs() > 0.5 || years > 30.0 {
                continue;
            }
            let shifted =
                ugdoppler::Config { shift: ColorShift::SPECTRA, keep: true, ..Default::default() };
            let colored = scenes::parse(&pipe::doppler(&lorentz, &shifted));
            let xyz = |color: ugscene::ColorId| match colored.colors[color.index()].value {
                ColorValue::Xyz(xyz) => DVec3::from_array(xyz),
                other => panic!("{other:?}"),
            };
            let light = xyz(colored.vertices[1].color.unwrap());
            // CIE 1931, of 5800 K.
            let chromaticity = light / light.element_sum();
            assert!(
                (chromaticity - DVec3::new(0.3260, 0.3354, 0.3386)).length() < 1e-3,
                "{years}: {chromaticity}"
            );
        }
    }
}

/// The cockpit of such a flight is events near one that is γ² times as far away in the scene: it is
/// drawn while that is precise, and refused from then on.
#[test]
fn a_cockpit_is_seen_at_rest_or_refused() {
    let cockpit =
        "motion ship -acc 0 1 0; v a -.5 1 -.5; v b .5 1 -.5; v c 0 1 .5; f (a b c) <ship>;
                   cam -ep 0 0 0 -vc 0 1 0 <ship>;";
    let mut last = Vec::new();
    for years in [0.0, 5.0, 10.0, 12.0, 13.0, 14.0, 16.0, 19.0] {
        let mut scene = scenes::parse(cockpit.as_bytes());
        let config = uglorentz::Config {
            time: years,
            pieces: uglorentz::Pieces::PerEdge(1),
            ..Default::default()
        };
        match uglorentz::apply(std::mem::take(&mut scene), &config) {
            Ok((scene, _)) => {
                last.push(scene.vertices.iter().map(|v| v.position).collect::<Vec<_>>())
            }
            Err(error) => {
                assert!(
                    years > 12.0 && error.to_string().contains("rounding moves it"),
                    "{years}: {error}"
                );
                continue;
            }
        }
        let [_, first, .., now] = &last[..] else { continue };
        for (a, b) in first.iter().zip(now) {
            assert!(a.distance(*b) < 1e-3, "{years}: {a} {b}");
        }
    }
    assert!((4..7).contains(&last.len()));
}
