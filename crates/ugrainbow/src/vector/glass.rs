//! Translucent faces in figures, as areas of the colours that are seen through them.
//!
//! Not every format has opacity, and those that have it blend encoded colours and not light. So whatever a translucent
//! face lies over is painted once more within its outline, in the colours that are seen there.

use super::convex::{Convex, clip, sides};
use super::order::Piece;
use super::patch::Patch;

/// An area in paint order, and the patches seen in it: the last hides part of the one before, and so on.
pub struct Area {
    /// Rows of the patches, from behind.
    pub stack: Vec<usize>,
    /// None for all of the patch, which is then the only one.
    pub part: Option<Convex>,
}

/// The areas to be painted for pieces, from behind.
pub fn areas(patches: &[Patch], pieces: Vec<Piece>) -> Vec<Area> {
    let mut areas = Vec::new();
    // What is seen where a pane may come, in disjoint parts but for what is painted over.
    let mut seen: Vec<(Vec<usize>, Convex)> = Vec::new();
    let mut n_panes = pieces.iter().filter(|piece| patches[piece.patch()].is_clear).count();
    for piece in pieces {
        let idx = piece.patch();
        let parts = piece.parts(patches).to_vec();
        areas.push(Area {
            stack: vec![idx],
            part: match piece {
                Piece::Whole(_) => None,
                Piece::Part(_, part) => Some(part),
            },
        });
        if n_panes == 0 {
            continue;
        }
        if patches[idx].is_clear {
            n_panes -= 1;
            for part in &parts {
                let through = look_through(part, idx, &mut seen);
                areas.extend(
                    through
                        .iter()
                        .map(|(stack, part)| Area { stack: stack.clone(), part: Some(part.clone()) }),
                );
                seen.push((vec![idx], part.clone()));
                seen.extend(through);
            }
        } else {
            seen.extend(parts.into_iter().map(|part| (vec![idx], part)));
        }
    }
    areas
}

/// What is seen through a part of a pane; what remains beside it stays in `seen`.
fn look_through(
    pane: &Convex,
    idx: usize,
    seen: &mut Vec<(Vec<usize>, Convex)>,
) -> Vec<(Vec<usize>, Convex)> {
    let mut through = Vec::new();
    for (stack, area) in std::mem::take(seen) {
        let is_apart =
            (0..2).any(|axis| area.high[axis] <= pane.low[axis] || pane.high[axis] <= area.low[axis]);
        if is_apart || stack.last() == Some(&idx) {
            seen.push((stack, area));
            continue;
        }
        let mut rest = area.corners;
        for (a, b) in sides(&pane.corners) {
            let inside = |[x, y, _]: [f64; 3]| (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
            let beside = Convex::new(clip(&rest, |place| -inside(place)));
            seen.extend(beside.map(|part| (stack.clone(), part)));
            rest = clip(&rest, inside);
        }
        if let Some(common) = Convex::new(rest) {
            let mut stack = stack;
            stack.push(idx);
            through.push((stack, common));
        }
    }
    through
}
