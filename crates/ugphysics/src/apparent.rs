//! How fast things seem to move, and how planes stand.

use glam::DVec3;

use crate::{Velocity, doppler_factor};

/// The velocity at which the place moves where a body is *seen*: **v**/(1 − **v**·n) = γD**v**.  Eq. (P31)
///
/// `to_observer` is n as in [`doppler_factor`]. It may be far above that of light: a body that comes nearly at the eye
/// catches up with its own light (Rees 1966).
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Velocity, apparent_velocity};
///
/// let v = Velocity::from_beta(DVec3::new(0.9, 0.0, 0.0))?;
/// assert!((apparent_velocity(DVec3::X, v).x - 9.0).abs() < 1e-13);
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
#[must_use]
pub fn apparent_velocity(to_observer: DVec3, v: Velocity) -> DVec3 {
    v.proper() * doppler_factor(to_observer, v)
}

/// The unit normal, at one moment of S, of a plane of a body that moves with `v`: along (γ n_along, n_across) of its
/// normal in the body's frame, which may have any length but 0.  Eq. (P34)
///
/// This is the normal of a contracted body, not of its picture, whose faces the time of flight bends.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Velocity, contracted_normal};
///
/// let v = Velocity::from_beta(DVec3::new(0.6, 0.0, 0.0))?;
/// assert!((contracted_normal(DVec3::new(0.6, 1.0, 0.0), v) - DVec3::new(0.6, 0.8, 0.0)).length() < 1e-15);
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
#[must_use]
pub fn contracted_normal(rest_normal: DVec3, v: Velocity) -> DVec3 {
    let n = rest_normal.normalize_or_zero();
    let along = n.dot(v.direction());
    (n + v.gamma_minus_one() * along * v.direction()).normalize_or_zero()
}
