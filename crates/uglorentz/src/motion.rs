//! Bodies in motion and points on them.

use glam::DVec3;
use ugphysics::{Velocity, doppler_at};
use ugscene::Geometry;

/// How one body moves, and which effects are shown.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    velocity: Velocity,
    geometry: Geometry,
}

impl Motion {
    pub(crate) fn new(velocity: Velocity, geometry: Geometry) -> Motion {
        Motion { velocity, geometry }
    }

    pub(crate) fn velocity(&self) -> Velocity {
        self.velocity
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

    /// γ − 1 = (γβ)²/(γ + 1), which does not cancel.
    pub(crate) fn gamma_minus_one(&self) -> f64 {
        self.proper_speed() * (self.proper_speed() / (self.gamma() + 1.0))
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

/// A point of a body, relative to the eye.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    /// Rest coordinates.
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
