//! (P2), (P3), (P4) and (P10) against the papers' formulas at 200 bits.

use glam::DVec3;
use ugphysics::{Velocity, doppler_at, doppler_factor, flight_time, rest_position, seen_event};

use crate::big::{BigVelocity, length, relative_error, relative_vector_error, vector};
use crate::directions;

/// The largest errors found, relative to the true value.
#[derive(Debug, Default)]
struct Worst {
    seen: f64,
    time: f64,
    rest: f64,
    doppler: f64,
    doppler_at: f64,
    flight: f64,
    n_cases: usize,
}

impl Worst {
    fn look(&mut self, v: Velocity, exact: &BigVelocity) {
        let raise = |worst: &mut f64, error: f64| *worst = worst.max(error);
        for p in points(v.direction(), v.gamma()) {
            let seen = seen_event(p, v);
            let want = exact.seen_by_the_report(p);
            raise(&mut self.seen, relative_vector_error(seen.x, &want));
            raise(&mut self.time, relative_error(-seen.t, &length(&want)));
            raise(&mut self.rest, relative_vector_error(rest_position(p, v), &exact.rest(p)));
            raise(&mut self.doppler, relative_error(doppler_factor(p, v), &exact.doppler(p)));
            raise(&mut self.doppler_at, relative_error(doppler_at(p, v), &exact.doppler(-p)));
            raise(
                &mut self.flight,
                relative_error(flight_time(p, v), &exact.flight_time(&vector(p))),
            );
            self.n_cases += 1;
        }
    }

    #[track_caller]
    fn check(&self, least_cases: usize, tolerance: f64, flight_tolerance: f64) {
        let well_conditioned = [self.seen, self.time, self.rest, self.doppler, self.doppler_at];
        assert!(well_conditioned.iter().all(|&error| error <= tolerance), "{self:?}");
        assert!(self.flight <= flight_tolerance, "{self:?}");
        assert!(self.n_cases >= least_cases, "{self:?}");
    }
}

/// Points in all directions, and near the line of motion, where cancellation would show: at angles
/// from 10⁻¹² to well beyond 1/γ.
fn points(axis: DVec3, gamma: f64) -> Vec<DVec3> {
    let mut all: Vec<DVec3> =
        directions().into_iter().map(|d| 3.7 * d + DVec3::new(0.2, -0.1, 0.05)).collect();
    let aside = axis.any_orthonormal_vector();
    for angle in [0.0, 1e-12, 1e-9, 1e-6, 0.1 / gamma, 1.0 / gamma, 3.0 / gamma, 0.01, 0.3, 1.0] {
        all.push(7.3 * (axis + angle * aside));
        all.push(-7.3 * (axis + angle * aside));
    }
    all
}

#[test]
fn velocities_given_as_beta() {
    let mut worst = Worst::default();
    for speed in [1e-12, 1e-6, 0.001, 0.1, 0.5, 0.9, 0.99, 0.999, 0.999_999] {
        for direction in directions().into_iter().step_by(3) {
            let beta = speed * direction;
            worst.look(Velocity::from_beta(beta).unwrap(), &BigVelocity::from_beta(beta));
        }
    }
    // Measured: 7.6·10⁻¹⁶. (P2) contains a plain scalar product, which can cost a factor γ = 707.
    worst.check(13_000, 2e-15, 2e-13);
}

#[test]
fn velocities_given_as_rapidity() {
    let mut worst = Worst::default();
    // The third is 1 − β = 10⁻¹², the last 1 − β = 8·10⁻¹⁸, closer to 1 than any double below 1.
    let near_light = 0.5 * libm::log((2.0 - 1e-12) / 1e-12);
    for rapidity in [1e-9, 3.0, near_light, 20.0] {
        for direction in directions().into_iter().step_by(3) {
            let v = Velocity::from_rapidity(direction, rapidity).unwrap();
            worst.look(v, &BigVelocity::from_rapidity(direction, rapidity));
        }
    }
    worst.check(5_000, 2e-15, 1e-11);
}
