//! Why a figure cannot be placed on a sheet.

use std::fmt;

/// Why a figure cannot be placed on a sheet.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PartError {
    /// An SVG file that is not UTF-8 text.
    NotText,
    /// An SVG file that is not well-formed XML, with the message of the reader.
    Xml(String),
    /// An SVG file with entities of its own.
    Entities,
    /// An SVG file whose root is another element.
    NoSvg,
    /// A figure without a size, or with an invalid one.
    NoSize,
    /// A PDF file with a password or restrictions.
    Encrypted,
    /// A PDF file whose objects are in compressed streams.
    Compressed,
    /// A PDF file with another number of pages than one.
    Pages(usize),
    /// A PDF file whose page is rotated, or has several streams of content.
    UnusualPage,
    /// A PDF file with invalid syntax: what is invalid.
    Pdf(&'static str),
}

impl fmt::Display for PartError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotText => f.write_str("the file is not UTF-8 text"),
            Self::Xml(message) => write!(f, "invalid XML: {message}"),
            Self::Entities => f.write_str("its DOCTYPE declares entities, which are not read"),
            Self::NoSvg => f.write_str("its root is no `svg` element"),
            Self::NoSize => f.write_str("it has no valid size"),
            Self::Encrypted => f.write_str("the PDF file is encrypted"),
            Self::Compressed => f.write_str(
                "the objects of the PDF file are compressed (PDF 1.5), and only plain ones are read",
            ),
            Self::Pages(count) => write!(f, "the PDF file has {count} pages, and a figure is one page"),
            Self::UnusualPage => {
                f.write_str("the page of the PDF file is rotated, or its content is in several parts")
            }
            Self::Pdf(what) => write!(f, "invalid PDF: {what}"),
        }
    }
}

impl std::error::Error for PartError {}
