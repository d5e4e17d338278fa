//! Panoramas: light by direction, on an equirectangular grid with mip levels.

use std::fmt;
use std::ops::Range;
use std::sync::OnceLock;

use rayon::prelude::*;
use ugphysics::srgb_decode;

use crate::grid::{APRON, Columns, Extent, Grid, Row, SEGMENT, grids, ladder};

/// The texels of a panorama, row after row from the top.
#[derive(Clone, Debug, PartialEq)]
pub enum Texels {
    /// Display-encoded sRGB, and alpha.
    Srgb(Vec<[u8; 4]>),
    /// Linear light, white is 1, and alpha from 0 to 1. Colours are not multiplied by alpha. NaN
    /// counts as 0, and infinite light as the largest number.
    Light(Vec<[f32; 4]>),
}

impl Texels {
    fn len(&self) -> usize {
        match self {
            Self::Srgb(texels) => texels.len(),
            Self::Light(texels) => texels.len(),
        }
    }
}

/// Why a grid of texels is no panorama.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PanoramaError {
    /// The number of texels is not width × height, or 0.
    Size,
    /// The angles are not increasing, or not on the sphere.
    Extent,
    /// A texel is larger than 0.2 radians.
    Coarse,
}

impl fmt::Display for PanoramaError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Size => "the number of texels is not that of the size",
            Self::Extent => {
                "the angles of the panorama must increase from west to east, by at most 360 degrees, and from south to \
                 north, within 90 degrees of the horizon"
            }
            Self::Coarse => {
                "the panorama has too few pixels: none may be larger than 11 degrees, so a whole one has at least \
                 32 x 16"
            }
        })
    }
}

impl std::error::Error for PanoramaError {}

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

/// Light times alpha, and alpha, of [`SEGMENT`] columns or those up to the end of the row, and of
/// [`APRON`] more.
type Segment = OnceLock<Box<[[f32; 4]]>>;

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
        RowTexels::Light(&self.segment(level, row, column / SEGMENT)[at..at + n])
    }

    #[inline(always)]
    fn given(&self, range: Range<usize>) -> RowTexels<'_> {
        match &self.texels {
            Texels::Srgb(texels) => RowTexels::Srgb(&texels[range], &self.decoder),
            Texels::Light(texels) => RowTexels::Light(&texels[range]),
        }
    }

    #[inline(always)]
    fn segment(&self, level: usize, row: &Row, idx: usize) -> &[[f32; 4]] {
        let segment = &self.levels[level][row.offset + idx];
        match segment.get() {
            Some(texels) => texels,
            None => segment.get_or_init(|| self.computed(level, row, idx)),
        }
    }

    /// A segment, from the texels below it. Closed rows begin again after their end; after the end
    /// of others there is nothing.
    #[inline(never)]
    fn computed(&self, level: usize, row: &Row, idx: usize) -> Box<[[f32; 4]]> {
        let n = self.ladder[row.ladder].n;
        let start = idx * SEGMENT;
        let length = SEGMENT.min(n - start) + APRON;
        let mut texels = vec![[0.0; 4]; length];
        let mut done = 0;
        while done < length {
            let first = (start + done) % n;
            let part = (length - done).min(n - first);
            self.compute(level, row, first, &mut texels[done..done + part]);
            done += part;
            if !self.extent.is_closed() {
                break;
            }
        }
        texels.into_boxed_slice()
    }

    /// The means of the texels below those of a row from a column on, weighted by their areas.
    fn compute(&self, level: usize, row: &Row, first: usize, sum: &mut [[f32; 4]]) {
        let n = self.ladder[row.ladder].n;
        let mut below = Vec::new();
        let mut add = |level: usize, row: &Row, n_fine: usize, weight: f32| {
            let start = first * n_fine / n;
            let end = ((first + sum.len()) * n_fine).div_ceil(n);
            below.clear();
            self.for_each(level, row, start..end, |texels| texels.push_to(&mut below));
            add_reduced(&below, start, [n_fine, n], weight, first, sum);
        };
        if level == 0 {
            let given = Row { ladder: 0, offset: row.idx * self.ladder[0].n, ..*row };
            return add(0, &given, self.ladder[0].n, 1.0);
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
            take(RowTexels::Light(&segment[at - offset..end - offset]));
            at = end;
        }
    }
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

