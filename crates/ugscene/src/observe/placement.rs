//! Placement of bodies: anchors, observer time, and bodies in place.
//!
//! All three add a constant to the rest coordinates of a body. So all later steps work on rest
//! coordinates alone, and the rest geometry recovered from the output has the same shape.

use glam::DVec3;
use ugphysics::{Event, InertialFrame, Lorentz, observer_shift};

use super::observer::Observer;
use super::{Anchor, MotionOptions, RelativeMotion};
use crate::{BodyId, LightKind, Scene, SeenPosition, StatedMotion};

/// Where bodies are placed: for which observer, and which of them belong together.
pub(super) struct Placement<'o> {
    pub options: &'o MotionOptions,
    pub observer: Observer,
    /// The eye, in scene coordinates.
    pub eye: DVec3,
    /// The body that the option `-vel` moves.
    overridden: Option<BodyId>,
    /// For each body, the centre of that whose place it keeps, if it is asked for; else 0.
    centers: Vec<DVec3>,
}

impl<'o> Placement<'o> {
    /// `bodies`: of each vertex.
    pub(super) fn new(
        scene: &Scene,
        bodies: &[BodyId],
        options: &'o MotionOptions,
        (eye, observer): (DVec3, Observer),
        overridden: Option<BodyId>,
    ) -> Self {
        let is_asked = match options.anchor {
            Some(anchor) => anchor == Anchor::Center,
            None => options.in_place,
        };
        // This reads every vertex.
        let own =
            if is_asked { centers(scene, bodies) } else { vec![DVec3::ZERO; scene.bodies.len()] };
        // A part keeps the place of the body that carries all others that it is part of.
        let root = |body: BodyId| scene.bodies.carriers(body).last().unwrap_or(body);
        let centers = scene.bodies.ids().map(|body| own[root(body).index()]).collect();
        Self { options, observer, eye, overridden, centers }
    }

    /// The event of the eye when the picture is taken, in the frame of the scene.
    pub(super) fn eye_event(&self) -> Event {
        self.observer.event(self.options.time) + Event { t: 0.0, x: self.eye }
    }

    /// The fixed point of the contraction of a body that the options state.
    pub(super) fn anchor_point(&self, body: BodyId) -> Option<DVec3> {
        self.options.anchor_point(self.eye, self.centers[body.index()])
    }

    /// The rest frame in the scene of each inertial body, with the fixed point of the contraction
    /// as A: the option, else the reference point of the body; for the one that the option `-vel`
    /// moves, the eye. Entries of bodies on world lines are not used.
    pub(super) fn frames(&self, scene: &Scene) -> Vec<InertialFrame> {
        let frame = |body: BodyId| {
            let own = *scene.bodies.motion(body).inertial_frame().unwrap_or(&InertialFrame::REST);
            let about = |at: DVec3| InertialFrame { at, shift: StatedMotion::NO_SHIFT, ..own };
            match self.anchor_point(body) {
                Some(point) => about(point),
                None if self.overridden == Some(body) => about(self.eye),
                None => own,
            }
        };
        scene.bodies.ids().map(frame).collect()
    }

    /// The offset of the rest coordinates of each body, in the axes of [`RelativeMotion::turned`].
    ///
    /// `motions`: of each body. `frames`: from [`Placement::frames`].
    pub(super) fn shifts(
        &self,
        motions: &[RelativeMotion],
        frames: &[InertialFrame],
    ) -> Vec<DVec3> {
        let shift = |(motion, frame): (&RelativeMotion, &InertialFrame)| {
            if motion.world_line().is_some() {
                return DVec3::ZERO;
            }
            anchor_shift(motion, frame.at - self.eye, self.options.in_place)
                + own_shift(motion, frame.shift)
                + eye_shift(motion, &self.observer, self.options.time)
        };
        let mut shifts: Vec<DVec3> = motions.iter().zip(frames).map(shift).collect();
        // Unused vertices are part of the first body. They get the offset of a body of the same
        // motion.
        let is_like_first = |&row: &usize| {
            motions[row].world_line().is_none() && motions[row].in_scene() == motions[0].in_scene()
        };
        let same_motion = (1..motions.len()).find(is_like_first);
        if let Some(row) = same_motion {
            shifts[0] = shifts[row];
        }
        shifts
    }
}

impl MotionOptions {
    /// The fixed point of the contraction that the options state; `None` if it is the reference
    /// point of each body. `center`: of the body.
    pub(super) fn anchor_point(&self, eye: DVec3, center: DVec3) -> Option<DVec3> {
        match self.anchor {
            Some(Anchor::Eye) => Some(eye),
            Some(Anchor::Origin) => Some(DVec3::ZERO),
            Some(Anchor::Center) => Some(center),
            Some(Anchor::Point(point)) => Some(point),
            None => self.in_place.then_some(center),
        }
    }
}

/// `anchor`: relative to the eye, in the axes of the scene; in those of the camera for bodies in
/// place.  (P26)
fn anchor_shift(motion: &RelativeMotion, anchor: DVec3, in_place: bool) -> DVec3 {
    if in_place {
        if motion.is_at_rest() {
            return DVec3::ZERO;
        }
        // The anchor in rest coordinates moves to the rest position that is seen at the anchor,
        // (P4).
        motion.rest(SeenPosition(anchor)).0 - motion.turned(anchor)
    } else if motion.has_contraction() {
        // The fixed point A instead of the eye adds (1 − 1/γ)(A·û)û to (P1), which is γ times as
        // much in rest coordinates. The contraction is that in the frame of the scene.
        let v = motion.in_scene();
        motion.turned(v.direction() * (v.gamma_minus_one() * anchor.dot(v.direction())))
    } else {
        DVec3::ZERO
    }
}

