//! Points and edges of bodies on world lines.
//!
//! Their edges are seen as curves without a closed form. The error of an edge is sampled at three
//! points of it and multiplied by [`MARGIN`]: the largest error of a smooth arc is at its middle,
//! that of an S at about a quarter, and where the motion of the body changes between two samples,
//! the curve has a bend whose height the samples see two thirds of at least. Pieces that are halved
//! are sampled anew, so what the samples of a long edge miss, those of its halves find.

use glam::DVec3;

use crate::edge_errors::Errors;
use crate::relative_motion::{Point, RelativeMotion};

/// The factor on sampled errors.
const MARGIN: f64 = 1.5;

/// The factor on the errors at the middles of edges, for [`is_surely_right`].
const SURE_MARGIN: f64 = 4.0;

/// The error of own times after several operations, over that of their rounding.
const ROUNDINGS: f64 = 8.0;

/// Of larger pieces, [`is_surely_right`] says nothing: they have many diagonals.
const MOST_CORNERS: usize = 4;

/// The angle at the eye, in units of the bound of the outline, below which an edge is not halved for
/// its colours.
const BLUR: f64 = 4.0;

/// Where an edge is sampled: first where the error of most edges is largest.
const SAMPLES: [f64; 3] = [0.5, 0.25, 0.75];

/// True only if the errors of all edges between these corners, and inside, are below the bounds by
/// so much that the middles of the edges say so.
///
/// The errors of small pieces are quadratic: largest at the middle of an edge, and inside a
/// triangle 4/3 of the largest of those at most.
pub(crate) fn is_surely_right<'a>(
    corners: impl Iterator<Item = &'a Point> + Clone,
    motion: &RelativeMotion,
    bounds: Deviation,
) -> bool {
    let is_right = |a: &Point, b: &Point| {
        !deviation(a, b, &Point::between(motion, a, b, 0.5)).exceeds(bounds, SURE_MARGIN)
    };
    corners.clone().count() <= MOST_CORNERS
        && corners
            .clone()
            .enumerate()
            .all(|(row, a)| corners.clone().skip(row + 1).all(|b| is_right(a, b)))
}

/// Is an error of an edge above its bound?
///
/// The colours of short edges are not compared: where a spin begins or the acceleration of a spinning
/// body changes, D changes abruptly, and no subdivision makes linear interpolation right.
pub(crate) fn exceeds(a: &Point, b: &Point, motion: &RelativeMotion, bounds: Deviation) -> bool {
    let color = if is_short(a, b, bounds.tan_half) { f64::INFINITY } else { bounds.color };
    let bounds = Deviation { color, ..bounds };
    let bounds = bounds.above_rounding(a).above_rounding(b);
    SAMPLES
        .into_iter()
        .any(|s| deviation(a, b, &Point::between(motion, a, b, s)).exceeds(bounds, MARGIN))
        && !is_within_rounding(a, b)
}

/// Is the angle of an edge at the eye too small to halve it for its colours? `tan_half`: tangent of
/// half the bound of the outline.
pub(crate) fn is_short(a: &Point, b: &Point, tan_half: f64) -> bool {
    tan_half_angle(a.seen, b.seen, a.seen_distance * b.seen_distance) <= BLUR * tan_half
}

/// True for an edge so short that its errors are those of rounding, which no subdivision reduces:
/// own times are rounded, and events to a part of γ times the distance, which D multiplies once
/// more.
fn is_within_rounding(a: &Point, b: &Point) -> bool {
    let rounding = |point: &Point| {
        let shift = point.inverse_doppler.max(1.0 / point.inverse_doppler);
        f64::EPSILON * (point.own_time.abs() + shift * shift * point.rest.length())
    };
    (b.rest - a.rest).length() <= rounding(a).max(rounding(b))
}

/// The largest errors of an edge, sampled.
pub(crate) fn errors(a: &Point, b: &Point, motion: &RelativeMotion) -> Errors {
    let sampled = SAMPLES.map(|s| deviation(a, b, &Point::between(motion, a, b, s)));
    let largest =
        |error: fn(&Deviation) -> f64| MARGIN * sampled.iter().map(error).fold(0.0, f64::max);
    Errors {
        angle: 2.0 * libm::atan(largest(|sample| sample.tan_half)),
        offset: largest(|sample| sample.offset),
        color: largest(|sample| sample.color),
    }
}

/// How far a point of the true edge is from the chord that is drawn, or bounds of that.
#[derive(Clone, Copy)]
pub(crate) struct Deviation {
    /// Tangent of half the angle at the eye.
    pub tan_half: f64,
    /// Distance over that from the eye.
    pub offset: f64,
    /// Relative error of D or of 1/D.
    pub color: f64,
}

impl Deviation {
    /// The same bounds, at least as large as the errors of places by which own times are rounded.
    fn above_rounding(self, point: &Point) -> Self {
        let shift = 1.0_f64.max(1.0 / point.inverse_doppler);
        let error = ROUNDINGS * f64::EPSILON * point.own_time.abs() * shift / point.seen_distance;
        Self { tan_half: self.tan_half.max(error), offset: self.offset.max(error), ..self }
    }

    /// True if one of them times `margin` is above its bound; NaN is not.
    fn exceeds(self, bounds: Self, margin: f64) -> bool {
        margin * self.tan_half > bounds.tan_half
            || margin * self.offset > bounds.offset
            || margin * self.color > bounds.color
    }
}

fn deviation(a: &Point, b: &Point, true_point: &Point) -> Deviation {
    let chord = b.seen - a.seen;
    let place = true_point.seen;
    let along = (place - a.seen).dot(chord) / chord.length_squared();
    let along = if along.is_finite() { along.clamp(0.0, 1.0) } else { 0.0 };
    let off = place - (a.seen + along * chord);
    // Where the line of sight to the true point passes the chord.
    let beside = nearest_in_sight(a.seen, chord, place).unwrap_or(along);
    let drawn = a.seen + beside * chord;
    let tan_half = tan_half_angle(drawn, place, drawn.length() * true_point.seen_distance);
    let mix = |of: fn(&Point) -> f64| (1.0 - beside) * of(a) + beside * of(b);
    let inverse = mix(|point| point.inverse_doppler);
    let doppler = mix(|point| 1.0 / point.inverse_doppler);
    let of_inverse = (inverse / true_point.inverse_doppler - 1.0).abs();
    let of_doppler = (doppler * true_point.inverse_doppler - 1.0).abs();
    Deviation {
        tan_half,
        offset: off.length() / true_point.seen_distance,
        color: of_inverse.max(of_doppler),
    }
}

/// The tangent of half the angle x between two vectors, sin x/(1 + cos x). `product`: of their
/// lengths.
fn tan_half_angle(p: DVec3, q: DVec3, product: f64) -> f64 {
    p.cross(q).length() / (product + p.dot(q))
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
pub(crate) fn offset_inside(corners: [&Point; 3], motion: &RelativeMotion) -> f64 {
    let ([a, b, c], middle) = (corners, Point::middle(motion, corners));
    let normal = (b.seen - a.seen).cross(c.seen - a.seen).normalize_or_zero();
    MARGIN * normal.dot(middle.seen - a.seen).abs() / middle.seen_distance
}
