//! Triangles whose corners stand in a table that faces share, drawn without lists of edges.
//!
//! Most faces of large scenes are small triangles. Of such a one only the corners' rows are kept; where its
//! corners are, and what is interpolated between them, is looked up while it is drawn, the latter only if a
//! sample of it is seen.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8};

use crate::block::{BLOCK, Block, Corners, Each, first_centers, whole};
use crate::rows::{STEPS, TriangleRow};
use crate::sides::{KeptOutlines, Outlines, Spans};
use crate::slopes::{FindPlanes, KeptSlopes, Plane, Planes, Slopes};
use crate::spans::Sink;

/// A corner in the picture plane, without the numbers to interpolate; see [`crate::Corner`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    /// Column, in samples from the left edge of the picture.
    pub x: f64,
    /// Row, in samples from the upper edge.
    pub y: f64,
    /// Depth key, larger is nearer. In perspective it is positive: 1/distance.
    pub key: f64,
}

impl Point {
    /// True if all of it is a number.
    #[inline]
    pub fn is_finite(&self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.key.is_finite()
    }
}

/// Where corners of triangles are, and what they look like.
pub trait Table<const N: usize>: Sync {
    /// Where a corner is.
    fn point(&self, corner: u32) -> Point;

    /// The numbers to interpolate between the corners of an item, as they are at the surface.
    fn numbers(&self, item: u32, corners: [u32; 3]) -> [[f64; N]; 3];
}

/// The table of lists that have no triangles: all corners are nowhere.
#[derive(Clone, Copy, Debug)]
pub struct NoTable;

impl<const N: usize> Table<N> for NoTable {
    fn point(&self, _corner: u32) -> Point {
        Point { x: f64::NAN, y: f64::NAN, key: f64::NAN }
    }

    fn numbers(&self, _item: u32, _corners: [u32; 3]) -> [[f64; N]; 3] {
        [[0.0; N]; 3]
    }
}

/// Triangles that wait to be drawn. How many rows and samples a triangle has is not to be foreseen, so a processor often
/// goes astray in the loops over them; meanwhile what it needs of the next is ready. And it is found of several at once.
pub struct Traces {
    items: [u32; AHEAD],
    /// Rows of the table.
    corners: [[u32; 3]; AHEAD],
    blocks: [Block; AHEAD / BLOCK],
    n: usize,
}

/// How many they are.
const AHEAD: usize = 2 * BLOCK;

impl Default for Traces {
    fn default() -> Self {
        Self { items: [0; AHEAD], corners: [[0; 3]; AHEAD], blocks: Default::default(), n: 0 }
    }
}

impl Traces {
    /// Adds a [regular](crate::block::Findings) triangle. True if there is no room for another.
    #[inline(always)]
    pub fn push(&mut self, item: u32, corners: [u32; 3], points: [Point; 3]) -> bool {
        self.items[self.n] = item;
        self.corners[self.n] = corners;
        self.blocks[self.n / BLOCK].set(self.n % BLOCK, points);
        self.n += 1;
        self.n == AHEAD
    }

    /// Draws them, and is empty then. What is interpolated between the corners is asked for only if something is seen.
    #[inline(always)]
    pub fn draw<const N: usize, S: Simd>(
        &mut self,
        simd: S,
        sink: &mut impl Sink<N>,
        is_perspective: bool,
        table: &(impl Table<N> + ?Sized),
    ) {
        for (block, first) in self.blocks.iter().zip((0..self.n).step_by(BLOCK)) {
            let traced = Traced::new(simd, block, self.n - first, sink.rows(), sink.columns());
            let mut left = traced.has_samples;
            while left != 0 {
                let triangle = left.trailing_zeros() as usize;
                left &= left - 1;
                let (item, corners) = (self.items[first + triangle], &self.corners[first + triangle]);
                let known = Known { table, item, corners, traced: &traced, triangle, is_perspective };
                traced.draw(simd, triangle, sink, is_perspective, item, &mut Planes::new(known));
            }
        }
        self.n = 0;
    }
}

/// The triangles of a block, whose outlines are known.
struct Traced {
    /// Where the highest corner is, and which of the three it and the others are, downwards.
    x: Each,
    y: Each,
    order: [Each; 3],
    /// Depth keys of the corners in this order, and what they change a column and a row.
    keys: [Each; 3],
    key_slopes: [Each; 2],
    slopes: KeptSlopes,
    outlines: KeptOutlines,
    /// The first row of samples, and one past the last.
    rows: [[i32; BLOCK]; 2],
    /// Of the first row of each, of the second, and so on.
    spans: [Spans; AT_ONCE],
    /// Those of the triangles that have samples: triangle i is bit i.
    has_samples: u64,
}

/// Rows of all triangles that are found together; the rest are found for each, as many at once.
const AT_ONCE: usize = BLOCK;

/// Swaps corners if the second is higher.
#[inline(always)]
fn swap<S: Simd>((a, i): &mut (Corners<S>, f64x8<S>), (b, j): &mut (Corners<S>, f64x8<S>)) {
    let is_wrong = b.y.simd_lt(a.y);
    for (a, b) in [(&mut a.x, &mut b.x), (&mut a.y, &mut b.y), (&mut a.key, &mut b.key), (i, j)] {
        (*a, *b) = (is_wrong.select(*b, *a), is_wrong.select(*a, *b));
    }
}

