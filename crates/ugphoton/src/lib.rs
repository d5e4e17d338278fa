//! Relativistic ray tracer for UniGrafix scenes.
//!
//! For each sample of the picture a ray is followed from the eye into the past: to the event at
//! which its light left a surface, and on through mirrors and glass, each with its own motion
//! (Nguyen 1988, chapter 5; Chang, Lai and Chen 1996; Howard, Dance and Kitchen 1995; Li, Shum and
//! Peng 2001).
//!
//! - **Bodies** rest in frames of their own. A ray is an event and a step, carried to each frame,
//!   where a static hierarchy of triangles answers (P21). Its parameter is the same in all frames,
//!   so the nearest hit is the one with the latest emission (P22).
//! - **Light** is a wave 4-vector. Mirrors reflect it and glass refracts it in the rest frame of
//!   the surface (P23), (P37); its frequency there is 1/D, the product of all Doppler factors along
//!   the path. In a medium light is slower, and is dragged along where the medium moves.
//! - **Shadow rays** run backwards in time, so the shadows of moving bodies lag (P24).
//!
//! # Modules
//!
//! What rays meet is found by [`ugtrace::outlines`] and [`ugtrace::rays`], with places, normals
//! and colours. Each line imports
//! only from the lines above it:
//!
//! ```text
//! error  config                             errors; options
//! sampling  media                           places on lamps; the media that rays are in
//! immersion                                 the transparent solids that the eye is in
//! scenery                                   a scene prepared for rays
//! neighbours  shade  tracer                 the sizes of samples; lamps; mirrors and glass
//! pixel_centers  pixels  notes  render  explain  from samples to a picture; one pixel
//! cli                                       the command line
//! ```
//!
//! # Example
//!
//! A mirror that recedes with 0.6 c divides frequencies by four, and by the law of 1988 the value
//! of the white wall behind the eye:
//!
//! ```
//! use ugphoton::{Config, PictureOptions, light};
//!
//! let text = "surf mirror 0 1 0; l 0; v a -9 -9 -2; v b 9 -9 -2; v c 9 9 -2; v d -9 9 -2;
//!             v e -99 -99 1; v f -99 99 1; v g 99 99 1; v h 99 -99 1;
//!             c white 1; f (a b c d) white mirror <0 0 -0.6>; f (e f g h) white 1;
//!             cam -ep 0 0 0 -vc 0 0 -1 -ud 0 1 0;";
//! let source = ugparse::Source::new("mirror.ug", text);
//! let scene = ugparse::parse(&source, &ugparse::Options::default())?.scene;
//! let picture = PictureOptions { size: [1, 1], samples: 1, ..PictureOptions::default() };
//! let frame = light(scene, &Config { picture, ..Config::default() })?;
//! let expected = ugphysics::srgb_decode(0.25) as f32;
//! assert!((frame.pixels()[0][0] - expected).abs() < 1e-4, "{:?}", frame.pixels()[0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[cfg(feature = "cli")]
mod cli;
mod config;
mod error;
pub mod explain;
mod immersion;
mod media;
mod neighbours;
mod notes;
mod open_solids;
mod pixel_centers;
mod pixels;
mod render;
mod rounds;
mod sampling;
mod scenery;
mod shade;
mod tracer;
mod wires;

#[cfg(feature = "cli")]
pub use cli::{Args, draw};
pub use config::{Config, RayOptions, Shutter};
pub use error::Error;
pub use explain::explain;
pub use render::{PROVENANCE, PreparedScene, light, render, render_with, run};
pub use tracer::Way;
pub use uglight::{ColorShift, HueShift, Interpolation, SpectralShift};
pub use ugpicture::{
    Background, Channel, Exposure, Filter, Note, Output, PictureFile, PictureOptions, Rendering,
    Tone, metadata,
};
pub use ugscene::{Anchor, CameraOptions, HueScale, MotionOptions, Provenance};
pub use ugskybox::{SceneSky, SkySource};
use ugtrace::lens;
pub use ugtrace::lens::Lens;
