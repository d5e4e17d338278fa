//! Surface colours upsampled to reflectance spectra.

use crate::spectrum::curve::{CURVE_NM, Coefficients};
use crate::spectrum::quadrature::dot;
use crate::spectrum::upsampling::solve;
use crate::spectrum::weighted_daylight::WeightedDaylight;

/// The value of the largest channel for which a curve is solved: with 1 the coefficients would grow
/// without bound towards white. Colours outside the sRGB gamut need a dimmer surface to be that
/// saturated, so they get a second try with the second value.
const LARGEST_CHANNEL: [f64; 2] = [0.98, 0.25];

/// A smooth reflectance under [`daylight`](crate::spectrum::daylight): a factor times a sigmoid of
/// a quadratic in the wavelength (Jakob and Hanika 2019), constant outside 380…780 nm.  Eq. (P20)
///
/// Greys have a constant reflectance, so white keeps the chromaticity of the illuminant. Colours
/// with the same ratios of channels differ only by the factor. A colour with channels up to 1 has a
/// reflectance up to 1/0.98.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reflectance {
    factor: f64,
    /// `None` for greys.
    curve: Option<Coefficients>,
}

impl Reflectance {
    /// The surface that has this linear sRGB colour (white is 1, 1, 1) at rest, to 10⁻⁹. Channels
    /// may be above 1, for surfaces brighter than white. Negative channels are colours outside the
    /// sRGB gamut; they are found too, up to a limit. `None` if no smooth surface has the colour.
    ///
    /// ```
    /// use ugphysics::spectrum::Reflectance;
    ///
    /// let brick = Reflectance::from_linear_srgb([0.45, 0.07, 0.03]).expect("in the sRGB gamut");
    /// assert!(brick.at(650.0) > 4.0 * brick.at(450.0));
    /// assert_eq!(brick.at(2000.0), brick.at(780.0));
    /// ```
    #[must_use]
    pub fn from_linear_srgb(rgb: [f64; 3]) -> Option<Self> {
        let [red, green, blue] = rgb;
        if red == green && green == blue {
            return Some(Self { factor: red.max(0.0), curve: None });
        }
        let largest = red.max(green).max(blue);
        if !(largest > 0.0 && rgb.iter().all(|channel| channel.is_finite())) {
            return None;
        }
        LARGEST_CHANNEL.into_iter().find_map(|brightest| {
            let factor = largest / brightest;
            let curve = solve(rgb.map(|channel| channel / factor))?;
            Some(Self { factor, curve: Some(curve) })
        })
    }

    /// The reflectance at a wavelength in nm.
    #[must_use]
    pub fn at(&self, wavelength_nm: f64) -> f64 {
        let [first, last] = CURVE_NM;
        self.factor * self.curve.map_or(1.0, |curve| curve.at(wavelength_nm.clamp(first, last)))
    }

    /// X, Y, Z of L(λ) = L'(λD) under daylight, which is computed beforehand: (P12) without D⁵.
    pub(crate) fn xyz_under(&self, light: &WeightedDaylight) -> [f64; 3] {
        let ends = CURVE_NM.map(|nm| self.at(nm));
        let [ultraviolet, infrared] = &light.outside;
        let reflected: Vec<f64> = match self.curve {
            Some(curve) => light.wavelengths().map(|nm| curve.at(nm)).collect(),
            None => vec![1.0; light.inside[0].len()],
        };
        std::array::from_fn(|i| {
            let inside = self.factor * dot(&reflected, &light.inside[i]);
            ends[0] * ultraviolet[i] + ends[1] * infrared[i] + inside
        })
    }

    /// The factor, and the curve that it multiplies (`None`: the constant 1).
    pub(crate) fn parts(&self) -> (f64, Option<Coefficients>) {
        (self.factor, self.curve)
    }
}
