//! The samples of a tile, and the depth test.

use std::ops::Range;
use std::sync::Arc;

/// Samples that are drawn together; a tile has as many elements more than samples.
pub const LANES: usize = 8;

/// The depth key of samples where nothing has been drawn: farther than everything.
pub(crate) const EMPTY: f32 = f32::NEG_INFINITY;

/// A rectangle of samples with the nearest opaque surface at each.
#[derive(Debug)]
pub struct Tile<const N: usize> {
    area: Area,
    /// Depth keys, row after row; [`EMPTY`] where nothing has been drawn.
    keys: Vec<f32>,
    /// For each value the numbers of all samples, so that many are shaded at once.
    values: [Vec<f32>; N],
    /// The item visible at each sample; no elements if items are not kept.
    items: Vec<u32>,
    /// The plane of each item, see [`OpaqueLayer::planes`](crate::OpaqueLayer::planes).
    planes: Arc<[u32]>,
}

/// A rectangle of samples of the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Area {
    /// First column, and one past the last.
    pub columns: [u32; 2],
    /// First row, and one past the last.
    pub rows: [u32; 2],
}

impl Area {
    /// Number of samples in a row.
    pub fn width(&self) -> u32 {
        self.columns[1] - self.columns[0]
    }

    /// Number of samples.
    pub fn n_samples(&self) -> usize {
        self.width() as usize * (self.rows[1] - self.rows[0]) as usize
    }

    /// Index of a sample, counted row after row.
    #[inline(always)]
    pub fn index(&self, row: u32, column: u32) -> usize {
        (row - self.rows[0]) as usize * self.width() as usize + (column - self.columns[0]) as usize
    }

    /// Indices of samples of one row.
    #[inline(always)]
    pub fn indices(&self, row: u32, columns: &Range<u32>) -> Range<usize> {
        let first = self.index(row, columns.start);
        first..first + columns.len()
    }
}

/// The item visible at a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VisibleItem {
    /// Its depth key.
    pub key: f32,
    /// The item it belongs to.
    pub item: u32,
}

/// The plane that an item shares with others.
#[inline(always)]
pub(crate) fn shared_plane(planes: &[u32], item: u32) -> Option<u32> {
    planes.get(item as usize).copied().filter(|&plane| plane != 0)
}

/// What opaque surfaces hide of surfaces that are drawn later: the samples of a whole tile.
#[derive(Clone, Copy, Debug)]
pub struct OpaqueSamples<'a> {
    pub area: Area,
    /// Depth keys.
    pub keys: &'a [f32],
    /// Items; no elements if they are not kept.
    pub items: &'a [u32],
    /// The plane of each item; no elements if no planes are shared.
    pub planes: &'a [u32],
}

impl OpaqueSamples<'_> {
    /// The item visible at a sample if it is in the plane of `item`.
    #[inline(always)]
    pub fn item_in_plane(&self, sample: usize, item: u32) -> Option<u32> {
        let plane = shared_plane(self.planes, item)?;
        let own = self.items[sample];
        (self.keys[sample] != EMPTY && self.planes[own as usize] == plane).then_some(own)
    }
}

/// The samples of a tile with any number of values, for the loops that are compiled once.
pub struct TileSamples<'a> {
    area: Area,
    pub keys: &'a mut [f32],
    pub values: &'a mut [Vec<f32>],
    /// No elements if items are not kept.
    pub items: &'a mut [u32],
    /// The plane of each item; no elements if no planes are shared.
    pub planes: &'a [u32],
}

impl TileSamples<'_> {
    /// Index of a sample.
    #[inline(always)]
    pub fn sample(&self, row: u32, column: u32) -> usize {
        self.area.index(row, column)
    }
}

impl<const N: usize> Default for Tile<N> {
    fn default() -> Self {
        let values = [const { Vec::new() }; N];
        Self {
            area: Area::default(),
            keys: Vec::new(),
            values,
            items: Vec::new(),
            planes: Arc::default(),
        }
    }
}

impl<const N: usize> Tile<N> {
    /// Makes it an empty tile, reusing its buffers.
    pub(crate) fn reset(&mut self, area: Area, planes: Arc<[u32]>, keeps_items: bool) {
        let keeps_items = keeps_items || !planes.is_empty();
        (self.area, self.planes) = (area, planes);
        // With some elements behind the last row, because rows are drawn LANES samples at once.
        let len = area.n_samples() + LANES;
        self.keys.clear();
        self.keys.resize(len, EMPTY);
        // Values and items are read only where a key has been written, so old ones may stay.
        self.values.iter_mut().for_each(|all| all.resize(len, 0.0));
        self.items.resize(if keeps_items { len } else { 0 }, 0);
    }

    /// The samples as occluders.
    pub(crate) fn opaque(&self) -> OpaqueSamples<'_> {
        let Self { area, keys, items, planes, .. } = self;
        OpaqueSamples { area: *area, keys, items, planes }
    }

    pub(crate) fn samples(&mut self) -> TileSamples<'_> {
        let Self { area, keys, values, items, planes } = self;
        TileSamples { area: *area, keys, values, items, planes }
    }

    /// The samples of the tile.
    pub(crate) fn area(&self) -> Area {
        self.area
    }

    /// The samples of part of a row, to be drawn on.
    #[inline]
    pub(crate) fn part(&mut self, row: u32, columns: &Range<u32>) -> RowPart<'_, N> {
        let samples = self.area.indices(row, columns);
        let items = if self.items.is_empty() { &mut [] } else { &mut self.items[samples.clone()] };
        RowPart {
            keys: &mut self.keys[samples.clone()],
            values: self.values.each_mut().map(|all| &mut all[samples.clone()]),
            items,
            planes: &self.planes,
        }
    }

    /// Part of a row: depth keys, [`EMPTY`] where nothing was drawn, and values, meaningless there.
    #[inline]
    pub(crate) fn row_part(&self, row: u32, first: u32, end: u32) -> (&[f32], [&[f32]; N]) {
        let samples = self.area.indices(row, &(first..end));
        (&self.keys[samples.clone()], self.values.each_ref().map(|all| &all[samples.clone()]))
    }

    /// The item visible at a sample. Always `None` if items are not kept.
    #[inline]
    pub(crate) fn hit(&self, row: u32, column: u32) -> Option<VisibleItem> {
        let sample = self.area.index(row, column);
        let &item = self.items.get(sample)?;
        let key = self.keys[sample];
        (key != EMPTY).then_some(VisibleItem { key, item })
    }
}

/// Part of a row of a [`Tile`].
pub(crate) struct RowPart<'a, const N: usize> {
    pub(crate) keys: &'a mut [f32],
    values: [&'a mut [f32]; N],
    items: &'a mut [u32],
    planes: &'a [u32],
}

impl<const N: usize> RowPart<'_, N> {
    /// True if something in the plane of an item is visible at a sample.
    #[inline(always)]
    pub(crate) fn is_in_plane_of(&self, sample: usize, item: u32) -> bool {
        let is_drawn = self.keys[sample] != EMPTY;
        shared_plane(self.planes, item)
            .is_some_and(|plane| is_drawn && self.planes[self.items[sample] as usize] == plane)
    }

    /// Sets what is visible at a sample.
    #[inline(always)]
    pub(crate) fn set(&mut self, sample: usize, key: f32, values: [f32; N], item: u32) {
        self.keys[sample] = key;
        if let Some(kept) = self.items.get_mut(sample) {
            *kept = item;
        }
        for (all, value) in self.values.iter_mut().zip(values) {
            all[sample] = value;
        }
    }
}
