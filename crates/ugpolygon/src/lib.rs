//! Polygons in their rest plane: convexity, and the triangles of a face.
//!
//! All programs compute the triangles of a face by [`triangulate`], each from rest positions with
//! rounding errors of its own and in axes of its own. So the result must not depend on either: no
//! choice is made by comparing lengths, of which those of a square are equal, and corners on
//! straight sides count as such with a tolerance.
//!
//! ```
//! use glam::dvec3;
//!
//! // An arrowhead: one corner points inwards.
//! let arrow = [dvec3(0., 0., 0.), dvec3(2., 1., 0.), dvec3(0., 2., 0.), dvec3(0.5, 1., 0.)];
//! assert!(!ugpolygon::is_convex(&arrow));
//! let triangles = ugpolygon::triangulate(&[arrow.to_vec()]).ok_or("no area")?;
//! assert_eq!(triangles.len(), 2);
//! # Ok::<(), &str>(())
//! ```

mod delaunay;
mod ears;

use glam::{DVec2, DVec3};
use rustc_hash::{FxHashMap, FxHashSet};
use ugscene::{Face, Scene, VertexId, newell_normal};

/// Three corners, as indices of the list of corners.
pub type Triangle = [u32; 3];

/// A corner with a sine below this is almost straight.
const STRAIGHT: f64 = 1e-6;

/// Is this contour convex, and no corner almost straight?
pub fn is_convex(corners: &[DVec3]) -> bool {
    let reach = corners.iter().map(|corner| corner.abs().max_element()).fold(0.0, f64::max);
    if !(1e-60..1e60).contains(&reach) {
        // Products of three vectors would overflow or underflow.
        return (reach > 0.0 && reach < f64::INFINITY)
            && is_convex(&corners.iter().map(|&corner| corner / reach).collect::<Vec<_>>());
    }
    let normal = newell_normal(corners.iter().copied());
    let least = STRAIGHT * normal.length();
    let n = corners.len();
    let is_left = |into: DVec3, out: DVec3| {
        into.cross(out).dot(normal) > least * into.length() * out.length()
    };
    let turns_left = |idx: usize| {
        let (back, here, ahead) =
            (corners[(idx + n - 1) % n], corners[idx], corners[(idx + 1) % n]);
        is_left(here - back, ahead - here)
    };
    // A star turns left at every corner, too, but runs around more than once. Four corners cannot.
    let from_first = |idx: usize| corners[idx] - corners[0];
    let is_ahead = |idx: usize| {
        let normal = |from: usize| from_first(from).cross(from_first(idx)).dot(normal);
        normal(1) > 0.0 && normal(idx - 1) > 0.0
    };
    n >= 3 && (0..n).all(turns_left) && (n == 4 || (2..n).all(is_ahead))
}

/// Ear cutting takes time quadratic in the number of corners, and more where corners coincide.
/// Polygons with more corners than this go through a constrained Delaunay triangulation, which does
/// not.
const MAX_EAR_CORNERS: usize = 256;

/// Contours are tested against each other for nesting. A polygon that would need more tests than
/// this is not triangulated. Contours whose bounding boxes are not nested need no test.
const MAX_NESTING_TESTS: usize = 1 << 24;

/// The triangles of a polygon. They have its orientation and use every corner and every side.
///
/// A convex polygon is cut by the diagonals from its first corner. Another one, or one with corners
/// on straight sides, is cut by ears: the first corner that can be cut off, from the second on, and
/// so forth; holes are joined to the outline first.
///
/// `rings`: the corners of its contours, numbered through all rings. The first gives the
/// orientation; the even-odd rule decides what is inside. `None` for polygons that intersect
/// themselves, have no area, or have contours nested thousands deep.
pub fn triangulate(rings: &[Vec<DVec3>]) -> Option<Vec<Triangle>> {
    if let [ring] = rings
        && is_convex(ring)
    {
        // Scenes have fewer than 2^32 corners.
        return Some((2..ring.len() as u32).map(|corner| [0, corner - 1, corner]).collect());
    }
    let rings = of_usual_size(rings)?;
    let normal = newell_normal(rings[0].iter().copied());
    let flat = Flat::new(&rings, normal)?;
    let groups = flat.groups()?;
    let sides = flat.sides(&groups);
    let mut triangles = Vec::new();
    for group in &groups {
        if flat.n_corners(group) <= MAX_EAR_CORNERS {
            ears::triangulate(&flat.contours(group, &sides), &mut triangles)?;
        } else {
            delaunay::triangulate(&flat.contours(group, &sides), &mut triangles)?;
        }
    }
    (is_complete(&triangles, &sides) && flat.are_upright(&triangles)).then_some(triangles)
}

