//! Triangles whose corners stand in a table that faces share, drawn without lists of edges.
//!
//! Most faces of large scenes are small triangles. Of such a one only the corners' rows are kept; where its
//! corners are, and what is interpolated between them, is looked up while it is drawn, the latter only if a
//! sample of it is seen.

use super::polygons::first_center;
use super::spans::{Sink, Tag, Tile};

/// A corner in the picture plane, without the numbers to interpolate; see [`super::Corner`].
#[derive(Clone, Copy, Debug, PartialEq)]
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
    let spread = |p: f64, q: f64, r: f64| p.max(q).max(r) - p.min(q).min(r);
    let extent = spread(a.x, b.x, c.x).max(spread(a.y, b.y, c.y));
    let is_near = corners.iter().all(|corner| corner.x.abs() <= FAR && corner.y.abs() <= FAR);
    let is_even = !is_perspective || {
        let (least, most) = (a.key.min(b.key).min(c.key), a.key.max(b.key).max(c.key));
        0.0 < least && most <= MOST_KEY_RATIO * least
    };
    is_near && is_even && twice_area(corners).abs() > SLIVER * extent * extent
}

/// An edge as a function of the row.
#[derive(Clone, Copy)]
struct Side {
    top: Point,
    slope: f64,
}

impl Side {
    /// The very numbers of [`super::Scanner`], so that triangles and polygons share edges exactly.
    #[inline]
    fn new(top: &Point, bottom: &Point) -> Self {
        let per_row = 1.0 / (bottom.y - top.y);
        Self { top: *top, slope: (bottom.x - top.x) * per_row }
    }

