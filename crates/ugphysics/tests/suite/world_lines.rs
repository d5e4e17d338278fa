//! World lines: laws. Published numbers are in `numbers.rs`.

use glam::DVec3;
use ugphysics::{
    Event, InertialFrame, Lorentz, Piece, SampledPath, Velocity, WorldLine, doppler_at,
};

pub const ALWAYS: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

pub fn piece(of: [f64; 3], [from, to]: [f64; 2]) -> Piece {
    Piece { of: of.into(), from, to }
}

pub fn moving(at: [f64; 3], beta: [f64; 3], accelerations: &[Piece], spins: &[Piece]) -> WorldLine {
    let velocity = Velocity::from_beta(beta.into()).unwrap();
    WorldLine::accelerated(at.into(), velocity, accelerations, spins).unwrap()
}

/// A trip there and back.
#[test]
fn twins_meet_again() {
    let push = [0.3, 0.0, 0.0];
    let pull = [-0.3, 0.0, 0.0];
    let trip = moving(
        [0.0; 3],
        [0.0; 3],
        &[piece(push, [0.0, 2.0]), piece(pull, [2.0, 6.0]), piece(push, [6.0, 8.0])],
        &[],
    );
    let home = trip.pose(8.0);
    assert!(home.event.x.length() < 1e-14 && (home.event.t - 8.4887144286432).abs() < 1e-12);
    assert!(home.scene_from_axes.velocity_of_frame().unwrap().speed() < 1e-15);
}

/// Frames in frames: their axes are the product of the matrices of each, however often they are
/// nested, in whatever directions they move and turn; and the event of A at own time 0 is that of
/// the products, too.
#[test]
fn nested_frames_are_products_of_matrices() {
    let frame = |beta: [f64; 3], turn: [f64; 3]| {
        let velocity = Velocity::from_beta(beta.into()).unwrap();
        let shift = Event { t: 0.3, x: DVec3::new(0.1, -2.0, 0.4) };
        InertialFrame { turn: turn.into(), shift, ..InertialFrame::new(velocity) }
    };
    let flat = [0.0; 3];
    let all = [
        frame([0.5, 0.0, 0.0], flat),
        frame([0.0, 0.4, 0.0], flat),
        frame([0.0, 0.1, 0.6], [0.3, -0.2, 0.1]),
        frame([-0.7, 0.3, 0.2], [-1.0, 0.4, 2.0]),
        frame([0.9, 0.1, -0.1], flat),
    ];
    let entries = |axes: Lorentz| axes.matrix().to_cols_array();
    let mut n_compared = 0;
    for first in 0..all.len() {
        let mut nested = all[first];
        let (mut axes, mut start) = (all[first].axes(), all[first].start());
        let mut gamma = all[first].velocity.gamma();
        for next in (0..all.len()).filter(|&next| next != first) {
            nested = nested.carrying(&all[next]).unwrap();
            start = start + axes.apply(all[next].start());
            axes = axes * all[next].axes();
            gamma *= all[next].velocity.gamma();
            let pairs = entries(nested.axes()).into_iter().zip(entries(axes));
            let worst = pairs.map(|(one, other)| (one - other).abs()).fold(0.0, f64::max);
            // Velocities in texts are rounded to 17 digits; each boost magnifies that by its γ,
            // there and back.
            assert!(worst < 1e-14 * gamma * gamma, "{first} {next}: {worst:e}, γ {gamma}");
            let got = nested.start();
            let off = (got.x - start.x).length() + (got.t - start.t).abs();
            assert!(off < 1e-13 * gamma * gamma, "{first} {next}: {off:e}");
            n_compared += 1;
        }
    }
    assert_eq!(n_compared, 20);
}

/// Thomas precession: the axes turn by −2π(γ − 1) a revolution.
#[test]
fn axes_on_an_orbit_turn_back() {
    let line = WorldLine::orbiting(3.0 * DVec3::X, DVec3::ZERO, DVec3::Z, 0.3, &[]).unwrap();
    let gamma = 1.0 / (1.0 - 0.81f64).sqrt();
    let round = std::f64::consts::TAU / (0.3 * gamma);
    let [start, end] = [0.0, round].map(|own_time| line.pose(own_time).scene_from_axes);
    let turn = start.inverse() * end;
    let x = turn.apply(Event { t: 0.0, x: DVec3::X }).x;
    let angle = libm::atan2(x.y, x.x);
    assert!(
        (gamma - 2.294157338706).abs() < 1e-12 && (angle + 1.8482450685542).abs() < 1e-11,
        "{angle}"
    );
}

