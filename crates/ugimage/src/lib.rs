//! The file formats of images, areas and text on them. The images in memory are those of
//! [`ugframe`].
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
//! let metadata = Metadata { software, comment, ..Metadata::default() };
//! let png = Format::Png.encode(&frame, &metadata);
//! assert!(png.starts_with(b"\x89PNG"));
//!
//! let eps = Format::Eps.encode(&frame, &metadata);
//! assert!(eps.starts_with(b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 2 1\n"));
//! ```

mod encoding;
mod exr;
pub mod figure;
mod format;
mod hdr;
mod history;
pub mod label;
mod metadata;
mod orientation;
mod panorama;
mod pdf;
mod pfm;
mod pixels;
mod png;
mod postscript;
mod ppm;
mod read;
mod read_exr;
mod read_hdr;
mod read_light;
mod read_pfm;
mod spelled_color;
mod svg;
mod typeface;

pub use format::Format;
pub use history::read_history;
pub use metadata::Metadata;
pub use panorama::PanoramaArea;
pub use pixels::Pixels;
pub use png::Compression;
pub use read::{MAX_PIXELS, PictureLimits, ReadError, read_png, read_png_header};
pub use read_exr::{SpectralPicture, read_spectrum};
pub use read_light::{
    ForeignKind, PictureHeader, ReadPicture, check_picture, foreign_kind, read_picture,
};
pub use spelled_color::spelled_color;
pub use ugframe::{
    Development, DevelopmentSteps, Filter, Frame, LinearFrame, Plane, Quantizer, ROUNDING_OFFSET,
    Samples, Tone, auto_exposure, display_pixel,
};
