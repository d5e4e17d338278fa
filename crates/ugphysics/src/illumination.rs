//! Light that falls on a moving surface from a source that moves on its own.
//!
//! Three events follow each other: the source emits light, the surface scatters it, and the eye
//! receives it. The surface rests in S', which moves with **v** in the camera frame S; the light
//! rests in S'', which moves with **v**_l in S. Rest coordinates are relative to the eye, as
//! everywhere: the origins of all three frames coincide at t = 0.
//!
//! An eye at the origin at t = 0 sees the surface point scatter at (−|p'|, p'). Light that reaches
//! the eye by a mirror or through glass, or another eye at another time, left the point at another
//! time; the difference is its *delay*.

use glam::DVec3;

use crate::{Brightness, Velocity, compose, rest_position, seen_position};

/// Light arriving at a point of a surface, described in the rest frame of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IncidentLight {
    /// Unit vector from the surface towards the place of the light at emission, in S'.
    pub toward: DVec3,
    /// Doppler factor D_l = f_surface/f_light; above 1 the light arrives blueshifted.
    pub doppler: f64,
    /// r: distance of the light at emission, in S'. Infinite for a directional light.
    pub distance: f64,
    /// r'' = r/D_l: the same distance in the frame of the light, S''. Infinite for a directional
    /// light.
    pub rest_distance: f64,
    /// Unit vector in which the light left its source, in S''.
    pub leaving: DVec3,
}

/// The light of a point source at rest at `light` in S'' that arrives at the surface point at rest
/// at `p_rest` in S', at the event (−|p'| + `delay`, p') of S'. `None` if the source is at the
/// surface point at that moment, or so close that no direction can be computed.  Eq. (P14)
///
/// `delay`: 0 if the eye, at the origin at t = 0, sees the point directly through a vacuum. Then
/// the event is on the past light cone of the eye, and its place x'' in S'' is (P4) of its position
/// in S. A point at rest in S' moves through S'' with the 4-velocity of **v** composed with
/// −**v**_l, so a delay adds its spatial part times the delay. The source rests in S'', so q'' =
/// l'' − x'' points at it, and it emitted the light |q''| earlier. (−|q''|, q'') is a past null
/// vector, so (P3) and then (P4) transform it through S to S'. D_l = |q'|/|q''|, as for the eye.
///
/// If both velocities are equal no transformation is computed, so a light that moves with the
/// surface gives the same bits as a light and surface at rest. Otherwise the error is about
/// γ²·10⁻¹⁶ of the distances.
pub fn illumination(
    p_rest: DVec3,
    delay: f64,
    v: Velocity,
    light: DVec3,
    v_light: Velocity,
) -> Option<IncidentLight> {
    illumination_at(place_in_frame(p_rest, delay, v, v_light), v, light, v_light)
}

/// From the vectors to the light in the frames of the surface and of the light.
fn illumination_by(at_surface: DVec3, to_light: DVec3) -> Option<IncidentLight> {
    let [distance, rest_distance] = [at_surface, to_light].map(length);
    let illumination = IncidentLight {
        toward: at_surface / distance,
        doppler: distance / rest_distance,
        distance,
        rest_distance,
        leaving: -to_light / rest_distance,
    };
    (rest_distance > 0.0 && illumination.toward.is_finite() && illumination.doppler > 0.0)
        .then_some(illumination)
}

/// The light of a source on any world line, which the past null vector `way` in S leads to from the
/// event at which the surface scatters it. `v`: velocity of the surface there, `v_light`: of the
/// source at emission. `None` as for [`illumination`].  Eq. (P14)
///
/// The vector is transformed to both frames by (P4); its lengths there are r' and r'', and their
/// quotient is D_l.
pub fn illumination_along(way: DVec3, v: Velocity, v_light: Velocity) -> Option<IncidentLight> {
    illumination_by(rest_position(way, v), rest_position(way, v_light))
}

/// The light of a source at rest at `light` in S'', at the event of S'' at which a surface that
/// moves with `v` in S scatters it, at `place`. `None` as for [`illumination`].  Eq. (P14)
pub fn illumination_at(
    place: DVec3,
    v: Velocity,
    light: DVec3,
    v_light: Velocity,
) -> Option<IncidentLight> {
    illumination_by(change_view(light - place, v_light, v), light - place)
}

/// The light of a directional source, infinitely far away towards `toward_light` in its own frame
/// S'', at any point of a surface that moves with `v`. `None` if `toward_light` is zero or not
/// finite.  Eq. (P14)
///
/// The direction is aberrated, and D_l is the same for all points: the limit of [`illumination`] as
/// l'' goes to infinity along `toward_light`.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Velocity, illumination_from_afar};
///
/// // A star straight ahead of a ship at 0.6 c: its light is blueshifted by a factor 2.
/// let ship = Velocity::from_beta(DVec3::new(0.6, 0.0, 0.0))?;
/// let ahead = illumination_from_afar(ship, DVec3::X, Velocity::ZERO).map(|light| light.doppler);
/// assert_eq!(ahead, Some(2.0));
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
pub fn illumination_from_afar(
    v: Velocity,
    toward_light: DVec3,
    v_light: Velocity,
) -> Option<IncidentLight> {
    let toward_light = toward_light / toward_light.abs().max_element();
    let at_surface = change_view(toward_light, v_light, v);
    let distance = length(at_surface);
    let illumination = IncidentLight {
        toward: at_surface / distance,
        doppler: distance / length(toward_light),
        distance: f64::INFINITY,
        rest_distance: f64::INFINITY,
        leaving: -toward_light / length(toward_light),
    };
    (illumination.toward.is_finite() && illumination.doppler > 0.0).then_some(illumination)
}

/// The place in S'', which moves with `to`, of the event (−|p'| + `delay`, p') of S', which moves
/// with `from`.
fn place_in_frame(p_rest: DVec3, delay: f64, from: Velocity, to: Velocity) -> DVec3 {
    let place = change_view(p_rest, from, to);
    if delay == 0.0 || from == to { place } else { place + delay * compose(from, -to).proper() }
}

/// Transforms the vector towards a seen point from the frame that moves with `from` to the one that
/// moves with `to`.
fn change_view(d: DVec3, from: Velocity, to: Velocity) -> DVec3 {
    if from == to { d } else { rest_position(seen_position(d, from), to) }
}

/// The length of `d`, also where the square of a component would overflow or underflow.
fn length(d: DVec3) -> f64 {
    let largest = d.abs().max_element();
    if largest > 0.0 { (d / largest).length() * largest } else { largest }
}

impl Brightness {
    /// The factor on the light level at a surface that receives light with Doppler factor
    /// `doppler`, at equal distance in the frame of the source.  Eq. (P14)
    ///
    /// Irradiance is radiance times solid angle, and a source covers 1/D² of the solid angle it
    /// would cover at rest. So the laws for radiance (P12) lose a factor D²: photons D, power D².
    /// The report's law ignores solid angles and stays D.
    ///
    /// ```
    /// use ugphysics::Brightness;
    ///
    /// assert_eq!(Brightness::Bolometric.irradiance_factor(3.0), 9.0);
    /// ```
    pub fn irradiance_factor(self, doppler: f64) -> f64 {
        match self {
            Brightness::Report | Brightness::Photon => doppler,
            Brightness::Bolometric => doppler * doppler,
            Brightness::None => 1.0,
        }
    }
}
