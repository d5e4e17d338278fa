//! Faces seen edge-on: their plane contains the eye, so they have no area in the picture.
//!
//! All their points are seen on one circle of directions (P8), so only the outline and its depth
//! are visible. Such a face keeps its contours, with the new corners of its edges, and is not
//! subdivided inside, which would take unlimited pieces close to the eye.

use glam::DVec3;
use ugscene::{Face, Scene, VertexId};

use crate::DEFAULT_ERROR;
use crate::relative_motion::{Point, RelativeMotion};

/// The distance of the eye from a plane that contains it, up to rounding, over the largest distance
/// of a corner.
const FLAT: f64 = 1e-12;

/// The smallest distance of edges from the eye, over the largest distance of a corner.
const CLEAR: f64 = 1e-9;

/// Is the face seen edge-on, so that its outline alone draws it?
///
/// If it moves out of its plane, the circle is a small circle, and an outline around the eye would
/// enclose the inside of that circle. Such a face does not count.
pub(crate) fn is_edge_on(
    scene: &Scene,
    face: &Face,
    motion: &RelativeMotion,
    rest: impl Fn(VertexId) -> DVec3,
) -> bool {
    let corners = || scene.face_corners(face).iter().map(|&corner| rest(corner));
    let Some(outline) = scene.face_contours(face).next() else { return false };
    let normal = ugscene::unit_normal(outline.iter().map(|&corner| rest(corner)));
    if normal == DVec3::ZERO {
        return false;
    }
    let reach = corners().map(|corner| corner.length()).fold(0.0, f64::max);
    if !corners().all(|corner| normal.dot(corner).abs() <= FLAT * reach) {
        return false;
    }
    let slides = motion.proper_speed() * normal.dot(motion.direction()).abs() <= FLAT;
    slides || is_beside_eye(outline.iter().map(|&corner| rest(corner)), normal, CLEAR * reach)
}

/// Is a flat piece seen as a line, by `angle` at the eye?
///
/// With n' and k as in (P8) and h' the distance of its plane from the eye, the piece is seen where
/// m·d + k = h'/|p|, since (P3) is linear. This is a band along the circle m·d + k = 0, whose width
/// is h'/|p| to first order if h'|m|/|p| is small, since the radius of the circle is 1/|m|. It
/// counts as a line if it is narrower than a quarter of the angle and of a tenth of a milliradian;
/// in wider bands colours are visible.
pub(crate) fn is_seen_as_line(motion: &RelativeMotion, corners: &[&Point], angle: f64) -> bool {
    if !motion.has_flight_time() {
        return false;
    }
    let rest = || corners.iter().map(|corner| motion.boosted_rest(corner.rest));
    let normal = ugscene::unit_normal(rest());
    if normal == DVec3::ZERO {
        return false;
    }
    let height = rest().map(|corner| normal.dot(corner).abs()).fold(0.0, f64::max);
    // |p| = γ(|p'| − v·p') is at least γ(u − v)·p' for any unit u, and that is least in a corner.
    let toward = rest().map(|corner| corner.normalize_or_zero()).sum::<DVec3>().normalize_or_zero();
    let way = (toward - motion.velocity().beta()) * motion.gamma();
    let nearest = rest().map(|corner| way.dot(corner)).fold(f64::INFINITY, f64::min);
    let k = motion.proper_speed() * normal.dot(motion.direction());
    height <= nearest * (angle.min(DEFAULT_ERROR) / 4.0)
        && height * (1.0 + k * k).sqrt() <= nearest / 4.0
}

/// Is the eye, in the plane of an outline, outside it and away from its edges?
fn is_beside_eye(outline: impl Iterator<Item = DVec3> + Clone, normal: DVec3, clear: f64) -> bool {
    let (across, up) = normal.any_orthonormal_pair();
    let next = outline.clone().skip(1).chain(outline.clone().take(1));
    let mut is_inside = false;
    for (a, b) in outline.zip(next) {
        let along = b - a;
        // For a repeated corner the edge is a single point.
        let s = (-a.dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        if (a + along * s).length() <= clear {
            return false;
        }
        let ([ax, ay], [bx, by]) = ([a.dot(across), a.dot(up)], [b.dot(across), b.dot(up)]);
        if (ay <= 0.0) != (by <= 0.0) && ax - ay * (bx - ax) / (by - ay) > 0.0 {
            is_inside = !is_inside;
        }
    }
    !is_inside
}
