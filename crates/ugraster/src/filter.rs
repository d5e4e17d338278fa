//! Pixels that weigh the samples around their middles, those of their neighbours among them.
//!
//! The picture is drawn in strips of rows of pixels, in parallel; the rows next to a strip are drawn again for their
//! samples. Each row of samples is added, with its weights, to the rows of pixels it counts for, and a row of pixels is
//! finished when the last of its samples has come. So memory grows with the width of the picture alone.

use std::collections::VecDeque;

use fearless_simd::{Level, Simd, dispatch};

use crate::band::{Band, Grid, Layer, paint_parts};
use crate::edges::Scanner;
use crate::progress::Progress;
use crate::resolve::{Finish, Gathered, Resolver};
use crate::shading::{Shading, Tally};
use crate::spans::Tile;
use crate::transparency::{KeepFragments, TransparencyBuffer, TransparentLayer};

/// Rows of pixels of a strip: many, beside those that are drawn twice.
const STRIP_ROWS: u32 = 32;

/// How much samples weigh in a pixel, by their distances x and y from its middle in pixels: w(x) w(y).
///
/// These are B-splines: the weights of a sample in all pixels add up to 1, so wherever something small stands, the picture has
/// the same light of it. None is negative, so no pixel is darker or brighter than all of its samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// The samples of the pixel itself, all alike, as of a detector: w = 1 for |x| < ½.
    #[default]
    Box,
    /// w = 1 − |x|, up to 1.
    Triangle,
    /// The quadratic B-spline, nearly a Gaussian with σ = ½: w = ¾ − x² for |x| < ½, else ½ (3/2 − |x|)², up to 3/2.
    Spline,
}

impl Filter {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Box, Self::Triangle, Self::Spline];

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Box => "box",
            Self::Triangle => "triangle",
            Self::Spline => "spline",
        }
    }

    /// The filter called `name`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|filter| name == filter.name())
    }

    /// How many pixels beside its own have samples that count, on each side.
    fn margin(self) -> u32 {
        match self {
            Self::Box => 0,
            Self::Triangle | Self::Spline => 1,
        }
    }

    /// How many samples along a side count for a pixel with `n` of its own along a side.
    pub fn n_samples(self, n: u32) -> usize {
        self.weights(n).iter().filter(|weight| **weight != 0.0).count()
    }

    /// The weight at a distance in pixels.
    fn at(self, distance: f64) -> f64 {
        let x = distance.abs();
        match self {
            Self::Box => f64::from(u8::from(x < 0.5)),
            Self::Triangle => (1.0 - x).max(0.0),
            Self::Spline if x < 0.5 => 0.75 - x * x,
            Self::Spline => 0.5 * (1.5 - x).max(0.0) * (1.5 - x).max(0.0),
        }
    }

    /// The weights along a side of a pixel with `n` samples along a side.
    fn weights(self, n: u32) -> Vec<f32> {
        let place = |sample: u32| (f64::from(sample) + 0.5) / f64::from(n) - 0.5;
        let first = f64::from(self.margin());
        (0..n * (1 + 2 * self.margin())).map(|sample| self.at(place(sample) - first) as f32).collect()
    }
}

/// Draws a layer, and what is clear before it, as [`crate::paint`] does, by a filter. `finish` is told nothing but light.
pub fn paint_filtered<const N: usize, L, P, S, F>(
    grid: &Grid,
    filter: Filter,
    layer: &L,
    clear: Option<&dyn TransparentLayer>,
    shader: &S,
    finish: &F,
    progress: &dyn Progress,
) -> (Vec<P>, Tally)
where
    L: Layer<N> + ?Sized,
    P: Copy + Send + Sync,
    S: Shading<N>,
    F: Finish<(), P>,
{
    let (weights, margin) = (filter.weights(grid.samples), filter.margin());
    let empty = finish.pixel(&Gathered::EMPTY);
    paint_parts(grid, STRIP_ROWS, empty, progress, |own, strip, pixels| {
        let top = strip as u32 * STRIP_ROWS;
        let rows = [top, (top + STRIP_ROWS).min(grid.height)];
        let mut strip = Strip { grid, layer, clear, margin, weights: &weights, own };
        let mut resolver = Resolver::new(shader, finish, grid);
        for first in (0..grid.width).step_by(grid.tile_columns() as usize) {
            let columns = [first, (first + grid.tile_columns()).min(grid.width)];
            strip.paint(&mut resolver, columns, rows, |[column, row], pixel| {
                pixels[(row - top) as usize * grid.width as usize + column as usize] = pixel;
            });
        }
        resolver.tally
    })
}

