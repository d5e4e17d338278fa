//! The edges of moving bodies as they would look at rest.
//!
//! Each body gets its rest shape (P4), placed so that its centre (of its bounding box in its rest
//! frame) is at the apparent position of that centre (P3). The outline is thus what the eye would
//! see if the body rested there; for a body placed by `uglorentz -in` it is the body in the scene
//! at rest. A spinning body is turned as its centre is seen. Only edges that the eye sees are
//! drawn: edges between front and back faces, borders, and creases. Other faces of the scene at
//! rest occlude them, those of the picture do not.

use std::collections::HashMap;

use glam::{DQuat, DVec3};
use ugimage::figure::Point;
use ugimage::label::Drawing;
use ugphysics::{Event, WorldLine};
use ugscene::{
    BodyId, Face, Geometry, RestPosition, Scene, VertexId, View, face_edges, rest_positions, unit_normal,
    vertex_bodies,
};

use super::seen::SeenScene;
use super::style::Style;
use super::visible::{DepthPoint, VisibleLines};
use crate::depth_buffer::DepthBuffer;

/// Cosine of the angle, 35 degrees, below which adjacent faces count as one curved surface.
const CREASE: f64 = 0.819;

/// Cosine of the angle below which faces count as coplanar.
const COPLANAR: f64 = 0.9999;

/// Distance from a line, in pixels, at which the surfaces beside it are tested.
const ASIDE: f64 = 1.6;

/// Points closer than this to the plane of a face, relative to their distance from the eye, count
/// as in the plane.
const FLAT: f64 = 3e-3;

/// As [`BEHIND`], of faces that are connected with the edge, so that they are placed as exactly.
const JUST_BEHIND: f64 = 1e-6;

/// Points further than this behind the plane of a face, relative to their distance from the eye,
/// are behind it: a tenth of a pixel of a face that is seen at 45 degrees.
const BEHIND: f64 = 1e-4;

/// The scene for the outlines: moving bodies as they would look at rest.
pub struct IdealScene {
    /// The scene, in which nothing moves.
    pub scene: Scene,
    /// Positions of its vertices relative to the eye.
    places: Vec<DVec3>,
}

impl IdealScene {
    /// `None` if nothing moves.
    pub fn new(seen: &SeenScene<'_>) -> Option<Self> {
        let is_moving = |body: BodyId| seen.is_moving(body);
        if !seen.scene.faces.iter().any(|face| is_moving(face.body)) {
            return None;
        }
        let places = ideal_places(seen);
        Some(Self { scene: ideal_scene(seen.scene, seen.view.eye, &places), places })
    }
}

/// Draws the outlines. `depths`: of the ideal scene.
pub fn draw(
    seen: &SeenScene<'_>,
    ideal: &IdealScene,
    depths: &DepthBuffer,
    style: &Style,
    drawing: &mut Drawing,
) {
    let IdealScene { places, .. } = ideal;
    let is_moving = |body: BodyId| seen.is_moving(body);
    let visible = VisibleLines { view: &seen.view, depths };
    let mut lines = Vec::new();
    let faces = Faces::new(seen.scene, places, &seen.view);
    for edge in edges(seen.scene, &is_moving).iter().filter(|edge| edge.is_shown(&faces)) {
        let ends = edge.ends.map(|vertex| places[vertex.index()]);
        lines.extend(visible.visible_where(ends, |place, across| {
            !faces.hide(&visible, edge, place)
                && (edge.faces.len() == 2 || !faces.go_on(&visible, place, across))
        }));
    }
    let width = style.hairline;
    drawing.lines(lines.clone(), 3.0 * width, style.background);
    drawing.lines(lines, width, style.ink);
}

/// How the rest shape of a body is placed.
#[derive(Clone, Copy)]
struct Standing {
    /// A turn about a centre, of a body on a world line.
    turn: Option<(DQuat, DVec3)>,
    shift: DVec3,
}

impl Standing {
    fn shifted(shift: DVec3) -> Self {
        Self { turn: None, shift }
    }
}

/// A body on a world line, turned as its centre is seen.
fn standing(line: &WorldLine, center: DVec3) -> Standing {
    match line.emission(center, Event { t: 0.0, x: DVec3::ZERO }) {
        Ok(emission) => Standing {
            turn: Some((line.pose(emission.own_time).turn, center)),
            shift: emission.event.x - center,
        },
        Err(_) => Standing::shifted(DVec3::ZERO),
    }
}

