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

/// Is the relative error of D above `bound`?
pub(crate) fn is_off(a: &Point, b: &Point, motion: &RelativeMotion, bound: f64) -> bool {
    if bound == f64::INFINITY {
        return false;
    }
    let chord = Chord::new(a, b, motion);
    // A cheaper bound without samples.
    let coarse = chord.total(chord.between_samples(1.0));
    coarse > bound && chord.total(chord.sampled()) > bound
}

/// An upper bound of the relative errors of D and 1/D, interpolated linearly along the edge. (E4)
pub(crate) fn error(a: &Point, b: &Point, motion: &RelativeMotion) -> f64 {
    let chord = Chord::new(a, b, motion);
    chord.total(chord.between_samples(1.0)).min(chord.total(chord.sampled()))
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
        let bend2 = in_plane * h2 * (4.0 - 3.0 * h2 / r2) / r2;
        let least = self.a.inverse_doppler.min(self.b.inverse_doppler);
        self.motion.proper_speed() * bend2.sqrt() * (length2 / r2) * (part * part / 8.0) / least
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
