//! A rendered picture.

use ugimage::{Compression, Frame, LinearFrame, Metadata, grey_postscript};

use crate::output::Output;

/// A rendered picture.
#[derive(Clone, Debug)]
pub enum Image {
    /// 8-bit pixels for a display.
    Display(Frame),
    /// Light: developed for a display, or linear for a format that holds light.
    Light(LinearFrame),
}

impl Image {
    /// As 8-bit pixels.
    pub fn into_frame(self) -> Frame {
        match self {
            Self::Display(frame) => frame,
            Self::Light(frame) => frame.to_display(),
        }
    }

    /// The bytes of a file. Vector formats contain the pixels as an image.
    pub fn into_file(self, output: Output, metadata: &Metadata, compression: Compression) -> Vec<u8> {
        match (output, self) {
            (Output::Color(format) | Output::Vector(format), Self::Display(frame)) => {
                format.encode_with(&frame, metadata, compression)
            }
            (Output::Color(format) | Output::Vector(format), Self::Light(frame)) => {
                format.encode_linear_with(&frame, metadata, compression)
            }
            (Output::Grey, image) => grey_postscript(&image.into_frame(), metadata),
        }
    }
}
