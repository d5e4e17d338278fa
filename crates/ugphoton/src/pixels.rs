//! Pixels from samples: a ray for each, the mean by a reconstruction filter, on the background.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;
use ugimage::{Filter, LinearFrame};
use ugpicture::{Backdrop, PictureOptions, push_channels};
use ugpipe::Progress;
use ugskybox::drawn_on;
use ugtrace::outlines::{NearestFaces, Outlines, Tiles};

use crate::config::Config;
use crate::lens::frame_around;
use crate::neighbours::PictureSample;
use crate::pixel_centers::PixelCenters;
use crate::scenery::Scenery;
use crate::tracer::{Arriving, Tracer, Visit};
use ugtrace::rays::{Intersection, PacketMemory, PastRay};

/// Pixels along a side of a tile, which one task computes.
const TILE: u32 = 16;

/// Samples along a side of a packet of rays that are traced together.
const PACKET: u32 = 8;

/// Statistics of the samples of a picture.
#[derive(Clone, Copy, Debug, Default)]
pub struct Statistics {
    /// Samples that show a surface.
    pub n_covered: u64,
    /// Samples that are not black.
    pub n_visible: u64,
    /// The brightest channel of a sample.
    pub max_light: f64,
    /// Samples of which a path ended at the most reflections and refractions.
    pub n_too_deep: u64,
    /// A path had more branches than are followed.
    pub is_cut_short: bool,
    /// Samples of which a path left a transparent solid that it had not entered.
    pub n_open: u64,
    /// The first face where they leave.
    pub open_face: Option<u32>,
    /// Samples traced. Those that two tiles need are counted twice.
    pub n_samples: u64,
}

impl Statistics {
    fn with(self, other: Self) -> Self {
        Self {
            n_covered: self.n_covered + other.n_covered,
            n_visible: self.n_visible + other.n_visible,
            max_light: self.max_light.max(other.max_light),
            n_too_deep: self.n_too_deep + other.n_too_deep,
            is_cut_short: self.is_cut_short || other.is_cut_short,
            n_open: self.n_open + other.n_open,
            open_face: [self.open_face, other.open_face].into_iter().flatten().min(),
            n_samples: self.n_samples + other.n_samples,
        }
    }
}

/// The light of a picture, or of a part of it, with the requested channels. Tiles are missing if
/// the caller stopped it.
pub fn light(
    scenery: &Scenery<'_>,
    config: &Config,
    progress: &dyn Progress,
) -> (LinearFrame, Statistics) {
    let mut painting = Painting::new(scenery, config);
    let [width, height] = painting.area.clone().map(|range| range.len() as u32);
    let [left, top] = [painting.area[0].start, painting.area[1].start];
    // Adaptive samples are too few for outlines.
    if painting.contrast.is_none() {
        painting.outlines = scenery.outlines(painting.tiles());
    }
    let [columns, rows] = [width, height].map(|side| side.div_ceil(TILE));
    progress.step("tracing rays", u64::from(columns) * u64::from(rows));
    let tiles: Vec<Tile> = (0..columns * rows)
        .into_par_iter()
        .map_init(
            || (Tracer::new(scenery), Packet::default()),
            |(tracer, packet), idx| {
                progress.check().ok()?;
                let tile = painting.tile([idx % columns, idx / columns], tracer, packet);
                progress.done(1);
                Some(tile)
            },
        )
        .while_some()
        .collect();
    let statistics =
        tiles.iter().fold(Statistics::default(), |sum, tile| sum.with(tile.statistics));
    let mut pixels = vec![[0.0; 4]; width as usize * height as usize];
    for tile in tiles {
        let n = tile.columns.len();
        for (line, row) in tile.rows.clone().enumerate() {
            let start =
                (row - top) as usize * width as usize + (tile.columns.start - left) as usize;
            pixels[start..start + n].copy_from_slice(&tile.pixels[line * n..(line + 1) * n]);
        }
    }
    let mut frame = LinearFrame::new([width, height], painting.backdrop.is_opaque(), pixels);
    let PictureOptions { channels, samples, .. } = &config.picture;
    if !channels.is_empty() {
        let seen = PixelCenters::new(scenery, [left, top, width, height], *samples);
        push_channels(&mut frame, channels, scenery.view.eye, &|idx| seen.item(idx));
    }
    (frame, statistics)
}

