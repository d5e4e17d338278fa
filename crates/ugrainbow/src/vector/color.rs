//! Colours of patches, as figures interpolate them.

use ugimage::Development;
use ugimage::figure::Rgb;
use ugphysics::srgb_encode;

use super::patch::Patch;
use crate::canvas::developed;
use crate::shade::Shader;
use crate::sheet::{MOST_VALUES, Sheet};

/// Display-encoded red, green and blue, from 0 to 255, not rounded.
pub type Levels = [f64; 3];

/// Turns numbers of the draw list into colours on the display.
pub struct Palette<'a> {
    pub sheet: &'a Sheet<'a>,
    pub shader: &'a Shader,
    /// How light is developed; `None` if it fits a display as it is.
    pub development: Option<Development>,
}

impl Palette<'_> {
    /// The colour of a patch at a place.
    pub fn at(&self, patch: &Patch, place: [f64; 2]) -> Levels {
        self.levels(&patch.values_at(place))
    }

    /// The colour of interpolated numbers.
    pub fn levels(&self, values: &[f32; MOST_VALUES]) -> Levels {
        let [red, green, blue] = self.sheet.shade(self.shader, values).light;
        let light = match &self.development {
            Some(development) => developed(development, [red, green, blue, 1.0]),
            None => [red, green, blue, 1.0],
        };
        [0, 1, 2].map(|i| 255.0 * srgb_encode(f64::from(light[i]).clamp(0.0, 1.0)))
    }
}

/// The nearest levels.
pub fn rounded(levels: Levels) -> Rgb {
    levels.map(|level| level.round() as u8)
}

/// The mean of two colours.
pub fn mean(a: Levels, b: Levels) -> Levels {
    [0, 1, 2].map(|i| 0.5 * (a[i] + b[i]))
}

/// The greatest difference in a channel.
pub fn distance(a: Levels, b: Levels) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max)
}
