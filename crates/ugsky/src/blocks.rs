//! A cache of texels as linear light, each channel apart. The footprints of neighbouring pixels
//! have most of their texels in common, so each texel is decoded once for many of them.

use std::ops::Range;

use crate::panorama::Panorama;
use crate::pyramid::APRON;

/// Columns of a block.
const COLUMNS: usize = 64;

/// Columns of a block, and those of the next one that a window which begins in it may need.
pub(crate) const WIDTH: usize = COLUMNS + APRON;

/// Rows of blocks that are kept.
const KEPT: usize = 64;

/// Columns of blocks that are kept.
const KEPT_COLUMNS: usize = 4;

/// Rows of texels that are loaded into the processor's cache at once.
const AHEAD: u32 = 8;

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

/// The cache. It is direct-mapped: a block's row and column, modulo the numbers of those that are
/// kept, are its only place.
pub(crate) struct Blocks([Column; KEPT_COLUMNS]);

/// Blocks one below the other.
struct Column {
    texels: Box<[Block; KEPT]>,
    /// The [`key`] of the block in each place.
    keys: [u64; KEPT],
    /// The rows that are all here, of the blocks whose row 0 has this key.
    held: (u64, Range<u32>),
    /// The first row that [`Pyramid::load`](crate::pyramid::Pyramid::load) has not yet read.
    ahead: u32,
    /// All texels that were ever decoded are opaque.
    is_opaque: bool,
}

/// The key of a place that was never used.
const NONE: u64 = u64::MAX;

impl Blocks {
    pub fn new() -> Self {
        Self(std::array::from_fn(|_| Column {
            texels: Box::new([Block([[0.0; WIDTH]; 4]); KEPT]),
            keys: [NONE; KEPT],
            held: (NONE, 0..0),
            ahead: 0,
            is_opaque: true,
        }))
    }

    /// The texels of a window.
    #[inline(always)]
    pub fn at(&mut self, sky: &Panorama, window: &Window) -> Held<'_> {
        let idx = window.column as usize / COLUMNS;
        let column = &mut self.0[idx % KEPT_COLUMNS];
        let (held, rows) = &column.held;
        let is_held = key(window.level, 0, idx) == *held
            && window.row >= rows.start
            && window.row + window.n_rows <= rows.end;
        if !is_held {
            column.fetch(sky, window, idx);
        }
        let at = window.column as usize % COLUMNS;
        Held { blocks: &column.texels, column: at, is_opaque: column.is_opaque }
    }
}

impl Column {
    #[inline(never)]
    fn fetch(&mut self, sky: &Panorama, window: &Window, idx: usize) {
        let level = window.level as usize;
        let rows = window.row..window.row + window.n_rows;
        let key_0 = key(window.level, 0, idx);
        if self.held.0 != key_0 {
            self.held = (key_0, rows.clone());
            self.ahead = rows.start;
        }
        for row in rows.clone() {
            let key = key(window.level, row, idx);
            let place = row as usize % KEPT;
            if self.keys[place] != key {
                self.keys[place] = key;
                if row >= self.ahead || row + AHEAD < self.ahead {
                    self.ahead = row + AHEAD;
                    sky.pyramid.load(
                        level,
                        row as usize..self.ahead as usize,
                        idx * COLUMNS..idx * COLUMNS + WIDTH,
                    );
                }
                self.is_opaque &= fill(&mut self.texels[place], sky, level, row as usize, idx * COLUMNS);
            }
        }
        self.held.1 = joined(&self.held.1, &rows);
    }
}

/// Texels in the cache.
pub(crate) struct Held<'a> {
    /// The block of a row is at the index of the row, modulo their number.
    pub blocks: &'a [Block; KEPT],
    /// The first column of the window in each.
    pub column: usize,
    /// True if all are opaque.
    pub is_opaque: bool,
}

