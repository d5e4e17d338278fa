//! What holds for every diagram.

use glam::DVec3;
use ugdiagram::{
    Config, CurveRole, DiagramOptions, Interval, MarkRole, NamedEvent, PointChoice, Spacetime,
};
use ugphysics::{Event, InertialFrame, Lorentz, Velocity, WorldLine};
use ugscene::MotionOptions;
use ugtesting::Random;

use crate::common::{assert_near, diagram, drawn, place_at, scene, spacetime, stored};

/// Minkowski's product of two vectors.
fn product(a: Event, b: Event) -> f64 {
    a.t * b.t - a.x.dot(b.x)
}

fn worlds() -> Vec<Spacetime> {
    let at = |time: f64| Config {
        motion: MotionOptions { time, ..MotionOptions::default() },
        ..Config::default()
    };
    let driving = Config {
        motion: MotionOptions {
            camera_velocity: Some(DVec3::new(0.2, -0.6, 0.3)),
            ..MotionOptions::default()
        },
        ..Config::default()
    };
    let accelerating = [("twins", 5.0), ("orbit", 30.0), ("slalom", 20.0), ("departure", 20.0)];
    let mut all: Vec<Spacetime> =
        accelerating.iter().map(|(name, time)| spacetime(stored(name), &at(*time))).collect();
    all.push(spacetime(stored("traffic"), &driving));
    all.push(spacetime(stored("dice"), &driving));
    all
}

#[test]
fn intervals_are_the_same_in_all_frames() {
    let mut n_frames = 0;
    for world in worlds() {
        let mut frames = vec![world.scene_frame(), world.camera_frame()];
        for row in 0..world.lines.len() {
            for own_time in [-1.0, 0.0, 2.5] {
                frames.push(world.frame_of(row, Some(own_time)).unwrap());
            }
        }
        let mut random = Random(7);
        for frame in &frames {
            let mut number = || 20.0 * random.unit() - 10.0;
            let difference = Event { t: number(), x: DVec3::new(number(), number(), number()) };
            let there = frame.components(difference);
            let size = there.t * there.t + there.x.length_squared();
            let [here, there] = [difference, there].map(Interval::of);
            assert!((here.square - there.square).abs() <= 1e-13 * size, "{}", frame.name);
            assert!(here.kind == there.kind || here.square.abs() < 1e-12 * size);
            // There and back.
            assert_near(frame.coordinates(frame.event(difference)), difference, 1e-12);
            n_frames += 1;
        }
    }
    assert!(n_frames > 60, "{n_frames}");
}

/// Own time passes along world lines, and their bodies rest in their frames.
#[test]
fn frames_are_those_in_which_bodies_rest() {
    for world in worlds() {
        for (row, line) in world.lines.iter().enumerate() {
            for own_time in [0.0, 1.7] {
                let frame = world.frame_of(row, Some(own_time)).unwrap();
                let event = |own_time| line.motion.event(line.point, own_time).unwrap();
                assert_near(
                    frame.coordinates(event(own_time)),
                    Event { t: own_time, x: DVec3::ZERO },
                    1e-12,
                );
                const STEP: f64 = 1e-4;
                let passed = event(own_time + STEP) - event(own_time - STEP);
                let passed = frame.components(passed);
                assert!(passed.x.length() < 1e-6, "{}: {passed:?}", line.name);
                // A camera that rides ahead of the reference point of a ship has a clock of its own.
                let lapse = 2.0 * STEP;
                if world.lines[row].vertices.is_empty() && line.color == [0; 3] {
                    continue;
                }
                assert!((passed.t - lapse).abs() < 1e-10, "{}: {passed:?}", line.name);
            }
        }
    }
}

