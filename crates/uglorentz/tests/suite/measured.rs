//! Where bodies are at one time of a frame: contraction, clocks, world lines, lamps.

use glam::DVec3;
use uglorentz::{Config, Error, MeasuredFrame, Pieces, apply};
use ugphysics::srgb_decode;
use ugscene::{ColorValue, LightKind, Scene};

use crate::common::parse;

fn measured(text: &str, frame: MeasuredFrame, config: Config) -> Scene {
    let config = Config { measured: Some(frame), pieces: Pieces::PerEdge(1), ..config };
    match apply(parse(text), &config) {
        Ok((scene, _)) => scene,
        Err(error) => panic!("{error}"),
    }
}

fn of(name: &str) -> MeasuredFrame {
    MeasuredFrame::Body(name.to_owned())
}

fn at(time: f64) -> Config {
    Config { time, ..Config::default() }
}

fn place(scene: &Scene, name: &str) -> DVec3 {
    let is_it = |vertex: &&ugscene::Vertex| scene.names.get(vertex.name) == name;
    scene.vertices.iter().find(is_it).map(|vertex| vertex.position).unwrap_or(DVec3::NAN)
}

#[track_caller]
fn near(got: f64, want: f64) {
    assert!((got - want).abs() < 1e-12 * want.abs().max(1.0), "{got}, not {want}");
}

/// A train of 12.5 at 0.6c between posts that are 10 apart: γ = 1.25.
const TRAIN: &str = "motion train -vel .6 0 0 ; cam -ep 0 -14 3 -vc 0 0 3 ;
    v rear -6.25 0 0 ; v front 6.25 0 0 ; v top 6.25 0 2 ; f (rear front top) <train> ;
    v left -5 0 0 ; v right 5 0 0 ; v over 5 0 2 ; f (left right over) ;";

#[test]
fn moving_bodies_are_contracted_in_every_frame() {
    let length = |scene: &Scene, [a, b]: [&str; 2]| (place(scene, b) - place(scene, a)).x;
    for time in [-3.0, 0.0, 2.5] {
        for (frame, train, posts) in [
            (MeasuredFrame::Camera, 10.0, 10.0),
            (MeasuredFrame::Scene, 10.0, 10.0),
            (of("train"), 12.5, 8.0),
        ] {
            let scene = measured(TRAIN, frame, at(time));
            near(length(&scene, ["rear", "front"]), train);
            near(length(&scene, ["left", "right"]), posts);
        }
    }
    // At time 0 of the embankment the ends are at the posts, and later 0.6 T further.
    for time in [0.0, 7.0] {
        let scene = measured(TRAIN, MeasuredFrame::Scene, at(time));
        near(place(&scene, "front").x, 5.0 + 0.6 * time);
        near(place(&scene, "right").x, 5.0);
    }
    // The frame of a moving camera is that of the train.
    let with_camera = Config { camera_velocity: Some(DVec3::X * 0.6), ..at(4.0) };
    let by_camera = measured(TRAIN, MeasuredFrame::Camera, with_camera.clone());
    assert_eq!(by_camera.vertices, measured(TRAIN, of("train"), at(4.0)).vertices);
    // The frame of the scene does not depend on the camera.
    let by_scene = measured(TRAIN, MeasuredFrame::Scene, with_camera);
    assert_eq!(by_scene.vertices, measured(TRAIN, MeasuredFrame::Scene, at(4.0)).vertices);
}

/// What is written is at rest: no motion is left, and it is measured as it is.
#[test]
fn measured_scenes_are_at_rest() {
    let spinning = "motion wheel -at 0 3 0 -spin 0 .5 0 ;
        v p 1 3 0 ; v q 1.5 3 0 ; v r 1 3 1 ; f (p q r) <wheel> ; l .5 1 1 1 <train> ;";
    let scene = measured(&format!("{TRAIN}{spinning}"), of("train"), at(3.0));
    assert!(scene.stage.is_at_rest() && !scene.bodies.has_motion());
    assert!(
        scene.cameras.iter().all(|camera| camera.velocity.is_none() && camera.carrier.is_none())
    );
    assert!(scene.lights.iter().all(|light| light.motion.body().is_none()));
    let again = ugparse::write(&scene);
    let again = String::from_utf8(again).unwrap_or_default();
    let twice = measured(&again, MeasuredFrame::Scene, Config::default());
    let places = |scene: &Scene| -> Vec<DVec3> {
        scene.vertices.iter().map(|vertex| vertex.position).collect()
    };
    assert_eq!(places(&scene), places(&twice));
}

