//! From a scene to a picture.

use ugimage::LinearFrame;
use ugparse::{Diagnostics, Parsed, Source};
use ugpicture::{
    Annotated, Canvas, Drawn, FoundItems, Output, PictureFile, Rendering, Subject, metadata,
};
use ugpipe::Progress;
use ugscene::{Provenance, Scene};

use crate::annotate::{find_items, visible_wires};
use crate::config::{Config, HiddenLines};
use crate::depth_cue::prepare;
use crate::drawn_scene::DrawnScene;
use crate::error::Error;
use crate::notes::notes;
use crate::render_layers::RenderLayers;
use crate::{pixels, vector};

/// This program, without a command line, for the history of what it makes.
pub const PROVENANCE: Provenance<'static> = Provenance {
    program: env!("CARGO_PKG_NAME"),
    version: env!("CARGO_PKG_VERSION"),
    command: None,
    files: &[],
};

/// Renders a scene: to pixels for a display, light, or a vector figure.
///
/// # Errors
/// See [`Error`].
pub fn render(scene: &Scene, config: &Config) -> Result<Rendering, Error> {
    render_with(scene, config, &())
}

/// Like [`render`], and reports progress.
///
/// # Errors
/// See [`Error`].
pub fn render_with(
    scene: &Scene,
    config: &Config,
    progress: &dyn Progress,
) -> Result<Rendering, Error> {
    draw(scene, config, &Canvas::new(&config.picture)?, PROVENANCE, progress)
}

/// The linear light of a scene, without exposure and gamut mapping: white is 1. Options for the
/// file, exposure, tone curve and annotations are ignored.
///
/// # Errors
/// See [`Error`].
pub fn light(scene: &Scene, config: &Config) -> Result<LinearFrame, Error> {
    let mut config = config.with_textures(scene);
    config.picture.keep_light();
    config.picture.check()?;
    config.sky.or_stated(scene.sky.as_ref());
    let setup = prepare(scene, &config)?;
    let layers = RenderLayers::new(&setup, &config)?;
    Ok(pixels::light_with_sky(&setup, &layers, &config, &())?.0)
}

/// Reads a scene, renders it, and packs it into a file.
///
/// # Errors
/// See [`Error`].
pub fn run(config: &Config, source: &Source) -> Result<PictureFile, Error> {
    run_with(config, source, PROVENANCE, &())
}

/// Like [`run`], and reports progress. `provenance`: for the history in the file.
///
/// # Errors
/// See [`Error`].
pub fn run_with(
    config: &Config,
    source: &Source,
    provenance: Provenance<'_>,
    progress: &dyn Progress,
) -> Result<PictureFile, Error> {
    let canvas = Canvas::new(&config.picture)?;
    progress.step("reading", 0);
    let parsed = ugparse::read(source, &config.reading, config.picture.camera.name.as_deref())?;
    let rendering = match draw(&parsed.scene, config, &canvas, provenance, progress) {
        // A warning says what a mesh without faces has.
        Err(Error::Picture(error @ ugpicture::Error::Empty(_))) if !parsed.warnings.is_empty() => {
            return Err(parsed.warnings.with_error(source, error.to_string()).into());
        }
        drawn => drawn.map_err(|error| error.at_rounds(source, &parsed))?,
    };
    Ok(rendering.pack(warnings(source, parsed), progress))
}

/// Warnings of the parser, and one if moving bodies are drawn at rest.
pub(crate) fn warnings(source: &Source, parsed: Parsed) -> Diagnostics {
    match ugparse::rest_shapes_warning(&parsed) {
        Some(warning) => parsed.warnings.with(source, warning),
        None => parsed.warnings,
    }
}

/// Renders a scene on a canvas. `config`: of the whole picture.
fn draw(
    scene: &Scene,
    config: &Config,
    canvas: &Canvas,
    provenance: Provenance<'_>,
    progress: &dyn Progress,
) -> Result<Rendering, Error> {
    progress.step("preparing", 0);
    let mut config = Config { picture: canvas.options().clone(), ..config.with_textures(scene) };
    config.sky.or_stated(scene.sky.as_ref());
    let config = &config;
    let drawn = match config.picture.output {
        Output::Vector(format) => vector::draw(scene, config, format, progress)?,
        Output::Color(_) => draw_pixels(scene, config, progress)?,
    };
    let mut notes = notes(&drawn, config);
    notes.extend(config.sky.notes());
    let DrawnScene { setup, stats, content, .. } = drawn;
    let items = |each_sample: bool, found: &mut dyn FnMut(&FoundItems<'_>)| {
        find_items(setup.scene(), config, each_sample, found)
    };
    let wires = |scene: &_, camera: &_| visible_wires(scene, camera, config);
    let is_shifted = match config.exact {
        Some(shift) => shift.shifts_wavelengths(),
        None => setup.scene().stage.seen_colors().is_some_and(|seen| seen.doppler),
    };
    let subject = Subject::Surfaces {
        view: &setup.view,
        items: &items,
        scene: Some(setup.scene()),
        wires: Some(&wires),
        shows_hidden: config.wireframe.is_some_and(|lines| lines.hidden != HiddenLines::default()),
    };
    let annotated = Annotated { is_shifted, subject };
    let drawn = Drawn { content, brightest: stats.max_intensity, notes, annotated };
    canvas.finish(drawn, metadata(&scene.head, provenance), progress)
}

fn draw_pixels<'a>(
    scene: &'a Scene,
    config: &Config,
    progress: &dyn Progress,
) -> Result<DrawnScene<'a>, Error> {
    let setup = prepare(scene, config)?;
    let layers = RenderLayers::new(&setup, config)?.with_progress(progress);
    let (content, stats) = pixels::draw(&setup, &layers, config, progress)?;
    drop(layers);
    Ok(DrawnScene { setup, stats, content })
}
