//! Pixels from samples: averaged in linear light, put on the background, and made fit for a display if asked.

use std::borrow::Borrow;

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch, f32x16, i32x16};
use rayon::prelude::*;
use ugimage::{Development, Frame, HALF, LinearFrame, Quantizer, auto_exposure, display_pixel};
use ugphysics::srgb_decode;
use ugraster::{Center, Filter, Hit, PixelSamples, RUN, Resolve, ResolveSingle, SampleStats};

use crate::config::{Background, Config, Exposure};
use crate::planes::{Finder, front, planes};
use crate::render_layers::RenderLayers;
use crate::setup::Setup;

/// Pixels that one task develops.
const CHUNK: usize = 1 << 14;

/// A picture before it is a file.
pub enum Drawn {
    /// What a display shows.
    Display(Frame),
    /// Light: developed, or as it is for a format that holds light.
    Light(LinearFrame),
}

impl Drawn {
    /// What a display shows of it.
    pub fn into_frame(self) -> Frame {
        match self {
            Self::Display(frame) => frame,
            Self::Light(frame) => frame.to_display(),
        }
    }
}

/// A picture, and how it came about.
pub struct Canvas {
    /// Its pixels.
    pub drawn: Drawn,
    /// What its samples were.
    pub stats: SampleStats,
    /// How its light was developed; `None` if it is light as it is, or fitted a display from the first.
    pub development: Option<Development>,
}

impl Canvas {
    /// Draws a layers.
    pub fn new(setup: &Setup<'_>, layers: &RenderLayers<'_>, config: &Config) -> Self {
        let is_deep = config.output.format().is_some_and(|format| format.is_deep());
        if !is_deep && !setup.is_uncut {
            return Self::display(setup, layers, config);
        }
        let (mut frame, stats) = light(setup, layers, config);
        if config.is_linear() {
            return Self { drawn: Drawn::Light(frame), stats, development: None };
        }
        let development = development(|| &frame, config);
        frame.pixels_mut().par_chunks_mut(CHUNK).flatten().for_each(|pixel| {
            *pixel = developed(&development, *pixel);
        });
        let drawn = if is_deep { Drawn::Light(frame) } else { Drawn::Display(frame.to_display()) };
        Self { drawn, stats, development: setup.is_uncut.then_some(development) }
    }

    /// Straight to 8 bits, when nothing in between is asked for.
    fn display(setup: &Setup<'_>, layers: &RenderLayers<'_>, config: &Config) -> Self {
        let grid = &setup.grid;
        let finish = Display::new(config);
        let (pixels, stats) = layers.paint_filtered(grid, config.filter, &setup.shader, &finish);
        let frame = Frame::new([grid.width, grid.height], finish.ground.is_opaque(), pixels);
        Self { drawn: Drawn::Display(frame), stats, development: None }
    }
}

/// Samples to what a display shows of them.
pub struct Display {
    ground: Ground,
    quantizer: Quantizer,
}

impl Display {
    /// That of a picture.
    pub fn new(config: &Config) -> Self {
        Self { ground: Ground::new(config), quantizer: Quantizer::new() }
    }
}

impl Resolve<[u8; 4]> for Display {
    fn pixel(&self, all: &PixelSamples<'_>) -> [u8; 4] {
        display_pixel(&self.quantizer, self.ground.pixel(all), self.ground.is_opaque())
    }

    fn single(&self) -> Option<&dyn ResolveSingle<[u8; 4]>> {
        Some(self)
    }
}

impl ResolveSingle<[u8; 4]> for Display {
    fn pixels(&self, keys: &[f32], levels: &[[f32; RUN]; 3], pixels: &mut [[u8; 4]]) {
        dispatch!(Level::new(), simd => write_levels(simd, keys, levels, pixels));
    }
}

/// Levels, 0…1, to the nearest of 256, where there are depth keys.
#[inline(always)] // Compiled for what the processor can do to many numbers at once.
fn write_levels<S: Simd>(simd: S, keys: &[f32], levels: &[[f32; RUN]; 3], pixels: &mut [[u8; 4]]) {
    let [red, green, blue] = levels;
    let all = red.as_chunks().0.iter().zip(green.as_chunks().0).zip(blue.as_chunks().0);
    for ((keys, pixels), ((red, green), blue)) in keys.chunks(LANES).zip(pixels.chunks_mut(LANES)).zip(all) {
        let (red, green, blue) = (bytes(simd, red), bytes(simd, green), bytes(simd, blue));
        let shown = red | green << 8 | blue << 16 | i32x16::splat(simd, i32::from_le_bytes([0, 0, 0, 255]));
        if let (Some(keys), Some(pixels)) = (keys.first_chunk(), pixels.first_chunk_mut()) {
            show(simd, keys, shown, pixels);
        } else {
            let (mut all_keys, mut all_pixels) = ([f32::NEG_INFINITY; LANES], [[0; 4]; LANES]);
            all_keys[..keys.len()].copy_from_slice(keys);
            all_pixels[..pixels.len()].copy_from_slice(pixels);
            show(simd, &all_keys, shown, &mut all_pixels);
            pixels.copy_from_slice(&all_pixels[..pixels.len()]);
        }
    }
}

