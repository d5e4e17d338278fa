//! Samples to pixels: shading, and adding up in linear light.

use crate::band::Grid;
use crate::shading::{RUN, Scale, Shades, Shading, Tally};
use crate::spans::{EMPTY, Seen, Tag, Tile};
use crate::transparency::{Fragment, TransparencyBuffer};

/// The samples of a pixel together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gathered<'a, T> {
    /// Sum of the linear light of the covered samples.
    pub sum: [f32; 3],
    /// How many are covered; those that something clear covers count in part.
    pub covered: f32,
    /// The nearest that hides at the sample nearest to the middle, of equals the last; never anything if tags are not
    /// kept.
    pub center: Option<Seen<T>>,
    /// What is clear in front of it, from behind.
    pub layers: &'a [Fragment],
}

impl<T: Copy> Gathered<'_, T> {
    /// Of a pixel that shows nothing.
    pub const EMPTY: Self = Self { sum: [0.0; 3], covered: 0.0, center: None, layers: &[] };

    /// True if the pixel shows nothing.
    fn is_empty(&self) -> bool {
        self.covered == 0.0 && self.center.is_none() && self.layers.is_empty()
    }
}

/// Makes pixels of samples.
pub trait Finish<T, P>: Sync {
    /// A pixel of its samples; also asked once what a pixel is that shows nothing.
    fn pixel(&self, all: &Gathered<'_, T>) -> P;

    /// What makes pixels of single samples without asking for their linear light, if anything can.
    fn direct(&self) -> Option<&dyn Direct<P>> {
        None
    }
}

impl<T, P, F: Fn(&Gathered<'_, T>) -> P + Sync> Finish<T, P> for F {
    fn pixel(&self, all: &Gathered<'_, T>) -> P {
        self(all)
    }
}

/// Makes pixels of samples that are pixels by themselves.
pub trait Direct<P> {
    /// Pixels that show something. `keys`: depth keys, −∞ where nothing is shown, and pixels stay as they are. `levels`:
    /// display-encoded red, green and blue.
    fn pixels(&self, keys: &[f32], levels: &[[f32; RUN]; 3], pixels: &mut [P]);
}

/// Turns samples into pixels.
pub struct Resolver<'a, S, F> {
    shader: &'a S,
    pub finish: &'a F,
    grid: &'a Grid,
    shades: Shades,
    /// Linear light, and cover, of a row of samples.
    lit: [Vec<f32>; 4],
    /// Their sums over the rows of a pixel, for each column of samples.
    columns: [Vec<f32>; 4],
    /// Their sums for each pixel of a row.
    sums: Vec<[f32; 4]>,
    pub tally: Tally,
}

impl<'a, S, F> Resolver<'a, S, F> {
    /// `finish` makes a pixel of its samples.
    pub fn new(shader: &'a S, finish: &'a F, grid: &'a Grid) -> Self {
        Self {
            shader,
            finish,
            grid,
            shades: Shades::default(),
            lit: Default::default(),
            columns: Default::default(),
            sums: Vec::new(),
            tally: Tally::default(),
        }
    }

    /// Paints the pixels of a row from column `first` on that show something; the others stay as they are.
    pub fn paint<const N: usize, T: Tag, P: Copy>(
        &mut self,
        tile: &Tile<N, T>,
        transparency: &TransparencyBuffer,
        first: u32,
        row: u32,
        pixels: &mut [P],
    ) where
        S: Shading<N>,
        F: Finish<T, P>,
    {
        if let Some(direct) = self.finish.direct().filter(|_| self.is_direct(transparency)) {
            return self.paint_direct(tile, direct, first, row, pixels);
        }
        self.add_up(tile, transparency, first, row, pixels.len() as u32);
        for ((column, sums), pixel) in (first..).zip(&self.sums).zip(pixels) {
            let all = gathered(self.grid, tile, transparency, [column, row], sums);
            if !all.is_empty() {
                *pixel = self.finish.pixel(&all);
            }
        }
    }

    /// True if a pixel is what its only sample shows.
    fn is_direct(&self, transparency: &TransparencyBuffer) -> bool {
        self.grid.samples == 1 && self.grid.cue.is_none() && transparency.is_empty()
    }

    fn paint_direct<const N: usize, T: Tag, P>(
        &mut self,
        tile: &Tile<N, T>,
        direct: &dyn Direct<P>,
        first: u32,
        row: u32,
        pixels: &mut [P],
    ) where
        S: Shading<N>,
    {
        let (keys, values) = tile.row_part(row, first, first + pixels.len() as u32);
        for (run, pixels) in pixels.chunks_mut(RUN).enumerate() {
            let run = run * RUN..run * RUN + pixels.len();
            let keys = &keys[run.clone()];
            if is_empty(keys) {
                continue;
            }
            self.shader.shade(values.map(|all| &all[run.clone()]), Scale::Display, &mut self.shades);
            self.tally.count_run(keys, &self.shades);
            direct.pixels(keys, &self.shades.light, pixels);
        }
    }

