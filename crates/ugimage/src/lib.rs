//! Pictures as bytes: a frame of pixels, and the formats it is written in.
//!
//! A [`Frame`] holds what a display shows: four bytes a pixel, red, green, blue
//! and alpha, the colours encoded with the sRGB transfer function. Everything
//! that computes with light works in linear light; [`Quantizer`] is the one way
//! from there to bytes, and it rounds to the nearest of the 256 levels exactly.
//!
//! The writers ([`Format::encode`], [`grey_postscript`]) return the whole file in
//! a `Vec<u8>`. They do no I/O, read no clock and are given everything that
//! stands in the file besides pixels in a [`Label`], so the same frame gives the
//! same bytes.
//!
//! | format | pixels | transparency |
//! | --- | --- | --- |
//! | [`Format::Png`] | RGB or RGBA, 8 bits, tagged sRGB | kept |
//! | [`Format::Eps`], [`Format::Ps`] | DeviceRGB, PostScript level 2, one pixel is one point | put on white |
//! | [`grey_postscript`] | luminance, PostScript level 1, one pixel is one point | put on white |
//!
//! ```
//! use ugimage::{Format, Frame, Label};
//!
//! let mut frame = Frame::opaque(2, 1);
//! frame.pixels_mut()[1] = [255, 128, 0, 255];
//! let label = Label { software: "demo 1.0".into(), comment: "demo -sz 2 1".into() };
//! let png = Format::Png.encode(&frame, &label);
//! assert!(png.starts_with(b"\x89PNG"));
//!
//! let eps = Format::Eps.encode(&frame, &label);
//! assert!(eps.starts_with(b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 2 1\n"));
//! ```

mod eps;
mod format;
mod frame;
mod grey;
mod png;
mod postscript;
mod ps;
mod quantizer;

pub use format::{Format, Label};
pub use frame::Frame;
pub use grey::grey_postscript;
pub use quantizer::Quantizer;
