//! Motion on a circle.

use glam::{DQuat, DVec3};

use super::super::pieces::rotation;
use super::super::{Piece, Pose, WorldLine, WorldLineError};
use super::Curve;
use crate::{Event, Lorentz, Velocity};

/// A circle on which a reference point runs with constant speed, and the axes that are carried
/// along without turning. Seen from the scene they turn by −2π(γ − 1) a revolution (Thomas).  Eq.
/// (P44)
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::world_line) struct Orbit {
    center: DVec3,
    /// The unit vector about which the point runs counterclockwise.
    axis: DVec3,
    /// Radians per unit of the time of the scene.
    rate: f64,
    /// From the centre to the point at own time 0.
    start: DVec3,
    velocity: Velocity,
}

impl WorldLine {
    /// A motion whose reference point, which is at `at` at time 0, runs on a circle about the axis
    /// `axis` through `center`, with `rate` radians per unit of the time of the scene.
    ///
    /// # Errors
    /// [`WorldLineError::NotFinite`], [`WorldLineError::NoAxis`], [`WorldLineError::Velocity`] if
    /// the speed is not below that of light, or the error of a spin.
    pub fn orbiting(
        at: DVec3,
        center: DVec3,
        axis: DVec3,
        rate: f64,
        spins: &[Piece],
    ) -> Result<Self, WorldLineError> {
        if !(at.is_finite() && center.is_finite() && axis.is_finite() && rate.is_finite()) {
            return Err(WorldLineError::NotFinite);
        }
        let axis = crate::unit_or_zero(axis);
        if axis == DVec3::ZERO {
            return Err(WorldLineError::NoAxis);
        }
        let start = at - center;
        let velocity = Velocity::from_beta(rate * axis.cross(start))?;
        let orbit = Orbit { center, axis, rate, start, velocity };
        // As the pose at own time 0 has it.
        Self::on_curve(center + start, velocity, Curve::Orbit(orbit), spins)
    }
}

impl Orbit {
    /// Radians per unit of own time by which the acceleration turns in the carried axes: γ²ω.
    pub(super) fn turn_rate(&self) -> f64 {
        self.velocity.gamma() * (self.rate * self.velocity.gamma()).abs()
    }

    /// The pose and the proper acceleration in the carried axes.
    pub(super) fn pose(&self, own_time: f64) -> (Pose, DVec3) {
        let gamma = self.velocity.gamma();
        // The turn of the point's place about the axis.
        let progress = rotation(self.axis, self.rate * gamma * own_time);
        let event = Event { t: gamma * own_time, x: self.center + progress * self.start };
        // A turn does not change the speed, whose square is below the limit.
        let velocity =
            Velocity::from_proper(progress * self.velocity.proper()).unwrap_or(self.velocity);
        let lag =
            rotation(self.axis, -self.velocity.gamma_minus_one() * gamma * self.rate * own_time);
        let scene_from_axes = Lorentz::boost(velocity) * Lorentz::rotation(lag);
        let acceleration = lag.conjugate() * (progress * self.initial_acceleration());
        (Pose { event, scene_from_axes, turn: DQuat::IDENTITY }, acceleration)
    }

    /// |a| and |da/dτ|.
    pub(super) fn bounds(&self) -> [f64; 2] {
        let acceleration = self.initial_acceleration().length();
        [acceleration, self.turn_rate() * acceleration]
    }

    /// At own time 0. Centripetal, perpendicular to the velocity: γ²ω²ρ towards the axis.
    fn initial_acceleration(&self) -> DVec3 {
        let from_axis = self.start - self.start.dot(self.axis) * self.axis;
        let own_rate = self.velocity.gamma() * self.rate;
        -own_rate * own_rate * from_axis
    }
}
