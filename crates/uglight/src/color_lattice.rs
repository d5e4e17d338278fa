//! Spectra of arbitrary surface colours as mixtures of a few, which are tabulated.
//!
//! The reflectance of a colour (P20) is found by iteration, which takes too long for every texel. So
//! the cube of linear red, green and blue is divided by a lattice, and a colour is a mixture of the
//! four corners of the tetrahedron that it is in, with the same red, green and blue at rest. A mixture
//! of reflectances is a reflectance, so it can be lit, shifted and filtered as one. Eq. (P51)

use glam::DVec3;

/// Corners of the lattice along each axis. They are closer together in the dark, where
/// reflectances change most.
const N: usize = 13;

/// The number of corners.
pub(crate) const N_CORNERS: usize = N * N * N;

/// Linear light of a corner along one axis.
fn level(at: usize) -> f64 {
    let part = at as f64 / (N - 1) as f64;
    part * part
}

/// Linear red, green and blue of a corner.
pub(crate) fn corner(row: usize) -> [f64; 3] {
    [row / (N * N), row / N % N, row % N].map(level)
}

/// The corners whose mixture is a colour, with their shares. Light brighter than 1 has shares that
/// add up to more than 1; light below 0 is none.
pub(crate) fn mixture(light: DVec3) -> [(u32, f64); 4] {
    let brightest = light.max_element().clamp(1.0, ugphysics::MOST_LIGHT);
    let mut base = 0;
    let mut axes = [(0.0, 0); 3];
    for (axis, stride) in [N * N, N, 1].into_iter().enumerate() {
        let channel = (light[axis] / brightest).clamp(0.0, 1.0);
        let at = ((channel.sqrt() * (N - 1) as f64) as usize).min(N - 2);
        base += at * stride;
        axes[axis] = ((channel - level(at)) / (level(at + 1) - level(at)), stride);
    }
    axes.sort_by(|a, b| b.0.total_cmp(&a.0));
    let [(first, one), (second, two), (third, three)] = axes;
    let corners = [base, base + one, base + one + two, base + one + two + three];
    let shares = [1.0 - first, first - second, second - third, third];
    std::array::from_fn(|at| (corners[at] as u32, brightest * shares[at]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mixtures_are_the_colour_at_rest() {
        for seed in 0..500 {
            let part = |factor: f64| 1.2 * (f64::from(seed) * factor).fract();
            let light = DVec3::new(part(0.618_034), part(0.414_214), part(0.302_776));
            let parts = mixture(light);
            assert!(parts.iter().all(|&(row, share)| (row as usize) < N_CORNERS && share >= -1e-15));
            let sum: DVec3 =
                parts.iter().map(|&(row, share)| share * DVec3::from(corner(row as usize))).sum();
            assert!(sum.distance(light) < 1e-14, "{light} {sum}");
        }
    }
}
