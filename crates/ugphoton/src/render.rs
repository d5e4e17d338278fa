//! From a scene to a picture.

use std::borrow::Cow;

use ugimage::{Development, LinearFrame, Metadata};
use ugparse::{Diagnostics, Source};
use ugpicture::{
    Annotated, Annotations, Content, DepthBuffer, Image, Layout, PictureFile, Rendering, SceneState, metadata,
};
use ugpipe::Progress;
use ugscene::{CameraOptions, PlacedBodies, Provenance, RestPosition, Scene};

use crate::config::Config;
use crate::error::Error;
use crate::lens::Lens;
use crate::notes::notes;
use crate::scenery::Scenery;
use crate::{middles, pixels};

/// Renders a scene at rest.
///
/// # Errors
/// See [`Error`].
pub fn render(scene: Scene, config: &Config) -> Result<Rendering, Error> {
    config.check()?;
    Prepared::new(scene, config, Layout::new(&config.picture)?, &())?.rendering(&())
}

/// The linear light of a scene, without exposure and gamut mapping: white is 1. Options for the
/// file, exposure, tone curve and annotations are ignored.
///
/// # Errors
/// See [`Error`].
pub fn light(scene: Scene, config: &Config) -> Result<LinearFrame, Error> {
    let mut config = config.clone();
    config.picture.keep_light();
    config.check()?;
    let scene = as_seen(scene, &config)?;
    let scenery = Scenery::new(Cow::Owned(scene), &config)?;
    Ok(pixels::light(&scenery, &config, &()).0)
}

/// This program, without a command line, for the history of what it makes.
pub const PROVENANCE: Provenance<'static> =
    Provenance { program: env!("CARGO_PKG_NAME"), version: env!("CARGO_PKG_VERSION"), command: None };

/// Reads a scene, renders it, and packs it into a file. `provenance`: for the history in the file.
///
/// # Errors
/// See [`Error`].
pub fn run(
    config: &Config,
    source: &Source,
    provenance: Provenance<'_>,
    progress: &dyn Progress,
) -> Result<PictureFile, Error> {
    Drawing::read(config, source, provenance, progress)?.picture(progress)
}

/// A scene that is prepared for drawing, as a preview or as the full picture.
pub struct Drawing {
    prepared: Prepared,
    metadata: Metadata,
    warnings: Diagnostics,
}

impl Drawing {
    /// Sides of the squares of previews, in pixels, from coarse to fine.
    pub const PREVIEWS: [u32; 3] = [8, 4, 2];

    /// Reads a scene. `provenance`: for the history in the file.
    ///
    /// # Errors
    /// See [`Error`].
    pub fn read(
        config: &Config,
        source: &Source,
        provenance: Provenance<'_>,
        progress: &dyn Progress,
    ) -> Result<Self, Error> {
        let layout = Layout::new(&config.picture)?;
        progress.step("reading", 0);
        let parsed = ugparse::read(source, &config.reading, config.picture.camera.name.as_deref())?;
        config.check()?;
        let metadata = metadata(&parsed.scene.remarks, provenance);
        let prepared = Prepared::new(parsed.scene, config, layout, progress)?;
        Ok(Self { prepared, metadata, warnings: parsed.warnings })
    }

    /// The file of a preview: of the size of the picture, in squares of `side` pixels with one
    /// sample each, and without channels (`-ch`).
    ///
    /// # Errors
    /// See [`Error`].
    pub fn preview(&self, side: u32, progress: &dyn Progress) -> Result<Vec<u8>, Error> {
        let prepared = &self.prepared;
        let frame = pixels::preview(&prepared.scenery, &prepared.config, side.max(1), progress);
        let (rendering, _) = prepared.developed(frame, progress)?;
        Ok(rendering.into_file(&self.metadata))
    }

    /// Draws the picture.
    ///
    /// # Errors
    /// See [`Error`].
    pub fn picture(self, progress: &dyn Progress) -> Result<PictureFile, Error> {
        let Self { prepared, metadata, warnings } = self;
        let rendering = prepared.rendering(progress)?;
        drop(prepared);
        progress.step("compression", 0);
        let notes = rendering.notes.clone();
        Ok(PictureFile { bytes: rendering.into_file(&metadata), notes, warnings })
    }
}

