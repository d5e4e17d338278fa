//! Bodies of constant velocity: their rest frames, and frames in frames.

use glam::{DQuat, DVec3};

use super::moving::{Moving, Path};
use super::pieces::{Acceleration, rotation};
use super::{Pose, WorldLineError};
use crate::{Event, Lorentz, Velocity, compose_rounded, wigner_rotation};

/// The rest frame of a body of constant velocity, and where in space and time the body is in it.
///
/// At its own time 0 the reference point A is at the event (0, A), displaced by `shift`. All other
/// points keep their distances to A in the rest frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InertialFrame {
    /// β, in the frame that this one moves in.
    pub velocity: Velocity,
    /// A, in the coordinates of the body.
    pub at: DVec3,
    /// The turn about A in the axes of a single boost: axis times angle in radians. Frames in
    /// frames of another direction are turned (Wigner rotation).
    pub turn: DVec3,
    /// Displacement in space and time of the event of A at own time 0 from (0, A).
    pub shift: Event,
}

impl InertialFrame {
    /// At rest.
    pub const REST: Self = Self::new(Velocity::ZERO);

    /// A body with this velocity whose reference point is the origin.
    pub const fn new(velocity: Velocity) -> Self {
        Self { velocity, at: DVec3::ZERO, turn: DVec3::ZERO, shift: Event::ORIGIN }
    }

    /// The turn about A.
    pub fn rotation(&self) -> DQuat {
        rotation(self.turn, 1.0)
    }

    /// The frame it moves in from its own axes.
    pub fn axes(&self) -> Lorentz {
        let boost = Lorentz::boost(self.velocity);
        if self.turn == DVec3::ZERO { boost } else { boost * Lorentz::rotation(self.rotation()) }
    }

    /// The event of A at own time 0.
    pub fn start(&self) -> Event {
        Event { t: 0.0, x: self.at } + self.shift
    }

    /// A frame that moves in this one, seen from outside: velocities are composed by (P15), and
    /// boosts in different directions turn it.
    ///
    /// `inner`: with A in the coordinates of this body. Its own time 0 is at that of this body, in
    /// the frame of this body.
    ///
    /// # Errors
    /// The velocity rounds to that of light.
    pub fn carrying(&self, inner: &Self) -> Result<Self, WorldLineError> {
        if *self == Self::REST {
            return Ok(*inner);
        }
        if *inner == (Self { at: inner.at, ..Self::REST }) {
            // At rest in it: the same body, with its reference point.
            return Ok(*self);
        }
        let turn = self.rotation();
        let is_turned = self.turn != DVec3::ZERO;
        let relative = if is_turned {
            Velocity::from_proper(turn * inner.velocity.proper())?
        } else {
            inner.velocity
        };
        // Rounded to what texts express, before anything follows from it.
        let velocity = compose_rounded(relative, self.velocity)?;
        let turn = wigner_rotation(relative, self.velocity) * turn * inner.rotation();
        let start = self.start() + self.axes().apply(inner.start() - Event { t: 0.0, x: self.at });
        Ok(Self {
            velocity,
            at: inner.at,
            turn: turn_vector(turn),
            shift: start - Event { t: 0.0, x: inner.at },
        })
    }

    /// Event and axes of A at an own time.
    pub(super) fn pose(&self, own_time: f64) -> Pose {
        let scene_from_axes = self.axes();
        let event = self.start() + scene_from_axes.apply(Event { t: own_time, x: DVec3::ZERO });
        Pose { event, scene_from_axes, turn: DQuat::IDENTITY }
    }

    /// The same in other coordinates of space-time, see [`super::WorldLine::in_frame`].
    pub(super) fn in_frame(&self, target_from_source: Lorentz, origin: Event) -> Self {
        let start = target_from_source.apply(self.start() - origin);
        let shift = start - Event { t: 0.0, x: self.at };
        if target_from_source == Lorentz::IDENTITY {
            return Self { shift, ..*self };
        }
        let axes = target_from_source * self.axes();
        let velocity = axes.velocity_of_frame().unwrap_or(self.velocity);
        let turn = turn_vector((Lorentz::boost(velocity).inverse() * axes).turn());
        Self { velocity, at: self.at, turn, shift }
    }

    /// As a motion to which spins can be added.
    pub(super) fn as_moving(&self) -> Moving {
        let path = Path::Accelerated(Acceleration::none(self.pose(0.0)));
        Moving { at: self.at, initial: self.velocity, path, turns: Vec::new() }
    }
}

/// Axis times angle of a turn, in radians up to π. Rounding of a matrix product is no turn.
fn turn_vector(turn: DQuat) -> DVec3 {
    let turn = if turn.w < 0.0 { -turn } else { turn };
    let sine = DVec3::new(turn.x, turn.y, turn.z);
    let length = crate::length(sine);
    const ROUNDING: f64 = 1e-15;
    if length < ROUNDING {
        DVec3::ZERO
    } else {
        sine * (2.0 * libm::atan2(length, turn.w) / length)
    }
}