/// The position of each vertex at rest, relative to the eye.
fn ideal_places(seen: &SeenScene<'_>) -> Vec<DVec3> {
    let scene = seen.scene;
    let at_rest = rest_positions(scene, seen.view.eye, &seen.frames);
    let geometry = Geometry::of(scene);
    let bodies = vertex_bodies(scene);
    let shift = |body: BodyId| {
        let rest = (0..scene.vertices.len()).filter(|&vertex| bodies[vertex] == body);
        let rest = rest.map(|vertex| at_rest[vertex]);
        let bounds = rest.fold(None, |bounds: Option<[DVec3; 2]>, place| {
            Some(bounds.map_or([place; 2], |[low, high]| [low.min(place), high.max(place)]))
        });
        let velocity = seen.frames.velocity(body);
        bounds.filter(|_| seen.is_moving(body)).map(|[low, high]| {
            let center = 0.5 * low + 0.5 * high;
            if let Some(line) = seen.frames.world_line(body) {
                return standing(line, center);
            }
            let rest = RestPosition(seen.frames.of(body).scene_from_boosted().inverse() * center);
            Standing::shifted(geometry.seen(rest, velocity).0 - center)
        })
    };
    let shifts: Vec<Option<Standing>> = scene.bodies.ids().map(shift).collect();
    let place = |(vertex, body): (usize, &BodyId)| match shifts[body.index()] {
        Some(Standing { turn: None, shift }) => at_rest[vertex] + shift,
        Some(Standing { turn: Some((turn, center)), shift }) => {
            center + turn * (at_rest[vertex] - center) + shift
        }
        None => scene.vertices[vertex].position - seen.view.eye,
    };
    bodies.iter().enumerate().map(place).collect()
}

/// The scene with its vertices at `places`, and nothing in motion.
fn ideal_scene(scene: &Scene, eye: DVec3, places: &[DVec3]) -> Scene {
    let mut ideal = scene.clone();
    for (vertex, place) in ideal.vertices.iter_mut().zip(places) {
        vertex.position = eye + *place;
    }
    ideal.rest.clear();
    let body = ideal.bodies.unstated();
    ideal.faces.iter_mut().for_each(|face| face.body = body);
    ideal.wires.clear();
    ideal
}

/// The faces of the ideal scene.
struct Faces<'a> {
    scene: &'a Scene,
    places: &'a [DVec3],
    view: &'a View,
    /// For each face, the surface that it is part of: faces that are connected by vertices at the
    /// same positions.
    surfaces: Vec<usize>,
}

impl<'a> Faces<'a> {
    fn new(scene: &'a Scene, places: &'a [DVec3], view: &'a View) -> Self {
        Self { scene, places, view, surfaces: surfaces(scene) }
    }

    /// True if a face in the pixels around a point of an edge hides it.
    ///
    /// [`VisibleLines`] tolerates what is a little nearer, and what is beside the point, since
    /// faces of the surface that ends at an edge are seen so. A silhouette continues behind its own
    /// surface, nearer to it than that tolerance, so each of these faces is tested exactly.
    fn hide(&self, visible: &VisibleLines<'_>, edge: &Edge, place: DepthPoint) -> bool {
        let point = visible.point(place);
        let is_own = |face: usize| edge.faces.iter().any(|&(own, _)| own == face);
        let is_connected =
            |face: usize| edge.faces.iter().any(|&(own, _)| self.surfaces[own] == self.surfaces[face]);
        let behind = |face: usize| if is_connected(face) { JUST_BEHIND } else { BEHIND };
        self.hides_by_plane(visible, edge, place)
            || visible.faces_around([place[0], place[1]]).any(|face| {
                !is_own(face)
                    && self.is_behind(face, point, behind(face))
                    && self.covers(visible, face, place)
            })
    }

    /// True if the face in the pixel of a point of an edge is part of another surface, or the edge
    /// is not where its surface ends, and the point is behind the plane of the face.
    fn hides_by_plane(&self, visible: &VisibleLines<'_>, edge: &Edge, place: DepthPoint) -> bool {
        let Some(face) = visible.face_at([place[0], place[1]]) else { return false };
        let is_own = edge.faces.iter().any(|&(own, _)| own == face);
        let is_of_surface = edge.faces.iter().any(|&(own, _)| self.surfaces[own] == self.surfaces[face]);
        let is_turned_away = edge.faces.len() > 1 && edge.faces.iter().all(|&(own, _)| !self.normal(own).1);
        if is_own || (is_of_surface && !is_turned_away) {
            return false;
        }
        self.is_behind(face, visible.point(place), BEHIND)
    }

