//! Relativistic optics: a light wave in another frame, and its reflection and refraction at moving
//! surfaces.

use glam::DVec3;

use crate::{Event, Velocity, aberrate, compose, doppler_factor};

/// A plane light wave: its frequency, in any unit, and its direction of propagation.
///
/// A viewing direction points the other way. The wave 4-vector is the null vector f(1, n), and a
/// change of frame boosts it. [`Wave::in_frame`] computes the boost by (P6) and (P10), which lose
/// no digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// Frequency f, above 0.
    pub frequency: f64,
    /// n, the unit vector along the light's motion.
    pub direction: DVec3,
}

impl Wave {
    /// The same light in the frame that moves with `v`, axes parallel.  Eq. (P6), (P10)
    ///
    /// ```
    /// use glam::DVec3;
    /// use ugphysics::{Velocity, Wave};
    ///
    /// // An observer who moves away from the source sees its light redshifted.
    /// let light = Wave { frequency: 1.0, direction: DVec3::X };
    /// let v = Velocity::from_beta(DVec3::new(0.6, 0.0, 0.0))?;
    /// assert_eq!(light.in_frame(v), Wave { frequency: 0.5, direction: DVec3::X });
    /// # Ok::<(), ugphysics::VelocityError>(())
    /// ```
    #[must_use]
    pub fn in_frame(self, v: Velocity) -> Wave {
        // For an observer with velocity v the source has velocity −v, so D is that of −v.
        let direction = -aberrate(-self.direction, v);
        Wave { frequency: self.frequency * doppler_factor(direction, -v), direction }
    }

    /// The inverse of [`Wave::in_frame`]: light given in the frame that moves with `v`, transformed
    /// to the frame in which `v` is measured.  Eq. (P6), (P10)
    #[must_use]
    pub fn out_of_frame(self, v: Velocity) -> Wave {
        self.in_frame(-v)
    }
}

/// The light reflected by a mirror, from either side. The mirror moves with `v`; `rest_normal` is
/// its normal in its own frame, of any length but 0.  Eq. (P23)
///
/// In the mirror's frame the component of the direction along the normal is reversed, and the
/// frequency is unchanged.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Velocity, Wave, reflect};
///
/// // A mirror that approaches at 0.5 c triples the frequency.
/// let light = Wave { frequency: 1.0, direction: DVec3::NEG_X };
/// let v = Velocity::from_beta(DVec3::new(0.5, 0.0, 0.0))?;
/// let back = reflect(light, DVec3::X, v);
/// assert!((back.frequency - 3.0).abs() < 1e-14 && back.direction == DVec3::X);
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
#[must_use]
pub fn reflect(light: Wave, rest_normal: DVec3, v: Velocity) -> Wave {
    let there = light.in_frame(v);
    let push = 2.0 * there.direction.dot(rest_normal) / rest_normal.length_squared();
    Wave { direction: there.direction - push * rest_normal, ..there }.out_of_frame(v)
}

/// The direction of refracted light, in the frame of the surface: Snell's law. `None` at total
/// internal reflection.  Eq. (P23)
///
/// `direction` is a unit vector along the light's motion, `normal` a unit vector on either side;
/// `ratio` is n₁/n₂, the refractive index before the surface over the one behind it.
///
/// ```
/// use glam::DVec3;
///
/// let d = ugphysics::refract(DVec3::new(0.6, 0.8, 0.0), DVec3::X, 1.0 / 1.6).ok_or("no light")?;
/// assert!((d.y - 0.5).abs() < 1e-15);
/// # Ok::<(), &str>(())
/// ```
#[must_use]
pub fn refract(direction: DVec3, normal: DVec3, ratio: f64) -> Option<DVec3> {
    let cos_in = direction.dot(normal);
    let sideways = ratio * (direction - cos_in * normal);
    let cos_out_squared = 1.0 - sideways.length_squared();
    (cos_out_squared >= 0.0).then(|| sideways + cos_out_squared.sqrt().copysign(cos_in) * normal)
}

/// The velocity of light inside glass that moves with `v`. `index` is the refractive index, above
/// 1; `direction`, of any length but 0, is the light's direction in the frame of the glass. `None`
/// if `index` is not above 1, or if `direction` is not finite.  Eq. (P35)
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Velocity, light_in_glass};
///
/// // Fizeau's experiment: moving glass drags light along, but only by part of its own speed.
/// let v = Velocity::from_beta(DVec3::new(0.1, 0.0, 0.0))?;
/// let light = light_in_glass(DVec3::X, 1.5, v).ok_or("no glass")?;
/// assert!((light.speed() - 0.71875).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn light_in_glass(direction: DVec3, index: f64, v: Velocity) -> Option<Velocity> {
    let in_glass = direction.normalize_or_zero() / index;
    let slower = (index > 1.0).then(|| Velocity::from_beta(in_glass))?.ok()?;
    Some(compose(slower, v))
}

/// A plate with parallel faces, of glass for example, in its own frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slab {
    /// Unit normal of the faces.
    pub normal: DVec3,
    /// Above 0.
    pub thickness: f64,
    /// Refractive index, 1 or more.
    pub index: f64,
}

impl Slab {
    /// The event at which light that travels along `direction` and enters the slab at event 0
    /// leaves it. The slab moves with `v`; `direction`, a unit vector, and the event are in the
    /// frame in which `v` is measured.  Eq. (P35)
    ///
    /// Light leaves with the direction and frequency with which it entered. Light that travels
    /// parallel to the faces in the slab's frame never leaves: the event is not finite.
    ///
    /// ```
    /// use glam::DVec3;
    /// use ugphysics::{Slab, Velocity};
    ///
    /// let slab = Slab { normal: DVec3::X, thickness: 1.0, index: 1.5 };
    /// let exit = slab.exit(DVec3::X, Velocity::ZERO);
    /// assert_eq!((exit.t, exit.x), (1.5, DVec3::X));
    /// ```
    #[must_use]
    pub fn exit(&self, direction: DVec3, v: Velocity) -> Event {
        let there = Wave { frequency: 1.0, direction }.in_frame(v).direction;
        // The index is at least 1, so there is no total internal reflection on entering.
        let inside = refract(there, self.normal, 1.0 / self.index).unwrap_or(there);
        let path = self.thickness / inside.dot(self.normal).abs();
        let leaves = Event { t: path * self.index, x: path * inside };
        crate::Lorentz::boost(v).apply(leaves)
    }
}
