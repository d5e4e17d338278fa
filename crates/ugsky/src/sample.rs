//! The light of a panorama in an elliptical footprint.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use fearless_simd::{Level, Simd, dispatch};
use glam::DVec3;

use crate::footprint::{CURVED, Ellipse, Kernel, SLACK, correction_of, near_atan2};
use crate::grid::{CHUNK, Columns, Grid, PAD, Row};
use crate::observer::SkyRay;
use crate::panorama::Panorama;
use crate::window::{self, Buffers, EACH, Footprints};

/// Finds the light of footprints in a panorama.
pub struct Sampler<'a> {
    panorama: &'a Panorama,
    pub(crate) simd: Level,
    buffers: Buffers,
    runs: Vec<Run>,
    /// The weights of all runs, each in whole chunks.
    chunks: Vec<Weights>,
    moments: Moments,
    /// The sum of all weights of a footprint much larger than the panorama, of which only the
    /// texels are weighed.
    total: Option<f32>,
}

/// The light of sixteen footprints in the frame of the sky.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seen {
    /// Red, green and blue times alpha, and alpha.
    pub light: [[f32; EACH]; 4],
    /// The Doppler factors.
    pub doppler: [f32; EACH],
    /// False for footprints that have to be divided.
    pub is_found: [bool; EACH],
}

impl Seen {
    /// Number of footprints.
    pub const N: usize = EACH;
}

/// Weights of neighbouring texels, which are 0 after the end of a run.
#[derive(Clone, Copy)]
struct Weights {
    /// Weights by the kernel.
    kernel: [f32; CHUNK],
    /// Weights by its positive part, (1 − q)², times the coordinates s = a·d and t = b·d, which
    /// away from poles are divided by the cosine of the latitude, as in windows.
    across: [f32; CHUNK],
    along: [f32; CHUNK],
}

/// Sums over the texels of a footprint, by place in the chunk: weight times s, weight times t,
/// positive part times s², s t and t².
#[derive(Clone, Copy, Default)]
struct Moments([[f32; CHUNK]; 5]);

/// Consecutive columns of a row.
struct Run {
    /// `None` above and below the panorama.
    row: Option<usize>,
    /// The first column; negative before the left edge.
    column: i64,
    n: usize,
}

impl Panorama {
    /// Finds the light of footprints. Make one for each thread.
    pub fn sampler(&self) -> Sampler<'_> {
        Sampler {
            panorama: self,
            simd: Level::new(),
            buffers: Buffers::new(),
            runs: Vec::new(),
            chunks: Vec::new(),
            moments: Moments::default(),
            total: None,
        }
    }
}

impl<'a> Sampler<'a> {
    /// The mean light of a footprint: light times alpha, and alpha. `None` if the footprint is so
    /// large that it has to be divided. `spread`: the variance of the pixel filter along each axis
    /// relative to that of a box.
    ///
    /// Weights are those of the directions of the texels, times their solid angles, so there is no
    /// seam at the date line or the poles.
    pub fn light(&mut self, ray: &SkyRay, spread: f64) -> Option<[f32; 4]> {
        let mut rays = [None; Seen::N];
        rays[0] = Some(*ray);
        let seen = self.see(&rays, spread);
        seen.is_found[0].then(|| seen.light.map(|channel| channel[0]))
    }

    /// Like [`Sampler::light`], of several footprints; black without a ray.
    pub fn see(&mut self, rays: &[Option<SkyRay>; Seen::N], spread: f64) -> Seen {
        dispatch!(self.simd, simd => self.see_on(simd, |idx| rays[idx], spread))
    }

