//! From display-encoded levels to linear light, many at once.

/// Up to here the curve is a straight line.
const KNEE: f32 = 0.040_45;

/// What (s^4.8 − 1)/(s − 1) is for 0.3 ≤ s ≤ 1, as a polynomial of (s − 0.65)/0.35, lowest power
/// first: Chebyshev's, so that the curve below is off by 3·10⁻⁹ at most, before rounding.
#[allow(clippy::excessive_precision)] // The digits of the numbers nearest to them.
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

/// Linear light of a level, 0…1, to 3·10⁻⁷; 0 and 1 exactly. IEC 61966-2-1, as
/// `ugphysics::srgb_decode`.
///
/// ((c + 0.055)/1.055)^2.4 is s^4.8 of a square root s. All of it is sums, products and a root,
/// which give the same bits on every machine, one at a time or many.
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
