//! Quantization of the Doppler factor with a bounded error of colour.

use uglight::{SpectralColor, SpectralShift};
use ugphysics::spectrum::{DopplerGrid, LN_STEP};

use crate::digits::name_as_seen;

/// ln of the X, Y or Z of a colour without light: below that of every positive number.
const DARK: f64 = -750.0;

/// A quantization of ln D. The levels are spaced so that from one to the next X, Y and Z of every
/// colour change by at most twice the tolerance; D = 1 is a level.
pub(crate) struct DopplerQuantizer {
    /// ln D of the points of the grid, in ascending order.
    ln_doppler: Vec<f64>,
    /// The level at each point, before rounding.
    levels: Vec<f64>,
    /// If false, D is not quantized.
    is_rounding: bool,
}

impl DopplerQuantizer {
    /// `colors`: those that are tabulated count. `tolerance`: bound of the relative error of X, Y
    /// and Z; with 0 nothing is quantized.
    pub fn new<'c>(
        grid: &DopplerGrid,
        colors: impl Iterator<Item = &'c SpectralColor>,
        shift: SpectralShift,
        tolerance: f64,
    ) -> Self {
        let ln_doppler: Vec<f64> = grid.ln_doppler().collect();
        let mut changes = vec![0.0_f64; ln_doppler.len() - 1];
        for points in colors.filter_map(|color| color.points(grid)) {
            let points: Vec<_> = points.collect();
            for (cell, (points, change)) in points.windows(2).zip(&mut changes).enumerate() {
                let gain = shift.ln_gain(ln_doppler[cell + 1]) - shift.ln_gain(ln_doppler[cell]);
                for (from, to) in points[0].iter().zip(points[1]) {
                    let change_of_ln =
                        if shift.doppler { to.max(DARK) - from.max(DARK) } else { 0.0 };
                    *change = change.max((change_of_ln + gain).abs());
                }
            }
        }
        // Rounded to the nearest level, the error is half a step at most.
        let step = 2.0 * tolerance;
        let mut levels = vec![0.0; ln_doppler.len()];
        let mut sum = 0.0;
        for (level, change) in levels[1..].iter_mut().zip(changes) {
            sum += change / step;
            *level = sum;
        }
        let rest = ln_doppler.iter().position(|ln| *ln == 0.0).map_or(0.0, |row| levels[row]);
        levels.iter_mut().for_each(|level| *level -= rest);
        Self { ln_doppler, levels, is_rounding: tolerance > 0.0 }
    }

    /// The level nearest to a ln D, as a key, and ln D there.
    pub fn quantized(&self, ln_doppler: f64) -> (u64, f64) {
        if !self.is_rounding {
            return (ln_doppler.to_bits(), ln_doppler);
        }
        let (cell, part) = self.cell(ln_doppler);
        let level =
            (self.levels[cell] + part * (self.levels[cell + 1] - self.levels[cell])).round();
        (level.to_bits(), self.ln_at(level))
    }

    fn cell(&self, ln_doppler: f64) -> (usize, f64) {
        let at = ((ln_doppler - self.ln_doppler[0]) / LN_STEP)
            .clamp(0.0, (self.levels.len() - 1) as f64);
        let cell = (at as usize).min(self.levels.len() - 2);
        (cell, at - cell as f64)
    }

    /// ln D at a level.
    fn ln_at(&self, level: f64) -> f64 {
        if level == 0.0 {
            return 0.0;
        }
        let next = self.levels.partition_point(|&at| at < level).clamp(1, self.levels.len() - 1);
        let (from, to) = (self.levels[next - 1], self.levels[next]);
        let part = if to > from { ((level - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
        self.ln_doppler[next - 1] + part * LN_STEP
    }

    /// The name of a colour as seen: with as many digits of D as distinguish the levels.
    pub fn name_as_seen(&self, name: &str, ln_doppler: f64) -> String {
        let doppler = libm::exp(ln_doppler);
        let (cell, _) = self.cell(ln_doppler);
        let levels_in_cell = self.levels[cell + 1] - self.levels[cell];
        let is_stepped = self.is_rounding && levels_in_cell > 0.0 && levels_in_cell.is_finite();
        name_as_seen(name, doppler, is_stepped.then(|| doppler * LN_STEP / levels_in_cell.max(1.0)))
    }
}
