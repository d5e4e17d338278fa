//! Why there is no picture.

use thiserror::Error;
use ugparse::Diagnostics;
use ugscene::{CameraError, StageError};

/// Why there is no picture.
#[derive(Debug, Error)]
pub enum Error {
    /// The scene has errors.
    #[error(transparent)]
    Scene(#[from] Diagnostics),
    /// The scene has neither faces nor wires.
    #[error(
        "the scene has no faces and no wires, so there is nothing to draw; \
         check that the program before in the pipe wrote one"
    )]
    Empty,
    /// The options of the picture, its camera or its annotations.
    #[error(transparent)]
    Picture(#[from] ugpicture::Error),
    /// Options that exclude each other; the text says which, and what to do.
    #[error("{0}")]
    Options(&'static str),
    /// A scene that cannot be drawn by rays; the text says why, and what to do.
    #[error("{0}")]
    Exact(&'static str),
    /// A scene that cannot be drawn as areas; the text says why, and what to do.
    #[error("{0}")]
    Figure(&'static str),
    /// The scene is not at the stage at which it can be drawn so.
    #[error(transparent)]
    Stage(#[from] StageError),
}

impl Error {
    /// True if the command line is wrong, whatever the scene.
    pub fn is_usage(&self) -> bool {
        match self {
            Self::Picture(error) => error.is_usage(),
            Self::Options(_) => true,
            Self::Scene(_) | Self::Empty | Self::Stage(_) | Self::Exact(_) | Self::Figure(_) => false,
        }
    }
}

impl From<CameraError> for Error {
    fn from(error: CameraError) -> Self {
        Self::Picture(error.into())
    }
}
