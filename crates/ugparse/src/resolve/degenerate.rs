//! Removes degenerate faces and wires, which would draw nothing.

use rayon::prelude::*;
use ugscene::{Contours, Face, RoundShape, Vertex, VertexId, Wire, newell_normal};

use super::corners::{LEAST_ROWS, is_linked};
use super::undefined::show;
use crate::diagnostic::Diagnostic;
use crate::reader::names_in;
use crate::scope::Scope;
use crate::source::Span;
use crate::statement::NameKind;

/// Removes faces with fewer than three different vertices in a contour, or without area, with a
/// warning for each.
pub(super) fn remove_degenerate_faces(
    text: &[u8],
    scope: &mut Scope<'_>,
    has_corners: bool,
    findings: &mut Vec<Diagnostic>,
) {
    let is_whole = |face: &Face| has_corners || is_linked(scope.contours.corners(face.contours.clone()));
    let problem = |face: &Face| degeneracy(&scope.contours, &scope.vertices.rows, face);
    let faces = &scope.faces.rows;
    let is_degenerate = |&row: &usize| is_whole(&faces[row]) && problem(&faces[row]).is_some();
    let rows = (0..faces.len()).into_par_iter().with_min_len(LEAST_ROWS);
    let degenerate: Vec<usize> = rows.filter(is_degenerate).collect();
    for &row in &degenerate {
        let problem = problem(&scope.faces.rows[row]).unwrap_or_default();
        let span = scope.faces.spans[row];
        findings.push(omitted(text, span, "face", problem, "remove it, or correct its vertices"));
    }
    scope.remove_faces(&degenerate);
}

pub(super) fn remove_short_wires(
    text: &[u8],
    scope: &mut Scope<'_>,
    has_corners: bool,
    findings: &mut Vec<Diagnostic>,
) {
    let wires = &scope.wires.rows;
    let is_whole = |wire: &Wire| has_corners || is_linked(scope.contours.corners(wire.contours.clone()));
    let is_short = |&row: &usize| is_whole(&wires[row]) && is_short(&scope.contours, &wires[row]);
    let rows = (0..wires.len()).into_par_iter().with_min_len(LEAST_ROWS);
    let short: Vec<usize> = rows.filter(is_short).collect();
    findings.extend(short.iter().map(|&row| short_wire(text, scope.wires.spans[row])));
    scope.remove_wires(&short);
}

/// Why a face is degenerate, if it is.
pub(crate) fn degeneracy(contours: &Contours, vertices: &[Vertex], face: &Face) -> Option<&'static str> {
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
pub(crate) fn has_three(corners: &[VertexId]) -> bool {
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
    omitted(text, span, "wire", "has a contour of fewer than 2 vertices", "remove it, or add a vertex")
}

pub(crate) fn omitted(text: &[u8], span: Span, kind: &str, problem: &str, remedy: &str) -> Diagnostic {
    let name = face_name(text, span);
    let shown = name.map_or(String::new(), |name| format!(" `{}`", show(text, name)));
    let span = name.unwrap_or(Span { start: span.start, end: span.start + 1 });
    Diagnostic::warning(span, format!("{kind}{shown} {problem}")).label("omitted").help(remedy)
}

/// The span of the name of the face or wire at `span`.
pub(crate) fn face_name(text: &[u8], span: Span) -> Option<Span> {
    names_in(text, span).into_iter().find(|(kind, _)| *kind == NameKind::Own).map(|(_, name)| name)
}
