//! The edges of moving bodies as they would look at rest.
//!
//! Each body is given back its rest shape (P4), and is placed so that its centre, that of its box in its rest frame,
//! stands where it is seen (P3). So the outline is what the eye would see if the same body rested there, and of a
//! body placed by `uglorentz -in` just what the scene shows at rest. Drawn are the edges that the eye sees: where a face
//! that is turned to it meets one that is not, borders, and creases; other faces of the ideal scene hide them, those
//! of the picture do not.

use std::collections::HashMap;

use glam::DVec3;
use uglabel::{Drawing, Point};
use ugparse::{BodyId, Scene, VertexId, newell_normal};
use ugscene::{Geometry, View, vertex_bodies};

use super::depths::{Depths, Spot};
use super::style::Style;
use crate::config::Config;
use crate::error::Error;
use crate::setup::Setup;

/// Faces that meet at less than this angle are one bent surface: its cosine, of 35 degrees.
const CREASE: f64 = 0.819;

/// The same of faces in one plane.
const COPLANAR: f64 = 0.9999;

/// How far beside a line it is asked what goes on there, in pixels.
const ASIDE: f64 = 1.6;

/// What is so far from the plane of a face, in parts of its distance from the eye, still lies in it.
const FLAT: f64 = 3e-3;

/// Draws the outlines. `setup`: with one sample for each pixel, and `config` of the same.
///
/// # Errors
/// As for pictures.
pub fn draw(
    setup: &Setup<'_>,
    config: &Config,
    style: &Style,
    drawing: &mut Drawing,
) -> Result<Option<String>, Error> {
    let scene = setup.scene();
    let is_moving = |body: BodyId| !setup.surface.velocity(body).is_zero();
    if !scene.faces.iter().any(|face| is_moving(face.body)) {
        return Ok(Some("nothing moves, so there is no undistorted outline (-dl) beside the picture".into()));
    }
    let places = ideal_places(setup);
    let ideal = ideal_scene(scene, setup.view.eye, &places);
    // The camera looks where it looked, although the middle of the scene is elsewhere.
    let mut still = Config { exact: None, ..config.clone() };
    still.camera.eye = Some(setup.view.eye);
    still.camera.center = Some(setup.view.eye + setup.view.distance * setup.view.forward);
    let ideal = Setup::new(&ideal, &still)?;
    let depths = Depths::new(&ideal, &still.draw_mode());
    let mut lines = Vec::new();
    let faces = Faces { scene, places: &places, view: &setup.view };
    for edge in edges(scene, &is_moving).iter().filter(|edge| edge.is_shown(&faces)) {
        let ends = edge.ends.map(|vertex| places[vertex.index()]);
        lines.extend(depths.visible_where(&setup.view, ends, |spot, across| {
            edge.faces.len() == 2 || !faces.go_on(&depths, spot, across)
        }));
    }
    let width = style.hairline;
    drawing.lines(lines.clone(), 3.0 * width, style.ground);
    drawing.lines(lines, width, style.ink);
    Ok(None)
}

/// Where each vertex would be, relative to the eye.
fn ideal_places(setup: &Setup<'_>) -> Vec<DVec3> {
    let scene = setup.scene();
    let geometry = Geometry::of(scene);
    let bodies = vertex_bodies(scene);
    let shift = |body: BodyId| {
        let rest = (0..scene.vertices.len()).filter(|&vertex| bodies[vertex] == body);
        let rest = rest.map(|vertex| setup.surface.rest(VertexId::from_index(vertex)));
        let bounds = rest.fold(None, |bounds: Option<[DVec3; 2]>, place| {
            Some(bounds.map_or([place; 2], |[low, high]| [low.min(place), high.max(place)]))
        });
        let velocity = setup.surface.velocity(body);
        bounds.filter(|_| !velocity.is_zero()).map(|[low, high]| {
            let center = 0.5 * low + 0.5 * high;
            let of_body = setup.surface.scene_from_axes(body).inverse() * center;
            geometry.seen(of_body, velocity) - center
        })
    };
    let shifts: Vec<Option<DVec3>> = scene.bodies.ids().map(shift).collect();
    let place = |(vertex, body): (usize, &BodyId)| match shifts[body.index()] {
        Some(shift) => setup.surface.rest(VertexId::from_index(vertex)) + shift,
        None => scene.vertices[vertex].position - setup.view.eye,
    };
    bodies.iter().enumerate().map(place).collect()
}

/// The scene with its vertices there, and nothing in motion.
fn ideal_scene(scene: &Scene, eye: DVec3, places: &[DVec3]) -> Scene {
    let mut ideal = scene.clone();
    for (vertex, place) in ideal.vertices.iter_mut().zip(places) {
        vertex.position = eye + *place;
    }
    ideal.faces.iter_mut().for_each(|face| face.body = BodyId::UNSTATED);
    ideal.wires.clear();
    ideal
}

/// The faces of the ideal scene.
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
        let normal = newell_normal(corners).normalize_or_zero();
        let toward =
            if self.view.is_perspective { -self.places[outline[0].index()] } else { -self.view.forward };
        (normal, normal.dot(toward) > 0.0)
    }

    /// True if one surface goes on at both sides of a place on a line, though it may be made of faces that do not
    /// share this edge: cut another way, or let into each other.
    fn go_on(&self, depths: &Depths, spot: Spot, across: Point) -> bool {
        let point = depths.point(self.view, spot);
        let side = |by: f64| {
            let face = depths.face_at([spot[0] + by * across[0], spot[1] + by * across[1]])?;
            let corner = self.scene.face_contours(&self.scene.faces[face]).next()?.first()?;
            let (normal, is_front) = self.normal(face);
            let height = normal.dot(point - self.places[corner.index()]).abs();
            (height <= FLAT * point.length()).then_some(if is_front { normal } else { -normal })
        };
        matches!((side(ASIDE), side(-ASIDE)), (Some(one), Some(other)) if one.dot(other) > CREASE)
    }
}

/// An edge of faces, from its first use.
struct Edge {
    ends: [VertexId; 2],
    /// Faces that have it, and whether they run from the first end to the second.
    faces: Vec<(usize, bool)>,
}

/// Edges of moving bodies, in the order of the scene.
fn edges(scene: &Scene, is_moving: &dyn Fn(BodyId) -> bool) -> Vec<Edge> {
    // A vertex that was repeated, for another colour, is in the same place.
    let spot = |vertex: VertexId| scene.vertices[vertex.index()].position.to_array().map(f64::to_bits);
    let mut edges: Vec<Edge> = Vec::new();
    // Only looked up, so its order is never seen.
    let mut known = HashMap::new();
    for (idx, face) in scene.faces.iter().enumerate().filter(|(_, face)| is_moving(face.body)) {
        for contour in scene.face_contours(face) {
            for (&a, &b) in contour.iter().zip(contour.iter().cycle().skip(1)) {
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
    }
    edges
}

impl Edge {
    /// True if it is drawn where nothing hides it.
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