/// A preview of [`light`]: squares of `side` pixels with one sample each, and without channels.
pub fn preview(
    scenery: &Scenery<'_>,
    config: &Config,
    side: u32,
    progress: &dyn Progress,
) -> LinearFrame {
    let painting = Painting::new(scenery, config);
    let [width, height] = painting.area.clone().map(|range| range.len() as u32);
    let [columns, rows] = [width, height].map(|length| length.div_ceil(side));
    progress.step("tracing rays of a preview", u64::from(rows));
    let lines: Vec<Vec<[f32; 4]>> = (0..rows)
        .into_par_iter()
        .map_init(
            || Tracer::new(scenery),
            |tracer, row| {
                let n_columns = if progress.is_stopped() { 0 } else { columns };
                let line = (0..n_columns)
                    .map(|column| painting.square([column, row], side, tracer))
                    .collect();
                progress.done(1);
                line
            },
        )
        .collect();
    let lines = &lines;
    let pixels = (0..height).flat_map(|row| {
        let line = &lines[(row / side) as usize];
        (0..width)
            .map(move |column| line.get((column / side) as usize).copied().unwrap_or_default())
    });
    LinearFrame::new([width, height], painting.backdrop.is_opaque(), pixels.collect())
}

/// The light of every `step`-th pixel across and down, without channels.
pub fn sparse(scenery: &Scenery<'_>, config: &Config, step: u32) -> LinearFrame {
    let whole = Painting::new(scenery, config);
    let [width, height] = whole.size.map(|side| side.div_ceil(step));
    let middle = |at: u32, side: u32| (at * step + step / 2).min(side - 1);
    let pixels = (0..width * height)
        .into_par_iter()
        .map_init(
            || (Painting::new(scenery, config), Tracer::new(scenery), Packet::default()),
            |(painting, tracer, packet), idx| {
                let column = middle(idx % width, painting.size[0]);
                let row = middle(idx / width, painting.size[1]);
                painting.area = [column..column + 1, row..row + 1];
                painting.tile([0, 0], tracer, packet).pixels[0]
            },
        )
        .collect();
    LinearFrame::new([width, height], whole.backdrop.is_opaque(), pixels)
}

/// A sample of a pixel with the surfaces that contribute to it.
pub struct ExplainedRay {
    /// Its column and row in the picture.
    pub place: [u32; 2],
    /// Its ray.
    pub ray: PastRay,
    /// Its light, and the part of the background that is seen.
    pub arriving: Arriving,
    /// From the eye on.
    pub visits: Vec<Visit>,
}

/// All samples of a pixel; those where the lens shows nothing are left out.
pub fn explained(scenery: &Scenery<'_>, config: &Config, pixel: [u32; 2]) -> Vec<ExplainedRay> {
    let n = config.picture.samples;
    let mut tracer = Tracer::new(scenery);
    let slab = scenery.view.slab;
    let ray = |place: [u32; 2]| {
        let ray = scenery.primary_ray(place)?;
        let first = scenery.closest(&ray, slab.near..slab.far);
        let sample =
            u64::from(place[1]) * u64::from(config.picture.size[0] * n) + u64::from(place[0]);
        let (arriving, visits) =
            tracer.explained(&ray, first, slab.far, (sample, PictureSample { place, distance: 1 }));
        Some(ExplainedRay { place, ray, arriving, visits })
    };
    let places = (0..n).flat_map(|row| (0..n).map(move |column| [column, row]));
    places
        .map(|[column, row]| [pixel[0] * n + column, pixel[1] * n + row])
        .filter_map(ray)
        .collect()
}

