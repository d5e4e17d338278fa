//! Lengths and directions of vectors of any magnitude.

use glam::DVec3;

use crate::error_free::power_of_two_below;

/// |v|, also where the squares of the components would overflow or underflow. Infinite if the
/// length itself is above the largest number.
///
/// ```
/// use glam::DVec3;
///
/// let length = ugphysics::length(DVec3::new(3e200, 4e200, 0.0));
/// assert!((length / 5e200 - 1.0).abs() < 1e-15);
/// ```
pub fn length(v: DVec3) -> f64 {
    let scale = power_of_two_below(v);
    (v / scale).length() * scale
}

/// v/|v|, also where the squares of the components would overflow or underflow; zero for the zero
/// vector, and for one that is not finite.
///
/// ```
/// use glam::DVec3;
///
/// let unit = ugphysics::unit_or_zero(DVec3::new(3e200, 4e200, 0.0));
/// assert!(unit.abs_diff_eq(DVec3::new(0.6, 0.8, 0.0), 1e-15));
/// assert_eq!(ugphysics::unit_or_zero(DVec3::new(0.0, 5e-324, 0.0)), DVec3::Y);
/// ```
pub fn unit_or_zero(v: DVec3) -> DVec3 {
    (v / power_of_two_below(v)).normalize_or_zero()
}

/// The angle between two vectors of any magnitude, radians in 0…π; 0 if one is zero or not
/// finite.
pub fn angle(a: DVec3, b: DVec3) -> f64 {
    let (a, b) = (a / power_of_two_below(a), b / power_of_two_below(b));
    let angle = libm::atan2(a.cross(b).length(), a.dot(b));
    if angle.is_nan() { 0.0 } else { angle }
}
