//! World lines through the events of a table: agreement with motions in closed form, and mistakes.

use glam::DVec3;
use ugphysics::{
    Event, HyperbolicMotion, InertialFrame, Piece, SampledPath, Velocity, WorldLine,
    WorldLineError as Error,
};

fn table(rows: impl Iterator<Item = Event>) -> SampledPath {
    SampledPath::new(&rows.collect::<Vec<_>>()).unwrap()
}

/// A spline of the fourth order: with half the time between rows, errors of a sixteenth, between the
/// first two rows as well.
#[test]
fn a_sampled_hyperbola_is_constant_acceleration() {
    let acceleration = DVec3::new(0.3, 0.4, 0.0);
    let push = [Piece { of: acceleration, from: -9.0, to: 9.0 }];
    let exact = WorldLine::accelerated(DVec3::ZERO, Velocity::ZERO, &push, &[]).unwrap();
    let worst = |n: u32| {
        let rows = (0..=n).map(|k| {
            let t = 16.0 * f64::from(k) / f64::from(n) - 8.0;
            HyperbolicMotion { acceleration }.event(libm::asinh(0.5 * t) / 0.5)
        });
        let line = WorldLine::along(DVec3::ZERO, table(rows), &[]).unwrap();
        let mut worst = 0.0_f64;
        for step in 0..97 {
            let observer = Event { t: 1.0 + f64::from(step) / 23.0, x: DVec3::new(0.7, -0.9, 1.0) };
            let [found, expected] =
                [&line, &exact].map(|line| line.emission(DVec3::ZERO, observer).unwrap());
            assert!(expected.event.t.abs() < 4.0, "{expected:?}");
            worst = worst.max((found.event.x - expected.event.x).length());
            let velocity = (found.velocity.beta() - expected.velocity.beta()).length();
            assert!(
                velocity < 40.0 / (f64::from(n) * f64::from(n) * f64::from(n)),
                "{n}: {velocity:e}"
            );
        }
        worst
    };
    let at_begin = |n: u32| {
        let time = |k: f64| 2.0 * k / f64::from(n) - 1.0;
        let event = |t: f64| HyperbolicMotion { acceleration }.event(libm::asinh(0.5 * t) / 0.5);
        let line =
            WorldLine::along(DVec3::ZERO, table((0..=n).map(|k| event(time(f64::from(k))))), &[])
                .unwrap();
        let error = |k: u32| {
            // Seen from its own place.
            let expected = event(time(f64::from(k) / 8.0));
            (line.emission(DVec3::ZERO, expected).unwrap().event.x - expected.x).length()
        };
        (1..8).map(error).fold(0.0, f64::max)
    };
    let [coarse, fine] = [20, 40].map(at_begin);
    assert!(fine < 1e-6 && coarse > 12.0 * fine, "{coarse:e} {fine:e}");
    let [coarse, fine] = [160, 320].map(worst);
    assert!(fine < 1e-7 && (12.0..20.0).contains(&(coarse / fine)), "{coarse:e} {fine:e}");
}

/// A table on a straight line is constant velocity, to rounding.
#[test]
fn a_straight_table_is_inertial() {
    let (velocity, start) = (DVec3::new(0.3, -0.4, 0.6), DVec3::new(5.0, 1.0, -2.0));
    let times = [-2.0, -1.7, 0.9, 1.0, 6.0, 6.5];
    let rows = times.map(|t| Event { t, x: start + (t + 2.0) * velocity });
    let at = DVec3::new(1.0, 2.0, 3.0);
    let line = WorldLine::along(at, SampledPath::new(&rows).unwrap(), &[]).unwrap();
    let inertial = WorldLine::inertial(InertialFrame::new(Velocity::from_beta(velocity).unwrap()));
    let shift = rows[0] - inertial.event(at, 0.0).unwrap();
    for step in -40..40 {
        let own_time = 0.25 * f64::from(step);
        let point = DVec3::new(0.3, libm::sin(own_time), -4.0);
        let [found, expected] = [&line, &inertial].map(|line| line.event(point, own_time).unwrap());
        let error = found - expected - shift;
        assert!(error.t.abs() < 1e-13 && error.x.length() < 1e-13, "{own_time}: {error:?}");
        let (point, own_time) = line.at_event(found).unwrap();
        assert!(line.velocity(point, own_time).unwrap().beta().abs_diff_eq(velocity, 1e-13));
    }
}

