//! Pixels from samples: averaged in linear light, put on the background, and developed for a
//! display if the format requires it.

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch, f32x16, i32x16};
use ugimage::{Filter, Frame, LinearFrame, Quantizer, ROUNDING_OFFSET, display_pixel};
use ugpicture::{Backdrop, DrawnContent, Emissions, PictureOptions, SurfaceSample};
use ugpipe::Progress;
use ugraster::{Center, Encoding, Keep, PixelSamples, RUN, Resolve, ResolveSingle, SampleStats};
use ugscene::View;
use ugskybox::{SkyCamera, drawn_on};
use ugtrace::lens::Lens;

use crate::center_surface::center_surface;
use crate::config::Config;
use crate::error::Error;
use crate::render_layers::{RenderLayers, with_rasterizer};
use crate::setup::Setup;

/// Draws the scene as light, or directly as 8-bit levels if no exposure, tone curve or channel is
/// requested.
///
/// # Errors
/// See [`Error`].
pub fn draw(
    setup: &Setup<'_>,
    layers: &RenderLayers<'_>,
    config: &Config,
    progress: &dyn Progress,
) -> Result<(DrawnContent, SampleStats), Error> {
    let is_deep = config.picture.output.format().is_deep();
    if !is_deep && !setup.keeps_highlights && !config.sky.is_some() {
        let (frame, stats) = display(setup, layers, config);
        return Ok((DrawnContent::Display(frame), stats));
    }
    let (frame, stats) = light_with_sky(setup, layers, config, progress)?;
    let keeps_highlights =
        setup.keeps_highlights || config.sky.is_some() && config.shift(setup.scene()).is_spectral();
    Ok((DrawnContent::Light { frame, is_clipped: !keeps_highlights }, stats))
}

/// The light of the scene with its sky behind it, and the requested channels.
///
/// # Errors
/// See [`Error`].
pub fn light_with_sky(
    setup: &Setup<'_>,
    layers: &RenderLayers<'_>,
    config: &Config,
    progress: &dyn Progress,
) -> Result<(LinearFrame, SampleStats), Error> {
    let (mut frame, mut stats) = light(setup, layers, config);
    if config.sky.is_some() {
        let camera = SkyCamera {
            view: &View::new(setup.scene(), &config.picture.camera, config.picture.size)?,
            lens: Lens::Pinhole,
            is_stereo: false,
            crop: None,
            velocity: ugscene::camera_velocity(setup.scene()),
            shift: config.shift(setup.scene()),
            keeps_light: setup.keeps_highlights,
            picture: &config.picture,
        };
        let brightest = config.sky.put_behind(&mut frame, &camera, progress)?;
        stats.max_intensity = stats.max_intensity.max(brightest);
    }
    Ok((frame, stats))
}

/// The whole picture as 8-bit levels.
fn display(setup: &Setup<'_>, layers: &RenderLayers<'_>, config: &Config) -> (Frame, SampleStats) {
    let grid = &setup.grid;
    let finish = Display::new(&config.picture);
    let (pixels, stats) = layers.paint(config.picture.filter, &finish);
    (Frame::new([grid.width, grid.height], finish.backdrop.is_opaque(), pixels), stats)
}

/// Converts samples to display levels.
pub struct Display {
    backdrop: Backdrop,
    quantizer: Quantizer,
}

impl Display {
    /// The conversion for a picture.
    pub fn new(picture: &PictureOptions) -> Self {
        Self { backdrop: backdrop(picture), quantizer: Quantizer::new() }
    }
}

impl Resolve<[u8; 4]> for Display {
    #[inline]
    fn pixel(&self, all: &PixelSamples<'_>) -> [u8; 4] {
        display_pixel(&self.quantizer, mean(&self.backdrop, all), self.backdrop.is_opaque())
    }

    fn single(&self) -> Option<&dyn ResolveSingle<[u8; 4]>> {
        Some(self)
    }
}

impl ResolveSingle<[u8; 4]> for Display {
    fn encoding(&self) -> Encoding {
        Encoding::Display
    }

    fn pixels(&self, keys: &[f32], levels: &[[f32; RUN]; 3], pixels: &mut [[u8; 4]]) {
        dispatch!(Level::new(), simd => write_levels(simd, keys, levels, pixels));
    }
}

