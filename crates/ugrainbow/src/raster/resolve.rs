//! Samples to pixels: shading, and adding up in linear light.

use super::band::Grid;
use super::glass::{Fragment, Glass};
use super::spans::{Seen, Tag, Tile};

/// What a shader says of a sample.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shade {
    /// Linear light, red, green, blue.
    pub light: [f32; 3],
    /// Brightness before it was clipped to 1.
    pub intensity: f32,
    /// True if it is black because its wavelength cannot be seen.
    pub is_out_of_range: bool,
}

/// The samples of a pixel together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gathered<'a, T> {
    /// Sum of the light of the covered samples.
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
    const EMPTY: Self = Self { sum: [0.0; 3], covered: 0.0, center: None, layers: &[] };

    /// True if the pixel shows nothing.
    fn is_empty(&self) -> bool {
        self.covered == 0.0 && self.center.is_none() && self.layers.is_empty()
    }
}

/// What the samples of a picture were.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tally {
    /// Samples with a face or wire.
    pub covered: u64,
    /// Those that are not black.
    pub visible: u64,
    /// Those that are black because of their wavelength.
    pub out_of_range: u64,
    /// Greatest brightness before clipping.
    pub max_intensity: f32,
}

impl Tally {
    /// That of two parts of a picture together.
    pub fn merge(self, other: Self) -> Self {
        Self {
            covered: self.covered + other.covered,
            visible: self.visible + other.visible,
            out_of_range: self.out_of_range + other.out_of_range,
            max_intensity: self.max_intensity.max(other.max_intensity),
        }
    }

    pub fn count(&mut self, shade: &Shade) {
        self.covered += 1;
        self.visible += u64::from(shade.light != [0.0; 3]);
        self.out_of_range += u64::from(shade.is_out_of_range);
        self.max_intensity = self.max_intensity.max(shade.intensity);
    }
}

/// Pixels that are gathered before the first of them is finished.
const AT_ONCE: usize = 64;

/// Turns samples into pixels.
pub struct Resolver<'a, const N: usize, S, F> {
    shader: &'a S,
    finish: &'a F,
    grid: &'a Grid,
    /// The sample shaded last: on a flat face the next is the same.
    last: ([f32; N], Shade),
    pub tally: Tally,
}

impl<'a, const N: usize, S: Fn(&[f32; N]) -> Shade, F> Resolver<'a, N, S, F> {
    /// `finish` makes a pixel of its samples.
    pub fn new(shader: &'a S, finish: &'a F, grid: &'a Grid) -> Self {
        // NaN differs from every sample, so that the first one is shaded.
        let last = ([f32::NAN; N], Shade::default());
        Self { shader, finish, grid, last, tally: Tally::default() }
    }

    /// Paints the pixels of a row from column `first` on.
    pub fn paint<T: Tag, P: Copy>(
        &mut self,
        tile: &Tile<N, T>,
        glass: &Glass,
        first: u32,
        row: u32,
        pixels: &mut [P],
    ) where
        F: Fn(&Gathered<'_, T>) -> P,
    {
        // Some pixels are gathered before the first is finished: what has just been stored
        // in parts is slow to load as a whole.
        let mut gathered = [Gathered::EMPTY; AT_ONCE];
        // All pixels without a sample are alike.
        let mut empty = None;
        for (first, pixels) in (first..).step_by(AT_ONCE).zip(pixels.chunks_mut(AT_ONCE)) {
            for (column, all) in (first..).zip(&mut gathered[..pixels.len()]) {
                *all = self.gather(tile, glass, column, row);
            }
            for (pixel, all) in pixels.iter_mut().zip(&gathered) {
                let is_empty = all.is_empty();
                *pixel = match empty {
                    Some(empty) if is_empty => empty,
                    _ => (self.finish)(all),
                };
                if is_empty {
                    empty = Some(*pixel);
                }
            }
        }
    }

    /// The samples of one pixel.
    #[inline]
    pub fn gather<'g, T: Tag>(
        &mut self,
        tile: &Tile<N, T>,
        glass: &'g Glass,
        column: u32,
        row: u32,
    ) -> Gathered<'g, T> {
        if !glass.is_empty() || self.grid.cue.is_some() {
            return self.gather_through(tile, glass, column, row);
        }
        let n = self.grid.samples;
        let mut sum = [0.0; 3];
        let mut n_covered = 0;
        for sample_row in row * n..(row + 1) * n {
            for values in tile.row_part(sample_row, column * n, (column + 1) * n).flatten() {
                let light = self.shade(values);
                n_covered += 1;
                sum = std::array::from_fn(|i| sum[i] + light[i]);
            }
        }
        let center = if T::IS_KEPT { tile.seen(row * n + n / 2, column * n + n / 2) } else { None };
        Gathered { sum, covered: n_covered as f32, center, layers: &[] }
    }

    /// The same behind what is clear, and with depth cueing.
    #[inline(never)]
    fn gather_through<'g, T: Tag>(
        &mut self,
        tile: &Tile<N, T>,
        glass: &'g Glass,
        column: u32,
        row: u32,
    ) -> Gathered<'g, T> {
        let n = self.grid.samples;
        let (mut sum, mut covered) = ([0.0; 3], 0.0);
        for sample_row in row * n..(row + 1) * n {
            let values = tile.row_part(sample_row, column * n, (column + 1) * n);
            for (sample_column, values) in (column * n..).zip(values) {
                let veil = glass.veil(sample_row, sample_column);
                let (mut light, mut cover) = (veil.light, veil.cover);
                if let (Some(values), Some(seen)) = (values, tile.seen(sample_row, sample_column)) {
                    let part = veil.pass * self.grid.cue_at(seen.key);
                    let behind = self.shade(values);
                    light = std::array::from_fn(|i| light[i] + part * behind[i]);
                    cover += part;
                }
                sum = std::array::from_fn(|i| sum[i] + light[i]);
                covered += cover;
            }
        }
        let middle = [row, column].map(|pixel| pixel * n + n / 2);
        let center = if T::IS_KEPT { tile.seen(middle[0], middle[1]) } else { None };
        Gathered { sum, covered, center, layers: glass.fragments(middle[0], middle[1]) }
    }

    #[inline]
    fn shade(&mut self, values: &[f32; N]) -> [f32; 3] {
        if self.last.0 == *values {
            self.tally.count(&self.last.1);
            return self.last.1.light;
        }
        let shade = (self.shader)(values);
        self.tally.count(&shade);
        self.last = (*values, shade);
        shade.light
    }
}
