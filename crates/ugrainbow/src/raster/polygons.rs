//! Polygons in buffers, sorted into bands.

use std::ops::Range;

use super::band::Grid;
use super::bins::Bins;

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

/// Polygons in drawing order, all corners in one buffer.
#[derive(Clone, Debug, Default)]
pub struct PolygonList<const N: usize> {
    corners: Vec<Corner<N>>,
    contour_ends: Vec<u32>,
    polygons: Vec<Polygon>,
    bins: Bins,
}

/// A polygon: its contours, the rows of samples it may touch, and what of the scene it is.
#[derive(Clone, Debug)]
struct Polygon {
    contours: Range<u32>,
    rows: Range<u32>,
    item: u32,
}

impl<const N: usize> PolygonList<N> {
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
        let first_contour = self.polygons.last().map_or(0, |polygon| polygon.contours.end);
        let first_corner = self.contour_start(first_contour);
        let rows = sample_rows(&self.corners[first_corner..], grid);
        let is_in_picture = rows.is_some();
        if let Some(rows) = rows.filter(|rows| !rows.is_empty()) {
            let contours = first_contour..index(self.contour_ends.len());
            self.polygons.push(Polygon { contours, rows, item });
        } else {
            self.corners.truncate(first_corner);
            self.contour_ends.truncate(first_contour as usize);
        }
        is_in_picture
    }

    /// True if no polygon stayed.
    pub fn is_empty(&self) -> bool {
        self.polygons.is_empty()
    }

    /// Sorts the polygons into the bands of the grid. To be called once, when all are in.
    pub fn sort_into_bands(&mut self, grid: &Grid) {
        self.bins = Bins::new(grid, self.polygons.iter().map(|polygon| &polygon.rows));
    }

    /// The polygons that touch a band, each as its item and its contours.
    pub fn in_band(&self, band: usize) -> impl Iterator<Item = (u32, impl Iterator<Item = &[Corner<N>]>)> {
        self.bins
            .in_band(band)
            .iter()
            .map(|&polygon| (self.polygons[polygon as usize].item, self.contours(polygon)))
    }

    /// All polygons in drawing order, each as its item and its contours.
    pub fn polygons(&self) -> impl Iterator<Item = (u32, impl Iterator<Item = &[Corner<N>]>)> {
        (0..).zip(&self.polygons).map(|(idx, polygon)| (polygon.item, self.contours(idx)))
    }

    fn contours(&self, polygon: u32) -> impl Iterator<Item = &[Corner<N>]> {
        self.polygons[polygon as usize].contours.clone().map(|contour| {
            &self.corners[self.contour_start(contour)..self.contour_ends[contour as usize] as usize]
        })
    }

    fn contour_start(&self, contour: u32) -> usize {
        contour.checked_sub(1).map_or(0, |before| self.contour_ends[before as usize] as usize)
    }
}

/// A list is built from a bounded number of faces, so its rows fit 32 bits.
fn index(idx: usize) -> u32 {
    u32::try_from(idx).expect("a polygon list has fewer than 2^32 corners")
}

/// The rows of samples between the highest and the lowest corner; `None` if the box round
/// the corners does not touch the picture, or if a corner is not finite.
fn sample_rows<const N: usize>(corners: &[Corner<N>], grid: &Grid) -> Option<Range<u32>> {
    let is_finite = |corner: &Corner<N>| {
        let numbers = [corner.x, corner.y, corner.key];
        numbers.iter().chain(&corner.values).all(|number| number.is_finite())
    };
    if !corners.iter().all(is_finite) {
        return None;
    }
    let range = |coordinate: fn(&Corner<N>) -> f64| {
        corners
            .iter()
            .map(coordinate)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)))
    };
    let (left, right) = range(|corner| corner.x);
    let (top, bottom) = range(|corner| corner.y);
    let (columns, rows) = (grid.sample_columns(), grid.sample_rows());
    let is_in_picture = right > 0.0 && left < f64::from(columns) && bottom > 0.0 && top < f64::from(rows);
    is_in_picture.then(|| first_center(top, rows)..first_center(bottom, rows))
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
