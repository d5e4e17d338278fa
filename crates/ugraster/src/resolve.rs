//! Samples to pixels: shading, and sums in linear light.

use fearless_simd::{Level, Simd, dispatch};

use crate::grid::SampleGrid;
use crate::shading::{Encoding, RUN, SampleShading, SampleStats, ShadedRun};
use crate::tile::{EMPTY, Tile, VisibleItem};
use crate::transparency::{Fragment, TileBuffers};

/// The samples of a pixel together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelSamples<'a> {
    /// Sum of the linear light of the covered samples.
    pub sum: [f32; 3],
    /// Number of covered samples; samples with only transparent fragments count in part.
    pub covered: f32,
    /// The item visible at the centre, if it is requested.
    pub center: Center<'a>,
}

/// The item visible at the sample nearest to the centre of a pixel; ties go to the lower-right
/// sample.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Center<'a> {
    /// The nearest opaque surface.
    pub opaque: Option<VisibleItem>,
    /// Transparent fragments in front of it, from back to front.
    pub fragments: &'a [Fragment],
}

impl Center<'_> {
    /// True if nothing is visible.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.opaque.is_none() && self.fragments.is_empty()
    }
}

impl PixelSamples<'_> {
    /// A pixel that shows nothing.
    pub const EMPTY: Self =
        Self { sum: [0.0; 3], covered: 0.0, center: Center { opaque: None, fragments: &[] } };

    /// True if the pixel shows nothing.
    fn is_empty(&self) -> bool {
        self.covered == 0.0 && self.center.is_empty()
    }
}

/// Makes pixels of samples.
pub trait Resolve<P>: Sync {
    /// A pixel of its samples. Called once with [`PixelSamples::EMPTY`] for all pixels that show
    /// nothing.
    fn pixel(&self, samples: &PixelSamples<'_>) -> P;

    /// A faster way for pixels of one sample, if there is one.
    fn single(&self) -> Option<&dyn ResolveSingle<P>> {
        None
    }
}

impl<P, F: Fn(&PixelSamples<'_>) -> P + Sync> Resolve<P> for F {
    fn pixel(&self, samples: &PixelSamples<'_>) -> P {
        self(samples)
    }
}

/// Makes pixels of one opaque sample each.
pub trait ResolveSingle<P> {
    /// The encoding of the light that it reads.
    fn encoding(&self) -> Encoding;

    /// Sets the pixels of a run. `keys`: depth keys, −∞ where nothing is visible; those pixels must
    /// stay as they are. `light`: red, green and blue.
    fn pixels(&self, keys: &[f32], light: &[[f32; RUN]; 3], pixels: &mut [P]);
}

/// A row of samples or pixels as planes: red, green, blue, coverage.
pub type Planes = [Vec<f32>; 4];

/// Shades samples and adds them up, with buffers that are reused.
pub struct Resolver<'a, const N: usize> {
    grid: &'a SampleGrid,
    shading: &'a dyn SampleShading<N>,
    run: ShadedRun,
    /// A row of samples.
    lit: Planes,
    /// Their sums over the rows of a pixel.
    columns: Planes,
    /// Their sums for each pixel of a row.
    sums: Vec<[f32; 4]>,
    pub stats: SampleStats,
}

impl<'a, const N: usize> Resolver<'a, N> {
    /// With empty buffers.
    pub fn new(grid: &'a SampleGrid, shading: &'a dyn SampleShading<N>) -> Self {
        Self {
            grid,
            shading,
            run: ShadedRun::default(),
            lit: Default::default(),
            columns: Default::default(),
            sums: Vec::new(),
            stats: SampleStats::default(),
        }
    }

    /// Sets the pixels of a row from column `first` on that show something; others stay as they
    /// are.
    pub fn paint<P>(
        &mut self,
        resolve: &impl Resolve<P>,
        buffers: &TileBuffers<N>,
        [first, row]: [u32; 2],
        pixels: &mut [P],
    ) {
        if let Some(single) = resolve.single().filter(|_| self.is_single(buffers)) {
            return self.paint_single(&buffers.tile, single, [first, row], pixels);
        }
        self.add_up(buffers, [first, row], pixels.len() as u32);
        for ((column, sums), pixel) in (first..).zip(&self.sums).zip(pixels) {
            let samples = pixel_samples(self.grid, buffers, [column, row], sums);
            if !samples.is_empty() {
                *pixel = resolve.pixel(&samples);
            }
        }
    }

