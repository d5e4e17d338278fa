//! Why a scene has no colours as seen.

use thiserror::Error;
use ugpipe::Stopped;
use ugscene::{CameraError, StageError, TooManyPolygons, VertexId};
use ugskybox::SkyError;

/// Why a scene has no colours as seen.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// The scene is not at the stage at which it can be coloured.
    #[error(transparent)]
    Stage(#[from] StageError),
    /// More than 2^27 lights times lit vertices.
    #[error(
        "{n_lights} lights at {n_vertices} vertices, more than {} together: use fewer lights, or faces with \
         fewer vertices",
        crate::MAX_LIT
    )]
    TooManyLights {
        /// Lights of the scene.
        n_lights: usize,
        /// Vertices that they light.
        n_vertices: usize,
    },
    /// The eye is the view centre of the scene's camera.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// Round faces would become too many polygons.
    #[error(transparent)]
    TooManyPolygons(#[from] TooManyPolygons),
    /// A vertex of a moving body lies exactly at the eye, where it has no direction and so no
    /// Doppler factor.
    #[error("vertex `{name}` lies at the eye, where no direction to it exists")]
    VertexAtEye {
        /// The vertex.
        vertex: VertexId,
        /// Its name.
        name: String,
    },
    /// The sky cannot light the scene.
    #[error(transparent)]
    Sky(#[from] SkyError),
    /// The caller stopped the computation.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}
