//! Spectra of arbitrary surface colours as mixtures of a few, which are tabulated.
//!
//! The reflectance of a colour (P20) is found by iteration, which takes too long for every texel.
//! Colours with the same ratios of channels differ by a factor, so a lattice of ratios is enough:
//! for each channel that may be the largest, the other two as parts of it. A colour is a mixture of
//! the three corners of the triangle that it is in, with the same red, green and blue at rest. A
//! mixture of reflectances is a reflectance, so it can be lit, shifted and filtered as one. Eq. (P51)

use glam::DVec3;

/// Corners of the lattice along each axis.
const N: usize = 65;

/// The number of corners.
pub(crate) const N_CORNERS: usize = 3 * N * N;

/// The ratio of channels at a corner along one axis. Corners are closer together where colours are
/// saturated, and reflectances change most.
fn level(at: usize) -> f64 {
    let part = at as f64 / (N - 1) as f64;
    part * part
}

/// Linear red, green and blue of a corner.
pub(crate) fn corner(row: usize) -> [f64; 3] {
    let [largest, second, third] = [row / (N * N), row / N % N, row % N];
    let mut light = [1.0; 3];
    light[(largest + 1) % 3] = level(second);
    light[(largest + 2) % 3] = level(third);
    light
}

/// The corners whose mixture is a colour, with their shares, which add up to its largest channel.
/// Light below 0 is none.
pub(crate) fn mixture(light: DVec3) -> [(u32, f64); 3] {
    let light = light.clamp(DVec3::ZERO, DVec3::splat(ugphysics::MOST_LIGHT));
    let largest = if light.x >= light.y.max(light.z) {
        0
    } else if light.y >= light.z {
        1
    } else {
        2
    };
    let brightest = light[largest];
    if brightest == 0.0 {
        return [(0, 0.0); 3];
    }
    let cell = |axis: usize| {
        let ratio = light[(largest + axis) % 3] / brightest;
        let at = ((ratio.sqrt() * (N - 1) as f64) as usize).min(N - 2);
        (at, (ratio - level(at)) / (level(at + 1) - level(at)))
    };
    let [(second, x), (third, y)] = [cell(1), cell(2)];
    let corner = |over: usize, behind: usize| (largest * N * N + (second + over) * N + third + behind) as u32;
    let (middle, shares) =
        if x >= y { (corner(1, 0), [1.0 - x, x - y, y]) } else { (corner(0, 1), [1.0 - y, y - x, x]) };
    let corners = [corner(0, 0), middle, corner(1, 1)];
    std::array::from_fn(|at| (corners[at], brightest * shares[at]))
}

#[cfg(test)]
mod tests {
    use std::cell::OnceCell;

    use ugphysics::spectrum::Spectrum;

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

    /// The error of X, Y, Z of a mixture in motion, relative to Y of white: 0.001 in the mean; more
    /// only in few colours far from rest, where the reflectance beyond the visible range jumps.
    #[test]
    fn mixtures_are_shifted_as_the_colour() {
        let corners: Vec<OnceCell<Spectrum>> = vec![OnceCell::new(); N_CORNERS];
        for (doppler, most) in [(0.5, 0.05), (0.85, 0.02), (1.0, 1e-9), (1.2, 0.03), (2.0, 0.3)] {
            let [_, white, _] = Spectrum::from_linear_srgb([1.0; 3]).shifted(doppler);
            let seen = |spectrum: &Spectrum| DVec3::from(spectrum.shifted(doppler)) / white;
            let mut errors = Vec::new();
            for seed in 1..200 {
                let part = |factor: f64| ugphysics::srgb_decode((f64::from(seed) * factor).fract());
                let light = DVec3::new(part(0.618_034), part(0.414_214), part(0.302_776));
                let of_corner = |&(row, share): &(u32, f64)| {
                    let spectrum = || Spectrum::from_linear_srgb(corner(row as usize));
                    share * seen(corners[row as usize].get_or_init(spectrum))
                };
                let mixed: DVec3 = mixture(light).iter().map(of_corner).sum();
                let exact = seen(&Spectrum::from_linear_srgb(light.to_array()));
                errors.push((mixed - exact).abs().max_element());
            }
            let (mean, worst) =
                (errors.iter().sum::<f64>() / 199.0, errors.iter().copied().fold(0.0, f64::max));
            assert!(mean < 1e-3 && worst < most, "D = {doppler}: {mean} {worst}");
        }
    }
}
