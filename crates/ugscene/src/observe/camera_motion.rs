//! A camera that moves through the scene.
//!
//! The programs compute in the frame of the camera. If the scene was written in another frame, all
//! its velocities have been carried over, and the axes of bodies are turned by that, (P25). The
//! stage of the scene keeps the motion between the two frames, so that rest positions come back in
//! the axes of the scene, where its lights and normals are.

use glam::DQuat;
use ugphysics::{Velocity, wigner_rotation};

use crate::Scene;

/// The velocity of the camera in the frame the scene was written in; zero where no camera moved.
pub fn camera_velocity(scene: &Scene) -> Velocity {
    scene.stage.seen_geometry().map_or(Velocity::ZERO, |seen| seen.camera_velocity)
}

/// Turns the axes of the scene into those in which a body that moves with `seen` in the frame of
/// the camera stands to it by a single boost, as (P3) and (P4) want it: W(w, v_c)⁻¹ = W(v_b, −v_c).
/// Eq. (P25)
pub fn axes_from_scene(seen: Velocity, camera: Velocity) -> DQuat {
    wigner_rotation(camera, seen)
}
