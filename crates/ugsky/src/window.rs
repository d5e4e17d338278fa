//! The light of most footprints: away from poles and edges, where all rows of an ellipse have the
//! same columns, and few.
//!
//! Weights are computed for a whole window, eight columns at once. There is no fused
//! multiplication and addition, so all processors compute the same.

use core::f64::consts::TAU;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x4, f32x8};
use glam::DVec3;

use crate::footprint::{CURVED, Kernel, SLACK, correction, near_atan2};
use crate::grid::{APRON, CHUNK, PAD, Row};
use crate::panorama::{Decoder, Panorama, RowTexels};

/// Most rows of a window. Its columns are at most [`APRON`].
const ROWS: usize = 16;

const CHUNKS: usize = ROWS * APRON / CHUNK;

/// The weights of a window: of the kernel, and of its positive part times s and times t.
pub(crate) type Scratch = [[[f32; CHUNK]; 3]; CHUNKS];

/// What is needed of an ellipse to weigh texels.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Footprint {
    pub level: usize,
    /// The kernel: q = (a·d)² + (b·d)², and c.
    pub a: [f32; 3],
    pub b: [f32; 3],
    pub c: f32,
    /// The first and the last row that it may cover; NaN where circles of latitude are too curved.
    pub rows: [f32; 2],
    /// The longitude of its middle, and half its width in radians on the sphere.
    pub longitude: f32,
    pub half: f32,
}

impl Footprint {
    #[inline(always)]
    fn new(sky: &Panorama, level: usize, kernel: &Kernel, center: DVec3) -> Self {
        let grid = &sky.grids[level];
        let cos = (center.x * center.x + center.y * center.y).sqrt();
        let latitude = near_atan2(center.z, cos);
        let reach = reach(kernel.matrix[2].sqrt()) * grid.rows_per_radian;
        let row = (sky.extent().latitudes[1] - latitude) * grid.rows_per_radian - 0.5;
        let is_curved = kernel.radius * center.z.abs() > CURVED * cos;
        Self {
            level,
            a: kernel.a.as_vec3().to_array(),
            b: kernel.b.as_vec3().to_array(),
            c: kernel.c,
            rows: if is_curved {
                [f32::NAN; 2]
            } else {
                [(row - reach).ceil() as f32, (row + reach).floor() as f32]
            },
            longitude: near_atan2(center.x, center.y) as f32,
            half: ((1.0 + SLACK) * kernel.matrix[0].sqrt()) as f32,
        }
    }
}

/// An angle not below asin r, as asin r < r + 0.21 r³ for r < 0.6.
#[inline(always)]
fn reach(r: f64) -> f64 {
    r + 0.21 * r * r * r
}

/// The rows and columns that an ellipse may cover.
struct Window {
    rows: [usize; 2],
    column: usize,
    n_columns: usize,
}

impl Window {
    /// Returns `None` near poles and edges, and if the ellipse is large.
    #[inline(always)]
    fn new(sky: &Panorama, footprint: &Footprint) -> Option<Self> {
        let grid = &sky.grids[footprint.level];
        let [first, last] = footprint.rows;
        if !(first >= 0.0 && last < grid.rows.len() as f32 && last - first < ROWS as f32) {
            return None;
        }
        let rows = [first as usize, last as usize];
        let (top, bottom) = (&grid.rows[rows[0]], &grid.rows[rows[1]]);
        if top.ladder != bottom.ladder {
            return None;
        }
        let columns = &sky.ladder[top.ladder];
        let [west, east] = sky.extent().longitudes;
        let longitude = f64::from(footprint.longitude);
        let turned = if longitude < west {
            longitude + TAU
        } else if longitude > east {
            longitude - TAU
        } else {
            longitude
        };
        let half = f64::from(footprint.half) / top.cos.min(bottom.cos) * columns.per_radian;
        let column = (turned - west) * columns.per_radian - 0.5;
        let (first, last) = ((column - half).ceil(), (column + half).floor());
        if !(first >= 0.0 && last < columns.n as f64 && last - first < APRON as f64) {
            return None;
        }
        Some(Self { rows, column: first as usize, n_columns: (last - first) as usize + 1 })
    }
}

/// The mean light of an ellipse: light times alpha, and alpha. `None` where it has no window.
#[inline(always)]
pub(crate) fn light<S: Simd>(
    simd: S,
    sky: &Panorama,
    level: usize,
    kernel: &Kernel,
    center: DVec3,
    scratch: &mut Scratch,
) -> Option<[f32; 4]> {
    light_of(simd, sky, &Footprint::new(sky, level, kernel, center), scratch)
}

