//! The coordinates of boxes: a mesh moved and scaled to the cube |x|, |y|, |z| ≤ 1.

/// Greatest valid coordinate, 2¹⁰⁰⁰. Differences of two, scaled by [`Frame::scale`], are finite.
pub const MAX_COORDINATE: f64 = power_of_two(1000);

/// Box coordinates are (p − centre) × scale.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    pub center: [f64; 3],
    /// A power of two.
    pub scale: f64,
    /// 1 / scale.
    pub unit: f64,
}

impl Frame {
    /// The frame in which the greatest half extent of the bounds is in ½…1, or less for a mesh
    /// smaller than 2⁻¹⁰⁰⁰, for which no scale exists.
    pub fn new(low: [f64; 3], high: [f64; 3]) -> Self {
        let center = std::array::from_fn(|axis| low[axis] / 2.0 + high[axis] / 2.0);
        // Rounding of the centre makes the halves unequal by one unit in the last place at most.
        let half = (0..3)
            .map(|axis: usize| (high[axis] - center[axis]).max(center[axis] - low[axis]))
            .fold(0.0, f64::max);
        let exponent = -(exponent(half) + 1).clamp(-1000, 1001);
        Self { center, scale: power_of_two(exponent), unit: power_of_two(-exponent) }
    }

    #[inline(always)]
    pub fn to_box(self, position: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|axis| (position[axis] - self.center[axis]) * self.scale)
    }
}

/// 2ⁿ for −1022 ≤ n ≤ 1023.
pub const fn power_of_two(n: i64) -> f64 {
    f64::from_bits(((n + 1023) as u64) << 52)
}

/// The n for which 2ⁿ ≤ |number| < 2ⁿ⁺¹; −1023 for subnormal numbers and 0.
pub fn exponent(number: f64) -> i64 {
    ((number.to_bits() >> 52) & 0x7ff) as i64 - 1023
}