pub(crate) fn premultiply(texel: &mut [f32; 4]) {
    let finite = |part: f32| if part.is_nan() { 0.0 } else { part.clamp(-f32::MAX, f32::MAX) };
    let alpha = finite(texel[3]).clamp(0.0, 1.0);
    let [red, green, blue, _] = *texel;
    *texel = [alpha * finite(red), alpha * finite(green), alpha * finite(blue), alpha];
}

/// Light of 8-bit colours.
pub(crate) struct Decoder(Box<[f32; 256]>);

impl Decoder {
    fn new() -> Self {
        Self(Box::new(std::array::from_fn(|level| srgb_decode(level as f64 / 255.0) as f32)))
    }

    /// Light times alpha, and alpha.
    #[inline(always)]
    pub fn light(&self, [red, green, blue, alpha]: [u8; 4]) -> [f32; 4] {
        let [red, green, blue] = [red, green, blue].map(|level| self.0[usize::from(level)]);
        if alpha == 255 {
            return [red, green, blue, 1.0];
        }
        let alpha = f32::from(alpha) / 255.0;
        [alpha * red, alpha * green, alpha * blue, alpha]
    }

    /// Sets the channels of texels, from a place on.
    pub fn decode<const N: usize>(&self, texels: &[[u8; 4]], planes: &mut [[f32; N]; 4], at: usize) {
        let n = texels.len().min(N - at);
        let [reds, greens, blues, alphas] = planes;
        let places = reds[at..at + n].iter_mut().zip(&mut greens[at..at + n]).zip(&mut blues[at..at + n]);
        for (((red, green), blue), texel) in places.zip(texels) {
            *red = self.0[usize::from(texel[0])];
            *green = self.0[usize::from(texel[1])];
            *blue = self.0[usize::from(texel[2])];
        }
        let alphas = &mut alphas[at..at + n];
        alphas.fill(1.0);
        if texels.iter().fold(255, |all, texel| all & texel[3]) < 255 {
            for (idx, &texel) in texels.iter().enumerate().take(n) {
                let light = self.light(texel);
                (reds[at + idx], greens[at + idx], blues[at + idx]) = (light[0], light[1], light[2]);
                alphas[idx] = light[3];
            }
        }
    }
}

/// Consecutive texels of a row.
#[derive(Clone, Copy)]
pub(crate) enum RowTexels<'a> {
    Srgb(&'a [[u8; 4]], &'a Decoder),
    Light(&'a [[f32; 4]]),
}

impl RowTexels<'_> {
    /// Number of texels.
    pub fn len(&self) -> usize {
        match self {
            Self::Srgb(texels, _) => texels.len(),
            Self::Light(texels) => texels.len(),
        }
    }

    /// Appends all to a list: light times alpha, and alpha.
    fn push_to(&self, list: &mut Vec<[f32; 4]>) {
        match self {
            Self::Srgb(texels, decoder) => list.extend(texels.iter().map(|&texel| decoder.light(texel))),
            Self::Light(texels) => list.extend_from_slice(texels),
        }
    }

    /// A texel: light times alpha, and alpha.
    #[inline]
    pub fn get(&self, idx: usize) -> [f32; 4] {
        match self {
            Self::Srgb(texels, decoder) => decoder.light(texels[idx]),
            Self::Light(texels) => texels[idx],
        }
    }
}

/// Adds texels reduced to fewer columns by means, times a weight. `below`: those of the finer row
/// from column `start` on; `counts`: the columns of both rows; `first`: the column of the first
/// sum.
fn add_reduced(
    below: &[[f32; 4]],
    start: usize,
    [n_fine, n]: [usize; 2],
    weight: f32,
    first: usize,
    sum: &mut [[f32; 4]],
) {
    if n_fine == 2 * n {
        let half = 0.5 * weight;
        for (sum, pair) in sum.iter_mut().zip(below.chunks_exact(2)) {
            (0..4).for_each(|channel| sum[channel] += half * (pair[0][channel] + pair[1][channel]));
        }
        return;
    }
    let per_cell = weight * n as f32 / n_fine as f32;
    for (idx, sum) in (first..).zip(sum) {
        for (cell, part) in overlaps(n_fine, n, idx) {
            let texel = below[cell - start];
            (0..4).for_each(|channel| sum[channel] += per_cell * part as f32 * texel[channel]);
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
        for size in [[256, 128], [301, 147], [288, 133]] {
            let n_texels = size[0] as usize * size[1] as usize;
            let texel = |idx: usize| [(idx as f32 * 0.618_034).fract(), (idx / 7 % 5) as f32, 1.0, 1.0];
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
