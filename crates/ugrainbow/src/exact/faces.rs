//! The faces of a scene, intersected with one ray per sample.

use std::ops::Range;
use std::sync::{Mutex, PoisonError};

use glam::DVec3;
use rayon::prelude::*;
use ugraster::{Area, Bins, FragmentWriter, ShapeTarget, TRANSPARENT_VALUES, Tile};
use ugscene::Face;

use super::film::{Film, Form, Lengths, center};
use super::footprint::{Rect, footprint};
use super::frame::{PictureRays, Ray, frames};
use super::look::Look;
use super::nearest::{Nearest, PlaneRow, limited};
use super::outline::Outline;
use super::sections::{Cutter, Side};
use crate::clip::ClipCounts;
use crate::packing::Pack;
use crate::painter::Painter;

/// All faces that are in the picture, with the rays that intersect them.
pub struct Faces<'a, const N: usize> {
    painter: Painter<'a>,
    pack: Pack<N>,
    frames: Vec<PictureRays>,
    shapes: Vec<Shape>,
    bins: Bins,
    film: Film,
    /// Least and greatest depth key between the clipping planes.
    limits: [f64; 2],
    pool: Mutex<Vec<Scratch>>,
    /// How many faces are left after clipping.
    pub clip_counts: ClipCounts,
}

/// Buffers for drawing one tile.
#[derive(Default)]
struct Scratch {
    lengths: Lengths,
    nearest: Nearest,
    cutter: Cutter,
}

/// A face that may be visible in the picture.
struct Shape {
    item: u32,
    /// Index into the rest frames.
    frame: usize,
    columns: Range<u32>,
    rows: Range<u32>,
    outline: Outline,
    sides: Box<[Side]>,
    depth: Form,
    look: Look,
}

impl<'a, const N: usize> Faces<'a, N> {
    /// The faces of a scene for which `is_drawn` returns true. `planes`: the plane of each face, see
    /// [`ugscene::shared_planes`].
    pub fn new(
        painter: Painter<'a>,
        planes: &[u32],
        is_drawn: impl Fn(&Face) -> bool + Sync,
        pack: Pack<N>,
    ) -> Self {
        let frames = frames(&painter);
        let built = build_all(&painter, &frames, planes, &is_drawn);
        let in_front = built.iter().filter(|built| !matches!(built, Built::Behind)).count();
        let shapes: Vec<Shape> = built.into_iter().filter_map(Built::shape).collect();
        let clip_counts = ClipCounts { in_front, in_picture: shapes.len() };
        let bins = Bins::new(painter.grid, shapes.iter().map(|shape| painter.grid.bands().of(&shape.rows)));
        let slab = painter.view.slab;
        let limits = [(1.0 / slab.far).max(f64::MIN_POSITIVE), 1.0 / slab.near];
        let film = Film::new(painter.view.rays());
        let pool = Mutex::default();
        Self { painter, pack, frames, shapes, bins, film, limits, pool, clip_counts }
    }

    /// True if a face is nearer than `key` on the ray through a point of the picture, in samples.
    pub fn hides(&self, [x, y]: [f64; 2], key: f64) -> bool {
        let grid = self.painter.grid;
        let is_inside = (0.0..f64::from(grid.sample_columns())).contains(&x)
            && (0.0..f64::from(grid.sample_rows())).contains(&y);
        if !is_inside {
            return false;
        }
        // In the picture coordinates are not negative, so the casts round down.
        let (column, row) = (x as u32, y as u32);
        let [least, most] = self.limits;
        let hides = |shape: &Shape| {
            let frame = &self.frames[shape.frame];
            let ray = frame.ray(frame.row(y), x);
            let nearer = shape.outline.key(ray);
            nearer > key && (least..=most).contains(&nearer) && shape.outline.contains(ray)
        };
        let shapes = self.bins.in_band(grid.bands().of(&(row..row + 1)).start as usize).iter();
        shapes
            .map(|&shape| &self.shapes[shape as usize])
            .filter(|shape| shape.columns.contains(&column) && shape.rows.contains(&row))
            .any(hides)
    }

    /// Calls `take` with each run of samples that a face covers, occluded or not. Runs are limited
    /// to the given columns and rows.
    fn cover(
        &self,
        shape: &Shape,
        [columns, rows]: [Range<u32>; 2],
        lengths: &Lengths,
        cutter: &mut Cutter,
        mut take: impl FnMut(u32, Range<u32>),
    ) {
        let frame = &self.frames[shape.frame];
        for row in rows {
            let rays = frame.row(center(row));
            let contains = |column| shape.outline.contains(frame.ray(rays, center(column)));
            let take = |columns| take(row, columns);
            cutter.sections(row, columns.clone(), lengths.row(row), &shape.sides, contains, take);
        }
    }

