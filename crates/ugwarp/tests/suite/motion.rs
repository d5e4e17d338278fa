//! Skies seen from cameras on world lines, against formulas of their velocity and axes.

use core::f64::consts::{FRAC_PI_2, TAU};

use glam::{DQuat, DVec3};
use ugimage::Samples;
use ugphysics::Velocity;
use ugscene::Scene;
use ugwarp::{CameraOptions, Channel, Config, PictureOptions, Star, light};

fn scene(text: &str) -> Scene {
    let source = ugparse::Source::new("camera.ug", text);
    ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene
}

/// Stars in all directions.
fn stars() -> Vec<Star> {
    let star = |idx: u32| {
        let z = 1.0 - (2.0 * f64::from(idx) + 1.0) / 600.0;
        let (sin, cos) = libm::sincos(2.399_963 * f64::from(idx));
        let level = (1.0 - z * z).sqrt();
        let direction = DVec3::new(level * cos, level * sin, z);
        Star { direction, magnitude: f64::from(idx % 5), kelvin: 3000.0 + 20.0 * f64::from(idx) }
    };
    (0..600).map(star).collect()
}

fn reals(samples: &Samples) -> &[f32] {
    let Samples::Float(reals) = samples else { panic!("no real numbers") };
    reals
}

fn config(camera: CameraOptions) -> Config {
    let channels = vec![Channel::Doppler, Channel::Direction];
    let picture = PictureOptions {
        size: [80, 60],
        samples: 1,
        camera,
        channels,
        ..PictureOptions::default()
    };
    Config { picture, ..Config::default() }
}

/// The picture of the scene's camera at `time` is that of a camera with constant velocity `beta`,
/// which looks along `forward`.
#[track_caller]
fn check(text: &str, time: f64, beta: DVec3, [forward, up]: [DVec3; 2]) {
    let sky = stars();
    let config = Config { time, ..config(CameraOptions::default()) };
    let carried = config.with_camera_of(&scene(text)).unwrap();
    let found = (carried.velocity.beta() - beta).length();
    assert!(found < 1e-12, "{text} at {time}: {:?}, not {beta}", carried.velocity.beta());
    let camera = CameraOptions {
        center: Some(forward),
        up: Some(up),
        view_angle: Some((80.0, None)),
        ..CameraOptions::default()
    };
    let inertial = Config { velocity: Velocity::from_beta(beta).unwrap(), ..self::config(camera) };
    let [seen, expected] =
        [&carried, &inertial].map(|config| light(sky.as_slice(), config).unwrap());
    let most = expected.pixels().iter().fold(0.0, |most: f32, pixel| most.max(pixel[1]));
    assert!(most > 0.0);
    for (seen, expected) in seen.pixels().iter().zip(expected.pixels()) {
        for channel in 0..3 {
            assert!((seen[channel] - expected[channel]).abs() < 1e-5 * most, "{text} at {time}");
        }
    }
    // The Doppler factor, and the direction in the sky.
    assert_eq!(expected.planes().len(), 4);
    for (seen, expected) in seen.planes().iter().zip(expected.planes()) {
        for (seen, expected) in reals(&seen.samples).iter().zip(reals(&expected.samples)) {
            let most = 1e-5 * expected.abs().max(1.0);
            assert!((seen - expected).abs() <= most, "{text} at {time}: {seen}, not {expected}");
        }
    }
}

const AHEAD: [DVec3; 2] = [DVec3::Y, DVec3::Z];

/// Constant proper acceleration a has the rapidity aτ.
#[test]
fn accelerated_cameras_have_their_rapidity() {
    for (time, a) in [(0.0, 0.3), (2.0, 0.2), (5.0, 0.3), (-4.0, 0.3)] {
        let text = format!("motion ship -acc 0 {a} 0 -9 9; cam -ep 0 0 0 -vc 0 1 0 -va 80 <ship>;");
        check(&text, time, DVec3::Y * libm::tanh(a * time), AHEAD);
    }
    // Of docs: after own time 2 with 0.2, and 10 with 0.2 that has ended.
    let text = "motion ship -acc 0 .2 0 0 10; cam -ep 0 0 0 -vc 0 1 0 -va 80 <ship>;";
    check(text, 2.0, DVec3::Y * 0.379_948_962_255_225, AHEAD);
    check(text, 10.0, DVec3::Y * 0.964_027_580_075_817, AHEAD);
    check(text, 40.0, DVec3::Y * 0.964_027_580_075_817, AHEAD);
}

