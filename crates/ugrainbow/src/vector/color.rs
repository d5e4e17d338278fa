//! Colours of patches, as figures interpolate them.

use ugimage::Development;
use ugimage::figure::Rgb;
use ugphysics::srgb_encode;

use super::patch::Patch;
use crate::canvas::developed;
use crate::raster::{CLEAR_VALUES, Corner, Grid, Shade};
use crate::shade::Shader;
use crate::sheet::{Sheet, clear_shade};

/// Display-encoded red, green and blue, from 0 to 255, not rounded.
pub type Levels = [f64; 3];

/// Turns numbers of the draw list into colours on the display.
pub struct Palette<'a> {
    pub sheet: &'a Sheet<'a>,
    pub shader: &'a Shader,
    /// How light is developed; `None` if it fits a display as it is.
    pub development: Option<Development>,
    pub grid: &'a Grid,
    /// Linear light of what stands behind everything; white if that is nothing.
    pub ground: [f32; 3],
}

impl Palette<'_> {
    /// The colour of a patch at a place.
    pub fn at(&self, patch: &Patch, place: [f64; 2]) -> Levels {
        let Numbers { values, key } = patch.numbers_at(place);
        self.cued(self.sheet.shade(self.shader, &values), key)
    }

    /// The colour of a patch, if it is the same everywhere.
    pub fn everywhere(&self, patch: &Patch) -> Option<Levels> {
        let values = patch.single_values().filter(|_| self.grid.cue.is_none())?;
        Some(self.levels(self.sheet.shade(self.shader, &values).light))
    }

    /// The colour of a point of a line.
    pub fn on_line(&self, at: &Corner<CLEAR_VALUES>) -> Levels {
        let scale = if self.grid.is_perspective { 1.0 / at.key } else { 1.0 };
        let values = at.values.map(|value| (value * scale) as f32);
        self.cued(clear_shade(self.shader, &values).0, at.key)
    }

    fn cued(&self, shade: Shade, key: f64) -> Levels {
        let cue = self.grid.cue_at(key as f32);
        self.levels(std::array::from_fn(|i| cue * shade.light[i] + (1.0 - cue) * self.ground[i]))
    }

    /// Light developed for a display.
    pub fn levels(&self, [red, green, blue]: [f32; 3]) -> Levels {
        let light = match &self.development {
            Some(development) => developed(development, [red, green, blue, 1.0]),
            None => [red, green, blue, 1.0],
        };
        [0, 1, 2].map(|i| 255.0 * srgb_encode(f64::from(light[i]).clamp(0.0, 1.0)))
    }
}

/// What is interpolated, at a place.
pub struct Numbers {
    pub values: [f32; CLEAR_VALUES],
    pub key: f64,
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
