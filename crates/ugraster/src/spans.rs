//! The samples of a tile, and the depth test.

use fearless_simd::Simd;

use crate::edges::Crossing;
use crate::polygons::first_center;
use crate::rows::{LANES, TriangleRow};
use crate::slopes::{FindPlanes, Planes};

/// What a sample remembers of the polygon it shows.
pub trait Tag: Copy + Default + Send {
    /// False if it remembers nothing, and costs nothing.
    const IS_KEPT: bool;

    /// That of a polygon of this item.
    fn of(item: u32) -> Self;
}

impl Tag for () {
    const IS_KEPT: bool = false;

    fn of(_item: u32) -> Self {}
}

impl Tag for u32 {
    const IS_KEPT: bool = true;

    fn of(item: u32) -> Self {
        item
    }
}

/// What takes the samples of shapes.
pub trait Sink<const N: usize> {
    /// False if only the nearest shape is kept at each sample.
    const KEEPS_ALL: bool;

    /// First row, and one past the last, in samples of the whole picture.
    fn rows(&self) -> [u32; 2];

    /// First column, and one past the last.
    fn columns(&self) -> [u32; 2];

    /// Takes the samples of a row with left ≤ x < right, as [`Tile::draw`] does.
    fn draw(&mut self, row: u32, left: &Crossing<N>, right: &Crossing<N>, is_perspective: bool, item: u32);

    /// Takes the samples of a row of a triangle, as [`Tile::draw_line`] does.
    fn draw_line<S: Simd>(
        &mut self,
        simd: S,
        line: &TriangleRow,
        is_perspective: bool,
        item: u32,
        planes: &mut Planes<N, impl FindPlanes<N>>,
    );

    /// Takes samples of a row one by one, as [`Tile::draw_each`] does.
    fn draw_each(
        &mut self,
        row: u32,
        columns: std::ops::Range<u32>,
        item: u32,
        sample: impl FnMut(u32, f32) -> Option<(f32, [f32; N])>,
    );
}

impl<const N: usize, T: Tag> Sink<N> for Tile<N, T> {
    const KEEPS_ALL: bool = false;

    fn rows(&self) -> [u32; 2] {
        self.rows
    }

    fn columns(&self) -> [u32; 2] {
        self.columns
    }

    #[inline]
    fn draw(&mut self, row: u32, left: &Crossing<N>, right: &Crossing<N>, is_perspective: bool, item: u32) {
        self.draw(row, left, right, is_perspective, T::of(item));
    }

    #[inline(always)]
    fn draw_line<S: Simd>(
        &mut self,
        simd: S,
        line: &TriangleRow,
        is_perspective: bool,
        item: u32,
        planes: &mut Planes<N, impl FindPlanes<N>>,
    ) {
        self.draw_line(simd, line, is_perspective, T::of(item), planes);
    }

    #[inline]
    fn draw_each(
        &mut self,
        row: u32,
        columns: std::ops::Range<u32>,
        item: u32,
        sample: impl FnMut(u32, f32) -> Option<(f32, [f32; N])>,
    ) {
        self.draw_each(row, columns, T::of(item), sample);
    }
}

/// A rectangle of samples with what is nearest at each of them.
#[derive(Debug)]
pub struct Tile<const N: usize, T> {
    /// First column, and one past the last, in samples of the whole picture.
    columns: [u32; 2],
    rows: [u32; 2],
    /// Depth keys; [`EMPTY`] where nothing has been drawn.
    pub(crate) keys: Vec<f32>,
    /// Each number of all samples together, so that they can be shaded many at once.
    pub(crate) values: [Vec<f32>; N],
    pub(crate) tags: Vec<T>,
}

/// What is seen at a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen<T> {
    /// Its depth key.
    pub key: f32,
    /// Whose it is.
    pub tag: T,
}

/// Part of a row of a [`Tile`].
pub(crate) struct Part<'a, const N: usize, T> {
    pub keys: &'a mut [f32],
    pub values: [&'a mut [f32]; N],
    pub tags: &'a mut [T],
}

impl<const N: usize, T: Copy> Part<'_, N, T> {
    /// Puts something at a sample.
    #[inline(always)]
    pub fn set(&mut self, sample: usize, key: f32, values: [f32; N], tag: T) {
        self.keys[sample] = key;
        self.tags[sample] = tag;
        for (all, value) in self.values.iter_mut().zip(values) {
            all[sample] = value;
        }
    }
}

/// Some elements from one on.
#[inline(always)]
pub(crate) fn lanes<T>(all: &mut [T], start: usize) -> &mut [T; LANES] {
    all[start..].first_chunk_mut().expect("more stand behind the samples of a tile")
}

/// Farther than everything.
pub(crate) const EMPTY: f32 = f32::NEG_INFINITY;

