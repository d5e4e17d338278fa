//! Lorentz transformations as 4×4 matrices, and the composition of velocities.

use core::ops::Mul;

use glam::{DMat3, DMat4, DQuat, DVec3, DVec4, Vec4Swizzles};

use crate::{Event, Velocity, VelocityError};

/// A Lorentz transformation: a linear change of frame that preserves the light cone, such as
/// boosts, rotations, and their products.  Eq. (P7)
///
/// The matrix acts on columns (t, x, y, z) and gives target from source coordinates, so `a * b`
/// applies `b` first. The product of two boosts that are not parallel is a boost and a rotation.
/// That is why several bodies and a moving camera cannot be combined by composing velocities alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lorentz(DMat4);

impl Lorentz {
    /// The identity.
    pub const IDENTITY: Lorentz = Lorentz(DMat4::IDENTITY);

    /// The boost from the frame that moves with `v`, axes parallel, to the frame in which `v` is
    /// measured: S from S'. A body at rest in the source frame moves with `v` in the target frame.
    /// Eq. (P7)
    ///
    /// ```
    /// use glam::DVec3;
    /// use ugphysics::{Event, Lorentz, Velocity};
    ///
    /// let v = Velocity::from_beta(DVec3::new(0.6, 0.0, 0.0))?;
    /// let tick = Event { t: 1.0, x: DVec3::ZERO };
    /// assert_eq!(Lorentz::boost(v).apply(tick), Event { t: 1.25, x: DVec3::new(0.75, 0.0, 0.0) });
    /// # Ok::<(), ugphysics::VelocityError>(())
    /// ```
    pub fn boost(v: Velocity) -> Lorentz {
        let u = v.proper();
        let axis = v.direction();
        let stretch = axis * v.gamma_minus_one();
        Lorentz(DMat4::from_cols(
            column(v.gamma(), u),
            column(u.x, DVec3::X + stretch * axis.x),
            column(u.y, DVec3::Y + stretch * axis.y),
            column(u.z, DVec3::Z + stretch * axis.z),
        ))
    }

    /// The rotation of the axes by `turn`, which must be a unit quaternion.
    pub fn rotation(turn: DQuat) -> Lorentz {
        let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| column(0.0, turn * axis));
        Lorentz(DMat4::from_cols(DVec4::X, x, y, z))
    }

    /// This transformation, followed by `next`.
    pub fn then(self, next: Lorentz) -> Lorentz {
        next * self
    }

    /// The inverse transformation: the transpose with the signs of the time-space terms flipped,
    /// without any rounding.
    pub fn inverse(self) -> Lorentz {
        let metric = DMat4::from_diagonal(DVec4::new(-1.0, 1.0, 1.0, 1.0));
        Lorentz(metric * self.0.transpose() * metric)
    }

    /// The event in target coordinates.
    pub fn apply(self, event: Event) -> Event {
        let moved = self.0 * column(event.t, event.x);
        Event { t: moved.x, x: moved.yzw() }
    }

    /// The velocity, in the target frame, of a body at rest in the source frame.
    ///
    /// # Errors
    /// [`VelocityError`] if the product of several boosts exceeds [`Velocity::MAX_RAPIDITY`] or
    /// overflowed.
    pub fn velocity_of_frame(self) -> Result<Velocity, VelocityError> {
        Velocity::from_proper(self.0.x_axis.yzw())
    }

    /// The turn of a transformation that is a rotation.
    pub fn turn(self) -> DQuat {
        let [_, x, y, z] =
            [self.0.x_axis, self.0.y_axis, self.0.z_axis, self.0.w_axis].map(Vec4Swizzles::yzw);
        DQuat::from_mat3(&DMat3::from_cols(x, y, z)).normalize()
    }

    /// The matrix, on columns (t, x, y, z).
    pub fn matrix(self) -> DMat4 {
        self.0
    }
}

impl Mul for Lorentz {
    type Output = Lorentz;

    /// `self` after `first`.
    fn mul(self, first: Lorentz) -> Lorentz {
        Lorentz(self.0 * first.0)
    }
}

