//! Rays against round faces, exact up to rounding.
//!
//! A ray is carried to the coordinates of the unit shape, where it meets a sphere, a cylinder or a
//! plane.

use std::ops::{ControlFlow, Range};

use glam::{DMat3, DVec3};
use ugbvh::{Bvh, Ray};
use ugscene::{FaceShape, RoundShape};

/// A ray starts on a shape if it starts this close to it, in radii.
const ON_SURFACE: f64 = 1e-9;

/// The boxes around shapes are larger by this part of their size and distance from the eye: more
/// than rounding errors of hits.
const MARGIN: f64 = 1e-9;

/// A round face in its rest frame, relative to the eye.
#[derive(Clone, Copy, Debug)]
struct Round {
    shape: RoundShape,
    unit_from_rest: DMat3,
}

/// The round faces of a part.
#[derive(Debug)]
pub(super) struct Rounds {
    all: Vec<Round>,
    /// Twelve triangles around each.
    boxes: Bvh,
}

impl Rounds {
    pub fn new(shapes: Vec<RoundShape>) -> Self {
        let round = |shape: RoundShape| Round { shape, unit_from_rest: shape.axes.inverse() };
        let all: Vec<Round> = shapes.into_iter().map(round).collect();
        let corners = all.iter().flat_map(|round| {
            let [low, high] = round.shape.bounds();
            let margin =
                MARGIN * ((high - low).max_element() + low.abs().max(high.abs()).max_element());
            let ends = [low - margin, high + margin];
            let corner = move |idx: usize| {
                DVec3::from_array([0, 1, 2].map(|axis| ends[idx >> axis & 1][axis]))
            };
            (0..8).map(corner)
        });
        // Sides of a box; the numbers of corners have a bit for each axis.
        let sides =
            [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
        let triangles = (0..all.len() as u32).flat_map(|row| {
            sides.into_iter().flat_map(move |[a, b, c, d]| {
                [[a, b, c], [a, c, d]].map(|triangle| triangle.map(|corner| 8 * row + corner))
            })
        });
        let boxes = Bvh::new(&corners.collect::<Vec<_>>(), &triangles.collect::<Vec<_>>());
        Self { all, boxes }
    }

    pub fn len(&self) -> usize {
        self.all.len()
    }

    /// [`RoundShape::bounds`]
    pub fn bounds_of(&self, row: usize) -> [DVec3; 2] {
        self.all[row].shape.bounds()
    }

    /// [`Round::surface`]
    pub fn surface(&self, row: usize, hit: DVec3) -> (DVec3, DVec3) {
        self.all[row].surface(hit)
    }

    /// The least and greatest coordinates.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        self.boxes.bounds()
    }

    /// The nearest hit with `range.start` < t < `range.end`, and the row of its face. Ties go to
    /// the lowest row.
    pub fn closest(&self, ray: &Ray, range: Range<f64>) -> Option<(f64, u32)> {
        let mut best: Option<(f64, u32)> = None;
        let _ = self.visit(ray, range, |t, row| {
            if best.is_none_or(|best| (t, row) < best) {
                best = Some((t, row));
            }
            ControlFlow::Continue(())
        });
        best
    }

