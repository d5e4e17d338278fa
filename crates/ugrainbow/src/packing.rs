//! The values that are interpolated between the corners of a face, packed as an array for the
//! rasterizer.
//!
//! The fewest interpolants that a scene needs are used:
//!
//! | numbers | scene | in this order |
//! | ---: | --- | --- |
//! | 3 | hues under white light | tint, saturation, value × level |
//! | 4 | some colours given as light | as above, then 0; or lit linear red, green, blue, then 1 |
//! | 6 | hues under coloured lights, or with levels of linear light | tint, saturation, value; level of red, green, blue |
//! | 7 | both | as 6, then 0; or lit linear red, green, blue, 1, 1, 1, then 1 |
//! | 8 | translucent faces, lines | as 7, then the translucency |

use glam::DVec3;
use uglight::{Appearance, Lighting, Swatch};
use ugraster::TRANSPARENT_VALUES;

/// Packs a colour and the level of red, green and blue light on it.
pub type Pack<const N: usize> = fn(&Swatch, DVec3) -> [f64; N];

/// The numbers of opaque samples in any layout.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Packed<T> {
    /// Tint, saturation and value; linear red, green and blue where `is_light` is 1.
    pub color: [T; 3],
    /// Level of red, green and blue light; `None` if it has been multiplied into the value.
    pub level: Option<[T; 3]>,
    /// 1 where the colour is given as light, else 0; `None` if none is.
    pub is_light: Option<T>,
}

impl<T: Copy> Packed<T> {
    /// The numbers of a layout.
    ///
    /// # Panics
    /// If no layout has so many.
    #[inline]
    pub fn new(numbers: &[T]) -> Self {
        match *numbers {
            [a, b, c] => Self { color: [a, b, c], level: None, is_light: None },
            [a, b, c, light] => Self { color: [a, b, c], level: None, is_light: Some(light) },
            [a, b, c, red, green, blue] => {
                Self { color: [a, b, c], level: Some([red, green, blue]), is_light: None }
            }
            [a, b, c, red, green, blue, light] => {
                Self { color: [a, b, c], level: Some([red, green, blue]), is_light: Some(light) }
            }
            _ => unreachable!("layouts have 3, 4, 6 or 7 numbers"),
        }
    }
}

/// The layout of the opaque faces of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PackedLayout {
    Plain,
    Colored,
    Mixed,
    MixedColored,
}

/// The interpolated colour of a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Interpolated {
    /// Given as light: linear red, green, blue, lit.
    Light([f64; 3]),
    /// Given as a hue or wavelength.
    Hue {
        /// Hue or wavelength, saturation, and value.
        color: Plain,
        /// Level of red, green and blue light; `None` if it has been multiplied into the value.
        level: Option<[f64; 3]>,
    },
}

/// A colour given as a hue or wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plain {
    pub tint: f64,
    pub saturation: f64,
    pub value: f64,
}

impl PackedLayout {
    /// The one with the fewest interpolants.
    pub fn new(appearance: &Appearance, lighting: &Lighting) -> Self {
        // The exact mode adds the light of coloured lamps as such.
        let adds_light = lighting.is_colored() && lighting.acts_on_light();
        let draws_light = appearance.palette.has_light() || appearance.draws_display() || adds_light;
        match (draws_light, lighting.is_colored() || lighting.acts_on_light()) {
            (false, false) => Self::Plain,
            (false, true) => Self::Colored,
            (true, false) => Self::Mixed,
            (true, true) => Self::MixedColored,
        }
    }

    /// The colour of an opaque sample.
    pub fn color(self, numbers: &[f32]) -> Interpolated {
        let Packed { color, level, is_light } = Packed::new(numbers);
        let color = color.map(f64::from);
        if is_light.is_some_and(|is_light| is_light > 0.5) {
            return Interpolated::Light(color);
        }
        let [tint, saturation, value] = color;
        let level = level.map(|level| level.map(f64::from));
        Interpolated::Hue { color: Plain { tint, saturation, value }, level }
    }
}

/// White light of one level goes into the value.
pub fn pack_plain(swatch: &Swatch, level: DVec3) -> [f64; 3] {
    [swatch.tint, swatch.saturation, swatch.value * level.x]
}

/// Coloured light and factors of linear light are interpolated beside the colour.
pub fn pack_colored(swatch: &Swatch, level: DVec3) -> [f64; 6] {
    let [red, green, blue] = (level * swatch.factor).to_array();
    [swatch.tint, swatch.saturation, swatch.value, red, green, blue]
}

/// White light, and some colours given as light.
pub fn pack_mixed(swatch: &Swatch, level: DVec3) -> [f64; 4] {
    match swatch.lit(level) {
        Some(light) => [light.x, light.y, light.z, 1.0],
        None => [swatch.tint, swatch.saturation, swatch.value * level.x, 0.0],
    }
}

/// Coloured light, and some colours given as light.
pub fn pack_mixed_colored(swatch: &Swatch, level: DVec3) -> [f64; 7] {
    if let Some(light) = swatch.lit(level) {
        return [light.x, light.y, light.z, 1.0, 1.0, 1.0, 1.0];
    }
    let [tint, saturation, value, red, green, blue] = pack_colored(swatch, level);
    [tint, saturation, value, red, green, blue, 0.0]
}

/// One layout for translucent faces and lines of every scene.
pub fn pack_transparent(swatch: &Swatch, level: DVec3) -> [f64; TRANSPARENT_VALUES] {
    let [a, b, c, red, green, blue, is_light] = pack_mixed_colored(swatch, level);
    [a, b, c, red, green, blue, is_light, swatch.translucency]
}
