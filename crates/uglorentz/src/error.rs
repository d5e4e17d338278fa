//! Errors.

use std::fmt;

use thiserror::Error;
use ugparse::{Diagnostic, Diagnostics, Origins, Source};
use ugscene::{CameraError, MotionError};

use crate::adaptive::MAX_PIECES;

/// Why a scene cannot be mapped to the scene as seen.
#[derive(Clone, Debug, Error)]
pub enum Error {
    /// The stage of the scene, a motion or the camera is invalid.
    Motion(#[from] MotionError),
    /// [`crate::Config::cull`] needs the view centre, and neither the configuration nor the scene
    /// has one.
    NoViewCenter,
    /// The view of the camera is invalid.
    Camera(CameraError),
    /// The bound of [`crate::Pieces::UpTo`] is not above 0, or not finite.
    NoBound {
        /// The bound given, radians.
        error: f64,
    },
    /// [`crate::Config::color_error`] is not above 0.
    NoColorBound {
        /// The bound given, a fraction.
        error: f64,
    },
    /// [`crate::Config::light_error`] is not above 0.
    NoLightBound {
        /// The bound given, a fraction.
        error: f64,
    },
    /// [`crate::Pieces::PerEdge`] is 0.
    NoPieces,
    /// [`crate::Pieces::PerEdge`] makes too many pieces.
    TooManyPieces {
        /// The number of pieces it would make.
        n_pieces: usize,
    },
    /// A vertex of a moving body is exactly at the eye.
    VertexAtEye {
        /// Its name.
        name: String,
        /// Its row.
        row: usize,
    },
    /// The seen position of a vertex overflows.
    OutOfRange {
        /// Its name.
        name: String,
        /// Its row.
        row: usize,
    },
}

impl Error {
    /// True if the configuration is invalid, false if the scene is.
    pub fn is_usage(&self) -> bool {
        let Error::Motion(error) = self else {
            return matches!(
                self,
                Error::Camera(CameraError::NoUp)
                    | Error::NoViewCenter
                    | Error::NoBound { .. }
                    | Error::NoColorBound { .. }
                    | Error::NoLightBound { .. }
                    | Error::NoPieces
                    | Error::TooManyPieces { .. }
            );
        };
        error.is_usage()
    }

    /// The error with its place in the text of the scene; `None` if it is not about a vertex.
    pub fn diagnostics(&self, source: &Source, origins: &Origins) -> Option<Diagnostics> {
        let (Error::VertexAtEye { row, .. } | Error::OutOfRange { row, .. }) = self else { return None };
        let finding = Diagnostic::error(*origins.vertices.get(*row)?, self.problem()).label("this vertex");
        Some(Diagnostics::one(source, finding.help(self.remedy())))
    }

    fn problem(&self) -> String {
        match self {
            Error::Motion(error) => error.to_string(),
            Error::NoViewCenter => "-cull needs the view centre of the camera".to_string(),
            Error::Camera(error) => error.to_string(),
            Error::NoBound { error } => format!("the bound of -se is {} milliradians", error * 1e3),
            Error::NoColorBound { error } => format!("the bound of -sc is {} percent", error * 1e2),
            Error::NoLightBound { error } => format!("the bound of -sl is {} percent", error * 1e2),
            Error::NoPieces => "-sd 0 would make no pieces".to_string(),
            Error::TooManyPieces { n_pieces } => {
                format!("-sd would make {n_pieces} pieces, more than the limit of {MAX_PIECES}")
            }
            Error::VertexAtEye { name, .. } => {
                format!("vertex `{name}` lies at the eye, where no direction to it exists")
            }
            Error::OutOfRange { name, .. } => {
                format!("the seen position of vertex `{name}` is too far away for a number")
            }
        }
    }

    fn remedy(&self) -> &'static str {
        match self {
            Error::Motion(_) | Error::Camera(_) => "",
            Error::NoViewCenter => "give it with -vc, or in the `cam` statement of the scene",
            Error::NoBound { .. } => "give a number above 0",
            Error::NoColorBound { .. } | Error::NoLightBound { .. } => "give a number above 0, or off",
            Error::NoPieces => "give 1 or more",
            Error::TooManyPieces { .. } => {
                "give fewer, or use -se, which subdivides only where it is visible"
            }
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
