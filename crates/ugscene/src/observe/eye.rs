//! The eye, and bodies on world lines in a scene as seen.
//!
//! The text of a scene as seen keeps the motions in the frame of the scene, and the stage says
//! where and when the eye is and how it moves. So the event at which light left a point that is
//! seen at p, (−|p|, p) relative to the eye, leads back to the point and its own time (P45).

use glam::DVec3;
use ugphysics::{Event, Lorentz, Velocity, WorldLine};

use crate::{BodyId, RestFrames, Scene, VertexId, vertex_bodies};

/// The event at which light left what is seen at `seen`, relative to the event of the eye.
pub fn seen_event(seen: DVec3) -> Event {
    Event { t: -ugphysics::length(seen), x: seen }
}

/// The event of the eye in the frame of the scene, when the picture is taken: the eye is at `eye`
/// at time 0 and moves with `camera`.
pub(crate) fn eye_event(eye: DVec3, time: f64, camera: Velocity) -> Event {
    Lorentz::boost(camera).apply(Event { t: time, x: DVec3::ZERO }) + Event { t: 0.0, x: eye }
}

/// The world line of a body of a scene as seen that is not inertial, in the frame of the camera
/// with the event of the eye as its origin; coordinates of the body are relative to the eye.
pub(crate) fn world_line(scene: &Scene, body: BodyId) -> Option<WorldLine> {
    let seen = scene.stage.seen_geometry().filter(|_| scene.bodies.is_on_world_line(body))?;
    let origin = eye_event(seen.eye, seen.time, seen.camera_velocity);
    let frame = Lorentz::boost(seen.camera_velocity).inverse();
    Some(scene.bodies.motion(body).in_frame(frame, origin).with_body_origin(seen.eye))
}

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
