//! How far a camera stands back so that what it sees fits into the picture.

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use crate::RelativeMotion;
use crate::{BodyId, SeenPosition};

/// Passes over moving bodies, whose shape as seen depends a little on the place of the eye. From
/// the third pass on the distance changes by about a thousandth or less.
const N_PASSES: usize = 6;

/// The greatest distance, in units of the least: bodies that approach may be seen so near the eye
/// that no distance is enough.
const FARTHEST: f64 = 64.0;

/// Points that one thread looks at together.
const N_TOGETHER: usize = 1024;

/// [`Frame::extents`] of no point.
const NOTHING: [f64; 4] = [f64::NEG_INFINITY; 4];

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

/// A body in motion, as it is seen from a place of the eye.
struct SeenBody {
    /// Seen where it is at rest.
    middle: DVec3,
    /// [`RelativeMotion::boosted_rest`] of the middle relative to the eye, and its length.
    anchor: DVec3,
    distance: f64,
    /// The same of displacements from the middle, unless that changes nothing.
    boosted: Option<DMat3>,
    /// Along each axis of the frame: the place of the middle, and [`RelativeMotion::seen_part`].
    along: [(f64, DVec3, f64); 3],
}

impl SeenBody {
    fn new(motion: &RelativeMotion, middle: DVec3, eye: DVec3, axes: [DVec3; 3]) -> Self {
        let boosted = |p: DVec3| motion.boosted_rest(p);
        let anchor = boosted(motion.rest(SeenPosition(middle - eye)).0);
        let [x, y, z] =
            DMat3::IDENTITY.to_cols_array_2d().map(|axis| boosted(motion.turned(axis.into())));
        let along = axes.map(|axis| {
            let (normal, flight) = motion.seen_part(axis);
            (axis.dot(middle), normal, flight)
        });
        let boosted = DMat3::from_cols(x, y, z);
        let boosted = (boosted != DMat3::IDENTITY).then_some(boosted);
        Self { middle, anchor, distance: anchor.length(), boosted, along }
    }

    /// Where a point of it is seen, along each axis.
    fn seen(&self, point: DVec3) -> [f64; 3] {
        let way = point - self.middle;
        let way = self.boosted.map_or(way, |boosted| boosted * way);
        let place = self.anchor + way;
        // The difference of two lengths a and b is (a² − b²)/(a + b), which does not cancel.
        let farther = (place + self.anchor).dot(way) / (place.length() + self.distance);
        self.along.map(|(middle, normal, flight)| middle + (normal.dot(way) - flight * farther))
    }
}

impl Frame {
    /// The nearest place from which everything is seen in the filled part of the picture.
    pub(crate) fn fit(&self, subject: &Subject<'_>) -> Place {
        let moves = subject
            .bodies
            .iter()
            .flat_map(|(_, motions)| motions)
            .any(|motion| !motion.is_at_rest());
        let [x, y, z] = self.axes;
        let axes = [x, y, if self.is_orthographic { DVec3::ZERO } else { z }];
        let mut place = Place { offset: [0.0; 2], distance: 2.0 * self.nearest };
        for _ in 0..if moves { N_PASSES } else { 1 } {
            let eye = self.point(place);
            // `None` at rest.
            let seen = |(middle, motions): &(DVec3, Vec<RelativeMotion>)| -> Vec<Option<SeenBody>> {
                let one = |motion: &RelativeMotion| SeenBody::new(motion, *middle, eye, axes);
                let all = motions.iter().map(|motion| (!motion.is_at_rest()).then(|| one(motion)));
                if motions.is_empty() { vec![None] } else { all.collect() }
            };
            let bodies: Vec<_> = subject.bodies.iter().map(seen).collect();
            let of_chunk = |chunk: &[(DVec3, BodyId)]| {
                let mut most = NOTHING;
                for points in chunk.chunk_by(|a, b| a.1 == b.1) {
                    for body in &bodies[points[0].1.index()] {
                        for &(point, _) in points {
                            let along = match body {
                                Some(body) => body.seen(point),
                                None => axes.map(|axis| axis.dot(point)),
                            };
                            most = greater(most, self.extents(along));
                        }
                    }
                }
                most
            };
            let chunks = subject.points.par_chunks(N_TOGETHER);
            let most = chunks.map(of_chunk).reduce(|| NOTHING, greater);
            place = self.place(most);
        }
        place
    }

    /// A place of the eye as a point.
    pub(crate) fn point(&self, Place { offset: [across, up], distance }: Place) -> DVec3 {
        self.axes[0] * across + self.axes[1] * up + self.axes[2] * distance
    }

    /// At the distance d and with the offset c of the eye, a point at x and at the height z towards
    /// the eye is in the filled part, of half-width t, if |x − c| ≤ t(d − z): if x + tz ≤ td + c
    /// and tz − x ≤ td − c. These are the left sides, across and up.
    fn extents(&self, [x, y, depth]: [f64; 3]) -> [f64; 4] {
        let [across, up] = self.filled.map(|half| half * depth);
        [across + x, across - x, up + y, up - y]
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
    std::array::from_fn(|idx| if b[idx] > a[idx] { b[idx] } else { a[idx] })
}