    #[inline(always)]
    pub(crate) fn see_on<S: Simd>(
        &mut self,
        simd: S,
        ray: impl Fn(usize) -> Option<SkyRay>,
        spread: f64,
    ) -> Seen {
        let sky = self.panorama;
        let mut seen =
            Seen { doppler: [1.0; Seen::N], is_found: [true; Seen::N], ..Seen::default() };
        let mut footprints = Footprints::default();
        // Beside poles and edges.
        let mut others = [None; Seen::N];
        for (idx, other) in others.iter_mut().enumerate() {
            let Some(ray) = ray(idx) else { continue };
            seen.doppler[idx] = ray.doppler as f32;
            let ellipse = Ellipse::new(&ray, spread);
            if !ellipse.is_small() {
                seen.is_found[idx] = false;
                continue;
            }
            let level = sky.level_of(ellipse.small_square());
            let kernel = ellipse.kernel(sky.grids[level].texel, sky.grids[0].texel);
            if !footprints.set(idx, sky, level, &kernel, ray.direction) {
                *other = Some((level, kernel, ray.direction));
            }
        }
        seen.light = window::lights(simd, sky, &footprints, &mut self.buffers);
        for (idx, other) in others.iter().enumerate() {
            if let Some((level, kernel, direction)) = other {
                let light = self.light_anywhere(*level, kernel, *direction);
                (0..4).for_each(|channel| seen.light[channel][idx] = light[channel]);
            }
        }
        seen
    }

    /// The light of a footprint of any shape, beside poles and edges too.
    #[inline(never)]
    pub(crate) fn light_anywhere(
        &mut self,
        level: usize,
        kernel: &Kernel,
        center: DVec3,
    ) -> [f32; 4] {
        self.weigh(level, kernel, center);
        self.sum(level)
    }

