//! Triangles whose corners stand in a table that faces share, drawn without lists of edges.
//!
//! Most faces of large scenes are small triangles. Of such a one only the corners' rows are kept; where its
//! corners are, and what is interpolated between them, is looked up while it is drawn, the latter only if a
//! sample of it is seen.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8, f64x4, f64x8};

use super::polygons::{first_center, greater, lesser};
use super::spans::{Sink, Tag, Tile, lanes};

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

/// An edge as a function of the row.
#[derive(Clone, Copy, Default)]
struct Side {
    /// Its upper end.
    x: f64,
    y: f64,
    slope: f64,
}

impl Side {
    /// The very numbers of [`super::Scanner`], so that triangles and polygons share edges exactly.
    #[inline(always)]
    fn new(top: &Point, bottom: &Point) -> Self {
        let per_row = 1.0 / (bottom.y - top.y);
        Self { x: top.x, y: top.y, slope: (bottom.x - top.x) * per_row }
    }

    /// Where the middles of rows cross it.
    #[inline(always)]
    fn at<S: Simd>(&self, centers: f64x8<S>) -> f64x8<S> {
        (centers - self.y) * self.slope + self.x
    }
}

/// What turns numbers at three corners into planes over the picture, measured from the highest corner.
#[derive(Clone, Copy)]
struct Slopes {
    /// The two other corners from the highest.
    sides: [[f64; 2]; 2],
    per_area: f64,
}

impl Slopes {
    #[inline(always)]
    fn new([top, middle, bottom]: [&Point; 3]) -> Self {
        let [p, q] = [[middle.x - top.x, middle.y - top.y], [bottom.x - top.x, bottom.y - top.y]];
        Self { sides: [p, q], per_area: 1.0 / (p[0] * q[1] - q[0] * p[1]) }
    }

    /// Change a column and a row of what is `top`, `middle` and `bottom` at the corners.
    #[inline(always)]
    fn of(&self, [top, middle, bottom]: [f64; 3]) -> [f64; 2] {
        let ([p, q], [u, v]) = (self.sides, [middle - top, bottom - top]);
        [(u * q[1] - v * p[1]) * self.per_area, (v * p[0] - u * q[0]) * self.per_area]
    }
}

/// The planes of all numbers, found when they are asked for.
pub struct Planes<const N: usize, F> {
    find: F,
    is_found: bool,
    all: [Plane; N],
}

/// A number over the picture, multiplied by the key in perspective.
#[derive(Clone, Copy, Default)]
pub struct Plane {
    at_top: f64,
    a_row: f64,
    pub a_column: f64,
}

impl Plane {
    /// The number at the column that the row is measured from.
    #[inline(always)]
    pub fn start(&self, line: &TriangleRow) -> f64 {
        self.at_top + line.down * self.a_row
    }
}

impl<const N: usize, F: Fn(&mut [Plane; N])> Planes<N, F> {
    #[inline(always)]
    pub fn get(&mut self) -> &[Plane; N] {
        if !self.is_found {
            (self.find)(&mut self.all);
            self.is_found = true;
        }
        &self.all
    }
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

/// Samples of a row that are computed together.
pub const LANES: usize = 8;

/// Rows that are computed together.
const ROWS: usize = 8;

/// 0, 1, 2, 3: places of lanes.
const STEPS: [f64; 4] = [0.0, 1.0, 2.0, 3.0];

/// The outline of a triangle.
#[derive(Clone, Copy, Default)]
struct Outline {
    long: Side,
    /// Above and below the knee.
    short: [Side; 2],
    knee: u32,
}

/// For some rows the first sample, and one past the last.
type Spans = [[i32; ROWS]; 2];

impl Outline {
    #[inline(always)] // As all of a triangle: see `Shapes::draw`.
    fn new([top, middle, bottom]: [&Point; 3], knee: u32) -> Self {
        Self {
            long: Side::new(top, bottom),
            short: [Side::new(top, middle), Side::new(middle, bottom)],
            knee,
        }
    }

