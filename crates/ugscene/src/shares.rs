//! The colours that meet at a vertex, and their weights (Nguyen 1988, 4.1).

use glam::DVec3;
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
    let used_by_faces: Vec<bool> = if scene.wires.is_empty() { Vec::new() } else { face_vertices(scene) };
    for wire in &scene.wires {
        for corner in scene.wire_contours(wire).flatten() {
            if !used_by_faces[corner.index()] {
                use_colour(std::slice::from_ref(corner), wire.color, false);
            }
        }
    }
    sums.into_iter().map(Sum::finish).collect()
}

fn face_vertices(scene: &Scene) -> Vec<bool> {
    let mut used = vec![false; scene.vertices.len()];
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
    Many(Vec<(Option<ColorId>, f64)>),
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
                *self = Self::Many(vec![(*first, *sum), (color, weight())]);
            }
            Self::Many(parts) => match parts.iter_mut().find(|part| part.0 == color) {
                Some((_, sum)) => *sum += weight(),
                None => parts.push((color, weight())),
            },
        }
    }

    fn finish(self) -> Shares {
        match self {
            Self::Own(color) => Shares::One(Some(color)),
            Self::Nothing => Shares::One(None),
            Self::One { color, .. } => Shares::One(color),
            Self::Many(mut parts) => {
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
