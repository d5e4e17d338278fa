//! Rays against the triangles of a body, in its rest frame, by a bounding-volume hierarchy.
//!
//! ```
//! use glam::dvec3;
//! use ugbvh::{Bvh, Ray};
//!
//! let corners = [dvec3(0., 0., 0.), dvec3(4., 0., 0.), dvec3(0., 4., 0.)];
//! let bvh = Bvh::new(&corners, &[[0, 1, 2]]);
//! let ray = Ray { origin: dvec3(1., 2., 5.), direction: dvec3(0., 0., -2.) };
//! let hit = bvh.closest(&ray, 0.0..f64::INFINITY).ok_or("no hit")?;
//! assert_eq!((hit.t, hit.triangle, hit.u, hit.v), (2.5, 0, 0.25, 0.5));
//! # Ok::<(), &str>(())
//! ```
//!
//! # What a hit is
//!
//! One function defines it (`shear::Shear::intersect`), and every search returns what testing all
//! triangles with it would return, bit for bit. Boxes (`box_ray`) and single-precision tests of
//! eight triangles at once (`nodes`) only skip triangles of which it is proved that the function
//! misses them. So hits do not depend on the hierarchy, on the number of threads or on the
//! instruction set: they are computed by sums, differences, products, quotients and comparisons,
//! never by fused multiply-add. Only tests that skip triangles use it, where the processor has it.
//!
//! # Watertight edges
//!
//! A triangle is tested in a projection along the ray (S. Woop, C. Benthin and I. Wald, *Watertight
//! ray/triangle intersection*, Journal of Computer Graphics Techniques 2, 2013). The projection of
//! a corner does not depend on the triangle. In the projection, the side of an edge on which the
//! ray runs is exact: where rounding could decide, products are computed without error. A ray
//! through an edge or a corner is treated as if it were moved by an infinitesimal amount, the same
//! for all triangles (H. Edelsbrunner and E. P. Mücke, *Simulation of simplicity*, 1990). So a ray
//! crosses exactly one of two triangles on both sides of a common edge, exactly one of a fan around
//! a corner, and a closed mesh an even number of times.
//!
//! # Curves
//!
//! A ray that is straight in its own frame is a curve in the coordinates of a body that turns or
//! accelerates. [`Curve`] states how much it may bend; [`Bvh::visit_on_curve`] halves it where a
//! box could hide between the curve and its chord. A hit is that of a tangent that touches the
//! curve so close to it that the difference is below 10⁻¹² sizes of the mesh.
//!
//! # Range of numbers
//!
//! Corners and origins up to 2¹⁰⁰⁰ (10³⁰¹) are valid; a triangle with a corner beyond, or with a
//! NaN coordinate, is never hit. Directions may have any length but zero and infinity. A ray whose
//! origin is farther than 2³⁰⁰ sizes of the mesh away hits nothing.

mod box_ray;
mod build;
mod closest;
mod curve;
mod displaced;
mod frame;
mod nodes;
mod packet;
mod shear;
mod stack;
#[cfg(test)]
mod tests;

use std::ops::{ControlFlow, Range};

use fearless_simd::Level;
use glam::DVec3;

use closest::Prepared;
pub use curve::Curve;
pub use displaced::{Candidate, DisplacedBvh};
use frame::Frame;
use nodes::{Block, Node};

/// Triangles of a body at rest, for rays.
#[derive(Debug)]
pub struct Bvh {
    level: Level,
    frame: Frame,
    bounds: Option<(DVec3, DVec3)>,
    positions: Vec<[f64; 3]>,
    /// Triangles in the order of blocks: rows of `positions`, and the caller's index.
    triangles: Vec<Triangle>,
    /// The root comes first. Empty if there are no triangles.
    nodes: Vec<Node>,
    blocks: Vec<Block>,
}

/// A triangle: rows of the table of positions, and its index.
#[derive(Clone, Copy, Debug)]
struct Triangle {
    corners: [u32; 3],
    index: u32,
}

/// A straight line with a parameter: origin + t direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// The point of parameter 0.
    pub origin: DVec3,
    /// The direction, of any length but zero and infinity.
    pub direction: DVec3,
}

/// An intersection of a ray with a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Parameter of the ray.
    pub t: f64,
    /// Index of the triangle.
    pub triangle: u32,
    /// Barycentric weight of the second corner, 0…1.
    pub u: f64,
    /// Barycentric weight of the third corner, 0…1.
    pub v: f64,
}

impl Bvh {
    /// Builds the hierarchy, on all threads of the current rayon pool.
    ///
    /// `triangles`: rows of `positions`. A degenerate triangle is never hit: one with an index
    /// beyond the table, with a corner that is not valid, or whose edges have the cross product 0.
    /// At most the first 2³¹ triangles are used.
    pub fn new(positions: &[DVec3], triangles: &[[u32; 3]]) -> Self {
        build::build(positions, triangles)
    }

    fn empty() -> Self {
        Self {
            level: Level::new(),
            frame: Frame { center: [0.0; 3], scale: 1.0, unit: 1.0 },
            bounds: None,
            positions: Vec::new(),
            triangles: Vec::new(),
            nodes: Vec::new(),
            blocks: Vec::new(),
        }
    }

    /// The least and the greatest coordinates of the triangles that can be hit.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        self.bounds
    }

    /// The nearest hit with `range.start` < t < `range.end`. Ties go to the lowest triangle index.
    #[inline(always)]
    pub fn closest(&self, ray: &Ray, range: Range<f64>) -> Option<Hit> {
        closest::closest(self, &Prepared::new(self, ray, range)?)
    }

    /// Calls `visit` for hits with `range.start` < t < `range.end`, in any order, until it returns
    /// `ControlFlow::Break`; for shadow rays through transparent faces.
    pub fn visit(
        &self,
        ray: &Ray,
        range: Range<f64>,
        mut visit: impl FnMut(Hit) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let Some(ray) = Prepared::new(self, ray, range) else { return ControlFlow::Continue(()) };
        closest::visit(self, &ray, &mut visit)
    }

    /// The nearest hit of each of several rays from one origin, as [`Bvh::closest`] returns it.
    /// It is fastest for rays close to each other, as those of 8×8 neighbouring pixels.
    ///
    /// `hits[i]` becomes that of `directions[i]`; the shorter slice counts.
    pub fn closest_packet(
        &self,
        origin: DVec3,
        directions: &[DVec3],
        range: Range<f64>,
        hits: &mut [Option<Hit>],
    ) {
        packet::closest(self, origin, directions, &range, hits);
    }

    /// Calls `visit` for the hits on a curve with `range.start` < t < `range.end`, both finite,
    /// roughly the first ones first. `visit` returns the end of the range from then on; −∞ ends the
    /// search.
    ///
    /// The last digits of hits depend on the range, but not on the ends that `visit` returns.
    pub fn visit_on_curve(
        &self,
        curve: &impl Curve,
        range: Range<f64>,
        mut visit: impl FnMut(Hit) -> f64,
    ) {
        curve::visit(self, curve, range, |crossing, triangle| {
            visit(Hit { t: crossing.t, triangle, u: crossing.u, v: crossing.v })
        });
    }

    #[inline(always)]
    fn corners(&self, triangle: &Triangle) -> [&[f64; 3]; 3] {
        let [a, b, c] = triangle.corners;
        [&self.positions[a as usize], &self.positions[b as usize], &self.positions[c as usize]]
    }
}