/// By a displacement in space and time, in the frame of the scene.
fn own_shift(motion: &RelativeMotion, shift: Event) -> DVec3 {
    if shift == StatedMotion::NO_SHIFT {
        DVec3::ZERO
    } else if motion.has_contraction() {
        motion.turned(Lorentz::boost(motion.in_scene()).inverse().apply(shift).x)
    } else {
        motion.turned(shift.x - motion.in_scene().beta() * shift.t)
    }
}

/// By time and place of the eye.
fn eye_shift(motion: &RelativeMotion, observer: &Observer, time: f64) -> DVec3 {
    if let Some(event) = observer.event {
        let in_rest_frame = Lorentz::boost(motion.in_scene()).inverse().apply(event);
        return -motion.turned(in_rest_frame.x);
    }
    if motion.has_contraction() {
        observer_shift(motion.velocity(), time) // (P5)
    } else {
        motion.velocity().beta() * time
    }
}

/// The centre of the bounding box of each body, in scene coordinates: of its vertices and round
/// faces, or of its lamps if it has neither.
pub(super) fn centers(scene: &Scene, bodies: &[BodyId]) -> Vec<DVec3> {
    const EMPTY: (DVec3, DVec3) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let grow = |(low, high): &mut (DVec3, DVec3), position: DVec3| {
        *low = low.min(position);
        *high = high.max(position);
    };
    let mut boxes = vec![EMPTY; scene.bodies.len()];
    let mut lamp_boxes = boxes.clone();
    for (vertex, body) in scene.vertices.iter().zip(bodies) {
        grow(&mut boxes[body.index()], vertex.position);
    }
    for (body, round) in scene.rounds() {
        round.bounds().into_iter().for_each(|corner| grow(&mut boxes[body.index()], corner));
    }
    for light in &scene.lights {
        if let LightKind::Local { position, .. } = light.kind {
            let body = light.motion.body().unwrap_or(scene.bodies.unstated());
            grow(&mut lamp_boxes[body.index()], position);
        }
    }
    let middle = |(low, high): (DVec3, DVec3)| (low.x <= high.x).then(|| low.midpoint(high));
    let center = |(own, lamps)| middle(own).or(middle(lamps)).unwrap_or_default();
    boxes.into_iter().zip(lamp_boxes).map(center).collect()
}

/// Shifts lamps with their body. Those without a velocity rest with whatever they light, and so are
/// shifted with every body: in place if all bodies are shifted alike, otherwise the shift for each
/// of them becomes part of the scene.
///
/// `scene`: with velocities in the frame of the camera.
pub(super) fn shift_lights(scene: &mut Scene, motions: &[RelativeMotion], shifts: &[DVec3]) {
    let mut is_used = vec![false; motions.len()];
    scene.drawn().for_each(|drawn| is_used[drawn.body.index()] = true);
    let shift_of = |body: BodyId| motions[body.index()].turned_back(shifts[body.index()]);
    let mut lights_everything = Vec::new();
    for light in &mut scene.lights {
        match (&mut light.kind, light.motion.body()) {
            (LightKind::Local { position, .. }, Some(body)) => *position += shift_of(body),
            (LightKind::Local { position, .. }, None) => lights_everything.push(position),
            _ => {}
        }
    }
    if lights_everything.is_empty() {
        return;
    }
    let used = scene.bodies.ids().filter(|body| is_used[body.index()]);
    // Vertices of bodies on world lines stay where they are.
    let (on_lines, used): (Vec<_>, Vec<_>) =
        used.partition(|&body| scene.bodies.is_on_world_line(body));
    let shifts: Vec<(BodyId, DVec3)> =
        used.into_iter().map(|body| (body, shift_of(body))).collect();
    let Some(&(_, first)) = shifts.first() else { return };
    if on_lines.is_empty() && shifts.iter().all(|&(_, shift)| shift == first) {
        lights_everything.into_iter().for_each(|position| *position += first);
        return;
    }
    for (body, shift) in shifts.into_iter().filter(|&(_, shift)| shift != DVec3::ZERO) {
        let shift = Event { t: 0.0, x: shift };
        let velocity = scene.bodies.velocity(body);
        scene.bodies.set_frame(body, InertialFrame { shift, ..InertialFrame::new(velocity) });
    }
}

/// Turns bodies about their reference points as frames in frames are turned, with their lights.
/// `bodies`: of each vertex.
pub(super) fn turn_bodies(scene: &mut Scene, bodies: &[BodyId]) {
    let turn = |body: BodyId| {
        let frame = scene.bodies.motion(body).inertial_frame()?;
        (frame.turn != DVec3::ZERO).then(|| (frame.at, frame.rotation()))
    };
    let turns: Vec<_> = scene.bodies.ids().map(turn).collect();
    if turns.iter().all(Option::is_none) {
        return;
    }
    for (vertex, body) in scene.vertices.iter_mut().zip(bodies) {
        if let Some((at, turn)) = turns[body.index()] {
            vertex.position = at + turn * (vertex.position - at);
            vertex.normal = vertex.normal.map(|normal| turn * normal);
        }
    }
    for light in &mut scene.lights {
        let Some((at, turn)) = light.motion.body().and_then(|body| turns[body.index()]) else {
            continue;
        };
        match &mut light.kind {
            LightKind::Ambient => {}
            LightKind::Directional(toward) => *toward = turn * *toward,
            LightKind::Local { position, beam, .. } => {
                *position = at + turn * (*position - at);
                *beam = beam.turned(|vector| turn * vector);
            }
        }
    }
}
