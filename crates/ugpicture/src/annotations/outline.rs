//! The edges of moving bodies as they would look at rest.
//!
//! Each body gets its rest shape (P4), placed so that its centre (of its bounding box in its rest
//! frame) is at the apparent position of that centre (P3). The outline is thus what the eye would
//! see if the body rested there; for a body placed by `uglorentz -in` it is the body in the scene
//! at rest. A spinning body is turned as its centre is seen. Only edges that the eye sees are
//! drawn: edges between front and back faces, borders, and creases. They are wires of the scene at
//! rest, so its faces occlude them, and those of the picture do not.

use std::collections::HashMap;

use glam::{DQuat, DVec3};
use ugimage::label::Drawing;
use ugscene::{BodyId, Scene, VertexId, View, face_edges, rest_positions, unit_normal, vertex_bodies};

use super::seen::SeenScene;
use super::style::Style;
use crate::error::Error;
use crate::note::Note;
use crate::spots::spots;

/// Cosine of the angle, 35 degrees, below which adjacent faces count as one curved surface.
const CREASE: f64 = 0.819;

/// Cosine of the angle below which faces count as coplanar.
const COPLANAR: f64 = 0.9999;

/// Corners closer than this many pixels, where the bodies are nearest to the eye, are at the same
/// place: vertices are repeated for other colours, and parts of a body meet up to the digits in its
/// text.
const SAME_PLACE: f64 = 0.1;

/// Draws the outlines of moving bodies as they would look at rest. Returns a note if nothing moves.
pub fn draw<E: From<Error>>(
    seen: &SeenScene<'_, E>,
    style: &Style,
    drawing: &mut Drawing,
) -> Result<Option<Note>, E> {
    if !seen.scene.faces.iter().any(|face| seen.frames.is_moving(face.body)) {
        return Ok(Some(Note::NoOutline));
    }
    let places = ideal_places(seen);
    let faces = Faces { scene: seen.scene, places: &places, view: &seen.view };
    let shown = edges(seen, &places).into_iter().filter(|edge| edge.is_shown(&faces));
    let lines: Vec<[DVec3; 2]> = shown.map(|edge| edge.ends.map(|end| places[end.index()])).collect();
    let visible = seen.visible(ideal_scene(seen.scene, seen.view.eye, &places), &lines)?;
    let width = style.hairline;
    drawing.lines(visible.clone(), 3.0 * width, style.background);
    drawing.lines(visible, width, style.ink);
    Ok(None)
}

/// The position of each vertex at rest, relative to the eye.
fn ideal_places<E: From<Error>>(seen: &SeenScene<'_, E>) -> Vec<DVec3> {
    let SeenScene { scene, view, frames, .. } = seen;
    let at_rest = rest_positions(scene, view.eye, frames);
    let bodies = vertex_bodies(scene);
    let mut bounds: Vec<Option<[DVec3; 2]>> = vec![None; scene.bodies.len()];
    for (&place, body) in at_rest.iter().zip(&bodies) {
        let bounds = &mut bounds[body.index()];
        *bounds = Some(bounds.map_or([place; 2], |[low, high]| [low.min(place), high.max(place)]));
    }
    // The centre of a moving body at rest, where it is seen, and the turn of the body then.
    let standing = |body: BodyId| {
        let [low, high] = bounds[body.index()].filter(|_| seen.frames.is_moving(body))?;
        let center = 0.5 * low + 0.5 * high;
        let motion = frames.motion(body);
        let (place, own_time) = motion.light(motion.turned(center)).unwrap_or((center, 0.0));
        let turn = motion.world_line().map_or(DQuat::IDENTITY, |line| line.standing(center, own_time).1);
        Some((center, place, turn))
    };
    let standing: Vec<_> = scene.bodies.ids().map(standing).collect();
    let place = |(vertex, body): (usize, &BodyId)| match standing[body.index()] {
        Some((center, place, turn)) => place + turn * (at_rest[vertex] - center),
        None => scene.vertices[vertex].position - view.eye,
    };
    bodies.iter().enumerate().map(place).collect()
}

