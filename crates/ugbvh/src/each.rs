//! The nearest hits of independent rays, eight of which are prepared at once.
//!
//! Each ray then traverses the hierarchy by itself, so they need not be close to each other.
//! Preparation consists of the operations of [`Shear::new`] and [`crate::box_ray::BoxRay`], in the
//! same order, so it has the same results.

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, f32x8, f64x8, mask64x8};

use crate::box_ray::{Line, MAX_PADDING, MAX_RECIPROCAL, Slabs, is_backward};
use crate::closest::{Source, Stop, Walk, lowest, walk_on};
use crate::frame::power_of_two;
use crate::nodes::WIDTH;
use crate::shear::{MAX_DISTANCE, Shear};
use crate::{Bvh, Hit, Ray};

pub fn closest(bvh: &Bvh, rays: &[Ray], range: &Range<f64>, hits: &mut [Option<Hit>]) {
    let n = rays.len().min(hits.len());
    let (rays, hits) = (&rays[..n], &mut hits[..n]);
    hits.fill(None);
    // NaN fails the comparison.
    let has_length = range.start < range.end;
    if has_length && !bvh.nodes.is_empty() {
        dispatch!(bvh.level, simd => closest_on(simd, bvh, rays, range, hits));
    }
}

#[inline(always)]
fn closest_on<S: Simd>(simd: S, bvh: &Bvh, rays: &[Ray], range: &Range<f64>, hits: &mut [Option<Hit>]) {
    let mut walk = Walk::new(0.0);
    for (rays, hits) in rays.chunks(WIDTH).zip(hits.chunks_mut(WIDTH)) {
        let batch = Batch::new(simd, bvh, rays, range);
        let mut mask = batch.are_valid & ((1 << rays.len()) - 1);
        while mask != 0 {
            let lane = lowest(mask);
            mask &= mask - 1;
            walk.begin(batch.ends[lane]);
            let (ray, hit) = (Lane { batch: &batch, lane, range }, &mut hits[lane]);
            match walk_on::<_, false>(simd, bvh, &ray, &mut walk, hit, &mut ()) {
                Stop::Empty => {}
                // A full stack, or an edge that needs an exact test: rare, so the ray starts again.
                _ => *hit = bvh.closest(&rays[lane], range.clone()),
            }
        }
    }
}

/// Eight rays, ready for searches.
struct Batch {
    /// A mask of those that may have hits.
    are_valid: u32,
    /// Masks of those whose main axis is x, and y.
    are_along: [u32; 2],
    /// The fields of [`Shear`] by lane.
    origins: [[f64; WIDTH]; 3],
    starts: [[f64; WIDTH]; 3],
    distances: [f64; WIDTH],
    slopes: [[f64; WIDTH]; 2],
    speeds: [f64; WIDTH],
    scale: f64,
    unit: f64,
    /// The fields of [`crate::box_ray::BoxRay`] by lane.
    positions: [[f32; WIDTH]; 3],
    line_slopes: [[f32; WIDTH]; 2],
    paddings: [f32; WIDTH],
    entry_offsets: [[f32; WIDTH]; 3],
    exit_offsets: [[f32; WIDTH]; 3],
    reciprocals: [[f32; WIDTH]; 3],
    depths_z: [f64; WIDTH],
    depths_padding: [f64; WIDTH],
    /// Least and greatest τ of hits.
    from: [f32; WIDTH],
    ends: [f32; WIDTH],
}

