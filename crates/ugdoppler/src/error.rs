//! Why a scene has no colours as seen.

use std::fmt;

use ugparse::VertexId;
use ugscene::{CameraError, StageError};

/// Why a scene has no colours as seen.
#[derive(Clone, Debug, PartialEq)]
pub enum Error {
    /// The scene is not at the stage at which it can be coloured.
    Stage(StageError),
    /// More than 2^27 lights times lit vertices.
    TooManyLights {
        /// Lights of the scene.
        n_lights: usize,
        /// Vertices that they light.
        n_vertices: usize,
    },
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
            Self::TooManyLights { n_lights, n_vertices } => write!(
                f,
                "-li computes {n_lights} lights at {n_vertices} vertices, more than {} together: use fewer \
                 lights, or faces with fewer vertices",
                crate::MAX_LIT
            ),
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