    /// True if each pixel is one opaque sample, without depth cueing.
    fn is_single(&self, buffers: &TileBuffers<N>) -> bool {
        self.grid.samples == 1 && self.grid.fade.is_none() && buffers.transparency.is_empty()
    }

    fn paint_single<P>(
        &mut self,
        tile: &Tile<N>,
        single: &dyn ResolveSingle<P>,
        [first, row]: [u32; 2],
        pixels: &mut [P],
    ) {
        let (keys, values) = tile.row_part(row, first, first + pixels.len() as u32);
        for (run, pixels) in pixels.chunks_mut(RUN).enumerate() {
            let run = run * RUN..run * RUN + pixels.len();
            let keys = &keys[run.clone()];
            if is_empty(keys) {
                continue;
            }
            let values = values.map(|all| &all[run.clone()]);
            self.shading.shade(values, single.encoding(), &mut self.run);
            self.stats.count_run(keys, &self.run);
            single.pixels(keys, &self.run.light, pixels);
        }
    }

    /// The samples of one pixel.
    pub fn pixel_samples<'t>(
        &mut self,
        buffers: &'t TileBuffers<N>,
        pixel: [u32; 2],
    ) -> PixelSamples<'t> {
        self.add_up(buffers, pixel, 1);
        pixel_samples(self.grid, buffers, pixel, &self.sums[0])
    }

    /// Adds up the samples of `n_pixels` pixels of a row: down each column of samples, then from
    /// the left. As many pixels at once as fit in a run, so that their sums stay in the level 1
    /// cache.
    fn add_up(&mut self, buffers: &TileBuffers<N>, [first, row]: [u32; 2], n_pixels: u32) {
        let n = self.grid.samples;
        let end = first + n_pixels;
        let together = (RUN as u32 / n).max(1);
        self.sums.clear();
        for first in (first..end).step_by(together as usize) {
            let end = (first + together).min(end);
            self.add_up_run(buffers, row, [first, end]);
        }
    }

    /// Adds up the samples of the pixels from column `first` to `end`.
    fn add_up_run(&mut self, buffers: &TileBuffers<N>, row: u32, [first, end]: [u32; 2]) {
        let n = self.grid.samples;
        let mut is_lit = false;
        for sample_row in row * n..(row + 1) * n {
            if self.light(buffers, sample_row, [first * n, end * n]).is_none() {
                continue;
            }
            if !is_lit {
                is_lit = true;
                for all in &mut self.columns {
                    all.clear();
                    all.resize(((end - first) * n) as usize, 0.0);
                }
            }
            dispatch!(Level::new(), simd => add_columns(simd, &mut self.columns, &self.lit));
        }
        if is_lit {
            dispatch!(Level::new(), simd => add_rows(simd, &self.columns, n as usize, &mut self.sums));
        } else {
            self.sums.resize(self.sums.len() + (end - first) as usize, [0.0; 4]);
        }
    }

    /// Linear light and coverage of the samples from column `first` to `end` of a row; `None` if
    /// nothing is visible there.
    pub fn light(
        &mut self,
        buffers: &TileBuffers<N>,
        row: u32,
        [first, end]: [u32; 2],
    ) -> Option<&Planes> {
        let mut is_lit = self.light_opaque(&buffers.tile, row, [first, end]);
        if !buffers.transparency.is_empty() || self.grid.fade.is_some() {
            self.composite(buffers, row, first);
            is_lit = true;
        }
        is_lit.then_some(&self.lit)
    }

    /// Computes the light of the opaque surfaces on a row of samples; zero where there are none.
    /// Returns false if there are none at all.
    fn light_opaque(&mut self, tile: &Tile<N>, row: u32, [first, end]: [u32; 2]) -> bool {
        let (keys, values) = tile.row_part(row, first, end);
        let mut is_lit = false;
        self.lit.iter_mut().for_each(|all| all.resize(keys.len(), 0.0));
        for (run, keys) in keys.chunks(RUN).enumerate() {
            let run = run * RUN..run * RUN + keys.len();
            if is_empty(keys) {
                self.lit.iter_mut().for_each(|all| all[run.clone()].fill(0.0));
                continue;
            }
            is_lit = true;
            let values = values.map(|all| &all[run.clone()]);
            self.shading.shade(values, Encoding::Linear, &mut self.run);
            self.stats.count_run(keys, &self.run);
            let lit = self.lit.each_mut().map(|all| &mut all[run.clone()]);
            dispatch!(Level::new(), simd => store_covered(simd, keys, &self.run, lit));
        }
        is_lit
    }

    /// Blends fragments in front of the row of samples in `lit`, and applies depth cueing.
    #[inline(never)]
    fn composite(&mut self, buffers: &TileBuffers<N>, row: u32, first: u32) {
        let (keys, _) = buffers.tile.row_part(row, first, first + self.lit[0].len() as u32);
        for (idx, &key) in keys.iter().enumerate() {
            let composite = buffers.transparency.composite(row, first + idx as u32);
            let part =
                if key > EMPTY { composite.transmittance * self.grid.light_left(key) } else { 0.0 };
            let [light @ .., coverage] = &mut self.lit;
            for (light, composite) in light.iter_mut().zip(composite.light) {
                light[idx] = composite + part * light[idx];
            }
            coverage[idx] = composite.coverage + part;
        }
    }
}