    /// The panorama.
    pub(crate) fn panorama(&self) -> &'a Panorama {
        self.panorama
    }

    /// The texels of a footprint: rows of the level, each with its first and last column.
    pub(crate) fn texels_read(
        &mut self,
        level: usize,
        kernel: &Kernel,
        center: DVec3,
    ) -> impl Iterator<Item = (usize, [usize; 2])> {
        self.weigh(level, kernel, center);
        let sky = self.panorama;
        self.runs.iter().filter_map(move |run| {
            let row = run.row?;
            let n = sky.ladder[sky.grids[level].rows[row].ladder].n as i64;
            let (first, end) = (run.column.max(0), n.min(run.column + run.n as i64));
            (first < end).then(|| (row, [first as usize, end as usize - 1]))
        })
    }

    /// Computes the weights of all texels of a footprint.
    fn weigh(&mut self, level: usize, kernel: &Kernel, center: DVec3) {
        self.runs.clear();
        self.chunks.clear();
        self.moments = Moments::default();
        let sky = self.panorama;
        let grid = &sky.grids[level];
        let [a, b] = [kernel.a, kernel.b];
        let cos = (center.x * center.x + center.y * center.y).sqrt();
        let latitude = near_atan2(center.z, cos);
        let longitude = near_atan2(center.x, center.y);
        // asin r < r + 0.21 r³ for r < 0.6.
        let north = kernel.matrix[2].sqrt();
        let reach = north + 0.21 * north * north * north;
        let is_curved = kernel.radius * center.z.abs() > CURVED * cos;
        let top = sky.extent().latitudes[1];
        let place = |latitude: f64| (top - latitude) * grid.rows_per_radian - 0.5;
        let mut first = place((latitude + reach).min(FRAC_PI_2)).ceil() as i64;
        let mut last = place((latitude - reach).max(-FRAC_PI_2)).floor() as i64;
        let (n_rows, pad) = (grid.rows.len() as i64, PAD as i64);
        self.total = None;
        if first < -pad || last >= n_rows + pad {
            // So many rows have nothing that their weights are summed as an integral instead.
            (first, last) = (first.max(0), last.min(n_rows - 1));
            self.total = Some(
                (kernel.integral() * grid.rows_per_radian * sky.ladder[level].per_radian) as f32,
            );
        }
        for idx in first..=last {
            let inside = usize::try_from(idx).ok().filter(|idx| *idx < grid.rows.len());
            let beyond;
            let row = match inside {
                Some(idx) => &grid.rows[idx],
                None => {
                    beyond = row_beyond(sky, grid, level, idx);
                    &beyond
                }
            };
            let range = if is_curved {
                curved_range(kernel.radius, center.z, cos, row)
                    .map(|half| [longitude - half, longitude + half])
            } else {
                Some(flat_range(kernel, latitude, longitude, row))
            };
            let weights = RowWeights {
                across: [a.y * row.cos, a.x * row.cos, a.z * row.sin].map(|part| part as f32),
                along: [b.y * row.cos, b.x * row.cos, b.z * row.sin].map(|part| part as f32),
                area: row.area,
                c: kernel.c,
                scale: if is_curved { 1.0 } else { (1.0 / row.cos) as f32 },
            };
            let columns = &sky.ladder[row.ladder];
            if sky.extent().is_closed() {
                self.add_closed(columns, range, inside, &weights);
            } else {
                self.add_open(columns, range, inside, &weights);
            }
        }
    }

    /// Adds the columns of a range of longitudes, `None` for all, of a row around the whole sphere.
    #[inline]
    fn add_closed(
        &mut self,
        columns: &Columns,
        range: Option<[f64; 2]>,
        row: Option<usize>,
        weights: &RowWeights,
    ) {
        let n = columns.n as i64;
        let west = self.panorama.extent().longitudes[0];
        let place = |longitude: f64| (longitude - west) * columns.per_radian - 0.5;
        let (first, last) = match range.map(|range| range.map(place)) {
            Some([first, last]) => (first.ceil() as i64, last.floor() as i64),
            None => (0, n - 1),
        };
        if last - first + 1 >= n {
            self.add(columns, 0, n as usize, 0, row, weights);
            return;
        }
        let mut start = first.rem_euclid(n);
        let mut rest = last - first + 1;
        while rest > 0 {
            let run = rest.min(n - start);
            self.add(columns, start, run as usize, 0, row, weights);
            rest -= run;
            start = 0;
        }
    }

    /// The same in a panorama that does not go around.
    fn add_open(
        &mut self,
        columns: &Columns,
        range: Option<[f64; 2]>,
        row: Option<usize>,
        weights: &RowWeights,
    ) {
        let [west, east] = self.panorama.extent().longitudes;
        let middle = 0.5 * (west + east);
        let pad = PAD as i64;
        let [from, to] = range.unwrap_or([middle - PI, middle + PI]);
        // The turn at which the middle of the range is nearest to that of the panorama.
        let turns = ((0.5 * (from + to) - middle) / TAU).round() * TAU;
        let place = |longitude: f64| (longitude - turns - west) * columns.per_radian - 0.5;
        let (first, last) = (place(from).ceil() as i64, place(to).floor() as i64);
        let (first, last) = (first.max(-pad), last.min(columns.n as i64 + pad - 1));
        if first <= last {
            self.add(columns, first, (last - first + 1) as usize, pad, row, weights);
        }
    }

    /// Adds a run of columns. `pad`: entries of the tables before the first column.
    #[inline]
    fn add(
        &mut self,
        columns: &Columns,
        column: i64,
        n: usize,
        pad: i64,
        row: Option<usize>,
        weights: &RowWeights,
    ) {
        let first = (column + pad) as usize;
        let mut done = 0;
        while done < n {
            let count = (n - done).min(CHUNK);
            let chunk = weights.chunk(columns, first + done, count, &mut self.moments);
            self.chunks.push(chunk);
            done += CHUNK;
        }
        self.runs.push(Run { row, column, n });
    }

    /// The weighted mean of the light of the texels.
    fn sum(&self, level: usize) -> [f32; 4] {
        let sky = self.panorama;
        let moments = self.moments.0.map(|lanes| lanes.iter().sum::<f32>());
        let [across, along] = correction_of(self.simd, moments);
        // Of a part of a footprint the first moments do not vanish.
        let [across, along] = if self.total.is_some() { [0.0; 2] } else { [across, along] };
        let (mut light, mut total) = ([0.0_f32; 4], [0.0_f32; CHUNK]);
        let mut chunks = self.chunks.iter();
        for run in &self.runs {
            let mut column = run.column;
            let mut rest = run.n;
            while rest > 0 {
                let Some(chunk) = chunks.next() else { break };
                let count = rest.min(CHUNK);
                let weights: [f32; CHUNK] = core::array::from_fn(|k| {
                    chunk.kernel[k] + across * chunk.across[k] + along * chunk.along[k]
                });
                (0..CHUNK).for_each(|k| total[k] += weights[k]);
                if let Some(row) = run.row {
                    add_texels(sky, level, row, column, &weights[..count], &mut light);
                }
                column += CHUNK as i64;
                rest -= count;
            }
        }
        let total: f32 = self.total.unwrap_or_else(|| total.iter().sum());
        if total > 0.0 { light.map(|part| part / total) } else { [0.0; 4] }
    }
}