/// A stretch of acceleration in two pieces is the same stretch, and light leaves on the light cone
/// of the observer.
#[test]
fn pieces_join_without_a_trace() {
    let (at, beta) = ([0.3, -1.0, 0.2], [0.1, 0.2, -0.4]);
    let (push, spin) = ([0.2, -0.1, 0.3], [0.05, 0.1, -0.02]);
    let whole = moving(at, beta, &[piece(push, [-3.0, 5.0])], &[piece(spin, [-1.0, 9.0])]);
    let halves = moving(
        at,
        beta,
        &[piece(push, [1.0, 5.0]), piece(push, [-3.0, 1.0])],
        &[piece(spin, [-1.0, -0.5]), piece(spin, [-0.5, 4.0]), piece(spin, [4.0, 9.0])],
    );
    for step in -40..40 {
        let observer = Event { t: f64::from(step), x: DVec3::new(1.0, -2.0, 3.0) };
        let point = DVec3::new(0.5, -0.2, 0.1);
        let [one, other] = [&whole, &halves].map(|line| line.emission(point, observer).unwrap());
        assert!((one.own_time - other.own_time).abs() < 1e-12 * one.own_time.abs().max(1.0));
        assert!((one.velocity.beta() - other.velocity.beta()).length() < 1e-12);
        let way = observer.x - one.event.x;
        assert!((observer.t - one.event.t - way.length()).abs() < 1e-12 * way.length().max(1.0));
    }
}

/// Without acceleration and spin a motion is inertial, and sees what (P3) says.
#[test]
fn nothing_is_inertial() {
    let velocity = Velocity::from_beta(DVec3::new(0.3, -0.4, 0.5)).unwrap();
    let none = piece([0.0; 3], [0.0, 1.0]);
    let line = WorldLine::accelerated(DVec3::ZERO, velocity, &[none], &[none]).unwrap();
    assert_eq!(line, WorldLine::inertial(InertialFrame::new(velocity)));
    let point = DVec3::new(4.0, 1.0, -2.0);
    let seen = line.emission(point, Event { t: 0.0, x: DVec3::ZERO }).unwrap();
    assert!((seen.event.x - ugphysics::seen_position(point, velocity)).length() < 1e-14);
}

/// Points of a body without spin keep their distances in every momentary rest frame, and move with
/// the velocity of the axes; normals of a spinning body are perpendicular to the surface as it
/// moves.
#[test]
fn normals_are_perpendicular_to_the_motion_of_the_surface() {
    let line = moving(
        [1.0, 0.0, 0.0],
        [0.0, 0.3, 0.0],
        &[piece([0.2, 0.0, 0.1], ALWAYS_TO_TEN)],
        &[piece([0.1, 0.2, -0.3], ALWAYS)],
    );
    let (point, normal) = (DVec3::new(1.5, 0.8, -0.4), DVec3::new(0.36, 0.48, 0.8));
    let [first, second] = normal.any_orthonormal_pair().into();
    for own_time in [-2.0, 0.0, 3.0] {
        let element = line.element(point, own_time);
        let found = element.normal(normal);
        assert!((found.length() - 1.0).abs() < 1e-14);
        let h = 1e-6;
        let difference = |plus: Event, minus: Event| Event {
            t: (plus.t - minus.t) / (2.0 * h),
            x: (plus.x - minus.x) / (2.0 * h),
        };
        let along = |d: DVec3| {
            difference(
                line.event(point + h * d, own_time).unwrap(),
                line.event(point - h * d, own_time).unwrap(),
            )
        };
        let rate = difference(
            line.event(point, own_time + h).unwrap(),
            line.event(point, own_time - h).unwrap(),
        );
        let velocity = Velocity::from_beta(rate.x / rate.t).unwrap();
        let to_element = Lorentz::boost(velocity).inverse();
        for direction in [first, second] {
            let tangent = to_element.apply(along(direction)).x;
            // At rest with the element, tangents at one time lie in the surface.
            assert!(found.dot(tangent).abs() < 1e-8, "{own_time}: {found} {tangent}");
            assert!(element.line(direction).distance(tangent) < 1e-8, "{own_time}: {tangent}");
        }
    }
}

