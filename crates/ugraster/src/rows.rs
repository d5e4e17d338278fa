//! The samples of a row of a triangle.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8, f64x8};

use crate::slopes::{FindPlanes, Planes};
use crate::spans::{Tag, Tile, lanes};

/// Samples of a row that are computed together.
pub const LANES: usize = 8;

/// Places of lanes.
pub const STEPS: [f64; LANES] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

impl<const N: usize, T: Tag> Tile<N, T> {
    /// Draws a row of a triangle where the depth test lets it. `planes`: of the numbers to interpolate.
    #[inline(always)]
    pub fn draw_line<S: Simd>(
        &mut self,
        simd: S,
        line: &TriangleRow,
        is_perspective: bool,
        tag: T,
        planes: &mut Planes<N, impl FindPlanes<N>>,
    ) {
        let [first, end] = line.columns;
        let steps: f64x8<S> = STEPS.simd_into(simd);
        let places = narrow(simd, steps);
        for column in (first..end).step_by(LANES) {
            let first = self.samples(line.row, column, column).start;
            let nearest_keys = lanes(&mut self.keys, first);
            // Columns are whole numbers and exact, so the answer does not depend on where a tile starts.
            let across = steps + (f64::from(column) + 0.5) - line.from;
            let keys = across * line.key_a_column + line.key;
            let (key, nearest) = (narrow(simd, keys), f32x8::from_slice(simd, nearest_keys));
            let is_seen = key.simd_gt(nearest) & places.simd_lt(f32x8::splat(simd, (end - column) as f32));
            // Early depth: most of what is hidden ends here.
            if !is_seen.any_true() {
                continue;
            }
            is_seen.select(key, nearest).store_slice(nearest_keys);
            let scale = if is_perspective { reciprocals(simd, keys, key) } else { f64x8::splat(simd, 1.0) };
            for (all, plane) in self.values.iter_mut().zip(planes.get()) {
                let (all, start, slope) = (lanes(all, first), plane.start(line), plane.a_column);
                // Double precision pays: where values do not change they stay the same bits.
                let value = narrow(simd, (across * slope + start) * scale);
                is_seen.select(value, f32x8::from_slice(simd, all)).store_slice(all);
            }
            if T::IS_KEPT {
                for (lane, tag_here) in lanes(&mut self.tags, first).iter_mut().enumerate() {
                    *tag_here = if is_seen.test(lane) { tag } else { *tag_here };
                }
            }
        }
    }
}

/// The same in single precision.
#[inline(always)]
fn narrow<S: Simd>(simd: S, numbers: f64x8<S>) -> f32x8<S> {
    simd.narrow_f64x8(numbers, numbers).split().0
}

/// One over numbers, to 2⁻⁴⁷ of it. `narrowed`: the same in single precision, in which division takes a third of the time;
/// a step of Newton's brings the other half of the digits.
#[inline(always)]
fn reciprocals<S: Simd>(simd: S, numbers: f64x8<S>, narrowed: f32x8<S>) -> f64x8<S> {
    let (low, high) = simd.widen_f32x8(f32x8::splat(simd, 1.0) / narrowed);
    let rough = simd.combine_f64x4(low, high);
    rough * (f64x8::splat(simd, 2.0) - numbers * rough)
}

/// A row of a triangle.
#[derive(Clone, Copy, Debug)]
pub struct TriangleRow {
    /// Of samples.
    pub row: u32,
    /// The first, and one past the last, in the columns of the sink.
    pub columns: [u32; 2],
    /// The column that the key, and the numbers to interpolate, are measured from.
    pub from: f64,
    /// How far it is below the highest corner.
    pub down: f64,
    /// The depth key at that column, and its change a column.
    pub key: f64,
    pub key_a_column: f64,
}

impl TriangleRow {
    /// The depth key at a column.
    #[inline]
    pub fn key_at(&self, column: f64) -> f64 {
        self.key + (column - self.from) * self.key_a_column
    }
}
