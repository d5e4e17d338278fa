//! Motions with a name, as the text states them.

use glam::DVec3;
use ugphysics::{Event, InertialFrame, Piece, SampledPath, Velocity, WorldLine, WorldLineError};

use super::ids::BodyId;

/// The motion of a body with a name: `motion`.
#[derive(Clone, Debug, PartialEq)]
pub struct StatedMotion {
    /// `-at`: the reference point A, in the coordinates of the body.
    pub at: DVec3,
    /// The world line of A, in the frame of the carrier.
    pub path: MotionPath,
    /// `-spin`: angular velocity about A along the carried axes, radians per unit of own time.
    pub spins: Vec<Piece>,
    /// `-on`: what it moves on; the scene if it is `None`.
    pub on: Option<Carrier>,
    /// `-shift`: displacement of the whole world line in space and time, in the frame of the scene,
    /// which `-an`, `-in` and a camera on a world line leave in a scene as seen.
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
    /// `-orbit`: a curve given by a few numbers, on which A is at own time 0.
    Curve {
        /// Its kind.
        kind: &'static CurveKind,
        /// The numbers of the option.
        numbers: Vec<f64>,
    },
    /// `-path`: A passes the events of a table.
    Along(SampledPath),
}

impl MotionPath {
    /// A is a fixed point of the carrier.
    pub const FIXED: Self = Self::Free { velocity: Velocity::ZERO, accelerations: Vec::new() };
}

/// A kind of curve: the option that states it, and its world line.
#[derive(Debug)]
pub struct CurveKind {
    /// The option without `-`, and the numbers that follow it, as the manual shows them.
    pub form: &'static str,
    /// Where among them a vector begins that is not zero.
    pub axis: Option<usize>,
    line: Line,
}

/// Makes the world line of a body from A, the numbers of the curve, and the spins.
type Line = fn(DVec3, &[f64], &[Piece]) -> Result<WorldLine, WorldLineError>;

impl CurveKind {
    /// All kinds.
    pub const ALL: &'static [Self] = &[Self {
        form: "orbit cx cy cz nx ny nz ω",
        axis: Some(3),
        // The centre, the axis, and the angular velocity in the time of the frame.
        line: |at, numbers, spins| {
            let [center, axis] = [0, 3].map(|row| DVec3::from_slice(&numbers[row..]));
            WorldLine::orbiting(at, center, axis, numbers[6], spins)
        },
    }];

    /// The option without `-`.
    pub fn word(&self) -> &'static str {
        self.form.split(' ').next().unwrap_or_default()
    }

    /// How many numbers follow it.
    pub fn n_numbers(&self) -> usize {
        self.form.split(' ').count() - 1
    }

    /// All options of a motion, for error messages.
    pub const OPTIONS: &'static str =
        "an option of a motion (-vel -at -acc -spin -orbit -path -on -shift)";

    /// The options that state a path, of which a motion has one kind, for error messages.
    pub const PATHS: &'static str = "give `-vel` and `-acc`, or `-orbit`, or `-path`";
}

impl PartialEq for CurveKind {
    fn eq(&self, other: &Self) -> bool {
        self.form == other.form
    }
}

/// What a motion moves on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Carrier {
    /// Another body with a name.
    Body(BodyId),
    /// A frame of constant velocity in the scene.
    Frame(InertialFrame),
}

impl StatedMotion {
    /// No displacement.
    pub const NO_SHIFT: Event = Event { t: 0.0, x: DVec3::ZERO };

    /// Constant velocity.
    pub fn inertial(velocity: Velocity) -> Self {
        let path = MotionPath::Free { velocity, accelerations: Vec::new() };
        Self { at: DVec3::ZERO, path, spins: Vec::new(), on: None, shift: Self::NO_SHIFT }
    }

    /// The body that it moves on.
    pub fn body(&self) -> Option<BodyId> {
        match self.on {
            Some(Carrier::Body(body)) => Some(body),
            _ => None,
        }
    }

    /// The world line in the frame of the scene. `body`: that of the body that this one moves on.
    /// `None` if it moves on a body that accelerates or turns, and not with a point of it.
    ///
    /// # Errors
    /// See [`WorldLineError`].
    pub fn world_line(&self, body: &WorldLine) -> Result<Option<WorldLine>, WorldLineError> {
        let frame = match &self.on {
            None => &InertialFrame::REST,
            Some(Carrier::Frame(frame)) => frame,
            Some(Carrier::Body(_)) => match body.inertial_frame() {
                Some(frame) => frame,
                None if self.path != MotionPath::FIXED => return Ok(None),
                None => return Ok(Some(self.displaced(body.with_part(self.at, &self.spins)?))),
            },
        };
        let line = match &self.path {
            MotionPath::Free { velocity, accelerations } => {
                WorldLine::accelerated(self.at, *velocity, accelerations, &self.spins)
            }
            MotionPath::Curve { kind, numbers } => (kind.line)(self.at, numbers, &self.spins),
            MotionPath::Along(path) => WorldLine::along(self.at, path.clone(), &self.spins),
        }?;
        let line = if *frame == InertialFrame::REST { line } else { line.carried_by(frame)? };
        Ok(Some(self.displaced(line)))
    }

    fn displaced(&self, line: WorldLine) -> WorldLine {
        if self.shift == Self::NO_SHIFT { line } else { line.displaced(self.shift) }
    }
}
