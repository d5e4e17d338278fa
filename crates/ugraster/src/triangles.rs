//! Triangles whose corners are rows of a shared table, drawn without lists of edges.
//!
//! Most faces of large scenes are small triangles. Only the rows of their corners are stored. The
//! positions are read when a triangle is drawn, the values only if one of its samples is visible.

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch, f64x8};

use crate::block::{BLOCK, Corners, PerTriangle, TriangleBlock, first_centers, to_integers};
use crate::gradients::{Gradients, StoredGradients};
use crate::outlines::{Outlines, RowSpans, StoredOutlines};
use crate::polygons::ScreenPoint;

/// Values of triangles at their corners, for the loops that are compiled once for any number of
/// values.
pub trait TriangleValues {
    /// Writes each value of an item at its three corners, as it is on the surface.
    fn write(&self, item: u32, corners: [u32; 3], values: &mut [[f64; 3]]);
}

/// Triangles about to be drawn. Row and sample counts vary per triangle, so the loop branches are
/// often mispredicted. Setup of several triangles is done ahead to hide that, and in vector
/// registers.
pub struct TriangleQueue {
    items: [u32; LEN],
    /// Rows of the table.
    corners: [[u32; 3]; LEN],
    blocks: [TriangleBlock; LEN / BLOCK],
    n: usize,
}

/// Triangles in a full queue.
const LEN: usize = 2 * BLOCK;

impl Default for TriangleQueue {
    fn default() -> Self {
        Self { items: [0; LEN], corners: [[0; 3]; LEN], blocks: Default::default(), n: 0 }
    }
}

impl TriangleQueue {
    /// Adds a [regular](crate::BlockClasses) triangle. Returns true if the queue is full.
    #[inline(always)]
    pub fn push(&mut self, item: u32, corners: [u32; 3], points: [ScreenPoint; 3]) -> bool {
        self.items[self.n] = item;
        self.corners[self.n] = corners;
        self.blocks[self.n / BLOCK].set(self.n % BLOCK, points);
        self.n += 1;
        self.n == LEN
    }

    /// Empties the queue. `draw` receives its triangles, block by block, with their spans in some
    /// rows and columns of samples.
    pub fn flush(
        &mut self,
        level: Level,
        rows: [u32; 2],
        columns: [u32; 2],
        is_perspective: bool,
        mut draw: impl FnMut(&BlockSetup<'_>),
    ) {
        for (idx, block) in self.blocks.iter().enumerate().take(self.n.div_ceil(BLOCK)) {
            let queued = idx * BLOCK..((idx + 1) * BLOCK).min(self.n);
            let spans = BlockSpans::new(level, block, queued.len(), rows, columns);
            let (items, corners) = (&self.items[queued.clone()], &self.corners[queued]);
            draw(&BlockSetup { level, items, corners, columns, is_perspective, spans });
        }
        self.n = 0;
    }
}

/// The triangles of a block, ready to be drawn.
pub struct BlockSetup<'a> {
    level: Level,
    items: &'a [u32],
    /// Rows of the table.
    corners: &'a [[u32; 3]],
    /// First column of samples, and one past the last.
    columns: [u32; 2],
    is_perspective: bool,
    spans: BlockSpans,
}

impl BlockSetup<'_> {
    /// Draws the samples of every triangle, row by row.
    #[inline(always)] // Compiled into loops for several instruction sets.
    pub fn draw(&self, target: &mut impl RowTarget, planes: &mut LazyPlanes<'_>) {
        let mut left = self.spans.has_samples;
        while left != 0 {
            let idx = left.trailing_zeros() as usize;
            left &= left - 1;
            planes.is_found = false;
            self.draw_triangle(idx, target, planes);
        }
    }

    #[inline(always)]
    fn draw_triangle(&self, idx: usize, target: &mut impl RowTarget, planes: &mut LazyPlanes<'_>) {
        let all = &self.spans;
        let [first, end] = [all.rows[0][idx], all.rows[1][idx]];
        let top_key = all.keys[0][idx];
        let (key_per_column, key_per_row) = (all.key_gradients[0][idx], all.key_gradients[1][idx]);
        let (x, y) = (all.x[idx], all.y[idx]);
        let triangle = TriangleRef { setup: self, idx };
        let (mut spans, mut later) = (&all.first_spans, [[[0; BLOCK]; 2]; FIRST_ROWS]);
        for start in (first..end).step_by(FIRST_ROWS) {
            if start > first {
                all.find_later(self.level, idx, start, self.columns, &mut later);
                spans = &later;
            }
            for (row, [starts, ends]) in (start..end).zip(spans) {
                let (start, end) = (starts[idx], ends[idx]);
                if start >= end {
                    continue;
                }
                let down = f64::from(row) + 0.5 - y;
                let (row, columns) = (row as u32, [start as u32, end as u32]);
                let key = top_key + down * key_per_row;
                let row = TriangleRow { row, columns, from: x, down, key, key_per_column };
                target.draw_row(&row, &triangle, planes);
            }
        }
    }
}

