//! World lines of reference points that are not pieces of constant acceleration.

mod orbit;

use glam::DVec3;

use super::moving::{Moving, Path, Turn};
use super::pieces::Spin;
use super::{Kind, Piece, Pose, SampledPath, WorldLine, WorldLineError};
use crate::{Event, Lorentz, Velocity};
use orbit::Orbit;

/// A curve in the frame in which it is stated: at its place at own time 0.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Curve {
    Orbit(Orbit),
    Along(SampledPath),
}

impl Curve {
    /// The pose and the proper acceleration in the carried axes.
    fn pose(&self, own_time: f64) -> (Pose, DVec3) {
        match self {
            Self::Orbit(orbit) => (orbit.pose(own_time), orbit.acceleration(own_time)),
            Self::Along(path) => path.pose(own_time),
        }
    }

    /// |a| and |da/dτ|, or upper bounds of them, between own times at which the acceleration does
    /// not jump.
    pub fn bounds(&self, own_times: [f64; 2]) -> [f64; 2] {
        match self {
            Self::Orbit(orbit) => orbit.bounds(),
            Self::Along(path) => path.bounds(own_times),
        }
    }

    /// Radians per unit of own time by which the acceleration turns in the carried axes at all
    /// times.
    pub fn turn_rate(&self) -> f64 {
        match self {
            Self::Orbit(orbit) => orbit.turn_rate(),
            Self::Along(_) => 0.0,
        }
    }

    /// Own times at which the acceleration, or the bound of its derivative, changes.
    pub fn changes(&self) -> impl Iterator<Item = f64> + use<> {
        let changes = match self {
            Self::Orbit(_) => None,
            Self::Along(path) => Some([0.0, path.end()]),
        };
        changes.into_iter().flatten()
    }
}

/// A curve in any frame.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Framed {
    pub curve: Curve,
    /// The frame of the world line from that of the curve, after `origin` is subtracted.
    frame: Lorentz,
    origin: Event,
}

impl Framed {
    pub fn change_frame(&mut self, target_from_source: Lorentz, origin: Event) {
        self.origin = self.origin + self.frame.inverse().apply(origin);
        self.frame = target_from_source * self.frame;
    }

    /// The pose and the proper acceleration in the carried axes.
    pub fn pose(&self, own_time: f64) -> (Pose, DVec3) {
        let (Pose { event, scene_from_axes, turn }, acceleration) = self.curve.pose(own_time);
        let event = self.frame.apply(event - self.origin);
        (Pose { event, scene_from_axes: self.frame * scene_from_axes, turn }, acceleration)
    }
}

impl WorldLine {
    /// A motion whose reference point, `at` in the coordinates of the body, passes given events, at
    /// whose first its own time is 0.  Eq. (P48)
    ///
    /// # Errors
    /// See [`WorldLineError`].
    pub fn along(at: DVec3, path: SampledPath, spins: &[Piece]) -> Result<Self, WorldLineError> {
        Self::on_curve(at, path.velocity(), Curve::Along(path), spins)
    }

    /// A motion whose reference point, `at` in the coordinates of the body, follows a curve.
    /// `initial`: its velocity at own time 0.
    fn on_curve(at: DVec3, initial: Velocity, curve: Curve, spins: &[Piece]) -> Result<Self, WorldLineError> {
        if !at.is_finite() {
            return Err(WorldLineError::NotFinite);
        }
        let turns = Turn::new(at, Spin::new(spins)?).into_iter().collect();
        let framed = Framed { curve, frame: Lorentz::IDENTITY, origin: Event { t: 0.0, x: DVec3::ZERO } };
        Ok(Self(Kind::Moving(Box::new(Moving { at, initial, path: Path::Curved(Box::new(framed)), turns }))))
    }
}
