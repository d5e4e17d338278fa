//! The values that are interpolated between the corners of a face, packed as an array for the
//! rasterizer.
//!
//! | numbers | drawn | in this order |
//! | ---: | --- | --- |
//! | 3 | all faces as hues under white light | tint, saturation, value × level |
//! | 3 | all faces as light | lit linear red, green, blue |
//! | 8 | everything else | tint, saturation, value; level of red, green, blue; 0; translucency |
//! | | | or lit linear red, green, blue; 1, 1, 1; 1; translucency |

use glam::DVec3;
use uglight::{Appearance, ColorForm, Lighting, Swatch};
use ugraster::TRANSPARENT_VALUES;
use ugscene::Scene;

/// Packs a colour and the level of red, green and blue light on it.
pub type Pack<const N: usize> = fn(&Swatch, DVec3) -> [f64; N];

/// The packed values of the opaque faces of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// 3 numbers: hues under white light.
    Hues,
    /// 3 numbers: light.
    Light,
    /// 8 numbers.
    Mixed {
        /// Levels are interpolated beside the colour; otherwise they are in the value.
        has_levels: bool,
    },
}

impl Layout {
    /// The one with the fewest interpolants.
    pub fn new(scene: &Scene, appearance: &Appearance, lighting: &Lighting) -> Self {
        let has_levels = lighting.is_colored() || lighting.acts_on_light;
        match appearance.draws_light(scene) {
            [_, false] if !has_levels => Self::Hues,
            [false, true] => Self::Light,
            _ => Self::Mixed { has_levels },
        }
    }
}

/// White light of one level goes into the value.
pub fn pack_hue(swatch: &Swatch, level: DVec3) -> [f64; 3] {
    [swatch.tint, swatch.saturation, swatch.value * level.x]
}

/// Lit light.
pub fn pack_light(swatch: &Swatch, level: DVec3) -> [f64; 3] {
    swatch.form.lit(level).unwrap_or_default().to_array()
}

/// Hues as in [`pack_hue`], and light.
pub fn pack_white(swatch: &Swatch, level: DVec3) -> [f64; TRANSPARENT_VALUES] {
    let form = swatch.form.lit(level).map_or(ColorForm::Hue, ColorForm::Light);
    let value = swatch.value * level.x;
    pack_transparent(&Swatch { value, factor: 1.0, form, ..*swatch }, DVec3::ONE)
}

/// Levels of light and factors of linear light are interpolated beside the colour.
pub fn pack_transparent(swatch: &Swatch, level: DVec3) -> [f64; TRANSPARENT_VALUES] {
    let translucency = swatch.translucency;
    if let Some(light) = swatch.form.lit(level) {
        return [light.x, light.y, light.z, 1.0, 1.0, 1.0, 1.0, translucency];
    }
    let [red, green, blue] = (level * swatch.factor).to_array();
    [swatch.tint, swatch.saturation, swatch.value, red, green, blue, 0.0, translucency]
}
