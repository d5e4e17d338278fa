//! From the pixels of a picture to the sky, and their light.

use std::sync::{Mutex, MutexGuard, PoisonError};

use glam::{DQuat, DVec3};
use rayon::prelude::*;
use ugimage::{Filter, Frame, LinearFrame, Quantizer, display_pixel};
use ugphysics::luminance;
use ugpicture::{Backdrop, Background, Emission, SeenItem};
use ugpipe::Progress;
use ugsky::{
    BasisError, FlatFilm, Layer, Observer, Panorama, PanoramaPart, Reach, ReachFinder, Sampler,
    Seen, Sky, SkyLight, SkyView,
};
use ugtrace::lens::{Film, Lens};

use crate::picture::SkyPicture;

/// Rows that one task computes.
const BAND: usize = 32;

/// Columns that are computed for all rows of a task before the next ones, so that their texels stay
/// in the cache.
const TILE: usize = 64;

/// Light of which no 8-bit level is made: rounding leaves less than that of black, also below 0.
const DARK: f64 = 1e-4;

/// The light of neighbouring pixels: red, green and blue, and alpha or the covered part.
type Light = [[f32; Seen::N]; 4];

/// The directions of a pinhole camera, which are linear in the place.
fn flat_film(lens: Lens, film: &Film, [left, top]: [f64; 2]) -> Option<FlatFilm> {
    let at = |place: [f64; 2]| {
        film.sight([left + place[0], top + place[1]]).map(|sight| sight.direction)
    };
    if lens != Lens::Pinhole {
        return None;
    }
    let corner = at([0.0, 0.0])?;
    Some(FlatFilm { corner, across: at([1.0, 0.0])? - corner, down: at([0.0, 1.0])? - corner })
}

/// The way of light from a sky to a picture: directions, Doppler factors, and how colours change.
pub struct Warp<'s> {
    size: [u32; 2],
    samples: u32,
    film: Film,
    view: SkyView,
    backdrop: Backdrop,
    /// The panorama, unless there are only stars.
    panorama: Option<Layer<'s>>,
    /// Infrared and ultraviolet light.
    bands: Vec<Layer<'s>>,
    /// The upper left corner of the part that is drawn, in samples.
    corner: [f64; 2],
}

/// The findings in a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// The brightest channel of a pixel.
    pub max_light: f32,
    /// Pixels that show some of the panorama.
    pub n_covered: u64,
    /// Pixels of negative luminance, which has light with a negative amount of a black body. They
    /// are shown as black.
    pub n_negative: u64,
}

/// [`Statistics`] of a part of a picture, for each index of [`Light`] apart, so that they are
/// computed with SIMD instructions.
#[derive(Clone, Copy, Default)]
struct Found {
    max_light: [f32; Seen::N],
    n_covered: [u32; Seen::N],
    n_negative: [u32; Seen::N],
}

impl Found {
    /// Adds pixels: light times the covered part, and that part.
    #[inline]
    fn add(&mut self, [reds, greens, blues, covered]: &Light) {
        // One instruction; `f32::max` takes several, because of NaN.
        let max = |one: f32, other: f32| if one > other { one } else { other };
        for idx in 0..Seen::N {
            self.max_light[idx] =
                max(max(reds[idx], greens[idx]), max(blues[idx], self.max_light[idx]));
            self.n_covered[idx] += u32::from(covered[idx] > 0.0);
        }
        for idx in 0..Seen::N {
            let luminance = luminance([reds, greens, blues].map(|channel| channel[idx].into()));
            self.n_negative[idx] += u32::from(luminance < -DARK);
        }
    }
}

impl Statistics {
    /// Adds the statistics of a part of the picture.
    fn add(&mut self, found: &Found) {
        self.max_light = found.max_light.into_iter().fold(self.max_light, f32::max);
        let sum = |numbers: [u32; Seen::N]| numbers.map(u64::from).iter().sum::<u64>();
        self.n_covered += sum(found.n_covered);
        self.n_negative += sum(found.n_negative);
    }
}

