//! A sky behind a scene: its light in the footprint of any ray.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;
use ugphysics::Velocity;

use crate::observer::Observer;
use crate::sample::Sampler;
use crate::shade::SkyColors;
use crate::sky::{Layer, Sky};
use crate::spectral::{ALL_NM, BasisError};
use crate::stars::{Star, StarLight, StarOptions};
use crate::view::{SkyLight, SkyView};

/// A sky as an observer in motion sees it in the footprints of rays.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Brightness, Velocity};
/// use ugsky::{SkyBehind, SkyColors, Star, StarOptions};
///
/// // At 0.5 c a star abeam is seen 60° from straight ahead.
/// let stars = [Star { direction: DVec3::X, magnitude: 0.0, kelvin: 5800.0 }];
/// let velocity = Velocity::from_beta(DVec3::new(0.0, 0.5, 0.0))?;
/// let colors = SkyColors::Hues { doppler: true, law: Brightness::Report };
/// let sky = SkyBehind::new(stars.as_slice().into(), colors, velocity, StarOptions::default())?;
/// let mut rays = sky.rays();
/// let (seen, pixel) = (DVec3::new(0.75_f64.sqrt(), 0.5, 0.0), 0.01);
/// let slopes = [pixel * DVec3::new(-0.5, 0.75_f64.sqrt(), 0.0), pixel * DVec3::Z];
/// assert!(rays.light(seen, slopes)[1] > 0.0 && rays.light(-seen, slopes)[1] == 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct SkyBehind<'s> {
    view: SkyView,
    layers: Vec<Layer<'s>>,
    stars: StarMap,
    /// Standard deviation of the profile of a star, in pixels.
    deviation: f64,
}

impl<'s> SkyBehind<'s> {
    /// `velocity`: of the observer in the frame of the sky. Light brighter than white is kept.
    ///
    /// # Errors
    /// [`BasisError`].
    pub fn new(
        sky: Sky<'s>,
        colors: SkyColors,
        velocity: Velocity,
        options: StarOptions,
    ) -> Result<Self, BasisError> {
        let observer = Observer::new(velocity);
        let light = StarLight::new(sky.stars, colors.parts(), velocity.rapidity());
        let point = |star: &Star| {
            let (direction, doppler) = observer.seen_direction(star.direction);
            Point { direction, light: light.irradiance(star, doppler).map(|part| part * options.scale()) }
        };
        Ok(Self {
            stars: StarMap::new(sky.stars.iter().map(point).collect()),
            layers: sky.layers(colors, velocity, &ALL_NM, true)?,
            view: SkyView { observer, spread: 1.0, flat: None },
            deviation: options.deviation(),
        })
    }

    /// Finds the light of rays. Make one for each thread.
    #[must_use]
    pub fn rays(&self) -> SkyRays<'_> {
        SkyRays { sky: self, samplers: self.layers.iter().map(|layer| layer.panorama.sampler()).collect() }
    }
}

/// The light of a sky along rays, on one thread.
pub struct SkyRays<'a> {
    sky: &'a SkyBehind<'a>,
    samplers: Vec<Sampler<'a>>,
}

impl SkyRays<'_> {
    /// The light seen in a pixel: linear red, green and blue times the part of the pixel where
    /// there is sky, and that part. `seen`: unit vector to the middle of the pixel in the frame of
    /// the observer; `slopes`: its changes per column and per row, perpendicular to it.
    ///
    /// A star is a Gaussian profile of the angle to it, normalised so that light times solid angle,
    /// added up over pixels, is its irradiance.
    #[must_use]
    pub fn light(&mut self, seen: DVec3, slopes: [DVec3; 2]) -> [f32; 4] {
        let sky = self.sky;
        let film = |[x, y]: [f64; 2]| Some((seen + x * slopes[0] + y * slopes[1]).normalize());
        let mut sum = [0.0, 0.0, 0.0, if sky.layers.is_empty() { 1.0 } else { 0.0 }];
        for (layer, sampler) in sky.layers.iter().zip(&mut self.samplers) {
            let mut light = SkyLight { view: &sky.view, film, shade: &layer.shade, sampler };
            let [red, green, blue, covered] = light.square([0.0; 2], 1.0);
            sum = [sum[0] + red, sum[1] + green, sum[2] + blue, covered.max(sum[3])];
        }
        let side = slopes[0].cross(slopes[1]).length().sqrt();
        let deviation = (sky.deviation * side).min(StarOptions::MOST_DEVIATION);
        if deviation > 0.0 {
            let whole = TAU
                * deviation
                * deviation
                * (1.0 - libm::exp(-0.5 * StarOptions::REACH * StarOptions::REACH));
            sky.stars.visit(seen, StarOptions::REACH * deviation, |star| {
                let weight =
                    StarOptions::profile((star.direction - seen).length_squared(), deviation) / whole;
                (0..3).for_each(|channel| sum[channel] += (weight * star.light[channel]) as f32);
            });
        }
        sum
    }
}

/// A star as seen.
struct Point {
    direction: DVec3,
    /// Linear red, green and blue of its irradiance.
    light: [f64; 3],
}

/// Stars by place on the sphere: rows of equal area, each sorted by longitude.
struct StarMap(Vec<Vec<(f64, Point)>>);

impl StarMap {
    fn new(points: Vec<Point>) -> Self {
        let n_rows = (points.len() as f64).sqrt().ceil() as usize;
        let mut rows: Vec<Vec<(f64, Point)>> = (0..n_rows).map(|_| Vec::new()).collect();
        for point in points {
            let row = row_of(point.direction.z, n_rows);
            rows[row].push((libm::atan2(point.direction.x, point.direction.y), point));
        }
        rows.iter_mut().for_each(|row| row.sort_by(|one, other| one.0.total_cmp(&other.0)));
        Self(rows)
    }

