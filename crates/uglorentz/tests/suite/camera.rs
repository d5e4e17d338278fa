//! A camera that moves in the scene (`-cv`): laws of (P5), (P7), (P25) and (P26), through text.

use std::fmt::Write;

use glam::DVec3;
use uglorentz::{Anchor, Config, Pieces};
use ugphysics::{Velocity, compose, doppler_at, rest_position, wigner_rotation};
use ugpipe::Words;
use ugscene::{LightKind, LightMotion, RestFrames, Scene, ShownEffects, rest_positions};
use ugtesting::Random;

use crate::common::{find, parse, place, seen};

/// Bodies of one triangle each.
struct Fleet {
    bodies: Vec<Body>,
    camera: DVec3,
    eye: DVec3,
}

struct Body {
    beta: DVec3,
    corners: [DVec3; 3],
}

impl Fleet {
    /// The first body rests in the scene, the second moves with the camera.
    fn new(random: &mut Random, n_bodies: usize, speed: f64) -> Fleet {
        let camera = random.direction() * speed;
        let eye = random.in_ball(20.0);
        let mut beta = |idx: usize| match idx {
            0 => DVec3::ZERO,
            1 => camera,
            _ => random.direction() * speed * random.unit(),
        };
        let betas: Vec<DVec3> = (0..n_bodies).map(&mut beta).collect();
        let bodies =
            betas.into_iter().map(|beta| Body { beta, corners: [(); 3].map(|()| random.in_ball(10.0)) });
        Fleet { bodies: bodies.collect(), camera, eye }
    }

    fn text(&self) -> String {
        let mut text = String::new();
        for (idx, Body { beta, corners }) in self.bodies.iter().enumerate() {
            for (corner, p) in corners.iter().enumerate() {
                writeln!(text, "v b{idx}:{corner} {:?} {:?} {:?};", p.x, p.y, p.z).unwrap();
            }
            let velocity = if *beta == DVec3::ZERO {
                String::new()
            } else {
                format!(" <{:?} {:?} {:?}>", beta.x, beta.y, beta.z)
            };
            writeln!(text, "f (b{idx}:0 b{idx}:1 b{idx}:2){velocity};").unwrap();
        }
        text
    }

    fn config(&self) -> Config {
        Config {
            camera_velocity: Some(self.camera),
            eye: Some(self.eye),
            pieces: Pieces::PerEdge(1),
            ..Config::default()
        }
    }
}

fn velocity(beta: DVec3) -> Velocity {
    Velocity::from_beta(beta).unwrap()
}

/// The boost of an event, written out: coordinates in the frame that moves with `beta`.
fn boosted(t: f64, x: DVec3, beta: DVec3) -> (f64, DVec3) {
    let speed = beta.length();
    if speed == 0.0 {
        return (t, x);
    }
    let gamma = 1.0 / (1.0 - speed * speed).sqrt();
    let axis = beta / speed;
    let along = x.dot(axis);
    (gamma * (t - speed * along), x + axis * (gamma * (along - speed * t) - along))
}

/// Where a point is seen by the camera, the slow way, all in the frame of the scene. At time 0
/// there the point is at `now`, contracted; it is followed back until its light just reaches the
/// camera, at the event of which the camera's own clock shows `time`; and the event found is
/// boosted to the camera.
fn slowly_seen(now: DVec3, beta: DVec3, camera: DVec3, time: f64) -> DVec3 {
    let gamma = 1.0 / (1.0 - camera.length_squared()).sqrt();
    let (t_camera, x_camera) = (gamma * time, camera * gamma * time);
    let at = |t: f64| now + beta * t - x_camera;
    let (mut early, mut late) = (t_camera - 1e6, t_camera);
    for _ in 0..200 {
        let t = (early + late) / 2.0;
        *(if at(t).length() < t_camera - t { &mut early } else { &mut late }) = t;
    }
    boosted(early - t_camera, at(early), camera).1
}

