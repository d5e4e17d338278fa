//! Laws that hold whatever the motion.

use glam::DVec3;
use ugscene::Anchor;
use ugtesting::Random;
use ugtests::picture::assert_same;
use ugtests::pipe::Pipe;
use ugtests::scenes::parse;
use ugtests::world_lines::statement::words;
use ugtests::world_lines::{Path, Statement};

use super::{World, options, seen};

/// A cube with colours, lamps and a camera; `MOTION` is the motion of the cube.
const CUBE: &str = "c red 1 20 .8; c blue .8 230;
    v a -1 -1 -1; v b 1 -1 -1; v c 1 1 -1; v d -1 1 -1; v e -1 -1 1; v f 1 -1 1; v g 1 1 1; v h -1 1 1;
    f (d c b a) red MOTION; f (e f g h) blue MOTION; f (a b f e) MOTION; f (c d h g) red MOTION;
    f (b c g f) blue MOTION; f (d a e h) red MOTION;
    v i -3 2 -2; v j 3 2 -2; v k 3 2 2; v l -3 2 2; f (i j k l) blue;
    l .2; l .5 -1 -2 3; l .6 2 -3 1 0 <0 0 0>;
";

const CAMERA: &str = "cam -ep 2 -6 1 -vc 0 0 0 -va 50 40;";

fn pipe(time: f64) -> Pipe {
    let mut pipe = Pipe::default();
    pipe.lorentz.time = time;
    pipe.rainbow.picture.size = [80, 60];
    pipe
}

fn cube(motion: &str) -> Vec<u8> {
    (CUBE.replace("MOTION", motion) + CAMERA).into_bytes()
}

/// Motions without acceleration and spin, however they are written, are the velocity.
#[test]
fn no_spin_and_no_acceleration_are_inertial_motion_byte_for_byte() {
    for options in [
        "-vel .3 .5 -.2",
        "-vel .3 .5 -.2 -spin 0 0 0",
        "-at 1 2 3 -acc 0 0 0 -vel .3 .5 -.2 -acc 0 0 0 -3 -1",
        "-vel .3 .5 -.2 -spin 0 0 0 1 2 -acc 0 0 0 1 2",
    ] {
        let velocity =
            if options.starts_with("-at 1 2 3") { "<.3 .5 -.2 -at 1 2 3>" } else { "<.3 .5 -.2>" };
        let velocity = cube(velocity);
        let named = [format!("motion m {options};\n").as_bytes(), &cube("<m>")].concat();
        let on = format!("motion n -on m -at 1 1 1; motion m {options};\n");
        let on = [on.as_bytes(), &cube("<n>")].concat();
        for (anchor, in_place, camera) in [
            (None, false, None),
            (None, true, None),
            (Some(Anchor::Origin), false, Some(DVec3::new(0.1, 0.6, 0.0))),
            (Some(Anchor::Center), true, Some(DVec3::new(0.1, 0.6, 0.0))),
        ] {
            let mut pipe = pipe(1.5);
            (pipe.lorentz.anchor, pipe.lorentz.in_place, pipe.lorentz.camera_velocity) =
                (anchor, in_place, camera);
            let expected = pipe.run(&velocity);
            for text in [&named, &on] {
                let found = pipe.run(text);
                assert!(found.file == expected.file, "{options} {anchor:?} {in_place} {camera:?}");
                let positions = |text: &[u8]| -> Vec<DVec3> {
                    parse(text).vertices.iter().map(|vertex| vertex.position).collect()
                };
                assert_eq!(positions(&found.seen), positions(&expected.seen), "{options}");
            }
        }
    }
}

/// A camera on a body with constant velocity is a camera with that velocity.
#[test]
fn a_camera_on_an_inertial_body_has_its_velocity() {
    for (motion, beta) in [("-vel .3 .5 -.2", DVec3::new(0.3, 0.5, -0.2)), ("", DVec3::ZERO)] {
        let text = format!(
            "motion car -at 2 -6 1 {motion}; motion turning -spin 0 0 .2; motion going -acc .1 .2 0;\n"
        );
        for body in ["<turning>", "<going>", "<.2 0 .5>", ""] {
            let mut pipe = pipe(0.7);
            let text = text.clone() + std::str::from_utf8(&cube(body)).unwrap();
            let on_car = pipe.draw(text.replace("40;", "40 <car>;").as_bytes());
            pipe.lorentz.camera_velocity = Some(beta);
            assert_same("camera-on-car", &pipe.draw(text.as_bytes()), &on_car, 1);
        }
    }
}

/// What rides on a body without turning on it, is the body.
#[test]
fn a_rider_without_spin_equals_its_carrier() {
    let mut random = Random(7);
    for _ in 0..30 {
        let mut world = World::default();
        let middle = random.in_ball(3.0);
        let motion = Statement::random(&mut random, middle, 0.8);
        world.add(&mut random, motion, middle, 3);
        let mut riders = world.clone();
        riders.motions.push(Statement { at: middle, path: Path::On(0), spins: Vec::new() });
        riders.triangles.iter_mut().for_each(|triangle| triangle.body = 1);
        for anchor in [None, Some(Anchor::Origin)] {
            let config = uglorentz::Config {
                anchor,
                camera_velocity: Some(random.in_ball(0.8)),
                ..options(random.in_ball(8.0), random.between(-3.0, 3.0))
            };
            let (carrier, rider) = (seen(&world.text(), &config), seen(&riders.text(), &config));
            for (a, b) in carrier.vertices.iter().zip(&rider.vertices) {
                assert_eq!(a.position, b.position);
            }
        }
    }
}