const ALWAYS_TO_TEN: [f64; 2] = [f64::NEG_INFINITY, 10.0];

#[test]
fn impossible_motions_are_refused() {
    use ugphysics::WorldLineError as Error;
    let refused = |accelerations: &[Piece], spins: &[Piece]| {
        WorldLine::accelerated(DVec3::ZERO, Velocity::ZERO, accelerations, spins).unwrap_err()
    };
    let x = [1.0, 0.0, 0.0];
    assert_eq!(refused(&[piece(x, [2.0, 1.0])], &[]), Error::EmptyPiece { piece: [2.0, 1.0] });
    assert_eq!(
        refused(&[piece(x, [0.0, 2.0]), piece(x, [1.0, 3.0])], &[]),
        Error::Overlap { from: 1.0 }
    );
    assert_eq!(refused(&[piece([f64::NAN, 0.0, 0.0], [0.0, 1.0])], &[]), Error::NotFinite);
    assert!(matches!(refused(&[piece(x, [0.0, 1e6])], &[]), Error::TooLong { .. }));
    let observer = Event { t: 0.0, x: DVec3::ZERO };
    let disc = moving([0.0; 3], [0.0; 3], &[], &[piece([0.0, 0.0, 0.5], ALWAYS)]);
    assert!(matches!(disc.emission(2.0 * DVec3::X, observer), Err(Error::Horizon { .. })));
    let ship = moving([0.0; 3], [0.0; 3], &[piece(x, [0.0, 1.0])], &[]);
    assert!(matches!(
        ship.emission(-DVec3::X, Event { t: 1.5, x: DVec3::ZERO }),
        Err(Error::Horizon { .. })
    ));
    let orbit = |at, center, axis, rate| WorldLine::orbiting(at, center, axis, rate, &[]);
    assert!(matches!(orbit(DVec3::X, DVec3::ZERO, DVec3::Z, 1.0), Err(Error::Velocity(_))));
    assert_eq!(orbit(DVec3::X, DVec3::ZERO, DVec3::ZERO, 0.5), Err(Error::NoAxis));
    // Times whose rounding error is a visible angle.
    assert_eq!(disc.check_turn(-1.9e12), Ok(()));
    assert_eq!(disc.check_turn(-2.1e12), Err(Error::ManyTurns { own_time: -2.1e12 }));
    assert_eq!(disc.check_turn(f64::NAN), Err(Error::NotFinite));
    assert_eq!(disc.check_turn(f64::NEG_INFINITY), Err(Error::NotFinite));
    let far = Event { t: 3e12, x: DVec3::ZERO };
    assert!(matches!(disc.check_turn_seen(far), Err(Error::ManyTurns { .. })));
    assert_eq!(ship.check_turn_seen(far), Ok(()));
    // Finite numbers whose products overflow.
    assert_eq!(orbit(DVec3::X * 1e308, -1e308 * DVec3::X, DVec3::Z, 2.0), Err(Error::NotFinite));
    assert_eq!(refused(&[piece([1e308, 0.0, 0.0], [-3.0, -1.0])], &[]), Error::NotFinite);
}

/// Motions of every kind, and points of them before every horizon.
fn motions() -> Vec<WorldLine> {
    let push = [piece([0.3, 0.0, 0.1], [-2.0, 1.5]), piece([0.0, -0.2, 0.0], [2.0, 6.0])];
    let spin = [piece([0.1, 0.2, 0.05], ALWAYS)];
    let center = DVec3::new(-3.0, 1.0, 0.0);
    let pushed = moving([0.1, 0.2, 0.3], [0.2, 0.3, -0.1], &push, &[]);
    let both = moving([0.1, 0.2, 0.3], [0.2, 0.3, -0.1], &push, &spin);
    let wheel =
        both.with_part(DVec3::new(0.5, 0.4, 0.0), &[piece([0.0, 0.3, 0.0], [0.0, 9.0])]).unwrap();
    let moon =
        WorldLine::orbiting(0.2 * DVec3::X, center, DVec3::new(0.1, 0.2, 1.0), 0.2, &spin).unwrap();
    vec![
        pushed,
        both,
        wheel,
        moon.clone(),
        moon.with_part(DVec3::new(0.5, 0.0, 0.0), &[piece([0.2, 0.0, 0.0], ALWAYS)]).unwrap(),
        moving([0.0; 3], [0.5, 0.0, 0.0], &[], &spin),
        WorldLine::along(DVec3::X * 0.1, curve(), &[]).unwrap(),
        WorldLine::along(DVec3::X * 0.1, curve(), &spin).unwrap(),
        WorldLine::inertial(InertialFrame::new(
            Velocity::from_beta(DVec3::new(0.3, 0.2, 0.1)).unwrap(),
        )),
    ]
}