/// What contraction by `beta` about `anchor` leaves of a place.
fn contracted_about(anchor: DVec3, p: DVec3, beta: DVec3) -> DVec3 {
    let Some(axis) = beta.try_normalize() else { return p };
    let shrink = (1.0 - beta.length_squared()).sqrt() - 1.0;
    p + axis * (shrink * (p - anchor).dot(axis))
}

#[test]
fn light_seen_by_the_camera_left_the_world_lines_in_the_scene() {
    let mut random = Random(71);
    for speed in [1e-6, 0.1, 0.5, 0.9, 0.97] {
        for (time, anchor) in [
            (0.0, None),
            (0.0, Some(Anchor::Origin)),
            (-3.0, Some(Anchor::Eye)),
            (2.5, Some(Anchor::Center)),
            (7.0, Some(Anchor::Point(DVec3::new(3.0, -2.0, 1.0)))),
        ] {
            let fleet = Fleet::new(&mut random, 6, speed);
            let scene = seen(&fleet.text(), &Config { time, anchor, ..fleet.config() });
            for (idx, Body { beta, corners }) in fleet.bodies.iter().enumerate() {
                let low = corners.iter().copied().reduce(DVec3::min).unwrap();
                let high = corners.iter().copied().reduce(DVec3::max).unwrap();
                let fixed = match anchor {
                    Some(Anchor::Eye) => fleet.eye,
                    // The reference point of faces with a velocity.
                    None | Some(Anchor::Origin) => DVec3::ZERO,
                    Some(Anchor::Center) => (low + high) / 2.0,
                    Some(Anchor::Point(point)) => point,
                };
                for (corner, &p) in corners.iter().enumerate() {
                    let now = contracted_about(fixed, p, *beta) - fleet.eye;
                    let expected = slowly_seen(now, *beta, fleet.camera, time) + fleet.eye;
                    let found = place(&scene, find(&scene, &format!("b{idx}:{corner}")));
                    let off = (found - expected).length();
                    // Bisection on times up to 10⁶ leaves 10⁻¹⁰, the boost magnifies it by γ² of up
                    // to 17.
                    assert!(
                        off < 1e-8 * (1.0 + expected.length()),
                        "{speed} {time} {anchor:?} {idx}: {off:e}"
                    );
                }
            }
        }
    }
}

#[test]
fn rest_positions_come_back_in_the_axes_of_the_scene() {
    let mut random = Random(73);
    for speed in [0.0, 1e-9, 0.1, 0.6, 0.9, 0.99, 0.999] {
        for (contraction, flight_time) in [(true, true), (true, false), (false, true)] {
            let fleet = Fleet::new(&mut random, 12, speed);
            let geometry = ShownEffects { contraction, flight_time };
            let anchor = Some(Anchor::Eye);
            let scene = seen(&fleet.text(), &Config { geometry, anchor, ..fleet.config() });
            let frames = RestFrames::new(&scene);
            let rest = rest_positions(&scene, fleet.eye, &frames);
            for (idx, body) in fleet.bodies.iter().enumerate() {
                for (corner, &p) in body.corners.iter().enumerate() {
                    let row = find(&scene, &format!("b{idx}:{corner}"));
                    let (found, p) = (rest[row.index()], p - fleet.eye);
                    // Seen places are written to the last digit relative to the origin, not the
                    // eye; undoing the boost magnifies that by up to 2γ.
                    let gamma = frames.velocity(scene.faces[idx].body).gamma();
                    let tolerance = 1e-12 * p.length() + 1e-15 * gamma * place(&scene, row).length();
                    assert!((found - p).length() <= tolerance, "{speed} {idx}: {found} {p}");
                }
            }
        }
    }
}

