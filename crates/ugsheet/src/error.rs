//! The errors of making a sheet.

use std::fmt;

use uglabel::MissingCharacter;

/// Largest number of pixels of a sheet.
pub const MAX_PIXELS: u64 = 1 << 28;

/// Why a sheet cannot be made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Error {
    /// There are no pictures.
    Empty,
    /// The number of labels is not the number of pictures.
    Count {
        /// The number of labels.
        labels: usize,
        /// The number of pictures.
        pictures: usize,
    },
    /// The font lacks a character of a title, caption or label.
    Text {
        /// The whole text.
        text: String,
        /// The first character that the font lacks.
        missing: MissingCharacter,
    },
    /// The sheet has more than 2²⁸ pixels, or the pictures are too narrow for text.
    Size,
    /// A picture cannot be read; the message names it.
    Picture(String),
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("there are no pictures; name PNG files"),
            Self::Count { labels, pictures } => {
                let several = |count: usize| if count == 1 { "" } else { "s" };
                let (of_labels, of_pictures) = (several(*labels), several(*pictures));
                write!(
                    f,
                    "{labels} label{of_labels} for {pictures} picture{of_pictures}: give -label once for each \
                     picture, in order, or not at all"
                )
            }
            Self::Text { text, missing } => {
                write!(f, "in `{text}`: {missing}; change the text, or use -label or -lb none")
            }
            Self::Picture(message) => f.write_str(message),
            Self::Size => write!(f, "the sheet has more than {MAX_PIXELS} pixels; draw smaller pictures"),
        }
    }
}

impl std::error::Error for Error {}
