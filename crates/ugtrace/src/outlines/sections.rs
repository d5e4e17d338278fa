//! The runs of samples of a row that are in a face, from the crossings of the row with its edges:
//! between two crossings all samples are inside or all are outside.

use std::ops::Range;

use super::film::{Form, LengthRow, RowForm};

/// The plane through the eye and an edge.
#[derive(Clone, Copy, Debug)]
pub struct Side {
    /// Signed distance of a ray from it: dot product of its normal and the ray at rest.
    pub form: Form,
    /// Bound on the terms of that product for a ray of length 1.
    pub size: f64,
}

/// Columns around a crossing that are tested one by one; usually empty.
type Cut = Range<u32>;

/// The sign of a sum is trusted if it exceeds this part of the bound on its terms. Rounding errors
/// are about 10⁻¹⁵.
const UNSURE: f64 = 1e-13;

/// Rows of at most so many columns are tested column by column.
const FEW: usize = 4;

/// Computes sections of rows; keeps its buffer.
#[derive(Default)]
pub struct Cutter {
    cuts: Vec<Cut>,
}

impl Cutter {
    /// Calls `take` with each run of `columns` that is in the face. `contains`: whether a single
    /// column is.
    pub fn sections(
        &mut self,
        row: u32,
        columns: Range<u32>,
        lengths: LengthRow<'_>,
        sides: &[Side],
        contains: impl Fn(u32) -> bool,
        mut take: impl FnMut(Range<u32>),
    ) {
        if columns.len() <= FEW || !self.cut(row, &columns, lengths, sides) {
            columns.filter(|&column| contains(column)).for_each(|column| take(column..column + 1));
            return;
        }
        let mut start = columns.start;
        let last = columns.end..columns.end;
        for cut in self.cuts.iter().chain([&last]) {
            if start < cut.start && contains(start + (cut.start - start) / 2) {
                take(start..cut.start);
            }
            (cut.start.max(start)..cut.end)
                .filter(|&column| contains(column))
                .for_each(|column| take(column..column + 1));
            start = start.max(cut.end);
        }
    }

    /// Finds the crossings of the row. Returns false if every column has to be tested.
    fn cut(
        &mut self,
        row: u32,
        columns: &Range<u32>,
        lengths: LengthRow<'_>,
        sides: &[Side],
    ) -> bool {
        self.cuts.clear();
        let ends = [columns.start, columns.end - 1];
        let longest = lengths.at(ends[0]).max(lengths.at(ends[1]));
        let is_cut = sides.iter().all(|side| {
            let form = side.form.on_row(row);
            let line = Line { form, lengths, unsure: UNSURE * side.size * longest };
            line.cut(ends, &mut self.cuts)
        });
        self.cuts.sort_unstable_by_key(|cut| (cut.start, cut.end));
        is_cut && self.cuts.len() * FEW <= columns.len().max(FEW * FEW)
    }
}

/// A function along a row: linear in the column plus a multiple of the ray's length, so convex or
/// concave.
struct Line<'a> {
    form: RowForm,
    lengths: LengthRow<'a>,
    /// Up to this absolute value the sign is uncertain.
    unsure: f64,
}

