//! The rest frames of a scene's bodies, and which body a vertex is part of.

use glam::{DQuat, DVec3};
use ugphysics::Velocity;

use crate::{BodyId, Motion, Scene, axes_from_scene, camera_velocity, split_vertices};

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
