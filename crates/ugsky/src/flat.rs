//! Rows of pixels on a flat film, sixteen at once: their rays, their ellipses and the texels around
//! them, in single precision.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, f32x16, mask32x16, u32x16};
use glam::DVec3;

use crate::footprint::{CURVED, LARGEST, MOST_ECCENTRIC, RADIUS, SLACK};
use crate::observer::Observer;
use crate::panorama::Panorama;
use crate::pyramid::APRON;
use crate::sample::Sampler;
use crate::window::{EACH, Footprints, ROWS, Windows, lights};

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

/// The light of sixteen neighbouring pixels in the frame of the sky.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seen {
    /// Red, green and blue times alpha, and alpha.
    pub light: [[f32; EACH]; 4],
    /// The Doppler factors.
    pub doppler: [f32; EACH],
    /// The pixels that have their light.
    pub is_found: [bool; EACH],
}

impl Seen {
    /// Number of pixels.
    pub const N: usize = EACH;

    /// Sets the light of a pixel: red, green and blue times alpha, and alpha.
    pub fn set(&mut self, idx: usize, light: [f32; 4], doppler: f64) {
        (0..4).for_each(|channel| self.light[channel][idx] = light[channel]);
        self.doppler[idx] = doppler as f32;
        self.is_found[idx] = true;
    }
}

/// Above this Doppler factor single precision does not suffice.
const MOST_DOPPLER: f64 = 100.0;

impl Sampler<'_> {
    /// The light of the pixels of a row, one column apart, from a place on a film on: the same as
    /// of [`Sampler::light`] for each within 10⁻⁴, but several times faster. Pixels at poles and
    /// edges, and all those near the speed of light, are left out: they are not `is_found`.
    pub fn flat_row(
        &mut self,
        observer: &Observer,
        film: &FlatFilm,
        [x, y]: [f64; 2],
        spread: f64,
        found: &mut [Seen],
    ) {
        if observer.factors()[1] > MOST_DOPPLER {
            found.fill(Seen::default());
            return;
        }
        let start = film.corner + y * film.down;
        for (idx, found) in found.iter_mut().enumerate() {
            let first = start + (x + (idx * EACH) as f64) * film.across;
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
        found: &mut Seen,
    ) {
        let (footprints, doppler) = footprints(simd, self.panorama, observer, film, first, spread);
        found.light = lights(simd, self.panorama, &footprints, &mut self.buffers);
        found.doppler = doppler;
        found.is_found = footprints.windows.are_windows();
    }
}

/// Sixteen vectors.
#[derive(Clone, Copy)]
struct Vectors<S: Simd> {
    x: f32x16<S>,
    y: f32x16<S>,
    z: f32x16<S>,
}

impl<S: Simd> Vectors<S> {
    #[inline(always)]
    fn splat(simd: S, vector: DVec3) -> Self {
        Self {
            x: f32x16::splat(simd, vector.x as f32),
            y: f32x16::splat(simd, vector.y as f32),
            z: f32x16::splat(simd, vector.z as f32),
        }
    }

