//! Nearly all pieces of a fine mesh are right: one bound over their corners says so.

use crate::edge::{Tolerance, lengths_less_dot};
use crate::relative_motion::{Point, RelativeMotion};

/// √(4/3): the largest value of h √(4 − 3h²/r²)/r, see [`crate::color`].
pub(crate) const MOST_BEND: f64 = 1.154_700_538_379_251_7;

/// Corners no further from the first than the square root of this, in parts of the distance of the
/// nearest, are right for sure by [`is_right`]. Computed once for a body, it spares most of a fine
/// mesh the rest.
///
/// With R the reach and r the distance, as seen, rest coordinates change by e^η R at most, and are
/// r e^−η long at least, since e^±η are the extremes of D; directions differ by 2R/r at most, and
/// so 1/D by 2γβ R/r.
pub(crate) fn most_spread(motion: &RelativeMotion, tolerance: &Tolerance) -> f64 {
    let is_right = |spread: f64| {
        let (reach, least) = (spread.sqrt(), 1.0 / (motion.gamma() + motion.proper_speed()));
        let rest_reach = reach / least;
        let room = 2.0 * least - rest_reach;
        let delta = if room > 0.0 { rest_reach * rest_reach / room } else { f64::INFINITY };
        let floor = 1.0 - motion.gamma() * delta;
        let is_offset_right =
            floor > 0.0 && motion.proper_speed() * delta <= tolerance.safe * floor;
        let change = 2.0 * motion.proper_speed() * reach;
        is_offset_right && color_of(motion, change, least, spread, 1.0 - reach) <= tolerance.color
    };
    let spreads = std::iter::successors(Some(1.0), |spread| Some(spread / 2.0));
    spreads.take(N_SPREADS).find(|&spread| is_right(spread)).unwrap_or(0.0)
}

/// [`most_spread`] is not looked for below 2^−60: finer meshes have no more digits.
const N_SPREADS: usize = 60;

/// Are these corners as close to each other as [`most_spread`]?
pub(crate) fn is_close<'a>(mut corners: impl Iterator<Item = &'a Point>, spread: f64) -> bool {
    let Some(first) = corners.next() else { return true };
    let (mut reach2, mut nearest) = (0.0, first.seen_distance);
    for corner in corners {
        reach2 = f64::max(reach2, (corner.seen - first.seen).length_squared());
        nearest = f64::min(nearest, corner.seen_distance);
    }
    reach2 <= spread * (nearest * nearest)
}

/// True only if everything between these corners is right for sure: every line from one to another,
/// and the inside. All rules are upper bounds here, and looser than those for edges, which
/// therefore never contradict.
pub(crate) fn is_right<'a>(
    motion: &RelativeMotion,
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
pub(crate) fn offset<'a>(
    motion: &RelativeMotion,
    mut corners: impl Iterator<Item = &'a Point>,
) -> f64 {
    let Some(first) = corners.next() else { return 0.0 };
    let first_rest = motion.boosted_rest(first.rest);
    let (mut delta, mut floor) = (0.0, first.seen_distance);
    for corner in corners {
        let product = first.rest_distance * corner.rest_distance;
        let less = lengths_less_dot(first_rest, motion.boosted_rest(corner.rest), product)
            / first.rest_distance;
        delta = f64::max(delta, less);
        floor = f64::min(floor, corner.seen_distance - motion.gamma() * less);
    }
    // False for what is not a number, too.
    if floor > 0.0 { motion.proper_speed() * delta / floor } else { f64::INFINITY }
}

/// Upper bound of the error of D on any chord between the corners, by (E4).
fn color<'a>(motion: &RelativeMotion, mut corners: impl Iterator<Item = &'a Point>) -> f64 {
    let Some(first) = corners.next() else { return 0.0 };
    let (mut least, mut most) = (first.inverse_doppler, first.inverse_doppler);
    let (mut reach2, mut nearest) = (0.0, first.seen_distance);
    for corner in corners {
        least = f64::min(least, corner.inverse_doppler);
        most = f64::max(most, corner.inverse_doppler);
        reach2 = f64::max(reach2, (corner.seen - first.seen).length_squared());
        nearest = f64::min(nearest, corner.seen_distance);
    }
    // Chords are no longer than twice the reach, and no point of one is further than the reach from
    // an end.
    let r = nearest - reach2.sqrt();
    if r.is_nan() || r <= 0.0 {
        return f64::INFINITY;
    }
    color_of(motion, most - least, least, reach2, r)
}

/// (E4) for 1/D that changes by `change` from `least` on, on chords of twice a reach, `nearest` or
/// more from the eye.
fn color_of(motion: &RelativeMotion, change: f64, least: f64, reach2: f64, nearest: f64) -> f64 {
    let q = change * change / (4.0 * least * least);
    let x = motion.proper_speed() * MOST_BEND * 4.0 * reach2 / (8.0 * nearest * nearest * least);
    if x < 1.0 { q + (1.0 + q) * x / (1.0 - x) } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use ugphysics::Velocity;
    use ugscene::{BodyId, ShownEffects};

    use super::*;

    #[test]
    fn what_is_close_is_right() {
        let step = |k: u32, seed: f64| (f64::from(k) * seed).fract() * 2.0 - 1.0;
        let (mut n_close, mut n_far) = (0, 0);
        for k in 1..4000_u32 {
            let point = |p, q, r| DVec3::new(step(k, p), step(k, q), step(k, r));
            let speed = [0.1, 0.3, 0.7, 0.95][k as usize % 4];
            let motion = RelativeMotion::new(
                Velocity::from_beta(DVec3::new(0.6, 0.0, 0.8) * speed).unwrap(),
                ShownEffects::default(),
            );
            let size = libm::pow(10.0, -f64::from(k % 23) / 4.0);
            let a = point(0.618_034, 0.414_214, 0.732_051);
            let b = a + point(0.236_068, 0.645_751, 0.316_625) * size;
            let c = a + point(0.872_983, 0.123_106, 0.358_899) * size;
            let corners = [a, b, c].map(|p| Point::new(&motion, BodyId::from_index(0), p));
            for tolerance in [Tolerance::new(1e-4, 1.5e-3), Tolerance::new(1e-2, f64::INFINITY)] {
                if is_close(corners.iter(), most_spread(&motion, &tolerance)) {
                    n_close += 1;
                    assert!(is_right(&motion, corners.iter(), &tolerance), "{a} {b} {c} {speed}");
                } else {
                    n_far += 1;
                }
            }
        }
        assert!(n_close > 1000 && n_far > 1000, "{n_close} {n_far}");
    }
}
