//! Every dot of a diagram is the event of the table that `uglorentz -at` writes.

use std::collections::BTreeMap;

use glam::DVec3;
use ugdiagram::{Config, DiagramOptions, FrameOwner, FrameWord, MarkRole};
use ugphysics::Event;
use ugscene::{CameraOptions, MotionOptions};

use crate::common::{drawn, stored};

/// An event of the frame of a camera with velocity v in that of the scene, written out.
fn boosted(event: Event, v: DVec3) -> Event {
    let gamma = 1.0 / (1.0 - v.length_squared()).sqrt();
    let along =
        if v == DVec3::ZERO { DVec3::ZERO } else { v * (event.x.dot(v) / v.length_squared()) };
    Event {
        t: gamma * (event.t + v.dot(event.x)),
        x: event.x + (gamma - 1.0) * along + gamma * event.t * v,
    }
}

/// The worst difference of a scene, and how many events were compared.
fn compared(name: &str, motion: &MotionOptions, eye: Option<DVec3>) -> (f64, usize) {
    let camera = CameraOptions { eye, ..CameraOptions::default() };
    let of_table = uglorentz::Config {
        velocity: motion.velocity,
        camera_velocity: motion.camera_velocity,
        time: motion.time,
        in_place: motion.in_place,
        eye,
        camera: camera.clone(),
        pieces: uglorentz::Pieces::PerEdge(1),
        ..uglorentz::Config::default()
    };
    let (seen, _) = uglorentz::apply(stored(name), &of_table).unwrap();
    let eye_point = ugscene::eye(&seen, None);
    let rows = uglorentz::measure(&seen, eye_point, motion.time);
    // Positions and times as the table has them.
    let table: BTreeMap<String, Event> = seen
        .vertices
        .iter()
        .zip(&rows)
        .map(|(vertex, row)| {
            let event = Event { t: row.emission_time, x: vertex.position };
            (seen.names.get(vertex.name).to_owned(), event)
        })
        .collect();
    let mut worst = (0.0_f64, 0);
    for owner in [FrameOwner::Camera, FrameOwner::Scene] {
        let frame = FrameWord { owner: owner.clone(), own_time: None };
        let options = DiagramOptions { frame, axis: Some(DVec3::X), ..DiagramOptions::default() };
        let mut config = Config { motion: motion.clone(), diagram: options, ..Config::default() };
        config.picture.camera = camera.clone();
        let diagram = drawn(stored(name), &config).diagram;
        for mark in diagram.marks.iter().filter(|mark| mark.role == MarkRole::Emission) {
            let Some(row) = table.get(&mark.name) else { continue };
            let v = ugscene::camera_velocity(&seen).beta();
            let expected = if owner == FrameOwner::Camera {
                Event { t: row.t, x: row.x - eye_point }
            } else {
                // At time 0 the eye is at its point.
                boosted(Event { t: row.t, x: row.x - eye_point }, v)
                    + Event { t: 0.0, x: eye_point }
            };
            let size = 1.0 + expected.t.abs() + expected.x.length();
            let [x, t] = mark.place;
            let error = (x - expected.x.x).abs().max((t - expected.t).abs()) / size;
            worst = (worst.0.max(error), worst.1 + 1);
        }
    }
    worst
}

#[test]
fn dots_are_the_events_of_the_table() {
    let vector = |x: f64, y: f64, z: f64| Some(DVec3::new(x, y, z));
    let none = MotionOptions::default;
    let moved = |velocity| MotionOptions { velocity, ..none() };
    let rows: [(&str, MotionOptions, Option<DVec3>); 20] = [
        ("house", moved(vector(0.9, 0.0, 0.0)), None),
        ("ship", MotionOptions { in_place: true, ..moved(vector(0.6, 0.0, 0.0)) }, None),
        (
            "ship",
            MotionOptions { time: -2.0, ..moved(vector(0.3, -0.8, 0.1)) },
            vector(4.0, -9.0, 1.0),
        ),
        ("street", moved(vector(0.0, -0.99, 0.0)), None),
        (
            "street",
            MotionOptions { camera_velocity: vector(0.0, 0.9, 0.0), time: 2.0, ..none() },
            None,
        ),
        ("traffic", MotionOptions { time: 1.5, ..none() }, None),
        ("traffic", MotionOptions { camera_velocity: vector(0.1, 0.7, 0.2), ..none() }, None),
        ("dice", none(), None),
        ("die", moved(vector(0.5, 0.5, 0.5)), None),
        ("cubes", moved(vector(0.95, 0.0, 0.0)), None),
        ("clocks", MotionOptions { time: 3.0, ..none() }, None),
        ("ticks", MotionOptions { time: 16.0, ..none() }, None),
        ("twins", MotionOptions { time: 14.0, ..none() }, None),
        ("wheels", MotionOptions { time: 8.7, ..none() }, None),
        ("orbit", MotionOptions { time: 32.0, ..none() }, None),
        ("disc", MotionOptions { time: 9.0, ..none() }, None),
        ("slalom", MotionOptions { time: 22.0, ..none() }, None),
        ("departure", MotionOptions { time: 28.0, ..none() }, None),
        ("barn", MotionOptions { time: 30.0, ..none() }, None),
        (
            "bell",
            MotionOptions { time: 14.0, camera_velocity: vector(0.4, 0.0, 0.0), ..none() },
            None,
        ),
    ];
    let (mut worst, mut total) = (0.0_f64, 0);
    for (name, motion, eye) in &rows {
        let (error, n_events) = compared(name, motion, *eye);
        assert!(n_events >= 20, "{name}: {n_events} events");
        assert!(error <= 1e-12, "{name} {motion:?}: {error:e}");
        (worst, total) = (worst.max(error), total + n_events);
    }
    println!("{total} events, worst difference {worst:e}");
}
