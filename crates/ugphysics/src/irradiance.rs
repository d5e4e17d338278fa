//! Irradiance from a moving lamp.

use core::f64::consts::PI;

/// Irradiance (power per area) on a surface that faces a small lamp of power P = `power`, isotropic
/// in its own frame: P D⁴/(4π r²).  Eq. (P33)
///
/// `distance` is r, from the surface to where the lamp is *seen*, in the frame of the surface;
/// `doppler` is D of that light. In terms of r' = r/D, the same distance in the lamp's frame, it is
/// P D²/(4π r'²). Per unit of wavelength both have one more factor D, as in (P12).
///
/// ```
/// use ugphysics::irradiance;
///
/// let at_rest = irradiance(1.0, 2.0, 1.0);
/// assert!((irradiance(1.0, 2.0, 3.0) / at_rest - 81.0).abs() < 1e-12);
/// ```
#[must_use]
pub fn irradiance(power: f64, distance: f64, doppler: f64) -> f64 {
    let lamp_distance = distance / doppler;
    power * (doppler * doppler) / (4.0 * PI * lamp_distance * lamp_distance)
}
