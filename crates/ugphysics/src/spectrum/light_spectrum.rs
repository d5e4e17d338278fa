//! Surfaces under a light of any spectrum, which may move relative to them.

use crate::MOST_LIGHT;
use crate::spectrum::blackbody;
use crate::spectrum::daylight::daylight;
use crate::spectrum::observer::integrate;
use crate::spectrum::radiance::{Kind, Spectrum};
use crate::spectrum::{SmoothCurve, planck, samples};

/// The spectrum of a light, in the light's rest frame.
#[derive(Clone, Debug)]
pub struct LightSpectrum {
    source: Source,
    /// Factor that gives a white surface at rest the Y of the spectrum.
    scale: f64,
}

#[derive(Clone, Debug)]
enum Source {
    /// Daylight through a filter.
    Filtered(Spectrum),
    Blackbody(f64),
    /// A black body of so many kelvins whose visible light underflows. `ln_scale`: ln of a factor.
    ColdBody {
        kelvin: f64,
        ln_scale: f64,
    },
    Samples(Vec<[f64; 2]>),
}

impl LightSpectrum {
    /// The light whose colour is `spectrum`. A surface colour becomes daylight through a filter of
    /// that transmittance; black bodies and samples shine as they are.
    pub fn new(spectrum: &Spectrum) -> Self {
        match &spectrum.0 {
            Kind::Reflected(_) | Kind::Measured(_) => Self {
                source: Source::Filtered(spectrum.clone()),
                scale: 1.0 / integrate(daylight)[1],
            },
            Kind::Blackbody { kelvin, luminance } => {
                let scale = luminance / integrate(|nm| planck(nm, *kelvin))[1];
                if scale.is_finite() {
                    return Self { source: Source::Blackbody(*kelvin), scale };
                }
                let ln_scale = libm::log(*luminance) - blackbody::ln_xyz(*kelvin)[1];
                Self { source: Source::ColdBody { kelvin: *kelvin, ln_scale }, scale: 1.0 }
            }
            Kind::Samples(samples) => {
                Self { source: Source::Samples(samples.to_vec()), scale: 1.0 }
            }
        }
    }

    /// Relative spectral power at a wavelength in nm: 1 for a table of value 1.
    pub fn at(&self, wavelength_nm: f64) -> f64 {
        let light = match &self.source {
            Source::Filtered(filter) => {
                filter.transmittance(wavelength_nm) * daylight(wavelength_nm)
            }
            Source::Blackbody(kelvin) => planck(wavelength_nm, *kelvin),
            Source::ColdBody { kelvin, ln_scale } => {
                libm::exp(blackbody::ln_planck(wavelength_nm, *kelvin) + ln_scale).min(MOST_LIGHT)
            }
            Source::Samples(samples) => interpolate(samples, wavelength_nm),
        };
        light * self.scale
    }

    /// X, Y, Z of L(λ) = C(λ) S(λD): of this light S, received with D = `doppler` and weakened on
    /// the way by C, without a factor for the radiance.  Eq. (P14), (P19)
    ///
    /// A sum over whole nanometres. Daylight in it is interpolated over ln D: with 81 pairs of
    /// surfaces and filters, white to primaries, by at most 1.7·10⁻⁴ of the largest of X, Y and Z.
    pub fn seen_through(&self, curve: &SmoothCurve, doppler: f64) -> [f64; 3] {
        let xyz = match &self.source {
            Source::Filtered(filter) => curve.through(filter, doppler).xyz_of_daylight(doppler),
            Source::Blackbody(kelvin) => curve.times(|nm| planck(nm * doppler, *kelvin)).xyz(),
            Source::ColdBody { kelvin, ln_scale } => {
                let ln = |nm: f64| blackbody::ln_planck(nm * doppler, *kelvin) + ln_scale;
                // Limited by one factor, so that it keeps its hue. By Wien's law the maximum is at
                // 2.898·10⁶/(D T) nm.
                let strongest = ln((2.898e6 / (doppler * kelvin)).clamp(360.0, 830.0));
                let excess = (strongest - libm::log(MOST_LIGHT)).max(0.0);
                curve.xyz_of(|nm| libm::exp(ln(nm) - excess))
            }
            Source::Samples(samples) => curve.xyz_of(|nm| interpolate(samples, nm * doppler)),
        };
        xyz.map(|part| part * self.scale)
    }
}

/// Linear interpolation of samples (nm, value), 0 outside.
fn interpolate(samples: &[[f64; 2]], wavelength_nm: f64) -> f64 {
    let next = samples.partition_point(|&[nm, _]| nm <= wavelength_nm);
    match (next.checked_sub(1).map(|row| samples[row]), samples.get(next)) {
        (Some([low, from]), Some(&[high, to])) => {
            from + (to - from) * ((wavelength_nm - low) / (high - low))
        }
        (Some([last, value]), None) if last == wavelength_nm => value,
        _ => 0.0,
    }
}

impl Spectrum {
    /// X, Y, Z of a surface seen with D = `doppler` under a light that it receives with
    /// D_l = `light_doppler`: of L(λ) = R(λD) S(λ D D_l), without the factors D⁵ and D_l³. `None`
    /// if this spectrum is not a surface but emits light itself.  Eq. (P14), (P19), (P20)
    ///
    /// ```
    /// use ugphysics::spectrum::{LightSpectrum, Spectrum};
    ///
    /// // White under a green lamp looks green; a surface under white light has its own colour.
    /// let white = Spectrum::from_linear_srgb([1.0; 3]);
    /// let green = Spectrum::from_linear_srgb([0.1, 0.5, 0.1]);
    /// for (surface, lamp) in [(&white, &green), (&green, &white)] {
    ///     let seen = surface.under(&LightSpectrum::new(lamp), 1.0, 1.0).ok_or("a surface")?;
    ///     assert!(seen.iter().zip(green.seen(1.0)).all(|(a, b)| (a - b).abs() < 1e-9));
    /// }
    /// # Ok::<(), &str>(())
    /// ```
    pub fn under(
        &self,
        light: &LightSpectrum,
        doppler: f64,
        light_doppler: f64,
    ) -> Option<[f64; 3]> {
        if !self.is_surface() {
            return None;
        }
        let reflected = SmoothCurve::of(self, doppler);
        Some(light.seen_through(&reflected, doppler * light_doppler))
    }

    /// The part of light that a filter of this colour transmits at a wavelength in nm; all of it
    /// if this spectrum is not that of a surface.
    pub fn transmittance(&self, wavelength_nm: f64) -> f64 {
        match &self.0 {
            Kind::Reflected(surface) => surface.at(wavelength_nm),
            Kind::Measured(samples) => samples::held(samples, wavelength_nm),
            _ => 1.0,
        }
    }

    /// True if this is the spectrum of a surface, which reflects light; false for what emits it.
    pub fn is_surface(&self) -> bool {
        matches!(self.0, Kind::Reflected(_) | Kind::Measured(_))
    }
}
