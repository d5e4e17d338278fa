//! Hyperbolic motion: constant proper acceleration.

use glam::DVec3;

use crate::{Event, Velocity, VelocityError};

/// A body with constant proper acceleration. At event 0 it is at rest and its proper time is 0.
/// Eq. (P32)
///
/// ```
/// use glam::DVec3;
/// use ugphysics::HyperbolicMotion;
///
/// let ship = HyperbolicMotion { acceleration: DVec3::X };
/// let later = ship.event(2.0);
/// assert!((later.x.x - 2.762195691083631).abs() < 1e-14);
/// assert!((ship.velocity(2.0)?.gamma() - 3.7621956910836314).abs() < 1e-14);
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HyperbolicMotion {
    /// Proper acceleration **a**, in units of c per unit of time: |**a**| times a proper time is a
    /// rapidity.
    pub acceleration: DVec3,
}

impl HyperbolicMotion {
    /// The body's event at proper time τ = `proper_time`: t = sinh(aτ)/a, x = (cosh(aτ) − 1)/a.
    /// Eq. (P32)
    pub fn event(&self, proper_time: f64) -> Event {
        let a = self.acceleration.length();
        if a == 0.0 {
            return Event { t: proper_time, x: DVec3::ZERO };
        }
        let half = libm::sinh(0.5 * a * proper_time);
        // cosh(aτ) − 1 = 2 sinh²(aτ/2), which does not cancel.
        Event {
            t: libm::sinh(a * proper_time) / a,
            x: self.acceleration * (2.0 * half * half / (a * a)),
        }
    }

    /// The body's velocity at proper time τ = `proper_time`: its rapidity is aτ.  Eq. (P32)
    ///
    /// # Errors
    /// [`VelocityError::RapidityTooLarge`] if |aτ| is above [`Velocity::MAX_RAPIDITY`];
    /// [`VelocityError::NotFinite`] if aτ is NaN or infinite.
    pub fn velocity(&self, proper_time: f64) -> Result<Velocity, VelocityError> {
        Velocity::from_rapidity(self.acceleration, self.acceleration.length() * proper_time)
    }
}
