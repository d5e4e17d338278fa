//! Motions with a name, as the text states them.

use glam::DVec3;
use ugphysics::{Event, Orbit, Piece, SampledPath, Velocity, WorldLine, WorldLineError};

use super::ids::BodyId;

/// The motion of a body with a name: `motion`.
#[derive(Clone, Debug, PartialEq)]
pub struct StatedMotion {
    /// `-at`: the reference point A, in the coordinates of the body.
    pub at: DVec3,
    /// The world line of A.
    pub path: MotionPath,
    /// `-spin`: angular velocity about A along the carried axes, radians per unit of own time.
    pub spins: Vec<Piece>,
    /// `-shift`: displacement of the whole world line in space and time, which `-an`, `-in` and a
    /// camera on a world line leave in a scene as seen.
    pub shift: Event,
}

/// The world line of the reference point of a motion.
#[derive(Clone, Debug, PartialEq)]
pub enum MotionPath {
    /// It is at its place at own time 0.
    Free {
        /// `-vel`: the velocity at own time 0.
        velocity: Velocity,
        /// `-acc`: proper acceleration along the carried axes.
        accelerations: Vec<Piece>,
    },
    /// `-orbit`: a circle through A.
    Orbit {
        /// The centre.
        center: DVec3,
        /// The axis, of any length except 0.
        axis: DVec3,
        /// Radians per unit of the time of the scene.
        rate: f64,
    },
    /// `-path`: A passes the events of a table.
    Along(SampledPath),
    /// `-on`: A is a point of another body.
    On(BodyId),
}

impl StatedMotion {
    /// No displacement.
    pub const NO_SHIFT: Event = Event { t: 0.0, x: DVec3::ZERO };

    /// Constant velocity.
    pub fn inertial(velocity: Velocity) -> Self {
        let path = MotionPath::Free { velocity, accelerations: Vec::new() };
        Self { at: DVec3::ZERO, path, spins: Vec::new(), shift: Self::NO_SHIFT }
    }

    /// The body that this one is part of.
    pub fn on(&self) -> Option<BodyId> {
        match self.path {
            MotionPath::On(body) => Some(body),
            _ => None,
        }
    }

    /// The world line in the frame of the scene. `carrier`: that of the body that this one is part
    /// of; at rest if there is none.
    ///
    /// # Errors
    /// See [`WorldLineError`].
    pub fn world_line(&self, carrier: &WorldLine) -> Result<WorldLine, WorldLineError> {
        let line = match &self.path {
            MotionPath::Free { velocity, accelerations } => {
                WorldLine::accelerated(self.at, *velocity, accelerations, &self.spins)
            }
            &MotionPath::Orbit { center, axis, rate } => {
                WorldLine::orbiting(Orbit::new(self.at, center, axis, rate)?, &self.spins)
            }
            MotionPath::Along(path) => WorldLine::along(self.at, path.clone(), &self.spins),
            MotionPath::On(_) => carrier.with_part(self.at, &self.spins),
        }?;
        if self.shift == Self::NO_SHIFT {
            return Ok(line);
        }
        let origin = Event { t: -self.shift.t, x: -self.shift.x };
        Ok(line.in_frame(ugphysics::Lorentz::IDENTITY, origin))
    }
}
