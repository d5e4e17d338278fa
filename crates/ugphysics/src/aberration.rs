//! How a direction of view changes between frames.

use glam::DVec3;

use crate::{Velocity, rest_position};

/// The viewing direction in S', the frame that moves with `v` in S, of what is seen along `d` in S: a unit
/// vector along d + (γ−1)(d·û)û + γ**v** (|d| = 1).  Eq. (P6)
///
/// A viewing direction points from the eye to what is seen, against the light. `d` may have any length but
/// 0, which gives 0. It is the direction of (P4), computed as well conditioned.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Velocity, aberrate};
///
/// // Moving at 0.5 c, what was abeam is seen 60° from straight ahead.
/// let v = Velocity::from_beta(DVec3::new(0.5, 0.0, 0.0))?;
/// assert!((aberrate(DVec3::Y, v).x - 0.5).abs() < 1e-15);
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
#[must_use]
pub fn aberrate(d: DVec3, v: Velocity) -> DVec3 {
    if d == DVec3::ZERO {
        return d;
    }
    rest_position(d / d.abs().max_element(), v).normalize()
}
