//! Why there is no sheet.

use std::fmt;

use uglabel::MissingCharacter;

/// Most pixels of a sheet.
pub const MAX_PIXELS: u64 = 1 << 28;

/// Why there is no sheet.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Error {
    /// There is no picture.
    Empty,
    /// Not as many labels as pictures.
    Count {
        /// Of labels.
        labels: usize,
        /// Of pictures.
        pictures: usize,
    },
    /// The font lacks a character of a title, caption or label.
    Text {
        /// The whole text.
        text: String,
        /// What it lacks.
        missing: MissingCharacter,
    },
    /// The sheet has more than 2²⁸ pixels, or the pictures are too narrow for text.
    Size,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("there are no pictures; name PNG files"),
            Self::Count { labels, pictures } => write!(
                f,
                "there are {labels} labels for {pictures} pictures; give -label once for each picture, in their order, or not \
                 at all"
            ),
            Self::Text { text, missing } => {
                write!(f, "in `{text}`: {missing}; say it otherwise with -label, or -lb none")
            }
            Self::Size => write!(f, "the sheet has more than {MAX_PIXELS} pixels; draw smaller pictures"),
        }
    }
}

impl std::error::Error for Error {}