/// With `-in`, a body that hardly turns is where one that does not turn is, whatever the camera
/// does.
#[test]
fn slow_spins_are_placed_as_no_spin() {
    for camera in [DVec3::ZERO, DVec3::new(0.2, 0.5, 0.1)] {
        for (anchor, in_place) in [
            (None, false),
            (None, true),
            (Some(Anchor::Origin), false),
            (Some(Anchor::Center), false),
            (Some(Anchor::Origin), true),
            (Some(Anchor::Point(DVec3::new(1.0, 2.0, 0.5))), true),
        ] {
            let config = uglorentz::Config {
                anchor,
                in_place,
                camera_velocity: Some(camera),
                ..options(DVec3::new(2.0, -6.0, 1.0), 1.5)
            };
            let texts = ["-spin 0 0 1e-14", ""].map(|spin| {
                format!("motion m -vel .3 .5 -.2 {spin}; v a 1 0 0; v b 2 0 0; v c 2 1 3; f (a b c) <m>;")
            });
            let [turning, inertial] = texts.map(|text| seen(&text, &config));
            for (a, b) in turning.vertices.iter().zip(&inertial.vertices) {
                let off = (a.position - b.position).length();
                assert!(
                    off < 1e-11,
                    "{camera} {anchor:?} {in_place}: {} {}",
                    a.position,
                    b.position
                );
            }
        }
    }
}

/// A camera that has stopped sees what a camera sees that rests at its place, at the time there.
#[test]
fn a_camera_that_has_stopped_is_where_it_stopped() {
    let (sinh, cosh) = (libm::sinh(1.0), libm::cosh(1.0));
    let way = 2.0 * (cosh - 1.0) / 0.25 + 4.0 * sinh;
    let time = 2.0 * sinh / 0.25 + 4.0 * cosh;
    for of_cube in ["", "<.3 .2 0>", "<m>"] {
        let text = format!("motion m -spin 0 .1 .3;{}", CUBE.replace("MOTION", of_cube));
        let drives = format!(
            "{text} motion car -at {} -6 1 -acc .25 0 0 0 4 -acc -.25 0 0 8 12;
            cam -ep {} -6 1 -vc {} 0 0 -va 50 40 <car>;",
            2.0 - way,
            2.0 - way,
            -way
        );
        let stands = format!("{text} cam -ep 2 -6 1 -vc 0 0 0 -va 50 40;");
        // Rounding may decide how edges are cut.
        let pieces = uglorentz::Pieces::PerEdge(3);
        let config = |time: f64| uglorentz::Config {
            time,
            anchor: Some(Anchor::Origin),
            pieces,
            ..uglorentz::Config::default()
        };
        for after in [0.0, 1.5] {
            let [driven, stood] = [(&drives, 12.0), (&stands, time)]
                .map(|(text, time)| seen(text, &config(time + after)));
            assert_eq!(driven.vertices.len(), stood.vertices.len());
            let shift = ugscene::eye(&driven, None) - ugscene::eye(&stood, None);
            for (a, b) in driven.vertices.iter().zip(&stood.vertices) {
                assert!(
                    (a.position - b.position - shift).length() < 1e-11,
                    "{of_cube}: {a:?} {b:?}"
                );
            }
            let [driven, stood] = [(&drives, 12.0), (&stands, time)].map(|(text, time)| {
                let mut config = ugphoton::Config::default();
                (config.motion.time, config.motion.anchor) = (time + after, Some(Anchor::Origin));
                config.picture.size = [80, 60];
                ugphoton::light(parse(text.as_bytes()), &config).unwrap()
            });
            let pixels = driven.pixels().iter().flatten().zip(stood.pixels().iter().flatten());
            let n_off = pixels.filter(|(a, b)| (*a - *b).abs() > 1e-5).count();
            // At edges the rounding of places decides.
            assert!(n_off <= 4, "{of_cube}: {n_off}");
        }
    }
}

/// A camera and a body on the same path see each other at rest.
#[test]
fn a_camera_sees_its_own_body_as_it_is() {
    let mut random = Random(9);
    for _ in 0..20 {
        let eye = random.in_ball(2.0);
        let mut motion = Statement::random(&mut random, eye, 0.8);
        motion.at = eye;
        if let Path::Free { accelerations, .. } = &mut motion.path {
            accelerations.clear();
        } else {
            continue;
        }
        // Without spin it is at rest for its own camera.
        motion.spins.clear();
        let text = format!(
            "{} v a 1 2 3; v b 2 2 {}; w (a b) <m0>;",
            motion.text("m0"),
            words(DVec3::ONE).len()
        );
        let scene =
            seen(&format!("{text} cam -vc 0 0 0 <m0>;"), &options(eye, random.between(-3.0, 3.0)));
        let found = scene.vertices[0].position;
        assert!((found - DVec3::new(1.0, 2.0, 3.0)).length() < 1e-11, "{found}");
    }
}
