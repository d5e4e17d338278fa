//! Diagrams of textbooks, with their numbers.

use glam::DVec3;
use ugdiagram::{Config, CurveRole, Diagram, DiagramOptions, IntervalKind, MarkRole};
use ugscene::MotionOptions;

use crate::common::{diagram, drawn, names, stored, time_at};

#[track_caller]
fn assert_is(value: f64, expected: f64) {
    assert!((value - expected).abs() < 1e-9, "{value}, not {expected}");
}

/// The difference of two events in a frame: time, and place along the axis.
fn parts(diagram: &Diagram, interval: usize, frame: &str) -> [f64; 2] {
    let frame = diagram.frames.iter().find(|known| known.name == frame).unwrap();
    let components = frame.components(diagram.intervals[interval].difference);
    [components.t, diagram.axis.dot(components.x)]
}

/// Twins at 0.8c: five years out, five years back, and the traveller ages six. The home's time
/// that is simultaneous with the turn jumps from 1.8 to 8.2.
#[test]
fn twins() {
    let text = "motion home; motion out -vel .8 0 0; motion back -vel -.8 0 0 -shift 0 8 0 0;\
        cam -ep 0 0 0;";
    let event = |word: &str| word.parse().unwrap();
    let options = DiagramOptions {
        events: vec!["turn=5,4".parse().unwrap()],
        intervals: [
            ["out@0", "turn"],
            ["turn", "back@6"],
            ["home@0", "home@10"],
            ["out@3", "back@3"],
        ]
        .map(|pair| pair.map(event))
        .to_vec(),
        simultaneous: ["out", "back"].map(|name| (name.parse().unwrap(), event("turn"))).to_vec(),
        ..DiagramOptions::default()
    };
    let diagram = diagram(text, options);
    let length = |row: usize| diagram.intervals[row].interval.length();
    assert_is(length(0), 3.0);
    assert_is(length(1), 3.0);
    assert_is(length(2), 10.0);
    // Both meet at the turn, and one returns home.
    assert_is(length(3), 0.0);
    assert_is(parts(&diagram, 1, "scene")[0], 5.0);
    assert_is(parts(&diagram, 1, "scene")[1], -4.0);
    let now = |name: &str| {
        let is_it = |role, of: &str| role == CurveRole::Simultaneity && of == name;
        let curve = diagram.curves.iter().find(|curve| is_it(curve.role, &curve.name)).unwrap();
        time_at(&curve.points, 0.0)
    };
    assert_is(now("out"), 1.8);
    assert_is(now("back"), 8.2);
    assert_eq!((diagram.axis, diagram.step), (DVec3::X, 2.0));
}

/// A twin that accelerates: 12 units of own time against 17.03.
#[test]
fn accelerated_twins() {
    let event = |word: &str| word.parse().unwrap();
    let options = DiagramOptions {
        intervals: vec![["traveller@0", "traveller@12"].map(event)],
        ..DiagramOptions::default()
    };
    let motion = MotionOptions { time: 26.0, ..MotionOptions::default() };
    let config = Config { motion, diagram: options, ..Config::default() };
    let diagram = drawn(stored("twins"), &config).diagram;
    // Four legs of 3 with a = 0.5: 4 sinh(1.5)/0.5.
    let expected = 8.0 * libm::sinh(1.5);
    let [time, place] = parts(&diagram, 0, "scene");
    assert!((time - expected).abs() < 1e-9 && place.abs() < 1e-9, "{time} {place}");
    assert!((expected - 17.03).abs() < 0.005);
    // The bend of the world line and the return are in the diagram.
    assert!(diagram.window.times[0] < 0.0 && diagram.window.times[1] > 17.1);
}

/// The lines of both ends of a body at a time.
fn ends(diagram: &Diagram, name: &str, time: f64) -> [f64; 2] {
    let band = diagram.bands.iter().find(|band| band.name == name).unwrap();
    [0, 1].map(|end| {
        let points: Vec<[f64; 2]> = band.rows.iter().map(|(t, ends)| [ends[end], *t]).collect();
        crate::common::place_at(&points, time)
    })
}

