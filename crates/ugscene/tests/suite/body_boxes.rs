//! Boxes around bodies: what is in view, when, and in which direction.

use glam::DVec3;
use ugscene::{
    BodyBoxes, CameraOptions, MotionOptions, Note, PlacedBodies, RestPosition, Scene, TimesInView,
    View,
};
use ugtesting::Random;

use super::parse;

const SIZE: [u32; 2] = [400, 300];

/// A small triangle at a point, and the eye at the origin.
fn small(center: DVec3) -> Scene {
    let corner = |name: &str, way: DVec3| {
        let p = center + 1e-6 * way;
        format!("v {name} {} {} {};", p.x, p.y, p.z)
    };
    let corners = [corner("a", DVec3::X), corner("b", DVec3::Z), corner("c", -DVec3::X)].concat();
    parse(&format!("{corners} f (a b c); cam -ep 0 0 0 -vc 0 9 0 -va 20;"))
}

fn moving(beta: DVec3, time: f64) -> MotionOptions {
    MotionOptions { velocity: Some(beta), time, ..MotionOptions::default() }
}

/// A point that passes at the distance 9 with the speed β is seen at x at the time
/// x/β + √(81 + x²), and is in a view of 20°, not at its edge, for |x| < 9 tan 9.5°.
#[test]
fn times_in_view_are_those_of_a_point_that_passes() {
    let boxes = BodyBoxes::new(&small(9.0 * DVec3::Y));
    let camera = CameraOptions::default();
    let seen_at = |x: f64, beta: f64| x / beta + libm::hypot(9.0, x);
    let half = 10f64.to_radians();
    let end = 9.0 * libm::tan(half - libm::asin(0.05 * libm::sin(half)));
    for (beta, time) in
        [(0.5, 0.0), (0.9, -40.0), (0.99, 30.0), (0.9999, 9.0), (0.01, 2000.0), (-0.9, 5.0)]
    {
        let found =
            boxes.times_in_view(&moving(beta * DVec3::X, time), &camera, SIZE).unwrap().unwrap();
        let ends = [seen_at(-end, beta), seen_at(end, beta)];
        let TimesInView { first, last, best } = found;
        let tolerance = 1e-4 * (ends[1] - ends[0]).abs();
        let [first, last] = [first.unwrap(), last.unwrap()];
        assert!((first - ends[0].min(ends[1])).abs() < tolerance, "{beta}: {found:?} {ends:?}");
        assert!((last - ends[0].max(ends[1])).abs() < tolerance, "{beta}: {found:?} {ends:?}");
        assert!(
            first < best && best < last && (best - 9.0).abs() < 0.2 * (last - first),
            "{found:?}"
        );
    }
}

#[test]
fn what_is_behind_the_eye_or_at_rest_is_never_in_view() {
    let camera = CameraOptions { center: Some(-9.0 * DVec3::Y), ..CameraOptions::default() };
    let scene = small(9.0 * DVec3::Y);
    let boxes = BodyBoxes::new(&scene);
    for beta in [DVec3::ZERO, 0.9 * DVec3::X, 0.9 * DVec3::Z] {
        assert_eq!(boxes.times_in_view(&moving(beta, 0.0), &camera, SIZE).unwrap(), None);
    }
    // It leaves by the back of the eye, and stays in view.
    let found =
        boxes.times_in_view(&moving(DVec3::new(0.0, -0.5, 0.03), 0.0), &camera, SIZE).unwrap();
    let found = found.unwrap();
    assert!(found.first.is_none_or(|first| first > 0.0) && found.last.is_none(), "{found:?}");
    // A body at rest has no time at which it would be elsewhere.
    assert_eq!(boxes.note(&scene, &moving(DVec3::ZERO, 0.0), &camera, SIZE), None);
    let mut behind = scene.clone();
    behind.cameras[0].center = camera.center;
    let note = boxes.note(&behind, &moving(0.9 * DVec3::X, 3.0), &camera, SIZE);
    assert_eq!(note, Some(Note::OutOfView { time: 3.0, when: None }));
}

#[test]
fn times_are_rounded_inward() {
    let times = |first: Option<f64>, last: Option<f64>, best: f64| {
        TimesInView { first, last, best }.to_string()
    };
    assert_eq!(times(Some(1.2345), Some(9.8765), 5.554), "from 1.24 to 9.87, best at 5.55");
    assert_eq!(times(Some(-1234.5), Some(1234.5), 0.1), "from -1234 to 1234, best at 0");
    assert_eq!(times(Some(3.33333), None, 4.0), "from 3.34 on, best at 4");
    assert_eq!(times(None, Some(3.33333), 3.0), "until 3.33, best at 3");
    assert_eq!(times(None, None, 1.0), "best at 1");
}

/// Random tetrahedra, and a square without thickness.
fn random_scene(random: &mut Random) -> Scene {
    let mut text = String::from("v p -9 -9 -2; v q 9 -9 -2; v r 9 9 -2; v s -9 9 -2; f (p q r s);");
    for body in 0..20 {
        let center = 8.0 * vector(random);
        for corner in ["a", "b", "c", "d"] {
            let p = center + vector(random);
            text += &format!("v {corner}{body} {} {} {};", p.x, p.y, p.z);
        }
        let beta = 0.5 * vector(random);
        text += &format!("f (a{body} b{body} c{body}) <{} {} {}>;", beta.x, beta.y, beta.z);
        text += &format!("f (a{body} d{body} b{body}) <{} {} {}>;", beta.x, beta.y, beta.z);
    }
    parse(&text)
}

