//! Layers of polygons and triangles, drawn into tiles or as transparent fragments.

use std::ops::Range;
use std::sync::Arc;

use fearless_simd::Level;

use crate::edges::{Crossing, Scanner};
use crate::grid::SampleGrid;
use crate::polygons::{PolygonList, ScreenPoint, ShapeRef, first_center};
use crate::rows::draw_block;
use crate::tile::{Area, Tile};
use crate::triangles::{BlockSetup, LazyPlanes, Plane, TriangleQueue, TriangleValues};

/// Opaque surfaces that are drawn tile by tile. They carry N interpolated values.
pub trait OpaqueLayer<const N: usize>: Sync {
    /// Draws what the layer has in a band into a tile of that band.
    fn draw(&self, grid: &SampleGrid, band: usize, scanner: &mut Scanner<N>, tile: &mut Tile<N>);

    /// For each item, also of transparent layers, the number of the plane that it shares with
    /// others, or 0. Of items in one plane that overlap the one with the lowest number is visible,
    /// whatever their keys. Empty if no planes are shared.
    fn planes(&self) -> Arc<[u32]> {
        Arc::default()
    }
}

/// The corners that triangles share, by row.
pub trait CornerTable<const N: usize>: Sync {
    /// The position of a corner.
    fn point(&self, corner: u32) -> ScreenPoint;

    /// The values to interpolate between three corners of an item, as they are on the surface (in
    /// perspective they are not yet multiplied by the key).
    fn values(&self, item: u32, corners: [u32; 3]) -> [[f64; N]; 3];
}

/// The table of lists that have no triangles: its corners are nowhere.
#[derive(Clone, Copy, Debug)]
pub struct NoTriangles;

impl<const N: usize> CornerTable<N> for NoTriangles {
    fn point(&self, _corner: u32) -> ScreenPoint {
        ScreenPoint { x: f64::NAN, y: f64::NAN, key: f64::NAN }
    }

    fn values(&self, _item: u32, _corners: [u32; 3]) -> [[f64; N]; 3] {
        [[0.0; N]; 3]
    }
}

/// Lists of shapes, drawn in this order. Each list has been sorted into the bands of the grid.
pub struct PolygonLayer<'a, const N: usize, C: ?Sized> {
    /// Polygons and triangles.
    pub lists: &'a [PolygonList<N>],
    /// The corners of the triangles.
    pub corners: &'a C,
}

impl<const N: usize, C: CornerTable<N> + ?Sized> OpaqueLayer<N> for PolygonLayer<'_, N, C> {
    fn draw(&self, grid: &SampleGrid, band: usize, scanner: &mut Scanner<N>, tile: &mut Tile<N>) {
        self.draw_on(grid, band, scanner, tile);
    }
}

impl<const N: usize, C: CornerTable<N> + ?Sized> PolygonLayer<'_, N, C> {
    /// Draws what the layer has in a band: into a tile, or as transparent fragments.
    pub fn draw_on(
        &self,
        grid: &SampleGrid,
        band: usize,
        scanner: &mut Scanner<N>,
        target: &mut impl ShapeTarget<N>,
    ) {
        let level = Level::new();
        let Area { columns, rows } = target.area();
        let is_perspective = grid.is_perspective;
        let tile_columns = grid.tile_columns_of(columns);
        let values = Values::<N, C>(self.corners);
        let mut queue = TriangleQueue::default();
        let flush = |queue: &mut TriangleQueue, target: &mut _| {
            let draw = |block: &BlockSetup<'_>| draw_triangles(target, level, block, &values);
            queue.flush(level, rows, columns, is_perspective, draw);
        };
        for (item, shape) in self.lists.iter().flat_map(|list| list.in_tiles(band, tile_columns)) {
            match shape {
                ShapeRef::Triangle(corners) => {
                    let [a, b, c] = corners;
                    let points =
                        [self.corners.point(a), self.corners.point(b), self.corners.point(c)];
                    if queue.push(item, corners, points) {
                        flush(&mut queue, target);
                    }
                }
                ShapeRef::Polygon(contours) => {
                    // Ties between keys go to the first drawn, so the order must stay.
                    flush(&mut queue, target);
                    scanner.scan(contours, rows[0], rows[1], |row, left, right| {
                        target.draw_span(row, left, right, is_perspective, item);
                    });
                }
            }
        }
        flush(&mut queue, target);
    }
}

