//! From the frame of the scene to that of a camera that moves in it.

use glam::DVec3;
use rayon::prelude::*;
use ugparse::{Scene, VelocityId};
use ugphysics::{Velocity, compose};

use crate::{Config, Error, PROGRAM};

/// The velocity of the camera in the frame of the scene: the option, else that of the scene's camera, which
/// loses it, for downstream the camera is at rest.
pub(crate) fn take_camera_velocity(scene: &mut Scene, config: &Config) -> Result<Velocity, Error> {
    let own = scene
        .camera_row()
        .and_then(|row| scene.cameras[row].velocity.take())
        .map(|id| scene.velocities[id.index()]);
    match (config.camera_velocity, own) {
        (Some(beta), _) => Velocity::from_beta(beta).map_err(Error::CameraVelocity),
        (None, Some(beta)) => Velocity::from_beta(beta).map_err(Error::SceneVelocity),
        (None, None) => Ok(Velocity::ZERO),
    }
}

/// Gives all faces and wires one velocity. At rest, those that had none still have none.
pub(crate) fn set_velocity(scene: &mut Scene, velocity: DVec3) {
    let id = scene.velocity_id(velocity);
    let set = |slot: &mut Option<VelocityId>| {
        if velocity != DVec3::ZERO || slot.is_some() {
            *slot = Some(id);
        }
    };
    scene.faces.par_iter_mut().for_each(|face| set(&mut face.velocity));
    scene.wires.par_iter_mut().for_each(|wire| set(&mut wire.velocity));
}

/// Gives everything that is drawn a velocity, for what rests in the scene moves in the frame of the camera.
/// `default`: of what carries none.
pub(crate) fn give_velocities(scene: &mut Scene, default: Velocity) {
    let id = scene.velocity_id(default.beta());
    let faces = scene.faces.iter_mut().map(|face| &mut face.velocity);
    for slot in faces.chain(scene.wires.iter_mut().map(|wire| &mut wire.velocity)) {
        slot.get_or_insert(id);
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

/// Carries all velocities of a scene over, and notes in it from where.
pub(crate) fn carry_velocities(scene: &mut Scene, camera: Velocity) -> Result<(), Error> {
    if !camera.is_zero() {
        for beta in &mut scene.velocities {
            let body = Velocity::from_beta(*beta).map_err(Error::SceneVelocity)?;
            *beta = in_camera_frame(body, camera)?.beta();
        }
    }
    ugscene::record_camera_velocity(scene, camera);
    Ok(())
}

/// Has the scene been through this program?
pub(crate) fn was_seen_before(scene: &Scene) -> bool {
    ugscene::history(scene).iter().any(|line| line.split(' ').next() == Some(PROGRAM))
}