/// The triangles of a face, as numbers of its corners through all contours; see [`triangulate`].
/// A corner that is repeated at once counts once. `rest`: the rest position of a vertex.
pub fn face_triangles(
    scene: &Scene,
    face: &Face,
    rest: impl Fn(VertexId) -> DVec3,
) -> Option<Vec<Triangle>> {
    // The usual faces, without copies of their corners.
    if face.contours.len() == 1 {
        match scene.contours.get(face.contours.start) {
            [_, _, _] => return Some(vec![[0, 1, 2]]),
            &[a, b, c, d] if is_convex(&[a, b, c, d].map(&rest)) => {
                return Some(vec![[0, 1, 2], [0, 2, 3]]);
            }
            _ => {}
        }
    }
    let (mut rings, mut numbers, mut first) = (Vec::new(), Vec::new(), 0);
    for contour in scene.face_contours(face) {
        let n = contour.len();
        let is_new = |&at: &usize| contour[at] != contour[(at + n - 1) % n];
        let kept = (0..n).filter(is_new);
        rings.push(kept.clone().map(|at| rest(contour[at])).collect::<Vec<DVec3>>());
        numbers.extend(kept.map(|at| first + at as u32));
        first += n as u32;
    }
    let mut triangles = triangulate(&rings)?;
    triangles.iter_mut().flatten().for_each(|corner| *corner = numbers[*corner as usize]);
    Some(triangles)
}

/// The polygon in coordinates of its plane, its first contour counterclockwise.
struct Flat {
    rings: Vec<Vec<DVec2>>,
    /// Number of each ring's first corner.
    first: Vec<u32>,
}

/// Cosine and sine of the angle, one radian, from a side of the polygon to the first coordinate
/// axis. Sides are rarely parallel to the axes then, so no choice is made between corners of equal
/// coordinates.
const AXES: [f64; 2] = [0.540_302_305_868_139_7, 0.841_470_984_807_896_5];

impl Flat {
    fn new(rings: &[Vec<DVec3>], normal: DVec3) -> Option<Flat> {
        let normal = normal.try_normalize()?;
        let origin = rings[0][0];
        let reach = rings[0].iter().map(|corner| corner.distance(origin)).fold(0.0, f64::max);
        // Not the farthest corner: several may be equally far.
        let is_far = |corner: &&DVec3| corner.distance(origin) > 0.37 * reach;
        let toward = *rings[0].iter().find(is_far)? - origin;
        let along = (toward - toward.dot(normal) * normal).try_normalize()?;
        let across = normal.cross(along);
        let [cosine, sine] = AXES;
        let (x, y) = (cosine * along + sine * across, cosine * across - sine * along);
        let flat =
            |corner: &DVec3| DVec2::new((*corner - origin).dot(x), (*corner - origin).dot(y));
        let rings: Vec<Vec<DVec2>> =
            rings.iter().map(|ring| ring.iter().map(flat).collect()).collect();
        let first = rings
            .iter()
            .scan(0, |next, ring| {
                *next += ring.len() as u32;
                Some(*next - ring.len() as u32)
            })
            .collect();
        (signed_area(&rings[0]) > 0.0).then_some(Flat { rings, first })
    }

    /// Outlines, each with the holes directly inside it, by even-odd nesting. `None` beyond
    /// [`MAX_NESTING_TESTS`].
    fn groups(&self) -> Option<Vec<Vec<usize>>> {
        let around = nesting(&self.rings)?;
        let is_outline = |ring: usize| around[ring].len().is_multiple_of(2);
        let mut groups: Vec<Vec<usize>> = Vec::new();
        let mut group_of = vec![usize::MAX; self.rings.len()];
        for outline in (0..self.rings.len()).filter(|&ring| is_outline(ring)) {
            group_of[outline] = groups.len();
            groups.push(vec![outline]);
        }
        for hole in (0..self.rings.len()).filter(|&ring| !is_outline(ring)) {
            let n_around = around[hole].len();
            for &outline in
                around[hole].iter().filter(|&&outline| around[outline].len() + 1 == n_around)
            {
                groups[group_of[outline]].push(hole);
            }
        }
        Some(groups)
    }

    fn n_corners(&self, group: &[usize]) -> usize {
        group.iter().map(|&ring| self.rings[ring].len()).sum()
    }

    /// The contours of a group, as corners with their numbers, from the first corner on with the
    /// inside on the left. `sides`: the corner after each corner.
    fn contours(&self, group: &[usize], sides: &[u32]) -> Vec<Vec<(u32, DVec2)>> {
        let contour = |&ring: &usize| {
            let first = self.first[ring];
            let next = |&corner: &u32| Some(sides[corner as usize]);
            let numbers = std::iter::successors(Some(first), next).take(self.rings[ring].len());
            numbers.map(|number| (number, self.rings[ring][(number - first) as usize])).collect()
        };
        group.iter().map(contour).collect()
    }

    /// Do all triangles have the orientation of the polygon? False for polygons that intersect
    /// themselves.
    fn are_upright(&self, triangles: &[Triangle]) -> bool {
        let corners = self.rings.concat();
        let at = |number: u32| corners[number as usize];
        let rounding = 1e-12 * signed_area(&self.rings[0]);
        triangles.iter().all(|&[a, b, c]| signed_area(&[at(a), at(b), at(c)]) >= -rounding)
    }