/// Data that all tiles of a picture share.
struct Painting<'a> {
    scenery: &'a Scenery<'a>,
    /// Pixels of the whole picture.
    size: [u32; 2],
    /// Frames of it, across and down.
    frames: [u32; 2],
    /// The columns and rows to be drawn.
    area: [Range<u32>; 2],
    samples: u32,
    filter: Filter,
    /// See [`Config::adaptive`].
    contrast: Option<f64>,
    backdrop: Backdrop,
    /// Outlines of faces, if these find what rays from the eye meet.
    outlines: Option<Outlines>,
}

/// Pixels of a part of the picture.
struct Tile {
    columns: Range<u32>,
    rows: Range<u32>,
    pixels: Vec<[f32; 4]>,
    statistics: Statistics,
}

/// Samples of a tile with its margin: red, green, blue, and the covered part.
struct Samples {
    columns: Range<u32>,
    rows: Range<u32>,
    light: Vec<[f32; 4]>,
}

impl<'a> Painting<'a> {
    fn new(scenery: &'a Scenery<'a>, config: &Config) -> Self {
        let PictureOptions { size, samples, filter, background, .. } = config.picture;
        let [left, top, width, height] = config.crop.unwrap_or([0, 0, size[0], size[1]]);
        Self {
            scenery,
            size,
            frames: config.frames(),
            area: [left..left + width, top..top + height],
            samples,
            filter,
            contrast: config.adaptive,
            backdrop: Backdrop::new(drawn_on(&config.sky, background), samples),
            outlines: None,
        }
    }

    /// The tiles, in samples.
    fn tiles(&self) -> Tiles {
        let n = self.samples;
        Tiles {
            size: self.size.map(|side| side * n),
            start: [0, 1].map(|axis| self.area[axis].start * n),
            tile: [TILE * n; 2],
            margin: self.filter.margin() * n,
        }
    }

    /// A square of a preview, as a pixel: a sample near its middle.
    fn square(&self, at: [u32; 2], side: u32, tracer: &mut Tracer<'_>) -> [f32; 4] {
        let middle = |axis: usize| {
            let Range { start, end } = self.area[axis];
            let pixel = (start + at[axis] * side + side / 2).min(end - 1);
            pixel * self.samples + self.samples / 2
        };
        let place = [middle(0), middle(1)];
        let slab = self.scenery.view.slab;
        let sample = match self.scenery.primary_ray(place) {
            Some(ray) => {
                let first = self.scenery.closest(&ray, slab.near..slab.far);
                let sample = PictureSample { place, distance: side * self.samples };
                let arriving = tracer.arriving(&ray, first, slab.far, (self.number(place), sample));
                self.on_background(arriving.light, arriving.background)
            }
            None => self.on_background(DVec3::ZERO, DVec3::ONE),
        };
        // A pixel is the sum of its samples.
        let [red, green, blue, covered] =
            sample.map(|channel| channel * (self.samples * self.samples) as f32);
        self.backdrop.pixel([red, green, blue], covered)
    }

    /// The number of a sample of the picture.
    fn number(&self, [column, row]: [u32; 2]) -> u64 {
        u64::from(row) * u64::from(self.size[0] * self.samples) + u64::from(column)
    }

    fn tile(&self, at: [u32; 2], tracer: &mut Tracer<'_>, packet: &mut Packet) -> Tile {
        let range = |axis: usize| {
            let start = self.area[axis].start + at[axis] * TILE;
            start..(start + TILE).min(self.area[axis].end)
        };
        let (columns, rows) = (range(0), range(1));
        let mut statistics = Statistics::default();
        let samples = self.samples(at, [&columns, &rows], (tracer, packet), &mut statistics);
        let weights = self.filter.weights(self.samples);
        let mut pixels = Vec::with_capacity(columns.len() * rows.len());
        for row in rows.clone() {
            for column in columns.clone() {
                pixels.push(self.pixel(&samples, &weights, [column, row]));
            }
        }
        statistics.is_cut_short = tracer.is_cut_short;
        Tile { columns, rows, pixels, statistics }
    }

