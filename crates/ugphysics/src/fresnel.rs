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
#[must_use]
pub fn reflectance(before: Medium, behind: Medium, light: WaveVector, normal: DVec3) -> f64 {
    let Some(transmitted) = behind.wave_beside(light, -normal) else { return 1.0 };
    let part = if is_at_rest(before) && is_at_rest(behind) {
        at_rest((light, before.index), (transmitted, behind.index), normal)
    } else {
        let Some(incident) = before.wave_beside(light, -normal) else { return 0.0 };
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
    let [incident, reflected, transmitted] = [incident, reflected, transmitted].map(|(wave, medium)| {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Velocity;

    fn beta(x: f64, y: f64, z: f64) -> Velocity {
        Velocity::from_beta(DVec3::new(x, y, z)).unwrap()
    }

    fn at_rest(index: f64) -> Medium {
        Medium { index, velocity: Velocity::ZERO }
    }

    fn light(index: f64, direction: DVec3) -> WaveVector {
        WaveVector { frequency: 1.0, k: index * direction.normalize() }
    }

    /// Textbook values: Brewster's angle, where only one polarisation is reflected, and the
    /// critical angle.
    #[test]
    fn glass_at_rest_follows_fresnels_equations() {
        let glass = at_rest(1.5);
        let brewster = DVec3::new(1.5, 0.0, 1.0);
        let one = (1.5_f64 * 1.5 - 1.0) / (1.5 * 1.5 + 1.0);
        let found = reflectance(Medium::VACUUM, glass, light(1.0, brewster), DVec3::Z);
        assert!((found - 0.5 * one * one).abs() < 1e-15, "{found}");
        assert_eq!(reflectance(glass, Medium::VACUUM, light(1.5, DVec3::new(0.7, 0.0, 0.7)), DVec3::Z), 1.0);
    }

    /// The equations for fields give the same as Fresnel's where no medium moves, and media that
    /// move along their boundary reflect as they do in their common rest frame.
    #[test]
    fn a_boundary_that_slides_reflects_as_at_rest() {
        for (before, behind) in [(1.0, 1.5), (1.33, 1.5), (1.7, 1.2), (1.5, 1.0)] {
            for toward in [DVec3::new(0.1, 0.0, 1.0), DVec3::new(0.3, -0.2, 1.0), DVec3::new(-0.4, 0.1, 0.8)]
            {
                let light = light(before, toward);
                let [first, second] = [at_rest(before), at_rest(behind)];
                let expected = reflectance(first, second, light, DVec3::Z);
                let waves = [first.wave_beside(light, -DVec3::Z), second.wave_beside(light, -DVec3::Z)];
                if let [Some(incident), Some(through)] = waves {
                    let found = in_motion((incident, first), (light, first), (through, second), DVec3::Z);
                    assert!((found - expected).abs() < 1e-14, "{found} {expected}");
                }
                for v in [beta(0.5, 0.0, 0.0), beta(-0.3, 0.6, 0.0)] {
                    let moving = |index| Medium { index, velocity: v };
                    let seen = light.in_frame(-v);
                    let found = reflectance(moving(before), moving(behind), seen, DVec3::Z);
                    assert!((found - expected).abs() < 1e-12, "{v:?} {found} {expected}");
                }
            }
        }
    }

    /// At right angles a medium reflects the same part however fast it flows through its boundary:
    /// the ratio of **E** and **H** of a wave along the motion does not change.
    #[test]
    fn flow_through_a_boundary_does_not_change_reflection_at_right_angles() {
        let part = |n: f64, m: f64| ((n - m) / (n + m)) * ((n - m) / (n + m));
        for speed in [-0.5, 0.1, 0.6] {
            let water = Medium { index: 1.33, velocity: beta(0.0, 0.0, speed) };
            let (glass, wave) = (at_rest(1.6), water.wave_along(DVec3::Z).unwrap());
            let found = reflectance(water, glass, wave, DVec3::Z);
            assert!((found - part(1.33, 1.6)).abs() < 1e-14, "{speed} {found}");
            let found = reflectance(glass, water, light(1.6, DVec3::Z), DVec3::Z);
            assert!((found - part(1.33, 1.6)).abs() < 1e-14, "{speed} {found}");
        }
    }

    /// No energy is lost at a boundary at rest: what is not reflected into a direction from the
    /// front comes from behind. Both parts are computed from fields, each with the other side as
    /// `before`.
    #[test]
    fn light_from_both_sides_adds_up() {
        for v in [beta(0.4, 0.0, 0.3), beta(-0.2, 0.5, -0.4), beta(0.0, 0.3, 0.1)] {
            let (water, glass) = (Medium { index: 1.33, velocity: v }, at_rest(1.5));
            for toward in [DVec3::Z, DVec3::new(0.3, 0.0, 1.0), DVec3::new(-0.5, 0.4, 1.0)] {
                let light = light(1.5, toward);
                // The same two waves, as seen from the other side: light that comes in from the water.
                let through = water.wave_beside(light, DVec3::Z).unwrap();
                let front = reflectance(glass, water, light, DVec3::Z);
                // Reversed in time, light and media move the other way.
                let reversed = |wave: WaveVector| WaveVector { k: -wave.k, ..wave };
                let back = Medium { velocity: -v, ..water };
                let behind = reflectance(back, glass, reversed(through), -DVec3::Z);
                assert!((front - behind).abs() < 1e-13, "{v:?} {toward} {front} {behind}");
            }
        }
    }
}