#[test]
fn a_moving_camera_is_a_scene_that_moves_the_other_way() {
    let mut random = Random(74);
    let fleet = Fleet::new(&mut random, 1, 0.0);
    for speed in [1e-9, 0.5, 0.9, 0.999_999] {
        for (time, in_place) in [(0.0, false), (-4.0, false), (0.0, true)] {
            let beta = random.direction() * speed;
            let config = Config { eye: Some(fleet.eye), time, in_place, smooth: true, ..Config::default() };
            let camera = seen(&fleet.text(), &Config { camera_velocity: Some(-beta), ..config.clone() });
            let mut scene = seen(&fleet.text(), &Config { velocity: Some(beta), ..config });
            assert_eq!(ugscene::camera_velocity(&camera), velocity(-beta));
            scene.stage = camera.stage;
            assert_eq!(ugparse::write(&camera), ugparse::write(&scene));
        }
    }
}

/// The same bodies and camera, described in another frame: rest axes and the camera's own are
/// turned by Wigner rotations, what is seen is the same.
#[test]
fn a_common_boost_of_scene_and_camera_changes_nothing() {
    let mut random = Random(75);
    for (speed, extra) in [(0.5, 0.1), (0.9, 0.5), (0.9, 0.9), (0.99, 0.6)] {
        let here = Fleet::new(&mut random, 8, speed);
        let here = Fleet { eye: DVec3::ZERO, ..here };
        let boost = velocity(random.direction() * extra);
        let there = Fleet {
            camera: compose(velocity(here.camera), boost).beta(),
            eye: DVec3::ZERO,
            bodies: Vec::from_iter(here.bodies.iter().map(|body| {
                let turn = wigner_rotation(velocity(body.beta), boost);
                Body {
                    beta: compose(velocity(body.beta), boost).beta(),
                    corners: body.corners.map(|p| turn * p),
                }
            })),
        };
        let turn = wigner_rotation(velocity(here.camera), boost);
        let (one, other) = (seen(&here.text(), &here.config()), seen(&there.text(), &there.config()));
        let betas = |scene: &Scene| -> Vec<Velocity> {
            scene.faces.iter().map(|face| scene.bodies.stated_velocity(face.body).unwrap()).collect()
        };
        for (idx, (v, w)) in betas(&one).into_iter().zip(betas(&other)).enumerate() {
            // Velocities in text are right to γ²·10⁻¹⁶, and there are four roundings of them.
            let gamma = v.gamma().max(boost.gamma()) * velocity(here.camera).gamma();
            let tolerance = 1e-14 * gamma * gamma;
            assert!((turn * v.proper() - w.proper()).length() <= tolerance * v.gamma());
            for corner in 0..3 {
                let at = |scene: &Scene| place(scene, find(scene, &format!("b{idx}:{corner}")));
                let (p, q) = (at(&one), at(&other));
                assert!((turn * p - q).length() <= tolerance * p.length(), "{speed} {extra} {idx}");
                assert!(
                    (doppler_at(p, v) / doppler_at(q, w) - 1.0).abs() <= tolerance,
                    "{speed} {extra} {idx}"
                );
            }
        }
    }
}

/// T31 and T32: what crosses the way of the camera is seen with its axes turned.
#[test]
fn crossing_bodies_are_turned_by_the_wigner_rotation() {
    for (speed, degrees) in [(0.5, 8.213210702), (0.6, 12.68038349), (0.8, 28.07248694), (0.9, 42.89619887)] {
        let text = format!("v a 3 0 0; v b 0 4 0; v c 0 0 5; f (a b c) <0 {speed} 0>;");
        let scene = seen(&text, &Config { camera_velocity: Some(DVec3::X * speed), ..Config::default() });
        let beta = scene.bodies.stated_velocity(scene.faces[0].body).unwrap().beta();
        let gamma = 1.0 / (1.0 - speed * speed).sqrt();
        // (P15): along the camera's way the body falls back, across it moves on slower by γ.
        assert!((beta - DVec3::new(-speed, speed / gamma, 0.0)).length() < 1e-15, "{beta}");
        for (name, axis) in [("a", DVec3::X), ("b", DVec3::Y)] {
            let turned = rest_position(place(&scene, find(&scene, name)), velocity(beta));
            let angle = libm::atan2(turned.cross(axis).length(), turned.dot(axis)).to_degrees();
            assert!((angle - degrees).abs() < 5e-9, "{speed}: {angle}");
        }
        let along = rest_position(place(&scene, find(&scene, "c")), velocity(beta));
        assert!((along - DVec3::Z * 5.0).length() < 1e-13);
    }
}

