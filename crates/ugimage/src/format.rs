//! The file formats and their names.

use crate::png::Compression;
use crate::{Frame, LinearFrame, Metadata, exr, hdr, pdf, pfm, png, postscript, ppm, svg};

/// A file format for colour images.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Portable Network Graphics.
    Png,
    /// Portable Network Graphics with 16 bits per channel.
    Png16,
    /// Encapsulated PostScript, to be placed in a document.
    Eps,
    /// PostScript, one page of the size of the image.
    Ps,
    /// Portable Document Format, one page of the size of the image.
    Pdf,
    /// Scalable Vector Graphics.
    Svg,
    /// Portable pixmap, binary.
    Ppm,
    /// OpenEXR: linear light, and extra planes.
    Exr,
    /// Portable float map: linear light.
    Pfm,
    /// Radiance HDR: linear light, as 8-bit mantissas with a shared exponent.
    Hdr,
}

impl Format {
    /// All formats, the default first.
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

    /// The name of the format, which except for `png16` is also the usual file extension.
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

    /// The format of the given name, in lower or upper case; `None` if there is no such format.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| name.eq_ignore_ascii_case(format.name()))
    }

    /// All names, separated by commas, for messages.
    pub fn list() -> String {
        Self::ALL.map(Self::name).join(", ")
    }

    /// True if the file is binary, so that it must not be printed to a terminal.
    pub fn is_binary(self) -> bool {
        !matches!(self, Self::Eps | Self::Ps | Self::Svg)
    }

    /// True if the file holds linear, unclipped light rather than display-encoded colours.
    pub fn is_linear(self) -> bool {
        matches!(self, Self::Exr | Self::Pfm | Self::Hdr)
    }

    /// True if the format has vector graphics (areas and lines) as well as pixels, see
    /// [`crate::figure`].
    pub fn has_vectors(self) -> bool {
        matches!(self, Self::Eps | Self::Ps | Self::Pdf | Self::Svg)
    }

    /// True if the format has more precision than an 8-bit [`Frame`].
    pub fn is_deep(self) -> bool {
        self.is_linear() || self == Self::Png16
    }

    /// True if transparency is kept or composited over white; otherwise it is composited over
    /// black.
    pub fn has_alpha(self) -> bool {
        !matches!(self, Self::Pfm | Self::Hdr)
    }

    /// The frame as a file of this format.
    pub fn encode(self, frame: &Frame, metadata: &Metadata) -> Vec<u8> {
        self.encode_with(frame, metadata, Compression::Fast)
    }

    /// Like [`Format::encode`], with the given compression for PNG files.
    pub fn encode_with(
        self,
        frame: &Frame,
        metadata: &Metadata,
        compression: Compression,
    ) -> Vec<u8> {
        match self {
            Self::Png => png::encode(frame, metadata, compression),
            Self::Eps => postscript::encode(frame, metadata, true),
            Self::Ps => postscript::encode(frame, metadata, false),
            Self::Pdf => pdf::encode(frame, metadata),
            Self::Svg => svg::encode(frame, metadata),
            Self::Ppm => ppm::encode(frame, metadata),
            Self::Png16 | Self::Exr | Self::Pfm | Self::Hdr => {
                self.encode_linear(&frame.into(), metadata, compression)
            }
        }
    }

    /// Linear light as a file of this format, with the given compression for PNG files. Unless the
    /// format [is linear](Format::is_linear), light outside 0…1 is clipped: apply a
    /// [`Development`](crate::Development) first.
    pub fn encode_linear(
        self,
        frame: &LinearFrame,
        metadata: &Metadata,
        compression: Compression,
    ) -> Vec<u8> {
        match self {
            Self::Png16 => png::encode_16(frame, metadata, compression),
            Self::Exr => exr::encode(frame, metadata),
            Self::Pfm => pfm::encode(frame),
            Self::Hdr => hdr::encode(frame, metadata),
            Self::Png | Self::Eps | Self::Ps | Self::Pdf | Self::Svg | Self::Ppm => {
                self.encode_with(&frame.to_display(), metadata, compression)
            }
        }
    }
}
