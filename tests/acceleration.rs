//! Films at growing speed: constant proper acceleration along a line.

use std::process::Command;

use glam::DVec3;
use uglight::{ScatteringTime, SurfaceElement};
use ugscene::{Anchor, CameraOptions, MotionOptions, PlacedBodies, RestFrames};
use ugtests::{programs, scenes};

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
/// frame of the scene, whoever looks. The sun rests at time 0; at −5 its rapidity is −asinh 1.5, and
/// D = γ(1 − β·n). So is the light on a body that accelerates itself.  Eq. (P14)
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
                let mut scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
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
