//! The faces of a scene, drawn ray by ray.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;
use ugparse::Face;

use super::footprint::{Rect, footprint};
use super::frame::{Frame, frame_of, frames};
use super::look::Look;
use super::motion::Motion;
use super::outline::Outline;
use crate::config::Exact;
use crate::drawlist::Reach;
use crate::painter::Painter;
use crate::raster::{Bins, Grid, Layer, Scanner, Sink};
use crate::sheet::Pack;

/// Faces and the rays that meet them.
pub struct Faces<'a, const N: usize> {
    painter: Painter<'a>,
    motion: Motion<'a>,
    pack: Pack<N>,
    frames: Vec<Frame>,
    shapes: Vec<Shape>,
    bins: Bins,
    /// Keys of what is not clipped.
    keys: [f64; 2],
    /// How many faces came how far.
    pub reach: Reach,
}

/// A face that can be seen in the picture.
struct Shape {
    item: u32,
    /// Row in the frames.
    frame: usize,
    columns: Range<u32>,
    rows: Range<u32>,
    outline: Outline,
    look: Look,
}

impl<'a, const N: usize> Faces<'a, N> {
    /// The faces of a scene that `is_drawn` says.
    pub fn new(
        painter: Painter<'a>,
        exact: Exact,
        is_drawn: impl Fn(&Face) -> bool + Sync,
        pack: Pack<N>,
    ) -> Self {
        let motion = Motion::new(exact, painter.palette);
        let frames = frames(&painter);
        let built: Vec<Built> = (painter.scene.faces.par_iter().enumerate())
            .filter(|(_, face)| is_drawn(face))
            .map(|(row, face)| build(&painter, motion, &frames, row, face))
            .collect();
        let in_front = built.iter().filter(|built| !matches!(built, Built::Behind)).count();
        let shapes: Vec<Shape> = built.into_iter().filter_map(Built::shape).collect();
        let reach = Reach { in_front, in_picture: shapes.len() };
        let bins = Bins::new(painter.grid, shapes.iter().map(|shape| &shape.rows));
        let slab = painter.view.slab;
        let keys = [1.0 / slab.far, 1.0 / slab.near];
        Self { painter, motion, pack, frames, shapes, bins, keys, reach }
    }

    /// True if a face is nearer than `key` on the ray through a place of the picture, in samples.
    pub fn hides(&self, [x, y]: [f64; 2], key: f64) -> bool {
        let grid = self.painter.grid;
        let is_inside = (0.0..f64::from(grid.sample_columns())).contains(&x)
            && (0.0..f64::from(grid.sample_rows())).contains(&y);
        if !is_inside {
            return false;
        }
        // Inside, so the casts keep the whole part.
        let (column, row) = (x as u32, y as u32);
        let [least, most] = self.keys;
        let hides = |shape: &Shape| {
            let frame = &self.frames[shape.frame];
            let ray = frame.ray(frame.row(y), x);
            let nearer = shape.outline.key(ray.rest);
            nearer > key && (least..=most).contains(&nearer) && shape.outline.contains(ray.rest)
        };
        let shapes = self.bins.in_band(grid.bands_of(&(row..row + 1)).start).iter();
        shapes
            .map(|&shape| &self.shapes[shape as usize])
            .filter(|shape| shape.columns.contains(&column) && shape.rows.contains(&row))
            .any(hides)
    }

    /// Draws a face into a rectangle of the tile.
    fn draw_shape(&self, shape: &Shape, [columns, rows]: [Range<u32>; 2], tile: &mut impl Sink<N>) {
        let frame = &self.frames[shape.frame];
        let [least, most] = self.keys;
        for row in rows {
            let rays = frame.row(f64::from(row) + 0.5);
            tile.draw_each(row, columns.clone(), shape.item, |column, nearest| {
                let ray = frame.ray(rays, f64::from(column) + 0.5);
                let key = shape.outline.key(ray.rest);
                // What is hidden or clipped need not be met.
                let may_be_seen = key as f32 > nearest && key > 0.0 && (least..=most).contains(&key);
                if !may_be_seen || !shape.outline.contains(ray.rest) {
                    return None;
                }
                let (color, level) = shape.look.at(&self.painter, self.motion, frame, &ray, key);
                Some((key as f32, (self.pack)(&color, level).map(|number| number as f32)))
            });
        }
    }

