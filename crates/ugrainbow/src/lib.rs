//! `ugrainbow` turns a UniGrafix scene into a picture: a scanline renderer
//! that interpolates hues or wavelengths between the corners of faces.
//!
//! It is the last program of the pipe. What moves has been bent by `uglorentz` and
//! coloured by `ugdoppler`; the picture of the result is an ordinary one, but for colour.
//! After Nguyen (1988) a colour is a wavelength with a saturation and a value. Between a
//! red corner (700 nm) and a blue one (435.8 nm) lies the rainbow, not purple; a pure colour
//! shifted out of the visible range is black, and fades toward its ends; of a pale one the
//! white in it stays (P17).
//!
//! # From scene to picture
//!
//! ```text
//! Scene ─camera─→ places of vertices ┐
//!       ─surface→ colours, rest frame ├─drawlist→ polygons ─raster→ samples ─shade→ light ─canvas→ pixels
//!       ─light──→ light levels        ┘  (clip)                                            (develop)
//! ```
//!
//! - **Camera.** An option beats the scene's `cam`, which beats the default: the eye at the
//!   origin looking at the middle of the scene, +z up, 40 degrees across. Pixels are square
//!   unless both view angles are given as options.
//! - **Colour.** Colours given as light (`c_xyz`) are interpolated as linear light, uncut. A vertex has its own colour, else the mix of its faces' colours, else
//!   white. A saturation of 0 has no wavelength, and nothing to attenuate.
//! - **Light.** As in 1988 lights rest in the frame of the face they light. Positions and
//!   normals are brought back to that frame (P4), so a moving cube is lit like a cube.
//!   Faces are lit on the side that is seen. The level multiplies the value.
//! - **Hidden surfaces.** Depth is compared per sample, so faces may cut through each other. Colour and light of a
//!   face are computed when the first of its samples is seen, and never if none is. [`Config::cull`] leaves out what is seen from behind.
//!   Translucent faces are blended from behind, sample by sample, in linear light.
//! - **Pixels.** Samples are averaged in linear light, those of the pixel alike or by a wider [`Filter`]. The mean is exposed, put through a tone curve, brought
//!   into the gamut (P30), and encoded as sRGB; or written as it is to a format that holds light. Unless light
//!   is given or asked for, values above 1 are clipped sample by sample, as in 1988.
//!
//! - **Exact pictures** ([`Config::exact`]): each sample is found by a ray into the rest frame of a face (P6), and its colour
//!   shifted there; faces need not be cut, and the scene must not have been coloured by `ugdoppler`.
//! - **Lines**, wires and edges of faces ([`Wireframe`]), are not lit, and win against the faces they lie on. What of them is
//!   hidden is computed along their middles.
//! - **Depth cueing** ([`DepthCue`]) lets what is far fade into the background.
//!
//! - **Figures** of areas and lines are made of the same polygons, with [`Output::Vector`].
//!
//! What is not done: a fall-off of local lights with distance, their radius, and lights that move against what they light: `ugdoppler -li`
//! does that. Every thread count gives the same bytes.
//!
//! # Example
//!
//! A green square fills the picture:
//!
//! ```
//! use ugrainbow::{Config, PictureOptions, render};
//!
//! let text = "c green 1 120; l 1;
//!             v a -1 -1 0; v b 1 -1 0; v c 1 1 0; v d -1 1 0; f (a b c d) green;
//!             cam -ep 0 0 1 -vc 0 0 0 -ud 0 1 0;";
//! let source = ugparse::Source::new("square.ug", text);
//! let scene = ugparse::parse(&source, &ugparse::Options::default())?.scene;
//! let picture = PictureOptions { size: [4, 4], ..PictureOptions::default() };
//! let rendering = render(&scene, &Config { picture, ..Config::default() })?;
//! assert!(rendering.notes.is_empty());
//! assert!(rendering.into_frame().expect("PNG has pixels").pixels().iter().all(|&pixel| pixel == [0, 255, 0, 255]));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod annotate;
#[cfg(feature = "cli")]
mod cli;
mod clip;
mod config;
mod depth_cue;
mod drawlist;
mod error;
mod exact;
pub mod explain;
mod front;
mod lines;
#[cfg(test)]
mod noise;
mod notes;
mod packing;
mod painter;
mod palette;
mod pixels;
mod planar;
mod render;
mod render_layers;
mod setup;
mod shade;
mod spectra;
mod surface;
mod vector;
#[cfg(feature = "cli")]
mod words;

#[cfg(feature = "cli")]
pub use cli::{Args, draw};
pub use config::{Config, DepthCue, Interpolation, Wireframe};
pub use error::Error;
pub use render::{Picture, Prepared, Rendering, label, light, render, run, run_with};
pub use uglight::{ColorShift, HueScale, HueShift, SpectralShift};
pub use ugpicture::{
    AnnotationOptions, Background, Channel, Exposure, Filter, MAX_PIXELS, MAX_SIDE, Output, PictureOptions,
    Tone,
};
pub use ugscene::{CameraError, CameraOptions};
pub use vector::VectorFigure;
