//! The formats, their names, and what is written beside the pixels.

use crate::png::Packing;
use crate::{Frame, LinearFrame, eps, exr, hdr, pdf, pfm, png, ppm, ps, svg};

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
    /// The same with 16 bits a channel.
    Png16,
    /// Encapsulated PostScript, to be put into a document.
    Eps,
    /// PostScript, one page the size of the picture.
    Ps,
    /// Portable Document Format, one page the size of the picture.
    Pdf,
    /// Scalable Vector Graphics.
    Svg,
    /// Portable pixmap, binary.
    Ppm,
    /// OpenEXR: light, and any other planes.
    Exr,
    /// Portable float map: light.
    Pfm,
    /// Radiance HDR: light, to 8 bits with a common exponent.
    Hdr,
}

impl Format {
    /// All of them, the default first.
    pub const ALL: [Self; 10] = [
        Self::Png,
        Self::Png16,
        Self::Eps,
        Self::Ps,
        Self::Pdf,
        Self::Svg,
        Self::Ppm,
        Self::Exr,
        Self::Pfm,
        Self::Hdr,
    ];

    /// Its name, which is also the usual ending of its files, but for `png16`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Png16 => "png16",
            Self::Eps => "eps",
            Self::Ps => "ps",
            Self::Pdf => "pdf",
            Self::Svg => "svg",
            Self::Ppm => "ppm",
            Self::Exr => "exr",
            Self::Pfm => "pfm",
            Self::Hdr => "hdr",
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
        !matches!(self, Self::Eps | Self::Ps | Self::Svg)
    }

    /// True if it holds light, uncut, and not what a display shows of it.
    pub fn is_linear(self) -> bool {
        matches!(self, Self::Exr | Self::Pfm | Self::Hdr)
    }

    /// True if it has areas and lines as well as pixels, see [`crate::figure`].
    pub fn has_vectors(self) -> bool {
        matches!(self, Self::Eps | Self::Ps | Self::Pdf | Self::Svg)
    }

    /// True if it needs more than a [`Frame`] of 8 bits holds.
    pub fn is_deep(self) -> bool {
        self.is_linear() || self == Self::Png16
    }

    /// True if transparency is kept, or put on white; else light counts as if the rest were black.
    pub fn has_alpha(self) -> bool {
        !matches!(self, Self::Pfm | Self::Hdr)
    }

    /// The frame as a file of this format.
    pub fn encode(self, frame: &Frame, label: &Label) -> Vec<u8> {
        self.pack(frame, label, Packing::Fast)
    }

    /// The same; PNG files packed as asked.
    pub fn pack(self, frame: &Frame, label: &Label, packing: Packing) -> Vec<u8> {
        match self {
            Self::Png => png::encode(frame, label, packing),
            Self::Eps => eps::encode(frame, label),
            Self::Ps => ps::encode(frame, label),
            Self::Pdf => pdf::encode(frame, label),
            Self::Svg => svg::encode(frame, label),
            Self::Ppm => ppm::encode(frame, label),
            Self::Png16 | Self::Exr | Self::Pfm | Self::Hdr => {
                self.pack_linear(&frame.into(), label, packing)
            }
        }
    }

    /// Light as a file of this format. What a display cannot show is clipped unless the format
    /// [is linear](Format::is_linear): develop it before.
    pub fn encode_linear(self, frame: &LinearFrame, label: &Label) -> Vec<u8> {
        self.pack_linear(frame, label, Packing::Fast)
    }

    /// The same; PNG files packed as asked.
    pub fn pack_linear(self, frame: &LinearFrame, label: &Label, packing: Packing) -> Vec<u8> {
        match self {
            Self::Png16 => png::encode_16(frame, label, packing),
            Self::Exr => exr::encode(frame, label),
            Self::Pfm => pfm::encode(frame),
            Self::Hdr => hdr::encode(frame, label),
            Self::Png | Self::Eps | Self::Ps | Self::Pdf | Self::Svg | Self::Ppm => {
                self.pack(&frame.to_display(), label, packing)
            }
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
        assert_eq!(Format::list(), "png, png16, eps, ps, pdf, svg, ppm, exr, pfm, hdr");
    }
}
