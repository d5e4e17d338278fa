//! Why there is no picture.

use thiserror::Error;
use ugimage::label::MissingCharacter;
use ugpipe::Stopped;
use ugscene::CameraError;

use crate::WithoutFaces;
use crate::limits::{MAX_PIXELS, MAX_SAMPLES, MAX_SIDE, MAX_VECTOR_SIDE};

/// Why there is no picture.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// The picture has no pixels, or more than [`MAX_PIXELS`] or [`MAX_SIDE`].
    #[error(
        "a picture of {width} x {height} pixels cannot be made: the limit is {MAX_PIXELS} \
         pixels in all and {MAX_SIDE} along a side",
        width = .0[0],
        height = .0[1]
    )]
    Size([u32; 2]),
    /// The samples along a side of a pixel are not 1…[`MAX_SAMPLES`].
    #[error("{0} x {0} samples a pixel cannot be taken, only 1 to {MAX_SAMPLES} along a side")]
    Samples(u32),
    /// The system has less memory than the picture needs: its size, and bytes.
    #[error(
        "there is not enough memory for a picture of {width} x {height} pixels, {1} bytes",
        width = .0[0],
        height = .0[1]
    )]
    Memory([u32; 2], u64),
    /// The scene has nothing that a picture could show.
    #[error("{0}")]
    Empty(WithoutFaces),
    /// A texture cannot be read.
    #[error(transparent)]
    Texture(#[from] ugtrace::textures::TextureError),
    /// A file to be packed is no PNG file.
    #[error("only PNG files are packed smaller")]
    NotPng,
    /// A file with other channels than colour is no EXR file.
    #[error("only EXR has a place for other channels than colour")]
    NotExr,
    /// Exposure or tone curve of a format that holds linear light.
    #[error("EXR, PFM and HDR pictures hold the light as it is")]
    NotDeveloped,
    /// Annotations of a format that holds linear light.
    #[error("EXR, PFM and HDR pictures hold the light of the scene and nothing else")]
    NotAnnotated,
    /// A quantity in false colours as a vector figure.
    #[error("false colours are drawn as pixels")]
    MapVectors,
    /// A quantity of the surfaces in a picture of which only the pixels are known.
    #[error("quantities of what is seen are for pictures of a single view")]
    NoSurfaces,
    /// A transparent background of a format without transparency.
    #[error("PFM and HDR pictures have no transparency")]
    NotTransparent,
    /// A vector figure of a format of pixels.
    #[error("this format has only pixels")]
    NoVectors,
    /// A reconstruction filter of a vector figure.
    #[error("vector graphics have no samples to filter")]
    NoSamples,
    /// A vector figure of more points along a side than the figure can count.
    #[error("vector graphics are at most {MAX_VECTOR_SIDE} points along a side")]
    VectorSize,
    /// A word of the caption, or the legend, is wider than the picture.
    #[error("the picture is too narrow for a title, caption, legend or scale")]
    TooNarrow,
    /// Caption and legend are almost as high as the picture.
    #[error("title, caption and legend leave no room for the picture")]
    NoRoom,
    /// A pixel to be explained that is not in the picture.
    #[error(
        "pixel {},{} is not in the picture of {} x {} pixels; columns and rows count from 0 at the upper left",
        .pixel[0], .pixel[1], .size[0], .size[1]
    )]
    Pixel {
        /// Its column and row.
        pixel: [u32; 2],
        /// Columns and rows of the picture.
        size: [u32; 2],
    },
    /// Text with a character that the font lacks.
    #[error(transparent)]
    Text(#[from] MissingCharacter),
    /// The options of the camera do not define a picture.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// The caller stopped the computation.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

/// Refuses options that exclude each other.
///
/// # Errors
/// The first error whose condition holds.
pub fn refuse<E>(refused: impl IntoIterator<Item = (bool, E)>) -> Result<(), E> {
    refused.into_iter().find(|(is_refused, _)| *is_refused).map_or(Ok(()), |(_, error)| Err(error))
}
