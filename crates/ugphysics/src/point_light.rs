//! Moving lamps.

use core::f64::consts::PI;

/// The energy per area and time that a small lamp, which sends `power` evenly into all directions of its own frame, gives a
/// surface that faces it: P D⁴/(4π r²).  Eq. (P33)
///
/// `distance` is r, from the surface to where the lamp is *seen*, in the frame of the surface; `doppler` is D of that light.
/// Where r' = r/D, the same distance in the lamp's frame, is known instead, D² takes the place of D⁴. Per unit of
/// wavelength both have one D more, as in (P12).
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
