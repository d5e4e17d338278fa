//! Shapes sorted into the bands they touch.

use std::ops::Range;

use crate::grid::SampleGrid;

/// For each band of a grid the shapes that touch it, in drawing order.
#[derive(Clone, Debug, Default)]
pub struct Bins {
    /// Start of each band's part of `items`, then the end of the last.
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Bins {
    /// Sorts shapes, of which `bands` gives the bands that each may touch.
    pub fn new(grid: &SampleGrid, bands: impl Iterator<Item = Range<u32>> + Clone) -> Self {
        // A counting sort. Counts of band b are stored at b + 2, so the running sum at b + 1 is
        // the start of band b. Filling band b moves that entry on to the start of band b + 1.
        let mut starts = vec![0u32; grid.n_bands() + 2];
        for band in bands.clone().flatten() {
            starts[band as usize + 2] += 1;
        }
        for band in 1..starts.len() {
            starts[band] += starts[band - 1];
        }
        let mut items = vec![0; starts[starts.len() - 1] as usize];
        // The text of a scene is below 4 GiB, so counts of shapes fit 32 bits.
        for (shape, bands) in (0u32..).zip(bands) {
            for band in bands {
                let next = &mut starts[band as usize + 1];
                items[*next as usize] = shape;
                *next += 1;
            }
        }
        Self { starts, items }
    }

    /// Indices of the shapes that touch a band.
    pub fn in_band(&self, band: usize) -> &[u32] {
        &self.items[self.starts[band] as usize..self.starts[band + 1] as usize]
    }
}
