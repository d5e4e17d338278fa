//! The light of most footprints: away from poles and edges, where all rows of an ellipse have the
//! same columns, and few. That of sixteen footprints is found together.
//!
//! Weights are computed for eight columns of a row at once. There is no fused multiplication and
//! addition, so all processors compute the same.

use core::f64::consts::TAU;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x4, f32x8, f32x16};
use glam::DVec3;

use crate::blocks::{Block, Blocks, Held, WIDTH, Window};
use crate::footprint::{CURVED, Kernel, SLACK, correction, near_atan2};
use crate::grid::{CHUNK, LINES_AT_ONCE, PAD};
use crate::panorama::Panorama;
use crate::pyramid::APRON;

/// Most rows of a window. Its columns are at most [`APRON`].
pub(crate) const ROWS: usize = LINES_AT_ONCE;

/// Footprints whose light is found together.
pub(crate) const EACH: usize = 16;

/// Sixteen footprints.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Footprints {
    /// Their kernels, by coordinate: q = (a·d)² + (b·d)², and c.
    pub a: [[f32; EACH]; 3],
    pub b: [[f32; EACH]; 3],
    pub c: [f32; EACH],
    /// Their texels.
    pub windows: [Option<Window>; EACH],
}

/// An angle not below asin r, as asin r < r + 0.21 r³ for r < 0.6.
#[inline(always)]
fn reach(r: f64) -> f64 {
    r + 0.21 * r * r * r
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
        let up = reach(kernel.matrix[2].sqrt()) * grid.rows_per_radian;
        let row = (sky.extent().latitudes[1] - latitude) * grid.rows_per_radian - 0.5;
        let (first, last) = ((row - up).ceil(), (row + up).floor());
        if !is_window(first, last, grid.rows.len(), ROWS) {
            return None;
        }
        let (row, n_rows) = (first as u32, (last - first) as u32 + 1);
        let [top, bottom] = [row, row + n_rows - 1].map(|idx| &grid.rows[idx as usize]);
        if top.ladder != bottom.ladder {
            return None;
        }
        let columns = &sky.ladder[top.ladder];
        let [west, east] = sky.extent().longitudes;
        let longitude = near_atan2(center.x, center.y);
        let turned = if longitude < west {
            longitude + TAU
        } else if longitude > east {
            longitude - TAU
        } else {
            longitude
        };
        let width = (1.0 + SLACK) * kernel.matrix[0].sqrt();
        let half = width / top.cos.min(bottom.cos) * columns.per_radian;
        let at = (turned - west) * columns.per_radian - 0.5;
        let (first, last) = ((at - half).ceil(), (at + half).floor());
        is_window(first, last, columns.n, APRON).then(|| Self {
            level: level as u32,
            ladder: top.ladder as u32,
            row,
            column: first as u32,
            n_rows,
            n_columns: (last - first) as u32 + 1,
        })
    }
}

/// True if indices are below `n` and not more than `most`.
#[inline(always)]
fn is_window(first: f64, last: f64, n: usize, most: usize) -> bool {
    first >= 0.0 && last < f64::from(n as u32) && last >= first && last - first < most as f64
}

/// The weights of a window by chunk and row: of the kernel, and of its positive part times s and
/// times t, see [`weigh`].
type Weights = [[[[f32; CHUNK]; 3]; ROWS]; APRON / CHUNK];

/// Sums over the texels of a window, by column of a chunk.
type Sums = [[f32; CHUNK]; 5];

/// Buffers for the light of footprints.
pub(crate) struct Buffers {
    weights: Box<[Weights; EACH]>,
    sums: [Sums; EACH],
    blocks: Blocks,
}

impl Buffers {
    pub fn new() -> Self {
        Self { weights: Box::default(), sums: [[[0.0; CHUNK]; 5]; EACH], blocks: Blocks::new() }
    }
}

impl Footprints {
    /// Sets a footprint, and returns whether it has a window.
    #[inline(always)]
    pub fn set(
        &mut self,
        idx: usize,
        sky: &Panorama,
        level: usize,
        kernel: &Kernel,
        center: DVec3,
    ) -> bool {
        let Some(window) = Window::new(sky, level, kernel, center) else { return false };
        let (a, b) = (kernel.a.as_vec3().to_array(), kernel.b.as_vec3().to_array());
        (0..3).for_each(|axis| (self.a[axis][idx], self.b[axis][idx]) = (a[axis], b[axis]));
        self.c[idx] = kernel.c;
        self.windows[idx] = Some(window);
        true
    }
}

