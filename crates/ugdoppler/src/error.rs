//! Why a scene has no colours as seen.

use std::fmt;

use ugparse::VertexId;
use ugscene::{CameraError, StageError};

/// Why a scene has no colours as seen.
#[derive(Clone, Debug, PartialEq)]
pub enum Error {
    /// The scene is not at the stage at which it can be coloured.
    Stage(StageError),
    /// The eye is the view centre of the scene's camera.
    Camera(CameraError),
    /// A vertex of a moving body lies exactly at the eye, where it has no direction and so no
    /// Doppler factor.
    VertexAtEye {
        /// The vertex.
        vertex: VertexId,
        /// Its name.
        name: String,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stage(error) => error.fmt(f),
            Self::Camera(error) => error.fmt(f),
            Self::VertexAtEye { name, .. } => {
                write!(f, "vertex `{name}` lies at the eye, where no direction to it exists")
            }
        }
    }
}

impl std::error::Error for Error {}

impl From<StageError> for Error {
    fn from(error: StageError) -> Self {
        Self::Stage(error)
    }
}

impl From<CameraError> for Error {
    fn from(error: CameraError) -> Self {
        Self::Camera(error)
    }
}