/// The own time of each point is that of its frame at the time of the picture: t' = γ(t − β·x).
#[test]
fn clocks_show_their_own_times() {
    // Linear light is (t' + 100)/200.
    let text = TRAIN
        .replace("top) <train>", "top) clock <train>")
        .replace("over) ;", "over) clock ;")
        + "c_xyz dark 0 0 0 ; c_xyz light .95047 1 1.08883 ; c_time clock -100 dark 100 light ;";
    let shown = |scene: &Scene, name: &str| {
        let row = scene.vertices.iter().position(|vertex| {
            // Copies of a vertex have its name with a suffix.
            scene.names.get(vertex.name).starts_with(name) && vertex.color.is_some()
        });
        let color = row.and_then(|row| scene.vertices[row].color).expect("a colour");
        let light = match scene.colors[color.index()].value {
            ColorValue::Xyz([_, y, _]) => y,
            ColorValue::Rgb([_, green, _]) => srgb_decode(green),
            ref other => panic!("{other:?}"),
        };
        200.0 * light - 100.0
    };
    let gamma = 1.25;
    for time in [0.0, 5.0] {
        // Of the embankment: γ(t − βx) at the ends, where x is that of the ends then.
        let scene = measured(&text, MeasuredFrame::Scene, at(time));
        for (name, x) in [("rear", -5.0 + 0.6 * time), ("front", 5.0 + 0.6 * time)] {
            let own = gamma * (time - 0.6 * x);
            assert!((shown(&scene, name) - own).abs() < 1e-3, "{name}: {}", shown(&scene, name));
        }
        assert!((shown(&scene, "left") - time).abs() < 1e-3);
        // Of the train: its clocks agree, and those of the embankment are ahead in front.
        let scene = measured(&text, of("train"), at(time));
        let both = ["rear", "front"].map(|name| shown(&scene, name));
        assert!((both[0] - time).abs() < 1e-3 && (both[1] - time).abs() < 1e-3, "{both:?}");
        // The posts are at x' = ±4 − 0.6 t'.
        for (name, at_zero) in [("left", -4.0), ("right", 4.0)] {
            let own = gamma * (time + 0.6 * (at_zero - 0.6 * time));
            assert!((shown(&scene, name) - own).abs() < 1e-3, "{name}: {}", shown(&scene, name));
        }
    }
}

/// Born-rigid acceleration: each point follows a hyperbola about one event, X = √((1/a + ξ)² +
/// T²) − 1/a, and spins are turns.
#[test]
fn bodies_on_world_lines_are_where_they_are() {
    let text = "motion ship -acc .25 0 0 ; motion wheel -at 0 3 0 -spin 0 0 .5 ; cam -ep 0 -9 0 ;
        v a 0 0 0 ; v b 3 0 0 ; v c -2 1 0 ; f (a b c) <ship> ;
        v p 1 3 0 ; v q 0 3 0 ; v r 0 4 0 ; f (p q r) <wheel> ;";
    for time in [0.0_f64, 2.0, 12.0] {
        let scene = measured(text, MeasuredFrame::Scene, at(time));
        for (name, xi) in [("a", 0.0_f64), ("b", 3.0), ("c", -2.0)] {
            let x = libm::hypot(4.0 + xi, time) - 4.0;
            assert!((place(&scene, name).x - x).abs() < 1e-11, "{name} at {time}");
        }
        let (sin, cos) = libm::sincos(0.5 * time);
        assert!((place(&scene, "p") - DVec3::new(cos, 3.0 + sin, 0.0)).length() < 1e-11);
        assert!((place(&scene, "r") - DVec3::new(-sin, 3.0 + cos, 0.0)).length() < 1e-11);
    }
    // In its own momentary frame it has its rest shape.
    let (scene, report) = apply(
        parse(text),
        &Config { measured: Some(of("ship")), pieces: Pieces::PerEdge(1), ..at(5.0) },
    )
    .expect("measured");
    assert_eq!(report.momentary_frame, Some(("ship".to_owned(), 5.0)));
    near((place(&scene, "b") - place(&scene, "a")).x, 3.0);
    near((place(&scene, "c") - place(&scene, "a")).x, -2.0);
}

