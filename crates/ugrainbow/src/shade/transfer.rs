//! Conversion of display-encoded levels to linear light, many at once.

/// Up to here the transfer function is linear.
const KNEE: f32 = 0.040_45;

/// (s^4.8 − 1)/(s − 1) for 0.3 ≤ s ≤ 1 as a Chebyshev approximation in powers of (s − 0.65)/0.35,
/// lowest first. The error of [`decode`] is then at most 3·10⁻⁹ before rounding.
#[allow(clippy::excessive_precision)] // All digits of the nearest single-precision numbers.
const CURVE: [f32; 8] = [
    2.495_802_9,
    1.561_877_8,
    0.606_400_67,
    0.126_211_99,
    0.009_859_236,
    -0.000_164_303_97,
    0.000_014_538_618,
    -0.000_003_156_663_3,
];

/// Linear light of a level in 0…1, to 3·10⁻⁷; exact at 0 and 1. IEC 61966-2-1, as
/// `ugphysics::srgb_decode`.
///
/// ((c + 0.055)/1.055)^2.4 = s^4.8 with a square root s. Only sums, products and a square root are
/// used, so the bits are the same on every machine, with and without SIMD.
#[inline(always)]
pub fn decode(level: f32) -> f32 {
    let root = (1.0 + (level - 1.0) * (1.0 / 1.055)).max(0.0).sqrt();
    let place = (root - 0.65) * (1.0 / 0.35);
    let mut slope = CURVE[7];
    let mut power = 7;
    while power > 0 {
        power -= 1;
        slope = slope * place + CURVE[power];
    }
    let curve = 1.0 + (root - 1.0) * slope;
    if level <= KNEE { level * (1.0 / 12.92) } else { curve }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ugphysics::srgb_decode;

    #[test]
    fn follows_the_curve() {
        let n_steps = 100_000;
        let mut before = 0.0;
        for step in 0..=n_steps {
            let level = step as f32 / n_steps as f32;
            let (ours, exact) = (decode(level), srgb_decode(f64::from(level)));
            assert!((f64::from(ours) - exact).abs() < 3e-7, "{level}: {ours} {exact}");
            assert!(ours >= before, "{level}");
            before = ours;
        }
        assert_eq!([decode(0.0), decode(1.0)], [0.0, 1.0]);
    }
}
