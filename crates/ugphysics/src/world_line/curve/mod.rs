//! Paths of reference points other than pieces of constant acceleration: circles, and paths
//! through given events.

mod orbit;

use glam::DVec3;

use super::{Pose, SampledPath};
use crate::{Event, Lorentz};
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
            Self::Orbit(orbit) => orbit.pose(own_time),
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

/// A curve seen from another frame than the one in which it is stated.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Framed {
    pub curve: Curve,
    /// Maps events of the curve, less `origin`, to the frame of the world line.
    frame: Lorentz,
    /// In the frame of the curve.
    origin: Event,
}

impl Framed {
    /// A curve in its own frame.
    pub fn new(curve: Curve) -> Self {
        Self { curve, frame: Lorentz::IDENTITY, origin: Event::ORIGIN }
    }

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
