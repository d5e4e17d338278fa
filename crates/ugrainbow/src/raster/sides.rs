//! Where the outline of a triangle crosses the rows of samples.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x4, f64x8};

use super::rows::STEPS;
use super::triangles::Point;

/// An edge as a function of the row.
#[derive(Clone, Copy, Default)]
struct Side {
    /// Its upper end.
    x: f64,
    y: f64,
    slope: f64,
}

impl Side {
    /// The very numbers of [`super::Scanner`], so that triangles and polygons share edges exactly.
    #[inline(always)]
    fn new(top: &Point, bottom: &Point) -> Self {
        let per_row = 1.0 / (bottom.y - top.y);
        Self { x: top.x, y: top.y, slope: (bottom.x - top.x) * per_row }
    }

    /// Where the middles of rows cross it.
    #[inline(always)]
    fn at<S: Simd>(&self, centers: f64x8<S>) -> f64x8<S> {
        (centers - self.y) * self.slope + self.x
    }
}

/// Rows that are computed together.
pub const ROWS: usize = 8;

/// The outline of a triangle.
#[derive(Clone, Copy, Default)]
pub struct Outline {
    long: Side,
    /// Above and below the knee.
    short: [Side; 2],
    knee: u32,
}

/// For some rows the first sample, and one past the last.
pub type Spans = [[i32; ROWS]; 2];

impl Outline {
    /// Of corners, the highest first. `knee`: the first row of samples below the middle one.
    #[inline(always)] // As all of a triangle: see `Shapes::draw`.
    pub fn new([top, middle, bottom]: [&Point; 3], knee: u32) -> Self {
        Self {
            long: Side::new(top, bottom),
            short: [Side::new(top, middle), Side::new(middle, bottom)],
            knee,
        }
    }

    /// The samples in rows from `row` on, in columns from `start` on; and whether there are any above `end_row`.
    #[inline(always)]
    pub fn spans<S: Simd>(&self, simd: S, [row, end_row]: [u32; 2], [start, end]: [u32; 2]) -> (Spans, bool) {
        let [upper, lower] = &self.short;
        let steps: f64x4<S> = STEPS.simd_into(simd);
        let centers = simd.combine_f64x4(steps, steps + 4.0) + (f64::from(row) + 0.5);
        // No `map` here: what it calls would not be compiled into this.
        let (a, upper, lower) = (self.long.at(centers), upper.at(centers), lower.at(centers));
        let is_upper = centers.simd_lt(f64x8::splat(simd, f64::from(self.knee)));
        let b = is_upper.select(upper, lower);
        let is_first = a.simd_gt(b);
        let columns = (f64x8::splat(simd, f64::from(start)), f64x8::splat(simd, f64::from(end)));
        let first = first_columns(is_first.select(b, a), columns);
        let end = first_columns(is_first.select(a, b), columns);
        let is_row = centers.simd_lt(f64x8::splat(simd, f64::from(end_row)));
        let has_samples = (first.simd_lt(end) & is_row).any_true();
        // Whole numbers up to 2²⁴ stay what they are, and no corner is further; beyond, both ends are the same.
        let (first, end) = simd.cvt_i32_f32x16(simd.narrow_f64x8(first, end)).split();
        ([first.into(), end.into()], has_samples)
    }
}

/// The first centres at or behind places, in some columns.
#[inline(always)]
fn first_columns<S: Simd>(places: f64x8<S>, (start, end): (f64x8<S>, f64x8<S>)) -> f64x8<S> {
    (places - 0.5).ceil().max(start).min(end)
}
