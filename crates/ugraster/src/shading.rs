//! The light of samples, computed for many at once.

use fearless_simd::{Level, Simd, dispatch};

/// Most samples that are shaded at once: few enough for all their values to stay in the level 1
/// cache.
pub const RUN: usize = 128;

/// How light is encoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// Linear light.
    Linear,
    /// Display-encoded levels, 0…1.
    Display,
}

/// Computes light from N interpolated values.
pub trait SampleShading<const N: usize>: Sync {
    /// The light of a run of samples, at most [`RUN`]. Each value has a slice of its own, with one
    /// element per sample. The light of a sample must not depend on the others in the run.
    fn shade(&self, values: [&[f32]; N], encoding: Encoding, run: &mut ShadedRun);
}

/// The light of a run of samples. Elements past its end are meaningless.
#[derive(Clone, Debug)]
pub struct ShadedRun {
    /// Red, green, blue.
    pub light: [[f32; RUN]; 3],
    /// Brightness before it was clipped to 1.
    pub intensity: [f32; RUN],
    /// True for samples that are black because their wavelength is invisible.
    pub is_out_of_range: [bool; RUN],
}

impl Default for ShadedRun {
    fn default() -> Self {
        Self { light: [[0.0; RUN]; 3], intensity: [0.0; RUN], is_out_of_range: [false; RUN] }
    }
}

impl ShadedRun {
    /// The light of one sample.
    #[inline]
    pub fn get(&self, sample: usize) -> ShadedSample {
        ShadedSample {
            light: self.light.each_ref().map(|channel| channel[sample]),
            intensity: self.intensity[sample],
            is_out_of_range: self.is_out_of_range[sample],
        }
    }

    /// Sets the light of one sample.
    #[inline]
    pub fn set(&mut self, sample: usize, shaded: ShadedSample) {
        for (channel, light) in self.light.iter_mut().zip(shaded.light) {
            channel[sample] = light;
        }
        self.intensity[sample] = shaded.intensity;
        self.is_out_of_range[sample] = shaded.is_out_of_range;
    }
}

/// The light of a sample.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ShadedSample {
    /// Red, green, blue.
    pub light: [f32; 3],
    /// Brightness before it was clipped to 1.
    pub intensity: f32,
    /// True if it is black because its wavelength is invisible.
    pub is_out_of_range: bool,
}

/// Statistics of the samples of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SampleStats {
    /// Samples that show a surface or line.
    pub covered: u64,
    /// Covered samples that are not black.
    pub visible: u64,
    /// Covered samples that are black because their wavelength is invisible.
    pub out_of_range: u64,
    /// Greatest brightness before clipping.
    pub max_intensity: f32,
}

impl SampleStats {
    /// The statistics of two parts of a picture together.
    pub fn merge(self, other: Self) -> Self {
        Self {
            covered: self.covered + other.covered,
            visible: self.visible + other.visible,
            out_of_range: self.out_of_range + other.out_of_range,
            max_intensity: self.max_intensity.max(other.max_intensity),
        }
    }

    /// Counts a sample.
    pub fn count(&mut self, shaded: &ShadedSample) {
        self.covered += 1;
        self.visible += u64::from(shaded.light != [0.0; 3]);
        self.out_of_range += u64::from(shaded.is_out_of_range);
        self.max_intensity = self.max_intensity.max(shaded.intensity);
    }

    /// Counts the covered samples of a run, which are those with a depth key above −∞.
    pub fn count_run(&mut self, keys: &[f32], run: &ShadedRun) {
        *self = self.merge(dispatch!(Level::new(), simd => Self::of_run(simd, keys, run)));
    }

    #[inline(always)] // Compiled for several instruction sets.
    fn of_run<S: Simd>(_: S, keys: &[f32], run: &ShadedRun) -> Self {
        let n = keys.len().min(RUN);
        let keys = &keys[..n];
        let [red, green, blue] = run.light.each_ref().map(|channel| &channel[..n]);
        let (is_out, intensity) = (&run.is_out_of_range[..n], &run.intensity[..n]);
        let (mut covered, mut visible, mut out_of_range, mut most) = (0u32, 0u32, 0u32, 0i32);
        for i in 0..n {
            let is_on = keys[i] > f32::NEG_INFINITY;
            let is_lit = (red[i] != 0.0) | (green[i] != 0.0) | (blue[i] != 0.0);
            covered += u32::from(is_on);
            visible += u32::from(is_on & is_lit);
            out_of_range += u32::from(is_on & is_out[i]);
            // Non-negative floats are ordered as their bits are, and a maximum of integers is
            // vectorized.
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
