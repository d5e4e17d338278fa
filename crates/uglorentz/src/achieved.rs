//! How right the result is: the rules of [`crate::edge`] on everything that is written.

use glam::DVec3;
use rayon::prelude::*;
use ugparse::{Face, Scene, VertexId, Wire};

use crate::criterion::Bounds;
use crate::edge::{self, Shown};
use crate::motion::{Motion, Point};
use crate::notes::{Achieved, Worst};
use crate::pieces::{Cut, Shape, shape};
use crate::refined_mesh::RefinedMesh;
use crate::{early_accept, edge_on, interior};

/// The greatest errors of all edges and faces of a scene whose pieces are in place, where they show.
pub(crate) fn measure(scene: &Scene, mesh: &RefinedMesh, bounds: &Bounds) -> Achieved {
    let meter = ErrorMeter { scene, mesh, bounds };
    let faces = scene.faces.par_iter().map(|face| meter.face(face)).reduce(Found::default, Found::or);
    let wires = scene.wires.par_iter().map(|wire| meter.wire(wire)).reduce(Found::default, Found::or);
    let found = faces.or(wires);
    let worst = |(error, at): At| {
        let name = |row: &u32| scene.names.get(scene.vertices[*row as usize].name).to_string();
        Worst { error, at: if error > 0.0 { at.iter().flatten().map(name).collect() } else { Vec::new() } }
    };
    Achieved {
        angle: worst(found.angle),
        depth: worst(found.depth),
        doppler: worst(found.doppler),
        light: (!bounds.lit.is_empty()).then(|| worst(found.light)),
    }
}

/// An error and the vertices it is between.
type At = (f64, [Option<u32>; 3]);

#[derive(Clone, Copy, Default)]
struct Found {
    angle: At,
    depth: At,
    doppler: At,
    light: At,
}

impl Found {
    /// The larger of each; of equal ones the first, so the result does not depend on threads.
    fn or(self, other: Found) -> Found {
        let larger = |a: At, b: At| {
            let first = if b.1 < a.1 { b } else { a };
            if a.0 == b.0 {
                first
            } else if b.0 > a.0 {
                b
            } else {
                a
            }
        };
        Found {
            angle: larger(self.angle, other.angle),
            depth: larger(self.depth, other.depth),
            doppler: larger(self.doppler, other.doppler),
            light: larger(self.light, other.light),
        }
    }
}

struct ErrorMeter<'a, 'b> {
    scene: &'a Scene,
    mesh: &'a RefinedMesh<'b>,
    bounds: &'a Bounds,
}

impl ErrorMeter<'_, '_> {
    fn face(&self, face: &Face) -> Found {
        let corners = self.scene.contours.corners(face.contours.clone());
        let Some(first) = corners.first() else { return Found::default() };
        let motion = self.mesh.motion(first.0);
        let points: Vec<&Point> = corners.iter().map(|corner| self.mesh.point(corner.0)).collect();
        let Some(shown) = self.bounds.shown(motion, &points) else { return Found::default() };
        let (inside, shown) = self.inside(face, motion, &points, shown);
        let ends = self
            .scene
            .face_contours(face)
            .flat_map(|corners| corners.iter().zip(corners.iter().cycle().skip(1)));
        let edges = ends.map(|(a, b)| self.edge(a.0, b.0, shown)).fold(Found::default(), Found::or);
        edges.or(inside)
    }

    fn wire(&self, wire: &Wire) -> Found {
        let contours = self.scene.wire_contours(wire);
        let ends = contours.flat_map(|corners| corners.windows(2));
        ends.map(|pair| self.edge(pair[0].0, pair[1].0, Shown::All)).fold(Found::default(), Found::or)
    }

    fn edge(&self, a: u32, b: u32, shown: Shown) -> Found {
        let (low, high) = (a.min(b), a.max(b));
        let (from, to, motion) = (self.mesh.point(low), self.mesh.point(high), self.mesh.motion(low));
        let shown = if self.mesh.is_rim(low, high) { Shown::All } else { shown };
        let errors = edge::errors(from, to, motion, shown);
        let light = self.bounds.lit.error(from, to, motion);
        let at = [Some(low), Some(high), None];
        Found {
            angle: (errors.angle, at),
            depth: (errors.offset, at),
            doppler: (errors.color, at),
            light: (light, at),
        }
    }

    /// Triangles as they are drawn, larger polygons as they would be cut, an upper bound for those that cannot be; and what
    /// is seen of the edges: all, if the outline alone draws the face.
    fn inside(&self, face: &Face, motion: &Motion, points: &[&Point], shown: Shown) -> (Found, Shown) {
        if motion.is_at_rest() || !motion.has_flight_time() || matches!(shown, Shown::Outline) {
            return (Found::default(), shown);
        }
        let rest = |vertex: VertexId| -> DVec3 { self.mesh.point(vertex.0).rest };
        if edge_on::is_edge_on(self.scene, face, motion, rest) {
            return (Found::default(), Shown::All);
        }
        let Some(Cut::Pieces(shapes)) = shape(self.scene, face, rest) else {
            let corners = self.scene.contours.corners(face.contours.clone());
            let at = [0, 1, 2].map(|idx| corners.get(idx).map(|corner| corner.0));
            let depth = early_accept::offset(motion, points.iter().copied());
            return (Found { depth: (depth, at), ..Found::default() }, Shown::All);
        };
        let halves = shapes.iter().flat_map(|shape| match *shape {
            Shape::Triangle(corners) => vec![corners],
            Shape::Quad([a, b, c, d]) => vec![[a, b, c], [a, c, d], [b, c, d], [b, d, a]],
        });
        let found = halves.map(|corners| {
            let points: [&Point; 3] = corners.map(|row| self.mesh.point(row));
            Found { depth: (interior::offset(motion, points), corners.map(Some)), ..Found::default() }
        });
        (found.fold(Found::default(), Found::or), shown)
    }
}
