//! The illuminant of surface colours: D65 in the visible range, a black body outside.

use std::sync::LazyLock;

use crate::spectrum::blackbody::planck;

/// Temperature of the black body that continues daylight, kelvins: the correlated colour
/// temperature of D65.
pub const DAYLIGHT_KELVIN: f64 = 6504.0;

const FIRST_NM: f64 = 380.0;
const LAST_NM: f64 = 780.0;
const STEP_NM: f64 = 5.0;

/// The illuminant of surface colours at a wavelength in nm: relative spectral power, 1 at 560 nm.
/// Eq. (P20)
///
/// CIE standard illuminant D65 from 380 to 780 nm, interpolated linearly between its values every 5
/// nm. Outside, where Doppler-shifted visible light comes from, Planck's law at 6504 K, scaled at
/// each end to be continuous with the table. This is sunlight above the atmosphere, which would
/// absorb the ultraviolet.
///
/// ```
/// use ugphysics::spectrum::daylight;
///
/// assert_eq!(daylight(560.0), 1.0);
/// assert!((daylight(379.999) - daylight(380.001)).abs() < 1e-5);
/// ```
pub fn daylight(wavelength_nm: f64) -> f64 {
    static JOINTS: LazyLock<[f64; 2]> = LazyLock::new(|| [FIRST_NM, LAST_NM].map(black_body));
    // Planck's law, scaled to the table's value at each end.
    if wavelength_nm < FIRST_NM {
        return D65[0] / 100.0 * (black_body(wavelength_nm) / JOINTS[0]);
    }
    if wavelength_nm > LAST_NM {
        return D65[D65.len() - 1] / 100.0 * (black_body(wavelength_nm) / JOINTS[1]);
    }
    let at = (wavelength_nm - FIRST_NM) / STEP_NM;
    // NaN is cast to row 0; the interpolation then gives NaN.
    let row = (at as usize).min(D65.len() - 2);
    (D65[row] + (at - row as f64) * (D65[row + 1] - D65[row])) / 100.0
}

fn black_body(wavelength_nm: f64) -> f64 {
    planck(wavelength_nm, DAYLIGHT_KELVIN)
}

/// CIE standard illuminant D65, every 5 nm from 380 to 780 nm (ISO/CIE 11664-2), 100 at 560 nm.
#[rustfmt::skip]
const D65: [f64; 81] = [
    49.9755, 52.3118, 54.6482, 68.7015, 82.7549, 87.1204, 91.486, 92.4589, 93.4318, 90.057, 86.6823,
    95.7736, 104.865, 110.936, 117.008, 117.41, 117.812, 116.336, 114.861, 115.392, 115.923, 112.367,
    108.811, 109.082, 109.354, 108.578, 107.802, 106.296, 104.79, 106.239, 107.689, 106.047, 104.405,
    104.225, 104.046, 102.023, 100.0, 98.1671, 96.3342, 96.0611, 95.788, 92.2368, 88.6856, 89.3459, 90.0062,
    89.8026, 89.5991, 88.6489, 87.6987, 85.4936, 83.2886, 83.4939, 83.6992, 81.863, 80.0268, 80.1207,
    80.2146, 81.2462, 82.2778, 80.281, 78.2842, 74.0027, 69.7213, 70.6652, 71.6091, 72.979, 74.349, 67.9765,
    61.604, 65.7448, 69.8856, 72.4863, 75.087, 69.3398, 63.5927, 55.0054, 46.4182, 56.6118, 66.8054,
    65.0941, 63.3828,
];
