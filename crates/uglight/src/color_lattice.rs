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
    let largest = if light.x >= light.y.max(light.z) { 0 } else { if light.y >= light.z { 1 } else { 2 } };
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

    #[test]
    fn probe() {
        use ugphysics::spectrum::Spectrum;
        let corners: Vec<Spectrum> =
            (0..N_CORNERS).map(|row| Spectrum::from_linear_srgb(corner(row))).collect();
        for doppler in [0.4, 0.5, 0.7, 0.85, 1.0, 1.2, 1.5, 2.0, 2.5] {
            let white = DVec3::from(Spectrum::from_linear_srgb([1.0; 3]).shifted(doppler));
            let (mut worst, mut sum, mut n) = (0.0_f64, 0.0, 0);
            let (mut at, mut encoded) = (DVec3::ZERO, 0.0_f64);
            for seed in 1..400 {
                let part = |factor: f64| {
                    let x = (f64::from(seed) * factor).fract();
                    ugphysics::srgb_decode(x)
                };
                let light = DVec3::new(part(0.618_034), part(0.414_214), part(0.302_776));
                let exact =
                    DVec3::from(Spectrum::from_linear_srgb(light.to_array()).shifted(doppler)) / white.y;
                let mixed: DVec3 = mixture(light)
                    .iter()
                    .filter(|p| p.1 > 0.0)
                    .map(|&(row, share)| share * DVec3::from(corners[row as usize].shifted(doppler)))
                    .sum::<DVec3>()
                    / white.y;
                let e = (exact - mixed).abs().max_element();
                if e > worst {
                    worst = e;
                    at = light;
                }
                sum += e;
                n += 1;
                encoded =
                    encoded.max((ugphysics::srgb_encode(exact.y) - ugphysics::srgb_encode(mixed.y)).abs());
            }
            println!(
                "D {doppler}: worst {worst:.4} at {at:.3}, mean {:.5}, encoded Y {encoded:.4}",
                sum / f64::from(n)
            );
        }
    }
}