fn vector(random: &mut Random) -> DVec3 {
    random.in_cube(1.0)
}

/// An eye, and a camera there.
fn random_camera(random: &mut Random) -> (DVec3, CameraOptions) {
    let eye = 12.0 * vector(random);
    let (center, view_angle) =
        (Some(eye + vector(random)), Some((random.between(5.0, 60.0), None)));
    (eye, CameraOptions { eye: Some(eye), center, view_angle, ..CameraOptions::default() })
}

/// Where nothing is said to be in view, no point of any face is.
#[test]
fn nothing_is_seen_of_what_is_out_of_view() {
    let mut random = Random(7);
    let (mut n_out, mut n_points) = (0, 0);
    for _ in 0..120 {
        let scene = random_scene(&mut random);
        let velocity = (random.one_in(2)).then(|| 0.57 * vector(&mut random));
        let motion = MotionOptions {
            velocity,
            camera_velocity: Some(0.5 * vector(&mut random)),
            time: random.between(-30.0, 30.0),
            in_place: random.one_in(3),
            ..MotionOptions::default()
        };
        let (_, camera) = random_camera(&mut random);
        if !BodyBoxes::new(&scene).seen(&motion, &camera, SIZE).unwrap().are_out_of_view() {
            continue;
        }
        n_out += 1;
        let mut moved = scene.clone();
        let placed =
            PlacedBodies::move_to_camera_frame(&mut moved, &motion, &camera, SIZE).unwrap();
        let rest = placed.rest_positions(&moved);
        let view = View::new(&moved, &CameraOptions { eye: None, ..camera }, SIZE).unwrap();
        for face in &moved.faces {
            let motion = &placed.motions[face.body.index()];
            let corners = moved.contours.corners(face.contours.clone());
            for _ in 0..40 {
                let weights: Vec<f64> = corners.iter().map(|_| random.between(0.0, 1.0)).collect();
                let sum: f64 = weights.iter().sum();
                let parts = corners
                    .iter()
                    .zip(weights)
                    .map(|(corner, weight)| rest[corner.index()] * (weight / sum));
                let point = view.place(motion.seen(RestPosition(parts.sum())).0);
                let inside = point.z > 0.0
                    && (0.0..400.0).contains(&(point.x / point.z))
                    && (0.0..300.0).contains(&(point.y / point.z));
                assert!(!inside, "{point:?}");
                n_points += 1;
            }
        }
    }
    assert!(n_out > 10 && n_points > 10_000, "{n_out} {n_points}");
}

/// Where a part of a moving body is found in the picture, there is nothing to note.
#[test]
fn motion_in_view_is_not_noted() {
    let mut random = Random(8);
    let (mut n_in_view, mut n_notes) = (0, 0);
    for _ in 0..120 {
        let scene = random_scene(&mut random);
        let motion = MotionOptions {
            time: random.between(-30.0, 30.0),
            in_place: random.one_in(3),
            ..MotionOptions::default()
        };
        let (eye, camera) = random_camera(&mut random);
        let mut seen = scene.clone();
        let placed = PlacedBodies::move_to_camera_frame(&mut seen, &motion, &camera, SIZE).unwrap();
        let rest = placed.rest_positions(&seen).into_iter().zip(&placed.bodies);
        for (vertex, (rest, body)) in seen.vertices.iter_mut().zip(rest) {
            vertex.position = eye + placed.motions[body.index()].seen(RestPosition(rest)).0;
        }
        let note = BodyBoxes::new(&scene).note(&seen, &motion, &camera, SIZE);
        let may_miss_motion = ugscene::may_miss_motion(&seen, &camera, SIZE);
        assert!(may_miss_motion || note.is_none(), "{note:?}");
        n_in_view += usize::from(!may_miss_motion);
        n_notes += usize::from(note.is_some());
    }
    assert!(n_in_view > 10 && n_notes > 10, "{n_in_view} {n_notes}");
}

/// The middle of a small body is where it is seen, whatever else is at rest.
#[test]
fn the_middle_is_that_of_what_moves() {
    let scene = parse(
        "v a 5 9 0; v b 5.001 9 0; v c 5 9 .001; f (a b c) <.8 0 0>;
         v d -3 5 0; v e -3 6 0; v f -3 5 1; f (d e f); cam -ep 0 0 0 -vc 0 9 0;",
    );
    let boxes = BodyBoxes::new(&scene);
    for time in [-20.0, 0.0, 3.0, 50.0] {
        let motion = MotionOptions { time, ..MotionOptions::default() };
        let center =
            boxes.seen(&motion, &CameraOptions::default(), SIZE).unwrap().center().unwrap();
        // x − 5/γ = .8 (t − |p|), with the eye as the fixed point of the contraction.
        assert!((center.y - 9.0).abs() < 2e-3 && center.z.abs() < 2e-3, "{center}");
        // Rounded to a millionth of the distance; the triangle is a thousandth wide.
        assert!((center.x - 3.0 - 0.8 * (time - center.length())).abs() < 1e-2, "{time} {center}");
    }
    // Everything, if nothing moves.
    let still = moving(DVec3::ZERO, 0.0);
    let center = boxes.seen(&still, &CameraOptions::default(), SIZE).unwrap().center().unwrap();
    assert!(center.x > -3.0 && center.x < 5.0, "{center}");
}
