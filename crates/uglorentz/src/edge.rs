//! The error of a straight line between two seen points, for a moving edge.
//!
//! An edge at rest in S' runs from a' to b'. Its point at parameter s is seen at C(s), eq. (P3).
//! Since (P3) is linear except for the length |p'|,
//!
//! ```text
//! C(s) − [(1 − s) C(0) + s C(1)] = γ v δ(s),      δ(s) = (1 − s)|a'| + s|b'| − |p'(s)| ≥ 0.      (E1)
//! ```
//!
//! So the true curve deviates from the chord that a renderer draws only along the motion, by a
//! closed form. Three rules test its visibility:
//!
//! 1. **outline**: the edge and the eye span a plane in S' with unit normal n'. By (P6) its
//!    directions d in S satisfy m·d + k = 0 with m = n' + (γ − 1)(n'·û)û, k = γ n'·v and |m|² − k² = 1: a circle on
//!    the sphere of directions, of geodesic curvature k. The chord is a great circle. The angle between
//!    the two is largest in the middle (E2) and must be within the bound;
//! 2. **depth**: the distance from C(s) to the chord in space, over |C(s)|, must be within the bound,
//!    since depth decides which face is occluded, and a decal is close in front of its wall. Its maximum
//!    is (E3);
//! 3. **colour**: D and 1/D interpolated linearly along the chord must agree with D in that
//!    direction ([`crate::color`]).
//!
//! The result depends on the two points, their body and the bound, not on the face, so faces that
//! share an edge agree. [`shows`] then decides for one piece. Derivations are in
//! `docs/geometry.md`.

use glam::DVec3;
use ugphysics::elongated;

use crate::color;
use crate::edge_errors::Errors;
use crate::relative_motion::{Point, RelativeMotion};
use crate::world_line::{self, Deviation};

/// The smallest bound of rule 2, a ten-thousandth of the distance; smaller for bodies far away
/// ([`crate::distant_bodies`]).
const LEAST_OFFSET: f64 = 1e-4;

/// Two directions with |d_a + d_b|² below this are opposite: the great circle through them is
/// undefined.
const OPPOSITE: f64 = 1e-12;

/// Bounds of the errors of a drawn edge.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tolerance {
    /// Tangent of half the bound of rule 1.
    pub tan_half: f64,
    /// Bound of rule 2.
    pub offset: f64,
    /// Rules 1 and 2 hold surely if |C − chord|/|C| is below this.
    pub safe: f64,
    /// Bound of rule 3; infinite for none.
    pub color: f64,
    /// Edges whose length is below this part of the distance of their nearer end are straight
    /// enough.
    shortest: f64,
}

impl Tolerance {
    /// `error`: the largest angle at the eye, radians, limited to a right angle. `color`: the
    /// largest relative error of D, infinite for any.
    pub(crate) fn new(error: f64, color: f64) -> Tolerance {
        let error = error.min(std::f64::consts::FRAC_PI_2);
        let offset = error.max(LEAST_OFFSET);
        let safe = libm::sin(error).min(offset);
        Tolerance {
            tan_half: libm::tan(error / 2.0),
            offset,
            safe,
            color: color * color::EDGE_SHARE,
            shortest: 0.0,
        }
    }

    /// Edges shorter than this angle at the eye, radians, are not cut.
    pub(crate) fn with_shortest(self, shortest: f64) -> Tolerance {
        Tolerance { shortest, ..self }
    }

    /// Are these two points, as seen, too close to each other to be told apart?
    fn is_short(&self, a: &Point, b: &Point) -> bool {
        let most = self.shortest * a.seen_distance.min(b.seen_distance);
        (b.seen - a.seen).length_squared() < most * most
    }

    /// The bounds for bodies on world lines.
    pub(crate) fn on_world_line(&self) -> Deviation {
        Deviation { tan_half: self.tan_half, offset: self.offset, color: self.color }
    }

    /// With the bound of rule 2 multiplied by `factor`, at most 1.
    pub(crate) fn with_depth(self, factor: f64) -> Tolerance {
        let offset = self.offset * factor;
        Tolerance { offset, safe: self.safe.min(offset), ..self }
    }
}

