//! The frame: an image of display-encoded pixels.

/// An image in memory, rows from top to bottom, four bytes per pixel: red, green, blue encoded with
/// the sRGB transfer function, and alpha.
///
/// Colours are not premultiplied by alpha. In an opaque frame every alpha is 255.
///
/// # Guarantees
/// There are exactly width × height pixels, and neither side is 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    width: u32,
    height: u32,
    is_opaque: bool,
    pixels: Vec<[u8; 4]>,
}

impl Frame {
    /// A black frame without transparency.
    ///
    /// # Panics
    /// If a side is 0.
    pub fn opaque(width: u32, height: u32) -> Self {
        Self::filled(width, height, true, [0, 0, 0, 255])
    }

    /// A fully transparent frame.
    ///
    /// # Panics
    /// If a side is 0.
    pub fn clear(width: u32, height: u32) -> Self {
        Self::filled(width, height, false, [0; 4])
    }

    fn filled(width: u32, height: u32, is_opaque: bool, pixel: [u8; 4]) -> Self {
        Self::new([width, height], is_opaque, vec![pixel; width as usize * height as usize])
    }

    /// A frame of the given pixels. If it is opaque, every alpha must be 255.
    ///
    /// # Panics
    /// If a side is 0, or the number of pixels is not width × height.
    pub fn new([width, height]: [u32; 2], is_opaque: bool, pixels: Vec<[u8; 4]>) -> Self {
        assert!(width > 0 && height > 0, "a frame has at least one pixel");
        assert_eq!(pixels.len(), width as usize * height as usize, "a frame has all its pixels");
        Self { width, height, is_opaque, pixels }
    }

    /// The pixels alone.
    pub fn into_pixels(self) -> Vec<[u8; 4]> {
        self.pixels
    }

    /// Number of pixels per row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Number of rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// True if the frame has no transparency, so that writers can omit alpha.
    pub fn is_opaque(&self) -> bool {
        self.is_opaque
    }

    /// All pixels, row after row from the top.
    pub fn pixels(&self) -> &[[u8; 4]] {
        &self.pixels
    }

    /// All pixels, mutable. In an opaque frame alpha must stay 255.
    pub fn pixels_mut(&mut self) -> &mut [[u8; 4]] {
        &mut self.pixels
    }

    /// The pixel in column `x` of row `y`, counted from the top left.
    ///
    /// # Panics
    /// If the pixel lies outside the frame.
    pub fn pixel(&self, x: u32, y: u32) -> [u8; 4] {
        assert!(x < self.width && y < self.height, "the pixel lies in the frame");
        self.pixels[y as usize * self.width as usize + x as usize]
    }
}
