//! The rest frames of a scene's bodies, and which body a vertex is part of.

use glam::{DQuat, DVec3};
use ugparse::{BodyId, Motion, Scene};
use ugphysics::Velocity;

use crate::{axes_from_scene, camera_velocity, split_vertices};

/// The rest frame of each body relative to the frame of the camera.
#[derive(Clone, Debug)]
pub struct RestFrames {
    /// In the order of [`Scene::bodies`].
    velocities: Vec<Velocity>,
    /// For each body, see [`RestFrames::scene_from_axes`].
    scene_from_axes: Vec<DQuat>,
    /// For each body, see [`RestFrames::lamp_shift`]; empty if all are 0.
    lamp_shifts: Vec<DVec3>,
    /// Velocity of the camera, in the frame the scene was written in.
    camera: Velocity,
}

impl RestFrames {
    /// The rest frames of the bodies of `scene`.
    pub fn new(scene: &Scene) -> Self {
        let velocity = |motion: Motion| match motion {
            Motion::Inertial(velocity) => velocity,
        };
        let velocities: Vec<Velocity> = scene.bodies.iter().map(|body| velocity(body.motion)).collect();
        let camera = camera_velocity(scene);
        let turned = |&velocity: &Velocity| axes_from_scene(velocity, camera).inverse();
        let scene_from_axes = velocities.iter().map(turned).collect();
        let shift = |velocity: &Velocity| {
            let own = scene.lamp_shifts.iter().find(|shift| shift.velocity == *velocity);
            own.map_or(DVec3::ZERO, |own| own.shift)
        };
        let are_shifted = !scene.lamp_shifts.is_empty();
        let lamp_shifts = velocities.iter().filter(|_| are_shifted).map(shift).collect();
        Self { velocities, scene_from_axes, lamp_shifts, camera }
    }

    /// With `velocity` for bodies whose motion is not stated.
    #[must_use]
    pub fn with_unstated(mut self, velocity: Velocity) -> Self {
        self.velocities[BodyId::UNSTATED.index()] = velocity;
        self.scene_from_axes[BodyId::UNSTATED.index()] = axes_from_scene(velocity, self.camera).inverse();
        self
    }

    /// The velocity of a body in the frame of the camera.
    pub fn velocity(&self, body: BodyId) -> Velocity {
        self.velocities[body.index()]
    }

    /// Turns rest coordinates of a body, as (P4) gives them, into the axes of the scene, where
    /// lights and normals are. The identity unless the camera moves in the scene.  Eq. (P25)
    pub fn scene_from_axes(&self, body: BodyId) -> DQuat {
        self.scene_from_axes[body.index()]
    }

    /// What is added to the positions of lamps that rest with whatever they light, when they light
    /// this body, in the axes of the scene.
    #[inline]
    pub fn lamp_shift(&self, body: BodyId) -> DVec3 {
        self.lamp_shifts.get(body.index()).copied().unwrap_or_default()
    }

    /// True if nothing moves.
    pub fn are_at_rest(&self) -> bool {
        self.velocities.iter().all(|v| v.is_zero())
    }
}

/// The body of each vertex, from the faces and wires that use it; [`BodyId::UNSTATED`] for unused
/// vertices.
///
/// A vertex shared by several bodies is part of the first of them. [`separate_bodies`] removes such
/// sharing.
pub fn vertex_bodies(scene: &Scene) -> Vec<BodyId> {
    let mut bodies = vec![BodyId::UNSTATED; scene.vertices.len()];
    // In reverse, so that the first user is written last.
    for (rows, body) in users(scene).rev() {
        for corner in scene.contours.corners(rows) {
            bodies[corner.index()] = body;
        }
    }
    bodies
}

/// Faces and wires: their contours and body.
fn users(scene: &Scene) -> impl DoubleEndedIterator<Item = (std::ops::Range<u32>, BodyId)> {
    let faces = scene.faces.iter().map(|face| (face.contours.clone(), face.body));
    let wires = scene.wires.iter().map(|wire| (wire.contours.clone(), wire.body));
    faces.chain(wires)
}

/// True if all faces and wires are part of one body; [`separate_bodies`] then changes nothing.
pub fn is_one_body(scene: &Scene) -> bool {
    let first = users(scene).next().map(|(_, body)| body);
    scene.bodies.len() == 1 || users(scene).all(|(_, body)| Some(body) == first)
}

/// Gives every body its own vertices: where faces or wires of different bodies share a vertex, the
/// later ones get a copy, named after it.
pub fn separate_bodies(scene: &mut Scene) {
    if !is_one_body(scene) {
        let users: Vec<_> = users(scene).collect();
        split_vertices(scene, &users, |_| true);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(text: &str) -> Scene {
        ugparse::parse(&ugparse::Source::new("t.ug", text), &ugparse::Options::default()).unwrap().scene
    }

    #[test]
    fn shared_vertices_are_copied_once_for_each_body() {
        let mut scene = scene(
            "v a 0 0 0; v b 1 0 0; v c 0 1 0; v a_2 9 9 9;
             f x (a b c) <0.5 0 0>; f y (c b a) <0 0.5 0>; f z (a b c) <0 0.5 0>; w (a b);",
        );
        separate_bodies(&mut scene);
        assert_eq!(scene.vertices.len(), 4 + 3 + 2);
        let names: Vec<&str> = scene.vertices[4..].iter().map(|v| scene.names.get(v.name)).collect();
        assert_eq!(names, ["c_2", "b_2", "a_3", "a_4", "b_3"]);
        let bodies = vertex_bodies(&scene);
        for face in &scene.faces {
            for corner in scene.contours.corners(face.contours.clone()) {
                assert_eq!(bodies[corner.index()], face.body);
            }
        }
    }

    #[test]
    fn one_body_is_left_alone() {
        let before = scene("v a 0 0 0; v b 1 0 0; v c 0 1 0; f (a b c) <0.5 0 0>; f (c b a) <0.5 0 0>;");
        let mut after = before.clone();
        separate_bodies(&mut after);
        assert_eq!(before, after);
    }
}
