//! Samples to pixels: shading, and adding up in linear light.

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
pub struct Gathered<T> {
    /// Sum of the light of the covered samples.
    pub sum: [f32; 3],
    /// How many are covered.
    pub n_covered: u32,
    /// What is seen at the sample nearest to the middle, of equals the last; never anything if tags are not kept.
    pub center: Option<Seen<T>>,
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

    fn count(&mut self, shade: &Shade) {
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
    /// Samples along a side of a pixel.
    samples: u32,
    /// The sample shaded last: on a flat face the next is the same.
    last: ([f32; N], Shade),
    pub tally: Tally,
}

impl<'a, const N: usize, S: Fn(&[f32; N]) -> Shade, F> Resolver<'a, N, S, F> {
    /// `finish` makes a pixel of its samples.
    pub fn new(shader: &'a S, finish: &'a F, samples: u32) -> Self {
        // NaN differs from every sample, so that the first one is shaded.
        let last = ([f32::NAN; N], Shade::default());
        Self { shader, finish, samples, last, tally: Tally::default() }
    }

    /// Paints the pixels of a row from column `first` on.
    pub fn paint<T: Tag, P: Copy>(&mut self, tile: &Tile<N, T>, first: u32, row: u32, pixels: &mut [P])
    where
        F: Fn(&Gathered<T>) -> P,
    {
        // Some pixels are gathered before the first is finished: what has just been stored
        // in parts is slow to load as a whole.
        let mut gathered = [Gathered { sum: [0.0; 3], n_covered: 0, center: None }; AT_ONCE];
        // All pixels without a sample are alike.
        let mut empty = None;
        for (first, pixels) in (first..).step_by(AT_ONCE).zip(pixels.chunks_mut(AT_ONCE)) {
            for (column, all) in (first..).zip(&mut gathered[..pixels.len()]) {
                *all = self.gather(tile, column, row);
            }
            for (pixel, all) in pixels.iter_mut().zip(&gathered) {
                *pixel = match empty {
                    Some(empty) if all.n_covered == 0 => empty,
                    _ => (self.finish)(all),
                };
                if all.n_covered == 0 {
                    empty = Some(*pixel);
                }
            }
        }
    }

    /// The samples of one pixel.
    #[inline]
    pub fn gather<T: Tag>(&mut self, tile: &Tile<N, T>, column: u32, row: u32) -> Gathered<T> {
        let n = self.samples;
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
        Gathered { sum, n_covered, center }
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