/// Rounds levels in 0…1 to the nearest of 256, where there are depth keys.
#[inline(always)] // Compiled for the SIMD instructions of the processor.
fn write_levels<S: Simd>(simd: S, keys: &[f32], levels: &[[f32; RUN]; 3], pixels: &mut [[u8; 4]]) {
    let [red, green, blue] = levels;
    let all = red.as_chunks().0.iter().zip(green.as_chunks().0).zip(blue.as_chunks().0);
    for ((keys, pixels), ((red, green), blue)) in
        keys.chunks(LANES).zip(pixels.chunks_mut(LANES)).zip(all)
    {
        let (red, green, blue) = (bytes(simd, red), bytes(simd, green), bytes(simd, blue));
        let shown =
            red | green << 8 | blue << 16 | i32x16::splat(simd, i32::from_le_bytes([0, 0, 0, 255]));
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

/// The nearest of 256 levels for numbers in 0…1.
#[inline(always)]
fn bytes<S: Simd>(simd: S, levels: &[f32; LANES]) -> i32x16<S> {
    // The conversion truncates.
    simd.cvt_i32_f32x16(f32x16::from_slice(simd, levels) * 255.0 + ROUNDING_OFFSET as f32)
}

/// Adds up the light of samples on a background.
struct Light<'a>(&'a Backdrop);

impl Resolve<[f32; 4]> for Light<'_> {
    #[inline]
    fn pixel(&self, all: &PixelSamples<'_>) -> [f32; 4] {
        mean(self.0, all)
    }

    fn single(&self) -> Option<&dyn ResolveSingle<[f32; 4]>> {
        Some(self)
    }
}

impl ResolveSingle<[f32; 4]> for Light<'_> {
    fn encoding(&self) -> Encoding {
        Encoding::Linear
    }

    fn pixels(&self, keys: &[f32], light: &[[f32; RUN]; 3], pixels: &mut [[f32; 4]]) {
        let covered =
            keys.iter().zip(pixels).enumerate().filter(|(_, (key, _))| **key > f32::NEG_INFINITY);
        for (idx, (_, pixel)) in covered {
            *pixel = self.0.pixel(light.each_ref().map(|channel| channel[idx]), 1.0);
        }
    }
}

/// The whole picture of the scene as light, with the requested channels.
pub fn light(
    setup: &Setup<'_>,
    layers: &RenderLayers<'_>,
    config: &Config,
) -> (LinearFrame, SampleStats) {
    let grid = &setup.grid;
    let PictureOptions { filter, channels, .. } = &config.picture;
    let background = drawn_on(&config.sky, config.picture.background);
    let backdrop = Backdrop::new(background, config.picture.samples);
    let frame = |pixels| LinearFrame::new([grid.width, grid.height], backdrop.is_opaque(), pixels);
    if channels.is_empty() || *filter != Filter::Box {
        let (pixels, stats) = layers.paint(*filter, &Light(&backdrop));
        let mut frame = frame(pixels);
        if !channels.is_empty() {
            // Channels show the middle of a pixel and are not filtered.
            let seen = |center: &Center<'_>| center_surface(&setup.view, center);
            let seen = with_rasterizer!(layers, |all| all.paint_centers(seen, &layers.progress()));
            push_channels(&mut frame, setup, config, &seen);
        }
        return (frame, stats);
    }
    let both =
        |all: &PixelSamples<'_>| (mean(&backdrop, all), center_surface(&setup.view, &all.center));
    let (pixels, stats) = with_rasterizer!(layers, |rasterizer| {
        rasterizer.paint(layers.shader, Keep::Centers, &both, &layers.progress())
    });
    let (pixels, seen): (Vec<[f32; 4]>, Vec<Option<SurfaceSample>>) = pixels.into_iter().unzip();
    let mut frame = frame(pixels);
    push_channels(&mut frame, setup, config, &seen);
    (frame, stats)
}

/// Adds the requested channels. `seen`: the surfaces at the middles of the pixels.
fn push_channels(
    frame: &mut LinearFrame,
    setup: &Setup<'_>,
    config: &Config,
    seen: &[Option<SurfaceSample>],
) {
    let emissions = Emissions::new(setup.scene(), &setup.view, setup.appearance.surface.frames());
    let grid = [setup.grid.width, setup.grid.samples];
    let at = |idx| emissions.at_pixel(grid, seen, idx);
    ugpicture::push_channels(frame, &config.picture.channels, setup.view.eye, &at);
}

/// The background of a picture.
pub fn backdrop(picture: &PictureOptions) -> Backdrop {
    Backdrop::new(picture.background, picture.samples)
}

/// The mean light of a pixel, and its covered part.
pub fn mean(backdrop: &Backdrop, all: &PixelSamples<'_>) -> [f32; 4] {
    backdrop.pixel(all.sum, all.covered)
}
