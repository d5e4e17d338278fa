//! Why there is no picture.

use thiserror::Error;
use ugscene::{CameraError, MotionError};
use ugsky::BasisError;
use ugskybox::OpenError;

/// Why there is no picture.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// Files are no panorama.
    #[error(transparent)]
    Open(#[from] OpenError),
    /// The options of the picture, its camera or its annotations.
    #[error(transparent)]
    Picture(#[from] ugpicture::Error),
    /// The basis of colours.
    #[error(transparent)]
    Basis(#[from] BasisError),
    /// The camera of a scene is invalid, or the scene is not at rest.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// A scene without a camera.
    #[error("the scene has no camera")]
    NoCamera,
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
    #[error(
        "a sky has no time, distance, Z or id: the channels of a panorama are D, direction and velocity"
    )]
    Channels,
    /// Width or magnitude of stars out of range.
    #[error("stars are 0.5 to 50 pixels wide, and white has a magnitude from -60 to 60")]
    Stars,
    /// A cube map that is not six times as wide as high.
    #[error("a cube map is six squares side by side")]
    CubeSize,
    /// Annotations of a cube map.
    #[error("annotations are for pictures of a single view")]
    AnnotatedCube,
}

impl From<CameraError> for Error {
    fn from(error: CameraError) -> Self {
        Self::Picture(error.into())
    }
}
