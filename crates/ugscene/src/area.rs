//! Area, normal and edges of polygons.

use std::ops::Range;

use glam::DVec3;
use ugphysics::unit_or_zero;

use crate::{Face, Scene, VertexId};

/// Area-weighted normal of a polygon by Newell's method: right-handed, its
/// length twice the area for a planar polygon, zero for a degenerate one.
///
/// Coordinates are relative to the first corner, so that a small face far from the origin keeps its
/// precision. Areas above 1e300 or below 1e-300 overflow or underflow: for directions there is
/// [`unit_normal`].
pub fn newell_normal(corners: impl Iterator<Item = DVec3> + Clone) -> DVec3 {
    let mut rest = corners.clone();
    let Some(origin) = rest.next() else {
        return DVec3::ZERO;
    };
    rest.clone()
        .zip(rest.skip(1))
        .fold(DVec3::ZERO, |sum, (a, b)| sum + (a - origin).cross(b - origin))
}

/// Unit normal of a polygon of any size, right-handed; zero if it has no area.
pub fn unit_normal(corners: impl Iterator<Item = DVec3> + Clone) -> DVec3 {
    /// Lengths whose squares neither overflow nor underflow.
    const USUAL: Range<f64> = 1e-140..1e150;
    let normal = newell_normal(corners.clone());
    if normal.is_finite() && USUAL.contains(&normal.abs().max_element()) {
        return normal.normalize();
    }
    let Some(origin) = corners.clone().next() else { return DVec3::ZERO };
    // Halved first: the difference of large coordinates may overflow.
    let halves = corners.map(|corner| corner * 0.5 - origin * 0.5);
    let largest = halves.clone().map(|half| half.abs().max_element()).fold(0.0, f64::max);
    if largest > 0.0 {
        unit_or_zero(newell_normal(halves.map(|half| half / largest)))
    } else {
        DVec3::ZERO
    }
}

/// The edges of a face, contour by contour, each from one corner to the next.
pub fn face_edges<'a>(scene: &'a Scene, face: &'a Face) -> impl Iterator<Item = [VertexId; 2]> {
    scene.face_contours(face).flat_map(closed)
}

/// The pairs of neighbours in a row of corners, with that from the last to the first.
pub fn closed<T: Copy>(corners: &[T]) -> impl Iterator<Item = [T; 2]> {
    corners.iter().zip(corners.iter().cycle().skip(1)).map(|(&from, &to)| [from, to])
}
