//! Kinds of files.

use ugimage::Format;

/// Kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// Pixels.
    Color(Format),
    /// Vector graphics: a format that [supports them](Format::has_vectors).
    Vector(Format),
}

impl Output {
    /// The format.
    pub fn format(self) -> Format {
        match self {
            Self::Color(format) | Self::Vector(format) => format,
        }
    }
}