    #[inline]
    fn at_row(&self, row: u32) -> f64 {
        let down = f64::from(row) + 0.5 - self.top.y;
        self.top.x + down * self.slope
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
    #[inline]
    fn new([top, middle, bottom]: &[Point; 3]) -> Self {
        let [p, q] = [[middle.x - top.x, middle.y - top.y], [bottom.x - top.x, bottom.y - top.y]];
        Self { sides: [p, q], per_area: 1.0 / (p[0] * q[1] - q[0] * p[1]) }
    }

    /// Change a column and a row of what is `top`, `middle` and `bottom` at the corners.
    #[inline]
    fn of(&self, [top, middle, bottom]: [f64; 3]) -> [f64; 2] {
        let ([p, q], [u, v]) = (self.sides, [middle - top, bottom - top]);
        [(u * q[1] - v * p[1]) * self.per_area, (v * p[0] - u * q[0]) * self.per_area]
    }
}

/// The planes of all numbers.
#[derive(Clone, Copy)]
struct Planes<const N: usize> {
    at_top: [f64; N],
    a_column: [f64; N],
    a_row: [f64; N],
}

impl<const N: usize> Planes<N> {
    /// `numbers`: at the corners, multiplied by the key in perspective.
    #[inline]
    fn new(slopes: &Slopes, [top, middle, bottom]: &[[f64; N]; 3]) -> Self {
        let both: [[f64; 2]; N] = std::array::from_fn(|i| slopes.of([top[i], middle[i], bottom[i]]));
        Self { at_top: *top, a_column: both.map(|[across, _]| across), a_row: both.map(|[_, down]| down) }
    }
}

/// The corners' places in a triangle, the highest first.
#[inline]
fn by_row([a, b, c]: &[Point; 3]) -> [usize; 3] {
    let mut order = [0, 1, 2];
    let mut rows = [a.y, b.y, c.y];
    for (i, j) in [(0, 1), (1, 2), (0, 1)] {
        if rows[j] < rows[i] {
            rows.swap(i, j);
            order.swap(i, j);
        }
    }
    order
}

/// Draws the rows of a [regular](is_regular) triangle. `numbers`: to interpolate between the corners, as they are at
/// the surface; asked for only if something is seen.
#[inline]
pub fn draw_triangle<const N: usize>(
    sink: &mut impl Sink<N>,
    corners: &[Point; 3],
    is_perspective: bool,
    item: u32,
    numbers: impl Fn() -> [[f64; N]; 3],
) {
    let order = by_row(corners);
    let sorted @ [top, middle, bottom] = order.map(|corner| corners[corner]);
    let [first, end] = sink.rows();
    let [first, knee, end] = [&top, &middle, &bottom].map(|corner| first_center(corner.y, end).max(first));
    if first == end {
        return;
    }
    let slopes = Slopes::new(&sorted);
    let [key_a_column, key_a_row] = slopes.of(sorted.map(|corner| corner.key));
    let mut planes = None;
    let mut planes = || {
        *planes.get_or_insert_with(|| {
            let numbers = numbers();
            let scale = |corner: usize| if is_perspective { corners[corner].key } else { 1.0 };
            Planes::new(&slopes, &order.map(|corner| numbers[corner].map(|number| number * scale(corner))))
        })
    };
    let long = Side::new(&top, &bottom);
    for (rows, ends) in [(first..knee, [&top, &middle]), (knee..end, [&middle, &bottom])] {
        if rows.is_empty() {
            continue;
        }
        let short = Side::new(ends[0], ends[1]);
        for row in rows {
            let (a, b) = (long.at_row(row), short.at_row(row));
            let down = f64::from(row) + 0.5 - top.y;
            let line = TriangleRow {
                row,
                ends: if a > b { [b, a] } else { [a, b] },
                from: top.x,
                key: top.key + down * key_a_row,
                key_a_column,
            };
            sink.draw_line(&line, is_perspective, item, || {
                let Planes { at_top, a_column, a_row } = planes();
                (std::array::from_fn(|i| at_top[i] + down * a_row[i]), a_column)
            });
        }
    }
}

impl<const N: usize, T: Tag> Tile<N, T> {
    /// Draws a row of a triangle where the depth test lets it. `numbers`: at the column the row is measured from, and
    /// their change a column.
    #[inline]
    pub fn draw_line(
        &mut self,
        line: &TriangleRow,
        is_perspective: bool,
        tag: T,
        numbers: impl FnOnce() -> ([f64; N], [f64; N]),
    ) {
        let columns = self.columns();
        let first = first_center(line.ends[0], columns[1]).max(columns[0]);
        let end = first_center(line.ends[1], columns[1]);
        if first >= end {
            return;
        }
        let mut part = self.part(line.row, first, end);
        // Early depth: most of what is hidden ends here. Columns are whole numbers and exact, so the
        // answer does not depend on where a tile starts.
        let mut column = f64::from(first) + 0.5;
        let Some(n_hidden) = part.keys.iter().position(|nearest| {
            let is_seen = line.key_at(column) as f32 > *nearest;
            column += 1.0;
            is_seen
        }) else {
            return;
        };
        part.skip(n_hidden);
        column -= 1.0;
        let (start, slope) = numbers();
        for ((nearest, values), tag_here) in part.keys.iter_mut().zip(part.values).zip(part.tags) {
            let key = line.key_at(column);
            if key as f32 > *nearest {
                *nearest = key as f32;
                *tag_here = tag;
                let scale = if is_perspective { 1.0 / key } else { 1.0 };
                let across = column - line.from;
                // Double precision pays: where values do not change they stay the same bits, and
                // the resolver shades them once.
                *values = std::array::from_fn(|i| ((start[i] + across * slope[i]) * scale) as f32);
            }
            column += 1.0;
        }
    }
}

/// A row of a triangle.
#[derive(Clone, Copy, Debug)]
pub struct TriangleRow {
    /// Of samples.
    pub row: u32,
    /// Where the outline crosses the row.
    pub ends: [f64; 2],
    /// The column that the key, and the numbers to interpolate, are measured from.
    pub from: f64,
    key: f64,
    key_a_column: f64,
}

impl TriangleRow {
    /// The depth key at a column.
    #[inline]
    pub fn key_at(&self, column: f64) -> f64 {
        self.key + (column - self.from) * self.key_a_column
    }
}
