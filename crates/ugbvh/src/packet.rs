//! The nearest hits of rays from one origin, with one traversal of the hierarchy for up to 64 rays.
//!
//! Boxes are tested against the frustum of all rays. τ, x and y are those of [`crate::box_ray`]: at
//! τ a ray is at x = q + τ s, with the same τ in a plane for all rays. As they have one origin, the
//! rays of least and of greatest s bound the others, from the origin on. Where a block is met, its
//! box is tested against each ray, eight at once, and its triangles against the rays that pass.
//!
//! Bounds are moved by twice the padding p = 16 u + 2⁻⁴⁸ (d + 2) of a single ray. A bound q + τ s
//! has errors of 2 u from q, u from s, 2 u from τ, 2 u from the product and 4 u from the sum, as no
//! operand is greater than 5; planes have errors of u / 2 and their sums with 2 p of 2 u; and a hit
//! is within ε = 2⁻³⁰ + 2⁻⁵⁰ (d + 2) of the box. Together that is less than 2 p.

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, f32x8};
use glam::DVec3;

use crate::box_ray::{Depths, Line};
use crate::closest::{keep_nearest, lowest};
use crate::frame::power_of_two;
use crate::nodes::{Block, IS_BLOCK, Node, WIDTH};
use crate::shear::Shear;
use crate::stack::{Entry, Stack};
use crate::{Bvh, Hit, Ray, Triangle};

/// Rays of a packet.
const LEN: usize = 64;

/// Rays tested at once.
const GROUPS: usize = LEN / WIDTH;

/// Greatest padding of packets; beyond it, rays are traced each by itself.
const MAX_PADDING: f64 = power_of_two(-10);

pub fn closest(
    bvh: &Bvh,
    origin: DVec3,
    directions: &[DVec3],
    range: &Range<f64>,
    hits: &mut [Option<Hit>],
) {
    for (directions, hits) in directions.chunks(LEN).zip(hits.chunks_mut(LEN)) {
        let n = directions.len().min(hits.len());
        let (directions, hits) = (&directions[..n], &mut hits[..n]);
        hits.fill(None);
        let is_done =
            dispatch!(bvh.level, simd => closest_on(simd, bvh, origin, directions, range, hits));
        if !is_done {
            for (&direction, hit) in directions.iter().zip(hits) {
                *hit = bvh.closest(&Ray { origin, direction }, range.clone());
            }
        }
    }
}

/// Rays of a packet, by group and lane.
struct Packet {
    /// x and y where τ is 0, and for each unit of τ.
    positions: [[[f32; WIDTH]; GROUPS]; 2],
    slopes: [[[f32; WIDTH]; GROUPS]; 2],
    /// Greatest τ of hits of interest; −1 for rays without hits.
    ends: [[f32; WIDTH]; GROUPS],
    /// The exact slopes and speed.
    exact: [([f64; 2], f64); LEN],
}

/// Returns false if the rays have to be traced each by itself.
#[inline(always)]
fn closest_on<S: Simd>(
    simd: S,
    bvh: &Bvh,
    origin: DVec3,
    directions: &[DVec3],
    range: &Range<f64>,
    hits: &mut [Option<Hit>],
) -> bool {
    // False for NaN. Before the origin the rays of least slope are the upper bound.
    let is_forward = range.start >= 0.0 && range.start < range.end;
    if !is_forward || bvh.nodes.is_empty() {
        return false;
    }
    let origin = origin.to_array();
    let shear =
        directions.first().and_then(|first| Shear::new(&bvh.frame, origin, first.to_array()));
    let Some(shear) = shear else { return false };
    let depths = Depths::new(&shear);
    if depths.padding > MAX_PADDING {
        return false;
    }
    let Some((mut packet, frustum)) = Packet::new(simd, &shear, &depths, directions, range) else {
        return false;
    };
    let search = Search { simd, bvh, shear, depths, frustum, range };
    let mut end = packet.end();
    let mut stack = Stack::empty();
    let mut node = &bvh.nodes[0];
    let mut idx = 0;
    loop {
        let (near, mask) = search.frustum.intersect(simd, node, end);
        push_sorted(&mut stack, idx, &near, mask);
        loop {
            let Some(entry) = stack.pop() else { return true };
            if entry > Entry::limit(end) {
                continue;
            }
            let (parent, child) = (entry.child() as usize / WIDTH, entry.child() as usize % WIDTH);
            let parent = &bvh.nodes[parent];
            let row = parent.children()[child];
            if row & IS_BLOCK == 0 {
                idx = row as usize;
                node = &bvh.nodes[idx];
                break;
            }
            let block = &bvh.blocks[(row & !IS_BLOCK) as usize];
            if search.trace_block((parent, child), block, &mut packet, hits) {
                end = packet.end();
            }
        }
    }
}

