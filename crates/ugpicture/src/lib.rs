//! What every renderer of the ug programs shares, whatever it renders a scene with.
//!
//! A renderer turns a scene into linear light for each pixel. Everything before and after that is
//! here:
//!
//! - [`PictureOptions`]: camera, size, samples and filter, background, exposure, tone curve,
//!   format, and annotations; [`cli`] has them as options of the command line;
//! - [`lens`]: which direction is seen at a place of the picture;
//! - [`Backdrop`]: the mean of a pixel's samples on the background;
//! - [`Exposure`]: how light is brought into the range of a display;
//! - [`Image`]: the picture as light or as 8-bit pixels, developed for its format;
//! - [`Rendering`]: the picture or vector figure that a renderer returns, and its file
//!   ([`PictureFile`]);
//! - [`Emissions`] and [`Channel`]: when and where light was emitted that is seen at a sample, and
//!   the channels of an EXR file made of that;
//! - [`explain`]: why a pixel is as it is, as text and as JSON;
//! - [`Layout`]: caption, legend, coordinate grid and undistorted outlines.
//!
//! ```
//! use ugimage::{Compression, Frame, Metadata};
//! use ugpicture::{Image, PictureOptions};
//!
//! let options = PictureOptions { size: [4, 3], ..PictureOptions::default() };
//! options.check()?;
//! let image = Image::Display(Frame::opaque(4, 3));
//! let metadata = Metadata { software: "demo 1.0".into(), comment: String::new() };
//! let png = image.into_file(options.output, &metadata, Compression::Fast);
//! assert!(png.starts_with(b"\x89PNG"));
//! # Ok::<(), ugpicture::Error>(())
//! ```

mod annotations;
mod background;
mod channel;
#[cfg(feature = "cli")]
pub mod cli;
mod depth_buffer;
mod emission;
mod error;
pub mod explain;
mod exposure;
mod image;
pub mod lens;
mod limits;
mod line;
mod metadata;
mod note;
mod options;
mod output;
mod picture_file;
mod rendering;

pub use annotations::{Annotated, Annotations, Layout, SceneState};
pub use background::{Backdrop, Background};
pub use channel::{Channel, channel_planes};
pub use depth_buffer::{DepthBuffer, SurfaceSample};
pub use emission::{Emission, Emissions, MediumLight, SeenItem};
pub use error::Error;
pub use exposure::Exposure;
pub use image::Image;
pub use limits::{MAX_PIXELS, MAX_SAMPLES, MAX_SIDE};
pub use line::{clip_line, visible_runs};
pub use metadata::metadata;
pub use note::Note;
pub use options::{AnnotationOptions, PictureOptions};
pub use output::Output;
pub use picture_file::PictureFile;
pub use rendering::{Content, Rendering, VectorFigure};
pub use ugimage::{Filter, Tone};
