//! Stars: black bodies too small to be resolved.

use glam::DVec3;
use ugphysics::spectrum::{DopplerGrid, DopplerTable, Spectrum};
use ugphysics::xyz_to_linear_srgb;

/// A star in the frame of a sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Star {
    /// Unit vector to it.
    pub direction: DVec3,
    /// Apparent visual magnitude for an observer at rest.
    pub magnitude: f64,
    /// Temperature of the black body of its colour, kelvins.
    pub kelvin: f64,
}

/// How stars are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StarOptions {
    /// Full width at half maximum of the disc of a star, pixels, 0.5 to 50.
    pub width: f64,
    /// Magnitude that is drawn as white: one such star per square degree has the mean light 1.
    pub white: f64,
}

impl Default for StarOptions {
    fn default() -> Self {
        Self { width: 1.7, white: -2.0 }
    }
}

impl StarOptions {
    /// Radius of the disc in standard deviations of its profile, a Gaussian.
    pub const REACH: f64 = 4.0;

    /// Largest standard deviation, radians: a disc is smaller than a quarter of the sphere.
    pub const MOST_DEVIATION: f64 = 0.3;

    /// Standard deviation of the profile in pixels.
    pub fn deviation(&self) -> f64 {
        // The width is 2 √(2 ln 2) standard deviations.
        self.width / 2.354_820_045_030_949_3
    }

    /// Light per irradiance and steradian.
    pub fn scale(&self) -> f64 {
        const SQUARE_DEGREE: f64 =
            (core::f64::consts::PI / 180.0) * (core::f64::consts::PI / 180.0);
        libm::exp10(0.4 * self.white) * SQUARE_DEGREE
    }

    /// The magnitude of a star whose irradiance is that of white light from this solid angle,
    /// steradians.
    pub fn magnitude(&self, white: f64) -> f64 {
        -2.5 * libm::log10(white / self.scale())
    }

    /// The profile of a star at the square of a distance on the unit sphere.
    #[inline]
    pub fn profile(square: f64, deviation: f64) -> f64 {
        let ratio = square / (deviation * deviation);
        if ratio < Self::REACH * Self::REACH { libm::exp(-0.5 * ratio) } else { 0.0 }
    }
}

/// The temperature to which the table is relative, kelvins.
const REFERENCE: f64 = 5800.0;

/// |ln D| up to which starlight is tabulated. Beyond it the nearest entry is used.
const MOST_LN_DOPPLER: f64 = 30.0;

/// Irradiance by stars as a moving observer measures it.
///
/// A star of temperature T is seen as a black body of D T, so its radiance per wavelength is D⁵
/// L(λD). Its disc is D² times smaller in solid angle, so its irradiance per wavelength grows by
/// D³, and over all wavelengths by D². Eq. (P6), (P12), (P13)
///
/// ```
/// use glam::DVec3;
/// use ugsky::{Star, StarLight};
///
/// let sun = Star { direction: DVec3::Y, magnitude: 0.0, kelvin: 5800.0 };
/// let light = StarLight::new(&[sun], [true, true], 0.5);
/// // At rest a star of magnitude 0 has luminance 1.
/// let luminance = ugphysics::luminance(light.irradiance(&sun, 1.0));
/// assert!((luminance - 1.0).abs() < 1e-4);
/// ```
pub struct StarLight {
    grid: DopplerGrid,
    table: DopplerTable,
    doppler: bool,
    flux: bool,
}

impl StarLight {
    /// A table for stars and Doppler factors up to e^±`reach`. `shift`: whether wavelengths are
    /// shifted, and whether the radiance at each wavelength is multiplied by D⁵. Directions, and
    /// so solid angles, always change.
    pub fn new(stars: &[Star], shift: [bool; 2], reach: f64) -> Self {
        let reach = reach.abs().min(MOST_LN_DOPPLER);
        let [mut low, mut high] = [0.0_f64; 2];
        for star in stars {
            let ln = ln_relative(star.kelvin);
            (low, high) = (low.min(ln), high.max(ln));
        }
        let grid = DopplerGrid::new(low - reach..=high + reach);
        Self { table: grid.table(), grid, doppler: shift[0], flux: shift[1] }
    }

    /// Linear red, green and blue of the irradiance by a star that is seen with a Doppler factor,
    /// above 0. The luminance of a star of magnitude 0 at rest is 1.
    pub fn irradiance(&self, star: &Star, doppler: f64) -> [f64; 3] {
        let rest = ln_relative(star.kelvin);
        let seen = if self.doppler { rest + libm::log(doppler) } else { rest };
        let reference = Spectrum::blackbody(REFERENCE, 1.0);
        let xyz = |ln: f64| self.table.xyz(ln, |idx| self.grid.ln_xyz(&reference, idx));
        let [_, luminance, _] = xyz(rest);
        let gain = if self.flux { doppler * doppler * doppler } else { 1.0 / (doppler * doppler) };
        let scale = gain * libm::exp10(-0.4 * star.magnitude) / luminance;
        xyz_to_linear_srgb(xyz(seen).map(|part| part * scale))
    }
}

fn ln_relative(kelvin: f64) -> f64 {
    libm::log(kelvin / REFERENCE)
}