/// Pushes the children of a node that are in a mask, the nearest last, so that it is popped first.
#[inline(always)]
fn push_sorted(stack: &mut Stack, node: usize, near: &[f32; WIDTH], mut mask: u32) {
    let mut entries = [Entry::new(0.0, 0); WIDTH];
    let mut n = 0;
    while mask != 0 {
        let child = lowest(mask);
        mask &= mask - 1;
        let entry = Entry::new(near[child], (node * WIDTH + child) as u32);
        let mut at = n;
        while at > 0 && entries[at - 1] < entry {
            entries[at] = entries[at - 1];
            at -= 1;
        }
        entries[at] = entry;
        n += 1;
    }
    for entry in &entries[..n] {
        stack.push(*entry);
    }
}

impl Packet {
    /// Returns `None` if rays have different main axes.
    #[inline(always)]
    fn new<S: Simd>(
        simd: S,
        first: &Shear,
        depths: &Depths,
        directions: &[DVec3],
        range: &Range<f64>,
    ) -> Option<(Self, Frustum<S>)> {
        let mut packet = Self {
            positions: [[[0.0; WIDTH]; GROUPS]; 2],
            slopes: [[[0.0; WIDTH]; GROUPS]; 2],
            ends: [[-1.0; WIDTH]; GROUPS],
            exact: [([0.0; 2], 0.0); LEN],
        };
        let Depths { z, sign, padding } = *depths;
        let widest = 3.0 + 2.0 * padding;
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for (idx, direction) in directions.iter().enumerate().take(LEN) {
            let shear = first.with_direction(direction.to_array())?;
            let [x, y] = shear.slopes;
            let positions = [first.start[0] + z * x, first.start[1] + z * y];
            let (group, lane) = (idx / WIDTH, idx % WIDTH);
            packet.exact[idx] = (shear.slopes, shear.speed);
            packet.positions[0][group][lane] = positions[0] as f32;
            packet.positions[1][group][lane] = positions[1] as f32;
            packet.slopes[0][group][lane] = (x * sign) as f32;
            packet.slopes[1][group][lane] = (y * sign) as f32;
            // Others miss the cube.
            if positions[0].abs() <= widest && positions[1].abs() <= widest {
                packet.ends[group][lane] = depths.end(&shear, range.end);
                low = [low[0].min(x * sign), low[1].min(y * sign)];
                high = [high[0].max(x * sign), high[1].max(y * sign)];
            }
        }
        let ahead = z * sign;
        let bound = |slope: f64, axis: usize| {
            let slope = if slope.is_finite() { slope } else { 0.0 };
            [(first.start[axis] + ahead * slope) as f32, slope as f32]
        };
        let padding = 2.0 * padding as f32;
        let [low_x, low_y] = [bound(low[0], 0), bound(low[1], 1)];
        let [high_x, high_y] = [bound(high[0], 0), bound(high[1], 1)];
        let [axis_x, axis_y, axis_z] = first.axes;
        let frustum = Frustum {
            planes: [2 * axis_x, 2 * axis_y, 2 * axis_z + usize::from(sign < 0.0)],
            lows: [Bound::new(simd, low_x), Bound::new(simd, low_y)],
            highs: [Bound::new(simd, high_x), Bound::new(simd, high_y)],
            sign: sign as f32,
            start: ((-ahead) as f32 - padding).max(0.0),
            padding,
        };
        Some((packet, frustum))
    }

    /// Greatest τ of hits of interest of any ray.
    #[inline(always)]
    fn end(&self) -> f32 {
        let mut end = [-1.0_f32; WIDTH];
        for ends in &self.ends {
            for lane in 0..WIDTH {
                end[lane] = if ends[lane] > end[lane] { ends[lane] } else { end[lane] };
            }
        }
        end.into_iter().fold(-1.0, f32::max)
    }
}

/// A ray that bounds all others: its x or y where τ is 0, and its slope.
struct Bound<S: Simd> {
    position: f32x8<S>,
    slope: f32x8<S>,
    is_rising: bool,
}

impl<S: Simd> Bound<S> {
    #[inline(always)]
    fn new(simd: S, [position, slope]: [f32; 2]) -> Self {
        Self {
            position: f32x8::splat(simd, position),
            slope: f32x8::splat(simd, slope),
            is_rising: slope >= 0.0,
        }
    }

    #[inline(always)]
    fn at(&self, depth: f32x8<S>) -> f32x8<S> {
        self.position + depth * self.slope
    }
}

/// All rays of a packet, from the origin on.
struct Frustum<S: Simd> {
    /// Planes of a node: least x and y, and where the rays enter. See [`Node::opposite`].
    planes: [usize; 3],
    lows: [Bound<S>; 2],
    highs: [Bound<S>; 2],
    sign: f32,
    /// τ of the origin, or 0 if it is before the cube.
    start: f32,
    /// 2 p
    padding: f32,
}