impl Traced {
    /// Traces the first `n` of a block in some rows and columns of samples.
    #[inline(always)]
    fn new<S: Simd>(
        simd: S,
        block: &Block,
        n: usize,
        [first_row, end_row]: [u32; 2],
        columns: [u32; 2],
    ) -> Self {
        let number = |number: f64| f64x8::splat(simd, number);
        // The corners from above. Chosen and not branched to: nobody can tell beforehand which way a triangle lies.
        let corner = |which: usize| (block.corners(simd, which), number(which as f64));
        let (mut top, mut middle, mut bottom) = (corner(0), corner(1), corner(2));
        swap(&mut top, &mut middle);
        swap(&mut middle, &mut bottom);
        swap(&mut top, &mut middle);
        let order = [top.1.into(), middle.1.into(), bottom.1.into()];
        let sorted @ [top, middle, bottom] = [&top.0, &middle.0, &bottom.0];
        let (picture_top, picture_bottom) = (number(f64::from(first_row)), number(f64::from(end_row)));
        let row_of = |corner: &Corners<S>| first_centers(corner.y, picture_top, picture_bottom);
        let (first, knee) = (row_of(top), row_of(middle));
        let steps: f64x8<S> = STEPS.simd_into(simd);
        let end = steps.simd_lt(number(n as f64)).select(row_of(bottom), first);
        let outlines = Outlines::new(simd, sorted, knee, end);
        let slopes = Slopes::new(simd, sorted);
        let [key_a_column, key_a_row] = slopes.of([top.key, middle.key, bottom.key]);
        let n_rows = end - first;
        let mut has_samples = n_rows.simd_gt(number(AT_ONCE as f64)).to_bitmask();
        let mut spans = [[[0; BLOCK]; 2]; AT_ONCE];
        for (row, spans) in spans.iter_mut().enumerate() {
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
            key_slopes: [key_a_column.into(), key_a_row.into()],
            slopes: KeptSlopes::new(&slopes),
            outlines: KeptOutlines::new(&outlines),
            rows: whole(simd, first, end),
            spans,
            has_samples,
        }
    }

    /// Draws one of the triangles.
    #[inline(always)]
    fn draw<const N: usize, S: Simd>(
        &self,
        simd: S,
        triangle: usize,
        sink: &mut impl Sink<N>,
        is_perspective: bool,
        item: u32,
        planes: &mut Planes<N, impl FindPlanes<N>>,
    ) {
        let [first, end] = [self.rows[0][triangle], self.rows[1][triangle]];
        let top_key = self.keys[0][triangle];
        let [key_a_column, key_a_row] = self.key_slopes.each_ref().map(|all| all[triangle]);
        let (x, y) = (self.x[triangle], self.y[triangle]);
        let (mut spans, mut later) = (&self.spans, [[[0; BLOCK]; 2]; AT_ONCE]);
        for first in (first..end).step_by(AT_ONCE) {
            if first > self.rows[0][triangle] {
                self.find_later(simd, triangle, first, sink.columns(), &mut later);
                spans = &later;
            }
            for (row, [starts, ends]) in (first..end).zip(spans) {
                let (start, end) = (starts[triangle], ends[triangle]);
                if start >= end {
                    continue;
                }
                let down = f64::from(row) + 0.5 - y;
                let (row, columns) = (row as u32, [start as u32, end as u32]);
                let key = top_key + down * key_a_row;
                let line = TriangleRow { row, columns, from: x, down, key, key_a_column };
                sink.draw_line(simd, &line, is_perspective, item, planes);
            }
        }
    }

    /// Finds the samples of one triangle in the rows from `first` on, and puts them where they are in [`Traced::spans`].
    #[inline(always)]
    fn find_later<S: Simd>(
        &self,
        simd: S,
        triangle: usize,
        first: i32,
        columns: [u32; 2],
        later: &mut [Spans; AT_ONCE],
    ) {
        let steps: f64x8<S> = STEPS.simd_into(simd);
        let centers = steps + (f64::from(first) + 0.5);
        let ([starts, ends], _) = self.outlines.only(simd, triangle).spans(simd, centers, columns);
        for ((spans, start), end) in later.iter_mut().zip(starts).zip(ends) {
            (spans[0][triangle], spans[1][triangle]) = (start, end);
        }
    }
}

/// What is known of a triangle that is drawn.
struct Known<'a, C: ?Sized> {
    table: &'a C,
    item: u32,
    /// Rows of the table.
    corners: &'a [u32; 3],
    /// The block it is in, and its place there.
    traced: &'a Traced,
    triangle: usize,
    is_perspective: bool,
}

impl<const N: usize, C: Table<N> + ?Sized> FindPlanes<N> for Known<'_, C> {
    #[inline(always)]
    fn find(&self) -> [Plane; N] {
        let &Self { traced, triangle, .. } = self;
        let corner = |place: usize| self.corners[traced.order[place][triangle] as usize];
        let [top, middle, bottom] = self.table.numbers(self.item, [corner(0), corner(1), corner(2)]);
        let key = |place: usize| if self.is_perspective { traced.keys[place][triangle] } else { 1.0 };
        let keys = [key(0), key(1), key(2)];
        let slopes = traced.slopes.only(triangle);
        let mut planes = [Plane::default(); N];
        for (i, plane) in planes.iter_mut().enumerate() {
            let numbers = [top[i] * keys[0], middle[i] * keys[1], bottom[i] * keys[2]];
            let [a_column, a_row] = slopes.of(numbers);
            *plane = Plane { at_top: numbers[0], a_row, a_column };
        }
        planes
    }
}
