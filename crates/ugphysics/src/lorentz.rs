//! Changes of frame as 4×4 matrices, and the composition of velocities.

use core::ops::Mul;

use glam::{DMat4, DQuat, DVec3, DVec4, Vec4Swizzles};

use crate::{Event, Velocity, VelocityError};

/// A linear change of frame that keeps the light cone: boosts, rotations, and their products.  Eq. (P7)
///
/// The matrix acts on columns (t, x, y, z) and gives target from source coordinates, so `a * b` applies `b`
/// first. Two boosts that are not parallel multiply to a boost and a rotation; that is why several bodies
/// and a moving camera are composed with matrices and not by adding velocities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lorentz(DMat4);

impl Lorentz {
    /// No change.
    pub const IDENTITY: Lorentz = Lorentz(DMat4::IDENTITY);

    /// From the frame that moves with `v`, axes parallel, to the frame in which `v` is measured: S from S'.
    /// What rests in the source moves with `v` in the target.
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
    #[must_use]
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

    /// This change, and `next` after it.
    #[must_use]
    pub fn then(self, next: Lorentz) -> Lorentz {
        next * self
    }

    /// The change back: the transpose with the signs of the mixed terms turned, exact to the bit.
    #[must_use]
    pub fn inverse(self) -> Lorentz {
        let metric = DMat4::from_diagonal(DVec4::new(-1.0, 1.0, 1.0, 1.0));
        Lorentz(metric * self.0.transpose() * metric)
    }

    /// The event in target coordinates.
    #[must_use]
    pub fn apply(self, event: Event) -> Event {
        let moved = self.0 * column(event.t, event.x);
        Event { t: moved.x, x: moved.yzw() }
    }

    /// The velocity, in the target frame, of what rests in the source frame.
    ///
    /// # Errors
    /// When the product of several boosts passed [`Velocity::MAX_RAPIDITY`] or overflowed.
    pub fn velocity_of_frame(self) -> Result<Velocity, VelocityError> {
        Velocity::from_proper(self.0.x_axis.yzw())
    }

    /// The matrix, on columns (t, x, y, z).
    #[must_use]
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

/// The velocity in S of what moves with `u` in a frame that moves with `v` in S: the relativistic sum.
/// Eq. (P15), with −v in place of v
///
/// `compose(u, -v)` is the velocity of a body moving with `u` in S as found in the frame moving with `v`,
/// which is (P15) as it stands. The order matters: `compose(u, v)` and `compose(v, u)` have the same
/// speed and differ in direction by the Wigner rotation. A sum above [`Velocity::MAX_RAPIDITY`] stops there.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Velocity, compose};
///
/// let half = Velocity::from_beta(DVec3::new(0.5, 0.0, 0.0))?;
/// assert!((compose(half, half).speed() - 0.8).abs() < 1e-15);
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
#[must_use]
pub fn compose(u: Velocity, v: Velocity) -> Velocity {
    let part = v.split(u.proper());
    let (object, frame) = (part.along, v.proper_speed());
    let along = if object < 0.0 {
        // Opposite motions cancel. The same difference as a quotient of squares, with γ² = 1 + u² put in by
        // hand, does not.
        let difference = (frame - object.abs()) * (frame + object.abs());
        let transverse = frame * frame * part.across.length_squared();
        (difference + transverse) / (frame * u.gamma() - v.gamma() * object)
    } else {
        frame * u.gamma() + v.gamma() * object
    };
    let proper = part.across + along * v.direction();
    // Both γ are bounded, so the sum is finite and can only be too fast; then its direction is not zero.
    Velocity::from_proper(proper)
        .or_else(|_| Velocity::from_rapidity(proper, Velocity::MAX_RAPIDITY))
        .unwrap_or_default()
}

/// The Wigner rotation W of two motions: Λ(v)Λ(u) = Λ(w)W with w = [`compose`]`(u, v)`.  Eq. (P25)
///
/// It turns the axes of a body that moves with `u` in a frame that moves with `v` in S, both boosts with
/// parallel axes, into the axes a single boost with w would give it. The rotation back is
/// `wigner_rotation(v, u)`, and also `wigner_rotation(w, -v)`.
///
/// Angles are right to about 10⁻¹⁶ divided by 1 + b·b', (P25): a few units in the last place unless nearly
/// opposite motions are both close to the speed of light.
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
#[must_use]
pub fn wigner_rotation(u: Velocity, v: Velocity) -> DQuat {
    // The sum of the directions is exact where they are nearly opposite, and there their cross product and
    // 1 + cos φ must not come from a difference of rounded products.
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

/// tanh η/2 = |u|/(γ+1), and what it lacks of 1: (1 + e^{−η})/(γ+1).
fn half_speed(v: Velocity) -> (f64, f64) {
    let per = 1.0 / (v.gamma() + 1.0);
    (v.proper_speed() * per, (1.0 + v.exp_minus_rapidity()) * per)
}

fn column(t: f64, x: DVec3) -> DVec4 {
    DVec4::new(t, x.x, x.y, x.z)
}