    /// The samples that the pixels of a tile need.
    fn samples(
        &self,
        tile: [u32; 2],
        [columns, rows]: [&Range<u32>; 2],
        (tracer, packet): (&mut Tracer<'_>, &mut Packet),
        statistics: &mut Statistics,
    ) -> Samples {
        let (n, margin) = (self.samples, self.filter.margin());
        let around = |range: &Range<u32>, side: u32| {
            range.start.saturating_sub(margin) * n..(range.end + margin).min(side) * n
        };
        // For differences the nearest samples of the pixels around are needed.
        let beside = u32::from(self.contrast.is_some());
        let with_beside = |range: Range<u32>, side: u32| {
            range.start.saturating_sub(beside)..(range.end + beside).min(side * n)
        };
        let across = with_beside(around(columns, self.size[0]), self.size[0]);
        let down = with_beside(around(rows, self.size[1]), self.size[1]);
        // Where the lens shows nothing there is background.
        let nothing = self.on_background(DVec3::ZERO, DVec3::ONE);
        let light = vec![nothing; across.len() * down.len()];
        let mut samples = Samples { columns: across, rows: down, light };
        let own = [columns, rows];
        let Some(contrast) = self.contrast else {
            let mut trace = |seen: Option<&NearestFaces<'_>>, samples: &mut Samples| {
                // Bodies on world lines may be where no outline is.
                let seen_everywhere = seen.filter(|_| self.scenery.world.is_inertial());
                self.trace(samples, own, seen, (tracer, packet), statistics, |sample| {
                    seen_everywhere.is_none_or(|seen| seen.at(sample).is_some())
                });
            };
            let area = [samples.columns.clone(), samples.rows.clone()];
            match &self.outlines {
                Some(outlines) => {
                    outlines.with_nearest(tile, area, |seen| trace(Some(seen), &mut samples))
                }
                None => trace(None, &mut samples),
            }
            return samples;
        };
        let first = first_samples(n);
        let is_first =
            |[column, row]: [u32; 2]| first.contains(&(column % n)) && first.contains(&(row % n));
        self.trace(&mut samples, own, None, (tracer, packet), statistics, is_first);
        // Without the samples beside the outermost pixels.
        let pixels = [(columns, 0), (rows, 1)].map(|(range, axis): (&Range<u32>, usize)| {
            range.start.saturating_sub(margin)..(range.end + margin).min(self.size[axis])
        });
        let width = pixels[0].len();
        let mut is_refined = Vec::with_capacity(width * pixels[1].len());
        for row in pixels[1].clone() {
            for column in pixels[0].clone() {
                is_refined.push(self.differ(&samples, &first, [column, row], contrast));
            }
        }
        let is_pixel_refined = |[column, row]: [u32; 2]| {
            let is_inside = pixels[0].contains(&column) && pixels[1].contains(&row);
            let at =
                || (row - pixels[1].start) as usize * width + (column - pixels[0].start) as usize;
            is_inside && is_refined[at()]
        };
        self.trace(&mut samples, own, None, (tracer, packet), statistics, |sample| {
            !is_first(sample) && is_pixel_refined(sample.map(|at| at / n))
        });
        for row in pixels[1].clone() {
            for column in pixels[0].clone().filter(|&column| !is_pixel_refined([column, row])) {
                samples.fill([column, row], n, &first);
            }
        }
        samples
    }

