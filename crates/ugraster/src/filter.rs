//! Pixels that weigh the samples around their centres, those of neighbouring pixels among them.
//!
//! The picture is drawn in strips of pixel rows, in parallel; the rows next to a strip are drawn
//! again for their samples. Each row of samples is added, with its weights, to the pixel rows it
//! counts for. A pixel row is finished after the last of its samples, so memory grows only with the
//! width of the picture.

use std::collections::VecDeque;

use fearless_simd::{Level, Simd, dispatch};
use ugframe::Filter;

use crate::progress::BandProgress;
use crate::rasterizer::{Rasterizer, paint_parts};
use crate::resolve::{Center, PixelSamples, Planes, Resolve, Resolver};
use crate::shading::{SampleShading, SampleStats};
use crate::transparency::{Keep, TileBuffers};

/// Rows of pixels of a strip: many, beside those that are drawn twice.
const STRIP_ROWS: u32 = 32;

impl<const N: usize> Rasterizer<'_, N> {
    /// As [`Rasterizer::paint`], with a reconstruction filter. `resolve` receives light and
    /// coverage only.
    pub fn paint_filtered<P: Copy + Send + Sync>(
        &self,
        filter: Filter,
        shading: &dyn SampleShading<N>,
        resolve: &impl Resolve<P>,
        progress: &dyn BandProgress,
    ) -> (Vec<P>, SampleStats) {
        let grid = self.grid;
        let (weights, margin) = (filter.weights(grid.samples), filter.margin());
        let empty = resolve.pixel(&PixelSamples::EMPTY);
        paint_parts(grid, STRIP_ROWS, empty, progress, |buffers, strip, pixels| {
            let top = strip as u32 * STRIP_ROWS;
            let rows = [top, (top + STRIP_ROWS).min(grid.height)];
            let mut strip = Strip { rasterizer: self, margin, weights: &weights, buffers };
            let mut resolver = Resolver::new(grid, shading);
            for first in (0..grid.width).step_by(grid.tile_columns() as usize) {
                let columns = [first, (first + grid.tile_columns()).min(grid.width)];
                strip.paint(&mut resolver, columns, rows, |[column, row], samples| {
                    pixels[(row - top) as usize * grid.width as usize + column as usize] =
                        resolve.pixel(samples);
                });
            }
            resolver.stats
        })
    }

    /// A pixel of [`Rasterizer::paint_filtered`]: the same bits, because sums do not depend on
    /// where a strip starts.
    pub fn probe_filtered<P>(
        &self,
        filter: Filter,
        shading: &dyn SampleShading<N>,
        resolve: &impl Resolve<P>,
        [column, row]: [u32; 2],
    ) -> P {
        let (weights, margin) = (filter.weights(self.grid.samples), filter.margin());
        let buffers = &mut StripBuffers::default();
        let mut strip = Strip { rasterizer: self, margin, weights: &weights, buffers };
        let mut resolver = Resolver::new(self.grid, shading);
        let mut found = resolve.pixel(&PixelSamples::EMPTY);
        let take = |_, samples: &PixelSamples<'_>| found = resolve.pixel(samples);
        strip.paint(&mut resolver, [column, column + 1], [row, row + 1], take);
        found
    }
}

/// Buffers of a strip.
#[derive(Default)]
struct StripBuffers<const N: usize> {
    tile: TileBuffers<N>,
    /// Sums of the pixel rows that have some of their samples, from the uppermost.
    pending: VecDeque<RowSums>,
    spare: Vec<RowSums>,
}

/// Weighted sums of linear light and coverage down the columns of samples, for a row of pixels.
#[derive(Default)]
struct RowSums(Planes);

impl RowSums {
    /// Sets them to zero.
    fn clear(&mut self, n_columns: usize) {
        for sums in &mut self.0 {
            sums.clear();
            sums.resize(n_columns, 0.0);
        }
    }

    /// Adds a row of samples, from column `first` of the sums on.
    fn add(&mut self, first: usize, weight: f32, lit: &Planes) {
        dispatch!(Level::new(), simd => self.add_on(simd, first, weight, lit));
    }

    #[inline(always)] // Compiled for several instruction sets.
    fn add_on<S: Simd>(&mut self, _: S, first: usize, weight: f32, lit: &Planes) {
        for (sums, lit) in self.0.iter_mut().zip(lit) {
            for (sum, lit) in sums[first..].iter_mut().zip(lit) {
                *sum += weight * lit;
            }
        }
    }

    /// The weighted sum of the columns from `first` on. `weight`: the sum of weights down a column.
    fn pixel(
        &self,
        first: usize,
        weights: &[f32],
        weight: f32,
        n_samples: f32,
    ) -> PixelSamples<'static> {
        let [red, green, blue, coverage] =
            self.0.each_ref().map(|sums| &sums[first..first + weights.len()]);
        let (mut sum, mut covered, mut all) = ([0.0; 3], 0.0, 0.0);
        for ((((part, red), green), blue), coverage) in
            weights.iter().zip(red).zip(green).zip(blue).zip(coverage)
        {
            sum[0] += part * red;
            sum[1] += part * green;
            sum[2] += part * blue;
            covered += part * coverage;
            all += part * weight;
        }
        // Scaled to a sum of `n_samples` samples. The quotient comes first: it is exactly 1 for a
        // fully covered pixel.
        let scaled = |sum: f32| sum / all * n_samples;
        PixelSamples { sum: sum.map(scaled), covered: scaled(covered), center: Center::default() }
    }
}

