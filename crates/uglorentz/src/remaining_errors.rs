//! Measures the errors of the output: the rules of [`crate::edge`] on all its edges and faces.

use glam::DVec3;
use rayon::prelude::*;
use ugscene::{Face, Scene, VertexId, Wire, face_edges};

use crate::criterion::Bounds;
use crate::edge::{self, Shown};
use crate::pieces::{Cut, Shape, shape};
use crate::refined_mesh::RefinedMesh;
use crate::relative_motion::{Point, RelativeMotion};
use crate::report::{LargestError, RemainingErrors};
use crate::{color, early_accept, edge_on, interior};

/// The largest visible errors of all edges and faces of a subdivided scene.
pub(crate) fn measure(scene: &Scene, mesh: &RefinedMesh, bounds: &Bounds) -> RemainingErrors {
    let meter = ErrorMeter { scene, mesh, bounds };
    let faces =
        scene.faces.par_iter().map(|face| meter.face(face)).reduce(Errors::default, Errors::or);
    let wires =
        scene.wires.par_iter().map(|wire| meter.wire(wire)).reduce(Errors::default, Errors::or);
    let found = faces.or(wires);
    let largest = |(error, at): ErrorAt| {
        let name = |row: &u32| scene.names.get(scene.vertices[*row as usize].name).to_string();
        LargestError {
            error,
            at: if error > 0.0 { at.iter().flatten().map(name).collect() } else { Vec::new() },
        }
    };
    RemainingErrors {
        angle: largest(found.angle),
        depth: largest(found.depth),
        doppler: largest(found.doppler),
        light: (!bounds.near_lamps.is_empty()).then(|| largest(found.light)),
    }
}

/// An error and the vertices it is between.
type ErrorAt = (f64, [Option<u32>; 3]);

#[derive(Clone, Copy, Default)]
struct Errors {
    angle: ErrorAt,
    depth: ErrorAt,
    doppler: ErrorAt,
    light: ErrorAt,
}

impl Errors {
    /// The larger of each; ties go to the lower rows, so the result does not depend on threads.
    fn or(self, other: Errors) -> Errors {
        let larger = |a: ErrorAt, b: ErrorAt| {
            if b.0 > a.0 || (b.0 == a.0 && b.1 < a.1) { b } else { a }
        };
        Errors {
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
    fn face(&self, face: &Face) -> Errors {
        let corners = self.scene.face_corners(face);
        let Some(first) = corners.first() else { return Errors::default() };
        let motion = self.mesh.motion(first.0);
        let points: Vec<&Point> = corners.iter().map(|corner| self.mesh.point(corner.0)).collect();
        if self.bounds.is_outside(motion, &points) {
            return Errors::default();
        }
        let shown = self.bounds.shown(motion, &points);
        let (inside, shown) = self.inside(face, motion, &points, shown);
        let edges = face_edges(self.scene, face).map(|[a, b]| self.edge(a.0, b.0, shown));
        let edges = edges.fold(Errors::default(), Errors::or);
        edges.or(inside)
    }

    fn wire(&self, wire: &Wire) -> Errors {
        let contours = self.scene.wire_contours(wire);
        let ends = contours.flat_map(|corners| corners.windows(2));
        ends.map(|pair| self.edge(pair[0].0, pair[1].0, Shown::All))
            .fold(Errors::default(), Errors::or)
    }

    fn edge(&self, a: u32, b: u32, shown: Shown) -> Errors {
        let (low, high) = (a.min(b), a.max(b));
        let (from, to, motion) =
            (self.mesh.point(low), self.mesh.point(high), self.mesh.motion(low));
        let shown = if self.mesh.is_rim(low, high) { Shown::All } else { shown };
        let errors = edge::errors(from, to, motion, shown, color::error);
        let light = self.bounds.near_lamps.error(from, to, motion);
        let at = [Some(low), Some(high), None];
        Errors {
            angle: (errors.angle, at),
            depth: (errors.offset, at),
            doppler: (errors.color, at),
            light: (light, at),
        }
    }

    /// The error inside a face, and what is visible of its edges. Triangles are measured as they
    /// are drawn, larger polygons as they would be triangulated, with an upper bound if that fails.
    /// If the outline alone draws the face, all of its edges is visible.
    fn inside(
        &self,
        face: &Face,
        motion: &RelativeMotion,
        points: &[&Point],
        shown: Shown,
    ) -> (Errors, Shown) {
        if motion.is_at_rest() || !motion.has_flight_time() || matches!(shown, Shown::Outline) {
            return (Errors::default(), shown);
        }
        let rest = |vertex: VertexId| -> DVec3 { self.mesh.point(vertex.0).rest };
        if edge_on::is_edge_on(self.scene, face, motion, rest) {
            return (Errors::default(), Shown::All);
        }
        let Some(Cut::Pieces(shapes)) = shape(self.scene, face, true, rest) else {
            let corners = self.scene.face_corners(face);
            let at = [0, 1, 2].map(|idx| corners.get(idx).map(|corner| corner.0));
            let depth = early_accept::offset(motion, points.iter().copied());
            return (Errors { depth: (depth, at), ..Errors::default() }, Shown::All);
        };
        let halves = shapes.iter().flat_map(|shape| match *shape {
            Shape::Triangle(corners) => vec![corners],
            Shape::Quad([a, b, c, d]) => vec![[a, b, c], [a, c, d], [b, c, d], [b, d, a]],
        });
        let found = halves.map(|corners| {
            let points: [&Point; 3] = corners.map(|row| self.mesh.point(row));
            Errors {
                depth: (interior::offset(motion, points), corners.map(Some)),
                ..Errors::default()
            }
        });
        (found.fold(Errors::default(), Errors::or), shown)
    }
}