/// A path with an acceleration of 0.5 at most.
fn curve() -> SampledPath {
    let row = |k: i32| {
        let t = f64::from(k) * 1.5 - 4.0 + 0.3 * f64::from(k % 2);
        let x = DVec3::new(0.3 * t + libm::sin(0.5 * t), libm::cos(0.4 * t), 0.2 * t);
        Event { t, x }
    };
    SampledPath::new(&(0..9).map(row).collect::<Vec<_>>()).unwrap()
}

fn points() -> impl Iterator<Item = DVec3> {
    (0..20).map(|k| {
        let k = f64::from(k);
        DVec3::new(0.6 * libm::sin(k), 0.6 * libm::cos(2.0 * k), 0.6 * libm::sin(3.0 * k + 1.0))
    })
}

/// An event on a body leads back to its point and own time.
#[test]
fn events_are_of_the_points_that_are_there() {
    for motion in motions() {
        points().for_each(|point| motion.check(point).unwrap());
        for (point, own_time) in points().zip((-10..10).map(f64::from)) {
            let event = motion.event(point, own_time).unwrap();
            let (point_there, time) = motion.at_event(event).unwrap();
            let velocity = motion.velocity(point, own_time).unwrap();
            let scale = 1.0 + event.t.abs();
            assert!((time - own_time).abs() < 1e-13 * scale, "{time} {own_time}");
            assert!((point_there - point).length() < 1e-13 * scale, "{point_there} {point}");
            let seen = motion
                .emission(point, Event { t: event.t + 5.0, x: event.x + 5.0 * DVec3::Y })
                .unwrap();
            assert!((seen.own_time - own_time).abs() < 1e-12 * scale);
            // A spin begins and ends with a jerk.
            if [-2.0, 0.0, 1.5, 2.0, 6.0, 9.0].contains(&own_time) {
                continue;
            }
            assert!((seen.velocity.beta() - velocity.beta()).length() < 1e-12);
            // The velocity is the derivative of the event.
            let [early, late] =
                [-1e-5, 1e-5].map(|step| motion.event(point, own_time + step).unwrap());
            let slope = (late.x - early.x) / (late.t - early.t);
            assert!((velocity.beta() - slope).length() < 1e-8, "{slope}");
        }
    }
}

/// A change of frame changes coordinates, not what is seen.
#[test]
fn what_is_seen_does_not_depend_on_the_frame() {
    let velocity = Velocity::from_beta(DVec3::new(-0.3, 0.5, 0.2)).unwrap();
    let frame = Lorentz::boost(velocity).inverse();
    let origin = Event { t: 2.0, x: DVec3::new(1.0, -3.0, 0.5) };
    let there = |event: Event| frame.apply(event - origin);
    for motion in motions() {
        let moved = motion.in_frame(frame, origin);
        let twice = moved.in_frame(frame.inverse(), there(Event { t: 0.0, x: DVec3::ZERO }));
        for point in points() {
            let observer = Event { t: 3.0, x: DVec3::new(0.0, -4.0, 1.0) };
            let seen = motion.emission(point, observer).unwrap();
            let again = moved.emission(point, there(observer)).unwrap();
            assert!((again.own_time - seen.own_time).abs() < 1e-12 * (1.0 + seen.own_time.abs()));
            let event = there(seen.event);
            assert!((again.event.x - event.x).length() < 1e-12 * (1.0 + event.t.abs()));
            let composed = ugphysics::compose(seen.velocity, -velocity);
            assert!((again.velocity.beta() - composed.beta()).length() < 1e-13);
            let back = twice.emission(point, observer).unwrap();
            assert!((back.event.x - seen.event.x).length() < 1e-11 * (1.0 + seen.event.t.abs()));
        }
    }
}

