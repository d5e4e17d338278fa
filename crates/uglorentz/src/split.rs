//! Subdivision of a piece with some of its edges halved.
//!
//! New edges inside are chosen by their error: of the two diagonals of four points the one with the
//! smaller error, or the shorter one if the errors are equal. So pieces of a floor near the eye
//! become long in the direction to the eye, in which D hardly changes.

use crate::criterion::{Bounds, Criterion, Marks};
use crate::pieces::Shape;
use crate::refined_mesh::RefinedMesh;

/// Halves the marked edges of a piece, or subdivides its inside if that is marked.
pub(crate) fn split(
    mesh: &mut RefinedMesh,
    bounds: &Bounds,
    shape: &Shape,
    marks: Marks,
) -> Vec<Shape> {
    match *shape {
        Shape::Triangle(corners) => {
            let [a, b, c, _] = marks.edges;
            if marks.inside {
                fan(mesh, corners)
            } else {
                split_triangle(mesh, bounds, corners, [a, b, c])
            }
        }
        Shape::Quad(corners) => split_quad(mesh, bounds, corners, marks.edges),
    }
}

/// Three triangles around the mean. For an equilateral triangle they are obtuse, so that their
/// inside has smaller errors than their edges.
fn fan(mesh: &mut RefinedMesh, [a, b, c]: [u32; 3]) -> Vec<Shape> {
    let center = mesh.center([a, b, c]);
    [[a, b, center], [b, c, center], [c, a, center]].map(Shape::Triangle).to_vec()
}

/// `marks`: from each corner to the next.
fn split_triangle(
    mesh: &mut RefinedMesh,
    bounds: &Bounds,
    corners: [u32; 3],
    marks: [bool; 3],
) -> Vec<Shape> {
    let n_marks = marks.iter().filter(|&&mark| mark).count();
    // Rotated so that the first edge is marked, and the last is not unless all are.
    let turn = (0..3).find(|&k| marks[k] && (n_marks == 3 || !marks[(k + 2) % 3])).unwrap_or(0);
    let [a, b, c] = [corners[turn], corners[(turn + 1) % 3], corners[(turn + 2) % 3]];
    match n_marks {
        0 => vec![Shape::Triangle([a, b, c])],
        1 => {
            let ab = mesh.middle(a, b);
            vec![Shape::Triangle([a, ab, c]), Shape::Triangle([ab, b, c])]
        }
        2 => {
            let (ab, bc) = (mesh.middle(a, b), mesh.middle(b, c));
            let [first, second] = halves(mesh, bounds, [a, ab, bc, c]);
            [[ab, b, bc], first, second].map(Shape::Triangle).to_vec()
        }
        _ => quarters(mesh, bounds, [a, b, c]).map(Shape::Triangle).to_vec(),
    }
}

/// Four triangles between the corners and the midpoints of the sides: one at each corner and one in
/// the middle. One inner edge is flipped where that reduces the error most.
fn quarters(mesh: &mut RefinedMesh, bounds: &Bounds, [a, b, c]: [u32; 3]) -> [[u32; 3]; 4] {
    let (ab, bc, ca) = (mesh.middle(a, b), mesh.middle(b, c), mesh.middle(c, a));
    let criterion = Criterion { mesh, bounds };
    let excess = |(a, b): (u32, u32)| criterion.excess(a, b);
    let gain = |[a, ab, bc, ca, ..]: &[u32; 6]| excess((*ab, *ca)) - excess((*a, *bc));
    let turns = [[a, ab, bc, ca, b, c], [b, bc, ca, ab, c, a], [c, ca, ab, bc, a, b]];
    let [first, rest @ ..] = turns.map(|turn| (gain(&turn), turn));
    let best = rest.into_iter().fold(first, |best, turn| if turn.0 > best.0 { turn } else { best });
    let (gain, [a, ab, bc, ca, b, c]) = best;
    let halves = if gain > 0.0 { [[a, ab, bc], [a, bc, ca]] } else { [[a, ab, ca], [ab, bc, ca]] };
    [halves[0], halves[1], [ab, b, bc], [ca, bc, c]]
}

/// `marks`: from each corner to the next.
fn split_quad(
    mesh: &mut RefinedMesh,
    bounds: &Bounds,
    corners: [u32; 4],
    marks: [bool; 4],
) -> Vec<Shape> {
    let [a, b, c, d] = corners;
    match marks {
        [true, true, true, true] if !has_right_diagonal(mesh, bounds, corners) => {
            let middle = mesh.mean(corners);
            let [ab, bc, cd, da] = [(a, b), (b, c), (c, d), (d, a)].map(|(p, q)| mesh.middle(p, q));
            vec![
                Shape::Quad([a, ab, middle, da]),
                Shape::Quad([ab, b, bc, middle]),
                Shape::Quad([middle, bc, c, cd]),
                Shape::Quad([da, middle, cd, d]),
            ]
        }
        [true, false, true, false] => {
            let (ab, cd) = (mesh.middle(a, b), mesh.middle(c, d));
            vec![Shape::Quad([a, ab, cd, d]), Shape::Quad([ab, b, c, cd])]
        }
        [false, true, false, true] => {
            let (bc, da) = (mesh.middle(b, c), mesh.middle(d, a));
            vec![Shape::Quad([a, b, bc, da]), Shape::Quad([da, bc, c, d])]
        }
        _ => {
            // Rotated so that the chosen diagonal runs from the first corner.
            let turn = usize::from(is_second_diagonal_better(mesh, bounds, corners));
            let [a, b, c, d] = std::array::from_fn(|idx| corners[(idx + turn) % 4]);
            let [ab, bc, cd, da] = std::array::from_fn(|idx| marks[(idx + turn) % 4]);
            let mut shapes = split_triangle(mesh, bounds, [a, b, c], [ab, bc, false]);
            shapes.extend(split_triangle(mesh, bounds, [a, c, d], [false, cd, da]));
            shapes
        }
    }
}