/// The same of a footprint.
#[inline(always)]
pub(crate) fn light_of<S: Simd>(
    simd: S,
    sky: &Panorama,
    footprint: &Footprint,
    scratch: &mut Scratch,
) -> Option<[f32; 4]> {
    let window = Window::new(sky, footprint)?;
    let level = footprint.level;
    let rows = &sky.grids[level].rows[window.rows[0]..=window.rows[1]];
    let columns = &sky.ladder[rows[0].ladder];
    let pad = if sky.extent().is_closed() { 0 } else { PAD };
    let n_chunks = window.n_columns.div_ceil(CHUNK);

    let one = f32x8::splat(simd, 1.0);
    let zero = f32x8::splat(simd, 0.0);
    let c = f32x8::splat(simd, footprint.c);
    let mut sums = Sums::new(zero);
    let mut idx = 0;
    for row in rows {
        let across = Line::new(simd, &footprint.a, row);
        let along = Line::new(simd, &footprint.b, row);
        let area = f32x8::splat(simd, row.area);
        for chunk in 0..n_chunks {
            let at = window.column + pad + CHUNK * chunk;
            let cos = f32x8::from_slice(simd, &columns.cos[at..at + CHUNK]);
            let sin = f32x8::from_slice(simd, &columns.sin[at..at + CHUNK]);
            let s = across.at(cos, sin);
            let t = along.at(cos, sin);
            let q = s * s + t * t;
            let rest = (one - q).max(zero);
            let positive = area * rest * rest;
            let weight = positive * (one - c * q);
            let (by_s, by_t) = (positive * s, positive * t);
            sums.s += weight * s;
            sums.t += weight * t;
            sums.ss += by_s * s;
            sums.st += by_s * t;
            sums.tt += by_t * t;
            sums.total += weight;
            sums.by_s += by_s;
            sums.by_t += by_t;
            let stored = &mut scratch[idx % CHUNKS];
            weight.store_slice(&mut stored[0]);
            by_s.store_slice(&mut stored[1]);
            by_t.store_slice(&mut stored[2]);
            idx += 1;
        }
    }
    let moments = [lanes(sums.s), lanes(sums.t), lanes(sums.ss), lanes(sums.st), lanes(sums.tt)];
    let [across, along] = correction(moments);
    let total = lanes(sums.total) + across * lanes(sums.by_s) + along * lanes(sums.by_t);
    if total <= 0.0 {
        return Some([0.0; 4]);
    }

    let across = f32x8::splat(simd, across);
    let along = f32x8::splat(simd, along);
    let dark = f32x4::splat(simd, 0.0);
    let (mut even, mut odd) = (dark, dark);
    let mut idx = 0;
    for row in rows {
        let texels = sky.texels(level, row, window.column, window.n_columns);
        let mut rest = window.n_columns;
        for chunk in 0..n_chunks {
            let stored = &scratch[idx % CHUNKS];
            let weight = f32x8::from_slice(simd, &stored[0]);
            let by_s = f32x8::from_slice(simd, &stored[1]);
            let by_t = f32x8::from_slice(simd, &stored[2]);
            let weights: [f32; CHUNK] = (weight + across * by_s + along * by_t).into();
            let n = rest.min(CHUNK);
            match texels {
                RowTexels::Light(texels) => {
                    let texels = &texels[CHUNK * chunk..];
                    let texels = &texels[..n];
                    let mut k = 0;
                    while k + 1 < n {
                        even += weighted(simd, weights[k % CHUNK], &texels[k]);
                        odd += weighted(simd, weights[(k + 1) % CHUNK], &texels[k + 1]);
                        k += 2;
                    }
                    if k < n {
                        even += weighted(simd, weights[k % CHUNK], &texels[k]);
                    }
                }
                RowTexels::Srgb(texels, decoder) => {
                    let texels = &texels[CHUNK * chunk..];
                    let texels = &texels[..n];
                    let is_opaque = texels.iter().fold(255, |all, texel| all & texel[3]) == 255;
                    if is_opaque {
                        let mut k = 0;
                        while k + 1 < n {
                            even += weighted_opaque(simd, weights[k % CHUNK], decoder, texels[k]);
                            odd += weighted_opaque(simd, weights[(k + 1) % CHUNK], decoder, texels[k + 1]);
                            k += 2;
                        }
                        if k < n {
                            even += weighted_opaque(simd, weights[k % CHUNK], decoder, texels[k]);
                        }
                    } else {
                        for k in 0..n {
                            even += weighted(simd, weights[k % CHUNK], &decoder.light(texels[k]));
                        }
                    }
                }
            }
            rest -= n;
            idx += 1;
        }
    }
    Some(((even + odd) * f32x4::splat(simd, 1.0 / total)).into())
}

#[inline(always)]
fn weighted<S: Simd>(simd: S, weight: f32, texel: &[f32; 4]) -> f32x4<S> {
    f32x4::splat(simd, weight) * f32x4::from_slice(simd, texel)
}

