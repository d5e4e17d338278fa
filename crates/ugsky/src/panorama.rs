//! Panoramas: light by direction, on an equirectangular grid with mip levels.

use std::fmt;
use std::sync::OnceLock;

use rayon::prelude::*;
use ugphysics::srgb_decode;

use crate::grid::{Columns, Extent, Grid, Row, grids, ladder};

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
    /// Light of an 8-bit colour.
    decoded: [f32; 256],
    pub(crate) ladder: Vec<Columns>,
    pub(crate) grids: Vec<Grid>,
    /// Light times alpha, and alpha. Level 0 has only its rows with fewer columns, the polar ones.
    levels: Vec<OnceLock<Vec<[f32; 4]>>>,
}

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
        let levels = grids.iter().map(|_| OnceLock::new()).collect();
        let decoded = std::array::from_fn(|level| srgb_decode(level as f64 / 255.0) as f32);
        Ok(Self { extent, size, texels, decoded, ladder, grids, levels })
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

    /// Computes the levels for pixels whose smaller semi-axis, in radians, is at most this large,
    /// on all threads. Others are computed when they are first needed, each on one thread.
    pub fn prepare(&self, semi_axis: f64) {
        let last = self.level_of(semi_axis * semi_axis);
        for level in 0..=last {
            if self.levels[level].get().is_none() {
                let rows = self.grids[level].rows.par_iter().enumerate();
                let is_stored = |row: &Row| level > 0 || row.ladder > 0;
                let parts: Vec<Vec<[f32; 4]>> = rows
                    .filter(|(_, row)| is_stored(row))
                    .map(|(idx, _)| self.computed_row(level, idx))
                    .collect();
                // Another thread may have been faster, with the same texels.
                let _ = self.levels[level].set(parts.concat());
            }
        }
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

    /// The texels of a row: light times alpha, and alpha.
    #[inline]
    pub(crate) fn row(&self, level: usize, row: &Row) -> RowTexels<'_> {
        let range = row.offset..row.offset + self.ladder[row.ladder].n;
        if level == 0 && row.ladder == 0 {
            return match &self.texels {
                Texels::Srgb(texels) => RowTexels::Srgb(&texels[range], &self.decoded),
                Texels::Light(texels) => RowTexels::Light(&texels[range]),
            };
        }
        RowTexels::Light(&self.level(level)[range])
    }

    #[inline]
    fn level(&self, level: usize) -> &[[f32; 4]] {
        self.levels[level].get_or_init(|| {
            let rows = self.grids[level].rows.iter().enumerate();
            let stored = rows.filter(|(_, row)| level > 0 || row.ladder > 0);
            stored.flat_map(|(idx, _)| self.computed_row(level, idx)).collect()
        })
    }

    /// The means of the texels below a row, weighted by their areas.
    fn computed_row(&self, level: usize, idx: usize) -> Vec<[f32; 4]> {
        let n = self.ladder[self.grids[level].rows[idx].ladder].n;
        let mut sum = vec![[0.0_f32; 4]; n];
        if level == 0 {
            let range = idx * self.ladder[0].n..(idx + 1) * self.ladder[0].n;
            match &self.texels {
                Texels::Srgb(texels) => RowTexels::Srgb(&texels[range], &self.decoded),
                Texels::Light(texels) => RowTexels::Light(&texels[range]),
            }
            .add_reduced(1.0, &mut sum);
            return sum;
        }
        let finer = &self.grids[level - 1];
        let n_rows = self.grids[level].rows.len();
        let parts = overlaps(finer.rows.len(), n_rows, idx);
        // Relative to the solid angle of the whole row.
        let whole = |(row, part): (usize, f64)| {
            let row = &finer.rows[row];
            part * f64::from(row.area) * self.ladder[row.ladder].n as f64
        };
        let total: f64 = parts.clone().map(whole).sum();
        for (row, part) in parts {
            self.row(level - 1, &finer.rows[row]).add_reduced((whole((row, part)) / total) as f32, &mut sum);
        }
        sum
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

/// The texels of a row.
#[derive(Clone, Copy)]
pub(crate) enum RowTexels<'a> {
    Srgb(&'a [[u8; 4]], &'a [f32; 256]),
    Light(&'a [[f32; 4]]),
}

impl RowTexels<'_> {
    /// A texel: light times alpha, and alpha.
    #[inline]
    pub fn get(&self, idx: usize) -> [f32; 4] {
        match self {
            Self::Srgb(texels, decoded) => {
                let [red, green, blue, alpha] = texels[idx];
                let light = [red, green, blue].map(|level| decoded[usize::from(level)]);
                if alpha == 255 {
                    return [light[0], light[1], light[2], 1.0];
                }
                let alpha = f32::from(alpha) / 255.0;
                [alpha * light[0], alpha * light[1], alpha * light[2], alpha]
            }
            Self::Light(texels) => texels[idx],
        }
    }

    fn len(&self) -> usize {
        match self {
            Self::Srgb(texels, _) => texels.len(),
            Self::Light(texels) => texels.len(),
        }
    }

    /// Adds the row, reduced to fewer columns by means, times a weight.
    fn add_reduced(&self, weight: f32, sum: &mut [[f32; 4]]) {
        let (n_fine, n) = (self.len(), sum.len());
        for (idx, sum) in sum.iter_mut().enumerate() {
            let mut add = |cell: usize, part: f32| {
                let texel = self.get(cell);
                (0..4).for_each(|channel| sum[channel] += part * texel[channel]);
            };
            if n_fine == 2 * n {
                add(2 * idx, 0.5 * weight);
                add(2 * idx + 1, 0.5 * weight);
            } else {
                let per_cell = weight * n as f32 / n_fine as f32;
                overlaps(n_fine, n, idx).for_each(|(cell, part)| add(cell, per_cell * part as f32));
            }
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
            panorama.prepare(1.0);
            let mean = |level: usize| {
                let (mut sum, mut total) = ([0.0_f64; 4], 0.0);
                for row in &panorama.grids[level].rows {
                    let texels = panorama.row(level, row);
                    for idx in 0..texels.len() {
                        let area = f64::from(row.area);
                        (0..4).for_each(|i| sum[i] += area * f64::from(texels.get(idx)[i]));
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
