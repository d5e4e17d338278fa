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
            let ([red, green, blue], all) = over(color.map(f32::from), part, [red, green, blue], below);
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
            let under = [red, green, blue].map(|light| srgb_encode(f64::from(light).clamp(0.0, 1.0)) as f32);
            let (levels, all) = over(color.map(|level| f32::from(level) / 255.0), part, under, below);
            let [red, green, blue] = levels.map(|level| srgb_decode(f64::from(level)) as f32);
            pixels[idx] = [red, green, blue, if is_opaque { drawn } else { all }];
        });
    }

    /// Calls `mix` for each pixel that a shape covers, with the pixel's index, the colour of the
    /// shape and the coverage, 0…1.
    fn for_each_covered(&self, [width, height]: [u32; 2], mut mix: impl FnMut(usize, [u8; 3], f32)) {
        for shape in &self.shapes {
            let shape = shape.outlined();
            let color = shape.color();
            for top in (0..height).step_by(TILE as usize) {
                for left in (0..width).step_by(TILE as usize) {
                    let size = [TILE.min(width - left), TILE.min(height - top)];
                    let tile = Tile { first: [left, top], size };
                    let Some(parts) = tile.coverage(&shape) else { continue };
                    for (idx, &part) in parts.iter().enumerate().filter(|(_, part)| **part > 0.0) {
                        let (x, y) =
                            (left as usize + idx % size[0] as usize, top as usize + idx / size[0] as usize);
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

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle(left: f64, top: f64, right: f64, bottom: f64) -> Drawing {
        let mut drawing = Drawing::default();
        drawing.rectangle([left, top], [right, bottom], [255, 128, 0]);
        drawing
    }

    #[test]
    fn covered_pixels_are_exact_and_others_unchanged() {
        let mut frame = Frame::opaque(600, 300);
        frame.pixels_mut().fill([9, 8, 7, 255]);
        rectangle(250.0, 200.0, 530.0, 280.0).paint(&mut frame);
        for y in 0..300 {
            for x in 0..600 {
                let is_inside = (250..530).contains(&x) && (200..280).contains(&y);
                let expected = if is_inside { [255, 128, 0, 255] } else { [9, 8, 7, 255] };
                assert_eq!(frame.pixel(x, y), expected, "{x} {y}");
            }
        }
    }

    #[test]
    fn partly_covered_pixels_are_blended() {
        let mut frame = Frame::opaque(3, 1);
        let mut drawing = Drawing::default();
        drawing.rectangle([0.5, 0.0], [1.25, 1.0], [255; 3]);
        drawing.paint(&mut frame);
        for (x, part) in [(0, 0.5), (1, 0.25), (2, 0.0)] {
            assert!((f64::from(frame.pixel(x, 0)[0]) - 255.0 * part).abs() <= 1.0, "{x}");
        }
    }

    /// Letters are equally bold on black and on white.
    #[test]
    fn black_on_white_is_white_on_black() {
        let mut frames = [Frame::opaque(60, 20), Frame::opaque(60, 20)];
        frames[1].pixels_mut().fill([255; 4]);
        for (frame, ink) in frames.iter_mut().zip([[255; 3], [0; 3]]) {
            let mut drawing = Drawing::default();
            drawing.text(&crate::label::Line::new("γ = 2.29", 12.0).unwrap(), [2.0, 14.0], ink);
            drawing.paint(frame);
        }
        let [black, white] = &frames;
        for (light, dark) in black.pixels().iter().zip(white.pixels()) {
            // The results may be rounded in opposite directions.
            assert!(light[0].abs_diff(255 - dark[0]) <= 1, "{light:?} {dark:?}");
        }
    }

    #[test]
    fn ink_keeps_its_colour_on_a_transparent_frame() {
        let mut frame = Frame::clear(2, 1);
        rectangle(0.0, 0.0, 1.5, 1.0).paint(&mut frame);
        assert_eq!(frame.pixel(0, 0), [255, 128, 0, 255]);
        let [red, green, blue, alpha] = frame.pixel(1, 0);
        assert_eq!([red, green, blue], [255, 128, 0]);
        assert!(alpha.abs_diff(128) <= 1, "{alpha}");
    }

    /// Overlapping lines of any direction are covered as their union.
    #[test]
    fn crossing_lines_are_covered_as_a_union() {
        let mut frame = Frame::opaque(20, 20);
        let mut drawing = Drawing::default();
        let lines =
            vec![[[10.0, 2.0], [10.0, 18.0]], [[18.0, 10.0], [2.0, 10.0]], [[10.0, 18.0], [10.0, 9.0]]];
        drawing.lines(lines, 4.0, [255; 3]);
        drawing.paint(&mut frame);
        assert_eq!(frame.pixel(10, 10), [255; 4]);
        assert_eq!(frame.pixel(9, 12), [255; 4]);
        assert_eq!(frame.pixel(4, 4), [0, 0, 0, 255]);
    }

    #[test]
    fn light_is_blended_in_display_encoding() {
        let mut drawing = rectangle(0.3, 0.2, 3.7, 2.6);
        drawing.text(&crate::label::Line::new("β", 4.0).unwrap(), [0.2, 3.1], [0, 40, 90]);
        for mut frame in [Frame::opaque(5, 4), Frame::clear(5, 4)] {
            let mut light = LinearFrame::from(&frame);
            drawing.paint(&mut frame);
            drawing.paint_light(&mut light);
            for (ours, theirs) in frame.pixels().iter().zip(light.to_display().pixels()) {
                // Bytes are rounded after each shape.
                assert!(ours.iter().zip(theirs).all(|(a, b)| a.abs_diff(*b) <= 2), "{ours:?} {theirs:?}");
            }
        }
    }

    #[test]
    fn huge_and_nan_coordinates_are_harmless() {
        let mut drawing = rectangle(-1e300, -1e300, 1e300, 1e300);
        drawing.rectangle([f64::NAN, 0.0], [3.0, 3.0], [1, 2, 3]);
        drawing.lines(vec![[[1.0, 1.0], [1.0, 1.0]], [[f64::INFINITY, 0.0], [0.0, 0.0]]], 2.0, [1, 2, 3]);
        let mut frame = Frame::opaque(4, 4);
        drawing.paint(&mut frame);
        assert_eq!(frame.pixel(2, 2), [255, 128, 0, 255]);
    }
}
