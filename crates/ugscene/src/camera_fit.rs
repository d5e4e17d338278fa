//! How far a camera stands back so that what it sees fits into the picture.

use glam::DVec3;
use rayon::prelude::*;

use crate::relative_motion::RelativeMotion;
use crate::{BodyId, RestPosition, SeenPosition};

/// Passes over moving bodies, whose shape as seen depends a little on the place of the eye. From
/// the third pass on the distance changes by about a thousandth or less.
const N_PASSES: usize = 6;

/// The greatest distance, in units of the least: bodies that approach may be seen so near the eye
/// that no distance is enough.
const FARTHEST: f64 = 64.0;

/// The seen point, in any unit, relative to any origin.
pub(crate) struct Subject<'s> {
    /// Points and their bodies.
    pub points: &'s [(DVec3, BodyId)],
    /// For each body its middle, which is seen where it is at rest (`-in`), and its motions. It is
    /// seen in all of them; at rest if there are none.
    pub bodies: &'s [(DVec3, Vec<RelativeMotion>)],
}

/// The direction of a camera, and what it may fill.
pub(crate) struct Frame {
    /// Unit vectors to the right, up, and from the view centre to the eye.
    pub axes: [DVec3; 3],
    /// Half of the part of the film that is filled, across and down, at distance 1.
    pub filled: [f64; 2],
    /// Depth does not change sizes.
    pub is_orthographic: bool,
    /// The view axis goes through the origin; otherwise the picture is centred.
    pub is_fixed: bool,
    /// The least distance from the origin.
    pub nearest: f64,
}

/// A place of the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    /// Displacement of the view axis, to the right and up from the origin.
    pub offset: [f64; 2],
    /// From the origin, along the view.
    pub distance: f64,
}

impl Frame {
    /// The nearest place from which everything is seen in the filled part of the picture.
    pub(crate) fn fit(&self, subject: &Subject<'_>) -> Place {
        let moves = subject.bodies.iter().flat_map(|(_, motions)| motions).any(|motion| !motion.is_at_rest());
        let mut place = Place { offset: [0.0; 2], distance: 2.0 * self.nearest };
        for _ in 0..if moves { N_PASSES } else { 1 } {
            let eye = self.point(place);
            let extents = |(point, body): &(DVec3, BodyId)| self.extents(subject, eye, *point, *body);
            let most = subject.points.par_iter().map(extents).reduce(|| [f64::NEG_INFINITY; 4], greater);
            place = self.place(most);
        }
        place
    }

    /// A place of the eye as a point.
    pub(crate) fn point(&self, Place { offset: [across, up], distance }: Place) -> DVec3 {
        self.axes[0] * across + self.axes[1] * up + self.axes[2] * distance
    }

    /// At the distance d and with the offset c of the eye, a point at x and at the height z towards
    /// the eye is in the filled part, of half-width t, if |x − c| ≤ t(d − z): if x + tz ≤ td + c and
    /// tz − x ≤ td − c. These are the left sides, across and up.
    fn extents(&self, subject: &Subject<'_>, eye: DVec3, point: DVec3, body: BodyId) -> [f64; 4] {
        let (middle, motions) = &subject.bodies[body.index()];
        let of = |seen: DVec3| {
            let depth = if self.is_orthographic { 0.0 } else { seen.dot(self.axes[2]) };
            let [x, y] = [seen.dot(self.axes[0]), seen.dot(self.axes[1])];
            let [across, up] = self.filled.map(|half| half * depth);
            [across + x, across - x, up + y, up - y]
        };
        let seen = |motion: &RelativeMotion| {
            if motion.is_at_rest() {
                return point;
            }
            let anchor = motion.rest(SeenPosition(*middle - eye)).0;
            motion.seen(RestPosition(anchor + motion.turned(point - *middle))).0 + eye
        };
        let all = motions.iter().map(|motion| of(seen(motion)));
        all.reduce(greater).unwrap_or_else(|| of(point))
    }

    fn place(&self, [right, left, above, below]: [f64; 4]) -> Place {
        let axis = |high: f64, low: f64, half: f64| {
            if self.is_fixed {
                (0.0, high.max(low) / half)
            } else {
                (0.5 * (high - low), 0.5 * (high + low) / half)
            }
        };
        let (across, wide) = axis(right, left, self.filled[0]);
        let (up, tall) = axis(above, below, self.filled[1]);
        let distance = wide.max(tall).max(self.nearest).min(FARTHEST * self.nearest);
        Place { offset: [across, up], distance }
    }
}

fn greater(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    std::array::from_fn(|idx| a[idx].max(b[idx]))
}
