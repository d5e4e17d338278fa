//! Placement of bodies on world lines: a displacement in space and time for each, which stays in
//! the scene as part of their statements.

use glam::DVec3;
use ugphysics::{Event, Lorentz, Velocity, WorldLine};

use super::eye::eye_event;
use super::placement::Placement;
use super::{MOST_ROUNDED, MotionError};
use crate::{BodyId, Carrier, RelativeMotion, Scene, ShownEffects, StatedMotion};

/// Places all bodies on world lines, and puts their motions relative to the camera into `motions`.
///
/// A body that is part of another one stays in its place on it.
pub(super) fn place(
    scene: &mut Scene,
    motions: &mut [RelativeMotion],
    placement: &Placement<'_>,
) -> Result<(), MotionError> {
    if !scene.bodies.has_world_lines() {
        return Ok(());
    }
    let &Placement { options, observer, eye, .. } = placement;
    if !options.geometry.contraction {
        return Err(MotionError::PartialGeometry);
    }
    // Programs downstream know eye, time and velocity of the camera.
    let stated_eye = eye_event(eye, options.time, observer.velocity);
    let eye_shift = stated_eye - placement.eye_event();
    let frame = Lorentz::boost(observer.velocity).inverse();
    let roots: Vec<BodyId> =
        scene.bodies.stated_by_name().filter(|&body| is_root(scene, body)).collect();
    for body in roots {
        let line = scene.bodies.motion(body);
        // What rides on an inertial body is placed as that is.
        let of_carrier = match scene.bodies.statement(body).and_then(|motion| motion.on) {
            Some(Carrier::Frame(frame)) => Some(WorldLine::inertial(frame)),
            _ => None,
        };
        let placed = of_carrier.as_ref().unwrap_or(line);
        let shift = match placement.anchor_point(body) {
            None => StatedMotion::NO_SHIFT,
            Some(anchor) if options.in_place && !line.passes_events() => {
                in_place_shift(placed, anchor, options.geometry, (eye, observer.velocity))
                    .map_err(|error| impossible(scene, body, error))?
            }
            Some(anchor) => placed.anchor_shift(anchor),
        };
        let shift = shift + eye_shift;
        if let Some(motion) = scene.bodies.statement(body) {
            let motion = StatedMotion { shift: motion.shift + shift, ..motion.clone() };
            restate(scene, body, motion, &WorldLine::REST)?;
        }
    }
    // Carriers first, whatever the order of the text.
    let mut parts: Vec<(usize, BodyId)> = scene
        .bodies
        .stated_by_name()
        .map(|body| (scene.bodies.carriers(body).count(), body))
        .collect();
    parts.sort_unstable();
    for (_, body) in parts.into_iter().filter(|&(n_carriers, _)| n_carriers > 1) {
        if let Some(motion) = scene.bodies.statement(body).cloned()
            && let Some(carrier) = motion.body()
        {
            let carrier = scene.bodies.motion(carrier).clone();
            restate(scene, body, motion, &carrier)?;
        }
    }
    for body in scene.bodies.ids().filter(|&body| scene.bodies.is_on_world_line(body)) {
        let line = scene.bodies.motion(body).in_frame(frame, stated_eye).with_body_origin(eye);
        line.check_turn_seen(Event::ORIGIN).map_err(|error| impossible(scene, body, error))?;
        motions[body.index()] = RelativeMotion::on_world_line(line, options.geometry);
    }
    Ok(())
}

/// Refuses bodies that rounding garbles: events on world lines are numbers in the frame of the
/// scene, so far from its origin their rounding is γ times as much for a fast camera. `bodies`: of
/// each vertex.
pub(super) fn check_rounding(
    scene: &Scene,
    bodies: &[BodyId],
    placement: &Placement<'_>,
) -> Result<(), MotionError> {
    let &Placement { options, observer, eye, .. } = placement;
    let error = f64::EPSILON
        * observer.velocity.gamma()
        * eye_event(eye, options.time, observer.velocity).t.abs();
    let mut sizes = vec![0.0_f64; scene.bodies.len()];
    for (vertex, body) in scene.vertices.iter().zip(bodies) {
        let at = scene.bodies.statement(*body).map_or(DVec3::ZERO, |motion| motion.at);
        let size = &mut sizes[body.index()];
        *size = size.max(vertex.position.distance(at));
    }
    let garbled = |&body: &BodyId| {
        let size = sizes[body.index()];
        scene.bodies.is_on_world_line(body) && size > 0.0 && error > MOST_ROUNDED * size
    };
    scene.bodies.ids().find(garbled).map_or(Ok(()), |body| {
        let name = scene.bodies[body].name.map_or("", |name| scene.names.get(name));
        Err(MotionError::Rounded { name: name.to_string(), error })
    })
}

/// States for what rides on inertial bodies their frames in the scene instead. Inertial bodies of a
/// scene as seen have velocities in the frame of the camera, all others in that of the scene, so one
/// cannot ride on the other.
pub(super) fn release_parts_of_inertial_bodies(scene: &mut Scene) -> Result<(), MotionError> {
    let bodies: Vec<BodyId> =
        scene.bodies.stated_by_name().filter(|&body| scene.bodies.is_on_world_line(body)).collect();
    for body in bodies {
        if let Some(motion) = scene.bodies.statement(body).cloned()
            && let Some(frame) =
                motion.body().and_then(|on| scene.bodies.motion(on).inertial_frame())
        {
            let on = Some(Carrier::Frame(*frame));
            restate(scene, body, StatedMotion { on, ..motion }, &WorldLine::REST)?;
        }
    }
    Ok(())
}

/// True if a body is on a world line, and not part of another one.
fn is_root(scene: &Scene, body: BodyId) -> bool {
    scene.bodies.is_on_world_line(body) && scene.bodies.carriers(body).count() == 1
}

fn restate(
    scene: &mut Scene,
    body: BodyId,
    motion: StatedMotion,
    carrier: &WorldLine,
) -> Result<(), MotionError> {
    let line = motion.world_line(carrier).map_err(|error| impossible(scene, body, error))?;
    if let (Some(name), Some(line)) = (scene.bodies[body].name, line) {
        scene.bodies.set_statement(body, name, motion, line);
    }
    Ok(())
}

fn impossible(scene: &Scene, body: BodyId, error: ugphysics::WorldLineError) -> MotionError {
    let name = scene.bodies[body].name.map_or("", |name| scene.names.get(name));
    MotionError::WorldLine { name: name.to_string(), error }
}

/// The displacement, at rest for the body at its own time 0, with which a camera with the velocity
/// `camera` sees `anchor`, from `eye` at time 0, where the scene has it; or, without flight time,
/// with which it is there.  Eq. (P26)
fn in_place_shift(
    line: &WorldLine,
    anchor: DVec3,
    geometry: ShownEffects,
    (eye, camera): (DVec3, Velocity),
) -> Result<Event, ugphysics::WorldLineError> {
    let place = anchor - eye;
    let seen =
        if geometry.flight_time { crate::seen_event(place) } else { Event { t: 0.0, x: place } };
    let event = Lorentz::boost(camera).apply(seen) + Event { t: 0.0, x: eye };
    line.displacement_to(anchor, event)
}
