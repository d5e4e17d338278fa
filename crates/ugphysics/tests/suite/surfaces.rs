//! Mirrors, glass, lamps and accelerated bodies: laws tested on random input.

use glam::DVec3;
use proptest::prelude::*;
use ugphysics::{
    Event, HyperbolicMotion, Lorentz, Medium, Velocity, WaveVector, contracted, doppler_at,
    elongated, seen_position,
};

use crate::{near, near_vector};

pub fn wave(direction: DVec3) -> WaveVector {
    WaveVector::in_vacuum(1.0, direction)
}

/// Light in vacuum after a mirror that moves with `v`.
pub fn reflected(light: WaveVector, rest_normal: DVec3, v: Velocity) -> WaveVector {
    let there = light.in_frame(v);
    let normal = rest_normal * -there.k.dot(rest_normal).signum();
    Medium::VACUUM.wave_across(there, normal).expect("a mirror reflects").in_frame(-v)
}

#[test]
fn without_acceleration_a_body_stays() {
    let still = HyperbolicMotion { acceleration: DVec3::ZERO };
    assert_eq!(still.event(3.0), Event { t: 3.0, x: DVec3::ZERO });
}

fn velocities() -> impl Strategy<Value = Velocity> {
    (0usize..64, 0.0..3.0_f64).prop_map(|(i, rapidity)| {
        let all = crate::directions();
        Velocity::from_rapidity(all[i % all.len()], rapidity).expect("a rapidity below 100")
    })
}

fn directions() -> impl Strategy<Value = DVec3> {
    (0usize..64).prop_map(|i| {
        let all = crate::directions();
        all[(7 * i + 3) % all.len()]
    })
}

proptest! {
    /// A wave in another frame is the boost of its null vector.
    #[test]
    fn waves_are_null_vectors(v in velocities(), n in directions()) {
        let there = wave(n).in_frame(v);
        let vector = Lorentz::boost(v).inverse().apply(Event { t: 1.0, x: n });
        let scale = v.gamma() * v.gamma();
        near("frequency", there.frequency / vector.t, 1.0, 1e-14 * scale);
        near_vector("direction", there.k / there.frequency, vector.x / vector.t, 1e-14 * scale);
        let back = there.in_frame(-v);
        near("there and back", back.frequency, 1.0, 1e-13 * scale);
    }

    /// Light that is reflected twice by the same mirror is the original wave.
    #[test]
    fn reflection_is_its_own_inverse(v in velocities(), n in directions(), normal in directions()) {
        let scale = v.gamma() * v.gamma();
        let once = reflected(wave(n), normal, v);
        let frequencies = once.frequency;
        let twice = reflected(once, normal, v);
        near("frequency", twice.frequency, 1.0, 1e-12 * scale * frequencies.max(1.0 / frequencies));
        near("direction", twice.k.dot(n) / twice.frequency, 1.0, 1e-12 * scale);
    }

    /// The seen position moves with the apparent velocity γD**v** (P31).
    #[test]
    fn what_is_seen_moves_with_the_apparent_velocity(v in velocities(), d in directions()) {
        let p_rest = 3.0 * d;
        let step = 1e-5;
        let at = |t: f64| seen_position(p_rest + v.proper() * t, v);
        let p = at(0.0);
        let moved = (at(step) - at(-step)) / (2.0 * step);
        let doppler = doppler_at(p, v);
        let apparent = v.proper() * doppler;
        prop_assert!((moved - apparent).length() <= 1e-6 * (1.0 + apparent.length()) * v.gamma() * v.gamma());
    }

    /// Lines in a contracted plane are perpendicular to its normal (P34).
    #[test]
    fn contracted_normals_stay_perpendicular(v in velocities(), normal in directions()) {
        let line = normal.any_orthonormal_vector();
        let other = normal.cross(line);
        let seen = elongated(normal, v).normalize();
        prop_assert!(seen.dot(contracted(line, v)).abs() < 1e-13 && seen.dot(contracted(other, v)).abs() < 1e-13);
    }
}
