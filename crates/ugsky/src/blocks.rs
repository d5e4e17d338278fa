//! A cache of texels as linear light, each channel apart. The footprints of neighbouring pixels
//! have most of their texels in common, so each texel is decoded once for many of them.

use std::ops::Range;

use crate::grid::{APRON, Row};
use crate::panorama::{Panorama, RowTexels};

/// Columns of a block.
const COLUMNS: usize = 64;

/// Columns of a block, and those of the next one that a window which begins in it may need.
pub(crate) const WIDTH: usize = COLUMNS + APRON;

/// Rows and columns of blocks that are kept.
const KEPT: [usize; 2] = [64, 4];

/// Consecutive texels of a row: red, green and blue times alpha, and alpha.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub(crate) struct Block(pub [[f32; WIDTH]; 4]);

/// The texels that an ellipse may cover.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Window {
    pub level: u32,
    /// Index in the ladder of columns.
    pub ladder: u32,
    /// The first row and the first column.
    pub row: u32,
    pub column: u32,
    pub n_rows: u32,
    pub n_columns: u32,
}

/// The cache. It is direct-mapped: row and column of a block, modulo [`KEPT`], are its only place.
pub(crate) struct Blocks {
    texels: Vec<[Block; KEPT[0]]>,
    /// The [`key`] of the block in each place.
    keys: [[u64; KEPT[0]]; KEPT[1]],
    /// The rows of the last window, which are all in the cache, and the [`key`] of its block in
    /// row 0.
    last: (u64, Range<u32>),
}

/// The key of a place that was never used.
const NONE: u64 = u64::MAX;

impl Blocks {
    pub fn new() -> Self {
        Self {
            texels: vec![[Block([[0.0; WIDTH]; 4]); KEPT[0]]; KEPT[1]],
            keys: [[NONE; KEPT[0]]; KEPT[1]],
            last: (NONE, 0..0),
        }
    }

    /// The blocks of the rows of a window, and the index of its first column in each. The block of a
    /// row is at the index of the row, modulo their number.
    #[inline(always)]
    pub fn at(&mut self, sky: &Panorama, window: &Window) -> (&[Block; KEPT[0]], usize) {
        let idx = window.column as usize / COLUMNS;
        let key = key(window.level, 0, idx);
        let end = window.row + window.n_rows;
        let (last, rows) = &self.last;
        if !(key == *last && window.row >= rows.start && end <= rows.end) {
            self.fetch(sky, window, idx);
            self.last = (key, window.row..end);
        }
        (&self.texels[idx % KEPT[1]], window.column as usize % COLUMNS)
    }

    #[inline(never)]
    fn fetch(&mut self, sky: &Panorama, window: &Window, idx: usize) {
        let (keys, blocks) = (&mut self.keys[idx % KEPT[1]], &mut self.texels[idx % KEPT[1]]);
        for row in window.row..window.row + window.n_rows {
            let key = key(window.level, row, idx);
            let place = row as usize % KEPT[0];
            if keys[place] != key {
                keys[place] = key;
                let level = window.level as usize;
                fill(&mut blocks[place], sky, level, &sky.grids[level].rows[row as usize], idx * COLUMNS);
            }
        }
    }
}

/// The number of a block among all of a panorama.
#[inline(always)]
fn key(level: u32, row: u32, idx: usize) -> u64 {
    u64::from(level) << 58 | u64::from(row) << 26 | idx as u64
}

/// Decodes the texels of a row from a column on. Beyond the end of the row nothing is changed,
/// because no window reaches there.
fn fill(Block(planes): &mut Block, sky: &Panorama, level: usize, row: &Row, column: usize) {
    let end = sky.ladder[row.ladder].n.min(column + WIDTH);
    let mut at = 0;
    sky.for_each(level, row, column..end, |texels| {
        match texels {
            RowTexels::Srgb(texels, decoder) => decoder.decode(texels, planes, at),
            RowTexels::Light(texels) => {
                for (idx, texel) in texels.iter().enumerate().take(WIDTH - at) {
                    (0..4).for_each(|channel| planes[channel][at + idx] = texel[channel]);
                }
            }
        }
        at += texels.len();
    });
}
