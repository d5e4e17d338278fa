//! Spectra given by samples, interpolated linearly between them and 0 outside.

use crate::spectrum::cie_1931::{CIE_1931, FIRST_NM};
use crate::spectrum::daylight::daylight;
use crate::spectrum::observer::{SUM_Y, observer, weighted_sums};
use crate::spectrum::weighted_daylight::white_luminance;

/// X, Y, Z of L(λ) = L'(λD) for samples (nm, radiance) of L' at increasing wavelengths.  Eq. (P12)
/// without D⁵, (P19)
///
/// Both the spectrum and the observer are piecewise linear, so Simpson's rule integrates each piece
/// exactly. Even a spectral line much narrower than a nanometre is integrated without loss.
pub(crate) fn xyz(samples: &[[f64; 2]], doppler: f64) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for ends in samples.windows(2) {
        let ([from_nm, from], [to_nm, to]) = (ends[0], ends[1]);
        let (from_nm, to_nm) = (from_nm / doppler, to_nm / doppler);
        let radiance = |nm: f64| from + (to - from) * ((nm - from_nm) / (to_nm - from_nm));
        pieces(from_nm, to_nm, |low, high| {
            let middle = 0.5 * (low + high);
            for (at, weight) in [(low, 1.0), (middle, 4.0), (high, 1.0)] {
                let light = radiance(at) * weight * (high - low) / 6.0;
                let seen = observer(at);
                sums.iter_mut().zip(seen).for_each(|(sum, part)| *sum += light * part);
            }
        });
    }
    sums.map(|sum| sum / SUM_Y)
}

/// X, Y, Z of what a surface of this reflectance shows of daylight, which is seen with D; without
/// D⁵.  Eq. (P12), (P19), (P20)
pub(crate) fn of_daylight(reflectance: impl Fn(f64) -> f64, doppler: f64) -> [f64; 3] {
    let light = |nm: f64| reflectance(nm) * daylight(nm) / white_luminance();
    weighted_sums(|_, nm| light(nm * doppler))
}

/// Linear interpolation of samples (nm, value); outside, the value of the nearer end.
pub(crate) fn held(samples: &[[f64; 2]], wavelength_nm: f64) -> f64 {
    let next = samples.partition_point(|&[nm, _]| nm <= wavelength_nm);
    match (next.checked_sub(1).map(|row| samples[row]), samples.get(next)) {
        (Some([low, from]), Some(&[high, to])) => {
            from + (to - from) * ((wavelength_nm - low) / (high - low))
        }
        (Some([_, end]), None) | (None, Some(&[_, end])) => end,
        (None, None) => 0.0,
    }
}

/// Splits the range at whole nanometres, clips it to the observer's, and calls `each` with the ends
/// of every piece.
fn pieces(from_nm: f64, to_nm: f64, mut each: impl FnMut(f64, f64)) {
    let first = FIRST_NM as f64;
    let last = (FIRST_NM + CIE_1931.len() - 1) as f64;
    let (mut low, to_nm) = (from_nm.max(first), to_nm.min(last));
    while low < to_nm {
        let high = (low.floor() + 1.0).min(to_nm);
        each(low, high);
        low = high;
    }
}
