//! How far the assumed reflectance of a colour can be trusted.

use crate::spectrum::foliage;
use crate::spectrum::radiance::{Kind, Spectrum};
use crate::xyz_to_linear_srgb;

/// Colours whose reflectance in motion is about equally uncertain, (P20).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColorClass {
    /// Chroma C*ab below 10.
    Grey,
    /// Greens and browns that may be plants.
    Foliage,
    /// All others.
    Saturated,
}

/// Colours with less chroma C*ab are greys.
const GREY_CHROMA: f64 = 10.0;

/// D, and the ΔE*ab below which 10 % and 90 % of measured surfaces of the classes are: greys,
/// foliage, others. From docs/physics/reflectance.py.
const MEASURED: [(f64, [[f64; 2]; 3]); 8] = [
    (1.0, [[0.0, 0.0], [0.0, 0.0], [0.0, 0.0]]),
    (1.05, [[0.1, 1.0], [1.5, 9.8], [0.5, 3.2]]),
    (1.1, [[0.1, 1.4], [1.9, 9.1], [0.7, 5.3]]),
    (1.2, [[0.6, 3.3], [2.8, 18.2], [1.2, 7.5]]),
    (1.3, [[1.0, 5.9], [3.4, 20.6], [2.7, 11.9]]),
    (1.5, [[2.0, 9.2], [4.0, 26.2], [2.5, 15.0]]),
    (2.0, [[1.8, 13.3], [4.4, 17.4], [4.3, 19.0]]),
    (2.5, [[1.3, 15.3], [5.0, 23.8], [3.7, 18.6]]),
];

impl ColorClass {
    /// All classes.
    pub const ALL: [Self; 3] = [Self::Grey, Self::Foliage, Self::Saturated];

    /// The class of a surface whose reflectance is assumed, because only its colour is known;
    /// `None` for measured reflectances and for what emits light.
    ///
    /// ```
    /// use ugphysics::spectrum::{ColorClass, Spectrum};
    ///
    /// let class = |rgb| ColorClass::of(&Spectrum::from_linear_srgb(rgb));
    /// assert_eq!(class([0.3, 0.3, 0.29]), Some(ColorClass::Grey));
    /// assert_eq!(class([0.05, 0.07, 0.02]), Some(ColorClass::Foliage));
    /// assert_eq!(class([0.5, 0.05, 0.03]), Some(ColorClass::Saturated));
    /// assert_eq!(ColorClass::of(&Spectrum::reflectance(&[[500.0, 0.5]])), None);
    /// ```
    pub fn of(spectrum: &Spectrum) -> Option<Self> {
        let Kind::Reflected(_) = spectrum.0 else { return None };
        let rgb = xyz_to_linear_srgb(spectrum.shifted(1.0));
        let [_, a, b] = foliage::lab(rgb);
        Some(match () {
            () if foliage::share(rgb) > 0.0 => Self::Foliage,
            () if libm::hypot(a, b) < GREY_CHROMA => Self::Grey,
            () => Self::Saturated,
        })
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Grey => "grey",
            Self::Foliage => "foliage",
            Self::Saturated => "saturated",
        }
    }

    /// The ΔE*ab, with white at the same D as white, by which most measured surfaces of this class
    /// differ in motion from the reflectance that (P20) assumes for their colour: 10 % are below,
    /// 10 % above. `None` for factors for which nothing was measured.
    ///
    /// ```
    /// use ugphysics::spectrum::ColorClass;
    ///
    /// assert_eq!(ColorClass::Grey.difference(1.0), Some([0.0, 0.0]));
    /// assert_eq!(ColorClass::Grey.difference(1.3), Some([1.0, 5.9]));
    /// // What is ultraviolet at rest was not measured.
    /// assert_eq!(ColorClass::Grey.difference(0.8), None);
    /// ```
    pub fn difference(self, doppler: f64) -> Option<[f64; 2]> {
        let next = MEASURED.iter().position(|row| row.0 >= doppler)?;
        let (to, high) = MEASURED[next];
        if to == doppler {
            return Some(high[self as usize]);
        }
        let (from, low) = MEASURED[next.checked_sub(1)?];
        let part = (doppler - from) / (to - from);
        let (low, high) = (low[self as usize], high[self as usize]);
        Some(std::array::from_fn(|i| low[i] + part * (high[i] - low[i])))
    }
}
