//! The hue model of 1988 for sixteen pixels at once, in single precision.

use std::sync::LazyLock;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, i32x16};
use ugphysics::{Brightness, RED_END_NM, VIOLET_END_NM, hue_to_wavelength, wavelength_to_hue};

use crate::sample::Seen;
use crate::transfer::{decode, encode};

/// Pixels in one SIMD vector.
const N: usize = Seen::N;

/// Tables for the hue model of 1988.
pub struct Hues {
    /// Wavelengths by hue, and hues by wavelength.  Eq. (P16)
    nm: Table,
    hue: Table,
}

static HUES: LazyLock<Hues> = LazyLock::new(|| Hues {
    nm: Table::new([-60.0, 300.0], hue_to_wavelength),
    hue: Table::new([VIOLET_END_NM, RED_END_NM], wavelength_to_hue),
});

impl Hues {
    pub fn get() -> &'static Self {
        &HUES
    }

    /// Linear red, green and blue at rest as seen with a Doppler factor, by the hue model of
    /// 1988. A picture shows hues near the ends of the visible range dimmed, so their pure part
    /// is first divided by that attenuation, as far as channels stay below 1. Display-encoded
    /// values of the result are at most `most`.  Eq. (P11), (P12), (P17)
    #[inline(always)]
    pub fn seen<S: Simd>(
        &self,
        simd: S,
        (is_shifted, law): (bool, Brightness),
        most: f32,
        [red, green, blue]: [f32x16<S>; 3],
        doppler: f32x16<S>,
    ) -> [f32x16<S>; 3] {
        let number = |x: f32| f32x16::splat(simd, x);
        let (zero, one) = (number(0.0), number(1.0));
        let (red, green, blue) = (encode(simd, red), encode(simd, green), encode(simd, blue));
        let factor = match law {
            Brightness::Report => doppler,
            Brightness::Photon => doppler * doppler * doppler,
            Brightness::Bolometric => doppler * doppler * (doppler * doppler),
            Brightness::None => one,
        };
        // The factor of display-encoded values.
        let (gain, of_light) =
            if law.acts_on_light() { (one, Some(factor)) } else { (factor, None) };

        // A colour is a sum of white and of a pure hue.
        let value = red.max(green).max(blue);
        let white = red.min(green).min(blue);
        let pure = value - white;
        let keeps_wavelength = pure.simd_le(zero) | (doppler - one).abs().simd_le(number(ROUNDING));
        if !is_shifted || keeps_wavelength.all_true() {
            let (red, green, blue) = (red * gain, green * gain, blue * gain);
            return decoded(simd, most, of_light, [red, green, blue]);
        }
        let sixth = number(60.0) / pure;
        let of_green = number(120.0) + sixth * (blue - red);
        let of_blue = number(240.0) + sixth * (red - green);
        let hue = value.simd_eq(green).select(of_green, of_blue);
        let hue = value.simd_eq(red).select(sixth * (green - blue), hue);
        // Magenta is the violet end of the range, not the red one.
        let hue = hue.simd_le(number(-60.0)).select(hue + number(360.0), hue);

        let rest_nm = self.nm.at(simd, hue);
        let most_pure = (value.max(one) - white).max(pure);
        let pure_seen = (pure / attenuation(simd, rest_nm)).min(most_pure);
        let seen_nm = rest_nm / doppler;
        let seen_hue = self.hue.at(simd, seen_nm);
        let pure_seen = pure_seen * attenuation(simd, seen_nm) * gain;

        let white = white * gain;
        let sixth = seen_hue * number(1.0 / 60.0);
        let sixth = sixth.simd_lt(zero).select(sixth + number(6.0), sixth);
        let (at_red, at_green, at_blue) =
            (part(simd, sixth, 0.0), part(simd, sixth, 2.0), part(simd, sixth, 4.0));
        let shifted_red = white + pure_seen * at_red;
        let shifted_green = white + pure_seen * at_green;
        let shifted_blue = white + pure_seen * at_blue;
        let red = keeps_wavelength.select(red * gain, shifted_red);
        let green = keeps_wavelength.select(green * gain, shifted_green);
        let blue = keeps_wavelength.select(blue * gain, shifted_blue);
        decoded(simd, most, of_light, [red, green, blue])
    }
}