/// The scene with its vertices at `places`, and nothing in motion.
fn ideal_scene(scene: &Scene, eye: DVec3, places: &[DVec3]) -> Scene {
    let mut ideal = scene.clone();
    for (vertex, place) in ideal.vertices.iter_mut().zip(places) {
        vertex.position = eye + *place;
    }
    (ideal.rest, ideal.own_times) = (Vec::new(), Vec::new());
    let body = ideal.bodies.unstated();
    ideal.faces.iter_mut().for_each(|face| face.body = body);
    ideal
}

/// The faces of the scene at rest.
struct Faces<'a> {
    scene: &'a Scene,
    places: &'a [DVec3],
    view: &'a View,
}

impl Faces<'_> {
    /// The normal of a face, and whether the eye is on its side.
    fn normal(&self, face: usize) -> (DVec3, bool) {
        let Some(outline) = self.scene.face_contours(&self.scene.faces[face]).next() else {
            return (DVec3::ZERO, false);
        };
        let corners = outline.iter().map(|vertex| self.places[vertex.index()]);
        let normal = unit_normal(corners);
        let toward =
            if self.view.is_perspective { -self.places[outline[0].index()] } else { -self.view.forward };
        (normal, normal.dot(toward) > 0.0)
    }
}

/// An edge of faces, stored once.
struct Edge {
    ends: [VertexId; 2],
    /// The faces that share it, and whether they run from the first end to the second.
    faces: Vec<(usize, bool)>,
}

/// Edges of moving bodies, in the order of the scene. `places`: of the vertices at rest.
fn edges<E: From<Error>>(seen: &SeenScene<'_, E>, places: &[DVec3]) -> Vec<Edge> {
    let scene = seen.scene;
    let moving = scene.faces.iter().filter(|face| seen.frames.is_moving(face.body));
    let corners = moving.flat_map(|face| scene.contours.corners(face.contours.clone()));
    let nearest = corners.map(|corner| places[corner.index()].length()).fold(f64::INFINITY, f64::min);
    let [left, right] = [[0.0, 0.0], [1.0, 0.0]].map(|place| seen.view.point(place, nearest));
    let spots = spots(places, SAME_PLACE * (right - left).length());
    let spot = |vertex: VertexId| spots[vertex.index()];
    let mut edges: Vec<Edge> = Vec::new();
    // Only looked up, so its order does not matter.
    let mut known = HashMap::new();
    for (idx, face) in scene.faces.iter().enumerate().filter(|(_, face)| seen.frames.is_moving(face.body)) {
        for [a, b] in face_edges(scene, face) {
            let (from, to) = (spot(a), spot(b));
            if from == to {
                continue;
            }
            let key = (from.min(to), from.max(to), face.body);
            let edge = *known.entry(key).or_insert_with(|| {
                edges.push(Edge { ends: [a, b], faces: Vec::new() });
                edges.len() - 1
            });
            let is_forth = spot(edges[edge].ends[0]) == from;
            edges[edge].faces.push((idx, is_forth));
        }
    }
    edges
}

impl Edge {
    /// True if the edge is drawn where it is not occluded.
    fn is_shown(&self, faces: &Faces<'_>) -> bool {
        let &[(one, one_forth), (other, other_forth)] = self.faces.as_slice() else { return true };
        let ((normal, is_front), (other_normal, other_is_front)) = (faces.normal(one), faces.normal(other));
        // Faces of one surface run opposite ways along their edge; else one of them is turned.
        let is_turned = one_forth == other_forth;
        // Or one lies in a hole of the other.
        if is_turned && normal.dot(other_normal) > COPLANAR {
            return false;
        }
        if is_front != (other_is_front != is_turned) {
            return true;
        }
        let is_smooth = self.ends.iter().all(|end| faces.scene.vertices[end.index()].normal.is_some());
        let cosine = normal.dot(other_normal) * if is_turned { -1.0 } else { 1.0 };
        cosine < CREASE && !is_smooth
    }
}
