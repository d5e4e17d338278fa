//! Transparent faces and lines in front of opaque surfaces: an A-buffer.
//!
//! When a tile holds the nearest opaque surface at every sample, transparent layers are drawn over
//! it: each of their samples that is nearer becomes a [`Fragment`]. The fragments of a sample are
//! sorted by depth and blended from back to front in linear light, so faces may intersect and the
//! order of drawing does not matter.
//!
//! Fragments with a transmittance of 0 (lines, and opaque parts of faces) occlude transparent ones
//! behind them, which are not stored if they are drawn later. Fragments take memory: a tile with
//! too many is drawn in parts: fewer rows of samples, then fewer columns. The time is proportional
//! to the number of fragments, times the logarithm of those of a sample.

use std::ops::Range;

use fearless_simd::Level;

use crate::edges::Scanner;
use crate::grid::SampleGrid;
use crate::layer::ShapeTarget;
use crate::polygons::greater;
use crate::shading::{Encoding, SampleShading, SampleStats, ShadedRun};
use crate::tile::{Area, EMPTY, OpaqueSamples, Tile, shared_plane};
use crate::triangles::{BlockSetup, LazyPlanes, Plane, RowTarget, TriangleRef, TriangleRow};

/// Number of interpolated values of transparent shapes. The last is the transmittance, 0…1.
pub const TRANSPARENT_VALUES: usize = 8;

/// Fragments stored at once, if more than one sample is drawn: 64 MiB.
const MAX_FRAGMENTS: usize = 1 << 21;

/// Transparent surfaces and lines, and their light.
pub trait TransparentLayer: Sync {
    /// Draws what the layer has in a band.
    fn draw(
        &self,
        grid: &SampleGrid,
        band: usize,
        scanner: &mut Scanner<TRANSPARENT_VALUES>,
        target: &mut FragmentTarget<'_>,
    );
}

/// A sample of a transparent surface or line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fragment {
    /// Index of the sample in its tile.
    sample: u32,
    /// Depth key.
    pub key: f32,
    /// The item it belongs to.
    pub item: u32,
    /// True for lines. Their keys are a little too near, so that they win against faces they lie
    /// on.
    pub is_line: bool,
    /// Its linear light, before it is multiplied by its opacity.
    pub light: [f32; 3],
    /// The part of the light from behind that it transmits.
    pub transmittance: f32,
}

/// The fragments of a sample, blended: light from behind times `transmittance`, plus `light`, is
/// what is visible.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Composite {
    pub light: [f32; 3],
    /// The part of the sample that does not show the background.
    pub coverage: f32,
    pub transmittance: f32,
}

impl Composite {
    /// No fragments.
    pub const NONE: Self = Self { light: [0.0; 3], coverage: 0.0, transmittance: 1.0 };

    /// The composite behind another fragment, of whose light depth cueing leaves `light_left`.
    fn behind(self, fragment: &Fragment, light_left: f32) -> Self {
        let Fragment { light, transmittance, .. } = *fragment;
        let own = (1.0 - transmittance) * light_left;
        Self {
            light: std::array::from_fn(|i| own * light[i] + transmittance * self.light[i]),
            coverage: own + transmittance * self.coverage,
            transmittance: transmittance * self.transmittance,
        }
    }
}

/// What is kept of the samples of a tile besides their light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keep {
    /// Nothing.
    Light,
    /// Items, and the fragments at the centres of pixels.
    Centers,
    /// Items and all fragments.
    All,
}

/// The fragments of a tile.
#[derive(Default)]
pub struct TransparencyBuffer {
    scanner: Scanner<TRANSPARENT_VALUES>,
    fragments: Vec<Fragment>,
    /// Indices of the fragments, by sample and from back to front.
    order: Vec<u32>,
    /// For each sample of the tile, where its fragments end in `order`.
    ends: Vec<u32>,
    /// For each sample of the tile the depth key of the nearest fragment with a transmittance of 0.
    front: Vec<f32>,
    /// One for each sample of the tile; no elements if the tile has no fragments.
    composites: Vec<Composite>,
    kept: Vec<Fragment>,
    run: ShadedRun,
    area: Area,
}