    /// The samples of one pixel, of which tags are kept.
    pub fn gather<'g, const N: usize, T: Tag>(
        &mut self,
        tile: &Tile<N, T>,
        transparency: &'g TransparencyBuffer,
        [column, row]: [u32; 2],
    ) -> Gathered<'g, T>
    where
        S: Shading<N>,
    {
        self.add_up(tile, transparency, column, row, 1);
        gathered(self.grid, tile, transparency, [column, row], &self.sums[0])
    }

    /// Adds up the samples of `n_pixels` pixels of a row: down each column of samples, then from the left.
    fn add_up<const N: usize, T: Tag>(
        &mut self,
        tile: &Tile<N, T>,
        transparency: &TransparencyBuffer,
        first: u32,
        row: u32,
        n_pixels: u32,
    ) where
        S: Shading<N>,
    {
        let n = self.grid.samples;
        for all in &mut self.columns {
            all.clear();
            all.resize((n_pixels * n) as usize, 0.0);
        }
        for sample_row in row * n..(row + 1) * n {
            self.light(tile, transparency, sample_row, [first * n, (first + n_pixels) * n]);
            for (sums, lit) in self.columns.iter_mut().zip(&self.lit) {
                sums.iter_mut().zip(lit).for_each(|(sum, lit)| *sum += lit);
            }
        }
        self.sums.clear();
        let [red, green, blue, cover] = self.columns.each_ref().map(|all| all.chunks_exact(n as usize));
        let sum = |parts: &[f32]| parts.iter().fold(0.0, |sum, part| sum + part);
        self.sums.extend(
            red.zip(green)
                .zip(blue)
                .zip(cover)
                .map(|(((red, green), blue), cover)| [sum(red), sum(green), sum(blue), sum(cover)]),
        );
    }

    /// The linear light, and cover, of the samples from column `first` to `end` of a row; `None` if they show nothing.
    pub fn light<const N: usize, T: Tag>(
        &mut self,
        tile: &Tile<N, T>,
        transparency: &TransparencyBuffer,
        row: u32,
        [first, end]: [u32; 2],
    ) -> Option<&[Vec<f32>; 4]>
    where
        S: Shading<N>,
    {
        let mut is_lit = self.light_row(tile, row, [first, end]);
        if !transparency.is_empty() || self.grid.cue.is_some() {
            self.look_through(tile, transparency, row, first);
            is_lit = true;
        }
        is_lit.then_some(&self.lit)
    }

    /// Puts the light of a row of samples into `lit`: nothing where nothing is drawn. False if that is everywhere.
    fn light_row<const N: usize, T: Tag>(
        &mut self,
        tile: &Tile<N, T>,
        row: u32,
        [first, end]: [u32; 2],
    ) -> bool
    where
        S: Shading<N>,
    {
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
            self.shader.shade(values.map(|all| &all[run.clone()]), Scale::Linear, &mut self.shades);
            self.tally.count_run(keys, &self.shades);
            let [lit @ .., covers] = self.lit.each_mut().map(|all| &mut all[run.clone()]);
            for (lit, light) in lit.into_iter().zip(&self.shades.light) {
                for ((lit, light), key) in lit.iter_mut().zip(light).zip(keys) {
                    *lit = if *key > EMPTY { *light } else { 0.0 };
                }
            }
            for (cover, key) in covers.iter_mut().zip(keys) {
                *cover = f32::from(u8::from(*key > EMPTY));
            }
        }
        is_lit
    }

    /// Puts the row of samples that is in `lit` behind what is clear, and fades what is far.
    #[inline(never)]
    fn look_through<const N: usize, T: Tag>(
        &mut self,
        tile: &Tile<N, T>,
        transparency: &TransparencyBuffer,
        row: u32,
        first: u32,
    ) {
        let (keys, _) = tile.row_part(row, first, first + self.lit[0].len() as u32);
        for (idx, &key) in keys.iter().enumerate() {
            let composite = transparency.composite(row, first + idx as u32);
            let part = if key > EMPTY { composite.pass * self.grid.cue_at(key) } else { 0.0 };
            let [light @ .., cover] = &mut self.lit;
            for (light, composite) in light.iter_mut().zip(composite.light) {
                light[idx] = composite + part * light[idx];
            }
            cover[idx] = composite.cover + part;
        }
    }
}

/// True if nothing is drawn on samples. All are looked at, which is faster than to look for one.
fn is_empty(keys: &[f32]) -> bool {
    keys.iter().fold(true, |all, key| all & (*key == EMPTY))
}

/// What the samples of a pixel add up to, and what is in its middle.
#[inline]
fn gathered<'g, const N: usize, T: Tag>(
    grid: &Grid,
    tile: &Tile<N, T>,
    transparency: &'g TransparencyBuffer,
    [column, row]: [u32; 2],
    &[red, green, blue, covered]: &[f32; 4],
) -> Gathered<'g, T> {
    let [column, row] = [column, row].map(|pixel| pixel * grid.samples + grid.samples / 2);
    Gathered {
        sum: [red, green, blue],
        covered,
        center: if T::IS_KEPT { tile.seen(row, column) } else { None },
        layers: if transparency.is_empty() { &[] } else { transparency.fragments(row, column) },
    }
}
