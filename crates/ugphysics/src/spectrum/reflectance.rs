//! Surface colours upsampled to reflectance spectra.

use std::sync::Arc;

use crate::spectrum::curve::Curve;
use crate::spectrum::dot::dot;
use crate::spectrum::foliage;
use crate::spectrum::infrared::{self, InfraredRule};
use crate::spectrum::quadrature::Quadrature;
use crate::spectrum::ranges::{CURVE_NM, N_LEVELS, N_NM};
use crate::spectrum::upsampling::solve;
use crate::spectrum::weighted_daylight::WeightedDaylight;

/// The least bounds of a reflectance in units of its largest channel. With 1 no curve of a bright
/// saturated colour would be smooth. Colours outside the sRGB gamut need a dimmer surface to be
/// that saturated, so they get a second try with the second value.
const LEAST_BOUND: [f64; 2] = [1.02, 4.0];

/// The largest bound in units of the largest channel: more makes no difference.
const LARGEST_BOUND: f64 = 100.0;

/// A smooth reflectance under [`daylight`](crate::spectrum::daylight): the one that changes least
/// from wavelength to wavelength, between 0 and a bound, constant below 380 nm; in infrared by an
/// [`InfraredRule`].  Eq. (P20)
///
/// Greys have a constant reflectance, so white keeps the chromaticity of the illuminant. A colour
/// with channels up to 0.98 has a reflectance up to 1, and brighter ones up to 1.02 of the largest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reflectance {
    factor: f64,
    /// `None` for greys.
    curve: Option<Curve>,
    /// The curve at every nanometre, if it is [tabulated](Self::tabulated).
    values: Option<Arc<[f64; N_NM]>>,
    /// The reflectances at the levels of the [`InfraredRule`].
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
        let levels = rule.levels(rgb);
        if red == green && green == blue {
            return Some(Self { factor: red.max(0.0), curve: None, values: None, levels });
        }
        let largest = red.max(green).max(blue);
        if !(largest > 0.0 && rgb.iter().all(|channel| channel.is_finite())) {
            return None;
        }
        let parts = levels.map(|level| level / largest);
        // A curve that ends at the red channel has no rise towards infrared.
        let (visible, foliage) = match rule {
            InfraredRule::Measured => (1.0, foliage::share(rgb)),
            InfraredRule::Constant => (parts[0], 0.0),
        };
        LEAST_BOUND.into_iter().find_map(|least| {
            let most = (1.0 / largest).clamp(least, LARGEST_BOUND);
            let start = Curve::between(visible, parts[0], foliage, most);
            let curve = solve(rgb.map(|channel| channel / largest), start, parts)?;
            Some(Self { factor: largest, curve: Some(curve), values: None, levels })
        })
    }

    /// The same, soon found at many wavelengths and Doppler factors.
    pub(crate) fn tabulated(mut self) -> Self {
        self.values = self.curve.map(|curve| Arc::new(curve.values()));
        self
    }

    /// The reflectance at a wavelength in nm.
    pub fn at(&self, wavelength_nm: f64) -> f64 {
        self.at_with(wavelength_nm, |row| match (&self.values, &self.curve) {
            (Some(values), _) => values[row],
            (None, Some(curve)) => curve.at_node(row),
            (None, None) => 1.0,
        })
    }

    /// The reflectance at each of many wavelengths in nm.
    pub(crate) fn at_each<const N: usize>(&self, nm: impl Fn(usize) -> f64) -> [f64; N] {
        let values = self.values();
        std::array::from_fn(|k| self.at_with(nm(k), |row| values[row]))
    }

    /// Between whole nanometres the curve is interpolated linearly. `value`: of a nanometre of it.
    #[inline]
    fn at_with(&self, wavelength_nm: f64, value: impl Fn(usize) -> f64) -> f64 {
        if wavelength_nm > infrared::FIRST_NM {
            return infrared::mixed(&self.levels, wavelength_nm);
        }
        let at = (wavelength_nm - CURVE_NM[0]).max(0.0);
        let row = (at as usize).min(N_NM - 2);
        let (low, high) = (value(row), value(row + 1));
        self.factor * (low + (at - row as f64) * (high - low))
    }

    /// The curve at every nanometre.
    fn values(&self) -> Arc<[f64; N_NM]> {
        let new = || Arc::new(self.curve.map_or([1.0; N_NM], |curve| curve.values()));
        self.values.clone().unwrap_or_else(new)
    }

    /// X, Y, Z of L(λ) = L'(λD) under daylight, which is computed beforehand: (P12) without D⁵.
    pub(crate) fn xyz_under(&self, light: &WeightedDaylight) -> [f64; 3] {
        let values = self.values();
        let used = || light.used.clone();
        std::array::from_fn(|i| {
            let inside = dot(&values[used()], &light.inside[i][used()]);
            let visible = values[0] * light.ultraviolet[i] + inside;
            self.factor * visible + dot(&self.levels, &light.infrared[i])
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
    pub(crate) fn curve(&self) -> Option<Curve> {
        self.curve
    }
}
