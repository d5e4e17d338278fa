//! Columns of a scene as seen: rest positions and own times of its vertices.

use glam::DVec3;
use rayon::prelude::*;
use ugphysics::{Event, Velocity};

use crate::{
    BodyId, Face, RestFrames, Scene, SeenPosition, Vertex, VertexId, seen_event, seen_normal,
    vertex_bodies,
};

/// The points of bodies that are seen at the vertices of a scene, as columns.
#[derive(Clone, Debug)]
pub struct SeenVertices {
    /// The body of each vertex.
    pub bodies: Vec<BodyId>,
    /// The rest position of each vertex, see [`rest_positions`]; empty if it is not needed.
    pub rest: Vec<DVec3>,
    /// For each vertex of a body on a world line, the own time at emission; NaN for others, and
    /// where no point of the body can be seen. Empty without such bodies.
    own_times: Vec<f64>,
}

impl SeenVertices {
    /// `eye`: in scene coordinates. The columns of the scene where it has them ([`Scene::rest`]);
    /// else they follow from seen positions, by (P4) and (P45).
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
    pub fn seen_normal(
        &self,
        scene: &Scene,
        face: &Face,
        (eye, frames): (DVec3, &RestFrames),
    ) -> DVec3 {
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
