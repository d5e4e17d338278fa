//! Cutting where the picture needs it (`-se`).
//!
//! Edges that bend ([`crate::edge::bends`]) are halved, the longest first: a round takes those longer than half
//! the longest one left, in every piece they border, so that pieces stay in shape. Whether and when an edge is
//! halved depends on that edge alone. So at the end of each round pieces still meet edge to edge, and it
//! is safe to stop after any of them.
//!
//! | piece | edges halved | becomes |
//! | --- | --- | --- |
//! | triangle | 1, 2, 3 | 2, 3, 4 triangles |
//! | convex quadrilateral | all | 4 quadrilaterals round the mean of its corners |
//! | | two opposite ones | 2 quadrilaterals |
//! | | others | 2 triangles, and those as above |
//! | | none bends, but a diagonal does, or the inside | 2 triangles |
//! | triangle | none bends, but the inside does | 3 triangles round the mean of its corners |
//! | other polygon | any bends, or an inner edge of its triangles | triangles, and those as above |
//! | other polygon that cannot be triangulated | any | itself with more corners |
//! | any, seen edge-on | any | itself with more corners |
//! | wire | any | itself with more corners |

use glam::DVec3;
use rayon::prelude::*;
use ugparse::{Face, Scene, VertexId};

use crate::edge::{self, Tolerance};
use crate::growth::Growth;
use crate::lit::Lit;
use crate::motion::Point;
use crate::pieces::{Cut, Outcome, Piece, Polyline, Shape, as_contours, shape};
use crate::{edge_on, interior, quick};

/// An edge is halved this often at most. Each halving divides the sagitta by 4, so 12 take the worst arc down
/// to the default bound; the rest are for edges that pass the eye at a millionth of their length.
pub(crate) const MAX_GENERATION: u32 = 32;

/// Pieces a scene is cut into at most: about half a gigabyte of text.
pub(crate) const MAX_PIECES: usize = 4_000_000;

/// Cuts faces and wires until every edge is right to `tolerance` and by `lit`, or `max_pieces` would be passed.
pub(crate) fn cut(
    scene: &Scene,
    growth: &mut Growth,
    tolerance: &Tolerance,
    lit: &Lit,
    max_pieces: usize,
) -> Outcome {
    let judge = Judge { growth, tolerance, lit };
    let mut outcome = Outcome::default();
    let mut fresh: Vec<Piece> = Vec::new();
    for (face, cut) in judge.first_cuts(scene) {
        match cut {
            Cut::Pieces(shapes) => fresh.extend(shapes.into_iter().map(|shape| Piece { face, shape })),
            Cut::EdgeOn(lines) => outcome.lines.extend(lines),
            Cut::Contours(lines) => {
                outcome.lines.extend(lines);
                outcome.n_uncut += 1;
            }
        }
    }
    outcome.lines.extend(judge.bent_wires(scene));
    let mut open: Vec<Open> = Vec::new();
    loop {
        let judge = Judge { growth, tolerance, lit };
        judge.sort(std::mem::take(&mut fresh), &mut open, &mut outcome.pieces);
        let line_marks: Vec<Vec<bool>> = outcome.lines.par_iter().map(|line| judge.line(line)).collect();
        let Some(least) = judge.least_due(&open, &outcome.lines, &line_marks) else { break };

        let due: Vec<Marks> = open.par_iter().map(|open| open.due(growth, least)).collect();
        let n_corners: usize = outcome.lines.iter().map(|line| 2 * line.corners.len()).sum();
        let n_added: usize = due.iter().map(|due| due.n_added()).sum();
        outcome.is_full = outcome.pieces.len() + open.len() + n_added + n_corners > max_pieces;
        if outcome.is_full {
            break;
        }
        open =
            open.into_iter().zip(due).filter_map(|(open, due)| open.cut(growth, due, &mut fresh)).collect();
        for (line, marks) in outcome.lines.iter_mut().zip(&line_marks) {
            *line = halve_marked(growth, line, marks, least);
        }
    }
    outcome.pieces.extend(open.into_iter().map(|open| open.piece));
    outcome.pieces.sort_by_key(|piece| piece.face);
    outcome.n_too_deep = Judge { growth, tolerance, lit }.n_too_deep(&outcome);
    outcome
}

/// A piece with edges that bend.
struct Open {
    piece: Piece,
    marks: Marks,
}

impl Open {
    /// The marked edges as long as `least`, the square of a length.
    fn due(&self, growth: &Growth, least: f64) -> Marks {
        let mut due = self.marks;
        for (mark, (a, b)) in due.edges.iter_mut().zip(self.piece.shape.edges()) {
            *mark = *mark && length_squared(growth, a, b) >= least;
        }
        due
    }

    /// Halves the edges that are due. A piece without one is given back.
    fn cut(self, growth: &mut Growth, due: Marks, fresh: &mut Vec<Piece>) -> Option<Open> {
        if !due.any() {
            return Some(self);
        }
        let Piece { face, shape } = self.piece;
        fresh.extend(split(growth, &shape, due).into_iter().map(|shape| Piece { face, shape }));
        None
    }
}

