//! Stars as points of light in a picture.

use core::ops::Range;

use glam::DVec3;
use rayon::prelude::*;
use ugimage::LinearFrame;
use ugsky::{Observer, Star, StarLight, StarOptions};
use ugtrace::lens::{Film, Lens, Window};

use crate::picture::SkyPicture;

/// Rows that one task draws.
const BAND: u32 = 16;

/// Stars whose places are in memory at once.
const CHUNK: usize = 1 << 17;

/// Largest value of a channel, far from the end of single precision.
const MOST: f64 = 1e30;

/// Stars in a picture: their directions by aberration, and their light spread over pixels.
///
/// The profile of a star is a Gaussian of the angle to it, cut off at four standard deviations. It
/// is normalised by the sum over the pixels, so that light times solid angle, added up, is the
/// irradiance, wherever the star is between the middles of pixels and whatever the lens.
pub struct StarField {
    /// Left column, upper row, width and height of the part of the picture that is drawn.
    part: [u32; 4],
    film: Film,
    lens: Lens,
    observer: Observer,
    light: StarLight,
    /// Standard deviation of the profile in pixels.
    deviation: f64,
    /// Light per irradiance and steradian.
    scale: f64,
}

/// A star as seen.
struct Point {
    direction: DVec3,
    /// Irradiance divided by the sum of the profile times solid angles.
    light: [f64; 3],
    deviation: f64,
    rows: Range<u32>,
}

impl StarField {
    /// The map of a picture for a list of stars.
    pub fn new(stars: &[Star], picture: &SkyPicture) -> Self {
        Self {
            part: picture.part,
            film: picture.pixel_film,
            lens: picture.lens,
            observer: Observer::new(picture.velocity),
            light: StarLight::new(stars, picture.colors.parts(), picture.velocity.rapidity()),
            deviation: picture.stars.deviation(),
            scale: picture.stars.scale(),
        }
    }

    /// Adds the light of stars to a picture. Returns the largest channel of its pixels.
    pub fn add(&self, stars: &[Star], frame: &mut LinearFrame) -> f32 {
        let [_, top, width, height] = self.part;
        let n_bands = height.div_ceil(BAND);
        for stars in stars.chunks(CHUNK) {
            let points: Vec<Point> = stars.par_iter().filter_map(|star| self.point(star)).collect();
            let mut bands = vec![Vec::new(); n_bands as usize];
            for (idx, point) in points.iter().enumerate() {
                for band in (point.rows.start - top) / BAND..=(point.rows.end - top - 1) / BAND {
                    bands[band as usize].push(idx);
                }
            }
            let rows = frame.pixels_mut().par_chunks_mut((BAND * width) as usize);
            rows.zip(bands).enumerate().for_each(|(band, (pixels, indices))| {
                let top = top + band as u32 * BAND;
                indices.into_iter().for_each(|idx| self.draw(&points[idx], top, pixels));
            });
        }
        let largest = |pixel: &[f32; 4]| pixel[0].max(pixel[1]).max(pixel[2]);
        frame.pixels().par_iter().map(largest).reduce(|| 0.0, f32::max)
    }

    /// A star as seen; `None` if none of its light is in the picture.
    fn point(&self, star: &Star) -> Option<Point> {
        let (direction, doppler) = self.observer.seen_direction(star.direction);
        let deviation = self.deviation_at(direction);
        if deviation <= 0.0 {
            return None;
        }
        let (mut sum, mut first, mut last) = (0.0, u32::MAX, 0);
        let [above, below] = [self.part[1], self.part[1] + self.part[3]];
        for window in self.film.pixels_near(direction, StarOptions::REACH * deviation) {
            // Pixels may be much longer than wide: along a disc there are more than can be counted,
            // and the sum over some of them is as exact.
            self.film.visit_evenly(&window, |facet| {
                let square = (facet.direction - direction).length_squared();
                sum += StarOptions::profile(square, deviation) * facet.solid_angle;
            });
            let [from, to] = [window.rows.start, window.rows.end]
                .map(|row| row.clamp(above.into(), below.into()) as u32);
            (first, last) = (first.min(from), last.max(to));
        }
        if sum <= 0.0 || first >= last {
            return None;
        }
        let irradiance = self.light.irradiance(star, doppler);
        let light = irradiance.map(|part| (part * self.scale / sum).clamp(-MOST, MOST));
        Some(Point { direction, light, deviation, rows: first..last })
    }

    /// Standard deviation of the profile at a direction, radians; 0 where the lens shows nothing.
    fn deviation_at(&self, direction: DVec3) -> f64 {
        let side = self.deviation * self.film.pixel_side(direction);
        let most = if self.lens == Lens::Pinhole {
            // A disc has to be ahead.
            StarOptions::MOST_DEVIATION.min(self.film.ahead(direction) / (2.0 * StarOptions::REACH))
        } else {
            StarOptions::MOST_DEVIATION
        };
        side.min(most)
    }

    /// Adds the light of a star to rows of the picture from `top` on.
    fn draw(&self, point: &Point, top: u32, pixels: &mut [[f32; 4]]) {
        let [left, _, width, _] = self.part;
        let (right, width) = (left + width, width as usize);
        let bottom = i64::from(top) + (pixels.len() / width) as i64;
        for window in self.film.pixels_near(point.direction, StarOptions::REACH * point.deviation) {
            let rows = window.rows.start.max(i64::from(top))..window.rows.end.min(bottom);
            let columns = match self.lens {
                Lens::Pinhole => {
                    window.columns.start.max(left.into())..window.columns.end.min(right.into())
                }
                _ => window.columns,
            };
            self.film.visit(&Window { columns, rows, ..window }, |facet| {
                let Some([column, row]) = facet.place else { return };
                if !(left..right).contains(&column) {
                    return;
                }
                let square = (facet.direction - point.direction).length_squared();
                let weight = StarOptions::profile(square, point.deviation);
                if weight > 0.0 {
                    let pixel =
                        &mut pixels[(row - top) as usize * width + (column - left) as usize];
                    (0..3).for_each(|channel| {
                        pixel[channel] += (weight * point.light[channel]) as f32
                    });
                    let brightest = pixel[0].max(pixel[1]).max(pixel[2]);
                    pixel[3] = pixel[3].max(brightest.min(1.0));
                }
            });
        }
    }
}
