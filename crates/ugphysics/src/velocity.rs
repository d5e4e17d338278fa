//! A velocity below the speed of light, stored without loss of precision near it.

use core::fmt;
use core::ops::Neg;

use glam::DVec3;

use crate::error_free::{mul_add, one_minus_square, power_of_two_below};

/// A velocity in the camera frame S, as a fraction of the speed of light, below 1 by construction.
///
/// γ and the proper velocity **u** = γ**β** are computed once, from the unrounded 1 − β², so they
/// are right to a few units in the last place at every speed. The direction is stored exactly as
/// given. A rounded direction would magnify errors by a factor γ in the positions of fast bodies.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::Velocity;
///
/// let v = Velocity::from_beta(DVec3::new(0.6, 0.0, 0.0))?;
/// assert_eq!(v.gamma(), 1.25);
/// assert_eq!(v.proper(), DVec3::new(0.75, 0.0, 0.0));
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Velocity {
    /// Exactly parallel to the velocity: the given vector times a power of two that brings its
    /// length near 1.
    axis: DVec3,
    /// û, the unit vector of `axis`.
    direction: DVec3,
    beta: DVec3,
    gamma: f64,
    /// |u| = γβ = sinh η.
    proper_speed: f64,
}

impl Velocity {
    /// At rest.
    pub const ZERO: Velocity = Velocity {
        axis: DVec3::X,
        direction: DVec3::X,
        beta: DVec3::ZERO,
        gamma: 1.0,
        proper_speed: 0.0,
    };

    /// The largest accepted rapidity, at which 1 − β is about 10⁻⁸⁷. The bound keeps products of
    /// several γ finite.
    pub const MAX_RAPIDITY: f64 = 100.0;

    /// The velocity **β**, in fractions of the speed of light.
    ///
    /// |**β**| < 1 is checked on the exact sum of the squares.
    ///
    /// # Errors
    /// [`VelocityError::NotFinite`], or [`VelocityError::NotBelowLight`] if |**β**| ≥ 1.
    ///
    /// ```
    /// use glam::DVec3;
    /// use ugphysics::Velocity;
    ///
    /// let error = Velocity::from_beta(DVec3::new(0.0, 1.2, 0.0)).unwrap_err();
    /// assert_eq!(
    ///     error.to_string(),
    ///     "speed is 1.2 c: it must be below 1 (velocities are fractions of the speed of light)"
    /// );
    /// ```
    pub fn from_beta(beta: DVec3) -> Result<Velocity, VelocityError> {
        if !beta.is_finite() {
            return Err(VelocityError::NotFinite);
        }
        if beta == DVec3::ZERO {
            // The signs of its zeros are kept.
            return Ok(Velocity { beta, ..Velocity::ZERO });
        }
        let scale = power_of_two_below(beta);
        let axis = beta / scale;
        let length = axis.length();
        let speed = length * scale;
        let below_light = beta.abs().max_element() < 1.0;
        let gamma_inverse_squared = if below_light { one_minus_square(beta) } else { 0.0 };
        if gamma_inverse_squared <= 0.0 {
            return Err(VelocityError::NotBelowLight { speed: speed.max(1.0) });
        }
        let gamma = 1.0 / gamma_inverse_squared.sqrt();
        Ok(Velocity { axis, direction: axis / length, beta, gamma, proper_speed: gamma * speed })
    }

    /// The velocity of rapidity η (β = tanh η) along `direction`, a vector of any length. A
    /// negative rapidity reverses the direction; rapidity 0 needs no direction.
    ///
    /// Rapidity can express speeds too close to 1 for β to represent: 1 − β = 10⁻¹² is η = ½ ln((2
    /// − 10⁻¹²)/10⁻¹²), with full precision.
    ///
    /// # Errors
    /// [`VelocityError::NotFinite`], [`VelocityError::NoDirection`], or
    /// [`VelocityError::RapidityTooLarge`] above [`Velocity::MAX_RAPIDITY`].
    ///
    /// ```
    /// use glam::DVec3;
    /// use ugphysics::{Velocity, doppler_factor};
    ///
    /// let v = Velocity::from_rapidity(DVec3::Y, 20.0)?;
    /// assert_eq!(v.speed(), 1.0); // rounded: 1 − β is 8e-18
    /// let ahead = doppler_factor(DVec3::Y, v);
    /// assert!((ahead / libm::exp(20.0) - 1.0).abs() < 1e-14);
    /// # Ok::<(), ugphysics::VelocityError>(())
    /// ```
    pub fn from_rapidity(direction: DVec3, rapidity: f64) -> Result<Velocity, VelocityError> {
        if !rapidity.is_finite() {
            return Err(VelocityError::NotFinite);
        }
        if rapidity.abs() > Velocity::MAX_RAPIDITY {
            return Err(VelocityError::RapidityTooLarge { rapidity });
        }
        let direction = if rapidity < 0.0 { -direction } else { direction };
        Velocity::along(direction, libm::cosh(rapidity), libm::sinh(rapidity.abs()))
    }

