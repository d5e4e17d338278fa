//! What touches which band.

use std::ops::Range;

use crate::band::Grid;

/// For each band of a grid the shapes that touch it, in drawing order.
#[derive(Clone, Debug, Default)]
pub struct Bins {
    /// Where each band's part of `items` starts, and then where the last ends.
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Bins {
    /// `bands`: those that each shape may touch.
    pub fn new(grid: &Grid, bands: impl Iterator<Item = Range<u32>> + Clone) -> Self {
        // Counted two places further on, the counts of the bands before add up to where a band starts one place further on;
        // and when that place has gone through the band it is where the next one starts.
        let mut starts = vec![0u32; grid.n_bands() + 2];
        for band in bands.clone().flatten() {
            starts[band as usize + 2] += 1;
        }
        for band in 1..starts.len() {
            starts[band] += starts[band - 1];
        }
        let mut items = vec![0; starts[starts.len() - 1] as usize];
        // The text of a scene is below 4 GiB, and so are these numbers.
        for (shape, bands) in (0u32..).zip(bands) {
            for band in bands {
                let next = &mut starts[band as usize + 1];
                items[*next as usize] = shape;
                *next += 1;
            }
        }
        Self { starts, items }
    }

    /// The shapes that touch a band, by their place in what was sorted.
    pub fn in_band(&self, band: usize) -> &[u32] {
        &self.items[self.starts[band] as usize..self.starts[band + 1] as usize]
    }
}