#[test]
fn bodies_in_place_are_seen_where_the_scene_has_them() {
    let mut random = Random(76);
    let fleet = Fleet::new(&mut random, 6, 0.95);
    let anchor = DVec3::new(4.0, 1.0, -2.0);
    // The first corner of each body is the anchor.
    let bodies = fleet
        .bodies
        .into_iter()
        .map(|body| Body { corners: [anchor, body.corners[1], body.corners[2]], ..body });
    let fleet = Fleet { bodies: bodies.collect(), ..fleet };
    let config = Config { in_place: true, anchor: Some(Anchor::Point(anchor)), ..fleet.config() };
    let scene = seen(&fleet.text(), &config);
    for idx in 0..6 {
        let found = place(&scene, find(&scene, &format!("b{idx}:0")));
        assert!((found - anchor).length() < 1e-12, "{idx}: {found}");
    }
}

#[test]
fn the_camera_of_the_scene_may_move() {
    const CAR: &str = "v a 1 2 3; v b 2 0 3; v c 1 1 1; f (a b c) <0 0.5 0>; f (c b a); w (a b);
        l 0.3; l 0.5 0 0 1 <0.1 0 0.2>; cam -ep 1 0 0 < 0.6 0 0 >; cam other <0 0 0.5>;";
    let by_itself = seen(CAR, &Config::default());
    let without = CAR.replace("< 0.6 0 0 >", "");
    let by_option = seen(&without, &Config { camera_velocity: Some(DVec3::X * 0.6), ..Config::default() });
    assert_eq!(ugparse::write(&by_itself), ugparse::write(&by_option));
    assert_eq!(by_itself.camera().unwrap().velocity, None, "downstream the camera is at rest");
    assert_eq!(ugscene::camera_velocity(&by_itself), velocity(DVec3::X * 0.6));

    // The option overrides it, and -vel overrides faces but not what rests in no frame.
    let still = seen(CAR, &Config { camera_velocity: Some(DVec3::ZERO), ..Config::default() });
    assert_eq!(ugscene::camera_velocity(&still), Velocity::ZERO);
    let beta = |scene: &Scene, body| scene.bodies.stated_velocity(body).map(Velocity::beta);
    assert_eq!(beta(&still, still.faces[0].body), Some(DVec3::new(0.0, 0.5, 0.0)));
    assert_eq!(still.faces.last().unwrap().body, still.bodies.unstated());

    // All velocities are those in the frame of the camera, (P15).
    let expected = |u: DVec3| compose(velocity(u), velocity(DVec3::X * -0.6)).beta();
    let scene = &by_itself;
    assert_eq!(beta(scene, scene.faces[0].body), Some(expected(DVec3::Y * 0.5)));
    assert_eq!(beta(scene, scene.faces.last().unwrap().body), Some(DVec3::X * -0.6));
    assert_eq!(beta(scene, scene.wires[0].body), Some(DVec3::X * -0.6));
    assert_eq!(scene.lights[0].motion, LightMotion::WithWhatItLights);
    assert_eq!(
        beta(scene, scene.lights[1].motion.body().unwrap()),
        Some(expected(DVec3::new(0.1, 0.0, 0.2)))
    );
    assert_eq!(scene.lights[1].kind, LightKind::Directional(DVec3::Z));
}

