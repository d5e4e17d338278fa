//! Triangles whose corners stand in a table that faces share, drawn without lists of edges.
//!
//! Most faces of large scenes are small triangles. Of such a one only the corners' rows are kept; where its
//! corners are, and what is interpolated between them, is looked up while it is drawn, the latter only if a
//! sample of it is seen.

use fearless_simd::Simd;

use super::polygons::{first_center, greater, lesser};
use super::rows::TriangleRow;
use super::sides::{Outline, ROWS, Spans};
use super::slopes::{Plane, Planes, Slopes};
use super::spans::Sink;

/// A corner in the picture plane, without the numbers to interpolate; see [`super::Corner`].
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

/// Samples from the picture's corner within which planes are used.
const FAR: f64 = (1u32 << 24) as f64;

/// Twice the area over the square of the extent, below which a triangle is a sliver. The error of a plane at a
/// corner is some 2⁻⁵³ over this, relative to what the number changes in the triangle: below that of an f32.
const SLIVER: f64 = 1.0 / (1u32 << 26) as f64;

/// How much nearer one corner may be than another.
const MOST_KEY_RATIO: f64 = 16.0;

/// Twice the area, positive if the corners run counterclockwise as the picture is looked at.
#[inline]
pub fn twice_area([a, b, c]: &[Point; 3]) -> f64 {
    (b.y - a.y) * (c.x - a.x) - (b.x - a.x) * (c.y - a.y)
}

/// True if all numbers of a triangle can be had from planes through its corners, as precise as along its
/// edges: it is no sliver, not far outside the picture, and not much nearer at one corner than at another.
#[inline]
pub fn is_regular(corners: &[Point; 3], is_perspective: bool) -> bool {
    let [a, b, c] = corners;
    let [(left, right), (top, bottom)] = [range(a.x, b.x, c.x), range(a.y, b.y, c.y)];
    let (least, most) = range(a.key, b.key, c.key);
    let extent = greater(right - left, bottom - top);
    let is_near = (-FAR <= lesser(left, top)) & (greater(right, bottom) <= FAR);
    let is_even = !is_perspective | ((0.0 < least) & (most <= MOST_KEY_RATIO * least));
    // What is no number is in no sum that is greater than anything.
    let is_number = a.key + b.key + c.key > f64::NEG_INFINITY;
    is_near & is_even & is_number & (twice_area(corners).abs() > SLIVER * extent * extent)
}

/// The least and the greatest of three numbers.
#[inline]
fn range(p: f64, q: f64, r: f64) -> (f64, f64) {
    (lesser(lesser(p, q), r), greater(greater(p, q), r))
}

/// The corners' places in a triangle, the highest first.
#[inline(always)]
fn by_row(corners: &[Point; 3]) -> [usize; 3] {
    let [mut top, mut middle, mut bottom] = [0, 1, 2];
    // Chosen and not branched to: nobody can tell beforehand which way a triangle lies.
    for (upper, lower) in [(0, 1), (1, 2), (0, 1)] {
        let order = [top, middle, bottom];
        let (i, j) = (order[upper], order[lower]);
        let is_wrong = corners[j].y < corners[i].y;
        let (i, j) = (if is_wrong { j } else { i }, if is_wrong { i } else { j });
        [top, middle, bottom] = if upper == 0 { [i, j, bottom] } else { [top, i, j] };
    }
    [top, middle, bottom]
}

/// A triangle whose outline is known.
#[derive(Clone, Copy, Default)]
struct Traced {
    item: u32,
    /// Rows of the table.
    corners: [u32; 3],
    points: [Point; 3],
    /// Its corners from above.
    order: [usize; 3],
    /// The first row of samples, and one past the last.
    rows: [u32; 2],
    outline: Outline,
    /// Of the first rows.
    spans: Spans,
}

/// Triangles that are traced before the first of them is drawn. How many rows and samples a triangle has is not to be
/// foreseen, so a processor often goes astray in the loops over them; meanwhile the outlines of the next are ready.
#[derive(Default)]
pub struct Traces {
    all: [Traced; AHEAD],
    n: usize,
}

/// How many they are.
const AHEAD: usize = 16;

impl Traces {
    /// Traces a [regular](is_regular) triangle in some rows and columns of samples. True if there is no room for another.
    #[inline(always)]
    pub fn push<S: Simd>(
        &mut self,
        simd: S,
        points: [Point; 3],
        item: u32,
        corners: [u32; 3],
        [first, end]: [u32; 2],
        columns: [u32; 2],
    ) -> bool {
        let order = by_row(&points);
        let sorted @ [top, middle, bottom] = [&points[order[0]], &points[order[1]], &points[order[2]]];
        let row_of = |corner: &Point| first_center(corner.y, end).max(first);
        let (first, knee, end) = (row_of(top), row_of(middle), row_of(bottom));
        let outline = Outline::new(sorted, knee);
        let rows = [first, end];
        let (spans, has_samples) = outline.spans(simd, rows, columns);
        self.all[self.n] = Traced { item, corners, points, order, rows, outline, spans };
        // Many small triangles lie between samples.
        self.n += usize::from(has_samples | (end - first > ROWS as u32));
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
        for traced in &self.all[..self.n] {
            traced.draw(simd, sink, is_perspective, table);
        }
        self.n = 0;
    }
}

impl Traced {
    #[inline(always)]
    fn draw<const N: usize, S: Simd>(
        &self,
        simd: S,
        sink: &mut impl Sink<N>,
        is_perspective: bool,
        table: &(impl Table<N> + ?Sized),
    ) {
        let Self { points, order, .. } = self;
        let sorted @ [top, middle, bottom] = [&points[order[0]], &points[order[1]], &points[order[2]]];
        let slopes = Slopes::new(sorted);
        let find = |planes: &mut [Plane; N]| {
            let mut numbers = table.numbers(self.item, self.corners);
            if is_perspective {
                for (numbers, corner) in numbers.iter_mut().zip(points) {
                    numbers.iter_mut().for_each(|number| *number *= corner.key);
                }
            }
            for (i, plane) in planes.iter_mut().enumerate() {
                let [top, middle, bottom] = *order;
                let [a_column, a_row] = slopes.of([numbers[top][i], numbers[middle][i], numbers[bottom][i]]);
                *plane = Plane { at_top: numbers[top][i], a_row, a_column };
            }
        };
        let mut planes = Planes::new(find);
        let [key_a_column, key_a_row] = slopes.of([top.key, middle.key, bottom.key]);
        let ([first, end], columns) = (self.rows, sink.columns());
        let mut spans = self.spans;
        for first in (first..end).step_by(ROWS) {
            if first > self.rows[0] {
                (spans, _) = self.outline.spans(simd, [first, end], columns);
            }
            let [starts, ends] = &spans;
            for ((row, &start), &end) in (first..end).zip(starts).zip(ends) {
                if start >= end {
                    continue;
                }
                let down = f64::from(row) + 0.5 - top.y;
                let line = TriangleRow {
                    row,
                    columns: [start as u32, end as u32],
                    from: top.x,
                    down,
                    key: top.key + down * key_a_row,
                    key_a_column,
                };
                sink.draw_line(simd, &line, is_perspective, self.item, &mut planes);
            }
        }
    }
}
