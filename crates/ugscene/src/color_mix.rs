//! The colours that meet at a vertex, and their weights (Nguyen 1988, 4.1).

use glam::DVec3;
use rustc_hash::FxHashMap;

use crate::{ColorId, Scene, VertexId, corner_angle};

/// The colours of a vertex. `None` is white, for faces without a colour.
#[derive(Clone, Debug, PartialEq)]
pub enum ColorMix {
    /// Its own, or that of all its faces.
    One(Option<ColorId>),
    /// The colours of its faces, each once, weighted by the angles of the faces at the vertex; or
    /// the parts of a mixture (`c_mix`). In the order of the faces; the weights add up to 1.
    Mixed(Vec<(Option<ColorId>, f64)>),
}

impl ColorMix {
    /// Where colours are spectra: a mixture (`c_mix`) is its parts.
    #[must_use]
    pub fn of_spectra(self, scene: &Scene) -> Self {
        let mix = |color: Option<ColorId>| color.map_or(&[][..], |color| scene.mix_of(color));
        let has_none =
            scene.mixes.is_empty() || self.parts().all(|(color, _)| mix(color).is_empty());
        if has_none {
            return self;
        }
        let parts = self.parts().flat_map(|(color, share)| {
            let parts = mix(color).iter().map(move |&(part, of_mix)| (Some(part), share * of_mix));
            let own = mix(color).is_empty().then_some((color, share));
            own.into_iter().chain(parts)
        });
        Self::Mixed(parts.collect())
    }

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
pub fn vertex_mixes(scene: &Scene, positions: &[DVec3]) -> Vec<ColorMix> {
    // If all vertices have a colour, the faces do not matter.
    let own =
        scene.vertices.iter().map(|vertex| vertex.color.map(|color| ColorMix::One(Some(color))));
    if let Some(shares) = own.collect() {
        return shares;
    }
    let mut sums: Vec<Sum> = scene.vertices.iter().map(|vertex| Sum::new(vertex.color)).collect();
    for_each_corner(scene, |contour, idx, color, _| sums[contour[idx].index()].meet(color));
    // Angles, which are slow to compute, are needed only where several colours meet.
    if sums.iter().any(|sum| matches!(sum, Sum::Many(_))) {
        for_each_corner(scene, |contour, idx, color, is_of_face| {
            if let Sum::Many(parts) = &mut sums[contour[idx].index()] {
                parts.add(
                    color,
                    if is_of_face { corner_angle(contour, idx, positions) } else { 1.0 },
                );
            }
        });
    }
    sums.into_iter().map(Sum::finish).collect()
}

/// Calls `visit` with each corner of a face, and of wires at vertices that no face uses: the
/// contour, the index in it, the colour, and true for a face.
fn for_each_corner(
    scene: &Scene,
    mut visit: impl FnMut(&[VertexId], usize, Option<ColorId>, bool),
) {
    for face in &scene.faces {
        for contour in scene.face_contours(face) {
            (0..contour.len()).for_each(|idx| visit(contour, idx, face.color, true));
        }
    }
    if scene.wires.is_empty() {
        return;
    }
    let used_by_faces = face_vertices(scene, scene.vertices.len());
    for wire in &scene.wires {
        for corner in scene.wire_contours(wire).flatten() {
            if !used_by_faces[corner.index()] {
                visit(std::slice::from_ref(corner), 0, wire.color, false);
            }
        }
    }
}

/// For each of the first `n_vertices` vertices, true if it is a corner of a face. All corners are
/// below `n_vertices`; the vertices themselves need not be in the scene yet.
pub fn face_vertices(scene: &Scene, n_vertices: usize) -> Vec<bool> {
    let mut used = vec![false; n_vertices];
    for face in &scene.faces {
        scene.face_corners(face).iter().for_each(|corner| used[corner.index()] = true);
    }
    used
}

/// The colours at a vertex.
enum Sum {
    /// The colour of the vertex itself.
    Own(ColorId),
    Nothing,
    One(Option<ColorId>),
    /// Several, with the weights added so far.
    Many(Parts),
}

/// Colours in the order of their first face, with the sums of their weights.
#[derive(Default)]
struct Parts {
    all: Vec<(Option<ColorId>, f64)>,
    /// The index of each colour; no elements while there are few.
    index: FxHashMap<Option<ColorId>, usize>,
}

impl Parts {
    /// More colours are found through the index.
    const FEW: usize = 16;

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
            Self::FEW => {
                self.index.extend(self.all.iter().enumerate().map(|(row, part)| (part.0, row)))
            }
            last => drop(self.index.insert(color, last)),
        }
    }
}

impl Sum {
    fn new(own: Option<ColorId>) -> Self {
        own.map_or(Self::Nothing, Self::Own)
    }

    /// Notes a colour. Weights are added when all colours are noted.
    fn meet(&mut self, color: Option<ColorId>) {
        match self {
            Self::Own(_) | Self::Many(_) => {}
            Self::Nothing => *self = Self::One(color),
            Self::One(first) if *first == color => {}
            Self::One(_) => *self = Self::Many(Parts::default()),
        }
    }

    fn finish(self) -> ColorMix {
        match self {
            Self::Own(color) => ColorMix::One(Some(color)),
            Self::Nothing => ColorMix::One(None),
            Self::One(color) => ColorMix::One(color),
            Self::Many(Parts { all: mut parts, .. }) => {
                let whole: f64 = parts.iter().map(|part| part.1).sum();
                // All angles are 0.
                if whole <= 0.0 {
                    return ColorMix::One(None);
                }
                parts.iter_mut().for_each(|part| part.1 /= whole);
                ColorMix::Mixed(parts)
            }
        }
    }
}
