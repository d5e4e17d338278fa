//! Bands of pixel rows, drawn in parallel.

use std::sync::{Mutex, MutexGuard, PoisonError};

use rayon::prelude::*;

use crate::grid::SampleGrid;
use crate::layer::OpaqueLayer;
use crate::progress::BandProgress;
use crate::resolve::{Center, PixelSamples, Resolve, Resolver, center};
use crate::shading::{SampleShading, SampleStats};
use crate::tile::Area;
use crate::transparency::{Keep, TileBuffers, TransparentLayer};

/// The shapes to draw. The methods differ in what they make of the samples; their output does not
/// depend on the number of threads.
#[derive(Clone, Copy)]
pub struct Rasterizer<'a, const N: usize> {
    /// The sample grid.
    pub grid: &'a SampleGrid,
    /// Opaque surfaces, with N interpolated values.
    pub opaque: &'a dyn OpaqueLayer<N>,
    /// Transparent surfaces and lines in front of them.
    pub transparent: Option<&'a dyn TransparentLayer>,
}

impl<const N: usize> Rasterizer<'_, N> {
    /// The pixels of the grid, row after row, and statistics of their samples. With
    /// [`Keep::Centers`], `resolve` receives what is visible at the centres of pixels. Progress
    /// counts bands.
    pub fn paint<P: Copy + Send + Sync>(
        &self,
        shading: &dyn SampleShading<N>,
        keep: Keep,
        resolve: &impl Resolve<P>,
        progress: &dyn BandProgress,
    ) -> (Vec<P>, SampleStats) {
        let grid = self.grid;
        let empty = resolve.pixel(&PixelSamples::EMPTY);
        paint_parts(grid, grid.band_rows(), empty, progress, |buffers, band, pixels| {
            let mut resolver = Resolver::new(grid, shading);
            let stats = self.for_each_row(buffers, band, keep, pixels, |buffers, place, pixels| {
                resolver.paint(resolve, buffers, place, pixels);
            });
            resolver.stats.merge(stats)
        })
    }

    /// The pixels of the grid, row after row, each made by `pixel` of what is visible at its
    /// centre. No light of opaque surfaces is computed.
    pub fn paint_centers<P: Copy + Send + Sync>(
        &self,
        pixel: impl Fn(&Center<'_>) -> P + Sync,
        progress: &dyn BandProgress,
    ) -> Vec<P> {
        let grid = self.grid;
        let empty = pixel(&Center::default());
        let (pixels, _) =
            paint_parts(grid, grid.band_rows(), empty, progress, |buffers, band, pixels| {
                self.for_each_row(
                    buffers,
                    band,
                    Keep::Centers,
                    pixels,
                    |buffers, [first, row], pixels| {
                        for (column, out) in (first..).zip(pixels) {
                            let center = center(grid, buffers, [column, row]);
                            if !center.is_empty() {
                                *out = pixel(&center);
                            }
                        }
                    },
                )
            });
        pixels
    }

    /// Draws a band tile by tile. `take` receives each tile with each row of its pixels: column and
    /// row of the first, and the pixels. Returns the statistics of transparent samples.
    fn for_each_row<P>(
        &self,
        buffers: &mut TileBuffers<N>,
        band: usize,
        keep: Keep,
        pixels: &mut [P],
        mut take: impl FnMut(&TileBuffers<N>, [u32; 2], &mut [P]),
    ) -> SampleStats {
        let grid = self.grid;
        let width = grid.width as usize;
        let top = band as u32 * grid.band_rows();
        let tile_rows = grid.tile_rows() as usize;
        let mut stats = SampleStats::default();
        for (row, rows) in (top..).step_by(tile_rows).zip(pixels.chunks_mut(tile_rows * width)) {
            for column in (0..grid.width).step_by(grid.tile_columns() as usize) {
                let end_column = (column + grid.tile_columns()).min(grid.width);
                let end_row = row + rows.len() as u32 / grid.width;
                stats = stats.merge(self.draw_tile(
                    buffers,
                    band,
                    [column, end_column],
                    [row, end_row],
                    keep,
                ));
                for (row, pixels) in (row..).zip(rows.chunks_mut(width)) {
                    take(buffers, [column, row], &mut pixels[column as usize..end_column as usize]);
                }
            }
        }
        stats
    }

    /// Draws the tile of some columns and rows of pixels, all in one band. Returns the statistics
    /// of transparent samples.
    #[inline(never)] // One copy for all kinds of pixels.
    pub(crate) fn draw_tile(
        &self,
        buffers: &mut TileBuffers<N>,
        band: usize,
        columns: [u32; 2],
        rows: [u32; 2],
        keep: Keep,
    ) -> SampleStats {
        let Self { grid, opaque, transparent } = *self;
        let TileBuffers { scanner, tile, transparency } = buffers;
        let samples = |pixels: u32| pixels * grid.samples;
        let area = Area { columns: columns.map(samples), rows: rows.map(samples) };
        tile.reset(area, opaque.planes(), keep != Keep::Light);
        opaque.draw(grid, band, scanner, tile);
        let draw = |layer| transparency.draw(layer, grid, band, tile.opaque(), keep);
        transparent.map_or_else(SampleStats::default, draw)
    }
}

