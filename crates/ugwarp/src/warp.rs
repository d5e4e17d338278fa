//! From the pixels of a picture to the sky, and their light.

use std::sync::{Mutex, MutexGuard, PoisonError};

use glam::{DQuat, DVec3};
use rayon::prelude::*;
use ugimage::{Compression, Filter, Frame, LinearFrame, Metadata, Quantizer, display_pixel, draw_png};
use ugpicture::lens::{Film, Lens};
use ugpicture::{Backdrop, Emission, SeenItem};
use ugpipe::Progress;
use ugscene::{CameraOptions, Scene, View};
use ugsky::{FlatFilm, Observer, Panorama, Sampler, Seen, SkyRay};

use crate::config::Config;
use crate::error::Error;
use crate::shade::Shade;

/// Rows that one task computes.
const BAND: usize = 32;

/// Columns that are computed for all rows of a task before the next ones, so that their texels stay
/// in the cache.
const TILE: usize = 64;

/// Half the distance of the places whose directions are compared, in samples: less than a half, so
/// that both are in the same view of a picture of several.
const HALF_STEP: f64 = 0.49;

/// The light of neighbouring pixels: red, green and blue, and alpha or the covered part.
type Light = [[f32; Seen::N]; 4];

/// How often the footprint of a sample is divided at most, if it is large on the sky.
const MOST_DIVISIONS: u32 = 24;

/// The directions of a pinhole camera, which are linear in the place.
fn flat_film(lens: Lens, film: &Film) -> Option<FlatFilm> {
    let at = |place: [f64; 2]| film.sight(place).map(|sight| sight.direction);
    if lens != Lens::Pinhole {
        return None;
    }
    let corner = at([0.0, 0.0])?;
    Some(FlatFilm { corner, across: at([1.0, 0.0])? - corner, down: at([0.0, 1.0])? - corner })
}

/// The way of light from the sky to a picture: directions, Doppler factors, and how colours change.
/// It can be used with any number of panoramas.
pub struct Warp {
    size: [u32; 2],
    samples: u32,
    film: Film,
    lens: Lens,
    observer: Observer,
    /// Variance of the reconstruction filter, less that of the places of samples, relative to that
    /// of a sample.
    spread: f64,
    backdrop: Backdrop,
    shade: Shade,
    /// The camera was parallel to its up direction.
    pub(crate) is_up_replaced: bool,
    /// The directions of a pinhole camera.
    flat: Option<FlatFilm>,
}

/// What was found in a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// The brightest channel of a pixel.
    pub max_light: f32,
    /// Pixels that show some of the panorama.
    pub n_covered: u64,
}

/// [`Statistics`] of a part of a picture. The maximum is kept for each index of [`Light`] apart, so
/// that it is computed with SIMD instructions.
#[derive(Clone, Copy, Default)]
struct Found {
    max_light: [f32; Seen::N],
    n_covered: u64,
}

impl Found {
    /// Adds pixels: light times the covered part, and that part.
    #[inline]
    fn add(&mut self, [reds, greens, blues, covered]: &Light) {
        for idx in 0..Seen::N {
            // One instruction; `f32::max` takes several, because of NaN.
            let max = |one: f32, other: f32| if one > other { one } else { other };
            self.max_light[idx] = max(max(reds[idx], greens[idx]), max(blues[idx], self.max_light[idx]));
        }
        self.n_covered += covered.iter().map(|part| u64::from(*part > 0.0)).sum::<u64>();
    }
}

impl Statistics {
    /// Adds the statistics of a part of the picture.
    fn add(&mut self, found: &Found) {
        self.max_light = found.max_light.into_iter().fold(self.max_light, f32::max);
        self.n_covered += found.n_covered;
    }
}

/// The camera of a picture: in the middle of the sky, looking along +y unless options say
/// otherwise.
pub(crate) fn camera(options: &CameraOptions) -> CameraOptions {
    let eye = options.eye.unwrap_or(DVec3::ZERO);
    CameraOptions {
        eye: Some(eye),
        center: Some(options.center.unwrap_or(eye + DVec3::Y)),
        ..options.clone()
    }
}

