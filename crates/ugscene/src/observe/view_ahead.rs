//! The view ahead: of a moving camera, what one at rest would see.

use glam::DVec3;
use ugphysics::{Velocity, aberrate};

use crate::camera::view_distance;
use crate::camera_options::{CameraError, half_side, half_width_of, right_of};
use crate::{Camera, Projection};

/// Cosine of the greatest angle between a view and the motion at which the camera looks ahead.
const AHEAD: f64 = 0.5;

/// Turns a view at rest in the scene into that of a camera in motion: the middle of the picture,
/// the middles of its sides and its upper side are aberrated, so that the picture shows the same
/// things at every speed. The view angle A becomes A' with tan(A'/4) = tan(A/4) √((1−β)/(1+β)) if
/// the camera looks along its motion. Eq. (P6)
///
/// A camera that looks more than 60° away from its motion first turns to it. Without perspective
/// nothing changes. `middle`: the view centre of a camera that has none.
///
/// # Errors
/// The camera is invalid, or its film would be seen at more than 180°.
pub(super) fn look_ahead(
    camera: &mut Camera,
    eye: DVec3,
    middle: DVec3,
    velocity: Velocity,
) -> Result<(), CameraError> {
    if velocity.is_zero() || camera.projection == Some(Projection::Orthographic) {
        return Ok(());
    }
    let center = camera.center.unwrap_or(middle);
    let distance = view_distance(eye, center)?;
    let own = (center - eye) / distance;
    let motion = velocity.beta().normalize_or_zero();
    let forward = if own.dot(motion) < AHEAD { motion } else { own };
    let right = right_of(forward, camera.up.unwrap_or(DVec3::Z)).0;
    let half = half_width_of(camera)?;
    let seen = |aside: DVec3| aberrate(forward + half * aside, velocity);
    let seen_forward = seen(DVec3::ZERO);
    let angle =
        |side: DVec3| libm::atan2(seen_forward.cross(side).length(), seen_forward.dot(side));
    let half_angle = angle(seen(right)).max(angle(seen(-right)));
    let view_angle = 2.0 * half_angle.to_degrees();
    if view_angle >= 180.0 {
        return Err(CameraError::ViewAngle(view_angle));
    }
    camera.center = Some(eye + distance * seen_forward);
    camera.up = Some((seen(right.cross(forward)) - seen_forward).normalize());
    let down = match camera.view_angle {
        Some([across, down]) if down != across => {
            let larger = libm::tan(half_angle) / half;
            2.0 * libm::atan(half_side(down)? * larger).to_degrees()
        }
        _ => view_angle,
    };
    camera.view_angle = Some([view_angle, down]);
    (camera.film_size, camera.focal_length) = (None, None);
    Ok(())
}
