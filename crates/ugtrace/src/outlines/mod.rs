//! The nearest face at every sample of a picture, from the outlines of faces as they are seen:
//! primary rays of a pinhole camera to bodies without acceleration.
//!
//! After T. Müller, S. Grottel and D. Weiskopf, *Special relativistic visualization by local ray
//! tracing* (2010): the viewing direction of a sample is transformed to the rest frame of a face
//! (P6) and intersected with the plane of the face there. Outline and depth are those of the
//! intersection, so faces need no subdivision. The steps, one file each:
//!
//! 1. `frame`: rays of a row of samples in the rest frame of a body;
//! 2. `film`: linear functions of these rays: side of an edge, depth, and D;
//! 3. `outline`: whether a ray passes through a face;
//! 4. `footprint`: the part of the picture that a face can cover, bounded by arcs of conics (P8);
//! 5. `bins`: the faces of each tile of the picture;
//! 6. `sections`: where a row of samples enters and leaves a face;
//! 7. `nearest`: the nearest face at each sample.
//!
//! # Watertight edges
//!
//! A ray is in a face if a half plane that begins at the ray crosses the outline of the face an odd
//! number of times. The side of an edge on which the ray runs is computed from the ends in a fixed
//! order, so faces that share an edge obtain the same bits. Summed over faces that share edges, the
//! crossings of shared edges cancel, and those of the common outline remain: a sample inside the
//! outline is in an odd number of faces, and so in at least one.
//!
//! # Row by row
//!
//! Testing each sample separately would be slow. The side of an edge and the depth of a plane are
//! linear in p', and so in p and |p| (`film`). Along a row of samples they are a straight line
//! plus a multiple of |p|; such a function is convex or concave and changes sign at most twice.
//! Between the columns of these changes all samples are in the face or all are outside, so one of
//! them is tested. Samples where rounding could decide are tested one by one.

mod bins;
mod film;
mod footprint;
mod frame;
mod nearest;
mod outline;
mod sections;

use std::ops::Range;
use std::sync::{Mutex, PoisonError};

use glam::DVec3;
use rayon::prelude::*;
use ugscene::{Face, RestFrames, Scene, View};

use bins::Bins;
pub use bins::Tiles;
use film::{Film, Form, Lengths, center};
use footprint::{Rect, footprint};
pub use frame::{PictureRays, RestRay};
use nearest::Nearest;
pub use nearest::Run;
use outline::Outline;
use sections::{Cutter, Side};

/// The faces that may be visible in a picture.
pub struct Outlines {
    /// The rays of the picture in the rest frame of each body.
    frames: Vec<PictureRays>,
    shapes: Vec<OutlinedFace>,
    bins: Bins,
    film: Film,
    /// Samples across and down.
    size: [u32; 2],
    /// Least and greatest depth key between the clipping planes.
    limits: [f64; 2],
    pool: Mutex<Vec<Scratch>>,
}

/// What the samples of a part of the picture show.
pub struct NearestFaces<'a> {
    outlines: &'a Outlines,
    scratch: &'a Scratch,
}

/// Memory to find what samples show.
#[derive(Default)]
struct Scratch {
    lengths: Lengths,
    nearest: Nearest,
    cutter: Cutter,
}

/// A face that may be visible in the picture.
pub struct OutlinedFace {
    /// Row of the face in the scene.
    pub item: u32,
    /// Row of its body.
    frame: usize,
    columns: Range<u32>,
    rows: Range<u32>,
    outline: Outline,
    sides: Box<[Side]>,
    depth: Form,
}

impl OutlinedFace {
    /// The inverse of the parameter at which a ray meets the plane of the face. `ray`: at rest.
    #[inline]
    pub fn key(&self, ray: DVec3) -> f64 {
        self.outline.key(ray)
    }
}

/// A scene at rest, from which outlines are made.
#[derive(Clone, Copy)]
pub struct RestFaces<'a> {
    /// Its vertices are part of one body each.
    pub scene: &'a Scene,
    /// The rest position of each vertex relative to the eye, in the axes of the scene.
    pub rest: &'a [DVec3],
    /// The rest frames of the bodies.
    pub frames: &'a RestFrames,
    /// The plane of each face, see [`ugscene::shared_planes`].
    pub planes: &'a [u32],
}

