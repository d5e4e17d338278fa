//! Clipping of polygons.

/// Clips a polygon by one boundary (Sutherland and Hodgman 1974): the corners that are left are
/// added to `kept`.
///
/// `edges`: from corner to corner, once around. `crossing` is passed the inner end of an edge
/// first, whichever way the polygon winds, so two polygons that share an edge share its crossing
/// exactly.
pub fn clip_edges<P>(
    edges: impl Iterator<Item = (P, P)>,
    is_inside: impl Fn(&P) -> bool,
    crossing: impl Fn(&P, &P) -> P,
    kept: &mut Vec<P>,
) {
    for (a, b) in edges {
        match (is_inside(&a), is_inside(&b)) {
            (true, true) => kept.push(b),
            (true, false) => kept.push(crossing(&a, &b)),
            (false, true) => kept.extend([crossing(&b, &a), b]),
            (false, false) => {}
        }
    }
}
