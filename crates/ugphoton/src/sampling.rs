//! Places on lamps that have a size: the same for the same sample on every run.

use glam::DVec3;

/// A point of the unit disk perpendicular to `axis`, evenly distributed over samples. `lamp`: lamps
/// get independent points.
pub fn disk_point(axis: DVec3, sample: u64, lamp: u64) -> DVec3 {
    let [u, v] = square_point(sample, lamp);
    let (sin, cos) = libm::sincos(core::f64::consts::TAU * v);
    let (e1, e2) = axis.any_orthonormal_pair();
    u.sqrt() * (cos * e1 + sin * e2)
}

/// A point of the unit square, likewise.
pub fn square_point(sample: u64, lamp: u64) -> [f64; 2] {
    // The R2 sequence (M. Roberts, 2018): each sample falls between those before it.
    const STEPS: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];
    let shift = scrambled(lamp.wrapping_add(0x9e37_79b9_7f4a_7c15));
    let start =
        [(shift >> 32) as f64, (shift & 0xffff_ffff) as f64].map(|bits| bits / 4_294_967_296.0);
    // Below 2^40 the product keeps a precision of 2^-13, and pictures have fewer samples.
    [0, 1].map(|at| (start[at] + STEPS[at] * sample as f64).fract())
}

/// SplitMix64, a hash of 64 bits.
fn scrambled(seed: u64) -> u64 {
    let mut z = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
