//! The event of the eye, and how the camera moves and is turned there.

use glam::{DQuat, DVec3};
use ugphysics::{Event, Lorentz, Velocity, WorldLine};

use super::{MotionError, MotionOptions, camera_frame};
use crate::Scene;

/// The eye when the picture is taken.
#[derive(Clone, Copy, Debug)]
pub(super) struct Observer {
    /// The velocity of the camera in the frame of the scene.
    pub velocity: Velocity,
    /// The event of the eye in the frame of the scene, relative to that at time 0; `None` without
    /// a world line of its own, if it follows from velocity and time.
    pub event: Option<Event>,
    /// The turn of the camera, in the axes of a single boost.
    pub turn: DQuat,
}

impl Observer {
    /// The camera of a scene, whose motion is removed from the scene, since the output is in the
    /// frame of the camera.
    ///
    /// # Errors
    /// An invalid velocity, or an eye that cannot move with the camera's body.
    pub(super) fn take(
        scene: &mut Scene,
        options: &MotionOptions,
        eye: Option<DVec3>,
    ) -> Result<Self, MotionError> {
        let row = scene.camera_row();
        let carrier = row.and_then(|row| scene.cameras[row].carrier.take());
        let velocity = camera_frame::take_camera_velocity(scene, options.camera_velocity)?;
        match carrier.filter(|_| options.camera_velocity.is_none()) {
            Some(body) => {
                let line = scene.bodies.motion(body).clone();
                Self::carried(&line, crate::eye(scene, eye), options)
            }
            None => Ok(Self { velocity, event: None, turn: DQuat::IDENTITY }),
        }
    }

    /// The eye as a point of a body on a world line.
    fn carried(line: &WorldLine, eye: DVec3, options: &MotionOptions) -> Result<Self, MotionError> {
        let failed = |error| MotionError::Eye { error };
        line.check(eye).map_err(failed)?;
        line.check_turn(options.time).map_err(failed)?;
        // With `-in` the eye is at its place at time 0.
        let anchor = if options.in_place { Some(eye) } else { options.anchor_point(eye, eye) };
        let line = anchor.map_or_else(|| line.clone(), |anchor| line.anchored(anchor));
        let event = line.event(eye, options.time).map_err(failed)?;
        let frame = line.frame(eye, options.time);
        let velocity = frame.velocity_of_frame().map_err(MotionError::CameraVelocity)?;
        let turn = (Lorentz::boost(velocity).inverse() * frame).turn();
        Ok(Self { velocity, event: Some(event - Event { t: 0.0, x: eye }), turn })
    }

    /// The event of the eye in the frame of the scene, relative to that at time 0, at a time of its
    /// own.
    pub(super) fn event(&self, time: f64) -> Event {
        let of_velocity = || Lorentz::boost(self.velocity).apply(Event { t: time, x: DVec3::ZERO });
        self.event.unwrap_or_else(of_velocity)
    }

    /// True if a world line has carried the eye away from its place at time 0.
    pub(super) fn has_left(&self) -> bool {
        self.event.is_some_and(|event| event.x != DVec3::ZERO)
    }

    /// Turns a direction of view with the camera.
    pub(super) fn turned(&self, direction: DVec3) -> DVec3 {
        if self.turn == DQuat::IDENTITY { direction } else { self.turn * direction }
    }
}
