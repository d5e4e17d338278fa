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
    #[error(
        "{} x {} pixels are not the shape of a {}",
        .size[0], .size[1],
        if *arrangement == Arrangement::Equirectangular {
            "panorama, which is twice as wide as high"
        } else {
            arrangement.name()
        }
    )]
    Shape {
        /// Its pixels across and down.
        size: [u32; 2],
        /// What it should be.
        arrangement: Arrangement,
    },
    /// There are not as many files as a cube has sides, or more than one for other arrangements.
    #[error("{n_files} files were given: a cube of sides needs six, and other panoramas one")]
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
    /// Orthographic projection.
    #[error("light from all directions meets at one point, so there is no orthographic projection")]
    Orthographic,
    /// The name of a camera.
    #[error("a panorama has no cameras with names")]
    NamedCamera,
    /// Outline or grid.
    #[error("outline and grid are for scenes")]
    OutlineOrGrid,
    /// A channel that light from infinitely far away does not have.
    #[error("a sky has no time, distance, Z or id: the channels of a panorama are D, direction and velocity")]
    Channels,
    /// Width or magnitude of stars out of range.
    #[error("stars are 0.5 to 50 pixels wide, and white has a magnitude from -60 to 60")]
    Stars,
    /// Panoramas of infrared or ultraviolet light, or a range of wavelengths, with spectra of black
    /// bodies.
    #[error("the colours of black bodies have infrared and ultraviolet light of their own")]
    BlackBodyRange,
    /// A cube map that is not six times as wide as high.
    #[error("a cube map is six squares side by side")]
    CubeSize,
    /// Annotations of a cube map.
    #[error("annotations are for pictures of a single view")]
    AnnotatedCube,
}

const ORDINALS: [&str; 6] = ["first", "second", "third", "fourth", "fifth", "sixth"];

impl Error {
    /// True if the command line is wrong, whatever the panorama.
    pub fn is_usage(&self) -> bool {
        match self {
            Self::Picture(error) => error.is_usage(),
            Self::Panorama(error) => *error == PanoramaError::Extent,
            Self::Read { .. } | Self::Shape { .. } | Self::Side { .. } => false,
            _ => true,
        }
    }
}

impl From<CameraError> for Error {
    fn from(error: CameraError) -> Self {
        Self::Picture(error.into())
    }
}