/// Linear light of display-encoded channels, which are at most `most`, 1 or infinite. With a factor
/// of linear light, its product is at most `most`.
#[inline(always)]
fn decoded<S: Simd>(
    simd: S,
    most: f32,
    factor: Option<f32x16<S>>,
    [red, green, blue]: [f32x16<S>; 3],
) -> [f32x16<S>; 3] {
    let most = f32x16::splat(simd, most);
    // No closure, which would be compiled apart, without the instructions of `S`.
    let Some(factor) = factor else {
        let (red, green, blue) = (red.min(most), green.min(most), blue.min(most));
        return [decode(simd, red), decode(simd, green), decode(simd, blue)];
    };
    let (red, green, blue) = (decode(simd, red), decode(simd, green), decode(simd, blue));
    [(factor * red).min(most), (factor * green).min(most), (factor * blue).min(most)]
}

/// The part of a pure hue in a primary colour: 1 within 60° of its hue, falling linearly to 0 at
/// 120°. Both are in units of 60°.
#[inline(always)]
fn part<S: Simd>(simd: S, hue: f32x16<S>, primary: f32) -> f32x16<S> {
    let number = |x: f32| f32x16::splat(simd, x);
    let apart = (hue - number(primary)).abs();
    (number(2.0) - apart.min(number(6.0) - apart)).max(number(0.0)).min(number(1.0))
}

/// As [`ugphysics::attenuation`].  Eq. (P17)
#[inline(always)]
fn attenuation<S: Simd>(simd: S, nm: f32x16<S>) -> f32x16<S> {
    let number = |x: f32| f32x16::splat(simd, x);
    let violet = (nm - number(VIOLET_END_NM as f32)) * number(1.0 / (435.8 - VIOLET_END_NM as f32));
    let red = (number(RED_END_NM as f32) - nm) * number(1.0 / (RED_END_NM as f32 - 700.0));
    violet.min(red).max(number(0.0)).min(number(1.0))
}

/// Rounding error of a Doppler factor of 1 in single precision. Magentas are no wavelengths, so
/// they would change with it.
const ROUNDING: f32 = 1e-6;

/// Cells of a [`Table`].
const CELLS: usize = 4096;

/// A function in a range, with linear interpolation between points. Arguments outside of it count
/// as its ends.
struct Table {
    first: f32,
    per_unit: f32,
    points: Box<[f32; CELLS + 1]>,
}

impl Table {
    fn new([first, last]: [f64; 2], function: impl Fn(f64) -> f64) -> Self {
        let step = (last - first) / CELLS as f64;
        let points =
            Box::new(std::array::from_fn(|idx| function(first + step * idx as f64) as f32));
        Self { first: first as f32, per_unit: (1.0 / step) as f32, points }
    }

    #[inline(always)]
    fn at<S: Simd>(&self, simd: S, x: f32x16<S>) -> f32x16<S> {
        let place = (x - f32x16::splat(simd, self.first)) * f32x16::splat(simd, self.per_unit);
        // NaN, the hue of greys, becomes a number too.
        let place = place.max(f32x16::splat(simd, 0.0)).min(f32x16::splat(simd, CELLS as f32));
        let cell = place.min(f32x16::splat(simd, (CELLS - 1) as f32)).floor();
        let cells: [i32; N] = cell.to_int::<i32x16<S>>().into();
        let (mut low, mut high) = ([0.0; N], [0.0; N]);
        for k in 0..N {
            let cell = (cells[k] as usize).min(CELLS - 1);
            (low[k], high[k]) = (self.points[cell], self.points[cell + 1]);
        }
        interpolated(simd, &low, &high, place - cell)
    }
}

#[inline(always)]
fn interpolated<S: Simd>(simd: S, low: &[f32; N], high: &[f32; N], part: f32x16<S>) -> f32x16<S> {
    let low = f32x16::from_slice(simd, low);
    low + (f32x16::from_slice(simd, high) - low) * part
}
