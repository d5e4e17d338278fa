//! Why there is no picture.

use std::fmt;

use ugparse::Diagnostics;
use ugscene::{CameraError, MotionError, StageError};

/// The most lights times samples of a picture. A shadow ray takes about a microsecond, so this many
/// take some hours.
pub(crate) const MOST_LIGHTINGS: u64 = 1 << 34;

/// Why there is no picture.
#[derive(Debug)]
pub enum Error {
    /// The text of the scene has errors.
    Text(Diagnostics),
    /// The scene has no faces.
    Empty,
    /// The motions of the scene are invalid, or it is not at rest.
    Motion(MotionError),
    /// The options of the picture, its camera or its annotations.
    Picture(ugpicture::Error),
    /// The seen position of a vertex overflows.
    OutOfRange {
        /// Its name.
        name: String,
    },
    /// Options that exclude each other; the text says which, and what to do.
    Options(&'static str),
    /// A part of a picture that is not in it.
    Crop {
        /// Its left column, upper row, width and height.
        crop: [u32; 4],
        /// Of the picture.
        size: [u32; 2],
    },
    /// More lights than can be computed at so many samples.
    TooManyLights {
        /// Of the scene.
        n_lights: usize,
        /// Of the picture.
        n_samples: u64,
    },
    /// Rays through the eye need perspective.
    Orthographic,
    /// The scene cannot be drawn by rays; the text says why, and what to do.
    Scene(&'static str),
    /// The scene is not at the stage at which it can be drawn so.
    Stage(StageError),
}

impl Error {
    /// True if the command line is wrong, whatever the scene.
    pub fn is_usage(&self) -> bool {
        match self {
            Self::Picture(error) => error.is_usage(),
            Self::Motion(error) => error.is_usage(),
            Self::Options(_) | Self::Crop { .. } => true,
            Self::TooManyLights { .. } => false,
            Self::Text(_)
            | Self::Empty
            | Self::OutOfRange { .. }
            | Self::Orthographic
            | Self::Scene(_)
            | Self::Stage(_) => false,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Text(diagnostics) => diagnostics.fmt(f),
            Self::Empty => f.write_str("the scene has no faces, so rays meet nothing"),
            Self::Motion(error) => error.fmt(f),
            Self::Picture(error) => error.fmt(f),
            Self::Orthographic => f.write_str(
                "rays go through the eye, and in orthographic projection they do not meet there: leave out -og \
                 (in the scene, too)",
            ),
            Self::OutOfRange { name } => write!(
                f,
                "the seen position of vertex `{name}` is too far away for a number: \
                 use smaller coordinates, a smaller time (-ti) or a lower speed"
            ),
            Self::Crop { crop: [left, top, width, height], size } => write!(
                f,
                "-crop {left} {top} {width} {height} is not in the picture of {} x {} pixels: \
                 columns and rows count from 0 at the upper left",
                size[0], size[1]
            ),
            Self::TooManyLights { n_lights, n_samples } => write!(
                f,
                "{n_lights} lights at each of {n_samples} samples are more than 2^{}: \
                 give fewer lights, a smaller -sz, or a smaller -aa",
                MOST_LIGHTINGS.ilog2()
            ),
            Self::Options(text) | Self::Scene(text) => f.write_str(text),
            Self::Stage(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for Error {}

impl From<Diagnostics> for Error {
    fn from(diagnostics: Diagnostics) -> Self {
        Self::Text(diagnostics)
    }
}

impl From<MotionError> for Error {
    fn from(error: MotionError) -> Self {
        Self::Motion(error)
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