/// The mean light of sixteen ellipses: red, green and blue times alpha, and alpha. Nothing where
/// there is no window.
#[inline(always)]
pub(crate) fn lights<S: Simd>(
    simd: S,
    sky: &Panorama,
    footprints: &Footprints,
    buffers: &mut Buffers,
) -> [[f32; EACH]; 4] {
    let Buffers { weights, sums, blocks } = buffers;
    for (idx, (sums, weights)) in sums.iter_mut().zip(weights.iter_mut()).enumerate() {
        match footprints.windows[idx] {
            Some(window) => weigh(simd, sky, footprints, idx, &window, weights, sums),
            None => *sums = [[0.0; CHUNK]; 5],
        }
    }
    let [across, along] = correction(simd, totals(simd, sums));
    let (across, along): ([f32; EACH], [f32; EACH]) = (across.into(), along.into());

    // The sums of footprints without a window stay 0.
    for (idx, (sums, weights)) in sums.iter_mut().zip(weights.iter()).enumerate() {
        if let Some(window) = footprints.windows[idx] {
            sum(simd, sky, &window, weights, [across[idx], along[idx]], blocks, sums);
        }
    }
    let [total, red, green, blue, alpha] = totals(simd, sums);
    let zero = f32x16::splat(simd, 0.0);
    let is_any = total.simd_gt(zero);
    let scale = is_any.select(f32x16::splat(simd, 1.0) / total, zero);
    // Exactly 1 if all texels are opaque.
    let alpha = is_any.select(alpha / total, zero);
    [(red * scale).into(), (green * scale).into(), (blue * scale).into(), alpha.into()]
}

/// Computes the weights of a window, and sums: weight times s, weight times t, and positive part
/// times s², s t and t². Here s = a·d and t = b·d are divided by the cosine of the latitude, so
/// that each is a sum of two terms, one for the column and one for the row.
#[inline(always)]
fn weigh<S: Simd>(
    simd: S,
    sky: &Panorama,
    footprints: &Footprints,
    idx: usize,
    window: &Window,
    weights: &mut Weights,
    sums: &mut Sums,
) {
    let grid = &sky.grids[window.level as usize];
    let columns = &sky.ladder[window.ladder as usize];
    let pad = if sky.extent().is_closed() { 0 } else { PAD };
    let (one, zero) = (f32x8::splat(simd, 1.0), f32x8::splat(simd, 0.0));
    let (a_x, a_y) =
        (f32x8::splat(simd, footprints.a[0][idx]), f32x8::splat(simd, footprints.a[1][idx]));
    let (b_x, b_y) =
        (f32x8::splat(simd, footprints.b[0][idx]), f32x8::splat(simd, footprints.b[1][idx]));
    let row = window.row as usize;
    let n_rows = (window.n_rows as usize).min(ROWS);
    // For each row, what its texels have in common.
    let of_rows = |list: &[f32]| f32x16::from_slice(simd, &list[row..row + ROWS]);
    let root: [f32; ROWS] = of_rows(&grid.lines.root).into();
    let root_cos_square: [f32; ROWS] = of_rows(&grid.lines.root_cos_square).into();
    let (tan, cos_square) = (of_rows(&grid.lines.tan), of_rows(&grid.lines.cos_square));
    let row_s: [f32; ROWS] = (f32x16::splat(simd, footprints.a[2][idx]) * tan).into();
    let row_t: [f32; ROWS] = (f32x16::splat(simd, footprints.b[2][idx]) * tan).into();
    let row_c: [f32; ROWS] = (f32x16::splat(simd, footprints.c[idx]) * cos_square).into();
    let mut moments = [zero; 5];
    let n_chunks = (window.n_columns as usize).div_ceil(CHUNK);
    for (chunk, weights) in weights.iter_mut().enumerate().take(n_chunks) {
        let at = window.column as usize + pad + CHUNK * chunk;
        let cos = f32x8::from_slice(simd, &columns.cos[at..at + CHUNK]);
        let sin = f32x8::from_slice(simd, &columns.sin[at..at + CHUNK]);
        // The dot products of a and b with the horizontal directions of the columns.
        let level_a = a_x * sin + a_y * cos;
        let level_b = b_x * sin + b_y * cos;
        for row in 0..n_rows {
            let s = level_a + f32x8::splat(simd, row_s[row]);
            let t = level_b + f32x8::splat(simd, row_t[row]);
            let square = s * s + t * t;
            let rest =
                f32x8::splat(simd, root[row]) - f32x8::splat(simd, root_cos_square[row]) * square;
            let rest = rest.max(zero);
            let positive = rest * rest;
            let weight = positive * (one - f32x8::splat(simd, row_c[row]) * square);
            let (by_s, by_t) = (positive * s, positive * t);
            moments[0] += weight * s;
            moments[1] += weight * t;
            moments[2] += by_s * s;
            moments[3] += by_s * t;
            moments[4] += by_t * t;
            let stored = &mut weights[row];
            weight.store_slice(&mut stored[0]);
            by_s.store_slice(&mut stored[1]);
            by_t.store_slice(&mut stored[2]);
        }
    }
    for (moment, sum) in moments.iter().zip(sums) {
        moment.store_slice(sum);
    }
}

