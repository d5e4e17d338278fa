//! Light that falls on a moving surface from a source with a motion of its own.
//!
//! Three events follow each other: the source shines, the surface scatters that light, the eye takes its
//! picture (at the origin, at t = 0). The surface rests in S', which moves with **v** in the camera frame S; the
//! light rests in S'', which moves with **v**_l in S. Rest coordinates are relative to the eye, as everywhere:
//! the origins of all three frames meet at t = 0.

use core::f64::consts::PI;

use glam::DVec3;

use crate::{Brightness, Velocity, rest_position, seen_position};

/// How light arrives at a point of a surface, as found in the rest frame of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Illumination {
    /// Unit vector from the surface towards where the light was when it shone, in S'.
    pub toward: DVec3,
    /// Doppler factor D_l = f_surface/f_light; above 1 the surface finds the light bluer than it was sent.
    pub doppler: f64,
    /// r: distance of the light when it shone, in S'. Infinite for a directional light.
    pub distance: f64,
    /// r'' = r/D_l: the same distance in the frame of the light, S''. Infinite for a directional light.
    pub rest_distance: f64,
}

impl Illumination {
    /// Power per area that a point source of power `power`, the same in all directions in its own frame, sends
    /// through an area facing it: P D_l⁴/(4πr²) = P D_l²/(4πr''²).  Eq. (P14)
    ///
    /// ```
    /// use glam::DVec3;
    /// use ugphysics::{Velocity, illumination};
    ///
    /// // A surface at rest just at the eye; a light comes at it with 0.5 c, D = √3.
    /// let v = Velocity::from_beta(DVec3::new(-0.5, 0.0, 0.0))?;
    /// let light = illumination(DVec3::ZERO, Velocity::ZERO, DVec3::new(1.0, 0.0, 0.0), v);
    /// let light = light.ok_or("the light is not at the surface")?;
    /// assert!((light.distance - 3.0f64.sqrt()).abs() < 1e-15);
    /// assert!((light.irradiance(1.0) * 4.0 * std::f64::consts::PI - 3.0).abs() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn irradiance(&self, power: f64) -> f64 {
        power * self.doppler * self.doppler / (4.0 * PI * self.rest_distance * self.rest_distance)
    }

    /// The same per unit of wavelength, from the source's power per unit of wavelength at the wavelength it had
    /// there, λ D_l: P_λ D_l⁵/(4πr²) = P_λ D_l³/(4πr''²).  Eq. (P14)
    #[must_use]
    pub fn spectral_irradiance(&self, power: f64) -> f64 {
        self.doppler * self.irradiance(power)
    }
}

/// The light of a point source at rest at `light` in S'', on the surface point at rest at `p_rest` in S', when
/// that point sends what the eye sees at t = 0. `None` if the light is just at the surface then, or too close
/// for numbers: there is no direction.  Eq. (P14)
///
/// The surface point scatters the light at the event (−|p'|, p') of S', on the past light cone of the eye; in
/// S'' that event is at (−|x''|, x'') with x'' the (P4) of its place in S. The light stands still there, so
/// q'' = l'' − x'' points at it, and it shone |q''| earlier. (−|q''|, q'') is a null vector into the past as
/// in (P3) and (P4), which take it through S to S'. D_l = |q'|/|q''|, as for the eye.
///
/// Between frames of one velocity nothing is computed, so a light that moves along is as one at rest, to the bit.
/// Otherwise the error is some γ²·10⁻¹⁶ of the distances.
#[must_use]
pub fn illumination(p_rest: DVec3, v: Velocity, light: DVec3, v_light: Velocity) -> Option<Illumination> {
    let at_light = if v == v_light { p_rest } else { rest_position(seen_position(p_rest, v), v_light) };
    let to_light = light - at_light;
    let at_surface = change_view(to_light, v_light, v);
    let [distance, rest_distance] = [at_surface, to_light].map(length);
    let illumination = Illumination {
        toward: at_surface / distance,
        doppler: distance / rest_distance,
        distance,
        rest_distance,
    };
    (rest_distance > 0.0 && illumination.toward.is_finite() && illumination.doppler > 0.0)
        .then_some(illumination)
}

/// The light of a source infinitely far away towards `toward_light` in its own frame S'', on any point of a
/// surface. `None` if that vector is zero or not finite.  Eq. (P14)
///
/// The direction is aberrated, and D_l the same for all points: the limit of [`illumination`] for l'' far along
/// `toward_light`.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Velocity, illumination_from_afar};
///
/// // The stars' light falls on a ship at 0.6 c; in its frame the stars go the other way.
/// let ship = Velocity::from_beta(DVec3::new(0.6, 0.0, 0.0))?;
/// let ahead = illumination_from_afar(ship, DVec3::X, Velocity::ZERO).map(|light| light.doppler);
/// assert_eq!(ahead, Some(2.0));
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
#[must_use]
pub fn illumination_from_afar(v: Velocity, toward_light: DVec3, v_light: Velocity) -> Option<Illumination> {
    let toward_light = toward_light / toward_light.abs().max_element();
    let at_surface = change_view(toward_light, v_light, v);
    let distance = length(at_surface);
    let illumination = Illumination {
        toward: at_surface / distance,
        doppler: distance / length(toward_light),
        distance: f64::INFINITY,
        rest_distance: f64::INFINITY,
    };
    (illumination.toward.is_finite() && illumination.doppler > 0.0).then_some(illumination)
}

/// A vector along which something is seen, from the frame that moves with `from` to that which moves with `to`.
fn change_view(d: DVec3, from: Velocity, to: Velocity) -> DVec3 {
    if from == to { d } else { rest_position(seen_position(d, from), to) }
}

/// The length, also where the square of a component is not a normal number.
fn length(d: DVec3) -> f64 {
    let largest = d.abs().max_element();
    if largest > 0.0 { (d / largest).length() * largest } else { largest }
}

impl Brightness {
    /// What the light that falls on a surface is multiplied by, if the source's frame and the surface's differ by
    /// the Doppler factor `doppler`, at equal distance in the frame of the source.  Eq. (P14)
    ///
    /// A source of light covers 1/D² of the solid angle it would cover at rest, so a law for what is seen loses
    /// D² where it becomes one for what falls in: photons D, power D². The report's law knows no solid angles and
    /// stays D.
    ///
    /// ```
    /// use ugphysics::Brightness;
    ///
    /// assert_eq!(Brightness::Bolometric.irradiance_factor(3.0), 9.0);
    /// ```
    #[must_use]
    pub fn irradiance_factor(self, doppler: f64) -> f64 {
        match self {
            Brightness::Report | Brightness::Photon => doppler,
            Brightness::Bolometric => doppler * doppler,
            Brightness::None => 1.0,
        }
    }
}
