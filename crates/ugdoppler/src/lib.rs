//! Colours of a UniGrafix scene as seen in relativistic motion.
//!
//! Every vertex gets the colour that its body's colour looks like from there:
//! the hue becomes a wavelength (P16), is divided by the Doppler factor
//! D (P10), (P11), and becomes a hue again; the value is multiplied by D
//! (P12). Saturation stays, and a colour without saturation has no wavelength
//! to shift. The eye's fading towards infrared and ultraviolet (P17) is left to
//! the renderer, which applies it at every pixel.
//!
//! With [`Config::light`] the colours get the light of the scene's lights as well. A light
//! that moves against a surface has a Doppler factor D_l of its own there, and falls in
//! from where it was when it shone (P14); it shifts and dims the colour like D does.
//!
//! With [`Config::spectral`] colours are spectra instead: of surfaces (P20), of black
//! bodies (P13), or given by samples. Each is shifted as a whole and multiplied by D⁵
//! (P12), and what the eye makes of it is written as X, Y, Z (P19).
//!
//! The input is what `uglorentz` writes: vertices where they are seen, faces
//! with their velocity, the eye in the camera.
//!
//! ```
//! let text = "c green 1 120; v a 9 0 0; v b 10 0 0; v c 10 1 0; f (a b c) green <-0.5 0 0>;";
//! let source = ugparse::Source::new("scene.ug", text);
//! let config = ugdoppler::Config { tolerance: 0.0, wavelengths: true, ..Default::default() };
//! let seen = String::from_utf8(ugdoppler::run(&config, &source)?.text())?;
//! // It comes straight at the eye, so D = √3 and 546.1 nm is seen at 315.3 nm.
//! assert!(seen.contains("c green#1_73205080756887") && seen.contains(" 1 315.29098200445"), "{seen}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod cli;
mod illumination;
mod lit;
mod lit_spectra;
mod look;
mod notes;
mod palette;
mod ruler;
mod spectral;

use std::fmt;

use glam::DVec3;
use rayon::prelude::*;
use uglight::{HueScale, VertexColor};
use ugparse::{Diagnostics, Face, Options, Scene, Source};
use ugphysics::{Brightness, Hsv, Velocity, VelocityError, doppler_at};
use ugpipe::Progress;
use ugscene::RestFrames;

pub use cli::{Args, main};

use illumination::Illumination;
use lit::Seen;
use palette::Palette;

/// What to do.
#[derive(Clone, Debug)]
pub struct Config {
    /// Velocity where faces carry none.
    pub velocity: Velocity,
    /// Name of the camera that counts, of several (`-cam`).
    pub camera: Option<String>,
    /// The eye; else the scene's camera says.
    pub eye: Option<DVec3>,
    /// Write wavelengths in nm in place of hues (`-gw`).
    pub wavelengths: bool,
    /// How D changes brightness, (P12).
    pub law: Brightness,
    /// Repeat a vertex for every colour of its faces, instead of mixing them (`-vr`).
    pub repeat: bool,
    /// Reuse a colour whose wavelength is within this many nm, and whose value
    /// is within as many percent; with spectra, whose X, Y and Z are. 0 gives every
    /// vertex its own (`-ct`).
    pub tolerance: f64,
    /// Scale all values so that the largest is 1, instead of clipping (`-ir`).
    pub iris: bool,
    /// Put the light of the scene's lights, moving ones included, into the colours (`-li`).
    pub light: bool,
    /// Keep values above 1, instead of clipping (`-hd`).
    pub keep: bool,
    /// Shift spectra in place of hues, and write X, Y, Z (`-sp`). The law is that of spectral radiance, D⁵, and
    /// nothing is clipped.
    pub spectral: bool,
    /// Shift wavelengths.
    pub doppler: bool,
    /// Change brightness.
    pub flux: bool,
    /// How the scene is read.
    pub reading: Options,
    /// How the program was called, for the scene's history.
    pub command_line: String,
}

/// A tenth of a nanometre moves the hue by less than one 8-bit step, a tenth
/// of a percent the value by a quarter of one.
pub const DEFAULT_TOLERANCE: f64 = 0.1;

