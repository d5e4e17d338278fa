//! Polygons in their rest plane: convexity, and triangles by ear cutting.

use earcut::Earcut;
use glam::{DVec2, DVec3};
use rustc_hash::{FxHashMap, FxHashSet};
use ugparse::newell_normal;

/// Three corners, by place in the list of corners.
pub type Triangle = [u32; 3];

/// Is this quadrilateral convex, with no corner straight or nearly so?
pub fn is_convex(corners: [DVec3; 4]) -> bool {
    let normal = newell_normal(corners.iter().copied());
    // A corner with a sine below a millionth would make a needle of a triangle.
    let least = 1e-6 * normal.length();
    (0..4).all(|idx| {
        let (back, here, ahead) = (corners[(idx + 3) % 4], corners[idx], corners[(idx + 1) % 4]);
        let (into, out) = (here - back, ahead - here);
        into.cross(out).dot(normal) > least * into.length() * out.length()
    })
}

/// Cuts a polygon into triangles that keep its direction and use every corner and every side.
///
/// `rings`: the corners of its contours; the first gives its direction, and inside is decided by the even-odd
/// rule. Corners are numbered through all rings. `None` if that cannot be done, for polygons that cross
/// themselves or have no area.
pub fn triangulate(rings: &[Vec<DVec3>]) -> Option<Vec<Triangle>> {
    let normal = newell_normal(rings.first()?.iter().copied());
    let flat = Flat::new(rings, normal)?;
    let mut triangles = Vec::new();
    for group in flat.groups() {
        flat.cut_group(&group, &mut triangles);
    }
    let sides = flat.sides();
    let triangles = take_up_dropped_corners(triangles, &sides)?;
    (is_complete(&triangles, &sides) && flat.are_upright(&triangles)).then_some(triangles)
}

/// The polygon dropped onto a coordinate plane, its first contour counterclockwise. Dropping a coordinate does
/// not round, so corners on one line stay on one line.
struct Flat {
    rings: Vec<Vec<DVec2>>,
    /// Number of each ring's first corner.
    first: Vec<u32>,
}

impl Flat {
    fn new(rings: &[Vec<DVec3>], normal: DVec3) -> Option<Flat> {
        let size = normal.abs();
        let (drop, dropped): (fn(DVec3) -> DVec2, f64) = if size.x >= size.y && size.x >= size.z {
            (|p| DVec2::new(p.y, p.z), normal.x)
        } else if size.y >= size.z {
            (|p| DVec2::new(p.z, p.x), normal.y)
        } else {
            (|p| DVec2::new(p.x, p.y), normal.z)
        };
        let turn = |p: DVec2| if dropped < 0.0 { DVec2::new(-p.x, p.y) } else { p };
        let origin = *rings.first()?.first()?;
        let place = |&corner: &DVec3| turn(drop(corner) - drop(origin));
        let rings: Vec<Vec<DVec2>> = rings.iter().map(|ring| ring.iter().map(place).collect()).collect();
        let first = rings
            .iter()
            .scan(0, |next, ring| {
                *next += ring.len() as u32;
                Some(*next - ring.len() as u32)
            })
            .collect();
        let is_usable = rings.iter().flatten().all(|p| p.is_finite()) && signed_area(&rings[0]) > 0.0;
        is_usable.then_some(Flat { rings, first })
    }

    /// Outlines, each with the holes right inside it, by even-odd nesting.
    fn groups(&self) -> Vec<Vec<usize>> {
        let n = self.rings.len();
        let around: Vec<Vec<usize>> = (0..n)
            .map(|ring| {
                (0..n).filter(|&o| o != ring && is_inside(&self.rings[ring], &self.rings[o])).collect()
            })
            .collect();
        let is_outline = |ring: usize| around[ring].len().is_multiple_of(2);
        (0..n)
            .filter(|&outline| is_outline(outline))
            .map(|outline| {
                let is_its_hole = |&ring: &usize| {
                    around[ring].len() == around[outline].len() + 1 && around[ring].contains(&outline)
                };
                [outline].into_iter().chain((0..n).filter(is_its_hole)).collect()
            })
            .collect()
    }

