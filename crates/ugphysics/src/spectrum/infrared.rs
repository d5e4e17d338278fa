//! What surfaces reflect in infrared, of which only the colour is known.

use std::sync::LazyLock;

use crate::spectrum::foliage;
use crate::spectrum::ranges::{CURVE_NM, N_LEVELS, smooth_step};

/// What a surface of a known colour reflects beyond the visible range.  Eq. (P20)
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InfraredRule {
    /// As measured surfaces of this colour do.
    #[default]
    Measured,
    /// As the red channel of its colour, at which the curve ends at 780 nm.
    Constant,
}

impl InfraredRule {
    /// Both rules.
    pub const ALL: [Self; 2] = [Self::Measured, Self::Constant];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Measured => "measured",
            Self::Constant => "constant",
        }
    }

    /// The reflectances at the wavelengths of the levels of a surface with this linear red, green
    /// and blue.
    pub(crate) fn levels(self, rgb: [f64; 3]) -> [f64; N_LEVELS] {
        match self {
            Self::Measured => levels(rgb),
            Self::Constant => {
                let largest = rgb[0].max(rgb[1]).max(rgb[2]);
                // The curve is above 0.
                [rgb[0].max(1e-4 * largest).max(0.0); N_LEVELS]
            }
        }
    }
}

/// Beyond this wavelength, nm, the reflectance is that of the levels.
pub(crate) const FIRST_NM: f64 = CURVE_NM[1];

/// The wavelengths of the levels, nm: the middles of the bands that the fit used.
const LEVELS_NM: [f64; N_LEVELS] = [845.0, 1150.0, 1640.0, 2200.0];

/// For each level, the coefficients of a fit to measured surfaces of 23 kinds, found as
/// docs/physics/reflectance.py says.
const FIT: [[f64; 3]; N_LEVELS] =
    [[0.9, -1.06, 1.2], [1.28, 0.05, 1.88], [0.03, -0.05, 2.14], [0.06, 1.85, 0.63]];

/// Keep the infrared of dark saturated colours alike: for each level, an amount of white that is
/// added to a colour before its channels are compared.
const WHITE: [f64; N_LEVELS] = [0.005, 0.175, 0.175, 0.175];

/// Keeps the infrared of dark surfaces in proportion to their colour.
const SOFT: f64 = 0.03;

/// A Σ below 0, that of colours without green, is held above −1 over this. Without it, purples that
/// are alike at rest would differ in infrared.
const LEAST: f64 = 9.0;

/// The reflectances at the wavelengths of the levels of a surface with this linear red, green and
/// blue, m the largest: m ((m + e)/(1 + e))^(p − 1) with p = 2^(−Σ k (m − c)/(m + w)), and as far
/// as the colour is that of [foliage], what foliage reflects. A Σ below 0 is held near 0. Greys
/// stay grey, white stays white, and no level is above 1, or m if this is more.
pub(crate) fn levels(rgb: [f64; 3]) -> [f64; N_LEVELS] {
    let largest = rgb[0].max(rgb[1]).max(rgb[2]);
    if !(largest > 0.0 && largest < 1.0) {
        return [largest.max(0.0); N_LEVELS];
    }
    let share = foliage::share(rgb);
    std::array::from_fn(|i| {
        let lacks = rgb.map(|channel| (largest - channel.max(0.0)) / (largest + WHITE[i]));
        let sum: f64 = FIT[i].iter().zip(lacks).map(|(k, lack)| k * lack).sum();
        let sum = if sum < 0.0 { sum / (1.0 + LEAST * LEAST * sum * sum).sqrt() } else { sum };
        let exponent = libm::exp2(-sum);
        let level = largest * libm::pow((largest + SOFT) / (1.0 + SOFT), exponent - 1.0);
        level + share * (foliage::LEVELS[i] - level)
    })
}

/// The share of each level in the reflectance at a wavelength, nm, beyond the curve of the colour.
/// They add up to 1. Interpolated linearly between whole nanometres.
pub(crate) fn parts(wavelength_nm: f64) -> [f64; N_LEVELS] {
    let (low, high, part) = rows(wavelength_nm);
    std::array::from_fn(|i| low[i] + part * (high[i] - low[i]))
}