impl Default for Config {
    fn default() -> Self {
        Self {
            velocity: Velocity::ZERO,
            camera: None,
            eye: None,
            wavelengths: false,
            law: Brightness::Report,
            repeat: false,
            tolerance: DEFAULT_TOLERANCE,
            iris: false,
            light: false,
            keep: false,
            spectral: false,
            doppler: true,
            flux: true,
            reading: Options::default(),
            command_line: PROGRAM.to_string(),
        }
    }
}

pub(crate) const PROGRAM: &str = env!("CARGO_PKG_NAME");

/// Why no scene came out.
#[derive(Debug)]
pub enum Error {
    /// The text is no scene that can be used.
    Scene(Diagnostics),
    /// A velocity of the scene is not below the speed of light.
    Velocity(VelocityError),
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(findings) => findings.fmt(f),
            Self::Velocity(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for Error {}

impl From<Diagnostics> for Error {
    fn from(findings: Diagnostics) -> Self {
        Self::Scene(findings)
    }
}

impl From<VelocityError> for Error {
    fn from(error: VelocityError) -> Self {
        Self::Velocity(error)
    }
}

/// What came of it.
#[derive(Clone, Debug)]
pub struct Report {
    /// The scene with a colour on every vertex that a face or wire uses.
    pub scene: Scene,
    /// What the user should know.
    pub notes: Vec<String>,
    /// What the reader changed to make the scene usable.
    pub warnings: Diagnostics,
}

impl Report {
    /// The scene as text.
    pub fn text(&self) -> Vec<u8> {
        ugparse::write(&self.scene)
    }
}

/// Reads a scene as `uglorentz` writes it, and colours it.
///
/// # Errors
/// What is wrong with the scene: [`Error`].
pub fn run(config: &Config, source: &Source) -> Result<Report, Error> {
    run_with(config, source, &())
}

/// [`run`], which tells somebody how far it is.
///
/// # Errors
/// What is wrong with the scene: [`Error`].
pub fn run_with(config: &Config, source: &Source, progress: &dyn Progress) -> Result<Report, Error> {
    progress.step("reading", 0);
    let parsed = ugscene::read(source, &config.reading, config.camera.as_deref())?;
    let frames = RestFrames::new(&parsed.scene)?.with_unstated(config.velocity);
    let eye = ugscene::eye(&parsed.scene, config.eye);
    if let Some(vertex) = ugscene::vertex_at_eye(&parsed.scene, eye, &frames) {
        return Err(ugscene::at_eye_error(source, &parsed, vertex).into());
    }
    progress.step("colouring", 0);
    let (scene, notes) = colour(parsed.scene, config, eye, &frames);
    Ok(Report { scene, notes, warnings: parsed.warnings })
}

fn colour(mut scene: Scene, config: &Config, eye: DVec3, frames: &RestFrames) -> (Scene, Vec<String>) {
    ugscene::separate_bodies(&mut scene);
    repeat_vertices(&mut scene, config.repeat);
    let rest = ugscene::rest_positions(&scene, eye, frames);
    let mut notes = if config.spectral {
        let mut shares = ugscene::vertex_shares(&scene, &rest);
        let light = put_light(&mut scene, config, eye, frames, rest, &mut shares);
        let (factors, used) = (doppler_factors(&scene, eye, frames), used_vertices(&scene));
        let lit = light.map(|light| lit_spectra::seen(&scene, config, &shares, &factors, &light));
        spectral::paint(&mut scene, config, &shares, &factors, &used, lit.as_deref())
    } else {
        let mut colors = uglight::vertex_colors(&scene, &rest, HueScale::Degrees);
        let light = put_light(&mut scene, config, eye, frames, rest, &mut colors);
        let (factors, used) = (doppler_factors(&scene, eye, frames), used_vertices(&scene));
        let lit = light.map(|light| lit_colors(&scene, config, &colors, &factors, &light));
        let spectra_note = uglight::spectra_note(&scene);
        let mut palette = Palette::new(&mut scene, config);
        for (row, (&color, &doppler)) in colors.iter().zip(&factors).enumerate() {
            match lit.as_ref().and_then(|lit| lit[row]) {
                _ if !used[row] => {}
                Some(seen) => palette.paint_lit(row, color, seen),
                None => palette.paint(row, color, doppler),
            }
        }
        palette.finish().into_iter().chain(spectra_note).collect()
    };
    if config.light && scene.lights.is_empty() {
        notes.push("no lights in the scene, so -li puts none into its colours".to_string());
    } else if config.light {
        illumination::replace_lights(&mut scene);
    }
    ugscene::record(&mut scene, PROGRAM, env!("CARGO_PKG_VERSION"), &config.command_line);
    (scene, notes)
}

/// The light on the vertices, if it is wanted and there is some. Vertices on which it differs are repeated, and what
/// is known of each vertex with them.
fn put_light<T: Clone>(
    scene: &mut Scene,
    config: &Config,
    eye: DVec3,
    frames: &RestFrames,
    mut rest: Vec<DVec3>,
    of_vertex: &mut Vec<T>,
) -> Option<Illumination> {
    if !config.light || scene.lights.is_empty() {
        return None;
    }
    let (originals, normals) = illumination::split(scene, &rest);
    for original in originals {
        rest.push(rest[original.index()]);
        of_vertex.push(of_vertex[original.index()].clone());
    }
    Some(Illumination::new(scene, eye, frames, &rest, &normals))
}

/// Of every vertex, with its light; `None` where it is not lit.
fn lit_colors(
    scene: &Scene,
    config: &Config,
    colors: &[VertexColor],
    factors: &[f64],
    light: &Illumination,
) -> Vec<Option<Seen>> {
    let all = colors.par_iter().zip(factors).zip(&light.of_vertex);
    all.map(|((&color, &doppler), parts)| {
        let base = surface_hsv(scene, color);
        Some(lit::look(base, doppler, parts.as_ref()?, &light.lamps, config))
    })
    .collect()
}

fn surface_hsv(scene: &Scene, color: VertexColor) -> Hsv {
    match color {
        VertexColor::Named(id) => uglight::hsv(scene, &scene.colors[id.index()], HueScale::Degrees),
        VertexColor::White => Hsv { hue: 0.0, saturation: 0.0, value: 1.0 },
        VertexColor::Mixed { hsv, .. } => hsv,
    }
}

/// True for vertices that a face or wire uses.
fn used_vertices(scene: &Scene) -> Vec<bool> {
    let mut used = vec![false; scene.vertices.len()];
    let faces = scene.faces.iter().map(|face| face.contours.clone());
    let wires = scene.wires.iter().map(|wire| wire.contours.clone());
    for rows in faces.chain(wires) {
        scene.contours.corners(rows).iter().for_each(|corner| used[corner.index()] = true);
    }
    used
}

/// Gives wires vertices of their own, since a vertex can carry one colour only; and with `each_face_color`
/// (`-vr`) a vertex for every face colour that meets there. A normal stays on every copy, so shading stays
/// smooth across them.
fn repeat_vertices(scene: &mut Scene, each_face_color: bool) {
    if scene.wires.is_empty() && !each_face_color {
        return;
    }
    let of_face = |face: &Face| (false, face.color.filter(|_| each_face_color));
    let faces = scene.faces.iter().map(|face| (face.contours.clone(), of_face(face)));
    let wires = scene.wires.iter().map(|wire| (wire.contours.clone(), (true, wire.color)));
    let users: Vec<_> = faces.chain(wires).collect();
    ugscene::split_vertices(scene, &users, |vertex| vertex.color.is_none());
}

/// D of every vertex, in its body's motion. (P10)
pub fn doppler_factors(scene: &Scene, eye: DVec3, frames: &RestFrames) -> Vec<f64> {
    let bodies = ugscene::vertex_bodies(scene);
    (scene.vertices.par_iter().zip(bodies.par_iter()))
        .map(|(vertex, &body)| doppler_at(vertex.position - eye, frames.velocity(body)))
        .collect()
}
