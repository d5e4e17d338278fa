//! Painting drawings on frames of pixels.
//!
//! Ink and background are blended in display encoding, not in linear light. PDF, PostScript and SVG
//! viewers do the same, and letters look equally bold black on white and white on black.

use crate::{Frame, LinearFrame};
use ugphysics::{srgb_decode, srgb_encode};

use crate::label::coverage::{TILE, Tile};
use crate::label::drawing::Drawing;

impl Drawing {
    /// Paints the drawing on a frame. Pixels that no shape covers keep their bytes.
    pub fn paint(&self, frame: &mut Frame) {
        let is_opaque = frame.is_opaque();
        let size = [frame.width(), frame.height()];
        let pixels = frame.pixels_mut();
        self.for_each_covered(size, |idx, color, part| {
            let [red, green, blue, alpha] = pixels[idx].map(f32::from);
            let below = if is_opaque { 1.0 } else { alpha / 255.0 };
            let ([red, green, blue], all) =
                over(color.map(f32::from), part, [red, green, blue], below);
            // The casts to integers saturate.
            pixels[idx] = [red, green, blue, 255.0 * all].map(|level| level.round() as u8);
        });
    }

    /// Paints the drawing on a frame of linear light that is already tone-mapped, so that white is
    /// 1.
    pub fn paint_light(&self, frame: &mut LinearFrame) {
        let size = [frame.width(), frame.height()];
        let is_opaque = frame.is_opaque();
        let pixels = frame.pixels_mut();
        self.for_each_covered(size, |idx, color, part| {
            let [red, green, blue, drawn] = pixels[idx];
            let below = if is_opaque { 1.0 } else { drawn };
            let under = [red, green, blue]
                .map(|light| srgb_encode(f64::from(light).clamp(0.0, 1.0)) as f32);
            let (levels, all) =
                over(color.map(|level| f32::from(level) / 255.0), part, under, below);
            let [red, green, blue] = levels.map(|level| srgb_decode(f64::from(level)) as f32);
            pixels[idx] = [red, green, blue, if is_opaque { drawn } else { all }];
        });
    }

    /// Calls `mix` for each pixel that a shape covers, with the pixel's index, the colour of the
    /// shape and the coverage, 0…1.
    fn for_each_covered(
        &self,
        [width, height]: [u32; 2],
        mut mix: impl FnMut(usize, [u8; 3], f32),
    ) {
        for shape in &self.shapes {
            let shape = shape.outlined();
            let color = shape.color();
            for top in (0..height).step_by(TILE as usize) {
                for left in (0..width).step_by(TILE as usize) {
                    let size = [TILE.min(width - left), TILE.min(height - top)];
                    let tile = Tile { first: [left, top], size };
                    let Some(parts) = tile.coverage(&shape) else { continue };
                    for (idx, &part) in parts.iter().enumerate().filter(|(_, part)| **part > 0.0) {
                        let (x, y) = (
                            left as usize + idx % size[0] as usize,
                            top as usize + idx / size[0] as usize,
                        );
                        mix(y * width as usize + x, color, part);
                    }
                }
            }
        }
    }
}

/// Porter–Duff "over", not premultiplied: `ink` with alpha `part` over `under` with alpha `below`.
/// Returns the blended colour and alpha.
fn over(ink: [f32; 3], part: f32, under: [f32; 3], below: f32) -> ([f32; 3], f32) {
    let left = below * (1.0 - part);
    let all = part + left;
    (std::array::from_fn(|i| (ink[i] * part + under[i] * left) / all), all)
}
