//! Why there is no picture.

use thiserror::Error;
use ugimage::ReadError;
use ugscene::CameraError;
use ugsky::{BasisError, PanoramaError};

use crate::arrangement::Arrangement;

/// Why there is no picture.
#[derive(Debug, Error)]
pub enum Error {
    /// A file is no picture that can be read.
    #[error("{error}")]
    Read {
        /// Which of several files.
        idx: usize,
        /// What is wrong.
        error: ReadError,
    },
    /// The picture cannot be a panorama.
    #[error(transparent)]
    Panorama(#[from] PanoramaError),
    /// The sides of the picture have not the ratio of its arrangement.
    #[error("{}", wrong_shape(*size, *arrangement))]
    Shape {
        /// Its pixels across and down.
        size: [u32; 2],
        /// What it should be.
        arrangement: Arrangement,
    },
    /// There are not as many files as a cube has sides, or more than one for other arrangements.
    #[error(
        "{n_files} files were given: -from sides needs six, right, left, up, down, front and back, and others \
         one"
    )]
    Sides {
        /// Their number.
        n_files: usize,
    },
    /// A side of a cube is no square, or has another size than the first.
    #[error(
        "the {} side of the cube has {} x {} pixels: all must be squares of the same size, here \
         {expected} x {expected}",
        ORDINALS[*idx % 6], .size[0], .size[1]
    )]
    Side {
        /// Which of the six.
        idx: usize,
        /// Its pixels across and down.
        size: [u32; 2],
        /// Columns of the first side.
        expected: u32,
    },
    /// The options of the picture, its camera or its annotations.
    #[error(transparent)]
    Picture(#[from] ugpicture::Error),
    /// The temperatures of a basis.
    #[error(transparent)]
    Basis(#[from] BasisError),
    /// Options that exclude each other; the text says which, and what to do.
    #[error("{0}")]
    Options(&'static str),
}

const ORDINALS: [&str; 6] = ["first", "second", "third", "fourth", "fifth", "sixth"];

fn wrong_shape([width, height]: [u32; 2], arrangement: Arrangement) -> String {
    let (expected, remedy) = match arrangement {
        Arrangement::Equirectangular => (
            "panorama, which is twice as wide as high",
            "give the angles that it shows with -part WEST EAST SOUTH NORTH, or -part -180 180 -90 90 if it shows \
             all; a cube map needs -from strip or -from cross",
        ),
        _ => (
            arrangement.name(),
            "a strip is 6 squares across, a cross 4 across and 3 down, or 3 across and 4 down",
        ),
    };
    format!("{width} x {height} pixels are not the shape of a {expected}: {remedy}")
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

impl From<CameraError> for Error {
    fn from(error: CameraError) -> Self {
        Self::Picture(error.into())
    }
}
