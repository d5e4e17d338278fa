//! What can be measured of the faces of a flat scene.

use glam::DVec3;
use rustc_hash::FxHashMap;

use crate::body::BodyId;
use crate::flatness::thickness;
use crate::scene::{Face, Scene, VertexId, newell_normal};

/// Corners of all faces.
pub(crate) fn corner_count(scene: &Scene) -> usize {
    scene.faces.iter().map(|face| scene.contours.corners(face.contours.clone()).len()).sum()
}

/// The face that is least flat, and how much: see [`thickness`].
pub(crate) fn thickest_face(scene: &Scene) -> Option<(usize, f64)> {
    let faces = scene.faces.iter().enumerate().map(|(row, face)| (row, thickness(scene, face)));
    // Of equals the first; a face too large to measure is never the thickest.
    faces.reduce(|worst, face| if face.1 > worst.1 { face } else { worst })
}

fn position(scene: &Scene, vertex: VertexId) -> DVec3 {
    scene.vertices[vertex.index()].position
}

fn outline_normal(scene: &Scene, face: &Face) -> DVec3 {
    normal(scene, scene.contours.get(face.contours.start))
}

fn normal(scene: &Scene, contour: &[VertexId]) -> DVec3 {
    newell_normal(contour.iter().map(|&vertex| position(scene, vertex)))
}

/// Edges of faces by how many faces have them, and which way these run.
///
/// Vertices in the same place count as one. Two faces that both run
/// counterclockwise, seen from outside, run opposite ways along their edge.
#[derive(Default)]
pub(crate) struct Edges {
    /// Of two faces, opposite ways.
    pub opposite: usize,
    /// Of two faces, the same way: one of them is turned.
    pub same: usize,
    /// Of one face.
    pub border: usize,
    /// Of more than two.
    pub crowded: usize,
    /// The first of the faces with most edges that run the same way as a neighbour's, and their number.
    pub turned: Option<(usize, u32)>,
}

/// The faces along one edge.
#[derive(Default)]
struct Sides {
    /// How many run from the earlier place to the later one, and how many back.
    n_along: [usize; 2],
    /// The last two.
    faces: [u32; 2],
}

impl Edges {
    pub fn new(scene: &Scene) -> Self {
        let places = places(scene);
        let mut sides: FxHashMap<(u32, u32), Sides> = FxHashMap::default();
        for (row, face) in scene.faces.iter().enumerate() {
            each_edge(scene, face, |from, to| {
                let (from, to) = (places[from.index()], places[to.index()]);
                if from != to {
                    let edge = sides.entry((from.min(to), from.max(to))).or_default();
                    edge.n_along[usize::from(from > to)] += 1;
                    edge.faces = [edge.faces[1], row as u32];
                }
            });
        }
        let mut edges = Self::default();
        let mut n_same = vec![0u32; scene.faces.len()];
        // Only sums are made, so the order of the table does not matter.
        for Sides { n_along, faces } in sides.into_values() {
            match n_along {
                [1, 1] => edges.opposite += 1,
                [2, 0] | [0, 2] => {
                    edges.same += 1;
                    faces.iter().for_each(|&face| n_same[face as usize] += 1);
                }
                [1, 0] | [0, 1] => edges.border += 1,
                _ => edges.crowded += 1,
            }
        }
        let disagree = n_same.into_iter().enumerate().filter(|&(_, n_edges)| n_edges > 0);
        edges.turned = disagree.reduce(|most, face| if face.1 > most.1 { face } else { most });
        edges
    }
}

/// The edges of a face, with its inside to their left: holes may be written
/// either way, and are taken to run against the outline.
fn each_edge(scene: &Scene, face: &Face, mut edge: impl FnMut(VertexId, VertexId)) {
    let outward = outline_normal(scene, face);
    for (idx, contour) in scene.face_contours(face).enumerate() {
        let is_reversed = idx > 0 && normal(scene, contour).dot(outward) > 0.0;
        let next = contour.iter().cycle().skip(1);
        for (&from, &to) in contour.iter().zip(next) {
            if is_reversed { edge(to, from) } else { edge(from, to) }
        }
    }
}

/// For each vertex the first one in the same place.
fn places(scene: &Scene) -> Vec<u32> {
    let mut known: FxHashMap<[u64; 3], u32> = FxHashMap::default();
    let place = |(row, position): (usize, DVec3)| {
        // Adding 0 turns -0 into 0.
        let key = (position + DVec3::ZERO).to_array().map(f64::to_bits);
        *known.entry(key).or_insert(row as u32)
    };
    scene.vertices.iter().map(|vertex| vertex.position).enumerate().map(place).collect()
}

/// The bodies that have faces or wires, with the numbers of these.
pub(crate) fn bodies(scene: &Scene) -> Vec<(BodyId, usize, usize)> {
    let mut bodies: Vec<_> = scene.bodies.ids().map(|body| (body, 0, 0)).collect();
    scene.faces.iter().for_each(|face| bodies[face.body.index()].1 += 1);
    scene.wires.iter().for_each(|wire| bodies[wire.body.index()].2 += 1);
    bodies.retain(|&(_, faces, wires)| faces + wires > 0);
    bodies
}
