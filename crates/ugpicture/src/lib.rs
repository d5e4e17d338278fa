//! The parts that all renderers of the ug programs share.
//!
//! A renderer turns a scene into linear light for each pixel. Everything before and after that is
//! here:
//!
//! - [`PictureOptions`]: camera, size, samples and filter, background, exposure, tone curve,
//!   format, and annotations; [`cli`] has them as options of the command line;
//! - [`Backdrop`]: the mean of a pixel's samples on the background;
//! - [`Exposure`]: how light is brought into the range of a display; [`levels_note`]: whether a
//!   picture is nearly black or overexposed;
//! - [`Canvas`]: the shell, which checks options, develops and annotates what a renderer draws,
//!   and notes what the user should know;
//! - [`Rendering`]: the picture or vector figure that a renderer returns, and its file
//!   ([`PictureFile`]);
//! - [`Emissions`] and [`Channel`]: when and where light was emitted that is seen at a sample, and
//!   the channels of an EXR file made of that;
//! - [`explain`]: why a pixel is as it is, as text and as JSON;
//! - [`Layout`]: caption, legend, coordinate grid and undistorted outlines.
//!
//! A renderer is a function from options to light; this one draws a sky that fades to the right:
//!
//! ```
//! use ugimage::{LinearFrame, Metadata};
//! use ugpicture::{Annotated, Canvas, Drawn, DrawnContent, Error, PictureOptions, Subject};
//!
//! let canvas = Canvas::new(&PictureOptions { size: [4, 3], ..PictureOptions::default() })?;
//! let [width, height] = canvas.options().size;
//! let sky = |idx: u32| [0.2, 0.4, 0.8, 1.0].map(|light: f32| light / (1 + idx % width) as f32);
//! let frame = LinearFrame::new([width, height], true, (0..width * height).map(sky).collect());
//! let drawn = Drawn::<Error> {
//!     content: DrawnContent::Light { frame, is_clipped: false },
//!     brightest: 0.8,
//!     notes: Vec::new(),
//!     annotated: Annotated { is_shifted: false, subject: Subject::Pixels },
//! };
//! let metadata =
//!     Metadata { software: "demo 1.0".into(), comment: String::new(), ..Metadata::default() };
//! let png = canvas.finish(drawn, metadata, &())?.into_file();
//! assert!(png.starts_with(b"\x89PNG"));
//! # Ok::<(), ugpicture::Error>(())
//! ```

mod annotations;
mod background;
mod canvas;
mod channel;
#[cfg(feature = "cli")]
pub mod cli;
mod emission;
mod error;
pub mod explain;
mod exposure;
mod image;
mod levels;
mod limits;
mod line;
mod metadata;
mod note;
mod nothing;
mod options;
mod output;
mod picture_file;
mod quantity;
mod rendering;
mod shared_edges;
mod spots;
mod units;

pub use annotations::{
    Annotated, FindItems, FoundItems, Layout, Scale, Style, Subject, VisibleWires,
};
pub use background::{Backdrop, Background};
pub use canvas::{Canvas, Drawn, DrawnContent};
pub use channel::{Channel, push_channels};
pub use emission::{Emission, Emissions, MediumLight, SeenItem, SurfaceSample};
pub use error::{Error, refuse};
pub use exposure::Exposure;
pub use levels::levels_note;
pub use limits::{MAX_PIXELS, MAX_SAMPLES, MAX_SIDE};
pub use line::{DepthPoint, clip_line, in_picture, visible_parts};
pub use metadata::metadata;
pub use note::Note;
pub use nothing::{WithoutFaces, is_all_transparent, why_nothing_is_seen};
pub use options::{AnnotationOptions, PictureOptions, Place};
pub use output::Output;
pub use picture_file::PictureFile;
pub use quantity::{IsoOptions, MapOptions, Quantity};
pub use rendering::{Rendering, VectorFigure};
pub use shared_edges::{FaceEdge, Fold, shared_edges};
pub use spots::spots;
pub use ugimage::label::TextForm;
pub use ugimage::{Filter, Tone};
pub use units::{Unit, Units};