impl<'s> Warp<'s> {
    /// The map of a picture to a sky, with its light.
    ///
    /// # Errors
    /// [`BasisError`].
    pub fn new(sky: Sky<'s>, picture: &SkyPicture) -> Result<Self, BasisError> {
        let samples = picture.samples;
        let n = f64::from(samples * samples);
        let variance = match picture.filter {
            Filter::Box => 1.0 / 12.0,
            Filter::Triangle => 1.0 / 6.0,
            Filter::Spline => 1.0 / 4.0,
        };
        let [left, top, width, height] = picture.part;
        let corner = [left, top].map(|at| f64::from(at * samples));
        let mut layers =
            sky.layers(picture.colors, picture.velocity, &picture.range_nm, picture.keeps_light)?;
        let bands = layers.split_off(layers.len() - sky.bands.len());
        Ok(Self {
            size: [width, height],
            samples,
            view: SkyView {
                observer: Observer::new(picture.velocity),
                // Less the variance of the places of samples.
                spread: 12.0 * variance * n - n + 1.0,
                flat: flat_film(picture.lens, &picture.film, corner),
            },
            backdrop: Backdrop::new(picture.background, 1),
            panorama: layers.pop(),
            bands,
            film: picture.film,
            corner,
        })
    }

    /// The panorama, if its light is clipped at white, as in 1988, and alone.
    pub fn clipped(&self) -> Option<&Layer<'s>> {
        self.panorama
            .as_ref()
            .filter(|layer| self.bands.is_empty() && !layer.shade.keeps_highlights())
    }

    /// Light brighter than white is kept until it is developed.
    pub fn keeps_highlights(&self) -> bool {
        self.panorama.as_ref().is_none_or(|layer| layer.shade.keeps_highlights())
    }

    /// The light of a picture of panoramas, on the background.
    pub fn light(&self, progress: &dyn Progress) -> (LinearFrame, Statistics) {
        let (mut frame, mut statistics) = match &self.panorama {
            Some(layer) => self.light_of(layer, &self.backdrop, progress),
            None => self.darkness(),
        };
        for band in &self.bands {
            progress.step("light outside the visible range", 0);
            let (light, _) = self.light_of(band, &Backdrop::new(Background::Transparent, 1), &());
            let sums =
                frame.pixels_mut().par_iter_mut().zip(light.pixels()).map(|(pixel, light)| {
                    (0..3).for_each(|channel| pixel[channel] += light[channel]);
                    pixel[..3].iter().fold(0.0, |most: f32, part| most.max(*part))
                });
            statistics.max_light = sums.reduce(|| statistics.max_light, f32::max);
        }
        (frame, statistics)
    }

    /// The light of a layer, on a background.
    fn light_of(
        &self,
        layer: &Layer<'s>,
        backdrop: &Backdrop,
        progress: &dyn Progress,
    ) -> (LinearFrame, Statistics) {
        let finish = |light: &Light, pixels: &mut [[f32; 4]]| {
            for (idx, pixel) in pixels.iter_mut().enumerate() {
                *pixel = light.map(|channel| channel[idx]);
            }
        };
        let (pixels, statistics) = Drawing::new(self, layer, backdrop, progress, finish).pixels();
        (LinearFrame::new(self.size, backdrop.is_opaque(), pixels), statistics)
    }

    /// The light of a layer display-encoded with 8 bits per channel; light outside 0…1 is clipped.
    pub fn frame(&self, layer: &Layer<'s>, progress: &dyn Progress) -> (Frame, Statistics) {
        let drawing = Drawing::new(self, layer, &self.backdrop, progress, self.encode());
        let (pixels, statistics) = drawing.pixels();
        (Frame::new(self.size, self.backdrop.is_opaque(), pixels), statistics)
    }

    /// From light to 8-bit pixels.
    fn encode(&self) -> impl Fn(&Light, &mut [[u8; 4]]) + Sync {
        let (quantizer, is_opaque) = (Quantizer::new(), self.backdrop.is_opaque());
        move |light, pixels| {
            if is_opaque {
                let [reds, greens, blues, _] = light;
                let (reds, greens) = (quantizer.levels(reds), quantizer.levels(greens));
                let blues = quantizer.levels(blues);
                for (idx, pixel) in pixels.iter_mut().enumerate() {
                    *pixel = [reds[idx], greens[idx], blues[idx], 255];
                }
            } else {
                for (idx, pixel) in pixels.iter_mut().enumerate() {
                    *pixel = display_pixel(&quantizer, light.map(|channel| channel[idx]), false);
                }
            }
        }
    }

    /// The direction seen at a place, in samples from the corner of the part that is drawn.
    fn sight(&self, [x, y]: [f64; 2]) -> Option<DVec3> {
        self.film.sight([self.corner[0] + x, self.corner[1] + y]).map(|sight| sight.direction)
    }

    /// A black sky on the background, which is outside the circle of a fisheye.
    fn darkness(&self) -> (LinearFrame, Statistics) {
        let (n, width) = (f64::from(self.samples), self.size[0] as usize);
        let covered = |idx: usize| {
            let place = [idx % width, idx / width].map(|at| n * (at as f64 + 0.5));
            f32::from(self.sight(place).is_some())
        };
        let n_pixels = width * self.size[1] as usize;
        let pixel = |idx: usize| self.backdrop.pixel([0.0; 3], covered(idx));
        let pixels: Vec<[f32; 4]> = (0..n_pixels).into_par_iter().map(pixel).collect();
        let n_covered = pixels.par_iter().filter(|pixel| pixel[3] > 0.0).count() as u64;
        let statistics = Statistics { max_light: 0.0, n_covered, n_negative: 0 };
        (LinearFrame::new(self.size, self.backdrop.is_opaque(), pixels), statistics)
    }

    /// The panorama, and the part of it that the picture reads, with the sides of a pixel of the
    /// picture. `None` if it reads nothing, or there are only stars.
    pub fn part(&self, progress: &dyn Progress) -> Option<(&'s Panorama, PanoramaPart)> {
        let panorama = self.panorama.as_ref().or(self.bands.first())?.panorama;
        let [columns, rows] = self.size.map(|side| (side * self.samples) as usize);
        let n_bands = rows.div_ceil(BAND);
        progress.step("measuring", n_bands as u64);
        let reach_of_band = |band: usize| {
            let mut finder = ReachFinder {
                view: &self.view,
                film: |place: [f64; 2]| self.sight(place),
                sampler: &mut panorama.sampler(),
                reach: Reach::new(panorama),
            };
            if !progress.is_stopped() {
                for row in band * BAND..rows.min((band + 1) * BAND) {
                    (0..columns).for_each(|column| {
                        finder.add([column, row].map(|at| at as f64 + 0.5));
                    });
                }
            }
            progress.done(1);
            finder.reach
        };
        let reaches = (0..n_bands).into_par_iter().map(reach_of_band);
        let reach = reaches.reduce(|| Reach::new(panorama), |sum, reach| sum.and(&reach));
        let part = reach.part(panorama)?;
        let sides = part.sides.map(|side| side * f64::from(self.samples));
        Some((panorama, PanoramaPart { sides, ..part }))
    }

    /// The surfaces at the middles of pixels, for channels and legends: light that was
    /// emitted far away, in the frame of the sky.
    pub fn seen_item(&self, idx: usize) -> Option<SeenItem> {
        self.seen_at(f64::from(self.samples), self.size[0] as usize, idx)
    }

    /// What is seen at the middle of a sample, counted row after row.
    pub fn seen_sample(&self, idx: usize) -> Option<SeenItem> {
        self.seen_at(1.0, self.size[0] as usize * self.samples as usize, idx)
    }

    /// What is seen at the middle of a square `side` samples wide, of `width` in a row.
    fn seen_at(&self, side: f64, width: usize, idx: usize) -> Option<SeenItem> {
        let place = [idx % width, idx / width].map(|at| side * (at as f64 + 0.5));
        let direction = self.sight(place)?.normalize();
        let emission = Emission {
            place: direction,
            depth: f64::INFINITY,
            time: f64::NEG_INFINITY,
            velocity: -self.view.observer.velocity(),
            own_time: None,
            // The axes of the panorama are those of a single boost to the observer.
            scene_from_axes: DQuat::IDENTITY,
            in_medium: None,
        };
        Some((0, emission))
    }
}

