//! What light passes: translucent faces, and lines, in front of what hides.
//!
//! When a tile holds the nearest of what hides at every sample, everything clear is drawn over it: each sample of it
//! that is nearer becomes a [`Fragment`]. The fragments of a sample are sorted by depth and blended from behind, in
//! linear light, so faces may cut through each other, and the order of statements makes no difference.
//!
//! Lines, and what of a face lets nothing through, hide what is clear behind them: that is not kept if it is drawn later.
//! Fragments take memory, so if a tile has too many of them it is drawn in parts, down to single rows of samples.

use std::ops::Range;

use fearless_simd::Simd;

use crate::band::Grid;
use crate::edges::{Crossing, Scanner};
use crate::polygons::{first_center, greater};
use crate::rows::TriangleRow;
use crate::shading::{Shade, Tally};
use crate::slopes::{FindPlanes, Planes};
use crate::spans::{EMPTY, Sink, Tag, Tile};

/// Numbers that are interpolated for what is clear.
pub const TRANSPARENT_VALUES: usize = 8;

/// Fragments that are kept at once, if more than a row of samples is drawn: 64 MiB.
const MOST_FRAGMENTS: usize = 1 << 21;

/// What is clear and how it looks.
pub trait TransparentLayer: Sync {
    /// Draws what of it is in a band.
    fn draw(
        &self,
        grid: &Grid,
        band: usize,
        scanner: &mut Scanner<TRANSPARENT_VALUES>,
        target: &mut FragmentTarget<'_>,
    );
}

/// A sample of something clear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fragment {
    /// Number of the sample in its tile.
    sample: u32,
    /// Depth key.
    pub key: f32,
    /// Whose it is.
    pub item: u32,
    /// True if it is of a line, which is drawn nearer than it is.
    pub is_line: bool,
    /// Its own linear light, before anything is taken from it.
    pub light: [f32; 3],
    /// The part of the light from behind that it lets through.
    pub pass: f32,
}

/// What a sample shows, blended: to the light behind times `pass`, `light` is added, and `cover` is the part of the
/// sample that is not the ground behind everything.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Composite {
    pub light: [f32; 3],
    pub cover: f32,
    pub pass: f32,
}

impl Composite {
    /// Nothing.
    pub const NONE: Self = Self { light: [0.0; 3], cover: 0.0, pass: 1.0 };

    /// The same behind something of which the part `cue` is left by depth cueing.
    fn behind(self, fragment: &Fragment, cue: f32) -> Self {
        let Fragment { light, pass, .. } = *fragment;
        let own = (1.0 - pass) * cue;
        Self {
            light: std::array::from_fn(|i| own * light[i] + pass * self.light[i]),
            cover: own + pass * self.cover,
            pass: pass * self.pass,
        }
    }
}

/// Which fragments are kept after blending.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum KeepFragments {
    #[default]
    None,
    /// Those of the samples nearest to the middles of pixels.
    Centers,
    All,
}

/// What is clear in a tile.
#[derive(Default)]
pub struct TransparencyBuffer {
    scanner: Scanner<TRANSPARENT_VALUES>,
    fragments: Vec<Fragment>,
    /// Depth keys of the nearest of them that lets nothing through, for each sample of the tile.
    front: Vec<f32>,
    /// One for each sample of the tile; none at all if nothing in it is clear.
    composites: Vec<Composite>,
    kept: Vec<Fragment>,
    columns: [u32; 2],
    rows: [u32; 2],
}

