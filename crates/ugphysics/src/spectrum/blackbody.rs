//! Black-body radiation.

use crate::spectrum::cie_1931::FIRST_NM;
use crate::spectrum::observer::{SUM_Y, weighted_sums};

/// Planck's constant (J s), the speed of light (m/s), and Boltzmann's constant (J/K), exact in the
/// SI of 2019.
const PLANCK: f64 = 6.62607015e-34;
const LIGHT: f64 = 299_792_458.0;
const BOLTZMANN: f64 = 1.380649e-23;

/// The second radiation constant hc/k, nm K: 1.4387768775039338·10⁷.
const SECOND_RADIATION_NM_K: f64 = PLANCK * LIGHT / BOLTZMANN * 1e9;

/// The first radiation constant for radiance, 2hc², in W nm⁴ m⁻² sr⁻¹: with λ in nm it gives
/// radiance per nm.
const FIRST_RADIATION: f64 = 2.0 * PLANCK * LIGHT * LIGHT * 1e36;

/// Temperatures are clamped to this range, kelvins.
const MIN_KELVIN: f64 = 1e-6;
const MAX_KELVIN: f64 = 1e15;

/// Planck's law: the spectral radiance of a black body, W m⁻² sr⁻¹ nm⁻¹, at a wavelength in nm and
/// a temperature in kelvins, both above 0.  Eq. (P13)
///
/// ```
/// // About the Sun's temperature: the maximum is at 499.6 nm (Wien's law).
/// let at = |nm| ugphysics::spectrum::planck(nm, 5800.0);
/// assert!(at(499.6) > at(498.0) && at(499.6) > at(501.0));
/// ```
pub fn planck(wavelength_nm: f64, kelvin: f64) -> f64 {
    let square = wavelength_nm * wavelength_nm;
    let fifth = square * square * wavelength_nm;
    FIRST_RADIATION / (fifth * libm::expm1(SECOND_RADIATION_NM_K / (wavelength_nm * kelvin)))
}

/// ln of [`planck`] in the unit of [`ln_xyz`].
pub(crate) fn ln_planck(wavelength_nm: f64, kelvin: f64) -> f64 {
    let exponent = SECOND_RADIATION_NM_K / (wavelength_nm * kelvin.clamp(MIN_KELVIN, MAX_KELVIN));
    libm::log(1e13) - 5.0 * libm::log(wavelength_nm) - exponent - libm::log(-libm::expm1(-exponent))
}

/// ln X, ln Y, ln Z of a black body's radiance, in the same unit for all temperatures. Logarithms,
/// because the visible light of cold bodies underflows: at 30 K, Y is e⁻⁵⁷⁸, and at 20 K it is
/// below the smallest f64.  Eq. (P13), (P19)
pub(crate) fn ln_xyz(kelvin: f64) -> [f64; 3] {
    // Outside this range the exponents would overflow.
    let kelvin = kelvin.clamp(MIN_KELVIN, MAX_KELVIN);
    let exponent = |wavelength_nm: f64| SECOND_RADIATION_NM_K / (wavelength_nm * kelvin);
    // The smallest exponent, at the red end of the table.
    let least = exponent((FIRST_NM + crate::spectrum::cie_1931::CIE_1931.len() - 1) as f64);
    let fifth = |nm: f64| 1e13 / (nm * nm * (nm * nm) * nm);
    if least < 1.0 {
        return weighted_sums(|_, nm| fifth(nm) / libm::expm1(exponent(nm)))
            .map(|sum| libm::log(sum / SUM_Y));
    }
    // 1/(e^x − 1), without the factor e^(−least).
    let factor = libm::exp(-least);
    let sums = weighted_sums(|_, nm| {
        let rest = libm::exp(least - exponent(nm));
        fifth(nm) * rest / (1.0 - rest * factor)
    });
    sums.map(|sum| libm::log(sum / SUM_Y) - least)
}
