//! Cutting where the picture needs it (`-se`).
//!
//! Edges that bend ([`crate::edge::bends`]), where that shows in one of their pieces ([`crate::criterion`]), are halved, the longest
//! first: a round takes those between one power of 2 and the next, in every piece they border, so that pieces stay in
//! shape. So at the end of each round pieces still meet edge to edge, and it is safe to stop after any of them.
//!
//! | piece | edges halved | becomes |
//! | --- | --- | --- |
//! | triangle | 1, 2, 3 | 2, 3, 4 triangles |
//! | convex quadrilateral | all | 4 quadrilaterals round the mean of its corners, if both diagonals bend |
//! | | two opposite ones | 2 quadrilaterals |
//! | | others | 2 triangles, and those as above |
//! | | none bends, but a diagonal does, or the inside | 2 triangles |
//! | triangle | none bends, but the inside does | 3 triangles round the mean of its corners |
//! | other polygon | any bends, or an inner edge of its triangles | triangles, and those as above |
//! | other polygon that cannot be triangulated | any | itself with more corners |
//! | any, seen edge-on | any | itself with more corners |
//! | wire | any | itself with more corners |

use rayon::prelude::*;
use rustc_hash::FxHashSet;
use ugparse::Scene;

use crate::criterion::{Bounds, Criterion, MAX_GENERATION, Marks, Verdict};
use crate::pieces::{Cut, Outcome, Piece, Polyline};
use crate::refined_mesh::RefinedMesh;
use crate::split::split;

/// Pieces a scene is cut into at most: about half a gigabyte of text.
pub(crate) const MAX_PIECES: usize = 4_000_000;

/// Cuts faces and wires until every edge is right within `bounds`, or `max_pieces` would be passed.
pub(crate) fn cut(scene: &Scene, mesh: &mut RefinedMesh, bounds: &Bounds, max_pieces: usize) -> Outcome {
    let mut outcome = Outcome::default();
    let mut fresh: Vec<Piece> = Vec::new();
    for (face, cut) in (Criterion { mesh, bounds }).first_cuts(scene) {
        for contour in scene.face_contours(&scene.faces[face as usize]) {
            let next = contour.iter().cycle().skip(1);
            contour.iter().zip(next).for_each(|(a, b)| mesh.add_rim(a.0, b.0));
        }
        match cut {
            Cut::Pieces(shapes) => fresh.extend(shapes.into_iter().map(|shape| Piece { face, shape })),
            Cut::EdgeOn(lines) => outcome.lines.extend(lines),
            Cut::Contours(lines) => {
                outcome.lines.extend(lines);
                outcome.n_uncut += 1;
            }
        }
    }
    outcome.lines.extend(Criterion { mesh, bounds }.bent_wires(scene));
    let mut is_cut = vec![false; if fresh.is_empty() { 0 } else { scene.faces.len() }];
    let mut open: Vec<Open> = Vec::new();
    loop {
        let criterion = Criterion { mesh, bounds };
        sort(&criterion, std::mem::take(&mut fresh), &mut open, &mut outcome.pieces);
        let line_marks: Vec<Vec<bool>> = outcome.lines.par_iter().map(|line| criterion.line(line)).collect();
        let Some(least) = least_due(mesh, &open, &outcome.lines, &line_marks) else { break };

        let wanted = Wanted::new(&open, &outcome.lines, &line_marks);
        let due: Vec<Marks> = open.par_iter().map(|open| open.due(mesh, &wanted, least)).collect();
        let n_corners: usize = outcome.lines.iter().map(|line| 2 * line.corners.len()).sum();
        let n_added: usize = due.iter().map(|due| due.n_added()).sum();
        outcome.is_full = outcome.pieces.len() + open.len() + n_added + n_corners > max_pieces;
        if outcome.is_full {
            break;
        }
        let cut = |(open, due): (Open, Marks)| {
            if !due.any() {
                return Some(open);
            }
            let face = open.piece.face;
            is_cut[face as usize] = true;
            let shapes = split(mesh, bounds, &open.piece.shape, due);
            fresh.extend(shapes.into_iter().map(|shape| Piece { face, shape }));
            None
        };
        open = open.into_iter().zip(due).filter_map(cut).collect();
        for (line, marks) in outcome.lines.iter_mut().zip(&line_marks) {
            *line = halve_marked(mesh, line, marks, least);
        }
    }
    outcome.pieces.extend(open.into_iter().map(|open| open.piece));
    // A face of which nothing was cut stays as it is.
    outcome.pieces.retain(|piece| is_cut[piece.face as usize]);
    outcome.pieces.sort_by_key(|piece| piece.face);
    outcome.n_too_deep = n_too_deep(&Criterion { mesh, bounds }, &outcome);
    outcome
}

/// A piece with edges that bend.
struct Open {
    piece: Piece,
    verdict: Verdict,
}

impl Open {
    /// The edges that are wanted and as long as `least`, the square of a length.
    fn due(&self, mesh: &RefinedMesh, wanted: &Wanted, least: f64) -> Marks {
        let mut due = Marks { edges: self.verdict.bends, inside: false };
        for (mark, ends) in due.edges.iter_mut().zip(self.piece.shape.edges()) {
            *mark = *mark && wanted.has(ends) && length_squared(mesh, ends) >= least;
        }
        // Neighbours come first: what is left inside is seen when their edges are halved.
        due.inside = self.verdict.shows.inside && !due.any();
        due
    }
}

/// The edges that show in any of their pieces.
struct Wanted {
    /// `None` if all that bend do.
    edges: Option<FxHashSet<(u32, u32)>>,
}

