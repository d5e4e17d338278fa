//! Bands of pixel rows, drawn in parallel.

use std::ops::Range;

use rayon::prelude::*;
use ugimage::{Frame, Quantizer};

use super::edges::Scanner;
use super::polygons::PolygonList;
use super::resolve::{Backdrop, Resolver, Shade, Tally};
use super::spans::Tile;

/// Samples a tile should have: with some 16 bytes each they stay in a core's cache.
const TILE_SAMPLES: u32 = 1 << 15;

/// Most samples of a tile one pixel high. Only pictures wider than that are cut into columns
/// of tiles, for every column scans the outlines anew.
const MAX_ROW_SAMPLES: u32 = 1 << 19;

/// Most bands a picture is cut into; more would only cost memory for the bins.
const MAX_BANDS: u32 = 1 << 10;

/// The sample grid of a picture.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Samples along a side of a pixel.
    pub samples: u32,
    /// True if values are multiplied by the depth key.
    pub is_perspective: bool,
}

impl Grid {
    /// Samples across.
    pub fn sample_columns(&self) -> u32 {
        self.width * self.samples
    }

    /// Samples down.
    pub fn sample_rows(&self) -> u32 {
        self.height * self.samples
    }

    /// Pixel columns of a tile.
    fn tile_columns(&self) -> u32 {
        (MAX_ROW_SAMPLES / (self.samples * self.samples)).clamp(1, self.width)
    }

    /// Pixel rows of a tile.
    fn tile_rows(&self) -> u32 {
        let row_samples = self.samples * self.samples * self.tile_columns();
        (TILE_SAMPLES / row_samples).clamp(1, self.height)
    }

    /// Pixel rows of a band, a whole number of tiles.
    fn band_rows(&self) -> u32 {
        self.height.div_ceil(MAX_BANDS).next_multiple_of(self.tile_rows())
    }

    /// Number of bands.
    pub fn n_bands(&self) -> usize {
        self.height.div_ceil(self.band_rows()) as usize
    }

    /// The bands that these rows of samples lie in; `rows` is not empty.
    pub fn bands_of(&self, rows: &Range<u32>) -> Range<usize> {
        let band_samples = self.band_rows() * self.samples;
        (rows.start / band_samples) as usize..((rows.end - 1) / band_samples) as usize + 1
    }
}

/// Draws polygons, list after list, into a frame of the grid's size.
///
/// The lists have been sorted into the bands of this grid. The pixels do not depend on the
/// number of threads: bands are cut by the size of the picture alone.
pub fn paint<const N: usize, S>(
    frame: &mut Frame,
    grid: &Grid,
    lists: &[PolygonList<N>],
    backdrop: Backdrop,
    shader: &S,
) -> Tally
where
    S: Fn(&[f32; N]) -> Shade + Sync,
{
    let quantizer = Quantizer::new();
    let band_pixels = grid.band_rows() as usize * grid.width as usize;
    frame
        .pixels_mut()
        .par_chunks_mut(band_pixels)
        .enumerate()
        .map_init(
            || (Scanner::default(), Tile::default()),
            |(scanner, tile), (band, pixels)| {
                let mut resolver = Resolver::new(shader, &quantizer, backdrop, grid.samples);
                Band { grid, lists, band, scanner, tile }.paint(&mut resolver, pixels);
                resolver.tally
            },
        )
        .reduce(Tally::default, Tally::merge)
}

/// One band being drawn.
struct Band<'a, const N: usize> {
    grid: &'a Grid,
    lists: &'a [PolygonList<N>],
    band: usize,
    scanner: &'a mut Scanner<N>,
    tile: &'a mut Tile<N>,
}

impl<const N: usize> Band<'_, N> {
    fn paint<S: Fn(&[f32; N]) -> Shade>(
        &mut self,
        resolver: &mut Resolver<'_, N, S>,
        pixels: &mut [[u8; 4]],
    ) {
        let grid = self.grid;
        let top = self.band as u32 * grid.band_rows();
        let tile_rows = grid.tile_rows() as usize;
        for (row, rows) in (top..).step_by(tile_rows).zip(pixels.chunks_mut(tile_rows * grid.width as usize))
        {
            for column in (0..grid.width).step_by(grid.tile_columns() as usize) {
                self.paint_tile(resolver, column, row, rows);
            }
        }
    }

    /// Draws the tile whose upper left pixel is given into `rows`, whole rows of the frame.
    fn paint_tile<S: Fn(&[f32; N]) -> Shade>(
        &mut self,
        resolver: &mut Resolver<'_, N, S>,
        column: u32,
        row: u32,
        rows: &mut [[u8; 4]],
    ) {
        let grid = self.grid;
        let end_column = (column + grid.tile_columns()).min(grid.width);
        let n_rows = rows.len() as u32 / grid.width;
        let samples = |pixels: u32| pixels * grid.samples;
        self.tile.reset([samples(column), samples(end_column)], [samples(row), samples(row + n_rows)]);
        self.draw_polygons();
        for (row, pixels) in (row..).zip(rows.chunks_mut(grid.width as usize)) {
            resolver.paint(self.tile, column, row, &mut pixels[column as usize..end_column as usize]);
        }
    }

    fn draw_polygons(&mut self) {
        let [first_row, end_row] = self.tile.rows();
        for polygon in self.lists.iter().flat_map(|list| list.in_band(self.band)) {
            self.scanner.scan(polygon, first_row, end_row, |row, left, right| {
                self.tile.draw(row, left, right, self.grid.is_perspective);
            });
        }
    }
}