/// A picture of a panorama, of which bands are drawn in any order on any threads.
struct Drawing<'a, F> {
    warp: &'a Warp<'a>,
    layer: &'a Layer<'a>,
    backdrop: &'a Backdrop,
    progress: &'a dyn Progress,
    /// Converts linear light and alpha to pixels.
    finish: F,
    /// Buffers of all threads.
    buffers: Mutex<Vec<(Sampler<'a>, Vec<Seen>)>>,
    /// Statistics of the bands that are drawn.
    statistics: Mutex<Statistics>,
}

impl<'a, F> Drawing<'a, F> {
    fn new(
        warp: &'a Warp<'_>,
        layer: &'a Layer<'_>,
        backdrop: &'a Backdrop,
        progress: &'a dyn Progress,
        finish: F,
    ) -> Self {
        progress.step("warping", warp.size[1].div_ceil(BAND as u32).into());
        let (buffers, statistics) = (Mutex::default(), Mutex::default());
        Self { warp, layer, backdrop, progress, finish, buffers, statistics }
    }

    /// All pixels.
    fn pixels<T: Copy + Default + Send>(self) -> (Vec<T>, Statistics)
    where
        F: Fn(&Light, &mut [T]) + Sync,
    {
        let [width, height] = self.warp.size.map(|side| side as usize);
        let mut pixels = vec![T::default(); width * height];
        pixels
            .par_chunks_mut(BAND * width)
            .enumerate()
            .for_each(|(band, pixels)| self.band(band, pixels));
        (pixels, self.statistics())
    }