    fn cut_group(&self, group: &[usize], triangles: &mut Vec<Triangle>) {
        let corners: Vec<[f64; 2]> =
            group.iter().flat_map(|&ring| self.rings[ring].iter().map(|p| p.to_array())).collect();
        let numbers: Vec<u32> =
            group.iter().flat_map(|&ring| (self.first[ring]..).take(self.rings[ring].len())).collect();
        let holes: Vec<u32> = group
            .iter()
            .scan(0, |next, &ring| {
                *next += self.rings[ring].len() as u32;
                Some(*next)
            })
            .take(group.len() - 1)
            .collect();
        let mut cut: Vec<u32> = Vec::new();
        Earcut::new().earcut(corners.iter().copied(), &holes, &mut cut);
        let at = |idx: u32| DVec2::from_array(corners[idx as usize]);
        let area: f64 = cut.chunks_exact(3).map(|t| signed_area(&[at(t[0]), at(t[1]), at(t[2])])).sum();
        triangles.extend(cut.chunks_exact(3).map(|t| {
            let [a, b, c] = [t[0], t[1], t[2]].map(|idx| numbers[idx as usize]);
            if area < 0.0 { [a, c, b] } else { [a, b, c] }
        }));
    }

    /// Do all triangles turn as the polygon does? Those of a polygon that crosses itself do not.
    fn are_upright(&self, triangles: &[Triangle]) -> bool {
        let corners = self.rings.concat();
        let at = |number: u32| corners[number as usize];
        let rounding = 1e-12 * signed_area(&self.rings[0]);
        triangles.iter().all(|&[a, b, c]| signed_area(&[at(a), at(b), at(c)]) >= -rounding)
    }

    /// The corner after each corner, walking with the inside on the left.
    fn sides(&self) -> Vec<u32> {
        let mut next = Vec::with_capacity(self.rings.iter().map(Vec::len).sum());
        let holes: FxHashSet<usize> = self.groups().iter().flat_map(|group| group[1..].to_vec()).collect();
        for (ring, corners) in self.rings.iter().enumerate() {
            let (n, first) = (corners.len() as u32, self.first[ring]);
            let is_ahead = (signed_area(corners) > 0.0) != holes.contains(&ring);
            let step = if is_ahead { 1 } else { n - 1 };
            next.extend((0..n).map(|idx| first + (idx + step) % n));
        }
        next
    }
}

/// Ear cutting drops corners on a straight side. Neighbours do use them, so the triangle at such a side is
/// replaced by a fan that uses them too.
fn take_up_dropped_corners(triangles: Vec<Triangle>, sides: &[u32]) -> Option<Vec<Triangle>> {
    let mut edges: FxHashSet<(u32, u32)> = triangles.iter().flat_map(|&t| edges_of(t)).collect();
    let mut todo = triangles;
    todo.reverse();
    let mut done = Vec::with_capacity(todo.len());
    // Each step settles a triangle or takes up a corner.
    let mut steps_left = todo.len() + 2 * sides.len();
    while let Some([a, b, c]) = todo.pop() {
        steps_left = steps_left.checked_sub(1)?;
        let open = [[a, b, c], [b, c, a], [c, a, b]]
            .into_iter()
            .find(|&[u, w, _]| sides[u as usize] != w && !edges.contains(&(w, u)));
        let Some([u, w, apex]) = open else {
            done.push([a, b, c]);
            continue;
        };
        let chain = chain(sides, u, w)?;
        for pair in chain.windows(2).rev() {
            let piece = [pair[0], pair[1], apex];
            edges.extend(edges_of(piece));
            todo.push(piece);
        }
    }
    Some(done)
}

/// Corners met walking along the sides from `from` to `to`.
fn chain(sides: &[u32], from: u32, to: u32) -> Option<Vec<u32>> {
    let mut chain = vec![from];
    while *chain.last()? != to {
        if chain.len() > sides.len() {
            return None;
        }
        chain.push(sides[*chain.last()? as usize]);
    }
    Some(chain)
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
        && edges.iter().all(|(edge, &n)| n == 1 && (is_side(edge) || edges.contains_key(&(edge.1, edge.0))))
}

fn edges_of([a, b, c]: Triangle) -> [(u32, u32); 3] {
    [(a, b), (b, c), (c, a)]
}

