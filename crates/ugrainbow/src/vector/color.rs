//! Display colours of patches, which figures interpolate.

use ugimage::Development;
use ugimage::figure::Rgb;
use ugphysics::srgb_encode;
use ugpicture::Backdrop;
use ugraster::{Corner, SampleGrid, ShadedSample, TRANSPARENT_VALUES};

use super::patch::{Interpolants, Patch};
use crate::render_layers::RenderLayers;

/// Display-encoded red, green and blue, from 0 to 255, not rounded.
pub type Levels = [f64; 3];

/// Shades patches with the colours of the display.
pub struct FigureColors<'a> {
    pub layers: &'a RenderLayers<'a>,
    /// How light is developed; `None` if it needs no development.
    pub development: Option<Development>,
    pub grid: &'a SampleGrid,
    pub backdrop: &'a Backdrop,
    /// Linear light of the background; white if it is transparent.
    pub ground: [f32; 3],
}

impl FigureColors<'_> {
    /// The colour of stacked patches at a point; the first is in front.
    pub fn at<'p>(&self, layers: impl Iterator<Item = &'p Patch>, place: [f64; 2]) -> Levels {
        self.blended(layers.map(|patch| self.layer(patch, &patch.interpolants_at(place))))
    }

    /// The colour of stacked patches if it is the same everywhere.
    pub fn everywhere<'p>(&self, layers: impl Iterator<Item = &'p Patch>) -> Option<Levels> {
        let layer = |patch: &'p Patch| {
            let values = patch.single_values().filter(|_| self.grid.fade.is_none())?;
            Some(self.layer(patch, &Interpolants { values, key: 1.0 }))
        };
        Some(self.blended(layers.map(layer).collect::<Option<Vec<_>>>()?.into_iter()))
    }

    /// The colour of a point of a line behind translucent patches, in any order.
    pub fn on_line<'p>(
        &self,
        at: &Corner<TRANSPARENT_VALUES>,
        in_front: impl Iterator<Item = &'p Patch>,
    ) -> Levels {
        let scale = if self.grid.is_perspective { 1.0 / at.key } else { 1.0 };
        let values = at.values.map(|value| (value * scale) as f32);
        let line =
            SeenLayer { light: self.cued(self.layers.shader.one(&values), at.key), pass: 0.0 };
        let layer = |patch: &'p Patch| {
            let numbers = patch.interpolants_at([at.x, at.y]);
            (numbers.key, self.layer(patch, &numbers))
        };
        let mut layers: Vec<(f64, SeenLayer)> = in_front.map(layer).collect();
        layers.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        self.blended(layers.into_iter().map(|(_, layer)| layer).chain([line]))
    }

    fn layer(&self, patch: &Patch, Interpolants { values, key }: &Interpolants) -> SeenLayer {
        let (shade, pass) = if patch.is_transparent {
            (self.layers.shader.one(values), values[TRANSPARENT_VALUES - 1].clamp(0.0, 1.0))
        } else {
            (self.layers.shade(values), 0.0)
        };
        SeenLayer { light: self.cued(shade, *key), pass }
    }

    /// Composites layers over the background; the first is in front.
    fn blended(&self, layers: impl Iterator<Item = SeenLayer>) -> Levels {
        let (mut light, mut pass) = ([0.0; 3], 1.0);
        for layer in layers {
            let own = pass * (1.0 - layer.pass);
            light = std::array::from_fn(|i| light[i] + own * layer.light[i]);
            pass *= layer.pass;
        }
        self.levels(std::array::from_fn(|i| light[i] + pass * self.ground[i]), pass)
    }

    fn cued(&self, shade: ShadedSample, key: f64) -> [f32; 3] {
        let cue = self.grid.light_left(key as f32);
        std::array::from_fn(|i| cue * shade.light[i] + (1.0 - cue) * self.ground[i])
    }

    /// Light developed for a display. `pass`: the part of the background in it.
    pub fn levels(&self, light @ [red, green, blue]: [f32; 3], pass: f32) -> Levels {
        let convert =
            |development| self.backdrop.converter(development)([red, green, blue, 1.0 - pass]);
        let light = self.development.map_or(light, convert);
        [0, 1, 2].map(|i| 255.0 * srgb_encode(f64::from(light[i]).clamp(0.0, 1.0)))
    }
}

/// The light of a patch or line, and the part of the light from behind that it transmits.
struct SeenLayer {
    light: [f32; 3],
    pass: f32,
}

/// Rounded to the nearest levels.
pub fn rounded(levels: Levels) -> Rgb {
    levels.map(|level| level.round() as u8)
}

/// The mean of two colours.
pub fn mean(a: Levels, b: Levels) -> Levels {
    [0, 1, 2].map(|i| 0.5 * (a[i] + b[i]))
}

/// The greatest difference of a channel.
pub fn distance(a: Levels, b: Levels) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max)
}
