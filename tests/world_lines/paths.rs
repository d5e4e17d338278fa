//! Motions through the events of a table, integrated to rounding.

use glam::DVec3;
use ugphysics::{Event, SampledPath, WorldLine};
use ugtesting::Random;
use ugtests::pipe;
use ugtests::scenes::parse;
use ugtests::world_lines::curve::Curve;
use ugtests::world_lines::{Four, boosted};

use super::options;

fn event([t, x, y, z]: Four) -> Event {
    Event { t, x: DVec3::new(x, y, z) }
}

/// Few rows with turns between them, and a speed of up to 0.95.
fn rows(random: &mut Random) -> Vec<Four> {
    let mut row = [random.between(-5.0, 5.0), 0.0, 0.0, 0.0];
    (0..7)
        .map(|_| {
            let passed = random.between(0.5, 3.0);
            let x = passed * random.in_ball(0.9);
            row = [row[0] + passed, row[1] + x.x, row[2] + x.y, row[3] + x.z];
            row
        })
        .collect()
}

/// Own times, and axes that are carried without turning.  Eq. (P48)
#[test]
fn own_times_and_axes_are_integrated_to_rounding() {
    let mut random = Random(48);
    let (mut n_fast, mut n_found) = (0, 0);
    while n_found < 12 {
        let rows = rows(&mut random);
        let curve = Curve::new(&rows);
        let times =
            (0..1000).map(|k| rows[0][0] + (rows[6][0] - rows[0][0]) * f64::from(k) / 1000.0);
        let fastest = times.map(|t| curve.at(t).0.length()).fold(0.0, f64::max);
        let events: Vec<Event> = rows.iter().copied().map(event).collect();
        if fastest > 0.95 {
            assert!(fastest < 1.0 || SampledPath::new(&events).is_err(), "{fastest}");
            n_fast += 1;
            continue;
        }
        n_found += 1;
        let line = WorldLine::along(DVec3::ZERO, SampledPath::new(&events).unwrap(), &[]).unwrap();
        let velocity = curve.at(rows[0][0]).0;
        let start = [[0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
        let axes = curve.axes(start.map(|axis| boosted(velocity, axis)));
        for ((own_time, axes), expected) in curve.own_times().into_iter().zip(axes).zip(&events) {
            let pose = line.pose(own_time);
            let error = pose.event - *expected;
            assert!(error.t.abs().max(error.x.length()) < 1e-12, "{own_time}: {error:?} {rows:?}");
            for (unit, axis) in DVec3::AXES.into_iter().zip(axes) {
                let found = pose.scene_from_axes.apply(Event { t: 0.0, x: unit });
                let error = found - event(axis);
                assert!(
                    error.t.abs().max(error.x.length()) < 1e-12,
                    "{own_time}: {error:?} {rows:?}"
                );
            }
        }
    }
    assert!(n_fast > 0);
}

/// Places and times of a path are those of the scene: no option displaces them.
#[test]
fn a_path_is_where_its_events_are() {
    let text = "motion m -path (0 3 0 0  2 3 1 0  4 4 1 0); v a 0 0 0; v b 0 0 .1; w (a b) <m>;";
    let eye = DVec3::new(3.0, -4.0, 0.0);
    for (anchor, in_place) in [
        (None, false),
        (None, true),
        (Some(ugscene::Anchor::Center), false),
        (options(eye, 0.0).anchor, false),
    ] {
        // Light of the second event.
        let config = uglorentz::Config { anchor, in_place, ..options(eye, 7.0) };
        let scene = parse(&pipe::lorentz(text.as_bytes(), &config));
        let seen = scene.vertices[0].position;
        assert!(
            (seen - DVec3::new(3.0, 1.0, 0.0)).length() < 1e-12,
            "{anchor:?} {in_place}: {seen}"
        );
        let own = ugscene::measure(&scene, eye, 7.0)[0].velocity;
        let curve = Curve::new(&[[0.0, 3.0, 0.0, 0.0], [2.0, 3.0, 1.0, 0.0], [4.0, 4.0, 1.0, 0.0]]);
        assert!((own - curve.at(2.0).0).length() < 1e-12, "{own}");
    }
}
