//! What is the same in every frame: T36 of the conformance suite, by rendered rays.

use glam::{DMat3, DQuat, DVec3};
use ugphoton::{Config, MotionOptions, RayOptions};
use ugphysics::Brightness;
use ugtesting::Random;

use crate::laws::drawing::{
    Chart, HEAD, boost, by_law, config, distance, drawn, factors, polygon, square, surroundings, value,
    velocity,
};

/// Where the camera looks.
const AHEAD: DVec3 = DVec3::new(0.3, 0.9, -0.2);

/// A body of a scene: the corners of its faces in its rest frame, and its velocity.
#[derive(Clone, Debug)]
struct Body {
    faces: Vec<(Vec<DVec3>, &'static str)>,
    velocity: DVec3,
}

impl Body {
    /// Quadrilaterals of random shape and place, some of them mirrors and glass.
    fn random(random: &mut Random, greatest_speed: f64) -> Self {
        let surfaces = ["red", "grey", "white mirror", "white glass", "pane"];
        let faces = (0..5).map(|at| {
            let center = 4.0 * AHEAD + random.in_cube(3.0);
            let axes = DMat3::from_quat(DQuat::from_rotation_arc(DVec3::Z, random.direction()));
            let (a, b) = (random.between(0.5, 2.0), random.between(0.5, 2.0));
            let corners = [(-a, -b), (a, -b), (a, b), (-a, b)];
            let corners = corners.map(|(x, y)| center + x * axes.x_axis + y * axes.y_axis);
            (corners.to_vec(), surfaces[at])
        });
        Self { faces: faces.collect(), velocity: random.in_ball(greatest_speed) }
    }

    fn text(&self, name: usize) -> String {
        let faces = self.faces.iter().enumerate().map(|(at, (corners, surface))| {
            polygon(&format!("b{name}f{at}v"), corners, &format!("{surface} {}", velocity(self.velocity)))
        });
        faces.collect()
    }

    /// The body with its rest frame turned, and another velocity.
    fn turned(&self, turn: DMat3, velocity: DVec3) -> Self {
        self.moved(|place| turn * place, velocity)
    }

