//! Tighter depth bounds for bodies that are far away compared with their size.

use glam::DVec3;

use crate::relative_motion::{Point, RelativeMotion};

/// Bodies further away than this many times their size get a tighter bound. Without a factor the
/// bound of depth is a ten-thousandth of the distance, so at this distance it is a thousandth of
/// the size.
const FAR: f64 = 10.0;

/// The smallest factor: renderers compare depths in single precision.
const MIN_FACTOR: f64 = 3e-3;

/// The factor of the depth bound of each body: [`FAR`] times its size over the distance of its
/// nearest vertex, both in its rest frame; at most 1, as for bodies around the eye.  (E3)
///
/// Along a line of sight all distances scale by D. So the relative depth difference of two points
/// of a body that are in line with the eye is the same as in the rest frame, where it is a fraction
/// of the size of the body.
pub(crate) fn depth_factors(points: &[Point], motions: &[RelativeMotion]) -> Vec<f64> {
    let mut extents = vec![Extent::EMPTY; motions.len()];
    for point in points {
        extents[point.body.index()].add(point, &motions[point.body.index()]);
    }
    extents.iter().map(Extent::depth_factor).collect()
}

/// The bounding box of a body, and the distance of its nearest vertex from the eye.
#[derive(Clone, Copy)]
struct Extent {
    low: DVec3,
    high: DVec3,
    nearest: f64,
}

impl Extent {
    const EMPTY: Extent =
        Extent { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY, nearest: f64::INFINITY };

    fn add(&mut self, point: &Point, motion: &RelativeMotion) {
        let rest = motion.boosted_rest(point.rest);
        (self.low, self.high) = (self.low.min(rest), self.high.max(rest));
        self.nearest = self.nearest.min(point.rest_distance);
    }

    fn depth_factor(&self) -> f64 {
        let factor = FAR * (self.high - self.low).length() / self.nearest;
        // The comparison is false without vertices (NaN) and for a single point.
        if factor > 0.0 { factor.clamp(MIN_FACTOR, 1.0) } else { 1.0 }
    }
}