    /// True if a point, relative to the eye, is behind the plane of a face, by more than `least` of
    /// its distance.
    fn is_behind(&self, face: usize, point: DVec3, least: f64) -> bool {
        let outline = self.scene.face_contours(&self.scene.faces[face]).next();
        let Some(corner) = outline.and_then(<[VertexId]>::first) else { return false };
        let (normal, is_front) = self.normal(face);
        let height = normal.dot(point - self.places[corner.index()]);
        (if is_front { height } else { -height }) < -least * point.length()
    }

    /// True if a face covers a point of the picture; false if a part of it is behind the eye.
    fn covers(&self, visible: &VisibleLines<'_>, face: usize, [x, y, _]: DepthPoint) -> bool {
        let mut is_inside = false;
        for contour in self.scene.face_contours(&self.scene.faces[face]) {
            let Some(last) = contour.last() else { continue };
            let mut from = visible.depth_point(self.places[last.index()]);
            for corner in contour {
                let to = visible.depth_point(self.places[corner.index()]);
                if self.view.is_perspective && to[2] <= 0.0 {
                    return false;
                }
                let crosses = (from[1] <= y) != (to[1] <= y);
                if crosses && from[0] + (to[0] - from[0]) * (y - from[1]) / (to[1] - from[1]) > x {
                    is_inside = !is_inside;
                }
                from = to;
            }
        }
        is_inside
    }

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

    /// True if one surface continues on both sides of a point on a line, though possibly made of
    /// faces that do not share this edge: differently subdivided, or inserted into each other.
    fn go_on(&self, visible: &VisibleLines<'_>, place: DepthPoint, across: Point) -> bool {
        let point = visible.point(place);
        let side = |by: f64| {
            let face = visible.face_at([place[0] + by * across[0], place[1] + by * across[1]])?;
            let corner = self.scene.face_contours(&self.scene.faces[face]).next()?.first()?;
            let (normal, is_front) = self.normal(face);
            let height = normal.dot(point - self.places[corner.index()]).abs();
            (height <= FLAT * point.length()).then_some(if is_front { normal } else { -normal })
        };
        matches!((side(ASIDE), side(-ASIDE)), (Some(one), Some(other)) if one.dot(other) > CREASE)
    }
}

/// The surface that each face is part of, by the row of one of its vertices.
fn surfaces(scene: &Scene) -> Vec<usize> {
    // A forest: the parent of each vertex, itself for a root.
    let mut parents: Vec<usize> = (0..scene.vertices.len()).collect();
    fn root(parents: &mut [usize], mut vertex: usize) -> usize {
        while parents[vertex] != vertex {
            parents[vertex] = parents[parents[vertex]];
            vertex = parents[vertex];
        }
        vertex
    }
    let mut join = |a: usize, b: usize| {
        let (a, b) = (root(&mut parents, a), root(&mut parents, b));
        parents[a] = b;
    };
    // Only looked up, so its order does not matter.
    let mut known = HashMap::new();
    for (row, vertex) in scene.vertices.iter().enumerate() {
        join(*known.entry(vertex.position.to_array().map(f64::to_bits)).or_insert(row), row);
    }
    let first = |face: &Face| scene.contours.corners(face.contours.clone())[0].index();
    for face in &scene.faces {
        let corners = scene.contours.corners(face.contours.clone());
        corners.iter().for_each(|corner| join(first(face), corner.index()));
    }
    scene.faces.iter().map(|face| root(&mut parents, first(face))).collect()
}

/// An edge of faces, stored once.
struct Edge {
    ends: [VertexId; 2],
    /// The faces that share it, and whether they run from the first end to the second.
    faces: Vec<(usize, bool)>,
}

/// Edges of moving bodies, in the order of the scene.
fn edges(scene: &Scene, is_moving: &dyn Fn(BodyId) -> bool) -> Vec<Edge> {
    // A vertex repeated for another colour is at the same position.
    let spot = |vertex: VertexId| scene.vertices[vertex.index()].position.to_array().map(f64::to_bits);
    let mut edges: Vec<Edge> = Vec::new();
    // Only looked up, so its order does not matter.
    let mut known = HashMap::new();
    for (idx, face) in scene.faces.iter().enumerate().filter(|(_, face)| is_moving(face.body)) {
        for [a, b] in face_edges(scene, face) {
            let (from, to) = (spot(a), spot(b));
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
