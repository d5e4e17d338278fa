//! Searches along a single ray, nearest boxes first.

use std::ops::{ControlFlow, Range};

use fearless_simd::{Simd, dispatch};

use crate::box_ray::BoxRay;
use crate::nodes::{IS_BLOCK, Node, SimdRay, WIDTH};
use crate::shear::{Crossing, Shear};
use crate::stack::{Entry, Stack};
use crate::{Bvh, Hit, Ray, Work};

/// Counts work, or does not.
pub trait Count {
    fn node(&mut self) {}
    fn block(&mut self) {}
    fn triangle(&mut self) {}
}

impl Count for () {}

impl Count for Work {
    fn node(&mut self) {
        self.nodes += 1;
    }

    fn block(&mut self) {
        self.blocks += 1;
    }

    fn triangle(&mut self) {
        self.triangles += 1;
    }
}

/// What a search does with hits.
trait Search {
    /// Receives a hit in the range of the search. Returns true if farther hits are no longer of
    /// interest.
    fn hit(&mut self, crossing: &Crossing, triangle: u32) -> ControlFlow<(), bool>;
}

/// Keeps the nearest hit.
struct Nearest {
    hit: Option<Hit>,
}

impl Search for Nearest {
    #[inline(always)]
    fn hit(&mut self, crossing: &Crossing, triangle: u32) -> ControlFlow<(), bool> {
        ControlFlow::Continue(keep_nearest(&mut self.hit, crossing, triangle))
    }
}

/// Replaces a hit by a nearer one. Returns true if it did.
#[inline(always)]
pub fn keep_nearest(hit: &mut Option<Hit>, crossing: &Crossing, triangle: u32) -> bool {
    let is_nearer =
        hit.is_none_or(|hit| crossing.t < hit.t || (crossing.t == hit.t && triangle < hit.triangle));
    if is_nearer {
        *hit = Some(Hit { t: crossing.t, triangle, u: crossing.u, v: crossing.v });
    }
    is_nearer
}

/// Passes all hits on.
struct All<'a, F>(&'a mut F);

impl<F: FnMut(Hit) -> ControlFlow<()>> Search for All<'_, F> {
    #[inline(always)]
    fn hit(&mut self, crossing: &Crossing, triangle: u32) -> ControlFlow<(), bool> {
        self.0(Hit { t: crossing.t, triangle, u: crossing.u, v: crossing.v })?;
        ControlFlow::Continue(false)
    }
}

/// A ray ready for a search. It is prepared where it is made, in registers: loading it again right
/// after it was stored, in other pieces, took a quarter of that time.
pub struct Prepared {
    shear: Shear,
    box_ray: BoxRay,
    range: Range<f64>,
    /// The range of τ.
    depths: Range<f32>,
}

impl Prepared {
    /// Returns `None` for rays that hit nothing.
    #[inline(always)]
    pub fn new(bvh: &Bvh, ray: &Ray, range: Range<f64>) -> Option<Self> {
        // NaN fails the comparison.
        let has_length = range.start < range.end;
        if bvh.nodes.is_empty() || !has_length {
            return None;
        }
        let direction = ray.direction.to_array();
        let shear = Shear::new(&bvh.frame, ray.origin.to_array(), direction)?;
        let box_ray = BoxRay::new(&shear, direction)?;
        let depths = box_ray.limits(&shear, &range);
        Some(Self { shear, box_ray, range, depths })
    }
}

pub fn closest(bvh: &Bvh, ray: &Prepared, count: &mut impl Count) -> Option<Hit> {
    let mut nearest = Nearest { hit: None };
    // A search for the nearest hit never breaks.
    let _ = dispatch!(bvh.level, simd => search(simd, bvh, ray, &mut nearest, count));
    nearest.hit
}

pub fn visit(bvh: &Bvh, ray: &Prepared, visit: &mut impl FnMut(Hit) -> ControlFlow<()>) -> ControlFlow<()> {
    dispatch!(bvh.level, simd => search(simd, bvh, ray, &mut All(visit), &mut ()))
}

#[inline(always)]
fn search<S: Simd>(
    simd: S,
    bvh: &Bvh,
    ray: &Prepared,
    search: &mut impl Search,
    count: &mut impl Count,
) -> ControlFlow<()> {
    let Prepared { shear, box_ray, range, depths } = ray;
    let Range { start, mut end } = *depths;
    let simd_ray = SimdRay::new(simd, box_ray);
    let mut stack = Stack::new();
    let mut child = 0;
    loop {
        if child & IS_BLOCK == 0 {
            let node = &bvh.nodes[child as usize];
            count.node();
            let (near, mut mask) = node.intersect(simd, &simd_ray, start, end);
            if mask != 0 {
                let first = lowest(mask);
                mask &= mask - 1;
                child = node.children[first];
                if mask != 0 {
                    child = push_others(&mut stack, node, &near, Entry::new(near[first], child), mask);
                }
                continue;
            }
        } else {
            let block = &bvh.blocks[(child & !IS_BLOCK) as usize];
            count.block();
            let mut mask = block.candidates(simd, &box_ray.line);
            while mask != 0 {
                let triangle = bvh.triangles[block.first as usize + lowest(mask)];
                mask &= mask - 1;
                count.triangle();
                let Some(crossing) = shear.intersect(bvh.corners(&triangle)) else { continue };
                let is_in_range = range.start < crossing.t && crossing.t < range.end;
                if is_in_range && search.hit(&crossing, triangle.index)? {
                    end = end.min(box_ray.limit(crossing.z));
                }
            }
        }
        loop {
            let Some(next) = stack.pop() else { return ControlFlow::Continue(()) };
            if next <= Entry::limit(end) {
                child = next.child();
                break;
            }
        }
    }
}

/// Pushes the children in a mask and `nearest`, except the nearest of all, which is returned.
#[inline(always)]
fn push_others(
    stack: &mut Stack,
    node: &Node,
    near: &[f32; WIDTH],
    mut nearest: Entry,
    mut mask: u32,
) -> u32 {
    while mask != 0 {
        let idx = lowest(mask);
        mask &= mask - 1;
        let other = Entry::new(near[idx], node.children[idx]);
        stack.push(nearest.max(other));
        nearest = nearest.min(other);
    }
    nearest.child()
}

/// Index of the lowest bit of a mask of up to eight.
#[inline(always)]
pub fn lowest(mask: u32) -> usize {
    mask.trailing_zeros() as usize & 7
}
