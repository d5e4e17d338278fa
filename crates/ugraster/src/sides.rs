//! Where the outlines of triangles cross the rows of samples.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8};

use crate::block::{BLOCK, Corners, Each, first_centers, whole};

/// Edges as functions of the row.
#[derive(Clone, Copy)]
struct Sides<S: Simd> {
    /// Their upper ends.
    x: f64x8<S>,
    y: f64x8<S>,
    slope: f64x8<S>,
}

impl<S: Simd> Sides<S> {
    /// The very numbers of [`crate::Scanner`], so that triangles and polygons share edges exactly.
    #[inline(always)]
    fn new(simd: S, top: &Corners<S>, bottom: &Corners<S>) -> Self {
        let per_row = f64x8::splat(simd, 1.0) / (bottom.y - top.y);
        Self { x: top.x, y: top.y, slope: (bottom.x - top.x) * per_row }
    }

    /// Where the middles of rows cross them.
    #[inline(always)]
    fn at(&self, centers: f64x8<S>) -> f64x8<S> {
        (centers - self.y) * self.slope + self.x
    }
}

/// The outlines of the triangles of a block, or eight times that of one.
#[derive(Clone, Copy)]
pub struct Outlines<S: Simd> {
    long: Sides<S>,
    /// Above and below the knee.
    upper: Sides<S>,
    lower: Sides<S>,
    /// The first rows of samples below the middle corners, and one past the last.
    knee: f64x8<S>,
    end: f64x8<S>,
}

/// For each of some rows the first sample, and one past the last.
pub type Spans = [[i32; BLOCK]; 2];

impl<S: Simd> Outlines<S> {
    /// Of corners, the highest first.
    #[inline(always)] // As all of a triangle: see `Shapes::draw`.
    pub fn new(simd: S, [top, middle, bottom]: [&Corners<S>; 3], knee: f64x8<S>, end: f64x8<S>) -> Self {
        Self {
            long: Sides::new(simd, top, bottom),
            upper: Sides::new(simd, top, middle),
            lower: Sides::new(simd, middle, bottom),
            knee,
            end,
        }
    }

    /// The samples with middles in these rows, in columns from `start` on; and those that have any.
    #[inline(always)]
    pub fn spans(&self, simd: S, centers: f64x8<S>, [start, end]: [u32; 2]) -> (Spans, u64) {
        // No `map` here: what it calls would not be compiled into this.
        let (a, upper, lower) = (self.long.at(centers), self.upper.at(centers), self.lower.at(centers));
        let is_upper = centers.simd_lt(self.knee);
        let b = is_upper.select(upper, lower);
        let is_first = a.simd_gt(b);
        let (start, end) = (f64x8::splat(simd, f64::from(start)), f64x8::splat(simd, f64::from(end)));
        let first = first_centers(is_first.select(b, a), start, end);
        let end = first_centers(is_first.select(a, b), start, end);
        let has_samples = first.simd_lt(end) & centers.simd_lt(self.end);
        // No corner is further than 2²⁴; beyond, both ends are the same.
        (whole(simd, first, end), has_samples.to_bitmask())
    }
}

/// The outlines of the triangles of a block, to be looked up.
#[derive(Clone, Copy)]
pub struct KeptOutlines {
    /// Places and slopes of the long, the upper and the lower sides.
    sides: [[Each; 3]; 3],
    knee: Each,
    end: Each,
}

impl KeptOutlines {
    #[inline(always)]
    pub fn new<S: Simd>(all: &Outlines<S>) -> Self {
        let of = |side: &Sides<S>| [side.x.into(), side.y.into(), side.slope.into()];
        Self {
            sides: [of(&all.long), of(&all.upper), of(&all.lower)],
            knee: all.knee.into(),
            end: all.end.into(),
        }
    }

    /// Eight times that of one triangle.
    #[inline(always)]
    pub fn only<S: Simd>(&self, simd: S, triangle: usize) -> Outlines<S> {
        let splat = |each: &Each| f64x8::splat(simd, each[triangle]);
        let side = |[x, y, slope]: &[Each; 3]| Sides { x: splat(x), y: splat(y), slope: splat(slope) };
        let [long, upper, lower] = &self.sides;
        Outlines {
            long: side(long),
            upper: side(upper),
            lower: side(lower),
            knee: splat(&self.knee),
            end: splat(&self.end),
        }
    }
}