/// A pixel of [`paint_filtered`]: the very numbers, for sums do not depend on where a strip begins.
pub fn probe_filtered<const N: usize, L, P, S, F>(
    grid: &Grid,
    filter: Filter,
    layer: &L,
    clear: Option<&dyn TransparentLayer>,
    shader: &S,
    finish: &F,
    [column, row]: [u32; 2],
) -> P
where
    L: Layer<N> + ?Sized,
    P: Copy,
    S: Shading<N>,
    F: Finish<(), P>,
{
    let mut found = finish.pixel(&Gathered::EMPTY);
    let (weights, margin) = (filter.weights(grid.samples), filter.margin());
    let mut strip = Strip { grid, layer, clear, margin, weights: &weights, own: &mut Own::default() };
    let mut resolver = Resolver::new(shader, finish, grid);
    strip.paint(&mut resolver, [column, column + 1], [row, row + 1], |_, pixel| found = pixel);
    found
}

/// Buffers of a strip.
struct Own<const N: usize> {
    scanner: Scanner<N>,
    tile: Tile<N, ()>,
    transparency: TransparencyBuffer,
    /// Of the rows of pixels that have samples and wait for more, from the uppermost.
    waiting: VecDeque<Sums>,
    spare: Vec<Sums>,
}

impl<const N: usize> Default for Own<N> {
    fn default() -> Self {
        Self {
            scanner: Scanner::default(),
            tile: Tile::default(),
            transparency: TransparencyBuffer::default(),
            waiting: VecDeque::new(),
            spare: Vec::new(),
        }
    }
}

/// Weighed sums of linear light, and of cover, down the columns of samples for a row of pixels.
#[derive(Default)]
struct Sums([Vec<f32>; 4]);

impl Sums {
    /// Makes them zero.
    fn clear(&mut self, n_columns: usize) {
        for sums in &mut self.0 {
            sums.clear();
            sums.resize(n_columns, 0.0);
        }
    }

    /// Adds a row of samples, of which the first stands in column `first`.
    fn add(&mut self, first: usize, weight: f32, lit: &[Vec<f32>; 4]) {
        dispatch!(Level::new(), simd => self.add_on(simd, first, weight, lit));
    }

    #[inline(always)] // Compiled for what the processor can do to many numbers at once.
    fn add_on<S: Simd>(&mut self, _: S, first: usize, weight: f32, lit: &[Vec<f32>; 4]) {
        for (sums, lit) in self.0.iter_mut().zip(lit) {
            for (sum, lit) in sums[first..].iter_mut().zip(lit) {
                *sum += weight * lit;
            }
        }
    }

    /// What the columns from `first` on add up to with their weights. `weight`: what a column of covered samples adds up
    /// to.
    fn pixel(&self, first: usize, weights: &[f32], weight: f32, n_samples: f32) -> Gathered<'static, ()> {
        let [red, green, blue, cover] = self.0.each_ref().map(|sums| &sums[first..first + weights.len()]);
        let (mut sum, mut covered, mut all) = ([0.0; 3], 0.0, 0.0);
        for ((((part, red), green), blue), cover) in weights.iter().zip(red).zip(green).zip(blue).zip(cover) {
            sum[0] += part * red;
            sum[1] += part * green;
            sum[2] += part * blue;
            covered += part * cover;
            all += part * weight;
        }
        // As if so many samples were added up. The quotient comes first: it is 1, to the bit, where all is covered.
        let of_samples = |sum: f32| sum / all * n_samples;
        Gathered { sum: sum.map(of_samples), covered: of_samples(covered), center: None, layers: &[] }
    }
}

/// A part of the picture being drawn.
struct Strip<'a, const N: usize, L: ?Sized> {
    grid: &'a Grid,
    layer: &'a L,
    clear: Option<&'a dyn TransparentLayer>,
    margin: u32,
    /// Along a side of a pixel.
    weights: &'a [f32],
    own: &'a mut Own<N>,
}

