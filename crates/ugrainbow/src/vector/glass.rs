//! Translucent faces in figures, as areas of the colours that are seen through them.
//!
//! Not every format has opacity, and those that have it blend encoded colours and not light. So what lies behind a
//! translucent face is cut along its outline, and the part within gets the colours that are seen there.

use super::convex::{Convex, Place, clip, sides};
use super::order::Piece;
use super::patch::Patch;

/// Pixels within which an edge lies on another.
const CLOSE: f64 = 0.02;

/// An area, and the patches seen in it.
#[derive(Clone, Debug)]
pub struct Area {
    /// The pieces seen in it, from behind.
    pub stack: Vec<Piece>,
    /// None for all of a piece, which is then the only one.
    pub part: Option<Convex>,
}

/// The areas to be painted for pieces, from behind.
pub fn areas(patches: &[Patch], pieces: Vec<Piece>) -> Vec<Area> {
    let mut areas: Vec<Area> = Vec::with_capacity(pieces.len());
    for piece in pieces {
        let mut through = Vec::new();
        if patches[piece.patch()].is_clear {
            for part in piece.parts(patches) {
                let cut = |area| look_through(patches, (&piece, part), area, &mut through);
                areas = areas.into_iter().flat_map(cut).collect();
            }
        }
        areas.push(Area { stack: vec![piece], part: None });
        areas.append(&mut through);
    }
    areas
}

/// What of an area lies beside a part of a pane; the rest is put to what is seen `through` it.
fn look_through(
    patches: &[Patch],
    (pane, part): (&Piece, &Convex),
    area: Area,
    through: &mut Vec<Area>,
) -> Vec<Area> {
    let parts = area.parts(patches);
    if parts.iter().all(|own| own.is_apart(part)) {
        return vec![area];
    }
    let mut beside = Vec::new();
    for own in parts {
        let mut rest = own.corners.clone();
        for (a, b) in sides(&part.corners) {
            let inside = |[x, y, _]: Place| (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
            beside.extend(Convex::new(clip(&rest, |place| -inside(place))));
            rest = clip(&rest, inside);
        }
        if let Some(common) = Convex::new(rest) {
            let stack = area.stack.iter().chain([pane]).cloned().collect();
            through.push(Area { stack, part: Some(common) });
        }
    }
    beside.into_iter().map(|part| Area { stack: area.stack.clone(), part: Some(part) }).collect()
}

impl Area {
    /// Its convex flat parts.
    pub fn parts<'a>(&'a self, patches: &'a [Patch]) -> &'a [Convex] {
        self.part.as_ref().map_or_else(|| self.stack[0].parts(patches), std::slice::from_ref)
    }

    /// Edges that are cuts, and no outline of what is seen in it. Beyond them the picture goes on, either alike or with
    /// what is painted later; so the area may reach over them, and no hairline of what lies behind is left.
    pub fn cuts(&self, patches: &[Patch]) -> Vec<[Place; 2]> {
        let Some(part) = &self.part else { return Vec::new() };
        let is_outline = |a: Place, b: Place| {
            let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
            self.stack.iter().any(|piece| match piece {
                Piece::Whole(idx) => patches[*idx].outline.iter().any(|outline| is_on(outline, middle)),
                Piece::Part(_, part) => is_on(&part.corners, middle),
            })
        };
        sides(&part.corners).filter(|&(a, b)| !is_outline(a, b)).map(|(a, b)| [a, b]).collect()
    }
}

/// True if a place lies on an outline.
fn is_on(outline: &[Place], [x, y]: [f64; 2]) -> bool {
    sides(outline).any(|(a, b)| {
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let square = dx * dx + dy * dy;
        let along = if square > 0.0 { ((x - a[0]) * dx + (y - a[1]) * dy) / square } else { 0.0 };
        let along = along.clamp(0.0, 1.0);
        libm::hypot(x - a[0] - along * dx, y - a[1] - along * dy) < CLOSE
    })
}
