//! Where the parts of a reflectance begin and end.

/// The range of the curve of a colour, nm: constant below it, and infrared beyond.
pub(crate) const CURVE_NM: [f64; 2] = [380.0, 780.0];

/// Nanometres of that range.
pub(crate) const N_NM: usize = 401;

/// Number of infrared levels.
pub(crate) const N_LEVELS: usize = 4;

/// 0 below a range, 1 above it, 6x⁵ − 15x⁴ + 10x³ in between.
pub(crate) fn smooth_step(at: f64, [from, to]: [f64; 2]) -> f64 {
    let x = ((at - from) / (to - from)).clamp(0.0, 1.0);
    x * x * x * (10.0 + x * (6.0 * x - 15.0))
}