    /// The corner after each corner, walking with the inside on the left.
    fn sides(&self, groups: &[Vec<usize>]) -> Vec<u32> {
        let mut next = Vec::with_capacity(self.rings.iter().map(Vec::len).sum());
        let holes: FxHashSet<usize> = groups.iter().flat_map(|group| group[1..].to_vec()).collect();
        for (ring, corners) in self.rings.iter().enumerate() {
            let (n, first) = (corners.len() as u32, self.first[ring]);
            let is_ahead = (signed_area(corners) > 0.0) != holes.contains(&ring);
            let step = if is_ahead { 1 } else { n - 1 };
            next.extend((0..n).map(|idx| first + (idx + step) % n));
        }
        next
    }
}

/// The corners relative to the first, multiplied by a power of two where areas would overflow or
/// underflow. `None` if a corner is infinite, or all of them coincide.
fn of_usual_size(rings: &[Vec<DVec3>]) -> Option<Vec<Vec<DVec3>>> {
    let origin = *rings.first()?.first()?;
    let mut rings: Vec<Vec<DVec3>> =
        rings.iter().map(|ring| ring.iter().map(|&corner| corner - origin).collect()).collect();
    let largest = rings.iter().flatten().map(|p| p.abs().max_element()).fold(0.0, f64::max);
    if largest == 0.0 || !rings.iter().flatten().all(|p| p.is_finite()) {
        return None;
    }
    if !(1e-60..1e60).contains(&largest) {
        // In two steps, since one factor may be too large for a double.
        let half = libm::ldexp(1.0, -libm::ilogb(largest) / 2);
        rings.iter_mut().flatten().for_each(|p| *p = *p * half * half);
    }
    Some(rings)
}

/// For each contour, those that contain it. `None` beyond [`MAX_NESTING_TESTS`].
fn nesting(rings: &[Vec<DVec2>]) -> Option<Vec<Vec<usize>>> {
    let boxes: Vec<[DVec2; 2]> = rings.iter().map(|ring| bounds(ring)).collect();
    let mut around = vec![Vec::new(); rings.len()];
    let mut n_tests = 0;
    // A sweep from left to right, which pairs only contours that overlap horizontally.
    let mut order: Vec<usize> = (0..rings.len()).collect();
    order.sort_by(|&a, &b| boxes[a][0].x.total_cmp(&boxes[b][0].x));
    let mut open: Vec<usize> = Vec::new();
    for ring in order {
        let [low, high] = boxes[ring];
        open.retain(|&other| boxes[other][1].x >= low.x);
        n_tests += open.len();
        for &other in &open {
            if boxes[other][0].y <= high.y && boxes[other][1].y >= low.y {
                n_tests += rings[ring].len() * rings[other].len();
                if n_tests <= MAX_NESTING_TESTS {
                    if is_inside(&rings[ring], &rings[other]) {
                        around[ring].push(other);
                    }
                    if is_inside(&rings[other], &rings[ring]) {
                        around[other].push(ring);
                    }
                }
            }
        }
        if n_tests > MAX_NESTING_TESTS {
            return None;
        }
        open.push(ring);
    }
    Some(around)
}

fn bounds(ring: &[DVec2]) -> [DVec2; 2] {
    let grown = |[low, high]: [DVec2; 2], &p: &DVec2| [low.min(p), high.max(p)];
    ring.iter().fold([DVec2::INFINITY, DVec2::NEG_INFINITY], grown)
}

/// Is every side used once, and every other edge once in each direction?
fn is_complete(triangles: &[Triangle], sides: &[u32]) -> bool {
    let mut edges: FxHashMap<(u32, u32), u32> = FxHashMap::default();
    for &triangle in triangles {
        edges_of(triangle).into_iter().for_each(|edge| *edges.entry(edge).or_default() += 1);
    }
    let is_side = |&(u, w): &(u32, u32)| sides[u as usize] == w;
    let n_sides = edges.keys().filter(|edge| is_side(edge)).count();
    n_sides == sides.len()
        && edges
            .iter()
            .all(|(edge, &n)| n == 1 && (is_side(edge) || edges.contains_key(&(edge.1, edge.0))))
}

fn edges_of([a, b, c]: Triangle) -> [(u32, u32); 3] {
    [(a, b), (b, c), (c, a)]
}

/// Positive for counterclockwise.
fn signed_area(ring: &[DVec2]) -> f64 {
    let Some(&origin) = ring.first() else { return 0.0 };
    ring.windows(2).map(|pair| (pair[0] - origin).perp_dot(pair[1] - origin)).sum::<f64>() / 2.0
}

/// Does most of `ring` lie inside `other`? Rings do not intersect; testing the midpoints of all
/// sides decides for rings that touch.
fn is_inside(ring: &[DVec2], other: &[DVec2]) -> bool {
    let middles = (0..ring.len()).map(|idx| ring[idx].midpoint(ring[(idx + 1) % ring.len()]));
    let n_inside = middles.filter(|&p| contains(other, p)).count();
    2 * n_inside > ring.len()
}

/// Even-odd rule.
fn contains(ring: &[DVec2], p: DVec2) -> bool {
    let mut is_inside = false;
    for idx in 0..ring.len() {
        let (a, b) = (ring[idx], ring[(idx + 1) % ring.len()]);
        if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y) {
            is_inside = !is_inside;
        }
    }
    is_inside
}
