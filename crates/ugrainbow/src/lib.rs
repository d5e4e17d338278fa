//! `ugrainbow` turns a UniGrafix scene into a picture: a scanline renderer
//! that interpolates hues or wavelengths between the corners of faces.
//!
//! It is the last program of the pipe. What moves has been bent by `uglorentz` and
//! coloured by `ugdoppler`; the picture of the result is an ordinary one, but for colour.
//! After Nguyen (1988) a colour is a wavelength with a saturation and a value. Between a
//! red corner (700 nm) and a blue one (435.8 nm) lies the rainbow, not purple; a colour
//! shifted out of the visible range is black, and fades toward its ends (P17).
//!
//! # From scene to picture
//!
//! ```text
//! Scene ─camera─→ places of vertices ┐
//!       ─surface→ colours, rest frame ├─drawlist→ polygons ─raster→ samples ─shade→ light ─→ pixels
//!       ─light──→ light levels        ┘  (clip)
//! ```
//!
//! - **Camera.** An option beats the scene's `cam`, which beats the default: the eye at the
//!   origin looking at the middle of the scene, +z up, 40 degrees across. Pixels are square
//!   unless both view angles are given as options.
//! - **Colour.** A vertex has its own colour, else the mix of its faces' colours, else
//!   white. A saturation of 0 has no wavelength and is not attenuated.
//! - **Light.** As in 1988 lights rest in the frame of the face they light. Positions and
//!   normals are brought back to that frame (P4), so a moving cube is lit like a cube.
//!   Faces are lit on the side that is seen. The level multiplies the value.
//! - **Hidden surfaces.** Depth is compared per sample, so faces may cut through each other.
//! - **Pixels.** Samples are averaged in linear light and encoded as sRGB.
//!
//! - **Wires** are 1.2 pixels wide and not lit, and win against the faces they lie on.
//!
//! What is not done: translucency (everything is opaque), a fall-off of local lights with
//! distance, their radius, and lights that move against what they light: `ugdoppler -li`
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

mod camera;
mod cli;
mod clip;
mod config;
mod drawlist;
mod error;
mod light;
mod notes;
mod palette;
mod raster;
mod shade;
mod surface;

use std::borrow::Cow;

use glam::DVec3;
use ugimage::{Frame, Label, grey_postscript};
use ugparse::{Diagnostics, Scene, Source};
use ugphysics::srgb_decode;

pub use camera::CameraError;
pub use cli::{Args, draw};
pub use config::{Background, CameraOptions, Config, Interpolation, Output};
pub use error::{Error, MAX_PIXELS, MAX_SIDE};
pub use ugscene::HueScale;

use camera::View;
use drawlist::{DrawList, Painter};
use light::Lighting;
use notes::Outcome;
use palette::{Palette, Swatch};
use raster::{Backdrop, Grid, PolygonList, Shade, Tally, paint};
use shade::Shader;
use surface::Surface;

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
    let parsed = ugparse::parse(source, &ugparse::Options { lax: config.lax })?;
    let (frame, notes) = render(&parsed.scene, config)?;
    let label = label(&parsed.scene, config);
    let bytes = match config.output {
        Output::Color(format) => format.encode(&frame, &label),
        Output::Grey => grey_postscript(&frame, &label),
    };
    Ok(Picture { bytes, notes, warnings: parsed.warnings })
}

/// Draws a scene. The notes say what the user should know, one sentence each.
///
/// # Errors
/// The picture is too large, there is nothing to draw, or the camera makes no sense.
pub fn render(scene: &Scene, config: &Config) -> Result<(Frame, Vec<String>), Error> {
    error::check_size(config.size, config.samples)?;
    if scene.faces.is_empty() && scene.wires.is_empty() {
        return Err(Error::Empty);
    }
    let scene = &with_separate_bodies(scene);
    let [width, height] = config.size;
    let view = View::new(scene, &config.camera, config.size.map(|pixels| pixels * config.samples))?;
    let grid = Grid { width, height, samples: config.samples, is_perspective: view.is_perspective };
    let palette = Palette::new(scene, config);
    let lighting = Lighting::new(scene, config.hue_scale, &view);
    let surface = Surface::new(scene, view.eye, &palette, config.hue_scale)?;
    let painter = Painter {
        scene,
        view: &view,
        grid: &grid,
        palette: &palette,
        lighting: &lighting,
        surface: &surface,
    };
    let shader = Shader::new(config.interpolated());
    let mut canvas = Canvas::new(&grid, config.background);
    let outcome = if lighting.is_colored() {
        canvas.draw(DrawList::new(&painter, pack_colored), |values| shader.colored(values))
    } else {
        canvas.draw(DrawList::new(&painter, pack_plain), |values| shader.plain(values))
    };
    Ok((canvas.frame, notes::notes(scene, &view, &outcome)))
}

/// The scene with vertices of one velocity each, copied only if it has velocities.
fn with_separate_bodies(scene: &Scene) -> Cow<'_, Scene> {
    if scene.velocities.is_empty() {
        return Cow::Borrowed(scene);
    }
    let mut scene = scene.clone();
    ugscene::separate_bodies(&mut scene);
    Cow::Owned(scene)
}

/// White light of one level goes into the value.
fn pack_plain(swatch: &Swatch, level: DVec3) -> [f64; 3] {
    [swatch.tint, swatch.saturation, swatch.value * level.x]
}

/// Coloured light is carried beside the colour.
fn pack_colored(swatch: &Swatch, level: DVec3) -> [f64; 6] {
    [swatch.tint, swatch.saturation, swatch.value, level.x, level.y, level.z]
}

/// A frame to be drawn in.
struct Canvas<'a> {
    frame: Frame,
    backdrop: Backdrop,
    grid: &'a Grid,
}

impl<'a> Canvas<'a> {
    fn new(grid: &'a Grid, background: Background) -> Self {
        let (width, height) = (grid.width, grid.height);
        match background {
            Background::Clear => Self { frame: Frame::clear(width, height), backdrop: Backdrop::Clear, grid },
            Background::Color(color) => {
                let light = color.to_rgb().map(|channel| srgb_decode(channel) as f32);
                Self { frame: Frame::opaque(width, height), backdrop: Backdrop::Light(light), grid }
            }
        }
    }

    fn draw<const N: usize>(
        &mut self,
        DrawList { lists, reach }: DrawList<N>,
        shader: impl Fn(&[f32; N]) -> Shade + Sync,
    ) -> Outcome {
        let lists: Vec<PolygonList<N>> = lists.into_iter().filter(|list| !list.is_empty()).collect();
        let tally: Tally = paint(&mut self.frame, self.grid, &lists, self.backdrop, &shader);
        Outcome { reach, tally }
    }
}

/// Our name and version, and the command lines of the whole pipe.
fn label(scene: &Scene, config: &Config) -> Label {
    let mut lines = ugscene::history(scene);
    if !config.command_line.is_empty() {
        lines.push(&config.command_line);
    }
    Label { software: concat!("ugrainbow ", env!("CARGO_PKG_VERSION")).to_owned(), comment: lines.join("\n") }
}
