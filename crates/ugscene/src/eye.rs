//! Where the eye is.

use glam::DVec3;
use ugparse::Scene;

/// The eye point in scene coordinates: the option if given, else the one of the
/// scene's camera, else the origin. All programs of a pipe choose it alike.
pub fn eye(scene: &Scene, option: Option<DVec3>) -> DVec3 {
    option.or(scene.camera().and_then(|camera| camera.eye)).unwrap_or(DVec3::ZERO)
}