/// Draws a block of triangles with N values.
fn draw_triangles<const N: usize>(
    target: &mut impl ShapeTarget<N>,
    level: Level,
    block: &BlockSetup<'_>,
    values: &dyn TriangleValues,
) {
    let (mut at_corners, mut planes) = ([[0.0; 3]; N], [Plane::default(); N]);
    target.draw_block(level, block, &mut LazyPlanes::new(values, &mut at_corners, &mut planes));
}

/// The values of a table, for the loops that are compiled once.
struct Values<'a, const N: usize, C: ?Sized>(&'a C);

impl<const N: usize, C: CornerTable<N> + ?Sized> TriangleValues for Values<'_, N, C> {
    fn write(&self, item: u32, corners: [u32; 3], values: &mut [[f64; 3]]) {
        let [a, b, c] = self.0.values(item, corners);
        for (i, value) in values.iter_mut().enumerate().take(N) {
            *value = [a[i], b[i], c[i]];
        }
    }
}

/// Receives the samples of shapes.
pub trait ShapeTarget<const N: usize> {
    /// The samples to be drawn.
    fn area(&self) -> Area;

    /// Draws samples of a row. `sample` receives the column of each and the key of the nearest
    /// occluder; it returns key and values of a surface in front of that.
    fn draw_each(
        &mut self,
        row: u32,
        columns: Range<u32>,
        item: u32,
        sample: impl FnMut(u32, f32) -> Option<(f32, [f32; N])>,
    );

    /// Draws a block of triangles.
    fn draw_block(&mut self, level: Level, block: &BlockSetup<'_>, planes: &mut LazyPlanes<'_>);

    /// Draws the samples of a row with left ≤ x < right where the depth test passes.
    ///
    /// Keys and values are linear between the two ends. In perspective the values are multiplied
    /// by the key, and are divided by it here.
    #[inline]
    fn draw_span(
        &mut self,
        row: u32,
        left: &Crossing<N>,
        right: &Crossing<N>,
        is_perspective: bool,
        item: u32,
    ) {
        let [start, end] = self.area().columns;
        let columns = first_center(left.x, end).max(start)..first_center(right.x, end);
        if columns.is_empty() {
            return;
        }
        let per_column = 1.0 / (right.x - left.x);
        let key_slope = (right.key - left.key) * per_column;
        let slopes: [f64; N] =
            std::array::from_fn(|i| (right.values[i] - left.values[i]) * per_column);
        self.draw_each(row, columns, item, |column, occluder_key| {
            // From the left end and never from the sample before: the result must not depend on
            // where a tile starts.
            let across = f64::from(column) + 0.5 - left.x;
            let key = left.key + across * key_slope;
            if key as f32 <= occluder_key {
                return None;
            }
            let scale = if is_perspective { 1.0 / key } else { 1.0 };
            let value = |i: usize| ((left.values[i] + across * slopes[i]) * scale) as f32;
            Some((key as f32, std::array::from_fn(value)))
        });
    }
}

impl<const N: usize> ShapeTarget<N> for Tile<N> {
    fn area(&self) -> Area {
        self.area()
    }

    #[inline]
    fn draw_each(
        &mut self,
        row: u32,
        columns: Range<u32>,
        item: u32,
        mut sample: impl FnMut(u32, f32) -> Option<(f32, [f32; N])>,
    ) {
        let mut part = self.part(row, &columns);
        for (idx, column) in columns.enumerate() {
            if part.is_in_plane_of(idx, item) {
                continue;
            }
            if let Some((key, values)) = sample(column, part.keys[idx]) {
                part.set(idx, key, values, item);
            }
        }
    }

    fn draw_block(&mut self, level: Level, block: &BlockSetup<'_>, planes: &mut LazyPlanes<'_>) {
        draw_block(level, block, self.samples(), planes);
    }
}
