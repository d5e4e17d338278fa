//! Motion with constant proper acceleration.

use glam::DVec3;

use crate::{Event, Velocity, VelocityError};

/// A body that feels one acceleration all the time. It is at rest at the event 0, with its clock at 0.  Eq. (P32)
///
/// ```
/// use glam::DVec3;
/// use ugphysics::Hyperbolic;
///
/// let ship = Hyperbolic { acceleration: DVec3::X };
/// let later = ship.event(2.0);
/// assert!((later.x.x - 2.762195691083631).abs() < 1e-14);
/// assert!((ship.velocity(2.0)?.gamma() - 3.7621956910836314).abs() < 1e-14);
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hyperbolic {
    /// Proper acceleration a, a vector; its length times a time is a rapidity.
    pub acceleration: DVec3,
}

impl Hyperbolic {
    /// Where it is when its own clock shows `proper_time`: t = sinh(aτ)/a, x = (cosh(aτ) − 1)/a.
    #[must_use]
    pub fn event(&self, proper_time: f64) -> Event {
        let a = self.acceleration.length();
        if a == 0.0 {
            return Event { t: proper_time, x: DVec3::ZERO };
        }
        let half = libm::sinh(0.5 * a * proper_time);
        // cosh − 1 = 2 sinh² of the half, which does not cancel.
        Event { t: libm::sinh(a * proper_time) / a, x: self.acceleration * (2.0 * half * half / (a * a)) }
    }

    /// Its velocity then: the rapidity is aτ.
    ///
    /// # Errors
    /// [`VelocityError::RapidityTooLarge`] above [`Velocity::MAX_RAPIDITY`]; [`VelocityError::NotFinite`].
    pub fn velocity(&self, proper_time: f64) -> Result<Velocity, VelocityError> {
        Velocity::from_rapidity(self.acceleration, self.acceleration.length() * proper_time)
    }

    /// The proper time it takes, from rest, to come as far as `distance` ≥ 0: aτ = acosh(1 + a x).
    #[must_use]
    pub fn proper_time_to(&self, distance: f64) -> f64 {
        let a = self.acceleration.length();
        // acosh(1 + s) as 2 asinh √(s/2), good for small s too.
        2.0 * libm::asinh((0.5 * a * distance).sqrt()) / a
    }
}
