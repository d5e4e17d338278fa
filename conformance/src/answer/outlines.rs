//! Questions about circles on the sphere of directions.

use glam::DVec3;
use ugphysics::{Event, Lorentz, seen_position};

use super::numbers::{Answer, along_x, angle, at, exactly};

pub const KINDS: &[(&str, Answer)] = &[
    ("sphere_outline", |given| {
        let [speed, radius, distance, psi] = exactly(given)?;
        let v = along_x(speed)?;
        let (sin, center) = (radius / distance, at(psi));
        let circle = Circle { axis: center, sin, cos: ((1.0 - sin) * (1.0 + sin)).sqrt() };
        let (axis, radius_deg) = circle.in_frame(Lorentz::boost(v));
        let seen = seen_position(distance * center, v);
        Some(vec![radius_deg, angle(axis, DVec3::X), angle(seen, DVec3::X)])
    }),
    ("circle_image", |given| {
        let [speed, axis_deg, radius_deg] = exactly(given)?;
        let (sin, cos) = libm::sincos(radius_deg.to_radians());
        let circle = Circle { axis: at(axis_deg), sin, cos };
        let (axis, radius_deg) = circle.in_frame(Lorentz::boost(along_x(speed)?).inverse());
        Some(vec![angle(axis, DVec3::X), radius_deg])
    }),
];

/// The viewing directions d with d·axis = cos.
struct Circle {
    axis: DVec3,
    sin: f64,
    cos: f64,
}

impl Circle {
    /// Axis and angular radius, in degrees, in another frame.
    ///
    /// A viewing direction is the null vector (−1, d), and the circle consists of those orthogonal
    /// to N = (−cos, axis): in signature (−,+,+,+) the product is d·axis − cos. So N transforms
    /// like an event, and its length, sin, is invariant.
    fn in_frame(&self, change: Lorentz) -> (DVec3, f64) {
        let normal = change.apply(Event { t: -self.cos, x: self.axis });
        (normal.x, libm::atan2(self.sin, -normal.t).to_degrees())
    }
}