impl Wanted {
    fn new(open: &[Open], lines: &[Polyline], line_marks: &[Vec<bool>]) -> Wanted {
        if open.par_iter().all(|open| open.verdict.bends == open.verdict.shows.edges) {
            return Wanted { edges: None };
        }
        let of_pieces = open.iter().flat_map(|open| open.piece.shape.edges().zip(open.verdict.shows.edges));
        let of_lines =
            lines.iter().zip(line_marks).flat_map(|(line, marks)| line.edges().zip(marks.iter().copied()));
        let edges = of_pieces.chain(of_lines).filter(|&(_, shows)| shows).map(|(ends, _)| in_order(ends));
        Wanted { edges: Some(edges.collect()) }
    }

    fn has(&self, ends: (u32, u32)) -> bool {
        self.edges.as_ref().is_none_or(|edges| edges.contains(&in_order(ends)))
    }
}

fn in_order((a, b): (u32, u32)) -> (u32, u32) {
    (a.min(b), a.max(b))
}

/// Of an edge in rest coordinates. Lengths beyond the range of numbers count as its end.
fn length_squared(mesh: &RefinedMesh, (a, b): (u32, u32)) -> f64 {
    (mesh.point(a).rest - mesh.point(b).rest).length_squared().min(f64::MAX)
}

/// Tells pieces that are done from those that are not.
fn sort(criterion: &Criterion, pieces: Vec<Piece>, open: &mut Vec<Open>, done: &mut Vec<Piece>) {
    let verdicts: Vec<Verdict> = pieces.par_iter().map(|piece| criterion.piece(&piece.shape)).collect();
    for (piece, verdict) in pieces.into_iter().zip(verdicts) {
        if verdict.is_open() {
            open.push(Open { piece, verdict });
        } else {
            done.push(piece);
        }
    }
}

/// Edges are halved now if the square of their length is as large as this: the largest of those that are wanted, rounded
/// down to a power of 4. So what becomes of a piece does not depend on how long edges are elsewhere. `None` if nothing is
/// to be halved any more.
fn least_due(mesh: &RefinedMesh, open: &[Open], lines: &[Polyline], line_marks: &[Vec<bool>]) -> Option<f64> {
    let longest = |edges: &mut dyn Iterator<Item = ((u32, u32), bool)>| -> Option<f64> {
        edges.filter(|&(_, mark)| mark).map(|(ends, _)| length_squared(mesh, ends)).reduce(f64::max)
    };
    // What is wrong inside has no length: its piece is cut at once.
    let of_piece = |open: &Open| {
        if open.verdict.shows.inside {
            return Some(0.0);
        }
        longest(&mut open.piece.shape.edges().zip(open.verdict.shows.edges))
    };
    let of_line =
        |(line, marks): (&Polyline, &Vec<bool>)| longest(&mut line.edges().zip(marks.iter().copied()));
    let of_pieces = open.par_iter().filter_map(of_piece).reduce_with(f64::max);
    let of_lines = lines.iter().zip(line_marks).filter_map(of_line).reduce(f64::max);
    of_pieces.into_iter().chain(of_lines).reduce(f64::max).map(octave)
}

/// The largest power of 4 that a number is as large as; 0 for numbers that have none.
fn octave(square: f64) -> f64 {
    if square < f64::MIN_POSITIVE {
        return 0.0;
    }
    let power = libm::ilogb(square);
    libm::ldexp(1.0, power - power.rem_euclid(2))
}

/// Number of edges that bend although they were halved as often as can be.
fn n_too_deep(criterion: &Criterion, outcome: &Outcome) -> usize {
    let of_pieces = outcome.pieces.iter().flat_map(|piece| piece.shape.edges());
    let edges = of_pieces.chain(outcome.lines.iter().flat_map(Polyline::edges));
    let is_deep = |&(a, b): &(u32, u32)| {
        criterion.generation(a, b) >= MAX_GENERATION && criterion.bends_at_any_depth(a, b)
    };
    edges.filter(is_deep).count()
}

/// Halves those of the marked edges that are as long as `least`, the square of a length.
fn halve_marked(mesh: &mut RefinedMesh, line: &Polyline, marks: &[bool], least: f64) -> Polyline {
    let mut corners = Vec::with_capacity(2 * line.corners.len());
    for (idx, &corner) in line.corners.iter().enumerate() {
        corners.push(corner);
        if marks.get(idx) == Some(&true) {
            let next = line.corners[(idx + 1) % line.corners.len()];
            if length_squared(mesh, (corner, next)) >= least {
                corners.push(mesh.middle(corner, next));
            }
        }
    }
    Polyline { corners, ..*line }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use ugparse::BodyId;
    use ugphysics::Velocity;
    use ugscene::Geometry;

    use super::*;
    use crate::cull::ViewVolume;
    use crate::edge::Tolerance;
    use crate::near_lamps::NearLamps;
    use crate::relative_motion::RelativeMotion;

    #[test]
    fn there_are_no_cracks_when_cutting_stops_early() {
        let text = "v a -9 -9 1; v b 9 -9 1; v c 9 9 1; v d -9 9 1; f (a b c d); w (a c);";
        let source = ugparse::Source::new("t.ug", text);
        let scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
        let motions =
            [RelativeMotion::new(Velocity::from_beta(DVec3::X * 0.99).unwrap(), Geometry::default())];
        for max_pieces in [10, 100, 1000, 10_000] {
            let points = scene
                .vertices
                .iter()
                .map(|vertex| motions[0].point(BodyId::UNSTATED, vertex.position))
                .collect();
            let mut mesh = RefinedMesh::new(&motions, points);
            let bounds = Bounds::new(
                vec![Tolerance::new(1e-9, 2e-3)],
                NearLamps::default(),
                ViewVolume::default(),
                &motions,
            );
            let outcome = cut(&scene, &mut mesh, &bounds, max_pieces);
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
