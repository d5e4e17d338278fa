//! Steps of the Doppler factor within which no colour of a scene changes visibly.

use ugspectrum::{DopplerGrid, DopplerTable, LN_STEP};

use crate::look::Motion;

/// Logarithm that stands for no light: below those of all numbers.
const DARK: f64 = -750.0;

/// A scale over ln D on which X, Y and Z of every colour change by at most a fixed part from mark to mark; D = 1 is a mark.
pub(crate) struct Ruler {
    /// ln D of the points, rising by even steps.
    ln_doppler: Vec<f64>,
    /// Marks, not rounded, at the points.
    marks: Vec<f64>,
    /// False: every D is apart.
    is_rounding: bool,
}

impl Ruler {
    /// `tolerance`: X, Y and Z may be off by this part of themselves; 0 keeps every D apart.
    pub fn new<'t>(
        grid: &DopplerGrid,
        tables: impl Iterator<Item = &'t DopplerTable>,
        motion: Motion,
        tolerance: f64,
    ) -> Self {
        let ln_doppler: Vec<f64> = grid.ln_doppler().collect();
        let mut changes = vec![0.0_f64; ln_doppler.len() - 1];
        for table in tables {
            for (cell, (points, change)) in table.points().windows(2).zip(&mut changes).enumerate() {
                let gain = motion.gain(ln_doppler[cell + 1]) - motion.gain(ln_doppler[cell]);
                for (from, to) in points[0].iter().zip(points[1]) {
                    let shift = if motion.doppler { to.max(DARK) - from.max(DARK) } else { 0.0 };
                    *change = change.max((shift + gain).abs());
                }
            }
        }
        // A vertex is off by half a step at most.
        let step = 2.0 * tolerance;
        let mut marks = vec![0.0; ln_doppler.len()];
        let mut sum = 0.0;
        for (mark, change) in marks[1..].iter_mut().zip(changes) {
            sum += change / step;
            *mark = sum;
        }
        let rest = ln_doppler.iter().position(|ln| *ln == 0.0).map_or(0.0, |row| marks[row]);
        marks.iter_mut().for_each(|mark| *mark -= rest);
        Self { ln_doppler, marks, is_rounding: tolerance > 0.0 }
    }

    /// The step that D falls in, as a key, and ln D at its middle.
    pub fn rounded(&self, ln_doppler: f64) -> (u64, f64) {
        if !self.is_rounding {
            return (ln_doppler.to_bits(), ln_doppler);
        }
        let (cell, part) = self.cell(ln_doppler);
        let mark = (self.marks[cell] + part * (self.marks[cell + 1] - self.marks[cell])).round();
        (mark.to_bits(), self.ln_at(mark))
    }

    fn cell(&self, ln_doppler: f64) -> (usize, f64) {
        let at = ((ln_doppler - self.ln_doppler[0]) / LN_STEP).clamp(0.0, (self.marks.len() - 1) as f64);
        let cell = (at as usize).min(self.marks.len() - 2);
        (cell, at - cell as f64)
    }

    /// ln D where a mark stands.
    fn ln_at(&self, mark: f64) -> f64 {
        if mark == 0.0 {
            return 0.0;
        }
        let next = self.marks.partition_point(|&at| at < mark).clamp(1, self.marks.len() - 1);
        let (from, to) = (self.marks[next - 1], self.marks[next]);
        let part = if to > from { ((mark - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
        self.ln_doppler[next - 1] + part * LN_STEP
    }

    /// D for a name: as many digits as tell the steps apart, `_` for the point.
    pub fn digits(&self, ln_doppler: f64) -> String {
        let doppler = libm::exp(ln_doppler);
        let (cell, _) = self.cell(ln_doppler);
        let marks_in_cell = self.marks[cell + 1] - self.marks[cell];
        let text = if self.is_rounding && marks_in_cell > 0.0 && marks_in_cell.is_finite() {
            let step = doppler * LN_STEP / marks_in_cell.max(1.0);
            // Digits behind the point so that a unit of the last is below a step of D.
            let places = (-libm::log10(step)).ceil().clamp(0.0, 20.0);
            format!("{doppler:.*}", places as usize)
        } else {
            format!("{doppler}")
        };
        text.replace('.', "_")
    }
}
