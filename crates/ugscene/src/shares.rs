//! The colours that meet at a vertex, and their weights (Nguyen 1988, 4.1).

use glam::DVec3;
use rustc_hash::FxHashMap;
use ugparse::{ColorId, Scene, VertexId};

use crate::corner_angle;

/// The colours of a vertex. `None` is white, for faces without a colour.
#[derive(Clone, Debug, PartialEq)]
pub enum Shares {
    /// Its own, or that of all its faces.
    One(Option<ColorId>),
    /// Those of its faces, in their order, each once and with its share by the angles of the faces.
    /// Shares add up to 1.
    Mixed(Vec<(Option<ColorId>, f64)>),
}

impl Shares {
    /// Each colour with its share.
    pub fn parts(&self) -> impl Iterator<Item = (Option<ColorId>, f64)> {
        let (one, many) = match self {
            Self::One(color) => (Some((*color, 1.0)), &[][..]),
            Self::Mixed(parts) => (None, &parts[..]),
        };
        one.into_iter().chain(many.iter().copied())
    }
}

/// The colours of every vertex: its own, else those of its faces, else of its wires.
///
/// `positions`: one for each vertex, in the rest frame of its body, where angles do not depend on
/// the speed.
pub fn vertex_shares(scene: &Scene, positions: &[DVec3]) -> Vec<Shares> {
    // If all vertices have a colour, the faces do not matter.
    let own = scene.vertices.iter().map(|vertex| vertex.color.map(|color| Shares::One(Some(color))));
    if let Some(shares) = own.collect() {
        return shares;
    }
    let mut sums: Vec<Sum> = scene.vertices.iter().map(|vertex| Sum::new(vertex.color)).collect();
    let mut use_colour = |contour: &[VertexId], color: Option<ColorId>, weighted: bool| {
        for (idx, corner) in contour.iter().enumerate() {
            let weight = || if weighted { corner_angle(contour, idx, positions) } else { 1.0 };
            sums[corner.index()].add(color, weight);
        }
    };
    for face in &scene.faces {
        scene.face_contours(face).for_each(|contour| use_colour(contour, face.color, true));
    }
    // Wires matter only for vertices that no face uses.
    let used_by_faces: Vec<bool> =
        if scene.wires.is_empty() { Vec::new() } else { face_vertices(scene, scene.vertices.len()) };
    for wire in &scene.wires {
        for corner in scene.wire_contours(wire).flatten() {
            if !used_by_faces[corner.index()] {
                use_colour(std::slice::from_ref(corner), wire.color, false);
            }
        }
    }
    sums.into_iter().map(Sum::finish).collect()
}

/// For each of the first `n_vertices` vertices, true if it is a corner of a face. All corners are
/// below `n_vertices`; the vertices themselves need not be in the scene yet.
pub fn face_vertices(scene: &Scene, n_vertices: usize) -> Vec<bool> {
    let mut used = vec![false; n_vertices];
    for face in &scene.faces {
        scene.contours.corners(face.contours.clone()).iter().for_each(|corner| used[corner.index()] = true);
    }
    used
}

/// The colours at a vertex so far, with the sums of their weights.
enum Sum {
    /// That of the vertex itself.
    Own(ColorId),
    Nothing,
    One {
        color: Option<ColorId>,
        weight: f64,
    },
    Many(Parts),
}

/// Colours in the order of their first face, with the sums of their weights.
struct Parts {
    all: Vec<(Option<ColorId>, f64)>,
    /// The index of each colour; no elements while there are few.
    index: FxHashMap<Option<ColorId>, usize>,
}

impl Parts {
    /// More colours are found through the index.
    const FEW: usize = 16;

    fn new(parts: [(Option<ColorId>, f64); 2]) -> Self {
        Self { all: parts.to_vec(), index: FxHashMap::default() }
    }

    fn add(&mut self, color: Option<ColorId>, weight: f64) {
        let found = match self.all.len() {
            ..=Self::FEW => self.all.iter().position(|part| part.0 == color),
            _ => self.index.get(&color).copied(),
        };
        if let Some(row) = found {
            self.all[row].1 += weight;
            return;
        }
        self.all.push((color, weight));
        match self.all.len() - 1 {
            ..Self::FEW => {}
            Self::FEW => self.index.extend(self.all.iter().enumerate().map(|(row, part)| (part.0, row))),
            last => drop(self.index.insert(color, last)),
        }
    }
}

impl Sum {
    fn new(own: Option<ColorId>) -> Self {
        own.map_or(Self::Nothing, Self::Own)
    }

    fn add(&mut self, color: Option<ColorId>, weight: impl Fn() -> f64) {
        match self {
            Self::Own(_) => {}
            Self::Nothing => *self = Self::One { color, weight: weight() },
            Self::One { color: first, weight: sum } if *first == color => *sum += weight(),
            Self::One { color: first, weight: sum } => {
                *self = Self::Many(Parts::new([(*first, *sum), (color, weight())]));
            }
            Self::Many(parts) => parts.add(color, weight()),
        }
    }

    fn finish(self) -> Shares {
        match self {
            Self::Own(color) => Shares::One(Some(color)),
            Self::Nothing => Shares::One(None),
            Self::One { color, .. } => Shares::One(color),
            Self::Many(Parts { all: mut parts, .. }) => {
                let whole: f64 = parts.iter().map(|part| part.1).sum();
                // All angles are 0.
                if whole <= 0.0 {
                    return Shares::One(None);
                }
                parts.iter_mut().for_each(|part| part.1 /= whole);
                Shares::Mixed(parts)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every colour is on two faces, so its share is twice that of a face.
    #[test]
    fn colours_are_counted_once_in_their_order() {
        for n_colors in [2, 3, 15, 16, 17, 18, 100_000] {
            let color = |row: usize| (row > 0).then(|| ColorId::from_index(row));
            let mut sum = Sum::new(None);
            (0..2 * n_colors).for_each(|face| sum.add(color(face % n_colors), || 0.5));
            let Shares::Mixed(parts) = sum.finish() else { panic!("several colours are mixed") };
            let share = 1.0 / n_colors as f64;
            assert!(parts.into_iter().eq((0..n_colors).map(|row| (color(row), share))), "{n_colors}");
        }
    }
}
