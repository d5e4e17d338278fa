//! Pictures as bytes: frames of pixels, and the formats they are written in.
//!
//! A [`LinearFrame`] holds light: linear red, green and blue of the sRGB primaries, uncut, and
//! any other number for each pixel. A [`Development`] makes it fit for a display: exposure, tone
//! curve, and colours brought into the gamut without a change of hue.
//!
//! A [`Frame`] holds what a display shows: four bytes a pixel, red, green, blue
//! and alpha, the colours encoded with the sRGB transfer function. Everything
//! that computes with light works in linear light; [`Quantizer`] is the one way
//! from there to bytes, and it rounds to the nearest of the 256 levels exactly.
//!
//! The writers ([`Format::encode`], [`Format::encode_linear`], [`grey_postscript`]) return the whole file in
//! a `Vec<u8>`. They do no I/O, read no clock and are given everything that
//! stands in the file besides pixels in a [`Label`], so the same frame gives the
//! same bytes.
//!
//! [`read_png`] reads what PNG files hold, with the label.
//!
//! | format | pixels | transparency |
//! | --- | --- | --- |
//! | [`Format::Png`], [`Format::Png16`] | RGB or RGBA, 8 or 16 bits, tagged sRGB | kept |
//! | [`Format::Pdf`], [`Format::Svg`] | an embedded RGB picture, one pixel a point | kept |
//! | [`Format::Ppm`] | RGB, 8 bits | put on white |
//! | [`Format::Exr`] | light, 32-bit floats, and other planes | kept |
//! | [`Format::Pfm`] | light, 32-bit floats | put on black |
//! | [`Format::Hdr`] | light, 8 bits with a common exponent, nothing below 0 | put on black |
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

mod develop;
mod eps;
mod exr;
pub mod figure;
mod format;
mod frame;
mod grey;
mod hdr;
mod linear;
mod pdf;
mod pfm;
mod png;
mod postscript;
mod ppm;
mod ps;
mod quantizer;
mod read;
mod svg;

pub use develop::{Development, Steps, Tone, auto_exposure};
pub use format::{Format, Label};
pub use frame::Frame;
pub use grey::grey_postscript;
pub use linear::{LinearFrame, Plane, Samples, display_pixel};
pub use png::Packing;
pub use quantizer::{HALF, Quantizer};
pub use read::{ReadError, read_png};
