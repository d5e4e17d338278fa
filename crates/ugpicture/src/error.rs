//! Why there is no picture.

use std::fmt;

use uglabel::MissingCharacter;
use ugscene::CameraError;

use crate::limits::{MAX_PIXELS, MAX_SAMPLES, MAX_SIDE};

/// Why there is no picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Error {
    /// The picture has no pixels, or more than [`MAX_PIXELS`] or [`MAX_SIDE`].
    Size([u32; 2]),
    /// The samples along a side of a pixel are not 1…[`MAX_SAMPLES`].
    Samples(u32),
    /// The system has less memory than the picture needs: its size, and bytes.
    Memory([u32; 2], u64),
    /// Options that exclude each other; the text says which, and what to do.
    Options(&'static str),
    /// A pixel to be explained that is not in the picture.
    Pixel {
        /// Its column and row.
        pixel: [u32; 2],
        /// Of the picture.
        size: [u32; 2],
    },
    /// Text with a character that the font lacks.
    Text(MissingCharacter),
    /// The options of the camera do not define a picture.
    Camera(CameraError),
}

impl Error {
    /// True if the command line is wrong, whatever the scene.
    pub fn is_usage(&self) -> bool {
        matches!(
            self,
            Self::Size(_)
                | Self::Samples(_)
                | Self::Options(_)
                | Self::Pixel { .. }
                | Self::Text(_)
                | Self::Camera(CameraError::NoUp)
        )
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Size([width, height]) => write!(
                f,
                "a picture of {width} x {height} pixels cannot be made: the limit is {MAX_PIXELS} pixels in \
                 all and {MAX_SIDE} along a side; give a smaller -sz"
            ),
            Self::Samples(samples) => {
                write!(
                    f,
                    "{samples} x {samples} samples a pixel cannot be taken; give -aa 1 to {MAX_SAMPLES}"
                )
            }
            Self::Memory([width, height], bytes) => write!(
                f,
                "there is not enough memory for a picture of {width} x {height} pixels, {bytes} bytes; give a \
                 smaller -sz"
            ),
            Self::Options(text) => f.write_str(text),
            Self::Pixel { pixel: [x, y], size: [width, height] } => write!(
                f,
                "pixel {x},{y} is not in the picture of {width} x {height} pixels; \
                 count columns and rows from 0 at the upper left, or give -sz"
            ),
            Self::Text(missing) => missing.fmt(f),
            Self::Camera(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for Error {}

impl From<MissingCharacter> for Error {
    fn from(missing: MissingCharacter) -> Self {
        Self::Text(missing)
    }
}

impl From<CameraError> for Error {
    fn from(error: CameraError) -> Self {
        Self::Camera(error)
    }
}
