//! Images in memory, and the file formats they are written in.
//!
//! A [`LinearFrame`] holds linear light: red, green and blue of the sRGB primaries, unclipped, and
//! any number of extra channels. A [`Development`] converts it for a display: exposure, tone
//! mapping, and gamut mapping that preserves hue.
//!
//! A [`Frame`] holds display-encoded pixels: four bytes per pixel, red, green, blue and alpha, the
//! colours encoded with the sRGB transfer function. All computations use linear light. Only
//! [`Quantizer`] converts it to bytes, and it rounds exactly to the nearest of the 256 levels.
//!
//! The writers ([`Format::encode`], [`Format::encode_linear`]) return the
//! whole file as a `Vec<u8>`. They do no I/O and read no clock. Everything in the file besides
//! pixels is passed in a [`Metadata`], so the same frame and metadata give the same bytes.
//!
//! [`read_png`] reads PNG files with their metadata, [`read_picture`] pictures of several formats.
//!
//! | format | pixels | transparency |
//! | --- | --- | --- |
//! | [`Format::Png`], [`Format::Png16`] | RGB or RGBA, 8 or 16 bits, tagged sRGB | kept |
//! | [`Format::Pdf`], [`Format::Svg`] | embedded RGB image | kept |
//! | [`Format::Ppm`] | RGB, 8 bits | over white |
//! | [`Format::Exr`] | linear light, 32-bit floats, and extra planes | kept |
//! | [`Format::Pfm`] | linear light, 32-bit floats | over black |
//! | [`Format::Hdr`] | linear light ≥ 0, 8-bit mantissas with a shared exponent | over black |
//! | [`Format::Eps`], [`Format::Ps`] | DeviceRGB, PostScript level 2 | over white |
//!
//! "Over white" means that transparent pixels are composited over a white background. In page
//! formats one pixel is one point (1/72 inch).
//!
//! ```
//! use ugimage::{Format, Frame, Metadata};
//!
//! let mut frame = Frame::opaque(2, 1);
//! frame.pixels_mut()[1] = [255, 128, 0, 255];
//! let (software, comment) = ("demo 1.0".into(), "demo -sz 2 1".into());
//! let metadata = Metadata { software, comment, panorama: None };
//! let png = Format::Png.encode(&frame, &metadata);
//! assert!(png.starts_with(b"\x89PNG"));
//!
//! let eps = Format::Eps.encode(&frame, &metadata);
//! assert!(eps.starts_with(b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 2 1\n"));
//! ```

mod develop;
mod eps;
mod exr;
pub mod figure;
mod filter;
mod format;
mod frame;
mod hdr;
mod history;
pub mod label;
mod linear;
mod metadata;
mod panorama;
mod pdf;
mod pfm;
mod png;
mod postscript;
mod ppm;
mod ps;
mod quantizer;
mod read;
mod read_hdr;
mod read_light;
mod read_pfm;
mod svg;
mod typeface;

pub use develop::{Development, DevelopmentSteps, Tone, auto_exposure};
pub use filter::Filter;
pub use format::Format;
pub use frame::Frame;
pub use history::read_history;
pub use linear::{LinearFrame, Plane, Samples, display_pixel};
pub use metadata::Metadata;
pub use panorama::PanoramaArea;
pub use png::Compression;
pub use quantizer::{Quantizer, ROUNDING_OFFSET};
pub use read::{MAX_PIXELS, PictureLimits, ReadError, read_png, read_png_header};
pub use read_light::{Pixels, read_picture};