/// Receives the samples of triangles.
pub trait RowTarget {
    /// Draws one row. `planes` are computed when they are first read.
    fn draw_row(
        &mut self,
        row: &TriangleRow,
        triangle: &TriangleRef<'_>,
        planes: &mut LazyPlanes<'_>,
    );
}

/// The samples of a triangle on one row.
#[derive(Clone, Copy, Debug)]
pub struct TriangleRow {
    /// Row of samples in the whole picture.
    pub row: u32,
    /// First column of samples, and one past the last.
    pub columns: [u32; 2],
    /// The column that the key and the values are measured from: that of the highest corner.
    pub from: f64,
    /// Distance downwards from the highest corner.
    pub down: f64,
    /// The depth key at that column.
    pub key: f64,
    /// Change of the depth key per column.
    pub key_per_column: f64,
}

impl TriangleRow {
    /// The depth key at a column.
    #[inline]
    pub fn key_at(&self, column: f64) -> f64 {
        self.key + (column - self.from) * self.key_per_column
    }
}

/// One triangle of a block.
pub struct TriangleRef<'a> {
    setup: &'a BlockSetup<'a>,
    idx: usize,
}

impl TriangleRef<'_> {
    /// The item it belongs to.
    #[inline(always)]
    pub fn item(&self) -> u32 {
        self.setup.items[self.idx]
    }

    /// True if values over the picture are multiplied by the key.
    #[inline(always)]
    pub fn is_perspective(&self) -> bool {
        self.setup.is_perspective
    }
}

/// A value over the picture, multiplied by the key in perspective.
#[derive(Clone, Copy, Debug, Default)]
pub struct Plane {
    at_top: f64,
    per_row: f64,
    /// Change per column.
    pub per_column: f64,
}

impl Plane {
    /// The value on a row at the column that the row is measured from.
    #[inline(always)]
    pub fn start(&self, row: &TriangleRow) -> f64 {
        self.at_top + row.down * self.per_row
    }
}

/// The planes of all values of a triangle, computed when they are first read.
pub struct LazyPlanes<'a> {
    values: &'a dyn TriangleValues,
    /// Each value at the three corners.
    at_corners: &'a mut [[f64; 3]],
    planes: &'a mut [Plane],
    is_found: bool,
}

impl<'a> LazyPlanes<'a> {
    /// `at_corners` and `planes`: buffers of as many elements as there are values.
    pub fn new(
        values: &'a dyn TriangleValues,
        at_corners: &'a mut [[f64; 3]],
        planes: &'a mut [Plane],
    ) -> Self {
        Self { values, at_corners, planes, is_found: false }
    }

    /// The planes of the triangle that is being drawn.
    #[inline(always)]
    pub fn get(&mut self, triangle: &TriangleRef<'_>) -> &[Plane] {
        if !self.is_found {
            self.find(triangle);
            self.is_found = true;
        }
        self.planes
    }

    #[inline(always)]
    fn find(&mut self, &TriangleRef { setup, idx }: &TriangleRef<'_>) {
        let all = &setup.spans;
        let corners = setup.corners[idx];
        let corner = |place: usize| corners[all.order[place][idx] as usize];
        self.values.write(setup.items[idx], [corner(0), corner(1), corner(2)], self.at_corners);
        let key = |place: usize| if setup.is_perspective { all.keys[place][idx] } else { 1.0 };
        let keys = [key(0), key(1), key(2)];
        let gradients = all.gradients.only(idx);
        for (plane, [top, middle, bottom]) in self.planes.iter_mut().zip(&*self.at_corners) {
            let values = [top * keys[0], middle * keys[1], bottom * keys[2]];
            let [per_column, per_row] = gradients.of(values);
            *plane = Plane { at_top: values[0], per_row, per_column };
        }
    }
}

/// The outlines of the triangles of a block, and their samples on the first rows.
struct BlockSpans {
    /// Position of the highest corner.
    x: PerTriangle,
    y: PerTriangle,
    /// Which of the three corners is the highest, the middle and the lowest one.
    order: [PerTriangle; 3],
    /// Depth keys of the corners in this order.
    keys: [PerTriangle; 3],
    /// Change of the key per column and per row.
    key_gradients: [PerTriangle; 2],
    gradients: StoredGradients,
    outlines: StoredOutlines,
    /// The first row of samples, and one past the last.
    rows: [[i32; BLOCK]; 2],
    /// Spans of the first row of each triangle, of the second, and so on.
    first_spans: [RowSpans; FIRST_ROWS],
    /// The triangles that have samples: triangle i is bit i.
    has_samples: u64,
}

