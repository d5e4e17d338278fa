//! Why there is no sky.

use std::path::PathBuf;

use thiserror::Error;
use ugimage::ReadError;
use ugsky::{BasisError, PanoramaError};

/// Why files are no panorama.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum OpenError {
    /// A file is no picture that can be read.
    #[error("{error}")]
    Read {
        /// Which of several files.
        idx: usize,
        /// The error.
        error: ReadError,
    },
    /// The pictures cannot be a panorama.
    #[error(transparent)]
    Panorama(#[from] PanoramaError),
}

/// Why a scene has no sky.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SkyError {
    /// The file of the sky was not opened before the picture was drawn.
    #[error("the sky `{}` has not been opened", .0.display())]
    Closed(PathBuf),
    /// A sky behind vector graphics.
    #[error("a sky is drawn as pixels")]
    Vectors,
    /// A sky in orthographic projection.
    #[error(
        "in orthographic projection all lines of sight have one direction, so a sky has one colour"
    )]
    Orthographic,
    /// A sky behind a transparent picture that shows it nowhere else.
    #[error("a transparent background leaves no place for a sky")]
    Transparent,
    /// A sky behind positions without contraction or without time of flight.
    #[error(
        "a sky is seen with aberration, and time of flight or contraction is left out of this scene"
    )]
    PartialGeometry,
    /// A pixel of a picture with a sky is to be explained.
    #[error("pixels are explained without a sky")]
    Explained,
    /// The basis of colours.
    #[error(transparent)]
    Basis(#[from] BasisError),
}
