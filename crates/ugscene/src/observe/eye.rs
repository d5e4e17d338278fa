//! The eye point, and vertices that coincide with it.

use glam::DVec3;

use crate::{RestFrames, Scene, VertexId, vertex_bodies};

/// The eye point in scene coordinates: the option if given, else the one of the scene's camera,
/// else the one its positions were computed for, else the origin. All programs of a pipe agree
/// on it. Where the eye matters, [`crate::DefaultCamera`] comes first in a scene without a camera.
pub fn eye(scene: &Scene, option: Option<DVec3>) -> DVec3 {
    let of_camera = || scene.camera().and_then(|camera| camera.eye);
    let of_stage = || scene.stage.seen_geometry().map(|seen| seen.eye);
    option.or_else(of_camera).or_else(of_stage).unwrap_or(DVec3::ZERO)
}

/// The first vertex of a moving body that lies exactly at the eye, where its direction, and so its
/// seen position and Doppler factor, are undefined.
pub fn vertex_at_eye(scene: &Scene, eye: DVec3, frames: &RestFrames) -> Option<VertexId> {
    let row = scene.vertices.iter().position(|vertex| vertex.position == eye)?;
    let bodies = vertex_bodies(scene);
    (row..scene.vertices.len())
        .find(|&row| scene.vertices[row].position == eye && !frames.velocity(bodies[row]).is_zero())
        .map(VertexId::from_index)
}
