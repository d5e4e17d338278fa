//! What is interpolated between the corners of a face, as packed numbers for the rasterizer.
//!
//! The fewest numbers that a scene needs are interpolated:
//!
//! | layout | scene | numbers |
//! | --- | --- | --- |
//! | plain | hues under white light | tint, saturation, value × level |
//! | coloured | hues under coloured lights | tint, saturation, value; level of red, green, blue |
//! | mixed | some colours given as light | as plain, then 0; or lit linear red, green, blue, then 1 |
//! | mixed coloured | both | as coloured, then 0; or lit linear red, green, blue, 1, 1, 1, then 1 |
//! | transparent | translucent faces, lines | as mixed coloured, then the translucency |

use glam::DVec3;

use crate::palette::Swatch;
use crate::shade::Shader;
use ugraster::{ShadedSample, TRANSPARENT_VALUES};

/// Packs a colour and the level of red, green and blue light on it.
pub type Pack<const N: usize> = fn(&Swatch, DVec3) -> [f64; N];

/// The interpolated colour of a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Interpolated {
    /// Given as light: linear red, green, blue, lit.
    Light([f64; 3]),
    /// Given as a hue or wavelength.
    Hue {
        /// Hue or wavelength, saturation, and value.
        color: [f64; 3],
        /// Level of red, green and blue light; `None` if it has been multiplied into the value.
        level: Option<[f64; 3]>,
    },
}

/// The meaning of the numbers of an opaque sample; their count tells the layout.
pub fn unpack(numbers: &[f32]) -> Interpolated {
    let at = |idx: usize| f64::from(numbers[idx]);
    let is_mixed = matches!(numbers.len(), 4 | 7);
    if is_mixed && at(numbers.len() - 1) > 0.5 {
        return Interpolated::Light([at(0), at(1), at(2)]);
    }
    let level = (numbers.len() >= 6).then(|| [at(3), at(4), at(5)]);
    Interpolated::Hue { color: [at(0), at(1), at(2)], level }
}

/// White light of one level goes into the value.
pub fn pack_plain(swatch: &Swatch, level: DVec3) -> [f64; 3] {
    [swatch.tint, swatch.saturation, swatch.value * level.x]
}

/// Coloured light is interpolated beside the colour.
pub fn pack_colored(swatch: &Swatch, level: DVec3) -> [f64; 6] {
    [swatch.tint, swatch.saturation, swatch.value, level.x, level.y, level.z]
}

/// White light, and some colours given as light.
pub fn pack_mixed(swatch: &Swatch, level: DVec3) -> [f64; 4] {
    match swatch.light {
        Some(light) => {
            let [red, green, blue] = (light * level).to_array();
            [red, green, blue, 1.0]
        }
        None => {
            let [tint, saturation, value] = pack_plain(swatch, level);
            [tint, saturation, value, 0.0]
        }
    }
}

/// Coloured light, and some colours given as light.
pub fn pack_mixed_colored(swatch: &Swatch, level: DVec3) -> [f64; 7] {
    match swatch.light {
        Some(light) => {
            let [red, green, blue] = (light * level).to_array();
            [red, green, blue, 1.0, 1.0, 1.0, 1.0]
        }
        None => {
            let [tint, saturation, value, red, green, blue] = pack_colored(swatch, level);
            [tint, saturation, value, red, green, blue, 0.0]
        }
    }
}

/// One layout for translucent faces and lines of every scene.
pub fn pack_transparent(swatch: &Swatch, level: DVec3) -> [f64; TRANSPARENT_VALUES] {
    let [a, b, c, d, e, f, g] = pack_mixed_colored(swatch, level);
    [a, b, c, d, e, f, g, swatch.translucency]
}

/// Light of the numbers of [`pack_transparent`], and the part of the light from behind that is
/// transmitted.
pub fn shade_transparent(
    shader: &Shader,
    &[a, b, c, d, e, f, g, transmitted]: &[f32; TRANSPARENT_VALUES],
) -> (ShadedSample, f32) {
    (shader.mixed_colored(&[a, b, c, d, e, f, g]), transmitted.clamp(0.0, 1.0))
}