/// Edges of a piece that bend, or those of them that are halved now.
#[derive(Clone, Copy, Default)]
struct Marks {
    /// From each corner to the next.
    edges: [bool; 4],
    /// No edge is marked, but the inside is, or a diagonal of the quadrilateral.
    inside: bool,
}

impl Marks {
    fn any(self) -> bool {
        self.inside || self.edges.contains(&true)
    }

    /// At most how many pieces more there are when these edges are halved.
    fn n_added(self) -> usize {
        let n_edges = self.edges.iter().filter(|&&mark| mark).count();
        if self.any() { n_edges + 1 } else { 0 }
    }
}

/// Of an edge in rest coordinates. Lengths beyond the range of numbers count as its end.
fn length_squared(growth: &Growth, a: u32, b: u32) -> f64 {
    (growth.point(a).rest - growth.point(b).rest).length_squared().min(f64::MAX)
}

/// Says which edges bend.
struct Judge<'a, 'b> {
    growth: &'a Growth<'b>,
    tolerance: &'a Tolerance,
    lit: &'a Lit,
}

impl Judge<'_, '_> {
    /// Must this edge be halved? Asked in one order of its ends, so that all who share it hear the same.
    fn bends(&self, a: u32, b: u32) -> bool {
        self.generation(a, b) < MAX_GENERATION && self.bends_at_any_depth(a, b)
    }

    fn generation(&self, a: u32, b: u32) -> u32 {
        self.growth.point(a).generation.max(self.growth.point(b).generation)
    }

    fn bends_at_any_depth(&self, a: u32, b: u32) -> bool {
        let (low, high) = (a.min(b), a.max(b));
        let growth = self.growth;
        let (from, to, motion) = (growth.point(low), growth.point(high), growth.motion(low));
        edge::bends(from, to, motion, self.tolerance) || self.lit.is_uneven(from, to, motion)
    }

    /// The faces that need cutting, in order, cut into triangles and convex quadrilaterals.
    fn first_cuts(&self, scene: &Scene) -> Vec<(u32, Cut)> {
        let cut = |(idx, face): (usize, &Face)| Some((idx as u32, self.first_cut(scene, face)?));
        scene.faces.par_iter().enumerate().filter_map(cut).collect()
    }

    /// `None` if the face can stay as it is.
    fn first_cut(&self, scene: &Scene, face: &Face) -> Option<Cut> {
        let corners = scene.contours.corners(face.contours.clone());
        let motion = self.growth.motion(corners.first()?.0);
        if motion.is_at_rest() && self.lit.is_empty() {
            return None;
        }
        let points = corners.iter().map(|corner| self.growth.point(corner.0));
        if self.lit.is_empty() && quick::is_right(motion, points, self.tolerance) {
            return None;
        }
        let rest = |vertex: VertexId| -> DVec3 { self.growth.point(vertex.0).rest };
        let cut = if edge_on::is_edge_on(scene, face, motion, rest) {
            Cut::EdgeOn(as_contours(scene, face))
        } else {
            shape(scene, face, rest)?
        };
        let bends = match &cut {
            Cut::Pieces(shapes) => shapes.iter().any(|shape| self.piece(shape).any()),
            Cut::EdgeOn(lines) | Cut::Contours(lines) => {
                lines.iter().any(|line| self.line(line).contains(&true))
            }
        };
        bends.then_some(cut)
    }

    fn bent_wires(&self, scene: &Scene) -> Vec<Polyline> {
        let rows: Vec<u32> = scene.wires.iter().flat_map(|wire| wire.contours.clone()).collect();
        rows.into_par_iter()
            .map(|row| Polyline::open(row, scene.contours.get(row)))
            .filter(|line| self.line(line).contains(&true))
            .collect()
    }

    fn piece(&self, shape: &Shape) -> Marks {
        let mut marks = Marks::default();
        let points = shape.corners().iter().map(|&corner| self.growth.point(corner));
        let motion = self.growth.motion(shape.corners()[0]);
        if self.lit.is_empty() && quick::is_right(motion, points, self.tolerance) {
            return marks;
        }
        for (mark, (a, b)) in marks.edges.iter_mut().zip(shape.edges()) {
            *mark = self.bends(a, b);
        }
        marks.inside = !marks.any() && self.bends_inside(shape);
        marks
    }

    /// Given that no edge bends.
    fn bends_inside(&self, shape: &Shape) -> bool {
        match *shape {
            Shape::Triangle(corners) => self.bulges(corners),
            Shape::Quad([a, b, c, d]) => {
                self.bends(a, c)
                    || self.bends(b, d)
                    || [[a, b, c], [a, c, d], [b, c, d], [b, d, a]].into_iter().any(|half| self.bulges(half))
            }
        }
    }

    /// Is the true face too far from the inside of this triangle?
    fn bulges(&self, corners: [u32; 3]) -> bool {
        let motion = self.growth.motion(corners[0]);
        let points: [&Point; 3] = corners.map(|corner| self.growth.point(corner));
        let is_deep = points.iter().any(|point| point.generation >= MAX_GENERATION);
        motion.has_flight_time() && !is_deep && interior::offset(motion, points) > self.tolerance.offset
    }

