//! Culling of faces outside the view, before subdivision.
//!
//! A face is removed if all of it is surely outside one of the half-spaces whose intersection is
//! the view volume. Faces are seen curved, but seen positions are linear in the rest coordinates p'
//! and their length |p'|, so the distance from a plane has a bound that is attained at a corner,
//! (P27). On a world line a face is within a bound from the flat one with its seen corners, (P49).

use glam::DVec3;
use rayon::prelude::*;
use ugphysics::{Event, SeenLight, SeenPoint, SmoothStretch, WorldLine, WorldTube};
use ugscene::{Face, HalfSpace, Scene, VertexId, View, Wire};

use crate::relative_motion::{Point, RelativeMotion};

/// The half-spaces whose intersection is the view volume; empty without culling.
#[derive(Clone, Debug, Default)]
pub(crate) struct ViewVolume {
    spaces: Vec<HalfSpace>,
}

impl ViewVolume {
    pub(crate) fn new(view: &View) -> ViewVolume {
        ViewVolume { spaces: view.half_spaces().into_iter().flatten().collect() }
    }

    /// True only if no point between these corners of a body is in the picture, neither as seen nor
    /// as drawn. It is never true of bodies on world lines.
    pub(crate) fn is_outside(&self, motion: &RelativeMotion, corners: &[&Point]) -> bool {
        if self.spaces.is_empty() {
            return false;
        }
        let corners: Vec<DVec3> = corners.iter().map(|corner| corner.rest).collect();
        self.spaces.iter().any(|space| motion.is_outside(space, &corners))
    }
}

/// A body on a world line as it is seen.
struct SeenBody<'m> {
    line: &'m WorldLine,
    tube: WorldTube,
    passages: Vec<SmoothStretch>,
}

impl<'m> SeenBody<'m> {
    /// How often faces are divided for closer bounds.
    const LEVELS: u32 = 2;

    /// `None` for an inertial motion, or without bounds.
    fn new(motion: &'m RelativeMotion, points: &[Point], body: usize) -> Option<Self> {
        let line: &WorldLine = motion.world_line()?;
        let own = points.iter().filter(|point| point.body.index() == body).map(|point| point.rest);
        let tube = line.tube(own)?;
        let passages = line.smooth_stretches(&tube, Event::ORIGIN).ok()?;
        Some(Self { line, tube, passages })
    }

    /// True only if a face is outside the view. Triangles from its first corner to its edges cover
    /// it, whatever its outline.
    fn is_outside(&self, view_volume: &ViewVolume, corners: &[&Point]) -> bool {
        let Some((first, others)) = corners.split_first() else { return false };
        others
            .windows(2)
            .all(|edge| self.is_triangle_outside(view_volume, [first, edge[0], edge[1]]))
    }

    fn is_triangle_outside(&self, view_volume: &ViewVolume, corners: [&Point; 3]) -> bool {
        /// Of places, relative to the distances from the eye and from the fixed point of a motion.
        const ROUNDING: f64 = 1e-9;
        let outside = |space: &HalfSpace, margin: f64| {
            corners.iter().all(|corner| space.normal.dot(corner.seen) + space.offset < -margin)
        };
        // The bound takes longer than the corners, most of which are in the picture.
        if !view_volume.spaces.iter().any(|space| outside(space, 0.0)) {
            return false;
        }
        let seen = corners.map(|corner| -> SeenPoint {
            let &Point { rest, seen, seen_distance, own_time, inverse_doppler, .. } = corner;
            (
                rest,
                SeenLight {
                    own_time,
                    event: Event { t: -seen_distance, x: seen },
                    inverse_doppler,
                },
            )
        });
        let Some(bounds) =
            self.line.seen_triangle(&self.tube, &self.passages, &seen, Event::ORIGIN, Self::LEVELS)
        else {
            return false;
        };
        let size = corners
            .map(|corner| corner.seen_distance + corner.own_time.abs() + corner.rest.length());
        let margin = bounds.deviation + ROUNDING * size.into_iter().fold(0.0, f64::max);
        view_volume.spaces.iter().any(|space| outside(space, space.normal.length() * margin))
    }
}