/// Rows that are in the cache after those of a window were fetched. `before`: those that were
/// there.
fn joined(before: &Range<u32>, rows: &Range<u32>) -> Range<u32> {
    let most = KEPT as u32;
    if rows.start > before.end || before.start > rows.end {
        return rows.clone();
    }
    // Rows that do not fit in beside those of the window were overwritten.
    let start = before.start.max(rows.end.saturating_sub(most)).min(rows.start);
    let end = before.end.min(rows.start + most).max(rows.end);
    start..end
}

/// The number of a block among all of a panorama.
#[inline(always)]
fn key(level: u32, row: u32, idx: usize) -> u64 {
    u64::from(level) << 58 | u64::from(row) << 26 | idx as u64
}

/// Decodes the texels of a row from a column on; true if all are opaque. Beyond the end of the row
/// nothing is changed, because no window reaches there.
fn fill(Block(planes): &mut Block, sky: &Panorama, level: usize, row: usize, column: usize) -> bool {
    let end = sky.ladder[sky.grids[level].rows[row].ladder].n.min(column + WIDTH);
    let (mut at, mut is_opaque) = (0, true);
    sky.pyramid.for_each(level, row, column..end, |texels| {
        let end = at + texels.len();
        is_opaque &= texels.copy_to(planes.each_mut().map(|plane| &mut plane[at..end]));
        at = end;
    });
    is_opaque
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Extent;
    use crate::texels::Texels;

    /// After any moves of a window its cached texels are those of the panorama.
    #[test]
    fn windows_have_their_texels() {
        let size = [1600, 800];
        let texel = |idx: u32| {
            let bytes = idx.wrapping_mul(2_654_435_761).to_le_bytes();
            // One half is opaque.
            [bytes[0], bytes[1], bytes[2], if idx % size[0] < size[0] / 2 { 255 } else { bytes[3] }]
        };
        let texels = Texels::Srgb((0..size[0] * size[1]).map(texel).collect());
        let sky = Panorama::new(size, texels, Extent::FULL).unwrap();
        let mut blocks = Blocks::new();
        let (mut level, mut row, mut column) = (0_usize, 300_i64, 700_i64);
        let mut state = 1_u64;
        let mut random = |n: i64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as i64 % n
        };
        let mut n_opaque = 0;
        for _ in 0..20_000 {
            match random(200) {
                0 => (level, row, column) = (random(3) as usize, random(800), random(1600)),
                1 => column += random(200) - 100,
                // Far up and down, so that rows at the same place of the cache replace each other.
                2..100 => row += random(40) - 20,
                _ => (row, column) = (row + random(5) - 2, column + random(9) - 4),
            }
            let grid = &sky.grids[level];
            row = row.clamp(0, grid.rows.len() as i64 - 1);
            let ladder = grid.rows[row as usize].ladder;
            let n = sky.ladder[ladder].n as i64;
            column = column.clamp(0, n - 1);
            let alike =
                grid.rows[row as usize..].iter().take_while(|row| row.ladder == ladder).count() as i64;
            let window = Window {
                level: level as u32,
                ladder: ladder as u32,
                row: row as u32,
                column: column as u32,
                n_rows: (1 + random(16)).min(alike) as u32,
                n_columns: (1 + random(APRON as i64)).min(n - column) as u32,
            };
            let held = blocks.at(&sky, &window);
            n_opaque += u32::from(held.is_opaque);
            for row in window.row..window.row + window.n_rows {
                let Block(planes) = &held.blocks[row as usize % KEPT];
                let texels =
                    sky.pyramid.texels(level, row as usize, column as usize, window.n_columns as usize);
                for idx in 0..window.n_columns as usize {
                    let found = planes.each_ref().map(|plane| plane[held.column + idx]);
                    assert_eq!(found, texels.get(idx), "{window:?}");
                    assert!(!held.is_opaque || found[3] == 1.0);
                }
            }
        }
        assert!(n_opaque > 0);
    }
}
