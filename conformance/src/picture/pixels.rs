//! Classifies pixels: lit or dark, and by their dominant channel.

use super::Picture;

/// The dominant channel of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dominant {
    Dark,
    Red,
    Green,
    Blue,
}

impl Picture {
    pub fn size(&self) -> [u32; 2] {
        [self.pixels.width(), self.pixels.height()]
    }

    pub fn color(&self, x: u32, y: u32) -> [u8; 3] {
        self.pixels.get_pixel(x, y).0
    }

    /// Is at least half of the pixel covered by the body?
    pub fn is_lit(&self, x: u32, y: u32) -> bool {
        u32::from(*self.color(x, y).iter().max().unwrap_or(&0)) * 2 > u32::from(self.brightest)
    }

    pub fn dominant(&self, x: u32, y: u32) -> Dominant {
        let [red, green, blue] = self.color(x, y);
        match red.max(green).max(blue) {
            most if most < 64 => Dominant::Dark,
            most if most == red => Dominant::Red,
            most if most == green => Dominant::Green,
            _ => Dominant::Blue,
        }
    }

    /// The first and last edge of the lit part of a row, in pixels from the left.
    pub fn ends_of_row(&self, y: u32) -> Option<[f64; 2]> {
        ends((0..self.size()[0]).filter(|&x| self.is_lit(x, y)))
    }

    /// The first and last edge of the lit part of a column, in pixels from the top.
    pub fn ends_of_column(&self, x: u32) -> Option<[f64; 2]> {
        ends((0..self.size()[1]).filter(|&y| self.is_lit(x, y)))
    }
}

fn ends(mut lit: impl DoubleEndedIterator<Item = u32>) -> Option<[f64; 2]> {
    let first = lit.next()?;
    let last = lit.next_back().unwrap_or(first);
    Some([f64::from(first), f64::from(last + 1)])
}
