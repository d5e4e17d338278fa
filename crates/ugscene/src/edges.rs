//! Edges of faces.

use crate::{Face, Scene, VertexId};

/// The edges of a face, contour by contour, each from one corner to the next.
pub fn face_edges<'a>(scene: &'a Scene, face: &'a Face) -> impl Iterator<Item = [VertexId; 2]> {
    scene.face_contours(face).flat_map(|contour| {
        let next = contour.iter().cycle().skip(1);
        contour.iter().zip(next).map(|(&a, &b)| [a, b])
    })
}