/// Pole and barn: a pole of 20 in a barn of 10, at γ = 2. In its frame it leaves at the far door
/// 17.3 before it is in at the near one, and the barn is 5 long.
#[test]
fn pole_and_barn() {
    let event = |word: &str| word.parse().unwrap();
    let options = |frame: &str| DiagramOptions {
        lines: names("pole barn"),
        frame: frame.parse().unwrap(),
        axis: Some(DVec3::X),
        times: Some([-30.0, 30.0]),
        intervals: vec![["0,-5", "0,5"].map(event)],
        axes: vec![("pole".parse().unwrap(), event("0,0"))],
        ..DiagramOptions::default()
    };
    let of = |frame: &str| {
        let config = Config { diagram: options(frame), ..Config::default() };
        drawn(stored("barn"), &config).diagram
    };
    let in_barn = of("barn");
    let near = |found: [f64; 2], expected: [f64; 2]| {
        found.iter().zip(expected).for_each(|(found, expected)| assert_is(*found, expected));
    };
    near(ends(&in_barn, "pole", 0.0), [-5.0, 5.0]);
    near(ends(&in_barn, "barn", 0.0), [-5.0, 5.0]);
    let in_pole = of("pole");
    let [low, high] = ends(&in_pole, "barn", 3.0);
    assert_is(high - low, 5.0);
    near(ends(&in_pole, "pole", 3.0), [-10.0, 10.0]);
    near(parts(&in_barn, 0, "barn"), [0.0, 10.0]);
    near(parts(&in_barn, 0, "pole"), [-10.0 * 3.0_f64.sqrt(), 20.0]);
    let interval = in_barn.intervals[0].interval;
    assert_eq!(interval.kind, IntervalKind::Spacelike);
    assert_is(interval.length(), 10.0);
}

/// Bell's ships stay 4 apart in the scene, and are 8 apart in the frame in which both rest.
#[test]
fn bells_ships() {
    let of = |frame: &str| {
        let options = DiagramOptions {
            frame: frame.parse().unwrap(),
            lines: names("rear front"),
            times: Some([-2.0, 40.0]),
            axis: Some(DVec3::X),
            ..DiagramOptions::default()
        };
        drawn(stored("bell"), &Config { diagram: options, ..Config::default() }).diagram
    };
    let apart = |diagram: &Diagram, time: f64| {
        let place = |name: &str| {
            let is_it = |curve: &&ugdiagram::DiagramCurve| curve.name == name;
            let curve = diagram.curves.iter().find(is_it).unwrap();
            crate::common::place_at(&curve.points, time)
        };
        place("front") - place("rear")
    };
    let in_scene = of("scene");
    // Chords of curves are as exact as the picture.
    for time in [0.5, 2.0, 20.0] {
        assert!((apart(&in_scene, time) - 4.0).abs() < 1e-2, "{time}");
    }
    assert_is(apart(&of("rear@5"), 39.0), 8.0);
}

/// Einstein's train: for passengers a flash reaches both ends at once, at 6. For the street it
/// reaches the rear, which comes towards it, at 1.61, and the front at 22.4.
#[test]
fn einsteins_train() {
    let of = |frame: &str| {
        let options = DiagramOptions {
            frame: frame.parse().unwrap(),
            axis: Some(DVec3::Y),
            lines: names("tram lamp"),
            times: Some([-5.0, 30.0]),
            points: ugdiagram::PointChoice::None,
            ..DiagramOptions::default()
        };
        drawn(stored("tram"), &Config { diagram: options, ..Config::default() }).diagram
    };
    let arrivals = |diagram: &Diagram| {
        let flash = diagram.marks.iter().find(|mark| mark.role == MarkRole::Flash).unwrap();
        assert_is(flash.own_time.unwrap(), 0.0);
        let rays = diagram
            .curves
            .iter()
            .filter(|curve| curve.role == CurveRole::Light && curve.name == "lamp");
        assert_eq!(rays.count(), 2);
        // Where the rays of the flash meet the straight lines of the walls at y = −6 and 6 in the
        // frame of the tram; its roof overhangs by 0.1.
        let [x, t] = flash.place;
        let wall = |end: usize| {
            let [at, later] = [t, t + 1.0].map(|time| ends(diagram, "tram", time)[end] - x);
            let (side, speed) = ([-1.0, 1.0][end], later - at);
            at / (side - speed) * 6.0 / 6.1
        };
        [wall(0), wall(1)]
    };
    let [rear, front] = arrivals(&of("tram"));
    assert_is(rear, 6.0);
    assert_is(front, 6.0);
    let [rear, front] = arrivals(&of("scene"));
    assert!((rear - 1.608).abs() < 1e-3 && (front - 22.39).abs() < 1e-2, "{rear} {front}");
}
