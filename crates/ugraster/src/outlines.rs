//! Crossings of the outlines of triangles with rows of samples.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8};

use crate::block::{BLOCK, Corners, PerTriangle, first_centers, to_integers};

/// One side of each triangle; x is a linear function of the row.
#[derive(Clone, Copy)]
struct Sides<S: Simd> {
    /// Their upper ends.
    x: f64x8<S>,
    y: f64x8<S>,
    /// Change of x per row.
    slope: f64x8<S>,
}

impl<S: Simd> Sides<S> {
    /// The same arithmetic as in [`crate::Scanner`], so triangles and polygons share edges exactly.
    #[inline(always)]
    fn new(simd: S, top: &Corners<S>, bottom: &Corners<S>) -> Self {
        let per_row = f64x8::splat(simd, 1.0) / (bottom.y - top.y);
        Self { x: top.x, y: top.y, slope: (bottom.x - top.x) * per_row }
    }

    /// Their columns at the centres of rows.
    #[inline(always)]
    fn at(&self, centers: f64x8<S>) -> f64x8<S> {
        (centers - self.y) * self.slope + self.x
    }
}

/// The outlines of the triangles of a block, or eight times that of one triangle.
#[derive(Clone, Copy)]
pub struct Outlines<S: Simd> {
    /// From the highest to the lowest corner.
    long: Sides<S>,
    /// Above and below the middle corner.
    upper: Sides<S>,
    lower: Sides<S>,
    /// The first rows of samples below the middle corners.
    knee: f64x8<S>,
    /// One past the last rows of samples.
    end: f64x8<S>,
}

/// For each of eight rows the first sample, and one past the last.
pub type RowSpans = [[i32; BLOCK]; 2];

impl<S: Simd> Outlines<S> {
    /// `corners`: sorted, the highest first.
    #[inline(always)]
    pub fn new(simd: S, corners: [&Corners<S>; 3], knee: f64x8<S>, end: f64x8<S>) -> Self {
        let [top, middle, bottom] = corners;
        Self {
            long: Sides::new(simd, top, bottom),
            upper: Sides::new(simd, top, middle),
            lower: Sides::new(simd, middle, bottom),
            knee,
            end,
        }
    }

    /// The samples on rows with these centres, in columns from `start` to `end`; and the bit set of
    /// rows that have any.
    #[inline(always)]
    pub fn spans(&self, simd: S, centers: f64x8<S>, [start, end]: [u32; 2]) -> (RowSpans, u64) {
        // Without `map`: closures passed to it would not be compiled for the instruction set.
        let (a, upper, lower) =
            (self.long.at(centers), self.upper.at(centers), self.lower.at(centers));
        let is_upper = centers.simd_lt(self.knee);
        let b = is_upper.select(upper, lower);
        let is_first = a.simd_gt(b);
        let (start, end) =
            (f64x8::splat(simd, f64::from(start)), f64x8::splat(simd, f64::from(end)));
        let first = first_centers(is_first.select(b, a), start, end);
        let end = first_centers(is_first.select(a, b), start, end);
        let has_samples = first.simd_lt(end) & centers.simd_lt(self.end);
        // Corners are within 2²⁴, where the conversion is exact. Beyond, both ends are clamped to
        // the same column.
        (to_integers(simd, first, end), has_samples.to_bitmask())
    }
}

/// [`Outlines`] in memory, from which those of one triangle can be read.
#[derive(Clone, Copy)]
pub struct StoredOutlines {
    /// x, y and slope of the long, the upper and the lower sides.
    sides: [[PerTriangle; 3]; 3],
    knee: PerTriangle,
    end: PerTriangle,
}

impl StoredOutlines {
    /// Stores outlines.
    #[inline(always)]
    pub fn new<S: Simd>(all: &Outlines<S>) -> Self {
        let of = |side: &Sides<S>| [side.x.into(), side.y.into(), side.slope.into()];
        Self {
            sides: [of(&all.long), of(&all.upper), of(&all.lower)],
            knee: all.knee.into(),
            end: all.end.into(),
        }
    }

    /// Eight times the outline of one triangle.
    #[inline(always)]
    pub fn splat<S: Simd>(&self, simd: S, triangle: usize) -> Outlines<S> {
        let splat = |all: &PerTriangle| f64x8::splat(simd, all[triangle]);
        let side = |[x, y, slope]: &[PerTriangle; 3]| Sides {
            x: splat(x),
            y: splat(y),
            slope: splat(slope),
        };
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