    /// Traces those samples that are wanted. `own`: the pixels of the tile. `seen`: what outlines
    /// find there.
    fn trace(
        &self,
        samples: &mut Samples,
        [columns, rows]: [&Range<u32>; 2],
        seen: Option<&NearestFaces<'_>>,
        (tracer, packet): (&mut Tracer<'_>, &mut Packet),
        statistics: &mut Statistics,
        is_wanted: impl Fn([u32; 2]) -> bool,
    ) {
        let n = self.samples;
        // Where nothing is met, samples have the light of the background already.
        let has_background = self.scenery.is_seen_from_origin();
        for top in samples.rows.clone().step_by(PACKET as usize) {
            for left in samples.columns.clone().step_by(PACKET as usize) {
                let (right, bottom) = (
                    (left + PACKET).min(samples.columns.end),
                    (top + PACKET).min(samples.rows.end),
                );
                packet.trace(self.scenery, [left..right, top..bottom], seen, &is_wanted);
                statistics.n_samples += packet.places.len() as u64;
                for (&place @ [column, row], (ray, first)) in
                    packet.places.iter().zip(packet.rays.iter().zip(&packet.first))
                {
                    if first.is_none() && has_background {
                        continue;
                    }
                    let far = self.scenery.view.slab.far;
                    let arriving = tracer.arriving(
                        ray,
                        *first,
                        far,
                        (self.number(place), PictureSample { place, distance: 1 }),
                    );
                    let is_own = columns.contains(&(column / n)) && rows.contains(&(row / n));
                    let brightest = arriving.light.max_element();
                    if is_own && first.is_some() {
                        statistics.n_covered += 1;
                        statistics.n_visible += u64::from(brightest > 0.0);
                        statistics.n_too_deep += u64::from(tracer.is_too_deep);
                        statistics.n_open += u64::from(tracer.leaves_open_solid.is_some());
                        let open = [statistics.open_face, tracer.leaves_open_solid];
                        statistics.open_face = open.into_iter().flatten().min();
                        statistics.max_light = statistics.max_light.max(brightest);
                    }
                    *samples.at([column, row]) =
                        self.on_background(arriving.light, arriving.background);
                }
            }
        }
    }

    /// True if the first samples of a pixel and those next to it differ by more than a contrast:
    /// of the brightest channel, or of the covered part.
    fn differ(&self, samples: &Samples, first: &[u32], pixel: [u32; 2], contrast: f64) -> bool {
        /// Differences of light that no exposure makes visible.
        const ROUNDING: f32 = 1e-6;
        let n = self.samples;
        let [across, down] = [0, 1].map(|axis| {
            let frame = frame_around(pixel[axis], self.size[axis], self.frames[axis]);
            let start = pixel[axis] * n;
            let before = (pixel[axis] > frame.start).then(|| start - 1);
            let behind = (pixel[axis] + 1 < frame.end).then_some(start + n);
            before.into_iter().chain(first.iter().map(move |at| start + at)).chain(behind)
        });
        let (mut low, mut high) = ([f32::INFINITY; 4], [f32::NEG_INFINITY; 4]);
        for row in down {
            for column in across.clone() {
                let sample = samples.light[samples.index([column, row])];
                (0..4).for_each(|at| low[at] = low[at].min(sample[at]));
                (0..4).for_each(|at| high[at] = high[at].max(sample[at]));
            }
        }
        let most =
            |of: fn(f32, f32) -> f32| (0..3).map(|at| of(high[at], low[at])).fold(0.0, f32::max);
        let (spread, level) = (most(|high, low| high - low), most(|high, low| high + low));
        let contrast = contrast as f32;
        spread > contrast * level + ROUNDING || high[3] - low[3] > contrast
    }

    /// A sample: its light, and the covered part. Behind coloured glass an opaque background has
    /// another colour, so its light is added here; of a transparent one the mean of the channels is
    /// covered.
    fn on_background(&self, light: DVec3, background: DVec3) -> [f32; 4] {
        /// Rounding errors of products of transmittances.
        const ROUNDING: f64 = 1e-9;
        let is_colored = background.max_element() - background.min_element() > ROUNDING;
        let (light, covered) = match self.backdrop.light() {
            Some(behind) if is_colored => {
                (light + background * DVec3::from(behind.map(f64::from)), 1.0)
            }
            _ if is_colored => (light, 1.0 - background.element_sum() / 3.0),
            _ => (light, 1.0 - background.x),
        };
        [light.x as f32, light.y as f32, light.z as f32, covered as f32]
    }

    fn pixel(&self, samples: &Samples, weights: &[f32], [column, row]: [u32; 2]) -> [f32; 4] {
        let (n, margin) = (self.samples, self.filter.margin());
        // The weights of traced samples, and the place of the first of these. A filter does not
        // reach into the frame beside.
        let used = |axis: usize, pixel: u32, traced: &Range<u32>| {
            let frame = frame_around(pixel, self.size[axis], self.frames[axis]);
            let first = i64::from(pixel * n) - i64::from(margin * n);
            let [start, end] = [traced.start.max(frame.start * n), traced.end.min(frame.end * n)]
                .map(|at| (i64::from(at) - first).clamp(0, weights.len() as i64));
            (
                &weights[start as usize..end as usize],
                (first + start - i64::from(traced.start)) as usize,
            )
        };
        let (across, left) = used(0, column, &samples.columns);
        let (down, top) = used(1, row, &samples.rows);
        let lines = samples.light.chunks_exact(samples.columns.len()).skip(top);
        let (mut sum, mut total) = ([0.0_f32; 4], 0.0_f32);
        for (line, down) in lines.zip(down) {
            for (sample, across) in line[left..].iter().zip(across) {
                let weight = down * across;
                if weight != 0.0 {
                    (0..4).for_each(|channel| sum[channel] += weight * sample[channel]);
                    total += weight;
                }
            }
        }
        let scale = (n * n) as f32 / total;
        let [red, green, blue, covered] = sum.map(|channel| channel * scale);
        self.backdrop.pixel([red, green, blue], covered)
    }
}

impl Samples {
    fn index(&self, [column, row]: [u32; 2]) -> usize {
        (row - self.rows.start) as usize * self.columns.len()
            + (column - self.columns.start) as usize
    }

