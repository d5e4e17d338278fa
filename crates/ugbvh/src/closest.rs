//! Searches along a single ray, nearest boxes first.

use std::ops::{ControlFlow, Range};

use fearless_simd::{Simd, dispatch};

use crate::box_ray::BoxRay;
use crate::nodes::{IS_BLOCK, SimdRay, WIDTH};
use crate::shear::{Crossing, Shear, Simple};
use crate::stack::{Entry, N_FIRST, Stack};
use crate::{Bvh, Hit, Ray, Triangle};

/// Replaces a hit by a nearer one. Returns true if it did.
#[inline(always)]
pub fn keep_nearest(hit: &mut Option<Hit>, crossing: &Crossing, triangle: u32) -> bool {
    let is_nearer = hit
        .is_none_or(|hit| crossing.t < hit.t || (crossing.t == hit.t && triangle < hit.triangle));
    if is_nearer {
        *hit = Some(Hit { t: crossing.t, triangle, u: crossing.u, v: crossing.v });
    }
    is_nearer
}

/// [`keep_nearest`] for a hit that may not be in a range.
#[inline(always)]
fn keep_nearest_in(
    range: &Range<f64>,
    hit: &mut Option<Hit>,
    crossing: &Crossing,
    triangle: u32,
) -> bool {
    range.start < crossing.t && crossing.t < range.end && keep_nearest(hit, crossing, triangle)
}

/// A ray ready for a search. It is prepared where it is made, in registers: loading it again right
/// after it was stored, in other pieces, took a quarter of that time.
pub struct Prepared {
    pub shear: Shear,
    pub box_ray: BoxRay,
    pub range: Range<f64>,
    /// The range of τ.
    pub depths: Range<f32>,
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

#[inline(always)]
pub fn closest(bvh: &Bvh, ray: &Prepared) -> Option<Hit> {
    let mut walk = Walk::new(ray.depths.end);
    let mut hit = None;
    loop {
        match dispatch!(bvh.level, simd => walk_on::<_, false>(simd, bvh, ray, &mut walk, &mut hit))
        {
            Stop::Empty if !walk.stack.refill() => return hit,
            Stop::Empty => {}
            stop => walk.resume(bvh, ray, stop, &mut hit, false),
        }
    }
}

pub fn visit(
    bvh: &Bvh,
    ray: &Prepared,
    visit: &mut impl FnMut(Hit) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let mut walk = Walk::new(ray.depths.end);
    loop {
        let mut hit = None;
        match walk_to_hit(bvh, ray, &mut walk, &mut hit) {
            Stop::Empty if !walk.stack.refill() => return ControlFlow::Continue(()),
            Stop::Empty => {}
            stop => walk.resume(bvh, ray, stop, &mut hit, true),
        }
        if let Some(hit) = hit {
            visit(hit)?;
        }
    }
}

/// Not generic, so compiled once.
fn walk_to_hit(bvh: &Bvh, ray: &Prepared, walk: &mut Walk, hit: &mut Option<Hit>) -> Stop {
    dispatch!(bvh.level, simd => walk_on::<_, true>(simd, bvh, ray, walk, hit))
}

/// The state of a search.
struct Walk {
    stack: Stack,
    /// Triangles of the next block that are to be tested.
    triangles: u32,
    /// Greatest τ of hits of interest.
    end: f32,
}

/// Why a search stops. Rare cases are handled by its caller, as functions called in its loop would
/// keep the ray out of vector registers.
enum Stop {
    /// The array of the stack is empty.
    Empty,
    /// The array of the stack has no room for the children of this node.
    Full(u32),
    /// There is a hit in the block of this child; a mask of its triangles that are left.
    Hit(u32, u32),
    /// The same for a triangle that has to be tested exactly.
    Unsafe(u32, u32, Triangle),
}

impl Walk {
    /// Starts at the root, for hits up to a τ.
    #[inline(always)]
    fn new(end: f32) -> Self {
        Self { stack: Stack::with_root(), triangles: u32::MAX, end }
    }

