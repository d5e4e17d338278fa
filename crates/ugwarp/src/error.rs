//! Why there is no picture.

use std::fmt;

use ugimage::ReadError;
use ugscene::CameraError;
use ugsky::{BasisError, PanoramaError};

use crate::arrangement::Arrangement;

/// Why there is no picture.
#[derive(Debug)]
pub enum Error {
    /// A file is no picture that can be read.
    Read {
        /// Which of several files.
        idx: usize,
        /// What is wrong.
        error: ReadError,
    },
    /// The picture cannot be a panorama.
    Panorama(PanoramaError),
    /// The sides of the picture have not the ratio of its arrangement.
    Shape {
        /// Its pixels across and down.
        size: [u32; 2],
        /// What it should be.
        arrangement: Arrangement,
    },
    /// There are not as many files as a cube has sides, or more than one for other arrangements.
    Sides {
        /// Their number.
        n_files: usize,
    },
    /// A side of a cube is no square, or has another size than the first.
    Side {
        /// Which of the six.
        idx: usize,
        /// Its pixels across and down.
        size: [u32; 2],
        /// Columns of the first side.
        expected: u32,
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
            Self::Options(_) | Self::Basis(_) | Self::Sides { .. } => true,
            Self::Panorama(error) => *error == PanoramaError::Extent,
            Self::Read { .. } | Self::Shape { .. } | Self::Side { .. } => false,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Read { error, .. } => error.fmt(f),
            Self::Panorama(error) => error.fmt(f),
            Self::Shape { size: [width, height], arrangement: Arrangement::Equirectangular } => write!(
                f,
                "{width} x {height} pixels are not the shape of a panorama, which is twice as wide as high: give the \
                 angles that it shows with -part WEST EAST SOUTH NORTH, or -part -180 180 -90 90 if it shows all; a \
                 cube map needs -from strip or -from cross"
            ),
            Self::Shape { size: [width, height], arrangement } => write!(
                f,
                "{width} x {height} pixels are not the shape of a {}: a strip is 6 squares across, a cross 4 across and \
                 3 down, or 3 across and 4 down",
                arrangement.name()
            ),
            Self::Sides { n_files } => write!(
                f,
                "{n_files} files were given: -from sides needs six, right, left, up, down, front and back, and others \
                 one"
            ),
            Self::Side { idx, size: [width, height], expected } => write!(
                f,
                "the {} side of the cube has {width} x {height} pixels: all must be squares of the same size, here \
                 {expected} x {expected}",
                ["first", "second", "third", "fourth", "fifth", "sixth"][*idx % 6]
            ),
            Self::Picture(error) => error.fmt(f),
            Self::Basis(error) => error.fmt(f),
            Self::Options(text) => f.write_str(text),
        }
    }
}

impl std::error::Error for Error {}

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
