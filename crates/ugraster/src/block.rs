//! Some triangles together: which of them are drawn, and on which rows.

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch, f64x8};

use crate::band::Grid;
use crate::polygons::ROUNDING;
use crate::triangles::Point;

/// Triangles that are looked at together.
pub const BLOCK: usize = 8;

/// A number for each triangle of a block.
pub type Each = [f64; BLOCK];

/// Where the corners of some triangles are.
#[derive(Clone, Copy, Debug, Default)]
pub struct Block {
    corners: [Places; 3],
}

/// The first, second or third corners of all of them.
#[derive(Clone, Copy, Debug, Default)]
struct Places {
    x: Each,
    y: Each,
    key: Each,
}

/// One corner of every triangle.
#[derive(Clone, Copy)]
pub struct Corners<S: Simd> {
    /// Columns, rows and depth keys, as in [`Point`].
    pub x: f64x8<S>,
    pub y: f64x8<S>,
    pub key: f64x8<S>,
}

/// What is found of the triangles of a block. In sets of them triangle i is bit i.
#[derive(Clone, Copy, Debug)]
pub struct Findings {
    /// All numbers of these can be had from planes through their corners, as precise as along their edges: they are no
    /// slivers, not far outside the picture, and not much nearer at one corner than at another. Of others nothing is
    /// known.
    pub regular: u64,
    /// They touch the picture, if only between samples.
    pub in_picture: u64,
    /// Samples may lie in them, and they are not left out.
    pub drawn: u64,
    /// The first band that each may touch, and one past the last.
    pub bands: [[i32; BLOCK]; 2],
}

/// Samples from the picture's corner within which planes are used.
const FAR: f64 = (1u32 << 24) as f64;

/// Twice the area over the square of the extent, below which a triangle is a sliver. The error of a plane at a
/// corner is some 2⁻⁵³ over this, relative to what the number changes in the triangle: below that of an f32.
const SLIVER: f64 = 1.0 / (1u32 << 26) as f64;

/// Between these single precision has all its digits, for a key and for one over it.
const KEYS: [f64; 2] = [1e-30, 1e30];

/// How much nearer one corner may be than another.
const MOST_KEY_RATIO: f64 = 16.0;

impl Block {
    /// Puts a triangle in.
    #[inline(always)]
    pub fn set(&mut self, triangle: usize, corners: [Point; 3]) {
        for (all, Point { x, y, key }) in self.corners.iter_mut().zip(corners) {
            (all.x[triangle], all.y[triangle], all.key[triangle]) = (x, y, key);
        }
    }

    /// First, second or third corners.
    #[inline(always)]
    pub fn corners<S: Simd>(&self, simd: S, which: usize) -> Corners<S> {
        let Places { x, y, key } = &self.corners[which];
        Corners {
            x: f64x8::from_slice(simd, x),
            y: f64x8::from_slice(simd, y),
            key: f64x8::from_slice(simd, key),
        }
    }

    /// Looks at all of them. `is_culled`: those that run clockwise are left out.
    pub fn findings(&self, level: Level, grid: &Grid, is_culled: bool) -> Findings {
        dispatch!(level, simd => self.find(simd, grid, is_culled))
    }

    #[inline(always)]
    fn find<S: Simd>(&self, simd: S, grid: &Grid, is_culled: bool) -> Findings {
        let number = |number: f64| f64x8::splat(simd, number);
        let (a, b, c) = (self.corners(simd, 0), self.corners(simd, 1), self.corners(simd, 2));
        let (left, right) = range(a.x, b.x, c.x);
        let (top, bottom) = range(a.y, b.y, c.y);
        let (least, most) = range(a.key, b.key, c.key);
        // Positive if the corners run counterclockwise as the picture is looked at.
        let twice_area = (b.y - a.y) * (c.x - a.x) - (b.x - a.x) * (c.y - a.y);
        let extent = greater(right - left, bottom - top);
        let is_near = lesser(left, top).simd_ge(number(-FAR)) & greater(right, bottom).simd_le(number(FAR));
        // What is no number is in no area and no sum that is less than anything.
        let is_number = (a.key + b.key + c.key).abs().simd_lt(number(f64::INFINITY));
        let is_wide = twice_area.abs().simd_gt(extent * extent * SLIVER);
        let mut is_regular = is_near & is_number & is_wide;
        if grid.is_perspective {
            let [low, high] = KEYS;
            is_regular &= least.simd_gt(number(low)) & most.simd_lt(number(high));
            is_regular &= most.simd_le(least * MOST_KEY_RATIO);
        }
        let (columns, rows) = (f64::from(grid.sample_columns()), f64::from(grid.sample_rows()));
        let is_in_picture = right.simd_gt(number(0.0))
            & left.simd_lt(number(columns))
            & bottom.simd_gt(number(0.0))
            & top.simd_lt(number(rows));
        let first_row = first_centers(top, number(0.0), number(rows));
        let end_row = first_centers(bottom, number(0.0), number(rows));
        let first_column = first_centers(left - ROUNDING, number(0.0), number(columns));
        let end_column = first_centers(right + ROUNDING, number(0.0), number(columns));
        let mut is_drawn =
            is_regular & is_in_picture & first_row.simd_lt(end_row) & first_column.simd_lt(end_column);
        if is_culled {
            is_drawn &= twice_area.simd_gt(number(0.0));
        }
        // The middle of a row is half a row from the nearest end of a band, so no rounding moves it there.
        let per_row = 1.0 / f64::from(grid.bands().sample_rows());
        let first_band = ((first_row + 0.5) * per_row).floor();
        let end_band = ((end_row - 0.5) * per_row).floor() + 1.0;
        Findings {
            regular: is_regular.to_bitmask(),
            in_picture: is_in_picture.to_bitmask(),
            drawn: is_drawn.to_bitmask(),
            bands: whole(simd, first_band, end_band),
        }
    }
}

/// The lesser of numbers, the second if one is none.
#[inline(always)]
pub fn lesser<S: Simd>(a: f64x8<S>, b: f64x8<S>) -> f64x8<S> {
    a.simd_lt(b).select(a, b)
}

/// The greater of numbers, the second if one is none.
#[inline(always)]
pub fn greater<S: Simd>(a: f64x8<S>, b: f64x8<S>) -> f64x8<S> {
    a.simd_gt(b).select(a, b)
}

/// The least and the greatest of three.
#[inline(always)]
fn range<S: Simd>(p: f64x8<S>, q: f64x8<S>, r: f64x8<S>) -> (f64x8<S>, f64x8<S>) {
    (lesser(lesser(p, q), r), greater(greater(p, q), r))
}

/// The first sample centres, at ½, 1½ and so on, at or behind places, but no less than `start` and no more than `end`.
#[inline(always)]
pub fn first_centers<S: Simd>(places: f64x8<S>, start: f64x8<S>, end: f64x8<S>) -> f64x8<S> {
    lesser(greater((places - 0.5).ceil(), start), end)
}

/// Whole numbers, which up to 2²⁴ stay what they are.
#[inline(always)]
pub fn whole<S: Simd>(simd: S, a: f64x8<S>, b: f64x8<S>) -> [[i32; BLOCK]; 2] {
    let (a, b) = simd.cvt_i32_f32x16(simd.narrow_f64x8(a, b)).split();
    [a.into(), b.into()]
}
