//! Leaving out what the camera cannot see, before anything is cut.
//!
//! A face is left out if it certainly lies outside one of the half-spaces that hold all there is in the
//! picture. What is seen is bent, but seen places are linear in rest coordinates p' and their length, so their
//! distance from a plane has a bound that is largest at a corner, (P27).

use glam::DVec3;
use rayon::prelude::*;
use ugparse::{Face, Item, Scene, VertexId, Wire};
use ugscene::{HalfSpace, View};

use crate::motion::{Motion, Point};

/// A bound must be below by this part of what it is computed from: rounding of some ten operations.
const ROUNDING: f64 = 1e-12;

/// The half-spaces that hold all there is in the picture; none if nobody asks.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sight {
    spaces: Vec<HalfSpace>,
}

impl Sight {
    pub(crate) fn new(view: &View) -> Sight {
        Sight { spaces: view.half_spaces().into_iter().flatten().collect() }
    }

    /// True only if nothing between these corners of a body is in the picture, neither as it is nor as it is drawn.
    pub(crate) fn is_outside(&self, motion: &Motion, corners: &[&Point]) -> bool {
        self.spaces.iter().any(|space| is_outside(space, motion, corners))
    }
}

/// Leaves out faces that are out of sight, and vertices that only they used; how many faces.
///
/// Faces that share a vertex with one that is kept are kept, too: colours are mixed from the faces round a
/// vertex. One face is kept in any case, so that there is a scene.
pub(crate) fn cull(scene: &mut Scene, points: &mut Vec<Point>, motions: &[Motion], sight: &Sight) -> usize {
    if sight.spaces.is_empty() {
        return 0;
    }
    let may_be_seen = |face: &Face| {
        let corners = scene.contours.corners(face.contours.clone());
        let corners: Vec<&Point> = corners.iter().map(|corner| &points[corner.index()]).collect();
        let motion = corners.first().map(|first| &motions[first.body as usize]);
        motion.is_none_or(|motion| !sight.is_outside(motion, &corners))
    };
    let seen: Vec<bool> = scene.faces.par_iter().map(may_be_seen).collect();
    let mut touched = vec![false; scene.vertices.len()];
    for (face, _) in scene.faces.iter().zip(&seen).filter(|&(_, &seen)| seen) {
        scene
            .contours
            .corners(face.contours.clone())
            .iter()
            .for_each(|corner| touched[corner.index()] = true);
    }
    let is_touched = |face: &Face| {
        scene.contours.corners(face.contours.clone()).iter().any(|corner| touched[corner.index()])
    };
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

/// True only if no point between these corners is in the half-space as seen.  Eq. (P27)
fn is_outside(space: &HalfSpace, motion: &Motion, corners: &[&Point]) -> bool {
    let direction = motion.direction();
    let along = space.normal.dot(direction);
    let (normal, flight, places): (DVec3, f64, Vec<DVec3>) = if motion.has_flight_time() {
        let normal = space.normal + direction * (motion.gamma_minus_one() * along);
        let places = corners.iter().map(|corner| motion.boosted_rest(corner.rest)).collect();
        (normal, motion.proper_speed() * along, places)
    } else {
        // Contraction is linear: what is seen of a flat face is flat.
        (space.normal, 0.0, corners.iter().map(|corner| corner.seen).collect())
    };
    let toward = places.iter().map(|place| place.normalize_or_zero()).sum::<DVec3>().normalize_or_zero();
    let way = |place: DVec3| if flight > 0.0 { place.dot(toward) } else { place.length() };
    let bound = places.iter().map(|&place| place.dot(normal) - flight * way(place)).fold(f64::MIN, f64::max);
    let size = places.iter().map(|place| place.length()).fold(0.0, f64::max);
    let rounding = ROUNDING * ((normal.length() + flight.abs()) * size + space.offset.abs());
    bound + space.offset < -rounding
}

/// Keeps some faces, all wires, and the vertices that are not left without a user.
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

    let (new_vertices, new_faces) = (new_rows(&kept_vertices), new_rows(kept_faces));
    retain(&mut scene.faces, kept_faces);
    retain(&mut scene.vertices, &kept_vertices);
    retain(points, &kept_vertices);
    let old = std::mem::take(&mut scene.contours);
    let mut copy = |rows: std::ops::Range<u32>| {
        let contours = old.iter(rows);
        let corner = |corner: &VertexId| VertexId(new_vertices[corner.index()]);
        scene.contours.push_all(contours.map(|contour| contour.iter().map(corner).collect::<Vec<_>>()))
    };
    scene.faces.iter_mut().for_each(|Face { contours, .. }| *contours = copy(contours.clone()));
    scene.wires.iter_mut().for_each(|Wire { contours, .. }| *contours = copy(contours.clone()));
    scene.comments.retain_mut(|comment| match &mut comment.at {
        Item::Vertex(row) => follow(row, &kept_vertices, &new_vertices),
        Item::Face(row) => follow(row, kept_faces, &new_faces),
        _ => true,
    });
}

/// The new row of what is kept; false for what is not.
fn follow(row: &mut u32, kept: &[bool], new_rows: &[u32]) -> bool {
    let old = *row as usize;
    *row = new_rows[old];
    kept[old]
}

/// How many are kept before each.
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