/// Removes faces outside the view, and vertices that only they use; returns the number of faces.
///
/// Faces that share a vertex with a visible one are kept, since colours are mixed from all faces at
/// a vertex. One face is always kept, since a scene without any is invalid.
pub(crate) fn cull(
    scene: &mut Scene,
    points: &mut Vec<Point>,
    motions: &[RelativeMotion],
    view_volume: &ViewVolume,
) -> usize {
    if view_volume.spaces.is_empty() {
        return 0;
    }
    let seen_bodies: Vec<Option<SeenBody<'_>>> = motions
        .iter()
        .enumerate()
        .map(|(body, motion)| SeenBody::new(motion, points, body))
        .collect();
    let may_be_seen = |face: &Face| {
        if face.shape.is_round() {
            return true;
        }
        let corners = scene.face_corners(face).iter();
        let corners: Vec<&Point> = corners.map(|corner| &points[corner.index()]).collect();
        let Some(body) = corners.first().map(|first| first.body.index()) else { return true };
        match &seen_bodies[body] {
            Some(seen) => !seen.is_outside(view_volume, &corners),
            None => !view_volume.is_outside(&motions[body], &corners),
        }
    };
    let seen: Vec<bool> = scene.faces.par_iter().map(may_be_seen).collect();
    let mut touched = vec![false; scene.vertices.len()];
    for (face, _) in scene.faces.iter().zip(&seen).filter(|&(_, &seen)| seen) {
        scene.face_corners(face).iter().for_each(|corner| touched[corner.index()] = true);
    }
    let is_touched =
        |face: &Face| scene.face_corners(face).iter().any(|corner| touched[corner.index()]);
    let mut kept: Vec<bool> = scene.faces.iter().map(is_touched).collect();
    if scene.wires.is_empty()
        && !kept.contains(&true)
        && let Some(first) = kept.first_mut()
    {
        *first = true;
    }
    let n_culled = kept.iter().filter(|&&kept| !kept).count();
    if n_culled > 0 {
        remove(scene, points, &kept);
    }
    n_culled
}

/// Removes faces, and the vertices that are unused then.
fn remove(scene: &mut Scene, points: &mut Vec<Point>, kept_faces: &[bool]) {
    let mut kept_vertices = vec![true; scene.vertices.len()];
    let mut mark = |rows: std::ops::Range<u32>, is_kept: bool| {
        let corners = scene.contours.corners(rows);
        corners.iter().for_each(|corner| kept_vertices[corner.index()] = is_kept);
    };
    for is_kept in [false, true] {
        let faces = scene.faces.iter().zip(kept_faces).filter(|&(_, &kept)| kept == is_kept);
        faces.for_each(|(face, _)| mark(face.contours.clone(), is_kept));
    }
    scene.wires.iter().for_each(|wire| mark(wire.contours.clone(), true));

    let new_vertices = new_rows(&kept_vertices);
    retain(&mut scene.faces, kept_faces);
    retain(&mut scene.vertices, &kept_vertices);
    retain(points, &kept_vertices);
    let old = std::mem::take(&mut scene.contours);
    let mut copy = |rows: std::ops::Range<u32>| {
        let contours = old.iter(rows);
        let corner = |corner: &VertexId| VertexId(new_vertices[corner.index()]);
        scene
            .contours
            .push_all(contours.map(|contour| contour.iter().map(corner).collect::<Vec<_>>()))
    };
    scene.faces.iter_mut().for_each(|Face { contours, .. }| *contours = copy(contours.clone()));
    scene.wires.iter_mut().for_each(|Wire { contours, .. }| *contours = copy(contours.clone()));
}

/// The number of kept rows before each row.
fn new_rows(kept: &[bool]) -> Vec<u32> {
    let mut n_before = 0;
    let next = |&kept: &bool| {
        n_before += u32::from(kept);
        n_before - u32::from(kept)
    };
    kept.iter().map(next).collect()
}

fn retain<T>(rows: &mut Vec<T>, kept: &[bool]) {
    let mut kept = kept.iter();
    rows.retain(|_| kept.next().is_some_and(|&kept| kept));
}
