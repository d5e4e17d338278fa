//! From a scene to a picture.

use ugimage::{Frame, LinearFrame};
use ugparse::{Diagnostics, Parsed, Source};
use ugpicture::{Content, Layout, Output, PictureFile, Rendering, metadata};
use ugpipe::Progress;
use ugscene::{Provenance, Scene};

use crate::annotate::annotate;
use crate::config::Config;
use crate::depth_cue::prepare;
use crate::error::Error;
use crate::notes::{DrawStatistics, notes};
use crate::pixels::{self, Pixels};
use crate::render_layers::RenderLayers;
use crate::setup::Setup;
use crate::vector;

/// Renders a scene: to pixels for a display, light, or a vector figure.
///
/// # Errors
/// See [`Error`].
pub fn render(scene: &Scene, config: &Config) -> Result<Rendering, Error> {
    config.picture.check()?;
    render_with(scene, config, &Layout::new(&config.picture)?, &())
}

/// This program, without a command line, for the history of what it makes.
pub const PROVENANCE: Provenance<'static> =
    Provenance { program: env!("CARGO_PKG_NAME"), version: env!("CARGO_PKG_VERSION"), command: None };

/// The linear light of a scene, without exposure and gamut mapping: white is 1. Options for the
/// file, exposure, tone curve and annotations are ignored.
///
/// # Errors
/// See [`Error`].
pub fn light(scene: &Scene, config: &Config) -> Result<LinearFrame, Error> {
    let mut config = config.clone();
    config.picture.keep_light();
    config.picture.check()?;
    let setup = prepare(scene, &config)?;
    let layers = RenderLayers::new(setup.painter(), &config.draw_mode());
    Ok(pixels::light(&setup, &layers, &config).0)
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
    let layout = Layout::new(&config.picture)?;
    progress.step("reading", 0);
    let parsed = ugparse::read(source, &config.reading, config.picture.camera.name.as_deref())?;
    config.picture.check()?;
    let rendering = render_with(&parsed.scene, config, &layout, progress)?;
    progress.step("compression", 0);
    let notes = rendering.notes.clone();
    let bytes = rendering.into_file(&metadata(&parsed.scene.remarks, provenance));
    Ok(PictureFile { bytes, notes, warnings: warnings(source, parsed) })
}

/// Warnings of the parser, and one if moving bodies are drawn at rest.
pub(crate) fn warnings(source: &Source, parsed: Parsed) -> Diagnostics {
    match ugparse::rest_shapes_warning(&parsed) {
        Some(warning) => parsed.warnings.with(source, warning),
        None => parsed.warnings,
    }
}

/// Renders a scene in a layout. `config`: of the whole picture, already checked.
fn render_with(
    scene: &Scene,
    config: &Config,
    layout: &Layout,
    progress: &dyn Progress,
) -> Result<Rendering, Error> {
    progress.step("preparing", 0);
    let config = &Config { picture: layout.of_scene(&config.picture).into_owned(), ..config.clone() };
    let (setup, statistics, annotations, content) = match config.picture.output {
        Output::Vector(format) => {
            let drawn = vector::draw(scene, config, format, layout, progress)?;
            (drawn.setup, drawn.statistics, drawn.annotations, Content::Figure(drawn.figure))
        }
        Output::Color(_) | Output::Grey => {
            let setup = prepare(scene, config)?;
            let layers = RenderLayers::new(setup.painter(), &config.draw_mode()).telling(progress);
            let Pixels { image, stats, development } = Pixels::new(&setup, &layers, config);
            let statistics = DrawStatistics { clip_counts: layers.clip_counts(), stats, development };
            drop(layers);
            progress.step("annotating", 0);
            let annotations = annotate(layout, &setup, config, development)?;
            let content = Content::Image(annotations.composite(image));
            (setup, statistics, annotations, content)
        }
    };
    let mut notes = notes(&setup, config, &statistics);
    notes.extend(annotations.notes);
    Ok(Rendering::new(content, &config.picture, notes))
}

/// A scene prepared for drawing: its colours and lights are computed, but nothing is projected yet.
pub struct Prepared<'a> {
    setup: Setup<'a>,
    config: &'a Config,
}

impl<'a> Prepared<'a> {
    /// Prepares a scene.
    ///
    /// # Errors
    /// As [`render`].
    pub fn new(scene: &'a Scene, config: &'a Config) -> Result<Self, Error> {
        config.picture.check()?;
        Ok(Self { setup: prepare(scene, config)?, config })
    }

    /// Draws the scene: from vertices to 8 bits per channel.
    pub fn draw(&self) -> Frame {
        let layers = RenderLayers::new(self.setup.painter(), &self.config.draw_mode());
        Pixels::new(&self.setup, &layers, self.config).image.into_frame()
    }
}
