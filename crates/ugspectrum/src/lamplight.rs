//! Surfaces under light of any spectrum, which may move against them.

use crate::daylight::daylight;
use crate::observer::integrate;
use crate::spectrum::{Kind, Spectrum};
use crate::{Reflectance, planck};

/// The spectrum of a light, as it is in the frame of the light.
#[derive(Clone, Debug)]
pub struct Lamplight {
    source: Source,
    /// What brings the Y of a white surface at rest to that of the spectrum.
    scale: f64,
}

#[derive(Clone, Debug)]
enum Source {
    Filtered(Reflectance),
    Blackbody(f64),
    Samples(Vec<[f64; 2]>),
}

impl Lamplight {
    /// Daylight through a filter of that colour, a black body, or samples; of a light whose colour the spectrum is.
    #[must_use]
    pub fn new(spectrum: &Spectrum) -> Self {
        match &spectrum.0 {
            Kind::Reflected(filter) => {
                Self { source: Source::Filtered(*filter), scale: 1.0 / integrate(daylight)[1] }
            }
            Kind::Blackbody { kelvin, luminance } => {
                let white = integrate(|nm| planck(nm, *kelvin))[1];
                let scale = luminance / white;
                Self {
                    source: Source::Blackbody(*kelvin),
                    scale: if scale.is_finite() { scale } else { 0.0 },
                }
            }
            Kind::Samples(samples) => Self { source: Source::Samples(samples.to_vec()), scale: 1.0 },
        }
    }

    /// Its part at a wavelength in nm, 1 for a table of value 1.
    #[must_use]
    pub fn at(&self, wavelength_nm: f64) -> f64 {
        let light = match &self.source {
            Source::Filtered(filter) => filter.at(wavelength_nm) * daylight(wavelength_nm),
            Source::Blackbody(kelvin) => planck(wavelength_nm, *kelvin),
            Source::Samples(samples) => between(samples, wavelength_nm),
        };
        light * self.scale
    }
}

fn between(samples: &[[f64; 2]], wavelength_nm: f64) -> f64 {
    let next = samples.partition_point(|&[nm, _]| nm <= wavelength_nm);
    match (next.checked_sub(1).map(|row| samples[row]), samples.get(next)) {
        (Some([low, from]), Some(&[high, to])) => from + (to - from) * ((wavelength_nm - low) / (high - low)),
        (Some([last, value]), None) if last == wavelength_nm => value,
        _ => 0.0,
    }
}

impl Spectrum {
    /// X, Y, Z of a surface under a light with the Doppler factor D_l between them, seen with D: of
    /// L(λ) = R(λD) S(λ D D_l), without D⁵ and D_l³. `None` for what is no surface, but shines by itself.
    /// Eq. (P14), (P19), (P20)
    ///
    /// ```
    /// use ugspectrum::{Lamplight, Spectrum};
    ///
    /// // White under a green lamp is green; under daylight a surface has its own colour.
    /// let (white, green) = (Spectrum::from_linear_srgb([1.0; 3]), Spectrum::from_linear_srgb([0.1, 0.5, 0.1]));
    /// for (surface, lamp) in [(&white, &green), (&green, &white)] {
    ///     let seen = surface.under(&Lamplight::new(lamp), 1.0, 1.0).ok_or("a surface")?;
    ///     assert!(seen.iter().zip(green.seen(1.0)).all(|(a, b)| (a - b).abs() < 1e-9));
    /// }
    /// # Ok::<(), &str>(())
    /// ```
    #[must_use]
    pub fn under(&self, light: &Lamplight, doppler: f64, light_doppler: f64) -> Option<[f64; 3]> {
        let Kind::Reflected(surface) = &self.0 else { return None };
        Some(integrate(|nm| surface.at(nm * doppler) * light.at(nm * doppler * light_doppler)))
    }
}
