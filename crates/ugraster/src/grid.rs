//! The sample grid of a picture, cut into bands and tiles.

use std::ops::Range;

use crate::depth_fade::DepthFade;

/// Samples in a tile, about: with some 16 bytes each they stay in a core's cache.
const TILE_SAMPLES: u32 = 1 << 15;

/// Limit of the samples in one row of pixels of a tile: for wide tiles, and for tall ones. The
/// second was the fastest with 10⁵ and 10⁶ triangles. It makes tall tiles eight pixels high, or
/// less if a pixel has very many samples.
const MAX_ROW_SAMPLES: [u32; 2] = [1 << 19, 1 << 12];

/// Most bands of a picture. More would cost memory for the bins and gain nothing.
const MAX_BANDS: u32 = 1 << 10;

/// The sample grid of a picture.
#[derive(Clone, Copy, Debug)]
pub struct SampleGrid {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Number of samples along each side of a pixel.
    pub samples: u32,
    /// True if depth keys are 1/distance and interpolated values are multiplied by them.
    pub is_perspective: bool,
    /// Depth cueing.
    pub fade: Option<DepthFade>,
    /// The shape of tiles, which does not change the picture.
    pub tiles: TileShape,
}

/// The shape of tiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TileShape {
    /// As wide as most pictures, and low: for surfaces whose outlines are intersected with every
    /// row of a tile.
    Wide,
    /// Several pixels high, and narrow: for small triangles, whose setup is done again for every
    /// tile that they touch.
    Tall,
}

impl SampleGrid {
    /// Samples across.
    pub fn sample_columns(&self) -> u32 {
        self.width * self.samples
    }

    /// Samples down.
    pub fn sample_rows(&self) -> u32 {
        self.height * self.samples
    }

    /// The depth along the view, in scene units, of a depth key.
    pub fn depth(&self, key: f64) -> f64 {
        if self.is_perspective { 1.0 / key } else { -key }
    }

    /// The part of the light that depth cueing leaves at a depth key, 0…1.
    #[inline]
    pub fn light_left(&self, key: f32) -> f32 {
        self.fade.map_or(1.0, |fade| fade.light_left(self.depth(f64::from(key))) as f32)
    }

    /// Column and row of the sample nearest to the centre of a pixel. Ties go to the lower-right
    /// sample.
    #[inline]
    pub fn center(&self, pixel: [u32; 2]) -> [u32; 2] {
        pixel.map(|place| place * self.samples + self.samples / 2)
    }

    /// Pixel columns of a tile.
    pub(crate) fn tile_columns(&self) -> u32 {
        let [wide, tall] = MAX_ROW_SAMPLES;
        let row_samples = if self.tiles == TileShape::Wide { wide } else { tall };
        (row_samples / (self.samples * self.samples)).clamp(1, self.width)
    }

    /// The columns of tiles from that of the first of some columns of samples to that of the last.
    /// Columns beyond 2¹⁶ count as one.
    pub(crate) fn tile_columns_of(&self, [first, end]: [u32; 2]) -> [u16; 2] {
        let samples = self.tile_columns() * self.samples;
        [first, end.saturating_sub(1).max(first)]
            .map(|column| (column / samples).try_into().unwrap_or(u16::MAX))
    }

    /// Pixel rows of a tile.
    pub(crate) fn tile_rows(&self) -> u32 {
        let row_samples = self.samples * self.samples * self.tile_columns();
        (TILE_SAMPLES / row_samples).clamp(1, self.height)
    }

    /// One past the last row of the tile that contains a row of pixels.
    pub(crate) fn tile_end(&self, row: u32) -> u32 {
        (row / self.tile_rows() + 1) * self.tile_rows()
    }

    /// Pixel rows of a band, a whole number of tiles.
    pub(crate) fn band_rows(&self) -> u32 {
        self.height.div_ceil(MAX_BANDS).next_multiple_of(self.tile_rows())
    }

    /// Number of bands.
    pub fn n_bands(&self) -> usize {
        self.height.div_ceil(self.band_rows()) as usize
    }

    /// The bands of the picture.
    pub fn bands(&self) -> Bands {
        Bands { sample_rows: self.band_rows() * self.samples }
    }
}

/// The bands of a picture: as many rows of samples each, counted from the top.
#[derive(Clone, Copy, Debug)]
pub struct Bands {
    sample_rows: u32,
}

impl Bands {
    /// Rows of samples in each.
    pub fn sample_rows(&self) -> u32 {
        self.sample_rows
    }

    /// The bands that contain these rows of samples. `rows` is not empty.
    #[inline]
    pub fn of(&self, rows: &Range<u32>) -> Range<u32> {
        rows.start / self.sample_rows..(rows.end - 1) / self.sample_rows + 1
    }
}