    #[inline(always)]
    fn dot(self, other: Self) -> f32x16<S> {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline(always)]
    fn times(self, factor: f32x16<S>) -> Self {
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

/// The footprints of sixteen pixels, and their Doppler factors. Those that are too large, and those
/// near poles and edges, have no windows.
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
) -> (Footprints, [f32; EACH]) {
    let one = f32x16::splat(simd, 1.0);
    let zero = f32x16::splat(simd, 0.0);
    let half = f32x16::splat(simd, 0.5);
    let steps: [f32; EACH] =
        [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0];
    let steps = f32x16::from_slice(simd, &steps);
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
    let near = is_ahead.select(big, small) * f32x16::splat(simd, behind_factor as f32);
    let far = is_ahead.select(small, big) * f32x16::splat(simd, ahead_factor as f32);
    let doppler = (one + one) / (near + far);
    let direction = ahead.times(half * doppler * (near - far)).plus(across.times(doppler));
    let proper_speed = f32x16::splat(simd, observer.proper_speed() as f32);
    let turned = ahead.plus(across.times(proper_speed)).times(doppler * doppler);

    let level = (direction.x * direction.x + direction.y * direction.y).sqrt();
    let (sin, cos) = (direction.x / level, direction.y / level);
    let tilt = Vectors { x: zero - direction.z * sin, y: zero - direction.z * cos, z: level };
    let on_sky = OnSky { seen, inverse, ahead, doppler, turned, sin, cos, tilt };
    let (east_across, north_across) = on_sky.slope(film_across);
    let (east_down, north_down) = on_sky.slope(film_down);

    // As in Ellipse::new.
    let spread = f32x16::splat(simd, spread as f32);
    let mut see = spread * (east_across * east_across + east_down * east_down);
    let sen = spread * (east_across * north_across + east_down * north_down);
    let mut snn = spread * (north_across * north_across + north_down * north_down);
    let middle = half * (see + snn);
    let unequal = half * (see - snn);
    let apart = (unequal * unequal + sen * sen).sqrt();
    let large = middle + apart;
    let small = (middle - apart).max(zero);
    let least = large * f32x16::splat(simd, (1.0 / (MOST_ECCENTRIC * MOST_ECCENTRIC)) as f32);
    let widened = (least - small).max(zero);
    see += widened;
    snn += widened;
    let grids = GridsOf::new(simd, sky, small.max(least));

    // As in Ellipse::kernel.
    let square = grids.texel * grids.texel;
    let margin = f32x16::splat(simd, (RADIUS * RADIUS) as f32) * square;
    let finest = sky.grids[0].texel;
    let averaged = (square - f32x16::splat(simd, (finest * finest) as f32)) * f32x16::splat(simd, 1.0 / 6.0);
    let variance = (see + snn) * f32x16::splat(simd, 1.0 / 12.0);
    let (see, snn) = (see + margin, snn + margin);
    let moment = (variance - averaged).max(zero) / (see + snn);
    let c = (f32x16::splat(simd, 2.5) - f32x16::splat(simd, 20.0) * moment)
        / (one - f32x16::splat(simd, 5.0) * moment);
    let ratio = sen / snn;
    let east = Vectors { x: cos, y: zero - sin, z: zero };
    let a = east.minus(tilt.times(ratio)).times(one / (see - sen * ratio).sqrt());
    let north = snn.sqrt();
    let b = tilt.times(one / north);

    // As in Window::new.
    let top = f32x16::splat(simd, sky.extent().latitudes[1] as f32);
    let row = (top - near_atan2(simd, direction.z, level)) * grids.rows_per_radian - half;
    let reach = north + f32x16::splat(simd, 0.21) * north * north * north;
    let rows = reach * grids.rows_per_radian;
    let (first, last) = ((row - rows).ceil(), (row + rows).floor());
    let is_small = large.simd_le(f32x16::splat(simd, (LARGEST * LARGEST) as f32));
    let curvature = (large + margin).sqrt() * direction.z.abs();
    let is_flat = curvature.simd_le(f32x16::splat(simd, CURVED as f32) * level);
    let is_window = is_small & is_flat & are_windows(simd, first, last, grids.n_rows, ROWS);
    let first_rows: [u32; EACH] = first.to_int::<u32x16<S>>().into();
    let n_rows: [u32; EACH] = (last - first + one).to_int::<u32x16<S>>().into();
    let ladder = LadderOf::new(simd, sky, &grids.levels, is_window, &first_rows, &n_rows);

    let [west, east] = sky.extent().longitudes;
    let (west, east) = (f32x16::splat(simd, west as f32), f32x16::splat(simd, east as f32));
    let longitude = near_atan2(simd, direction.x, direction.y);
    let turn = f32x16::splat(simd, core::f32::consts::TAU);
    let turned = longitude.simd_gt(east).select(longitude - turn, longitude);
    let turned = longitude.simd_lt(west).select(longitude + turn, turned);
    // A lower bound of cos(|latitude| + reach).
    let least_cos = level * (one - half * reach * reach) - direction.z.abs() * reach;
    let width = f32x16::splat(simd, (1.0 + SLACK) as f32) * see.sqrt();
    let columns = width / least_cos * ladder.per_radian;
    let column = (turned - west) * ladder.per_radian - half;
    let (first, last) = ((column - columns).ceil(), (column + columns).floor());
    let is_window = (is_window & are_windows(simd, first, last, ladder.n_columns, APRON)).to_bitmask();
    let windows = Windows {
        is_window,
        level: grids.levels,
        ladder: ladder.idx,
        row: first_rows,
        column: first.to_int::<u32x16<S>>().into(),
        n_rows,
        n_columns: (last - first + one).to_int::<u32x16<S>>().into(),
    };
    (Footprints { a: lanes_of(a), b: lanes_of(b), c: c.into(), windows }, doppler.into())
}

/// The grids of the mip levels of sixteen footprints.
struct GridsOf<S: Simd> {
    levels: [u32; EACH],
    texel: f32x16<S>,
    rows_per_radian: f32x16<S>,
    n_rows: f32x16<S>,
}

impl<S: Simd> GridsOf<S> {
    /// `small`: squares of the smaller semi-axes.
    #[inline(always)]
    fn new(simd: S, sky: &Panorama, small: f32x16<S>) -> Self {
        let squares: [f32; EACH] = small.into();
        let level = sky.level_of(f64::from(squares[0]));
        let square =
            |level: usize| sky.grids.get(level).map_or(f64::INFINITY, |grid| grid.texel * grid.texel);
        let least = if level == 0 { 0.0 } else { square(level) as f32 };
        let is_same = small.simd_ge(f32x16::splat(simd, least))
            & small.simd_lt(f32x16::splat(simd, square(level + 1) as f32));
        if is_same.all_true() {
            let grid = &sky.grids[level];
            return Self {
                levels: [level as u32; EACH],
                texel: f32x16::splat(simd, grid.texel as f32),
                rows_per_radian: f32x16::splat(simd, grid.rows_per_radian as f32),
                n_rows: f32x16::splat(simd, grid.rows.len() as f32),
            };
        }
        let mut levels = [0; EACH];
        let mut parts = [[0.0; EACH]; 3];
        for k in 0..EACH {
            let level = sky.level_of(f64::from(squares[k]));
            let grid = &sky.grids[level];
            levels[k] = level as u32;
            parts[0][k] = grid.texel as f32;
            parts[1][k] = grid.rows_per_radian as f32;
            parts[2][k] = grid.rows.len() as f32;
        }
        Self {
            levels,
            texel: f32x16::from_slice(simd, &parts[0]),
            rows_per_radian: f32x16::from_slice(simd, &parts[1]),
            n_rows: f32x16::from_slice(simd, &parts[2]),
        }
    }
}

/// The columns of the rows of sixteen windows.
struct LadderOf<S: Simd> {
    /// Index in the ladder.
    idx: [u32; EACH],
    per_radian: f32x16<S>,
    /// 0 where the rows of a window do not have the same, or there is no window.
    n_columns: f32x16<S>,
}

impl<S: Simd> LadderOf<S> {
    #[inline(always)]
    fn new(
        simd: S,
        sky: &Panorama,
        levels: &[u32; EACH],
        is_window: mask32x16<S>,
        first_rows: &[u32; EACH],
        n_rows: &[u32; EACH],
    ) -> Self {
        let is_window = is_window.to_bitmask();
        let (mut idx, mut per_radian, mut n_columns) = ([0; EACH], [1.0; EACH], [0.0; EACH]);
        for k in 0..EACH {
            if is_window >> k & 1 == 1 {
                let ladder = &sky.grids[levels[k] as usize].lines.ladder;
                let [top, bottom] =
                    [first_rows[k], first_rows[k] + n_rows[k] - 1].map(|row| ladder[row as usize]);
                if top == bottom {
                    let columns = &sky.ladder[top as usize];
                    idx[k] = top;
                    per_radian[k] = columns.per_radian as f32;
                    n_columns[k] = columns.n as f32;
                }
            }
        }
        Self {
            idx,
            per_radian: f32x16::from_slice(simd, &per_radian),
            n_columns: f32x16::from_slice(simd, &n_columns),
        }
    }
}

/// As `is_window`.
#[inline(always)]
fn are_windows<S: Simd>(
    simd: S,
    first: f32x16<S>,
    last: f32x16<S>,
    n: f32x16<S>,
    most: usize,
) -> mask32x16<S> {
    let is_inside = first.simd_ge(f32x16::splat(simd, 0.0)) & last.simd_lt(n);
    is_inside & last.simd_ge(first) & (last - first).simd_lt(f32x16::splat(simd, most as f32))
}

#[inline(always)]
fn lanes_of<S: Simd>(vectors: Vectors<S>) -> [[f32; EACH]; 3] {
    [vectors.x.into(), vectors.y.into(), vectors.z.into()]
}

/// Directions in the sky, and how they change with those seen.
struct OnSky<S: Simd> {
    seen: Vectors<S>,
    /// Inverse of the lengths on the film.
    inverse: f32x16<S>,
    ahead: Vectors<S>,
    doppler: f32x16<S>,
    turned: Vectors<S>,
    /// Sine of the longitude.
    sin: f32x16<S>,
    cos: f32x16<S>,
    /// To the north.
    tilt: Vectors<S>,
}

impl<S: Simd> OnSky<S> {
    /// East and north components of the change with a step on the film.
    #[inline(always)]
    fn slope(&self, step: Vectors<S>) -> (f32x16<S>, f32x16<S>) {
        let slope = step.minus(self.seen.times(self.seen.dot(step))).times(self.inverse);
        let part = slope.dot(self.ahead);
        let in_sky = slope.minus(self.ahead.times(part)).times(self.doppler).plus(self.turned.times(part));
        (in_sky.x * self.cos - in_sky.y * self.sin, in_sky.dot(self.tilt))
    }
}

/// atan2 within 3·10⁻⁶; see [`crate::footprint::near_atan2`].
#[inline(always)]
fn near_atan2<S: Simd>(simd: S, y: f32x16<S>, x: f32x16<S>) -> f32x16<S> {
    use core::f32::consts::{FRAC_PI_2, PI};
    let zero = f32x16::splat(simd, 0.0);
    let (above, across) = (y.abs(), x.abs());
    let is_flat = above.simd_lt(across);
    let t = is_flat.select(above, across) / is_flat.select(across, above);
    let s = t * t;
    let angle = f32x16::splat(simd, 0.052_653_32) - s * f32x16::splat(simd, 0.011_721_2);
    let angle = f32x16::splat(simd, -0.116_432_87) + s * angle;
    let angle = f32x16::splat(simd, 0.193_543_46) + s * angle;
    let angle = f32x16::splat(simd, -0.332_623_47) + s * angle;
    let angle = t * (f32x16::splat(simd, 0.999_977_26) + s * angle);
    let angle = is_flat.select(angle, f32x16::splat(simd, FRAC_PI_2) - angle);
    let angle = x.simd_lt(zero).select(f32x16::splat(simd, PI) - angle, angle);
    y.simd_lt(zero).select(zero - angle, angle)
}

#[cfg(test)]
mod tests {
    use ugphysics::Velocity;