/// Positive for counterclockwise.
fn signed_area(ring: &[DVec2]) -> f64 {
    let Some(&origin) = ring.first() else { return 0.0 };
    ring.windows(2).map(|pair| (pair[0] - origin).perp_dot(pair[1] - origin)).sum::<f64>() / 2.0
}

/// Does most of `ring` lie inside `other`? Rings do not cross; asking the middles of all sides settles rings
/// that touch.
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

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(points: &[(f64, f64)]) -> Vec<DVec3> {
        // A slanted plane, so that no coordinate is special.
        points.iter().map(|&(x, y)| DVec3::new(x, y, 0.3 * x - 0.2 * y + 7.0)).collect()
    }

    /// Area of a polygon in that plane per area below it.
    fn tilt() -> f64 {
        DVec3::new(-0.3, 0.2, 1.0).length()
    }

    #[test]
    fn triangles_cover_the_polygon() {
        fn check(
            what: &str,
            outline: &[(f64, f64)],
            holes: &[&[(f64, f64)]],
            expected: Option<(usize, f64)>,
        ) {
            for mirrored in [false, true] {
                let turn = |points: &[(f64, f64)]| -> Vec<(f64, f64)> {
                    points.iter().map(|&(x, y)| (if mirrored { -x } else { x }, y)).collect()
                };
                let mut rings = vec![ring(&turn(outline))];
                rings.extend(holes.iter().map(|hole| ring(&turn(hole))));
                let corners: Vec<DVec3> = rings.concat();
                let normal = newell_normal(rings[0].iter().copied());
                let found = triangulate(&rings);
                assert_eq!(found.as_ref().map(Vec::len), expected.map(|e| e.0), "{what}");
                let Some((_, area)) = expected else { continue };
                let sum: f64 = found
                    .unwrap()
                    .iter()
                    .map(|t| {
                        newell_normal(t.iter().map(|&c| corners[c as usize])).dot(normal.normalize()) / 2.0
                    })
                    .inspect(|&part| assert!(part > -1e-12, "{what}: turned"))
                    .sum();
                assert!((sum - area * tilt()).abs() < 1e-12 * area, "{what}: {sum}");
            }
        }
        let square = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)];
        let inner = [(1.0, 1.0), (3.0, 1.0), (3.0, 3.0), (1.0, 3.0)];
        let mut turned_inner = inner;
        turned_inner.reverse();
        check("a square", &square, &[], Some((2, 16.0)));
        check("an arrow", &[(0.0, 0.0), (4.0, 0.0), (1.0, 1.0), (0.0, 4.0)], &[], Some((2, 4.0)));
        check("a hole", &square, &[&turned_inner], Some((8, 12.0)));
        check("a hole the wrong way round", &square, &[&inner], Some((8, 12.0)));
        check(
            "an island in the hole",
            &square,
            &[&inner, &[(1.5, 1.5), (2.5, 1.5), (2.0, 2.5)]],
            Some((9, 12.5)),
        );
        check("a second outline", &square, &[&[(5.0, 0.0), (6.0, 0.0), (6.0, 1.0)]], Some((3, 16.5)));
        check(
            "corners on straight sides, and a hole, for which ear cutting drops them",
            &[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (4.0, 0.0), (4.0, 4.0), (2.0, 4.0), (0.0, 4.0)],
            &[&turned_inner],
            Some((11, 12.0)),
        );
        check(
            "all corners of a triangle on its sides doubled",
            &[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (1.0, 1.0), (0.0, 2.0), (0.0, 1.0)],
            &[],
            Some((4, 2.0)),
        );
        check("no area", &[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0)], &[], None);
        check("a bow tie", &[(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 3.0)], &[], None);
    }

    #[test]
    fn convexity() {
        fn check(points: [(f64, f64); 4], expected: bool) {
            let corners: [DVec3; 4] = ring(&points).try_into().unwrap();
            assert_eq!(is_convex(corners), expected, "{points:?}");
        }
        check([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)], true);
        check([(0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.0)], true);
        check([(0.0, 0.0), (4.0, 0.0), (1.0, 1.0), (0.0, 4.0)], false);
        check([(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (0.0, 1.0)], false);
        check([(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)], false);
        check([(1.0, 1.0); 4], false);
    }
}
