//! Integrals of a light times a curve, such as a reflectance.

use std::sync::{LazyLock, OnceLock};

use crate::spectrum::cie_1931::{CIE_1931, FIRST_NM};
use crate::spectrum::daylight::daylight;
use crate::spectrum::doppler_table::{Cell, LN_STEP};
use crate::spectrum::dot::dot;
use crate::spectrum::observer::SUM_Y;
use crate::spectrum::radiance::{Kind, Spectrum};

/// Whole nanometres at the eye.
const N_NM: usize = CIE_1931.len();

/// [`LN_STEP`] over the step of the table of daylight, whose corners need it.
const FINER: f64 = 2.0;

/// The |ln D| up to which weights of daylight are kept; beyond it they are computed each time.
const REACH: f64 = 6.0;

/// The last row of that table, counted from that of D = 1, with margins for the interpolation.
const LAST: i32 = (REACH * FINER / LN_STEP) as i32 + 2;

/// Rows of that table.
const N_ROWS: usize = 2 * LAST as usize + 1;

/// A function of the wavelength at the eye, at every nanometre: what surfaces reflect and filters
/// transmit.
///
/// ```
/// use ugphysics::spectrum::{LightSpectrum, SmoothCurve, Spectrum};
///
/// // White seen through a filter of a colour has this colour.
/// let green = Spectrum::from_linear_srgb([0.1, 0.5, 0.1]);
/// let filter = SmoothCurve::of(&green, 1.0);
/// let white = LightSpectrum::new(&Spectrum::from_linear_srgb([1.0; 3]));
/// let seen = white.seen_through(&filter, 1.0);
/// assert!(seen.iter().zip(green.seen(1.0)).all(|(a, b)| (a - b).abs() < 1e-9));
/// ```
#[derive(Clone, Debug)]
pub struct SmoothCurve([f64; N_NM]);

impl SmoothCurve {
    /// `curve`: a function of the wavelength at the eye, nm.
    pub fn new(curve: impl Fn(f64) -> f64) -> Self {
        Self(std::array::from_fn(|row| curve((FIRST_NM + row) as f64)))
    }

    /// What a surface reflects and a filter of its colour transmits, seen with a Doppler factor:
    /// all of it if the spectrum is not that of a surface.
    pub fn of(spectrum: &Spectrum, doppler: f64) -> Self {
        let nm = |row: usize| (FIRST_NM + row) as f64 * doppler;
        match &spectrum.0 {
            Kind::Reflected(surface) => Self(surface.at_each(nm)),
            _ => Self(std::array::from_fn(|row| spectrum.transmittance(nm(row)))),
        }
    }

    /// The product with that of another surface or filter.
    #[must_use]
    pub fn through(&self, filter: &Spectrum, doppler: f64) -> Self {
        let other = Self::of(filter, doppler);
        Self(std::array::from_fn(|row| self.0[row] * other.0[row]))
    }

    /// The product with another curve.
    pub(crate) fn times(&self, curve: impl Fn(f64) -> f64) -> Self {
        let other = Self::new(curve);
        Self(std::array::from_fn(|row| self.0[row] * other.0[row]))
    }

    /// X, Y, Z of the curve.
    pub(crate) fn xyz(&self) -> [f64; 3] {
        static WEIGHTS: LazyLock<Weights> = LazyLock::new(|| Weights::new(|_| 1.0));
        WEIGHTS.sums(self)
    }

    /// X, Y, Z of the curve times a light, a function of the wavelength at the eye, nm.
    pub(crate) fn xyz_of(&self, light: impl Fn(f64) -> f64) -> [f64; 3] {
        Weights::new(light).sums(self)
    }

    /// X, Y, Z of the curve times daylight S(λD).
    pub(crate) fn xyz_of_daylight(&self, doppler: f64) -> [f64; 3] {
        let ln_doppler = libm::log(doppler);
        if ln_doppler.abs() < REACH {
            let cell = Cell::new(-LAST, N_ROWS, FINER * ln_doppler);
            let sums = |row: usize| daylight_row(row).sums(self);
            if cell.fraction == 0.0 {
                return sums(cell.idx);
            }
            // Interpolation polynomials can fall slightly below 0.
            let ln_sums = |row: usize| sums(row).map(|sum| libm::log(sum.max(0.0)));
            return cell.interpolate(std::array::from_fn(|k| ln_sums(cell.idx + k - 1)));
        }
        self.xyz_of(|nm| daylight(nm * doppler))
    }
}

/// The weights of daylight at a row of its table, computed at first use.
fn daylight_row(row: usize) -> &'static Weights {
    static ROWS: [OnceLock<Box<Weights>>; N_ROWS] = [const { OnceLock::new() }; N_ROWS];
    ROWS[row].get_or_init(|| {
        let doppler = libm::exp((row as f64 - f64::from(LAST)) * (LN_STEP / FINER));
        Box::new(Weights::new(|nm| daylight(nm * doppler)))
    })
}

/// X, Y, Z of a light at every nanometre, by channel.
#[derive(Debug)]
struct Weights([[f64; N_NM]; 3]);

impl Weights {
    /// `light`: a function of the wavelength at the eye, nm.
    fn new(light: impl Fn(f64) -> f64) -> Self {
        let mut weights = [[0.0; N_NM]; 3];
        for (row, observer) in CIE_1931.iter().enumerate() {
            let level = light((FIRST_NM + row) as f64) / SUM_Y;
            weights.iter_mut().zip(observer).for_each(|(of, part)| of[row] = level * part);
        }
        Self(weights)
    }

    fn sums(&self, curve: &SmoothCurve) -> [f64; 3] {
        self.0.each_ref().map(|weights| dot(&curve.0, weights))
    }
}
