//! Kinds of files.

use ugimage::Format;

/// Kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// Pixels in a colour format.
    Color(Format),
    /// Vector graphics: a format that [supports them](Format::has_vectors).
    Vector(Format),
    /// Black-and-white PostScript, as in 1988.
    Grey,
}

impl Output {
    /// The colour format; `None` for black-and-white PostScript.
    pub fn format(self) -> Option<Format> {
        match self {
            Self::Color(format) | Self::Vector(format) => Some(format),
            Self::Grey => None,
        }
    }

    /// True if the file holds linear light.
    pub fn is_linear(self) -> bool {
        self.format().is_some_and(Format::is_linear)
    }
}
