//! Rows of triangles drawn into a tile, eight samples at once.

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch, f32x8, f64x8, mask32x8};

use crate::tile::{EMPTY, LANES, TileSamples, shared_plane};
use crate::triangles::{BlockSetup, LazyPlanes, Plane, RowTarget, TriangleRef, TriangleRow};

/// Column offsets of the lanes.
const STEPS: [f64; LANES] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

/// Draws a block of triangles into a tile where the depth test passes.
pub fn draw_block(
    level: Level,
    block: &BlockSetup<'_>,
    tile: TileSamples<'_>,
    planes: &mut LazyPlanes<'_>,
) {
    // Compiled twice: most scenes share no planes.
    if tile.planes.is_empty() {
        dispatch!(level, simd => block.draw(&mut SimdTile::<_, false> { simd, tile }, planes));
    } else {
        dispatch!(level, simd => block.draw(&mut SimdTile::<_, true> { simd, tile }, planes));
    }
}

/// A tile, drawn with one instruction set.
struct SimdTile<'a, S, const SHARES_PLANES: bool> {
    simd: S,
    tile: TileSamples<'a>,
}

impl<S: Simd, const SHARES_PLANES: bool> RowTarget for SimdTile<'_, S, SHARES_PLANES> {
    #[inline(always)]
    fn draw_row(
        &mut self,
        row: &TriangleRow,
        triangle: &TriangleRef<'_>,
        planes: &mut LazyPlanes<'_>,
    ) {
        let Self { simd, ref mut tile } = *self;
        let [first, end] = row.columns;
        let plane = if SHARES_PLANES { shared_plane(tile.planes, triangle.item()) } else { None };
        let steps: f64x8<S> = STEPS.simd_into(simd);
        let places = narrow(simd, steps);
        for column in (first..end).step_by(LANES) {
            let first = tile.sample(row.row, column);
            let nearest_keys = lanes(tile.keys, first);
            // Columns are whole numbers, so this is exact and does not depend on where a tile
            // starts.
            let across = steps + (f64::from(column) + 0.5) - row.from;
            let keys = across * row.key_per_column + row.key;
            let (key, nearest) = (narrow(simd, keys), f32x8::from_slice(simd, nearest_keys));
            let mut is_visible =
                key.simd_gt(nearest) & places.simd_lt(f32x8::splat(simd, (end - column) as f32));
            if let Some(plane) = plane {
                // Of items in one plane the first is visible.
                let hidden = are_in_plane(plane, *nearest_keys, &tile.items[first..], tile.planes);
                is_visible &= f32x8::from_slice(simd, &hidden).simd_lt(f32x8::splat(simd, 0.5));
            }
            // Early depth test: most hidden samples end here.
            if !is_visible.any_true() {
                continue;
            }
            is_visible.select(key, nearest).store_slice(nearest_keys);
            let scale = if triangle.is_perspective() {
                reciprocals(simd, keys, key)
            } else {
                f64x8::splat(simd, 1.0)
            };
            let visible = VisibleLanes { simd, first, across, scale, is_visible };
            let (values, planes) = (&mut *tile.values, planes.get(triangle));
            // Compiled twice: with a known number of values the loop over them is unrolled.
            if values.len() == USUAL_VALUES && planes.len() == USUAL_VALUES {
                visible.draw(row, &mut values[..USUAL_VALUES], &planes[..USUAL_VALUES]);
            } else {
                visible.draw(row, values, planes);
            }
            if !tile.items.is_empty() {
                for (lane, item) in lanes(tile.items, first).iter_mut().enumerate() {
                    *item = if is_visible.test(lane) { triangle.item() } else { *item };
                }
            }
        }
    }
}

/// The usual number of values: hue, saturation and value under white light, say.
const USUAL_VALUES: usize = 3;

/// Samples drawn together, where some pass the depth test.
#[derive(Clone, Copy)]
struct VisibleLanes<S: Simd> {
    simd: S,
    /// Index of the first sample in the tile.
    first: usize,
    /// Distances to the right from the highest corner.
    across: f64x8<S>,
    /// The factor that undoes the multiplication of values by the key.
    scale: f64x8<S>,
    is_visible: mask32x8<S>,
}

impl<S: Simd> VisibleLanes<S> {
    /// Draws the interpolated values.
    #[inline(always)]
    fn draw(&self, row: &TriangleRow, values: &mut [Vec<f32>], planes: &[Plane]) {
        let Self { simd, first, across, scale, is_visible } = *self;
        for (all, plane) in values.iter_mut().zip(planes) {
            let (all, start, per_column) = (lanes(all, first), plane.start(row), plane.per_column);
            // In double precision, so that a constant value keeps its bits.
            let value = narrow(simd, (across * per_column + start) * scale);
            is_visible.select(value, f32x8::from_slice(simd, all)).store_slice(all);
        }
    }
}

/// 1 for samples at which an item in a plane is visible, else 0.
#[cold]
#[inline(never)] // Or the loop over all triangles has fewer registers.
fn are_in_plane(plane: u32, keys: [f32; LANES], items: &[u32], planes: &[u32]) -> [f32; LANES] {
    std::array::from_fn(|lane| {
        let is_in_plane = keys[lane] != EMPTY && planes[items[lane] as usize] == plane;
        f32::from(u8::from(is_in_plane))
    })
}

/// Eight elements from `start` on.
#[inline(always)]
fn lanes<T>(all: &mut [T], start: usize) -> &mut [T; LANES] {
    all[start..].first_chunk_mut().expect("a tile has LANES elements more than samples")
}

/// The same numbers in single precision.
#[inline(always)]
fn narrow<S: Simd>(simd: S, numbers: f64x8<S>) -> f32x8<S> {
    simd.narrow_f64x8(numbers, numbers).split().0
}

/// Reciprocals with a relative error of 2⁻⁴⁷. `narrowed`: the same numbers in single precision, in
/// which a division takes a third of the time. One Newton step doubles the number of digits.
#[inline(always)]
fn reciprocals<S: Simd>(simd: S, numbers: f64x8<S>, narrowed: f32x8<S>) -> f64x8<S> {
    let (low, high) = simd.widen_f32x8(f32x8::splat(simd, 1.0) / narrowed);
    let rough = simd.combine_f64x4(low, high);
    rough * (f64x8::splat(simd, 2.0) - numbers * rough)
}