/// Edges of a body that turns in another frame bend, and are cut within the bound.
#[test]
fn edges_that_bend_are_cut() {
    let text = "motion wheel -spin 0 0 .3 ; cam -ep 0 -9 0 -vc 0 0 0 ;
        v a -2 0 0 ; v b 2 0 0 ; v c 0 0 2 ; f (a b c) <wheel> ;";
    let pieces = |camera: DVec3| {
        let config = Config {
            measured: Some(MeasuredFrame::Camera),
            camera_velocity: Some(camera),
            ..at(1.0)
        };
        apply(parse(text), &config).expect("measured").0.faces.len()
    };
    assert_eq!(pieces(DVec3::ZERO), 1);
    assert!(pieces(DVec3::X * 0.8) > 4);
}

/// The time in the frame of a body is that of the body, wherever the eye is.
#[test]
fn frames_have_the_clock_of_their_body() {
    let text = TRAIN.replace("motion train", "motion train -at 2 0 0");
    let right = |eye: DVec3, time: f64| {
        let config = Config { eye: Some(eye), ..at(time) };
        let scene = measured(&text, of("train"), config);
        place(&scene, "right").x - place(&scene, "front").x
    };
    for time in [0.0, 3.0] {
        let by_body = right(DVec3::new(2.0, -14.0, 3.0), time);
        for x in [-8.0, 0.0, 11.0] {
            near(right(DVec3::new(x, -9.0, 1.0), time), by_body);
        }
        // At its time 0 the post at 5 is (5 − 2)/γ = 2.4 ahead of its reference point.
        near(by_body, 2.4 - 4.25 - 0.6 * time);
    }
}

/// Lamps are where they are, and normals those of contracted shapes.
#[test]
fn lamps_and_normals_are_those_of_the_frame() {
    let text =
        TRAIN.replace("v front 6.25 0 0 ;", "v front 6.25 0 0 .6 0 .8 ;") + "l 1 5 1 2 1 <train> ;";
    let scene = measured(&text, MeasuredFrame::Scene, at(10.0));
    let LightKind::Local { position, .. } = scene.lights[0].kind else { panic!("a place") };
    assert!((position - DVec3::new(5.0 / 1.25 + 6.0, 1.0, 2.0)).length() < 1e-12, "{position}");
    let normal = scene.vertices.iter().find_map(|vertex| vertex.normal).expect("a normal");
    // Slopes are 1.25 times as steep: (0.6 · 1.25, 0, 0.8).
    assert!((normal / normal.z - DVec3::new(0.9375, 0.0, 1.0)).length() < 1e-12, "{normal}");
}

#[test]
fn frames_that_are_not_there_are_refused() {
    let refused = |text: &str, frame| {
        let config = Config { measured: Some(frame), ..Config::default() };
        apply(parse(text), &config).expect_err("refused")
    };
    let names = vec!["train".to_owned()];
    let error = refused(TRAIN, of("tram"));
    assert!(matches!(&error, Error::NoFrame { names: found, .. } if *found == names), "{error}");
    let lone = "motion ship -acc 1 0 0 ; v a 0 0 0 ; v b 1 0 0 ; v c 0 1 0 ; f (a b c) <ship> ;";
    assert!(matches!(refused(lone, of("ship")), Error::NoFrameEye { .. }));
    // Without flight time alone, programs downstream would be wrong.
    let partial = Config {
        geometry: ugscene::ShownEffects { contraction: true, flight_time: false },
        ..Config::default()
    };
    assert!(apply(parse(lone), &partial).is_err());
}