/// The velocity in S of a body that moves with `u` in a frame that moves with `v` in S: the
/// relativistic sum.  Eq. (P15), with −v in place of v
///
/// `compose(u, -v)` is the velocity of a body moving with `u` in S as found in the frame moving
/// with `v`, which is (P15) as it stands. The order matters: `compose(u, v)` and `compose(v, u)`
/// have the same speed and differ in direction by the Wigner rotation. A sum above
/// [`Velocity::MAX_RAPIDITY`] is limited to it.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Velocity, compose};
///
/// let half = Velocity::from_beta(DVec3::new(0.5, 0.0, 0.0))?;
/// assert!((compose(half, half).speed() - 0.8).abs() < 1e-15);
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
pub fn compose(u: Velocity, v: Velocity) -> Velocity {
    let proper = composed(u, v);
    // Both γ are bounded, so the sum is finite. The only possible error is a rapidity above the
    // limit, and then the direction is not zero.
    Velocity::from_proper(proper)
        .or_else(|_| Velocity::from_rapidity(proper, Velocity::MAX_RAPIDITY))
        .unwrap_or_default()
}

/// Like [`compose`], rounded to what the text of a scene states, see [`Velocity::rounded`].
///
/// # Errors
/// [`VelocityError::RapidityTooLarge`].
pub fn compose_rounded(u: Velocity, v: Velocity) -> Result<Velocity, VelocityError> {
    Velocity::from_proper(composed(u, v)).map(Velocity::rounded)
}

/// γ**β** of [`compose`].
fn composed(u: Velocity, v: Velocity) -> DVec3 {
    let part = v.split(u.proper());
    let (object, frame) = (part.along, v.proper_speed());
    let along = if object < 0.0 {
        // For opposite motions the sum cancels. Rewritten as a quotient with a difference of
        // squares, using γ² = 1 + u², it does not.
        let difference = (frame - object.abs()) * (frame + object.abs());
        let transverse = frame * frame * part.across.length_squared();
        (difference + transverse) / (frame * u.gamma() - v.gamma() * object)
    } else {
        frame * u.gamma() + v.gamma() * object
    };
    part.across + along * v.direction()
}

/// The Wigner rotation W of two motions: Λ(v)Λ(u) = Λ(w)W with w = [`compose`]`(u, v)`.  Eq. (P25)
///
/// It rotates the axes of a body that moves with `u` in a frame that moves with `v` in S (both
/// boosts with parallel axes) into the axes that a single boost with w would give it. The inverse
/// rotation is `wigner_rotation(v, u)`, and also `wigner_rotation(w, -v)`.
///
/// The error of the angle is about 10⁻¹⁶/(1 + b·b') (P25): a few units in the last place, unless
/// both motions are close to the speed of light and nearly opposite.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Velocity, wigner_rotation};
///
/// let along = Velocity::from_beta(DVec3::new(0.8, 0.0, 0.0))?;
/// let aside = Velocity::from_beta(DVec3::new(0.0, 0.8, 0.0))?;
/// let turned = wigner_rotation(aside, along) * DVec3::X;
/// let gamma = 5.0 / 3.0;
/// assert!((turned.x - 2.0 * gamma / (1.0 + gamma * gamma)).abs() < 1e-15);
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
pub fn wigner_rotation(u: Velocity, v: Velocity) -> DQuat {
    // For nearly opposite directions the sum is exact. The cross product and 1 + cos φ are computed
    // from it, since differences of rounded products would cancel there.
    let sum = u.direction() + v.direction();
    let cross = sum.cross(v.direction());
    let (b, gap) = half_speed(u);
    let (b_frame, gap_frame) = half_speed(v);
    if cross == DVec3::ZERO || b == 0.0 || b_frame == 0.0 {
        return DQuat::IDENTITY;
    }
    let one_minus_product = gap + b * gap_frame;
    let real = one_minus_product + b * b_frame * (0.5 * sum.length_squared());
    let axis = b * b_frame * cross;
    DQuat::from_xyzw(axis.x, axis.y, axis.z, real).normalize()
}

/// (tanh η/2, 1 − tanh η/2) = (|u|/(γ+1), (1 + e^{−η})/(γ+1)).
fn half_speed(v: Velocity) -> (f64, f64) {
    let per = 1.0 / (v.gamma() + 1.0);
    (v.proper_speed() * per, (1.0 + v.exp_minus_rapidity()) * per)
}

fn column(t: f64, x: DVec3) -> DVec4 {
    DVec4::new(t, x.x, x.y, x.z)
}
