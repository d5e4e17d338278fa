//! Triangles of polygons with few corners, by cutting ears.
//!
//! Every choice goes by the order of corners, and every comparison has a tolerance far above
//! rounding errors. Libraries that were tried compare coordinates exactly: then rounding decides
//! where corners of a polygon and its holes are on one line, as those of a window's panes are.

use glam::DVec2;

use super::{STRAIGHT, Triangle};

/// A corner with its number.
type Corner = (u32, DVec2);

/// Distances below this part of the size of the polygon count as 0.
const ROUNDING: f64 = 1e-9;

/// Appends the triangles inside an outline and outside its holes, counterclockwise.
///
/// `contours`: the outline, then the holes, all with the inside on the left. `None` if the contours
/// cross.
pub(super) fn triangulate(contours: &[Vec<Corner>], triangles: &mut Vec<Triangle>) -> Option<()> {
    let corners = contours.iter().flatten();
    let reach = corners.map(|corner| corner.1.abs().max_element()).fold(0.0, f64::max);
    let tolerance = ROUNDING * reach;
    let mut polygon = contours.first()?.clone();
    for (idx, hole) in contours.iter().enumerate().skip(1) {
        let (at, from) = bridge(&polygon, &contours[idx..], tolerance)?;
        let end = polygon[at];
        // There, around the hole, and back.
        let around = hole.iter().cycle().skip(from).take(hole.len() + 1).copied();
        polygon.splice(at + 1..at + 1, around.chain([end]).collect::<Vec<_>>());
    }
    while polygon.len() > 3 {
        let n = polygon.len();
        // From the second corner, so that a convex polygon is cut by diagonals from the first.
        let in_order = || (1..n).chain([0]);
        let strict = in_order().find(|&at| is_ear(&polygon, at, tolerance));
        let ear = strict.or_else(|| in_order().find(|&at| is_ear(&polygon, at, -tolerance)))?;
        triangles.push([(ear + n - 1) % n, ear, (ear + 1) % n].map(|at| polygon[at].0));
        polygon.remove(ear);
    }
    triangles.push([polygon.first()?.0, polygon.get(1)?.0, polygon.get(2)?.0]);
    Some(())
}

/// Positive if a, b, c run counterclockwise: the distance of c from the line through a and b, times
/// their distance.
fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// The distance of `p` to the left of the line from a to b; 0 if these coincide.
fn left(a: DVec2, b: DVec2, p: DVec2) -> f64 {
    Side { a, b, length: (b - a).length() }.left(p)
}

/// The line from a to b, and the distance of these.
struct Side {
    a: DVec2,
    b: DVec2,
    length: f64,
}

impl Side {
    /// See [`left`].
    fn left(&self, p: DVec2) -> f64 {
        if self.length > 0.0 { turn(self.a, self.b, p) / self.length } else { 0.0 }
    }
}

/// Can a corner be cut off? Its neighbours see each other, and no corner is between. `tolerance`:
/// corners so close to the triangle count as inside of it; if negative, so do corners so far
/// inside, and straight corners can be cut off.
fn is_ear(polygon: &[Corner], at: usize, tolerance: f64) -> bool {
    let n = polygon.len();
    let [a, b, c] = [at + n - 1, at, at + 1].map(|at| polygon[at % n].1);
    let sine = if tolerance > 0.0 { STRAIGHT } else { -STRAIGHT };
    if turn(a, b, c) <= sine * (b - a).length() * (c - b).length() {
        return false;
    }
    let sides = [(a, b), (b, c), (c, a)].map(|(a, b)| Side { a, b, length: (b - a).length() });
    let is_inside = |p: DVec2| sides.iter().all(|side| side.left(p) >= -tolerance);
    let is_corner = |p: DVec2| [a, b, c].iter().any(|corner| corner.distance(p) <= tolerance.abs());
    // Few corners are inside, so that is tested first.
    polygon.iter().all(|&(_, p)| !is_inside(p) || is_corner(p))
}

/// The first corner of a hole that sees a corner of the polygon, and the first that it sees: the
/// index of that and its own. `holes`: the hole, and others that may be between.
fn bridge(polygon: &[Corner], holes: &[Vec<Corner>], tolerance: f64) -> Option<(usize, usize)> {
    let hole = holes.first()?;
    let edges = |ring: &[Corner]| -> Vec<[DVec2; 2]> {
        (0..ring.len()).map(|at| [ring[at].1, ring[(at + 1) % ring.len()].1]).collect()
    };
    let walls: Vec<[DVec2; 2]> = std::iter::once(polygon)
        .chain(holes.iter().map(|hole| &hole[..]))
        .flat_map(edges)
        .collect();
    let sees = |from: usize, at: usize| {
        let (p, q) = (hole[from].1, polygon[at].1);
        is_into(hole, from, q, tolerance)
            && is_into(polygon, at, p, tolerance)
            && walls.iter().all(|&wall| is_beside(wall, [p, q], tolerance))
    };
    let pairs = (0..hole.len()).flat_map(|from| (0..polygon.len()).map(move |at| (at, from)));
    pairs.into_iter().find(|&(at, from)| sees(from, at))
}

/// Does the way from a corner to `q` begin inside the polygon?
fn is_into(ring: &[Corner], at: usize, q: DVec2, tolerance: f64) -> bool {
    let n = ring.len();
    let [a, p, b] = [at + n - 1, at, at + 1].map(|at| ring[at % n].1);
    if turn(a, p, b) > 0.0 {
        left(a, p, q) > tolerance && left(p, b, q) > tolerance
    } else {
        left(a, p, q) > tolerance || left(p, b, q) > tolerance
    }
}

/// Does a wall leave the way between two points free? One that ends at such a point does, see
/// [`is_into`].
fn is_beside([a, b]: [DVec2; 2], [p, q]: [DVec2; 2], tolerance: f64) -> bool {
    let is_end = |wall: DVec2| p.distance(wall) <= tolerance || q.distance(wall) <= tolerance;
    let is_one_side = |[x, y]: [f64; 2]| x.min(y) > tolerance || x.max(y) < -tolerance;
    is_end(a)
        || is_end(b)
        || is_one_side([left(p, q, a), left(p, q, b)])
        || is_one_side([left(a, b, p), left(a, b, q)])
}
