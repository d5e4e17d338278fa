//! Polygons and triangles in buffers, sorted into bands.

use std::ops::Range;

use crate::bins::Bins;
use crate::grid::SampleGrid;

/// A corner of a triangle in the picture plane, without interpolated values; see [`Corner`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ScreenPoint {
    /// Column, in samples from the left edge of the picture.
    pub x: f64,
    /// Row, in samples from the upper edge.
    pub y: f64,
    /// Depth key, larger is nearer. In perspective it is positive: 1/distance.
    pub key: f64,
}

impl ScreenPoint {
    /// True if no number is NaN or infinite.
    #[inline]
    pub fn is_finite(&self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.key.is_finite()
    }
}

/// A corner of a polygon in the picture plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner<const N: usize> {
    /// Column, in samples from the left edge of the picture.
    pub x: f64,
    /// Row, in samples from the upper edge.
    pub y: f64,
    /// Depth key, larger is nearer. In perspective it is positive: 1/distance.
    pub key: f64,
    /// The values to interpolate, multiplied by the key in perspective.
    pub values: [f64; N],
}

/// Shapes in drawing order: polygons with all their corners in one buffer, and triangles whose
/// corners are rows of a [`crate::CornerTable`].
#[derive(Clone, Debug, Default)]
pub struct PolygonList<const N: usize> {
    corners: Vec<Corner<N>>,
    contour_ends: Vec<u32>,
    /// Contours of complete polygons.
    n_contours: u32,
    shapes: Vec<Shape>,
    /// The bands that each shape may touch; empty after sorting.
    bands: Vec<Range<u32>>,
    bins: Bins,
}

/// A shape in the list.
#[derive(Clone, Debug)]
struct Shape {
    /// The item it belongs to, given by the caller.
    item: u32,
    /// The first and the last column of tiles that it may touch.
    tile_columns: [u16; 2],
    outline: Outline,
}

#[derive(Clone, Debug)]
enum Outline {
    /// Its contours, by index.
    Contours(Range<u32>),
    /// Its corners, as rows of the table.
    Triangle([u32; 3]),
}

/// The tiles that a shape may touch.
#[derive(Clone, Debug)]
pub struct TilePlace {
    /// Its bands; not empty.
    pub bands: Range<u32>,
    /// The first and the last column of tiles. Those beyond 2¹⁶ count as one.
    pub columns: [u16; 2],
}

/// A shape of a [`PolygonList`].
pub enum ShapeRef<C> {
    /// Its contours.
    Polygon(C),
    /// Its corners, as rows of the [`crate::CornerTable`].
    Triangle([u32; 3]),
}

impl<const N: usize> PolygonList<N> {
    /// An empty list with room for this many shapes.
    pub fn with_capacity(shapes: usize) -> Self {
        Self {
            shapes: Vec::with_capacity(shapes),
            bands: Vec::with_capacity(shapes),
            ..Self::default()
        }
    }

    /// Adds a corner to the contour being built.
    pub fn push_corner(&mut self, corner: Corner<N>) {
        self.corners.push(corner);
    }

    /// Ends the contour.
    pub fn end_contour(&mut self) {
        self.contour_ends.push(index(self.corners.len()));
    }