#[test]
fn lines_of_simultaneity_are_orthogonal_to_four_velocities() {
    let mut n_lines = 0;
    for frame in ["scene", "camera", "planet", "month@3"] {
        for axis in [DVec3::X, DVec3::new(1.0, 2.0, -0.5)] {
            let word = |text: &str| text.parse().unwrap();
            let options = DiagramOptions {
                frame: word(frame),
                axis: Some(axis),
                times: Some([-20.0, 20.0]),
                simultaneous: ["planet@2", "planet@-7", "day@1", "camera", "scene"]
                    .map(|name| (word(name), "1,2".parse().unwrap()))
                    .to_vec(),
                axes: vec![(word("planet@5"), "planet@5".parse().unwrap())],
                points: PointChoice::None,
                ..DiagramOptions::default()
            };
            let motion = MotionOptions { time: 30.0, ..MotionOptions::default() };
            let config = Config { motion, diagram: options, ..Config::default() };
            let diagram = drawn(stored("orbit"), &config).diagram;
            for curve in &diagram.curves {
                let is_line = matches!(curve.role, CurveRole::Simultaneity | CurveRole::SpaceAxis);
                let Some(of) = diagram.frames.iter().find(|of| is_line && of.name == curve.name)
                else {
                    continue;
                };
                let u = diagram.frame.components(of.four_velocity());
                assert!((product(u, u) - 1.0).abs() < 1e-12);
                let [a, b] = [curve.points[0], curve.points[1]];
                let along = Event { t: b[1] - a[1], x: diagram.axis * (b[0] - a[0]) };
                let size = u.t * (along.t.abs() + along.x.length());
                assert!(product(u, along).abs() <= 1e-12 * size, "{curve:?}");
                n_lines += 1;
            }
        }
    }
    assert_eq!(n_lines, 4 * 2 * 6);
}

/// Bodies along x with places in space, and a camera that rides on one of them.
fn text(lines: &[(String, InertialFrame)]) -> String {
    let mut text = String::new();
    for (name, InertialFrame { velocity, at, shift, .. }) in lines {
        let (beta, Event { t, x }) = (velocity.beta(), *shift);
        let at_words = format!("{} {} {}", at.x, at.y, at.z);
        text += &format!(
            "motion {name} -vel {} {} {} -at {at_words} -shift {t} {} {} {} ;\n\
             v a{name} {at_words} ; v b{name} {} {} {} ; v c{name} {} {} {} ; f (a{name} b{name} c{name}) <{name}> ;\n",
            beta.x,
            beta.y,
            beta.z,
            x.x,
            x.y,
            x.z,
            at.x + 0.5,
            at.y,
            at.z,
            at.x,
            at.y,
            at.z + 1.0,
        );
    }
    let at = lines[0].1.at;
    text + &format!(
        "cam -ep {} {} {} -vc 9 9 9 <{}> ;\n",
        at.x - 0.25,
        at.y - 3.0,
        at.z,
        lines[0].0
    )
}

#[test]
fn a_boosted_world_has_the_same_diagram_in_frames_of_its_bodies() {
    let mut random = Random(3);
    for round in 0..12 {
        let mut number = |size: f64| size * (2.0 * random.unit() - 1.0);
        let lines: Vec<(String, InertialFrame)> = (0..5)
            .map(|row| {
                let beta = DVec3::new(number(0.9), 0.0, 0.0);
                let at = DVec3::new(number(5.0), number(5.0), number(5.0));
                let velocity = Velocity::from_beta(beta).unwrap();
                (format!("m{row}"), InertialFrame { at, ..InertialFrame::new(velocity) })
            })
            .collect();
        let boost = Velocity::from_beta(DVec3::new(number(0.95), 0.0, 0.0)).unwrap();
        let moved = |(name, frame): &(String, InertialFrame)| {
            let line = WorldLine::inertial(*frame);
            let line = line.in_frame(Lorentz::boost(boost), Event::ORIGIN);
            (name.clone(), *line.inertial_frame().unwrap())
        };
        let boosted: Vec<_> = lines.iter().map(moved).collect();
        let options = DiagramOptions {
            frame: "m1".parse().unwrap(),
            axis: Some(DVec3::X),
            events: vec!["E=m2@1.5".parse::<NamedEvent>().unwrap()],
            simultaneous: vec![("m3".parse().unwrap(), "E".parse().unwrap())],
            intervals: vec![["E".parse().unwrap(), "eye".parse().unwrap()]],
            ..DiagramOptions::default()
        };
        let motion = MotionOptions { time: 2.0, ..MotionOptions::default() };
        let config = Config { motion, diagram: options, ..Config::default() };
        let [one, other] =
            [lines, boosted].map(|lines| drawn(scene(&text(&lines)), &config).diagram);
        const CLOSE: f64 = 1e-9;
        let is_near = |a: &[f64; 2], b: &[f64; 2]| {
            a.iter().zip(b).all(|(a, b)| (a - b).abs() <= CLOSE * (1.0 + a.abs()))
        };
        assert!(is_near(&one.window.times, &other.window.times), "{round}");
        assert_eq!(one.curves.len(), other.curves.len());
        for (a, b) in one.curves.iter().zip(&other.curves) {
            assert_eq!((a.role, &a.name), (b.role, &b.name));
            assert!(a.points.iter().zip(&b.points).all(|(a, b)| is_near(a, b)), "{a:?}\n{b:?}");
        }
        assert_eq!(one.marks.len(), other.marks.len());
        for (a, b) in one.marks.iter().zip(&other.marks) {
            assert_eq!((a.role, &a.name), (b.role, &b.name));
            assert!(is_near(&a.place, &b.place), "{a:?}\n{b:?}");
        }
        let [a, b] = [&one.intervals[0], &other.intervals[0]].map(|one| one.interval);
        assert!(a.kind == b.kind && (a.square - b.square).abs() < CLOSE);
    }
}