/// Two triangles, by the better diagonal.
fn halves(mesh: &RefinedMesh, bounds: &Bounds, [a, b, c, d]: [u32; 4]) -> [[u32; 3]; 2] {
    if is_second_diagonal_better(mesh, bounds, [a, b, c, d]) {
        [[b, c, d], [b, d, a]]
    } else {
        [[a, b, c], [a, c, d]]
    }
}

fn has_right_diagonal(mesh: &RefinedMesh, bounds: &Bounds, [a, b, c, d]: [u32; 4]) -> bool {
    let criterion = Criterion { mesh, bounds };
    !criterion.bends_at_any_depth(a, c) || !criterion.bends_at_any_depth(b, d)
}

/// Smaller error, or equal error and shorter.
fn is_second_diagonal_better(mesh: &RefinedMesh, bounds: &Bounds, [a, b, c, d]: [u32; 4]) -> bool {
    let criterion = Criterion { mesh, bounds };
    let (first, second) = (criterion.excess(a, c), criterion.excess(b, d));
    let length = |a: u32, b: u32| (mesh.point(a).rest - mesh.point(b).rest).length_squared();
    second < first || (second == first && length(b, d) < length(a, c))
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use ugphysics::Velocity;
    use ugscene::{BodyId, ShownEffects};

    use super::*;
    use crate::clocks::Clocks;
    use crate::cull::ViewVolume;
    use crate::edge::Tolerance;
    use crate::near_lamps::NearLamps;
    use crate::relative_motion::{Point, RelativeMotion};

    /// A triangle is divided into four in the way whose inner edges have the smallest sum of
    /// errors, and the pieces cover it.
    #[test]
    fn inner_edges_have_the_smallest_errors() {
        let step = |k: u32, seed: f64| (f64::from(k) * seed).fract() * 2.0 - 1.0;
        let motions = [RelativeMotion::new(
            Velocity::from_beta(DVec3::X * 0.99).unwrap(),
            ShownEffects::default(),
        )];
        let bounds = Bounds::new(
            vec![Tolerance::new(1e-4, 1e-3)],
            (NearLamps::default(), Clocks::default()),
            ViewVolume::default(),
            &motions,
        );
        let mut n_turned = 0;
        for k in 1..200_u32 {
            let corner = |p, q| DVec3::new(3.0 + step(k, p), step(k, q), 0.01);
            let corners = [
                corner(0.618_034, 0.414_214),
                corner(0.236_068, 0.645_751),
                corner(0.872_983, 0.123_106),
            ];
            let points = corners
                .map(|corner| Point::new(&motions[0], BodyId::from_index(0), corner))
                .to_vec();
            let mut mesh = RefinedMesh::new(&motions, points);
            let marks = Marks { edges: [true, true, true, false], inside: false };
            let pieces = split(&mut mesh, &bounds, &Shape::Triangle([0, 1, 2]), marks);
            let area = |corners: &[u32]| {
                let [a, b, c] = [0, 1, 2].map(|idx| mesh.point(corners[idx]).rest);
                (b - a).cross(c - a)
            };
            let sum: DVec3 = pieces.iter().map(|piece| area(piece.corners())).sum();
            assert!((sum - area(&[0, 1, 2])).length() < 1e-12 && pieces.len() == 4);

            let criterion = Criterion { mesh: &mesh, bounds: &bounds };
            let mut inner: Vec<(u32, u32)> =
                pieces.iter().flat_map(Shape::edges).map(|(a, b)| (a.min(b), a.max(b))).collect();
            inner.sort_unstable();
            let shared: Vec<(u32, u32)> =
                inner.windows(2).filter(|pair| pair[0] == pair[1]).map(|pair| pair[0]).collect();
            assert_eq!(shared.len(), 3);
            let total = |edges: &[(u32, u32)]| {
                edges.iter().map(|&(a, b)| criterion.excess(a, b)).sum::<f64>()
            };
            // Each midpoint is between two corners, and opposite the third.
            let middles: Vec<u32> = (3..6).collect();
            let across = |middle: u32| {
                3 - mesh.recipes[middle as usize - 3].parents[..2].iter().sum::<u32>()
            };
            let round = [(3, 4), (4, 5), (3, 5)];
            let turned = middles.iter().map(|&middle| {
                let others = round.iter().copied().filter(|&(a, b)| a == middle || b == middle);
                others.chain([(across(middle), middle)]).collect::<Vec<_>>()
            });
            let least = turned.map(|edges| total(&edges)).fold(total(&round), f64::min);
            assert!(total(&shared) <= least * (1.0 + 1e-12), "{corners:?}");
            n_turned += u32::from(shared.iter().any(|&(low, _)| low < 3));
        }
        assert!((100..199).contains(&n_turned), "{n_turned}");
    }
}
