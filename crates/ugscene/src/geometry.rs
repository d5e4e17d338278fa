//! Transformation between rest positions and seen positions, also with effects omitted.

use glam::DVec3;
use rayon::prelude::*;
use ugphysics::{Velocity, contracted, elongated, flight_time, rest_position, seen_position};

use crate::{
    BodyId, RestFrames, RestPosition, Scene, SeenPosition, Vertex, VertexId, WorldLinePoint, vertex_bodies,
};

/// Which of the two effects are included in the seen positions of a scene: both, unless its stage
/// says otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Geometry {
    /// Lorentz contraction, (P1).
    pub contraction: bool,
    /// Time of flight, (P2).
    pub flight_time: bool,
}

impl Default for Geometry {
    fn default() -> Self {
        Self { contraction: true, flight_time: true }
    }
}

impl Geometry {
    /// The effects that the stage of a scene states.
    pub fn of(scene: &Scene) -> Self {
        match scene.stage.seen_geometry() {
            Some(seen) => Self { contraction: seen.contraction, flight_time: seen.flight_time },
            None => Self::default(),
        }
    }

    /// The seen position of a point of a body: (P3), or (P1) or (P2) alone.
    pub fn seen(self, RestPosition(rest): RestPosition, v: Velocity) -> SeenPosition {
        SeenPosition(match (self.contraction, self.flight_time) {
            (true, true) => seen_position(rest, v),
            (true, false) => contracted(rest, v),
            (false, true) => rest + flight_time(rest, v) * v.beta(),
            (false, false) => rest,
        })
    }

    /// The inverse of [`Geometry::seen`]; (P4) with both effects.
    pub fn rest(self, SeenPosition(seen): SeenPosition, v: Velocity) -> RestPosition {
        RestPosition(match (self.contraction, self.flight_time) {
            (true, true) => rest_position(seen, v),
            (true, false) => elongated(seen, v),
            // The light left at time −|seen|; since then the body has moved with v.
            (false, true) => seen + seen.length() * v.beta(),
            (false, false) => seen,
        })
    }
}

impl Geometry {
    /// A normal of the seen surface from that of the surface at rest, with the same axes. Any
    /// length; it stays on the same side.
    ///
    /// Planes through a point transform by the gradient of the rest position with respect to the
    /// seen one, the transpose of the Jacobian of (P4): with p' = p + (γ − 1)(p·b) b + γ |p| β and
    /// b along β, n = n' + (γ − 1)(n'·b) b + γ (n'·β) p/|p|. At the eye, where it does not exist,
    /// without the last term.
    pub fn seen_normal(
        self,
        RestPosition(rest): RestPosition,
        SeenPosition(seen): SeenPosition,
        v: Velocity,
    ) -> DVec3 {
        if v.is_zero() {
            return rest;
        }
        let mut normal = rest;
        if self.contraction {
            normal += v.gamma_minus_one() * rest.dot(v.direction()) * v.direction();
        }
        if self.flight_time {
            let gamma = if self.contraction { v.gamma() } else { 1.0 };
            normal += gamma * rest.dot(v.beta()) * seen.normalize_or_zero();
        }
        normal
    }
}

/// The points of bodies that are seen at the vertices of a scene.
#[derive(Clone, Debug)]
pub struct SeenVertices {
    /// The body of each vertex.
    pub bodies: Vec<BodyId>,
    /// For each vertex of a body on a world line, the point that is seen there; empty without such
    /// bodies.
    pub on_world_lines: Vec<Option<WorldLinePoint>>,
}

impl SeenVertices {
    /// `eye`: in scene coordinates.
    pub fn new(scene: &Scene, eye: DVec3, frames: &RestFrames) -> Self {
        let bodies = vertex_bodies(scene);
        let point = |(vertex, &body): (&Vertex, &BodyId)| {
            WorldLinePoint::new(frames.world_line(body)?, vertex.position - eye)
        };
        let vertices = scene.vertices.par_iter().zip(&bodies).filter(|_| frames.have_world_lines());
        let on_world_lines = vertices.map(point).collect();
        Self { bodies, on_world_lines }
    }

    /// The point at a vertex of a body on a world line.
    #[inline]
    pub fn on_world_line(&self, row: usize) -> Option<&WorldLinePoint> {
        self.on_world_lines.get(row)?.as_ref()
    }

    /// The velocity of the point at a vertex, in the frame of the camera: on a world line that at
    /// emission; where no point of the body can be seen, that at own time 0.
    pub fn velocity(&self, row: usize, frames: &RestFrames) -> Velocity {
        let at_own_time_0 = frames.velocity(self.bodies[row]);
        self.on_world_line(row).map_or(at_own_time_0, |point| point.velocity)
    }

    /// Adds a copy of a vertex.
    pub fn copy(&mut self, original: VertexId) {
        self.bodies.push(self.bodies[original.index()]);
        self.on_world_lines.extend(self.on_world_lines.get(original.index()).copied());
    }

    /// See [`rest_positions`].
    pub fn rest_positions(&self, scene: &Scene, eye: DVec3, frames: &RestFrames) -> Vec<DVec3> {
        if !scene.rest.is_empty() {
            return scene.rest.clone();
        }
        if frames.are_at_rest() {
            return scene.vertices.par_iter().map(|vertex| vertex.position - eye).collect();
        }
        let geometry = Geometry::of(scene);
        let vertices = scene.vertices.par_iter().zip(&self.bodies).enumerate();
        let rest = |(row, (vertex, &body)): (usize, (&Vertex, &BodyId))| {
            if frames.world_line(body).is_some() {
                return self.on_world_line(row).map_or(DVec3::NAN, |point| point.point);
            }
            let seen = SeenPosition(vertex.position - eye);
            frames.of(body).scene_from_boosted() * geometry.rest(seen, frames.velocity(body)).0
        };
        vertices.map(rest).collect()
    }
}

/// The rest position of every vertex of a scene as seen: relative to the eye, in the rest frame of
/// its body, with the axes of the scene. [`Scene::rest`] if it is known, else (P4), (P25), or (P45)
/// for bodies on world lines; NaN where such a body cannot be seen.
pub fn rest_positions(scene: &Scene, eye: DVec3, frames: &RestFrames) -> Vec<DVec3> {
    SeenVertices::new(scene, eye, frames).rest_positions(scene, eye, frames)
}