    /// Finds the nearest of the given faces at each sample of a part of the picture.
    fn find_nearest(&self, shapes: &[u32], [columns, rows]: [Range<u32>; 2], scratch: &mut Scratch) {
        let Scratch { lengths, nearest, cutter } = scratch;
        lengths.reset(&self.film, columns.clone(), rows.clone());
        nearest.reset(columns.clone(), rows.clone());
        for &number in shapes {
            let shape = &self.shapes[number as usize];
            let frame = &self.frames[shape.frame];
            let part = [common(&shape.columns, &columns), common(&shape.rows, &rows)];
            self.cover(shape, part, lengths, cutter, |row, columns| {
                let lengths = lengths.row(row);
                if frame.is_extreme() {
                    let rays = frame.row(center(row));
                    let key = |column| shape.outline.key(frame.ray(rays, center(column)));
                    nearest
                        .draw(row, columns, lengths, number, |column, _| limited(key(column), self.limits));
                } else {
                    let plane = PlaneRow { form: shape.depth.on_row(row), limits: self.limits };
                    nearest.draw(row, columns, lengths, number, |column, length| plane.key(column, length));
                }
            });
        }
    }

    /// Draws the opaque faces of a band into one of its tiles.
    pub fn draw(&self, band: usize, tile: &mut Tile<N>) {
        let shapes = self.bins.in_band(band);
        let part = self.bounds(shapes, tile.area());
        self.with_scratch(|scratch| {
            self.find_nearest(shapes, part, scratch);
            if self.painter.appearance.is_spectral() {
                self.draw_nearest::<true>(scratch, tile);
            } else {
                self.draw_nearest::<false>(scratch, tile);
            }
        });
    }

    /// Draws the nearest face at each sample, as `scratch` has it, into a tile: no hidden sample is
    /// shaded.
    fn draw_nearest<const SPECTRAL: bool>(&self, scratch: &Scratch, tile: &mut Tile<N>) {
        let Scratch { lengths, nearest, .. } = scratch;
        for run in nearest.runs() {
            let shape = &self.shapes[run.face as usize];
            let frame = &self.frames[shape.frame];
            let rays = frame.row(center(run.row));
            let (lengths, keys) = (lengths.row(run.row), nearest.keys(&run));
            let first = run.columns.start;
            tile.draw_each(run.row, run.columns, shape.item, |column, _| {
                let ray = frame.ray_of_length(rays, column, lengths.at(column));
                Some((keys[(column - first) as usize], self.values::<SPECTRAL>(shape, frame, &ray)))
            });
        }
    }

    /// The values of a face where a ray meets it, in the packed layout.
    #[inline(always)] // As `Look::at`.
    fn values<const SPECTRAL: bool>(&self, shape: &Shape, frame: &PictureRays, ray: &Ray) -> [f32; N] {
        let key = shape.outline.key(ray.rest);
        let (color, level) = shape.look.at::<SPECTRAL>(&self.painter, frame, ray, key);
        (self.pack)(&color, level).map(|number| number as f32)
    }

    /// Runs `work` with buffers from the pool, and returns them to the pool.
    fn with_scratch(&self, work: impl FnOnce(&mut Scratch)) {
        let pool = || self.pool.lock().unwrap_or_else(PoisonError::into_inner);
        let mut scratch = pool().pop().unwrap_or_default();
        work(&mut scratch);
        pool().push(scratch);
    }

    /// The part of an area in which the given faces may be visible.
    fn bounds(&self, shapes: &[u32], area: Area) -> [Range<u32>; 2] {
        let around = |sides: &dyn Fn(&Shape) -> Range<u32>, [start, end]: [u32; 2]| {
            let sides =
                shapes.iter().map(|&number| common(&sides(&self.shapes[number as usize]), &(start..end)));
            let sides = sides.filter(|side| !side.is_empty());
            sides.reduce(|a, b| a.start.min(b.start)..a.end.max(b.end)).unwrap_or(start..start)
        };
        [around(&|shape| shape.columns.clone(), area.columns), around(&|shape| shape.rows.clone(), area.rows)]
    }
}