    fn line(&self, line: &Polyline) -> Vec<bool> {
        line.edges().map(|(a, b)| self.bends(a, b)).collect()
    }

    /// Tells pieces that are done from those that are not.
    fn sort(&self, pieces: Vec<Piece>, open: &mut Vec<Open>, done: &mut Vec<Piece>) {
        let marks: Vec<Marks> = pieces.par_iter().map(|piece| self.piece(&piece.shape)).collect();
        for (piece, marks) in pieces.into_iter().zip(marks) {
            if marks.any() {
                open.push(Open { piece, marks });
            } else {
                done.push(piece);
            }
        }
    }

    /// Edges are halved now if the square of their length is as large as this: a quarter of the largest. `None`
    /// if nothing bends any more.
    fn least_due(&self, open: &[Open], lines: &[Polyline], line_marks: &[Vec<bool>]) -> Option<f64> {
        let longest = |edges: &mut dyn Iterator<Item = ((u32, u32), bool)>| -> Option<f64> {
            edges
                .filter(|&(_, mark)| mark)
                .map(|((a, b), _)| length_squared(self.growth, a, b))
                .reduce(f64::max)
        };
        // What is wrong inside has no length: its piece is cut at once.
        let of_piece = |open: &Open| {
            if open.marks.inside {
                return Some(0.0);
            }
            longest(&mut open.piece.shape.edges().zip(open.marks.edges))
        };
        let of_line =
            |(line, marks): (&Polyline, &Vec<bool>)| longest(&mut line.edges().zip(marks.iter().copied()));
        let of_pieces = open.par_iter().filter_map(of_piece).reduce_with(f64::max);
        let of_lines = lines.iter().zip(line_marks).filter_map(of_line).reduce(f64::max);
        of_pieces.into_iter().chain(of_lines).reduce(f64::max).map(|longest| longest / 4.0)
    }

    /// Number of edges that bend although they were halved as often as can be.
    fn n_too_deep(&self, outcome: &Outcome) -> usize {
        let of_pieces = outcome.pieces.iter().flat_map(|piece| piece.shape.edges());
        let edges = of_pieces.chain(outcome.lines.iter().flat_map(Polyline::edges));
        let is_deep =
            |&(a, b): &(u32, u32)| self.generation(a, b) >= MAX_GENERATION && self.bends_at_any_depth(a, b);
        edges.filter(is_deep).count()
    }
}

/// Halves the marked edges of a piece, or cuts it inside if that is marked.
fn split(growth: &mut Growth, shape: &Shape, marks: Marks) -> Vec<Shape> {
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

/// Halves those of the marked edges that are as long as `least`, the square of a length.
fn halve_marked(growth: &mut Growth, line: &Polyline, marks: &[bool], least: f64) -> Polyline {
    let mut corners = Vec::with_capacity(2 * line.corners.len());
    for (idx, &corner) in line.corners.iter().enumerate() {
        corners.push(corner);
        if marks.get(idx) == Some(&true) {
            let next = line.corners[(idx + 1) % line.corners.len()];
            if length_squared(growth, corner, next) >= least {
                corners.push(growth.middle(corner, next));
            }
        }
    }
    Polyline { corners, ..*line }
}

#[cfg(test)]
mod tests {
    use rustc_hash::FxHashSet;
    use ugphysics::Velocity;
    use ugscene::Geometry;

    use super::*;
    use crate::motion::Motion;

    #[test]
    fn there_are_no_cracks_when_cutting_stops_early() {
        let text = "v a -9 -9 1; v b 9 -9 1; v c 9 9 1; v d -9 9 1; f (a b c d); w (a c);";
        let source = ugparse::Source::new("t.ug", text);
        let scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
        let motions = [Motion::new(Velocity::from_beta(DVec3::X * 0.99).unwrap(), Geometry::default())];
        for max_pieces in [10, 100, 1000, 10_000] {
            let points = scene.vertices.iter().map(|vertex| motions[0].point(0, vertex.position)).collect();
            let mut growth = Growth::new(&motions, points);
            let outcome = cut(&scene, &mut growth, &Tolerance::new(1e-9, 2e-3), &Lit::default(), max_pieces);
            assert!(outcome.is_full);
            let n_pieces = outcome.pieces.len();
            assert!((max_pieces / 10..=max_pieces).contains(&n_pieces), "{n_pieces} of {max_pieces}");
            // Euler's formula for a square: it holds only if pieces share their edges.
            let edges = outcome.pieces.iter().flat_map(|piece| piece.shape.edges().collect::<Vec<_>>());
            let edges: FxHashSet<_> = edges.map(|(a, b)| (a.min(b), a.max(b))).collect();
            let vertices: FxHashSet<_> = edges.iter().flat_map(|&(a, b)| [a, b]).collect();
            assert_eq!(vertices.len() + n_pieces, edges.len() + 1);
        }
    }
}