impl<const N: usize, T> Default for Tile<N, T> {
    fn default() -> Self {
        Self {
            columns: [0; 2],
            rows: [0; 2],
            keys: Vec::new(),
            values: [const { Vec::new() }; N],
            tags: Vec::new(),
        }
    }
}

impl<const N: usize, T: Tag> Tile<N, T> {
    /// Makes it the empty tile of these columns and rows, reusing its buffers.
    pub fn reset(&mut self, columns: [u32; 2], rows: [u32; 2]) {
        (self.columns, self.rows) = (columns, rows);
        let len = (columns[1] - columns[0]) as usize * (rows[1] - rows[0]) as usize;
        // Some are left over behind the last, so that there are always enough to be drawn on together.
        let len = len + LANES;
        self.keys.clear();
        self.keys.resize(len, EMPTY);
        // What stands in `values` and `tags` is read only where a key has been written.
        self.values.iter_mut().for_each(|all| all.resize(len, 0.0));
        self.tags.resize(len, T::default());
    }

    /// Depth keys, row after row; some more stand behind them.
    pub fn keys(&self) -> &[f32] {
        &self.keys
    }

    pub fn rows(&self) -> [u32; 2] {
        self.rows
    }

    pub fn columns(&self) -> [u32; 2] {
        self.columns
    }

    /// Draws samples of a row one by one. `sample` is given the column of each and the key of what is nearest there
    /// so far, and answers key and values of what is nearer.
    #[inline]
    pub fn draw_each(
        &mut self,
        row: u32,
        columns: std::ops::Range<u32>,
        tag: T,
        mut sample: impl FnMut(u32, f32) -> Option<(f32, [f32; N])>,
    ) {
        let mut part = self.part(row, columns.start, columns.end);
        for (idx, column) in columns.enumerate() {
            if let Some((key, values)) = sample(column, part.keys[idx]) {
                part.set(idx, key, values, tag);
            }
        }
    }

    /// Draws the samples of a row with left ≤ x < right where the depth test lets it.
    ///
    /// Keys and values are linear between the two ends; in perspective the values
    /// are those of the surface times the key, and are divided by it.
    #[inline]
    pub fn draw(&mut self, row: u32, left: &Crossing<N>, right: &Crossing<N>, is_perspective: bool, tag: T) {
        let first = first_center(left.x, self.columns[1]).max(self.columns[0]);
        let end = first_center(right.x, self.columns[1]);
        if first >= end {
            return;
        }
        let per_column = 1.0 / (right.x - left.x);
        let key_slope = (right.key - left.key) * per_column;
        let slopes: [f64; N] = std::array::from_fn(|i| (right.values[i] - left.values[i]) * per_column);
        let mut part = self.part(row, first, end);
        for (idx, column) in (first..end).enumerate() {
            // From the left end and never from the sample before: the answer must not
            // depend on where a tile starts.
            let across = f64::from(column) + 0.5 - left.x;
            let key = left.key + across * key_slope;
            if key as f32 <= part.keys[idx] {
                continue;
            }
            let scale = if is_perspective { 1.0 / key } else { 1.0 };
            let value = |i: usize| ((left.values[i] + across * slopes[i]) * scale) as f32;
            part.set(idx, key as f32, std::array::from_fn(value), tag);
        }
    }

    /// The samples of part of a row, to be drawn on.
    #[inline]
    pub(crate) fn part(&mut self, row: u32, first: u32, end: u32) -> Part<'_, N, T> {
        let samples = self.samples(row, first, end);
        Part {
            keys: &mut self.keys[samples.clone()],
            values: self.values.each_mut().map(|all| &mut all[samples.clone()]),
            tags: &mut self.tags[samples],
        }
    }

    /// Part of a row: depth keys, [`EMPTY`] where nothing was drawn, and numbers, of no meaning there.
    #[inline]
    pub fn row_part(&self, row: u32, first: u32, end: u32) -> (&[f32], [&[f32]; N]) {
        let samples = self.samples(row, first, end);
        (&self.keys[samples.clone()], self.values.each_ref().map(|all| &all[samples.clone()]))
    }

    /// What is seen at a sample, if anything.
    pub fn seen(&self, row: u32, column: u32) -> Option<Seen<T>> {
        let sample = self.samples(row, column, column + 1).start;
        let (key, tag) = (self.keys[sample], self.tags[sample]);
        (key != EMPTY).then_some(Seen { key, tag })
    }

    #[inline(always)]
    pub(crate) fn samples(&self, row: u32, first: u32, end: u32) -> std::ops::Range<usize> {
        let width = (self.columns[1] - self.columns[0]) as usize;
        let start = (row - self.rows[0]) as usize * width;
        start + (first - self.columns[0]) as usize..start + (end - self.columns[0]) as usize
    }
}
