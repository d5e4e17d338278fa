//! Placement of bodies on world lines: a displacement in space and time for each, which stays in
//! the scene as part of their statements.

use glam::DVec3;
use ugphysics::{Event, Lorentz, WorldLine};

use super::observer::Observer;
use super::placement::centers;
use super::{Anchor, MotionError, MotionOptions};
use crate::world_lines::eye_event;
use crate::{BodyId, RelativeMotion, Scene, StatedMotion};

/// Places all bodies on world lines, and puts their motions relative to the camera into `motions`.
///
/// A body that is part of another one stays in its place on it.
pub(super) fn place(
    scene: &mut Scene,
    bodies: &[BodyId],
    motions: &mut [RelativeMotion],
    (eye, observer): (DVec3, &Observer),
    options: &MotionOptions,
) -> Result<(), MotionError> {
    if !scene.bodies.has_world_lines() {
        return Ok(());
    }
    if !(options.geometry.contraction && options.geometry.flight_time) {
        return Err(MotionError::PartialGeometry);
    }
    let needs_centers = options.in_place || options.anchor == Some(Anchor::Center);
    let centers = if needs_centers { centers(scene, bodies) } else { vec![DVec3::ZERO; motions.len()] };
    // Programs downstream know eye, time and velocity of the camera.
    let stated_eye = eye_event(eye, options.time, observer.velocity);
    let eye_shift = stated_eye - (observer.event(options.time) + Event { t: 0.0, x: eye });
    let frame = Lorentz::boost(observer.velocity).inverse();
    let roots: Vec<BodyId> = scene.bodies.stated_by_name().filter(|&body| is_root(scene, body)).collect();
    for body in roots {
        let anchor = match options.anchor {
            Some(Anchor::Eye) => eye,
            Some(Anchor::Origin) => DVec3::ZERO,
            Some(Anchor::Center) => centers[body.index()],
            Some(Anchor::Point(point)) => point,
            None if options.in_place => centers[body.index()],
            None => eye,
        };
        let line = scene.bodies.motion(body);
        let shift = if options.in_place {
            in_place_shift(line, anchor, eye).map_err(|error| impossible(scene, body, error))?
        } else {
            line.anchor_shift(anchor)
        };
        let shift = shift + eye_shift;
        if let Some(motion) = scene.bodies.statement(body) {
            let motion = StatedMotion { shift: motion.shift + shift, ..motion.clone() };
            restate(scene, body, motion, &WorldLine::REST)?;
        }
    }
    // Carriers first, whatever the order of the text.
    let mut parts: Vec<(usize, BodyId)> =
        scene.bodies.stated_by_name().map(|body| (depth(scene, body), body)).collect();
    parts.sort_unstable();
    for (_, body) in parts.into_iter().filter(|&(depth, _)| depth > 0) {
        if let Some(motion) = scene.bodies.statement(body).cloned()
            && let Some(carrier) = motion.on()
        {
            let carrier = scene.bodies.motion(carrier).clone();
            restate(scene, body, motion, &carrier)?;
        }
    }
    for body in scene.bodies.ids().filter(|&body| scene.bodies.is_on_world_line(body)) {
        let line = scene.bodies.motion(body).in_frame(frame, stated_eye).with_body_origin(eye);
        motions[body.index()] = RelativeMotion::on_world_line(line);
    }
    Ok(())
}

/// True if a body is on a world line, and not part of another one.
fn is_root(scene: &Scene, body: BodyId) -> bool {
    scene.bodies.is_on_world_line(body) && depth(scene, body) == 0
}

/// The number of bodies that it is part of, one in the other.
fn depth(scene: &Scene, body: BodyId) -> usize {
    let carrier = |&body: &BodyId| scene.bodies.statement(body).and_then(StatedMotion::on);
    std::iter::successors(Some(body), carrier).count() - 1
}

fn restate(
    scene: &mut Scene,
    body: BodyId,
    motion: StatedMotion,
    carrier: &WorldLine,
) -> Result<(), MotionError> {
    let line = motion.world_line(carrier).map_err(|error| impossible(scene, body, error))?;
    if let Some(name) = scene.bodies[body].name {
        scene.bodies.set_statement(body, name, motion, line);
    }
    Ok(())
}

fn impossible(scene: &Scene, body: BodyId, error: ugphysics::WorldLineError) -> MotionError {
    let name = scene.bodies[body].name.map_or("", |name| scene.names.get(name));
    MotionError::WorldLine { name: name.to_string(), error }
}

/// The displacement, at rest for the body at its own time 0, with which `anchor` is seen from `eye`
/// at time 0 where the scene has it.  Eq. (P26)
fn in_place_shift(line: &WorldLine, anchor: DVec3, eye: DVec3) -> Result<Event, ugphysics::WorldLineError> {
    let way = anchor - eye;
    let seen = Event { t: -ugphysics::length(way), x: anchor };
    line.displacement_to(anchor, seen)
}
