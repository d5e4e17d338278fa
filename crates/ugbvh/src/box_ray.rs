//! A ray in the coordinates of boxes, in single precision, with bounds on every error.
//!
//! # Why no hit is lost
//!
//! The parameter τ of a ray is its distance from the plane where it enters the cube |x|, |y|, |z| ≤ 1
//! ([`crate::frame`]), along its main axis, the one in which its direction is greatest. There its
//! position is q, and its direction has the components ±1 along the main axis and s, |s| ≤ 1, along
//! each of the others. Let u = 2⁻²⁴, half a unit in the last place of 1. A hit's τ is in 0…2 and
//! |q| ≤ 3, up to the errors below, for else the ray misses the cube.
//!
//! A hit at τ is computed from a point of the triangle that is within ε = 2⁻³⁰ + 2⁻⁵⁰ (d + 2) of the
//! ray ([`crate::shear::Shear::intersect`]). q has, before it is rounded to single precision, an
//! error of less than 2⁻⁵⁰ (d + 2), and corners have one of u / 2 in single precision. Let x be the
//! plane where the ray enters a box that contains the triangle, and let the ray run towards +x.
//! [`BoxRay`] has the origin q + p and not q, where p is the padding, with an error of 2 u. So
//!
//! ```text
//! x − origin ≤ τ s + ε + 2⁻⁵⁰ (d + 2) + u / 2 − p + 2 u.
//! ```
//!
//! It is 2 or less, or else the box is behind the hit. Rounding adds 2 u or less to the difference,
//! and a part of 2.1 u to the product with the rounded 1 / s, which is 4.2 u of the product with s.
//! Slopes less than 2⁻⁴⁰ are replaced by 2⁻⁴⁰, which moves the ray by 2⁻³⁸ or less. With
//! p = 16 u + 2⁻⁴⁸ (d + 2), which is greater than the sum of all errors, the computed entry is not
//! behind the hit. In the same way the computed exit is not before it. Limits of τ are moved by p,
//! too, for their rounding.

use std::ops::Range;

use crate::frame::{Frame, power_of_two};
use crate::shear::Shear;

/// A ray for tests of boxes and blocks.
#[derive(Clone, Copy, Debug)]
pub struct BoxRay {
    /// Origins for the planes where the ray enters boxes, in the order x, y, z.
    pub entry_origins: [f32; 3],
    /// Origins for the planes where the ray leaves boxes.
    pub exit_origins: [f32; 3],
    /// Reciprocals of the direction.
    pub reciprocals: [f32; 3],
    /// 1 in a coordinate that decreases along the ray.
    pub is_backward: [usize; 3],
    /// Axes of the mesh that are x, y and z of the projection.
    pub axes: [usize; 3],
    /// q in the projection's axes.
    pub position: [f32; 3],
    /// Slopes of the ray in the projection.
    pub slopes: [f32; 2],
    /// p
    pub padding: f32,
    /// z of the projection where τ is 0.
    z: f64,
    sign: f64,
    exact_padding: f64,
}

/// Padding beyond which all boxes are hit.
const MAX_PADDING: f64 = 1024.0;

/// Least |slope| for tests of boxes, 2⁻⁴⁰.
const MIN_SLOPE: f64 = power_of_two(-40);

impl BoxRay {
    /// Returns `None` if the ray misses the cube.
    #[inline(always)]
    pub fn new(frame: &Frame, shear: &Shear, origin: [f64; 3]) -> Option<Self> {
        let origin = frame.to_box(origin);
        let distance = origin[0].abs().max(origin[1].abs()).max(origin[2].abs());
        let exact_padding = power_of_two(-20) + power_of_two(-48) * (distance + 2.0);
        let sign = if shear.speed > 0.0 { 1.0 } else { -1.0 };
        let z = -sign - origin[shear.axes[2]];
        let [slope_x, slope_y] = shear.slopes;
        let mut position = [origin[shear.axes[0]] + z * slope_x, origin[shear.axes[1]] + z * slope_y, -sign];
        // With such an origin, q may be wrong by more than the cube: all boxes are hit.
        let padding = if exact_padding <= MAX_PADDING {
            if position[0].abs().max(position[1].abs()) > 3.0 + 2.0 * exact_padding {
                return None;
            }
            exact_padding
        } else {
            position = [0.0; 3];
            MAX_PADDING
        };
        let direction = [slope_x * sign, slope_y * sign, sign];
        let mut ray = Self {
            entry_origins: [0.0; 3],
            exit_origins: [0.0; 3],
            reciprocals: [0.0; 3],
            is_backward: [0; 3],
            axes: shear.axes,
            position: position.map(|number| number as f32),
            slopes: shear.slopes.map(|slope| slope as f32),
            padding: padding as f32,
            z,
            sign,
            exact_padding,
        };
        for (idx, axis) in shear.axes.into_iter().enumerate() {
            let slope = direction[idx];
            let ahead = padding.copysign(slope);
            ray.entry_origins[axis] = (position[idx] + ahead) as f32;
            ray.exit_origins[axis] = (position[idx] - ahead) as f32;
            ray.reciprocals[axis] = 1.0 / (slope.abs().max(MIN_SLOPE).copysign(slope) as f32);
            ray.is_backward[axis] = usize::from(slope.is_sign_negative());
        }
        Some(ray)
    }

    /// Least and greatest τ of hits in a range of t, or more. The least is 0 or greater, as entries
    /// are then clamped to it.
    #[inline(always)]
    pub fn limits(&self, shear: &Shear, range: &Range<f64>) -> Range<f32> {
        let start = shear.z(range.start);
        let end = shear.z(range.end);
        // NaN and infinities, which can be due to overflow, do not limit.
        let start = if start.is_finite() { (start - self.z) * self.sign - self.exact_padding } else { 0.0 };
        let end = if end.is_finite() { self.limit(end) } else { f32::INFINITY };
        (start.max(0.0) as f32)..end
    }

    /// Greatest τ of hits up to z.
    #[inline(always)]
    pub fn limit(&self, z: f64) -> f32 {
        ((z - self.z) * self.sign + self.exact_padding).max(0.0) as f32
    }
}
