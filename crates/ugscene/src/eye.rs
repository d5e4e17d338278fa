//! Where the eye is, and that nothing sits in it.

use glam::DVec3;
use ugparse::{Diagnostic, Diagnostics, Parsed, Scene, Source, VertexId};

use crate::{RestFrames, vertex_bodies};

/// The eye point in scene coordinates: the option if given, else the one of the
/// scene's camera, else the origin. All programs of a pipe choose it alike.
pub fn eye(scene: &Scene, option: Option<DVec3>) -> DVec3 {
    option.or(scene.camera().and_then(|camera| camera.eye)).unwrap_or(DVec3::ZERO)
}

/// The first vertex of a moving body that lies exactly at the eye, where no
/// direction to it exists, and so neither a place nor a Doppler factor.
pub fn vertex_at_eye(scene: &Scene, eye: DVec3, frames: &RestFrames) -> Option<VertexId> {
    let row = scene.vertices.iter().position(|vertex| vertex.position == eye)?;
    let bodies = vertex_bodies(scene);
    (row..scene.vertices.len())
        .find(|&row| scene.vertices[row].position == eye && !frames.velocity(bodies[row]).is_zero())
        .map(VertexId::from_index)
}

/// The message for [`vertex_at_eye`].
pub fn at_eye_error(source: &Source, parsed: &Parsed, vertex: VertexId) -> Diagnostics {
    let name = parsed.scene.names.get(parsed.scene.vertices[vertex.index()].name);
    let finding = Diagnostic::error(
        parsed.origins.vertices.get(vertex.index()).copied().unwrap_or_default(),
        format!("vertex `{name}` lies at the eye, where no direction to it exists"),
    );
    Diagnostics::one(source, finding.label("here").help("move the eye (-ep) or the vertex"))
}
