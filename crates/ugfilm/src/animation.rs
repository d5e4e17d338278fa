//! Animated PNG and GIF.

use std::io::{self, Write};

use gif::{Encoder as GifEncoder, Frame as GifFrame, Repeat};
use png::{BitDepth, ColorType, Compression, Encoder as PngEncoder, Writer};
use ugimage::Frame;

/// The frames of a film, one after the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// How many frames.
    pub n_frames: u32,
    /// Frames a second.
    pub rate: f64,
}

/// Columns and rows of a part of a frame: left, top, width, height.
type Part = [usize; 4];

/// The smallest part outside which two frames are the same; a pixel if they are the same
/// everywhere.
fn changed_part<T: PartialEq>(before: &[T], now: &[T], width: usize) -> Part {
    let (mut low, mut high) = ([usize::MAX; 2], [0; 2]);
    for (row, (before, now)) in before.chunks(width).zip(now.chunks(width)).enumerate() {
        let differs = |column: &usize| before[*column] != now[*column];
        if let Some(first) = (0..width).find(differs) {
            let last = (0..width).rev().find(differs).unwrap_or(first);
            low = [low[0].min(first), low[1].min(row)];
            high = [high[0].max(last), high[1].max(row)];
        }
    }
    if low[0] == usize::MAX {
        return [0, 0, 1, 1];
    }
    [low[0], low[1], high[0] - low[0] + 1, high[1] - low[1] + 1]
}

/// The rows of a part, one after the other.
fn cut<T: Copy>(pixels: &[T], width: usize, [left, top, columns, rows]: Part) -> Vec<T> {
    let rows = pixels.chunks(width).skip(top).take(rows);
    rows.flat_map(|row| &row[left..left + columns]).copied().collect()
}

/// Writes an animated PNG. Of every frame but the first only the part is written that has changed.
pub struct AnimatedPng<'w> {
    writer: Writer<&'w mut dyn Write>,
    before: Option<Frame>,
}

impl<'w> AnimatedPng<'w> {
    /// Begins a film that repeats without end.
    ///
    /// # Errors
    /// Writing fails.
    pub fn new(out: &'w mut dyn Write, shape: Shape) -> io::Result<Self> {
        let [width, height] = shape.size;
        let mut encoder = PngEncoder::new(out, width, height);
        encoder.set_color(ColorType::Rgba);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_compression(Compression::High);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        encoder.set_animated(shape.n_frames, 0)?;
        // Milliseconds, as far as 16 bits reach.
        let delay = (1000.0 / shape.rate).round().clamp(1.0, f64::from(u16::MAX)) as u16;
        encoder.set_frame_delay(delay, 1000)?;
        Ok(Self { writer: encoder.write_header()?, before: None })
    }

    /// Adds the next frame.
    ///
    /// # Errors
    /// Writing fails.
    pub fn push(&mut self, frame: &Frame) -> io::Result<()> {
        let width = frame.width() as usize;
        let pixels = match &self.before {
            None => frame.pixels().to_vec(),
            Some(before) => {
                let part = changed_part(before.pixels(), frame.pixels(), width);
                let [left, top, columns, rows] = part.map(|number| number as u32);
                self.writer.reset_frame_position()?;
                self.writer.set_frame_dimension(columns, rows)?;
                self.writer.set_frame_position(left, top)?;
                cut(frame.pixels(), width, part)
            }
        };
        self.writer.write_image_data(pixels.as_flattened())?;
        self.before = Some(frame.clone());
        Ok(())
    }

    /// Ends the film.
    ///
    /// # Errors
    /// Writing fails.
    pub fn finish(self) -> io::Result<()> {
        Ok(self.writer.finish()?)
    }
}

/// The colours of a GIF, the same for all its frames, so that nothing flickers.
#[derive(Clone, Debug, Default)]
pub struct Palette {
    /// Red, green, blue.
    colors: Vec<[u8; 3]>,
}

impl Palette {
    /// Colours for these pixels by a neural network (Dekker 1994).
    pub fn new(pixels: &[[u8; 4]]) -> Self {
        /// Pixels from which the network learns: every third.
        const SAMPLING: i32 = 3;
        if pixels.is_empty() {
            return Self { colors: vec![[0; 3], [255; 3]] };
        }
        let network = color_quant::NeuQuant::new(SAMPLING, 256, pixels.as_flattened());
        Self { colors: network.color_map_rgb().as_chunks().0.to_vec() }
    }

