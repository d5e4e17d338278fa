//! Light in media that move: steps, refraction and reflection.

use glam::DVec3;
use ugphysics::{Event, Medium, Velocity, WaveVector, compose, reflectance};

use crate::beta;

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
    assert_eq!(
        reflectance(glass, Medium::VACUUM, light(1.5, DVec3::new(0.7, 0.0, 0.7)), DVec3::Z),
        1.0
    );
}

/// Media that move along their boundary, by the equations for fields, reflect as they do in their
/// common rest frame, by Fresnel's.
#[test]
fn a_boundary_that_slides_reflects_as_at_rest() {
    for (before, behind) in [(1.0, 1.5), (1.33, 1.5), (1.7, 1.2), (1.5, 1.0)] {
        for toward in
            [DVec3::new(0.1, 0.0, 1.0), DVec3::new(0.3, -0.2, 1.0), DVec3::new(-0.4, 0.1, 0.8)]
        {
            let light = light(before, toward);
            let [first, second] = [at_rest(before), at_rest(behind)];
            let expected = reflectance(first, second, light, DVec3::Z);
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
            let through = water.wave_across(light, DVec3::Z).unwrap();
            let front = reflectance(glass, water, light, DVec3::Z);
            // Reversed in time, light and media move the other way.
            let reversed = |wave: WaveVector| WaveVector { k: -wave.k, ..wave };
            let back = Medium { velocity: -v, ..water };
            let behind = reflectance(back, glass, reversed(through), -DVec3::Z);
            assert!((front - behind).abs() < 1e-13, "{v:?} {toward} {front} {behind}");
        }
    }
}

#[test]
fn steps_have_the_velocity_of_light_in_moving_glass() {
    for v in [beta(0.0, 0.0, 0.0), beta(0.9, 0.0, 0.0), beta(-0.5, 0.3, 0.6)] {
        for direction in [DVec3::X, DVec3::NEG_X, DVec3::new(0.6, 0.0, -0.8)] {
            let wave = WaveVector { frequency: 2.0, k: 3.0 * direction }.in_frame(-v);
            let step = Medium { index: 1.5, velocity: v }.step(wave);
            let expected = compose(Velocity::from_beta(direction / 1.5).unwrap(), v).beta();
            assert!((step.x / step.t - expected).length() < 1e-14, "{v:?} {direction}");
        }
    }
}

#[test]
fn media_at_rest_refract_and_reflect_by_snells_law() {
    for (before, behind) in [(1.0, 1.5), (1.5, 1.0), (1.33, 1.5), (1.0, 1.0)] {
        for degrees in [0.0_f64, 20.0, 41.0, 42.0, 70.0, 89.0] {
            let (sin, cos) = libm::sincos(degrees.to_radians());
            let direction = DVec3::new(cos, sin, 0.0);
            let wave = WaveVector { frequency: 1.0, k: before * direction };
            let medium = |index| Medium { index, velocity: Velocity::ZERO };
            let sin_behind = sin * before / behind;
            let found = medium(behind).wave_across(wave, DVec3::X).map(|wave| wave.k.normalize());
            assert_eq!(found.is_some(), sin_behind <= 1.0, "{before} {behind} {degrees}");
            if let Some(found) = found {
                let expected = DVec3::new((1.0 - sin_behind * sin_behind).sqrt(), sin_behind, 0.0);
                assert!((found - expected).length() < 1e-14);
            }
            let back = medium(before).wave_across(wave, DVec3::NEG_X).unwrap();
            assert!((back.k - before * DVec3::new(-cos, sin, 0.0)).length() < 1e-14);
        }
    }
}

/// Light that enters water which flows along the surface of the glass around it. The answer is
/// computed in the frame of the water, in which the surface moves: the frequency in the frame
/// of the surface and the wave vector along it are the same on both sides.
#[test]
fn moving_media_keep_frequency_and_tangential_wave_vector() {
    for v in [beta(0.0, 0.4, 0.0), beta(0.2, -0.3, 0.1), beta(-0.6, 0.0, 0.5)] {
        let water = Medium { index: 1.33, velocity: v };
        let glass = WaveVector { frequency: 1.0, k: 1.5 * DVec3::new(0.8, 0.36, 0.48) };
        let inside = water.wave_across(glass, DVec3::X).unwrap();
        assert_eq!(inside.frequency, 1.0);
        assert!((inside.k - glass.k).reject_from(DVec3::X).length() < 1e-15);
        let own = inside.in_frame(v);
        assert!((own.k.length() - 1.33 * own.frequency).abs() < 1e-13, "{v:?} {own:?}");
        let step = water.step(inside);
        assert!(step.x.x / step.t > 0.0);
        // Its velocity is that of light in the water, composed with the water's.
        let light = Velocity::from_beta(own.k.normalize() / 1.33).unwrap();
        assert!((compose(light, v).beta() - step.x / step.t).length() < 1e-13);
    }
}

/// Light that is emitted in a direction of the frame of the medium is found by the direction in
/// which it moves.
#[test]
fn light_is_found_by_its_direction() {
    let velocities = [beta(0.0, 0.0, 0.0), beta(0.5, 0.2, 0.1), beta(-0.3, 0.0, 0.55)];
    for (index, v) in [0.8, 1.0, 1.5].into_iter().flat_map(|index| velocities.map(|v| (index, v))) {
        let medium = Medium { index, velocity: v };
        for direction in [DVec3::X, DVec3::NEG_X, DVec3::new(0.6, 0.0, -0.8), DVec3::NEG_Z] {
            let wave = WaveVector { frequency: 2.0, k: 2.0 * index * direction }.in_frame(-v);
            let found = medium.wave_along(medium.step(wave).x.normalize()).unwrap();
            assert!((found.k - wave.k / wave.frequency).length() < 1e-13, "{medium:?} {direction}");
        }
    }
}

/// In glass that moves with 0.9 c no light moves backwards.
#[test]
fn fast_media_drag_all_light_along() {
    let glass = Medium { index: 1.5, velocity: beta(0.9, 0.0, 0.0) };
    assert_eq!(glass.wave_along(DVec3::NEG_X), None);
    let forwards = glass.wave_along(DVec3::X).unwrap();
    let step = glass.step(forwards);
    assert!((step.x.x / step.t - 0.979_166_666_7).abs() < 1e-10);
}

#[test]
fn vacuum_has_no_beta() {
    let wave = WaveVector { frequency: 1.0, k: DVec3::new(0.6, 0.8, 0.0) };
    let moving = Medium { index: 1.0, velocity: beta(0.9, 0.1, 0.0) };
    for vacuum in [Medium::VACUUM, moving] {
        assert_eq!(vacuum.step(wave), Event { t: 1.0, x: wave.k });
        let beside = vacuum.wave_across(wave, DVec3::X).unwrap();
        assert!(beside.frequency == 1.0 && (beside.k - wave.k).length() < 1e-15);
    }
}
