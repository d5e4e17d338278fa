//! Which shapes are where in the picture.

use std::ops::RangeInclusive;

/// A grid of cells over the picture, each with the shapes whose boxes touch it.
pub struct Index {
    cells: Vec<Vec<usize>>,
    /// Cells across and down.
    n: [usize; 2],
    size: [f64; 2],
    /// Of each shape, the least and greatest x and y.
    boxes: Vec<[[f64; 2]; 2]>,
}

/// Most cells along a side.
const MAX_CELLS: usize = 256;

impl Index {
    /// Of shapes of these boxes, in a picture of this size.
    pub fn new(boxes: impl Iterator<Item = [[f64; 2]; 2]>, size: [u32; 2]) -> Self {
        let boxes: Vec<_> = boxes.collect();
        let mut index = Self::empty(boxes.len(), size);
        boxes.into_iter().for_each(|one| index.push(one));
        index
    }

    /// Of nothing as yet; made for so many shapes.
    pub fn empty(n_shapes: usize, size: [u32; 2]) -> Self {
        let side = (n_shapes as f64).sqrt().ceil() as usize;
        let n = [side.clamp(1, MAX_CELLS); 2];
        Self { cells: vec![Vec::new(); n[0] * n[1]], n, size: size.map(f64::from), boxes: Vec::new() }
    }

    /// Adds a shape.
    pub fn push(&mut self, its_box: [[f64; 2]; 2]) {
        for cell in self.cells_of(its_box) {
            self.cells[cell].push(self.boxes.len());
        }
        self.boxes.push(its_box);
    }

    /// The shapes whose boxes overlap a box, each once, in order.
    pub fn in_box(&self, asked: [[f64; 2]; 2]) -> Vec<usize> {
        let [low, high] = asked;
        let overlaps = |idx: &usize| {
            let [its_low, its_high] = self.boxes[*idx];
            (0..2).all(|axis| its_low[axis] <= high[axis] && low[axis] <= its_high[axis])
        };
        let cells = self.cells_of(asked).flat_map(|cell| &self.cells[cell]).copied();
        let mut found: Vec<usize> = cells.filter(overlaps).collect();
        found.sort_unstable();
        found.dedup();
        found
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
