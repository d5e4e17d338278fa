//! The faces of each tile of the picture.

use std::ops::Range;

/// The parts in which a picture is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Tiles {
    /// Samples of the picture across and down.
    pub size: [u32; 2],
    /// The first sample of the first tile.
    pub start: [u32; 2],
    /// Samples of a tile across and down.
    pub tile: [u32; 2],
    /// How many samples around a tile are drawn with it.
    pub margin: u32,
}

impl Tiles {
    /// Tiles across and down.
    fn count(&self) -> [u32; 2] {
        [0, 1].map(|axis| (self.size[axis] - self.start[axis]).div_ceil(self.tile[axis]).max(1))
    }

    /// The tiles, along an axis, with which some samples are drawn.
    fn of(&self, axis: usize, samples: &Range<u32>) -> Range<u32> {
        let place = |sample: u32| sample.saturating_sub(self.start[axis]) / self.tile[axis];
        let end = place(samples.end - 1 + self.margin) + 1;
        place(samples.start.saturating_sub(self.margin))..end.min(self.count()[axis])
    }
}

/// For each tile the faces that it may show, in drawing order.
#[derive(Debug)]
pub struct Bins {
    tiles: Tiles,
    /// Start of each tile's part of `shapes`, then the end of the last.
    starts: Vec<u32>,
    shapes: Vec<u32>,
}

impl Bins {
    /// Sorts shapes by their columns and rows, which are not empty.
    pub fn new(tiles: Tiles, rects: impl Iterator<Item = [Range<u32>; 2]> + Clone) -> Self {
        let [across, down] = tiles.count();
        let covered = |[columns, rows]: [Range<u32>; 2]| {
            let [columns, rows] = [tiles.of(0, &columns), tiles.of(1, &rows)];
            rows.flat_map(move |row| columns.clone().map(move |column| row * across + column))
        };
        // A counting sort. Counts of tile t are stored at t + 2, so the running sum at t + 1 is the
        // start of tile t. Filling tile t moves that entry on to the start of tile t + 1.
        let mut starts = vec![0u32; (across * down) as usize + 2];
        rects.clone().flat_map(covered).for_each(|tile| starts[tile as usize + 2] += 1);
        for tile in 1..starts.len() {
            starts[tile] += starts[tile - 1];
        }
        let mut shapes = vec![0; starts[starts.len() - 1] as usize];
        for (shape, rect) in (0u32..).zip(rects) {
            for tile in covered(rect) {
                let next = &mut starts[tile as usize + 1];
                shapes[*next as usize] = shape;
                *next += 1;
            }
        }
        Self { tiles, starts, shapes }
    }

    /// The shapes of a tile, given by its column and row.
    pub fn in_tile(&self, [column, row]: [u32; 2]) -> &[u32] {
        let tile = (row * self.tiles.count()[0] + column) as usize;
        &self.shapes[self.starts[tile] as usize..self.starts[tile + 1] as usize]
    }

    /// The shapes that may cover a sample.
    pub fn around(&self, sample: [u32; 2]) -> &[u32] {
        let Tiles { start, tile, .. } = self.tiles;
        self.in_tile([0, 1].map(|axis| sample[axis].saturating_sub(start[axis]) / tile[axis]))
    }
}
