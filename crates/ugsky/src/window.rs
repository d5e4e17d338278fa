//! The light of most footprints: away from poles and edges, where all rows of an ellipse have the
//! same columns, and few.
//!
//! Weights are computed for a whole window, eight columns at once. There is no fused
//! multiplication and addition, so all processors compute the same.

use core::f64::consts::TAU;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x4, f32x8};
use glam::DVec3;

use crate::footprint::{Kernel, near_atan2};
use crate::grid::{APRON, CHUNK, PAD};
use crate::panorama::{Panorama, RowTexels};
use crate::sample::{CURVED, SLACK, correction};

/// Most rows of a window. Its columns are at most [`APRON`].
const ROWS: usize = 16;

/// The weights of a window: of the kernel, and of its positive part times s and times t.
pub(crate) type Scratch = [[[f32; CHUNK]; 3]; ROWS * APRON / CHUNK];

/// The rows and columns that an ellipse may cover.
struct Window {
    rows: [usize; 2],
    column: usize,
    n_columns: usize,
}

impl Window {
    /// Returns `None` near poles and edges, and if the ellipse is large.
    #[inline(always)]
    fn new(sky: &Panorama, level: usize, kernel: &Kernel, center: DVec3) -> Option<Self> {
        let grid = &sky.grids[level];
        let cos = (center.x * center.x + center.y * center.y).sqrt();
        if kernel.radius * center.z.abs() > CURVED * cos {
            return None;
        }
        let latitude = near_atan2(center.z, cos);
        let longitude = near_atan2(center.x, center.y);
        let extent = sky.extent();
        // asin r < r + 0.21 r³ for r < 0.6.
        let north = kernel.matrix[2].sqrt();
        let reach = (north + 0.21 * north * north * north) * grid.rows_per_radian;
        let row = (extent.latitudes[1] - latitude) * grid.rows_per_radian - 0.5;
        let (first, last) = ((row - reach).ceil(), (row + reach).floor());
        if !(first >= 0.0 && last < grid.rows.len() as f64 && last - first < ROWS as f64) {
            return None;
        }
        let rows = [first as usize, last as usize];
        let [top, bottom] = rows.map(|row| &grid.rows[row]);
        if top.ladder != bottom.ladder {
            return None;
        }
        let columns = &sky.ladder[top.ladder];
        let west = extent.longitudes[0];
        let turned = if longitude < west {
            longitude + TAU
        } else if longitude > extent.longitudes[1] {
            longitude - TAU
        } else {
            longitude
        };
        let half = (1.0 + SLACK) * kernel.matrix[0].sqrt() / top.cos.min(bottom.cos) * columns.per_radian;
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
    let window = Window::new(sky, level, kernel, center)?;
    let rows = &sky.grids[level].rows[window.rows[0]..=window.rows[1]];
    let columns = &sky.ladder[rows[0].ladder];
    let pad = if sky.extent().is_closed() { 0 } else { PAD };
    let n_chunks = window.n_columns.div_ceil(CHUNK);

    let splat = |number: f32| f32x8::splat(simd, number);
    let (one, zero, c) = (splat(1.0), splat(0.0), splat(kernel.c));
    let (a, b) = (kernel.a, kernel.b);
    let mut sums = [zero; 8];
    let mut next = scratch.iter_mut();
    for row in rows {
        let across = [a.y * row.cos, a.x * row.cos, a.z * row.sin].map(|part| splat(part as f32));
        let along = [b.y * row.cos, b.x * row.cos, b.z * row.sin].map(|part| splat(part as f32));
        let area = splat(row.area);
        for chunk in 0..n_chunks {
            let at = window.column + pad + CHUNK * chunk;
            let cos = f32x8::from_slice(simd, &columns.cos[at..at + CHUNK]);
            let sin = f32x8::from_slice(simd, &columns.sin[at..at + CHUNK]);
            let s = across[0] * cos + across[1] * sin + across[2];
            let t = along[0] * cos + along[1] * sin + along[2];
            let q = s * s + t * t;
            let rest = (one - q).max(zero);
            let positive = area * rest * rest;
            let weight = positive * (one - c * q);
            let (by_s, by_t) = (positive * s, positive * t);
            sums[0] += weight * s;
            sums[1] += weight * t;
            sums[2] += by_s * s;
            sums[3] += by_s * t;
            sums[4] += by_t * t;
            sums[5] += weight;
            sums[6] += by_s;
            sums[7] += by_t;
            let [kernel, first, second] = next.next()?;
            weight.store_slice(kernel);
            by_s.store_slice(first);
            by_t.store_slice(second);
        }
    }
    let [s, t, ss, st, tt, total, first, second] = sums.map(lanes);
    let [across, along] = correction([s, t, ss, st, tt]);
    let total = total + across * first + along * second;
    if total <= 0.0 {
        return Some([0.0; 4]);
    }

    let (across, along) = (splat(across), splat(along));
    let mut light = [f32x4::splat(simd, 0.0); 2];
    let mut next = scratch.iter();
    for row in rows {
        let texels = sky.texels(level, row, window.column, window.n_columns);
        for chunk in 0..n_chunks {
            let [weight, first, second] = next.next()?;
            let [weight, first, second] = [weight, first, second].map(|lanes| f32x8::from_slice(simd, lanes));
            let weights: [f32; CHUNK] = (weight + across * first + along * second).into();
            match texels {
                RowTexels::Light(texels) => {
                    for (idx, (texel, &weight)) in texels[CHUNK * chunk..].iter().zip(&weights).enumerate() {
                        light[idx % 2] += f32x4::splat(simd, weight) * f32x4::from_slice(simd, texel);
                    }
                }
                RowTexels::Srgb(texels, decoder) => {
                    for (idx, (&texel, &weight)) in texels[CHUNK * chunk..].iter().zip(&weights).enumerate() {
                        let texel = if texel[3] == 255 {
                            let [red, green, blue] =
                                decoder.parts(texel).map(|part| f32x4::from_slice(simd, part));
                            red + green + blue
                        } else {
                            f32x4::from_slice(simd, &decoder.light(texel))
                        };
                        light[idx % 2] += f32x4::splat(simd, weight) * texel;
                    }
                }
            }
        }
    }
    let light = (light[0] + light[1]) * f32x4::splat(simd, 1.0 / total);
    Some(light.into())
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
            [part(0.618_034), part(0.754_878), part(0.569_84), if idx % 7 == 0 { part(0.3) } else { 255 }]
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
                assert!(error < 1e-5, "{direction} {size}: {found:?}, not {expected:?}");
            }
            let least = if extent == Extent::FULL { 0.9 } else { 0.3 };
            assert!(f64::from(n_windows) > least * f64::from(n), "{n_windows} of {n}");
        }
    }
}