impl Outlines {
    /// The faces for which `is_drawn` returns true. `view`: has samples as its picture coordinates.
    /// `tiles`: the parts in which the picture is drawn.
    pub fn new(
        faces: RestFaces<'_>,
        view: &View,
        tiles: Tiles,
        is_drawn: impl Fn(&Face) -> bool + Sync,
    ) -> Self {
        let frames = PictureRays::all(faces.frames, view, faces.scene);
        let all = faces.scene.faces.par_iter().enumerate().filter(|(_, face)| is_drawn(face));
        let shapes: Vec<OutlinedFace> =
            all.filter_map(|(row, face)| build(faces, &frames, tiles.size, row, face)).collect();
        let bins = Bins::new(
            tiles,
            shapes.iter().map(|shape| [shape.columns.clone(), shape.rows.clone()]),
        );
        let limits = [(1.0 / view.slab.far).max(f64::MIN_POSITIVE), 1.0 / view.slab.near];
        let film = Film::new(view.rays());
        Self { frames, shapes, bins, film, size: tiles.size, limits, pool: Mutex::default() }
    }

    /// The faces that may be in the picture.
    pub fn shapes(&self) -> &[OutlinedFace] {
        &self.shapes
    }

    /// The rays of the picture in the rest frame of a face.
    #[inline]
    pub fn frame(&self, shape: &OutlinedFace) -> &PictureRays {
        &self.frames[shape.frame]
    }

    /// True if a face is nearer than `key` on the ray through a point of the picture, in samples.
    pub fn hides(&self, [x, y]: [f64; 2], key: f64) -> bool {
        let [width, height] = self.size;
        if !((0.0..f64::from(width)).contains(&x) && (0.0..f64::from(height)).contains(&y)) {
            return false;
        }
        // In the picture coordinates are not negative, so the casts round down.
        let (column, row) = (x as u32, y as u32);
        let [least, most] = self.limits;
        let hides = |shape: &OutlinedFace| {
            let frame = self.frame(shape);
            let ray = frame.ray(frame.row(y), x);
            let nearer = shape.outline.key(ray);
            nearer > key && (least..=most).contains(&nearer) && shape.outline.contains(ray)
        };
        let shapes =
            self.bins.around([column, row]).iter().map(|&shape| &self.shapes[shape as usize]);
        shapes
            .filter(|shape| shape.columns.contains(&column) && shape.rows.contains(&row))
            .any(hides)
    }

    /// Finds the nearest face at each sample of a part of a tile, and runs `work` with the result.
    pub fn with_nearest<T>(
        &self,
        tile: [u32; 2],
        [columns, rows]: [Range<u32>; 2],
        work: impl FnOnce(&NearestFaces<'_>) -> T,
    ) -> T {
        let shapes = self.bins.in_tile(tile);
        let part = self.bounds(shapes, [columns, rows]);
        self.with_scratch(|scratch| {
            self.find_nearest(shapes, part, scratch);
            work(&NearestFaces { outlines: self, scratch })
        })
    }

    fn find_nearest(
        &self,
        shapes: &[u32],
        [columns, rows]: [Range<u32>; 2],
        scratch: &mut Scratch,
    ) {
        let Scratch { lengths, nearest, cutter } = scratch;
        lengths.reset(&self.film, columns.clone(), rows.clone());
        nearest.reset(columns.clone(), rows.clone());
        for &number in shapes {
            let shape = &self.shapes[number as usize];
            let frame = self.frame(shape);
            let part = [common(&shape.columns, &columns), common(&shape.rows, &rows)];
            self.cover(shape, part, lengths, cutter, |row, columns| {
                let lengths = lengths.row(row);
                if frame.is_extreme() {
                    let rays = frame.row(center(row));
                    let key = |column| shape.outline.key(frame.ray(rays, center(column)));
                    nearest
                        .draw(row, columns, lengths, number, |column, _| self.limited(key(column)));
                } else {
                    let form = shape.depth.on_row(row);
                    let key = |column, length| self.limited(form.at(column, length));
                    nearest.draw(row, columns, lengths, number, key);
                }
            });
        }
    }

    /// Calls `take` with every run of samples in a part of a tile that a face covers, occluded or
    /// not: the shape, the row, the columns, and a function for the ray at a column and its depth
    /// key, which is [`EMPTY`](Self::EMPTY) where the face is clipped.
    pub fn for_each_run(
        &self,
        tile: [u32; 2],
        [columns, rows]: [Range<u32>; 2],
        mut take: impl FnMut(u32, u32, Range<u32>, &dyn Fn(u32) -> (RestRay, f64)),
    ) {
        let shapes = self.bins.in_tile(tile);
        let [columns, rows] = self.bounds(shapes, [columns, rows]);
        self.with_scratch(|Scratch { lengths, cutter, .. }| {
            lengths.reset(&self.film, columns.clone(), rows.clone());
            for &number in shapes {
                let shape = &self.shapes[number as usize];
                let frame = self.frame(shape);
                let part = [common(&shape.columns, &columns), common(&shape.rows, &rows)];
                self.cover(shape, part, lengths, cutter, |row, columns| {
                    let (lengths, rays, form) =
                        (lengths.row(row), frame.row(center(row)), shape.depth.on_row(row));
                    take(number, row, columns, &|column| {
                        let length = lengths.at(column);
                        let ray = frame.ray_of_length(rays, column, length);
                        let key = if frame.is_extreme() {
                            shape.outline.key(ray.rest)
                        } else {
                            form.at(column, length)
                        };
                        (ray, self.limited(key))
                    });
                });
            }
        });
    }

    /// The depth key of nothing: farther than everything.
    pub const EMPTY: f64 = nearest::EMPTY;

    /// A key; [`Self::EMPTY`] outside the limits.
    #[inline]
    fn limited(&self, key: f64) -> f64 {
        let [least, most] = self.limits;
        if key >= least && key <= most { key } else { Self::EMPTY }
    }

    /// Calls `take` with each run of samples that a face covers, occluded or not. Runs are limited
    /// to the given columns and rows.
    fn cover(
        &self,
        shape: &OutlinedFace,
        [columns, rows]: [Range<u32>; 2],
        lengths: &Lengths,
        cutter: &mut Cutter,
        mut take: impl FnMut(u32, Range<u32>),
    ) {
        let frame = self.frame(shape);
        for row in rows {
            let rays = frame.row(center(row));
            let contains = |column| shape.outline.contains(frame.ray(rays, center(column)));
            let take = |columns| take(row, columns);
            cutter.sections(row, columns.clone(), lengths.row(row), &shape.sides, contains, take);
        }
    }

    /// Runs `work` with memory from the pool, and returns it to the pool.
    fn with_scratch<T>(&self, work: impl FnOnce(&mut Scratch) -> T) -> T {
        let pool = || self.pool.lock().unwrap_or_else(PoisonError::into_inner);
        let mut scratch = pool().pop().unwrap_or_default();
        let result = work(&mut scratch);
        pool().push(scratch);
        result
    }

    /// The part of some columns and rows in which the given faces may be visible.
    fn bounds(&self, shapes: &[u32], [columns, rows]: [Range<u32>; 2]) -> [Range<u32>; 2] {
        let around = |sides: &dyn Fn(&OutlinedFace) -> Range<u32>, range: Range<u32>| {
            let sides =
                shapes.iter().map(|&number| common(&sides(&self.shapes[number as usize]), &range));
            let sides = sides.filter(|side| !side.is_empty());
            sides
                .reduce(|a, b| a.start.min(b.start)..a.end.max(b.end))
                .unwrap_or(range.start..range.start)
        };
        [around(&|shape| shape.columns.clone(), columns), around(&|shape| shape.rows.clone(), rows)]
    }
}

impl NearestFaces<'_> {
    /// The runs of samples that show a face, row after row.
    pub fn runs(&self) -> impl Iterator<Item = Run> {
        self.scratch.nearest.runs()
    }