/// The pixels of the grid, painted in parallel in parts of `n_rows` rows, over pixels that are
/// `empty`. `paint` receives buffers, the number of a part, and its pixels.
pub(crate) fn paint_parts<P: Copy + Send + Sync, B: Default + Send>(
    grid: &SampleGrid,
    n_rows: u32,
    empty: P,
    progress: &dyn BandProgress,
    paint: impl Fn(&mut B, usize, &mut [P]) -> SampleStats + Sync,
) -> (Vec<P>, SampleStats) {
    let mut pixels = filled(empty, grid.width as usize * grid.height as usize);
    let part_pixels = n_rows as usize * grid.width as usize;
    // No thread waits for one of these locks: each part is taken once.
    let part = |pixels| Mutex::new((pixels, SampleStats::default()));
    let parts: Vec<_> = pixels.chunks_mut(part_pixels).map(part).collect();
    progress.begin(parts.len() as u64);
    // Buffers go from part to part: there are as many as threads, and their memory is touched once.
    let buffers: Mutex<Vec<B>> = Mutex::default();
    in_parallel(parts.len(), &|part| {
        if progress.is_stopped() {
            return;
        }
        let mut own = lock(&buffers).pop().unwrap_or_default();
        let (pixels, stats) = &mut *lock(&parts[part]);
        *stats = paint(&mut own, part, pixels);
        lock(&buffers).push(own);
        progress.done();
    });
    let stats = parts.iter().fold(SampleStats::default(), |all, part| all.merge(lock(part).1));
    drop(parts);
    (pixels, stats)
}

/// Calls a function with each number below `n`, on all threads. The function is `dyn` because rayon
/// compiles some 2,000 lines of LLVM for each type of closure.
fn in_parallel(n: usize, call: &(dyn Fn(usize) + Sync)) {
    (0..n).into_par_iter().with_max_len(1).for_each(call);
}

/// A table of `len` copies of a value, written on all threads.
fn filled<P: Copy + Send + Sync>(value: P, len: usize) -> Vec<P> {
    // In groups, because a parallel iterator produces elements one by one.
    const GROUP: usize = 64;
    let mut groups = Vec::new();
    rayon::iter::repeat_n([value; GROUP], len.div_ceil(GROUP)).collect_into_vec(&mut groups);
    let mut all = groups.into_flattened();
    all.truncate(len);
    all
}

/// The locked value, even if a thread panicked while it had the lock: rayon repeats that panic when
/// the other threads are done.
fn lock<T>(value: &Mutex<T>) -> MutexGuard<'_, T> {
    value.lock().unwrap_or_else(PoisonError::into_inner)
}
