//! The errors of making a sheet.

use thiserror::Error;
use ugimage::label::MissingCharacter;

/// Largest number of pixels of a sheet.
pub const MAX_PIXELS: u64 = 1 << 28;

/// Why a sheet cannot be made.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// There are no pictures.
    #[error("there are no pictures; name PNG files")]
    Empty,
    /// The number of labels is not the number of pictures.
    #[error(
        "{labels} label{} for {pictures} picture{}",
        plural(*labels), plural(*pictures)
    )]
    Count {
        /// The number of labels.
        labels: usize,
        /// The number of pictures.
        pictures: usize,
    },
    /// The font lacks a character of a title, caption or label.
    #[error("in `{text}`: {missing}")]
    Text {
        /// The whole text.
        text: String,
        /// The first character that the font lacks.
        missing: MissingCharacter,
    },
    /// The sheet has more than 2²⁸ pixels, or the pictures are too narrow for text.
    #[error("the sheet has more than {MAX_PIXELS} pixels; draw smaller pictures")]
    Size,
    /// A sheet of the size asked for has no room for its pictures.
    #[error("the sheet has no room for the pictures beside gaps, margins and text")]
    Narrow,
    /// The system has not enough memory for the sheet.
    #[error("there is not enough memory for {} x {} pixels, {bytes} bytes", size[0], size[1])]
    Memory {
        /// Pixels across and down.
        size: [u32; 2],
        /// Bytes that it needs, with the file.
        bytes: u64,
    },
    /// A tile whose history has no part of a picture.
    #[error("`{name}`: its history does not state which part of a picture it is")]
    NoPart {
        /// The name of the tile.
        name: String,
    },
    /// A tile whose history has no size of the whole picture.
    #[error("`{name}`: its history does not state the size of the whole picture")]
    NoWholeSize {
        /// The name of the tile.
        name: String,
    },
    /// A picture cannot be read or joined to others; the message names it.
    #[error("{0}")]
    Picture(String),
}

fn plural(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}
