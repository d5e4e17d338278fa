//! Why a scene has no colours as seen.

use std::fmt;

use ugparse::VertexId;
use ugphysics::VelocityError;

/// Why a scene has no colours as seen.
#[derive(Clone, Debug, PartialEq)]
pub enum Error {
    /// A velocity of the scene is not below the speed of light.
    Velocity(VelocityError),
    /// A vertex of a moving body lies exactly at the eye, where it has no direction and so no Doppler
    /// factor.
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
            Self::Velocity(error) => error.fmt(f),
            Self::VertexAtEye { name, .. } => {
                write!(f, "vertex `{name}` lies at the eye, where no direction to it exists")
            }
        }
    }
}

impl std::error::Error for Error {}

impl From<VelocityError> for Error {
    fn from(error: VelocityError) -> Self {
        Self::Velocity(error)
    }
}
