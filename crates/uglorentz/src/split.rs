//! What a piece becomes when some of its edges are halved.

use crate::growth::Growth;
use crate::judge::Marks;
use crate::pieces::Shape;

/// Halves the marked edges of a piece, or cuts it inside if that is marked.
pub(crate) fn split(growth: &mut Growth, shape: &Shape, marks: Marks) -> Vec<Shape> {
    match *shape {
        Shape::Triangle(corners) => {
            let [a, b, c, _] = marks.edges;
            if marks.inside { fan(growth, corners) } else { split_triangle(growth, corners, [a, b, c]) }
        }
        Shape::Quad(corners) => split_quad(growth, corners, marks.edges),
    }
}

/// Three triangles round the mean. In the shape of an equilateral one they are obtuse, so that no inside is worse
/// than its edges.
fn fan(growth: &mut Growth, [a, b, c]: [u32; 3]) -> Vec<Shape> {
    let center = growth.center([a, b, c]);
    [[a, b, center], [b, c, center], [c, a, center]].map(Shape::Triangle).to_vec()
}

/// `marks`: from each corner to the next.
fn split_triangle(growth: &mut Growth, corners: [u32; 3], marks: [bool; 3]) -> Vec<Shape> {
    let n_marks = marks.iter().filter(|&&mark| mark).count();
    // Turn it so that the first edge is marked, and the last is not if one is not.
    let turn = (0..3).find(|&k| marks[k] && (n_marks == 3 || !marks[(k + 2) % 3])).unwrap_or(0);
    let [a, b, c] = [corners[turn], corners[(turn + 1) % 3], corners[(turn + 2) % 3]];
    match n_marks {
        0 => vec![Shape::Triangle([a, b, c])],
        1 => {
            let ab = growth.middle(a, b);
            vec![Shape::Triangle([a, ab, c]), Shape::Triangle([ab, b, c])]
        }
        2 => {
            let (ab, bc) = (growth.middle(a, b), growth.middle(b, c));
            let mut shapes = vec![Shape::Triangle([ab, b, bc])];
            shapes.extend(halves(growth, [a, ab, bc, c]).map(Shape::Triangle));
            shapes
        }
        _ => {
            let (ab, bc, ca) = (growth.middle(a, b), growth.middle(b, c), growth.middle(c, a));
            vec![
                Shape::Triangle([a, ab, ca]),
                Shape::Triangle([ab, b, bc]),
                Shape::Triangle([ab, bc, ca]),
                Shape::Triangle([ca, bc, c]),
            ]
        }
    }
}

/// `marks`: from each corner to the next.
fn split_quad(growth: &mut Growth, corners: [u32; 4], marks: [bool; 4]) -> Vec<Shape> {
    let [a, b, c, d] = corners;
    match marks {
        [true, true, true, true] => {
            let middle = growth.mean(corners);
            let [ab, bc, cd, da] = [(a, b), (b, c), (c, d), (d, a)].map(|(p, q)| growth.middle(p, q));
            vec![
                Shape::Quad([a, ab, middle, da]),
                Shape::Quad([ab, b, bc, middle]),
                Shape::Quad([middle, bc, c, cd]),
                Shape::Quad([da, middle, cd, d]),
            ]
        }
        [true, false, true, false] => {
            let (ab, cd) = (growth.middle(a, b), growth.middle(c, d));
            vec![Shape::Quad([a, ab, cd, d]), Shape::Quad([ab, b, c, cd])]
        }
        [false, true, false, true] => {
            let (bc, da) = (growth.middle(b, c), growth.middle(d, a));
            vec![Shape::Quad([a, b, bc, da]), Shape::Quad([da, bc, c, d])]
        }
        _ => {
            // Turned so that the diagonal to cut along runs from the first corner.
            let turn = usize::from(is_second_diagonal_shorter(growth, corners));
            let [a, b, c, d] = std::array::from_fn(|idx| corners[(idx + turn) % 4]);
            let [ab, bc, cd, da] = std::array::from_fn(|idx| marks[(idx + turn) % 4]);
            let mut shapes = split_triangle(growth, [a, b, c], [ab, bc, false]);
            shapes.extend(split_triangle(growth, [a, c, d], [false, cd, da]));
            shapes
        }
    }
}

/// Two triangles, by the shorter diagonal.
fn halves(growth: &Growth, [a, b, c, d]: [u32; 4]) -> [[u32; 3]; 2] {
    if is_second_diagonal_shorter(growth, [a, b, c, d]) {
        [[b, c, d], [b, d, a]]
    } else {
        [[a, b, c], [a, c, d]]
    }
}

fn is_second_diagonal_shorter(growth: &Growth, corners: [u32; 4]) -> bool {
    let [a, b, c, d] = corners.map(|row| growth.point(row).rest);
    (b - d).length_squared() < (a - c).length_squared()
}