impl Warp {
    /// The map of a picture's options, with its light.
    ///
    /// # Errors
    /// See [`Error`].
    pub fn new(config: &Config) -> Result<Self, Error> {
        config.check()?;
        let picture = &config.picture;
        let [across, down] = config.lens.frames(false);
        let samples = picture.samples;
        let frame = [picture.size[0] / across * samples, picture.size[1] / down * samples];
        let view = View::new(&Scene::default(), &camera(&picture.camera), frame)?;
        let n = f64::from(samples * samples);
        let variance = match picture.filter {
            Filter::Box => 1.0 / 12.0,
            Filter::Triangle => 1.0 / 6.0,
            Filter::Spline => 1.0 / 4.0,
        };
        let film = Film::new(config.lens, None, &view, frame);
        Ok(Self {
            size: picture.size,
            samples,
            lens: config.lens,
            observer: Observer::new(config.velocity),
            spread: 12.0 * variance * n - n + 1.0,
            backdrop: Backdrop::new(picture.background, 1),
            shade: Shade::new(config)?,
            is_up_replaced: view.is_up_replaced,
            flat: flat_film(config.lens, &film),
            film,
        })
    }

    /// Light brighter than white is kept until it is developed.
    pub(crate) fn is_uncut(&self) -> bool {
        self.shade.is_uncut()
    }

    /// The light of a picture of a panorama, on the background.
    pub fn light(&self, panorama: &Panorama, progress: &dyn Progress) -> (LinearFrame, Statistics) {
        let (pixels, statistics) = self.draw(panorama, progress, |light, pixels| {
            for (idx, pixel) in pixels.iter_mut().enumerate() {
                *pixel = light.map(|channel| channel[idx]);
            }
        });
        (LinearFrame::new(self.size, self.backdrop.is_opaque(), pixels), statistics)
    }

    /// The same display-encoded with 8 bits per channel; light outside 0…1 is clipped.
    pub(crate) fn frame(&self, panorama: &Panorama, progress: &dyn Progress) -> (Frame, Statistics) {
        let (pixels, statistics) = self.draw(panorama, progress, self.encode());
        (Frame::new(self.size, self.backdrop.is_opaque(), pixels), statistics)
    }