/// Buffers to draw a tile, which are reused.
#[derive(Default)]
pub(crate) struct TileBuffers<const N: usize> {
    pub scanner: Scanner<N>,
    pub tile: Tile<N>,
    pub transparency: TransparencyBuffer,
}

impl TransparencyBuffer {
    /// Draws and blends a transparent layer in front of the opaque samples of a tile.
    pub fn draw(
        &mut self,
        layer: &dyn TransparentLayer,
        grid: &SampleGrid,
        band: usize,
        opaque: OpaqueSamples<'_>,
        keep: Keep,
    ) -> SampleStats {
        let area = opaque.area;
        self.area = area;
        self.composites.clear();
        self.kept.clear();
        let mut stats = SampleStats::default();
        let mut parts = vec![area];
        while let Some(part) = parts.pop() {
            self.fragments.clear();
            self.front.clear();
            self.front.resize(opaque.keys.len(), EMPTY);
            let mut target = FragmentTarget {
                part,
                opaque,
                fragments: &mut self.fragments,
                front: &mut self.front,
                run: &mut self.run,
                n_offered: 0,
                max_fragments: if part.n_samples() > 1 { MAX_FRAGMENTS } else { usize::MAX },
                stats: SampleStats::default(),
            };
            layer.draw(grid, band, &mut self.scanner, &mut target);
            if target.fragments.len() < target.max_fragments {
                stats = stats.merge(target.stats);
                self.blend(grid, opaque.planes, keep);
            } else {
                parts.extend(split(part, target.n_offered.div_ceil(MAX_FRAGMENTS as u64)));
            }
        }
        stats
    }

    /// True if the tile has no fragments.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.composites.is_empty()
    }

    fn blend(&mut self, grid: &SampleGrid, planes: &[u32], keep: Keep) {
        if self.fragments.is_empty() {
            return;
        }
        let Area { columns, rows } = self.area;
        let width = self.area.width();
        self.composites.resize(self.area.n_samples(), Composite::NONE);
        self.sort(planes);
        let is_middle = |place: u32| place % grid.samples == grid.samples / 2;
        for &index in &self.order {
            let fragment = &self.fragments[index as usize];
            let composite = &mut self.composites[fragment.sample as usize];
            *composite = composite.behind(fragment, grid.light_left(fragment.key));
            let is_center = || {
                is_middle(columns[0] + fragment.sample % width)
                    && is_middle(rows[0] + fragment.sample / width)
            };
            if keep == Keep::All || keep == Keep::Centers && is_center() {
                self.kept.push(*fragment);
            }
        }
    }

    /// Fills `order`: by sample in linear time, and then the fragments of each sample.
    fn sort(&mut self, planes: &[u32]) {
        let Self { fragments, order, ends, area, .. } = self;
        ends.clear();
        ends.resize(area.n_samples(), 0);
        fragments.iter().for_each(|fragment| ends[fragment.sample as usize] += 1);
        let mut start = 0;
        for end in ends.iter_mut() {
            start += std::mem::replace(end, start);
        }
        order.clear();
        order.resize(fragments.len(), 0);
        // A sample has fewer than 2^32 fragments: each takes 36 bytes.
        for (index, fragment) in fragments.iter().enumerate().rev() {
            let end = &mut ends[fragment.sample as usize];
            order[*end as usize] = index as u32;
            *end += 1;
        }
        // The last drawn comes first, and the sort is stable, so of equal keys the first drawn ends
        // in front.
        let mut start = 0;
        for &end in ends.iter() {
            let of_sample = &mut order[start as usize..end as usize];
            if of_sample.len() > 1 {
                of_sample.sort_by(|&a, &b| {
                    fragments[a as usize].key.total_cmp(&fragments[b as usize].key)
                });
                if !planes.is_empty() {
                    put_first_of_plane_in_front(of_sample, |idx| &fragments[idx as usize], planes);
                }
            }
            start = end;
        }
    }

    /// The blended fragments of a sample.
    #[inline]
    pub fn composite(&self, row: u32, column: u32) -> Composite {
        self.composites.get(self.area.index(row, column)).copied().unwrap_or(Composite::NONE)
    }

    /// The fragments of a sample from back to front, if they are kept.
    #[inline]
    pub fn fragments(&self, row: u32, column: u32) -> &[Fragment] {
        if self.kept.is_empty() { &[] } else { self.kept_at(row, column) }
    }

    fn kept_at(&self, row: u32, column: u32) -> &[Fragment] {
        let sample = self.area.index(row, column) as u32;
        // Parts of a tile are drawn from above, and those of a row from the left, so the kept
        // fragments are sorted by sample.
        let start = self.kept.partition_point(|fragment| fragment.sample < sample);
        let end = self.kept.partition_point(|fragment| fragment.sample <= sample);
        &self.kept[start..end]
    }
}

