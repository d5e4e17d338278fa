//! The footprint of a sample on the plane of a triangle.

use glam::DVec3;
use ugphysics::{Event, RestFrame};

use crate::rays::PastRay;

/// Where a ray meets the plane of a surface element, as the distance from an event on the element
/// in its rest frame. Neighbouring rays so give the footprint of a sample: the element rests in
/// this frame, so it does not matter when each ray meets it.  Eq. (P46)
///
/// `normal`: of the plane, in the rest frame. `event`: in the frame of the camera.
pub fn on_plane(frame: &RestFrame, normal: DVec3, event: Event, ray: &PastRay) -> DVec3 {
    let before = Event { t: ray.origin.t - event.t, x: ray.origin.x - event.x };
    let (from, step) = (frame.rest_from_camera(before).x, frame.rest_from_camera(ray.step).x);
    from - step * (normal.dot(from) / normal.dot(step))
}
