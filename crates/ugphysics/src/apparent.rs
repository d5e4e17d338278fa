//! Apparent velocity, and the normals of contracted bodies.

use glam::DVec3;

use crate::{Velocity, doppler_factor, elongated};

/// The velocity of a body's *seen* position (its apparent velocity): **v**/(1 − **v**·n) = γD**v**.
/// Eq. (P31)
///
/// `to_observer` is n as in [`doppler_factor`]. The result may exceed the speed of light
/// (superluminal motion): a body that moves almost straight towards the eye nearly keeps up with
/// its own light (Rees 1966).
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

/// The unit normal, in S at one instant, of a plane of a body that moves with `v`: along (γ
/// n_along, n_across), where n is the normal in the body's frame. `rest_normal` may have any
/// length; the zero vector gives the zero vector.  Eq. (P34)
///
/// This is the normal of the contracted body. The body as seen has other normals, since light
/// travel time bends its faces.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Velocity, contracted_normal};
///
/// let v = Velocity::from_beta(DVec3::new(0.6, 0.0, 0.0))?;
/// let normal = contracted_normal(DVec3::new(0.6, 1.0, 0.0), v);
/// assert!((normal - DVec3::new(0.6, 0.8, 0.0)).length() < 1e-15);
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
#[must_use]
pub fn contracted_normal(rest_normal: DVec3, v: Velocity) -> DVec3 {
    let n = rest_normal.normalize_or_zero();
    elongated(n, v).normalize_or_zero()
}
