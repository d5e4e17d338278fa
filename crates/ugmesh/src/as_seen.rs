//! Data of a scene as seen for other programs: normals of its seen shape, and its camera.

use glam::DVec3;
use ugscene::{
    Camera, CameraOptions, Projection, RestFrames, RestPosition, Scene, SeenPosition, ShownEffects,
    View,
};

/// Replaces the normals of moving bodies, which scenes store for the shapes at rest, by those of
/// the shapes as seen.
pub(crate) fn see_normals(scene: &mut Scene) {
    let Some(eye) = scene.stage.seen_geometry().map(|seen| seen.eye) else { return };
    if !ugscene::has_moving_bodies(scene) {
        return;
    }
    ugscene::separate_bodies(scene);
    let (frames, geometry) = (RestFrames::new(scene), ShownEffects::of(scene));
    let bodies = ugscene::vertex_bodies(scene);
    for (vertex, body) in scene.vertices.iter_mut().zip(bodies) {
        let Some(rest) = vertex.normal else { continue };
        if frames.world_line(body).is_some() {
            // Its faces as seen have normals of their own.
            vertex.normal = None;
            continue;
        }
        // Lengths do not matter, and their squares may overflow.
        let rest =
            frames.of(body).scene_from_boosted().inverse() * (rest / rest.abs().max_element());
        let seen = SeenPosition(vertex.position - eye);
        vertex.normal = Some(geometry.seen_normal(RestPosition(rest), seen, frames.velocity(body)));
    }
}

/// Replaces the cameras of a scene by the one that is used, with the values that it has by default.
/// Other programs have other defaults.
pub(crate) fn complete_camera(scene: &mut Scene) {
    /// Shape of the picture for a camera that does not define it.
    const SHAPE: [u32; 2] = [4, 3];
    if scene.cameras.is_empty() {
        return;
    }
    let Ok(view) = View::new(scene, &CameraOptions::default(), SHAPE) else { return };
    let [width, height] = SHAPE.map(f64::from);
    let corner = |x: f64, y: f64| view.point([x, y], 1.0);
    let (across, down) =
        (corner(width, 0.0) - corner(0.0, 0.0), corner(0.0, height) - corner(0.0, 0.0));
    let angle = |side: DVec3| 2.0 * libm::atan(side.length() / 2.0).to_degrees();
    scene.cameras = vec![Camera {
        eye: Some(view.eye),
        center: Some(view.eye + view.distance * view.forward),
        up: Some(-down.normalize()),
        projection: Some(if view.is_perspective {
            Projection::Perspective
        } else {
            Projection::Orthographic
        }),
        view_angle: view.is_perspective.then(|| [angle(across), angle(down)]),
        film_size: (!view.is_perspective).then(|| [across.length(), down.length()]),
        ..Camera::default()
    }];
}
