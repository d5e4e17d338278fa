//! Bodies on world lines in a scene as seen.
//!
//! The text of a scene as seen keeps the motions in the frame of the scene, and the stage says
//! where and when the eye is and how it moves. So the event at which light left a point that is
//! seen at p, (−|p|, p) relative to the eye, leads back to the point and its own time (P45).

use std::sync::Arc;

use glam::{DQuat, DVec3};
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

/// The world lines of the bodies of a scene as seen that are not inertial, in the frame of the
/// camera with the event of the eye as its origin; coordinates of bodies are relative to the eye.
/// Empty without such bodies.
pub(crate) fn world_lines(scene: &Scene) -> Vec<Option<Arc<WorldLine>>> {
    let Some(seen) = scene.stage.seen_geometry().filter(|_| scene.bodies.has_world_lines()) else {
        return Vec::new();
    };
    let origin = eye_event(seen.eye, seen.time, seen.camera_velocity);
    let frame = Lorentz::boost(seen.camera_velocity).inverse();
    let line = |body: BodyId| {
        let line = scene.bodies.motion(body);
        let is_on_one = scene.bodies.is_on_world_line(body);
        is_on_one.then(|| Arc::new(line.in_frame(frame, origin).with_body_origin(seen.eye)))
    };
    scene.bodies.ids().map(line).collect()
}

/// A point of a body on a world line, as it is seen.
#[derive(Clone, Copy, Debug)]
pub struct WorldLinePoint {
    /// The point, in the coordinates of the body, relative to the eye.
    pub point: DVec3,
    /// The own time of the body at emission.
    pub own_time: f64,
    /// The velocity of the point at emission, in the frame of the camera.
    pub velocity: Velocity,
    /// The turn of the body at emission.
    pub turn: DQuat,
    /// Where the point would be in the scene if the body only turned, relative to the eye.
    pub standing: DVec3,
    /// Toward the eye, in the coordinates of the body, up to a factor: a surface with the normal n
    /// there is seen on its front if n·`toward_eye` > 0.
    pub toward_eye: DVec3,
}

impl WorldLinePoint {
    /// The point of a body that is seen at `seen`, relative to the eye; `None` if none can be.
    pub fn new(line: &WorldLine, seen: DVec3) -> Option<Self> {
        let event = seen_event(seen);
        let at = line.at_event(event).ok()?;
        let turn = line.pose(at.own_time).turn;
        Some(Self {
            point: at.point,
            own_time: at.own_time,
            velocity: at.velocity,
            turn,
            standing: line.turned_point(at.point, at.own_time),
            toward_eye: line.toward(at.point, at.own_time, Event { t: -event.t, x: -event.x }),
        })
    }

    /// The normal of a surface of the body as it stands in the scene if the body only turned.
    pub fn standing_normal(&self, normal: DVec3) -> DVec3 {
        self.turn * normal
    }
}
