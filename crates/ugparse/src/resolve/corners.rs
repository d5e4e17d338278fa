//! Resolves the corners of faces and wires.

use rayon::prelude::*;
use ugscene::VertexId;

use crate::reader::names_in;
use crate::scope::{NO_ROW, PathCorner, Scope};
use crate::statement::NameKind;

/// The least number of rows per thread.
pub(super) const LEAST_ROWS: usize = 1 << 15;

/// Replaces numbers of names by rows of vertices; returns false if a vertex is not defined.
pub(super) fn link_corners(scope: &mut Scope<'_>) -> bool {
    let names = std::mem::take(&mut scope.vertex_names);
    let mut rows = std::mem::take(&mut scope.vertex_rows);
    rows.resize(names.len(), NO_ROW);
    let corners = scope.contours.all_corners_mut();
    let in_order = rows.iter().enumerate().all(|(number, &row)| number == row as usize);
    if !in_order {
        let corners = corners.par_iter_mut().with_min_len(LEAST_ROWS);
        corners.for_each(|corner| *corner = VertexId(rows[corner.index()]));
    }
    let is_complete = in_order || !corners.contains(&VertexId(NO_ROW));
    scope.vertex_names = names;
    scope.vertex_rows = rows;
    is_complete
}

/// True if all corners are rows of vertices.
pub(super) fn is_linked(corners: &[VertexId]) -> bool {
    !corners.contains(&VertexId(NO_ROW))
}

/// The corners that name vertices of instances.
pub(super) fn path_corners(text: &[u8], scope: &Scope<'_>) -> Vec<PathCorner> {
    let mut paths = Vec::new();
    let faces = scope.faces.rows.iter().map(|face| &face.contours).zip(&scope.faces.spans);
    let wires = scope.wires.rows.iter().map(|wire| &wire.contours).zip(&scope.wires.spans);
    for (contours, &span) in faces.chain(wires) {
        let corners = scope.contours.corners(contours.clone());
        if is_linked(corners) {
            continue;
        }
        let names = names_in(text, span).into_iter().filter(|(kind, _)| *kind == NameKind::Vertex);
        for ((corner, vertex), (_, name)) in
            (scope.contours.first_corner(contours.start)..).zip(corners).zip(names)
        {
            if vertex.0 == NO_ROW && scope.may_be_path(name.of(text)) {
                paths.push(PathCorner { corner, name });
            }
        }
    }
    paths
}
