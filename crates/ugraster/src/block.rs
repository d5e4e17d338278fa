//! Eight triangles together: which of them are drawn, and in which bands.

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch, f64x8};

use crate::grid::SampleGrid;
use crate::polygons::{ROUNDING, ScreenPoint, TilePlace};

/// Triangles in a block.
pub const BLOCK: usize = 8;

/// A number for each triangle of a block.
pub type PerTriangle = [f64; BLOCK];

/// The corners of a block of triangles.
#[derive(Clone, Copy, Debug, Default)]
pub struct TriangleBlock {
    corners: [BlockCorners; 3],
}

/// The first, second or third corners of all triangles.
#[derive(Clone, Copy, Debug, Default)]
struct BlockCorners {
    x: PerTriangle,
    y: PerTriangle,
    key: PerTriangle,
}

/// One corner of every triangle of a block, in vector registers.
#[derive(Clone, Copy)]
pub struct Corners<S: Simd> {
    /// Columns, rows and depth keys, as in [`ScreenPoint`].
    pub x: f64x8<S>,
    pub y: f64x8<S>,
    pub key: f64x8<S>,
}

/// Classification of the triangles of a block. In bit sets triangle i is bit i.
#[derive(Clone, Copy, Debug)]
pub struct BlockClasses {
    /// Triangles on which all values can be computed from planes through the corners as precisely
    /// as along the edges: no slivers, not far outside the picture, and no corner much nearer than
    /// another. The other fields are meaningless for other triangles.
    pub regular: u64,
    /// Triangles that touch the picture, even if only between samples.
    pub in_picture: u64,
    /// Triangles that may contain samples and are not culled.
    pub drawn: u64,
    /// First band that each triangle may touch, and one past the last.
    bands: [[i32; BLOCK]; 2],
    /// First and last column of tiles that each triangle may touch.
    tile_columns: [[i32; BLOCK]; 2],
}

impl BlockClasses {
    /// The tiles that a drawn triangle may touch.
    #[inline]
    pub fn place(&self, triangle: usize) -> TilePlace {
        let [first, end] = self.bands.map(|bands| bands[triangle] as u32);
        let columns = self.tile_columns.map(|all| all[triangle].try_into().unwrap_or(u16::MAX));
        TilePlace { bands: first..end, columns }
    }
}

/// Distance from the corner of the picture, in samples, up to which planes are used.
const FAR: f64 = (1u32 << 24) as f64;

/// A triangle is a sliver if twice its area is less than this times its extent squared. The error
/// of a plane at a corner is about 2⁻⁵³ over this ratio, relative to the change of the value within
/// the triangle: less than the precision of f32.
const SLIVER: f64 = 1.0 / (1u32 << 26) as f64;

/// Range of depth keys in which both a key and its reciprocal have all digits of f32.
const KEYS: [f64; 2] = [1e-30, 1e30];

/// Greatest ratio of the depth keys of two corners.
const MAX_KEY_RATIO: f64 = 16.0;

impl TriangleBlock {
    /// Sets the corners of one triangle.
    #[inline(always)]
    pub fn set(&mut self, triangle: usize, corners: [ScreenPoint; 3]) {
        for (all, ScreenPoint { x, y, key }) in self.corners.iter_mut().zip(corners) {
            (all.x[triangle], all.y[triangle], all.key[triangle]) = (x, y, key);
        }
    }

    /// The first, second or third corners.
    #[inline(always)]
    pub fn corners<S: Simd>(&self, simd: S, which: usize) -> Corners<S> {
        let BlockCorners { x, y, key } = &self.corners[which];
        Corners {
            x: f64x8::from_slice(simd, x),
            y: f64x8::from_slice(simd, y),
            key: f64x8::from_slice(simd, key),
        }
    }

    /// Classifies every triangle of the block. `is_culled`: clockwise triangles are not drawn.
    pub fn classify(&self, level: Level, grid: &SampleGrid, is_culled: bool) -> BlockClasses {
        dispatch!(level, simd => self.classify_on(simd, grid, is_culled))
    }

