//! Polygons in buffers, sorted into bands.

use std::ops::Range;

use crate::band::Grid;
use crate::bins::Bins;

/// A corner in the picture plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner<const N: usize> {
    /// Column, in samples from the left edge of the picture.
    pub x: f64,
    /// Row, in samples from the upper edge.
    pub y: f64,
    /// Depth key, larger is nearer. In perspective it is positive: 1/distance.
    pub key: f64,
    /// The numbers to interpolate, multiplied by the key in perspective.
    pub values: [f64; N],
}

/// Shapes in drawing order: polygons with all their corners in one buffer, and triangles whose corners are in a
/// [`crate::Table`].
#[derive(Clone, Debug, Default)]
pub struct PolygonList<const N: usize> {
    corners: Vec<Corner<N>>,
    contour_ends: Vec<u32>,
    /// How many contours belong to polygons that have ended.
    n_contours: u32,
    shapes: Vec<Shape>,
    /// The bands that each shape may touch, until they are sorted.
    bands: Vec<Range<u32>>,
    bins: Bins,
}

/// What of the scene a shape is, and its corners.
#[derive(Clone, Debug)]
struct Shape {
    item: u32,
    outline: Outline,
}

#[derive(Clone, Debug)]
enum Outline {
    /// Rows of the contours.
    Contours(Range<u32>),
    /// Rows of the table.
    Triangle([u32; 3]),
}

/// A shape to be drawn.
pub enum Drawn<C> {
    /// Its contours.
    Polygon(C),
    /// The rows of its corners in the [`crate::Table`].
    Triangle([u32; 3]),
}

impl<const N: usize> PolygonList<N> {
    /// An empty list with room for some shapes.
    pub fn with_capacity(shapes: usize) -> Self {
        Self { shapes: Vec::with_capacity(shapes), bands: Vec::with_capacity(shapes), ..Self::default() }
    }

    /// Adds a corner to the contour being built.
    pub fn push_corner(&mut self, corner: Corner<N>) {
        self.corners.push(corner);
    }

    /// Ends the contour.
    pub fn end_contour(&mut self) {
        self.contour_ends.push(index(self.corners.len()));
    }

    /// Ends the polygon: all contours since the last one. It is dropped if no sample can lie
    /// in it. The answer says whether it is in the picture, if only between samples. `item`: any number, to
    /// tell whose it is.
    pub fn end_polygon(&mut self, grid: &Grid, item: u32) -> bool {
        let first_corner = self.contour_start(self.n_contours);
        let corners = &self.corners[first_corner..];
        let rows = if corners.iter().all(is_finite) {
            Bounds::new(corners.iter().map(|corner| [corner.x, corner.y])).rows(grid)
        } else {
            None
        };
        if let Some(rows) = rows.clone().filter(|rows| !rows.is_empty()) {
            let contours = self.n_contours..index(self.contour_ends.len());
            self.n_contours = contours.end;
            self.push(item, Outline::Contours(contours), grid.bands().of(&rows));
        } else {
            self.drop_contours();
        }
        rows.is_some()
    }

    /// Drops all contours since the last polygon.
    pub fn drop_contours(&mut self) {
        self.corners.truncate(self.contour_start(self.n_contours));
        self.contour_ends.truncate(self.n_contours as usize);
    }

    /// Adds a triangle that may touch these bands; they are not none.
    #[inline]
    pub fn push_triangle(&mut self, item: u32, corners: [u32; 3], bands: Range<u32>) {
        self.push(item, Outline::Triangle(corners), bands);
    }

    #[inline]
    fn push(&mut self, item: u32, outline: Outline, bands: Range<u32>) {
        self.shapes.push(Shape { item, outline });
        self.bands.push(bands);
    }

    /// True if no shape stayed.
    pub fn is_empty(&self) -> bool {
        self.shapes.is_empty()
    }

    /// Sorts the shapes into the bands of the grid. To be called once, when all are in.
    pub fn sort_into_bands(&mut self, grid: &Grid) {
        self.bins = Bins::new(grid, std::mem::take(&mut self.bands).iter().cloned());
        self.shapes.shrink_to_fit();
    }

    /// The shapes that touch a band, each with its item.
    pub fn in_band(
        &self,
        band: usize,
    ) -> impl Iterator<Item = (u32, Drawn<impl Iterator<Item = &[Corner<N>]>>)> {
        self.bins.in_band(band).iter().map(|&shape| self.drawn(&self.shapes[shape as usize]))
    }

