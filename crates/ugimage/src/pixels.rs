//! The pixels of a picture that was read.

/// The pixels of a picture, row after row from the top.
#[derive(Clone, Debug, PartialEq)]
pub enum Pixels {
    /// Display-encoded sRGB, and alpha.
    Srgb(Vec<[u8; 4]>),
    /// Linear light with the sRGB primaries, not multiplied by alpha; white is 1. Numbers that are
    /// not finite occur as they are in the file.
    Light(Vec<[f32; 4]>),
}

impl Pixels {
    /// Their bytes in memory.
    pub fn n_bytes(&self) -> u64 {
        match self {
            Self::Srgb(pixels) => size_of_val(pixels.as_slice()) as u64,
            Self::Light(pixels) => size_of_val(pixels.as_slice()) as u64,
        }
    }
}
