//! Texels: those of a panorama as given, and those of mip levels.

use std::ops::Range;

use ugphysics::srgb_decode;

/// The texels of a panorama, row after row from the top.
#[derive(Clone, Debug, PartialEq)]
pub enum Texels {
    /// Display-encoded sRGB, and alpha.
    Srgb(Vec<[u8; 4]>),
    /// Linear light, white is 1, and alpha from 0 to 1. Colours are not multiplied by alpha. NaN
    /// counts as 0, and infinite light as the largest number.
    Light(Vec<[f32; 4]>),
}

impl Texels {
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Srgb(texels) => texels.len(),
            Self::Light(texels) => texels.len(),
        }
    }
}

/// Limits the channels as [`Texels::Light`] says, and multiplies colours by alpha.
pub(crate) fn premultiply(texel: &mut [f32; 4]) {
    let finite = |part: f32| if part.is_nan() { 0.0 } else { part.clamp(-f32::MAX, f32::MAX) };
    let alpha = finite(texel[3]).clamp(0.0, 1.0);
    let [red, green, blue, _] = *texel;
    *texel = [alpha * finite(red), alpha * finite(green), alpha * finite(blue), alpha];
}

/// Bytes.
const CACHE_LINE: usize = 64;

/// Light of 8-bit colours.
pub(crate) struct Decoder(Box<[f32; 256]>);

impl Decoder {
    pub fn new() -> Self {
        Self(Box::new(std::array::from_fn(|level| srgb_decode(level as f64 / 255.0) as f32)))
    }

    /// Light times alpha, and alpha.
    #[inline(always)]
    pub fn light(&self, [red, green, blue, alpha]: [u8; 4]) -> [f32; 4] {
        let [red, green, blue] = [red, green, blue].map(|level| self.0[usize::from(level)]);
        if alpha == 255 {
            return [red, green, blue, 1.0];
        }
        let alpha = f32::from(alpha) / 255.0;
        [alpha * red, alpha * green, alpha * blue, alpha]
    }

    /// As [`RowTexels::copy_to`].
    fn copy_to(&self, texels: &[[u8; 4]], [reds, greens, blues, alphas]: [&mut [f32]; 4]) -> bool {
        let places = reds.iter_mut().zip(&mut *greens).zip(&mut *blues);
        for (((red, green), blue), texel) in places.zip(texels) {
            *red = self.0[usize::from(texel[0])];
            *green = self.0[usize::from(texel[1])];
            *blue = self.0[usize::from(texel[2])];
        }
        let is_opaque = texels.iter().fold(255, |all, texel| all & texel[3]) == 255;
        if is_opaque {
            alphas.fill(1.0);
        } else {
            for (idx, &texel) in texels.iter().enumerate() {
                [reds[idx], greens[idx], blues[idx], alphas[idx]] = self.light(texel);
            }
        }
        is_opaque
    }
}

/// Texels as linear light, each channel apart: red, green and blue times alpha, and alpha.
pub(crate) struct Planes {
    n: usize,
    /// The channels one after the other. There is no alpha if all are opaque.
    values: Box<[f32]>,
}

impl Planes {
    pub fn new(channels: [&[f32]; 4], is_opaque: bool) -> Self {
        let n_channels = if is_opaque { 3 } else { 4 };
        Self { n: channels[0].len(), values: channels[..n_channels].concat().into() }
    }

    fn is_opaque(&self) -> bool {
        self.values.len() == 3 * self.n
    }

    #[inline(always)]
    fn channel(&self, idx: usize) -> &[f32] {
        &self.values[idx * self.n..][..self.n]
    }
}

/// Consecutive texels of a row.
#[derive(Clone)]
pub(crate) enum RowTexels<'a> {
    Srgb(&'a [[u8; 4]], &'a Decoder),
    Light(&'a [[f32; 4]]),
    Planes(&'a Planes, Range<usize>),
}

impl RowTexels<'_> {
    /// Number of texels.
    pub fn len(&self) -> usize {
        match self {
            Self::Srgb(texels, _) => texels.len(),
            Self::Light(texels) => texels.len(),
            Self::Planes(_, range) => range.len(),
        }
    }

    /// Sets as many values of each channel: red, green and blue times alpha, and alpha. True if all
    /// texels are opaque.
    pub fn copy_to(&self, channels: [&mut [f32]; 4]) -> bool {
        match self {
            Self::Srgb(texels, decoder) => decoder.copy_to(texels, channels),
            Self::Light(texels) => {
                for (channel, values) in channels.into_iter().enumerate() {
                    for (value, texel) in values.iter_mut().zip(*texels) {
                        *value = texel[channel];
                    }
                }
                texels.iter().all(|texel| texel[3] == 1.0)
            }
            Self::Planes(planes, range) => {
                for (channel, values) in channels.into_iter().enumerate() {
                    match channel {
                        3 if planes.is_opaque() => values.fill(1.0),
                        _ => values.copy_from_slice(&planes.channel(channel)[range.clone()]),
                    }
                }
                planes.is_opaque()
            }
        }
    }

    /// Reads something of each of their cache lines.
    #[inline(always)]
    pub fn load(&self) -> u32 {
        match self {
            Self::Srgb(texels, _) => {
                texels.iter().step_by(CACHE_LINE / 4).map(|texel| u32::from(texel[0])).sum()
            }
            Self::Light(texels) => {
                texels.iter().step_by(CACHE_LINE / 16).map(|texel| texel[0].to_bits() & 1).sum()
            }
            Self::Planes(..) => 0,
        }
    }

    /// A texel: light times alpha, and alpha.
    #[inline]
    pub fn get(&self, idx: usize) -> [f32; 4] {
        match self {
            Self::Srgb(texels, decoder) => decoder.light(texels[idx]),
            Self::Light(texels) => texels[idx],
            Self::Planes(planes, range) => {
                let at = range.start + idx;
                let alpha = if planes.is_opaque() { 1.0 } else { planes.channel(3)[at] };
                [planes.channel(0)[at], planes.channel(1)[at], planes.channel(2)[at], alpha]
            }
        }
    }
}