/// A part that does not spin is the body; a wheel that turns with its car is part of it.
#[test]
fn parts_move_with_their_body() {
    let car =
        moving([0.1, 0.2, 0.3], [0.2, 0.3, -0.1], &[piece([0.3, 0.0, 0.1], [-2.0, 1.5])], &[]);
    assert_eq!(car.with_part(DVec3::X, &[]).unwrap(), car);
    let wheel = car.with_part(DVec3::X, &[piece([0.0, 0.0, 0.5], [0.0, 4.0])]).unwrap();
    let hub = wheel.event(DVec3::X, 3.0).unwrap();
    assert_eq!(hub, car.event(DVec3::X, 3.0).unwrap());
    let rim = wheel.event(DVec3::X + DVec3::Y, 3.0).unwrap();
    let turned = DVec3::X + DVec3::new(-libm::sin(1.5), libm::cos(1.5), 0.0);
    let same = car.event(turned, 3.0).unwrap();
    assert!((rim.x - same.x).length() < 1e-14 && (rim.t - same.t).abs() < 1e-14);
}

#[test]
fn the_rim_of_a_spin_and_the_horizon_of_an_acceleration_are_limits() {
    let always = |of: DVec3| piece(of.into(), ALWAYS);
    let spin =
        WorldLine::accelerated(DVec3::X, Velocity::ZERO, &[], &[always(DVec3::Z * 0.5)]).unwrap();
    assert_eq!(spin.check(DVec3::new(2.999, 0.0, 7.0)), Ok(()));
    assert!(spin.check(DVec3::new(3.0, 0.0, 0.0)).is_err());
    let push = Piece { of: DVec3::X * 0.25, from: 1.0, to: 2.0 };
    let pushed = WorldLine::accelerated(DVec3::ZERO, Velocity::ZERO, &[push], &[]).unwrap();
    assert_eq!(pushed.check(DVec3::new(-3.999, 9.0, 9.0)), Ok(()));
    let error = pushed.check(DVec3::new(-4.0, 0.0, 0.0)).unwrap_err();
    assert_eq!(error, ugphysics::WorldLineError::Horizon { own_time: 1.5 });
    // Together: 1 + a·ξ of a point that turns into the horizon.
    let both = WorldLine::accelerated(
        DVec3::ZERO,
        Velocity::ZERO,
        &[always(DVec3::X * 0.25)],
        &[always(DVec3::Z * 0.1)],
    );
    assert!(both.unwrap().check(DVec3::new(0.0, 3.0, 0.0)).is_err());
    // A wheel on the disc that turns against it keeps its directions; one that turns with it
    // reaches 0.5 + |arm|.
    let wheel = |rate: f64| spin.with_part(DVec3::X * 2.0, &[always(DVec3::Z * rate)]).unwrap();
    assert_eq!(wheel(-0.5).check(DVec3::X * 9.0), Ok(()));
    assert_eq!(wheel(0.5).check(DVec3::X * 2.4), Ok(()));
    assert!(wheel(0.5).check(DVec3::X * 2.6).is_err());
}

