//! Animated PNG and GIF.

use std::io::{self, Write};

use gif::{DisposalMethod, Encoder as GifEncoder, Frame as GifFrame, Repeat};
use png::{BitDepth, ColorType, Compression, Encoder as PngEncoder, Writer};
use ugimage::Frame;

use super::palette::Palette;

/// Frames a second that a GIF can have: browsers show one of less than 1/50 s for 1/10 s.
pub const MOST_GIF_RATE: f64 = 50.0;

/// The frames of a film, one after the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmShape {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// How many frames.
    pub n_frames: u32,
    /// On a page, the values of a second slider: each has the same number of frames.
    pub n_rows: u32,
    /// Frames a second.
    pub rate: f64,
}

/// A film rate as a fraction: 25, or 30000/1001 for 29.97, as television has it.
pub fn fraction(rate: f64) -> [u32; 2] {
    let ntsc = rate.ceil() * 1000.0 / 1001.0;
    if rate > 20.0 && rate.fract() != 0.0 && (rate - ntsc).abs() < 0.005 {
        return [(rate.ceil() * 1000.0) as u32, 1001];
    }
    /// Decimals of a rate that count.
    const MILLION: u32 = 1_000_000;
    let count = (rate * f64::from(MILLION)).round() as u32;
    let (mut divisor, mut rest) = (MILLION, count % MILLION);
    while rest > 0 {
        (divisor, rest) = (rest, divisor % rest);
    }
    [count / divisor, MILLION / divisor]
}

/// When frames are shown, in whole ticks of a format. Rounding errors do not add up.
struct Clock {
    ticks_per_frame: f64,
    n_frames: f64,
}

impl Clock {
    fn new(ticks_per_frame: f64) -> Self {
        Self { ticks_per_frame, n_frames: 0.0 }
    }

    /// How many ticks the next frame is shown.
    fn delay(&mut self) -> u16 {
        let now = (self.n_frames * self.ticks_per_frame).round();
        self.n_frames += 1.0;
        ((self.n_frames * self.ticks_per_frame).round() - now).clamp(1.0, f64::from(u16::MAX))
            as u16
    }
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
    clock: Clock,
    ticks_per_second: u16,
    before: Option<Frame>,
}

impl<'w> AnimatedPng<'w> {
    /// Begins a film that repeats without end.
    ///
    /// # Errors
    /// Writing fails.
    pub fn new(out: &'w mut dyn Write, shape: FilmShape) -> io::Result<Self> {
        let [width, height] = shape.size;
        let mut encoder = PngEncoder::new(out, width, height);
        encoder.set_color(ColorType::Rgba);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_compression(Compression::High);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        encoder.set_animated(shape.n_frames, 0)?;
        // Exact delays of 1/24 s, unless the fraction has more than 16 bits.
        let exact = fraction(shape.rate).map(u16::try_from);
        let (ticks_per_second, clock) = if let [Ok(count), Ok(seconds)] = exact {
            (count, Clock::new(seconds.into()))
        } else {
            let ticks = (shape.rate * f64::from(u16::MAX)).clamp(1.0, 60_000.0) as u16;
            (ticks, Clock::new(f64::from(ticks) / shape.rate))
        };
        Ok(Self { writer: encoder.write_header()?, clock, ticks_per_second, before: None })
    }

    /// Adds the next frame.
    ///
    /// # Errors
    /// Writing fails.
    pub fn push(&mut self, frame: &Frame) -> io::Result<()> {
        let width = frame.width() as usize;
        self.writer.set_frame_delay(self.clock.delay(), self.ticks_per_second)?;
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

/// Writes a GIF that repeats without end. Every frame has its own colours. Of an opaque film only
/// the pixels are written that have changed, so what does not move does not flicker.
pub struct Gif<'w> {
    encoder: GifEncoder<&'w mut dyn Write>,
    clock: Clock,
    before: Option<Frame>,
}

impl<'w> Gif<'w> {
    /// Begins a film.
    ///
    /// # Errors
    /// Writing fails, or the film is larger than a GIF can be.
    pub fn new(out: &'w mut dyn Write, shape: FilmShape) -> io::Result<Self> {
        let side = |length: u32| {
            u16::try_from(length)
                .map_err(|_| io::Error::other("a GIF has at most 65535 pixels along a side"))
        };
        let (width, height) = (side(shape.size[0])?, side(shape.size[1])?);
        let mut encoder = GifEncoder::new(out, width, height, &[]).map_err(io::Error::other)?;
        encoder.set_repeat(Repeat::Infinite).map_err(io::Error::other)?;
        let clock = Clock::new(100.0 / shape.rate.min(MOST_GIF_RATE));
        Ok(Self { encoder, clock, before: None })
    }

    /// Adds the next frame. Pixels of which less than half is covered are transparent.
    ///
    /// # Errors
    /// Writing fails.
    pub fn push(&mut self, frame: &Frame) -> io::Result<()> {
        let [width, height] = [frame.width(), frame.height()].map(|length| length as usize);
        // A transparent frame replaces the one before.
        let before = self.before.take().filter(|_| frame.is_opaque());
        let part = match &before {
            Some(before) => changed_part(before.pixels(), frame.pixels(), width),
            None => [0, 0, width, height],
        };
        let mut drawn = cut(frame.pixels(), width, part);
        if let Some(before) = &before {
            let same = drawn.iter_mut().zip(cut(before.pixels(), width, part));
            same.filter(|(now, before)| *now == before).for_each(|(now, _)| now[3] = 0);
        }
        let color =
            |&[red, green, blue, alpha]: &[u8; 4]| (alpha >= 128).then_some([red, green, blue]);
        let colors: Vec<_> = drawn.iter().filter_map(color).collect();
        let n_transparent = usize::from(colors.len() < drawn.len());
        let palette = Palette::new(colors, 256 - n_transparent);
        let transparent = (n_transparent > 0).then_some(palette.colors.len() as u8);
        let [left, top, columns, _] = part;
        let index = |(at, pixel)| match color(pixel) {
            Some(color) => palette.index(color, [left + at % columns, top + at / columns]),
            None => transparent.unwrap_or(0),
        };
        let buffer: Vec<u8> = drawn.iter().enumerate().map(index).collect();
        let mut colors = palette.colors;
        colors.resize(colors.len() + n_transparent, [0; 3]);
        let [left, top, width, height] = part.map(|number| number as u16);
        let picture = GifFrame {
            left,
            top,
            width,
            height,
            delay: self.clock.delay(),
            dispose: if frame.is_opaque() {
                DisposalMethod::Keep
            } else {
                DisposalMethod::Background
            },
            transparent,
            palette: Some(colors.into_flattened()),
            buffer: buffer.into(),
            ..GifFrame::default()
        };
        self.encoder.write_frame(&picture).map_err(io::Error::other)?;
        self.before = Some(frame.clone());
        Ok(())
    }

    /// Ends the film.
    ///
    /// # Errors
    /// Writing fails.
    pub fn finish(self) -> io::Result<()> {
        self.encoder.into_inner().map_err(io::Error::other)?.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_are_fractions() {
        assert_eq!(fraction(25.0), [25, 1]);
        assert_eq!(fraction(29.97), [30000, 1001]);
        assert_eq!(fraction(23.976), [24000, 1001]);
        assert_eq!(fraction(59.94), [60000, 1001]);
        assert_eq!(fraction(12.5), [25, 2]);
        assert_eq!(fraction(0.0333), [333, 10000]);
        assert_eq!(fraction(1000.0), [1000, 1]);
        assert_eq!(fraction(0.01), [1, 100]);
    }

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
