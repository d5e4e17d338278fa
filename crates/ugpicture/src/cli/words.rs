//! Errors of picture options, with the options that correct them.

use ugpipe::Words;

use crate::Error;
use crate::limits::{MAX_SAMPLES, MAX_VECTOR_SIDE};

impl Words for Error {
    fn words(&self) -> String {
        let words = match self {
            Self::Size(_) | Self::Memory(..) => "{}; give a smaller -sz",
            Self::Samples(n) => {
                return format!("{n} x {n} samples a pixel cannot be taken; give -aa 1 to {MAX_SAMPLES}");
            }
            Self::NotPng => "{}: leave out -pz, or write -dt png or png16",
            Self::NotExr => "{}: with -ch write -dt exr",
            Self::NotDeveloped => "{}: leave out -ex and -tc, or write -dt png16",
            Self::NotAnnotated => "{}: leave out -cap, -lg, -dl and -gr, or write -dt png16",
            Self::NotTransparent => "{}: leave out -tb, or write -dt exr",
            Self::NoVectors => "{}: with -vec write -dt eps, ps, pdf or svg",
            Self::NoSamples => "vector graphics (-vec) have no samples to filter: leave out -fl or -vec",
            Self::VectorSize => {
                return format!(
                    "vector graphics (-vec) are at most {MAX_VECTOR_SIDE} points along a side: give a smaller -sz"
                );
            }
            Self::TooNarrow => "{}: give a wider -sz, or leave out -cap and -lg",
            Self::NoRoom => "{}: give a larger -sz, or a shorter -cap",
            Self::Pixel { pixel: [x, y], size: [width, height] } => {
                return format!(
                    "pixel {x},{y} is not in the picture of {width} x {height} pixels; \
                     count columns and rows from 0 at the upper left, or give -sz"
                );
            }
            Self::Text(_) => "{}",
            Self::Camera(error) => return error.words(),
        };
        words.replacen("{}", &self.to_string(), 1)
    }
}
