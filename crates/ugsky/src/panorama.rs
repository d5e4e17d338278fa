//! Panoramas: light by direction, on an equirectangular grid with mip levels.

use std::ops::Range;
use std::sync::OnceLock;

use rayon::prelude::*;
use thiserror::Error;

use crate::arrangement::Arrangement;
use crate::grid::{APRON, Columns, Extent, Grid, Row, SEGMENT, grids, ladder};
use crate::texels::{Decoder, Planes, RowTexels, Texels, premultiply};

/// Why pictures are no panorama.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum PanoramaError {
    /// The number of texels is not width × height, or 0.
    #[error("the number of texels is not that of the size")]
    Size,
    /// The angles are not increasing, or not on the sphere.
    #[error(
        "the angles of the panorama must increase from west to east, by at most 360 degrees, and from south to north, \
         within 90 degrees of the horizon"
    )]
    Extent,
    /// A texel is larger than 0.2 radians.
    #[error(
        "the panorama has too few pixels: none may be larger than 11 degrees, so a whole one has at least 32 x 16"
    )]
    Coarse,
    /// The sides of the picture have not the ratio of its arrangement.
    #[error(
        "{} x {} pixels are not the shape of a {}",
        .size[0], .size[1],
        if *arrangement == Arrangement::Equirectangular {
            "panorama, which is twice as wide as high"
        } else {
            arrangement.name()
        }
    )]
    Shape {
        /// Its pixels across and down.
        size: [u32; 2],
        /// What it should be.
        arrangement: Arrangement,
    },
    /// There are not as many files as a cube has sides, or more than one for other arrangements.
    #[error("{n_files} files were given: a cube of sides needs six, and other panoramas one")]
    Sides {
        /// Their number.
        n_files: usize,
    },
    /// A side of a cube is no square, or has another size than the first.
    #[error(
        "the {} side of the cube has {} x {} pixels: all must be squares of the same size, here \
         {expected} x {expected}",
        ORDINALS[*idx % 6], .size[0], .size[1]
    )]
    Side {
        /// Which of the six.
        idx: usize,
        /// Its pixels across and down.
        size: [u32; 2],
        /// Columns of the first side.
        expected: u32,
    },
}

const ORDINALS: [&str; 6] = ["first", "second", "third", "fourth", "fifth", "sixth"];

/// Largest texel, radians.
const COARSEST: f64 = 0.2;

/// The light that arrives from all directions, or from a part of them.
///
/// Directions have y ahead, in the middle of the panorama, x to the right and z up. Texels are
/// square on the map and have the light of their middle; their number across and down may be any.
pub struct Panorama {
    extent: Extent,
    size: [u32; 2],
    texels: Texels,
    decoder: Decoder,
    pub(crate) ladder: Vec<Columns>,
    pub(crate) grids: Vec<Grid>,
    /// Segments of rows, computed when they are first needed. Level 0 has only those of its rows
    /// with fewer columns, the polar ones.
    levels: Vec<Vec<Segment>>,
}

/// The texels of [`SEGMENT`] columns or those up to the end of the row, and of [`APRON`] more.
type Segment = OnceLock<Planes>;

impl Panorama {
    /// A panorama of `size` texels across and down.
    ///
    /// # Errors
    /// [`PanoramaError`].
    pub fn new(size: [u32; 2], mut texels: Texels, extent: Extent) -> Result<Self, PanoramaError> {
        let n_texels = size[0] as usize * size[1] as usize;
        if n_texels == 0 || texels.len() != n_texels {
            return Err(PanoramaError::Size);
        }
        if !extent.is_valid() {
            return Err(PanoramaError::Extent);
        }
        let coarsest = (extent.width() / f64::from(size[0])).max(extent.height() / f64::from(size[1]));
        if coarsest > COARSEST {
            return Err(PanoramaError::Coarse);
        }
        if let Texels::Light(texels) = &mut texels {
            texels.par_iter_mut().for_each(premultiply);
        }
        let ladder = ladder(size[0], &extent);
        let grids = grids(size, &extent, &ladder);
        let levels =
            grids.iter().map(|grid| (0..grid.n_segments).map(|_| OnceLock::new()).collect()).collect();
        Ok(Self { extent, size, texels, decoder: Decoder::new(), ladder, grids, levels })
    }

