//! Measures the faces of a flat scene.

use glam::DVec3;
use rustc_hash::FxHashMap;
use ugphysics::Velocity;
use ugscene::{Face, Scene, VertexId, closed, thickness, unit_normal};

/// Number of corners of all faces.
pub(crate) fn corner_count(scene: &Scene) -> usize {
    scene.faces.iter().map(|face| scene.face_corners(face).len()).sum()
}

/// The least flat face, and its [`thickness`].
pub(crate) fn thickest_face(scene: &Scene) -> Option<(usize, f64)> {
    let faces = scene.faces.iter().enumerate().map(|(row, face)| (row, thickness(scene, face)));
    // Ties go to the first; a face too large to measure is never the thickest.
    faces.reduce(|worst, face| if face.1 > worst.1 { face } else { worst })
}

fn position(scene: &Scene, vertex: VertexId) -> DVec3 {
    scene.vertices[vertex.index()].position
}

fn outline_normal(scene: &Scene, face: &Face) -> DVec3 {
    normal(scene, scene.contours.get(face.contours.start))
}

fn normal(scene: &Scene, contour: &[VertexId]) -> DVec3 {
    unit_normal(contour.iter().map(|&vertex| position(scene, vertex)))
}

/// Numbers of edges by the faces they border.
///
/// Vertices at the same position count as one. Two faces with consistent orientation traverse their
/// common edge in opposite directions.
#[derive(Default)]
pub(crate) struct Edges {
    /// Edges of two faces that traverse them in opposite directions.
    pub opposite: usize,
    /// Edges of two faces that traverse them in the same direction: one face is turned.
    pub same: usize,
    /// Edges of one face.
    pub border: usize,
    /// Edges of more than two faces.
    pub crowded: usize,
    /// The first face with most edges that a neighbour traverses in the same direction, and their
    /// number.
    pub turned: Option<(usize, u32)>,
}

/// The faces along one edge.
#[derive(Default)]
struct Sides {
    /// Number of faces in each direction.
    n_along: [usize; 2],
    /// The last two faces.
    faces: [u32; 2],
}

impl Edges {
    pub fn new(scene: &Scene) -> Self {
        let first = first_at_position(scene);
        let mut sides: FxHashMap<(u32, u32), Sides> = FxHashMap::default();
        for (row, face) in scene.faces.iter().enumerate() {
            each_edge(scene, face, |from, to| {
                let (from, to) = (first[from.index()], first[to.index()]);
                if from != to {
                    let edge = sides.entry((from.min(to), from.max(to))).or_default();
                    edge.n_along[usize::from(from > to)] += 1;
                    edge.faces = [edge.faces[1], row as u32];
                }
            });
        }
        let mut edges = Self::default();
        let mut n_same = vec![0u32; scene.faces.len()];
        // Sums do not depend on the order of the hash table.
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

/// Calls `edge` for the edges of a face, with its interior on their left: holes may have either
/// direction, and are assumed to run opposite to the outline.
fn each_edge(scene: &Scene, face: &Face, mut edge: impl FnMut(VertexId, VertexId)) {
    let outward = outline_normal(scene, face);
    for (idx, contour) in scene.face_contours(face).enumerate() {
        let is_reversed = idx > 0 && normal(scene, contour).dot(outward) > 0.0;
        for [from, to] in closed(contour) {
            if is_reversed { edge(to, from) } else { edge(from, to) }
        }
    }
}

/// For each vertex the first one at the same position.
fn first_at_position(scene: &Scene) -> Vec<u32> {
    let mut known: FxHashMap<[u64; 3], u32> = FxHashMap::default();
    let first = |(row, position): (usize, DVec3)| {
        // Adding 0 turns -0 into 0.
        let key = (position + DVec3::ZERO).to_array().map(f64::to_bits);
        *known.entry(key).or_insert(row as u32)
    };
    scene.vertices.iter().map(|vertex| vertex.position).enumerate().map(first).collect()
}

/// The stated velocities of the bodies with faces or wires, and the numbers of these.
pub(crate) fn bodies(scene: &Scene) -> Vec<(Option<Velocity>, usize, usize)> {
    let mut bodies: Vec<_> =
        scene.bodies.ids().map(|body| (scene.bodies.stated_velocity(body), 0, 0)).collect();
    scene.faces.iter().for_each(|face| bodies[face.body.index()].1 += 1);
    let lines = scene.wires.iter().filter(|wire| wire.text.is_none());
    lines.for_each(|wire| bodies[wire.body.index()].2 += 1);
    bodies.retain(|&(_, faces, wires)| faces + wires > 0);
    bodies
}
