//! Light at a place: its frequency and where it runs, from frame to frame, off mirrors and through glass.

use glam::DVec3;

use crate::{Event, Velocity, aberrate, compose, doppler_factor};

/// Light at an event: its frequency, in any unit, and the unit vector along its motion.
///
/// A viewing direction points the other way. In spacetime it is the null vector f(1, n), and a change of frame is the
/// boost of that; [`Wave::in_frame`] computes it as (P6) and (P10) do, which lose no digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// Above 0.
    pub frequency: f64,
    /// n, a unit vector.
    pub direction: DVec3,
}

impl Wave {
    /// The same light as found in the frame that moves with `v`, axes parallel.  Eq. (P6), (P10)
    ///
    /// ```
    /// use glam::DVec3;
    /// use ugphysics::{Velocity, Wave};
    ///
    /// // Who runs ahead of light finds it red.
    /// let light = Wave { frequency: 1.0, direction: DVec3::X };
    /// let v = Velocity::from_beta(DVec3::new(0.6, 0.0, 0.0))?;
    /// assert_eq!(light.in_frame(v), Wave { frequency: 0.5, direction: DVec3::X });
    /// # Ok::<(), ugphysics::VelocityError>(())
    /// ```
    #[must_use]
    pub fn in_frame(self, v: Velocity) -> Wave {
        // What a source at rest here sends, an observer with v in this frame receives with the D of −v: of that
        // source as seen from there.
        let direction = -aberrate(-self.direction, v);
        Wave { frequency: self.frequency * doppler_factor(direction, -v), direction }
    }

    /// The same light, given in the frame that moves with `v`, as found in the frame in which `v` is measured.
    #[must_use]
    pub fn out_of_frame(self, v: Velocity) -> Wave {
        self.in_frame(-v)
    }
}

/// The light that a mirror throws back, from either side. The mirror moves with `v`; `rest_normal` is its normal in its own
/// frame, of any length but 0.  Eq. (P23)
///
/// In the mirror's frame the part of the direction along the normal turns round, and the frequency stays.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Velocity, Wave, reflect};
///
/// // A mirror coming at 0.5 c makes light three times as fast.
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

/// The direction of light behind a surface, in the surface's frame: Snell's law. None if all light is thrown back.
/// Eq. (P23)
///
/// `direction` is a unit vector along the light's motion, `normal` a unit vector on either side; `ratio` is the index of
/// refraction before the surface over that behind it.
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

/// The velocity of light inside glass of an index of refraction above 1 that moves with `v`; `direction`, of any length
/// but 0, is its direction in the glass's frame. None if the index is not above 1.  Eq. (P35)
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Velocity, light_in_glass};
///
/// // Fizeau's experiment: glass drags light along, but not by the whole of its speed.
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

/// A plate of glass with parallel faces, in its own frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slab {
    /// Across its faces; a unit vector.
    pub normal: DVec3,
    /// Above 0.
    pub thickness: f64,
    /// Index of refraction, 1 or more.
    pub index: f64,
}

impl Slab {
    /// Where and when light that runs along `direction` and enters the slab at the event 0 leaves it. The slab moves with
    /// `v`; direction and event are in the frame in which `v` is measured.  Eq. (P35)
    ///
    /// Light leaves in the direction and with the frequency it came with. Light along the faces in the slab's frame never
    /// leaves: its event is not finite.
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
        // Into a denser medium light always enters.
        let inside = refract(there, self.normal, 1.0 / self.index).unwrap_or(there);
        let path = self.thickness / inside.dot(self.normal).abs();
        let leaves = Event { t: path * self.index, x: path * inside };
        crate::Lorentz::boost(v).apply(leaves)
    }
}
