//! Laws that hold for every body, direction and speed, tested on random ones.

use glam::{DQuat, DVec3, Vec3Swizzles};
use proptest::prelude::*;
use ugphysics::{
    Event, Lorentz, Velocity, aberrate, compose, contracted, doppler_at, doppler_factor,
    flight_time, observer_shift, rest_position, seen_event, seen_position, wigner_rotation,
};

use crate::{along_x, angle_deg, directions, near, near_vector};

/// Velocities of rapidity 0…4 (up to β = 0.9993, γ = 27) in all directions.
fn velocities() -> impl Strategy<Value = Velocity> {
    velocities_up_to(4.0)
}

fn velocities_up_to(rapidity: f64) -> impl Strategy<Value = Velocity> {
    (unit_vectors(), 0.0..rapidity).prop_map(|(axis, rapidity)| {
        Velocity::from_rapidity(axis, rapidity).expect("small rapidities are accepted")
    })
}

fn unit_vectors() -> impl Strategy<Value = DVec3> {
    (-1.0..1.0_f64, -std::f64::consts::PI..std::f64::consts::PI).prop_map(|(z, turn)| {
        let (sin, cos) = libm::sincos(turn);
        let ring = (1.0 - z * z).sqrt();
        DVec3::new(ring * cos, ring * sin, z)
    })
}

fn points() -> impl Strategy<Value = DVec3> {
    (unit_vectors(), 0.1..100.0_f64).prop_map(|(direction, distance)| distance * direction)
}

/// A tolerance of a few roundings, magnified by `factor`.
fn rounding(factor: f64) -> f64 {
    1e-15 * factor
}