    /// Calls `each` for the stars within `radius` of a direction, and some others.
    fn visit(&self, direction: DVec3, radius: f64, mut each: impl FnMut(&Point)) {
        let Self(rows) = self;
        if rows.is_empty() {
            return;
        }
        let latitude = libm::asin(direction.z.clamp(-1.0, 1.0));
        let longitude = libm::atan2(direction.x, direction.y);
        let [south, north] = [latitude - radius, latitude + radius];
        let half = if south <= -FRAC_PI_2 || north >= FRAC_PI_2 {
            PI
        } else {
            libm::asin((libm::sin(radius) / libm::cos(latitude)).min(1.0))
        };
        let row = |latitude: f64| row_of(libm::sin(latitude.clamp(-FRAC_PI_2, FRAC_PI_2)), rows.len());
        for row in &rows[row(south)..=row(north)] {
            // A turn at a time, each half open, so that none is visited twice.
            for turn in [-TAU, 0.0, TAU] {
                let at = |end: f64| row.partition_point(|(place, _)| *place < longitude + end + turn);
                row[at(-half)..at(half)].iter().for_each(|(_, point)| each(point));
            }
        }
    }
}

fn row_of(z: f64, n_rows: usize) -> usize {
    ((0.5 * (1.0 + z) * n_rows as f64) as usize).min(n_rows - 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Extent;
    use crate::panorama::Panorama;
    use crate::spectral::Basis;
    use crate::texels::Texels;

    const COLORS: SkyColors =
        SkyColors::Spectra { basis: Basis::Planck([3500.0, 5900.0, 10_000.0]), doppler: true, flux: true };

    fn direction(step: u32) -> DVec3 {
        let part = |by: f64| (f64::from(step) * by).fract();
        let (z, turn) = (2.0 * part(0.618_034) - 1.0, TAU * part(0.754_878));
        let (sin, cos) = libm::sincos(turn);
        DVec3::new((1.0 - z * z).sqrt() * sin, (1.0 - z * z).sqrt() * cos, z)
    }

    fn slopes(seen: DVec3, side: f64) -> [DVec3; 2] {
        let across = seen.any_orthonormal_vector();
        [side * across, side * seen.cross(across)]
    }

    /// The light of pixels around a star adds up to its irradiance, at poles and the date line too,
    /// and that of a panorama is added.
    #[test]
    fn stars_have_their_irradiance() {
        let velocity = Velocity::from_beta(DVec3::new(0.3, 0.4, -0.2)).unwrap();
        let options = StarOptions { white: 0.0, ..StarOptions::default() };
        let grey = Texels::Light(vec![[0.25, 0.25, 0.25, 1.0]; 64 * 32]);
        let grey = Panorama::new([64, 32], grey, Extent::FULL).unwrap();
        for step in 0..40 {
            let place = [DVec3::Z, DVec3::NEG_Y, DVec3::NEG_Z][step as usize % 3];
            let seen = if step < 9 { (place + 1e-3 * direction(step)).normalize() } else { direction(step) };
            let (place, doppler) = Observer::new(velocity).direction_in_sky(seen);
            let star = Star { direction: place, magnitude: 0.0, kelvin: 6000.0 };
            let behind = |sky: Sky<'_>| {
                let sky = SkyBehind::new(sky, COLORS, velocity, options).unwrap();
                let (mut sum, side) = ([0.0; 3], 0.004);
                let [across, down] = slopes(seen, side);
                for (i, j) in (-8..=8).flat_map(|i| (-8..=8).map(move |j| (f64::from(i), f64::from(j)))) {
                    let pixel = (seen + (i + 0.3) * across + (j - 0.1) * down).normalize();
                    let light = sky.rays().light(pixel, slopes(pixel, side));
                    (0..3).for_each(|channel| sum[channel] += f64::from(light[channel]) * side * side);
                }
                sum
            };
            let [alone, of_grey] = [behind([star].as_slice().into()), behind((&grey).into())];
            let both = behind(Sky { stars: &[star], ..Sky::from(&grey) });
            let light = StarLight::new(&[star], [true; 2], velocity.rapidity());
            let expected = light.irradiance(&star, doppler).map(|part| part * options.scale());
            for channel in 0..3 {
                let error = (alone[channel] / expected[channel] - 1.0).abs();
                assert!(error < 3e-3, "{seen}: {alone:?} {expected:?}");
                let error = (both[channel] / (alone[channel] + of_grey[channel]) - 1.0).abs();
                assert!(error < 1e-5, "{seen}: {both:?}");
            }
        }
    }

    /// Of many stars, those near a direction are found once.
    #[test]
    fn maps_find_their_stars() {
        let points = |n: u32| (0..n).map(|step| Point { direction: direction(step), light: [0.0; 3] });
        let map = StarMap::new(points(3000).collect());
        for step in 0..300 {
            let (at, radius) = (direction(7 * step + 1), [0.01, 0.1, 1.0][step as usize % 3]);
            let is_near = |point: &Point| point.direction.angle_between(at) < radius;
            let expected = points(3000).filter(|point| is_near(point)).count();
            let mut found = 0;
            map.visit(at, radius, |point| found += usize::from(is_near(point)));
            assert_eq!(found, expected, "{at} {radius}");
        }
    }
}
