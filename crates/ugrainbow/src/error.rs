//! Why there is no picture.

use std::fmt;

use ugparse::Diagnostics;
use ugscene::{CameraError, StageError};

/// Why there is no picture.
#[derive(Debug)]
pub enum Error {
    /// The scene has errors.
    Scene(Diagnostics),
    /// The scene has neither faces nor wires.
    Empty,
    /// The options of the picture, its camera or its annotations.
    Picture(ugpicture::Error),
    /// Options that exclude each other; the text says which, and what to do.
    Options(&'static str),
    /// A scene that cannot be drawn by rays; the text says why, and what to do.
    Exact(&'static str),
    /// A scene that cannot be drawn as areas; the text says why, and what to do.
    Figure(&'static str),
    /// The scene is not at the stage at which it can be drawn so.
    Stage(StageError),
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

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(diagnostics) => diagnostics.fmt(f),
            Self::Empty => f.write_str(
                "the scene has no faces and no wires, so there is nothing to draw; \
                 check that the program before in the pipe wrote one",
            ),
            Self::Picture(error) => error.fmt(f),
            Self::Options(text) | Self::Exact(text) | Self::Figure(text) => f.write_str(text),
            Self::Stage(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for Error {}

impl From<Diagnostics> for Error {
    fn from(diagnostics: Diagnostics) -> Self {
        Self::Scene(diagnostics)
    }
}

impl From<ugpicture::Error> for Error {
    fn from(error: ugpicture::Error) -> Self {
        Self::Picture(error)
    }
}

impl From<CameraError> for Error {
    fn from(error: CameraError) -> Self {
        Self::Picture(error.into())
    }
}

impl From<StageError> for Error {
    fn from(error: StageError) -> Self {
        Self::Stage(error)
    }
}