impl Line<'_> {
    #[inline]
    fn at(&self, column: u32) -> f64 {
        self.form.at(column, self.lengths.at(column))
    }

    /// True if the sign is uncertain, and for NaN.
    #[inline]
    fn is_unsure(&self, number: f64) -> bool {
        number.is_nan() || number.abs() <= self.unsure
    }

    /// Adds the cuts at sign changes. Returns false if the sign is uncertain at an end, or near a
    /// possible double change.
    fn cut(&self, [first, last]: [u32; 2], cuts: &mut Vec<Cut>) -> bool {
        let [start, end] = [self.at(first), self.at(last)];
        if self.is_unsure(start) || self.is_unsure(end) {
            return false;
        }
        if (start < 0.0) != (end < 0.0) {
            // A convex or concave function with different signs at its ends changes sign once.
            cuts.push(self.change([first, last], [start, end]));
            return true;
        }
        if self.form.per_length * start <= 0.0 {
            return true;
        }
        let Some(turn) = self.lengths.turn(&self.form, [first, last]) else { return true };
        for middle in [turn, turn + 1] {
            let number = self.at(middle);
            if self.is_unsure(number) {
                return false;
            }
            if (number < 0.0) != (start < 0.0) {
                cuts.push(self.change([first, middle], [start, number]));
                cuts.push(self.change([middle, last], [number, end]));
                return true;
            }
        }
        true
    }

    /// The columns around the sign change. The signs at the two given columns differ.
    fn change(&self, [mut low, mut high]: [u32; 2], [mut below, mut above]: [f64; 2]) -> Cut {
        let is_negative = below < 0.0;
        let is_low = |number: f64| (number < 0.0) == is_negative;
        let (from, to) = (low, high);
        let mut n_rounds = 0;
        while high - low > 1 {
            // Secant steps, with bisection every third time.
            let part = if n_rounds % 3 == 2 { 0.5 } else { below / (below - above) };
            let guess = (low + (f64::from(high - low) * part) as u32).min(high - 1);
            let [left, right] = [guess, guess + 1].map(|column| self.at(column));
            if !is_low(left) {
                (high, above) = (guess, left);
            } else if is_low(right) {
                (low, below) = (guess + 1, right);
            } else {
                (low, high) = (guess, guess + 1);
            }
            n_rounds += 1;
        }
        let is_unsure = |column: &u32| self.is_unsure(self.at(*column));
        let end = (high..to).find(|column| !is_unsure(column)).unwrap_or(to);
        let start = (from..=low)
            .rev()
            .find(|column| !is_unsure(column))
            .map_or(from + 1, |column| column + 1);
        start..end
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use ugtesting::Random;

    use super::super::film::{Film, Lengths, center};
    use super::*;

    const COLUMNS: Range<u32> = 0..200;
    const ROWS: Range<u32> = 0..60;

    /// Three random sides, some of which cross a row twice: `sections` takes exactly the samples
    /// that a test of each sample takes.
    #[test]
    fn every_change_of_a_sign_is_found() {
        let mut random = Random(1);
        let rays = [DVec3::new(-1.0, -0.3, 1.0), DVec3::X / 100.0, DVec3::Y / 100.0];
        let mut lengths = Lengths::default();
        lengths.reset(&Film::new(rays), COLUMNS, ROWS);
        let mut cutter = Cutter::default();
        let (mut n_cut, mut n_bent) = (0, 0);
        for case in 0..300 {
            let bend = [0.0, 1e-9, 0.1, 1.0][case % 4];
            let sides: Vec<Side> = (0..3)
                .map(|_| {
                    let (across, per_length) =
                        (random.in_cube(1.0), bend * random.between(-1.0, 1.0));
                    let [origin, per_column, per_row] = rays.map(|ray| across.dot(ray));
                    let form = Form { origin, per_column, per_row, per_length };
                    Side { form, size: across.length() + per_length.abs() }
                })
                .collect();
            for row in ROWS {
                let at = |side: &Side, column: u32| {
                    let ray = rays[0] + center(column) * rays[1] + center(row) * rays[2];
                    side.form.on_row(row).at(column, ray.length())
                };
                // Changes with the sign of each side.
                let contains = |column: u32| {
                    sides.iter().filter(|side| at(side, column) < 0.0).count() % 2 == 1
                };
                let mut taken = vec![false; COLUMNS.len()];
                cutter.sections(row, COLUMNS, lengths.row(row), &sides, contains, |columns| {
                    columns.for_each(|column| taken[column as usize] = true);
                });
                let expected: Vec<bool> = COLUMNS.map(contains).collect();
                assert_eq!(taken, expected, "case {case}, row {row}");
                n_cut += usize::from(cutter.cuts.len() > 1);
                let is_bent = |side: &Side| {
                    let signs: Vec<bool> = COLUMNS.map(|column| at(side, column) < 0.0).collect();
                    signs.windows(2).filter(|pair| pair[0] != pair[1]).count() == 2
                };
                n_bent += usize::from(sides.iter().any(is_bent));
            }
        }
        assert!(n_cut > 1000 && n_bent > 100, "{n_cut} rows, {n_bent} of them with a side twice");
    }
}
