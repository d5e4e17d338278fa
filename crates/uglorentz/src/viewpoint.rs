//! The camera that is written into the scene, and what it sees.

use glam::DVec3;
use rayon::prelude::*;
use ugparse::{Camera, Projection, Scene};
use ugscene::{CameraOptions, View};

use crate::motion::{Motion, Point};
use crate::{Error, name};

/// Writes the eye and the options into the camera that counts, so that they need not be repeated.
pub(crate) fn set_camera(scene: &mut Scene, eye: DVec3, options: &CameraOptions) {
    if scene.cameras.is_empty() {
        scene.cameras.push(Camera::default());
    }
    let row = scene.camera_row().unwrap_or(0);
    let camera = &mut scene.cameras[row];
    camera.eye = Some(eye);
    camera.center = options.center.or(camera.center);
    camera.up = options.up.or(camera.up);
    if options.is_orthographic {
        camera.projection = Some(Projection::Orthographic);
    }
    if let Some((across, down)) = options.view_angle {
        camera.view_angle = Some([across, down.unwrap_or(across)]);
        // A third number would contradict them.
        (camera.film_size, camera.focal_length) = (None, None);
    }
}

/// What the camera of the scene sees, in a picture of `size` pixels.
pub(crate) fn view(scene: &Scene, options: &CameraOptions, size: [u32; 2]) -> Result<View, Error> {
    if scene.camera().is_none_or(|camera| camera.center.is_none()) {
        return Err(Error::NoViewCenter);
    }
    // The eye has been written into the camera.
    View::new(scene, &CameraOptions { eye: None, ..options.clone() }, size).map_err(Error::Camera)
}

/// A moving point at the eye has no direction, and no Doppler factor.
pub(crate) fn refuse_vertices_at_eye(
    scene: &Scene,
    points: &[Point],
    motions: &[Motion],
) -> Result<(), Error> {
    let is_at_eye = |point: &Point| point.rest == DVec3::ZERO && !motions[point.body as usize].is_at_rest();
    if !points.par_iter().any(is_at_eye) {
        return Ok(());
    }
    let faces = scene.faces.iter().map(|face| face.contours.clone());
    let users = faces.chain(scene.wires.iter().map(|wire| wire.contours.clone()));
    let mut used = users.flat_map(|rows| scene.contours.corners(rows));
    match used.find(|vertex| is_at_eye(&points[vertex.index()])) {
        None => Ok(()),
        Some(vertex) => Err(Error::VertexAtEye { name: name(scene, vertex.index()), row: vertex.index() }),
    }
}
