//! Removes degenerate faces and wires, which would draw nothing.

use std::ops::Range;

use rayon::prelude::*;
use ugscene::{Contours, Face, RoundShape, Vertex, VertexId, Wire, newell_normal};

use super::corners::{LEAST_ROWS, is_linked};
use crate::diagnostic::Diagnostic;
use crate::reader::names_in;
use crate::scope::Scope;
use crate::source::Span;
use crate::statement::NameKind;

/// Removes faces with fewer than three different vertices in a contour, or without area, and wires
/// of fewer than two vertices. Returns a warning for each. `vertices`: those of the scope, with
/// others behind. `has_corners`: every corner is a row of them.
pub(crate) fn remove_degenerate(
    text: &[u8],
    scope: &mut Scope<'_>,
    vertices: &[Vertex],
    has_corners: bool,
) -> Vec<Diagnostic> {
    let Scope { faces, wires, contours, .. } = &*scope;
    let is_whole = |rows: &Range<u32>| has_corners || is_linked(contours.corners(rows.clone()));
    let problem = |face: &Face| {
        is_whole(&face.contours).then(|| degeneracy(contours, vertices, face)).flatten()
    };
    let is_short = |wire: &Wire| is_whole(&wire.contours) && is_short(contours, wire);
    let rows = |n: usize| (0..n).into_par_iter().with_min_len(LEAST_ROWS);
    let flat: Vec<usize> =
        rows(faces.len()).filter(|&row| problem(&faces.rows[row]).is_some()).collect();
    let short: Vec<usize> = rows(wires.len()).filter(|&row| is_short(&wires.rows[row])).collect();
    let of_face = |&row: &usize| {
        let problem = problem(&faces.rows[row]).unwrap_or_default();
        omitted(text, faces.spans[row], "face", problem, "remove it, or correct its vertices")
    };
    let of_wire = |&row: &usize| short_wire(text, wires.spans[row]);
    let found = flat.iter().map(of_face).chain(short.iter().map(of_wire)).collect();
    scope.remove(&flat, &short);
    found
}

/// Why a face is degenerate, if it is.
pub(crate) fn degeneracy(
    contours: &Contours,
    vertices: &[Vertex],
    face: &Face,
) -> Option<&'static str> {
    if !contours.iter(face.contours.clone()).all(has_three) {
        return Some("has a contour of fewer than 3 different vertices");
    }
    if face.shape.is_round() {
        let corners = contours.corners(face.contours.clone()).iter();
        let corners: Vec<_> = corners.map(|corner| vertices[corner.index()].position).collect();
        return RoundShape::from_corners(face.shape, &corners).is_none().then_some("has no area");
    }
    let outline = contours.get(face.contours.start);
    let corners = outline.iter().map(|corner| vertices[corner.index()].position);
    (newell_normal(corners) == glam::DVec3::ZERO).then_some("has no area")
}

/// Does a contour have three different vertices?
fn has_three(corners: &[VertexId]) -> bool {
    let Some((&a, rest)) = corners.split_first() else { return false };
    let Some(&b) = rest.iter().find(|&&c| c != a) else { return false };
    rest.iter().any(|&c| c != a && c != b)
}

/// Is a wire degenerate?
pub(crate) fn is_short(contours: &Contours, wire: &Wire) -> bool {
    wire.text.is_none() && contours.iter(wire.contours.clone()).any(|contour| contour.len() < 2)
}

/// The warning for a degenerate wire.
pub(crate) fn short_wire(text: &[u8], span: Span) -> Diagnostic {
    omitted(
        text,
        span,
        "wire",
        "has a contour of fewer than 2 vertices",
        "remove it, or add a vertex",
    )
}

fn omitted(text: &[u8], span: Span, kind: &str, problem: &str, remedy: &str) -> Diagnostic {
    let name = face_name(text, span);
    let shown = name.map_or(String::new(), |name| format!(" `{}`", name.lossy(text)));
    let span = name.unwrap_or(Span { start: span.start, end: span.start + 1 });
    Diagnostic::warning(span, format!("{kind}{shown} {problem}")).label("omitted").help(remedy)
}

/// The span of the name of the face or wire at `span`.
pub(crate) fn face_name(text: &[u8], span: Span) -> Option<Span> {
    names_in(text, span).into_iter().find(|(kind, _)| *kind == NameKind::Own).map(|(_, name)| name)
}
