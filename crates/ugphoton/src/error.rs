//! Why there is no picture.

use thiserror::Error;
use ugparse::Diagnostics;
use ugphysics::WorldLineError;
use ugscene::{CameraError, MotionError, StageError};
use ugskybox::SkyError;

/// The most lights times samples of a picture. A shadow ray takes about a microsecond, so this many
/// take some hours.
pub(crate) const MOST_LIGHTINGS: u64 = 1 << 34;

/// Why there is no picture.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// The text of the scene has errors.
    #[error(transparent)]
    Text(#[from] Diagnostics),
    /// Round faces on world lines would become too many polygons.
    #[error(transparent)]
    TooManyPolygons(#[from] ugscene::TooManyPolygons),
    /// The motions of the scene are invalid, or it is not at rest.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The options of the picture, its camera or its annotations.
    #[error(transparent)]
    Picture(#[from] ugpicture::Error),
    /// The seen position of a vertex overflows.
    #[error("the seen position of vertex `{name}` is too far away for a number")]
    OutOfRange {
        /// Its name.
        name: String,
    },
    /// Radiances at wavelengths in a picture that is no EXR, or of hues.
    #[error("radiances at wavelengths are channels of EXR files, of colours that are spectra")]
    NoWavelengths,
    /// Radiances at wavelengths before a sky.
    #[error("a sky has no radiances at wavelengths")]
    SkyWavelengths,
    /// Annotations of a part of a picture.
    #[error("annotations are for whole pictures")]
    AnnotatedPart,
    /// Automatic exposure of a part of a picture.
    #[error("automatic exposure would differ between the parts of a picture")]
    ExposedPart,
    /// A cube map for two eyes.
    #[error("a cube map is seen from one place")]
    StereoCube,
    /// A cube map that is not six times as wide as high.
    #[error("a cube map is six squares side by side")]
    CubeSize,
    /// A side of the picture cannot be halved for two eyes.
    #[error("the pictures of both eyes have the same size, each half of the whole picture")]
    StereoSize,
    /// Annotations of a cube map or of pictures for two eyes.
    #[error("annotations are for pictures of a single view")]
    AnnotatedViews,
    /// Outline or grid with a lens that bends straight lines.
    #[error("outline and grid are straight lines of pinhole cameras")]
    BentLines,
    /// A shutter at the film with a lens whose film is not flat.
    #[error("a shutter at the film is for pinhole cameras, whose film is flat")]
    FilmShutter,
    /// A part of a picture that is not in it.
    #[error(
        "the part {} {} {} {} is not in the picture of {} x {} pixels: \
         columns and rows count from 0 at the upper left",
        .crop[0], .crop[1], .crop[2], .crop[3], .size[0], .size[1]
    )]
    Crop {
        /// Its left column, upper row, width and height.
        crop: [u32; 4],
        /// Columns and rows of the picture.
        size: [u32; 2],
    },
    /// More lights than can be computed at so many samples.
    #[error(
        "{n_lights} lights at each of {n_samples} samples are more than 2^{}",
        MOST_LIGHTINGS.ilog2()
    )]
    TooManyLights {
        /// Lights in the scene.
        n_lights: usize,
        /// Samples in the picture.
        n_samples: u64,
    },
    /// Rays through the eye need perspective.
    #[error("rays go through the eye, and in orthographic projection they do not meet there")]
    Orthographic,
    /// Contraction or time of flight is left out.
    #[error(
        "rays follow contraction and time of flight, and one of them is left out of this scene"
    )]
    PartialGeometry,
    /// Hues are shifted, of moving bodies with spectra.
    #[error("hues are shifted, and a black body or spectrum of this scene moves")]
    MovingSpectrum,
    /// A face of a body on a world line is of glass.
    #[error(
        "motion `{name}`: a body that accelerates or turns cannot be of glass, whose index holds at rest"
    )]
    MovingMedium {
        /// The name of the motion.
        name: String,
    },
    /// A vertex of a body on a world line is never seen.
    #[error("vertex `{vertex}`: {error}")]
    WorldLine {
        /// Its name.
        vertex: String,
        /// Why.
        error: WorldLineError,
    },
    /// The sky.
    #[error(transparent)]
    Sky(#[from] SkyError),
    /// The scene is not at the stage at which it can be drawn so.
    #[error(transparent)]
    Stage(#[from] StageError),
}

impl From<CameraError> for Error {
    fn from(error: CameraError) -> Self {
        Self::Picture(error.into())
    }
}
