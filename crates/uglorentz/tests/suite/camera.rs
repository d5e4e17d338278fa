//! A camera that moves in the scene (`-cv`): laws of (P5), (P7), (P25) and (P26), through text.

use std::fmt::Write;

use glam::DVec3;
use uglorentz::{Anchor, Config, Pieces};
use ugphysics::{Velocity, compose};
use ugpipe::Words;
use ugscene::{LightKind, LightMotion, RestFrames, Scene, rest_positions};
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
        let bodies = betas
            .into_iter()
            .map(|beta| Body { beta, corners: [(); 3].map(|()| random.in_ball(10.0)) });
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
    let by_option =
        seen(&without, &Config { camera_velocity: Some(DVec3::X * 0.6), ..Config::default() });
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
    const NESTED: &str =
        "def tile; v a 1 2 3; v b 2 0 3; v c 1 1 1; f (a b c) <0.1 0 0>; f (c b a); end;
        def pair; i (tile) <0 0.2 0>; i (tile); end;
        i (pair) <0 0 0.3>; i (pair); i (tile);";
    let betas = |scene: &Scene| -> Vec<DVec3> {
        let of = |face: &ugscene::Face| {
            scene.bodies.stated_velocity(face.body).unwrap_or_default().beta()
        };
        scene.faces.iter().map(of).collect()
    };
    let camera = DVec3::new(0.0, 0.0, 0.3);
    let at_rest = betas(&parse(NESTED));
    let config =
        Config { camera_velocity: Some(camera), pieces: Pieces::PerEdge(1), ..Config::default() };
    let expected: Vec<DVec3> =
        at_rest
            .iter()
            .map(|&u| {
                if u == camera {
                    DVec3::ZERO
                } else {
                    compose(velocity(u), velocity(-camera)).beta()
                }
            })
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
    let config = Config {
        camera_velocity: Some(camera),
        time: 3.0,
        pieces: Pieces::PerEdge(1),
        ..Config::default()
    };
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

/// An eye that a body has carried away, and that rests for a moment: what rests in the scene is seen
/// from its new place, also beside a body that turns there.
#[test]
fn eyes_that_turn_back_have_left() {
    let motions =
        "motion ship -acc .5 0 0 0 3 -acc -.5 0 0 3 9 ; motion wheel -at 0 20 0 -spin 0 0 .1 ;";
    let faces = "v a 0 9 0 ; v b 1 9 0 ; v c 0 9 1 ; f (a b c) ; \
                 v p 0 20 0 ; v q 1 20 0 ; v r 0 20 1 ; f (p q r) <wheel> ; cam -ep 0 0 0 -vc 0 9 0 <ship> ;";
    // Twice (cosh aτ − 1)/a.
    let way = 4.0 * (libm::cosh(1.5) - 1.0);
    let config = Config { time: 6.0, pieces: Pieces::PerEdge(1), ..Config::default() };
    for motion in [motions, &motions[..motions.find("motion wheel").unwrap_or_default()]] {
        let is_alone = !motion.contains("wheel");
        let faces = if is_alone { faces.replace("<wheel>", "") } else { faces.to_owned() };
        let scene = seen(&format!("{motion}{faces}"), &config);
        for (name, x) in [("a", 0.0), ("b", 1.0), ("p", 0.0)] {
            let found = place(&scene, find(&scene, name)).x - ugscene::eye(&scene, None).x;
            assert!((found - (x - way)).abs() < 1e-9, "{name}: {found}");
        }
    }
}
