//! Points and edges of bodies on world lines.
//!
//! Their edges are seen as curves without a closed form. The error of an edge is sampled at three
//! points of it and multiplied by [`MARGIN`]: the largest error of a smooth arc is at its middle,
//! that of an S at about a quarter, and where the motion of the body changes between two samples,
//! the curve has a bend whose height the samples see two thirds of at least. Pieces that are halved
//! are sampled anew, so what the samples of a long edge miss, those of its halves find.

use glam::DVec3;
use ugphysics::WorldLine;

use crate::edge_errors::Errors;
use crate::relative_motion::Point;

/// The factor on sampled errors.
const MARGIN: f64 = 1.5;

/// Where an edge is sampled.
const SAMPLES: [f64; 3] = [0.25, 0.5, 0.75];

/// The largest errors of an edge, sampled.
pub(crate) fn errors(a: &Point, b: &Point, line: &WorldLine) -> Errors {
    let sampled =
        SAMPLES.map(|s| error_at(a, b, &Point::on_world_line(line, a.body, a.rest.lerp(b.rest, s))));
    let largest = |error: fn(&Errors) -> f64| MARGIN * sampled.iter().map(error).fold(0.0, f64::max);
    Errors {
        angle: largest(|errors| errors.angle).min(std::f64::consts::PI),
        offset: largest(|errors| errors.offset),
        color: largest(|errors| errors.color),
    }
}

/// How far a point of the true edge is from the chord that is drawn.
fn error_at(a: &Point, b: &Point, true_point: &Point) -> Errors {
    let chord = b.seen - a.seen;
    let place = true_point.seen;
    let along = (place - a.seen).dot(chord) / chord.length_squared();
    let along = if along.is_finite() { along.clamp(0.0, 1.0) } else { 0.0 };
    let off = place - (a.seen + along * chord);
    // Where the line of sight to the true point passes the chord.
    let beside = nearest_in_sight(a.seen, chord, place).unwrap_or(along);
    let drawn = a.seen + beside * chord;
    let angle = libm::atan2(drawn.cross(place).length(), drawn.dot(place));
    let mix = |of: fn(&Point) -> f64| (1.0 - beside) * of(a) + beside * of(b);
    let inverse = mix(|point| point.inverse_doppler);
    let doppler = mix(|point| 1.0 / point.inverse_doppler);
    let of_inverse = (inverse / true_point.inverse_doppler - 1.0).abs();
    let of_doppler = (doppler * true_point.inverse_doppler - 1.0).abs();
    Errors { angle, offset: off.length() / true_point.seen_distance, color: of_inverse.max(of_doppler) }
}

/// The part of the way along a chord at which it is nearest, in angle, to the direction of `place`.
fn nearest_in_sight(start: DVec3, chord: DVec3, place: DVec3) -> Option<f64> {
    let normal = start.cross(chord);
    let (at_start, change) = (start.cross(place).dot(normal), chord.cross(place).dot(normal));
    let part = -at_start / change;
    part.is_finite().then(|| part.clamp(0.0, 1.0))
}

/// The distance of the true face from the flat triangle at its middle, over the distance from the
/// eye.
pub(crate) fn offset_inside(corners: [&Point; 3], line: &WorldLine) -> f64 {
    let [a, b, c] = corners;
    let middle = Point::on_world_line(line, a.body, (a.rest + b.rest + c.rest) / 3.0);
    let normal = (b.seen - a.seen).cross(c.seen - a.seen).normalize_or_zero();
    MARGIN * normal.dot(middle.seen - a.seen).abs() / middle.seen_distance
}