/// A scene prepared for drawing.
struct Prepared {
    /// Options of the part of the picture that shows the scene, without rows for annotations.
    config: Config,
    layout: Layout,
    scenery: Scenery<'static>,
}

impl Prepared {
    /// `config`: of the whole picture, already checked.
    fn new(scene: Scene, config: &Config, layout: Layout, progress: &dyn Progress) -> Result<Self, Error> {
        progress.step("preparing", 0);
        let config = Config { picture: layout.of_scene(&config.picture).into_owned(), ..config.clone() };
        let scenery = Scenery::new(Cow::Owned(as_seen(scene, &config)?), &config)?;
        Ok(Self { config, layout, scenery })
    }

    fn rendering(&self, progress: &dyn Progress) -> Result<Rendering, Error> {
        let (frame, statistics) = pixels::light(&self.scenery, &self.config, progress);
        let (mut rendering, development) = self.developed(frame, progress)?;
        let about_picture = notes(&self.scenery, &self.config, &statistics, development);
        rendering.notes.splice(0..0, about_picture);
        Ok(rendering)
    }

    /// Develops and annotates the light of a picture; its notes are those of the annotations.
    fn developed(
        &self,
        frame: LinearFrame,
        progress: &dyn Progress,
    ) -> Result<(Rendering, Option<Development>), Error> {
        let Self { config, layout, scenery } = self;
        let (image, development) = Image::developed(frame, &config.picture, !scenery.is_uncut);
        progress.step("annotating", 0);
        let annotations = annotate(layout, scenery, config, development)?;
        let image = Content::Image(annotations.composite(image));
        Ok((Rendering::new(image, &config.picture, annotations.notes), development))
    }
}

/// The scene with its vertices where they are seen, and the stage that says so.
pub fn as_seen(mut scene: Scene, config: &Config) -> Result<Scene, Error> {
    ugscene::repeat_vertices(&mut scene, config.repeat);
    let picture = &config.picture;
    let placed = PlacedBodies::new(&mut scene, &config.motion, &picture.camera, config.frame_size())?;
    let rest = placed.rest_positions(&scene);
    if config.smooth {
        let normals = ugscene::smooth_normals(&scene, &rest);
        for ((vertex, normal), body) in scene.vertices.iter_mut().zip(normals).zip(&placed.bodies) {
            let normal = placed.motions[body.index()].turned_back(normal);
            vertex.normal = vertex.normal.or((normal != glam::DVec3::ZERO).then_some(normal));
        }
    }
    for ((vertex, rest), body) in scene.vertices.iter_mut().zip(rest).zip(&placed.bodies) {
        let motion = &placed.motions[body.index()];
        let is_unmoved = motion.is_at_rest() && placed.shifts[body.index()] == glam::DVec3::ZERO;
        if !is_unmoved {
            vertex.position = motion.seen(RestPosition(rest)).0 + placed.eye;
        }
    }
    if let Some(vertex) = scene.vertices.iter().find(|vertex| !vertex.position.is_finite()) {
        return Err(Error::OutOfRange { name: scene.names.get(vertex.name).to_string() });
    }
    scene.stage.geometry = placed.seen_stage(&config.motion);
    Ok(scene)
}

fn annotate(
    layout: &Layout,
    scenery: &Scenery<'_>,
    config: &Config,
    development: Option<Development>,
) -> Result<Annotations, Error> {
    let is_shifted = config.shift.shifts_wavelengths();
    let picture = &config.picture;
    let seen = (config.lens != Lens::Pinhole && picture.annotations.legend)
        .then(|| middles::seen_items(scenery, picture.size, picture.samples));
    let annotated =
        Annotated { scene: &scenery.scene, camera: &picture.camera, is_shifted, seen: seen.as_deref() };
    let depths = |scene: &Scene, camera: &CameraOptions, _: SceneState| -> Result<DepthBuffer, Error> {
        let mut coarse = config.clone();
        coarse.picture.samples = 1;
        coarse.picture.camera = camera.clone();
        let scenery = Scenery::new(Cow::Borrowed(scene), &coarse)?;
        Ok(middles::depths(&scenery, coarse.picture.size, 1))
    };
    layout.annotate(annotated, &config.picture, development, depths)
}
