//! What gives samples their light, many at once.

use fearless_simd::{Level, Simd, dispatch};

/// Samples that are shaded at once, at most: what is known of them stays in the nearest cache.
pub const RUN: usize = 128;

/// What light is told in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Linear light.
    Linear,
    /// Display-encoded levels, 0…1.
    Display,
}

/// Turns N interpolated numbers into light.
pub trait Shading<const N: usize>: Sync {
    /// The light of some samples, [`RUN`] at most, of which each number stands in a slice of its own. What a sample's
    /// light is does not depend on what is shaded with it.
    fn shade(&self, values: [&[f32]; N], scale: Scale, shades: &mut Shades);
}

/// What a shader says of some samples. Where a slice ends, the rest has no meaning.
#[derive(Clone, Debug)]
pub struct Shades {
    /// Red, green, blue.
    pub light: [[f32; RUN]; 3],
    /// Brightness before it was clipped to 1.
    pub intensity: [f32; RUN],
    /// True if it is black because its wavelength cannot be seen.
    pub is_out_of_range: [bool; RUN],
}

impl Default for Shades {
    fn default() -> Self {
        Self { light: [[0.0; RUN]; 3], intensity: [0.0; RUN], is_out_of_range: [false; RUN] }
    }
}

impl Shades {
    /// What is said of one sample.
    #[inline]
    pub fn get(&self, sample: usize) -> Shade {
        Shade {
            light: self.light.each_ref().map(|channel| channel[sample]),
            intensity: self.intensity[sample],
            is_out_of_range: self.is_out_of_range[sample],
        }
    }

    /// Says something of one sample.
    #[inline]
    pub fn set(&mut self, sample: usize, shade: Shade) {
        for (channel, light) in self.light.iter_mut().zip(shade.light) {
            channel[sample] = light;
        }
        self.intensity[sample] = shade.intensity;
        self.is_out_of_range[sample] = shade.is_out_of_range;
    }
}

/// What a shader says of a sample.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shade {
    /// Red, green, blue.
    pub light: [f32; 3],
    /// Brightness before it was clipped to 1.
    pub intensity: f32,
    /// True if it is black because its wavelength cannot be seen.
    pub is_out_of_range: bool,
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

    /// Counts a sample.
    pub fn count(&mut self, shade: &Shade) {
        self.covered += 1;
        self.visible += u64::from(shade.light != [0.0; 3]);
        self.out_of_range += u64::from(shade.is_out_of_range);
        self.max_intensity = self.max_intensity.max(shade.intensity);
    }

    /// Counts those samples of a run that show something, which are those with a depth key.
    pub fn count_run(&mut self, keys: &[f32], shades: &Shades) {
        *self = self.merge(dispatch!(Level::new(), simd => Self::of_run(simd, keys, shades)));
    }

    #[inline(always)] // Compiled for what the processor can do to many numbers at once.
    fn of_run<S: Simd>(_: S, keys: &[f32], shades: &Shades) -> Self {
        let n = keys.len().min(RUN);
        let keys = &keys[..n];
        let [red, green, blue] = shades.light.each_ref().map(|channel| &channel[..n]);
        let (is_out, intensity) = (&shades.is_out_of_range[..n], &shades.intensity[..n]);
        let (mut covered, mut visible, mut out_of_range, mut most) = (0u32, 0u32, 0u32, 0i32);
        for i in 0..n {
            let is_on = keys[i] > f32::NEG_INFINITY;
            let is_lit = (red[i] != 0.0) | (green[i] != 0.0) | (blue[i] != 0.0);
            covered += u32::from(is_on);
            visible += u32::from(is_on & is_lit);
            out_of_range += u32::from(is_on & is_out[i]);
            // Numbers that are not negative are in the order of their bits, and the greatest of whole numbers
            // is found many at once.
            most = most.max(if is_on { intensity[i].to_bits() as i32 } else { 0 });
        }
        Self {
            covered: covered.into(),
            visible: visible.into(),
            out_of_range: out_of_range.into(),
            max_intensity: f32::from_bits(most.unsigned_abs()),
        }
    }
}