    /// The samples in rows from `row` on, in columns from `start` on; and whether there are any above `end_row`.
    #[inline(always)]
    fn spans<S: Simd>(&self, simd: S, [row, end_row]: [u32; 2], [start, end]: [u32; 2]) -> (Spans, bool) {
        let [upper, lower] = &self.short;
        let steps: f64x4<S> = STEPS.simd_into(simd);
        let centers = simd.combine_f64x4(steps, steps + 4.0) + (f64::from(row) + 0.5);
        // No `map` here: what it calls would not be compiled into this.
        let (a, upper, lower) = (self.long.at(centers), upper.at(centers), lower.at(centers));
        let is_upper = centers.simd_lt(f64x8::splat(simd, f64::from(self.knee)));
        let b = is_upper.select(upper, lower);
        let is_first = a.simd_gt(b);
        let columns = (f64x8::splat(simd, f64::from(start)), f64x8::splat(simd, f64::from(end)));
        let first = first_columns(is_first.select(b, a), columns);
        let end = first_columns(is_first.select(a, b), columns);
        let is_row = centers.simd_lt(f64x8::splat(simd, f64::from(end_row)));
        let has_samples = (first.simd_lt(end) & is_row).any_true();
        // Whole numbers below 2²⁴ stay what they are.
        let (first, end) = simd.cvt_i32_f32x16(simd.narrow_f64x8(first, end)).split();
        ([first.into(), end.into()], has_samples)
    }
}

/// The first centres at or behind places, in some columns.
#[inline(always)]
fn first_columns<S: Simd>(places: f64x8<S>, (start, end): (f64x8<S>, f64x8<S>)) -> f64x8<S> {
    (places - 0.5).ceil().max(start).min(end)
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
        let mut planes = Planes { find, is_found: false, all: [Plane::default(); N] };
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

impl<const N: usize, T: Tag> Tile<N, T> {
    /// Draws a row of a triangle where the depth test lets it. `planes`: of the numbers to interpolate.
    #[inline(always)]
    pub fn draw_line<S: Simd>(
        &mut self,
        simd: S,
        line: &TriangleRow,
        is_perspective: bool,
        tag: T,
        planes: &mut Planes<N, impl Fn(&mut [Plane; N])>,
    ) {
        let [first, end] = line.columns;
        let steps: f64x4<S> = STEPS.simd_into(simd);
        let places = simd.narrow_f64x4(steps, steps + 4.0);
        for column in (first..end).step_by(LANES) {
            let first = self.samples(line.row, column, column).start;
            let nearest_keys = lanes(&mut self.keys, first);
            // Columns are whole numbers and exact, so the answer does not depend on where a tile starts.
            let across = steps + (f64::from(column) + 0.5);
            let across = (across - line.from, across + 4.0 - line.from);
            let keys = (line.keys(across.0), line.keys(across.1));
            let (key, nearest) = (simd.narrow_f64x4(keys.0, keys.1), f32x8::from_slice(simd, nearest_keys));
            let is_seen = key.simd_gt(nearest) & places.simd_lt(f32x8::splat(simd, (end - column) as f32));
            // Early depth: most of what is hidden ends here.
            if !is_seen.any_true() {
                continue;
            }
            is_seen.select(key, nearest).store_slice(nearest_keys);
            let one = f64x4::splat(simd, 1.0);
            let scale = if is_perspective { (one / keys.0, one / keys.1) } else { (one, one) };
            for (all, plane) in self.values.iter_mut().zip(planes.get()) {
                let (all, start, slope) = (lanes(all, first), plane.start(line), plane.a_column);
                // Double precision pays: where values do not change they stay the same bits.
                let a = (across.0 * slope + start) * scale.0;
                let b = (across.1 * slope + start) * scale.1;
                let (value, before) = (simd.narrow_f64x4(a, b), f32x8::from_slice(simd, all));
                is_seen.select(value, before).store_slice(all);
            }
            if T::IS_KEPT {
                for (lane, tag_here) in lanes(&mut self.tags, first).iter_mut().enumerate() {
                    *tag_here = if is_seen.test(lane) { tag } else { *tag_here };
                }
            }
        }
    }
}

/// A row of a triangle.
#[derive(Clone, Copy, Debug)]
pub struct TriangleRow {
    /// Of samples.
    pub row: u32,
    /// The first, and one past the last, in the columns of the sink.
    pub columns: [u32; 2],
    /// The column that the key, and the numbers to interpolate, are measured from.
    pub from: f64,
    /// How far it is below the highest corner.
    down: f64,
    key: f64,
    key_a_column: f64,
}

impl TriangleRow {
    /// Depth keys at places, measured from where they are measured from.
    #[inline(always)]
    fn keys<S: Simd>(&self, across: f64x4<S>) -> f64x4<S> {
        across * self.key_a_column + self.key
    }

    /// The depth key at a column.
    #[inline]
    pub fn key_at(&self, column: f64) -> f64 {
        self.key + (column - self.from) * self.key_a_column
    }
}
