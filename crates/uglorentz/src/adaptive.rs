//! Adaptive subdivision (`-se`).
//!
//! An edge is halved if its error is above the bound ([`crate::edge::bends`]) and visible in one of
//! its pieces ([`crate::criterion`]). The longest edges come first: a round halves those whose
//! lengths are between one power of 2 and the next, in all pieces they border, so that pieces keep
//! a good shape. At the end of each round the mesh is without T-junctions, so it is safe to stop
//! after any round.
//!
//! | piece | edges above the bound | becomes |
//! | --- | --- | --- |
//! | triangle | 1, 2, 3 | 2, 3, 4 triangles |
//! | convex quadrilateral with corners of one colour and normal | all, and both diagonals | 4 quadrilaterals around the mean of its corners |
//! | | two opposite ones | 2 quadrilaterals |
//! | | others | 2 triangles, and those as above |
//! | | none, but a diagonal or the inside | 2 triangles |
//! | triangle | none, but the inside | 3 triangles around the mean of its corners |
//! | other polygon | any, or an inner edge of its triangles | triangles, and those as above |
//! | other polygon that cannot be triangulated | any | itself with more corners |
//! | any, seen edge-on | any | itself with more corners |
//! | wire | any | itself with more corners |

use rayon::prelude::*;
use rustc_hash::FxHashSet;
use ugpipe::{Progress, Stopped};
use ugscene::{Scene, face_edges};

use crate::criterion::{Bounds, Criterion, MAX_GENERATION, Marks, Verdict};
use crate::evenness::Evenness;
use crate::pieces::{Cut, Outcome, Piece, Polyline};
use crate::refined_mesh::RefinedMesh;
use crate::relative_motion::RelativeMotion;
use crate::split::split;

/// The limit of pieces of a scene: about half a gigabyte of text.
pub(crate) const MAX_PIECES: usize = 4_000_000;

/// Pieces beyond the faces of the scene that a picture may have without pixels, and for each pixel.
const PIECES_OF_PICTURE: [usize; 2] = [1 << 18, 64];

/// Pieces beyond the faces of a scene with bodies on world lines, whose edges take much longer.
const PIECES_ON_WORLD_LINES: usize = 1_000_000;

/// The limit of pieces for a picture of this size: more than can be seen in it, and
/// [`MAX_PIECES`] at most.
pub(crate) fn max_pieces(
    n_faces: usize,
    [width, height]: [u32; 2],
    motions: &[RelativeMotion],
) -> usize {
    let [least, per_pixel] = PIECES_OF_PICTURE;
    let n_pixels = (width as usize).saturating_mul(height as usize);
    let of_picture = per_pixel.saturating_mul(n_pixels).saturating_add(least);
    let has_world_lines = motions.iter().any(|motion| motion.world_line().is_some());
    let most = if has_world_lines { of_picture.min(PIECES_ON_WORLD_LINES) } else { of_picture };
    most.saturating_add(n_faces).min(MAX_PIECES)
}

