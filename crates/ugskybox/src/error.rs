//! Why there is no sky.

use std::path::PathBuf;

use thiserror::Error;
use ugimage::ReadError;
use ugsky::{BasisError, PanoramaError};

/// Why files are no panorama.
#[derive(Debug, Error)]
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
pub enum SkyError {
    /// The file of the sky was not opened before the picture was drawn.
    #[error("the sky `{}` has not been opened", .0.display())]
    Closed(PathBuf),
    /// The basis of colours.
    #[error(transparent)]
    Basis(#[from] BasisError),
}
