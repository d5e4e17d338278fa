//! The sRGB transfer function of sixteen numbers at once, in single precision.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, u32x16};

/// Larger arguments count as this.
const MOST: f32 = (1 << 20) as f32;

/// Display-encoded values of linear light, as [`ugphysics::srgb_encode`] with relative errors below
/// 5·10⁻⁶. Light below 0 and NaN are 0, and light above 2²⁰ counts as that.
#[inline(always)]
pub fn encode<S: Simd>(simd: S, light: f32x16<S>) -> f32x16<S> {
    let number = |x: f32| f32x16::splat(simd, x);
    let light = limited(simd, light);
    let curve = number(1.055) * power(simd, light, 1.0 / 2.4) - number(0.055);
    light.simd_le(number(0.003_130_8)).select(light * number(12.92), curve)
}

/// Linear light of display-encoded values, as [`ugphysics::srgb_decode`] with relative errors below
/// 5·10⁻⁶. Values below 0 and NaN are 0, and those above 2²⁰ count as that.
#[inline(always)]
pub fn decode<S: Simd>(simd: S, encoded: f32x16<S>) -> f32x16<S> {
    let number = |x: f32| f32x16::splat(simd, x);
    let encoded = limited(simd, encoded);
    let curve = power(simd, (encoded + number(0.055)) * number(1.0 / 1.055), 2.4);
    encoded.simd_le(number(0.040_45)).select(encoded * number(1.0 / 12.92), curve)
}

/// NaN becomes 0.
#[inline(always)]
fn limited<S: Simd>(simd: S, x: f32x16<S>) -> f32x16<S> {
    let zero = f32x16::splat(simd, 0.0);
    x.simd_gt(zero).select(x, zero).min(f32x16::splat(simd, MOST))
}

/// A power of numbers from 10⁻³ to 10⁷. The result must be a normal number.
#[inline(always)]
fn power<S: Simd>(simd: S, x: f32x16<S>, exponent: f32) -> f32x16<S> {
    exp2(simd, log2(simd, x) * f32x16::splat(simd, exponent))
}

/// Bits of 1.
const ONE: u32 = 127 << MANTISSA;

/// Bits of √½.
const ROOT_HALF: u32 = 0x3f35_04f3;

/// Bits of a mantissa.
const MANTISSA: u32 = 23;

/// The binary logarithm of positive normal numbers.
#[inline(always)]
fn log2<S: Simd>(simd: S, x: f32x16<S>) -> f32x16<S> {
    let number = |x: f32| f32x16::splat(simd, x);
    // x = m 2ᵉ with m between √½ and √2.
    let bits: u32x16<S> = x.bitcast();
    let biased = (bits + u32x16::splat(simd, ONE - ROOT_HALF)) >> MANTISSA;
    let mantissa: f32x16<S> = (bits + u32x16::splat(simd, ONE) - (biased << MANTISSA)).bitcast();
    let biased: f32x16<S> = biased.to_float();
    // ln m = 2 artanh s.
    let s = (mantissa - number(1.0)) / (mantissa + number(1.0));
    let square = s * s;
    let series = number(1.0 / 5.0) + square * number(1.0 / 7.0);
    let series = number(1.0 / 3.0) + square * series;
    let series = number(1.0) + square * series;
    (biased - number(127.0)) + number(2.0 * core::f32::consts::LOG2_E) * s * series
}

/// The power of 2 of numbers from −126 to 127.
#[inline(always)]
fn exp2<S: Simd>(simd: S, x: f32x16<S>) -> f32x16<S> {
    let number = |x: f32| f32x16::splat(simd, x);
    // Adding 1.5·2²³ rounds to the nearest integer, which is then in the low bits.
    let shift = number((3 << (MANTISSA - 1)) as f32);
    let shifted = x + shift;
    let part = x - (shifted - shift);
    let bits: u32x16<S> = shifted.bitcast();
    let scale: f32x16<S> = ((bits << MANTISSA) + u32x16::splat(simd, ONE)).bitcast();
    // The series of exp(x ln 2).
    let series = number(1.333_355_8e-3) + part * number(1.540_353e-4);
    let series = number(9.618_129e-3) + part * series;
    let series = number(0.055_504_11) + part * series;
    let series = number(0.240_226_5) + part * series;
    let series = number(core::f32::consts::LN_2) + part * series;
    scale * (number(1.0) + part * series)
}
