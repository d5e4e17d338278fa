//! Why there is no picture.

use thiserror::Error;
use ugparse::{Diagnostics, Parsed, Source};
use ugscene::{CameraError, StageError};
use ugskybox::SkyError;

/// Why there is no picture.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// The scene has errors.
    #[error(transparent)]
    Scene(#[from] Diagnostics),
    /// The options of the picture, its camera or its annotations.
    #[error(transparent)]
    Picture(#[from] ugpicture::Error),
    /// A pixel of an exact picture is to be explained.
    #[error("only pixels of scanline mode can be explained")]
    ExplainExact,
    /// Round faces would become too many polygons.
    #[error(transparent)]
    TooManyPolygons(#[from] ugscene::TooManyPolygons),
    /// An exact picture of colours as seen.
    #[error("exact pictures shift colours themselves, and those of this scene are as seen already")]
    ExactSeenColors,
    /// An exact picture of positions without contraction or without time of flight.
    #[error(
        "rays follow contraction and time of flight, and one of them is left out of this scene"
    )]
    ExactPartialGeometry,
    /// An exact picture in orthographic projection.
    #[error("rays go to the eye, and in orthographic projection they do not meet there")]
    ExactOrthographic,
    /// An exact picture that shifts hues, of moving bodies with spectra.
    #[error("hues are shifted, and a black body or spectrum of this scene moves")]
    ExactMovingSpectrum,
    /// A vector figure with translucent faces on a transparent background.
    #[error("vector graphics with translucent faces need a background")]
    FigureBackground,
    /// A vector figure of too many faces.
    #[error(
        "faces, and the parts into which they cut each other, are too many for vector graphics"
    )]
    FigureFaces,
    /// Faces of a figure, or before lines, whose edges cross each other too often.
    #[error("edges of faces cross each other so often that the faces have too many parts")]
    CrossedFaces,
    /// A vector figure with too many translucent faces one behind another.
    #[error("too many translucent faces overlap for vector graphics")]
    FigureOverlaps,
    /// The sky.
    #[error(transparent)]
    Sky(#[from] SkyError),
    /// The scene is not at the stage at which it can be drawn so.
    #[error(transparent)]
    Stage(#[from] StageError),
}

impl Error {
    /// The same, at its place in the text if it is about round faces.
    pub(crate) fn at_rounds(self, source: &Source, parsed: &Parsed) -> Self {
        match self {
            Self::TooManyPolygons(error) => {
                ugparse::too_many_polygons(source, parsed.first_round(), error).into()
            }
            error => error,
        }
    }
}

impl From<CameraError> for Error {
    fn from(error: CameraError) -> Self {
        Self::Picture(error.into())
    }
}