    /// Handles the case a search stopped for, so that it can continue. `each`: as of [`walk_on`].
    #[cold]
    #[inline(never)]
    fn resume(&mut self, bvh: &Bvh, ray: &Prepared, stop: Stop, hit: &mut Option<Hit>, each: bool) {
        let (child, left) = match stop {
            Stop::Empty => return,
            Stop::Full(child) => {
                self.stack.make_room();
                (child, u32::MAX)
            }
            Stop::Hit(child, left) => (child, left),
            Stop::Unsafe(child, left, triangle) => {
                let crossing = ray.shear.intersect_exactly(bvh.corners(&triangle));
                if let Some(crossing) = crossing
                    && keep_nearest_in(&ray.range, hit, &crossing, triangle.index)
                    && !each
                {
                    self.end = self.end.min(ray.box_ray.limit(crossing.z));
                }
                (child, left)
            }
        };
        if left != 0 {
            self.stack.push(Entry::new(0.0, child));
            self.triangles = left;
        }
    }
}

/// Continues a search until it stops. With `EACH` it stops at every hit, otherwise it keeps the
/// nearest.
///
/// Parts of the ray are copied where they are used: by reference, single rays took a fifth more
/// time.
#[inline(always)]
fn walk_on<S: Simd, const EACH: bool>(
    simd: S,
    bvh: &Bvh,
    ray: &Prepared,
    walk: &mut Walk,
    nearest_hit: &mut Option<Hit>,
) -> Stop {
    let simd_ray = SimdRay::new(simd, &{ ray.box_ray.slabs });
    let start = ray.depths.start;
    let mut end = walk.end;
    let mut n = walk.stack.n;
    let mut child = 0;
    let mut is_popped = true;
    loop {
        if is_popped {
            let Some(below) = n.checked_sub(1) else {
                (walk.stack.n, walk.end) = (0, end);
                return Stop::Empty;
            };
            n = below;
            let entry = walk.stack.first[n % N_FIRST];
            if entry > Entry::limit(end) {
                continue;
            }
            child = entry.child();
        }
        if child & IS_BLOCK == 0 {
            let node = &bvh.nodes[child as usize];
            let (near, mut mask) = node.intersect(simd, &simd_ray, start, end);
            is_popped = mask == 0;
            if is_popped {
                continue;
            }
            let idx = lowest(mask);
            mask &= mask - 1;
            let first = node.children()[idx];
            if mask == 0 {
                child = first;
                continue;
            }
            if n > N_FIRST - WIDTH {
                (walk.stack.n, walk.end) = (n, end);
                return Stop::Full(child);
            }
            let mut nearest = Entry::new(near[idx], first);
            while mask != 0 {
                let idx = lowest(mask);
                mask &= mask - 1;
                let other = Entry::new(near[idx], node.children()[idx]);
                walk.stack.first[n % N_FIRST] = nearest.max(other);
                n += 1;
                nearest = nearest.min(other);
            }
            child = nearest.child();
            continue;
        }
        is_popped = true;
        let block = &bvh.blocks[(child & !IS_BLOCK) as usize];
        let mut mask = block.candidates(simd, &{ ray.box_ray.line }) & walk.triangles;
        walk.triangles = u32::MAX;
        while mask != 0 {
            let triangle = bvh.triangles[block.first as usize + lowest(mask)];
            mask &= mask - 1;
            match { ray.shear }.intersect_simply(bvh.corners(&triangle)) {
                Simple::Miss => {}
                Simple::Crossing(crossing) => {
                    if keep_nearest_in(&ray.range, nearest_hit, &crossing, triangle.index) {
                        if EACH {
                            walk.stack.n = n;
                            return Stop::Hit(child, mask);
                        }
                        end = end.min(ray.box_ray.limit(crossing.z));
                    }
                }
                Simple::Unsafe => {
                    (walk.stack.n, walk.end) = (n, end);
                    return Stop::Unsafe(child, mask, triangle);
                }
            }
        }
    }
}

/// Index of the lowest bit of a mask of up to eight.
#[inline(always)]
pub fn lowest(mask: u32) -> usize {
    mask.trailing_zeros() as usize & 7
}