    fn moved(&self, place: impl Fn(DVec3) -> DVec3, velocity: DVec3) -> Self {
        let moved = |(corners, surface): &(Vec<DVec3>, &'static str)| {
            (corners.iter().map(|corner| place(*corner)).collect(), *surface)
        };
        Self { faces: self.faces.iter().map(moved).collect(), velocity }
    }
}

/// Colours and surfaces. The light rests in the frame of what it lights.
const COLORS: &str = "c red 0.8 20 0.7; c grey 0.5; c white 1; c pane 0.7 200 0.4 0.5; \
                      surf mirror 0.1 0.9 0; surf glass 0.1 0.1 0.8 1.3; l 0.8;\n";

fn bodies(random: &mut Random, greatest_speed: f64) -> Vec<Body> {
    (0..4).map(|_| Body::random(random, greatest_speed)).collect()
}

fn picture(bodies: &[Body], base: Config) -> Vec<[f32; 4]> {
    picture_with("", bodies, base)
}

fn picture_with(others: &str, bodies: &[Body], base: Config) -> Vec<[f32; 4]> {
    let text: String = bodies.iter().enumerate().map(|(at, body)| body.text(at)).collect();
    drawn(&format!("{COLORS}{others}{text}"), &base).pixels().to_vec()
}

/// Both pictures show the same, apart from rounding. A sample within rounding of an edge is rare.
#[track_caller]
fn assert_same(a: &[[f32; 4]], b: &[[f32; 4]], tolerance: f32) {
    let lit = a.iter().filter(|pixel| pixel[0] > 0.0).count();
    assert!(lit > a.len() / 10, "{lit}");
    let differs = |(a, b): &(&[f32; 4], &[f32; 4])| {
        (0..3).any(|channel| (a[channel] - b[channel]).abs() > tolerance * a[channel].abs().max(0.1))
    };
    let n_different = a.iter().zip(b).filter(differs).count();
    assert!(n_different <= a.len() / 2000, "{n_different} of {}", a.len());
}

fn view(rays: RayOptions) -> Config {
    Config { rays, ..config([60, 50], AHEAD, 90.0) }
}

#[test]
fn slow_motion_changes_nothing() {
    let mut random = Random(1);
    let bodies = bodies(&mut random, 0.0);
    let at_rest = picture(&bodies, view(RayOptions::default()));
    for speed in [1e-12, 1e-9] {
        let moving: Vec<Body> =
            bodies.iter().map(|body| Body { velocity: speed * random.direction(), ..body.clone() }).collect();
        assert_same(&at_rest, &picture(&moving, view(RayOptions::default())), 1e-4);
    }
}

/// All bodies and the camera in another frame. The product of boosts is a boost and a rotation, by
/// which the rest frames of bodies and the camera are turned.
#[test]
fn a_common_boost_in_any_direction_changes_nothing() {
    for seed in 0..4 {
        let mut random = Random(30 + seed);
        let bodies = bodies(&mut random, 0.7);
        let camera = random.in_ball(0.6);
        let own = view(RayOptions::default());
        let motion = |camera| MotionOptions { camera_velocity: Some(camera), ..MotionOptions::default() };
        let before = picture(&bodies, Config { motion: motion(camera), ..own.clone() });
        let common = 0.7 * random.direction();
        let moved = |v: DVec3| factors(boost(common) * boost(v));
        let boosted: Vec<Body> = bodies
            .iter()
            .map(|body| {
                let (velocity, turn) = moved(body.velocity);
                body.turned(turn, velocity)
            })
            .collect();
        let (camera, turn) = moved(camera);
        let mut turned = Config { motion: motion(camera), ..own };
        let axes = &mut turned.picture.camera;
        (axes.center, axes.up) = (axes.center.map(|at| turn * at), axes.up.map(|up| turn * up));
        assert_same(&before, &picture(&boosted, turned), 1e-4);
    }
}

#[test]
fn rotated_scenes_look_alike() {
    for seed in 0..4 {
        let mut random = Random(40 + seed);
        let bodies = bodies(&mut random, 0.95);
        let own = view(RayOptions::default());
        let before = picture(&bodies, own.clone());
        let turn = DMat3::from_quat(DQuat::from_axis_angle(random.direction(), random.between(0.5, 3.0)));
        let turned: Vec<Body> = bodies.iter().map(|body| body.turned(turn, turn * body.velocity)).collect();
        let mut config = own;
        let axes = &mut config.picture.camera;
        (axes.center, axes.up) = (axes.center.map(|at| turn * at), axes.up.map(|up| turn * up));
        assert_same(&before, &picture(&turned, config), 1e-4);
    }
}

/// A picture at another time is that of bodies which have moved on: by γ v t in their own frames,
/// as lengths along v contract. So has a lamp.
#[test]
fn later_pictures_show_bodies_that_moved_on() {
    for (seed, time) in [(50, 1.5), (51, -2.0), (52, 0.7)] {
        let mut random = Random(seed);
        let bodies = bodies(&mut random, 0.9);
        let (lamp, of_lamp) = (random.in_cube(3.0), random.in_ball(0.6));
        let step = |v: DVec3| v * (time / (1.0 - v.length_squared()).sqrt());
        let of_lamp_text = velocity(of_lamp).replace('>', " -at 0 0 0>");
        let text = |at: DVec3| format!("l 0.9 {} {} {} 0 {of_lamp_text};\n", at.x, at.y, at.z);
        let motion = MotionOptions { time, ..MotionOptions::default() };
        let own = view(RayOptions::default());
        let later = picture_with(&text(lamp), &bodies, Config { motion, ..own.clone() });
        let moved: Vec<Body> = bodies
            .iter()
            .map(|body| body.moved(|place| place + step(body.velocity), body.velocity))
            .collect();
        assert_same(&later, &picture_with(&text(lamp + step(of_lamp)), &moved, own), 1e-4);
    }
}

/// The light left a body at an event on the past light cone of the eye, in all frames: the place in
/// the rest frame that is seen, by its colour, is that of the event in the direction of the pixel
/// at the distance of channel `distance`. There the distance is r' = r/D, with D from the
/// brightness (T26).
#[test]
fn emission_events_are_on_the_light_cone() {
    let mut n_seen = 0;
    for seed in 0..40 {
        let mut random = Random(100 + seed);
        let center = random.between(1.0, 6.0) * random.direction();
        let normal = (random.direction() - 1.5 * center.normalize()).normalize();
        let (u, v) = normal.any_orthonormal_pair();
        let chart = Chart { center, axes: [2.0 * u, 2.0 * v], velocity: random.in_ball(0.99) };
        // A direction in which it is seen: that of a point of it, by the boost of its event.
        let inside = center + random.between(-1.0, 1.0) * u + random.between(-1.0, 1.0) * v;
        let toward = (boost(chart.velocity) * inside.extend(-inside.length())).truncate();
        let Some(place) = chart.place("", toward) else { panic!("{seed}: nothing is seen") };
        let plain = format!(
            "{HEAD}{}",
            square("s", center, normal, 50.0, &format!("white 1 {}", velocity(chart.velocity)))
        );
        let r = distance(&plain, toward);
        let event = boost(-chart.velocity) * (r * toward.normalize()).extend(-r);
        let tolerance = 1e-5 * (1.0 + place.length());
        assert!((event.truncate() - place).length() < tolerance, "{seed}: {event} {place}");
        assert!((event.w + place.length()).abs() < tolerance, "{seed}: {event} {place}");
        let doppler = value(&plain, toward, by_law(Brightness::Report));
        assert!((place.length() * doppler / r - 1.0).abs() < 1e-5, "{seed}: {doppler}");
        n_seen += 1;
    }
    assert_eq!(n_seen, 40);
}

/// In front is what emitted its light last in the frame of the eye, whatever the distances in the
/// frames of the bodies (P22): a receding body from 24 is seen at 8, an approaching one from 5 at
/// 15.
#[test]
fn what_emitted_last_is_in_front() {
    let wall = |name: &str, rest: f64, level: f64, beta: f64| {
        square(name, rest * DVec3::NEG_Z, DVec3::Z, 100.0, &format!("white {level} <0 0 {beta}>"))
    };
    let (still, receding) = (wall("s", 10.0, 0.3, 0.0), wall("r", 24.0, 0.6, -0.8));
    let approaching = wall("a", 5.0, 0.9, 0.8);
    let mirror = square("m", DVec3::Z, DVec3::NEG_Z, 100.0, "white mirror");
    for (walls, expected) in [
        (format!("{still}{receding}"), 0.6),
        (format!("{receding}{still}"), 0.6),
        (format!("{still}{approaching}"), 0.3),
        (format!("{approaching}{still}"), 0.3),
        (format!("{approaching}{receding}"), 0.6),
    ] {
        for (others, toward) in [("", DVec3::NEG_Z), (mirror.as_str(), DVec3::Z)] {
            let found = value(&format!("{HEAD}{others}{walls}"), toward, by_law(Brightness::None));
            assert!((found - expected).abs() < 1e-6, "{found} {expected}");
        }
    }
}

/// A sphere of any size, speed and direction has a circular outline (Penrose 1959): the image of
/// its outline at rest by the Möbius map of directions.
#[test]
fn spheres_have_circular_outlines() {
    /// Faces from pole to pole and half around it.
    const N: usize = 90;
    for seed in 0..6 {
        let mut random = Random(200 + seed);
        let (radius, velocity_of) = (random.between(0.5, 2.0), random.in_ball(0.97));
        let center = radius * random.between(1.5, 5.0) * random.direction();
        let point = |row: usize, column: usize| {
            let (sin, cos) = libm::sincos(std::f64::consts::PI * row as f64 / N as f64);
            let (s, c) = libm::sincos(std::f64::consts::PI * column as f64 / N as f64);
            center + radius * DVec3::new(sin * c, sin * s, cos)
        };
        let mut text = String::from(HEAD);
        for (row, column) in (0..N).flat_map(|row| (0..2 * N).map(move |column| (row, column))) {
            let mut corners = vec![
                point(row, column),
                point(row + 1, column),
                point(row + 1, column + 1),
                point(row, column + 1),
            ];
            if row == 0 {
                corners.pop();
            } else if row == N - 1 {
                corners.remove(2);
            }
            text += &polygon(
                &format!("r{row}c{column}v"),
                &corners,
                &format!("white 1 {}", velocity(velocity_of)),
            );
        }
        // At rest a circle around the direction of the centre.
        let at_rest = libm::asin(radius / center.length());
        let (e1, e2) = center.normalize().any_orthonormal_pair();
        let outline: Vec<DVec3> = (0..3)
            .map(|at| {
                let (s, c) = libm::sincos(std::f64::consts::TAU * f64::from(at) / 3.0);
                let d = center.normalize() + libm::tan(at_rest) * (c * e1 + s * e2);
                (boost(velocity_of) * d.extend(-d.length())).truncate().normalize()
            })
            .collect();
        let axis = (outline[1] - outline[0]).cross(outline[2] - outline[0]).normalize();
        let axis = if axis.dot(outline[0]) < 0.0 { -axis } else { axis };
        let angle = libm::acos(axis.dot(outline[0]));
        assert!(angle < 1.2, "{seed}: {angle}");
        let n = 200;
        let width = 1.2 * libm::tan(angle);
        let config = config([n, n], axis, 2.0 * libm::atan(width).to_degrees());
        let up = config.picture.camera.up.unwrap();
        let right = axis.cross(up).normalize();
        let down = axis.cross(right);
        let frame = drawn(&text, &config);
        let mut n_wrong = 0;
        for (at, pixel) in frame.pixels().iter().enumerate() {
            let place = |at: usize| width * ((at as f64 + 0.5) / (0.5 * f64::from(n)) - 1.0);
            let (x, y) = (place(at % n as usize), place(at / n as usize));
            let from_axis = libm::atan(libm::hypot(x, y));
            // The polyhedron is inside the sphere, by 1 − cos(1°) of its radius, which is seen
            // larger or smaller by D.
            let is_near_outline = (from_axis - angle).abs() < 2e-3 * angle;
            let direction = axis + x * right + y * down;
            let is_inside = direction.normalize().dot(axis) > libm::cos(angle);
            n_wrong += usize::from(!is_near_outline && (pixel[0] > 0.0) != is_inside);
        }
        assert_eq!(n_wrong, 0, "{seed}");
    }
}

/// A periscope, two parallel mirrors, leaves direction and frequency of light as they are: D of the
/// way into its frame and D of the way out of it cancel.
#[test]
fn doppler_factors_in_and_out_cancel() {
    for seed in 0..12 {
        let mut random = Random(300 + seed);
        let (toward, motion) = (random.direction(), random.in_ball(0.95));
        // The way of the ray in the frame of the periscope.
        let first = (boost(-motion) * toward.extend(-1.0)).truncate().normalize();
        let aside = (first.any_orthonormal_vector() + 0.7 * random.direction()).normalize();
        let normal = (aside - first).normalize();
        let mirror = |name: &str, place: DVec3, normal: DVec3| {
            square(name, place, normal, 0.5, &format!("white mirror {}", velocity(motion)))
        };
        let [near, far] =
            [mirror("near", 4.0 * first, normal), mirror("far", 4.0 * (first + aside), -normal)];
        let sky = surroundings("s", 1e4, "white 1");
        let found = value(&format!("{HEAD}{near}{far}{sky}"), toward, by_law(Brightness::Report));
        assert!((found - 1.0).abs() < 1e-5, "{seed}: {found}");
        let turned = value(&format!("{HEAD}{near}{sky}"), toward, by_law(Brightness::Report));
        assert!((turned - 1.0).abs() > 1e-3 || motion.length() < 0.1, "{seed}: {turned}");
    }
}
