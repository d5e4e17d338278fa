//! Where bodies are at one time of a frame (`--measured`): a scene at rest, with bodies contracted,
//! their colours at their own times, and lamps where they are.

use ugphysics::Velocity;
use ugscene::{
    Bodies, Camera, GeometryStage, LightKind, LightMotion, MotionError, RestPosition, Scene,
    SeenPosition,
};

use crate::relative_motion::{Point, RelativeMotion};
use crate::{Config, Error, MeasuredFrame};

/// The options with which the camera rests in the frame that is asked for, and the name of the body
/// that carries it, if it accelerates or turns.
///
/// # Errors
/// There is no such body, or no eye that it can carry.
pub(crate) fn in_frame(
    scene: &mut Scene,
    config: &Config,
) -> Result<(Config, Option<String>), Error> {
    let mut config = config.clone();
    let name = match &config.measured {
        None | Some(MeasuredFrame::Camera) => return Ok((config, None)),
        Some(MeasuredFrame::Scene) => {
            config.camera_velocity = Some(Velocity::ZERO.beta());
            return Ok((config, None));
        }
        Some(MeasuredFrame::Body(name)) => name.clone(),
    };
    let name_of = |body| scene.bodies[body].name.map(|name| scene.names.get(name));
    let body = scene.bodies.ids().find(|&body| name_of(body) == Some(&name)).ok_or_else(|| {
        let names = scene.bodies.ids().filter_map(name_of).map(str::to_owned).collect();
        Error::NoFrame { name: name.clone(), names }
    })?;
    if let Some(frame) = scene.bodies.motion(body).inertial_frame() {
        config.camera_velocity = Some(frame.velocity.beta());
        config.zero = Some(frame.start());
        return Ok((config, None));
    }
    if scene.cameras.is_empty() {
        let eye = config.eye.ok_or_else(|| Error::NoFrameEye { name: name.clone() })?;
        scene.cameras.push(Camera { eye: Some(eye), ..Camera::default() });
    }
    let row = scene.camera_row().unwrap_or(0);
    (scene.cameras[row].velocity, scene.cameras[row].carrier) = (None, Some(body));
    config.camera_velocity = None;
    Ok((config, Some(name)))
}

/// Refuses to leave out flight time alone where programs downstream need it.
pub(crate) fn refuse_partial(scene: &Scene, config: &Config) -> Result<(), MotionError> {
    if config.measured.is_some() || config.geometry.flight_time {
        return Ok(());
    }
    if scene.bodies.has_world_lines() {
        return Err(MotionError::PartialGeometry);
    }
    if scene.color_tables.is_empty() { Ok(()) } else { Err(MotionError::PartialTimes) }
}

/// Makes a scene that was placed one at rest, but for its bodies and colours. `points`: of each
/// vertex. `motions`: of each body.
pub(crate) fn stand_still(scene: &mut Scene, points: &[Point], motions: &[RelativeMotion]) {
    let eye = ugscene::eye(scene, None);
    for (vertex, point) in scene.vertices.iter_mut().zip(points) {
        let motion = &motions[point.body.index()];
        let geometry = motion.effects();
        vertex.normal = vertex.normal.map(|normal| {
            let seen = SeenPosition(point.seen);
            let Some(line) = motion.world_line() else {
                let rest = RestPosition(motion.turned(normal));
                return geometry.seen_normal(rest, seen, motion.velocity());
            };
            let element = line.element(point.rest, point.own_time);
            let rest = RestPosition(element.normal(ugphysics::unit_or_zero(normal)));
            geometry.seen_normal(rest, seen, element.velocity)
        });
    }
    for light in &mut scene.lights {
        let Some(body) = light.motion.body() else { continue };
        if let LightKind::Local { position, .. } = &mut light.kind {
            let motion = &motions[body.index()];
            let point = Point::new(motion, body, motion.turned(*position - eye));
            *position = point.seen + eye;
        }
        light.motion = LightMotion::WithWhatItLights;
    }
    scene.cameras.iter_mut().for_each(|camera| {
        (camera.velocity, camera.carrier) = (None, None);
    });
    (scene.rest, scene.own_times) = (Vec::new(), Vec::new());
    scene.stage.geometry = GeometryStage::AtRest;
}

/// Makes all faces and wires parts of one body at rest.
pub(crate) fn forget_bodies(scene: &mut Scene) {
    scene.bodies = Bodies::default();
    let body = scene.bodies.unstated();
    scene.faces.iter_mut().for_each(|face| face.body = body);
    scene.wires.iter_mut().for_each(|wire| wire.body = body);
}
