//! Where a moving point is seen: length contraction, light travel time, and both in one boost.
//!
//! All coordinates are relative to the eye. p' are rest coordinates, in the frame S' of the body; p
//! are coordinates in the camera frame S. The picture is taken at t = 0; the origins coincide at
//! t = t' = 0. Nothing here fails: the zero vector is seen at zero, and a NaN or infinite point
//! gives a NaN or infinite one.

use glam::DVec3;

use crate::Velocity;
use crate::error_free::{mul_add, power_of_two_below};

/// An event: a point of spacetime. Time and lengths share one unit (c = 1).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Event {
    /// Time.
    pub t: f64,
    /// Position, relative to the eye.
    pub x: DVec3,
}

impl Event {
    /// The event of the eye when it sees the picture.
    pub const ORIGIN: Self = Self { t: 0.0, x: DVec3::ZERO };
}

impl core::ops::Add for Event {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { t: self.t + other.t, x: self.x + other.x }
    }
}

impl core::ops::Sub for Event {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { t: self.t - other.t, x: self.x - other.x }
    }
}

/// Where the body's point is in S at t = 0, regardless of light travel time: p₀ = p' − (1 −
/// 1/γ)(p'·û)û.  Eq. (P1)
///
/// Lengths along the motion shrink by 1/γ; the eye (the origin) is the fixed point of the
/// contraction.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Velocity, contracted};
///
/// let v = Velocity::from_beta(DVec3::new(0.6, 0.0, 0.0))?;
/// assert_eq!(contracted(DVec3::new(5.0, 1.0, 2.0), v), DVec3::new(4.0, 1.0, 2.0));
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
pub fn contracted(p_rest: DVec3, v: Velocity) -> DVec3 {
    let scale = power_of_two_below(p_rest);
    let part = v.split(p_rest / scale);
    mul_add(part.along / v.gamma(), v.direction(), part.across) * scale
}

/// The inverse of [`contracted`]: the rest coordinates p' = p₀ + (γ − 1)(p₀·û)û of the point that
/// is at p₀ = `p_now` in S at t = 0.  Eq. (P1)
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Velocity, elongated};
///
/// let v = Velocity::from_beta(DVec3::new(0.6, 0.0, 0.0))?;
/// assert_eq!(elongated(DVec3::new(4.0, 1.0, 2.0), v), DVec3::new(5.0, 1.0, 2.0));
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
pub fn elongated(p_now: DVec3, v: Velocity) -> DVec3 {
    p_now + v.direction() * (v.gamma_minus_one() * p_now.dot(v.direction()))
}

/// The (negative) time w at which a point, now at p₀ = `p_now` and moving with `v`, emitted the
/// light that reaches the eye now: |p₀ + w**v**| = −w.  Eq. (P2)
///
/// With b = p₀·**u**, (P2) is w = γ(b − √(b² + p₀²)). For b > 0 it is computed as −γp₀²/(b + √(b² +
/// p₀²)), which does not cancel.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Velocity, flight_time};
///
/// // Approaching at 0.75 c and now at distance 1: it is seen at distance 4, where it was.
/// let v = Velocity::from_beta(DVec3::new(0.75, 0.0, 0.0))?;
/// assert!((flight_time(DVec3::new(-1.0, 0.0, 0.0), v) + 4.0).abs() < 1e-14);
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
pub fn flight_time(p_now: DVec3, v: Velocity) -> f64 {
    let scale = power_of_two_below(p_now);
    let p = p_now / scale;
    let along = p.dot(v.direction()) * v.proper_speed();
    let square = p.length_squared();
    let root = (along * along + square).sqrt();
    let w = if along > 0.0 { -square / (along + root) } else { along - root };
    v.gamma() * w * scale
}

/// The emission event, in S, of the light that reaches the eye at t = 0 from the point at rest at
/// p' = `p_rest` in S': the boost of (−|p'|, p').  Eq. (P3)
///
/// With a = p'·û, q the part of p' across û and r = |p'|, the parts along and across are γa − |u|r
/// and q, and t = |u|a − γr = −|p|. For a > 0 both cancel near the speed of light, so they are
/// rewritten with r − a = q²/(r + a) and e^{−η} = γ − |u| = 1/(γ + |u|):
///
/// * along: a e^{−η} − |u| q²/(r + a)
/// * −t:    a e^{−η} + γ q²/(r + a)
///
/// Both are right to a few units in the last place of |p|, at every speed and in every direction.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Velocity, seen_event};
///
/// // Abeam of the eye in its own rest frame; seen γβ further back, as it was a time γ ago.
/// let v = Velocity::from_beta(DVec3::new(0.6, 0.0, 0.0))?;
/// let seen = seen_event(DVec3::new(0.0, 1.0, 0.0), v);
/// assert_eq!(seen.x, DVec3::new(-0.75, 1.0, 0.0));
/// assert_eq!(seen.t, -1.25);
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
pub fn seen_event(p_rest: DVec3, v: Velocity) -> Event {
    let scale = power_of_two_below(p_rest);
    let p = p_rest / scale;
    let r = p.length();
    let part = v.split(p);
    let a = part.along;
    let (t, along) = if a > 0.0 {
        let ahead = a * v.exp_minus_rapidity();
        let aside = part.across.length_squared() / (r + a);
        (-(ahead + v.gamma() * aside), ahead - v.proper_speed() * aside)
    } else {
        (v.proper_speed() * a - v.gamma() * r, v.gamma() * a - v.proper_speed() * r)
    };
    Event { t: t * scale, x: mul_add(along, v.direction(), part.across) * scale }
}

/// Where the point at rest at `p_rest` in S' is seen in S, relative to the eye: the position of
/// [`seen_event`].  Eq. (P3)
pub fn seen_position(p_rest: DVec3, v: Velocity) -> DVec3 {
    seen_event(p_rest, v).x
}

/// The rest coordinates in S' of the point seen at `p_seen` in S. The inverse of [`seen_position`],
/// which is the same boost with −v.  Eq. (P4)
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Velocity, rest_position, seen_position};
///
/// let v = Velocity::from_beta(DVec3::new(0.6, 0.5, -0.4))?;
/// let p_rest = DVec3::new(3.0, -1.0, 2.0);
/// let back = rest_position(seen_position(p_rest, v), v);
/// assert!((back - p_rest).length() < 1e-14);
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
pub fn rest_position(p_seen: DVec3, v: Velocity) -> DVec3 {
    seen_position(p_seen, -v)
}

/// The offset of rest coordinates when the picture is taken at time t_o = `t_observer` instead of
/// 0: γ**v**t_o.  Eq. (P5)
///
/// At that moment the eye, at rest in S, is at −γ**v**t_o in S'. Rest coordinates relative to it go
/// through (P3) as before.
pub fn observer_shift(v: Velocity, t_observer: f64) -> DVec3 {
    v.proper() * t_observer
}
