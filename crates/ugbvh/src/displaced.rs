//! A second hierarchy of the same triangles at the places where they are seen.
//!
//! Rays that are curves in the coordinates of a mesh are straight where it is seen, but there its
//! triangles are curved. The surface of each is within a margin of the plane triangle with the same
//! corners, so a straight ray meets boxes that are grown by this margin, and finds the triangles
//! that a curve has to be tested with.

use std::ops::Range;

use fearless_simd::{Simd, dispatch};
use glam::DVec3;

use crate::box_ray::Line;
use crate::build;
use crate::closest::{Prepared, lowest};
use crate::curve::{self, Curve};
use crate::nodes::{IS_BLOCK, SimdRay};
use crate::stack::{Entry, Stack};
use crate::{Bvh, Hit, Ray, Triangle};

/// The triangles of a [`Bvh`] at other places.
#[derive(Debug)]
pub struct DisplacedBvh(Bvh);

/// A triangle that a ray may hit.
#[derive(Clone, Copy, Debug)]
pub struct Candidate<'a> {
    bvh: &'a Bvh,
    triangle: Triangle,
}

impl DisplacedBvh {
    /// `positions`: the displaced corners, as many as those of the mesh, all finite. `margins[i]`:
    /// the greatest distance of a displaced point of triangle i from the point with the same
    /// barycentric weights of its displaced corners, finite.
    pub fn new(bvh: &Bvh, positions: &[DVec3], margins: &[f64]) -> Self {
        Self(build::displaced(bvh, positions, margins))
    }

    /// Calls `visit` for the triangles that a ray may hit with `range.start` < t < `range.end`,
    /// roughly the first ones first. `visit` returns the end of the range from then on.
    ///
    /// `bvh`: the hierarchy that this one was built from.
    pub fn visit<'a>(
        &self,
        bvh: &'a Bvh,
        ray: &Ray,
        range: Range<f64>,
        mut visit: impl FnMut(Candidate<'a>) -> f64,
    ) {
        let Some(ray) = Prepared::new(&self.0, ray, range) else { return };
        dispatch!(self.0.level, simd => self.walk(simd, &ray, |triangle| visit(Candidate { bvh, triangle })));
    }

    #[inline(always)]
    fn walk<S: Simd>(&self, simd: S, ray: &Prepared, mut visit: impl FnMut(Triangle) -> f64) {
        let slabs = SimdRay::new(simd, &{ ray.box_ray.slabs });
        let Range { start, mut end } = ray.depths;
        let mut stack = Stack::with_root();
        while let Some(entry) = stack.pop() {
            if entry > Entry::limit(end) {
                continue;
            }
            let child = entry.child();
            if child & IS_BLOCK == 0 {
                let node = &self.0.nodes[child as usize];
                let (near, mut mask) = node.intersect(simd, &slabs, start, end);
                let mut farthest_first = [Entry::new(0.0, 0); 8];
                let mut n = 0;
                while mask != 0 {
                    let idx = lowest(mask);
                    mask &= mask - 1;
                    let entry = Entry::new(near[idx], node.children()[idx]);
                    let at =
                        farthest_first[..n].iter().position(|other| *other < entry).unwrap_or(n);
                    farthest_first.copy_within(at..n, at + 1);
                    farthest_first[at] = entry;
                    n += 1;
                }
                farthest_first[..n].iter().for_each(|entry| stack.push(*entry));
                continue;
            }
            let block = &self.0.blocks[(child & !IS_BLOCK) as usize];
            // The projection to a plane adds it to itself at most; and rounding.
            let margin = 2.001 * block.margin;
            let line = Line { padding: ray.box_ray.line.padding + margin, ..ray.box_ray.line };
            let mut mask = block.candidates_near(simd, &line, margin);
            while mask != 0 {
                let triangle = self.0.triangles[block.first as usize + lowest(mask)];
                mask &= mask - 1;
                let limit = visit(triangle);
                if limit < ray.range.end {
                    end = end.min(ray.box_ray.limits(&ray.shear, &(ray.range.start..limit)).end);
                }
            }
        }
    }
}

impl Candidate<'_> {
    /// The index of the triangle.
    pub fn index(&self) -> u32 {
        self.triangle.index
    }

    /// Calls `visit` for the hits on a curve in the coordinates of the mesh, as
    /// [`Bvh::visit_on_curve`]. The curve bends by a finite amount in the range.
    ///
    /// `bend`: of all curves that are to miss or hit neighbouring triangles alike.
    pub fn visit_on_curve(
        &self,
        curve: &impl Curve,
        range: Range<f64>,
        bend: f64,
        mut visit: impl FnMut(Hit) -> f64,
    ) {
        let step = curve::tangent_step(self.bvh, bend);
        curve::visit_triangle(
            self.bvh,
            curve,
            &self.triangle,
            range,
            step,
            |crossing, triangle| {
                visit(Hit { t: crossing.t, triangle, u: crossing.u, v: crossing.v })
            },
        );
    }
}
