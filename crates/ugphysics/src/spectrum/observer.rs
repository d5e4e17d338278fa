//! The CIE 1931 standard observer, and X, Y, Z of a spectrum.

use crate::spectrum::cie_1931::{CIE_1931, FIRST_NM};

/// ∫ȳ dλ as the sum over the table: an equal-energy spectrum of 1 has Y = 1.
pub(crate) const SUM_Y: f64 = sum_y();

const fn sum_y() -> f64 {
    let mut sum = 0.0;
    let mut row = 0;
    while row < CIE_1931.len() {
        sum += CIE_1931[row][1];
        row += 1;
    }
    sum
}

/// The colour matching functions x̄, ȳ, z̄ of the CIE 1931 standard observer (2°) at a wavelength
/// in nm: interpolated linearly between whole nanometres, 0 outside 360…830 nm.  Eq. (P19)
///
/// ```
/// assert_eq!(ugphysics::spectrum::observer(555.0)[1], 1.0);
/// assert_eq!(ugphysics::spectrum::observer(900.0), [0.0; 3]);
/// ```
pub fn observer(wavelength_nm: f64) -> [f64; 3] {
    let at = wavelength_nm - FIRST_NM as f64;
    let last = CIE_1931.len() - 1;
    if !(0.0..=last as f64).contains(&at) {
        return [0.0; 3];
    }
    let row = (at as usize).min(last - 1);
    let part = at - row as f64;
    std::array::from_fn(|i| CIE_1931[row][i] + part * (CIE_1931[row + 1][i] - CIE_1931[row][i]))
}

/// X, Y, Z of a spectral radiance, a function of the wavelength in nm: the sum over every nanometre
/// from 360 to 830. A radiance of 1 at every wavelength has Y = 1.  Eq. (P19)
///
/// ```
/// let [x, y, z] = ugphysics::spectrum::integrate(|_| 1.0);
/// assert!((y - 1.0).abs() < 1e-12 && (x - 1.0).abs() < 1e-3 && (z - 1.0).abs() < 1e-3);
/// ```
pub fn integrate(radiance: impl Fn(f64) -> f64) -> [f64; 3] {
    weighted_sums(|_, wavelength_nm| radiance(wavelength_nm)).map(|sum| sum / SUM_Y)
}

/// Σ L x̄, Σ L ȳ, Σ L z̄ over the table; `radiance` is called with row and wavelength in nm.
pub(crate) fn weighted_sums(radiance: impl Fn(usize, f64) -> f64) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for (row, weights) in CIE_1931.iter().enumerate() {
        let light = radiance(row, (FIRST_NM + row) as f64);
        for (sum, weight) in sums.iter_mut().zip(weights) {
            *sum += light * weight;
        }
    }
    sums
}
