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
//! use ugrainbow::{Config, render};
//!
//! let text = "c green 1 120; l 1;
//!             v a -1 -1 0; v b 1 -1 0; v c 1 1 0; v d -1 1 0; f (a b c d) green;
//!             cam -ep 0 0 1 -vc 0 0 0 -ud 0 1 0;";
//! let source = ugparse::Source::new("square.ug", text);
//! let scene = ugparse::parse(&source, &ugparse::Options::default())?.scene;
//! let (frame, notes) = render(&scene, &Config { size: [4, 4], ..Config::default() })?;
//! assert!(frame.pixels().iter().all(|&pixel| pixel == [0, 255, 0, 255]));
//! assert!(notes.is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod canvas;
mod cli;
mod clip;
mod config;
mod depth_cue;
mod drawlist;
mod error;
mod exact;
mod explain;
mod figures;
mod lines;
#[cfg(test)]
mod noise;
mod notes;
mod packing;
mod painter;
mod palette;
mod planar;
mod planes;
mod render_layers;
mod setup;
mod shade;
mod surface;
mod vector;
mod words;

use ugimage::{Development, Frame, Label, Packing, grey_postscript};
use ugparse::{Diagnostics, Parsed, Scene, Source};
use ugpipe::Progress;

pub use cli::{Args, draw};
pub use config::{Background, Config, DepthCue, Exact, Exposure, Interpolation, Output, Wireframe};
pub use error::{Error, MAX_PIXELS, MAX_SIDE};
pub use figures::Figures;
pub use planes::Channel;
pub use ugimage::Tone;
pub use uglight::HueScale;
pub use ugraster::Filter;
pub use ugscene::{CameraError, CameraOptions};

use canvas::{Canvas, Drawn};
use depth_cue::prepare;
use figures::{Annotations, Plan};
use notes::Outcome;
use render_layers::RenderLayers;
use setup::Setup;

/// A picture as a file.
#[derive(Clone, Debug)]
pub struct Picture {
    /// The whole file.
    pub bytes: Vec<u8>,
    /// What the user should know, one sentence each.
    pub notes: Vec<String>,
    /// What the reader of the scene found.
    pub warnings: Diagnostics,
}

/// Reads a scene, draws it, and puts it into a file.
///
/// # Errors
/// Whatever stops it: see [`Error`].
pub fn run(config: &Config, source: &Source) -> Result<Picture, Error> {
    run_with(config, source, &())
}

/// [`run`], which tells somebody how far it is.
///
/// # Errors
/// Whatever stops it: see [`Error`].
pub fn run_with(config: &Config, source: &Source, progress: &dyn Progress) -> Result<Picture, Error> {
    let plan = Plan::new(config)?;
    progress.step("reading", 0);
    let parsed = ugscene::read(source, &config.reading, config.camera.name.as_deref())?;
    let of_scene = plan.of_scene(config);
    let Painted { drawn, development, annotations, notes } =
        paint(&parsed.scene, &plan, &of_scene, progress)?;
    progress.step("packing", 0);
    let label = label(&parsed.scene, config);
    let packing = if config.small { Packing::Small } else { Packing::Fast };
    let bytes = match (config.output, drawn) {
        (Output::Vector(format), _) => {
            vector::file(&parsed.scene, &of_scene, format, development, &annotations, &label)?
        }
        (Output::Color(format), Drawn::Display(frame)) => format.pack(&frame, &label, packing),
        (Output::Color(format), Drawn::Light(frame)) => format.pack_linear(&frame, &label, packing),
        (Output::Grey, drawn) => grey_postscript(&drawn.into_frame(), &label),
    };
    Ok(Picture { bytes, notes, warnings: warnings(source, parsed) })
}

/// What the reader found, and that moving bodies are drawn at rest.
fn warnings(source: &Source, parsed: Parsed) -> Diagnostics {
    match ugscene::rest_shapes_warning(&parsed) {
        Some(warning) => parsed.warnings.with(source, warning),
        None => parsed.warnings,
    }
}

/// Draws a scene for a display with 8 bits a channel. The notes say what the user should know, one sentence each.
///
/// # Errors
/// The picture is too large, there is nothing to draw, or the camera makes no sense.
pub fn render(scene: &Scene, config: &Config) -> Result<(Frame, Vec<String>), Error> {
    let plan = Plan::new(config)?;
    paint(scene, &plan, &plan.of_scene(config), &())
        .map(|painted| (painted.drawn.into_frame(), painted.notes))
}

/// A scene made ready to be drawn: its colours and lights are known, and nothing has been put into the picture yet.
pub struct Prepared<'a> {
    setup: Setup<'a>,
    config: &'a Config,
}

impl<'a> Prepared<'a> {
    /// Makes a scene ready.
    ///
    /// # Errors
    /// As of [`render`].
    pub fn new(scene: &'a Scene, config: &'a Config) -> Result<Self, Error> {
        Ok(Self { setup: prepare(scene, config)?, config })
    }

    /// Draws it: from vertices in the scene to 8 bits a channel.
    pub fn draw(&self) -> Frame {
        let layers = RenderLayers::new(self.setup.painter(), &self.config.draw_mode());
        Canvas::new(&self.setup, &layers, self.config).drawn.into_frame()
    }
}

/// A picture, how its light was developed, and what there is to say about it.
struct Painted {
    drawn: Drawn,
    development: Option<Development>,
    annotations: Annotations,
    notes: Vec<String>,
}

/// `config`: what is asked of the picture of the scene in the plan.
fn paint(scene: &Scene, plan: &Plan, config: &Config, progress: &dyn Progress) -> Result<Painted, Error> {
    progress.step("preparing", 0);
    let setup = prepare(scene, config)?;
    let layers = RenderLayers::new(setup.painter(), &config.draw_mode()).telling(progress);
    let canvas = Canvas::new(&setup, &layers, config);
    let Canvas { drawn, stats, development } = canvas;
    progress.step("annotating", 0);
    let outcome = Outcome { clip_counts: layers.clip_counts(), stats, development };
    let mut notes = notes::notes(&setup, config, &outcome);
    let annotations = plan.annotations(&setup, config, development)?;
    notes.extend(annotations.notes.iter().cloned());
    Ok(Painted { drawn: annotations.on(drawn), development, annotations, notes })
}

/// Our name and version, and the command lines of the whole pipe.
fn label(scene: &Scene, config: &Config) -> Label {
    let mut lines = ugscene::history(scene);
    if !config.command_line.is_empty() {
        lines.push(&config.command_line);
    }
    Label { software: concat!("ugrainbow ", env!("CARGO_PKG_VERSION")).to_owned(), comment: lines.join("\n") }
}
