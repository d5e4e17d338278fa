//! From linear light to 8-bit display levels, exactly and fast.

use ugphysics::srgb_decode;

/// Number of cells of equal width that [0, 1] is cut into. The transfer function is
/// steepest at 0, 12.92, where 255 levels × 12.92 / 4096 is below one level a cell:
/// no cell has two thresholds, and a look-up is never more than one away from the answer.
const CELLS: usize = 4096;

/// What is rounded up to 1 when a number of a cell is added to 1: half the distance of numbers there.
const ROUNDING: f32 = 1.0 / (1 << 24) as f32;

/// What is added to a display level before what stands behind its point is cut off: a little more than a half, so that
/// what lies halfway, as grey 0.5 does, goes up even if its light was computed a few 10⁻⁷ too small.
pub const HALF: f64 = 0.500_25;

/// Rounds linear light to the nearest display level: round(255 · encode(x)), without
/// the power function of the sRGB transfer curve.
///
/// The 255 places where the rounded level changes are computed once with the exact
/// curve; a table then gives a level just at or below the answer.
#[derive(Clone, Debug)]
pub struct Quantizer {
    /// `thresholds[k]`: the linear value at which level k + 1 begins; for the last, NaN, which nothing reaches.
    thresholds: [f32; 256],
    /// The level of the lower end of each cell.
    start: [u8; CELLS],
}

impl Quantizer {
    /// Computes the tables, some ten microseconds.
    pub fn new() -> Self {
        let thresholds: [f32; 256] = std::array::from_fn(|level| match level {
            255 => f32::NAN,
            level => srgb_decode((level as f64 + 1.0 - HALF) / 255.0) as f32,
        });
        let (mut start, mut level) = ([0; CELLS], 0u8);
        for (cell, of_cell) in start.iter_mut().enumerate() {
            let low = cell as f32 / CELLS as f32 - ROUNDING;
            // Cells are narrower than levels, and the last threshold is never reached.
            level += u8::from(thresholds[usize::from(level)] <= low);
            *of_cell = level;
        }
        Self { thresholds, start }
    }

    /// The display level nearest to `linear`; values outside 0…1 (and NaN) are clipped.
    #[inline]
    pub fn level(&self, linear: f32) -> u8 {
        let level = self.start[cell(linear)];
        level + u8::from(linear >= self.thresholds[usize::from(level)])
    }
}

/// The cell of a number: of 1 plus it the first bits behind the point, which is faster than a cast.
#[inline]
fn cell(linear: f32) -> usize {
    // NaN becomes 0.
    let low = if linear > 0.0 { linear } else { 0.0 };
    // The greatest number that stays below 2 when 1 is added.
    let inside = low.min(1.0 - 2.0 * ROUNDING);
    const SHIFT: u32 = f32::MANTISSA_DIGITS - 1 - CELLS.ilog2();
    ((1.0 + inside).to_bits() >> SHIFT) as usize % CELLS
}

impl Default for Quantizer {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ugphysics::srgb_encode;

    #[test]
    fn agrees_with_the_transfer_function() {
        let quantizer = Quantizer::new();
        let steps = 200_000;
        for step in 0..=steps {
            let linear = step as f32 / steps as f32;
            let exact = 255.0 * srgb_encode(f64::from(linear));
            // Thresholds are rounded to f32, 6e-8 of their size: 1e-4 of a level at most.
            let error = (f64::from(quantizer.level(linear)) - exact).abs();
            assert!(error <= HALF + 1e-4, "{linear}: {error}");
        }
    }

    #[test]
    fn halfway_goes_up() {
        let quantizer = Quantizer::new();
        for level in 0..255u8 {
            let halfway = srgb_decode((f64::from(level) + 0.5) / 255.0) as f32;
            assert_eq!(quantizer.level(halfway * (1.0 - 3e-7)), level + 1);
        }
    }

    #[test]
    fn every_level_returns_to_itself() {
        let quantizer = Quantizer::new();
        for level in 0..=255u8 {
            let linear = srgb_decode(f64::from(level) / 255.0) as f32;
            assert_eq!(quantizer.level(linear), level);
        }
    }

    /// Next to every place where the level changes, and next to the ends of all cells.
    #[test]
    fn levels_change_where_they_should() {
        let quantizer = Quantizer::new();
        let near = |x: f32| (-3..=3).map(move |step| f32::from_bits(x.to_bits().saturating_add_signed(step)));
        let ends = (1..=CELLS).map(|cell| cell as f32 / CELLS as f32);
        for linear in quantizer.thresholds[..255].iter().copied().chain(ends).flat_map(near) {
            let exact = quantizer.thresholds[..255].iter().filter(|threshold| **threshold <= linear).count();
            assert_eq!(usize::from(quantizer.level(linear)), exact, "{linear}");
        }
    }

    #[test]
    fn known_values() {
        let quantizer = Quantizer::new();
        let rows = [
            (0.0, 0),
            (1.0, 255),
            (0.5, 188),
            (0.25, 137),
            (-1.0, 0),
            (7.0, 255),
            (f32::INFINITY, 255),
            (f32::NEG_INFINITY, 0),
            (f32::NAN, 0),
        ];
        for (linear, level) in rows {
            assert_eq!(quantizer.level(linear), level, "{linear}");
        }
    }
}