    /// All shapes in drawing order, each with its item.
    pub fn shapes(&self) -> impl Iterator<Item = (u32, Drawn<impl Iterator<Item = &[Corner<N>]>>)> {
        self.shapes.iter().map(|shape| self.drawn(shape))
    }

    fn drawn(&self, shape: &Shape) -> (u32, Drawn<impl Iterator<Item = &[Corner<N>]> + use<'_, N>>) {
        let drawn = match &shape.outline {
            Outline::Triangle(corners) => Drawn::Triangle(*corners),
            Outline::Contours(contours) => Drawn::Polygon(contours.clone().map(|contour| {
                &self.corners[self.contour_start(contour)..self.contour_ends[contour as usize] as usize]
            })),
        };
        (shape.item, drawn)
    }

    fn contour_start(&self, contour: u32) -> usize {
        contour.checked_sub(1).map_or(0, |before| self.contour_ends[before as usize] as usize)
    }
}

/// A list is built from a bounded number of faces, so its rows fit 32 bits.
fn index(idx: usize) -> u32 {
    u32::try_from(idx).expect("a polygon list has fewer than 2^32 corners")
}

fn is_finite<const N: usize>(corner: &Corner<N>) -> bool {
    let numbers = [corner.x, corner.y, corner.key];
    numbers.iter().chain(&corner.values).all(|number| number.is_finite())
}

/// The box round some corners, in samples.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    columns: [f64; 2],
    rows: [f64; 2],
}

/// The lesser of two numbers, the second if one is none: one instruction, where `f64::min` is several.
#[inline(always)] // Into loops that are compiled for several families of processors.
pub fn lesser<T: PartialOrd>(a: T, b: T) -> T {
    if a < b { a } else { b }
}

/// The greater of two numbers, the second if one is none.
#[inline(always)]
pub fn greater<T: PartialOrd>(a: T, b: T) -> T {
    if a > b { a } else { b }
}

/// How far a crossing of an edge may be computed beside the corners, in samples. Coordinates where it matters are
/// below 2¹⁹, so it is no more than 2⁻³².
pub const ROUNDING: f64 = 1e-6;

impl Bounds {
    /// The box round these places.
    #[inline]
    pub fn new(places: impl Iterator<Item = [f64; 2]>) -> Self {
        let empty = [f64::INFINITY, f64::NEG_INFINITY];
        let with = |[low, high]: [f64; 2], place: f64| [lesser(place, low), greater(place, high)];
        places.fold(Self { columns: empty, rows: empty }, |bounds, [x, y]| Self {
            columns: with(bounds.columns, x),
            rows: with(bounds.rows, y),
        })
    }

    /// True if it touches the picture.
    #[inline]
    pub fn is_in_picture(&self, grid: &Grid) -> bool {
        let ([left, right], [top, bottom]) = (self.columns, self.rows);
        let (columns, rows) = (f64::from(grid.sample_columns()), f64::from(grid.sample_rows()));
        (right > 0.0) & (left < columns) & (bottom > 0.0) & (top < rows)
    }

    /// The rows of samples in the box, none if there is no sample in it; `None` if it does not touch the picture.
    #[inline]
    pub fn rows(&self, grid: &Grid) -> Option<Range<u32>> {
        let ([left, right], [top, bottom]) = (self.columns, self.rows);
        let (columns, rows) = (grid.sample_columns(), grid.sample_rows());
        let first = first_center(top, rows);
        let is_between_columns =
            || first_center(left - ROUNDING, columns) >= first_center(right + ROUNDING, columns);
        self.is_in_picture(grid).then(|| match first..first_center(bottom, rows) {
            rows if !rows.is_empty() && is_between_columns() => first..first,
            rows => rows,
        })
    }
}

/// The first of `count` sample centres, at ½, 1½ and so on, at or behind `place`.
#[inline]
pub fn first_center(place: f64, count: u32) -> u32 {
    // Rounds up by hand: on the oldest processors of the family `ceil` is a call. The cast
    // saturates: what lies before the first sample, and NaN, becomes 0.
    let behind = place - 0.5;
    let below = behind as u32;
    below.saturating_add(u32::from(f64::from(below) < behind)).min(count)
}
