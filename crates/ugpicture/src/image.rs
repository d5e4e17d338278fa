//! A rendered picture.

use rayon::prelude::*;
use ugimage::{Compression, Development, Frame, LinearFrame, Metadata, Quantizer, display_pixel};

use crate::background::Backdrop;
use crate::options::PictureOptions;
use crate::output::Output;

/// Pixels that one task develops.
const CHUNK: usize = 1 << 14;

/// A rendered picture.
#[derive(Clone, Debug)]
pub enum Image {
    /// 8-bit pixels for a display.
    Display(Frame),
    /// Light: developed for a display, or linear for a format that holds light.
    Light(LinearFrame),
}

impl Image {
    /// Light as the format of the picture holds it, and how it was developed. `is_clipped`: its
    /// samples were clipped one by one, so it is within the range of a display, and is not
    /// developed.
    pub fn developed(
        mut light: LinearFrame,
        options: &PictureOptions,
        is_clipped: bool,
    ) -> (Self, Option<Development>) {
        if options.output.format().is_linear() {
            return (Self::Light(light), None);
        }
        let development = (!is_clipped).then(|| options.development(|| &light));
        let is_deep = options.output.format().is_deep();
        let backdrop = Backdrop::new(options.background, 1);
        let image = match development.map(|development| backdrop.converter(development)) {
            Some(convert) if is_deep => {
                light.pixels_mut().par_chunks_mut(CHUNK).flatten().for_each(|pixel| {
                    [pixel[0], pixel[1], pixel[2]] = convert(*pixel);
                });
                Self::Light(light)
            }
            Some(convert) => {
                let quantizer = Quantizer::new();
                let mut pixels = vec![[0; 4]; light.pixels().len()];
                let chunks = pixels.par_chunks_mut(CHUNK).zip(light.pixels().par_chunks(CHUNK));
                chunks.for_each(|(pixels, chunk)| {
                    // Many pixels are like the one before.
                    let mut last = ([f32::NAN; 4], [0; 4]);
                    for (shown, &own) in pixels.iter_mut().zip(chunk) {
                        if own != last.0 {
                            let [red, green, blue] = convert(own);
                            let all = [red, green, blue, own[3]];
                            last = (own, display_pixel(&quantizer, all, light.is_opaque()));
                        }
                        *shown = last.1;
                    }
                });
                Self::Display(Frame::new(
                    [light.width(), light.height()],
                    light.is_opaque(),
                    pixels,
                ))
            }
            None if is_deep => Self::Light(light),
            None => Self::Display(light.to_display()),
        };
        (image, development)
    }

    /// As 8-bit pixels.
    pub fn into_frame(self) -> Frame {
        match self {
            Self::Display(frame) => frame,
            Self::Light(frame) => frame.to_display(),
        }
    }

    /// The bytes of a file. Vector formats contain the pixels as an image.
    pub fn into_file(
        self,
        output: Output,
        metadata: &Metadata,
        compression: Compression,
    ) -> Vec<u8> {
        match self {
            Self::Display(frame) => output.format().encode_with(&frame, metadata, compression),
            Self::Light(frame) => output.format().encode_linear(&frame, metadata, compression),
        }
    }
}