/// Is the error of an edge above the bound? Its ends must always be given in the same order.
pub(crate) fn bends(a: &Point, b: &Point, motion: &RelativeMotion, tolerance: &Tolerance) -> bool {
    if motion.is_at_rest() || tolerance.is_short(a, b) {
        return false;
    }
    if motion.world_line().is_some() {
        return world_line::exceeds(a, b, motion, tolerance.on_world_line());
    }
    (motion.has_flight_time() && leaves_chord(a, b, motion, tolerance))
        || color::is_off(a, b, motion, tolerance.color)
}

/// Which errors of an edge are visible.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Shown {
    /// All.
    All,
    /// An error of depth, the component normal to a piece: the number is [`slant`].
    OnPiece(f64),
    /// The outline, since its piece is seen as a line.
    Outline,
}

/// For an edge that bends: is this visible?
pub(crate) fn shows(
    a: &Point,
    b: &Point,
    motion: &RelativeMotion,
    tolerance: &Tolerance,
    shown: Shown,
) -> bool {
    if motion.is_at_rest() {
        return false;
    }
    // There is no closed form of the visible part of the error: all of it counts.
    if motion.world_line().is_some() {
        return true;
    }
    let leaves_chord = || {
        let edge = Edge::new(a, b, motion);
        edge.tan_half_sagitta() > tolerance.tan_half || edge.offset(shown) > tolerance.offset
    };
    let is_color_seen = !matches!(shown, Shown::Outline);
    (motion.has_flight_time() && leaves_chord())
        || (is_color_seen && color::is_off(a, b, motion, tolerance.color))
}

/// The largest component of the velocity normal to a drawn piece, at its corners: by (E1) an upper
/// bound for all points of the piece.
pub(crate) fn slant(corners: &[&Point], motion: &RelativeMotion) -> f64 {
    let n = corners.len();
    let at = |idx: usize| {
        let [before, here, next] = [idx + n - 1, idx, idx + 1].map(|idx| corners[idx % n].seen);
        (before - here).cross(next - here).normalize_or_zero().dot(motion.direction()).abs()
    };
    motion.velocity().speed() * (0..n).map(at).fold(0.0, f64::max)
}

/// All errors of an edge. `color`: the function for that of the colour, if the body is inertial.
pub(crate) fn errors(
    a: &Point,
    b: &Point,
    motion: &RelativeMotion,
    shown: Shown,
    color: impl Fn(&Point, &Point, &RelativeMotion) -> f64,
) -> Errors {
    if motion.is_at_rest() {
        return Errors::default();
    }
    if motion.world_line().is_some() {
        return world_line::errors(a, b, motion);
    }
    let color = if matches!(shown, Shown::Outline) { 0.0 } else { color(a, b, motion) };
    if !motion.has_flight_time() {
        return Errors { color, ..Errors::default() };
    }
    let edge = Edge::new(a, b, motion);
    Errors { angle: 2.0 * libm::atan(edge.tan_half_sagitta()), offset: edge.offset(shown), color }
}

/// The largest error of an edge relative to its bound; always finite.
pub(crate) fn excess(a: &Point, b: &Point, motion: &RelativeMotion, tolerance: &Tolerance) -> f64 {
    let Errors { angle, offset, color } = errors(a, b, motion, Shown::All, color::rough_error);
    let shape = (libm::tan(angle / 2.0) / tolerance.tan_half).max(offset / tolerance.offset);
    let relative =
        |error: f64| if tolerance.color == f64::INFINITY { 0.0 } else { error / tolerance.color };
    let mut color = relative(color);
    if color > shape && motion.world_line().is_none() {
        color = relative(color::error(a, b, motion));
    }
    color.max(shape).min(f64::MAX)
}

/// Rules 1 and 2.
fn leaves_chord(a: &Point, b: &Point, motion: &RelativeMotion, tolerance: &Tolerance) -> bool {
    let edge = Edge::new(a, b, motion);
    // δ ≤ w/(2 min(|a'|, |b'|)), and |C| is at least the smaller end distance minus γδ: by (E1) an
    // edge that passes this test is straight enough. Almost all edges of a fine mesh do.
    let delta = edge.w / (2.0 * a.rest_distance.min(b.rest_distance));
    let floor = a.seen_distance.min(b.seen_distance) - motion.gamma() * delta;
    if motion.proper_speed() * delta <= tolerance.safe * floor {
        return false;
    }
    edge.tan_half_sagitta() > tolerance.tan_half || edge.offset(Shown::All) > tolerance.offset
}

