//! Why there is no picture.

use thiserror::Error;
use uglabel::MissingCharacter;
use ugscene::CameraError;

use crate::limits::{MAX_PIXELS, MAX_SAMPLES, MAX_SIDE};

/// Why there is no picture.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum Error {
    /// The picture has no pixels, or more than [`MAX_PIXELS`] or [`MAX_SIDE`].
    #[error(
        "a picture of {width} x {height} pixels cannot be made: the limit is {MAX_PIXELS} \
         pixels in all and {MAX_SIDE} along a side; give a smaller -sz",
        width = .0[0],
        height = .0[1]
    )]
    Size([u32; 2]),
    /// The samples along a side of a pixel are not 1…[`MAX_SAMPLES`].
    #[error("{0} x {0} samples a pixel cannot be taken; give -aa 1 to {MAX_SAMPLES}")]
    Samples(u32),
    /// The system has less memory than the picture needs: its size, and bytes.
    #[error(
        "there is not enough memory for a picture of {width} x {height} pixels, {1} bytes; give a smaller -sz",
        width = .0[0],
        height = .0[1]
    )]
    Memory([u32; 2], u64),
    /// Options that exclude each other; the text says which, and what to do.
    #[error("{0}")]
    Options(&'static str),
    /// A pixel to be explained that is not in the picture.
    #[error(
        "pixel {},{} is not in the picture of {} x {} pixels; \
         count columns and rows from 0 at the upper left, or give -sz",
        .pixel[0], .pixel[1], .size[0], .size[1]
    )]
    Pixel {
        /// Its column and row.
        pixel: [u32; 2],
        /// Of the picture.
        size: [u32; 2],
    },
    /// Text with a character that the font lacks.
    #[error(transparent)]
    Text(#[from] MissingCharacter),
    /// The options of the camera do not define a picture.
    #[error(transparent)]
    Camera(#[from] CameraError),
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
