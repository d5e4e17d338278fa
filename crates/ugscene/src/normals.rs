//! Vertex normals: means of face normals, weighted by angle (Nguyen 1988, 5.2.1).

use glam::DVec3;
use ugphysics::unit_or_zero;

use crate::{Face, Scene, VertexId, unit_normal};

/// Angle at corner `idx` of a contour, radians in 0…π. For a reflex corner it is the outer angle,
/// so weights are at most π.
pub fn corner_angle(contour: &[VertexId], idx: usize, positions: &[DVec3]) -> f64 {
    // Halved first: the difference of large coordinates may overflow.
    let half = |idx: usize| positions[contour[idx].index()] * 0.5;
    let (before, after) = (idx.checked_sub(1).unwrap_or(contour.len() - 1), idx + 1);
    let (a, b) =
        (half(before) - half(idx), half(if after < contour.len() { after } else { 0 }) - half(idx));
    ugphysics::angle(a, b)
}

/// Unit normal of a face; zero if it has no area.
pub(crate) fn face_normal(scene: &Scene, face: &Face, positions: &[DVec3]) -> DVec3 {
    let outline = scene.contours.get(face.contours.start);
    unit_normal(outline.iter().map(|corner| positions[corner.index()]))
}

/// Unit normal of an outline on its visible side; zero if it has no area.
///
/// `corners`: rest positions. `toward_eye`: a vector to the eye, in the frame of `corners`.
pub fn seen_normal(corners: impl Iterator<Item = DVec3> + Clone, toward_eye: DVec3) -> DVec3 {
    let normal = unit_normal(corners);
    if normal.dot(toward_eye) < 0.0 { -normal } else { normal }
}

/// The unit normal for lighting a corner: that of its vertex, flipped to the visible side of the
/// face, else that of the face.
///
/// `own`: of the vertex, any length. `seen`: [`seen_normal`] of the face.
pub fn shading_normal(own: Option<DVec3>, seen: DVec3) -> DVec3 {
    match own {
        Some(own) if own.dot(seen) < 0.0 => -unit_or_zero(own),
        Some(own) => unit_or_zero(own),
        None => seen,
    }
}

/// For every vertex the mean of the unit normals of its faces, weighted by the angle of each face
/// there, normalized. Zero for a vertex without faces, or whose normals cancel.
///
/// `positions`: one for each vertex; the result is in their frame.
pub fn smooth_normals(scene: &Scene, positions: &[DVec3]) -> Vec<DVec3> {
    let mut normals = vec![DVec3::ZERO; scene.vertices.len()];
    for face in &scene.faces {
        let normal = face_normal(scene, face, positions);
        for contour in scene.face_contours(face) {
            for (idx, corner) in contour.iter().enumerate() {
                normals[corner.index()] += normal * corner_angle(contour, idx, positions);
            }
        }
    }
    // Opposite normals cancel up to rounding of about 1e-16, which has no meaningful direction.
    let unit = |sum: DVec3| if sum.length() > 1e-12 { sum.normalize() } else { DVec3::ZERO };
    normals.into_iter().map(unit).collect()
}