    fn at(&mut self, place: [u32; 2]) -> &mut [f32; 4] {
        let index = self.index(place);
        &mut self.light[index]
    }

    /// Gives the samples of a pixel that have not been traced the mean of the first ones.
    fn fill(&mut self, pixel: [u32; 2], n: u32, first: &[u32]) {
        let [left, top] = pixel.map(|at| at * n);
        let mut mean = [0.0_f32; 4];
        for (down, across) in
            first.iter().flat_map(|down| first.iter().map(move |across| (down, across)))
        {
            let sample = *self.at([left + across, top + down]);
            (0..4).for_each(|at| mean[at] += sample[at]);
        }
        let mean = mean.map(|sum| sum / (first.len() * first.len()) as f32);
        for (down, across) in (0..n).flat_map(|down| (0..n).map(move |across| (down, across))) {
            if !(first.contains(&across) && first.contains(&down)) {
                *self.at([left + across, top + down]) = mean;
            }
        }
    }
}

/// The columns and rows of a pixel's samples that are traced first, a half of them, from the first
/// to the last.
fn first_samples(n: u32) -> Vec<u32> {
    let count = n.div_ceil(2).max(2).min(n);
    let last = (count - 1).max(1);
    (0..count).map(|at| (2 * at * (n - 1) + last) / (2 * last)).collect()
}

/// Neighbouring samples, whose rays are traced together.
#[derive(Default)]
struct Packet {
    places: Vec<[u32; 2]>,
    rays: Vec<PastRay>,
    first: Vec<Option<Intersection>>,
    memory: PacketMemory,
}

impl Packet {
    /// Finds the nearest face at each sample that is wanted.
    fn trace(
        &mut self,
        scenery: &Scenery<'_>,
        [columns, rows]: [Range<u32>; 2],
        seen: Option<&NearestFaces<'_>>,
        is_wanted: impl Fn([u32; 2]) -> bool,
    ) {
        self.places.clear();
        self.rays.clear();
        for row in rows {
            for column in columns.clone().filter(|&column| is_wanted([column, row])) {
                if let Some(ray) = scenery.primary_ray([column, row]) {
                    self.places.push([column, row]);
                    self.rays.push(ray);
                }
            }
        }
        let slab = scenery.view.slab;
        let (range, rays) = (slab.near..slab.far, (&self.rays[..], &self.places[..]));
        scenery.first(rays, range, seen, &mut self.memory, &mut self.first);
    }
}