#[test]
fn velocities_take_precedence_as_without_a_moving_camera() {
    const NESTED: &str = "def tile; v a 1 2 3; v b 2 0 3; v c 1 1 1; f (a b c) <0.1 0 0>; f (c b a); end;
        def pair; i (tile) <0 0.2 0>; i (tile); end;
        i (pair) <0 0 0.3>; i (pair); i (tile);";
    let betas = |scene: &Scene| -> Vec<DVec3> {
        let of = |face: &ugscene::Face| scene.bodies.stated_velocity(face.body).unwrap_or_default().beta();
        scene.faces.iter().map(of).collect()
    };
    let camera = DVec3::new(0.0, 0.0, 0.3);
    let at_rest = betas(&parse(NESTED));
    let config = Config { camera_velocity: Some(camera), pieces: Pieces::PerEdge(1), ..Config::default() };
    let expected: Vec<DVec3> = at_rest
        .iter()
        .map(|&u| if u == camera { DVec3::ZERO } else { compose(velocity(u), velocity(-camera)).beta() })
        .collect();
    assert_eq!(at_rest.len(), 10);
    assert_eq!(betas(&seen(NESTED, &config)), expected);
    let all = Config { velocity: Some(DVec3::X * 0.5), ..config };
    assert!(
        betas(&seen(NESTED, &all))
            .iter()
            .all(|&w| w == compose(velocity(DVec3::X * 0.5), velocity(-camera)).beta())
    );
}

#[test]
fn a_local_light_moves_with_the_only_body() {
    let text = "v a 1 2 3; v b 2 0 3; v c 1 1 1; f (a b c) <0 0.5 0.3>; l 0.5 4 5 6 0;";
    let camera = DVec3::new(0.6, 0.2, 0.0);
    let config =
        Config { camera_velocity: Some(camera), time: 3.0, pieces: Pieces::PerEdge(1), ..Config::default() };
    let scene = seen(text, &config);
    let rest = rest_positions(&scene, DVec3::ZERO, &RestFrames::new(&scene));
    let LightKind::Local { position, .. } = scene.lights[0].kind else { panic!("it is local") };
    let lamp_from_a = DVec3::new(4.0, 5.0, 6.0) - DVec3::new(1.0, 2.0, 3.0);
    assert!((position - rest[0] - lamp_from_a).length() < 1e-13, "the lamp stays with the body");
}

#[test]
fn what_meets_too_fast_is_refused() {
    let text = "v a 1 2 3; v b 2 0 3; v c 1 1 1; f (a b c) <0 1 0 -gamma 1e40>;
                cam -ep 5 5 5 -vc 0 0 0 <0 -1 0 -gamma 1e40>;";
    let error = uglorentz::apply(parse(text), &Config::default()).unwrap_err();
    assert_eq!(
        error.words(),
        "the body with velocity 0 1 0 in the scene moves too close to the speed of light relative \
         to the camera (-cv): make one of them slower"
    );
    assert!(!error.is_usage());
    let config = Config { camera_velocity: Some(DVec3::Y), ..Config::default() };
    let error = uglorentz::apply(parse(text), &config).unwrap_err();
    assert!(error.is_usage());
    assert_eq!(
        error.words(),
        "-cv: speed is 1 c: it must be below 1 (velocities are fractions of the speed of light)"
    );
    // Together they are slow enough.
    let text = "v a 1 2 3; v b 2 0 3; v c 1 1 1; f (a b c) <0 0.9999999999 0>;";
    let config = Config { camera_velocity: Some(DVec3::Y * 0.999_999_999_8), ..Config::default() };
    let scene = seen(text, &config);
    // (b − c)/(1 − bc), whose rounding is 10⁻¹⁶ over 3·10⁻¹⁰.
    let beta = scene.bodies.stated_velocity(scene.faces[0].body).unwrap().beta().y;
    assert!((beta - 1.0 / 3.0).abs() < 1e-6, "{beta}");
}
