//! The edges of moving bodies as they would look at rest.
//!
//! Each body gets its rest shape (P4), placed so that its centre (of its bounding box in its rest
//! frame) is at the apparent position of that centre (P3). The outline is thus what the eye would
//! see if the body rested there; for a body placed by `uglorentz -in` it is the body in the scene
//! at rest. A spinning body is turned as its centre is seen. Only edges that the eye sees are
//! drawn: edges between front and back faces, borders, and creases. They are wires of the scene at
//! rest, so its faces occlude them, and those of the picture do not.

use glam::{DQuat, DVec3};
use ugimage::label::Drawing;
use ugscene::{BodyId, Face, Scene, rest_positions, unit_normal, vertex_bodies};

use super::seen::SeenScene;
use super::style::Style;
use crate::error::Error;
use crate::note::Note;
use crate::shared_edges::{FaceEdge, Fold, shared_edges};
use crate::spots::spots;

/// Cosine of the angle, 35 degrees, below which adjacent faces count as one curved surface.
const CREASE: f64 = 0.819;

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
    let visible =
        seen.visible(ideal_scene(seen.scene, seen.view.eye, &places), &edges(seen, &places))?;
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
        let turn =
            motion.world_line().map_or(DQuat::IDENTITY, |line| line.standing(center, own_time).1);
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

/// The edges of moving bodies that are drawn where they are not occluded. `places`: of the vertices
/// at rest.
fn edges<E: From<Error>>(seen: &SeenScene<'_, E>, places: &[DVec3]) -> Vec<[DVec3; 2]> {
    let SeenScene { scene, view, frames, .. } = seen;
    let is_moving = |face: &Face| frames.is_moving(face.body);
    let moving = scene.faces.iter().filter(|face| is_moving(face));
    let corners = moving.flat_map(|face| scene.face_corners(face));
    let nearest =
        corners.map(|corner| places[corner.index()].length()).fold(f64::INFINITY, f64::min);
    let [left, right] = [[0.0, 0.0], [1.0, 0.0]].map(|place| view.point(place, nearest));
    let spots = spots(places, SAME_PLACE * (right - left).length());
    // The normal of a face, and whether the eye is on its side.
    let facing = |edge: &FaceEdge| {
        let outline = scene.contours.get(scene.faces[edge.face as usize].contours.start);
        let normal = unit_normal(outline.iter().map(|vertex| places[vertex.index()]));
        let toward = if view.is_perspective { -places[outline[0].index()] } else { -view.forward };
        (normal, normal.dot(toward) > 0.0)
    };
    let shown = |edges: &[&FaceEdge]| {
        let ends = edges[0].ends.map(|end| places[end.index()]);
        let &[one, other] = edges else { return Some(ends) };
        let [(normal, is_front), (other_normal, other_is_front)] = [one, other].map(facing);
        let fold = Fold::new([one, other], [Some(normal), Some(other_normal)]);
        // Faces of one surface run opposite ways along their edge; else one of them is turned.
        let is_silhouette = is_front != (other_is_front != fold.is_turned);
        let is_smooth = one.ends.iter().all(|end| scene.vertices[end.index()].normal.is_some());
        let is_crease = fold.cosine < CREASE && !is_smooth;
        (!fold.is_in_hole && (is_silhouette || is_crease)).then_some(ends)
    };
    shared_edges(scene, &spots, &is_moving, shown)
}
