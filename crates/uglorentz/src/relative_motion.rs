//! The motion of a body relative to the camera, and points of bodies.

use glam::{DQuat, DVec3};
use ugparse::BodyId;
use ugphysics::{Velocity, doppler_at, elongated};
use ugscene::{Geometry, RestPosition, SeenPosition};

use crate::{Error, camera_frame};

/// How one body moves relative to the camera, and which effects are shown.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RelativeMotion {
    /// In the frame of the camera.
    velocity: Velocity,
    in_scene: Velocity,
    axes_from_scene: DQuat,
    geometry: Geometry,
}

impl RelativeMotion {
    /// Of a body with `velocity` in the frame of the camera, which is the frame of the scene.
    pub(crate) fn new(velocity: Velocity, geometry: Geometry) -> RelativeMotion {
        RelativeMotion { velocity, in_scene: velocity, axes_from_scene: DQuat::IDENTITY, geometry }
    }

    /// Of a body and a camera with velocities `in_scene` and `camera` in the frame of the scene.
    ///
    /// # Errors
    /// Their relative velocity rounds to that of light.
    pub(crate) fn seen_by(
        camera: Velocity,
        in_scene: Velocity,
        geometry: Geometry,
    ) -> Result<RelativeMotion, Error> {
        let velocity = camera_frame::in_camera_frame(in_scene, camera)?;
        let axes_from_scene = ugscene::axes_from_scene(velocity, camera);
        Ok(RelativeMotion { in_scene, axes_from_scene, ..RelativeMotion::new(velocity, geometry) })
    }

    /// In the frame of the camera.
    pub(crate) fn velocity(&self) -> Velocity {
        self.velocity
    }

    /// In the frame of the scene.
    pub(crate) fn in_scene(&self) -> Velocity {
        self.in_scene
    }

    /// Rest coordinates, or a direction, in the axes of [`Point::rest`]; `p` is in the axes of the
    /// scene.  Eq. (P25)
    pub(crate) fn turned(&self, p: DVec3) -> DVec3 {
        self.axes_from_scene * p
    }

    /// The inverse of [`RelativeMotion::turned`].
    pub(crate) fn turned_back(&self, p: DVec3) -> DVec3 {
        self.axes_from_scene.inverse() * p
    }

    pub(crate) fn is_at_rest(&self) -> bool {
        self.velocity.is_zero()
    }

    /// Is the time of flight of light taken into account, so that straight edges are seen as
    /// curves?
    pub(crate) fn has_flight_time(&self) -> bool {
        self.geometry.flight_time
    }

    /// Is contraction shown?
    pub(crate) fn has_contraction(&self) -> bool {
        self.geometry.contraction
    }

    /// The rest position of what is seen at `seen`.
    pub(crate) fn rest(&self, seen: SeenPosition) -> RestPosition {
        self.geometry.rest(seen, self.velocity)
    }

    /// û.
    pub(crate) fn direction(&self) -> DVec3 {
        self.velocity.direction()
    }

    /// γ.
    pub(crate) fn gamma(&self) -> f64 {
        self.velocity.gamma()
    }

    /// γβ.
    pub(crate) fn proper_speed(&self) -> f64 {
        self.velocity.proper_speed()
    }

    /// The vector in rest coordinates that (P3) maps to where `rest` is seen. Without contraction
    /// it is `rest` elongated along the motion by γ, which cancels the contraction in (P3).
    pub(crate) fn boosted_rest(&self, rest: DVec3) -> DVec3 {
        if self.geometry.contraction { rest } else { elongated(rest, self.velocity) }
    }

    /// The point at `rest`, relative to the eye.
    pub(crate) fn point(&self, body: BodyId, rest: DVec3) -> Point {
        let seen = match self.is_at_rest() {
            true => rest,
            false => self.geometry.seen(RestPosition(rest), self.velocity).0,
        };
        let (rest_distance, seen_distance) = (self.boosted_rest(rest).length(), seen.length());
        let inverse_doppler = if self.is_at_rest() {
            1.0
        } else if self.has_flight_time() {
            // D = |p|/|p'|.
            rest_distance / seen_distance
        } else {
            1.0 / doppler_at(seen, self.velocity)
        };
        Point { rest, seen, rest_distance, seen_distance, inverse_doppler, body, generation: 0 }
    }
}

/// A point of a body. Both positions are relative to the eye.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    /// Rest coordinates, in the axes of [`RelativeMotion::turned`].
    pub rest: DVec3,
    /// Seen position.
    pub seen: DVec3,
    /// |p'| of the rest coordinates that (P3) applies to.
    pub rest_distance: f64,
    /// |p|.
    pub seen_distance: f64,
    /// 1/D, (P10).
    pub inverse_doppler: f64,
    /// The body it is part of.
    pub body: BodyId,
    /// Number of halvings that led to it: 0 for a vertex of the scene.
    pub generation: u32,
}
