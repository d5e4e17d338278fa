//! Surface colours raised to spectra.

use crate::cie_1931::{CIE_1931, FIRST_NM};
use crate::daylight::daylight;
use crate::nodes::dot;
use crate::observer::weigh;
use crate::solve::{Coefficients, solve};

/// Where the curve ends; beyond, the reflectance stays as it is there.
pub(crate) const CURVE_NM: [f64; 2] = [380.0, 780.0];

/// The brightest channel that a curve is solved for: at 1 its coefficients grow without bound toward white. Colours
/// outside of the triangle of the primaries are so saturated only if the surface is dim, and get another try.
const BRIGHTEST: [f64; 2] = [0.98, 0.25];

/// A smooth reflectance under [`daylight`]: a factor times a sigmoid of a quadratic in the wavelength (Jakob and
/// Hanika 2019), constant outside 380…780 nm.  Eq. (P20)
///
/// Greys reflect alike at every wavelength, so white stays the white of the light that shines on it. Colours of one
/// hue and saturation differ by the factor alone. A colour of at most 1 reflects at most 1/0.98.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reflectance {
    factor: f64,
    /// `None` for greys.
    curve: Option<Coefficients>,
}

impl Reflectance {
    /// The surface that shows this linear red, green and blue (sRGB primaries, 1 1 1 is white) at rest, to 10⁻⁹. They
    /// may be above 1: it shines. Negative channels lie outside of the triangle of the primaries; what is not so
    /// far outside that no smooth surface has the colour still comes out. `None` for the rest.
    ///
    /// ```
    /// use ugspectrum::Reflectance;
    ///
    /// let brick = Reflectance::from_linear_srgb([0.45, 0.07, 0.03]).expect("a colour of the screen");
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
        BRIGHTEST.into_iter().find_map(|brightest| {
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

    /// X, Y, Z of L(λ) = L'(λD), with what shines on it and is seen: (P12) without D⁵.
    pub(crate) fn xyz(&self, doppler: f64) -> [f64; 3] {
        self.lit(&Illumination::new(doppler))
    }

    /// The same with the light worked out before.
    pub(crate) fn lit(&self, light: &Illumination) -> [f64; 3] {
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

    /// The curve times a factor; without a curve, 1 times it.
    pub(crate) fn parts(&self) -> (f64, Option<Coefficients>) {
        (self.factor, self.curve)
    }
}

/// The light on a surface as seen with a Doppler factor, weighed by the observer: white has Y = 1 at rest.
#[derive(Clone, Debug)]
pub(crate) struct Illumination {
    doppler: f64,
    /// X, Y, Z of all that comes from below 380 nm, and from above 780.
    pub outside: [[f64; 3]; 2],
    /// Wavelength at the eye, nm, of the first row of `inside`.
    first_nm: f64,
    /// X, then Y, then Z of each nanometre at the eye whose light comes from 380…780 nm.
    pub inside: [Vec<f64>; 3],
}

impl Illumination {
    pub fn new(doppler: f64) -> Self {
        let inside = [0; 3].map(|_| Vec::new());
        let mut light = Self { doppler, outside: [[0.0; 3]; 2], first_nm: 0.0, inside };
        let scale = 1.0 / white_luminance();
        for (row, weights) in CIE_1931.iter().enumerate() {
            let seen_nm = (FIRST_NM + row) as f64;
            let level = daylight(seen_nm * doppler) * scale;
            let xyz = weights.map(|weight| weight * level);
            let into = if seen_nm * doppler < CURVE_NM[0] {
                &mut light.outside[0]
            } else if seen_nm * doppler > CURVE_NM[1] {
                &mut light.outside[1]
            } else {
                if light.inside[0].is_empty() {
                    light.first_nm = seen_nm;
                }
                light.inside.iter_mut().zip(xyz).for_each(|(channel, part)| channel.push(part));
                continue;
            };
            into.iter_mut().zip(xyz).for_each(|(sum, part)| *sum += part);
        }
        light
    }

    /// Wavelengths at the surface of the rows of `inside`, nm.
    pub fn wavelengths(&self) -> impl Iterator<Item = f64> {
        (0..self.inside[0].len()).map(|row| (self.first_nm + row as f64) * self.doppler)
    }
}

/// Σ daylight ȳ.
fn white_luminance() -> f64 {
    static SUM: std::sync::OnceLock<f64> = std::sync::OnceLock::new();
    *SUM.get_or_init(|| weigh(|_, nm| daylight(nm))[1])
}
