//! From the pixels of a picture to the sky, and their light.

use glam::DVec3;
use rayon::prelude::*;
use ugimage::{Filter, LinearFrame};
use ugparse::Scene;
use ugpicture::lens::{Film, Lens};
use ugpicture::{Backdrop, Background, Emission, SeenItem};
use ugpipe::Progress;
use ugscene::{CameraOptions, View};
use ugsky::{FlatFilm, Observer, Panorama, Sampler, Seen, SkyRay};

use crate::config::Config;
use crate::error::Error;
use crate::shade::Shade;

/// Rows that one task computes.
const BAND: usize = 8;

/// Half the distance of the places whose directions are compared, in samples: less than a half, so
/// that both are in the same view of a picture of several.
const HALF_STEP: f64 = 0.49;

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
    background: Background,
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
            background: picture.background,
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
        let [width, height] = self.size.map(|side| side as usize);
        let backdrop = Backdrop::new(self.background, 1);
        let mut pixels = vec![[0.0; 4]; width * height];
        progress.step("warping", height.div_ceil(BAND) as u64);
        let bands = pixels.par_chunks_mut(BAND * width).enumerate();
        let statistics = bands.map_init(
            || (panorama.sampler(), vec![None; width * self.samples as usize]),
            |(sampler, row), (band, pixels)| {
                let mut statistics = Statistics::default();
                for (idx, pixels) in pixels.chunks_mut(width).enumerate() {
                    self.add_row(sampler, row, band * BAND + idx, pixels);
                    for pixel in pixels {
                        let [red, green, blue, covered] = *pixel;
                        *pixel = backdrop.pixel([red, green, blue], covered);
                        if covered > 0.0 {
                            statistics.n_covered += 1;
                            statistics.max_light = statistics.max_light.max(red).max(green).max(blue);
                        }
                    }
                }
                progress.done(1);
                statistics
            },
        );
        let statistics = statistics.reduce(Statistics::default, |one, other| Statistics {
            max_light: one.max_light.max(other.max_light),
            n_covered: one.n_covered + other.n_covered,
        });
        (LinearFrame::new(self.size, backdrop.is_opaque(), pixels), statistics)
    }

    /// A black sky on the background, which is outside the circle of a fisheye.
    pub fn darkness(&self) -> (LinearFrame, Statistics) {
        let backdrop = Backdrop::new(self.background, 1);
        let (n, width) = (f64::from(self.samples), self.size[0] as usize);
        let covered = |idx: usize| {
            let place = [idx % width, idx / width].map(|at| n * (at as f64 + 0.5));
            f32::from(self.film.sight(place).is_some())
        };
        let n_pixels = width * self.size[1] as usize;
        let pixel = |idx: usize| backdrop.pixel([0.0; 3], covered(idx));
        let pixels: Vec<[f32; 4]> = (0..n_pixels).into_par_iter().map(pixel).collect();
        let n_covered = pixels.par_iter().filter(|pixel| pixel[3] > 0.0).count() as u64;
        let statistics = Statistics { max_light: 0.0, n_covered };
        (LinearFrame::new(self.size, backdrop.is_opaque(), pixels), statistics)
    }

    /// Sets pixels of a row to the mean light of their samples, times their covered part, and that
    /// part. `found`: a buffer for a row of samples.
    fn add_row(
        &self,
        sampler: &mut Sampler<'_>,
        found: &mut [Option<Seen>],
        row: usize,
        pixels: &mut [[f32; 4]],
    ) {
        let n = self.samples as usize;
        for y in row * n..(row + 1) * n {
            let y = y as f64 + 0.5;
            if let Some(flat) = &self.flat {
                sampler.flat_row(&self.observer, flat, [0.5, y], self.spread, found);
            }
            for (pixel, (first, found)) in pixels.iter_mut().zip(found.chunks(n).enumerate()) {
                for (column, seen) in found.iter().enumerate() {
                    let light = match seen {
                        Some(seen) => self.shaded(seen.light, f64::from(seen.doppler)),
                        None => self.sample(sampler, [(first * n + column) as f64 + 0.5, y], 1.0, 0),
                    };
                    (0..4).for_each(|channel| pixel[channel] += light[channel]);
                }
            }
        }
        if n > 1 {
            let part = 1.0 / (n * n) as f32;
            pixels.iter_mut().flatten().for_each(|sum| *sum *= part);
        }
    }

    /// The light of a square of the film, `side` samples wide.
    fn sample(&self, sampler: &mut Sampler<'_>, place: [f64; 2], side: f64, depth: u32) -> [f32; 4] {
        let Some(ray) = self.ray(place, side) else { return [0.0; 4] };
        match sampler.light(&ray, self.spread) {
            Some(light) => self.shaded(light, ray.doppler),
            None if depth < MOST_DIVISIONS => self.divided(sampler, place, side, depth),
            // The footprint still covers nearly the whole sky. At this depth it weighs at most 4⁻²⁴
            // of a sample, so it is left out.
            None => [0.0; 4],
        }
    }

    /// Light as seen, times the covered part, and that part.
    #[inline]
    fn shaded(&self, [red, green, blue, covered]: [f32; 4], doppler: f64) -> [f32; 4] {
        // Interpolation may exceed the range by a little.
        let covered = covered.clamp(0.0, 1.0);
        if covered == 0.0 {
            return [0.0; 4];
        }
        let rest = [red, green, blue].map(|part| part / covered);
        let [red, green, blue] = self.shade.seen(rest, doppler).map(|part| part * covered);
        [red, green, blue, covered]
    }

    /// The mean of the four quarters of a square, whose footprint is too large.
    fn divided(&self, sampler: &mut Sampler<'_>, place: [f64; 2], side: f64, depth: u32) -> [f32; 4] {
        let mut sum = [0.0_f32; 4];
        for [right, below] in [[-0.25, -0.25], [0.25, -0.25], [-0.25, 0.25], [0.25, 0.25]] {
            let quarter = [place[0] + right * side, place[1] + below * side];
            let light = self.sample(sampler, quarter, 0.5 * side, depth + 1);
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
        let velocity = -self.observer.velocity();
        Some((0, Emission { place: direction, depth: f64::INFINITY, time: f64::NEG_INFINITY, velocity }))
    }
}