/// Subdivides faces and wires until every error is within `bounds`, or `max_pieces` would be
/// exceeded.
///
/// # Errors
/// The caller stopped it; this is checked in every round.
pub(crate) fn cut(
    scene: &Scene,
    evenness: &Evenness,
    mesh: &mut RefinedMesh,
    bounds: &Bounds,
    max_pieces: usize,
    progress: &dyn Progress,
) -> Result<Outcome, Stopped> {
    let mut outcome = Outcome::default();
    let mut fresh: Vec<Piece> = Vec::new();
    for (face, cut) in (Criterion { mesh, bounds }).first_cuts(scene, evenness) {
        face_edges(scene, &scene.faces[face as usize]).for_each(|[a, b]| mesh.add_rim(a.0, b.0));
        match cut {
            Cut::Pieces(shapes) => {
                fresh.extend(shapes.into_iter().map(|shape| Piece { face, shape }))
            }
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
        progress.check()?;
        let criterion = Criterion { mesh, bounds };
        sort(&criterion, std::mem::take(&mut fresh), &mut open, &mut outcome.pieces);
        let line_marks: Vec<Vec<bool>> =
            outcome.lines.par_iter().map(|line| criterion.line(line)).collect();
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
    // Faces without halved edges stay as they are.
    outcome.pieces.retain(|piece| is_cut[piece.face as usize]);
    outcome.pieces.sort_by_key(|piece| piece.face);
    outcome.n_too_deep = n_too_deep(&Criterion { mesh, bounds }, &outcome);
    Ok(outcome)
}

/// A piece with errors above the bound.
struct Open {
    piece: Piece,
    verdict: Verdict,
}

impl Open {
    /// The edges that are in `wanted` and whose squared length is at least `least`.
    fn due(&self, mesh: &RefinedMesh, wanted: &Wanted, least: f64) -> Marks {
        let mut due = Marks { edges: self.verdict.bends, inside: false };
        for (mark, ends) in due.edges.iter_mut().zip(self.piece.shape.edges()) {
            *mark = *mark && wanted.has(ends) && length_squared(mesh, ends) >= least;
        }
        // Edges first: halving them changes the error inside.
        due.inside = self.verdict.shows.inside && !due.any();
        due
    }
}

/// The edges whose errors are visible in any of their pieces.
struct Wanted {
    /// `None` if this holds for all edges above the bound.
    edges: Option<FxHashSet<(u32, u32)>>,
}

impl Wanted {
    fn new(open: &[Open], lines: &[Polyline], line_marks: &[Vec<bool>]) -> Wanted {
        if open.par_iter().all(|open| open.verdict.bends == open.verdict.shows.edges) {
            return Wanted { edges: None };
        }
        let of_pieces =
            open.iter().flat_map(|open| open.piece.shape.edges().zip(open.verdict.shows.edges));
        let of_lines = lines
            .iter()
            .zip(line_marks)
            .flat_map(|(line, marks)| line.edges().zip(marks.iter().copied()));
        let edges =
            of_pieces.chain(of_lines).filter(|&(_, shows)| shows).map(|(ends, _)| in_order(ends));
        Wanted { edges: Some(edges.collect()) }
    }

    fn has(&self, ends: (u32, u32)) -> bool {
        self.edges.as_ref().is_none_or(|edges| edges.contains(&in_order(ends)))
    }
}

fn in_order((a, b): (u32, u32)) -> (u32, u32) {
    (a.min(b), a.max(b))
}

/// The squared length of an edge in rest coordinates. Infinite values are replaced by the largest
/// number.
fn length_squared(mesh: &RefinedMesh, (a, b): (u32, u32)) -> f64 {
    (mesh.point(a).rest - mesh.point(b).rest).length_squared().min(f64::MAX)
}

/// Appends each piece to `open` or `done`.
fn sort(criterion: &Criterion, pieces: Vec<Piece>, open: &mut Vec<Open>, done: &mut Vec<Piece>) {
    let verdicts: Vec<Verdict> =
        pieces.par_iter().map(|piece| criterion.piece(&piece.shape)).collect();
    for (piece, verdict) in pieces.into_iter().zip(verdicts) {
        if verdict.is_open() {
            open.push(Open { piece, verdict });
        } else {
            done.push(piece);
        }
    }
}

/// The smallest squared length of edges to halve in this round: the largest of the wanted ones,
/// rounded down to a power of 4, so that the result for a piece does not depend on the lengths of
/// edges elsewhere. `None` if no edges are left to halve.
fn least_due(
    mesh: &RefinedMesh,
    open: &[Open],
    lines: &[Polyline],
    line_marks: &[Vec<bool>],
) -> Option<f64> {
    let longest = |edges: &mut dyn Iterator<Item = ((u32, u32), bool)>| -> Option<f64> {
        edges.filter(|&(_, mark)| mark).map(|(ends, _)| length_squared(mesh, ends)).reduce(f64::max)
    };
    // Pieces whose inside is above the bound are subdivided at once.
    let of_piece = |open: &Open| {
        if open.verdict.shows.inside {
            return Some(0.0);
        }
        longest(&mut open.piece.shape.edges().zip(open.verdict.shows.edges))
    };
    let of_line = |(line, marks): (&Polyline, &Vec<bool>)| {
        longest(&mut line.edges().zip(marks.iter().copied()))
    };
    let of_pieces = open.par_iter().filter_map(of_piece).reduce_with(f64::max);
    let of_lines = lines.iter().zip(line_marks).filter_map(of_line).reduce(f64::max);
    of_pieces.into_iter().chain(of_lines).reduce(f64::max).map(octave)
}

/// The largest power of 4 that is not above a number; 0 for 0 and subnormal numbers.
fn octave(square: f64) -> f64 {
    if square < f64::MIN_POSITIVE {
        return 0.0;
    }
    let power = libm::ilogb(square);
    libm::ldexp(1.0, power - power.rem_euclid(2))
}

/// The number of edges above the bound at the limit of halvings.
fn n_too_deep(criterion: &Criterion, outcome: &Outcome) -> usize {
    if criterion.mesh.points.iter().all(|point| point.generation < MAX_GENERATION) {
        return 0;
    }
    let of_pieces = outcome.pieces.iter().flat_map(|piece| piece.shape.edges());
    let edges = of_pieces.chain(outcome.lines.iter().flat_map(Polyline::edges));
    let is_deep = |&(a, b): &(u32, u32)| {
        criterion.generation(a, b) >= MAX_GENERATION && criterion.bends_at_any_depth(a, b)
    };
    edges.filter(is_deep).count()
}

/// Halves the marked edges whose squared length is at least `least`.
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
    use ugphysics::Velocity;
    use ugscene::{BodyId, ShownEffects};

    use super::*;
    use crate::clocks::Clocks;
    use crate::cull::ViewVolume;
    use crate::edge::Tolerance;
    use crate::near_lamps::NearLamps;
    use crate::relative_motion::Point;

    #[test]
    fn there_are_no_cracks_when_subdivision_stops_early() {
        let text = "v a -9 -9 1; v b 9 -9 1; v c 9 9 1; v d -9 9 1; f (a b c d); w (a c);";
        let source = ugparse::Source::new("t.ug", text);
        let scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
        let motions = [RelativeMotion::new(
            Velocity::from_beta(DVec3::X * 0.99).unwrap(),
            ShownEffects::default(),
        )];
        for max_pieces in [10, 100, 1000, 10_000] {
            let points = scene
                .vertices
                .iter()
                .map(|vertex| Point::new(&motions[0], BodyId::from_index(0), vertex.position))
                .collect();
            let mut mesh = RefinedMesh::new(&motions, points);
            let bounds = Bounds::new(
                vec![Tolerance::new(1e-9, 2e-3)],
                (NearLamps::default(), Clocks::default()),
                ViewVolume::default(),
                &motions,
            );
            let outcome =
                cut(&scene, &Evenness::default(), &mut mesh, &bounds, max_pieces, &()).unwrap();
            assert!(outcome.is_full);
            let n_pieces = outcome.pieces.len();
            assert!(
                (max_pieces / 10..=max_pieces).contains(&n_pieces),
                "{n_pieces} of {max_pieces}"
            );
            // Euler's formula for a square holds only if pieces share their edges.
            let edges =
                outcome.pieces.iter().flat_map(|piece| piece.shape.edges().collect::<Vec<_>>());
            let edges: FxHashSet<_> = edges.map(|(a, b)| (a.min(b), a.max(b))).collect();
            let vertices: FxHashSet<_> = edges.iter().flat_map(|&(a, b)| [a, b]).collect();
            assert_eq!(vertices.len() + n_pieces, edges.len() + 1);
        }
    }
}
