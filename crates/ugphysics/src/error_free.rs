//! Error-free transformations: sums and products that keep their rounding error beside the result.

use glam::DVec3;

/// 1 − |β|², rounded once: its sign is correct, and its relative error is about 2⁻⁵³ however close
/// |β| is to 1.
///
/// Near the speed of light 1 − β² is a small difference of numbers near 1, so the squares must not
/// be rounded before they are added. Each square is stored as a sum of two doubles, and the seven
/// terms are added as an expansion (Shewchuk 1997, "Adaptive precision floating-point arithmetic",
/// grow-expansion).
///
/// Each component must be below 1 in absolute value.
pub(crate) fn one_minus_square(beta: DVec3) -> f64 {
    let mut expansion = [0.0; 7];
    let mut n_terms = 0;
    let mut add = |term: f64| {
        let mut carry = term;
        for slot in &mut expansion[..n_terms] {
            (carry, *slot) = two_sum(carry, *slot);
        }
        expansion[n_terms] = carry;
        n_terms += 1;
    };
    add(1.0);
    for component in beta.to_array() {
        let (square, lost) = two_square(component);
        add(-lost);
        add(-square);
    }
    // The terms do not overlap and are in increasing order. Adding from the smallest one therefore
    // leaves only the last rounding significant.
    expansion.iter().sum()
}

/// The largest power of two that is not above the largest component of `p`. Dividing by it is exact
/// and gives a vector whose squares neither overflow nor underflow.
pub(crate) fn power_of_two_below(p: DVec3) -> f64 {
    const EXPONENT_BITS: u64 = 0x7ff0_0000_0000_0000;
    let largest = p.abs().max_element();
    f64::from_bits(largest.to_bits() & EXPONENT_BITS).max(f64::MIN_POSITIVE)
}

/// `factor * v + w`, each component rounded once.
pub(crate) fn mul_add(factor: f64, v: DVec3, w: DVec3) -> DVec3 {
    DVec3::new(v.x.mul_add(factor, w.x), v.y.mul_add(factor, w.y), v.z.mul_add(factor, w.z))
}

/// a + b as (rounded sum, rounding error), exactly (Knuth's two-sum).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_part = sum - a;
    let a_part = sum - b_part;
    (sum, (a - a_part) + (b - b_part))
}

/// a² as (rounded square, rounding error), exactly.
fn two_square(a: f64) -> (f64, f64) {
    let square = a * a;
    (square, a.mul_add(a, -square))
}