/// Exchanges neighbours in one plane until the first item is in front. `order`: from back to front.
fn put_first_of_plane_in_front<'f>(
    order: &mut [u32],
    fragment: impl Fn(u32) -> &'f Fragment,
    planes: &[u32],
) {
    let is_wrong = |back: &Fragment, front: &Fragment| {
        let plane = shared_plane(planes, back.item).filter(|_| !back.is_line && !front.is_line);
        back.item < front.item && plane.is_some() && plane == shared_plane(planes, front.item)
    };
    for end in 1..order.len() {
        let mut place = end;
        while place > 0 && is_wrong(fragment(order[place - 1]), fragment(order[place])) {
            order.swap(place - 1, place);
            place -= 1;
        }
    }
}

/// The rows of an area in about `n` parts of the same size, at least two, or the columns of a
/// single row; the uppermost or leftmost part is the last.
fn split(area: Area, n: u64) -> impl Iterator<Item = Area> {
    let is_row = area.rows[1] - area.rows[0] == 1;
    let [first, end] = if is_row { area.columns } else { area.rows };
    let n_lines = end - first;
    // Not above the number of rows or columns, which fits.
    let n = n.clamp(2, u64::from(n_lines)) as u32;
    let size = n_lines.div_ceil(n);
    (0..n_lines.div_ceil(size)).rev().map(move |part| {
        let start = first + part * size;
        let lines = [start, end.min(start + size)];
        if is_row { Area { columns: lines, ..area } } else { Area { rows: lines, ..area } }
    })
}

/// A part of a tile on which transparent layers are drawn.
pub struct FragmentTarget<'a> {
    part: Area,
    /// The opaque surfaces, of the whole tile.
    opaque: OpaqueSamples<'a>,
    fragments: &'a mut Vec<Fragment>,
    /// Depth keys of the nearest fragments with a transmittance of 0, of the whole tile.
    front: &'a mut [f32],
    run: &'a mut ShadedRun,
    max_fragments: usize,
    /// Samples of shapes, whether they become fragments or not.
    n_offered: u64,
    stats: SampleStats,
}

/// Samples that are shaded in one call.
const TOGETHER: usize = 32;

impl<'a> FragmentTarget<'a> {
    /// Receives samples of faces, or of lines.
    pub fn writer<'t>(
        &'t mut self,
        shading: &'t dyn SampleShading<TRANSPARENT_VALUES>,
        is_line: bool,
    ) -> FragmentWriter<'t, 'a> {
        FragmentWriter { target: self, shading, is_line }
    }
}

/// Stores samples of transparent shapes as fragments.
pub struct FragmentWriter<'t, 'a> {
    target: &'t mut FragmentTarget<'a>,
    shading: &'t dyn SampleShading<TRANSPARENT_VALUES>,
    is_line: bool,
}

impl ShapeTarget<TRANSPARENT_VALUES> for FragmentWriter<'_, '_> {
    fn area(&self) -> Area {
        self.target.part
    }

    fn draw_block(&mut self, _level: Level, block: &BlockSetup<'_>, planes: &mut LazyPlanes<'_>) {
        block.draw(self, planes);
    }