/// Sums over the texels of a window: weight; and red, green, blue and alpha times weight. Passed
/// are the factors of [`correction`].
#[inline(always)]
fn sum<S: Simd>(
    simd: S,
    sky: &Panorama,
    window: &Window,
    weights: &Weights,
    factors: [f32; 2],
    blocks: &mut Blocks,
    sums: &mut Sums,
) {
    let held = blocks.at(sky, window);
    let channels = if held.is_opaque {
        let [total, red, green, blue] = sum_channels(simd, &held, window, weights, factors);
        [total, red, green, blue, total]
    } else {
        sum_channels(simd, &held, window, weights, factors)
    };
    for (channel, sum) in channels.iter().zip(sums) {
        channel.store_slice(sum);
    }
}

/// The sums of the weights and of the first channels.
#[inline(always)]
fn sum_channels<S: Simd, const N: usize>(
    simd: S,
    held: &Held<'_>,
    window: &Window,
    weights: &Weights,
    factors: [f32; 2],
) -> [f32x8<S>; N] {
    let (across, along) = (f32x8::splat(simd, factors[0]), f32x8::splat(simd, factors[1]));
    let mut sums = [f32x8::splat(simd, 0.0); N];
    let (row, n_rows) = (window.row as usize, (window.n_rows as usize).min(ROWS));
    let n_chunks = (window.n_columns as usize).div_ceil(CHUNK);
    for (chunk, weights) in weights.iter().enumerate().take(n_chunks) {
        let at = (held.column + CHUNK * chunk).min(WIDTH - CHUNK);
        for (idx, [weight, by_s, by_t]) in weights[..n_rows].iter().enumerate() {
            let weight = f32x8::from_slice(simd, weight);
            let by_s = f32x8::from_slice(simd, by_s);
            let by_t = f32x8::from_slice(simd, by_t);
            let weight = weight + across * by_s + along * by_t;
            sums[0] += weight;
            let Block(planes) = &held.blocks[(row + idx) % held.blocks.len()];
            for (sum, plane) in sums[1..].iter_mut().zip(planes) {
                *sum += weight * f32x8::from_slice(simd, &plane[at..at + CHUNK]);
            }
        }
    }
    sums
}

/// The sums over the columns of each part, for all footprints.
#[inline(always)]
fn totals<S: Simd>(simd: S, sums: &[Sums; EACH]) -> [f32x16<S>; 5] {
    let mut totals = [f32x16::splat(simd, 0.0); 5];
    for (part, total) in totals.iter_mut().enumerate() {
        let first = simd.combine_f32x4(four(simd, sums, part, 0), four(simd, sums, part, 4));
        let second = simd.combine_f32x4(four(simd, sums, part, 8), four(simd, sums, part, 12));
        *total = simd.combine_f32x8(first, second);
    }
    totals
}

/// The sums over the columns of a part, for four footprints.
#[inline(always)]
fn four<S: Simd>(simd: S, sums: &[Sums; EACH], part: usize, first: usize) -> f32x4<S> {
    lanes(
        f32x8::from_slice(simd, &sums[first][part]),
        f32x8::from_slice(simd, &sums[first + 1][part]),
        f32x8::from_slice(simd, &sums[first + 2][part]),
        f32x8::from_slice(simd, &sums[first + 3][part]),
    )
}

/// The sums of the lanes of four vectors, in the same order on every processor.
#[inline(always)]
fn lanes<S: Simd>(a: f32x8<S>, b: f32x8<S>, c: f32x8<S>, d: f32x8<S>) -> f32x4<S> {
    let (a, b, c, d) = (halved(a), halved(b), halved(c), halved(d));
    let ac = a.zip_low(c) + a.zip_high(c);
    let bd = b.zip_low(d) + b.zip_high(d);
    ac.zip_low(bd) + ac.zip_high(bd)
}

/// The sums of lanes half a vector apart.
#[inline(always)]
fn halved<S: Simd>(vector: f32x8<S>) -> f32x4<S> {
    let (low, high) = vector.split();
    low + high
}
