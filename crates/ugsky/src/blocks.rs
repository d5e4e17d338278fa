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
                self.is_opaque &=
                    fill(&mut self.texels[place], sky, level, row as usize, idx * COLUMNS);
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
fn fill(
    Block(planes): &mut Block,
    sky: &Panorama,
    level: usize,
    row: usize,
    column: usize,
) -> bool {
    let end = sky.ladder[sky.grids[level].rows[row].ladder].n.min(column + WIDTH);
    let (mut at, mut is_opaque) = (0, true);
    sky.pyramid.for_each(level, row, column..end, |texels| {
        let end = at + texels.len();
        is_opaque &= texels.copy_to(planes.each_mut().map(|plane| &mut plane[at..end]));
        at = end;
    });
    is_opaque
}
