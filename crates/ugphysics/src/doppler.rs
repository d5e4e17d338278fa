//! The Doppler factor of a moving body, and the brightness laws.

use glam::DVec3;

use crate::Velocity;
use crate::error_free::power_of_two_below;

/// The Doppler factor D = f_observed/f_emitted = λ_emitted/λ_observed = 1/(γ(1 − **v**·n)),
/// dimensionless.  Eq. (P10)
///
/// D > 1 is a blueshift. `to_observer` is n, the direction of the light from the emission event to
/// the eye, in the camera frame; it may have any length. `v` is the velocity of the source in that
/// frame.
///
/// With θ between n and the motion, 1/D = γ − |u| cos θ; Ahead (cos θ > 0) this would cancel, so it
/// is computed as e^{−η} + |u|(1 − cos θ) with 1 − cos θ = sin²θ/(1 + cos θ). D is then right to a
/// few units in the last place at every speed and in every direction. The zero vector has no
/// direction and counts as abeam, D = 1/γ.
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

/// The Doppler factor of a point seen at `p_seen`, relative to the eye in the camera frame:
/// n = −p/|p|.  Eq. (P10)
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Velocity, doppler_at, seen_position};
///
/// // A point abeam of the eye in its own rest frame is seen blueshifted: D = γ.
/// let v = Velocity::from_beta(DVec3::new(0.6, 0.0, 0.0))?;
/// let p = seen_position(DVec3::new(0.0, 2.0, 0.0), v);
/// assert_eq!(doppler_at(p, v), 1.25);
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
pub fn doppler_at(p_seen: DVec3, v: Velocity) -> f64 {
    doppler_factor(-p_seen, v)
}

/// The brightness law: by which power of D brightness is multiplied. Pictures record the law they
/// used.  Eq. (P12)
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Brightness {
    /// D¹, the photon-flux law of the 1988 report.
    #[default]
    Report,
    /// D³, photon radiance: photons per area, time and solid angle.
    Photon,
    /// D⁴, bolometric radiance: power per area and solid angle.
    Bolometric,
    /// D⁰: brightness is unchanged.
    None,
}

impl Brightness {
    /// All laws, in the order of their powers; `None` last.
    pub const ALL: [Self; 4] = [Self::Report, Self::Photon, Self::Bolometric, Self::None];

    /// The name of the law, as in the table of (P12).
    pub fn name(self) -> &'static str {
        match self {
            Brightness::Report => "report",
            Brightness::Photon => "photon",
            Brightness::Bolometric => "bolometric",
            Brightness::None => "none",
        }
    }

    /// The law of the given name; `None` if there is no such law.
    ///
    /// ```
    /// use ugphysics::Brightness;
    ///
    /// assert_eq!(Brightness::from_name("photon"), Some(Brightness::Photon));
    /// assert!(Brightness::ALL.iter().all(|&law| Brightness::from_name(law.name()) == Some(law)));
    /// ```
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|law| law.name() == name)
    }

    /// True if the law names a quantity of light. Its factors, sums over lamps, intensities and
    /// cosines are then those of linear light. Those of the other laws, of 1988, are factors and
    /// sums of display-encoded values.  Eq. (P18)
    ///
    /// ```
    /// use ugphysics::Brightness;
    ///
    /// assert!(Brightness::Photon.acts_on_light() && !Brightness::Report.acts_on_light());
    /// ```
    #[inline]
    pub fn acts_on_light(self) -> bool {
        matches!(self, Brightness::Photon | Brightness::Bolometric)
    }

    /// The factor on brightness at Doppler factor `doppler`.  Eq. (P12)
    ///
    /// ```
    /// use ugphysics::Brightness;
    ///
    /// assert_eq!(Brightness::Photon.factor(2.0), 8.0);
    /// ```
    #[inline]
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
