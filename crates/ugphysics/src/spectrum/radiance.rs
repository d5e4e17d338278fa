//! Spectra, and X, Y, Z of them as seen in motion.

use std::cell::LazyCell;
use std::sync::Arc;

use crate::{linear_srgb_to_xyz, luminance, xyz_to_linear_srgb};

use crate::spectrum::infrared::InfraredRule;
use crate::spectrum::reflectance::Reflectance;
use crate::spectrum::weighted_daylight::WeightedDaylight;
use crate::spectrum::{blackbody, samples};

/// |ln D| is clamped to this value: beyond it nothing visible is left.
pub(crate) const MAX_LN_DOPPLER: f64 = 100.0;

/// Spectral radiance L'(λ) over all wavelengths, in the rest frame of its source.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum(pub(crate) Kind);

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Kind {
    /// Daylight reflected by a surface.
    Reflected(Reflectance),
    /// Planck's law with a given Y at rest.
    Blackbody { kelvin: f64, luminance: f64 },
    /// Samples (nm, radiance).
    Samples(Arc<[[f64; 2]]>),
    /// Daylight reflected by a surface, samples (nm, reflectance).
    Measured(Arc<[[f64; 2]]>),
}

impl Spectrum {
    /// A surface with the given linear sRGB colour under daylight. Negative channels, and colours
    /// that no smooth surface has, are handled as in [`Spectrum::from_xyz`].  Eq. (P20)
    pub fn from_linear_srgb(rgb: [f64; 3]) -> Self {
        Self::from_xyz(linear_srgb_to_xyz(rgb)).0
    }

    /// A surface with the given X, Y, Z under daylight, and whether it has exactly this colour at
    /// rest. Colours more saturated than any smooth surface are mixed with the grey of the same Y,
    /// to the boundary of the sRGB gamut; a negative Y becomes black.  Eq. (P20)
    pub fn from_xyz(xyz: [f64; 3]) -> (Self, bool) {
        Self::with_infrared(xyz, InfraredRule::default())
    }

    /// [`Spectrum::from_xyz`] by a rule for infrared.
    pub fn with_infrared(xyz: [f64; 3], rule: InfraredRule) -> (Self, bool) {
        let rgb = remove_rounding(xyz_to_linear_srgb(xyz));
        let exact = Reflectance::with_infrared(rgb, rule);
        let is_exact = exact.is_some();
        let surface = exact.or_else(|| Reflectance::with_infrared(in_gamut(rgb), rule));
        let black = Reflectance::default();
        (Self(Kind::Reflected(surface.unwrap_or(black))), is_exact)
    }

    /// The same, soon found for many wavelengths and Doppler factors; takes 3 kB more.
    #[must_use]
    pub fn tabulated(self) -> Self {
        match self.0 {
            Kind::Reflected(surface) => Self(Kind::Reflected(surface.tabulated())),
            other => Self(other),
        }
    }

    /// A black body of temperature `kelvin`, above 0, whose Y at rest is `scale`.  Eq. (P13)
    pub fn blackbody(kelvin: f64, scale: f64) -> Self {
        Self(Kind::Blackbody { kelvin, luminance: scale })
    }

    /// Spectral radiance from samples (nm, value) at increasing wavelengths, interpolated linearly
    /// between them and 0 outside.
    pub fn samples(samples: &[[f64; 2]]) -> Self {
        Self(Kind::Samples(samples.into()))
    }

    /// A surface under daylight by samples of its reflectance (nm, value) at increasing
    /// wavelengths, interpolated linearly between them; outside, the value of the nearer end.
    ///
    /// ```
    /// use ugphysics::spectrum::Spectrum;
    ///
    /// let half = Spectrum::reflectance(&[[500.0, 0.5]]);
    /// let grey = Spectrum::from_linear_srgb([0.5; 3]);
    /// assert!(half.seen(2.0).iter().zip(grey.seen(2.0)).all(|(a, b)| (a - b).abs() < 1e-9));
    /// ```
    pub fn reflectance(samples: &[[f64; 2]]) -> Self {
        Self(Kind::Measured(samples.into()))
    }