/// Sets pixels where there are depth keys.
#[inline(always)]
fn show<S: Simd>(simd: S, keys: &[f32; LANES], shown: i32x16<S>, pixels: &mut [[u8; 4]; LANES]) {
    let is_shown = f32x16::from_slice(simd, keys).simd_gt(f32x16::splat(simd, f32::NEG_INFINITY));
    let mut all = [0; LANES];
    for (all, pixel) in all.iter_mut().zip(&*pixels) {
        *all = i32::from_le_bytes(*pixel);
    }
    let all: [i32; LANES] = is_shown.select(shown, i32x16::from_slice(simd, &all)).into();
    for (pixel, all) in pixels.iter_mut().zip(all) {
        *pixel = all.to_le_bytes();
    }
}

/// Levels that are rounded together.
const LANES: usize = 16;

/// The levels of 256 nearest to some of 0…1.
#[inline(always)]
fn bytes<S: Simd>(simd: S, levels: &[f32; LANES]) -> i32x16<S> {
    // What stands behind the point is cut off.
    simd.cvt_i32_f32x16(f32x16::from_slice(simd, levels) * 255.0 + HALF as f32)
}

/// The whole picture as light, with the planes that are asked for.
pub fn light(setup: &Setup<'_>, layers: &RenderLayers<'_>, config: &Config) -> (LinearFrame, SampleStats) {
    let grid = &setup.grid;
    let ground = Ground::new(config);
    let frame = |pixels| LinearFrame::new([grid.width, grid.height], ground.is_opaque(), pixels);
    if config.channels.is_empty() || config.filter != Filter::Box {
        let light = |all: &PixelSamples<'_>| ground.pixel(all);
        let (pixels, stats) = layers.paint_filtered(grid, config.filter, &setup.shader, &light);
        let mut frame = frame(pixels);
        if !config.channels.is_empty() {
            // What is in the middle of a pixel is not filtered.
            let front = |center: &Center<'_>| front(&setup.view, center);
            push_planes(&mut frame, setup, config, &layers.paint_centers(grid, &setup.shader, front));
        }
        return (frame, stats);
    }
    let both = |all: &PixelSamples<'_>| (ground.pixel(all), front(&setup.view, &all.center));
    let (pixels, stats) = layers.paint_with_centers(grid, &setup.shader, &both);
    let (pixels, seen): (Vec<[f32; 4]>, Vec<Option<Hit>>) = pixels.into_iter().unzip();
    let mut frame = frame(pixels);
    push_planes(&mut frame, setup, config, &seen);
    (frame, stats)
}

/// Puts the channels that are asked for beside the light.
fn push_planes(frame: &mut LinearFrame, setup: &Setup<'_>, config: &Config, seen: &[Option<Hit>]) {
    let painter = setup.painter();
    let finder = Finder::new(&painter);
    for &channel in &config.channels {
        planes(channel, &finder, &setup.grid, seen).into_iter().for_each(|plane| frame.push_plane(plane));
    }
}

/// How the picture is to be developed. `frame`: its light, which only an automatic exposure looks at.
pub fn development<F: Borrow<LinearFrame>>(frame: impl FnOnce() -> F, config: &Config) -> Development {
    let stops = match config.exposure {
        None => 0.0,
        Some(Exposure::Stops(stops)) => stops,
        Some(Exposure::Auto) => auto_exposure(frame().borrow(), config.tone),
    };
    Development { stops, tone: config.tone }
}

/// A pixel developed; what part of it is covered stays.
pub fn developed(development: &Development, [red, green, blue, part]: [f32; 4]) -> [f32; 4] {
    let [red, green, blue] = development.apply([red, green, blue]);
    [red, green, blue, part]
}

/// The light of what stands behind everything, developed as it is in the picture; none if that is clear.
pub fn ground(config: &Config, development: Option<Development>) -> Option<[f32; 3]> {
    let [red, green, blue] = Ground::new(config).behind?;
    let light = [red, green, blue, 1.0];
    let [red, green, blue, _] = development.map_or(light, |development| developed(&development, light));
    Some([red, green, blue])
}

/// What stands behind everything, and how many samples a pixel has.
pub struct Ground {
    /// Linear light; `None` if the picture is transparent there.
    behind: Option<[f32; 3]>,
    n_samples: f32,
}

impl Ground {
    /// That of a picture.
    pub fn new(config: &Config) -> Self {
        let behind = match config.background {
            Background::Transparent => None,
            Background::Color(color) => Some(color.to_rgb().map(|channel| srgb_decode(channel) as f32)),
        };
        Self { behind, n_samples: (config.samples * config.samples) as f32 }
    }

    /// True if it is a colour.
    pub fn is_opaque(&self) -> bool {
        self.behind.is_some()
    }

    /// The mean light of a pixel on this ground, or of its covered part if there is none; and that part.
    pub fn pixel(&self, PixelSamples { sum, covered: n_covered, .. }: &PixelSamples<'_>) -> [f32; 4] {
        let n_covered = *n_covered;
        let [red, green, blue] = match self.behind {
            Some(behind) => {
                let n_free = self.n_samples - n_covered;
                std::array::from_fn(|i| (sum[i] + behind[i] * n_free) / self.n_samples)
            }
            None if n_covered == 0.0 => [0.0; 3],
            None => sum.map(|light| light / n_covered),
        };
        [red, green, blue, n_covered / self.n_samples]
    }
}