/// |p||q| − p·q of two vectors, given the product of their lengths.
pub(crate) fn lengths_less_dot(p: DVec3, q: DVec3, product: f64) -> f64 {
    let dot = p.dot(q);
    // The first form does not cancel for almost equal vectors.
    if dot > 0.0 { p.cross(q - p).length_squared() / (product + dot) } else { product - dot }
}

/// An edge of a moving body.
struct Edge<'a> {
    a: &'a Point,
    b: &'a Point,
    motion: &'a RelativeMotion,
    /// a', in rest coordinates that (P3) applies to.
    start: DVec3,
    /// b' − a'.
    along: DVec3,
    /// |a'||b'| − a'·b'.
    w: f64,
}

impl<'a> Edge<'a> {
    fn new(a: &'a Point, b: &'a Point, motion: &'a RelativeMotion) -> Edge<'a> {
        let (start, end) = (motion.boosted_rest(a.rest), motion.boosted_rest(b.rest));
        let along = end - start;
        let w = lengths_less_dot(start, end, a.rest_distance * b.rest_distance);
        Edge { a, b, motion, start, along, w }
    }

    /// tan(σ/2), where σ is the largest angle between the seen arc and the chord's great circle.
    ///
    /// With 2η the angle between the ends and g the unit normal d_a × d_b of the great circle, the
    /// midpoint of the arc is cos σ h + sin σ g (h bisects the angle). Inserted into m·d + k = 0,
    /// with m·h = −k/cos η and |m|² = 1 + k², this is a quadratic in tan(σ/2) with discriminant 1,
    /// and
    ///
    /// ```text
    /// tan(σ/2) = |k| (1/cos η − 1)/(1 + m·g) = (1 − m·g)/(|k| (1/cos η + 1)).      (E2)
    /// ```
    ///
    /// m·g is negative if the arc is the longer part of its circle; the second form is for that
    /// case.
    fn tan_half_sagitta(&self) -> f64 {
        let Some(rest_normal) = self.start.cross(self.along).try_normalize() else {
            return 0.0; // The edge points at the eye and is seen as a point.
        };
        let direction = self.motion.direction();
        let k = (self.motion.proper_speed() * rest_normal.dot(direction)).abs();
        let m = elongated(rest_normal, self.motion.velocity());

        let (d_a, d_b) = (self.a.seen / self.a.seen_distance, self.b.seen / self.b.seen_distance);
        let (sum, difference) = (d_a + d_b, d_b - d_a);
        if sum.length_squared() < OPPOSITE {
            return f64::INFINITY;
        }
        let Some(chord_normal) = d_a.cross(difference).try_normalize() else {
            return 0.0;
        };
        let tan2_eta = difference.length_squared() / sum.length_squared();
        let sec_eta = (1.0 + tan2_eta).sqrt();
        let side = m.dot(chord_normal).clamp(-1.0, 1.0);
        if side >= 0.0 {
            k * (tan2_eta / (1.0 + sec_eta)) / (1.0 + side)
        } else {
            (1.0 - side) / (k * (1.0 + sec_eta))
        }
    }

    /// Largest distance of the true curve from the chord over its distance from the eye.
    ///
    /// With x the position on the line of the edge, h the distance of the line from the eye,
    /// r = √(h² + x²) = |p'|, B = (|b'| − |a'|)/L, Q = v·l, and A and P the values at x = 0, it is
    /// γ|v × chord| times the largest
    ///
    /// ```text
    /// λ/γ = δ/|C| = (A + Bx − r)/γ(r − P − Qx).
    /// ```
    ///
    /// In the plane (x, r) each value of λ is a straight line, and the largest is the tangent of
    /// the hyperbola: a quadratic whose last term is exactly (w/L)², so that it does not cancel for
    /// short edges:
    ///
    /// ```text
    /// λ = (w/L)²/(e + √(e² + (w/L)²(h²(1 − Q²) − P²))),      e = h²(1 − BQ) − AP.      (E3)
    /// ```
    ///
    /// In a piece of a face only the component normal to it is visible.
    fn offset(&self, shown: Shown) -> f64 {
        let length = self.along.length();
        let chord = (self.b.seen - self.a.seen).normalize_or_zero();
        let beta = self.motion.velocity().beta();
        let across = beta.cross(chord).length();
        let across = match shown {
            Shown::All => across,
            Shown::OnPiece(slant) => across.min(slant),
            Shown::Outline => 0.0,
        };
        let term = (self.w / length) * (self.w / length);
        if across == 0.0 || term.is_nan() || term <= 0.0 {
            return 0.0;
        }
        let line = self.along / length;
        let x = self.start.dot(line);
        let foot = self.start - line * x;
        let h2 = foot.length_squared();
        let slope = (self.along.dot(self.start + self.start + self.along) / length)
            / (self.a.rest_distance + self.b.rest_distance);
        let (at_foot, p, q) = (self.a.rest_distance - slope * x, beta.dot(foot), beta.dot(line));
        let e = h2 * (1.0 - slope * q) - at_foot * p;
        let square = (e * e + term * (h2 * (1.0 - q * q) - p * p)).max(0.0);
        across * term / (e + square.sqrt()).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use ugphysics::Velocity;
    use ugscene::{BodyId, ShownEffects};

    use super::*;

    fn motion(beta: DVec3) -> RelativeMotion {
        RelativeMotion::new(Velocity::from_beta(beta).unwrap(), ShownEffects::default())
    }

    fn at(motion: &RelativeMotion, rest: DVec3) -> Point {
        Point::new(motion, BodyId::from_index(0), rest)
    }

    /// The sagitta by bisection: the point of the true curve seen at equal angles from both ends.
    fn sagitta(a: DVec3, b: DVec3, motion: &RelativeMotion) -> f64 {
        let seen = |s: f64| at(motion, a.lerp(b, s)).seen.normalize();
        let (d_a, d_b) = (seen(0.0), seen(1.0));
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..100 {
            let s = (low + high) / 2.0;
            *(if seen(s).dot(d_b - d_a) < 0.0 { &mut low } else { &mut high }) = s;
        }
        let middle = seen((low + high) / 2.0);
        let across = middle.dot(d_a.cross(d_b).normalize());
        libm::atan2(across.abs(), middle.dot((d_a + d_b).normalize()))
    }

    #[test]
    fn the_sagitta_is_that_of_the_true_curve() {
        fn check(a: DVec3, b: DVec3, beta: DVec3) -> f64 {
            let motion = motion(beta);
            let (p, q) = (at(&motion, a), at(&motion, b));
            let found = 2.0 * libm::atan(Edge::new(&p, &q, &motion).tan_half_sagitta());
            let expected = sagitta(a, b, &motion);
            assert!((found - expected).abs() < 1e-9, "{a} {b} {beta}: {found} {expected}");
            found
        }
        let step = |k: u32, seed: f64| (f64::from(k) * seed).fract() * 2.0 - 1.0;
        let mut largest: f64 = 0.0;
        for k in 1..400 {
            let a = DVec3::new(step(k, 0.618_034), step(k, 0.414_214), step(k, 0.732_051));
            let b = DVec3::new(step(k, 0.236_068), step(k, 0.645_751), step(k, 0.316_625));
            for speed in [1e-3, 0.5, 0.99] {
                largest = largest.max(check(a * 3.0, b * 3.0, DVec3::new(0.6, 0.0, 0.8) * speed));
            }
        }
        assert!(largest > 1.5, "arcs beyond half their circle are among them: {largest}");
    }

    #[test]
    fn opposite_and_degenerate_edges() {
        let motion = motion(DVec3::X * 0.9);
        let tolerance = Tolerance::new(0.25e-3, 2e-3);
        let bends = |a, b| bends(&at(&motion, a), &at(&motion, b), &motion, &tolerance);
        assert!(bends(DVec3::Y, -DVec3::Y), "through the eye");
        assert!(bends(DVec3::X, -DVec3::X), "through the eye, along the motion");
        assert!(!bends(DVec3::Y, DVec3::Y), "no length");
        assert!(!bends(DVec3::ONE, DVec3::splat(7.0)), "seen end-on");
        assert!(!bends(DVec3::splat(f64::NAN), DVec3::ONE));
        assert!(
            bends(DVec3::new(-1e-3, 1e-6, 0.0), DVec3::new(1e-3, 1e-6, 0.0)),
            "size does not matter"
        );
    }
}
