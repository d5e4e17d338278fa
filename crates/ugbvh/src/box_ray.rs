//! A ray in the coordinates of boxes, in single precision, with bounds on every error.
//!
//! # Why no hit is lost
//!
//! The parameter τ of a ray is its distance from the plane where it enters the cube |x|, |y|, |z| ≤
//! 1 ([`crate::frame`]), along its main axis, the one in which its direction is greatest. There its
//! position is q, and its direction has the components ±1 along the main axis and s, |s| ≤ 1, along
//! each of the others. Let u = 2⁻²⁴, half a unit in the last place of 1. A hit's τ is in 0…2 and
//! |q| ≤ 3, up to the errors below, for else the ray misses the cube.
//!
//! A hit at τ is computed from a point of the triangle that is within ε = 2⁻³⁰ + 2⁻⁵⁰ (d + 2) of
//! the ray ([`crate::shear::Shear::intersect`]). q has, before it is rounded to single precision,
//! an error of less than 2⁻⁵⁰ (d + 2), and corners have one of u / 2 in single precision. Let x be
//! the plane where the ray enters a box that contains the triangle, and let the ray run towards +x.
//! [`BoxRay`] has the origin q + p and not q, where p is the padding, with errors of 2 u from q and
//! 2 u from the sum. So
//!
//! ```text
//! x − origin ≤ τ s + ε + 2⁻⁵⁰ (d + 2) + u / 2 − p + 4 u.
//! ```
//!
//! It is 2 or less, or else the box is behind the hit. With the rounded reciprocal r of s, the
//! entry is computed as x r − (origin r), fused or not. Errors are multiplied by s here, as in the
//! formula above: u from x r, 3 u + 3 u p from origin r, 2 u from the difference, and 2 u from r,
//! which is wrong by a part of u. Reciprocals are 2⁴⁰ or less, which moves a ray by 2⁻³⁸ or less.
//! With p = 16 u + 2⁻⁴⁸ (d + 2), which is greater than the sum of all errors, the computed entry is
//! not behind the hit. In the same way the computed exit is not before it. Limits of τ are moved by
//! p, too, for their rounding.

use std::array;
use std::ops::Range;

use crate::frame::power_of_two;
use crate::shear::{Shear, permuted};

/// A ray for tests of boxes and blocks. Coordinates are in the order of the projection.
#[derive(Clone, Copy, Debug)]
pub struct BoxRay {
    pub line: Line,
    pub slabs: Slabs,
    depths: Depths,
}

/// A ray for tests of boxes.
#[derive(Clone, Copy, Debug)]
pub struct Slabs {
    /// Planes of a node where the ray enters boxes ([`crate::nodes::Node::planes`]).
    pub entries: [usize; 3],
    /// −(origins for the planes where the ray enters boxes) times `reciprocals`.
    pub entry_offsets: [f32; 3],
    /// −(origins for the planes where the ray leaves boxes) times `reciprocals`.
    pub exit_offsets: [f32; 3],
    /// Reciprocals of the direction.
    pub reciprocals: [f32; 3],
}

/// A ray for tests of blocks.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// Axes of the mesh that are x, y and z of the projection.
    pub axes: [usize; 3],
    /// q
    pub position: [f32; 3],
    /// The ray's direction in x and y for each unit of z.
    pub slopes: [f32; 2],
    /// p
    pub padding: f32,
}

/// τ of rays with the same origin and main axis.
#[derive(Clone, Copy, Debug)]
pub struct Depths {
    /// z of the projection where τ is 0.
    pub z: f64,
    /// 1 if rays run towards greater z, or else −1.
    pub sign: f64,
    /// p, however great it is.
    pub padding: f64,
}

/// Padding beyond which all boxes are hit.
const MAX_PADDING: f64 = 1024.0;

/// Greatest |reciprocal of a slope| for tests of boxes.
const MAX_RECIPROCAL: f64 = power_of_two(40);

impl BoxRay {
    /// `direction`: that of the ray. Returns `None` if the ray misses the cube.
    #[inline(always)]
    pub fn new(shear: &Shear, direction: [f64; 3]) -> Option<Self> {
        Self::with_depths(shear, direction, Depths::new(shear))
    }

    /// A ray with boxes and triangles that are greater by `margin`, in box coordinates.
    pub fn with_margin(shear: &Shear, direction: [f64; 3], margin: f64) -> Option<Self> {
        let depths = Depths::new(shear);
        Self::with_depths(shear, direction, Depths { padding: depths.padding + margin, ..depths })
    }

