//! Which edges of faces are drawn.

use glam::DVec3;
use rayon::prelude::*;
use ugpicture::{FaceEdge, Fold, shared_edges, spots};
use ugscene::{Face, VertexId, unit_normal};

use crate::config::EdgeKind;
use crate::painter::Painter;

/// An edge that is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Edge {
    /// From where to where.
    pub ends: [VertexId; 2],
    /// Row of the face, or of the first of several.
    pub face: u32,
    /// The places of its ends; vertices at one place have the same.
    pub places: [usize; 2],
    /// On which side of a silhouette, seen from its first end to the other, the body is not: 1 if
    /// on the right, −1 on the left, 0 for other edges.
    pub outward: f64,
}

/// The edges of all faces that are of this kind, each once. Edges at the same place of a body at
/// rest are one, also of faces without common vertices.
pub fn edges(painter: &Painter<'_>, kind: EdgeKind) -> Vec<Edge> {
    let places = places(painter.appearance.surface.all_rest());
    let drawn = |edges: &[&FaceEdge]| {
        let outward =
            if let &[one, other] = edges { outward(painter, [one, other], kind)? } else { 0.0 };
        let &FaceEdge { ends, face, places, .. } = edges[0];
        Some(Edge { ends, face, places, outward })
    };
    shared_edges(painter.scene, &places, &|_| true, drawn)
}

/// For each vertex the row of one at its place. Turned copies of a part meet only up to the digits
/// in its text.
fn places(rest: &[DVec3]) -> Vec<usize> {
    /// Greatest distance of vertices at one place, in units of the size of the scene.
    const SAME: f64 = 1e-8;
    let low = rest.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = rest.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    spots(rest, SAME * (high - low).max_element())
}

/// [`Edge::outward`] of the edge between two faces, if it is drawn.
fn outward(painter: &Painter<'_>, edges: [&FaceEdge; 2], kind: EdgeKind) -> Option<f64> {
    let faces = edges.map(|edge| &painter.scene.faces[edge.face as usize]);
    let fold = Fold::new(edges, faces.map(|face| normal(painter, face)));
    let least_cosine = match kind {
        EdgeKind::All => Fold::FLAT,
        EdgeKind::Creases { angle } => libm::cos(angle),
        EdgeKind::Silhouette => f64::NEG_INFINITY,
    };
    let has_silhouette = kind != EdgeKind::All && !fold.is_in_hole;
    let [one, other] = edges.map(|edge| has_silhouette && is_on_left(painter, edge));
    let outward = match (has_silhouette && one == other, one) {
        (false, _) => 0.0,
        (true, true) => 1.0,
        (true, false) => -1.0,
    };
    let is_border = kind != EdgeKind::Silhouette && faces[0].color != faces[1].color;
    (outward != 0.0 || is_border || fold.cosine < least_cosine).then_some(outward)
}

/// True if the face of an edge is seen on its left, from the first end to the other.
fn is_on_left(painter: &Painter<'_>, edge: &FaceEdge) -> bool {
    is_turned_away(painter, &painter.scene.faces[edge.face as usize]) != edge.is_forward
}

/// The normal of a face at rest; `None` if it has no area.
fn normal(painter: &Painter<'_>, face: &Face) -> Option<DVec3> {
    let outline = painter.scene.face_contours(face).next()?;
    let rest = outline.iter().map(|&vertex| painter.appearance.surface.rest(vertex));
    Some(unit_normal(rest)).filter(|&normal| normal != DVec3::ZERO)
}

/// True if a face is seen from behind. In its rest frame light comes straight from a body that is
/// not on a world line, so all of a flat face is seen from the side on which the eye is there.
fn is_turned_away(painter: &Painter<'_>, face: &Face) -> bool {
    let surface = &painter.appearance.surface;
    if !painter.view.is_perspective || surface.frames().world_line(face.body).is_some() {
        return painter.is_seen_from_behind(face);
    }
    let corner = painter.scene.face_contours(face).next().and_then(|outline| outline.first());
    corner
        .zip(normal(painter, face))
        .is_some_and(|(&corner, normal)| normal.dot(surface.rest(corner)) > 0.0)
}

/// Edges in the order in which they follow each other, each with whether it continues the one
/// before it: where two meet, and no third.
pub fn chained(edges: Vec<Edge>) -> Vec<(Edge, bool)> {
    let mut at: Vec<(usize, usize)> = edges
        .iter()
        .enumerate()
        .flat_map(|(row, edge)| edge.places.map(|place| (place, row)))
        .collect();
    at.par_sort_unstable();
    let next = |place: usize, row: usize| {
        let first = at.partition_point(|(other, _)| *other < place);
        let meet = at[first..].iter().take_while(|(other, _)| *other == place).map(|(_, row)| *row);
        let [one, other] = meet.take(3).collect::<Vec<_>>()[..] else { return None };
        Some(if one == row { other } else { one })
    };
    let reversed = |edge: Edge| {
        let ([a, b], [from, to]) = (edge.ends, edge.places);
        Edge { ends: [b, a], places: [to, from], outward: -edge.outward, ..edge }
    };
    let from = |place: usize, row: usize| {
        let edge = edges[row];
        if edge.places[0] == place { edge } else { reversed(edge) }
    };
    let mut is_done = vec![false; edges.len()];
    let mut chains = Vec::with_capacity(edges.len());
    for row in 0..edges.len() {
        if is_done[row] {
            continue;
        }
        // Back to where the chain begins, or once around it.
        let (mut first, mut start) = (row, edges[row].places[0]);
        while let Some(before) = next(start, first).filter(|&before| before != row) {
            (first, start) = (before, from(start, before).places[1]);
        }
        let (mut row, mut place, mut continues) = (first, start, false);
        loop {
            let edge = from(place, row);
            is_done[row] = true;
            chains.push((edge, continues));
            (place, continues) = (edge.places[1], true);
            match next(place, row).filter(|&other| !is_done[other]) {
                Some(other) => row = other,
                None => break,
            }
        }
    }
    chains
}
