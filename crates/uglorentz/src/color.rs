//! The error of the Doppler factor that a renderer interpolates along a chord.
//!
//! Programs downstream use D at the ends of an edge and interpolate linearly: wavelengths, which
//! are proportional to f = 1/D, and brightness, which depends on D. With f_lin and D_lin the
//! interpolants,
//!
//! ```text
//! D_lin f_lin = 1 + 4s(1 − s) q,     q = (f_b − f_a)²/(4 f_a f_b),
//! ```
//!
//! so with |f_lin − f| ≤ x f_lin both f_lin/f and D_lin/D are within q + (1 + q) x/(1 − x) of 1.
//! (E4)
//!
//! x is evaluated at samples. Between two of them, Δ of the edge apart, f_lin − f deviates from a
//! straight line by at most Δ²/8 times the largest f''. By (P10) f = γ(1 + v·d) with the direction
//! d, and along a chord of length L whose line passes the eye at h and whose points are at
//! distances of at least r,
//! |d''| ≤ L² h/r³ √(4 − 3h²/r²). So the result is an upper bound, not an estimate.

use glam::DVec3;
use ugphysics::doppler_at;

use crate::relative_motion::{Point, RelativeMotion};

/// The fraction of the bound used for edges. Inside a triangle a quadratic error is at most 4/3 of
/// the largest on its edges, for an equilateral one.
pub(crate) const EDGE_SHARE: f64 = 0.75;

/// The number of intervals between samples of an edge.
const N_PARTS: u32 = 8;

/// The largest D and 1/D that is resolved: visible light is then shifted from 4 mm, or from
/// 0.08 nm, and bodies of 0.3 K or 10⁷ K look like one of some 1000 K.
const MOST_SHIFT: f64 = 1e4;

/// The Lorentz factor, at 0.99995 c, above which the bound of û·d'' is used. Below, it saves few
/// pieces.
const FAST: f64 = 100.0;

/// Is the relative error of D above `bound`?
pub(crate) fn is_off(a: &Point, b: &Point, motion: &RelativeMotion, bound: f64) -> bool {
    if bound == f64::INFINITY {
        return false;
    }
    let chord = Chord::new(a, b, motion);
    // A cheaper bound without samples.
    let x = chord.between_samples(1.0);
    chord.total(x) > bound && !chord.is_out_of_range(x) && chord.total(chord.sampled()) > bound
}

/// An upper bound of the relative errors of D and 1/D, interpolated linearly along the edge. (E4)
pub(crate) fn error(a: &Point, b: &Point, motion: &RelativeMotion) -> f64 {
    let chord = Chord::new(a, b, motion);
    chord.rough_error().min(chord.total(chord.sampled()))
}

/// [`error`] without samples, which is larger or the same.
pub(crate) fn rough_error(a: &Point, b: &Point, motion: &RelativeMotion) -> f64 {
    Chord::new(a, b, motion).rough_error()
}

struct Chord<'a> {
    a: &'a Point,
    b: &'a Point,
    motion: &'a RelativeMotion,
    along: DVec3,
    q: f64,
}

