//! From linear light to 8-bit display levels, exactly and fast.

use ugphysics::srgb_decode;

/// Number of cells of equal width that [0, 1] is cut into. The transfer function is
/// steepest at 0, 12.92, where 255 levels × 12.92 / 4096 is below one level a cell:
/// a look-up is never more than one threshold away from the answer.
const CELLS: usize = 4096;

/// Rounds linear light to the nearest display level: round(255 · encode(x)), without
/// the power function of the sRGB transfer curve.
///
/// The 255 places where the rounded level changes are computed once with the exact
/// curve; a table then gives a level just at or below the answer.
#[derive(Clone, Debug)]
pub struct Quantizer {
    /// `thresholds[k]`: the linear value at which level k + 1 begins.
    thresholds: [f32; 255],
    /// The level of the lower end of each cell.
    start: [u8; CELLS],
}

impl Quantizer {
    /// Computes the tables, some ten microseconds.
    pub fn new() -> Self {
        let thresholds: [f32; 255] =
            std::array::from_fn(|level| srgb_decode((level as f64 + 0.5) / 255.0) as f32);
        let mut start = [0; CELLS];
        for (cell, level) in start.iter_mut().enumerate() {
            let low = cell as f32 / CELLS as f32;
            *level = thresholds.partition_point(|&threshold| threshold <= low) as u8;
        }
        Self { thresholds, start }
    }

    /// The display level nearest to `linear`; values outside 0…1 (and NaN) are clipped.
    #[inline]
    pub fn level(&self, linear: f32) -> u8 {
        // A cast from float to integer saturates, and takes NaN to 0.
        let cell = ((linear * CELLS as f32) as usize).min(CELLS - 1);
        let mut level = self.start[cell];
        while level < 255 && linear >= self.thresholds[usize::from(level)] {
            level += 1;
        }
        level
    }
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
            assert!(error <= 0.5 + 1e-4, "{linear}: {error}");
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