/// Adds texels from a column on; there is nothing beyond the edges.
#[inline]
fn add_texels(
    sky: &Panorama,
    level: usize,
    row: usize,
    column: i64,
    weights: &[f32],
    light: &mut [f32; 4],
) {
    let n = sky.ladder[sky.grids[level].rows[row].ladder].n as i64;
    let (first, end) = (column.max(0), n.min(column + weights.len() as i64));
    if first >= end {
        return;
    }
    let texels = sky.pyramid.texels(level, row, first as usize, (end - first) as usize);
    for (idx, weight) in
        weights[(first - column) as usize..(end - column) as usize].iter().enumerate()
    {
        let texel = texels.get(idx);
        (0..4).for_each(|channel| light[channel] += weight * texel[channel]);
    }
}

/// A row above or below the panorama, in which there is nothing.
fn row_beyond(sky: &Panorama, grid: &Grid, level: usize, idx: i64) -> Row {
    let latitude = sky.extent().latitudes[1] - (idx as f64 + 0.5) / grid.rows_per_radian;
    let (sin, cos) = libm::sincos(latitude);
    Row { ladder: level, sin, cos, latitude, area: cos.max(0.0) as f32 }
}

/// The common factors of the weights of a row: a·d and b·d are linear in the cosine and the sine of
/// the longitude.
struct RowWeights {
    across: [f32; 3],
    along: [f32; 3],
    area: f32,
    c: f32,
    /// A factor of s and t as coordinates, in which linear functions are exact.
    scale: f32,
}

impl RowWeights {
    /// The weights of `count` columns from `at` on.
    #[inline]
    fn chunk(&self, columns: &Columns, at: usize, count: usize, moments: &mut Moments) -> Weights {
        let (cos, sin) = (&columns.cos[at..at + CHUNK], &columns.sin[at..at + CHUNK]);
        let mut weights =
            Weights { kernel: [0.0; CHUNK], across: [0.0; CHUNK], along: [0.0; CHUNK] };
        let [m_s, m_t, m_ss, m_st, m_tt] = &mut moments.0;
        for k in 0..CHUNK {
            let s = self.across[0] * cos[k] + self.across[1] * sin[k] + self.across[2];
            let t = self.along[0] * cos[k] + self.along[1] * sin[k] + self.along[2];
            let q = s * s + t * t;
            let rest = if k < count { (1.0 - q).max(0.0) } else { 0.0 };
            let positive = self.area * rest * rest;
            let kernel = positive * (1.0 - self.c * q);
            let (s, t) = (s * self.scale, t * self.scale);
            let (across, along) = (positive * s, positive * t);
            m_s[k] += kernel * s;
            m_t[k] += kernel * t;
            m_ss[k] += across * s;
            m_st[k] += across * t;
            m_tt[k] += along * t;
            weights.kernel[k] = kernel;
            weights.across[k] = across;
            weights.along[k] = along;
        }
        weights
    }
}

/// The longitudes of a row that may be in an ellipse, where circles of latitude are nearly
/// straight.
#[inline]
fn flat_range(kernel: &Kernel, latitude: f64, longitude: f64, row: &Row) -> [f64; 2] {
    let [see, sen, snn] = kernel.matrix;
    let up = row.latitude - latitude;
    let ratio = sen / snn;
    let part = (1.0 - up * up / snn).max(0.0);
    let half = ((see - sen * ratio) * part).sqrt() + SLACK * see.sqrt();
    let per_radian = 1.0 / row.cos;
    [longitude + (ratio * up - half) * per_radian, longitude + (ratio * up + half) * per_radian]
}

/// Half the range of longitudes of a row within a circle around a point of a sine and cosine of
/// latitude; `None` for all.
fn curved_range(radius: f64, sin: f64, cos: f64, row: &Row) -> Option<f64> {
    let angle = radius + 0.21 * radius * radius * radius;
    let cosine = (libm::cos(angle) - sin * row.sin) / (cos * row.cos);
    // NaN at the poles as well.
    if cosine > -1.0 { Some(libm::acos(cosine.min(1.0)) + SLACK * radius) } else { None }
}
