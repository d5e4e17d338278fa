//! Bodies in motion and points on them.

use glam::{DQuat, DVec3};
use ugphysics::{Velocity, doppler_at};
use ugscene::Geometry;

use crate::{Error, frame};

/// How one body moves, and which effects are shown.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    /// In the frame of the camera.
    velocity: Velocity,
    in_scene: Velocity,
    axes_from_scene: DQuat,
    geometry: Geometry,
}

impl Motion {
    /// Of a body that moves with `velocity` in the frame of the camera, which is that of the scene.
    pub(crate) fn new(velocity: Velocity, geometry: Geometry) -> Motion {
        Motion { velocity, in_scene: velocity, axes_from_scene: DQuat::IDENTITY, geometry }
    }

    /// Of a body that moves with `in_scene`, seen by a camera that moves with `camera`.
    ///
    /// # Errors
    /// They meet too fast.
    pub(crate) fn seen_by(camera: Velocity, in_scene: Velocity, geometry: Geometry) -> Result<Motion, Error> {
        let velocity = frame::in_camera_frame(in_scene, camera)?;
        let axes_from_scene = ugscene::axes_from_scene(velocity, camera);
        Ok(Motion { in_scene, axes_from_scene, ..Motion::new(velocity, geometry) })
    }

    /// In the frame of the camera.
    pub(crate) fn velocity(&self) -> Velocity {
        self.velocity
    }

    /// In the frame of the scene.
    pub(crate) fn in_scene(&self) -> Velocity {
        self.in_scene
    }

    /// Rest coordinates, or a direction, in the axes that this module uses; `p` is in those of the scene. (P25)
    pub(crate) fn turned(&self, p: DVec3) -> DVec3 {
        self.axes_from_scene * p
    }

    /// The inverse of [`Motion::turned`].
    pub(crate) fn turned_back(&self, p: DVec3) -> DVec3 {
        self.axes_from_scene.inverse() * p
    }

    pub(crate) fn is_at_rest(&self) -> bool {
        self.velocity.is_zero()
    }

    /// Are straight edges seen bent?
    pub(crate) fn has_flight_time(&self) -> bool {
        self.geometry.flight_time
    }

    /// Is contraction shown?
    pub(crate) fn has_contraction(&self) -> bool {
        self.geometry.contraction
    }

    /// The rest coordinates of what is seen at `seen`.
    pub(crate) fn rest(&self, seen: DVec3) -> DVec3 {
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

    /// γ − 1 of the motion in the frame of the camera.
    pub(crate) fn gamma_minus_one(&self) -> f64 {
        gamma_minus_one(self.velocity)
    }

    /// The rest coordinates that (P3) maps to where `rest` is seen. Without contraction they are longer along
    /// the motion by γ, which the contraction in (P3) takes back.
    pub(crate) fn boosted_rest(&self, rest: DVec3) -> DVec3 {
        if self.geometry.contraction {
            return rest;
        }
        rest + self.direction() * (self.gamma_minus_one() * rest.dot(self.direction()))
    }

    /// The point at `rest`, relative to the eye.
    pub(crate) fn point(&self, body: u32, rest: DVec3) -> Point {
        let seen = if self.is_at_rest() { rest } else { self.geometry.seen(rest, self.velocity) };
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

/// γ − 1 = (γβ)²/(γ + 1), which does not cancel.
pub(crate) fn gamma_minus_one(v: Velocity) -> f64 {
    v.proper_speed() * (v.proper_speed() / (v.gamma() + 1.0))
}

/// A point of a body, relative to the eye.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    /// Rest coordinates, in the axes of [`Motion::turned`].
    pub rest: DVec3,
    /// Where it is seen.
    pub seen: DVec3,
    /// |p'| of the rest coordinates that (P3) applies to.
    pub rest_distance: f64,
    /// |p|.
    pub seen_distance: f64,
    /// 1/D, (P10).
    pub inverse_doppler: f64,
    /// Row of its body.
    pub body: u32,
    /// How many halvings made it: 0 for a vertex of the scene.
    pub generation: u32,
}
