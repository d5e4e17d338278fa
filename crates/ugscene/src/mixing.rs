//! Vertices where faces of different colours meet, whose colours are mixed unless they are kept
//! apart (`-vr`).

use crate::{Color, ColorId, Face, Scene, VertexId, split_corners};

/// Gives wires vertices of their own, since a vertex carries one colour only; and with
/// `each_face_color` (`-vr`) a copy of a vertex to each colour of its faces. All copies keep the
/// normal, so shading stays smooth across them.
///
/// With `each_face_color`, vertices lose the colours that are mixtures ([`crate::Stage`]).
pub fn repeat_vertices(scene: &mut Scene, each_face_color: bool) {
    if each_face_color {
        remove_mixtures(scene);
    }
    if scene.wires.is_empty() && !each_face_color {
        return;
    }
    let of_face = |face: &Face| (false, face.color.filter(|_| each_face_color));
    let faces = scene.faces.iter().map(|face| (face.contours.clone(), of_face(face)));
    let wires = scene.wires.iter().map(|wire| (wire.contours.clone(), (true, wire.color)));
    let users: Vec<_> = faces.chain(wires).collect();
    crate::split_vertices(scene, &users, |vertex| vertex.color.is_none());
}

/// Gives wires copies, without a colour, of the vertices that they share with faces. `rows`: the
/// vertices to copy.
pub fn separate_wires(scene: &mut Scene, rows: &[bool]) {
    if scene.wires.is_empty() || !rows.contains(&true) {
        return;
    }
    let n_faces = scene.faces.len();
    let users: Vec<_> = scene.drawn().map(|drawn| drawn.contours).collect();
    let has = |vertex: VertexId| rows.get(vertex.index()).copied().unwrap_or_default();
    let copies = split_corners(scene, users.into_iter(), |user, vertex, _| {
        has(vertex).then_some(user >= n_faces)
    });
    let first = scene.vertices.len() - copies.len();
    scene.vertices[first..].iter_mut().for_each(|copy| copy.color = None);
}

/// Takes the mixtures from the vertices that `uglorentz` gave them to.
fn remove_mixtures(scene: &mut Scene) {
    let Some(mixtures) = scene.stage.mixtures.take() else { return };
    let is_mixture = |color: &Color| mixtures.contains(scene.names.get(color.name));
    let mixed: Vec<bool> = scene.colors.iter().map(is_mixture).collect();
    for vertex in &mut scene.vertices {
        vertex.color = vertex.color.filter(|color| !mixed[color.index()]);
    }
}

/// The number of vertices without a colour of their own at which faces of different colours meet.
pub fn n_mixing_vertices(scene: &Scene) -> usize {
    mixing_vertices(scene).into_iter().filter(|&is_mixing| is_mixing).count()
}

/// For each vertex, whether it has no colour of its own and faces of different colours meet there;
/// empty if there is none.
pub fn mixing_vertices(scene: &Scene) -> Vec<bool> {
    // In most scenes no vertex needs a colour, or all faces have the same.
    let has_one_color = || scene.faces.windows(2).all(|pair| pair[0].color == pair[1].color);
    if scene.vertices.iter().all(|vertex| vertex.color.is_some()) || has_one_color() {
        return Vec::new();
    }
    let mut first_colors: Vec<Option<Option<ColorId>>> = vec![None; scene.vertices.len()];
    let mut are_mixing = vec![false; scene.vertices.len()];
    for face in &scene.faces {
        for corner in scene.face_corners(face) {
            let row = corner.index();
            let first = *first_colors[row].get_or_insert(face.color);
            let is_mixed =
                || scene.vertices[row].color.is_none() && !looks_same(scene, first, face.color);
            are_mixing[row] |= first != face.color && is_mixed();
        }
    }
    are_mixing
}

/// Are two colours with different names equal?
fn looks_same(scene: &Scene, a: Option<ColorId>, b: Option<ColorId>) -> bool {
    let (Some(a), Some(b)) = (a, b) else { return false };
    let [a, b] = [a, b].map(|color| &scene.colors[color.index()]);
    a.value == b.value && a.translucency == b.translucency
}
