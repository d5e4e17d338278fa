//! Bodies: the parts of a scene that move with one velocity.

use glam::DQuat;
use ugparse::{Scene, VelocityId};
use ugphysics::{Velocity, VelocityError};

use crate::{axes_from_scene, camera_velocity, split_vertices};

/// The velocities of a scene, ready to compute with.
#[derive(Clone, Debug)]
pub struct Bodies {
    /// In the order of [`Scene::velocities`].
    velocities: Vec<Velocity>,
    default: Velocity,
    /// How the camera moves in the frame the scene was written in.
    camera: Velocity,
}

impl Bodies {
    /// Bodies of `scene`; faces without a velocity move with `default`.
    ///
    /// # Errors
    /// A velocity of the scene, or that of its camera ([`camera_velocity`]), is not below the speed of light.
    pub fn new(scene: &Scene, default: Velocity) -> Result<Self, VelocityError> {
        let velocities = scene.velocities.iter().map(|&beta| Velocity::from_beta(beta));
        Ok(Self {
            velocities: velocities.collect::<Result<_, _>>()?,
            default,
            camera: camera_velocity(scene)?,
        })
    }

    /// The velocity of a face, wire or vertex.
    pub fn of(&self, id: Option<VelocityId>) -> Velocity {
        id.map_or(self.default, |id| self.velocities[id.index()])
    }

    /// Turns rest coordinates of a face, wire or vertex, as (P4) gives them, into the axes of the scene, where
    /// lights and normals are. The identity unless the camera moves in the scene.  Eq. (P25)
    pub fn scene_from_axes(&self, id: Option<VelocityId>) -> DQuat {
        axes_from_scene(self.of(id), self.camera).inverse()
    }

    /// The velocities of the scene, by row.
    pub fn all(&self) -> &[Velocity] {
        &self.velocities
    }

    /// True if nothing moves.
    pub fn are_at_rest(&self) -> bool {
        self.default.is_zero() && self.velocities.iter().all(|v| v.is_zero())
    }
}

/// The velocity each vertex moves with, from the faces and wires that use it;
/// `None` for vertices without one.
///
/// A vertex that bodies of different velocity share counts for the first of
/// them: call [`separate_bodies`] before, and there is no such vertex.
pub fn vertex_velocities(scene: &Scene) -> Vec<Option<VelocityId>> {
    let mut velocities = vec![None; scene.vertices.len()];
    // From behind, so that the first user has the last word.
    for (rows, velocity) in users(scene).rev() {
        for corner in scene.contours.corners(rows) {
            velocities[corner.index()] = velocity;
        }
    }
    velocities
}

/// Faces and wires: their contours and velocity.
fn users(scene: &Scene) -> impl DoubleEndedIterator<Item = (std::ops::Range<u32>, Option<VelocityId>)> {
    let faces = scene.faces.iter().map(|face| (face.contours.clone(), face.velocity));
    let wires = scene.wires.iter().map(|wire| (wire.contours.clone(), wire.velocity));
    faces.chain(wires)
}

/// True if all faces and wires have one velocity, so that [`separate_bodies`] would change nothing.
pub fn is_one_body(scene: &Scene) -> bool {
    let first = users(scene).next().map(|(_, velocity)| velocity);
    scene.velocities.is_empty() || users(scene).all(|(_, velocity)| Some(velocity) == first)
}

/// Gives every body its own vertices: where faces or wires of different
/// velocity share a vertex, the later ones get a copy, named after it.
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
        let velocities = vertex_velocities(&scene);
        for face in &scene.faces {
            for corner in scene.contours.corners(face.contours.clone()) {
                assert_eq!(velocities[corner.index()], face.velocity);
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
