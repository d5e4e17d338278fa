//! Questions about apparent positions, sizes and velocities.

use glam::DVec3;
use ugphysics::{
    Velocity, WaveVector, contracted, doppler_factor, elongated, flight_time, rest_position, seen_position,
};

use super::numbers::{Answer, along_x, angle, at, exactly, list, vectors, velocity};

pub const KINDS: &[(&str, Answer)] = &[
    ("retarded", |given| {
        let [p, u] = vectors(given)?;
        let (w, seen) = retarded(p, velocity(u)?);
        Some([&[w], &seen.to_array()[..]].concat())
    }),
    ("source_distances", |given| {
        let [p, u] = vectors(given)?;
        let v = velocity(u)?;
        let (_, seen) = retarded(p, v);
        Some(vec![seen.length(), rest_position(seen, v).length()])
    }),
    ("approach_speed", |given| Some(vec![seen_velocity(given, 0.0)?.length()])),
    ("recession_speed", |given| Some(vec![seen_velocity(given, 180.0)?.length()])),
    ("transverse_speed", |given| {
        let [speed, theta] = exactly(given)?;
        Some(vec![seen_velocity(&[speed], theta)?.reject_from_normalized(at(theta)).length()])
    }),
    ("transverse_speed_max", |given| {
        let [speed] = exactly(given)?;
        let theta = libm::acos(speed).to_degrees();
        let fastest = seen_velocity(given, theta)?.reject_from_normalized(at(theta));
        Some(vec![fastest.length(), theta])
    }),
    ("rod_approaching", |given| rod_end_on(given, -1.0)),
    ("rod_receding", |given| rod_end_on(given, 1.0)),
    ("rod_extent", |given| {
        let [speed, theta] = exactly(given)?;
        Some(vec![doppler_factor(at(theta), along_x(speed)?)])
    }),
    ("terrell", |given| {
        let [speed, theta] = exactly(given)?;
        let light = WaveVector::in_vacuum(1.0, at(theta));
        Some(vec![angle(light.in_frame(along_x(speed)?).k, DVec3::X) - theta])
    }),
    ("cube_abeam", |given| {
        let [speed] = exactly(given)?;
        let v = along_x(speed)?;
        // Light from the far end of the trailing side is emitted one unit of time before that from
        // its near end.
        Some(vec![contracted(DVec3::X, v).x, v.speed()])
    }),
    ("edge_x", |given| {
        let [speed, z, y] = exactly(given)?;
        Some(vec![edge_x(along_x(speed)?, z, y)])
    }),
    ("edge_chord_error", |given| {
        let [speed, z, half, n] = exactly(given)?;
        chord_error(along_x(speed)?, z, half, n).map(|error| vec![error])
    }),
    ("shadow", |given| {
        let [height, speed, camera] = exactly(given)?;
        let v = along_x(speed)?;
        let (_, plate) = retarded(DVec3::new(0.0, 0.0, height - camera), v);
        // Light passes the plate a time `height` before it reaches the ground, so the shadow lags
        // (P24).
        let (_, shadow) = retarded(DVec3::new(-speed * height, 0.0, -camera), v);
        Some(vec![plate.x, shadow.x])
    }),
    ("contracted_normal", |given| {
        let [normal, u] = vectors(given)?;
        Some(list(elongated(normal, velocity(u)?).normalize_or_zero(), &[]))
    }),
];

/// The emission time and the retarded position of a point that is now at `p`.
pub fn retarded(p: DVec3, v: Velocity) -> (f64, DVec3) {
    let w = flight_time(p, v);
    (w, p + w * v.beta())
}

fn seen_velocity(given: &[f64], theta: f64) -> Option<DVec3> {
    let [speed] = exactly(given)?;
    let v = along_x(speed)?;
    Some(v.proper() * doppler_factor(at(theta), v))
}

/// The apparent length of a rod on the line of motion, from 1 to 2 on the given side of the eye.
fn rod_end_on(given: &[f64], side: f64) -> Option<Vec<f64>> {
    let [speed] = exactly(given)?;
    let v = along_x(speed)?;
    let [near, far] = [1.0, 2.0].map(|x| seen_position(side * x * DVec3::X, v));
    Some(vec![near.distance(far)])
}

fn edge_x(v: Velocity, z: f64, y: f64) -> f64 {
    seen_position(DVec3::new(0.0, y, z), v).x
}

/// The greatest distance along the motion between the apparent edge over |y| ≤ `half` and `n`
/// chords of equal width in y.
fn chord_error(v: Velocity, z: f64, half: f64, n: f64) -> Option<f64> {
    if !(1.0..=1e6).contains(&n) {
        return None;
    }
    let width = 2.0 * half / n;
    let errors = (0..n as u32).map(|chord| {
        let y = -half + width * f64::from(chord);
        let (start, end) = (edge_x(v, z, y), edge_x(v, z, y + width));
        let slope = (end - start) / width;
        // The curve x = −|u| √(y² + z²) is farthest from its chord where its tangent is parallel to
        // it.
        let sine = -slope / v.proper_speed();
        let parallel = z * sine / (1.0 - sine * sine).sqrt();
        (edge_x(v, z, parallel) - (start + slope * (parallel - y))).abs()
    });
    Some(errors.fold(0.0, f64::max))
}
