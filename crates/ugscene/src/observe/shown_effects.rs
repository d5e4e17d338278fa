//! Transformation between rest positions and seen positions, also with effects omitted.

use glam::DVec3;
use ugphysics::{Velocity, contracted, elongated, flight_time, rest_position, seen_position};

use crate::Scene;

/// Where a point is seen: relative to the eye, in the frame of the camera. p of (P3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenPosition(pub DVec3);

/// Where a point rests: relative to the eye, in the rest frame of its body, with the axes of a
/// single boost to the frame of the camera. p' of (P3).
///
/// [`ugphysics::RestFrame::scene_from_boosted`] turns it into the axes of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestPosition(pub DVec3);

/// Which of the two effects are included in the seen positions of a scene: both, unless its stage
/// says otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShownEffects {
    /// Lorentz contraction, (P1).
    pub contraction: bool,
    /// Time of flight, (P2).
    pub flight_time: bool,
}

impl Default for ShownEffects {
    fn default() -> Self {
        Self { contraction: true, flight_time: true }
    }
}

impl ShownEffects {
    /// The effects that the stage of a scene states.
    pub fn of(scene: &Scene) -> Self {
        match scene.stage.seen_geometry() {
            Some(seen) => Self { contraction: seen.contraction, flight_time: seen.flight_time },
            None => Self::default(),
        }
    }

    /// The seen position of a point of a body: by contraction and flight time (P3), or by one of
    /// the two effects alone (P1), (P2).
    pub fn seen(self, RestPosition(rest): RestPosition, v: Velocity) -> SeenPosition {
        SeenPosition(match (self.contraction, self.flight_time) {
            (true, true) => seen_position(rest, v),
            (true, false) => contracted(rest, v),
            (false, true) => rest + flight_time(rest, v) * v.beta(),
            (false, false) => rest,
        })
    }

    /// The inverse of [`ShownEffects::seen`]; (P4) with both effects.
    pub fn rest(self, SeenPosition(seen): SeenPosition, v: Velocity) -> RestPosition {
        RestPosition(match (self.contraction, self.flight_time) {
            (true, true) => rest_position(seen, v),
            (true, false) => elongated(seen, v),
            // The light left at time −|seen|; since then the body has moved with v.
            (false, true) => seen + seen.length() * v.beta(),
            (false, false) => seen,
        })
    }

    /// A normal of the seen surface from that of the surface at rest, with the same axes. Any
    /// length; it stays on the same side.
    ///
    /// Planes through a point transform by the gradient of the rest position with respect to the
    /// seen one, the transpose of the Jacobian of (P4): with p' = p + (γ − 1)(p·b) b + γ |p| β and
    /// b along β, n = n' + (γ − 1)(n'·b) b + γ (n'·β) p/|p|. At the eye, where it does not exist,
    /// without the last term.
    pub fn seen_normal(
        self,
        RestPosition(rest): RestPosition,
        SeenPosition(seen): SeenPosition,
        v: Velocity,
    ) -> DVec3 {
        if v.is_zero() {
            return rest;
        }
        let mut normal = rest;
        if self.contraction {
            normal += v.gamma_minus_one() * rest.dot(v.direction()) * v.direction();
        }
        if self.flight_time {
            let gamma = if self.contraction { v.gamma() } else { 1.0 };
            normal += gamma * rest.dot(v.beta()) * seen.normalize_or_zero();
        }
        normal
    }
}