    #[inline(always)]
    fn classify_on<S: Simd>(&self, simd: S, grid: &SampleGrid, is_culled: bool) -> BlockClasses {
        let number = |number: f64| f64x8::splat(simd, number);
        let (a, b, c) = (self.corners(simd, 0), self.corners(simd, 1), self.corners(simd, 2));
        let (left, right) = range(a.x, b.x, c.x);
        let (top, bottom) = range(a.y, b.y, c.y);
        let (least, most) = range(a.key, b.key, c.key);
        // Positive if the corners run counterclockwise on the screen, where rows go downwards.
        let twice_area = (b.y - a.y) * (c.x - a.x) - (b.x - a.x) * (c.y - a.y);
        let extent = greater(right - left, bottom - top);
        let is_near =
            lesser(left, top).simd_ge(number(-FAR)) & greater(right, bottom).simd_le(number(FAR));
        // NaN fails every comparison. A NaN coordinate makes the area NaN, and a NaN key this sum.
        let has_keys = (a.key + b.key + c.key).abs().simd_lt(number(f64::INFINITY));
        let is_wide = twice_area.abs().simd_gt(extent * extent * SLIVER);
        let mut is_regular = is_near & has_keys & is_wide;
        if grid.is_perspective {
            let [low, high] = KEYS;
            is_regular &= least.simd_gt(number(low)) & most.simd_lt(number(high));
            is_regular &= most.simd_le(least * MAX_KEY_RATIO);
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
        let mut is_drawn = is_regular
            & is_in_picture
            & first_row.simd_lt(end_row)
            & first_column.simd_lt(end_column);
        if is_culled {
            is_drawn &= twice_area.simd_gt(number(0.0));
        }
        // A sample's centre is at least half a sample away from the ends of its band and its tile, so
        // rounding of the products below cannot move it into another one.
        let per_row = 1.0 / f64::from(grid.bands().sample_rows());
        let first_band = ((first_row + 0.5) * per_row).floor();
        let end_band = ((end_row - 0.5) * per_row).floor() + 1.0;
        let tile_samples = grid.tile_columns() * grid.samples;
        let per_column = 1.0 / f64::from(tile_samples);
        let first_tile = ((first_column + 0.5) * per_column).floor();
        let last_tile = ((end_column - 0.5) * per_column).floor();
        BlockClasses {
            regular: is_regular.to_bitmask(),
            in_picture: is_in_picture.to_bitmask(),
            drawn: is_drawn.to_bitmask(),
            bands: to_integers(simd, first_band, end_band),
            tile_columns: to_integers(simd, first_tile, last_tile),
        }
    }
}

/// The lesser of numbers, `b` where either is NaN.
#[inline(always)]
pub fn lesser<S: Simd>(a: f64x8<S>, b: f64x8<S>) -> f64x8<S> {
    a.simd_lt(b).select(a, b)
}

/// The greater of numbers, `b` where either is NaN.
#[inline(always)]
pub fn greater<S: Simd>(a: f64x8<S>, b: f64x8<S>) -> f64x8<S> {
    a.simd_gt(b).select(a, b)
}

/// The least and the greatest of three.
#[inline(always)]
fn range<S: Simd>(p: f64x8<S>, q: f64x8<S>, r: f64x8<S>) -> (f64x8<S>, f64x8<S>) {
    (lesser(lesser(p, q), r), greater(greater(p, q), r))
}

/// Indices of the first sample centres (½, 1½, …) at or beyond some places, clamped to
/// `start`…`end`.
#[inline(always)]
pub fn first_centers<S: Simd>(places: f64x8<S>, start: f64x8<S>, end: f64x8<S>) -> f64x8<S> {
    lesser(greater((places - 0.5).ceil(), start), end)
}

/// Integral numbers as integers; exact up to 2²⁴.
#[inline(always)]
pub fn to_integers<S: Simd>(simd: S, a: f64x8<S>, b: f64x8<S>) -> [[i32; BLOCK]; 2] {
    let (a, b) = simd.cvt_i32_f32x16(simd.narrow_f64x8(a, b)).split();
    [a.into(), b.into()]
}
