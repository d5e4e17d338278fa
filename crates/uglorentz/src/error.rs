//! Errors.

use thiserror::Error;
use ugpipe::Stopped;
use ugscene::{CameraError, MotionError, TooManyPolygons};

use crate::adaptive::MAX_PIECES;
use crate::attributes::MOST_PARTS;

/// Why a scene cannot be mapped to the scene as seen.
#[derive(Clone, Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// The stage of the scene, a motion or the camera is invalid.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// [`crate::Config::cull`] needs the view centre, and neither the configuration nor the scene
    /// has one.
    #[error("culling needs the view centre of the camera")]
    NoViewCenter,
    /// The view of the camera is invalid.
    #[error(transparent)]
    Camera(CameraError),
    /// The bound of [`crate::Pieces::UpToPixels`] is not above 0, or not finite.
    #[error("the error bound is {pixels} pixels")]
    NoPixelBound {
        /// The bound given, pixels.
        pixels: f64,
    },
    /// The bound of [`crate::Pieces::UpTo`] is not above 0, or not finite.
    #[error("the error bound is {} milliradians", error * 1e3)]
    NoBound {
        /// The bound given, radians.
        error: f64,
    },
    /// [`crate::Config::color_error`] is not above 0.
    #[error("the bound of colour errors is {} percent", error * 1e2)]
    NoColorBound {
        /// The bound given, a fraction.
        error: f64,
    },
    /// [`crate::Config::light_error`] is not above 0.
    #[error("the bound of light errors is {} percent", error * 1e2)]
    NoLightBound {
        /// The bound given, a fraction.
        error: f64,
    },
    /// [`crate::Pieces::PerEdge`] is 0.
    #[error("0 pieces of an edge are none")]
    NoPieces,
    /// [`crate::Pieces::PerEdge`] makes too many pieces.
    #[error("{n_pieces} pieces are more than the limit of {MAX_PIECES}")]
    TooManyPieces {
        /// The number of pieces it would make.
        n_pieces: usize,
    },
    /// Round faces would become too many polygons.
    #[error(transparent)]
    TooManyPolygons(#[from] TooManyPolygons),
    /// So many colours meet at vertices that the mixtures of new ones would have too many parts.
    #[error(
        "the colours of new vertices would mix more than {MOST_PARTS} colours of faces that meet"
    )]
    TooManyParts,
    /// A vertex of a moving body is exactly at the eye.
    #[error("vertex `{name}` lies at the eye, where no direction to it exists")]
    VertexAtEye {
        /// Its name.
        name: String,
        /// Its row.
        row: usize,
    },
    /// No body has the name of [`crate::MeasuredFrame::Body`].
    #[error("no motion is called `{name}`{}", known(names))]
    NoFrame {
        /// The name.
        name: String,
        /// Names of bodies.
        names: Vec<String>,
    },
    /// The body of [`crate::MeasuredFrame::Body`] accelerates or turns, and nothing states where on
    /// it the eye is.
    #[error("`{name}` accelerates or turns, and there is no camera that it could carry")]
    NoFrameEye {
        /// The name of the body.
        name: String,
    },
    /// The seen position of a vertex overflows.
    #[error("the seen position of vertex `{name}` is too far away for a number")]
    OutOfRange {
        /// Its name.
        name: String,
        /// Its row.
        row: usize,
    },
    /// The caller stopped the computation.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

/// The names that there are, in parentheses.
fn known(names: &[String]) -> String {
    if names.is_empty() { String::new() } else { format!(" (there are {})", names.join(", ")) }
}
