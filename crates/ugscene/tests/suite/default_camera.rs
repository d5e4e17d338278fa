//! The camera of a scene without one.

use glam::DVec3;
use ugpipe::Words;
use ugscene::{
    CameraOptions, CameraPoint, DefaultCamera, MotionOptions, PlacedBodies, RelativeMotion,
    RestPosition, Scene, ShownEffects, View,
};

use super::parse;

fn camera(text: &str, options: &CameraOptions, velocities: &[DVec3]) -> Option<DefaultCamera> {
    let scene = parse(text);
    let motion = |beta: &DVec3| {
        RelativeMotion::new(ugphysics::Velocity::from_beta(*beta).unwrap(), ShownEffects::default())
    };
    DefaultCamera::new(&scene, options, [4, 3], |_| velocities.iter().map(motion).collect())
        .unwrap()
}

fn square(center: DVec3, half: f64) -> String {
    let corner = |x: f64, y: f64| center + half * DVec3::new(x, y, 0.0);
    let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    let statements =
        corners.iter().enumerate().map(|(i, p)| format!("v v{i} {} {} {};", p.x, p.y, p.z));
    statements.collect::<String>() + "f (v0 v1 v2 v3);"
}

/// However large the coordinates are, the eye is not the view centre, and no distance
/// overflows.
#[test]
fn the_largest_scenes_have_a_camera() {
    let scene =
        "v a 0 -1.7e308 1.7e308; v b -1.7e308 1e308 0; v c 1.7e308 1.7e308 1.7e308; f (a b c);";
    for velocities in [&[][..], &[0.9 * DVec3::Y]] {
        let DefaultCamera { eye, center, .. } =
            camera(scene, &CameraOptions::default(), velocities).unwrap();
        assert!(ugscene::view_distance(eye, center).is_ok(), "{eye} {center}");
    }
}

/// The least and greatest place of what is seen in the picture, as parts of its width and height.
fn seen_parts(scene: &Scene, view: &View, seen: &[DVec3]) -> [[f64; 2]; 2] {
    assert_eq!(scene.vertices.len(), seen.len());
    let part = |p: &DVec3| {
        let CameraPoint { x, y, z } = view.place(*p);
        assert!(z > 0.0);
        [x / z / 400.0, y / z / 300.0]
    };
    let grow = |[low, high]: [f64; 2], x: f64| [low.min(x), high.max(x)];
    seen.iter().map(part).fold([[f64::INFINITY, f64::NEG_INFINITY]; 2], |[across, down], [x, y]| {
        [grow(across, x), grow(down, y)]
    })
}

/// Least and greatest place across and down.
const ENDS: [[f64; 2]; 2] = [[0.1, 0.9], [1.0 / 6.0, 5.0 / 6.0]];

/// Everything is within a tenth and nine tenths of the width, and in two thirds of the height.
fn is_within(parts: [[f64; 2]; 2], tolerance: f64) -> bool {
    let is_inside = |([low, high], end): ([f64; 2], [f64; 2])| {
        low > end[0] - tolerance && high < end[1] + tolerance
    };
    parts.into_iter().zip(ENDS).all(is_inside)
}

/// It reaches from one of these ends to the other in one direction.
fn fills(parts: [[f64; 2]; 2], tolerance: f64) -> bool {
    let reaches = |([low, high], end): ([f64; 2], [f64; 2])| {
        low < end[0] + tolerance && high > end[1] - tolerance
    };
    parts.into_iter().zip(ENDS).any(reaches)
}

/// The corners of a box and of its sides, so that motion bends its edges.
fn long_box(half: DVec3, center: DVec3) -> String {
    let mut text = String::new();
    for at in 0..27 {
        let p = center
            + half * DVec3::new(f64::from(at % 3), f64::from(at / 3 % 3), f64::from(at / 9))
            - half;
        text += &format!("v v{at} {:?} {:?} {:?};", p.x, p.y, p.z);
    }
    let names: Vec<String> = (0..27).map(|at| format!("v{at}")).collect();
    text + &format!("w ({});", names.join(" "))
}

const BOXES: [(DVec3, DVec3); 6] = [
    (DVec3::new(1.0, 1.0, 1.0), DVec3::ZERO),
    (DVec3::new(8.0, 1.0, 0.5), DVec3::new(7.0, -8.0, 9.0)),
    (DVec3::new(1e-3, 9e-3, 1e-3), DVec3::new(0.7, 0.0, 0.0)),
    (DVec3::new(1e6, 1e6, 1e7), DVec3::splat(3e7)),
    (DVec3::new(3e-200, 1e-200, 1e-200), DVec3::ZERO),
    (DVec3::new(1e290, 3e290, 1e290), DVec3::ZERO),
];

