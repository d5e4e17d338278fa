//! Aberration: how a viewing direction changes between frames.

use glam::DVec3;

use crate::{Velocity, rest_position};

/// The viewing direction in S', the frame that moves with `v` in S, of an object seen along `d` in
/// S: the unit vector along d + (γ−1)(d·û)û + γ**v** (|d| = 1).  Eq. (P6)
///
/// A viewing direction points from the eye to the object, against the light's motion. `d` may have
/// any length; the zero vector gives the zero vector. Computed as the direction of (P4), in the
/// same well-conditioned form.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Velocity, aberrate};
///
/// // From a ship at 0.5 c, a star abeam in the rest frame is seen 60° from straight ahead.
/// let v = Velocity::from_beta(DVec3::new(0.5, 0.0, 0.0))?;
/// assert!((aberrate(DVec3::Y, v).x - 0.5).abs() < 1e-15);
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
pub fn aberrate(d: DVec3, v: Velocity) -> DVec3 {
    if d == DVec3::ZERO {
        return d;
    }
    rest_position(d / d.abs().max_element(), v).normalize()
}