impl Batch {
    #[inline(always)]
    fn new<S: Simd>(simd: S, bvh: &Bvh, rays: &[Ray], range: &Range<f64>) -> Self {
        let mut origins = [[0.0; WIDTH]; 3];
        let mut directions = [[0.0; WIDTH]; 3];
        for (lane, ray) in rays.iter().enumerate().take(WIDTH) {
            for axis in 0..3 {
                origins[axis][lane] = ray.origin[axis];
                directions[axis][lane] = ray.direction[axis];
            }
        }
        let splat = |number: f64| f64x8::splat(simd, number);
        let [dx, dy, dz] = directions.map(|axis| f64x8::from_slice(simd, &axis));
        let (abs_x, abs_y, abs_z) = (dx.abs(), dy.abs(), dz.abs());
        let is_over_y = abs_x.simd_gt(abs_y);
        let along_x = is_over_y & abs_x.simd_gt(abs_z);
        let along_y = !is_over_y & abs_y.simd_gt(abs_z);
        let permuted = |[x, y, z]: [f64x8<S>; 3]| {
            [
                along_x.select(y, along_y.select(z, x)),
                along_x.select(z, along_y.select(x, y)),
                along_x.select(x, along_y.select(y, z)),
            ]
        };
        let [x, y, z] = permuted([dx, dy, dz]);
        let scale = splat(bvh.frame.scale);
        let boxed: [f64x8<S>; 3] = std::array::from_fn(|axis| {
            (f64x8::from_slice(simd, &origins[axis]) - splat(bvh.frame.center[axis])) * scale
        });
        let start = permuted(boxed);
        let distance = greater(greater(start[0].abs(), start[1].abs()), start[2].abs());
        let most = splat(MAX_DISTANCE);
        let mut is_valid = start[0].abs().simd_le(most)
            & start[1].abs().simd_le(most)
            & start[2].abs().simd_le(most)
            & x.abs().simd_le(z.abs())
            & y.abs().simd_le(z.abs())
            & z.abs().simd_gt(splat(0.0))
            & z.abs().simd_le(splat(f64::MAX));
        let slopes = [x / z, y / z];
        // BoxRay::new.
        let padding = splat(power_of_two(-20)) + splat(power_of_two(-48)) * (distance + splat(2.0));
        let sign = splat(1.0).copysign(z);
        let depth_z = -sign - start[2];
        let [q_x, q_y] = [start[0] + depth_z * slopes[0], start[1] + depth_z * slopes[1]];
        let is_far = padding.simd_gt(splat(MAX_PADDING));
        let widest = splat(3.0) + splat(2.0) * padding;
        is_valid &= is_far | (q_x.abs().simd_le(widest) & q_y.abs().simd_le(widest));
        let zero = splat(0.0);
        let (q_x, q_y) = (is_far.select(zero, q_x), is_far.select(zero, q_y));
        let line_padding = is_far.select(splat(MAX_PADDING), padding);
        let reciprocal = |speed: f64x8<S>| {
            let reciprocal = z.abs() / speed;
            let size = reciprocal.abs();
            let most = splat(MAX_RECIPROCAL);
            size.simd_lt(most).select(size, most).copysign(reciprocal)
        };
        let reciprocals = narrow3(simd, [reciprocal(x), reciprocal(y), sign]);
        let positions = narrow3(simd, [q_x, q_y, -sign]);
        let [line_padding, slope_x, slope_y] = narrow3(simd, [line_padding, slopes[0], slopes[1]]);
        let along = |axis: usize| line_padding.copysign(reciprocals[axis]);
        let entry_offsets: [f32x8<S>; 3] =
            std::array::from_fn(|axis| -(positions[axis] + along(axis)) * reciprocals[axis]);
        let exit_offsets: [f32x8<S>; 3] =
            std::array::from_fn(|axis| -(positions[axis] - along(axis)) * reciprocals[axis]);
        // BoxRay::limits.
        let at = |t: f64| splat(t) * z * scale;
        let from = (at(range.start) - depth_z) * sign - padding;
        let has_start = from.simd_gt(zero) & from.simd_le(splat(f64::MAX));
        let infinity = splat(f64::INFINITY);
        let end = if range.end < f64::INFINITY {
            let z = at(range.end);
            let end = (z - depth_z) * sign + padding;
            z.abs().simd_le(splat(f64::MAX)).select(end.simd_gt(zero).select(end, zero), infinity)
        } else {
            infinity
        };
        let [from, end, _] = narrow3(simd, [has_start.select(from, zero), end, zero]);
        let bits = |mask: mask64x8<S>| mask.to_bitmask() as u32;
        Self {
            are_valid: bits(is_valid),
            are_along: [bits(along_x), bits(along_y)],
            origins,
            starts: start.map(|axis| axis.into()),
            distances: distance.into(),
            slopes: slopes.map(|axis| axis.into()),
            speeds: z.into(),
            scale: bvh.frame.scale,
            unit: bvh.frame.unit,
            positions: positions.map(|axis| axis.into()),
            line_slopes: [slope_x.into(), slope_y.into()],
            paddings: line_padding.into(),
            entry_offsets: entry_offsets.map(|axis| axis.into()),
            exit_offsets: exit_offsets.map(|axis| axis.into()),
            reciprocals: reciprocals.map(|axis| axis.into()),
            depths_z: depth_z.into(),
            depths_padding: padding.into(),
            from: from.into(),
            ends: end.into(),
        }
    }

