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

/// For each tile, row after row, the faces that it may show, in drawing order.
#[derive(Debug)]
pub struct Bins {
    tiles: Tiles,
    shapes: Vec<Vec<u32>>,
}

impl Bins {
    /// Sorts shapes by their columns and rows, which are not empty.
    pub fn new(tiles: Tiles, rects: impl Iterator<Item = [Range<u32>; 2]>) -> Self {
        let [across, down] = tiles.count();
        let mut shapes = vec![Vec::new(); across as usize * down as usize];
        for (shape, [columns, rows]) in (0u32..).zip(rects) {
            let columns = tiles.of(0, &columns);
            for row in tiles.of(1, &rows) {
                columns
                    .clone()
                    .for_each(|column| shapes[(row * across + column) as usize].push(shape));
            }
        }
        Self { tiles, shapes }
    }

    /// The shapes of a tile, given by its column and row.
    pub fn in_tile(&self, [column, row]: [u32; 2]) -> &[u32] {
        &self.shapes[(row * self.tiles.count()[0] + column) as usize]
    }

    /// The shapes that may cover a sample.
    pub fn around(&self, sample: [u32; 2]) -> &[u32] {
        let Tiles { start, tile, .. } = self.tiles;
        self.in_tile([0, 1].map(|axis| sample[axis].saturating_sub(start[axis]) / tile[axis]))
    }
}
