//! Nearly all pieces of a fine mesh are right: one bound over their corners says so.

use crate::edge::{Tolerance, lengths_less_dot};
use crate::motion::{Motion, Point};

/// √(4/3): the largest value of h √(4 − 3h²/r²)/r, see [`crate::color`].
const MOST_BEND: f64 = 1.154_700_538_379_251_7;

/// True only if everything between these corners is right for sure: every line from one to another, and the
/// inside. All rules are upper bounds here, and looser than those for edges, which therefore never contradict.
pub(crate) fn is_right<'a>(
    motion: &Motion,
    corners: impl Iterator<Item = &'a Point> + Clone,
    tolerance: &Tolerance,
) -> bool {
    let is_color_right =
        tolerance.color == f64::INFINITY || color(motion, corners.clone()) <= tolerance.color;
    is_color_right && (!motion.has_flight_time() || offset(motion, corners) <= tolerance.safe)
}

/// Upper bound of |C − flat|/|C|, by (E5) with u towards the first corner.
///
/// |C| = γ(|p'| − v·p') is at least γ(u − v)·p', and that is linear: least in a corner.
pub(crate) fn offset<'a>(motion: &Motion, mut corners: impl Iterator<Item = &'a Point>) -> f64 {
    let Some(first) = corners.next() else { return 0.0 };
    let first_rest = motion.boosted_rest(first.rest);
    let (mut delta, mut floor) = (0.0, first.seen_distance);
    for corner in corners {
        let product = first.rest_distance * corner.rest_distance;
        let less =
            lengths_less_dot(first_rest, motion.boosted_rest(corner.rest), product) / first.rest_distance;
        delta = f64::max(delta, less);
        floor = f64::min(floor, corner.seen_distance - motion.gamma() * less);
    }
    // False for what is not a number, too.
    if floor > 0.0 { motion.proper_speed() * delta / floor } else { f64::INFINITY }
}

/// Upper bound of the error of D on any chord between the corners, by (E4).
fn color<'a>(motion: &Motion, mut corners: impl Iterator<Item = &'a Point>) -> f64 {
    let Some(first) = corners.next() else { return 0.0 };
    let (mut least, mut most) = (first.inverse_doppler, first.inverse_doppler);
    let (mut reach2, mut nearest) = (0.0, first.seen_distance);
    for corner in corners {
        least = f64::min(least, corner.inverse_doppler);
        most = f64::max(most, corner.inverse_doppler);
        reach2 = f64::max(reach2, (corner.seen - first.seen).length_squared());
        nearest = f64::min(nearest, corner.seen_distance);
    }
    // Chords are no longer than twice the reach, and no point of one is further than the reach from an end.
    let r = nearest - reach2.sqrt();
    if r.is_nan() || r <= 0.0 {
        return f64::INFINITY;
    }
    let change = most - least;
    let q = change * change / (4.0 * least * least);
    let x = motion.proper_speed() * MOST_BEND * 4.0 * reach2 / (8.0 * r * r * least);
    if x < 1.0 { q + (1.0 + q) * x / (1.0 - x) } else { f64::INFINITY }
}
