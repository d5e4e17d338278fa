//! Surface colours upsampled to reflectance spectra.

use crate::spectrum::curve::{CURVE_NM, Coefficients};
use crate::spectrum::infrared::{self, InfraredRule, N_LEVELS};
use crate::spectrum::quadrature::{Quadrature, dot};
use crate::spectrum::upsampling::solve;
use crate::spectrum::weighted_daylight::WeightedDaylight;

/// The value of the largest channel for which a curve is solved: with 1 the coefficients would grow
/// without bound towards white. Colours outside the sRGB gamut need a dimmer surface to be that
/// saturated, so they get a second try with the second value.
const LARGEST_CHANNEL: [f64; 2] = [0.98, 0.25];

/// A smooth reflectance under [`daylight`](crate::spectrum::daylight): a factor times a sigmoid of
/// a quadratic in the wavelength (Jakob and Hanika 2019), constant below 380 nm; in infrared by an
/// [`InfraredRule`].  Eq. (P20)
///
/// Greys have a constant reflectance, so white keeps the chromaticity of the illuminant. A colour
/// with channels up to 1 has a reflectance up to 1/0.98.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reflectance {
    factor: f64,
    /// `None` for greys.
    curve: Option<Coefficients>,
    rule: InfraredRule,
    /// The reflectances at the levels of [`InfraredRule::Measured`].
    levels: [f64; N_LEVELS],
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
    /// // As bricks do, it reflects more in infrared.
    /// assert!(brick.at(1600.0) > brick.at(700.0));
    /// ```
    pub fn from_linear_srgb(rgb: [f64; 3]) -> Option<Self> {
        Self::with_infrared(rgb, InfraredRule::default())
    }

    /// [`Reflectance::from_linear_srgb`] by a rule for infrared.
    pub fn with_infrared(rgb: [f64; 3], rule: InfraredRule) -> Option<Self> {
        let [red, green, blue] = rgb;
        let levels = infrared::levels(rgb);
        if red == green && green == blue {
            return Some(Self { factor: red.max(0.0), curve: None, rule, levels });
        }
        let largest = red.max(green).max(blue);
        if !(largest > 0.0 && rgb.iter().all(|channel| channel.is_finite())) {
            return None;
        }
        LARGEST_CHANNEL.into_iter().find_map(|brightest| {
            let factor = largest / brightest;
            let curve = solve(
                rgb.map(|channel| channel / factor),
                rule,
                levels.map(|level| level / factor),
            )?;
            Some(Self { factor, curve: Some(curve), rule, levels })
        })
    }

    /// The reflectance at a wavelength in nm.
    pub fn at(&self, wavelength_nm: f64) -> f64 {
        let [first, last] = CURVE_NM;
        let curve = self.factor
            * self.curve.map_or(1.0, |curve| curve.at(wavelength_nm.clamp(first, last)));
        match self.rule {
            InfraredRule::Measured if wavelength_nm > infrared::FIRST_NM => {
                let (visible, shares) = infrared::parts(wavelength_nm);
                curve * visible + dot(&self.levels, &shares)
            }
            _ => curve,
        }
    }

    /// X, Y, Z of L(λ) = L'(λD) under daylight, which is computed beforehand: (P12) without D⁵.
    pub(crate) fn xyz_under(&self, light: &WeightedDaylight) -> [f64; 3] {
        let ends = CURVE_NM.map(|nm| self.at(nm));
        let reflected: Vec<f64> = match self.curve {
            Some(curve) => light.wavelengths().map(|nm| curve.at(nm)).collect(),
            None => vec![1.0; light.inside[0].len()],
        };
        std::array::from_fn(|i| {
            let (inside, infrared) = match self.rule {
                InfraredRule::Measured => (&light.joined[i], dot(&self.levels, &light.infrared[i])),
                InfraredRule::Constant => (&light.inside[i], ends[1] * light.beyond[i]),
            };
            ends[0] * light.ultraviolet[i] + infrared + self.factor * dot(&reflected, inside)
        })
    }

    /// X, Y, Z from the values of the reflectance at the nodes of a quadrature by the same rule.
    pub(crate) fn xyz_at_nodes<const N: usize>(
        &self,
        values: &[f64; N],
        nodes: &Quadrature<N>,
    ) -> [f64; 3] {
        let (sums, infrared) = (nodes.sums(values), nodes.infrared(&self.levels));
        std::array::from_fn(|i| self.factor * sums[i] + infrared[i])
    }

    /// The curve that is multiplied by the factor (`None`: the constant 1).
    pub(crate) fn curve(&self) -> Option<Coefficients> {
        self.curve
    }

    /// The rule for infrared.
    pub(crate) fn rule(&self) -> InfraredRule {
        self.rule
    }
}
