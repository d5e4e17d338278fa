//! Which patches are where in the picture.

use std::cell::RefCell;
use std::ops::RangeInclusive;

use super::patch::Patch;

/// A grid of cells over the picture, each with the patches whose boxes touch it.
pub struct Index {
    cells: Vec<Vec<usize>>,
    /// Cells across and down.
    n: [usize; 2],
    size: [f64; 2],
    /// Of each patch, the least and greatest x and y.
    boxes: Vec<[[f64; 2]; 2]>,
    /// The question by which each patch was last found.
    found: RefCell<(u64, Vec<u64>)>,
}

/// Most cells along a side.
const MAX_CELLS: usize = 256;

impl Index {
    /// Of these patches, in a picture of `size` pixels.
    pub fn new(patches: &[Patch], size: [u32; 2]) -> Self {
        let side = (patches.len() as f64).sqrt().ceil() as usize;
        let n = [side.clamp(1, MAX_CELLS); 2];
        let mut index = Self {
            cells: vec![Vec::new(); n[0] * n[1]],
            n,
            size: size.map(f64::from),
            boxes: patches.iter().map(box_of).collect(),
            found: RefCell::new((0, vec![0; patches.len()])),
        };
        for idx in 0..patches.len() {
            for cell in index.cells_of(index.boxes[idx]) {
                index.cells[cell].push(idx);
            }
        }
        index
    }

    /// The patches whose boxes overlap that of a patch, each once, in order.
    pub fn overlapping(&self, patch: &Patch) -> impl Iterator<Item = usize> {
        self.in_box(box_of(patch))
    }

    /// The patches whose boxes overlap a box, each once, in order.
    pub fn in_box(&self, asked: [[f64; 2]; 2]) -> impl Iterator<Item = usize> + use<> {
        let mut found = self.found.borrow_mut();
        let (question, last) = &mut *found;
        *question += 1;
        let [low, high] = asked;
        let mut all = Vec::new();
        for idx in self.cells_of(asked).flat_map(|cell| &self.cells[cell]).copied() {
            let [its_low, its_high] = self.boxes[idx];
            let overlaps = (0..2).all(|axis| its_low[axis] <= high[axis] && low[axis] <= its_high[axis]);
            if overlaps && last[idx] != *question {
                last[idx] = *question;
                all.push(idx);
            }
        }
        all.sort_unstable();
        all.into_iter()
    }

    fn cells_of(&self, [low, high]: [[f64; 2]; 2]) -> impl Iterator<Item = usize> + use<> {
        let range = |axis: usize| -> RangeInclusive<usize> {
            // The cast saturates, so what is outside lies in the outermost cells.
            let cell = |x: f64| ((x / self.size[axis] * self.n[axis] as f64) as usize).min(self.n[axis] - 1);
            cell(low[axis])..=cell(high[axis])
        };
        let (columns, width) = (range(0), self.n[0]);
        range(1).flat_map(move |row| columns.clone().map(move |column| row * width + column))
    }
}

fn box_of(patch: &Patch) -> [[f64; 2]; 2] {
    let fold = |start: f64, pick: fn(f64, f64) -> f64, corner: fn(&super::convex::Convex) -> [f64; 2]| {
        [0, 1].map(|axis| patch.parts.iter().map(|part| corner(part)[axis]).fold(start, pick))
    };
    [fold(f64::INFINITY, f64::min, |part| part.low), fold(f64::NEG_INFINITY, f64::max, |part| part.high)]
}
