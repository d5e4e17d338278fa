//! The rest frames of a scene's bodies, and which body a vertex is part of.

use std::sync::Arc;

use glam::DVec3;
use ugphysics::{Event, Lorentz, RestFrame, Velocity, WorldLine};

use super::eye::world_line;
use crate::{
    BodyId, FaceOrWire, RelativeMotion, Scene, ShownEffects, axes_from_scene, camera_velocity,
    split_vertices,
};

/// The motion of each body of a scene as seen, and its rest frame, relative to the camera.
#[derive(Clone, Debug)]
pub struct RestFrames {
    /// In the order of [`Scene::bodies`].
    motions: Vec<RelativeMotion>,
    /// For each body, see [`RestFrames::lamp_shift`].
    lamp_shifts: Vec<DVec3>,
    /// The velocity of the camera in the frame of the scene.
    camera: Velocity,
}

impl RestFrames {
    /// The rest frames of the bodies of `scene`.
    pub fn new(scene: &Scene) -> Self {
        Self::with_default(scene, Velocity::ZERO)
    }

    /// Like [`RestFrames::new`], with `velocity` for bodies whose motion is not stated.
    pub fn with_default(scene: &Scene, velocity: Velocity) -> Self {
        let (camera, geometry) = (camera_velocity(scene), ShownEffects::of(scene));
        let motion = |body| {
            let velocity = scene.bodies.stated_velocity(body).unwrap_or(velocity);
            let motion = RelativeMotion::composed(velocity, velocity, camera, geometry);
            motion.with_line(world_line(scene, body))
        };
        let motions = scene.bodies.ids().map(motion).collect();
        let shift = |body| scene.bodies.motion(body).inertial_frame().map(|frame| frame.shift.x);
        let lamp_shifts = scene.bodies.ids().map(|body| shift(body).unwrap_or_default()).collect();
        Self { motions, lamp_shifts, camera }
    }

    /// The motion of a body relative to the camera.
    #[inline]
    pub fn motion(&self, body: BodyId) -> &RelativeMotion {
        &self.motions[body.index()]
    }

    /// The world line of a body that is not inertial in a scene as seen, in the frame of the
    /// camera with the event of the eye as its origin; coordinates of the body are relative to the
    /// eye. The rest frame and velocity of such a body are those at its own time 0.
    #[inline]
    pub fn world_line(&self, body: BodyId) -> Option<&Arc<WorldLine>> {
        self.motion(body).world_line()
    }

    /// Coordinates in the frame of the scene from those in the frame of the camera, with the event of
    /// the eye as the origin of both.
    pub fn scene_from_camera(&self) -> Lorentz {
        Lorentz::boost(self.camera)
    }

    /// True if a body has a world line.
    pub fn have_world_lines(&self) -> bool {
        self.motions.iter().any(|motion| motion.world_line().is_some())
    }

    /// The velocity of the point of a body at an event, in the frame of the camera with the eye as
    /// origin; and its own time if the body is on a world line and a point of it can be there.
    pub fn at_event(&self, body: BodyId, event: Event) -> (Velocity, Option<f64>) {
        let of_line = || {
            let line = self.world_line(body)?;
            let (point, own_time) = line.at_event(event).ok()?;
            Some((line.velocity(point, own_time).ok()?, Some(own_time)))
        };
        of_line().unwrap_or((self.velocity(body), None))
    }

    /// The point of a body at an event relative to that of the eye; `None` if none can be there.
    pub fn point_at(&self, body: BodyId, event: Event) -> Option<DVec3> {
        match self.world_line(body) {
            Some(line) => line.at_event(event).ok().map(|(point, _)| point),
            None => Some(self.of(body).rest_from_camera(event).x),
        }
    }

    /// True if a body, or a part of it, moves relative to the camera.
    pub fn is_moving(&self, body: BodyId) -> bool {
        !self.motion(body).is_at_rest()
    }

    /// True if two bodies have the same motion.
    pub fn move_alike(&self, a: BodyId, b: BodyId) -> bool {
        self.velocity(a) == self.velocity(b) && self.world_line(a) == self.world_line(b)
    }

    /// The rest frame of a body.
    pub fn of(&self, body: BodyId) -> &RestFrame {
        self.motion(body).rest_frame()
    }

    /// The velocity of a body in the frame of the camera.
    pub fn velocity(&self, body: BodyId) -> Velocity {
        self.motion(body).velocity()
    }

    /// The displacement of lamps that rest with whatever they light, when they light
    /// this body, in the axes of the scene.
    #[inline]
    pub fn lamp_shift(&self, body: BodyId) -> DVec3 {
        self.lamp_shifts[body.index()]
    }

    /// The greatest rapidity of a body.
    pub fn greatest_rapidity(&self) -> f64 {
        self.motions.iter().map(|motion| motion.velocity().rapidity()).fold(0.0, f64::max)
    }

    /// True if nothing moves.
    pub fn are_at_rest(&self) -> bool {
        self.motions.iter().all(RelativeMotion::is_at_rest)
    }
}

/// The rest frame of a body with `velocity` in the frame of a camera with the velocity `camera` in
/// the scene, with the axes of the scene.  Eq. (P25)
pub(crate) fn frame(velocity: Velocity, camera: Velocity) -> RestFrame {
    RestFrame::turned(velocity, axes_from_scene(velocity, camera).inverse())
}

/// The body of each vertex, from the faces and wires that use it; [`crate::Bodies::unstated`] for
/// unused vertices.
///
/// A vertex shared by several bodies is part of the first of them. [`separate_bodies`] removes such
/// sharing.
pub fn vertex_bodies(scene: &Scene) -> Vec<BodyId> {
    let mut bodies = vec![scene.bodies.unstated(); scene.vertices.len()];
    // In reverse, so that the first user is written last.
    for FaceOrWire { contours, body, .. } in scene.drawn().rev() {
        for corner in scene.contours.corners(contours) {
            bodies[corner.index()] = body;
        }
    }
    bodies
}

/// True if all faces and wires are part of one body; [`separate_bodies`] then changes nothing.
pub fn is_one_body(scene: &Scene) -> bool {
    let mut bodies = scene.drawn().map(|drawn| drawn.body);
    let first = bodies.next();
    scene.bodies.len() == 1 || bodies.all(|body| Some(body) == first)
}

/// Gives every body its own vertices: where faces or wires of different bodies share a vertex, the
/// later ones get a copy, named after it.
pub fn separate_bodies(scene: &mut Scene) {
    if !is_one_body(scene) {
        let users: Vec<_> = scene.drawn().map(|drawn| (drawn.contours, drawn.body)).collect();
        split_vertices(scene, &users, |_| true);
    }
}