/// A star straight ahead of a camera with acceleration a is seen with D = exp(aτ), one behind with
/// exp(−aτ).
#[test]
fn stars_are_shifted_by_the_exponential_of_own_time() {
    for (center, exponent) in [("0 1 0", 1.0), ("0 -1 0", -1.0)] {
        let text = format!("motion ship -acc 0 .4 0; cam -ep 0 0 0 -vc {center} -va .01 <ship>;");
        for time in [0.5, 2.0, 5.0] {
            let config = Config { time, ..config(CameraOptions::default()) };
            let frame =
                light(stars().as_slice(), &config.with_camera_of(&scene(&text)).unwrap()).unwrap();
            let found = f64::from(reals(&frame.planes()[0].samples)[30 * 80 + 40]);
            let expected = libm::exp(exponent * 0.4 * time);
            assert!((found / expected - 1.0).abs() < 1e-4, "{found}, not {expected}");
        }
    }
}

/// A camera on a circle: its velocity is along the tangent, and its axes, carried without turning,
/// turn by −γ(γ − 1)ω for each unit of own time against those of a single boost (Thomas 1926).
#[test]
fn cameras_on_circles_turn_by_thomas() {
    for (radius, omega) in [(3.0, 0.3_f64), (2.0, 0.4), (1.0, 0.2)] {
        let beta: f64 = radius * omega;
        let gamma = 1.0 / ((1.0 - beta) * (1.0 + beta)).sqrt();
        let text = format!(
            "motion carousel -at {radius} 0 0 -orbit 0 0 0 0 0 1 {omega};
             cam -ep {radius} 0 0 -vc {radius} 1 0 -va 80 <carousel>;"
        );
        for time in [0.0, 1.0, 4.0, TAU / omega / gamma, -7.0] {
            let (sin, cos) = libm::sincos(omega * gamma * time);
            let turn = DQuat::from_axis_angle(DVec3::Z, -gamma * (gamma - 1.0) * omega * time);
            check(&text, time, beta * DVec3::new(-sin, cos, 0.0), [turn * DVec3::Y, DVec3::Z]);
        }
    }
}

/// A camera beside the axle of a turntable moves with it and turns with it. Its axes are those of
/// the turntable, boosted.
#[test]
fn cameras_on_turntables_turn() {
    // Its own time is that of the axle.
    let text = "motion table -spin 0 0 .5; cam -ep 0 0 0 -vc 1 0 0 -va 80 <table>;";
    check(text, 2.0, DVec3::ZERO, [DVec3::new(libm::cos(1.0), libm::sin(1.0), 0.0), DVec3::Z]);
    // Tipped over: up turns, too.
    let text = "motion table -spin 0 .5 0; cam -ep 0 0 0 -vc 0 1 0 -va 80 <table>;";
    check(text, 1.0, DVec3::ZERO, [DVec3::Y, DVec3::new(libm::sin(0.5), 0.0, libm::cos(0.5))]);
}

/// Options go before the camera of the scene, and are in its axes.
#[test]
fn options_override_the_camera() {
    let text = "motion table -spin 0 0 .5; cam -ep 0 0 0 -vc 1 0 0 -va 80 <table>;";
    let options = CameraOptions {
        center: Some(DVec3::Y),
        view_angle: Some((50.0, None)),
        ..Default::default()
    };
    let time = FRAC_PI_2 / 0.5;
    let carried = Config { time, ..config(options) }.with_camera_of(&scene(text)).unwrap();
    let forward = CameraOptions {
        center: Some(-DVec3::X),
        view_angle: Some((50.0, None)),
        ..Default::default()
    };
    let sky = stars();
    let [seen, expected] =
        [&carried, &config(forward)].map(|config| light(sky.as_slice(), config).unwrap());
    let most = expected.pixels().iter().fold(0.0, |most: f32, pixel| most.max(pixel[1]));
    for (seen, expected) in seen.pixels().iter().zip(expected.pixels()) {
        assert!((seen[1] - expected[1]).abs() < 1e-5 * most);
    }
    // Without a motion the camera has its velocity.
    let text = "cam -ep 0 0 0 -vc 0 1 0 -va 80 <.3 .4 0>;";
    check(text, 7.0, DVec3::new(0.3, 0.4, 0.0), AHEAD);
    let message = config(CameraOptions::default())
        .with_camera_of(&scene("v a 0 0 0;"))
        .unwrap_err()
        .to_string();
    assert_eq!(message, "the scene has no camera");
}