    /// The axes that become x, y and z.
    #[inline(always)]
    fn axes(&self, lane: usize) -> [usize; 3] {
        match self.are_along.map(|mask| mask >> lane & 1) {
            [1, _] => [1, 2, 0],
            [_, 1] => [2, 0, 1],
            _ => [0, 1, 2],
        }
    }
}

/// The greater of two numbers, unless one is NaN.
#[inline(always)]
fn greater<S: Simd>(a: f64x8<S>, b: f64x8<S>) -> f64x8<S> {
    a.simd_gt(b).select(a, b)
}

/// In single precision.
#[inline(always)]
fn narrow3<S: Simd>(_: S, [a, b, c]: [f64x8<S>; 3]) -> [f32x8<S>; 3] {
    let (a, b) = a.narrow(b).split();
    let (c, _) = c.narrow(c).split();
    [a, b, c]
}

/// One of the rays of a batch.
struct Lane<'a> {
    batch: &'a Batch,
    lane: usize,
    range: &'a Range<f64>,
}

impl Source for Lane<'_> {
    #[inline(always)]
    fn slabs(&self) -> Slabs {
        let Self { batch, lane, .. } = *self;
        let axes = batch.axes(lane);
        let at = |axes: &[[f32; WIDTH]; 3]| [axes[0][lane & 7], axes[1][lane & 7], axes[2][lane & 7]];
        let reciprocals = at(&batch.reciprocals);
        Slabs {
            entries: std::array::from_fn(|axis| 2 * axes[axis] + is_backward(reciprocals[axis])),
            entry_offsets: at(&batch.entry_offsets),
            exit_offsets: at(&batch.exit_offsets),
            reciprocals,
        }
    }

    #[inline(always)]
    fn line(&self) -> Line {
        let Self { batch, lane, .. } = *self;
        Line {
            axes: batch.axes(lane),
            position: [0, 1, 2].map(|axis| batch.positions[axis][lane & 7]),
            slopes: [0, 1].map(|axis| batch.line_slopes[axis][lane & 7]),
            padding: batch.paddings[lane & 7],
        }
    }

    #[inline(always)]
    fn shear(&self) -> Shear {
        let Self { batch, lane, .. } = *self;
        Shear {
            axes: batch.axes(lane),
            origin: [0, 1, 2].map(|axis| batch.origins[axis][lane & 7]),
            start: [0, 1, 2].map(|axis| batch.starts[axis][lane & 7]),
            distance: batch.distances[lane & 7],
            scale: batch.scale,
            unit: batch.unit,
            slopes: [0, 1].map(|axis| batch.slopes[axis][lane & 7]),
            speed: batch.speeds[lane & 7],
        }
    }

    #[inline(always)]
    fn range(&self) -> &Range<f64> {
        self.range
    }

    #[inline(always)]
    fn start(&self) -> f32 {
        self.batch.from[self.lane & 7]
    }

    #[inline(always)]
    fn limit(&self, z: f64) -> f32 {
        let Self { batch, lane, .. } = *self;
        let sign = 1.0_f64.copysign(batch.speeds[lane & 7]);
        let end = (z - batch.depths_z[lane & 7]) * sign + batch.depths_padding[lane & 7];
        if end > 0.0 { end as f32 } else { 0.0 }
    }
}
