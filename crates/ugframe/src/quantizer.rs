//! Quantization of linear light to 8-bit sRGB levels, exact and fast.

use ugphysics::srgb_decode;

/// Number of cells of equal width into which [0, 1] is divided. The sRGB encoding is steepest at 0,
/// with slope 12.92, and 255 levels × 12.92 / 4096 is below one level per cell. So no cell contains
/// two thresholds, and the level of its lower end is at most one too low.
const CELLS: usize = 4096;

/// Half the spacing of `f32` above 1: numbers up to this much below the end of a cell round up into
/// the next one when 1 is added.
const ROUNDING: f32 = 1.0 / (1 << 24) as f32;

/// Offset added to a level before truncation to an integer: slightly more than a half. Values
/// halfway between two levels, such as grey 0.5, then round up even if rounding errors made their
/// light a few 10⁻⁷ too small.
pub const ROUNDING_OFFSET: f64 = 0.500_25;

/// Rounds linear light to the nearest display level, round(255 · encode(x)), without evaluating the
/// power function of the sRGB transfer function.
///
/// The 255 thresholds at which the rounded level changes are computed once with the exact curve.
/// For each cell a table gives the level at its lower end, and one comparison with the next
/// threshold gives the result.
#[derive(Clone, Debug)]
pub struct Quantizer {
    /// `thresholds[k]`: the linear value at which level k + 1 begins. The last is NaN, which no
    /// value reaches.
    thresholds: [f32; 256],
    /// The level of the lower end of each cell.
    start: [u8; CELLS],
}

impl Quantizer {
    /// Computes the tables, which takes about ten microseconds.
    pub fn new() -> Self {
        let thresholds: [f32; 256] = std::array::from_fn(|level| match level {
            255 => f32::NAN,
            level => srgb_decode((level as f64 + 1.0 - ROUNDING_OFFSET) / 255.0) as f32,
        });
        let (mut start, mut level) = ([0; CELLS], 0u8);
        for (cell, of_cell) in start.iter_mut().enumerate() {
            let low = cell as f32 / CELLS as f32 - ROUNDING;
            // A cell contains at most one threshold, and the last one is never reached.
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

    /// The display level of each value, as [`Quantizer::level`], but faster for many values.
    #[inline]
    pub fn levels<const N: usize>(&self, linear: &[f32; N]) -> [u8; N] {
        // A loop of its own, because the compiler can use SIMD instructions for it.
        let mut cells = [0; N];
        for (at, &linear) in cells.iter_mut().zip(linear) {
            *at = cell(linear) as u32;
        }
        let mut levels = [0; N];
        for ((level, &linear), &cell) in levels.iter_mut().zip(linear).zip(&cells) {
            let low = self.start[cell as usize % CELLS];
            *level = low + u8::from(linear >= self.thresholds[usize::from(low)]);
        }
        levels
    }
}

/// The index of the cell of a number: the leading mantissa bits of 1 + `linear`, which is faster
/// than a cast.
#[inline]
fn cell(linear: f32) -> usize {
    // NaN becomes 0.
    let low = if linear > 0.0 { linear } else { 0.0 };
    // Limited to the largest number that stays below 2 when 1 is added.
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
            // Thresholds are rounded to f32, a relative error of 6e-8, which is at most 1e-4 of a
            // level.
            let error = (f64::from(quantizer.level(linear)) - exact).abs();
            assert!(error <= ROUNDING_OFFSET + 1e-4, "{linear}: {error}");
            let several = [linear, -linear, f32::NAN, 1.0 - linear];
            assert_eq!(quantizer.levels(&several), several.map(|linear| quantizer.level(linear)));
        }
    }

    #[test]
    fn halfway_rounds_up() {
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

    /// Checked around every threshold and around the ends of all cells.
    #[test]
    fn levels_change_where_they_should() {
        let quantizer = Quantizer::new();
        let near = |x: f32| {
            (-3..=3).map(move |step| f32::from_bits(x.to_bits().saturating_add_signed(step)))
        };
        let ends = (1..=CELLS).map(|cell| cell as f32 / CELLS as f32);
        for linear in quantizer.thresholds[..255].iter().copied().chain(ends).flat_map(near) {
            let exact = quantizer.thresholds[..255]
                .iter()
                .filter(|threshold| **threshold <= linear)
                .count();
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