proptest! {

    /// (P6) as written, and as the direction of (P3) and (P4).
    #[test]
    fn aberration_is_the_direction_of_the_boost(d in unit_vectors(), v in velocities()) {
        let axis = v.direction();
        let plain = d + (v.gamma() - 1.0) * d.dot(axis) * axis + v.gamma() * v.beta();
        let tolerance = rounding(8.0 * v.gamma() * v.gamma());
        near_vector("(P6)", aberrate(d, v), plain.normalize(), tolerance);
        let seen = seen_position(5.0 * d, v).normalize();
        near_vector("direction of (P3)", aberrate(d, -v), seen, rounding(4.0));
        near("unit", aberrate(d, v).length(), 1.0, rounding(1.0));
    }

    /// Light out of a moving body and into another that moves with it is not shifted.
    #[test]
    fn doppler_shifts_in_and_out_cancel(n in unit_vectors(), v in velocities()) {
        let out = doppler_factor(n, v);
        let n_in_body = -aberrate(-n, v);
        let back_in = doppler_factor(n_in_body, -v);
        near("D D", out * back_in, 1.0, rounding(8.0 * v.gamma()));
    }

    /// Factors along a chain of frames multiply to that of the composed velocity.
    #[test]
    fn doppler_factors_multiply(n in unit_vectors(), u in velocities(), v in velocities()) {
        let n_in_frame = -aberrate(-n, v);
        let chain = doppler_factor(n_in_frame, u) * doppler_factor(n, v);
        let at_once = doppler_factor(n, compose(u, v));
        near("D", chain / at_once, 1.0, rounding(32.0 * u.gamma() * v.gamma()));
    }

    /// The velocity of a product of boosts is the composed velocity, and γ composes too.
    #[test]
    fn matrices_compose_velocities(u in velocities(), v in velocities()) {
        let product = Lorentz::boost(u).then(Lorentz::boost(v));
        let sum = compose(u, v);
        let by_matrix = product.velocity_of_frame().unwrap();
        let scale = rounding(32.0 * u.gamma() * v.gamma());
        prop_assert!((by_matrix.proper() - sum.proper()).length() <= scale);
        near("gamma", sum.gamma(), u.gamma() * v.gamma() * (1.0 + u.beta().dot(v.beta())), scale);
        let turned = compose(v, u);
        near("same speed", turned.gamma() / sum.gamma(), 1.0, rounding(32.0 * u.gamma() * v.gamma()));
    }

    /// (P15) as written, on velocities of moderate speed.
    #[test]
    fn composition_is_the_plain_formula(
        a in unit_vectors(), b in unit_vectors(), s in 0.01..0.95_f64, t in 0.01..0.95_f64,
    ) {
        let (u, v) = (Velocity::from_beta(s * a).unwrap(), Velocity::from_beta(t * b).unwrap());
        let (ub, vb, shrink) = (u.beta(), v.beta(), 1.0 / v.gamma());
        let dot = ub.dot(vb);
        let plain = (ub * shrink + ((1.0 - shrink) * dot / vb.length_squared() - 1.0) * vb) / (1.0 - dot);
        prop_assert!((compose(u, -v).beta() - plain).length() < 1e-13);
        prop_assert!((compose(compose(u, v), -v).beta() - ub).length() < 1e-13);
    }

    /// Boosts: identity and inverse, rapidities of parallel boosts add, and the light cone is
    /// preserved.
    #[test]
    fn group_law(v in velocities(), rapidity in -3.0..3.0_f64, t in -5.0..5.0_f64, x in points()) {
        let event = Event { t, x };
        let there_and_back = Lorentz::boost(-v) * Lorentz::boost(v);
        let size = t.abs() + x.length();
        let tolerance = rounding(16.0 * v.gamma() * v.gamma()) * size;
        let same = there_and_back.apply(event);
        prop_assert!((same.x - x).length() + (same.t - t).abs() <= tolerance);
        let by_inverse = Lorentz::boost(v).then(Lorentz::boost(v).inverse()).apply(event);
        prop_assert!((by_inverse.x - x).length() + (by_inverse.t - t).abs() <= tolerance);

        let parallel = Velocity::from_rapidity(v.direction(), rapidity).unwrap();
        let sum = compose(v, parallel).proper().dot(v.direction());
        let want = libm::sinh(v.rapidity() + rapidity);
        prop_assert!((sum - want).abs() <= rounding(16.0 * v.gamma() * parallel.gamma()));

        let moved = Lorentz::boost(v).apply(event);
        let interval = |e: Event| e.x.length_squared() - e.t * e.t;
        prop_assert!((interval(moved) - interval(event)).abs() <= tolerance * size);
    }

    /// Two boosts are the boost of the composed velocity, after the Wigner rotation. (P25)
    #[test]
    fn two_boosts_are_a_rotation_and_a_boost(
        p in points(), t in -50.0..50.0_f64, u in velocities_up_to(2.0), v in velocities_up_to(2.0),
    ) {
        let event = Event { t, x: p };
        let want = Lorentz::boost(u).then(Lorentz::boost(v)).apply(event);
        let turned = Event { t, x: wigner_rotation(u, v) * p };
        let got = Lorentz::boost(compose(u, v)).apply(turned);
        // Both γ are below 4, so components grow by up to a factor 30.
        let tolerance = rounding(30.0 * 4.0) * (p.length() + t.abs());
        prop_assert!((got.x - want.x).length() <= tolerance && (got.t - want.t).abs() <= tolerance);
    }

    /// The same rotation from the composed velocity, and its inverse, at speeds where matrices lose
    /// all digits.
    #[test]
    fn wigner_rotations_undo_each_other(u in velocities_up_to(12.0), v in velocities_up_to(12.0), d in unit_vectors()) {
        let turned = wigner_rotation(u, v) * d;
        near_vector("swapped", wigner_rotation(v, u) * turned, d, 1e-14);
        // Subtracting v again from a sum dominated by it magnifies rounding.
        let w = compose(u, v);
        prop_assume!(w.gamma() * v.gamma() < 1e6 * u.gamma());
        near_vector("undone", wigner_rotation(w, -v) * turned, d, rounding(16.0) * w.gamma() * v.gamma());
    }

    #[test]
    fn scale_does_not_matter(p in points(), v in velocities(), exponent in -900..900_i32) {
        let scale = libm::ldexp(1.0, exponent);
        prop_assert_eq!(seen_position(p * scale, v), seen_position(p, v) * scale);
        prop_assert_eq!(contracted(p * scale, v), contracted(p, v) * scale);
        prop_assert_eq!(flight_time(p * scale, v), flight_time(p, v) * scale);
        prop_assert_eq!(doppler_at(p * scale, v), doppler_at(p, v));
        prop_assert_eq!(aberrate(p * scale, v), aberrate(p, v));
    }
}

/// Directions in S of the outline of a sphere that, in its rest frame, is centred along `centre`
/// with angular radius asin `sine`.
pub fn sphere_outline(centre: DVec3, sine: f64, v: Velocity, n_points: u32) -> Vec<DVec3> {
    let (side, up) = centre.any_orthonormal_pair();
    let cosine = (1.0 - sine * sine).sqrt();
    let rim = (0..n_points).map(|i| {
        let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(i) / f64::from(n_points));
        cosine * centre + sine * (cos * side + sin * up)
    });
    rim.map(|d| aberrate(d, -v)).collect()
}

/// The axis and the angular radius in degrees of the circle through three directions, chosen far
/// apart since aberration crowds them.
pub fn circle_through(directions: &[DVec3]) -> (DVec3, f64) {
    let furthest = |measure: &dyn Fn(DVec3) -> f64| {
        directions
            .iter()
            .copied()
            .max_by(|&p, &q| measure(p).total_cmp(&measure(q)))
            .unwrap_or_default()
    };
    let a = directions[0];
    let b = furthest(&|p| (p - a).length());
    let c = furthest(&|p| (p - a).cross(b - a).length());
    let normal = (b - a).cross(c - a).normalize();
    let axis = if normal.dot(a) < 0.0 { -normal } else { normal };
    (axis, angle_deg(axis, a))
}

