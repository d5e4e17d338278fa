//! Duplication of vertices that are shared by faces and wires of different kinds.

use std::hash::Hash;
use std::ops::Range;

use rustc_hash::FxHashMap;

use crate::{Scene, UniqueNames, Vertex, VertexId};

/// Duplicates vertices that users of different kinds share, so that each vertex is used by one
/// kind. The first user keeps the vertex; the others get copies, one for each kind, named after it.
///
/// `users`: contours of faces and wires, each with its kind.
/// `divide`: false for vertices that may stay shared.
pub fn split_vertices<K: Copy + Eq + Hash>(
    scene: &mut Scene,
    users: &[(Range<u32>, K)],
    divide: impl Fn(&Vertex) -> bool,
) {
    let rows = users.iter().map(|(rows, _)| rows.clone());
    split_corners(scene, rows, |user, _, vertex| divide(vertex).then_some(users[user].1));
}

/// Like [`split_vertices`], for kinds that depend on the corner: `kind` gets the user, the vertex
/// and its row; `None` uses the vertex without a copy.
///
/// Returns the originals of the copies, which are the last vertices of the scene, in order. No copy
/// is the original of another.
pub fn split_corners<K: Copy + Eq + Hash>(
    scene: &mut Scene,
    users: impl Iterator<Item = Range<u32>>,
    kind: impl Fn(usize, VertexId, &Vertex) -> Option<K>,
) -> Vec<VertexId> {
    let mut owner: Vec<Option<K>> = vec![None; scene.vertices.len()];
    let mut copies: FxHashMap<(VertexId, K), VertexId> = FxHashMap::default();
    let mut originals = Vec::new();
    let mut names: Option<UniqueNames> = None;
    for (user, rows) in users.enumerate() {
        for at in scene.contours.first_corner(rows.start)..scene.contours.first_corner(rows.end) {
            let corner = scene.contours.corner(at);
            let Some(kind) = kind(user, corner, &scene.vertices[corner.index()]) else { continue };
            if *owner[corner.index()].get_or_insert(kind) == kind {
                continue;
            }
            let copy = *copies.entry((corner, kind)).or_insert_with(|| {
                originals.push(corner);
                let names = names.get_or_insert_with(|| vertex_names(scene));
                let name = names.add_copy(scene.vertices[corner.index()].name, &mut scene.names);
                scene.copy_vertex(corner, name)
            });
            scene.contours.all_corners_mut()[at] = copy;
        }
    }
    originals
}

/// The names of all vertices.
pub(crate) fn vertex_names(scene: &Scene) -> UniqueNames {
    scene.vertices.iter().map(|vertex| scene.names.get(vertex.name)).collect()
}
