//! Bands of pixel rows, drawn in parallel.

use std::ops::Range;
use std::sync::{Mutex, MutexGuard, PoisonError};

use fearless_simd::{Level, Simd, dispatch};
use rayon::prelude::*;

use crate::cue::Cue;
use crate::edges::Scanner;
use crate::polygons::{Drawn, PolygonList};
use crate::progress::Progress;
use crate::resolve::{Finish, Gathered, Resolver};
use crate::shading::{Shading, Tally};
use crate::spans::{Sink, Tag, Tile};
use crate::transparency::{KeepFragments, TransparencyBuffer, TransparentLayer};
use crate::triangles::{Table, Traces};

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
    /// How what is far fades, if it does.
    pub cue: Option<Cue>,
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

    /// The depth along the view of a key.
    pub fn depth(&self, key: f64) -> f64 {
        if self.is_perspective { 1.0 / key } else { -key }
    }

    /// The part of the light that depth cueing leaves at a key.
    #[inline]
    pub fn cue_at(&self, key: f32) -> f32 {
        self.cue.map_or(1.0, |cue| cue.part(self.depth(f64::from(key))) as f32)
    }

    /// Pixel columns of a tile.
    pub fn tile_columns(&self) -> u32 {
        (MAX_ROW_SAMPLES / (self.samples * self.samples)).clamp(1, self.width)
    }

    /// Pixel rows of a tile.
    fn tile_rows(&self) -> u32 {
        let row_samples = self.samples * self.samples * self.tile_columns();
        (TILE_SAMPLES / row_samples).clamp(1, self.height)
    }

    /// Behind the last row of the tile that a row of pixels is in.
    pub fn tile_end(&self, row: u32) -> u32 {
        (row / self.tile_rows() + 1) * self.tile_rows()
    }

    /// Pixel rows of a band, a whole number of tiles.
    fn band_rows(&self) -> u32 {
        self.height.div_ceil(MAX_BANDS).next_multiple_of(self.tile_rows())
    }

    /// Number of bands.
    pub fn n_bands(&self) -> usize {
        self.height.div_ceil(self.band_rows()) as usize
    }

    /// The bands of the picture.
    pub fn bands(&self) -> Bands {
        Bands { sample_rows: self.band_rows() * self.samples }
    }
}

/// How a picture is cut into bands.
#[derive(Clone, Copy, Debug)]
pub struct Bands {
    sample_rows: u32,
}

impl Bands {
    /// Rows of samples in each.
    pub fn sample_rows(&self) -> u32 {
        self.sample_rows
    }

    /// Those that these rows of samples lie in; `rows` is not empty.
    #[inline]
    pub fn of(&self, rows: &Range<u32>) -> Range<u32> {
        rows.start / self.sample_rows..(rows.end - 1) / self.sample_rows + 1
    }
}

/// What is drawn: something that knows which samples of a tile it covers.
pub trait Layer<const N: usize>: Sync {
    /// Draws into a tile, or onto one, what of it is in the band the tile belongs to.
    fn draw(&self, grid: &Grid, band: usize, scanner: &mut Scanner<N>, sink: &mut impl Sink<N>);
}

/// Shapes, list after list, that have been sorted into the bands of the grid.
pub struct Shapes<'a, const N: usize, C: ?Sized> {
    /// Polygons and triangles.
    pub lists: &'a [PolygonList<N>],
    /// Where the corners of triangles are.
    pub table: &'a C,
}

impl<const N: usize, C: Table<N> + ?Sized> Layer<N> for Shapes<'_, N, C> {
    fn draw(&self, grid: &Grid, band: usize, scanner: &mut Scanner<N>, sink: &mut impl Sink<N>) {
        dispatch!(Level::new(), simd => self.draw_on(simd, grid, band, scanner, sink));
    }
}

impl<const N: usize, C: Table<N> + ?Sized> Shapes<'_, N, C> {
    /// Draws them. All of a triangle is compiled into this, once for each of several families of processors.
    #[inline(always)]
    fn draw_on<S: Simd>(
        &self,
        simd: S,
        grid: &Grid,
        band: usize,
        scanner: &mut Scanner<N>,
        sink: &mut impl Sink<N>,
    ) {
        let [first_row, end_row] = sink.rows();
        let is_perspective = grid.is_perspective;
        let mut traces = Traces::default();
        for (item, shape) in self.lists.iter().flat_map(|list| list.in_band(band)) {
            match shape {
                Drawn::Triangle(corners) => {
                    let [a, b, c] = corners;
                    let points = [self.table.point(a), self.table.point(b), self.table.point(c)];
                    if traces.push(item, corners, points) {
                        traces.draw(simd, sink, is_perspective, self.table);
                    }
                }
                Drawn::Polygon(contours) => {
                    // Of equals the first drawn stays, so the order is kept.
                    traces.draw(simd, sink, is_perspective, self.table);
                    scanner.scan(contours, first_row, end_row, |row, left, right| {
                        sink.draw(row, left, right, is_perspective, item);
                    });
                }
            }
        }
        traces.draw(simd, sink, is_perspective, self.table);
    }
}

