//! A camera that moves through the scene: what later programs must know of it.
//!
//! The programs compute in the frame of the camera. If the scene was written in another frame, all its
//! velocities have been carried over, and the axes of bodies are turned by that, (P25). An escape such as
//! `(uglorentz camera-velocity 0.6 0 0)` keeps the motion between the two frames, so that rest positions
//! come back in the axes of the scene, where its lights and normals are.

use glam::{DQuat, DVec3};
use ugparse::Scene;
use ugphysics::{Velocity, VelocityError, wigner_rotation};

use crate::geometry::MARK;

const CAMERA_VELOCITY: &str = "camera-velocity";

/// The velocity of the camera in the frame the scene was written in, as the escape says; zero without one.
/// The last escape counts.
///
/// # Errors
/// The escape has no three numbers, or they are not below the speed of light.
pub fn camera_velocity(scene: &Scene) -> Result<Velocity, VelocityError> {
    scene.escapes.iter().rev().find_map(|text| numbers(text)).map_or(Ok(Velocity::ZERO), Velocity::from_beta)
}

/// Notes in an escape that the scene, whose velocities are those in the frame of the camera, was written in a
/// frame in which the camera moves with `velocity`.
pub fn record_camera_velocity(scene: &mut Scene, velocity: Velocity) {
    if camera_velocity(scene) == Ok(velocity) {
        return;
    }
    let [x, y, z] = velocity.beta().to_array();
    scene.escapes.push(format!("{MARK} {CAMERA_VELOCITY} {x} {y} {z}"));
}

/// What is not a number is NaN, which is no velocity.
fn numbers(escape: &str) -> Option<DVec3> {
    let mut words = escape.split_whitespace();
    if words.next() != Some(MARK) || words.next() != Some(CAMERA_VELOCITY) {
        return None;
    }
    let mut number = || words.next().and_then(|word| word.parse().ok()).unwrap_or(f64::NAN);
    Some(DVec3::new(number(), number(), number()))
}

/// Turns the axes of the scene into those in which a body that moves with `seen` in the frame of the camera
/// stands to it by a single boost, as (P3) and (P4) want it: W(w, v_c)⁻¹ = W(v_b, −v_c).  Eq. (P25)
pub fn axes_from_scene(seen: Velocity, camera: Velocity) -> DQuat {
    wigner_rotation(camera, seen)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_escape_carries_the_velocity_to_the_bit() {
        for beta in [[1.0 / 3.0, -1e-300, 0.7], [0.0, 0.999_999_999_999_999_9, 0.0]] {
            let velocity = Velocity::from_beta(DVec3::from(beta)).unwrap();
            let mut scene = Scene { escapes: vec!["uglorentz no-contraction".into()], ..Scene::default() };
            assert_eq!(camera_velocity(&scene), Ok(Velocity::ZERO));
            record_camera_velocity(&mut scene, velocity);
            record_camera_velocity(&mut scene, velocity);
            assert_eq!(scene.escapes.len(), 2);
            assert_eq!(camera_velocity(&scene), Ok(velocity));
            record_camera_velocity(&mut scene, Velocity::ZERO);
            assert_eq!(camera_velocity(&scene), Ok(Velocity::ZERO));
        }
    }

    #[test]
    fn what_is_no_velocity_is_an_error() {
        let check = |text: &str, expected| {
            let scene = Scene { escapes: vec![text.to_string()], ..Scene::default() };
            assert_eq!(camera_velocity(&scene), expected);
        };
        check("uglorentz camera-velocity", Err(VelocityError::NotFinite));
        check("uglorentz camera-velocity 0.1 0.2", Err(VelocityError::NotFinite));
        check("uglorentz camera-velocity 0 1 0", Err(VelocityError::NotBelowLight { speed: 1.0 }));
        check("another camera-velocity 0 1 0", Ok(Velocity::ZERO));
    }
}