    /// The part of the sphere that is shown.
    #[must_use]
    pub fn extent(&self) -> Extent {
        self.extent
    }

    /// Texels across and down.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The level on which an ellipse is sampled, by the square of its smaller semi-axis: its texels
    /// are at most as large, and more than half as large.
    #[inline]
    pub(crate) fn level_of(&self, small_square: f64) -> usize {
        let mut level = 0;
        while let Some(grid) = self.grids.get(level + 1)
            && grid.texel * grid.texel <= small_square
        {
            level += 1;
        }
        level
    }

    /// Consecutive texels of a row, at most [`APRON`], none beyond its end.
    #[inline(always)]
    pub(crate) fn texels(&self, level: usize, row: &Row, column: usize, n: usize) -> RowTexels<'_> {
        if level == 0 && row.ladder == 0 {
            let start = row.offset + column;
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
    fn segment(&self, level: usize, row: &Row, idx: usize) -> &Planes {
        let segment = &self.levels[level][row.offset + idx];
        match segment.get() {
            Some(texels) => texels,
            None => segment.get_or_init(|| self.computed(level, row, idx)),
        }
    }

    /// A segment, from the texels below it. Closed rows begin again after their end; after the end
    /// of others there is nothing.
    #[inline(never)]
    fn computed(&self, level: usize, row: &Row, idx: usize) -> Planes {
        let n = self.ladder[row.ladder].n;
        let start = idx * SEGMENT;
        let length = SEGMENT.min(n - start) + APRON;
        let mut sums = [[0.0; SEGMENT + APRON]; 4];
        let mut is_opaque = true;
        let mut done = 0;
        while done < length {
            let first = (start + done) % n;
            let part = (length - done).min(n - first);
            is_opaque &=
                self.compute(level, row, first, sums.each_mut().map(|sum| &mut sum[done..done + part]));
            done += part;
            if !self.extent.is_closed() {
                break;
            }
        }
        Planes::new(sums.each_ref().map(|sum| &sum[..length]), is_opaque)
    }

    /// The means of the texels below those of a row from a column on, weighted by their areas. True
    /// if all are opaque.
    fn compute(&self, level: usize, row: &Row, first: usize, mut sums: [&mut [f32]; 4]) -> bool {
        let n = self.ladder[row.ladder].n;
        let n_sums = sums[0].len();
        let mut below = Vec::new();
        let mut is_opaque = true;
        let mut add = |level: usize, row: &Row, n_fine: usize, weight: f32| {
            let start = first * n_fine / n;
            let length = ((first + n_sums) * n_fine).div_ceil(n) - start;
            below.resize(4 * length, 0.0);
            let mut planes = quarters(&mut below, length);
            let mut at = 0;
            self.for_each(level, row, start..start + length, |texels| {
                let end = at + texels.len();
                is_opaque &= texels.copy_to(planes.each_mut().map(|plane| &mut plane[at..end]));
                at = end;
            });
            let planes = planes.map(|plane| &*plane);
            add_reduced(planes, start, [n_fine, n], weight, first, &mut sums);
        };
        if level == 0 {
            let given = Row { ladder: 0, offset: row.idx * self.ladder[0].n, ..*row };
            add(0, &given, self.ladder[0].n, 1.0);
            return is_opaque;
        }
        let finer = &self.grids[level - 1];
        let parts = overlaps(finer.rows.len(), self.grids[level].rows.len(), row.idx);
        // Relative to the solid angle of the whole row.
        let whole = |(row, part): (usize, f64)| {
            let row = &finer.rows[row];
            part * f64::from(row.area) * self.ladder[row.ladder].n as f64
        };
        let total: f64 = parts.clone().map(whole).sum();
        for (row, part) in parts {
            let weight = (whole((row, part)) / total) as f32;
            let row = &finer.rows[row];
            add(level - 1, row, self.ladder[row.ladder].n, weight);
        }
        is_opaque
    }

    /// Reads texels of the given panorama before they are used, so that the processor waits for
    /// memory once for several rows.
    pub(crate) fn load(&self, level: usize, rows: Range<usize>, columns: Range<usize>) {
        let grid = &self.grids[level];
        let mut sum = 0_u32;
        for row in &grid.rows[rows.start..rows.end.min(grid.rows.len())] {
            if level == 0 && row.ladder == 0 {
                let end = columns.end.min(self.ladder[0].n);
                sum = sum.wrapping_add(self.given(row.offset + columns.start..row.offset + end).load());
            }
        }
        std::hint::black_box(sum);
    }

    /// Passes consecutive texels of a row on, from the left, in several parts.
    #[inline]
    pub(crate) fn for_each(
        &self,
        level: usize,
        row: &Row,
        columns: Range<usize>,
        mut take: impl FnMut(RowTexels<'_>),
    ) {
        if level == 0 && row.ladder == 0 {
            return take(self.given(row.offset + columns.start..row.offset + columns.end));
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
fn overlaps(n_fine: usize, n_coarse: usize, idx: usize) -> impl Iterator<Item = (usize, f64)> + Clone {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overlaps_cover_each_cell_once() {
        for (n_fine, n_coarse) in [(10, 5), (9, 5), (7, 7), (3, 7), (101, 51)] {
            let mut covered = vec![0.0; n_fine];
            for idx in 0..n_coarse {
                overlaps(n_fine, n_coarse, idx).for_each(|(cell, part)| covered[cell] += part);
            }
            assert!(covered.iter().all(|part: &f64| (part - 1.0).abs() < 1e-12), "{covered:?}");
        }
    }

    /// All levels have the mean of the panorama, weighted by area, odd sizes too.
    #[test]
    fn levels_keep_the_mean() {
        for (size, alpha) in [([256, 128], 1.0), ([256, 128], 0.5), ([301, 147], 0.2), ([288, 133], 1.0)] {
            let n_texels = size[0] as usize * size[1] as usize;
            let texel = |idx: usize| {
                let alpha = if idx.is_multiple_of(3) { alpha } else { 1.0 };
                [(idx as f32 * 0.618_034).fract(), (idx / 7 % 5) as f32, 1.0, alpha]
            };
            let texels = Texels::Light((0..n_texels).map(texel).collect());
            let panorama = Panorama::new(size, texels, Extent::FULL).unwrap();
            let mean = |level: usize| {
                let (mut sum, mut total) = ([0.0_f64; 4], 0.0);
                for row in &panorama.grids[level].rows {
                    for idx in 0..panorama.ladder[row.ladder].n {
                        let area = f64::from(row.area);
                        let texel = panorama.texels(level, row, idx, 1).get(0);
                        (0..4).for_each(|i| sum[i] += area * f64::from(texel[i]));
                        total += area;
                    }
                }
                sum.map(|sum| sum / total)
            };
            let all: Vec<_> = (0..panorama.grids.len()).map(mean).collect();
            assert!(all.len() >= 2, "{size:?}");
            for level in &all {
                let near = |i: usize| (level[i] - all[0][i]).abs() < 2e-5 * all[0][i];
                assert!((0..4).all(near), "{size:?}: {all:?}");
            }
        }
    }

    #[test]
    fn what_is_no_panorama_is_refused() {
        let new = |size: [u32; 2], n: usize, extent: Extent| {
            Panorama::new(size, Texels::Srgb(vec![[0; 4]; n]), extent).err()
        };
        assert_eq!(new([32, 16], 32 * 16, Extent::FULL), None);
        assert_eq!(new([32, 16], 12, Extent::FULL), Some(PanoramaError::Size));
        assert_eq!(new([0, 16], 0, Extent::FULL), Some(PanoramaError::Size));
        assert_eq!(new([8, 4], 32, Extent::FULL), Some(PanoramaError::Coarse));
        let bad = Extent { longitudes: [1.0, f64::NAN], ..Extent::FULL };
        assert_eq!(new([32, 16], 32 * 16, bad), Some(PanoramaError::Extent));
    }
}