/// The light of the picture comes from the past light cone of the eye, in every frame.
#[test]
fn light_leaves_on_the_light_cone() {
    for world in worlds() {
        for frame in [world.scene_frame(), world.frame_of(0, None).unwrap()] {
            for light in &world.lights {
                let way = frame.coordinates(Event::ORIGIN) - frame.coordinates(light.event);
                assert!(
                    (way.t - way.x.length()).abs() <= 1e-11 * (1.0 + way.t),
                    "{}",
                    light.vertex
                );
                assert!(way.t >= 0.0);
            }
        }
    }
}

/// A vertex is where its body is at its own time.
#[test]
fn light_leaves_at_own_times() {
    let text = "motion a -vel .6 .2 0 -at 1 2 3; motion b -acc 0 .2 0 -at -2 0 0;\
        v p 1 2 3; v q 2 2 3; v r 1 3 3; f (p q r) <a>; v s -2 0 0; v t -2 0 1; v u -2.5 0 0; f (s t u) <b>;\
        cam -ep 0 -9 0;";
    let motion = MotionOptions { time: 3.0, ..MotionOptions::default() };
    let world = spacetime(scene(text), &Config { motion, ..Config::default() });
    assert_eq!(world.lights.len(), 6);
    for (name, row) in [("p", 0), ("s", 1)] {
        let light = world.lights.iter().find(|light| light.vertex == name).unwrap();
        let line = &world.lines[row];
        // The reference point of b is its vertex s, and p is that of a, whose frame has own time.
        let frame = world.frame_of(row, Some(light.own_time)).unwrap();
        let there = frame.coordinates(light.event);
        assert!((there.t - light.own_time).abs() < 1e-12, "{}: {there:?}", line.name);
    }
}

/// Ticks are where clocks show their numbers, one apart in own time.
#[test]
fn ticks_are_own_times() {
    let options = DiagramOptions { times: Some([0.0, 10.0]), ..DiagramOptions::default() };
    let diagram = diagram("motion fast -vel .8 0 0; motion slow; cam -ep 0 -1 0;", options);
    let ticks = |name: &str| {
        let of = diagram
            .marks
            .iter()
            .filter(move |mark| mark.role == MarkRole::Tick && mark.line == name);
        of.map(|mark| (mark.own_time.unwrap(), mark.place)).collect::<Vec<_>>()
    };
    assert!(ticks("slow").len() >= 5 && ticks("fast").len() >= 3);
    for (own_time, [x, t]) in ticks("fast") {
        assert!((t - own_time / 0.6).abs() < 1e-12 && (x - 0.8 * t).abs() < 1e-12);
    }
    for (own_time, [x, t]) in ticks("slow") {
        assert!((t - own_time).abs() < 1e-12 && x.abs() < 1e-12);
    }
}

/// A circle is seen along its plane as a sine; a camera that rides on it is on it.
#[test]
fn curves_follow_world_lines() {
    let text = "motion round -at 3 0 0 -orbit 0 0 0 0 0 1 .2; v a 3 0 0; v b 3.1 0 0; v c 3 0 .1;\
        f (a b c) <round>; cam -ep 0 -9 0;";
    let options = DiagramOptions {
        times: Some([-30.0, 30.0]),
        axis: Some(DVec3::X),
        ..DiagramOptions::default()
    };
    let diagram = diagram(text, options);
    let curve = diagram.curves.iter().find(|curve| curve.role == CurveRole::WorldLine).unwrap();
    assert!(curve.points.len() > 60, "{}", curve.points.len());
    for step in -29..30 {
        let time = f64::from(step);
        let expected = 3.0 * libm::cos(0.2 * time);
        assert!((place_at(&curve.points, time) - expected).abs() < 0.03, "{time}");
    }
}
