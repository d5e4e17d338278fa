//! Bodies on world lines in a scene as seen.
//!
//! The text of a scene as seen keeps the motions in the frame of the scene, and the stage says
//! where and when the eye is and how it moves. So the event at which light left a point that is
//! seen at p, (−|p|, p) relative to the eye, leads back to the point and its own time (P45).

use glam::DVec3;
use ugphysics::{Event, Lorentz, Velocity, WorldLine};

use crate::{BodyId, Scene};

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