/// A ship that leaves with a proper acceleration of 1 is seen from its start, at the time T, with D
/// = 1/(T + 1); one that brakes has D = 1/(1 − T) where it will stop. From the place where it is
/// seen, D is found up to the rounding of that place, which grows by γ².  Eq. (P45)
#[test]
fn doppler_factors_are_found_from_places_at_every_rapidity() {
    let whole = moving([0.0; 3], [0.0; 3], &[piece([1.0, 0.0, 0.0], ALWAYS)], &[]);
    let cut = |begins: &[f64]| {
        let pieces: Vec<Piece> =
            begins.windows(2).map(|ends| piece([1.0, 0.0, 0.0], [ends[0], ends[1]])).collect();
        moving([0.0; 3], [0.0; 3], &pieces, &[])
    };
    let two = cut(&[-50.0, -25.0, 0.0, 25.0, 50.0]);
    let many: Vec<f64> = (-200..=200).map(|k| f64::from(k) / 4.0).collect();
    // Turned into the y axis, with an origin elsewhere, in a frame in motion.
    let turn = Lorentz::rotation(glam::DQuat::from_rotation_arc(DVec3::X, DVec3::Y));
    let shift = Event { t: 1.0, x: DVec3::new(2.0, -1.0, 0.5) };
    for (row, line) in
        [whole.clone(), two, cut(&many), whole.in_frame(turn, shift)].into_iter().enumerate()
    {
        let start = line.pose(0.0).event;
        let ahead = line.pose(0.0).scene_from_axes.apply(Event { t: 0.0, x: DVec3::X }).x;
        for gap in [0.5, 1.0, 2.0, 60.0, 71.0, 81.0, 101.0, 1e3, 1e5, 1e7, 1e8] {
            for is_leaving in [true, false] {
                // At the rapidity η of either sign, t = sinh η and x = cosh η − 1.
                let time = if is_leaving { gap - 1.0 } else { 1.0 / gap - 1.0 };
                let observer = Event { t: start.t + time, x: start.x };
                let light = line.light(DVec3::ZERO, observer).unwrap();
                let exact = 1.0 / (time + 1.0);
                let rounding = 1e-12 + 1e-15 * gap * gap;
                let close = |doppler: f64, allowed: f64| (doppler / exact - 1.0).abs() <= allowed;
                let of_time = if is_leaving { 1e-13 } else { rounding };
                assert!(
                    close(1.0 / light.inverse_doppler, of_time),
                    "{row} {gap} {is_leaving} {light:?}"
                );
                let way = light.event.x - observer.x;
                let on_cone = observer + Event { t: -way.length(), x: way };
                let Ok((point, own_time)) = line.at_event(on_cone) else {
                    panic!("{row} {gap} {light:?}")
                };
                let doppler = doppler_at(way, line.velocity(point, own_time).unwrap());
                assert!(close(doppler, rounding), "{row} {gap} {is_leaving}: {doppler} {exact}");
                assert!(way.dot(ahead) >= 0.0 && own_time.abs() < 50.0);
            }
        }
    }
}

/// The own time at an event's time in the frame of the scene is that of the world line there,
/// whatever the place of the event and the frame that both are given in.
#[test]
fn own_times_at_a_time_of_the_scene() {
    let camera = Velocity::from_beta(DVec3::new(-0.3, 0.2, 0.6)).unwrap();
    let origin = Event { t: 3.0, x: DVec3::new(1.0, 2.0, -4.0) };
    for line in motions() {
        for own_time in [-30.0, -3.0, 0.0, 0.7, 5.0, 40.0] {
            let at = line.pose(own_time).event;
            for offset in [DVec3::ZERO, DVec3::new(3.0, -500.0, 20.0)] {
                let event = Event { t: at.t, x: at.x + offset };
                let found = line.own_time_when(event, Lorentz::IDENTITY);
                assert!(
                    (found - own_time).abs() < 1e-12 * (1.0 + at.t.abs()),
                    "{found} {own_time}"
                );
                let frame = Lorentz::boost(camera);
                let seen = line.in_frame(frame.inverse(), origin);
                let found = seen.own_time_when(frame.inverse().apply(event - origin), frame);
                assert!(
                    (found - own_time).abs() < 1e-11 * (1.0 + at.t.abs()),
                    "{found} {own_time}"
                );
            }
        }
    }
}

/// Where a point is at a time of the scene: the inverse of its event at an own time.
#[test]
fn points_are_where_they_are_at_a_time() {
    let line = moving(
        [0.5, -1.0, 0.25],
        [0.3, 0.1, -0.2],
        &[piece([0.2, 0.1, 0.0], [-1.0, 3.0])],
        &[piece([0.0, 0.3, 0.1], ALWAYS)],
    );
    for point in [[0.5, -1.0, 0.25], [1.0, -1.5, 0.0], [-0.5, -0.5, 1.0]].map(DVec3::from) {
        for own_time in [-20.0, -0.9, 0.0, 0.4, 2.9, 30.0] {
            let event = line.event(point, own_time).unwrap();
            let found = line.at_time(point, event.t).unwrap();
            let off = (found.own_time - own_time).abs() / own_time.abs().max(1.0);
            let away = (found.event.x - event.x).length() / event.x.length().max(1.0);
            let velocity = line.velocity(point, own_time).unwrap().beta();
            let change = (found.velocity.beta() - velocity).length();
            assert_eq!(found.event.t, event.t);
            assert!(off < 1e-12 && away < 1e-11 && change < 1e-10, "{off} {away} {change}");
        }
    }
}
