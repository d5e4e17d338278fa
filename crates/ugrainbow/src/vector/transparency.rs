//! What is seen through translucent faces.
//!
//! Formats that have opacity blend encoded colours, and PostScript has none. So nothing is blended by who shows a figure:
//! where a translucent face comes, all that was painted there before is painted once more, cut to the face, and in the
//! colours it has behind it. Only what is still seen there is.

use ugimage::figure::Point;

use super::order::Piece;
use super::patch::Patch;
use crate::error::Error;
use crate::planar::BoxIndex;
use crate::planar::Convex;

/// Most coats of a figure. Each pane before others adds what is seen through it.
const MOST_COATS: usize = 1 << 16;

/// Most parts an area is cut into to find out whether it is hidden; with more it counts as seen.
const MOST_PARTS: usize = 64;

/// What is painted at once: an area, and what is seen there.
#[derive(Clone, Debug)]
pub struct Coat {
    /// The patches that are seen, from the front. All but the last are translucent; if that is, too, the ground is
    /// behind it.
    pub layers: Vec<usize>,
    /// Its outlines; even-odd rule.
    pub contours: Vec<Vec<Point>>,
    /// The same in convex parts.
    pub parts: Vec<Convex>,
}

/// Pieces in the order of painting as coats in that order. `size`: of the picture.
///
/// # Errors
/// There are too many.
pub fn coats(patches: &[Patch], pieces: &[Piece], size: [u32; 2]) -> Result<Vec<Coat>, Error> {
    let has_clear = patches.iter().any(|patch| patch.is_clear);
    let n_shapes = if has_clear { MOST_COATS } else { 1 };
    let mut coats = Coats { index: BoxIndex::empty(n_shapes, size), all: Vec::new() };
    for piece in pieces {
        let coat = whole(patches, piece);
        if patches[coat.layers[0]].is_clear {
            coats.push_clear(coat);
        } else {
            coats.push(coat);
        }
        if coats.all.len() > MOST_COATS {
            return Err(Error::Figure(
                "too many translucent faces stand before each other for a figure of areas: leave out -vec, and give a larger -sz for print",
            ));
        }
    }
    Ok(coats.all)
}

/// A piece before the ground.
fn whole(patches: &[Patch], piece: &Piece) -> Coat {
    match piece {
        Piece::Whole(idx) => {
            let patch = &patches[*idx];
            let flat = |contour: &Vec<[f64; 3]>| contour.iter().map(|&[x, y, _]| [x, y]).collect();
            let contours = patch.outline.iter().map(flat).collect();
            Coat { layers: vec![*idx], contours, parts: patch.parts.clone() }
        }
        Piece::Part(idx, part) => of_parts(vec![*idx], vec![part.clone()]),
    }
}

fn of_parts(layers: Vec<usize>, parts: Vec<Convex>) -> Coat {
    Coat { layers, contours: parts.iter().map(Convex::outline).collect(), parts }
}

/// What has been painted so far.
struct Coats {
    all: Vec<Coat>,
    index: BoxIndex,
}

impl Coats {
    fn push(&mut self, coat: Coat) {
        self.index.push(Convex::bounds(&coat.parts));
        self.all.push(coat);
    }

    /// Paints what is behind a translucent piece once more.
    fn push_clear(&mut self, pane: Coat) {
        let mut behind = Vec::new();
        for number in self.near(&pane.parts) {
            let coat = &self.all[number];
            let common: Vec<Convex> = pane
                .parts
                .iter()
                .flat_map(|own| coat.parts.iter().filter_map(|part| own.common(part)))
                .collect();
            if !common.is_empty() && !self.is_hidden(common.clone(), number + 1) {
                let layers = pane.layers.iter().chain(&coat.layers).copied().collect();
                behind.push(of_parts(layers, common));
            }
        }
        if !self.is_hidden(pane.parts.clone(), 0) {
            self.push(pane);
        }
        behind.into_iter().for_each(|coat| self.push(coat));
    }

    /// Coats whose boxes overlap that of some parts, in the order of painting.
    fn near(&self, parts: &[Convex]) -> Vec<usize> {
        self.index.in_box(Convex::bounds(parts))
    }

    /// True if coats from number `first` on cover these parts wholly.
    fn is_hidden(&self, mut parts: Vec<Convex>, first: usize) -> bool {
        let near = self.near(&parts);
        for &number in &near[near.partition_point(|&number| number < first)..] {
            for part in &self.all[number].parts {
                parts = parts.iter().flat_map(|own| own.beside(part)).collect();
            }
            if parts.is_empty() || parts.len() > MOST_PARTS {
                break;
            }
        }
        parts.is_empty()
    }
}