    fn draw_each(
        &mut self,
        row: u32,
        columns: Range<u32>,
        item: u32,
        mut sample: impl FnMut(u32, f32) -> Option<(f32, [f32; TRANSPARENT_VALUES])>,
    ) {
        self.target.n_offered += columns.len() as u64;
        // With too many fragments this area is drawn again in parts.
        if self.target.fragments.len() >= self.target.max_fragments {
            return;
        }
        let (mut places, mut values) =
            ([(0, 0.0); TOGETHER], [[0.0; TOGETHER]; TRANSPARENT_VALUES]);
        let mut n = 0;
        for (column, index) in columns.clone().zip(self.target.opaque.area.indices(row, &columns)) {
            // No fragment of a row occludes another one, so their order does not matter.
            if let Some((key, of_sample)) = sample(column, self.occluder_key(index, item)) {
                places[n] = (index, key);
                values.iter_mut().zip(of_sample).for_each(|(all, value)| all[n] = value);
                n += 1;
                if n == TOGETHER {
                    self.push(&places, values.each_ref().map(|all| &all[..]), item);
                    n = 0;
                }
            }
        }
        self.push(&places[..n], values.each_ref().map(|all| &all[..n]), item);
    }
}

impl FragmentWriter<'_, '_> {
    /// Shades samples, given by index and key, and stores them.
    fn push(&mut self, places: &[(usize, f32)], values: [&[f32]; TRANSPARENT_VALUES], item: u32) {
        let target = &mut *self.target;
        self.shading.shade(values, Encoding::Linear, target.run);
        for (idx, &(sample, key)) in places.iter().enumerate() {
            let transmittance = values[TRANSPARENT_VALUES - 1][idx].clamp(0.0, 1.0);
            // A fragment that transmits everything is invisible.
            if transmittance < 1.0 && target.fragments.len() < target.max_fragments {
                let shaded = target.run.get(idx);
                target.stats.count(&shaded);
                if transmittance == 0.0 {
                    target.front[sample] = greater(target.front[sample], key);
                }
                target.fragments.push(Fragment {
                    sample: sample as u32,
                    key,
                    item,
                    is_line: self.is_line,
                    light: shaded.light,
                    transmittance,
                });
            }
        }
    }

    /// The depth key of the nearest occluder of a sample; only what is nearer is visible, so of
    /// equal keys the first drawn wins. The hidden parts of lines have been removed along their
    /// middles, so opaque surfaces do not occlude lines here, where that would cut their width.
    fn occluder_key(&self, sample: usize, item: u32) -> f32 {
        let FragmentTarget { front, opaque, .. } = &*self.target;
        let front = front[sample];
        if self.is_line {
            return front;
        }
        match opaque.item_in_plane(sample, item) {
            Some(other) if other < item => f32::INFINITY,
            Some(_) => front,
            None => greater(front, opaque.keys[sample]),
        }
    }
}

impl RowTarget for FragmentWriter<'_, '_> {
    fn draw_row(
        &mut self,
        row: &TriangleRow,
        triangle: &TriangleRef<'_>,
        planes: &mut LazyPlanes<'_>,
    ) {
        let planes: &[Plane; TRANSPARENT_VALUES] = planes
            .get(triangle)
            .try_into()
            .expect("transparent shapes have a plane for each value");
        let starts = planes.each_ref().map(|plane| plane.start(row));
        let is_perspective = triangle.is_perspective();
        self.draw_each(
            row.row,
            row.columns[0]..row.columns[1],
            triangle.item(),
            |column, occluder_key| {
                let place = f64::from(column) + 0.5;
                let key = row.key_at(place);
                if key as f32 <= occluder_key {
                    return None;
                }
                let scale = if is_perspective { 1.0 / key } else { 1.0 };
                let across = place - row.from;
                let value = |i: usize| ((starts[i] + across * planes[i].per_column) * scale) as f32;
                Some((key as f32, std::array::from_fn(value)))
            },
        );
    }
}