    /// Draws what of a face is in a rectangle of the tile. What can show the face is found anew in each half of a
    /// large one, so that rays are not wasted on what lies beside slanting and thin faces.
    fn draw_within(&self, shape: &Shape, [columns, rows]: [Range<u32>; 2], tile: &mut impl Sink<N>) {
        /// Samples that are tried at once rather than to look for those that need not be.
        const FEW: usize = 512;
        if columns.is_empty() || rows.is_empty() {
            return;
        }
        if columns.len() * rows.len() <= FEW {
            return self.draw_shape(shape, [columns, rows], tile);
        }
        let halves = if columns.len() >= rows.len() {
            halves(columns).map(|columns| [columns, rows.clone()])
        } else {
            halves(rows).map(|rows| [columns.clone(), rows])
        };
        for [columns, rows] in halves {
            let rect = Rect::new([columns.start, columns.end], [rows.start, rows.end]);
            if let Some(part) = footprint(&self.frames[shape.frame], &shape.outline, rect) {
                self.draw_within(shape, samples(part), tile);
            }
        }
    }
}

impl<const N: usize> Layer<N> for Faces<'_, N> {
    fn draw(&self, _grid: &Grid, band: usize, _scanner: &mut Scanner<N>, tile: &mut impl Sink<N>) {
        for &shape in self.bins.in_band(band) {
            let shape = &self.shapes[shape as usize];
            let within =
                |range: &Range<u32>, [start, end]: [u32; 2]| range.start.max(start)..range.end.min(end);
            let part = [within(&shape.columns, tile.columns()), within(&shape.rows, tile.rows())];
            self.draw_within(shape, part, tile);
        }
    }
}

/// How far a face came.
enum Built {
    /// Behind the eye.
    Behind,
    /// Not in the picture.
    Outside,
    Shape(Box<Shape>),
}

impl Built {
    fn shape(self) -> Option<Shape> {
        match self {
            Self::Shape(shape) => Some(*shape),
            Self::Behind | Self::Outside => None,
        }
    }
}

fn build(painter: &Painter<'_>, motion: Motion<'_>, frames: &[Frame], row: usize, face: &Face) -> Built {
    let at = frame_of(face.velocity);
    let frame = &frames[at];
    let contours: Vec<Vec<DVec3>> = painter
        .scene
        .face_contours(face)
        .map(|contour| contour.iter().map(|&id| frame.axes_from_scene(painter.surface.rest(id))).collect())
        .collect();
    let mut corners = contours.iter().flatten();
    let is_behind = corners.all(|&corner| frame.place(frame.seen(corner)).z < painter.view.slab.near);
    let outside = if is_behind { Built::Behind } else { Built::Outside };
    let Some(outline) = Outline::new(&contours) else { return outside };
    let picture = Rect::new([0, painter.grid.sample_columns()], [0, painter.grid.sample_rows()]);
    let Some(rect) = footprint(frame, &outline, picture) else { return outside };
    let [columns, rows] = samples(rect);
    if columns.is_empty() || rows.is_empty() {
        return outside;
    }
    let look = Look::new(painter, motion, frame, face, &contours);
    // The text of a scene is below 4 GiB, and so are its rows.
    Built::Shape(Box::new(Shape { item: row as u32, frame: at, columns, rows, outline, look }))
}

fn halves(range: Range<u32>) -> [Range<u32>; 2] {
    let middle = range.start + (range.end - range.start) / 2;
    [range.start..middle, middle..range.end]
}

/// The samples in a rectangle, which is within the picture.
fn samples(rect: Rect) -> [Range<u32>; 2] {
    [0, 1].map(|i| rect.low[i].floor() as u32..rect.high[i].ceil() as u32)
}