impl TransparencyBuffer {
    /// Draws what is clear over a tile.
    pub fn draw<const N: usize, T: Tag>(
        &mut self,
        clear: &dyn TransparentLayer,
        grid: &Grid,
        band: usize,
        tile: &Tile<N, T>,
        keep: KeepFragments,
    ) -> Tally {
        (self.columns, self.rows) = (tile.columns(), tile.rows());
        self.composites.clear();
        self.kept.clear();
        let mut tally = Tally::default();
        let mut parts = vec![self.rows];
        while let Some(rows) = parts.pop() {
            self.fragments.clear();
            self.front.clear();
            self.front.resize(tile.keys().len(), EMPTY);
            let mut target = FragmentTarget {
                rows,
                columns: self.columns,
                top: self.rows[0],
                keys: tile.keys(),
                fragments: &mut self.fragments,
                front: &mut self.front,
                most: if rows[1] - rows[0] > 1 { MOST_FRAGMENTS } else { usize::MAX },
                tally: Tally::default(),
            };
            clear.draw(grid, band, &mut self.scanner, &mut target);
            if target.fragments.len() < target.most {
                tally = tally.merge(target.tally);
                self.blend(grid, keep);
            } else {
                let middle = rows[0] + (rows[1] - rows[0]) / 2;
                parts.extend([[middle, rows[1]], [rows[0], middle]]);
            }
        }
        tally
    }

    /// True if nothing in the tile is clear.
    pub fn is_empty(&self) -> bool {
        self.composites.is_empty()
    }

    fn blend(&mut self, grid: &Grid, keep: KeepFragments) {
        if self.fragments.is_empty() {
            return;
        }
        let width = self.columns[1] - self.columns[0];
        self.composites.resize((width * (self.rows[1] - self.rows[0])) as usize, Composite::NONE);
        // From behind; of equals the first drawn is in front.
        self.fragments.reverse();
        self.fragments.sort_by(|a, b| a.sample.cmp(&b.sample).then(a.key.total_cmp(&b.key)));
        let middle = |place: u32| place % grid.samples == grid.samples / 2;
        for fragment in &self.fragments {
            let composite = &mut self.composites[fragment.sample as usize];
            *composite = composite.behind(fragment, grid.cue_at(fragment.key));
            let is_center = || {
                middle(self.columns[0] + fragment.sample % width)
                    && middle(self.rows[0] + fragment.sample / width)
            };
            if keep == KeepFragments::All || keep == KeepFragments::Centers && is_center() {
                self.kept.push(*fragment);
            }
        }
    }

    /// What is in front of a sample.
    #[inline]
    pub fn composite(&self, row: u32, column: u32) -> Composite {
        self.composites.get(self.sample(row, column) as usize).copied().unwrap_or(Composite::NONE)
    }

    /// The fragments of a sample, from behind, if they are kept.
    pub fn fragments(&self, row: u32, column: u32) -> &[Fragment] {
        let sample = self.sample(row, column);
        // Parts of a tile come from above, so those kept are in order.
        let start = self.kept.partition_point(|fragment| fragment.sample < sample);
        let end = self.kept.partition_point(|fragment| fragment.sample <= sample);
        &self.kept[start..end]
    }

    #[inline]
    fn sample(&self, row: u32, column: u32) -> u32 {
        (row - self.rows[0]) * (self.columns[1] - self.columns[0]) + column - self.columns[0]
    }
}

/// A part of a tile on which what is clear is drawn.
pub struct FragmentTarget<'a> {
    rows: [u32; 2],
    columns: [u32; 2],
    /// First row of the tile.
    top: u32,
    /// Depth keys of what hides, of the whole tile.
    keys: &'a [f32],
    fragments: &'a mut Vec<Fragment>,
    /// Depth keys of the nearest of them that lets nothing through.
    front: &'a mut [f32],
    most: usize,
    tally: Tally,
}

impl<'a> FragmentTarget<'a> {
    /// Takes faces, or lines. `shader`: the light of interpolated numbers, and the part of what is behind that passes.
    pub fn sink<S>(&mut self, shader: S, is_line: bool) -> FragmentSink<'_, 'a, S> {
        FragmentSink { target: self, shader, is_line }
    }

    fn samples(&self, row: u32, columns: &Range<u32>) -> Range<usize> {
        let width = self.columns[1] - self.columns[0];
        let start = (row - self.top) * width;
        let at = |column: u32| (start + column - self.columns[0]) as usize;
        at(columns.start)..at(columns.end)
    }
}