    /// The depth keys of a run, and the lengths of its rays.
    pub fn of_run(&self, run: &Run) -> (&[f64], &[f64]) {
        (self.scratch.nearest.keys(run), self.scratch.lengths.row(run.row).part(&run.columns))
    }

    /// The row of the face in the scene that a sample shows.
    #[inline]
    pub fn at(&self, sample: [u32; 2]) -> Option<u32> {
        self.scratch.nearest.at(sample).map(|shape| self.outlines.shapes[shape as usize].item)
    }
}

/// The intersection of two ranges.
fn common(a: &Range<u32>, b: &Range<u32>) -> Range<u32> {
    a.start.max(b.start)..a.end.min(b.end)
}

/// The outline of a face; `None` if it is outside the picture, edge-on, or without area.
fn build(
    faces: RestFaces<'_>,
    frames: &[PictureRays],
    size: [u32; 2],
    row: usize,
    face: &Face,
) -> Option<OutlinedFace> {
    let at = face.body.index();
    let frame = &frames[at];
    let contours = frame.contours(faces.scene, faces.rest, face);
    let mut outline = Outline::new(&contours)?;
    if let Some(&plane) = faces.planes.get(row)
        && plane != 0
        && let first = &faces.scene.faces[plane as usize - 1]
        && let Some(first) = Outline::new(&frame.contours(faces.scene, faces.rest, first))
    {
        // The same bits for all faces in one plane: ties in depth go to the first of them.
        outline.plane = first.plane;
    }
    let rect = footprint(frame, &outline, Rect::new([0, size[0]], [0, size[1]]))?;
    // The footprint lies within the picture.
    let [columns, rows] = [0, 1].map(|i| rect.low[i].floor() as u32..rect.high[i].ceil() as u32);
    if columns.is_empty() || rows.is_empty() {
        return None;
    }
    // The text of a scene is below 4 GiB, so row numbers fit.
    let item = row as u32;
    let (sides, depth) = (
        outline.edges.iter().map(|edge| frame.side(edge.normal)).collect(),
        frame.form(outline.plane),
    );
    Some(OutlinedFace { item, frame: at, columns, rows, outline, sides, depth })
}