    /// Calls `visit` for all hits, in any order, until it breaks.
    pub fn visit(
        &self,
        ray: &Ray,
        range: Range<f64>,
        mut visit: impl FnMut(f64, u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        if self.all.is_empty() {
            return ControlFlow::Continue(());
        }
        // A ray leaves a box behind its hits; it may have entered it before its origin.
        let mut rows: Vec<u32> = Vec::new();
        let _ = self.boxes.visit(ray, range.start..f64::INFINITY, |hit| {
            rows.push(hit.triangle / 12);
            ControlFlow::Continue(())
        });
        rows.sort_unstable();
        rows.dedup();
        for row in rows {
            for t in self.all[row as usize].hits(ray).into_iter().flatten() {
                if range.start < t && t < range.end {
                    visit(t, row)?;
                }
            }
        }
        ControlFlow::Continue(())
    }
}

impl Round {
    /// The place on the surface nearest to a hit, and the unit normal on the outside there.
    fn surface(&self, hit: DVec3) -> (DVec3, DVec3) {
        let at = self.unit_from_rest * (hit - self.shape.origin);
        let around = at.with_z(0.0).normalize_or_zero();
        let (place, normal) = match self.shape.shape {
            FaceShape::Sphere => (at.normalize_or_zero(), at),
            FaceShape::Disc | FaceShape::Ring => (at.with_z(0.0), DVec3::Z),
            FaceShape::Cylinder
                if at.z.abs().min((at.z - 1.0).abs()) < (at.with_z(0.0).length() - 1.0).abs() =>
            {
                let end = if at.z < 0.5 { 0.0 } else { 1.0 };
                (at.with_z(end), DVec3::Z * (2.0 * end - 1.0))
            }
            _ => (around.with_z(at.z), around),
        };
        (self.shape.place(place), self.shape.normal(normal))
    }

    /// The parameters of the hits of a ray, beside its origin if that is on the surface.
    fn hits(&self, ray: &Ray) -> [Option<f64>; 2] {
        let from = self.unit_from_rest * (ray.origin - self.shape.origin);
        let step = self.unit_from_rest * ray.direction;
        match self.shape.shape {
            FaceShape::Polygon => [None; 2],
            FaceShape::Sphere => roots(from, step).map_or([None; 2], |roots| roots.map(Some)),
            FaceShape::Disc | FaceShape::Ring => {
                let t = at_plane(from.z, step.z);
                let inner = self.shape.inner;
                let is_in = |t: &f64| {
                    let squared = (from + *t * step).with_z(0.0).length_squared();
                    inner * inner <= squared && squared <= 1.0
                };
                [Some(t).filter(is_in), None]
            }
            FaceShape::Tube => {
                let Some(roots) = around_axis(from, step) else { return [None; 2] };
                roots.map(|t| Some(t).filter(|t| (0.0..=1.0).contains(&(from.z + t * step.z))))
            }
            FaceShape::Cylinder => {
                let Some([enters, leaves]) = around_axis(from, step) else { return [None; 2] };
                let ends = if step.z == 0.0 {
                    let is_between = (0.0..=1.0).contains(&from.z);
                    if is_between { [f64::NEG_INFINITY, f64::INFINITY] } else { return [None; 2] }
                } else {
                    [0.0, 1.0].map(|z| at_plane(from.z - z, step.z))
                };
                let [enters, leaves] =
                    [enters.max(ends[0].min(ends[1])), leaves.min(ends[0].max(ends[1]))];
                if enters < leaves { [Some(enters), Some(leaves)] } else { [None; 2] }
            }
        }
    }
}

/// Where a ray meets the unit cylinder around z, of any length.
fn around_axis(from: DVec3, step: DVec3) -> Option<[f64; 2]> {
    let (from, step) = (from.with_z(0.0), step.with_z(0.0));
    if step == DVec3::ZERO {
        return (from.length_squared() <= 1.0).then_some([f64::NEG_INFINITY, f64::INFINITY]);
    }
    roots(from, step)
}

/// The parameter at which a ray meets the plane z = 0. `z`, `step`: of its origin and its step.
fn at_plane(z: f64, step: f64) -> f64 {
    if z.abs() <= ON_SURFACE { 0.0 } else { -z / step }
}

/// The parameters at which a ray meets the unit sphere, in order.  Eq. (P52)
fn roots(from: DVec3, step: DVec3) -> Option<[f64; 2]> {
    let squared = step.length_squared();
    let middle = -from.dot(step) / squared;
    if (from.length_squared() - 1.0).abs() <= ON_SURFACE {
        // Rounding must not move the origin into the shape or out of it.
        return Some([f64::min(0.0, 2.0 * middle), f64::max(0.0, 2.0 * middle)]);
    }
    // Of the point nearest to the centre: its rounding error does not grow with the distance's
    // square.
    let half = (1.0 - (from + middle * step).length_squared()) / squared;
    (half >= 0.0).then(|| [middle - half.sqrt(), middle + half.sqrt()])
}
