//! How light changes colour and strength between a moving body and the eye.

use glam::DVec3;

use crate::Velocity;
use crate::exact::power_of_two_below;

/// The Doppler factor D = f_observed/f_emitted = λ_emitted/λ_observed = 1/(γ(1 − **v**·n)), dimensionless.
/// Eq. (P10)
///
/// D > 1 is a blueshift. `to_observer` is n, along the light's motion, from the emission event to the eye, in
/// the camera frame; its length does not matter. `v` is the velocity of the source in that frame.
///
/// With θ between n and the motion, 1/D = γ − |u| cos θ; ahead (cos θ > 0) it is taken as
/// e^{−η} + |u|(1 − cos θ) and 1 − cos θ = sin²θ/(1 + cos θ), so D is right to a few units in the last place
/// at every speed and in every direction. The zero vector has no direction; it is taken as abeam, D = 1/γ.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Velocity, doppler_factor};
///
/// let v = Velocity::from_beta(DVec3::new(0.6, 0.0, 0.0))?;
/// assert_eq!(doppler_factor(DVec3::X, v), 2.0); // coming
/// assert_eq!(doppler_factor(DVec3::Y, v), 0.8); // abeam
/// assert_eq!(doppler_factor(DVec3::NEG_X, v), 0.5); // going
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
#[must_use]
pub fn doppler_factor(to_observer: DVec3, v: Velocity) -> f64 {
    let n = to_observer / power_of_two_below(to_observer);
    let r = n.length();
    let part = v.split(n);
    let stretch = if r == 0.0 {
        v.gamma()
    } else if part.along > 0.0 {
        let one_minus_cos = part.across.length_squared() / (r * (r + part.along));
        v.exp_minus_rapidity() + v.proper_speed() * one_minus_cos
    } else {
        v.gamma() - v.proper_speed() * (part.along / r)
    };
    1.0 / stretch
}

/// The Doppler factor of a point seen at `p_seen`, relative to the eye: (P10) with n = −p/|p|.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Velocity, doppler_at, seen_position};
///
/// // A point abreast of the eye in its own frame is seen blue: D = γ.
/// let v = Velocity::from_beta(DVec3::new(0.6, 0.0, 0.0))?;
/// let p = seen_position(DVec3::new(0.0, 2.0, 0.0), v);
/// assert_eq!(doppler_at(p, v), 1.25);
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
#[must_use]
pub fn doppler_at(p_seen: DVec3, v: Velocity) -> f64 {
    doppler_factor(-p_seen, v)
}

/// The power of D by which a value of brightness is multiplied; a picture says which law it used.  Eq. (P12)
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Brightness {
    /// D¹, the photon-flux law of the 1988 report.
    #[default]
    Report,
    /// D³, photon radiance: photons per area, time and solid angle.
    Photon,
    /// D⁴, bolometric radiance: power per area and solid angle.
    Bolometric,
    /// D⁰: brightness is left alone.
    None,
}

impl Brightness {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Report, Self::Photon, Self::Bolometric, Self::None];

    /// Its name, as in the table of (P12).
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Brightness::Report => "report",
            Brightness::Photon => "photon",
            Brightness::Bolometric => "bolometric",
            Brightness::None => "none",
        }
    }

    /// The law called `name`.
    ///
    /// ```
    /// use ugphysics::Brightness;
    ///
    /// assert_eq!(Brightness::from_name("photon"), Some(Brightness::Photon));
    /// assert!(Brightness::ALL.iter().all(|&law| Brightness::from_name(law.name()) == Some(law)));
    /// ```
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|law| law.name() == name)
    }

    /// What brightness is multiplied by at Doppler factor `doppler`.
    ///
    /// ```
    /// use ugphysics::Brightness;
    ///
    /// assert_eq!(Brightness::Photon.factor(2.0), 8.0);
    /// ```
    #[must_use]
    pub fn factor(self, doppler: f64) -> f64 {
        let square = doppler * doppler;
        match self {
            Brightness::Report => doppler,
            Brightness::Photon => square * doppler,
            Brightness::Bolometric => square * square,
            Brightness::None => 1.0,
        }
    }
}