    use super::*;
    use crate::grid::Extent;
    use crate::texels::Texels;

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
            let mut found = [Seen::default(); 2];
            sampler.flat_row(&observer, &film, [0.5, 3.5], 1.0, &mut found);
            for column in 0..found.len() * Seen::N {
                n += 1;
                let (found, idx) = (&found[column / Seen::N], column % Seen::N);
                if !found.is_found[idx] {
                    continue;
                }
                n_found += 1;
                let light = found.light.map(|channel| channel[idx]);
                let on_film = film.corner + (0.5 + column as f64) * across + 3.5 * down;
                let inverse = 1.0 / on_film.length();
                let seen = on_film * inverse;
                let slopes = [across, down].map(|step| (step - seen.dot(step) * seen) * inverse);
                let ray = observer.ray(seen, slopes);
                let expected = sampler.light(&ray, 1.0).unwrap();
                let error = (0..4).map(|i| (light[i] - expected[i]).abs()).fold(0.0, f32::max);
                assert!(error < 1e-3, "{observer:?} {film:?}: {light:?}, not {expected:?}");
                assert!((f64::from(found.doppler[idx]) / ray.doppler - 1.0).abs() < 1e-5);
            }
        }
        assert!(n_found > n * 4 / 5, "{n_found} of {n}");
    }
}
