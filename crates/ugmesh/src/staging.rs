//! A camera and lights as statements, for a scene that has none (`--stage`).

use glam::DVec3;
use uglight::{DEFAULT_AMBIENT, DEFAULT_FROM_EYE};
use ugscene::{
    Camera, CameraOptions, Light, LightKind, LightMotion, MotionOptions, Projection, Scene,
};

/// Adds the camera and the lights with which a scene without them is drawn.
pub(crate) fn add(scene: &mut Scene) {
    let options = CameraOptions::default();
    let camera = ugscene::common_camera(scene, &options, [4, 3], &[MotionOptions::default()]);
    if let Some(camera) = camera.ok().flatten() {
        scene.cameras.push(Camera {
            eye: Some(camera.eye),
            center: Some(camera.center),
            up: Some(DVec3::Z),
            projection: Some(Projection::Perspective),
            view_angle: Some([camera.view_angle_deg; 2]),
            ..Camera::default()
        });
    }
    let ends = scene.camera().and_then(|camera| Some((camera.eye?, camera.center?)));
    if let (true, Some((eye, center))) = (scene.lights.is_empty(), ends) {
        scene.lights.push(light(DEFAULT_AMBIENT, LightKind::Ambient));
        scene.lights.push(light(DEFAULT_FROM_EYE, LightKind::Directional(direction(eye - center))));
    }
}

/// The direction with its longest component 1 and six decimals, so that it is short text.
fn direction(v: DVec3) -> DVec3 {
    (v / v.abs().max_element() * 1e6).round() / 1e6
}

fn light(intensity: f64, kind: LightKind) -> Light {
    Light { name: None, intensity, kind, color: None, motion: LightMotion::WithWhatItLights }
}
