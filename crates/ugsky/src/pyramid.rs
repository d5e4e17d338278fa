//! Texels in rows, with mip levels that are computed where they are needed.
//!
//! Rows may have different numbers of texels: on a sphere those near the poles have fewer.

use std::ops::Range;
use std::sync::OnceLock;

use rayon::prelude::*;

use crate::texels::{Decoder, Planes, RowTexels, Texels, premultiply};

/// Columns of a segment of a row, which is computed when it is first needed.
const SEGMENT: usize = 256;

/// Columns after its own that a segment repeats from the next one, so that this many columns are
/// together wherever they begin.
pub(crate) const APRON: usize = 16;

/// A row of texels.
#[derive(Clone, Copy)]
struct Cells {
    /// Number of texels.
    n: usize,
    /// Weight of each in means, such as its area.
    area: f32,
    /// The row has the given texels.
    is_given: bool,
    /// Index of its first texel among those given, else of its first segment among those of the
    /// level.
    offset: usize,
}

/// The texels of [`SEGMENT`] columns or those up to the end of the row, and of [`APRON`] more.
type Segment = OnceLock<Planes>;

/// Texels with mip levels.
pub(crate) struct Pyramid {
    texels: Texels,
    decoder: Decoder,
    /// Texels of a given row.
    width: usize,
    /// Rows begin again after their end.
    is_closed: bool,
    rows: Vec<Vec<Cells>>,
    /// Segments of rows, computed when they are first needed. Level 0 has only those of its rows
    /// with fewer columns than given.
    segments: Vec<Vec<Segment>>,
}

impl Pyramid {
    /// `width`: texels per row of `texels`. `levels`: for each level and row, the number of texels
    /// and the weight of one texel in means; level 0 has the rows of `texels`.
    pub fn new(
        mut texels: Texels,
        width: usize,
        is_closed: bool,
        levels: &[Vec<(usize, f32)>],
    ) -> Self {
        if let Texels::Light(texels) = &mut texels {
            texels.par_iter_mut().for_each(premultiply);
        }
        let (mut rows, mut segments) = (Vec::new(), Vec::new());
        for (level, shapes) in levels.iter().enumerate() {
            let mut n_segments = 0;
            let cells = shapes.iter().enumerate().map(|(idx, &(n, area))| {
                let is_given = level == 0 && n == width;
                let offset = if is_given { idx * width } else { n_segments };
                n_segments += if is_given { 0 } else { n.div_ceil(SEGMENT) };
                Cells { n, area, is_given, offset }
            });
            rows.push(cells.collect());
            segments.push((0..n_segments).map(|_| OnceLock::new()).collect());
        }
        Self { texels, decoder: Decoder::new(), width, is_closed, rows, segments }
    }

