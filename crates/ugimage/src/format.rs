//! The formats, their names, and what is written beside the pixels.

use crate::{Frame, eps, png, ps};

/// What a file says about where it comes from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Label {
    /// Name and version of the program.
    pub software: String,
    /// How the picture was made: the command lines of the pipe, one a line.
    pub comment: String,
}

/// A colour format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Portable Network Graphics.
    Png,
    /// Encapsulated PostScript, to be put into a document.
    Eps,
    /// PostScript, one page the size of the picture.
    Ps,
}

impl Format {
    /// All of them, the default first.
    pub const ALL: [Self; 3] = [Self::Png, Self::Eps, Self::Ps];

    /// Its name, which is also the usual ending of its files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Eps => "eps",
            Self::Ps => "ps",
        }
    }

    /// The format called `name`, in small or capital letters.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| name.eq_ignore_ascii_case(format.name()))
    }

    /// All names with commas between, for messages.
    pub fn list() -> String {
        Self::ALL.map(Self::name).join(", ")
    }

    /// True if the file is not text, and would garble a terminal.
    pub fn is_binary(self) -> bool {
        self == Self::Png
    }

    /// The frame as a file of this format.
    pub fn encode(self, frame: &Frame, label: &Label) -> Vec<u8> {
        match self {
            Self::Png => png::encode(frame, label),
            Self::Eps => eps::encode(frame, label),
            Self::Ps => ps::encode(frame, label),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_found_again() {
        for format in Format::ALL {
            assert_eq!(Format::from_name(format.name()), Some(format));
            assert_eq!(Format::from_name(&format.name().to_uppercase()), Some(format));
        }
        assert_eq!(Format::from_name("jpg"), None);
        assert_eq!(Format::from_name(""), None);
        assert_eq!(Format::list(), "png, eps, ps");
    }
}
