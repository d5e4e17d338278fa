//! Edges that faces share, by the places of their ends.

use glam::DVec3;
use rayon::prelude::*;
use ugscene::{BodyId, Face, Scene, VertexId, face_edges};

/// An edge of a face.
#[derive(Clone, Copy, Debug)]
pub struct FaceEdge {
    /// From where to where.
    pub ends: [VertexId; 2],
    /// Row of the face.
    pub face: u32,
    /// The places of its ends, in ascending order: see `places` of [`shared_edges`].
    pub places: [usize; 2],
    /// The face runs through its ends in this order.
    pub is_forward: bool,
    body: BodyId,
}

type IsCounted<'a> = dyn Fn(&Face) -> bool + Sync + 'a;

/// Calls `take` for each edge of a body with the edges of all faces that meet there, also of faces
/// without common vertices, and returns what it makes of them. `places`: for each vertex the row of
/// one vertex, the same for all at its place; `is_counted`: false for faces that are left out.
pub fn shared_edges<T: Send>(
    scene: &Scene,
    places: &[usize],
    is_counted: &IsCounted<'_>,
    take: impl Fn(&[&FaceEdge]) -> Option<T> + Sync,
) -> Vec<T> {
    let edges = sorted_edges(scene, places, is_counted);
    let is_one =
        |one: &FaceEdge, other: &FaceEdge| (one.places, one.body) == (other.places, other.body);
    let shared: Vec<&[FaceEdge]> = edges.chunk_by(is_one).collect();
    let taken = |shared: &&[FaceEdge]| {
        // A sliver between vertices at one place runs there and back.
        let of_faces = shared.chunk_by(|one, other| one.face == other.face);
        let of_faces: Vec<&FaceEdge> = of_faces.filter(|same| same.len() == 1).flatten().collect();
        if of_faces.is_empty() { None } else { take(&of_faces) }
    };
    shared.par_iter().filter_map(taken).collect()
}

/// The edges of all faces that count, those of one place and body together, in the order of faces.
fn sorted_edges(scene: &Scene, places: &[usize], is_counted: &IsCounted<'_>) -> Vec<FaceEdge> {
    let of_face = |(row, face): (usize, &Face)| {
        let edge = |ends: [VertexId; 2]| {
            let [a, b] = ends.map(|end| places[end.index()]);
            let is_forward = a < b;
            let (ends, places) =
                if is_forward { (ends, [a, b]) } else { ([ends[1], ends[0]], [b, a]) };
            // The text of a scene is below 4 GiB, so row numbers fit.
            FaceEdge { ends, face: row as u32, places, is_forward, body: face.body }
        };
        let edges = face_edges(scene, face).map(edge);
        edges.filter(|edge| edge.places[0] != edge.places[1]).collect::<Vec<_>>()
    };
    let counted = scene.faces.par_iter().enumerate().filter(|(_, face)| is_counted(face));
    let mut edges: Vec<FaceEdge> = counted.flat_map_iter(of_face).collect();
    edges.par_sort_unstable_by_key(|edge| (edge.places, edge.body, edge.face, edge.is_forward));
    edges
}

/// How two faces meet at an edge.
#[derive(Clone, Copy, Debug)]
pub struct Fold {
    /// Cosine of the angle between their normals, one of which is turned if it is inside out.
    pub cosine: f64,
    /// Both run along the edge alike: one of them is inside out, or lies in a hole of the other.
    pub is_turned: bool,
    /// One of them lies in a hole of the other.
    pub is_in_hole: bool,
}

impl Fold {
    /// Cosine of the greatest angle between the planes of faces that count as coplanar; its sine is
    /// 0.01.
    pub const FLAT: f64 = 0.999_95;

    /// The fold between the faces of two edges. `normals`: of the faces; a degenerate piece has
    /// none, and is coplanar with every face.
    pub fn new([one, other]: [&FaceEdge; 2], normals: [Option<DVec3>; 2]) -> Self {
        let cosine = normals[0].zip(normals[1]).map_or(1.0, |(one, other)| one.dot(other));
        let is_turned = one.is_forward == other.is_forward;
        let is_in_hole = is_turned && cosine > Self::FLAT;
        Self {
            cosine: if is_turned && !is_in_hole { -cosine } else { cosine },
            is_turned,
            is_in_hole,
        }
    }
}