#[test]
fn at_rest_everything_is_the_identity_to_the_bit() {
    for p in directions() {
        let p = 12.3 * p;
        assert_eq!(seen_position(p, Velocity::ZERO), p);
        assert_eq!(rest_position(p, Velocity::ZERO), p);
        assert_eq!(contracted(p, Velocity::ZERO), p);
        assert_eq!(observer_shift(Velocity::ZERO, 7.0), DVec3::ZERO);
        assert_eq!(doppler_at(p, Velocity::ZERO), 1.0);
        assert_eq!(Lorentz::boost(Velocity::ZERO), Lorentz::IDENTITY);
        near("time", seen_event(p, Velocity::ZERO).t, -p.length(), 1e-15);
    }
}

#[test]
fn the_eye_itself_stays_where_it_is() {
    for v in [Velocity::ZERO, along_x(0.9)] {
        assert_eq!(seen_event(DVec3::ZERO, v), Event { t: 0.0, x: DVec3::ZERO });
        assert_eq!(rest_position(DVec3::ZERO, v), DVec3::ZERO);
        assert_eq!(contracted(DVec3::ZERO, v), DVec3::ZERO);
        assert_eq!(flight_time(DVec3::ZERO, v), 0.0);
        assert_eq!(aberrate(DVec3::ZERO, v), DVec3::ZERO);
        assert_eq!(doppler_at(DVec3::ZERO, v), 1.0 / v.gamma());
    }
}

#[test]
fn every_size_and_speed_gives_a_finite_answer() {
    let fastest =
        Velocity::from_rapidity(DVec3::new(1.0, 2.0, -2.0), Velocity::MAX_RAPIDITY).unwrap();
    let slowest = Velocity::from_beta(DVec3::new(0.0, 5e-324, 0.0)).unwrap();
    for v in [fastest, -fastest, slowest] {
        for size in [5e-324, 1e-310, 1e-200, 1.0, 1e200] {
            for p in directions().into_iter().map(|d| d * size).filter(|&p| p != DVec3::ZERO) {
                let seen = seen_event(p, v);
                assert!(seen.x.is_finite() && seen.t.is_finite(), "{p:?} {v:?}");
                assert!(
                    contracted(p, v).is_finite() && flight_time(p, v).is_finite(),
                    "{p:?} {v:?}"
                );
                let doppler = doppler_at(p, v);
                assert!(doppler.is_finite() && doppler > 0.0, "{p:?} {v:?}");
                near("unit", aberrate(p, v).length(), 1.0, rounding(1.0));
            }
        }
        for p in [DVec3::new(f64::NAN, 0.0, 0.0), DVec3::new(0.0, f64::INFINITY, 1.0)] {
            assert!(seen_event(p, v).x.is_nan() && seen_event(p, v).t.is_nan());
            assert!(
                doppler_at(p, v).is_nan() && flight_time(p, v).is_nan() && aberrate(p, v).is_nan()
            );
        }
    }
}

#[test]
fn coordinates_across_an_axis_pass_to_the_bit() {
    // There is no threshold: even the smallest velocity displaces a point abeam.
    assert_eq!(seen_position(DVec3::Y, along_x(1e-300)).x, -1e-300);
    for speed in [0.1, 0.3, 0.9, 0.999_999] {
        for p in directions() {
            let p = 0.3 * p;
            for v in [along_x(speed), along_x(-speed)] {
                assert_eq!(seen_position(p, v).yz(), p.yz());
                assert_eq!(contracted(p, v).yz(), p.yz());
            }
        }
    }
}

#[test]
fn solid_angle_goes_as_the_square_of_d() {
    // dΩ' = D² dΩ: the Jacobian of aberration by central differences, good to h² and 10⁻¹⁶/h.
    let h = 1e-5;
    for speed in [0.1, 0.5, 0.9] {
        let v = along_x(speed);
        for d in directions() {
            let (a, b) = d.any_orthonormal_pair();
            let along = |e: DVec3| (aberrate(d + h * e, v) - aberrate(d - h * e, v)) / (2.0 * h);
            let jacobian = along(a).cross(along(b)).length();
            let doppler = doppler_factor(-d, v);
            near("solid angle", jacobian / (doppler * doppler), 1.0, 1e-8);
        }
    }
}

#[test]
fn collinear_motions_give_no_rotation() {
    let v = along_x(0.9);
    for u in [Velocity::ZERO, v, -v, along_x(0.999_999), along_x(-1e-9)] {
        assert_eq!(wigner_rotation(u, v), DQuat::IDENTITY);
        assert_eq!(wigner_rotation(v, u), DQuat::IDENTITY);
    }
}

#[test]
fn composition_saturates_and_matrices_return_errors() {
    let fast = Velocity::from_rapidity(DVec3::X, 90.0).unwrap();
    assert_eq!(compose(fast, fast).rapidity(), Velocity::MAX_RAPIDITY);
    assert!(Lorentz::boost(fast).then(Lorentz::boost(fast)).velocity_of_frame().is_err());
    // The sum of opposite motions near the speed of light is right to rounding.
    let slower = Velocity::from_rapidity(DVec3::NEG_X, 89.5).unwrap();
    near("90 − 89.5", compose(fast, slower).rapidity(), 0.5, 1e-12);
}
