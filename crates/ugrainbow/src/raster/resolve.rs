//! Samples to pixels: shading, averaging in linear light, display encoding.

use ugimage::Quantizer;

use super::spans::Tile;

/// What a shader says of a sample.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shade {
    /// Linear light, red, green, blue, each 0…1.
    pub light: [f32; 3],
    /// Brightness before it was clipped to 1.
    pub intensity: f32,
    /// True if it is black because its wavelength cannot be seen.
    pub is_out_of_range: bool,
}

/// What stands behind everything.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Backdrop {
    /// Linear light.
    Light([f32; 3]),
    /// Nothing: pixels get an alpha.
    Clear,
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

/// Turns samples into pixels.
pub struct Resolver<'a, const N: usize, S> {
    shader: &'a S,
    quantizer: &'a Quantizer,
    backdrop: Backdrop,
    /// Samples along a side of a pixel.
    samples: u32,
    /// The sample shaded last: on a flat face the next is the same.
    last: ([f32; N], Shade),
    pub tally: Tally,
}

impl<'a, const N: usize, S: Fn(&[f32; N]) -> Shade> Resolver<'a, N, S> {
    pub fn new(shader: &'a S, quantizer: &'a Quantizer, backdrop: Backdrop, samples: u32) -> Self {
        // NaN differs from every sample, so that the first one is shaded.
        let last = ([f32::NAN; N], Shade::default());
        Self { shader, quantizer, backdrop, samples, last, tally: Tally::default() }
    }

    /// Paints the pixels of a row from column `first` on.
    pub fn paint(&mut self, tile: &Tile<N>, first: u32, row: u32, pixels: &mut [[u8; 4]]) {
        for (column, pixel) in (first..).zip(pixels) {
            *pixel = self.pixel(tile, column, row);
        }
    }

    fn pixel(&mut self, tile: &Tile<N>, column: u32, row: u32) -> [u8; 4] {
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
        self.encode(sum, n_covered)
    }

    #[inline]
    fn shade(&mut self, values: &[f32; N]) -> [f32; 3] {
        if self.last.0 != *values {
            self.last = (*values, (self.shader)(values));
        }
        self.tally.count(&self.last.1);
        self.last.1.light
    }

    /// The pixel whose covered samples add up to `sum`.
    fn encode(&self, sum: [f32; 3], n_covered: u32) -> [u8; 4] {
        let n_samples = (self.samples * self.samples) as f32;
        let n_covered = n_covered as f32;
        let (mean, alpha) = match self.backdrop {
            Backdrop::Light(behind) => {
                let n_free = n_samples - n_covered;
                (std::array::from_fn(|i| (sum[i] + behind[i] * n_free) / n_samples), 255)
            }
            Backdrop::Clear if n_covered == 0.0 => return [0; 4],
            Backdrop::Clear => {
                (sum.map(|light| light / n_covered), (255.0 * n_covered / n_samples).round() as u8)
            }
        };
        let [r, g, b] = mean.map(|light: f32| self.quantizer.level(light));
        [r, g, b, alpha]
    }
}
