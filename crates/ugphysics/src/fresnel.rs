//! How much light is reflected where two transparent media meet.

use glam::{DMat4, DVec3, DVec4};

use crate::{Medium, WaveVector};

/// The part of unpolarised light that the boundary between two media reflects into a given
/// direction: the weight of the reflected light in what is seen from there. The rest, up to 1, is
/// the weight of the transmitted light.  Eq. (P39)
///
/// `light`: the light that leaves the boundary, in the medium `before` it. `normal`: unit vector on
/// that side. Everything is in the frame in which the boundary rests; the media may move. 1 if no
/// light is transmitted (total reflection), 0 if none is reflected: in a medium that moves faster
/// than the light in it there may be none that meets the boundary.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Medium, Velocity, WaveVector, reflectance};
///
/// // A pane of glass reflects 4 percent of the light that meets it at right angles.
/// let glass = Medium { index: 1.5, velocity: Velocity::ZERO };
/// let light = WaveVector { frequency: 1.0, k: DVec3::Z };
/// assert!((reflectance(Medium::VACUUM, glass, light, DVec3::Z) - 0.04).abs() < 1e-15);
/// ```
pub fn reflectance(before: Medium, behind: Medium, light: WaveVector, normal: DVec3) -> f64 {
    let Some(transmitted) = behind.wave_across(light, -normal) else { return 1.0 };
    let part = if is_at_rest(before) && is_at_rest(behind) {
        at_rest((light, before.index), (transmitted, behind.index), normal)
    } else {
        let Some(incident) = before.wave_across(light, -normal) else { return 0.0 };
        in_motion((incident, before), (light, before), (transmitted, behind), normal)
    };
    // NaN at grazing incidence, where all light is reflected.
    if part.is_finite() { part.clamp(0.0, 1.0) } else { 1.0 }
}

/// A vacuum has no velocity.
fn is_at_rest(medium: Medium) -> bool {
    medium.velocity.is_zero() || medium.index == 1.0
}

/// Fresnel's equations, with the components of the wave vectors along the normal.
fn at_rest(
    (light, index): (WaveVector, f64),
    (through, index_behind): (WaveVector, f64),
    normal: DVec3,
) -> f64 {
    let (a, b) = (light.k.dot(normal).abs(), through.k.dot(normal).abs());
    // Polarised perpendicular to the plane of incidence, and in it.
    let across = (a - b) / (a + b);
    let (p, q) = (index_behind * index_behind * a, index * index * b);
    let within = (p - q) / (p + q);
    0.5 * (across * across + within * within)
}

/// The amplitudes follow from the tangential components of **E** and **H**, which are the same on
/// both sides of a boundary at rest: four equations for two polarisations of the reflected and two
/// of the transmitted light.
fn in_motion(
    incident: (WaveVector, Medium),
    reflected: (WaveVector, Medium),
    transmitted: (WaveVector, Medium),
    normal: DVec3,
) -> f64 {
    let (across, up) = normal.any_orthonormal_pair();
    let tangential = |field: &Field| {
        DVec4::new(field.e.dot(across), field.e.dot(up), field.h.dot(across), field.h.dot(up))
    };
    let [incident, reflected, transmitted] =
        [incident, reflected, transmitted].map(|(wave, medium)| {
            let own = wave.in_frame(medium.velocity);
            let (first, second) = crate::unit_or_zero(own.k).any_orthonormal_pair();
            [first, second].map(|polarisation| Field::of(own, medium, polarisation))
        });
    let outgoing = DMat4::from_cols(
        tangential(&reflected[0]),
        tangential(&reflected[1]),
        -tangential(&transmitted[0]),
        -tangential(&transmitted[1]),
    );
    let solve = outgoing.inverse();
    let power = |field: &Field| field.e.cross(field.h).dot(normal);
    // The two polarisations of a wave carry their power independently of each other.
    let part = |field: &Field| {
        let amplitudes = solve * -tangential(field);
        let back = amplitudes.x * amplitudes.x * power(&reflected[0])
            + amplitudes.y * amplitudes.y * power(&reflected[1]);
        -back / power(field)
    };
    0.5 * (part(&incident[0]) + part(&incident[1]))
}

/// The electric and magnetic field of a wave, in the frame of the boundary.
struct Field {
    e: DVec3,
    h: DVec3,
}

impl Field {
    /// Fields of light `own` in the frame of its medium, polarised along a unit vector there.
    ///
    /// In the medium **H** = **B** = **k** × **E**/f and **D** = N² **E**; (**E**, **B**) and
    /// (**D**, **H**) change between frames as electric and magnetic fields do.
    fn of(own: WaveVector, medium: Medium, polarisation: DVec3) -> Self {
        let e = polarisation;
        let b = (own.k / own.frequency).cross(e);
        let d = medium.index * medium.index * e;
        let (gamma, axis) = (medium.velocity.gamma(), medium.velocity.direction());
        let u = medium.velocity.proper();
        let boosted = |field: DVec3, other: DVec3| {
            let along = field.dot(axis) * axis;
            along + gamma * (field - along) + u.cross(other)
        };
        Self { e: boosted(e, -b), h: boosted(b, d) }
    }
}