impl Faces<'_, TRANSPARENT_VALUES> {
    /// Draws the faces of a band as transparent fragments.
    pub fn draw_transparent(&self, band: usize, writer: &mut FragmentWriter<'_, '_>) {
        let shapes = self.bins.in_band(band);
        let part = self.bounds(shapes, writer.area());
        self.with_scratch(|scratch| {
            if self.painter.appearance.is_spectral() {
                self.draw_all::<true>(shapes, part, scratch, writer);
            } else {
                self.draw_all::<false>(shapes, part, scratch, writer);
            }
        });
    }

    /// Writes a fragment of every face wherever it is in front of the nearest occluder.
    fn draw_all<const SPECTRAL: bool>(
        &self,
        shapes: &[u32],
        [columns, rows]: [Range<u32>; 2],
        scratch: &mut Scratch,
        writer: &mut FragmentWriter<'_, '_>,
    ) {
        let Scratch { lengths, cutter, .. } = scratch;
        lengths.reset(&self.film, columns.clone(), rows.clone());
        for &number in shapes {
            let shape = &self.shapes[number as usize];
            let frame = &self.frames[shape.frame];
            let part = [common(&shape.columns, &columns), common(&shape.rows, &rows)];
            self.cover(shape, part, lengths, cutter, |row, columns| {
                let (lengths, rays) = (lengths.row(row), frame.row(center(row)));
                let plane = PlaneRow { form: shape.depth.on_row(row), limits: self.limits };
                writer.draw_each(row, columns, shape.item, |column, occluder_key| {
                    let length = lengths.at(column);
                    let ray = frame.ray_of_length(rays, column, length);
                    let key = if frame.is_extreme() {
                        limited(shape.outline.key(ray.rest), self.limits)
                    } else {
                        plane.key(column, length)
                    };
                    (key > occluder_key).then(|| (key, self.values::<SPECTRAL>(shape, frame, &ray)))
                });
            });
        }
    }
}

/// The intersection of two ranges.
fn common(a: &Range<u32>, b: &Range<u32>) -> Range<u32> {
    a.start.max(b.start)..a.end.min(b.end)
}

/// Result of preparing a face.
enum Built {
    /// Not in front of the near clipping plane.
    Behind,
    /// Outside the picture, edge-on, or without area.
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

fn build(painter: &Painter<'_>, frames: &[PictureRays], planes: &[u32], row: usize, face: &Face) -> Built {
    let at = face.body.index();
    let frame = &frames[at];
    let contours = contours(painter, frame, face);
    let mut corners = contours.iter().flatten();
    let is_behind = corners.all(|&corner| frame.place(frame.seen(corner)).z < painter.view.slab.near);
    let outside = if is_behind { Built::Behind } else { Built::Outside };
    let Some(mut outline) = Outline::new(&contours) else { return outside };
    if let Some(&plane) = planes.get(row)
        && plane != 0
        && let Some(first) =
            Outline::new(&self::contours(painter, frame, &painter.scene.faces[plane as usize - 1]))
    {
        // The same bits for all faces in one plane: ties in depth go to the first of them.
        outline.set_plane(first.plane());
    }
    let picture = Rect::new([0, painter.grid.sample_columns()], [0, painter.grid.sample_rows()]);
    let Some(rect) = footprint(frame, &outline, picture) else { return outside };
    let [columns, rows] = samples(rect);
    if columns.is_empty() || rows.is_empty() {
        return outside;
    }
    let look = Look::new(painter, frame, face, &contours);
    // The text of a scene is below 4 GiB, so row numbers fit.
    let item = row as u32;
    let (sides, depth) =
        (outline.edges().iter().map(|edge| frame.side(edge.normal)).collect(), frame.form(outline.plane()));
    Built::Shape(Box::new(Shape { item, frame: at, columns, rows, outline, sides, depth, look }))
}

/// The contours of a face at rest, in the axes of its frame.
fn contours(painter: &Painter<'_>, frame: &PictureRays, face: &Face) -> Vec<Vec<DVec3>> {
    let corner = |&id| frame.aligned_from_scene(painter.appearance.surface.rest(id));
    painter.scene.face_contours(face).map(|contour| contour.iter().map(corner).collect()).collect()
}

/// The faces of a scene for which `is_drawn` returns true, compiled once for all layouts.
fn build_all(
    painter: &Painter<'_>,
    frames: &[PictureRays],
    planes: &[u32],
    is_drawn: &(dyn Fn(&Face) -> bool + Sync),
) -> Vec<Built> {
    let faces = painter.scene.faces.par_iter().enumerate().filter(|(_, face)| is_drawn(face));
    faces.map(|(row, face)| build(painter, frames, planes, row, face)).collect()
}

/// The samples in a rectangle that lies within the picture.
fn samples(rect: Rect) -> [Range<u32>; 2] {
    [0, 1].map(|i| rect.low[i].floor() as u32..rect.high[i].ceil() as u32)
}
