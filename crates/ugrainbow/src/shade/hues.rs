//! Conversion of hues to red, green and blue.

use fearless_simd::{Level, Simd, dispatch};
use ugraster::{RUN, ShadedRun, greater, lesser};

use super::linear;
use super::transfer::decode;

/// Light levels for red, green and blue at every sample; `None` if the light is white and its level
/// is already in the value.
pub type Lights<'a> = Option<[&'a [f32]; 3]>;

/// A colour without its value.
#[derive(Clone, Copy, Debug)]
pub struct Pure {
    /// In degrees, −60…300.
    pub hue: f32,
    /// Attenuation of the hue, 0…1; 1 is none.
    pub fade: f32,
    /// 0 grey … 1 pure.
    pub saturation: f32,
}

/// Display-encoded red, green and blue of a colour, clipped to `ceiling`, and the greatest of them
/// before clipping. `values`: the value under red, green and blue light.  Eq. (P17)
#[inline(always)] // Into loops over many samples.
pub fn encode(
    Pure { hue, fade, saturation }: Pure,
    values: [f32; 3],
    ceiling: f32,
) -> ([f32; 3], f32) {
    let pure = saturation * fade;
    let faded = (1.0 - saturation) + pure;
    let per_kept = if faded > 0.0 { 1.0 / faded } else { 0.0 };
    // Most hues are not attenuated; skipping the division avoids its rounding.
    let (kept, saturation) = if fade < 1.0 { (faded, pure * per_kept) } else { (1.0, saturation) };
    let sixth = hue * (1.0 / 60.0);
    let [red, green, blue] = values.map(|value| value * kept);
    let level = |primary: f32, bright: f32| {
        // Distance of the hue from the sixths in which the primary is full: 0 inside, 1 two sixths
        // away.
        let apart = (sixth - primary).abs();
        let away = (lesser(apart, 6.0 - apart) - 1.0).clamp(0.0, 1.0);
        (1.0 - saturation * away) * lesser(bright, ceiling)
    };
    let levels = [level(0.0, red), level(2.0, green), level(4.0, blue)];
    (levels, greater(greater(greater(0.0, red), green), blue))
}

/// True if all numbers lie between the two `ends`, inclusive.
pub fn all_between(level: Level, numbers: &[f32], ends: [f32; 2]) -> bool {
    dispatch!(level, simd => are_between(simd, numbers, ends))
}

#[inline(always)] // Compiled for the SIMD instructions of the processor.
fn are_between<S: Simd>(_: S, numbers: &[f32], [least, most]: [f32; 2]) -> bool {
    // Testing all of them is faster than stopping early.
    numbers.iter().fold(true, |all, &number| all & (least <= number) & (number <= most))
}

/// Display-encoded red, green and blue of many samples from their hues, saturations, values and
/// attenuations of the hue. Without `fades` no hue is attenuated.
pub fn encode_all(
    level: Level,
    numbers: [&[f32]; 3],
    fades: Option<&[f32]>,
    lights: Lights<'_>,
    ceiling: f32,
    run: &mut ShadedRun,
) {
    dispatch!(level, simd => encode_run(simd, numbers, fades, lights, ceiling, run));
}

/// The linear light of `n` samples that are display-encoded and clipped to `ceiling`.
pub fn decode_all(level: Level, n: usize, ceiling: f32, run: &mut ShadedRun) {
    for levels in &mut run.light {
        let levels = &mut levels[..n];
        if ceiling > 1.0 && levels.iter().any(|level| *level > 1.0) {
            levels.iter_mut().for_each(|level| *level = linear(*level));
        } else {
            dispatch!(level, simd => decode_run(simd, levels));
        }
    }
}

#[inline(always)]
fn encode_run<S: Simd>(
    _: S,
    [hues, saturations, values]: [&[f32]; 3],
    fades: Option<&[f32]>,
    lights: Lights<'_>,
    ceiling: f32,
    run: &mut ShadedRun,
) {
    let n = hues.len().min(RUN);
    let (hues, saturations, values) = (&hues[..n], &saturations[..n], &values[..n]);
    let [red, green, blue] = &mut run.light;
    let (red, green, blue) = (&mut red[..n], &mut green[..n], &mut blue[..n]);
    let intensities = &mut run.intensity[..n];
    // A constant attenuation of 1 lets the compiler drop the division.
    let bright = |i: usize| Pure { hue: hues[i], fade: 1.0, saturation: saturations[i] };
    let pure = |i: usize| fades.map_or(bright(i), |fades| Pure { fade: fades[i], ..bright(i) });
    match (fades, lights) {
        (None, None) => {
            for i in 0..n {
                ([red[i], green[i], blue[i]], intensities[i]) =
                    encode(bright(i), [values[i]; 3], ceiling);
            }
        }
        (Some(fades), None) => {
            let fades = &fades[..n];
            for i in 0..n {
                let pure = Pure { fade: fades[i], ..bright(i) };
                ([red[i], green[i], blue[i]], intensities[i]) =
                    encode(pure, [values[i]; 3], ceiling);
            }
        }
        (_, Some([reds, greens, blues])) => {
            let (reds, greens, blues) = (&reds[..n], &greens[..n], &blues[..n]);
            for i in 0..n {
                let values = [values[i] * reds[i], values[i] * greens[i], values[i] * blues[i]];
                ([red[i], green[i], blue[i]], intensities[i]) = encode(pure(i), values, ceiling);
            }
        }
    }
}

#[inline(always)]
fn decode_run<S: Simd>(_: S, levels: &mut [f32]) {
    for level in levels {
        *level = decode(*level);
    }
}
