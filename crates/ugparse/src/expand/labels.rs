//! Labels move with their vertices.

use rustc_hash::FxHashMap;
use ugscene::{Scene, VertexId};

/// Makes each label part of the body of the first face, or else wire, that uses its vertex, and
/// removes the default colour of wires from it. A label at a vertex that nothing uses keeps its
/// body.
pub(super) fn follow_vertices(scene: &mut Scene) {
    let Scene { wires, faces, contours, .. } = scene;
    let vertex = |wire: &ugscene::Wire| -> Option<VertexId> {
        wire.text.and(contours.corners(wire.contours.clone()).first().copied())
    };
    let mut bodies: FxHashMap<_, _> =
        wires.iter().filter_map(|wire| Some((vertex(wire)?, wire.body))).collect();
    if bodies.is_empty() {
        return;
    }
    let lines =
        wires.iter().filter(|wire| wire.text.is_none()).map(|wire| (&wire.contours, wire.body));
    let users = faces.iter().map(|face| (&face.contours, face.body)).chain(lines);
    // In reverse, so that the first user is entered last.
    for (rows, body) in users.collect::<Vec<_>>().into_iter().rev() {
        for corner in contours.corners(rows.clone()) {
            bodies.entry(*corner).and_modify(|of_label| *of_label = body);
        }
    }
    for wire in wires {
        if let Some(vertex) = vertex(wire) {
            (wire.body, wire.color) = (bodies[&vertex], None);
        }
    }
}