    /// Makes a polygon of all contours since the last one. It is dropped if it is not finite or
    /// cannot contain a sample. Returns true if it touches the picture, even if only between
    /// samples. `item`: any number, by which the caller knows what the polygon belongs to.
    pub fn end_polygon(&mut self, grid: &SampleGrid, item: u32) -> bool {
        let first_corner = self.contour_start(self.n_contours);
        let corners = &self.corners[first_corner..];
        let bounds = Bounds::new(corners.iter().map(|corner| [corner.x, corner.y]));
        let rows = corners.iter().all(is_finite).then(|| bounds.rows(grid)).flatten();
        if let Some(rows) = rows.clone().filter(|rows| !rows.is_empty()) {
            let contours = self.n_contours..index(self.contour_ends.len());
            self.n_contours = contours.end;
            let place =
                TilePlace { bands: grid.bands().of(&rows), columns: bounds.tile_columns(grid) };
            self.push(item, Outline::Contours(contours), place);
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

    /// Adds a triangle that may touch these tiles.
    #[inline]
    pub fn push_triangle(&mut self, item: u32, corners: [u32; 3], place: TilePlace) {
        self.push(item, Outline::Triangle(corners), place);
    }

    #[inline]
    fn push(&mut self, item: u32, outline: Outline, place: TilePlace) {
        self.shapes.push(Shape { item, tile_columns: place.columns, outline });
        self.bands.push(place.bands);
    }

    /// True if the list contains no shape.
    pub fn is_empty(&self) -> bool {
        self.shapes.is_empty()
    }

    /// Sorts the shapes into the bands of the grid. Call it once, after the last shape.
    pub fn sort_into_bands(&mut self, grid: &SampleGrid) {
        self.bins = Bins::new(grid, std::mem::take(&mut self.bands).iter().cloned());
        self.shapes.shrink_to_fit();
    }

    /// The shapes that may touch the tiles of a band from one column to another, each with its
    /// item.
    pub fn in_tiles(
        &self,
        band: usize,
        [first, last]: [u16; 2],
    ) -> impl Iterator<Item = (u32, ShapeRef<impl Iterator<Item = &[Corner<N>]>>)> {
        let shapes = self.bins.in_band(band).iter().map(|&shape| &self.shapes[shape as usize]);
        shapes
            .filter(move |Shape { tile_columns: [start, end], .. }| *start <= last && first <= *end)
            .map(|shape| self.shape(shape))
    }

    /// All shapes in drawing order, each with its item.
    pub fn shapes(
        &self,
    ) -> impl Iterator<Item = (u32, ShapeRef<impl Iterator<Item = &[Corner<N>]>>)> {
        self.shapes.iter().map(|shape| self.shape(shape))
    }

    fn shape(
        &self,
        shape: &Shape,
    ) -> (u32, ShapeRef<impl Iterator<Item = &[Corner<N>]> + use<'_, N>>) {
        let outline = match &shape.outline {
            Outline::Triangle(corners) => ShapeRef::Triangle(*corners),
            Outline::Contours(contours) => ShapeRef::Polygon(contours.clone().map(|contour| {
                &self.corners
                    [self.contour_start(contour)..self.contour_ends[contour as usize] as usize]
            })),
        };
        (shape.item, outline)
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

/// A bounding box, in samples.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    columns: [f64; 2],
    rows: [f64; 2],
}

/// The lesser of two numbers; returns `b` if either is NaN. One instruction, where `f64::min` takes
/// several.
#[inline(always)] // Into loops that are compiled for several instruction sets.
pub fn lesser<T: PartialOrd>(a: T, b: T) -> T {
    if a < b { a } else { b }
}

/// The greater of two numbers; returns `b` if either is NaN.
#[inline(always)] // As `lesser`.
pub fn greater<T: PartialOrd>(a: T, b: T) -> T {
    if a > b { a } else { b }
}

/// How far rounding may move the crossing of an edge with a row beyond the ends of the edge, in
/// samples. Where it matters coordinates are below 2¹⁹, so the error is below 2⁻³².
pub const ROUNDING: f64 = 1e-6;

impl Bounds {
    /// The bounding box of some places, each a column and a row.
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
    pub fn is_in_picture(&self, grid: &SampleGrid) -> bool {
        let ([left, right], [top, bottom]) = (self.columns, self.rows);
        let (columns, rows) = (f64::from(grid.sample_columns()), f64::from(grid.sample_rows()));
        (right > 0.0) & (left < columns) & (bottom > 0.0) & (top < rows)
    }

    /// The columns of tiles that the box may touch.
    pub(crate) fn tile_columns(&self, grid: &SampleGrid) -> [u16; 2] {
        let [left, right] = self.columns;
        let column = |place: f64| first_center(place, grid.sample_columns());
        grid.tile_columns_of([column(left - ROUNDING), column(right + ROUNDING)])
    }

    /// The rows of samples in the box, an empty range if no sample is in it. `None` if it does not
    /// touch the picture.
    #[inline]
    pub fn rows(&self, grid: &SampleGrid) -> Option<Range<u32>> {
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

/// Index of the first of `count` sample centres (½, 1½, …) at or beyond `place`.
#[inline]
pub fn first_center(place: f64, count: u32) -> u32 {
    // Rounds up by hand, because `ceil` is a call on processors without SSE4.1. The cast
    // saturates: places before the first sample, and NaN, become 0.
    let behind = place - 0.5;
    let below = behind as u32;
    below.saturating_add(u32::from(f64::from(below) < behind)).min(count)
}
