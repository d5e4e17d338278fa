//! How far away bodies are in their own frames, measured by their size.

use glam::DVec3;

use crate::motion::{Motion, Point};

/// With a part of 1 the bound of depth is a ten-thousandth of the distance. So from bodies further away than ten times their size
/// a thousandth of the size is asked for.
const FAR: f64 = 10.0;

/// Less is not asked for: renderers compare depths in single precision.
const LEAST: f64 = 3e-3;

/// What part of the bound of depth counts for each body: [`FAR`] times its size over the distance of its nearest vertex,
/// both in its rest frame; 1 at most, as for bodies round the eye.  (E3)
///
/// Along a line of sight all distances are in the ratio D. So points of a body one behind the other are apart by the same
/// part of their distance as in the rest frame, where gaps are parts of the size of the body.
pub(crate) fn parts(points: &[Point], motions: &[Motion]) -> Vec<f64> {
    let mut bodies = vec![Body::NOTHING; motions.len()];
    for point in points {
        bodies[point.body as usize].add(point, &motions[point.body as usize]);
    }
    bodies.iter().map(Body::part).collect()
}

/// The box round a body, and how near it comes to the eye.
#[derive(Clone, Copy)]
struct Body {
    low: DVec3,
    high: DVec3,
    nearest: f64,
}

impl Body {
    const NOTHING: Body = Body { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY, nearest: f64::INFINITY };

    fn add(&mut self, point: &Point, motion: &Motion) {
        let place = motion.boosted_rest(point.rest);
        (self.low, self.high) = (self.low.min(place), self.high.max(place));
        self.nearest = self.nearest.min(point.rest_distance);
    }

    fn part(&self) -> f64 {
        let part = FAR * (self.high - self.low).length() / self.nearest;
        // Not so for what has no vertices, and no size.
        if part > 0.0 { part.clamp(LEAST, 1.0) } else { 1.0 }
    }
}
