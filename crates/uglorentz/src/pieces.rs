//! The pieces of faces and wires.

use glam::DVec3;
use ugscene::{Face, Scene, VertexId, closed};

/// A piece of a face that can be subdivided: corners by vertex row, in the orientation of the face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shape {
    /// A triangle.
    Triangle([u32; 3]),
    /// A convex quadrilateral.
    Quad([u32; 4]),
}

impl Shape {
    pub(crate) fn corners(&self) -> &[u32] {
        match self {
            Shape::Triangle(corners) => corners,
            Shape::Quad(corners) => corners,
        }
    }

    /// From each corner to the next.
    pub(crate) fn edges(&self) -> impl Iterator<Item = (u32, u32)> {
        closed(self.corners()).map(|[from, to]| (from, to))
    }
}

/// A piece and its face.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    /// Row of the face.
    pub face: u32,
    /// The piece.
    pub shape: Shape,
}

/// A contour that only gets more corners: of a wire, or of a face that cannot be triangulated.
#[derive(Clone, Debug)]
pub(crate) struct Polyline {
    /// Row of the contour.
    pub row: u32,
    /// Does an edge connect the last corner with the first?
    pub is_closed: bool,
    /// Vertex rows.
    pub corners: Vec<u32>,
}

impl Polyline {
    pub(crate) fn open(row: u32, corners: &[VertexId]) -> Polyline {
        Polyline { row, is_closed: false, corners: rows(corners) }
    }

    pub(crate) fn closed(row: u32, corners: &[VertexId]) -> Polyline {
        Polyline { row, is_closed: true, corners: rows(corners) }
    }

    /// From each corner to the next.
    pub(crate) fn edges(&self) -> impl Iterator<Item = (u32, u32)> {
        let n_edges = self.corners.len() - usize::from(!self.is_closed);
        closed(&self.corners).map(|[from, to]| (from, to)).take(n_edges)
    }
}

fn vertex_ids(rows: &[u32]) -> impl Iterator<Item = VertexId> {
    rows.iter().map(|&row| VertexId(row))
}

fn rows(corners: &[VertexId]) -> Vec<u32> {
    corners.iter().map(|corner| corner.0).collect()
}

/// A face prepared for subdivision.
#[derive(Clone, Debug)]
pub(crate) enum Cut {
    /// As triangles and convex quadrilaterals.
    Pieces(Vec<Shape>),
    /// Its contours, since it is seen edge-on.
    EdgeOn(Vec<Polyline>),
    /// Its contours, since they intersect or enclose no area.
    Contours(Vec<Polyline>),
}

/// A face as triangles and convex quadrilaterals, in its rest plane. `None` if it has no corners.
///
/// `is_even`: its corners have the same colour and normal. Only then is a quadrilateral cut as
/// such: else a renderer interpolates in its triangles, and so do new vertices.
pub(crate) fn shape(
    scene: &Scene,
    face: &Face,
    is_even: bool,
    rest: impl Fn(VertexId) -> DVec3,
) -> Option<Cut> {
    let corners = scene.face_corners(face);
    if corners.is_empty() {
        return None;
    }
    if let &[a, b, c, d] = corners
        && is_even
        && face.contours.len() == 1
        && ugpolygon::is_convex(&[a, b, c, d].map(&rest))
    {
        return Some(Cut::Pieces(vec![Shape::Quad([a.0, b.0, c.0, d.0])]));
    }
    let triangle = |at: [u32; 3]| Shape::Triangle(at.map(|at| corners[at as usize].0));
    Some(match ugpolygon::face_triangles(scene, face, rest) {
        Some(triangles) => Cut::Pieces(triangles.into_iter().map(triangle).collect()),
        None => Cut::Contours(as_contours(scene, face)),
    })
}

/// The contours of a face, as polylines.
pub(crate) fn as_contours(scene: &Scene, face: &Face) -> Vec<Polyline> {
    face.contours.clone().map(|row| Polyline::closed(row, scene.contours.get(row))).collect()
}

/// The result of subdivision.
#[derive(Debug, Default)]
pub(crate) struct Outcome {
    /// Pieces that replace faces, by face.
    pub pieces: Vec<Piece>,
    /// Contours with more corners.
    pub lines: Vec<Polyline>,
    /// Faces with errors inside that cannot be triangulated.
    pub n_uncut: usize,
    /// Edges above the bound at the limit of halvings.
    pub n_too_deep: usize,
    /// Did subdivision stop at the limit of pieces?
    pub is_full: bool,
}

impl Outcome {
    /// Replaces each subdivided face and wire with its pieces.
    pub(crate) fn put_into(&self, scene: &mut Scene) {
        if self.pieces.is_empty() && self.lines.is_empty() {
            return;
        }
        let mut lines: Vec<&Polyline> = self.lines.iter().collect();
        lines.sort_by_key(|line| line.row);
        let old = std::mem::take(&mut scene.contours);
        let kept = |row: u32| {
            let (whole, cut): (&[VertexId], &[u32]) =
                match lines.binary_search_by_key(&row, |line| line.row) {
                    Ok(at) => (&[], &lines[at].corners),
                    Err(_) => (old.get(row), &[]),
                };
            whole.iter().copied().chain(vertex_ids(cut))
        };

        let contours = &mut scene.contours;
        let mut faces = Vec::with_capacity(scene.faces.len() + self.pieces.len());
        let mut groups = self.pieces.chunk_by(|a, b| a.face == b.face).peekable();
        for (idx, face) in std::mem::take(&mut scene.faces).into_iter().enumerate() {
            let Some(group) = groups.next_if(|group| group[0].face as usize == idx) else {
                faces.push(Face {
                    contours: contours.push_all(face.contours.clone().map(kept)),
                    ..face
                });
                continue;
            };
            for piece in group {
                let rows = contours.push_all([vertex_ids(piece.shape.corners())]);
                faces.push(Face { contours: rows, ..face.clone() });
            }
        }
        scene.faces = faces;
        for wire in &mut scene.wires {
            wire.contours = contours.push_all(wire.contours.clone().map(kept));
        }
    }
}