    /// The same as a PNG file, which is written while the picture is drawn.
    pub(crate) fn png(
        &self,
        panorama: &Panorama,
        progress: &dyn Progress,
        metadata: &Metadata,
        compression: Compression,
    ) -> (Vec<u8>, Statistics) {
        let drawing = Drawing::new(self, panorama, progress, self.encode());
        let draw = |band: usize, pixels: &mut [[u8; 4]]| drawing.band(band, pixels);
        let file = draw_png(self.size, self.backdrop.is_opaque(), BAND, metadata, compression, draw);
        (file, drawing.statistics())
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

    /// The pixels of a picture of a panorama. `finish` converts linear light and alpha to pixels.
    fn draw<T: Copy + Default + Send>(
        &self,
        panorama: &Panorama,
        progress: &dyn Progress,
        finish: impl Fn(&Light, &mut [T]) + Sync,
    ) -> (Vec<T>, Statistics) {
        let [width, height] = self.size.map(|side| side as usize);
        let mut pixels = vec![T::default(); width * height];
        let drawing = Drawing::new(self, panorama, progress, finish);
        pixels.par_chunks_mut(BAND * width).enumerate().for_each(|(band, pixels)| drawing.band(band, pixels));
        (pixels, drawing.statistics())
    }

    /// A black sky on the background, which is outside the circle of a fisheye.
    pub fn darkness(&self) -> (LinearFrame, Statistics) {
        let (n, width) = (f64::from(self.samples), self.size[0] as usize);
        let covered = |idx: usize| {
            let place = [idx % width, idx / width].map(|at| n * (at as f64 + 0.5));
            f32::from(self.film.sight(place).is_some())
        };
        let n_pixels = width * self.size[1] as usize;
        let pixel = |idx: usize| self.backdrop.pixel([0.0; 3], covered(idx));
        let pixels: Vec<[f32; 4]> = (0..n_pixels).into_par_iter().map(pixel).collect();
        let n_covered = pixels.par_iter().filter(|pixel| pixel[3] > 0.0).count() as u64;
        let statistics = Statistics { max_light: 0.0, n_covered };
        (LinearFrame::new(self.size, self.backdrop.is_opaque(), pixels), statistics)
    }

    /// The light of `n_pixels` pixels of a row from column `left` on: the mean of their samples,
    /// times the covered part, and that part. `found`: a buffer for a row of samples.
    fn row(
        &self,
        sampler: &mut Sampler<'_>,
        found: &mut [Seen],
        [left, row]: [usize; 2],
        n_pixels: usize,
    ) -> [Light; TILE / Seen::N] {
        let n = self.samples as usize;
        let mut light = [[[0.0; Seen::N]; 4]; TILE / Seen::N];
        let found = &mut found[..(n * n_pixels).div_ceil(Seen::N)];
        let left = (left * n) as f64 + 0.5;
        for y in row * n..(row + 1) * n {
            self.see_row(sampler, found, [left, y as f64 + 0.5], n * n_pixels);
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

    /// Light on the background, from light times the covered part, and that part.
    fn composite(&self, light: &mut Light) {
        if light[3] == [1.0; Seen::N] {
            // Nothing of the background is seen.
            return;
        }
        for idx in 0..Seen::N {
            let [red, green, blue, covered] = light.map(|channel| channel[idx]);
            if covered != 1.0 {
                let pixel = self.backdrop.pixel([red, green, blue], covered);
                light.iter_mut().zip(pixel).for_each(|(channel, part)| channel[idx] = part);
            }
        }
    }

    /// The light of `n` samples of a row of the film as seen, times the covered part, and that part.
    fn see_row(&self, sampler: &mut Sampler<'_>, found: &mut [Seen], [left, y]: [f64; 2], n: usize) {
        match &self.flat {
            Some(flat) => sampler.flat_row(&self.observer, flat, [left, y], self.spread, found),
            None => found.fill(Seen::default()),
        }
        for (first, seen) in found.iter_mut().enumerate() {
            let place = |idx: usize| [left + (first * Seen::N + idx) as f64, y];
            let n = Seen::N.min(n - first * Seen::N);
            if seen.is_found != [true; Seen::N] {
                for idx in 0..n {
                    if !seen.is_found[idx]
                        && let Some((light, doppler)) = self.sample(sampler, place(idx))
                    {
                        seen.set(idx, light, doppler);
                    }
                }
            }
            self.shade.see(&mut seen.light, &seen.doppler);
            if seen.is_found != [true; Seen::N] {
                for idx in 0..n {
                    if !seen.is_found[idx] {
                        seen.set(idx, self.divided(sampler, place(idx), 1.0, 0), 1.0);
                    }
                }
            }
        }
    }

    /// The light of a sample, and its Doppler factor; `None` where its footprint is too large.
    fn sample(&self, sampler: &mut Sampler<'_>, place: [f64; 2]) -> Option<([f32; 4], f64)> {
        let Some(ray) = self.ray(place, 1.0) else { return Some(([0.0; 4], 1.0)) };
        sampler.light(&ray, self.spread).map(|light| (light, ray.doppler))
    }

    /// The light of a square of the film, `side` samples wide, as seen.
    fn square(&self, sampler: &mut Sampler<'_>, place: [f64; 2], side: f64, depth: u32) -> [f32; 4] {
        let Some(ray) = self.ray(place, side) else { return [0.0; 4] };
        match sampler.light(&ray, self.spread) {
            Some(light) => {
                let mut seen = light.map(|part| [part; Seen::N]);
                self.shade.see(&mut seen, &[ray.doppler as f32; Seen::N]);
                seen.map(|part| part[0])
            }
            None if depth < MOST_DIVISIONS => self.divided(sampler, place, side, depth),
            // The footprint still covers nearly the whole sky. At this depth it weighs at most 4⁻²⁴
            // of a sample, so it is left out.
            None => [0.0; 4],
        }
    }

    /// The mean of the four quarters of a square, whose footprint is too large.
    fn divided(&self, sampler: &mut Sampler<'_>, place: [f64; 2], side: f64, depth: u32) -> [f32; 4] {
        let mut sum = [0.0_f32; 4];
        for [right, below] in [[-0.25, -0.25], [0.25, -0.25], [-0.25, 0.25], [0.25, 0.25]] {
            let quarter = [place[0] + right * side, place[1] + below * side];
            let light = self.square(sampler, quarter, 0.5 * side, depth + 1);
            (0..4).for_each(|channel| sum[channel] += 0.25 * light[channel]);
        }
        sum
    }

    /// The ray of a square of the film, `side` samples wide; `None` where the lens shows nothing.
    #[inline]
    fn ray(&self, [x, y]: [f64; 2], side: f64) -> Option<SkyRay> {
        let seen = |place: [f64; 2]| self.film.sight(place).map(|sight| sight.direction);
        let direction = seen([x, y])?;
        let step = HALF_STEP * side;
        if self.lens == Lens::Pinhole {
            // Directions of depth 1 are linear in the place on the film.
            let inverse = 1.0 / direction.length();
            let unit = direction * inverse;
            let slope = |place: [f64; 2]| {
                let difference = (seen(place).unwrap_or(direction) - direction) * (inverse / HALF_STEP);
                difference - unit.dot(difference) * unit
            };
            return Some(self.observer.ray(unit, [slope([x + step, y]), slope([x, y + step])]));
        }
        let slope = |[right, below]: [f64; 2]| {
            let ends = [-1.0, 1.0].map(|sign| seen([x + sign * right * step, y + sign * below * step]));
            let difference = match ends {
                [Some(before), Some(after)] => (after - before) / (2.0 * HALF_STEP),
                [Some(before), None] => (direction - before) / HALF_STEP,
                [None, Some(after)] => (after - direction) / HALF_STEP,
                [None, None] => DVec3::ZERO,
            };
            difference - direction.dot(difference) * direction
        };
        Some(self.observer.ray(direction, [slope([1.0, 0.0]), slope([0.0, 1.0])]))
    }

    /// What is seen at the middles of pixels, as channels and legends need it: light that was
    /// emitted far away, in the frame of the sky.
    pub(crate) fn seen_item(&self, idx: usize) -> Option<SeenItem> {
        let n = f64::from(self.samples);
        let width = self.size[0] as usize;
        let place = [idx % width, idx / width].map(|at| n * (at as f64 + 0.5));
        let direction = self.film.sight(place)?.direction.normalize();
        let emission = Emission {
            place: direction,
            depth: f64::INFINITY,
            time: f64::NEG_INFINITY,
            velocity: -self.observer.velocity(),
            // The axes of the panorama are those of a single boost to the observer.
            scene_from_axes: DQuat::IDENTITY,
            in_medium: None,
        };
        Some((0, emission))
    }
}

/// A picture of a panorama, of which bands are drawn in any order on any threads.
struct Drawing<'a, F> {
    warp: &'a Warp,
    panorama: &'a Panorama,
    progress: &'a dyn Progress,
    /// Converts linear light and alpha to pixels.
    finish: F,
    /// Buffers of all threads.
    buffers: Mutex<Vec<(Sampler<'a>, Vec<Seen>)>>,
    /// Statistics of the bands that are drawn.
    statistics: Mutex<Statistics>,
}

impl<'a, F> Drawing<'a, F> {
    fn new(warp: &'a Warp, panorama: &'a Panorama, progress: &'a dyn Progress, finish: F) -> Self {
        progress.step("warping", warp.size[1].div_ceil(BAND as u32).into());
        Self { warp, panorama, progress, finish, buffers: Mutex::default(), statistics: Mutex::default() }
    }

    /// Draws [`BAND`] rows of pixels, or the last ones.
    fn band<T>(&self, band: usize, pixels: &mut [T])
    where
        F: Fn(&Light, &mut [T]),
    {
        let (warp, width) = (self.warp, self.warp.size[0] as usize);
        let kept = lock(&self.buffers).pop();
        let (mut sampler, mut found) = kept.unwrap_or_else(|| {
            let n_chunks = (TILE * warp.samples as usize).div_ceil(Seen::N);
            (self.panorama.sampler(), vec![Seen::default(); n_chunks])
        });
        let mut statistics = Found::default();
        for left in (0..width).step_by(TILE) {
            for (idx, row) in pixels.chunks_mut(width).enumerate() {
                let row = &mut row[left..width.min(left + TILE)];
                let mut light = warp.row(&mut sampler, &mut found, [left, band * BAND + idx], row.len());
                for (pixels, light) in row.chunks_mut(Seen::N).zip(&mut light) {
                    // There is nothing after the end of the row.
                    light.iter_mut().for_each(|channel| channel[pixels.len()..].fill(0.0));
                    statistics.add(light);
                    warp.composite(light);
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