    /// X, Y, Z as seen with Doppler factor D, above 0: of L(λ) = D⁵ L'(λD).  Eq. (P12), (P19)
    ///
    /// ```
    /// use ugphysics::spectrum::Spectrum;
    ///
    /// // White at rest has Y = 1; approaching, it is bluer and brighter.
    /// let white = Spectrum::from_linear_srgb([1.0; 3]);
    /// assert!((white.seen(1.0)[1] - 1.0).abs() < 1e-12);
    /// let [_, y, z] = white.seen(1.2);
    /// assert!(y > 1.5 && z / y > 1.2, "{y} {z}");
    /// ```
    pub fn seen(&self, doppler: f64) -> [f64; 3] {
        let square = doppler * doppler;
        self.shifted(doppler).map(|part| part * (square * square * doppler))
    }

    /// X, Y, Z of the shifted spectrum L(λ) = L'(λD), without the factor D⁵ of (P12). D is clamped
    /// to e⁻¹⁰⁰…e¹⁰⁰.
    pub fn shifted(&self, doppler: f64) -> [f64; 3] {
        let [xyz] = Self::all_shifted([self], doppler);
        xyz
    }

    /// [`Spectrum::shifted`] of each; the daylight on surfaces is weighted by the observer once.
    pub fn all_shifted<const N: usize>(spectra: [&Self; N], doppler: f64) -> [[f64; 3]; N] {
        let doppler = doppler.clamp(libm::exp(-MAX_LN_DOPPLER), libm::exp(MAX_LN_DOPPLER));
        let daylight = LazyCell::new(|| WeightedDaylight::new(doppler));
        spectra.map(|spectrum| match &spectrum.0 {
            Kind::Reflected(surface) => surface.xyz_under(&daylight),
            Kind::Blackbody { .. } => spectrum.ln_shifted(doppler).map(libm::exp),
            Kind::Samples(samples) => samples::xyz(samples, doppler),
            Kind::Measured(samples) => {
                samples::of_daylight(|nm| samples::held(samples, nm), doppler)
            }
        })
    }

    /// ln of [`Spectrum::shifted`]; −∞ where there is no light. A cold body in fast motion exceeds
    /// the range of f64 by thousands of digits: its light is limited to [`crate::MOST_LIGHT`] as
    /// seen, all three numbers by one factor.
    pub(crate) fn ln_shifted(&self, doppler: f64) -> [f64; 3] {
        match self.0 {
            Kind::Blackbody { kelvin, luminance } => {
                // (P13): L'(λD) at T is D⁻⁵ times L at D·T.
                let beaming = 5.0 * libm::log(doppler);
                let offset = libm::log(luminance) - blackbody::ln_xyz(kelvin)[1] - beaming;
                let seen = blackbody::ln_xyz(kelvin * doppler).map(|ln| ln + offset);
                let most = libm::log(crate::MOST_LIGHT) - beaming.max(0.0);
                let excess = seen.into_iter().fold(f64::NEG_INFINITY, f64::max) - most;
                seen.map(|ln| ln - excess.max(0.0))
            }
            _ => self.shifted(doppler).map(libm::log),
        }
    }
}

/// Removes rounding: makes nearly grey colours exactly grey, and nearly zero channels exactly 0.
fn remove_rounding(rgb: [f64; 3]) -> [f64; 3] {
    const ROUNDING: f64 = 1e-12;
    let largest = rgb.iter().fold(0.0, |largest: f64, channel| largest.max(channel.abs()));
    if rgb.iter().all(|channel| (channel - rgb[1]).abs() <= ROUNDING * largest) {
        return [rgb[1]; 3];
    }
    rgb.map(|channel| if channel.abs() <= ROUNDING * largest { 0.0 } else { channel })
}

/// Gamut mapping: the colour mixed with the grey of its luminance until no channel is below 0.
fn in_gamut(rgb: [f64; 3]) -> [f64; 3] {
    let grey = luminance(rgb).max(0.0);
    let least = rgb[0].min(rgb[1]).min(rgb[2]);
    if grey <= 0.0 {
        return [0.0; 3];
    }
    let keep = if least < 0.0 { grey / (grey - least) } else { 1.0 };
    rgb.map(|channel| (grey + keep * (channel - grey)).max(0.0))
}
