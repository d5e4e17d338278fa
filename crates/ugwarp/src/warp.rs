//! From the pixels of a picture to the sky, and their light.

use glam::DVec3;
use rayon::prelude::*;
use ugimage::{Filter, LinearFrame};
use ugparse::Scene;
use ugpicture::lens::{Film, Lens};
use ugpicture::{Backdrop, Background, Emission, SeenItem};
use ugpipe::Progress;
use ugscene::{CameraOptions, View};
use ugsky::{Observer, Panorama, Sampler, SkyRay};

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
    rays: Option<Vec<Option<StoredRay>>>,
}

/// A ray of the table of a map, in single precision.
#[derive(Clone, Copy, Debug)]
struct StoredRay {
    direction: [f32; 3],
    slopes: [[f32; 3]; 2],
    doppler: f32,
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
        Ok(Self {
            size: picture.size,
            samples,
            film: Film::new(config.lens, None, &view, frame),
            lens: config.lens,
            observer: Observer::new(config.velocity),
            spread: 12.0 * variance * n - n + 1.0,
            background: picture.background,
            shade: Shade::new(config)?,
            is_up_replaced: view.is_up_replaced,
            rays: None,
        })
    }

    /// Keeps the rays of all pixels in memory, 40 bytes each, for pictures of more than one
    /// panorama. Pictures with several samples per pixel have none.
    pub fn store_rays(&mut self) {
        if self.samples > 1 {
            return;
        }
        let width = self.size[0] as usize;
        let ray = |idx: usize| {
            let ray = self.ray([idx % width, idx / width].map(|at| at as f64 + 0.5), 1.0)?;
            let single = |vector: DVec3| vector.as_vec3().to_array();
            Some(StoredRay {
                direction: single(ray.direction),
                slopes: ray.slopes.map(single),
                doppler: ray.doppler as f32,
            })
        };
        self.rays = Some((0..width * self.size[1] as usize).into_par_iter().map(ray).collect());
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
            || panorama.sampler(),
            |sampler, (band, pixels)| {
                let mut statistics = Statistics::default();
                for (idx, pixel) in pixels.iter_mut().enumerate() {
                    let at = [idx % width, band * BAND + idx / width];
                    let [red, green, blue, covered] = self.pixel(sampler, at);
                    *pixel = backdrop.pixel([red, green, blue], covered);
                    if covered > 0.0 {
                        statistics.n_covered += 1;
                        statistics.max_light = statistics.max_light.max(red).max(green).max(blue);
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

    /// The mean light of the samples of a pixel, times their covered part, and that part.
    fn pixel(&self, sampler: &mut Sampler<'_>, at: [usize; 2]) -> [f32; 4] {
        let n = self.samples as usize;
        if n == 1 {
            let stored = self.rays.as_ref().map(|rays| rays[at[1] * self.size[0] as usize + at[0]]);
            let place = at.map(|at| at as f64 + 0.5);
            return match stored {
                Some(None) => [0.0; 4],
                Some(Some(ray)) => self.of_ray(sampler, &ray.into(), place, 1.0, 0),
                None => self.sample(sampler, place, 1.0, 0),
            };
        }
        let mut sum = [0.0; 4];
        for row in 0..n {
            for column in 0..n {
                let place = [at[0] * n + column, at[1] * n + row].map(|at| at as f64 + 0.5);
                let light = self.sample(sampler, place, 1.0, 0);
                (0..4).for_each(|channel| sum[channel] += light[channel]);
            }
        }
        let part = 1.0 / (n * n) as f32;
        sum.map(|sum| sum * part)
    }

    /// The light of a square of the film, `side` samples wide.
    fn sample(&self, sampler: &mut Sampler<'_>, place: [f64; 2], side: f64, depth: u32) -> [f32; 4] {
        match self.ray(place, side) {
            Some(ray) => self.of_ray(sampler, &ray, place, side, depth),
            None => [0.0; 4],
        }
    }

    #[inline]
    fn of_ray(
        &self,
        sampler: &mut Sampler<'_>,
        ray: &SkyRay,
        place: [f64; 2],
        side: f64,
        depth: u32,
    ) -> [f32; 4] {
        let light = match sampler.light(ray, self.spread) {
            Some(light) => light,
            None if depth < MOST_DIVISIONS => return self.divided(sampler, place, side, depth),
            // A footprint of nearly the whole sky, of no more than 4⁻²⁴ of a sample.
            None => [0.0; 4],
        };
        let [red, green, blue, covered] = light;
        // Interpolation may exceed the range by a little.
        let covered = covered.clamp(0.0, 1.0);
        if covered == 0.0 {
            return [0.0; 4];
        }
        let rest = [red, green, blue].map(|part| part / covered);
        let [red, green, blue] = self.shade.seen(rest, ray.doppler).map(|part| part * covered);
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

impl From<StoredRay> for SkyRay {
    fn from(ray: StoredRay) -> Self {
        let double = |vector: [f32; 3]| DVec3::from_array(vector.map(f64::from));
        Self {
            direction: double(ray.direction),
            slopes: ray.slopes.map(double),
            doppler: f64::from(ray.doppler),
        }
    }
}
