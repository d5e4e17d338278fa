//! Limits of a picture.

/// Most pixels of a picture: 1 GiB in memory as 8-bit pixels, 4 GiB as light.
pub const MAX_PIXELS: u64 = 1 << 28;

/// Most pixels along a side.
pub const MAX_SIDE: u32 = 1 << 24;

/// Most samples along a side of a pixel.
pub const MAX_SAMPLES: u32 = 16;

/// Most pixels along a side of a vector figure, whose coordinates are counted in fine steps.
pub(crate) const MAX_VECTOR_SIDE: u32 = 1 << 15;