    #[inline(always)]
    fn with_depths(shear: &Shear, direction: [f64; 3], depths: Depths) -> Option<Self> {
        let Depths { z, sign, .. } = depths;
        let [slope_x, slope_y] = shear.slopes;
        let [mut x, mut y] = [shear.start[0] + z * slope_x, shear.start[1] + z * slope_y];
        let mut padding = depths.padding;
        if padding > MAX_PADDING {
            // From so far away, q may be wrong by more than the cube: all boxes are hit.
            [x, y, padding] = [0.0, 0.0, MAX_PADDING];
        } else if !(x.abs() <= 3.0 + 2.0 * padding && y.abs() <= 3.0 + 2.0 * padding) {
            return None;
        }
        let [across, down, along] = permuted(direction, shear.axes);
        let reciprocal = |speed: f64| {
            // Infinite if the ray is perpendicular to the axis.
            let reciprocal = along.abs() / speed;
            let size = reciprocal.abs();
            (if size < MAX_RECIPROCAL { size } else { MAX_RECIPROCAL }).copysign(reciprocal) as f32
        };
        let reciprocals = [reciprocal(across), reciprocal(down), sign as f32];
        // In single precision from here on.
        let [x, y, sign, padding] = [x as f32, y as f32, sign as f32, padding as f32];
        let is_backward = reciprocals.map(is_backward);
        let ahead = reciprocals.map(|reciprocal| padding.copysign(reciprocal));
        let position = [x, y, -sign];
        let [axis_x, axis_y, axis_z] = shear.axes;
        Some(Self {
            line: Line {
                axes: shear.axes,
                position,
                slopes: shear.slopes.map(|slope| slope as f32),
                padding,
            },
            slabs: Slabs {
                entries: [
                    2 * axis_x + is_backward[0],
                    2 * axis_y + is_backward[1],
                    2 * axis_z + is_backward[2],
                ],
                entry_offsets: array::from_fn(|axis| {
                    -(position[axis] + ahead[axis]) * reciprocals[axis]
                }),
                exit_offsets: array::from_fn(|axis| {
                    -(position[axis] - ahead[axis]) * reciprocals[axis]
                }),
                reciprocals,
            },
            depths,
        })
    }

    /// Least and greatest τ of hits in a range of t, or more. The least is 0 or greater, as entries
    /// are then clamped to it.
    #[inline(always)]
    pub fn limits(&self, shear: &Shear, range: &Range<f64>) -> Range<f32> {
        let Depths { z, sign, padding } = self.depths;
        let start = (shear.z(range.start) - z) * sign - padding;
        // NaN and infinities, which can be due to overflow, do not limit.
        let start = if start > 0.0 && start <= f64::MAX { start as f32 } else { 0.0 };
        let end = if range.end < f64::INFINITY {
            self.depths.end(shear, range.end)
        } else {
            f32::INFINITY
        };
        start..end
    }

    /// τ at z, which may be beyond the cube.
    pub fn depth(&self, z: f64) -> f64 {
        (z - self.depths.z) * self.depths.sign
    }

    /// Greatest τ of hits up to z.
    #[inline(always)]
    pub fn limit(&self, z: f64) -> f32 {
        self.depths.limit(z)
    }
}

/// 1 for negative numbers and −0.
#[inline(always)]
fn is_backward(slope: f32) -> usize {
    (slope.to_bits() >> 31) as usize
}

impl Depths {
    #[inline(always)]
    pub fn new(shear: &Shear) -> Self {
        let padding = power_of_two(-20) + power_of_two(-48) * (shear.distance + 2.0);
        let sign = 1.0_f64.copysign(shear.speed);
        Self { z: -sign - shear.start[2], sign, padding }
    }

    /// Greatest τ of hits up to z, or 0.
    #[inline(always)]
    pub fn limit(&self, z: f64) -> f32 {
        let end = (z - self.z) * self.sign + self.padding;
        if end > 0.0 { end as f32 } else { 0.0 }
    }

    /// Greatest τ of hits up to t, or 0.
    #[inline(always)]
    pub fn end(&self, shear: &Shear, t: f64) -> f32 {
        let z = shear.z(t);
        if z.abs() <= f64::MAX { self.limit(z) } else { f32::INFINITY }
    }
}