    /// The velocity that the text of a scene states: **β** = `vector`, or, with a Lorentz factor,
    /// the one of that factor along `vector`, rounded as by [`Velocity::rounded`].
    ///
    /// # Errors
    /// Those of [`Velocity::from_beta`]; [`VelocityError::NotFinite`],
    /// [`VelocityError::NoDirection`], [`VelocityError::GammaBelowOne`], or
    /// [`VelocityError::RapidityTooLarge`] above γ = 1.3·10⁴³.
    pub fn from_stated(vector: DVec3, gamma: Option<f64>) -> Result<Velocity, VelocityError> {
        match gamma {
            None => Velocity::from_beta(vector),
            Some(gamma) => Velocity::from_gamma(vector, gamma).map(Velocity::rounded),
        }
    }

    fn from_gamma(direction: DVec3, gamma: f64) -> Result<Velocity, VelocityError> {
        if !gamma.is_finite() {
            return Err(VelocityError::NotFinite);
        }
        if gamma < 1.0 {
            return Err(VelocityError::GammaBelowOne { gamma });
        }
        if gamma > libm::cosh(Velocity::MAX_RAPIDITY) {
            return Err(VelocityError::RapidityTooLarge { rapidity: libm::acosh(gamma) });
        }
        Velocity::along(direction, gamma, (gamma - 1.0).sqrt() * (gamma + 1.0).sqrt())
    }

    /// The velocity rounded to three numbers **β**, or, where they change γ by more than 10⁻¹² of
    /// it, to its direction and γ. Idempotent.
    pub fn rounded(self) -> Velocity {
        let by_beta = |velocity: Velocity| {
            let rounded = Velocity::from_beta(velocity.beta).ok();
            rounded
                .filter(|rounded| (rounded.gamma - velocity.gamma).abs() <= 1e-12 * velocity.gamma)
        };
        let by_gamma = || {
            let velocity = Velocity::from_gamma(self.axis, self.gamma).ok()?;
            Some(by_beta(velocity).unwrap_or(velocity))
        };
        by_beta(self).or_else(by_gamma).unwrap_or(self)
    }

    /// The arguments of [`Velocity::from_stated`] for the rounded velocity.
    ///
    /// ```
    /// use glam::DVec3;
    /// use ugphysics::Velocity;
    ///
    /// let v = Velocity::from_stated(DVec3::Y, Some(3e8))?;
    /// assert_eq!(v.speed(), 1.0); // rounded: 1 − β is 6e-18
    /// assert_eq!((v.gamma(), v.stated()), (3e8, (DVec3::Y, Some(3e8))));
    /// # Ok::<(), ugphysics::VelocityError>(())
    /// ```
    pub fn stated(self) -> (DVec3, Option<f64>) {
        let rounded = self.rounded();
        if Velocity::from_beta(rounded.beta) == Ok(rounded) {
            (rounded.beta, None)
        } else {
            (rounded.axis, Some(rounded.gamma))
        }
    }

    /// The velocity whose proper velocity is `proper` = γ**β**.
    ///
    /// # Errors
    /// [`VelocityError::NotFinite`] or [`VelocityError::RapidityTooLarge`].
    pub(crate) fn from_proper(proper: DVec3) -> Result<Velocity, VelocityError> {
        if !proper.is_finite() {
            return Err(VelocityError::NotFinite);
        }
        let scale = power_of_two_below(proper);
        let proper_speed = (proper / scale).length() * scale;
        // Below it the rapidity is less than 99.8.
        if proper_speed > 1e43 {
            let rapidity = libm::asinh(proper_speed);
            if rapidity > Velocity::MAX_RAPIDITY {
                return Err(VelocityError::RapidityTooLarge { rapidity });
            }
        }
        Velocity::along(proper, (1.0 + proper_speed * proper_speed).sqrt(), proper_speed)
    }

    /// The velocity with the consistent pair (γ, |u|) along `direction`, a vector of any length.
    fn along(direction: DVec3, gamma: f64, proper_speed: f64) -> Result<Velocity, VelocityError> {
        if !direction.is_finite() {
            return Err(VelocityError::NotFinite);
        }
        if proper_speed == 0.0 {
            return Ok(Velocity::ZERO);
        }
        if direction == DVec3::ZERO {
            return Err(VelocityError::NoDirection);
        }
        let axis = direction / power_of_two_below(direction);
        let direction = axis / axis.length();
        // Along a coordinate axis, `split` is exact with a unit vector.
        let axis = if direction.abs().max_element() == 1.0 && direction.abs().element_sum() == 1.0 {
            direction
        } else {
            axis
        };
        Ok(Velocity {
            axis,
            direction,
            beta: direction * (proper_speed / gamma),
            gamma,
            proper_speed,
        })
    }