/// Rows that are intersected for all triangles of a block at once. Rows below are intersected
/// triangle by triangle, as many at once.
const FIRST_ROWS: usize = BLOCK;

/// 0, 1, 2 and so on.
const STEPS: [f64; BLOCK] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

/// Swaps corners where the second is higher.
#[inline(always)]
fn swap<S: Simd>((a, i): &mut (Corners<S>, f64x8<S>), (b, j): &mut (Corners<S>, f64x8<S>)) {
    let is_wrong = b.y.simd_lt(a.y);
    for (a, b) in [(&mut a.x, &mut b.x), (&mut a.y, &mut b.y), (&mut a.key, &mut b.key), (i, j)] {
        (*a, *b) = (is_wrong.select(*b, *a), is_wrong.select(*a, *b));
    }
}

impl BlockSpans {
    /// Intersects the first `n` triangles of a block with rows of samples.
    fn new(
        level: Level,
        block: &TriangleBlock,
        n: usize,
        rows: [u32; 2],
        columns: [u32; 2],
    ) -> Self {
        dispatch!(level, simd => Self::new_on(simd, block, n, rows, columns))
    }

    #[inline(always)]
    fn new_on<S: Simd>(
        simd: S,
        block: &TriangleBlock,
        n: usize,
        [first_row, end_row]: [u32; 2],
        columns: [u32; 2],
    ) -> Self {
        let number = |number: f64| f64x8::splat(simd, number);
        // Sorted from the highest by selection and not by branches, which would be mispredicted.
        let corner = |which: usize| (block.corners(simd, which), number(which as f64));
        let (mut top, mut middle, mut bottom) = (corner(0), corner(1), corner(2));
        swap(&mut top, &mut middle);
        swap(&mut middle, &mut bottom);
        swap(&mut top, &mut middle);
        let order = [top.1.into(), middle.1.into(), bottom.1.into()];
        let sorted @ [top, middle, bottom] = [&top.0, &middle.0, &bottom.0];
        let (picture_top, picture_bottom) =
            (number(f64::from(first_row)), number(f64::from(end_row)));
        let row_of = |corner: &Corners<S>| first_centers(corner.y, picture_top, picture_bottom);
        let (first, knee) = (row_of(top), row_of(middle));
        let steps: f64x8<S> = STEPS.simd_into(simd);
        let end = steps.simd_lt(number(n as f64)).select(row_of(bottom), first);
        let outlines = Outlines::new(simd, sorted, knee, end);
        let gradients = Gradients::new(simd, sorted);
        let [key_per_column, key_per_row] = gradients.of([top.key, middle.key, bottom.key]);
        let n_rows = end - first;
        let mut has_samples = n_rows.simd_gt(number(FIRST_ROWS as f64)).to_bitmask();
        let mut first_spans = [[[0; BLOCK]; 2]; FIRST_ROWS];
        for (row, spans) in first_spans.iter_mut().enumerate() {
            if !n_rows.simd_gt(number(row as f64)).any_true() {
                break;
            }
            let has_some;
            (*spans, has_some) = outlines.spans(simd, first + (row as f64 + 0.5), columns);
            has_samples |= has_some;
        }
        Self {
            x: top.x.into(),
            y: top.y.into(),
            order,
            keys: [top.key.into(), middle.key.into(), bottom.key.into()],
            key_gradients: [key_per_column.into(), key_per_row.into()],
            gradients: StoredGradients::new(&gradients),
            outlines: StoredOutlines::new(&outlines),
            rows: to_integers(simd, first, end),
            first_spans,
            has_samples,
        }
    }

    /// Finds the samples of one triangle in the rows from `first` on. They are stored as in
    /// [`BlockSpans::first_spans`].
    fn find_later(
        &self,
        level: Level,
        idx: usize,
        first: i32,
        columns: [u32; 2],
        later: &mut [RowSpans; FIRST_ROWS],
    ) {
        dispatch!(level, simd => self.find_later_on(simd, idx, first, columns, later));
    }

    #[inline(always)]
    fn find_later_on<S: Simd>(
        &self,
        simd: S,
        idx: usize,
        first: i32,
        columns: [u32; 2],
        later: &mut [RowSpans; FIRST_ROWS],
    ) {
        let steps: f64x8<S> = STEPS.simd_into(simd);
        let centers = steps + (f64::from(first) + 0.5);
        let ([starts, ends], _) = self.outlines.splat(simd, idx).spans(simd, centers, columns);
        for ((spans, start), end) in later.iter_mut().zip(starts).zip(ends) {
            (spans[0][idx], spans[1][idx]) = (start, end);
        }
    }
}
