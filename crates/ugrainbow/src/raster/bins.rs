//! What touches which band.

use std::ops::Range;

use super::band::Grid;

/// For each band of a grid the shapes that touch it, in drawing order.
#[derive(Clone, Debug, Default)]
pub struct Bins {
    /// Where each band's part of `items` starts; one more than there are bands.
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Bins {
    /// `rows`: of samples that each shape may touch; none of these ranges is empty.
    pub fn new<'a>(grid: &Grid, rows: impl Iterator<Item = &'a Range<u32>> + Clone) -> Self {
        let bands = grid.bands();
        let mut starts = vec![0u32; grid.n_bands() + 1];
        for band in rows.clone().flat_map(|rows| bands.of(rows)) {
            starts[band + 1] += 1;
        }
        for band in 1..starts.len() {
            starts[band] += starts[band - 1];
        }
        let mut items = vec![0; starts[starts.len() - 1] as usize];
        let mut next = starts.clone();
        // The text of a scene is below 4 GiB, and so are these numbers.
        for (shape, rows) in (0u32..).zip(rows) {
            for band in bands.of(rows) {
                items[next[band] as usize] = shape;
                next[band] += 1;
            }
        }
        Self { starts, items }
    }

    /// The shapes that touch a band, by their place in what was sorted.
    pub fn in_band(&self, band: usize) -> &[u32] {
        &self.items[self.starts[band] as usize..self.starts[band + 1] as usize]
    }
}