/// On a finely sampled circle the axes turn as on an orbit.  Eq. (P44)
#[test]
fn axes_on_a_sampled_circle_turn_back() {
    let exact = WorldLine::orbiting(3.0 * DVec3::X, DVec3::ZERO, DVec3::Z, 0.3, &[]).unwrap();
    let gamma = 1.0 / (1.0 - 0.81f64).sqrt();
    let rows = (-400..1600).map(|k| exact.event(3.0 * DVec3::X, f64::from(k) / 100.0).unwrap());
    let line = WorldLine::along(3.0 * DVec3::X, table(rows), &[]).unwrap();
    let round = std::f64::consts::TAU / (0.3 * gamma);
    let start = exact.event(3.0 * DVec3::X, 0.0).unwrap();
    let begin = line.at_event(start).unwrap().1;
    let [first, last] = [begin, begin + round].map(|own_time| line.pose(own_time));
    assert!(
        (last.event.x - first.event.x).length() < 1e-9 && (first.event - start).x.length() < 1e-9
    );
    let x = (first.scene_from_axes.inverse() * last.scene_from_axes)
        .apply(Event { t: 0.0, x: DVec3::X })
        .x;
    // The axes have turned before, but in the same plane.
    let angle = libm::atan2(x.y, x.x);
    assert!((angle + 1.8482450685542).abs() < 1e-8, "{angle}");
}

#[test]
fn impossible_paths_are_refused() {
    let check = |rows: &[(f64, f64)], expected: Error| {
        let rows: Vec<Event> = rows.iter().map(|&(t, x)| Event { t, x: DVec3::Y * x }).collect();
        assert_eq!(SampledPath::new(&rows).unwrap_err(), expected);
    };
    check(&[(0.0, 0.0)], Error::FewEvents);
    check(&[(0.0, 0.0), (1.0, 0.5), (1.0, 0.6)], Error::TimeOrder { row: 1 });
    check(&[(0.0, f64::NAN), (1.0, 0.5)], Error::NotFinite);
    check(&[(-1e308, 0.0), (1e308, 0.5)], Error::NotFinite);
    check(&[(0.0, 0.0), (1.0, 1.0)], Error::TooFast { row: 0 });
    check(&[(0.0, 0.0), (1.0, 0.1), (2.0, 1.2), (3.0, 1.3)], Error::TooFast { row: 0 });
    // Slower than light on average, but not at the rows.
    check(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.95), (3.0, 0.95)], Error::TooFast { row: 0 });
    // Slower than light at the rows, but not between them.
    check(
        &[(0.0, 0.0), (1.0, 0.25), (2.0, 0.5), (3.0, 1.42), (4.0, 1.67), (5.0, 1.92)],
        Error::TooFast { row: 2 },
    );
    // A single cubic, fastest at its ends: 7/6 of the last place.
    let parabola = |speed: f64| {
        let rows = [(0.0, 0.0), (1.0, 0.0), (2.0, 6.0 / 7.0 * speed), (3.0, 6.0 / 7.0 * speed)];
        let rows = rows.map(|(t, x)| Event { t, x: DVec3::Y * x });
        SampledPath::new(&rows)
    };
    assert!(parabola(1.0 - 1e-9).is_ok());
    assert_eq!(parabola(1.0 + 1e-12).unwrap_err(), Error::TooFast { row: 0 });
}
