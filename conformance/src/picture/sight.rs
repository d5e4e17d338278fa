//! What is asked of a picture: which pixels are lit, and in which colour.

use super::Sight;

/// The colour that prevails in a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hue {
    Dark,
    Red,
    Green,
    Blue,
}

impl Sight {
    pub fn size(&self) -> [u32; 2] {
        [self.pixels.width(), self.pixels.height()]
    }

    pub fn color(&self, x: u32, y: u32) -> [u8; 3] {
        self.pixels.get_pixel(x, y).0
    }

    /// True where the body is, at least in half of the pixel.
    pub fn is_lit(&self, x: u32, y: u32) -> bool {
        u32::from(*self.color(x, y).iter().max().unwrap_or(&0)) * 2 > u32::from(self.brightest)
    }

    pub fn hue(&self, x: u32, y: u32) -> Hue {
        let [red, green, blue] = self.color(x, y);
        match red.max(green).max(blue) {
            most if most < 64 => Hue::Dark,
            most if most == red => Hue::Red,
            most if most == green => Hue::Green,
            _ => Hue::Blue,
        }
    }

    /// Edges of the lit part of a row, in pixels from the left: its first and its last.
    pub fn ends_of_row(&self, y: u32) -> Option<[f64; 2]> {
        ends((0..self.size()[0]).filter(|&x| self.is_lit(x, y)))
    }

    /// The same of a column, from the top.
    pub fn ends_of_column(&self, x: u32) -> Option<[f64; 2]> {
        ends((0..self.size()[1]).filter(|&y| self.is_lit(x, y)))
    }
}

fn ends(mut lit: impl DoubleEndedIterator<Item = u32>) -> Option<[f64; 2]> {
    let first = lit.next()?;
    let last = lit.next_back().unwrap_or(first);
    Some([f64::from(first), f64::from(last + 1)])
}
