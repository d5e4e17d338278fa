//! Questions about bodies and cameras that accelerate, spin and orbit.

use glam::{DQuat, DVec3};
use ugphysics::{Event, Lorentz, Orbit, Piece, Velocity, WorldLine};

use super::numbers::{Answer, exactly, list, velocity};

pub const KINDS: &[(&str, Answer)] = &[
    ("accelerated", |given| {
        let [ax, ay, az, duration, px, py, pz, t, x, y, z] = exactly(given)?;
        let line = rocket([ax, ay, az], duration)?;
        seen(&line, DVec3::new(px, py, pz), [t, x, y, z])
    }),
    ("spinning", |given| {
        let [vx, vy, vz, wx, wy, wz, px, py, pz, t, x, y, z] = exactly(given)?;
        let spin = always([wx, wy, wz]);
        let velocity = velocity(DVec3::new(vx, vy, vz))?;
        let line = WorldLine::accelerated(DVec3::ZERO, velocity, &[], &[spin]).ok()?;
        seen(&line, DVec3::new(px, py, pz), [t, x, y, z])
    }),
    ("orbiting", |given| {
        let [radius, rate, px, py, pz, t, x, y, z] = exactly(given)?;
        let place = radius * DVec3::X;
        seen(&circle(radius, rate)?, place + DVec3::new(px, py, pz), [t, x, y, z])
    }),
    ("riding", |given| {
        let [ax, ay, az, bx, by, bz, wx, wy, wz, px, py, pz, t, x, y, z] = exactly(given)?;
        let carrier = rocket([ax, ay, az], f64::INFINITY)?;
        let line = carrier.with_part(DVec3::new(bx, by, bz), &[always([wx, wy, wz])]).ok()?;
        seen(&line, DVec3::new(px, py, pz), [t, x, y, z])
    }),
    ("accelerated_camera", |given| {
        let [ax, ay, az, own_time, px, py, pz] = exactly(given)?;
        let line = rocket([ax, ay, az], f64::INFINITY)?;
        seen_from(&line, DVec3::ZERO, own_time, DVec3::new(px, py, pz))
    }),
    ("orbiting_camera", |given| {
        let [radius, rate, own_time, px, py, pz] = exactly(given)?;
        seen_from(&circle(radius, rate)?, radius * DVec3::X, own_time, DVec3::new(px, py, pz))
    }),
    ("thomas", |given| {
        let [radius, rate] = exactly(given)?;
        Some(vec![precession(&circle(radius, rate)?, radius, rate)?.to_degrees()])
    }),
];

/// A body whose origin accelerates from rest, from its own time 0 to `duration`.
fn rocket([x, y, z]: [f64; 3], duration: f64) -> Option<WorldLine> {
    let piece = Piece { of: DVec3::new(x, y, z), from: 0.0, to: duration };
    WorldLine::accelerated(DVec3::ZERO, Velocity::ZERO, &[piece], &[]).ok()
}

fn always([x, y, z]: [f64; 3]) -> Piece {
    Piece { of: DVec3::new(x, y, z), from: f64::NEG_INFINITY, to: f64::INFINITY }
}

/// A body on a circle about the z axis, through (radius, 0, 0) at own time 0.
fn circle(radius: f64, rate: f64) -> Option<WorldLine> {
    WorldLine::orbiting(Orbit::new(radius * DVec3::X, DVec3::ZERO, DVec3::Z, rate).ok()?, &[]).ok()
}

/// Own time at emission, position relative to the eye, velocity at emission, and D.
fn seen(line: &WorldLine, point: DVec3, [t, x, y, z]: [f64; 4]) -> Option<Vec<f64>> {
    let eye = Event { t, x: DVec3::new(x, y, z) };
    let emission = line.emission(point, eye).ok()?;
    let place = emission.event.x - eye.x;
    let doppler = ugphysics::doppler_at(place, emission.velocity);
    let place = list(place, &emission.velocity.beta().to_array());
    Some([&[emission.own_time], &place[..], &[doppler]].concat())
}

/// Position, in the axes of a camera, of a point at rest, and D.
fn seen_from(line: &WorldLine, eye: DVec3, own_time: f64, point: DVec3) -> Option<Vec<f64>> {
    let event = line.event(eye, own_time).ok()?;
    let away = point - event.x;
    let sent = Event { t: -away.length(), x: away };
    let seen = line.frame(eye, own_time).inverse().apply(sent);
    Some(list(seen.x, &[seen.t / sent.t]))
}

/// The turn of the carried axes during a revolution, in steps of less than half a turn.
fn precession(line: &WorldLine, radius: f64, rate: f64) -> Option<f64> {
    let gamma = velocity(radius * rate * DVec3::Y)?.gamma();
    let n = libm::ceil(2.0 * gamma).clamp(1.0, 1e6);
    let revolution = core::f64::consts::TAU / (rate.abs() * gamma);
    let turn = |step: f64| -> Option<DQuat> {
        let frame = line.frame(radius * DVec3::X, revolution * step / n);
        Some((Lorentz::boost(frame.velocity_of_frame().ok()?).inverse() * frame).turn())
    };
    (0..n as u32).map(f64::from).map(|step| Some(about_z(turn(step + 1.0)? * turn(step)?.inverse()))).sum()
}

/// The angle of a rotation about the z axis, −π to π.
fn about_z(turn: DQuat) -> f64 {
    let (z, w) = if turn.w < 0.0 { (-turn.z, -turn.w) } else { (turn.z, turn.w) };
    2.0 * libm::atan2(z, w)
}
