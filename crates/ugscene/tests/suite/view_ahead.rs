//! The view ahead of a moving camera.

use glam::DVec3;
use ugphysics::{Velocity, aberrate};
use ugscene::{CameraOptions, MotionOptions, PlacedBodies, Scene, View};

use super::parse;

const SIZE: [u32; 2] = [300, 200];

const HOUSE: &str = "v a 0 9 0; v b 1 9 0; v c 1 9 2; f (a b c);";

/// The view of a moving camera, whose options state the view at rest.
fn ahead(text: &str, options: &CameraOptions, beta: DVec3) -> (Scene, View) {
    let mut scene = parse(text);
    let camera = CameraOptions { is_ahead: true, ..options.clone() };
    let motion = MotionOptions { camera_velocity: Some(beta), ..MotionOptions::default() };
    PlacedBodies::move_to_camera_frame(&mut scene, &motion, &camera, SIZE).unwrap();
    let view = View::new(&scene, &camera, SIZE).unwrap();
    (scene, view)
}

/// The direction in the scene of what a camera sees at a point of its picture.
fn in_scene(view: &View, place: [f64; 2], beta: DVec3) -> DVec3 {
    aberrate(view.point(place, 1.0), -Velocity::from_beta(beta).unwrap())
}

fn options(center: DVec3, angle: f64) -> CameraOptions {
    CameraOptions {
        eye: Some(DVec3::ZERO),
        center: Some(center),
        view_angle: Some((angle, None)),
        ..CameraOptions::default()
    }
}

#[test]
fn at_rest_it_is_the_ordinary_view() {
    for text in [HOUSE.to_owned(), format!("cam -ep 1 2 3 -vc 4 5 6 -va 70; {HOUSE}")] {
        for options in [CameraOptions::default(), options(DVec3::new(1.0, 2.0, 0.5), 50.0)] {
            let ordinary = View::new(&parse(&text), &options, SIZE).unwrap();
            let (_, view) = ahead(&text, &options, DVec3::ZERO);
            assert_eq!((view.eye, view.rays()), (ordinary.eye, ordinary.rays()));
        }
    }
}

/// Along the motion tan(A'/4) = tan(A/4) √((1−β)/(1+β)), and the sides of the picture show what
/// they show at rest; in other directions the middle does, and one of two sides, beyond which
/// nothing else is lost.
#[test]
fn the_picture_shows_at_every_speed_what_it_shows_at_rest() {
    let (mut n_along, mut n_aslant) = (0, 0);
    for speed in [0.01, 0.5, 0.9, 0.99, 0.999_999] {
        for aside in [DVec3::ZERO, DVec3::new(0.0, 0.0, 0.3), DVec3::new(0.8, 0.0, -0.4)] {
            for angle in [5.0, 75.0, 150.0] {
                let (beta, options) = (speed * DVec3::Y, options(DVec3::Y + aside, angle));
                let at_rest = View::new(&parse(HOUSE), &options, SIZE).unwrap();
                let (scene, view) = ahead(HOUSE, &options, beta);
                let apart = |x: f64| {
                    let place = [x, 100.0];
                    in_scene(&view, place, beta).distance(in_scene(&at_rest, place, DVec3::ZERO))
                };
                assert!(apart(150.0) < 1e-8, "{speed} {aside} {angle}: {}", apart(150.0));
                if aside == DVec3::ZERO {
                    assert!(apart(0.0).max(apart(300.0)) < 1e-8);
                    let [seen, _] = scene.camera().unwrap().view_angle.unwrap();
                    let slow = ((1.0 - speed) / (1.0 + speed)).sqrt();
                    let expected = 4.0 * libm::atan(slow * libm::tan(angle.to_radians() / 4.0));
                    assert!((seen.to_radians() / expected - 1.0).abs() < 1e-9, "{seen} {expected}");
                    n_along += 1;
                } else {
                    // Where the sides at rest are seen in motion.
                    let seen = [0.0, 300.0].map(|x| {
                        let side = in_scene(&at_rest, [x, 100.0], DVec3::ZERO);
                        let seen = view.place(aberrate(side, Velocity::from_beta(beta).unwrap()));
                        assert!(seen.z > 0.0);
                        seen.x / seen.z
                    });
                    assert!(seen[0] > -1e-6 && seen[1] < 300.0 + 1e-6, "{seen:?}");
                    // A straight row at rest is seen bent.
                    assert!(seen[0] < 3.0 || seen[1] > 297.0, "{seen:?}");
                    n_aslant += 1;
                }
            }
        }
    }
    assert_eq!((n_along, n_aslant), (15, 30));
}

/// With two view angles pixels keep their shape.
#[test]
fn two_view_angles_shrink_alike() {
    let both = CameraOptions { view_angle: Some((75.0, Some(30.0))), ..options(DVec3::Y, 75.0) };
    let shape = |beta: DVec3| {
        let [_, across, down] = ahead(HOUSE, &both, beta).1.rays();
        across.length() / down.length()
    };
    let at_rest = shape(DVec3::ZERO);
    assert!((at_rest - 1.0).abs() > 0.1 && (shape(0.9 * DVec3::Y) / at_rest - 1.0).abs() < 1e-12);
}

#[test]
fn a_camera_turns_to_its_motion_unless_it_looks_there() {
    for (center, expected) in
        [(DVec3::X, DVec3::Y), (-DVec3::Y, DVec3::Y), (DVec3::new(1.0, 1.0, 0.0), DVec3::ZERO)]
    {
        let (_, view) = ahead(HOUSE, &options(center, 40.0), 0.5 * DVec3::Y);
        let seen = aberrate(center, Velocity::from_beta(0.5 * DVec3::Y).unwrap());
        let expected = if expected == DVec3::ZERO { seen } else { expected };
        assert!(view.forward.distance(expected) < 1e-12, "{center}: {}", view.forward);
    }
}

/// Without a camera everything is in the picture, as it is from the same place at rest.
#[test]
fn a_scene_without_a_camera_fills_the_view() {
    for beta in [0.5 * DVec3::Y, 0.99 * DVec3::NEG_X, DVec3::new(0.3, 0.5, 0.6)] {
        let (scene, view) = ahead(HOUSE, &CameraOptions::default(), beta);
        let velocity = Velocity::from_beta(beta).unwrap();
        let places: Vec<[f64; 2]> = (parse(HOUSE).vertices.iter())
            .map(|vertex| {
                let place = view.place(aberrate(vertex.position - view.eye, velocity));
                assert!(place.z > 0.0, "{beta}");
                [place.x / place.z, place.y / place.z]
            })
            .collect();
        let extent = |axis: usize| {
            let all = || places.iter().map(|place| place[axis]);
            [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)]
        };
        let ([left, right], [top, bottom]) = (extent(0), extent(1));
        assert!(left > 0.0 && right < 300.0 && top > 0.0 && bottom < 200.0, "{beta}: {places:?}");
        assert!(
            right - left > 100.0 || bottom - top > 90.0,
            "{beta}: {places:?} {:?}",
            scene.camera()
        );
    }
}
