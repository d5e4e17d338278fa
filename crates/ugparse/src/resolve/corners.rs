//! Corners of faces and wires: from names to rows of vertices.

use super::complaints::read_again;
use super::left_out::is_linked;
use crate::group::{Group, NO_ROW, PathCorner};
use crate::scene::VertexId;
use crate::source::Span;
use crate::statement::References;

/// Rows that a thread should have at least.
pub(super) const LEAST_ROWS: usize = 1 << 15;

/// Turns numbers of names into rows of vertices; false if a vertex is not defined.
pub(super) fn link_corners(group: &mut Group<'_>) -> bool {
    let names = std::mem::take(&mut group.vertex_names);
    let mut rows = std::mem::take(&mut group.vertex_rows);
    rows.resize(names.len(), NO_ROW);
    let (corners, _) = group.contours.parts_mut();
    let in_order = rows.iter().enumerate().all(|(number, &row)| number == row as usize);
    if !group.is_linked && !in_order {
        ugparallel::for_each_mut(corners, LEAST_ROWS, |_, corner| *corner = VertexId(rows[corner.index()]));
    }
    let is_complete = in_order || !corners.contains(&VertexId(NO_ROW));
    group.vertex_names = names;
    group.vertex_rows = rows;
    is_complete
}

/// The corners that name vertices of instances.
pub(super) fn path_corners(text: &[u8], group: &Group<'_>) -> Vec<PathCorner> {
    let mut paths = Vec::new();
    let faces = group.faces.rows.iter().map(|face| &face.contours).zip(&group.faces.spans);
    let wires = group.wires.rows.iter().map(|wire| &wire.contours).zip(&group.wires.spans);
    let mut references = References::default();
    for (contours, &span) in faces.chain(wires) {
        let corners = group.contours.corners(contours.clone());
        if is_linked(corners) {
            continue;
        }
        read_again(text, span, &mut references);
        let first = group.contours.first_corner(contours.start);
        let places = (first..).zip(corners.iter().zip(&references.names));
        let of_instances = |name: &Span| group.may_be_path(name.of(text));
        paths.extend(
            places
                .filter(|(_, (corner, name))| corner.0 == NO_ROW && of_instances(name))
                .map(|(corner, (_, &name))| PathCorner { corner, name }),
        );
    }
    paths
}