    /// Consecutive texels of a row, at most [`APRON`], none beyond its end.
    #[inline(always)]
    pub fn texels(&self, level: usize, row: usize, column: usize, n: usize) -> RowTexels<'_> {
        let cells = &self.rows[level][row];
        if cells.is_given {
            let start = cells.offset + column;
            return self.given(start..start + n);
        }
        let at = column % SEGMENT;
        RowTexels::Planes(self.segment(level, row, column / SEGMENT), at..at + n)
    }

    #[inline(always)]
    fn given(&self, range: Range<usize>) -> RowTexels<'_> {
        match &self.texels {
            Texels::Srgb(texels) => RowTexels::Srgb(&texels[range], &self.decoder),
            Texels::Light(texels) => RowTexels::Light(&texels[range]),
        }
    }

    #[inline(always)]
    fn segment(&self, level: usize, row: usize, idx: usize) -> &Planes {
        let segment = &self.segments[level][self.rows[level][row].offset + idx];
        match segment.get() {
            Some(texels) => texels,
            None => segment.get_or_init(|| self.computed(level, row, idx)),
        }
    }

    /// A segment, from the texels below it. Closed rows begin again after their end; after the end
    /// of others there is nothing.
    #[inline(never)]
    fn computed(&self, level: usize, row: usize, idx: usize) -> Planes {
        let n = self.rows[level][row].n;
        let start = idx * SEGMENT;
        let length = SEGMENT.min(n - start) + APRON;
        let mut sums = [[0.0; SEGMENT + APRON]; 4];
        let mut is_opaque = true;
        let mut done = 0;
        while done < length {
            let first = (start + done) % n;
            let part = (length - done).min(n - first);
            is_opaque &= self.compute(
                level,
                row,
                first,
                sums.each_mut().map(|sum| &mut sum[done..done + part]),
            );
            done += part;
            if !self.is_closed {
                break;
            }
        }
        Planes::new(sums.each_ref().map(|sum| &sum[..length]), is_opaque)
    }

    /// The means of the texels below those of a row from a column on, weighted by their areas. True
    /// if all are opaque.
    fn compute(&self, level: usize, row: usize, first: usize, mut sums: [&mut [f32]; 4]) -> bool {
        let n = self.rows[level][row].n;
        let n_sums = sums[0].len();
        let mut below = Vec::new();
        let mut is_opaque = true;
        // `finer`: a row of the level before; without it, the given row.
        let mut add = |finer: Option<usize>, n_fine: usize, weight: f32| {
            let start = first * n_fine / n;
            let end = ((first + n_sums) * n_fine).div_ceil(n);
            below.resize(4 * (end - start), 0.0);
            let mut planes = quarters(&mut below, end - start);
            let mut at = 0;
            let mut take = |texels: RowTexels<'_>| {
                let end = at + texels.len();
                is_opaque &= texels.copy_to(planes.each_mut().map(|plane| &mut plane[at..end]));
                at = end;
            };
            match finer {
                Some(finer) => self.for_each(level - 1, finer, start..end, take),
                None => take(self.given(row * self.width + start..row * self.width + end)),
            }
            add_reduced(planes.map(|plane| &*plane), start, [n_fine, n], weight, first, &mut sums);
        };
        if level == 0 {
            add(None, self.width, 1.0);
            return is_opaque;
        }
        let finer = &self.rows[level - 1];
        let parts = overlaps(finer.len(), self.rows[level].len(), row);
        // Relative to the weight of the whole row.
        let whole =
            |(row, part): (usize, f64)| part * f64::from(finer[row].area) * finer[row].n as f64;
        let total: f64 = parts.clone().map(whole).sum();
        for (row, part) in parts {
            add(Some(row), finer[row].n, (whole((row, part)) / total) as f32);
        }
        is_opaque
    }

    /// Reads given texels before they are used, so that the processor waits for
    /// memory once for several rows.
    pub fn load(&self, level: usize, rows: Range<usize>, columns: Range<usize>) {
        let all = &self.rows[level];
        let mut sum = 0_u32;
        for row in &all[rows.start..rows.end.min(all.len())] {
            if row.is_given {
                let end = columns.end.min(self.width);
                sum = sum
                    .wrapping_add(self.given(row.offset + columns.start..row.offset + end).load());
            }
        }
        std::hint::black_box(sum);
    }

    /// Passes consecutive texels of a row on, from the left, in several parts.
    #[inline]
    pub fn for_each(
        &self,
        level: usize,
        row: usize,
        columns: Range<usize>,
        mut take: impl FnMut(RowTexels<'_>),
    ) {
        let cells = &self.rows[level][row];
        if cells.is_given {
            return take(self.given(cells.offset + columns.start..cells.offset + columns.end));
        }
        let mut at = columns.start;
        while at < columns.end {
            let segment = self.segment(level, row, at / SEGMENT);
            let end = columns.end.min((at / SEGMENT + 1) * SEGMENT);
            let offset = at - at % SEGMENT;
            take(RowTexels::Planes(segment, at - offset..end - offset));
            at = end;
        }
    }
}

/// Four parts of a buffer.
fn quarters(buffer: &mut [f32], length: usize) -> [&mut [f32]; 4] {
    let (first, rest) = buffer.split_at_mut(length);
    let (second, rest) = rest.split_at_mut(length);
    let (third, fourth) = rest.split_at_mut(length);
    [first, second, third, fourth]
}

/// The cells of a finer division that a cell of a coarser one overlaps, with the overlapped part of
/// each.
fn overlaps(
    n_fine: usize,
    n_coarse: usize,
    idx: usize,
) -> impl Iterator<Item = (usize, f64)> + Clone {
    // In units of 1/(n_fine n_coarse), so that all edges are whole numbers.
    let (start, end) = (idx * n_fine, (idx + 1) * n_fine);
    let first = start / n_coarse;
    let last = (end - 1) / n_coarse;
    (first..=last).map(move |cell| {
        let (low, high) = (cell * n_coarse, (cell + 1) * n_coarse);
        (cell, (high.min(end) - low.max(start)) as f64 / n_coarse as f64)
    })
}

/// Adds texels reduced to fewer columns by means, times a weight. `below`: those of the finer row
/// from column `start` on; `n_fine`, `n`: the columns of both rows; `first`: the column of the
/// first sum.
fn add_reduced(
    below: [&[f32]; 4],
    start: usize,
    [n_fine, n]: [usize; 2],
    weight: f32,
    first: usize,
    sums: &mut [&mut [f32]; 4],
) {
    if n_fine == 2 * n {
        let half = 0.5 * weight;
        for (sum, below) in sums.iter_mut().zip(below) {
            for (sum, pair) in sum.iter_mut().zip(below.as_chunks::<2>().0) {
                *sum += half * (pair[0] + pair[1]);
            }
        }
        return;
    }
    let per_cell = weight * n as f32 / n_fine as f32;
    for idx in 0..sums[0].len() {
        for (cell, part) in overlaps(n_fine, n, first + idx) {
            (0..4).for_each(|channel| {
                sums[channel][idx] += per_cell * part as f32 * below[channel][cell - start]
            });
        }
    }
}
