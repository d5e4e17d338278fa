//! The camera of the output, and its view.

use glam::DVec3;
use rayon::prelude::*;
use ugparse::{Camera, Projection, Scene};
use ugscene::{CameraOptions, DefaultCamera, View};

use crate::apply::vertex_name;
use crate::relative_motion::{Point, RelativeMotion};
use crate::{Config, Error};

/// The camera, if the scene has none. The scene is at rest; bodies that are kept in view (`-in`)
/// are seen about where they are then.
pub(crate) fn default_camera(
    scene: &Scene,
    config: &Config,
    motions: &[RelativeMotion],
) -> Result<Option<DefaultCamera>, Error> {
    let options = CameraOptions { eye: config.eye, ..config.camera.clone() };
    let velocities = motions.iter().map(|motion| motion.velocity().beta());
    DefaultCamera::new(scene, &options, config.size, velocities).map_err(Error::Camera)
}

/// Writes the eye and the options into the scene's camera, so that programs downstream use them.
/// `center`: the view centre of the default camera.
pub(crate) fn set_camera(scene: &mut Scene, eye: DVec3, center: Option<DVec3>, options: &CameraOptions) {
    if scene.cameras.is_empty() {
        scene.cameras.push(Camera::default());
    }
    let row = scene.camera_row().unwrap_or(0);
    let camera = &mut scene.cameras[row];
    camera.eye = Some(eye);
    camera.center = options.center.or(camera.center).or(center);
    camera.up = options.up.or(camera.up);
    if options.is_orthographic {
        camera.projection = Some(Projection::Orthographic);
    }
    if let Some((across, down)) = options.view_angle {
        camera.view_angle = Some([across, down.unwrap_or(across)]);
        // They would contradict the view angle.
        (camera.film_size, camera.focal_length) = (None, None);
    }
}

/// The view of the scene's camera, for a picture of `size` pixels.
pub(crate) fn view(scene: &Scene, options: &CameraOptions, size: [u32; 2]) -> Result<View, Error> {
    if scene.camera().is_none_or(|camera| camera.center.is_none()) {
        return Err(Error::NoViewCenter);
    }
    // The eye has been written into the camera.
    View::new(scene, &CameraOptions { eye: None, ..options.clone() }, size).map_err(Error::Camera)
}

/// The direction to a vertex at the eye, and so its Doppler factor, is undefined.
pub(crate) fn refuse_vertices_at_eye(
    scene: &Scene,
    points: &[Point],
    motions: &[RelativeMotion],
) -> Result<(), Error> {
    let is_at_eye = |point: &Point| point.rest == DVec3::ZERO && !motions[point.body.index()].is_at_rest();
    if !points.par_iter().any(is_at_eye) {
        return Ok(());
    }
    let faces = scene.faces.iter().map(|face| face.contours.clone());
    let users = faces.chain(scene.wires.iter().map(|wire| wire.contours.clone()));
    let mut used = users.flat_map(|rows| scene.contours.corners(rows));
    match used.find(|vertex| is_at_eye(&points[vertex.index()])) {
        None => Ok(()),
        Some(vertex) => {
            Err(Error::VertexAtEye { name: vertex_name(scene, vertex.index()), row: vertex.index() })
        }
    }
}
