//! Areas seen through translucent faces.
//!
//! Formats with opacity blend encoded colours instead of light, and PostScript has no opacity. So
//! figures contain no blending: where a translucent face is painted, everything painted there
//! before is painted again, clipped to the face and in the colour seen through it, unless it is
//! hidden there.

use ugimage::figure::Point;

use super::order::Piece;
use super::patch::Patch;
use crate::error::Error;
use crate::planar::{BoxIndex, Convex, is_covered};

/// Most areas of a figure. Each translucent face adds the areas seen through it.
const MOST_AREAS: usize = 1 << 16;

/// Most comparisons of an area with another: some seconds of work.
const MOST_VISITS: usize = 1 << 28;

/// An area to paint, and the patches that are seen there.
#[derive(Clone, Debug)]
pub struct PaintedArea {
    /// The visible patches from front to back. All but the last are translucent; if the last is
    /// too, the background is behind it.
    pub layers: Vec<usize>,
    /// Its outlines; even-odd rule.
    pub contours: Vec<Vec<Point>>,
    /// The same in convex parts.
    pub parts: Vec<Convex>,
}

/// Pieces in the order of painting as areas in that order. `size`: of the picture.
///
/// # Errors
/// There are too many.
pub fn areas(patches: &[Patch], pieces: &[Piece], size: [u32; 2]) -> Result<Vec<PaintedArea>, Error> {
    let has_clear = patches.iter().any(|patch| patch.is_transparent);
    let n_shapes = if has_clear { MOST_AREAS } else { 1 };
    let mut areas = PaintedAreas { index: BoxIndex::empty(n_shapes, size), all: Vec::new(), n_visits: 0 };
    for piece in pieces {
        let area = whole(patches, piece);
        if patches[area.layers[0]].is_transparent {
            areas.push_transparent(area);
        } else {
            areas.push(area);
        }
        if areas.all.len() > MOST_AREAS || areas.n_visits > MOST_VISITS {
            return Err(Error::Figure(too_many(has_clear, pieces.len())));
        }
    }
    Ok(areas.all)
}

/// Why there are too many areas of so many pieces.
fn too_many(has_clear: bool, n_pieces: usize) -> &'static str {
    if has_clear && n_pieces <= MOST_AREAS {
        "too many translucent faces overlap for vector graphics: leave out -vec, and give a larger -sz for print"
    } else {
        "faces, and the parts into which they cut each other, are too many for vector graphics: leave out -vec, \
         and give a larger -sz for print"
    }
}

/// A piece with the background directly behind it.
fn whole(patches: &[Patch], piece: &Piece) -> PaintedArea {
    match piece {
        Piece::Whole(idx) => {
            let patch = &patches[*idx];
            let flat = |contour: &Vec<[f64; 3]>| contour.iter().map(|&[x, y, _]| [x, y]).collect();
            let contours = patch.outline.iter().map(flat).collect();
            PaintedArea { layers: vec![*idx], contours, parts: patch.parts.clone() }
        }
        Piece::Part(idx, part) => of_parts(vec![*idx], vec![part.clone()]),
    }
}

fn of_parts(layers: Vec<usize>, parts: Vec<Convex>) -> PaintedArea {
    PaintedArea { layers, contours: parts.iter().map(Convex::outline).collect(), parts }
}

/// The areas painted so far.
struct PaintedAreas {
    all: Vec<PaintedArea>,
    index: BoxIndex,
    /// How many times an area was compared with another.
    n_visits: usize,
}

impl PaintedAreas {
    fn push(&mut self, area: PaintedArea) {
        self.index.push(Convex::bounds(&area.parts));
        self.all.push(area);
    }

    /// Adds a translucent piece, and the areas seen through it again.
    fn push_transparent(&mut self, front: PaintedArea) {
        let mut behind = Vec::new();
        // Everything that hides a part of the piece is among its neighbours.
        let near = self.index.in_box(Convex::bounds(&front.parts));
        self.n_visits += near.len();
        for (at, &number) in near.iter().enumerate() {
            let area = &self.all[number];
            let common: Vec<Convex> = front
                .parts
                .iter()
                .flat_map(|own| area.parts.iter().filter_map(|part| own.common(part)))
                .collect();
            if !common.is_empty() && !self.is_hidden(common.clone(), &near[at + 1..]) {
                let layers = front.layers.iter().chain(&area.layers).copied().collect();
                behind.push(of_parts(layers, common));
            }
        }
        if !self.is_hidden(front.parts.clone(), &near) {
            self.push(front);
        }
        behind.into_iter().for_each(|area| self.push(area));
    }

    /// True if the areas of these numbers cover these parts completely.
    fn is_hidden(&mut self, parts: Vec<Convex>, later: &[usize]) -> bool {
        let bounds = Convex::bounds(&parts);
        let mut n_visits = 0;
        let covers = later.iter().inspect(|_| n_visits += 1);
        let covers = covers.filter(|&&number| self.index.overlaps(number, bounds));
        let covers = covers.map(|&number| &self.all[number].parts[..]);
        let is_hidden = is_covered(parts, covers, |own, part| own.beside(part));
        self.n_visits += n_visits;
        is_hidden
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn translucent_faces_are_blamed_only_if_they_add_the_areas() {
        assert!(too_many(true, 1000).contains("translucent"));
        assert!(!too_many(true, MOST_AREAS + 1).contains("translucent"));
        assert!(!too_many(false, MOST_AREAS + 1).contains("translucent"));
    }
}
