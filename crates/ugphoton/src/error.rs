//! Why there is no picture.

use thiserror::Error;
use ugparse::Diagnostics;
use ugscene::{CameraError, MotionError, StageError};

/// The most lights times samples of a picture. A shadow ray takes about a microsecond, so this many
/// take some hours.
pub(crate) const MOST_LIGHTINGS: u64 = 1 << 34;

/// Why there is no picture.
#[derive(Debug, Error)]
pub enum Error {
    /// The text of the scene has errors.
    #[error(transparent)]
    Text(#[from] Diagnostics),
    /// The scene has no faces.
    #[error("the scene has no faces, so rays meet nothing")]
    Empty,
    /// The motions of the scene are invalid, or it is not at rest.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The options of the picture, its camera or its annotations.
    #[error(transparent)]
    Picture(#[from] ugpicture::Error),
    /// The seen position of a vertex overflows.
    #[error(
        "the seen position of vertex `{name}` is too far away for a number: \
         use smaller coordinates, a smaller time (-ti) or a lower speed"
    )]
    OutOfRange {
        /// Its name.
        name: String,
    },
    /// Options that exclude each other; the text says which, and what to do.
    #[error("{0}")]
    Options(&'static str),
    /// A part of a picture that is not in it.
    #[error(
        "-crop {} {} {} {} is not in the picture of {} x {} pixels: \
         columns and rows count from 0 at the upper left",
        .crop[0], .crop[1], .crop[2], .crop[3], .size[0], .size[1]
    )]
    Crop {
        /// Its left column, upper row, width and height.
        crop: [u32; 4],
        /// Of the picture.
        size: [u32; 2],
    },
    /// More lights than can be computed at so many samples.
    #[error(
        "{n_lights} lights at each of {n_samples} samples are more than 2^{}: \
         give fewer lights, a smaller -sz, or a smaller -aa",
        MOST_LIGHTINGS.ilog2()
    )]
    TooManyLights {
        /// Of the scene.
        n_lights: usize,
        /// Of the picture.
        n_samples: u64,
    },
    /// Rays through the eye need perspective.
    #[error(
        "rays go through the eye, and in orthographic projection they do not meet there: leave out -og \
         (in the scene, too)"
    )]
    Orthographic,
    /// The scene cannot be drawn by rays; the text says why, and what to do.
    #[error("{0}")]
    Scene(&'static str),
    /// The scene is not at the stage at which it can be drawn so.
    #[error(transparent)]
    Stage(#[from] StageError),
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

impl From<CameraError> for Error {
    fn from(error: CameraError) -> Self {
        Self::Picture(error.into())
    }
}
