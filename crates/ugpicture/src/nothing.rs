//! Why nothing is drawn. The cause is found in the scene, so that all renderers name the same one.

use std::fmt;

use glam::DVec3;
use ugscene::{HalfSpace, Scene, VertexId, View};

use crate::note::Note;

/// The contents of a scene without faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WithoutFaces {
    /// Its vertices, such as those of a point cloud.
    pub n_points: usize,
    /// It has wires, which rays do not meet.
    pub has_wires: bool,
}

impl WithoutFaces {
    /// Counts the contents of a scene without faces.
    pub fn new(scene: &Scene) -> Self {
        Self { n_points: scene.vertices.len(), has_wires: !scene.wires.is_empty() }
    }
}

impl fmt::Display for WithoutFaces {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("nothing is drawn: the scene has no faces")?;
        match self {
            Self { has_wires: true, .. } => f.write_str(", only wires, which rays do not meet"),
            Self { n_points: 0, .. } => f.write_str(" and no wires"),
            Self { n_points: 1, .. } => f.write_str(" and no wires, only a point"),
            Self { n_points, .. } => write!(f, " and no wires, only {n_points} points"),
        }
    }
}

/// Least extent, in samples, of a face that surely covers one unless it is seen edge-on.
const SAMPLES: f64 = 2.0;

/// Why no sample shows anything of a scene as it is seen. `view`: `None` if the picture is not
/// flat, so that the cause must be looked for elsewhere. `is_culled`: faces seen from behind are
/// left out.
pub fn why_nothing_is_seen(scene: &Scene, view: Option<&View>, is_culled: bool) -> Note {
    if is_all_transparent(scene) {
        return Note::AllTransparent;
    }
    let Some(view) = view else { return Note::NothingInPicture };
    let spaces = view.half_spaces();
    let (mut is_in_front, mut largest) = (false, None);
    for_each_outline(scene, |outline| {
        let outline = outline.into_iter().map(|point| point - view.eye).collect();
        let in_front = cut(outline, &spaces[4..]);
        is_in_front |= !in_front.is_empty();
        let seen = cut(in_front, &spaces[..4]);
        if !seen.is_empty() {
            largest = Some(extent(view, &seen).max(largest.unwrap_or(0.0)));
        }
    });
    match largest {
        _ if !is_in_front => Note::NothingInFront,
        None => Note::NothingInPicture,
        Some(extent) if extent < SAMPLES => Note::TooSmall,
        Some(_) if is_culled => Note::BackFacing,
        Some(_) => Note::EdgeOn,
    }
}

/// True if every face has a colour of translucency 1, without texture, mirror or medium.
pub fn is_all_transparent(scene: &Scene) -> bool {
    let is_clear = |face: &ugscene::Face| {
        face.color.is_some_and(|color| {
            scene.colors[color.index()].translucency >= 1.0 && scene.texture_of(color).is_none()
        }) && scene.surface(face).is_none()
    };
    scene.wires.is_empty() && scene.faces.iter().all(is_clear)
}

/// Passes on the corners of each contour of faces and wires, and of the boxes around round faces.
fn for_each_outline(scene: &Scene, mut take: impl FnMut(Vec<DVec3>)) {
    /// The corners of each side of a box: bit i of a corner's number selects the lower or
    /// upper bound of coordinate i.
    const SIDES: [[usize; 4]; 6] =
        [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    let position = |vertex: VertexId| scene.vertices[vertex.index()].position;
    for face in &scene.faces {
        let Some(round) = scene.round_shape(face, position) else {
            for contour in scene.face_contours(face) {
                take(contour.iter().map(|&vertex| position(vertex)).collect());
            }
            continue;
        };
        let ends = round.bounds();
        let corner = |at: usize| DVec3::new(ends[at & 1].x, ends[at >> 1 & 1].y, ends[at >> 2].z);
        SIDES.iter().for_each(|side| take(side.iter().map(|&at| corner(at)).collect()));
    }
    for wire in &scene.wires {
        for contour in scene.contours.iter(wire.contours.clone()) {
            take(contour.iter().map(|&vertex| position(vertex)).collect());
        }
    }
}

/// The part of a polygon in half-spaces.
fn cut(mut outline: Vec<DVec3>, spaces: &[Option<HalfSpace>]) -> Vec<DVec3> {
    for space in spaces.iter().flatten() {
        let height = |point: DVec3| point.dot(space.normal) + space.offset;
        let mut inside = Vec::with_capacity(outline.len() + 2);
        for (idx, &point) in outline.iter().enumerate() {
            let next = outline[(idx + 1) % outline.len()];
            let (here, there) = (height(point), height(next));
            if here >= 0.0 {
                inside.push(point);
            }
            if (here >= 0.0) != (there >= 0.0) {
                inside.push(point + here / (here - there) * (next - point));
            }
        }
        outline = inside;
    }
    outline
}

/// The greater side of the box around a polygon in the picture, in samples.
fn extent(view: &View, outline: &[DVec3]) -> f64 {
    let place = |&point: &DVec3| {
        let place = view.place(point);
        let w = if view.is_perspective { place.z } else { 1.0 };
        [place.x / w, place.y / w]
    };
    let span = |axis: usize| {
        let places = || outline.iter().map(|point| place(point)[axis]);
        places().fold(f64::NEG_INFINITY, f64::max) - places().fold(f64::INFINITY, f64::min)
    };
    span(0).max(span(1))
}
