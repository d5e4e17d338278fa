//! Rows of pixels on a flat film, eight at once: their rays, their ellipses and the texels around
//! them, in single precision.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, f32x8};
use glam::DVec3;

use crate::footprint::{CURVED, LARGEST, MOST_ECCENTRIC, RADIUS, SLACK};
use crate::grid::CHUNK;
use crate::observer::Observer;
use crate::panorama::Panorama;
use crate::sample::Sampler;
use crate::window::{Footprint, light_of};

/// Directions seen by the places of a flat film: corner + x across + y down, of any length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatFilm {
    /// Direction of the origin.
    pub corner: DVec3,
    /// Its change per column.
    pub across: DVec3,
    /// Its change per row.
    pub down: DVec3,
}

/// The light of a pixel in the frame of the sky, and its Doppler factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Light times alpha, and alpha.
    pub light: [f32; 4],
    /// The Doppler factor.
    pub doppler: f32,
}

/// Above this Doppler factor single precision does not suffice.
const MOST_DOPPLER: f64 = 100.0;

impl Sampler<'_> {
    /// The light of the pixels of a row, one column apart, from a place on a film on: the same as
    /// of [`Sampler::light`] for each within 10⁻⁴, but several times faster. `None` for the few
    /// that this way is not for, at poles, edges and near the speed of light.
    pub fn flat_row(
        &mut self,
        observer: &Observer,
        film: &FlatFilm,
        [x, y]: [f64; 2],
        spread: f64,
        found: &mut [Option<Seen>],
    ) {
        if observer.factors()[1] > MOST_DOPPLER {
            found.fill(None);
            return;
        }
        let start = film.corner + y * film.down;
        for (idx, found) in found.chunks_mut(CHUNK).enumerate() {
            let first = start + (x + (idx * CHUNK) as f64) * film.across;
            dispatch!(self.simd, simd => self.flat_chunk(simd, observer, film, first, spread, found));
        }
    }

    #[inline(always)]
    fn flat_chunk<S: Simd>(
        &mut self,
        simd: S,
        observer: &Observer,
        film: &FlatFilm,
        first: DVec3,
        spread: f64,
        found: &mut [Option<Seen>],
    ) {
        let (footprints, doppler) = footprints(simd, self.panorama, observer, film, first, spread);
        for (k, found) in found.iter_mut().enumerate() {
            *found = None;
            if let Some(light) = light_of(simd, self.panorama, &footprints[k % CHUNK], &mut self.scratch) {
                *found = Some(Seen { light, doppler: doppler[k % CHUNK] });
            }
        }
    }
}

/// Eight vectors.
#[derive(Clone, Copy)]
struct Vectors<S: Simd> {
    x: f32x8<S>,
    y: f32x8<S>,
    z: f32x8<S>,
}

impl<S: Simd> Vectors<S> {
    #[inline(always)]
    fn splat(simd: S, vector: DVec3) -> Self {
        Self {
            x: f32x8::splat(simd, vector.x as f32),
            y: f32x8::splat(simd, vector.y as f32),
            z: f32x8::splat(simd, vector.z as f32),
        }
    }

