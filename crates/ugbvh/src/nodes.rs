//! Nodes of eight boxes and blocks of eight triangles, each tested at once in single precision.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8, u32x8};

use crate::box_ray::{Line, Slabs};

/// Children of a node, and triangles of a block.
pub const WIDTH: usize = 8;

/// The boxes of up to eight children, in four cache lines.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct Node {
    /// Rows 0 to 5: bits of the least x of each child, the greatest x, the least y, and so on;
    /// where there is no child, of +∞ and −∞, which no ray hits. Row 6: the children. Row 7 is
    /// unused: with eight rows, an index of three bits needs no bounds check.
    rows: [[u32; WIDTH]; 8],
}

/// The row of a node that has its children.
const CHILDREN: usize = 6;

/// Marks a child that is a block.
pub const IS_BLOCK: u32 = 1 << 31;

impl Node {
    pub const EMPTY: Self = {
        let [low, high] = [[f32::INFINITY.to_bits(); WIDTH], [f32::NEG_INFINITY.to_bits(); WIDTH]];
        Self { rows: [low, high, low, high, low, high, [0; WIDTH], [0; WIDTH]] }
    };

    pub fn set_box(&mut self, child: usize, low: [f32; 3], high: [f32; 3]) {
        for axis in 0..3 {
            self.rows[2 * axis][child] = low[axis].to_bits();
            self.rows[2 * axis + 1][child] = high[axis].to_bits();
        }
    }

    /// Indices in the table of nodes, or in that of blocks if [`IS_BLOCK`] is set.
    #[inline(always)]
    pub fn children(&self) -> &[u32; WIDTH] {
        &self.rows[CHILDREN]
    }

    /// To be set.
    #[inline(always)]
    pub fn children_mut(&mut self) -> &mut [u32; WIDTH] {
        &mut self.rows[CHILDREN]
    }

    /// Planes of all children: the least coordinates in an axis at twice the axis, the greatest
    /// behind them.
    #[inline(always)]
    pub fn planes<S: Simd>(&self, simd: S, idx: usize) -> f32x8<S> {
        u32x8::from_slice(simd, &self.rows[idx & 7]).bitcast()
    }

    /// The planes on the other side of boxes.
    #[inline(always)]
    pub fn opposite<S: Simd>(&self, simd: S, idx: usize) -> f32x8<S> {
        self.planes(simd, idx ^ 1)
    }

    /// A plane of a child.
    #[inline(always)]
    pub fn plane(&self, idx: usize, child: usize) -> f32 {
        f32::from_bits(self.rows[idx & 7][child])
    }

    /// The greatest extent of a child in any axis.
    pub fn extent(&self, child: usize) -> f32 {
        let extent = |axis: usize| self.plane(2 * axis + 1, child) - self.plane(2 * axis, child);
        extent(0).max(extent(1)).max(extent(2))
    }

    /// Where the ray enters each box, and a mask of those it hits at τ in `start`…`end`.
    #[inline(always)]
    pub fn intersect<S: Simd>(
        &self,
        simd: S,
        ray: &SimdRay<S>,
        start: f32,
        end: f32,
    ) -> ([f32; WIDTH], u32) {
        // No operand is NaN: origins and reciprocals are finite, and reciprocals are not 0.
        let [near_x, far_x] = self.crossings(simd, ray, 0);
        let [near_y, far_y] = self.crossings(simd, ray, 1);
        let [near_z, far_z] = self.crossings(simd, ray, 2);
        let near = near_x.max(near_y).max(near_z.max(f32x8::splat(simd, start)));
        let far = far_x.min(far_y).min(far_z.min(f32x8::splat(simd, end)));
        (near.into(), near.simd_le(far).to_bitmask() as u32)
    }

    /// Where the ray enters the box of a child, if it hits it at τ in `start`…`end`; as of
    /// [`Node::intersect`], up to rounding.
    pub fn intersect_child(
        &self,
        ray: &Slabs,
        child: usize,
        [start, end]: [f32; 2],
    ) -> Option<f32> {
        let (mut near, mut far) = (start, end);
        for axis in 0..3 {
            let planes =
                [ray.entries[axis], ray.entries[axis] ^ 1].map(|idx| self.plane(idx, child));
            near = near.max(planes[0] * ray.reciprocals[axis] + ray.entry_offsets[axis]);
            far = far.min(planes[1] * ray.reciprocals[axis] + ray.exit_offsets[axis]);
        }
        (near <= far).then_some(near)
    }

    /// Where the ray crosses the planes of boxes in an axis.
    #[inline(always)]
    fn crossings<S: Simd>(&self, simd: S, ray: &SimdRay<S>, axis: usize) -> [f32x8<S>; 2] {
        let entry = self.planes(simd, ray.entries[axis]);
        let exit = self.opposite(simd, ray.entries[axis]);
        [
            entry.mul_add(ray.reciprocals[axis], ray.entry_offsets[axis]),
            exit.mul_add(ray.reciprocals[axis], ray.exit_offsets[axis]),
        ]
    }
}

/// A ray in vector registers.
pub struct SimdRay<S: Simd> {
    entry_offsets: [f32x8<S>; 3],
    exit_offsets: [f32x8<S>; 3],
    reciprocals: [f32x8<S>; 3],
    entries: [usize; 3],
}

