//! Colours of patches, as figures interpolate them.

use ugimage::Development;
use ugimage::figure::Rgb;
use ugphysics::srgb_encode;

use super::patch::Patch;
use crate::canvas::developed;
use crate::raster::{CLEAR_VALUES, Corner, Grid};
use crate::shade::Shader;
use crate::sheet::Sheet;

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
    /// The colour at a place where patches are seen, each through those behind it in the list.
    pub fn at(&self, stack: &[&Patch], place: [f64; 2]) -> Levels {
        let through = |light, patch: &&Patch| self.over(light, patch.is_clear, &patch.numbers_at(place));
        self.levels(stack.iter().fold(self.ground, through))
    }

    /// The colour where patches are seen, if it is the same everywhere.
    pub fn everywhere(&self, stack: &[&Patch]) -> Option<Levels> {
        if self.grid.cue.is_some() {
            return None;
        }
        let through = |light, patch: &&Patch| {
            Some(self.over(light, patch.is_clear, &Numbers { values: patch.single_values()?, key: 0.0 }))
        };
        stack.iter().try_fold(self.ground, through).map(|light| self.levels(light))
    }

    /// The colour of a point of a line behind panes.
    pub fn on_line(&self, at: &Corner<CLEAR_VALUES>, panes: &[&Patch]) -> Levels {
        let scale = if self.grid.is_perspective { 1.0 / at.key } else { 1.0 };
        let numbers = Numbers { values: at.values.map(|value| (value * scale) as f32), key: at.key };
        let through = |light, pane: &&Patch| self.over(light, pane.is_clear, &pane.numbers_at([at.x, at.y]));
        self.levels(panes.iter().fold(self.over(self.ground, true, &numbers), through))
    }

    /// Light behind something, and that.
    fn over(&self, behind: [f32; 3], is_clear: bool, numbers: &Numbers) -> [f32; 3] {
        let (shade, pass) = self.sheet.shade(self.shader, is_clear, &numbers.values);
        let cue = self.grid.cue_at(numbers.key as f32);
        std::array::from_fn(|i| {
            let own = cue * shade.light[i] + (1.0 - cue) * self.ground[i];
            (1.0 - pass) * own + pass * behind[i]
        })
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