/// The reflectance there of a surface with these levels.
#[inline]
pub(crate) fn mixed(levels: &[f64; N_LEVELS], wavelength_nm: f64) -> f64 {
    let (low, high, part) = rows(wavelength_nm);
    let mix = |shares: &[f64; N_LEVELS]| -> f64 {
        (levels[0] * shares[0] + levels[1] * shares[1])
            + (levels[2] * shares[2] + levels[3] * shares[3])
    };
    let (low, high) = (mix(low), mix(high));
    low + part * (high - low)
}

/// The shares at the whole nanometres around a wavelength, and its place between them, 0 to 1.
#[inline]
fn rows(wavelength_nm: f64) -> (&'static [f64; N_LEVELS], &'static [f64; N_LEVELS], f64) {
    static ROWS: LazyLock<Vec<[f64; N_LEVELS]>> = LazyLock::new(|| {
        let last = LEVELS_NM[N_LEVELS - 1] as usize + 1;
        (FIRST_NM as usize..=last).map(|nm| shares(nm as f64)).collect()
    });
    let rows = &**ROWS;
    let at = (wavelength_nm - FIRST_NM).max(0.0);
    let row = (at as usize).min(rows.len() - 2);
    (&rows[row], &rows[row + 1], (at - row as f64).min(1.0))
}

/// The share of each level at a wavelength, nm.
fn shares(wavelength_nm: f64) -> [f64; N_LEVELS] {
    let mut shares = [0.0; N_LEVELS];
    shares[0] = 1.0;
    for next in 1..N_LEVELS {
        // What is beyond a level goes over to the next, over the logarithm of the wavelength.
        let ends = [LEVELS_NM[next - 1], LEVELS_NM[next]].map(libm::log);
        let part = smooth_step(libm::log(wavelength_nm), ends);
        shares[next] = shares[next - 1] * part;
        shares[next - 1] *= 1.0 - part;
    }
    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The medians of measured spectra of some surfaces in two bands, and by how much the fit may
    /// be off: the errors of their kinds in docs/physics.md.
    #[test]
    fn surfaces_reflect_about_what_was_measured() {
        // Linear red, green, blue; reflectance at 790-900 nm and 1500-1780 nm.
        let rows = [
            ("foliage", [0.049, 0.067, 0.017], [0.445, 0.155], 1.1),
            ("clay tile", [0.194, 0.074, 0.046], [0.249, 0.542], 1.45),
            ("asphalt", [0.103, 0.092, 0.077], [0.108, 0.139], 1.25),
            ("blue paint", [0.037, 0.078, 0.141], [0.185, 0.211], 1.55),
        ];
        for (name, rgb, measured, most) in rows {
            let [near, _, far, _] = levels(rgb);
            for (found, measured) in [near, far].into_iter().zip(measured) {
                let error = (found / measured).max(measured / found);
                assert!(error < most, "{name}: {found} {measured}");
            }
        }
    }

    #[test]
    fn greys_stay_grey_and_nothing_reflects_more_than_all() {
        for level in [0.0, 0.02, 0.5, 1.0, 3.0] {
            assert_eq!(levels([level; 3]), [level; N_LEVELS]);
        }
        for idx in 0..729 {
            let rgb = [idx % 9, idx / 9 % 9, idx / 81].map(|step| f64::from(step) / 8.0);
            assert!(levels(rgb).iter().all(|level| (0.0..=1.0).contains(level)), "{rgb:?}");
        }
        assert!(levels([-0.1, 0.5, f64::NAN]).iter().all(|level| level.is_finite()));
    }

    #[test]
    fn shares_add_up_and_join_smoothly() {
        for step in 0..4000 {
            let nm = 600.0 + 0.7 * f64::from(step);
            let levels = parts(nm);
            let (sum, next): (f64, _) = (levels.iter().sum(), parts(nm + 1.0));
            let jump = (0..N_LEVELS).map(|idx| (next[idx] - levels[idx]).abs()).fold(0.0, f64::max);
            assert!((sum - 1.0).abs() < 1e-12 && jump < 0.03, "{nm} {sum} {jump}");
            let exact = shares(nm);
            assert!((0..N_LEVELS).all(|idx| (levels[idx] - exact[idx]).abs() < 2e-4), "{nm}");
        }
        assert_eq!(parts(700.0), [1.0, 0.0, 0.0, 0.0]);
        assert_eq!(parts(845.0), [1.0, 0.0, 0.0, 0.0]);
        assert_eq!(parts(9000.0), [0.0, 0.0, 0.0, 1.0]);
    }
}
