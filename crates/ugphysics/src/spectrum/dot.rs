//! Sums of products.

/// Products that [`dot`] adds up together.
pub(crate) const DOT_GROUP: usize = 4;

/// Σ a b, in four partial sums (for SIMD), in the same order on every machine.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a_chunks, a_rest) = a.as_chunks::<DOT_GROUP>();
    let (b_chunks, b_rest) = b.as_chunks::<DOT_GROUP>();
    let mut sums = [0.0; DOT_GROUP];
    for (a, b) in a_chunks.iter().zip(b_chunks) {
        for i in 0..DOT_GROUP {
            sums[i] += a[i] * b[i];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    (sums[0] + sums[2]) + (sums[1] + sums[3]) + rest
}
