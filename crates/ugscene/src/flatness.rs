//! Flatness of faces.

use glam::DVec3;

use crate::{Face, Scene, unit_normal};
use rayon::prelude::*;

/// A face that is less flat than this is drawn as triangles. Below, its triangles differ from its
/// plane by less than the precision of depth in pictures and of normals.
pub const BENT: f64 = 1e-6;

/// The least number of faces per thread.
const MANY_FACES: usize = 1 << 14;

/// A face to be drawn as triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BentFace {
    /// Row of [`Scene::faces`].
    pub row: usize,
    /// Its [`thickness`], above [`BENT`].
    pub thickness: f64,
}

/// The greatest distance of a corner from the plane of a polygon, divided by its size; both in rest
/// coordinates. Round faces have none.
///
/// The plane contains the mean of all corners and is perpendicular to the outline's area vector;
/// the size is the diagonal of the face's bounding box.
pub fn thickness(scene: &Scene, face: &Face) -> f64 {
    let corners = scene.face_corners(face);
    let positions = || corners.iter().map(|&corner| scene.vertices[corner.index()].position);
    let Some(first) = positions().next().filter(|_| !face.shape.is_round()) else { return 0.0 };
    let mean =
        positions().map(|corner| corner - first).sum::<DVec3>() / corners.len() as f64 + first;
    let outline = scene.contours.get(face.contours.start).iter();
    let normal = unit_normal(outline.map(|&corner| scene.vertices[corner.index()].position));
    let distance = positions().map(|corner| (corner - mean).dot(normal).abs()).fold(0.0, f64::max);
    let (low, high) =
        positions().fold((first, first), |(low, high), corner| (low.min(corner), high.max(corner)));
    let size = ugphysics::length(high - low);
    if size > 0.0 { distance / size } else { 0.0 }
}

/// The faces that are bent, in order. A scene as seen has none: its faces are bent by the motion,
/// and those that are bent at rest have been cut.
pub fn bent_faces(scene: &Scene) -> Vec<BentFace> {
    let bent = |row: usize| {
        let face = &scene.faces[row];
        // Triangles are flat.
        if face.contours.len() == 1 && scene.contours.get(face.contours.start).len() == 3 {
            return None;
        }
        let thickness = thickness(scene, face);
        (thickness > BENT).then_some(BentFace { row, thickness })
    };
    // No face has fewer than three corners, so if the mean is three, all are triangles.
    if scene.contours.corner_count() == 3 * scene.faces.len()
        || scene.stage.seen_geometry().is_some()
    {
        return Vec::new();
    }
    (0..scene.faces.len()).into_par_iter().with_min_len(MANY_FACES).filter_map(bent).collect()
}