/// The same of an opaque colour.
#[inline(always)]
fn weighted_opaque<S: Simd>(simd: S, weight: f32, decoder: &Decoder, texel: [u8; 4]) -> f32x4<S> {
    let [red, green, blue] = decoder.parts(texel);
    let parts = f32x4::from_slice(simd, red) + f32x4::from_slice(simd, green);
    f32x4::splat(simd, weight) * (parts + f32x4::from_slice(simd, blue))
}

/// Sums over the texels of a window.
struct Sums<S: Simd> {
    /// Weight times s, weight times t, and positive part times s², s t and t².
    s: f32x8<S>,
    t: f32x8<S>,
    ss: f32x8<S>,
    st: f32x8<S>,
    tt: f32x8<S>,
    /// Weight, and positive part times s and times t.
    total: f32x8<S>,
    by_s: f32x8<S>,
    by_t: f32x8<S>,
}

impl<S: Simd> Sums<S> {
    #[inline(always)]
    fn new(zero: f32x8<S>) -> Self {
        Self { s: zero, t: zero, ss: zero, st: zero, tt: zero, total: zero, by_s: zero, by_t: zero }
    }
}

/// Dot product of a vector with the directions of one latitude: `level + by_cos cos λ +
/// by_sin sin λ` at the longitude λ.
struct Line<S: Simd> {
    by_cos: f32x8<S>,
    by_sin: f32x8<S>,
    level: f32x8<S>,
}

impl<S: Simd> Line<S> {
    #[inline(always)]
    fn new(simd: S, [x, y, z]: &[f32; 3], row: &Row) -> Self {
        let (cos, sin) = (row.cos as f32, row.sin as f32);
        Self {
            by_cos: f32x8::splat(simd, y * cos),
            by_sin: f32x8::splat(simd, x * cos),
            level: f32x8::splat(simd, z * sin),
        }
    }

    #[inline(always)]
    fn at(&self, cos: f32x8<S>, sin: f32x8<S>) -> f32x8<S> {
        self.by_cos * cos + self.by_sin * sin + self.level
    }
}

/// The sum of the lanes, in the same order on every processor.
#[inline(always)]
fn lanes<S: Simd>(number: f32x8<S>) -> f32 {
    let [a, b, c, d, e, f, g, h]: [f32; CHUNK] = number.into();
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}

#[cfg(test)]
mod tests {
    use core::f64::consts::PI;

    use super::*;
    use crate::footprint::Ellipse;
    use crate::grid::Extent;
    use crate::observer::SkyRay;
    use crate::panorama::Texels;

    /// Windows have the light that is computed row by row, in most directions.
    #[test]
    fn windows_are_footprints() {
        let size = [1100, 550];
        let texel = |idx: u32| {
            let part = |by: f32| (255.0 * (idx as f32 * by).fract()) as u8;
            [
                part(0.618_034),
                part(0.754_878),
                part(0.569_84),
                if idx.is_multiple_of(7) { part(0.3) } else { 255 },
            ]
        };
        let texels: Vec<[u8; 4]> = (0..size[0] * size[1]).map(texel).collect();
        let part = Extent { longitudes: [1.0, 1.0 + PI], latitudes: [-1.0, 0.8] };
        for extent in [Extent::FULL, part] {
            let sky = Panorama::new(size, Texels::Srgb(texels.clone()), extent).unwrap();
            let mut sampler = sky.sampler();
            let (mut n, mut n_windows) = (0, 0);
            for step in 0..4000 {
                let part = |by: f64| (f64::from(step) * by).fract();
                let (z, turn) = (2.0 * part(0.618_034) - 1.0, TAU * part(0.754_878));
                let (sin, cos) = libm::sincos(turn);
                let level = (1.0 - z * z).sqrt();
                let direction = DVec3::new(level * sin, level * cos, z);
                let size = 1e-4 * libm::exp(6.0 * part(0.569_84));
                let one = direction.any_orthonormal_vector();
                let slopes = [size * one, 0.6 * size * direction.cross(one)];
                let ellipse = Ellipse::new(&SkyRay { direction, slopes, doppler: 1.0 }, 1.0);
                let level = sky.level_of(ellipse.small_square());
                let kernel = ellipse.kernel(sky.grids[level].texel, sky.grids[0].texel);
                let simd = fearless_simd::Level::new();
                let mut scratch = Scratch::default();
                let found = fearless_simd::dispatch!(simd, simd =>
                    light(simd, &sky, level, &kernel, direction, &mut scratch));
                n += 1;
                let Some(found) = found else { continue };
                n_windows += 1;
                let expected = sampler.light_anywhere(level, &kernel, direction);
                let error = (0..4).map(|i| (found[i] - expected[i]).abs()).fold(0.0, f32::max);
                assert!(error < 5e-5, "{direction} {size}: {found:?}, not {expected:?}");
            }
            let least = if extent == Extent::FULL { 0.9 } else { 0.3 };
            assert!(f64::from(n_windows) > least * f64::from(n), "{n_windows} of {n}");
        }
    }
}
