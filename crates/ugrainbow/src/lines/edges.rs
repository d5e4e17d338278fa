//! Which edges of faces are drawn.

use glam::DVec3;
use rayon::prelude::*;
use ugscene::{Face, VertexId, face_edges, unit_normal};

use crate::painter::Painter;

/// Sine of the greatest angle between the planes of faces that count as coplanar.
const FLAT: f64 = 0.01;

/// An edge of a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// From where to where.
    pub ends: [VertexId; 2],
    /// Row of the face, or of the first of several.
    pub face: u32,
}

/// The edges of all faces, each once, except between two coplanar faces of one colour and body at
/// rest. So a face that `uglorentz` has subdivided has the edges it had before.
pub fn edges(painter: &Painter<'_>) -> Vec<Edge> {
    let scene = painter.scene;
    let of_face = |(row, face): (usize, &Face)| {
        let sides = face_edges(scene, face).filter(|[a, b]| a != b).map(|[a, b]| [a.min(b), a.max(b)]);
        // The text of a scene is below 4 GiB, so row numbers fit.
        sides.map(|ends| Edge { ends, face: row as u32 }).collect::<Vec<_>>()
    };
    let mut edges: Vec<Edge> = scene.faces.par_iter().enumerate().flat_map_iter(of_face).collect();
    edges.par_sort_unstable_by_key(|edge| (edge.ends, edge.face));
    let shared: Vec<&[Edge]> = edges.chunk_by(|one, other| one.ends == other.ends).collect();
    let is_drawn = |shared: &&[Edge]| match shared {
        [one, other] => !is_inside(painter, [one.face, other.face]),
        _ => true,
    };
    shared.into_par_iter().filter(is_drawn).map(|shared| shared[0]).collect()
}

/// True if the edge between two faces lies inside one surface, so that it is not drawn.
fn is_inside(painter: &Painter<'_>, faces: [u32; 2]) -> bool {
    let [one, other] = faces.map(|row| &painter.scene.faces[row as usize]);
    if one.color != other.color || one.body != other.body {
        return false;
    }
    let normal = |face: &Face| {
        let outline = painter.scene.face_contours(face).next()?;
        Some(unit_normal(outline.iter().map(|&vertex| painter.appearance.surface.rest(vertex))))
            .filter(|&normal| normal != DVec3::ZERO)
    };
    let is_one_plane = |a: DVec3, b: DVec3| a.dot(b) > 0.0 && a.cross(b).length() < FLAT;
    // A degenerate piece is coplanar with every face.
    normal(one).zip(normal(other)).is_none_or(|(a, b)| is_one_plane(a, b))
}