/// Draws a layer, and what is clear before it: the pixels of the grid, row after row.
///
/// They do not depend on the number of threads. `finish` makes a pixel of its samples. `progress` counts
/// bands.
pub fn paint<const N: usize, L, T, P, S, F>(
    grid: &Grid,
    layer: &L,
    clear: Option<&dyn TransparentLayer>,
    shader: &S,
    finish: &F,
    progress: &dyn Progress,
) -> (Vec<P>, Tally)
where
    L: Layer<N> + ?Sized,
    T: Tag,
    P: Copy + Send + Sync,
    S: Shading<N>,
    F: Finish<T, P>,
{
    let empty = finish.pixel(&Gathered::EMPTY);
    paint_parts(grid, grid.band_rows(), empty, progress, |buffers, band, pixels| {
        let (scanner, tile, transparency) = buffers;
        let mut resolver = Resolver::new(shader, finish, grid);
        Band { grid, layer, clear, band, scanner, tile, transparency }.paint(&mut resolver, pixels);
        resolver.tally
    })
}

/// The pixels of the grid, painted in parallel in parts of as many rows, over those that are `empty`. `paint` is given buffers, the
/// number of a part, and its pixels.
pub fn paint_parts<P: Copy + Send + Sync, B: Default + Send>(
    grid: &Grid,
    n_rows: u32,
    empty: P,
    progress: &dyn Progress,
    paint: impl Fn(&mut B, usize, &mut [P]) -> Tally + Sync,
) -> (Vec<P>, Tally) {
    let part_pixels = n_rows as usize * grid.width as usize;
    let mut pixels = filled(empty, grid.width as usize * grid.height as usize);
    progress.begin(pixels.len().div_ceil(part_pixels) as u64);
    // Buffers go from part to part: as many as there are threads, and touched once.
    let buffers = Buffers::default();
    let tally = pixels
        .par_chunks_mut(part_pixels)
        .with_max_len(1)
        .enumerate()
        .map(|(part, pixels)| {
            let mut own = buffers.take();
            let tally = paint(&mut own, part, pixels);
            buffers.put_back(own);
            progress.done();
            tally
        })
        .reduce(Tally::default, Tally::merge);
    (pixels, tally)
}

/// As many of a value, written by all threads.
fn filled<P: Copy + Send + Sync>(value: P, len: usize) -> Vec<P> {
    // Many together, for a list that is made in parallel takes its elements one by one.
    const TOGETHER: usize = 64;
    let parts: Vec<[P; TOGETHER]> =
        rayon::iter::repeat_n([value; TOGETHER], len.div_ceil(TOGETHER)).collect();
    let mut all = parts.into_flattened();
    all.truncate(len);
    all
}

/// Buffers that no thread uses just now.
struct Buffers<B>(Mutex<Vec<B>>);

impl<B> Default for Buffers<B> {
    fn default() -> Self {
        Self(Mutex::new(Vec::new()))
    }
}

impl<B: Default> Buffers<B> {
    fn take(&self) -> B {
        self.lock().pop().unwrap_or_default()
    }

    fn put_back(&self, buffer: B) {
        self.lock().push(buffer);
    }

    fn lock(&self) -> MutexGuard<'_, Vec<B>> {
        // A thread that panicked left at worst fewer buffers.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// One band being drawn.
pub struct Band<'a, const N: usize, L: ?Sized, T> {
    pub grid: &'a Grid,
    pub layer: &'a L,
    pub clear: Option<&'a dyn TransparentLayer>,
    pub band: usize,
    pub scanner: &'a mut Scanner<N>,
    pub tile: &'a mut Tile<N, T>,
    pub transparency: &'a mut TransparencyBuffer,
}

impl<const N: usize, L: Layer<N> + ?Sized, T: Tag> Band<'_, N, L, T> {
    fn paint<P: Copy, S, F>(&mut self, resolver: &mut Resolver<'_, S, F>, pixels: &mut [P])
    where
        S: Shading<N>,
        F: Finish<T, P>,
    {
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
    fn paint_tile<P: Copy, S, F>(
        &mut self,
        resolver: &mut Resolver<'_, S, F>,
        column: u32,
        row: u32,
        rows: &mut [P],
    ) where
        S: Shading<N>,
        F: Finish<T, P>,
    {
        let grid = self.grid;
        let end_column = (column + grid.tile_columns()).min(grid.width);
        let n_rows = rows.len() as u32 / grid.width;
        self.draw([column, end_column], [row, row + n_rows]);
        let clear = self.draw_clear(if T::IS_KEPT { KeepFragments::Centers } else { KeepFragments::None });
        resolver.tally = resolver.tally.merge(clear);
        for (row, pixels) in (row..).zip(rows.chunks_mut(grid.width as usize)) {
            let pixels = &mut pixels[column as usize..end_column as usize];
            resolver.paint(self.tile, self.transparency, column, row, pixels);
        }
    }

    /// Makes the tile that of these columns and rows of pixels, all in this band, and draws it.
    pub fn draw(&mut self, columns: [u32; 2], rows: [u32; 2]) {
        let samples = |pixels: u32| pixels * self.grid.samples;
        self.tile.reset(columns.map(samples), rows.map(samples));
        self.layer.draw(self.grid, self.band, self.scanner, self.tile);
    }

    /// Draws what is clear over the tile.
    pub fn draw_clear(&mut self, keep: KeepFragments) -> Tally {
        match self.clear {
            Some(clear) => self.transparency.draw(clear, self.grid, self.band, self.tile, keep),
            None => Tally::default(),
        }
    }
}