#[test]
fn what_is_seen_fills_the_picture() {
    let mut n_cases = 0;
    for (half, center) in BOXES {
        for angle in [20.0, 60.0, 110.0] {
            for up in [None, Some(DVec3::Y)] {
                let options = CameraOptions {
                    view_angle: Some((angle, None)),
                    up,
                    ..CameraOptions::default()
                };
                let scene = parse(&long_box(half, center));
                let view = View::new(&scene, &options, [400, 300]).unwrap();
                let seen: Vec<DVec3> =
                    scene.vertices.iter().map(|v| v.position - view.eye).collect();
                // The camera is rounded to a thousandth of the distance.
                let tolerance = 4e-3 / libm::tan(angle.to_radians() / 2.0);
                let parts = seen_parts(&scene, &view, &seen);
                assert!(is_within(parts, tolerance), "{half} {angle}: {parts:?}");
                // With a wide angle, what extends along the view is seen from the least distance.
                let is_long = half != DVec3::splat(half.x);
                assert!(
                    angle > 20.0 && is_long || fills(parts, tolerance),
                    "{half} {angle}: {parts:?}"
                );
                n_cases += 1;
            }
        }
    }
    assert_eq!(n_cases, 36);
}

#[test]
fn a_body_in_motion_is_fitted_as_it_is_seen() {
    let (mut n_filled, mut n_cases) = (0, 0);
    for (half, center) in &BOXES[..4] {
        for beta in [DVec3::X, DVec3::Y, -DVec3::Y, DVec3::Z, DVec3::new(-0.6, 0.0, 0.8)] {
            for speed in [0.3, 0.9, 0.999] {
                let mut scene = parse(&long_box(*half, *center));
                let options = MotionOptions {
                    velocity: Some(speed * beta),
                    in_place: true,
                    ..MotionOptions::default()
                };
                let camera = CameraOptions::default();
                let placed =
                    PlacedBodies::move_to_camera_frame(&mut scene, &options, &camera, [400, 300])
                        .unwrap();
                let view = View::new(&scene, &camera, [400, 300]).unwrap();
                let bodies = placed.bodies.iter().map(|body| &placed.motions[body.index()]);
                let rest = placed.rest_positions(&scene);
                let seen: Vec<DVec3> =
                    rest.into_iter().zip(bodies).map(|(p, m)| m.seen(RestPosition(p)).0).collect();
                let parts = seen_parts(&scene, &view, &seen);
                assert!(is_within(parts, 1e-2), "{half} {beta} {speed}: {parts:?}");
                (n_filled, n_cases) = (n_filled + usize::from(fills(parts, 1e-2)), n_cases + 1);
            }
        }
    }
    // What is seen nearly from its end is seen from the least distance.
    assert!(n_cases == 60 && n_filled * 10 > n_cases * 8, "{n_filled} of {n_cases}");
}

/// A needle that points at the eye is not seen from its tip.
#[test]
fn the_eye_keeps_its_distance() {
    let found = camera("v a 0 0 0; v b 3 -4 2; w (a b);", &CameraOptions::default(), &[]).unwrap();
    let (distance, length) = ((found.eye - found.center).length(), 29f64.sqrt());
    assert!((0.9..2.0).contains(&(distance / length)), "{found:?}");
}

#[test]
fn what_is_given_holds() {
    let options = CameraOptions::default;
    let text = square(DVec3::ZERO, 1.0);
    assert!(camera(&format!("{text} cam -va 40 40;"), &options(), &[]).is_none());
    assert!(camera(&text, &CameraOptions { eye: Some(DVec3::X), ..options() }, &[]).is_none());
    assert!(camera("c red 1 0;", &options(), &[]).is_none());
    let aside = CameraOptions { center: Some(DVec3::new(0.1, 2.0, 0.3)), ..options() };
    assert_eq!(camera(&text, &aside, &[]).unwrap().center, DVec3::new(0.1, 2.0, 0.3));
    // With y up, the front is +z, as in most mesh formats.
    let found = camera(&text, &CameraOptions { up: Some(DVec3::Y), ..options() }, &[]).unwrap();
    assert!(
        found.eye.z > found.eye.x && found.eye.x > found.eye.y && found.eye.y > 0.0,
        "{found:?}"
    );
    // A vertex that nothing uses is not part of the picture.
    assert_eq!(
        camera(&format!("{text} v far 1e9 0 0;"), &options(), &[]),
        camera(&text, &options(), &[])
    );
}

#[test]
fn nothing_moves_straight_at_the_eye() {
    let text = square(DVec3::ZERO, 1.0);
    let at_rest = camera(&text, &CameraOptions::default(), &[]).unwrap();
    for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
        for velocity in [0.9 * axis, -0.9 * axis] {
            let moving = camera(&text, &CameraOptions::default(), &[velocity]).unwrap();
            let [one, other] =
                [at_rest, moving].map(|found| (found.eye - found.center).normalize());
            assert!(one.dot(other) > 0.999_99, "{moving:?}");
        }
    }
    let toward = at_rest.eye.normalize();
    let other = camera(&text, &CameraOptions::default(), &[0.5 * toward]).unwrap();
    assert!(other.eye.dot(toward) < 0.0 && other.eye.z > 0.0, "{other:?}");
    let other =
        camera(&text, &CameraOptions::default(), &[0.5 * toward, 0.5 * other.eye.normalize()])
            .unwrap();
    assert!(other.eye.normalize().dot(toward).abs() < 0.766, "{other:?}");
}

#[test]
fn the_note_has_options() {
    let found =
        camera(&square(DVec3::new(1.0, 2.0, 3.0), 1.0), &CameraOptions::default(), &[]).unwrap();
    assert_eq!(
        ugscene::Note::DefaultCamera(found).words(),
        "no camera in the scene: seen as with -ep 3.688 -1.674 4.566 -vc 1.009 1.897 2.78 -va 40"
    );
}