    /// Draws [`BAND`] rows of pixels, or the last ones.
    fn band<T>(&self, band: usize, pixels: &mut [T])
    where
        F: Fn(&Light, &mut [T]),
    {
        if self.progress.is_stopped() {
            return;
        }
        let (warp, width) = (self.warp, self.warp.size[0] as usize);
        let kept = lock(&self.buffers).pop();
        let (mut sampler, mut found) = kept.unwrap_or_else(|| {
            let n_chunks = (TILE * warp.samples as usize).div_ceil(Seen::N);
            (self.layer.panorama.sampler(), vec![Seen::default(); n_chunks])
        });
        let film = |place: [f64; 2]| warp.sight(place);
        let shade = &self.layer.shade;
        let mut sky = SkyLight { view: &warp.view, film, shade, sampler: &mut sampler };
        let mut statistics = Found::default();
        for left in (0..width).step_by(TILE) {
            for (idx, row) in pixels.chunks_mut(width).enumerate() {
                let row = &mut row[left..width.min(left + TILE)];
                let place = [left, band * BAND + idx];
                let mut light =
                    light_of_row(&mut sky, &mut found, place, row.len(), warp.samples as usize);
                for (pixels, light) in row.chunks_mut(Seen::N).zip(&mut light) {
                    // There is nothing after the end of the row.
                    light.iter_mut().for_each(|channel| channel[pixels.len()..].fill(0.0));
                    statistics.add(light);
                    composite(self.backdrop, light);
                    (self.finish)(light, pixels);
                }
            }
        }
        lock(&self.buffers).push((sampler, found));
        lock(&self.statistics).add(&statistics);
        self.progress.done(1);
    }

    fn statistics(self) -> Statistics {
        self.statistics.into_inner().unwrap_or_else(PoisonError::into_inner)
    }
}

fn lock<T>(value: &Mutex<T>) -> MutexGuard<'_, T> {
    value.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The light of `n_pixels` pixels of a row from column `left` on: the mean of their `n` × `n`
/// samples, times the covered part, and that part. `found`: a buffer for a row of samples.
fn light_of_row<F: Fn([f64; 2]) -> Option<DVec3>>(
    sky: &mut SkyLight<'_, '_, F>,
    found: &mut [Seen],
    [left, row]: [usize; 2],
    n_pixels: usize,
    n: usize,
) -> [Light; TILE / Seen::N] {
    let mut light = [[[0.0; Seen::N]; 4]; TILE / Seen::N];
    let found = &mut found[..(n * n_pixels).div_ceil(Seen::N)];
    let left = (left * n) as f64 + 0.5;
    for y in row * n..(row + 1) * n {
        sky.row(found, [left, y as f64 + 0.5], n * n_pixels);
        if n == 1 {
            light.iter_mut().zip(&*found).for_each(|(light, seen)| *light = seen.light);
            return light;
        }
        for (first, seen) in found.iter().enumerate() {
            for idx in 0..Seen::N.min(n * n_pixels - first * Seen::N) {
                let pixel = (first * Seen::N + idx) / n;
                let sums = &mut light[pixel / Seen::N];
                for (sums, values) in sums.iter_mut().zip(&seen.light) {
                    sums[pixel % Seen::N] += values[idx];
                }
            }
        }
    }
    let part = 1.0 / (n * n) as f32;
    light.as_flattened_mut().as_flattened_mut().iter_mut().for_each(|sum| *sum *= part);
    light
}

/// Light on a background, from light times the covered part, and that part.
fn composite(backdrop: &Backdrop, light: &mut Light) {
    if light[3] == [1.0; Seen::N] {
        // Nothing of the background is seen.
        return;
    }
    for idx in 0..Seen::N {
        let [red, green, blue, covered] = light.map(|channel| channel[idx]);
        if covered != 1.0 {
            let pixel = backdrop.pixel([red, green, blue], covered);
            light.iter_mut().zip(pixel).for_each(|(channel, part)| channel[idx] = part);
        }
    }
}
