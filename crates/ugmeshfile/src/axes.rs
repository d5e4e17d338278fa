//! The axes of meshes and scenes.

use glam::DVec3;
use ugscene::{LightKind, Scene};

/// A coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// The first axis.
    X,
    /// The second axis.
    Y,
    /// The third axis.
    Z,
}

/// Rotates the axis `up` to z, by a cyclic permutation of the axes or by a quarter turn about x.
/// Both are exact.
pub fn to_z_up(up: Axis, p: DVec3) -> DVec3 {
    match up {
        Axis::X => DVec3::new(p.y, p.z, p.x),
        // Not `-p.z`, which would give −0 for 0.
        Axis::Y => DVec3::new(p.x, 0.0 - p.z, p.y),
        Axis::Z => p,
    }
}

/// The inverse of [`to_z_up`].
pub fn from_z_up(up: Axis, p: DVec3) -> DVec3 {
    match up {
        Axis::X => DVec3::new(p.z, p.x, p.y),
        Axis::Y => DVec3::new(p.x, p.z, 0.0 - p.y),
        Axis::Z => p,
    }
}

/// Rotates all vertices, their normals, cameras and lights.
pub fn rotate(scene: &mut Scene, rotation: impl Fn(DVec3) -> DVec3) {
    for vertex in &mut scene.vertices {
        vertex.position = rotation(vertex.position);
        vertex.normal = vertex.normal.map(&rotation);
    }
    for camera in &mut scene.cameras {
        for vector in [&mut camera.eye, &mut camera.center, &mut camera.up].into_iter().flatten() {
            *vector = rotation(*vector);
        }
    }
    for light in &mut scene.lights {
        match &mut light.kind {
            LightKind::Ambient => {}
            LightKind::Directional(toward) => *toward = rotation(*toward),
            LightKind::Local { position, beam, .. } => {
                (*position, *beam) = (rotation(*position), beam.turned(&rotation));
            }
        }
    }
}
