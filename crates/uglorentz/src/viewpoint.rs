//! The view of the camera, and what it cannot see.

use rayon::prelude::*;
use ugscene::{CameraOptions, Scene, View};

use crate::relative_motion::{Point, RelativeMotion};
use crate::{Config, DEFAULT_ERROR, Error, Pieces};

/// The view of the scene's camera, for a picture of `size` pixels.
pub(crate) fn view(scene: &Scene, options: &CameraOptions, size: [u32; 2]) -> Result<View, Error> {
    if scene.camera().is_none_or(|camera| camera.center.is_none()) {
        return Err(Error::NoViewCenter);
    }
    // The eye has been written into the camera.
    View::new(scene, &CameraOptions { eye: None, ..options.clone() }, size).map_err(Error::Camera)
}

/// The bound on errors of shape, radians. `scene`: placed, with its eye in the camera.
pub(crate) fn error(scene: &Scene, config: &Config) -> Result<f64, Error> {
    match config.pieces {
        Pieces::UpTo(error) => Ok(error),
        Pieces::UpToPixels(pixels) => Ok(pixels * pixel(scene, config)?),
        Pieces::PerEdge(_) => Ok(DEFAULT_ERROR),
    }
}

/// The angle of a pixel in the middle of the picture, radians; about that of the default picture in
/// a parallel projection, which has none.
pub(crate) fn pixel(scene: &Scene, config: &Config) -> Result<f64, Error> {
    /// With 0.14 of it the bound is the default.
    const DEFAULT_PIXEL: f64 = DEFAULT_ERROR / 0.14;
    let options = CameraOptions { eye: None, ..config.camera.clone() };
    let view = View::new(scene, &options, config.size).map_err(Error::Camera)?;
    let [_, across, down] = view.rays();
    let side = across.length().min(down.length());
    Ok(if view.is_perspective && side > 0.0 { side } else { DEFAULT_PIXEL })
}

/// The direction to a vertex at the eye, and so its Doppler factor, is undefined.
pub(crate) fn refuse_vertices_at_eye(
    scene: &Scene,
    points: &[Point],
    motions: &[RelativeMotion],
) -> Result<(), Error> {
    let is_at_eye = |point: &Point| point.is_at_eye(&motions[point.body.index()]);
    if !points.par_iter().any(is_at_eye) {
        return Ok(());
    }
    let mut used = scene.drawn().flat_map(|drawn| scene.contours.corners(drawn.contours));
    match used.find(|vertex| is_at_eye(&points[vertex.index()])) {
        None => Ok(()),
        Some(vertex) => Err(Error::VertexAtEye {
            name: vertex_name(scene, vertex.index()),
            row: vertex.index(),
        }),
    }
}

/// For messages.
pub(crate) fn vertex_name(scene: &Scene, row: usize) -> String {
    scene.names.get(scene.vertices[row].name).to_string()
}