    #[inline(always)]
    fn dot(self, other: Self) -> f32x8<S> {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline(always)]
    fn times(self, factor: f32x8<S>) -> Self {
        Self { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

/// The footprints of eight pixels, and their Doppler factors. Those that are too large, or where
/// single precision does not suffice, have no rows: NaN.
///
/// `first`: the direction of the first pixel, of any length.
#[inline(always)]
pub(crate) fn footprints<S: Simd>(
    simd: S,
    sky: &Panorama,
    observer: &Observer,
    film: &FlatFilm,
    first: DVec3,
    spread: f64,
) -> ([Footprint; CHUNK], [f32; CHUNK]) {
    let one = f32x8::splat(simd, 1.0);
    let zero = f32x8::splat(simd, 0.0);
    let half = f32x8::splat(simd, 0.5);
    let steps = f32x8::from_slice(simd, &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
    let (film_across, film_down) = (Vectors::splat(simd, film.across), Vectors::splat(simd, film.down));
    let on_film = Vectors::splat(simd, first).plus(film_across.times(steps));
    let inverse = one / on_film.dot(on_film).sqrt();
    let seen = on_film.times(inverse);

    // As in Observer::ray.
    let ahead = Vectors::splat(simd, observer.ahead());
    let [behind_factor, ahead_factor] = observer.factors();
    let along = seen.dot(ahead);
    let across = seen.minus(ahead.times(along));
    let big = one + along.abs();
    let small = across.dot(across) / big;
    let is_ahead = along.simd_ge(zero);
    let near = is_ahead.select(big, small) * f32x8::splat(simd, behind_factor as f32);
    let far = is_ahead.select(small, big) * f32x8::splat(simd, ahead_factor as f32);
    let doppler = (one + one) / (near + far);
    let direction = ahead.times(half * doppler * (near - far)).plus(across.times(doppler));
    let proper_speed = f32x8::splat(simd, observer.proper_speed() as f32);
    let turned = ahead.plus(across.times(proper_speed)).times(doppler * doppler);

    let level = (direction.x * direction.x + direction.y * direction.y).sqrt();
    let (sin, cos) = (direction.x / level, direction.y / level);
    let tilt = Vectors { x: zero - direction.z * sin, y: zero - direction.z * cos, z: level };
    let on_sky = OnSky { seen, inverse, ahead, doppler, turned, sin, cos, tilt };
    let (east_across, north_across) = on_sky.slope(film_across);
    let (east_down, north_down) = on_sky.slope(film_down);

    // As in Ellipse::new.
    let spread = f32x8::splat(simd, spread as f32);
    let mut see = spread * (east_across * east_across + east_down * east_down);
    let sen = spread * (east_across * north_across + east_down * north_down);
    let mut snn = spread * (north_across * north_across + north_down * north_down);
    let middle = half * (see + snn);
    let unequal = half * (see - snn);
    let apart = (unequal * unequal + sen * sen).sqrt();
    let large = middle + apart;
    let small = (middle - apart).max(zero);
    let least = large * f32x8::splat(simd, (1.0 / (MOST_ECCENTRIC * MOST_ECCENTRIC)) as f32);
    let widened = (least - small).max(zero);
    see += widened;
    snn += widened;
    let small: [f32; CHUNK] = small.max(least).into();

    let mut levels = [0; CHUNK];
    let mut texels = [0.0; CHUNK];
    let mut rows_per_radian = [0.0; CHUNK];
    for k in 0..CHUNK {
        levels[k] = sky.level_of(f64::from(small[k]));
        let grid = &sky.grids[levels[k]];
        texels[k] = grid.texel as f32;
        rows_per_radian[k] = grid.rows_per_radian as f32;
    }

    // As in Ellipse::kernel.
    let texel = f32x8::from_slice(simd, &texels);
    let square = texel * texel;
    let margin = f32x8::splat(simd, (RADIUS * RADIUS) as f32) * square;
    let finest = sky.grids[0].texel;
    let averaged = (square - f32x8::splat(simd, (finest * finest) as f32)) * f32x8::splat(simd, 1.0 / 6.0);
    let variance = (see + snn) * f32x8::splat(simd, 1.0 / 12.0);
    let (see, snn) = (see + margin, snn + margin);
    let moment = (variance - averaged).max(zero) / (see + snn);
    let c = (f32x8::splat(simd, 2.5) - f32x8::splat(simd, 20.0) * moment)
        / (one - f32x8::splat(simd, 5.0) * moment);
    let ratio = sen / snn;
    let east = Vectors { x: cos, y: zero - sin, z: zero };
    let a = east.minus(tilt.times(ratio)).times(one / (see - sen * ratio).sqrt());
    let north = snn.sqrt();
    let b = tilt.times(one / north);

    // As in Footprint::new.
    let rows_per_radian = f32x8::from_slice(simd, &rows_per_radian);
    let top = f32x8::splat(simd, sky.extent().latitudes[1] as f32);
    let row = (top - near_atan2(simd, direction.z, level)) * rows_per_radian - half;
    let reach = (north + f32x8::splat(simd, 0.21) * north * north * north) * rows_per_radian;
    let longitude = near_atan2(simd, direction.x, direction.y);
    let width = f32x8::splat(simd, (1.0 + SLACK) as f32) * see.sqrt();
    let is_small = large.simd_le(f32x8::splat(simd, (LARGEST * LARGEST) as f32));
    let curvature = (large + margin).sqrt() * direction.z.abs();
    let is_flat = curvature.simd_le(f32x8::splat(simd, CURVED as f32) * level);
    let none = f32x8::splat(simd, f32::NAN);
    let first = is_small.select(is_flat.select((row - reach).ceil(), none), none);
    let last = (row + reach).floor();

    let ([ax, ay, az], [bx, by, bz]) = (lanes_of(a), lanes_of(b));
    let c: [f32; CHUNK] = c.into();
    let (first, last): ([f32; CHUNK], [f32; CHUNK]) = (first.into(), last.into());
    let (longitude, width): ([f32; CHUNK], [f32; CHUNK]) = (longitude.into(), width.into());
    let mut found = [Footprint::default(); CHUNK];
    for k in 0..CHUNK {
        found[k] = Footprint {
            level: levels[k],
            a: [ax[k], ay[k], az[k]],
            b: [bx[k], by[k], bz[k]],
            c: c[k],
            rows: [first[k], last[k]],
            longitude: longitude[k],
            half: width[k],
        };
    }
    (found, doppler.into())
}

#[inline(always)]
fn lanes_of<S: Simd>(vectors: Vectors<S>) -> [[f32; CHUNK]; 3] {
    [vectors.x.into(), vectors.y.into(), vectors.z.into()]
}

/// Directions in the sky, and how they change with those seen.
struct OnSky<S: Simd> {
    seen: Vectors<S>,
    /// Of the lengths on the film.
    inverse: f32x8<S>,
    ahead: Vectors<S>,
    doppler: f32x8<S>,
    turned: Vectors<S>,
    /// Of the longitude.
    sin: f32x8<S>,
    cos: f32x8<S>,
    /// To the north.
    tilt: Vectors<S>,
}

impl<S: Simd> OnSky<S> {
    /// East and north components of the change with a step on the film.
    #[inline(always)]
    fn slope(&self, step: Vectors<S>) -> (f32x8<S>, f32x8<S>) {
        let slope = step.minus(self.seen.times(self.seen.dot(step))).times(self.inverse);
        let part = slope.dot(self.ahead);
        let in_sky = slope.minus(self.ahead.times(part)).times(self.doppler).plus(self.turned.times(part));
        (in_sky.x * self.cos - in_sky.y * self.sin, in_sky.dot(self.tilt))
    }
}

/// atan2 within 3·10⁻⁶; see [`crate::footprint::near_atan2`].
#[inline(always)]
fn near_atan2<S: Simd>(simd: S, y: f32x8<S>, x: f32x8<S>) -> f32x8<S> {
    use core::f32::consts::{FRAC_PI_2, PI};
    let zero = f32x8::splat(simd, 0.0);
    let (above, across) = (y.abs(), x.abs());
    let is_flat = above.simd_lt(across);
    let t = is_flat.select(above, across) / is_flat.select(across, above);
    let s = t * t;
    let angle = f32x8::splat(simd, 0.052_653_32) - s * f32x8::splat(simd, 0.011_721_2);
    let angle = f32x8::splat(simd, -0.116_432_87) + s * angle;
    let angle = f32x8::splat(simd, 0.193_543_46) + s * angle;
    let angle = f32x8::splat(simd, -0.332_623_47) + s * angle;
    let angle = t * (f32x8::splat(simd, 0.999_977_26) + s * angle);
    let angle = is_flat.select(angle, f32x8::splat(simd, FRAC_PI_2) - angle);
    let angle = x.simd_lt(zero).select(f32x8::splat(simd, PI) - angle, angle);
    y.simd_lt(zero).select(zero - angle, angle)
}

#[cfg(test)]
mod tests {
    use ugphysics::Velocity;

    use super::*;
    use crate::grid::Extent;
    use crate::panorama::Texels;

    /// Rows have the light and the factors of single pixels, in all directions and at all sizes.
    #[test]
    fn rows_are_pixels() {
        let size = [1024, 512];
        let texel = |idx: u32| {
            let part = |by: f32| (idx as f32 * by).fract();
            [part(0.618_034), part(0.754_878), part(0.569_84), 1.0]
        };
        let texels = Texels::Light((0..size[0] * size[1]).map(texel).collect());
        let sky = Panorama::new(size, texels, Extent::FULL).unwrap();
        let mut sampler = sky.sampler();
        let (mut n, mut n_found) = (0, 0);
        for step in 0..3000 {
            let part = |by: f64| (f64::from(step) * by).fract() * 2.0 - 1.0;
            let forward = DVec3::new(part(0.618_034), part(0.754_878), part(0.569_84)).normalize();
            let right = forward.any_orthonormal_vector();
            let pixel = 1e-3 * libm::exp(3.0 * part(0.43));
            let (across, down) = (pixel * right, pixel * right.cross(forward));
            let film = FlatFilm { corner: forward + 0.3 * right, across, down };
            let axis = DVec3::new(part(0.32), part(0.21), part(0.77));
            let observer = Observer::new(Velocity::from_rapidity(axis, 2.0 + 2.0 * part(0.9)).unwrap());
            let mut found = [None; 11];
            sampler.flat_row(&observer, &film, [0.5, 3.5], 1.0, &mut found);
            for (column, found) in found.iter().enumerate() {
                n += 1;
                let Some(found) = found else { continue };
                n_found += 1;
                let on_film = film.corner + (0.5 + column as f64) * across + 3.5 * down;
                let inverse = 1.0 / on_film.length();
                let seen = on_film * inverse;
                let slopes = [across, down].map(|step| (step - seen.dot(step) * seen) * inverse);
                let ray = observer.ray(seen, slopes);
                let expected = sampler.light(&ray, 1.0).unwrap();
                let error = (0..4).map(|i| (found.light[i] - expected[i]).abs()).fold(0.0, f32::max);
                assert!(error < 1e-3, "{observer:?} {film:?}: {found:?}, not {expected:?}");
                assert!((f64::from(found.doppler) / ray.doppler - 1.0).abs() < 1e-5);
            }
        }
        assert!(n_found > n * 4 / 5, "{n_found} of {n}");
    }
}
