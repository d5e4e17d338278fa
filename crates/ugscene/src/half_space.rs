//! Half-spaces, whose intersection is a view volume.

use glam::DVec3;

/// A half-space, relative to the eye: points p with p·normal + offset ≥ 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    /// Points inward; any length.
    pub normal: DVec3,
    /// See above.
    pub offset: f64,
}