    /// **β**, the velocity in fractions of the speed of light; exactly the vector passed to
    /// [`Velocity::from_beta`].
    pub fn beta(self) -> DVec3 {
        self.beta
    }

    /// β = |**β**|. Rounds to 1 above rapidity 19; [`Velocity::gamma`] and [`Velocity::rapidity`]
    /// do not saturate.
    pub fn speed(self) -> f64 {
        self.proper_speed / self.gamma
    }

    /// The Lorentz factor γ = 1/√(1−β²) = cosh η, right to a few units in the last place.
    pub fn gamma(self) -> f64 {
        self.gamma
    }

    /// The proper velocity **u** = γ**β**.
    pub fn proper(self) -> DVec3 {
        self.direction * self.proper_speed
    }

    /// |**u**| = γβ = sinh η.
    pub fn proper_speed(self) -> f64 {
        self.proper_speed
    }

    /// The rapidity η = atanh β ≥ 0.
    pub fn rapidity(self) -> f64 {
        libm::asinh(self.proper_speed)
    }

    /// û, the unit vector along the motion; +x at rest.
    pub fn direction(self) -> DVec3 {
        self.direction
    }

    /// Whether the velocity is exactly 0.
    pub fn is_zero(self) -> bool {
        self.proper_speed == 0.0
    }

    /// γ − 1, without cancellation at small speeds.
    pub fn gamma_minus_one(self) -> f64 {
        self.proper_speed * (self.proper_speed / (self.gamma + 1.0))
    }

    /// e^{−η} = γ − |u|, without cancellation: the Doppler factor of a body that moves straight
    /// away.
    pub(crate) fn exp_minus_rapidity(self) -> f64 {
        1.0 / (self.gamma + self.proper_speed)
    }

    /// The components of `p` along and across the motion. The squares of its coordinates must be
    /// normal numbers.
    ///
    /// The component across is accurate relative to its own length, however small that is compared
    /// with |p|: it is projected twice ("twice is enough", Parlett 1980), along the direction as
    /// given. For motion along a coordinate axis the other two coordinates keep their bits.
    pub(crate) fn split(self, p: DVec3) -> Split {
        let per_square = 1.0 / self.axis.length_squared();
        let first = mul_add(-p.dot(self.axis) * per_square, self.axis, p);
        let across = mul_add(-first.dot(self.axis) * per_square, self.axis, first);
        Split { along: p.dot(self.direction), across }
    }
}

/// A vector decomposed along and across a motion.
pub(crate) struct Split {
    /// p·û.
    pub(crate) along: f64,
    /// p − (p·û)û.
    pub(crate) across: DVec3,
}

impl Default for Velocity {
    fn default() -> Velocity {
        Velocity::ZERO
    }
}

impl Neg for Velocity {
    type Output = Velocity;

    /// The opposite velocity, of the same speed.
    fn neg(self) -> Velocity {
        if self.is_zero() {
            return self;
        }
        Velocity { axis: -self.axis, direction: -self.direction, beta: -self.beta, ..self }
    }
}

/// Why a velocity is invalid.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum VelocityError {
    /// A component, a direction or a rapidity is NaN or infinite.
    NotFinite,
    /// The speed is not below the speed of light.
    NotBelowLight {
        /// The given speed, at least 1.
        speed: f64,
    },
    /// The direction is the zero vector, and the speed is not 0.
    NoDirection,
    /// The Lorentz factor is below 1.
    GammaBelowOne {
        /// The given factor.
        gamma: f64,
    },
    /// The rapidity is above [`Velocity::MAX_RAPIDITY`] in absolute value.
    RapidityTooLarge {
        /// The given rapidity.
        rapidity: f64,
    },
}

impl fmt::Display for VelocityError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            VelocityError::NotFinite => {
                write!(f, "velocity is not finite: its components must not be infinite or NaN")
            }
            VelocityError::NotBelowLight { speed } => write!(
                f,
                "speed is {speed} c: it must be below 1 (velocities are fractions of the speed of light)"
            ),
            VelocityError::NoDirection => {
                write!(f, "direction is the zero vector: give a nonzero direction, or speed 0")
            }
            VelocityError::GammaBelowOne { gamma } => {
                write!(f, "the Lorentz factor is {gamma}: it must be at least 1")
            }
            VelocityError::RapidityTooLarge { rapidity } => {
                write!(f, "rapidity is {rapidity}: it must be at most {}", Velocity::MAX_RAPIDITY)
            }
        }
    }
}

impl core::error::Error for VelocityError {}
