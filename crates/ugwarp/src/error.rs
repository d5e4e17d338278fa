//! Why there is no picture.

use std::fmt;

use ugimage::ReadError;
use ugscene::CameraError;
use ugsky::{BasisError, PanoramaError};

/// Why there is no picture.
#[derive(Debug)]
pub enum Error {
    /// The file is no picture that can be read.
    Read(ReadError),
    /// The picture cannot be a panorama.
    Panorama(PanoramaError),
    /// The picture is not twice as wide as high, and no angles were given.
    Shape {
        /// Its pixels across and down.
        size: [u32; 2],
    },
    /// The options of the picture, its camera or its annotations.
    Picture(ugpicture::Error),
    /// The temperatures of a basis.
    Basis(BasisError),
    /// Options that exclude each other; the text says which, and what to do.
    Options(&'static str),
}

impl Error {
    /// True if the command line is wrong, whatever the panorama.
    pub fn is_usage(&self) -> bool {
        match self {
            Self::Picture(error) => error.is_usage(),
            Self::Options(_) | Self::Basis(_) => true,
            Self::Panorama(error) => *error == PanoramaError::Extent,
            Self::Read(_) | Self::Shape { .. } => false,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Read(error) => error.fmt(f),
            Self::Panorama(error) => error.fmt(f),
            Self::Shape { size: [width, height] } => write!(
                f,
                "{width} x {height} pixels are not the shape of a panorama, which is twice as wide as high: give the \
                 angles that it shows with -part WEST EAST SOUTH NORTH, or -part -180 180 -90 90 if it shows all"
            ),
            Self::Picture(error) => error.fmt(f),
            Self::Basis(error) => error.fmt(f),
            Self::Options(text) => f.write_str(text),
        }
    }
}

impl std::error::Error for Error {}

impl From<ReadError> for Error {
    fn from(error: ReadError) -> Self {
        Self::Read(error)
    }
}

impl From<PanoramaError> for Error {
    fn from(error: PanoramaError) -> Self {
        Self::Panorama(error)
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

impl From<BasisError> for Error {
    fn from(error: BasisError) -> Self {
        Self::Basis(error)
    }
}
