//! 200-bit arithmetic: vectors, velocities and the formulas of the papers, written literally.

use dashu_float::round::mode::HalfEven;
use glam::DVec3;

pub type Big = dashu_float::FBig<HalfEven, 2>;
pub type BigVector = [Big; 3];

const PRECISION: usize = 200;

/// Exactly `x`, with 200 bits of precision.
pub fn big(x: f64) -> Big {
    Big::try_from(x).expect("tests compute with finite numbers").with_precision(PRECISION).value()
}

pub fn vector(v: DVec3) -> BigVector {
    v.to_array().map(big)
}

pub fn dot(a: &BigVector, b: &BigVector) -> Big {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

/// a + s b
pub fn add_scaled(a: &BigVector, s: &Big, b: &BigVector) -> BigVector {
    [0, 1, 2].map(|i| &a[i] + s * &b[i])
}

pub fn length(a: &BigVector) -> Big {
    dot(a, a).sqrt()
}

/// |got − want| / |want|
pub fn relative_error(got: f64, want: &Big) -> f64 {
    let error = ((big(got) - want) / want).to_f64().value();
    error.abs()
}

/// |got − want| / |want|
pub fn relative_vector_error(got: DVec3, want: &BigVector) -> f64 {
    let difference = add_scaled(&vector(got), &big(-1.0), want);
    (length(&difference) / length(want)).to_f64().value()
}

/// A velocity, given by its direction and β.
pub struct BigVelocity {
    pub axis: BigVector,
    pub beta: Big,
}

impl BigVelocity {
    pub fn from_beta(beta: DVec3) -> BigVelocity {
        let beta = vector(beta);
        let speed = length(&beta);
        BigVelocity { axis: beta.map(|x| x / &speed), beta: speed }
    }

    pub fn from_rapidity(direction: DVec3, rapidity: f64) -> BigVelocity {
        let direction = vector(direction);
        let speed = length(&direction);
        let square = (big(2.0) * big(rapidity)).exp();
        let beta = (&square - big(1.0)) / (&square + big(1.0));
        BigVelocity { axis: direction.map(|x| x / &speed), beta }
    }

    pub fn gamma(&self) -> Big {
        big(1.0) / self.one_minus_square().sqrt()
    }

    pub fn one_minus_square(&self) -> Big {
        big(1.0) - &self.beta * &self.beta
    }

    fn velocity(&self) -> BigVector {
        self.axis.clone().map(|x| x * &self.beta)
    }

    /// (P1) and (P2): the report's two steps, {2.1.5} and {2.2.7}.
    pub fn seen_by_the_report(&self, p_rest: DVec3) -> BigVector {
        let p = vector(p_rest);
        let shrink = big(1.0) / self.gamma() - big(1.0);
        let now = add_scaled(&p, &(shrink * dot(&p, &self.axis)), &self.axis);
        add_scaled(&now, &self.flight_time(&now), &self.velocity())
    }

    /// {2.2.6}
    pub fn flight_time(&self, now: &BigVector) -> Big {
        let approach = dot(now, &self.velocity());
        let root = (&approach * &approach + self.one_minus_square() * dot(now, now)).sqrt();
        (approach - root) / self.one_minus_square()
    }

    /// (P4): the boost of (−|p|, p) with −v.
    pub fn rest(&self, p_seen: DVec3) -> BigVector {
        let p = vector(p_seen);
        let gamma = self.gamma();
        let along = (&gamma - big(1.0)) * dot(&p, &self.axis) + &gamma * &self.beta * length(&p);
        add_scaled(&p, &along, &self.axis)
    }

    /// (P10), {3.1.3}
    pub fn doppler(&self, to_observer: DVec3) -> Big {
        let n = vector(to_observer);
        let cos = dot(&n, &self.axis) / length(&n);
        self.one_minus_square().sqrt() / (big(1.0) - &self.beta * cos)
    }
}