impl<const N: usize, L: Layer<N> + ?Sized> Strip<'_, N, L> {
    /// Gives `put` those pixels of these columns and rows that show something.
    fn paint<P, S, F>(
        &mut self,
        resolver: &mut Resolver<'_, S, F>,
        columns: [u32; 2],
        rows: [u32; 2],
        mut put: impl FnMut([u32; 2], P),
    ) where
        S: Shading<N>,
        F: Finish<(), P>,
    {
        let wide = self.around(columns, self.grid.width);
        let tall = self.around(rows, self.grid.height);
        // The first row of pixels that waits, and the first that has not been drawn.
        let (mut waiting, mut row) = (rows[0], tall[0]);
        while row < tall[1] {
            // Part by part: of a tile, and drawn for this strip or again for its neighbours.
            let ends = [self.grid.tile_end(row), rows[0], rows[1], tall[1]];
            let end = ends.into_iter().filter(|&end| end > row).min().unwrap_or(tall[1]);
            self.wait((end + self.margin).min(rows[1]) - waiting, wide);
            for part in [[wide[0], columns[0]], columns, [columns[1], wide[1]]] {
                let before = resolver.tally;
                self.add(resolver, part, [row, end], wide[0], waiting);
                if part != columns || row < rows[0] || row >= rows[1] {
                    // Counted by whom it belongs to.
                    resolver.tally = before;
                }
            }
            row = end;
            let is_last = row == tall[1];
            let done =
                if is_last { rows[1] } else { row.saturating_sub(self.margin).clamp(waiting, rows[1]) };
            for finished in waiting..done {
                self.finish(resolver.finish, finished, columns, wide[0], &mut put);
            }
            waiting = done;
        }
    }

    /// These pixels, and those whose samples they weigh.
    fn around(&self, [first, end]: [u32; 2], last: u32) -> [u32; 2] {
        [first.saturating_sub(self.margin), (end + self.margin).min(last)]
    }

    /// Lets so many rows wait.
    fn wait(&mut self, n_rows: u32, [first, end]: [u32; 2]) {
        while self.own.waiting.len() < n_rows as usize {
            let mut sums = self.own.spare.pop().unwrap_or_default();
            sums.clear(((end - first) * self.grid.samples) as usize);
            self.own.waiting.push_back(sums);
        }
    }

    /// Draws these columns and rows of pixels, which lie in a tile, and adds their samples to the rows that wait. `left`: the
    /// first column of the sums, `waiting`: the first row that waits.
    fn add<S, F>(
        &mut self,
        resolver: &mut Resolver<'_, S, F>,
        columns: [u32; 2],
        rows: [u32; 2],
        left: u32,
        waiting: u32,
    ) where
        S: Shading<N>,
    {
        if columns[0] == columns[1] {
            return;
        }
        let Self { grid, layer, clear, .. } = *self;
        let n = grid.samples;
        let samples = rows[0] * n..rows[1] * n;
        let band = grid.bands().of(&samples).start as usize;
        let Own { scanner, tile, transparency, waiting: all_sums, .. } = &mut *self.own;
        let mut one = Band { grid, layer, clear, band, scanner, tile, transparency };
        one.draw(columns, rows);
        let clear = one.draw_clear(KeepFragments::None);
        resolver.tally = resolver.tally.merge(clear);
        for sample in samples {
            let Some(lit) = resolver.light(tile, transparency, sample, columns.map(|column| column * n))
            else {
                continue;
            };
            for (pixel, sums) in (waiting..).zip(&mut *all_sums) {
                let idx = (sample + self.margin * n).checked_sub(pixel * n);
                if let Some(weight) = idx.and_then(|idx| self.weights.get(idx as usize))
                    && *weight != 0.0
                {
                    sums.add(((columns[0] - left) * n) as usize, *weight, lit);
                }
            }
        }
    }

    /// Makes pixels of the first row that waits, which is `row`.
    fn finish<P>(
        &mut self,
        finish: &impl Finish<(), P>,
        row: u32,
        columns: [u32; 2],
        left: u32,
        put: &mut impl FnMut([u32; 2], P),
    ) {
        let Some(sums) = self.own.waiting.pop_front() else { return };
        let n = self.grid.samples;
        // Added up from above, as they were with cover.
        let weight = self.inside(row, self.grid.height).1.iter().fold(0.0, |sum, weight| sum + weight);
        for column in columns[0]..columns[1] {
            let (first, weights) = self.inside(column, self.grid.width);
            let all = sums.pixel((first - left * n) as usize, weights, weight, (n * n) as f32);
            if all.covered != 0.0 {
                put([column, row], finish.pixel(&all));
            }
        }
        self.own.spare.push(sums);
    }

    /// Of the samples along a side that a pixel weighs, the first in the picture, and the weights of those in it.
    fn inside(&self, pixel: u32, n_pixels: u32) -> (u32, &[f32]) {
        let n = self.grid.samples;
        let [first, end] = self.around([pixel, pixel + 1], n_pixels).map(|pixel| pixel * n);
        let missing = self.margin.saturating_sub(pixel) * n;
        (first, &self.weights[missing as usize..(missing + end - first) as usize])
    }
}
