//! γ, the exact bound at the speed of light, and the messages.

use glam::DVec3;
use proptest::prelude::*;
use ugphysics::{Velocity, VelocityError};

use crate::big::{BigVelocity, big, relative_error};
use crate::{along_x, directions, near};

/// A few units in the last place.
const FEW_ULP: f64 = 4.0 * f64::EPSILON;

#[test]
fn gamma_is_right_to_a_few_ulp_in_every_direction() {
    for speed in [1e-300, 1e-20, 1e-8, 0.5, 0.99, 0.999_999, 0.999_999_999, 1.0 - 1e-15] {
        for direction in directions() {
            let beta = speed * direction;
            let (v, exact) = (Velocity::from_beta(beta).unwrap(), BigVelocity::from_beta(beta));
            let gamma = exact.gamma();
            assert!(relative_error(v.gamma(), &gamma) <= FEW_ULP, "gamma of {beta:?}");
            assert!(
                relative_error(v.proper_speed(), &(gamma * &exact.beta)) <= FEW_ULP,
                "proper of {beta:?}"
            );
            assert!(relative_error(v.speed(), &exact.beta) <= FEW_ULP, "speed of {beta:?}");
            assert_eq!(v.beta(), beta);
        }
    }
}

#[test]
fn the_bound_at_light_speed_is_exact() {
    // Directions normalised in doubles lie on both sides of length 1, all within rounding of it.
    let (mut n_above, mut n_below) = (0, 0);
    for direction in directions() {
        let exact_square = BigVelocity::from_beta(direction).one_minus_square();
        let below = exact_square > big(0.0);
        let got = Velocity::from_beta(direction);
        assert_eq!(got.is_ok(), below, "{direction:?}");
        if below {
            n_below += 1
        } else {
            n_above += 1
        }
        if let Ok(v) = got {
            assert!(
                relative_error(v.gamma(), &BigVelocity::from_beta(direction).gamma()) <= FEW_ULP
            );
        }
    }
    assert!(n_below >= 5 && n_above >= 10, "{n_below} below, {n_above} above");
    // 0.6 and 0.8 are not decimal fractions: the squares of the doubles add to 1 + 4·10⁻¹⁷.
    assert!(Velocity::from_beta(DVec3::new(0.6, 0.8, 0.0)).is_err());
    assert!(Velocity::from_beta(DVec3::new(0.6, 0.8_f64.next_down(), 0.0)).is_ok());
    assert!(Velocity::from_beta(DVec3::new(1.0, 1e-200, 0.0)).is_err());
    assert!(Velocity::from_beta(DVec3::new(1.0_f64.next_down(), 1e-200, 0.0)).is_ok());
}

#[test]
#[rustfmt::skip] // rows of a table
fn messages() {
    let check = |got: Result<Velocity, VelocityError>, message: &str| {
        assert_eq!(got.unwrap_err().to_string(), message);
    };
    let not_finite = "velocity is not finite: its components must not be infinite or NaN";
    check(Velocity::from_beta(DVec3::new(0.0, 1.2, 0.0)), "speed is 1.2 c: it must be below 1 (velocities are fractions of the speed of light)");
    check(Velocity::from_beta(DVec3::new(-1.0, 0.0, 0.0)), "speed is 1 c: it must be below 1 (velocities are fractions of the speed of light)");
    check(Velocity::from_beta(DVec3::new(f64::NAN, 0.0, 0.0)), not_finite);
    check(Velocity::from_beta(DVec3::new(0.0, f64::INFINITY, 0.0)), not_finite);
    check(Velocity::from_rapidity(DVec3::X, f64::NAN), not_finite);
    check(Velocity::from_rapidity(DVec3::new(f64::NAN, 1.0, 0.0), 1.0), not_finite);
    check(Velocity::from_rapidity(DVec3::X, 101.0), "rapidity is 101: it must be at most 100");
    check(Velocity::from_rapidity(DVec3::ZERO, 1.0), "direction is the zero vector: give a nonzero direction, or speed 0");
}

#[test]
fn rest_is_one_value() {
    let still = [
        Velocity::from_beta(DVec3::ZERO),
        Velocity::from_beta(DVec3::new(-0.0, 0.0, -0.0)),
        Velocity::from_rapidity(DVec3::ZERO, 0.0),
        Velocity::from_rapidity(DVec3::Y, 0.0),
        Ok(-Velocity::ZERO),
    ];
    for v in still {
        assert_eq!(v, Ok(Velocity::ZERO));
    }
    assert_eq!(Velocity::ZERO.direction(), DVec3::X);
    assert!(!along_x(5e-324).is_zero());
}

proptest! {
    #[test]
    fn rapidity_and_beta_agree(rapidity in 0.0..15.0_f64, x in -1.0..1.0_f64, y in -1.0..1.0_f64, z in 0.1..1.0_f64) {
        let direction = DVec3::new(x, y, z);
        let v = Velocity::from_rapidity(direction, rapidity).unwrap();
        near("rapidity", v.rapidity(), rapidity, 1e-14);
        near("tanh", v.speed(), libm::tanh(rapidity), 1e-15);
        // β determines 1 − β to half a unit in the last place, an error that γ² magnifies.
        if let Ok(by_beta) = Velocity::from_beta(v.beta()) {
            prop_assert!((by_beta.gamma() / v.gamma() - 1.0).abs() <= 1e-15 * v.gamma() * v.gamma());
        }
        let back = -v;
        prop_assert_eq!(back.proper(), -v.proper());
        prop_assert_eq!(back.gamma(), v.gamma());
    }
}