/// A part of the picture being drawn.
struct Strip<'a, const N: usize> {
    rasterizer: &'a Rasterizer<'a, N>,
    /// Pixels on each side whose samples count.
    margin: u32,
    /// Weights along a side of a pixel.
    weights: &'a [f32],
    buffers: &'a mut StripBuffers<N>,
}

impl<const N: usize> Strip<'_, N> {
    /// Calls `take` with the column and row of each pixel of some columns and rows that shows
    /// something, and with its samples.
    fn paint(
        &mut self,
        resolver: &mut Resolver<'_, N>,
        columns: [u32; 2],
        rows: [u32; 2],
        mut take: impl FnMut([u32; 2], &PixelSamples<'_>),
    ) {
        let grid = self.rasterizer.grid;
        let wide = self.around(columns, grid.width);
        let tall = self.around(rows, grid.height);
        // The first pending row of pixels, and the first that has not been drawn.
        let (mut pending, mut row) = (rows[0], tall[0]);
        while row < tall[1] {
            // In parts that are within a tile, and within this strip or outside of it.
            let ends = [grid.tile_end(row), rows[0], rows[1], tall[1]];
            let end = ends.into_iter().filter(|&end| end > row).min().unwrap_or(tall[1]);
            self.begin_rows((end + self.margin).min(rows[1]) - pending, wide);
            for part in [[wide[0], columns[0]], columns, [columns[1], wide[1]]] {
                let before = resolver.stats;
                self.add(resolver, part, [row, end], wide[0], pending);
                if part != columns || row < rows[0] || row >= rows[1] {
                    // The strip they belong to counts these samples.
                    resolver.stats = before;
                }
            }
            row = end;
            let is_last = row == tall[1];
            let done = if is_last {
                rows[1]
            } else {
                row.saturating_sub(self.margin).clamp(pending, rows[1])
            };
            for finished in pending..done {
                self.finish(finished, columns, wide[0], &mut take);
            }
            pending = done;
        }
    }

    /// The range of pixels whose samples count for pixels of a range.
    fn around(&self, [first, end]: [u32; 2], last: u32) -> [u32; 2] {
        [first.saturating_sub(self.margin), (end + self.margin).min(last)]
    }

    /// Adds empty pending rows until there are `n_rows`.
    fn begin_rows(&mut self, n_rows: u32, [first, end]: [u32; 2]) {
        while self.buffers.pending.len() < n_rows as usize {
            let mut sums = self.buffers.spare.pop().unwrap_or_default();
            sums.clear(((end - first) * self.rasterizer.grid.samples) as usize);
            self.buffers.pending.push_back(sums);
        }
    }

    /// Draws some columns and rows of pixels, which are within a tile, and adds their samples to
    /// the pending rows. `left`: the first column of pixels in the sums. `pending`: the first
    /// pending row.
    fn add(
        &mut self,
        resolver: &mut Resolver<'_, N>,
        columns: [u32; 2],
        rows: [u32; 2],
        left: u32,
        pending: u32,
    ) {
        if columns[0] == columns[1] {
            return;
        }
        let grid = self.rasterizer.grid;
        let n = grid.samples;
        let samples = rows[0] * n..rows[1] * n;
        let band = grid.bands().of(&samples).start as usize;
        let StripBuffers { tile: buffers, pending: all_sums, .. } = &mut *self.buffers;
        let stats = self.rasterizer.draw_tile(buffers, band, columns, rows, Keep::Light);
        resolver.stats = resolver.stats.merge(stats);
        for sample in samples {
            let columns_of_samples = columns.map(|column| column * n);
            let Some(lit) = resolver.light(buffers, sample, columns_of_samples) else {
                continue;
            };
            for (pixel, sums) in (pending..).zip(&mut *all_sums) {
                let idx = (sample + self.margin * n).checked_sub(pixel * n);
                if let Some(weight) = idx.and_then(|idx| self.weights.get(idx as usize))
                    && *weight != 0.0
                {
                    sums.add(((columns[0] - left) * n) as usize, *weight, lit);
                }
            }
        }
    }

    /// Finishes the first pending row of pixels, which is `row`.
    fn finish(
        &mut self,
        row: u32,
        columns: [u32; 2],
        left: u32,
        take: &mut impl FnMut([u32; 2], &PixelSamples<'_>),
    ) {
        let Some(sums) = self.buffers.pending.pop_front() else { return };
        let grid = self.rasterizer.grid;
        let n = grid.samples;
        // Added in the order in which coverage was, so that a fully covered pixel has the same
        // bits.
        let weight = self.inside(row, grid.height).1.iter().fold(0.0, |sum, weight| sum + weight);
        for column in columns[0]..columns[1] {
            let (first, weights) = self.inside(column, grid.width);
            let samples = sums.pixel((first - left * n) as usize, weights, weight, (n * n) as f32);
            if samples.covered != 0.0 {
                take([column, row], &samples);
            }
        }
        self.buffers.spare.push(sums);
    }

    /// The first sample along a side that counts for a pixel and is in the picture, and the weights
    /// of all that do.
    fn inside(&self, pixel: u32, n_pixels: u32) -> (u32, &[f32]) {
        let n = self.rasterizer.grid.samples;
        let [first, end] = self.around([pixel, pixel + 1], n_pixels).map(|pixel| pixel * n);
        let missing = self.margin.saturating_sub(pixel) * n;
        (first, &self.weights[missing as usize..(missing + end - first) as usize])
    }
}
