//! The error inside a flat piece: its distance from the true, curved image of the face.
//!
//! By (P3) the point Σλ_i p_i' of a face is seen at the same mean of the seen corners, minus γ v δ,
//! where
//!
//! ```text
//! δ = Σ λ_i |p_i'| − |Σ λ_i p_i'|        and its maximum is        min over |u| ≤ 1 of max over i of |p_i'| − u·p_i'.      (E5)
//! ```
//!
//! by the minimax theorem, since |p| is the largest of u·p. Any u gives an upper bound, which
//! accepts most small pieces, with their edges, at once ([`crate::early_accept`]). At a maximum
//! inside a triangle δ is stationary: u is then the direction of p, and the three differences are
//! equal.

use glam::DVec3;

use crate::relative_motion::{Point, RelativeMotion};

/// Upper bound of the distance of the true face from the flat triangle over its distance from the
/// eye, at the inner point where δ is largest; 0 if that is on an edge.
pub(crate) fn offset(motion: &RelativeMotion, corners: [&Point; 3]) -> f64 {
    let Some(delta) = largest_delta(corners.map(|corner| motion.boosted_rest(corner.rest))) else {
        return 0.0;
    };
    let [a, b, c] = corners.map(|corner| corner.seen);
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let across = motion.proper_speed() * normal.dot(motion.direction()).abs();
    let nearest = corners.iter().map(|corner| corner.seen_distance).fold(f64::INFINITY, f64::min);
    let floor = nearest - motion.gamma() * delta;
    if floor > 0.0 {
        across * delta / floor
    } else if across > 0.0 {
        f64::INFINITY
    } else {
        0.0
    }
}

/// The largest δ, if it is inside the triangle.
fn largest_delta([a, b, c]: [DVec3; 3]) -> Option<f64> {
    let (ab, ac) = (b - a, c - a);
    let normal = ab.cross(ac);
    let normal2 = normal.length_squared();
    let length = a.length();
    // |b| − |a| and |c| − |a|, without cancellation.
    let further = |p: DVec3, step: DVec3| step.dot(p + a) / (p.length() + length);
    let (to_b, to_c) = (further(b, ab), further(c, ac));
    // The part of u in the triangle's plane, from u·ab and u·ac.
    let flat = (ac.cross(normal) * to_b + normal.cross(ab) * to_c) / normal2;
    let rest2 = 1.0 - flat.length_squared();
    if rest2.is_nan() || rest2 < 0.0 {
        return None; // No stationary point, or no area.
    }
    let unit = normal / normal2.sqrt();
    let height = unit.dot(a);
    let out = rest2.sqrt() * if height < 0.0 { -1.0 } else { 1.0 };
    // Where the ray along u intersects the plane; the eye itself if the plane contains it.
    let place = (flat + unit * out) * (height / out);
    let place = if place.is_finite() { place } else { DVec3::ZERO };
    let is_left_of = |p: DVec3, q: DVec3| (q - p).cross(place - p).dot(normal) > 0.0;
    if !(is_left_of(a, b) && is_left_of(b, c) && is_left_of(c, a)) {
        return None;
    }
    let along = flat + unit * out;
    Some(crate::edge::lengths_less_dot(a, along, length).max(0.0))
}
