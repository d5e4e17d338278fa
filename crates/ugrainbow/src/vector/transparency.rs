//! Areas seen through translucent faces.
//!
//! Formats with opacity blend encoded colours instead of light, and PostScript has no opacity. So
//! figures contain no blending: where a translucent face is painted, everything painted there
//! before is painted again, clipped to the face and in the colour seen through it, unless it is
//! hidden there.

use ugimage::figure::Point;

use super::order::Piece;
use super::patch::Patch;
use super::work::Work;
use crate::error::Error;
use crate::planar::{BoxIndex, Convex, is_covered};

/// Most areas of a figure. Each translucent face adds the areas seen through it.
const MOST_AREAS: usize = 1 << 16;

/// Most work for the areas of a figure, which took about two seconds.
const MOST_WORK: u64 = 1 << 26;

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
pub fn areas(
    patches: &[Patch],
    pieces: &[Piece],
    size: [u32; 2],
) -> Result<Vec<PaintedArea>, Error> {
    let has_clear = patches.iter().any(|patch| patch.is_transparent);
    let n_shapes = if has_clear { MOST_AREAS } else { 1 };
    let mut areas = PaintedAreas {
        index: BoxIndex::empty(n_shapes, size),
        all: Vec::new(),
        work: Work::new(MOST_WORK),
    };
    for piece in pieces {
        let area = whole(patches, piece);
        if patches[area.layers[0]].is_transparent {
            areas.push_transparent(area);
        } else {
            areas.push(area);
        }
        if areas.all.len() > MOST_AREAS || areas.work.is_exceeded() {
            return Err(too_many(has_clear, pieces.len()));
        }
    }
    Ok(areas.all)
}

/// Why there are too many areas of so many pieces.
fn too_many(has_clear: bool, n_pieces: usize) -> Error {
    if has_clear && n_pieces <= MOST_AREAS { Error::FigureOverlaps } else { Error::FigureFaces }
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
    work: Work,
}

impl PaintedAreas {
    fn push(&mut self, area: PaintedArea) {
        self.index.push(Convex::bounds(&area.parts));
        self.all.push(area);
    }

    /// Adds a translucent piece, and the areas seen through it again. Beyond [`MOST_WORK`] it
    /// stops.
    fn push_transparent(&mut self, front: PaintedArea) {
        let mut behind = Vec::new();
        let work = &self.work;
        // Everything that hides a part of the piece is among its neighbours.
        let near = self.index.in_box(Convex::bounds(&front.parts));
        work.count(near.len());
        for (at, &number) in near.iter().enumerate() {
            if work.is_exceeded() {
                break;
            }
            let area = &self.all[number];
            let common: Vec<Convex> = front
                .parts
                .iter()
                .flat_map(|own| area.parts.iter().map(move |part| (own, part)))
                .inspect(|(own, part)| work.count_pair(own, part))
                .filter_map(|(own, part)| own.common(part))
                .collect();
            if !common.is_empty() && !self.is_hidden(common.clone(), &near[at + 1..]) {
                let layers = front.layers.iter().chain(&area.layers).copied().collect();
                behind.push(of_parts(layers, common));
            }
        }
        let is_hidden = self.is_hidden(front.parts.clone(), &near);
        if !is_hidden {
            self.push(front);
        }
        behind.into_iter().for_each(|area| self.push(area));
    }

    /// True if the areas of these numbers cover these parts completely.
    fn is_hidden(&self, parts: Vec<Convex>, later: &[usize]) -> bool {
        let bounds = Convex::bounds(&parts);
        let covers = later
            .iter()
            .inspect(|_| self.work.count(1))
            .filter(|&&number| self.index.overlaps(number, bounds))
            .map(|&number| &self.all[number].parts[..]);
        is_covered(parts, covers, |own, part| {
            self.work.count_pair(&own, part);
            own.difference(part)
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use ugtesting::Random;

    use super::*;

    #[test]
    fn translucent_faces_are_blamed_only_if_they_add_the_areas() {
        assert!(matches!(too_many(true, 1000), Error::FigureOverlaps));
        assert!(matches!(too_many(true, MOST_AREAS + 1), Error::FigureFaces));
        assert!(matches!(too_many(false, MOST_AREAS + 1), Error::FigureFaces));
    }

    /// Panes in front of each other at random places: the work of the last piece is bounded, too.
    #[test]
    fn work_stops_at_its_limit() {
        let mut random = Random(5);
        let index = BoxIndex::empty(MOST_AREAS, [100; 2]);
        let mut areas = PaintedAreas { index, all: Vec::new(), work: Work::new(MOST_WORK) };
        let mut pane = || {
            let [x, y] = [30.0 * random.unit(), 30.0 * random.unit()];
            let corners =
                [[x, y, 1.0], [x + 60.0, y, 1.0], [x + 60.0, y + 60.0, 1.0], [x, y + 60.0, 1.0]];
            of_parts(vec![0], vec![Convex::new(corners.to_vec()).unwrap()])
        };
        (0..20).for_each(|_| areas.push_transparent(pane()));
        assert!(
            !areas.work.is_exceeded() && areas.all.len() > 200,
            "{:?} {}",
            areas.work,
            areas.all.len()
        );
        let n_areas = areas.all.len();
        areas.work = Work::new(0);
        areas.work.count(1);
        areas.push_transparent(pane());
        // The pane itself is compared with each area, cut into 64 parts at most.
        let most = (n_areas * 64 * 64) as u64;
        assert!(areas.work.done() < most && areas.all.len() <= n_areas + 1, "{:?}", areas.work);
    }
}
