//! `ugrainbow` turns a UniGrafix scene into a picture: a scanline renderer
//! that interpolates hues or wavelengths between the corners of faces.
//!
//! It is the last program of the pipe. `uglorentz` has computed the apparent shape of what moves,
//! and `ugdoppler` its observed colours; rendering the result is ordinary but for colour. After
//! Nguyen (1988) a colour is a wavelength with a saturation and a value. Between a red corner (700
//! nm) and a blue one (435.8 nm) lies the rainbow, not purple. Towards the ends of the visible
//! range a pure colour fades to black; the white part of a pale one stays (P17).
//!
//! # From scene to picture
//!
//! ```text
//! Scene ─camera─→ positions of vertices   ┐
//!       ─surface→ colours, rest positions ├─drawlist→ polygons ─ugraster→ samples
//!       ─light──→ light levels            ┘  (clip)
//! samples ─shade→ light ─pixels→ Image
//! ```
//!
//! - **Camera.** An option overrides the scene's `cam`, which overrides the default: the eye at the
//!   origin looking at the middle of the scene, +z up, 40 degrees across. Pixels are square unless
//!   both view angles are given as options.
//! - **Colour.** Colours given as light (`c_xyz`) are interpolated as linear light, without
//!   clipping. A vertex has its own colour, else the mix of its faces' colours, else white. A
//!   colour of saturation 0 has no wavelength, and is not attenuated.
//! - **Light.** As in 1988 lights rest in the frame of the face they light. Positions and normals
//!   are transformed to that frame (P4), so a moving cube is lit like a cube at rest. The visible
//!   side of a face is lit. The level multiplies the value.
//! - **Visibility.** The depth test is made per sample, so faces may intersect. Colour and light of
//!   a face are computed when the first of its samples is visible. [`Config::cull`] leaves out
//!   back-facing faces. Translucent faces are blended from back to front, per sample, in linear
//!   light.
//! - **Pixels.** Samples are averaged in linear light by a reconstruction [`Filter`]. The mean is
//!   exposed, put through a tone curve, mapped to the gamut (P30) and encoded as sRGB, or written
//!   unchanged to a format that holds light. Values above 1 are clipped per sample, as in 1988,
//!   unless the scene has light or the options ask for it.
//! - **Exact pictures** ([`Config::exact`]): each sample is a ray into the rest frame of a face
//!   (P6), and its colour is shifted there. Faces need no subdivision, and the colours of the scene
//!   must be those at rest.
//! - **Lines**, wires and edges of faces ([`Wireframe`]), are not lit, and are drawn in front of
//!   the faces they lie on. Their hidden parts are computed along their centre lines.
//! - **Depth cueing** ([`DepthCue`]) fades distant surfaces into the background.
//! - **Vector graphics** are made of the same polygons ([`Output::Vector`]).
//!
//! Not supported: local lights that weaken with distance or have a radius, and lights that move
//! relative to what they light; `ugdoppler -li` has both. The bytes do not depend on the number of
//! threads.
//!
//! # Modules
//!
//! Each line imports only from the lines above it:
//!
//! ```text
//! config  error                                       options, and errors
//! shade  packing                                      colours of samples
//! planar  clip  painter                               geometry in the picture plane
//! drawlist  lines  exact                              polygons, lines, faces hit by rays
//! setup  render_layers  depth_cue                     the whole scene for one camera
//! center_surface  drawn_scene                         one surface of a pixel; what was drawn
//! pixels  annotate  notes                             from samples to an image, with messages
//! vector  render  explain                             vector graphics, pictures, one pixel
//! cli                                                 the command line
//! ```
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
//! let frame = rendering.into_frame().expect("PNG has pixels");
//! assert!(frame.pixels().iter().all(|&pixel| pixel == [0, 255, 0, 255]));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod annotate;
mod center_surface;
#[cfg(feature = "cli")]
mod cli;
mod clip;
mod config;
mod depth_cue;
mod drawlist;
mod drawn_scene;
mod error;
mod exact;
pub mod explain;
mod lines;
mod notes;
mod packing;
mod painter;
mod pixels;
mod planar;
mod render;
mod render_layers;
mod setup;
mod shade;
mod vector;

#[cfg(feature = "cli")]
pub use cli::{Args, draw};
pub use config::{Config, DepthCue, EdgeKind, HiddenLines, Wireframe};
pub use error::Error;
pub use render::{PROVENANCE, light, render, render_with, run, run_with};
pub use uglight::{ColorShift, HueShift, Interpolation, SpectralShift};
pub use ugpicture::{
    AnnotationOptions, Background, Channel, Exposure, Filter, MAX_PIXELS, MAX_SIDE, Note, Output,
    PictureFile, PictureOptions, Place, Rendering, TextForm, Tone, VectorFigure, metadata,
};
pub use ugscene::{CameraError, CameraOptions, HueScale, Provenance};
pub use ugskybox::{SceneSky, SkySource};
