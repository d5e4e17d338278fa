//! From the frame of the scene to that of a camera that moves in it.

use rayon::prelude::*;
use ugparse::{BodyId, Motion, Scene};
use ugphysics::{Velocity, compose};

use crate::{Config, Error};

/// The velocity of the camera in the frame of the scene: the option, else that of the scene's camera, which
/// loses it, for downstream the camera is at rest.
pub(crate) fn take_camera_velocity(scene: &mut Scene, config: &Config) -> Result<Velocity, Error> {
    let own = scene.camera_row().and_then(|row| scene.cameras[row].velocity.take());
    match config.camera_velocity {
        Some(beta) => Velocity::from_beta(beta).map_err(Error::CameraVelocity),
        None => Ok(own.unwrap_or_default()),
    }
}

/// Makes all faces and wires one body. At rest, those whose motion was not stated keep it so.
pub(crate) fn set_velocity(scene: &mut Scene, velocity: Velocity) {
    let body = scene.bodies.moving_with(Motion::Inertial(velocity));
    let set = |slot: &mut BodyId| {
        if !velocity.is_zero() || *slot != BodyId::UNSTATED {
            *slot = body;
        }
    };
    scene.faces.par_iter_mut().for_each(|face| set(&mut face.body));
    scene.wires.par_iter_mut().for_each(|wire| set(&mut wire.body));
}

/// States the motion of everything that is drawn, for what rests in the scene moves in the frame of the camera.
/// `default`: of what states none.
pub(crate) fn state_motions(scene: &mut Scene, default: Velocity) {
    let body = scene.bodies.moving_with(Motion::Inertial(default));
    let faces = scene.faces.iter_mut().map(|face| &mut face.body);
    for slot in faces.chain(scene.wires.iter_mut().map(|wire| &mut wire.body)) {
        if *slot == BodyId::UNSTATED {
            *slot = body;
        }
    }
}

/// The velocity in the frame of the camera of what moves with `body` in the scene, as it will be written: (P15).
///
/// Rounding to what text can say comes first, so that all that is computed from it agrees: places here, rest
/// places and colours downstream.
pub(crate) fn in_camera_frame(body: Velocity, camera: Velocity) -> Result<Velocity, Error> {
    // What rests in one of the frames needs no sum, and gets none, so that nothing is rounded.
    if camera.is_zero() || body.is_zero() {
        return Ok(if camera.is_zero() { body } else { -camera });
    }
    if body == camera {
        return Ok(Velocity::ZERO);
    }
    Velocity::from_beta(compose(body, -camera).beta()).map_err(|_| Error::TooFast { beta: body.beta() })
}

/// Carries all velocities of a scene over.
pub(crate) fn carry_velocities(scene: &mut Scene, camera: Velocity) -> Result<(), Error> {
    if !camera.is_zero() {
        // What states no motion is not drawn any more: it goes on without saying so.
        for body in scene.bodies.iter_mut().skip(1) {
            let Motion::Inertial(velocity) = &mut body.motion;
            *velocity = in_camera_frame(*velocity, camera)?;
        }
        for velocity in scene.cameras.iter_mut().filter_map(|other| other.velocity.as_mut()) {
            *velocity = in_camera_frame(*velocity, camera)?;
        }
    }
    Ok(())
}
