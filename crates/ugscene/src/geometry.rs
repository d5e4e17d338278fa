//! Transformation between rest positions and seen positions, also with effects omitted.

use glam::DVec3;
use rayon::prelude::*;
use ugphysics::{Event, Velocity, contracted, elongated, flight_time, rest_position, seen_position};

use crate::{
    BodyId, Face, RestFrames, RestPosition, Scene, SeenPosition, Vertex, VertexId, seen_event, seen_normal,
    vertex_bodies,
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

/// The points of bodies that are seen at the vertices of a scene, as columns.
#[derive(Clone, Debug)]
pub struct SeenVertices {
    /// The body of each vertex.
    pub bodies: Vec<BodyId>,
    /// The rest position of each vertex, see [`rest_positions`]; empty if it is not needed.
    pub rest: Vec<DVec3>,
    /// For each vertex of a body on a world line, the own time at emission; NaN for others, and where
    /// no point of the body can be seen. Empty without such bodies.
    own_times: Vec<f64>,
}

impl SeenVertices {
    /// `eye`: in scene coordinates. The columns of the scene where it has them ([`Scene::rest`]); else
    /// they follow from seen positions, by (P4) and (P45).
    pub fn new(scene: &Scene, eye: DVec3, frames: &RestFrames, needs_rest: bool) -> Self {
        let bodies = vertex_bodies(scene);
        let is_known = !scene.rest.is_empty();
        if is_known && (needs_rest || frames.have_world_lines()) {
            return Self { bodies, rest: scene.rest.clone(), own_times: scene.own_times.clone() };
        }
        let rest = |(vertex, &body): (&Vertex, &BodyId)| {
            let seen = vertex.position - eye;
            let motion = frames.motion(body);
            match motion.world_line() {
                Some(line) => line.at_event(seen_event(seen)).unwrap_or((DVec3::NAN, f64::NAN)),
                None => (motion.turned_back(motion.rest(SeenPosition(seen)).0), f64::NAN),
            }
        };
        let vertices = || scene.vertices.par_iter().zip(&bodies);
        let (rest, own_times) = if frames.have_world_lines() {
            vertices().map(rest).unzip()
        } else if !needs_rest {
            (Vec::new(), Vec::new())
        } else if frames.are_at_rest() {
            (vertices().map(|(vertex, _)| vertex.position - eye).collect(), Vec::new())
        } else {
            (vertices().map(|vertex| rest(vertex).0).collect(), Vec::new())
        };
        Self { bodies, rest, own_times }
    }

    /// For a vertex of a body on a world line, the own time at which its light left; `None` if no
    /// point of the body can be seen there.
    #[inline]
    pub fn own_time(&self, row: usize) -> Option<f64> {
        self.own_times.get(row).copied().filter(|own_time| !own_time.is_nan())
    }

    /// The velocity of the point at a vertex, in the frame of the camera: on a world line that at
    /// emission; where no point of the body can be seen, that at own time 0.
    pub fn velocity(&self, row: usize, frames: &RestFrames) -> Velocity {
        let body = self.bodies[row];
        let of_line = |own_time| frames.world_line(body)?.velocity(self.rest[row], own_time).ok();
        self.own_time(row).and_then(of_line).unwrap_or(frames.velocity(body))
    }

    /// The rest normal of a face on the side that is seen from `eye`.
    pub fn seen_normal(&self, scene: &Scene, face: &Face, (eye, frames): (DVec3, &RestFrames)) -> DVec3 {
        let outline = scene.contours.get(face.contours.start);
        let first = outline[0].index();
        let facing = |own_time| {
            let Event { t, x } = seen_event(scene.vertices[first].position - eye);
            let ray = Event { t: -t, x: -x };
            Some(frames.world_line(face.body)?.facing_covector(self.rest[first], own_time, ray))
        };
        let toward_eye = self.own_time(first).and_then(facing).unwrap_or(-self.rest[first]);
        seen_normal(outline.iter().map(|corner| self.rest[corner.index()]), toward_eye)
    }

    /// Adds a copy of a vertex.
    pub fn copy(&mut self, original: VertexId) {
        let row = original.index();
        self.bodies.push(self.bodies[row]);
        self.rest.extend(self.rest.get(row).copied());
        self.own_times.extend(self.own_times.get(row).copied());
    }
}

/// The rest position of every vertex of a scene as seen: relative to the eye, in the rest frame of
/// its body, with the axes of the scene. [`Scene::rest`] if it is known, else (P4), (P25), or (P45)
/// for bodies on world lines; NaN where such a body cannot be seen.
pub fn rest_positions(scene: &Scene, eye: DVec3, frames: &RestFrames) -> Vec<DVec3> {
    SeenVertices::new(scene, eye, frames, true).rest
}