impl<'a> Chord<'a> {
    fn new(a: &'a Point, b: &'a Point, motion: &'a RelativeMotion) -> Chord<'a> {
        let change = b.inverse_doppler - a.inverse_doppler;
        let q = change * change / (4.0 * a.inverse_doppler * b.inverse_doppler);
        Chord { a, b, motion, along: b.seen - a.seen, q }
    }

    /// (E4)
    fn total(&self, x: f64) -> f64 {
        if x >= 1.0 { f64::INFINITY } else { self.q + (1.0 + self.q) * x / (1.0 - x) }
    }

    fn rough_error(&self) -> f64 {
        let x = self.between_samples(1.0);
        if self.is_out_of_range(x) { 0.0 } else { self.total(x) }
    }

    /// Is D, on the whole chord, above [`MOST_SHIFT`] or below its inverse? `x`: an upper bound of
    /// |f_lin − f| over the smaller 1/D of the ends.
    fn is_out_of_range(&self, x: f64) -> bool {
        let (f_a, f_b) = (self.a.inverse_doppler, self.b.inverse_doppler);
        let (least, most) = (f_a.min(f_b), f_a.max(f_b));
        least * (1.0 - x) > MOST_SHIFT || (most + x * least) * MOST_SHIFT < 1.0
    }

    /// Upper bound of the deviation of f_lin − f from a straight line between samples this fraction
    /// of the edge apart, over f_lin.
    fn between_samples(&self, part: f64) -> f64 {
        let length2 = self.along.length_squared();
        let normal = self.a.seen.cross(self.along);
        let normal2 = normal.length_squared();
        if length2 == 0.0 || normal2 == 0.0 {
            // The edge has no length, or its line contains the eye.
            let is_through_eye = self.a.seen.dot(self.b.seen) < 0.0;
            return if is_through_eye { f64::INFINITY } else { 0.0 };
        }
        let h2 = normal2 / length2;
        let s = (-self.a.seen.dot(self.along) / length2).clamp(0.0, 1.0);
        let r2 = (self.a.seen + self.along * s).length_squared().max(h2);
        // The component of the velocity in the plane of the chord and the eye.
        let out = self.motion.direction().dot(normal);
        let in_plane = (1.0 - out * out / normal2).max(0.0);
        let mut bend = (in_plane * h2 * (4.0 - 3.0 * h2 / r2) / r2).sqrt();
        if self.motion.gamma() > FAST {
            let per_r = (h2 / r2).sqrt();
            let across = self.motion.direction().cross(self.along).length() / length2.sqrt();
            bend = bend.min(per_r * (2.0 * across + 3.0 * per_r));
        }
        let least = self.a.inverse_doppler.min(self.b.inverse_doppler);
        self.motion.proper_speed() * bend * (length2 / r2) * (part * part / 8.0) / least
    }

    fn sampled(&self) -> f64 {
        let (f_a, f_b) = (self.a.inverse_doppler, self.b.inverse_doppler);
        let at = |k: u32| {
            let s = f64::from(k) / f64::from(N_PARTS);
            let linear = (1.0 - s) * f_a + s * f_b;
            let exact = 1.0 / doppler_at(self.a.seen + self.along * s, self.motion.velocity());
            (linear - exact).abs() / linear
        };
        (1..N_PARTS).map(at).fold(0.0, f64::max) + self.between_samples(1.0 / f64::from(N_PARTS))
    }
}

#[cfg(test)]
mod tests {
    use ugphysics::Velocity;
    use ugscene::{BodyId, ShownEffects};

    use super::*;

    /// The error is no smaller than that of a thousand points of the chord, of which those count
    /// whose light is resolved; and pieces of a tenth of their distance have a finite one, however
    /// fast.
    #[test]
    fn the_error_is_a_bound_at_every_speed() {
        let step = |k: u32, seed: f64| (f64::from(k) * seed).fract() * 2.0 - 1.0;
        let mut n_finite = [0, 0];
        for k in 1..400_u32 {
            for gamma in [2.0, 99.0, 101.0, 1e4, 1e6, 6e7] {
                let v = Velocity::from_rapidity(DVec3::Y, libm::acosh(gamma)).unwrap();
                let motion = RelativeMotion::new(v, ShownEffects::default());
                // Around the point that is seen straight ahead, at every scale down to 1/γ.
                let scale = libm::pow(gamma, -f64::from(k % 7) / 6.0);
                let a = DVec3::new(step(k, 0.618_034), 0.0, step(k, 0.414_214)) * scale + DVec3::Y;
                let b =
                    a + DVec3::new(step(k, 0.236_068), 0.0, step(k, 0.645_751)) * (0.03 * scale);
                let [a, b] = [a, b].map(|p| Point::new(&motion, BodyId::from_index(0), p));
                let found = error(&a, &b, &motion);
                n_finite[usize::from(gamma > 1e3)] += u32::from(found < 0.1);
                for s in (0..=1000).map(|part| f64::from(part) / 1000.0) {
                    let exact = 1.0 / doppler_at(a.seen + (b.seen - a.seen) * s, v);
                    let linear = (1.0 - s) * a.inverse_doppler + s * b.inverse_doppler;
                    let is_resolved = (1.0 / MOST_SHIFT..MOST_SHIFT).contains(&exact);
                    let off = (linear / exact - 1.0).abs();
                    // Rounding of coordinates γ times as large as the distance from the axis.
                    let slack = 1e-12 + 1e-14 * gamma / scale;
                    assert!(!is_resolved || off <= found + slack, "{k} {gamma} {s}: {off} {found}");
                }
            }
        }
        assert!(n_finite[0] > 1000 && n_finite[1] > 1000, "{n_finite:?}");
    }
}
