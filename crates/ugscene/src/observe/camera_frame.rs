//! Velocities and axes: from the frame of the scene to that of a camera that moves in it.
//!
//! The programs compute in the frame of the camera. If the scene was written in another frame, all
//! its velocities have been carried over, and the axes of bodies are turned by that, (P25). The
//! stage of the scene keeps the motion between the two frames, so that rest positions come back in
//! the axes of the scene, where its lights and normals are.

use glam::{DQuat, DVec3};
use rayon::prelude::*;
use ugphysics::{InertialFrame, Velocity, WorldLine, compose_rounded, wigner_rotation};

use super::MotionError;
use crate::{BodyId, RelativeMotion, Scene};

/// The velocity of the camera in the frame the scene was written in; zero where no camera moved.
pub fn camera_velocity(scene: &Scene) -> Velocity {
    scene.stage.seen_geometry().map_or(Velocity::ZERO, |seen| seen.camera_velocity)
}

/// Turns the axes of the scene into those in which a body that moves with `seen` in the frame of
/// the camera stands to it by a single boost, as (P3) and (P4) want it: W(w, v_c)⁻¹ = W(v_b, −v_c).
/// Eq. (P25)
pub fn axes_from_scene(seen: Velocity, camera: Velocity) -> DQuat {
    wigner_rotation(camera, seen)
}

/// The velocity of the camera in the frame of the scene: the option, else that of the scene's
/// camera. It is removed from the scene, since the output is in the frame of the camera.
pub(super) fn take_camera_velocity(
    scene: &mut Scene,
    option: Option<DVec3>,
) -> Result<Velocity, MotionError> {
    let own = scene.camera_row().and_then(|row| scene.cameras[row].velocity.take());
    match option {
        Some(beta) => Velocity::from_beta(beta).map_err(MotionError::CameraVelocity),
        None => Ok(own.unwrap_or_default()),
    }
}

/// Makes all faces and wires parts of one new body, except those of bodies with a name, whose
/// motion is more than a velocity. If that body is at rest, those whose motion is not stated stay
/// what they are.
pub(super) fn set_velocity(scene: &mut Scene, velocity: Velocity) -> BodyId {
    let keeps: Vec<bool> =
        scene.bodies.ids().map(|id| scene.bodies.statement(id).is_some()).collect();
    let unstated = scene.bodies.unstated();
    let body = scene.bodies.push(None, WorldLine::inertial(InertialFrame::new(velocity)));
    let set = |slot: &mut BodyId| {
        if !keeps[slot.index()] && (!velocity.is_zero() || *slot != unstated) {
            *slot = body;
        }
    };
    scene.faces.par_iter_mut().for_each(|face| set(&mut face.body));
    scene.wires.par_iter_mut().for_each(|wire| set(&mut wire.body));
    body
}

/// States the motion of all faces and wires: what rests in the scene moves in the frame of the
/// camera. `default`: the velocity of bodies whose motion is not stated.
pub(super) fn state_motions(scene: &mut Scene, default: Velocity) {
    let (body, unstated) = (scene.bodies.moving_with(default), scene.bodies.unstated());
    let faces = scene.faces.iter_mut().map(|face| &mut face.body);
    for slot in faces.chain(scene.wires.iter_mut().map(|wire| &mut wire.body)) {
        if *slot == unstated {
            *slot = body;
        }
    }
}

/// A body's velocity in the frame of the camera, rounded to what the text can express: (P15).
/// `body`, `camera`: in the frame of the scene.
///
/// It is rounded before use, so that seen positions here agree with rest positions and colours that
/// programs downstream compute from the text.
pub(super) fn in_camera_frame(body: Velocity, camera: Velocity) -> Result<Velocity, MotionError> {
    // At rest in one of the frames the result is exact.
    if camera.is_zero() || body.is_zero() {
        return Ok(if camera.is_zero() { body } else { -camera });
    }
    if body == camera {
        return Ok(Velocity::ZERO);
    }
    compose_rounded(body, -camera).map_err(|_| MotionError::TooFast { beta: body.beta() })
}

/// Gives inertial bodies their motions relative to the camera, and other cameras theirs. `motions`:
/// of each body.
pub(super) fn state_relative_motions(
    scene: &mut Scene,
    motions: &[RelativeMotion],
    camera: Velocity,
) -> Result<(), MotionError> {
    for body in scene.bodies.ids() {
        if !scene.bodies.is_on_world_line(body) && scene.bodies.stated_velocity(body).is_some() {
            scene.bodies.set_frame(body, InertialFrame::new(motions[body.index()].velocity()));
        }
    }
    for velocity in scene.cameras.iter_mut().filter_map(|other| other.velocity.as_mut()) {
        *velocity = in_camera_frame(*velocity, camera)?;
    }
    Ok(())
}
