//! What can go wrong.

use std::fmt;

use glam::DVec3;
use ugparse::{Diagnostic, Diagnostics, Source, Span};
use ugphysics::VelocityError;
use ugscene::{CameraError, StageError};

use crate::adaptive::MAX_PIECES;

/// Why there is no scene.
#[derive(Clone, Debug)]
pub enum Error {
    /// The text is no scene, or what is wrong with it has a place in the text.
    Scene(Diagnostics),
    /// Positions or colours of the scene are as seen already.
    Stage(StageError),
    /// [`crate::Config::velocity`] is invalid.
    Velocity(VelocityError),
    /// [`crate::Config::camera_velocity`] is invalid.
    CameraVelocity(VelocityError),
    /// A body and the camera meet so fast that the body's velocity in the camera's frame rounds to that of light.
    TooFast {
        /// The body's velocity in the frame of the scene.
        beta: DVec3,
    },
    /// Nobody says where the camera looks, so what it sees is not known ([`crate::Config::cull`]).
    NoViewCenter,
    /// The camera makes no sense.
    Camera(CameraError),
    /// The bound of [`crate::Pieces::UpTo`] is not above 0, or not finite.
    NoBound {
        /// The bound given, radians.
        error: f64,
    },
    /// [`crate::Config::color_error`] is not above 0.
    NoColorBound {
        /// The bound given, a part.
        error: f64,
    },
    /// [`crate::Config::light_error`] is not above 0.
    NoLightBound {
        /// The bound given, a part.
        error: f64,
    },
    /// [`crate::Pieces::PerEdge`] is 0.
    NoPieces,
    /// [`crate::Pieces::PerEdge`] makes too many pieces.
    TooManyPieces {
        /// How many there would be.
        n_pieces: usize,
    },
    /// A vertex of a moving body is exactly at the eye.
    VertexAtEye {
        /// Its name.
        name: String,
        /// Its row.
        row: usize,
    },
    /// A vertex is seen further away than numbers reach.
    OutOfRange {
        /// Its name.
        name: String,
        /// Its row.
        row: usize,
    },
}

impl Error {
    /// Is the configuration to blame, not the scene?
    pub fn is_usage(&self) -> bool {
        matches!(
            self,
            Error::Velocity(_)
                | Error::CameraVelocity(_)
                | Error::NoViewCenter
                | Error::NoBound { .. }
                | Error::NoColorBound { .. }
                | Error::NoLightBound { .. }
                | Error::NoPieces
                | Error::TooManyPieces { .. }
        )
    }

    /// With the place in the text, if it has one. `origins`: of each vertex.
    pub(crate) fn located(self, source: &Source, origins: &[Span]) -> Error {
        let row = match self {
            Error::VertexAtEye { row, .. } | Error::OutOfRange { row, .. } => row,
            _ => return self,
        };
        let Some(&span) = origins.get(row) else { return self };
        let finding = Diagnostic::error(span, self.problem()).label("this vertex");
        Error::Scene(Diagnostics::one(source, finding.help(self.remedy())))
    }

    fn problem(&self) -> String {
        match self {
            Error::Scene(diagnostics) => diagnostics.to_string(),
            Error::Stage(error) => error.to_string(),
            Error::Velocity(error) => format!("-vel: {error}"),
            Error::CameraVelocity(error) => format!("-cv: {error}"),
            Error::TooFast { beta } => format!(
                "what moves with {} {} {} in the scene meets the camera (-cv) too near the speed of light to \
                 be written as a velocity",
                beta.x, beta.y, beta.z
            ),
            Error::NoViewCenter => "-cull does not know where the camera looks".to_string(),
            Error::Camera(error) => error.to_string(),
            Error::NoBound { error } => format!("the bound of -se is {} milliradians", error * 1e3),
            Error::NoColorBound { error } => format!("the bound of -sc is {} percent", error * 1e2),
            Error::NoLightBound { error } => format!("the bound of -sl is {} percent", error * 1e2),
            Error::NoPieces => "-sd 0 leaves no pieces".to_string(),
            Error::TooManyPieces { n_pieces } => {
                format!("-sd would make {n_pieces} pieces, more than the limit of {MAX_PIECES}")
            }
            Error::VertexAtEye { name, .. } => {
                format!("vertex `{name}` lies at the eye, where no direction to it exists")
            }
            Error::OutOfRange { name, .. } => {
                format!("vertex `{name}` is seen too far away to be written as a number")
            }
        }
    }

    fn remedy(&self) -> &'static str {
        match self {
            Error::Scene(_)
            | Error::Stage(_)
            | Error::Velocity(_)
            | Error::CameraVelocity(_)
            | Error::Camera(_) => "",
            Error::NoViewCenter => "give the view centre with -vc, or in the `cam` statement of the scene",
            Error::TooFast { .. } => "make one of them slower",
            Error::NoBound { .. } => "give a number above 0",
            Error::NoColorBound { .. } | Error::NoLightBound { .. } => "give a number above 0, or off",
            Error::NoPieces => "give 1 or more",
            Error::TooManyPieces { .. } => "give fewer, or use -se, which cuts only where it shows",
            Error::VertexAtEye { .. } => "move the eye (-ep) or the vertex",
            Error::OutOfRange { .. } => "use smaller coordinates, a smaller time (-ti) or a lower speed",
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.problem())?;
        match self.remedy() {
            "" => Ok(()),
            remedy => write!(f, ": {remedy}"),
        }
    }
}

impl std::error::Error for Error {}
