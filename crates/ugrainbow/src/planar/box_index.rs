//! A spatial index of bounding boxes in the picture.

use std::ops::RangeInclusive;

/// A hierarchy of grids over the picture, each twice as coarse as the one before. A box is stored
/// in the finest grid in which it touches at most two cells either way, so large boxes take no more
/// memory than small ones.
pub struct BoxIndex {
    /// The grids from the finest to the one with a single cell; for each cell, its boxes.
    grids: Vec<Vec<Vec<usize>>>,
    /// Cells along a side of the finest grid.
    n: usize,
    size: [f64; 2],
    /// Least and greatest x and y of each box.
    boxes: Vec<[[f64; 2]; 2]>,
}

/// Most cells along a side.
const MAX_CELLS: usize = 256;

impl BoxIndex {
    /// An index of these boxes in a picture of this size.
    pub fn new(boxes: impl Iterator<Item = [[f64; 2]; 2]>, size: [u32; 2]) -> Self {
        let boxes: Vec<_> = boxes.collect();
        let mut index = Self::empty(boxes.len(), size);
        boxes.into_iter().for_each(|one| index.push(one));
        index
    }

    /// Empty, with cells for `n_shapes` boxes.
    pub fn empty(n_shapes: usize, size: [u32; 2]) -> Self {
        let side = (n_shapes as f64).sqrt().ceil() as usize;
        let n = side.clamp(1, MAX_CELLS).next_power_of_two();
        let grids =
            (0..=n.ilog2()).map(|coarser| vec![Vec::new(); (n >> coarser) * (n >> coarser)]);
        Self { grids: grids.collect(), n, size: size.map(f64::from), boxes: Vec::new() }
    }

    /// Adds a box; its number is the count of boxes before it.
    pub fn push(&mut self, its_box: [[f64; 2]; 2]) {
        let shape = self.boxes.len();
        self.boxes.push(its_box);
        let ends = self.ends(its_box);
        let is_small = |coarser: &usize| {
            ends.iter().all(|[low, high]| (high >> coarser) - (low >> coarser) < 2)
        };
        // Everything fits the grid of one cell.
        let coarser = (0..self.grids.len()).find(is_small).unwrap_or(self.grids.len() - 1);
        for cell in self.cells(ends, coarser) {
            self.grids[coarser][cell].push(shape);
        }
    }

    /// Numbers of the boxes that overlap a box, each once, in order.
    pub fn in_box(&self, asked: [[f64; 2]; 2]) -> Vec<usize> {
        let overlaps = |shape: &usize| self.overlaps(*shape, asked);
        let ends = self.ends(asked);
        let mut found = Vec::new();
        for (coarser, grid) in self.grids.iter().enumerate() {
            let shapes = self.cells(ends, coarser).flat_map(|cell| &grid[cell]);
            found.extend(shapes.copied().filter(overlaps));
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    /// True if one of the boxes overlaps another box.
    pub fn has_any_in(&self, asked: [[f64; 2]; 2]) -> bool {
        let ends = self.ends(asked);
        let has_any = |(coarser, grid): (usize, &Vec<Vec<usize>>)| {
            self.cells(ends, coarser)
                .any(|cell| grid[cell].iter().any(|&shape| self.overlaps(shape, asked)))
        };
        self.grids.iter().enumerate().any(has_any)
    }

    /// True if the box of this number overlaps another.
    pub fn overlaps(&self, shape: usize, [low, high]: [[f64; 2]; 2]) -> bool {
        let [its_low, its_high] = self.boxes[shape];
        (0..2).all(|axis| its_low[axis] <= high[axis] && low[axis] <= its_high[axis])
    }

    /// First and last column, and row, of the cells of the finest grid that a box touches.
    fn ends(&self, [low, high]: [[f64; 2]; 2]) -> [[usize; 2]; 2] {
        [0, 1].map(|axis| {
            // The cast saturates, so boxes outside the picture fall into the outermost cells.
            let cell = |x: f64| ((x / self.size[axis] * self.n as f64) as usize).min(self.n - 1);
            [cell(low[axis]), cell(high[axis])]
        })
    }

    /// The range of cells in the grid that is 2^`coarser` times coarser.
    fn cells(&self, ends: [[usize; 2]; 2], coarser: usize) -> impl Iterator<Item = usize> + use<> {
        let width = self.n >> coarser;
        let [columns, rows] =
            ends.map(|[low, high]| -> RangeInclusive<usize> { low >> coarser..=high >> coarser });
        rows.flat_map(move |row| columns.clone().map(move |column| row * width + column))
    }
}

#[cfg(test)]
mod tests {
    use ugtesting::Random;

    use super::*;

    /// Boxes of all sizes, some outside the picture: the index finds those that a linear search
    /// finds.
    #[test]
    fn all_that_overlap_are_found() {
        let mut random = Random(3);
        let mut random_box = |scale: f64| {
            let low = [500.0 * random.unit() - 100.0, 300.0 * random.unit() - 100.0];
            [low, low.map(|low| low + scale * random.unit() * random.unit() * random.unit())]
        };
        let boxes: Vec<_> =
            (0..2000).map(|idx| random_box(if idx % 100 == 0 { 1e12 } else { 300.0 })).collect();
        let index = BoxIndex::new(boxes.iter().copied(), [300, 100]);
        let mut n_found = 0;
        for scale in [0.0, 3.0, 40.0, 400.0, 1e9] {
            for _ in 0..50 {
                let [low, high] = random_box(scale);
                let overlaps = |idx: &usize| {
                    let [its_low, its_high] = boxes[*idx];
                    !(0..2).any(|axis| its_high[axis] < low[axis] || high[axis] < its_low[axis])
                };
                let expected: Vec<usize> = (0..boxes.len()).filter(overlaps).collect();
                assert_eq!(index.in_box([low, high]), expected, "{low:?} {high:?}");
                assert_eq!(index.has_any_in([low, high]), !expected.is_empty());
                n_found += expected.len();
            }
        }
        assert!(n_found > 10_000, "{n_found}");
        let n_kept: usize = index.grids.iter().flatten().map(Vec::len).sum();
        assert!(n_kept <= 4 * boxes.len(), "{n_kept}");
    }
}