    /// The index of the nearest colour.
    fn nearest(&self, [red, green, blue]: [u8; 3]) -> u8 {
        let square = |a: u8, b: u8, weight: u32| weight * u32::from(a.abs_diff(b)).pow(2);
        let distance = |color: &[u8; 3]| {
            // The eye sees differences of green best, those of blue least.
            square(color[0], red, 3) + square(color[1], green, 6) + square(color[2], blue, 1)
        };
        let nearest = self.colors.iter().enumerate().min_by_key(|(_, color)| distance(color));
        nearest.map_or(0, |(row, _)| row as u8)
    }
}

/// Writes a GIF that repeats without end.
pub struct Gif<'w> {
    encoder: GifEncoder<&'w mut dyn Write>,
    palette: Palette,
    /// Palette index of each colour with 5 bits a channel, computed when it first occurs.
    known: Vec<Option<u8>>,
    before: Vec<u8>,
    rate: f64,
    n_written: u32,
}

impl<'w> Gif<'w> {
    /// Begins a film.
    ///
    /// # Errors
    /// Writing fails, or the film is larger than a GIF can be.
    pub fn new(out: &'w mut dyn Write, shape: Shape, palette: &Palette) -> io::Result<Self> {
        let side = |length: u32| {
            u16::try_from(length).map_err(|_| io::Error::other("a GIF has at most 65535 pixels along a side"))
        };
        let (width, height) = (side(shape.size[0])?, side(shape.size[1])?);
        let mut encoder =
            GifEncoder::new(out, width, height, palette.colors.as_flattened()).map_err(io::Error::other)?;
        encoder.set_repeat(Repeat::Infinite).map_err(io::Error::other)?;
        Ok(Self {
            encoder,
            palette: palette.clone(),
            known: vec![None; 1 << 15],
            before: Vec::new(),
            rate: shape.rate,
            n_written: 0,
        })
    }

    /// Adds the next frame.
    ///
    /// # Errors
    /// Writing fails.
    pub fn push(&mut self, frame: &Frame) -> io::Result<()> {
        let width = frame.width() as usize;
        let pixels = frame.pixels().iter().enumerate();
        let now: Vec<u8> = pixels.map(|(at, &pixel)| self.index(pixel, [at % width, at / width])).collect();
        let part = if self.before.is_empty() {
            [0, 0, width, now.len() / width]
        } else {
            changed_part(&self.before, &now, width)
        };
        let [left, top, columns, rows] = part.map(|number| number as u16);
        // The time of a frame is a whole number of hundredths; their sum is that of the film.
        let until = |n_frames: u32| (100.0 * f64::from(n_frames) / self.rate).round() as u32;
        let delay = until(self.n_written + 1) - until(self.n_written);
        let picture = GifFrame {
            left,
            top,
            width: columns,
            height: rows,
            delay: delay.clamp(1, u32::from(u16::MAX)) as u16,
            buffer: cut(&now, width, part).into(),
            ..GifFrame::default()
        };
        self.encoder.write_frame(&picture).map_err(io::Error::other)?;
        self.before = now;
        self.n_written += 1;
        Ok(())
    }

    /// Ends the film.
    ///
    /// # Errors
    /// Writing fails.
    pub fn finish(self) -> io::Result<()> {
        self.encoder.into_inner().map_err(io::Error::other)?.flush()
    }

    /// The palette index of a pixel. A fixed pattern decides between two near colours, so what does
    /// not move does not flicker.
    fn index(&mut self, [red, green, blue, _]: [u8; 4], [column, row]: [usize; 2]) -> u8 {
        /// Bayer's matrix of order 4.
        const PATTERN: [[i16; 4]; 4] = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];
        let shift = (PATTERN[row % 4][column % 4] - 7) / 2;
        // Black and white stay as they are.
        let is_extreme = matches!([red, green, blue], [0, 0, 0] | [255, 255, 255]);
        let shift = if is_extreme { 0 } else { shift };
        let key = [red, green, blue].map(|part| (i16::from(part) + shift).clamp(0, 255) as usize >> 3);
        let [r, g, b] = key;
        let slot = r << 10 | g << 5 | b;
        if let Some(known) = self.known[slot] {
            return known;
        }
        let middle = key.map(|part| (part << 3 | part >> 2) as u8);
        let index = self.palette.nearest(middle);
        self.known[slot] = Some(index);
        index
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_contain_all_changes() {
        let mut now = [0; 20];
        assert_eq!(changed_part(&[0; 20], &now, 5), [0, 0, 1, 1]);
        now[7] = 1;
        now[16] = 1;
        let part = changed_part(&[0; 20], &now, 5);
        assert_eq!(part, [1, 1, 2, 3]);
        assert_eq!(cut(&now, 5, part), [0, 1, 0, 0, 1, 0]);
    }
}
