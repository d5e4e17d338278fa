//! An observer who moves through light that is at rest.

use glam::DVec3;
use ugphysics::Velocity;

/// An observer in motion relative to a sky. The axes of the two frames are parallel.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::Velocity;
/// use ugsky::Observer;
///
/// // At 0.5 c, a star abeam in the frame of the sky is seen 60° from straight ahead.
/// let observer = Observer::new(Velocity::from_beta(DVec3::new(0.5, 0.0, 0.0))?);
/// let seen = DVec3::new(0.5, 0.75_f64.sqrt(), 0.0);
/// let (star, doppler) = observer.direction_in_sky(seen);
/// assert!((star - DVec3::Y).length() < 1e-15);
/// assert!((doppler - 1.0 / 0.75_f64.sqrt()).abs() < 1e-15);
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observer {
    velocity: Velocity,
    /// û, the unit vector along the motion.
    ahead: DVec3,
    /// γβ.
    proper_speed: f64,
    /// e^{−η} and e^{η}, the Doppler factors straight behind and ahead.
    factors: [f64; 2],
}

/// A direction seen by an observer, with its change from one pixel to the next, carried to the
/// frame of the sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyRay {
    /// Unit vector to the point of the sky that is seen.
    pub direction: DVec3,
    /// Change of the direction per column and per row of the picture, radians; perpendicular to
    /// the direction.
    pub slopes: [DVec3; 2],
    /// The Doppler factor.  Eq. (P10)
    pub doppler: f64,
}

impl Observer {
    /// An observer with a velocity in the frame of the sky.
    pub fn new(velocity: Velocity) -> Self {
        let (gamma, proper_speed) = (velocity.gamma(), velocity.proper_speed());
        Self {
            velocity,
            ahead: velocity.direction(),
            proper_speed,
            factors: [1.0 / (gamma + proper_speed), gamma + proper_speed],
        }
    }

    /// The velocity in the frame of the sky.
    pub fn velocity(&self) -> Velocity {
        self.velocity
    }

    /// The direction in the frame of the sky of what is seen along the unit vector `seen`, and its
    /// Doppler factor.  Eq. (P6), (P10)
    #[inline]
    pub fn direction_in_sky(&self, seen: DVec3) -> (DVec3, f64) {
        let (direction, doppler, _) = self.carried(seen);
        (direction, doppler)
    }

    /// The direction that the observer sees of a direction in the frame of the sky, a unit vector,
    /// and the Doppler factor. The inverse of [`Observer::direction_in_sky`].  Eq. (P6), (P10)
    pub fn seen_direction(&self, in_sky: DVec3) -> (DVec3, f64) {
        let (seen, inverse) = Self::new(-self.velocity).direction_in_sky(in_sky);
        (seen, 1.0 / inverse)
    }

    /// Like [`Observer::direction_in_sky`], with slopes. `slopes`: changes of the unit vector
    /// `seen` per column and row, perpendicular to it.
    ///
    /// Aberration is conformal: all lengths on the sphere are multiplied by D, and solid angles by
    /// D².  Eq. (P6)
    #[inline(always)]
    pub fn ray(&self, seen: DVec3, slopes: [DVec3; 2]) -> SkyRay {
        let (direction, doppler, across) = self.carried(seen);
        let turned = doppler * doppler * (self.ahead + self.proper_speed * across);
        let slopes = slopes.map(|slope| {
            let part = slope.dot(self.ahead);
            doppler * (slope - part * self.ahead) + part * turned
        });
        SkyRay { direction, slopes, doppler }
    }

    /// The direction in the sky, D, and the part of `seen` across the motion.
    ///
    /// With c = cos θ of the angle to the motion, tan(θ'/2) = e^{η} tan(θ/2) and 1/D = ½ ((1 + c)
    /// e^{−η} + (1 − c) e^{η}): sums of positive numbers, so nothing cancels near the speed of
    /// light.
    #[inline(always)]
    fn carried(&self, seen: DVec3) -> (DVec3, f64, DVec3) {
        let along = seen.dot(self.ahead);
        let across = seen - along * self.ahead;
        let square = across.length_squared();
        let (plus, minus) = if along >= 0.0 {
            (1.0 + along, square / (1.0 + along))
        } else {
            (square / (1.0 - along), 1.0 - along)
        };
        let (near, far) = (plus * self.factors[0], minus * self.factors[1]);
        let doppler = 2.0 / (near + far);
        let direction = (0.5 * doppler * (near - far)) * self.ahead + doppler * across;
        (direction, doppler, across)
    }
}