/// Puts samples of shapes on a target.
pub struct FragmentSink<'p, 'a, S> {
    target: &'p mut FragmentTarget<'a>,
    shader: S,
    is_line: bool,
}

impl<S: Fn(&[f32; TRANSPARENT_VALUES]) -> (Shade, f32)> FragmentSink<'_, '_, S> {
    fn push(&mut self, sample: usize, item: u32, key: f32, values: &[f32; TRANSPARENT_VALUES]) {
        let (shade, pass) = (self.shader)(values);
        let target = &mut *self.target;
        // What is all clear is as if it were not there.
        if pass < 1.0 && target.fragments.len() < target.most {
            target.tally.count(&shade);
            if pass == 0.0 {
                target.front[sample] = greater(target.front[sample], key);
            }
            let (sample, light) = (sample as u32, shade.light);
            target.fragments.push(Fragment { sample, key, item, is_line: self.is_line, light, pass });
        }
    }

    /// What is not nearer than this depth key is hidden. Lines have had their hidden parts removed; what hides is not looked at
    /// again, beside their middle. Of equals the first drawn is in front.
    fn hiding(&self, sample: usize) -> f32 {
        let front = self.target.front[sample];
        if self.is_line { front } else { greater(front, self.target.keys[sample]) }
    }
}

impl<S: Fn(&[f32; TRANSPARENT_VALUES]) -> (Shade, f32)> Sink<TRANSPARENT_VALUES> for FragmentSink<'_, '_, S> {
    const KEEPS_ALL: bool = true;

    fn rows(&self) -> [u32; 2] {
        self.target.rows
    }

    fn columns(&self) -> [u32; 2] {
        self.target.columns
    }

    fn draw(
        &mut self,
        row: u32,
        left: &Crossing<TRANSPARENT_VALUES>,
        right: &Crossing<TRANSPARENT_VALUES>,
        is_perspective: bool,
        item: u32,
    ) {
        let [start, end] = self.target.columns;
        let columns = first_center(left.x, end).max(start)..first_center(right.x, end);
        if columns.is_empty() {
            return;
        }
        let per_column = 1.0 / (right.x - left.x);
        for (column, sample) in columns.clone().zip(self.target.samples(row, &columns)) {
            let across = f64::from(column) + 0.5 - left.x;
            let mix = |a: f64, b: f64| a + across * ((b - a) * per_column);
            let key = mix(left.key, right.key);
            if key as f32 <= self.hiding(sample) {
                continue;
            }
            let scale = if is_perspective { 1.0 / key } else { 1.0 };
            let values = std::array::from_fn(|i| (mix(left.values[i], right.values[i]) * scale) as f32);
            self.push(sample, item, key as f32, &values);
        }
    }

    fn draw_line<P: Simd>(
        &mut self,
        _: P,
        line: &TriangleRow,
        is_perspective: bool,
        item: u32,
        planes: &mut Planes<TRANSPARENT_VALUES, impl FindPlanes<TRANSPARENT_VALUES>>,
    ) {
        let columns = line.columns[0]..line.columns[1];
        let planes = planes.get();
        for (column, sample) in columns.clone().zip(self.target.samples(line.row, &columns)) {
            let place = f64::from(column) + 0.5;
            let key = line.key_at(place);
            if key as f32 <= self.hiding(sample) {
                continue;
            }
            let scale = if is_perspective { 1.0 / key } else { 1.0 };
            let across = place - line.from;
            let values = planes.map(|plane| ((plane.start(line) + across * plane.a_column) * scale) as f32);
            self.push(sample, item, key as f32, &values);
        }
    }

    fn draw_each(
        &mut self,
        row: u32,
        columns: Range<u32>,
        item: u32,
        mut sample: impl FnMut(u32, f32) -> Option<(f32, [f32; TRANSPARENT_VALUES])>,
    ) {
        for (column, place) in columns.clone().zip(self.target.samples(row, &columns)) {
            if let Some((key, values)) = sample(column, self.hiding(place)) {
                self.push(place, item, key, &values);
            }
        }
    }
}