/// Adds a row of samples to the sums of their columns.
#[inline(always)] // Compiled for several instruction sets.
fn add_columns<S: Simd>(_: S, columns: &mut Planes, lit: &Planes) {
    for (sums, lit) in columns.iter_mut().zip(lit) {
        for (sum, lit) in sums.iter_mut().zip(lit) {
            *sum += lit;
        }
    }
}

/// Adds up the sums of `n` columns each, from the left.
#[inline(always)] // Compiled for several instruction sets.
fn add_rows<S: Simd>(_: S, columns: &Planes, n: usize, sums: &mut Vec<[f32; 4]>) {
    // For the usual numbers the compiler unrolls the inner loop, because they are constants here.
    match n {
        2 => add_groups(columns, 2, sums),
        4 => add_groups(columns, 4, sums),
        _ => add_groups(columns, n, sums),
    }
}

#[inline(always)]
fn add_groups(columns: &Planes, n: usize, sums: &mut Vec<[f32; 4]>) {
    let first = sums.len();
    sums.resize(first + columns[0].len() / n, [0.0; 4]);
    for (channel, all) in columns.iter().enumerate() {
        for (sums, parts) in sums[first..].iter_mut().zip(all.chunks_exact(n)) {
            for part in parts {
                sums[channel] += part;
            }
        }
    }
}

/// Stores linear light and coverage of a run of samples; zero where nothing is drawn.
#[inline(always)] // Compiled for several instruction sets.
fn store_covered<S: Simd>(_: S, keys: &[f32], run: &ShadedRun, lit: [&mut [f32]; 4]) {
    let n = keys.len().min(RUN);
    let keys = &keys[..n];
    let [lit @ .., coverage] = lit;
    for (lit, light) in lit.into_iter().zip(&run.light) {
        let (lit, light) = (&mut lit[..n], &light[..n]);
        for i in 0..n {
            lit[i] = if keys[i] > EMPTY { light[i] } else { 0.0 };
        }
    }
    let coverage = &mut coverage[..n];
    for i in 0..n {
        coverage[i] = if keys[i] > EMPTY { 1.0 } else { 0.0 };
    }
}

/// True if nothing is drawn on samples. Without an early exit, which would prevent vectorization.
#[inline]
fn is_empty(keys: &[f32]) -> bool {
    keys.iter().fold(true, |all, key| all & (*key == EMPTY))
}

/// The sums of a pixel, and what is visible at its centre.
#[inline]
fn pixel_samples<'t, const N: usize>(
    grid: &SampleGrid,
    buffers: &'t TileBuffers<N>,
    pixel: [u32; 2],
    &[red, green, blue, covered]: &[f32; 4],
) -> PixelSamples<'t> {
    PixelSamples { sum: [red, green, blue], covered, center: center(grid, buffers, pixel) }
}

/// The item visible at the centre of a pixel, if items are kept.
#[inline]
pub fn center<'t, const N: usize>(
    grid: &SampleGrid,
    buffers: &'t TileBuffers<N>,
    pixel: [u32; 2],
) -> Center<'t> {
    let [column, row] = grid.center(pixel);
    let TileBuffers { tile, transparency, .. } = buffers;
    Center { opaque: tile.hit(row, column), fragments: transparency.fragments(row, column) }
}
