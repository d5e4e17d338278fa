//! The samples of a tile, and the depth test.

use super::edges::Crossing;
use super::polygons::first_center;
use super::triangles::TriangleRow;

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
    fn draw_line(
        &mut self,
        line: &TriangleRow,
        is_perspective: bool,
        item: u32,
        numbers: impl FnOnce() -> ([f64; N], [f64; N]),
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

    #[inline]
    fn draw_line(
        &mut self,
        line: &TriangleRow,
        is_perspective: bool,
        item: u32,
        numbers: impl FnOnce() -> ([f64; N], [f64; N]),
    ) {
        self.draw_line(line, is_perspective, T::of(item), numbers);
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
    keys: Vec<f32>,
    values: Vec<[f32; N]>,
    tags: Vec<T>,
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
pub(super) struct Part<'a, const N: usize, T> {
    pub keys: &'a mut [f32],
    pub values: &'a mut [[f32; N]],
    pub tags: &'a mut [T],
}

impl<const N: usize, T> Part<'_, N, T> {
    /// Leaves out the first `n` samples.
    #[inline]
    pub fn skip(&mut self, n: usize) {
        self.keys = &mut std::mem::take(&mut self.keys)[n..];
        self.values = &mut std::mem::take(&mut self.values)[n..];
        self.tags = &mut std::mem::take(&mut self.tags)[n..];
    }
}

/// Farther than everything.
const EMPTY: f32 = f32::NEG_INFINITY;

impl<const N: usize, T> Default for Tile<N, T> {
    fn default() -> Self {
        Self { columns: [0; 2], rows: [0; 2], keys: Vec::new(), values: Vec::new(), tags: Vec::new() }
    }
}

impl<const N: usize, T: Tag> Tile<N, T> {
    /// Makes it the empty tile of these columns and rows, reusing its buffers.
    pub fn reset(&mut self, columns: [u32; 2], rows: [u32; 2]) {
        (self.columns, self.rows) = (columns, rows);
        let len = (columns[1] - columns[0]) as usize * (rows[1] - rows[0]) as usize;
        self.keys.clear();
        self.keys.resize(len, EMPTY);
        // What stands in `values` and `tags` is read only where a key has been written.
        self.values.resize(len, [0.0; N]);
        self.tags.resize(len, T::default());
    }

    /// Depth keys, row after row.
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
        let samples = self.samples(row, columns.start, columns.end);
        let keys = self.keys[samples.clone()].iter_mut();
        let stored = self.values[samples.clone()].iter_mut().zip(&mut self.tags[samples]);
        for (column, (nearest, (values, tag_here))) in columns.zip(keys.zip(stored)) {
            if let Some(nearer) = sample(column, *nearest) {
                (*nearest, *values) = nearer;
                *tag_here = tag;
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
        let Part { keys, values, tags } = self.part(row, first, end);
        for (column, ((nearest, values), tag_here)) in (first..end).zip(keys.iter_mut().zip(values).zip(tags))
        {
            // From the left end and never from the sample before: the answer must not
            // depend on where a tile starts.
            let across = f64::from(column) + 0.5 - left.x;
            let key = left.key + across * key_slope;
            if key as f32 <= *nearest {
                continue;
            }
            *nearest = key as f32;
            *tag_here = tag;
            let scale = if is_perspective { 1.0 / key } else { 1.0 };
            // Double precision pays: where values do not change they stay the same bits, and
            // the resolver shades them once.
            *values = std::array::from_fn(|i| ((left.values[i] + across * slopes[i]) * scale) as f32);
        }
    }

    /// The samples of part of a row, to be drawn on.
    #[inline]
    pub(super) fn part(&mut self, row: u32, first: u32, end: u32) -> Part<'_, N, T> {
        let samples = self.samples(row, first, end);
        Part {
            keys: &mut self.keys[samples.clone()],
            values: &mut self.values[samples.clone()],
            tags: &mut self.tags[samples],
        }
    }

    /// The samples of part of a row: their values where something was drawn.
    #[inline]
    pub fn row_part(&self, row: u32, first: u32, end: u32) -> impl Iterator<Item = Option<&[f32; N]>> {
        let samples = self.samples(row, first, end);
        let values = &self.values[samples.clone()];
        self.keys[samples].iter().zip(values).map(|(&key, values)| (key != EMPTY).then_some(values))
    }

    /// What is seen at a sample, if anything.
    pub fn seen(&self, row: u32, column: u32) -> Option<Seen<T>> {
        let sample = self.samples(row, column, column + 1).start;
        let (key, tag) = (self.keys[sample], self.tags[sample]);
        (key != EMPTY).then_some(Seen { key, tag })
    }

    #[inline]
    fn samples(&self, row: u32, first: u32, end: u32) -> std::ops::Range<usize> {
        let width = (self.columns[1] - self.columns[0]) as usize;
        let start = (row - self.rows[0]) as usize * width;
        start + (first - self.columns[0]) as usize..start + (end - self.columns[0]) as usize
    }
}