impl<S: Simd> Frustum<S> {
    /// Where the rays enter each box, and a mask of those they may hit up to τ = `end`.
    #[inline(always)]
    fn intersect(&self, simd: S, node: &Node, end: f32) -> ([f32; WIDTH], u32) {
        let padding = f32x8::splat(simd, self.padding);
        let start = f32x8::splat(simd, self.start);
        let near = node.planes(simd, self.planes[2]) * self.sign + 1.0;
        let far = node.opposite(simd, self.planes[2]) * self.sign + 1.0;
        let entry = (near - padding).max(start);
        let near = near.max(start);
        let mut is_hit = entry.simd_le(f32x8::splat(simd, end)) & start.simd_le(far + padding);
        for axis in 0..2 {
            let (low, high) = (&self.lows[axis], &self.highs[axis]);
            let least = low.at(if low.is_rising { near } else { far });
            let greatest = high.at(if high.is_rising { far } else { near });
            let from = node.planes(simd, self.planes[axis]) - padding;
            let to = node.opposite(simd, self.planes[axis]) + padding;
            is_hit = is_hit & least.simd_le(to) & greatest.simd_ge(from);
        }
        (entry.into(), is_hit.to_bitmask() as u32)
    }

    /// A mask of rays of a group that may hit the box of a child.
    #[inline(always)]
    fn rays_at(&self, simd: S, packet: &Packet, group: usize, node: &Node, child: usize) -> u32 {
        let near = node.plane(self.planes[2], child) * self.sign + 1.0;
        let far = node.plane(self.planes[2] ^ 1, child) * self.sign + 1.0;
        let end = f32x8::from_slice(simd, &packet.ends[group]);
        let mut is_hit = end.simd_ge(f32x8::splat(simd, near - self.padding));
        for axis in 0..2 {
            let position = f32x8::from_slice(simd, &packet.positions[axis][group]);
            let slope = f32x8::from_slice(simd, &packet.slopes[axis][group]);
            let (a, b) = (position + slope * near, position + slope * far);
            let from = node.plane(self.planes[axis], child) - self.padding;
            let to = node.plane(self.planes[axis] ^ 1, child) + self.padding;
            is_hit = is_hit
                & a.min(b).simd_le(f32x8::splat(simd, to))
                & a.max(b).simd_ge(f32x8::splat(simd, from));
        }
        is_hit.to_bitmask() as u32
    }
}

/// The constants of a traversal.
struct Search<'a, S: Simd> {
    simd: S,
    bvh: &'a Bvh,
    /// The first ray.
    shear: Shear,
    depths: Depths,
    frustum: Frustum<S>,
    range: &'a Range<f64>,
}

impl<S: Simd> Search<'_, S> {
    /// Tests the triangles of a block, which is a child of a node. Returns true if a ray has a
    /// nearer hit than before.
    #[inline(always)]
    fn trace_block(
        &self,
        (parent, child): (&Node, usize),
        block: &Block,
        packet: &mut Packet,
        hits: &mut [Option<Hit>],
    ) -> bool {
        let mut has_hit = false;
        for group in 0..GROUPS {
            let mut rays = self.frustum.rays_at(self.simd, packet, group, parent, child);
            while rays != 0 {
                let lane = lowest(rays);
                rays &= rays - 1;
                let mut mask = block.candidates(self.simd, &self.line(packet, group, lane));
                while mask != 0 {
                    let triangle = self.bvh.triangles[block.first as usize + lowest(mask)];
                    mask &= mask - 1;
                    has_hit |= self.trace_triangle(&triangle, packet, group, lane, hits);
                }
            }
        }
        has_hit
    }

    /// A ray for the test of a block.
    #[inline(always)]
    fn line(&self, packet: &Packet, group: usize, lane: usize) -> Line {
        let (slopes, _) = packet.exact[group * WIDTH + lane];
        let [x, y] = [packet.positions[0][group][lane], packet.positions[1][group][lane]];
        Line {
            axes: self.shear.axes,
            position: [x, y, -self.depths.sign as f32],
            slopes: [slopes[0] as f32, slopes[1] as f32],
            padding: self.depths.padding as f32,
        }
    }

    /// Returns true if the ray has a nearer hit than before.
    #[inline(always)]
    fn trace_triangle(
        &self,
        triangle: &Triangle,
        packet: &mut Packet,
        group: usize,
        lane: usize,
        hits: &mut [Option<Hit>],
    ) -> bool {
        let idx = group * WIDTH + lane;
        let (slopes, speed) = packet.exact[idx];
        let shear = Shear { slopes, speed, ..self.shear };
        let Some(crossing) = shear.intersect(self.bvh.corners(triangle)) else { return false };
        let is_hit = self.range.start < crossing.t
            && crossing.t < self.range.end
            && keep_nearest(&mut hits[idx], &crossing, triangle.index);
        if is_hit {
            let end = &mut packet.ends[group][lane];
            *end = end.min(self.depths.limit(crossing.z));
        }
        is_hit
    }
}