impl<S: Simd> SimdRay<S> {
    #[inline(always)]
    pub fn new(simd: S, ray: &Slabs) -> Self {
        Self {
            entry_offsets: splats(simd, ray.entry_offsets),
            exit_offsets: splats(simd, ray.exit_offsets),
            reciprocals: splats(simd, ray.reciprocals),
            entries: ray.entries,
        }
    }
}

#[inline(always)]
fn splats<S: Simd>(simd: S, [x, y, z]: [f32; 3]) -> [f32x8<S>; 3] {
    [f32x8::splat(simd, x), f32x8::splat(simd, y), f32x8::splat(simd, z)]
}

/// Up to eight triangles.
#[derive(Clone, Debug)]
#[repr(align(32))]
pub struct Block {
    /// x, y and z of each first corner, of each second, of each third, in box coordinates.
    pub corners: [[[f32; WIDTH]; 3]; 3],
    /// The first triangle, as a row of the table of triangles.
    pub first: u32,
    /// Number of triangles.
    pub n: u32,
    /// Greatest extent of the box of all triangles in any axis.
    pub extent: f32,
    /// Greatest distance of a surface from its plane triangle.
    pub margin: f32,
}

impl Block {
    pub const EMPTY: Self =
        Self { corners: [[[0.0; WIDTH]; 3]; 3], first: 0, n: 0, extent: 0.0, margin: 0.0 };

    /// A mask of triangles that the ray may hit; it misses the others, or the box of all.
    ///
    /// A projected corner has an error δ that is less than the padding of the ray: 2 u / 2 from
    /// rounding of the corner, 2 u + u / 2 from that of q, and 5 u from the operations and the
    /// slopes, with the u of [`crate::box_ray`]. A projected coordinate is less than 8, and, if the
    /// ray hits the box of the block, less than 2 extents + 3 δ. So a weight, a difference of two
    /// products of coordinates, has an error of less than 4 δ (2 extents + 3 δ) + 2 δ² from that of
    /// the coordinates, and one of 2 u × 8 (2 extents + 3 δ) from rounding. The sum is less than
    /// [`Block::tolerance`].
    #[inline(always)]
    pub fn candidates<S: Simd>(&self, simd: S, ray: &Line) -> u32 {
        let a = self.project(simd, 0, ray);
        let b = self.project(simd, 1, ray);
        let c = self.project(simd, 2, ray);
        let weights = [cross(b, c), cross(c, a), cross(a, b)];
        let tolerance = self.tolerance(ray.padding);
        let low = weights[0].min(weights[1]).min(weights[2]);
        let high = weights[0].max(weights[1]).max(weights[2]);
        let is_hit = low.simd_ge(f32x8::splat(simd, -tolerance))
            | high.simd_le(f32x8::splat(simd, tolerance));
        is_hit.to_bitmask() as u32 & ((1 << self.n) - 1)
    }

    /// [`Block::candidates`] for a curve that is within `margin` of the ray in x and y of the
    /// projection, or for surfaces that are so close to their plane triangles. The margin is part of
    /// the padding of the ray.
    ///
    /// A point that the curve and a triangle have in common is projected to a point of the
    /// triangle with coordinates up to the margin. Moved there, a ray changes the weight of an edge
    /// e by |eₓ| margin + |e_y| margin at most. Rounding adds no more than without a margin, of
    /// coordinates that may be greater by it.
    #[inline(always)]
    pub fn candidates_near<S: Simd>(&self, simd: S, ray: &Line, margin: f32) -> u32 {
        let a = self.project(simd, 0, ray);
        let b = self.project(simd, 1, ray);
        let c = self.project(simd, 2, ray);
        let rounding = (ray.padding - margin) * (16.0 * self.extent + 32.0 * ray.padding);
        let (mut low, mut high) = (u32::MAX, u32::MAX);
        for [from, to] in [[b, c], [c, a], [a, b]] {
            let weight = cross(from, to);
            let length = (to[0] - from[0]).abs() + (to[1] - from[1]).abs();
            let limit = length * margin + rounding;
            low &= (weight + limit).simd_ge(f32x8::splat(simd, 0.0)).to_bitmask() as u32;
            high &= (weight - limit).simd_le(f32x8::splat(simd, 0.0)).to_bitmask() as u32;
        }
        (low | high) & ((1 << self.n) - 1)
    }

    /// Projects a corner of each triangle; the result is −x, −y, as products of two are used.
    #[inline(always)]
    fn project<S: Simd>(&self, simd: S, corner: usize, ray: &Line) -> [f32x8<S>; 2] {
        let corner = &self.corners[corner];
        let x = f32x8::from_slice(simd, &corner[ray.axes[0]]) - ray.position[0];
        let y = f32x8::from_slice(simd, &corner[ray.axes[1]]) - ray.position[1];
        let z = f32x8::from_slice(simd, &corner[ray.axes[2]]) - ray.position[2];
        [
            z.mul_sub(f32x8::splat(simd, ray.slopes[0]), x),
            z.mul_sub(f32x8::splat(simd, ray.slopes[1]), y),
        ]
    }

    #[inline(always)]
    fn tolerance(&self, padding: f32) -> f32 {
        padding * (16.0 * self.extent + 32.0 * padding)
    }
}

#[inline(always)]
fn cross<S: Simd>(a: [f32x8<S>; 2], b: [f32x8<S>; 2]) -> f32x8<S> {
    a[0].mul_sub(b[1], a[1] * b[0])
}
