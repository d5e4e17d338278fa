//! Spectra of arbitrary surface colours as mixtures of a few, which are tabulated.
//!
//! The reflectance of a colour (P20) is found by iteration, which takes too long for every texel.
//! It depends on the ratios of the channels and, in infrared, on the largest, so a lattice is
//! enough: for each channel that may be the largest, seven levels of it, and the other two as parts
//! of it. A colour is a mixture of the three corners of the triangle of ratios that it is in, one
//! of which is taken at two levels, with the same red, green and blue at rest. A mixture of
//! reflectances is a reflectance, so it can be lit, shifted and filtered as one. Eq. (P51)

use glam::DVec3;

/// Corners of the lattice along each axis of ratios.
const N: usize = 65;

/// The levels of the largest channel. Above and below, the spectrum of a colour grows with it.
const LEVELS: [f64; 7] = [0.03, 0.055, 0.1, 0.18, 0.32, 0.57, 1.0];

/// Corners with one level.
const N_RATIOS: usize = 3 * N * N;

/// The number of corners.
pub(crate) const N_CORNERS: usize = LEVELS.len() * N_RATIOS;

/// The ratio of channels at a corner along one axis. Corners are closer together where colours are
/// saturated, and reflectances change most.
fn ratio(at: usize) -> f64 {
    let part = at as f64 / (N - 1) as f64;
    part * part
}

/// Linear red, green and blue of a corner.
pub(crate) fn corner(row: usize) -> [f64; 3] {
    let (level, row) = (LEVELS[row / N_RATIOS], row % N_RATIOS);
    let [largest, second, third] = [row / (N * N), row / N % N, row % N];
    let mut light = [level; 3];
    light[(largest + 1) % 3] *= ratio(second);
    light[(largest + 2) % 3] *= ratio(third);
    light
}

/// The corners whose mixture is a colour, with their shares. Light below 0 is none.
pub(crate) fn mixture(light: DVec3) -> [(u32, f64); 4] {
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
        return [(0, 0.0); 4];
    }
    let cell = |axis: usize| {
        let part = light[(largest + axis) % 3] / brightest;
        let at = ((part.sqrt() * (N - 1) as f64) as usize).min(N - 2);
        (at, (part - ratio(at)) / (ratio(at + 1) - ratio(at)))
    };
    let [(second, x), (third, y)] = [cell(1), cell(2)];
    let corner =
        |over: usize, behind: usize| largest * N * N + (second + over) * N + third + behind;
    let (middle, shares) = if x >= y {
        (corner(1, 0), [1.0 - x, x - y, y])
    } else {
        (corner(0, 1), [1.0 - y, y - x, x])
    };
    let corners = [corner(0, 0), middle, corner(1, 1)];
    // The first corners have the upper level, the last ones the lower, and one has both, so that
    // the shares of the levels interpolate between them.
    let low =
        LEVELS.iter().rposition(|level| *level <= brightest).unwrap_or(0).min(LEVELS.len() - 2);
    let ends = [LEVELS[low], LEVELS[low + 1]];
    let part = ((brightest - ends[0]) / (ends[1] - ends[0])).clamp(0.0, 1.0);
    let mut above = if part < 1.0 { part * ends[1] / brightest } else { 1.0 };
    let (mut mixed, mut n) = ([(0, 0.0); 4], 0);
    for (corner, share) in corners.into_iter().zip(shares) {
        let high = share.min(above);
        above -= high;
        for (upper, part) in [(1, high), (0, share - high)] {
            if part > 0.0 {
                mixed[n] =
                    (((low + upper) * N_RATIOS + corner) as u32, brightest * part / ends[upper]);
                n += 1;
            }
        }
    }
    mixed
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
            assert!(
                parts.iter().all(|&(row, share)| (row as usize) < N_CORNERS && share >= -1e-15)
            );
            let sum: DVec3 =
                parts.iter().map(|&(row, share)| share * DVec3::from(corner(row as usize))).sum();
            assert!(sum.distance(light) < 1e-14, "{light} {sum}");
        }
    }

    /// The error of X, Y, Z of a mixture in motion, relative to Y of white: 0.01 in the mean; more
    /// only in few colours far from rest, where the reflectance beyond the visible range jumps.
    #[test]
    fn mixtures_are_shifted_as_the_colour() {
        let corners: Vec<OnceCell<Spectrum>> = vec![OnceCell::new(); N_CORNERS];
        for (doppler, most) in [(0.5, 0.05), (0.85, 0.02), (1.0, 1e-9), (1.2, 0.05), (2.0, 0.3)] {
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
            assert!(mean < 1e-2 && worst < most, "D = {doppler}: {mean} {worst}");
        }
    }
}
