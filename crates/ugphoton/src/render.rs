//! From a scene to a picture.

use std::borrow::Cow;

use glam::DVec3;
use ugimage::{LinearFrame, Metadata, Plane, Samples};
use ugparse::{Diagnostics, Parsed, Source};
use ugphysics::WorldLineError;
use ugpicture::{
    Annotated, Canvas, Drawn, DrawnContent, FoundItems, Note, PictureFile, Rendering, Subject,
    metadata,
};
use ugpipe::Progress;
use ugscene::{BodyBoxes, PlacedBodies, Provenance, Scene, ShownPoint, View};
use ugskybox::SkyCamera;

use crate::config::Config;
use crate::error::Error;
use crate::lens::Lens;
use crate::notes::notes;
use crate::pixel_centers::PixelCenters;
use crate::scenery::Scenery;
use crate::{pixels, wires};

/// This program, without a command line, for the history of what it makes.
pub const PROVENANCE: Provenance<'static> = Provenance {
    program: env!("CARGO_PKG_NAME"),
    version: env!("CARGO_PKG_VERSION"),
    command: None,
    files: &[],
};

/// Renders a scene at rest.
///
/// # Errors
/// See [`Error`].
pub fn render(scene: Scene, config: &Config) -> Result<Rendering, Error> {
    render_with(scene, config, &())
}

/// Like [`render`], and reports progress.
///
/// # Errors
/// See [`Error`].
pub fn render_with(
    scene: Scene,
    config: &Config,
    progress: &dyn Progress,
) -> Result<Rendering, Error> {
    PreparedScene::new(scene, config, config.canvas()?, PROVENANCE, progress)?.picture(progress)
}

/// The linear light of a scene, without exposure and gamut mapping: white is 1. Options for the
/// file, exposure, tone curve and annotations are ignored.
///
/// # Errors
/// See [`Error`].
pub fn light(scene: Scene, config: &Config) -> Result<LinearFrame, Error> {
    let mut config = config.clone();
    config.picture.keep_light();
    let drawing = PreparedScene::new(scene, &config, config.canvas()?, PROVENANCE, &())?;
    let mut frame = pixels::light(&drawing.scenery, &drawing.config, &()).0;
    drawing.push_radiances(&mut frame, &())?;
    drawing.put_sky_behind(&mut frame, &())?;
    Ok(frame)
}

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
    let (drawing, warnings) = PreparedScene::read(config, source, provenance, true, progress)?;
    let rendering = drawing.picture(progress)?;
    // The file needs its memory.
    drop(drawing);
    Ok(rendering.pack(warnings, progress))
}

/// A scene that is prepared for drawing, as a preview or as the full picture.
pub struct PreparedScene {
    /// Options of the part of the picture that shows the scene, without rows for annotations.
    config: Config,
    canvas: Canvas,
    scenery: Scenery<'static>,
    metadata: Metadata,
    /// Notes on what was added to the scene.
    notes: Vec<Note>,
    /// Of a scene that was read, for the note on bodies that are outside the picture.
    boxes: Option<BodyBoxes>,
}

impl PreparedScene {
    /// Sides of the squares of previews, in pixels, from coarse to fine.
    pub const PREVIEWS: [u32; 3] = [8, 4, 2];

    /// Reads a scene; returns warnings about its text as well. `provenance`: for the history in the
    /// file. `notes_view`: a note says when bodies outside the picture are in it, which takes
    /// longer to find than a small picture takes to draw.
    ///
    /// # Errors
    /// See [`Error`].
    pub fn read(
        config: &Config,
        source: &Source,
        provenance: Provenance<'_>,
        notes_view: bool,
        progress: &dyn Progress,
    ) -> Result<(Self, Diagnostics), Error> {
        let canvas = config.canvas()?;
        progress.step("reading", 0);
        let parsed = read(config, source)?;
        let boxes = notes_view.then(|| BodyBoxes::new(&parsed.scene));
        match Self::new(parsed.scene, config, canvas, provenance, progress) {
            Ok(drawing) => Ok((Self { boxes, ..drawing }, parsed.warnings)),
            // A warning says what a mesh without faces has.
            Err(Error::Picture(error @ ugpicture::Error::Empty(_)))
                if !parsed.warnings.is_empty() =>
            {
                Err(parsed.warnings.with_error(source, error.to_string()).into())
            }
            Err(error) => Err(error),
        }
    }

    /// Prepares a scene. `canvas`: of these options.
    fn new(
        scene: Scene,
        config: &Config,
        canvas: Canvas,
        provenance: Provenance<'_>,
        progress: &dyn Progress,
    ) -> Result<Self, Error> {
        progress.step("preparing", 0);
        let metadata =
            Metadata { panorama: config.panorama(), ..metadata(&scene.head, provenance) };
        let mut config = config.on(&canvas);
        config.sky.or_stated(scene.sky.as_ref());
        let (mut scene, mut notes) = (scene, Vec::new());
        if config.ground {
            // The camera of a scene that has none shows the scene, not the ground.
            let (size, options) = (config.frame_size(), &mut config.picture.camera);
            let motions = std::slice::from_ref(&config.motion);
            if let Some(camera) = ugscene::common_camera(&scene, options, size, motions)? {
                (options.eye, options.center) = (Some(camera.eye), Some(camera.center));
                notes.push(Note::Scene(ugscene::Note::DefaultCamera(camera)));
            }
            ugscene::add_ground(&mut scene);
        }
        notes.extend(scene.has_rounds_on_world_lines().then_some(Note::CutRounds));
        let scenery = Scenery::new(Cow::Owned(as_seen(scene, &config)?), &config)?;
        Ok(Self { config, canvas, scenery, metadata, notes, boxes: None })
    }

    /// The note on bodies that are outside a flat picture, with the times at which they are in it.
    fn out_of_view(&self) -> Option<ugscene::Note> {
        let Config { lens, stereo, picture, motion, .. } = &self.config;
        let is_flat = *lens == Lens::Pinhole && stereo.is_none();
        let boxes = self.boxes.as_ref().filter(|_| is_flat)?;
        boxes.note(&self.scenery.scene, motion, &picture.camera, picture.size)
    }

    /// Draws a preview: of the size of the picture, in squares of `side` pixels with one sample
    /// each, and without channels (`-ch`).
    ///
    /// # Errors
    /// See [`Error`].
    pub fn preview(&self, side: u32, progress: &dyn Progress) -> Result<Rendering, Error> {
        let mut frame = pixels::preview(&self.scenery, &self.config, side.max(1), progress);
        self.put_sky_behind(&mut frame, progress)?;
        self.finish(frame, Vec::new(), 0.0, progress)
    }

    /// Draws the picture.
    ///
    /// # Errors
    /// See [`Error`].
    pub fn picture(&self, progress: &dyn Progress) -> Result<Rendering, Error> {
        let (mut frame, statistics) = pixels::light(&self.scenery, &self.config, progress);
        self.push_radiances(&mut frame, progress)?;
        let brightest = self.put_sky_behind(&mut frame, progress)?;
        let mut notes = notes(&self.scenery, &self.config, &statistics);
        notes.extend(self.out_of_view().map(Note::Scene));
        notes.extend(self.config.sky.notes().chain(self.notes.iter().cloned()));
        self.finish(frame, notes, brightest.max(statistics.max_light as f32), progress)
    }

    /// Adds the channels of radiances, if they are asked for; three are drawn at a time.
    fn push_radiances(
        &self,
        frame: &mut LinearFrame,
        progress: &dyn Progress,
    ) -> Result<(), Error> {
        if !self.config.radiances {
            return Ok(());
        }
        if self.config.sky.is_some() {
            return Err(Error::SkyWavelengths);
        }
        for &nm in uglight::sampled_wavelengths().as_chunks::<3>().0 {
            let mut config = Config { shift: self.config.shift.sampled(nm), ..self.config.clone() };
            config.picture.channels.clear();
            let scenery = Scenery::new(Cow::Borrowed(&*self.scenery.scene), &config)?;
            let (light, _) = pixels::light(&scenery, &config, progress);
            for (channel, nm) in nm.into_iter().enumerate() {
                let numbers = light.pixels().iter().map(|&pixel| light.light_of(pixel)[channel]);
                let samples = Samples::Float(numbers.collect());
                frame.push_plane(Plane { name: format!("S0.{nm}nm"), samples });
            }
        }
        Ok(())
    }

    /// Puts the sky behind the light of the picture. Returns its brightest channel.
    fn put_sky_behind(
        &self,
        frame: &mut LinearFrame,
        progress: &dyn Progress,
    ) -> Result<f32, Error> {
        let Self { config, scenery, .. } = self;
        if !config.sky.is_some() {
            return Ok(0.0);
        }
        let camera = SkyCamera {
            view: &View::new(&scenery.scene, &config.picture.camera, config.frame_size())?,
            lens: config.lens,
            is_stereo: config.stereo.is_some(),
            crop: config.crop,
            velocity: ugscene::camera_velocity(&scenery.scene),
            shift: config.shift,
            keeps_light: scenery.keeps_highlights,
            picture: &config.picture,
        };
        Ok(config.sky.put_behind(frame, &camera, progress)?)
    }

    /// Develops and annotates the light of a picture.
    fn finish(
        &self,
        frame: LinearFrame,
        notes: Vec<Note>,
        brightest: f32,
        progress: &dyn Progress,
    ) -> Result<Rendering, Error> {
        let Self { config, canvas, scenery, metadata, .. } = self;
        let picture = &config.picture;
        let items = |each_sample: bool, found: &mut dyn FnMut(&FoundItems<'_>)| {
            let ([width, height], samples) = if each_sample {
                (picture.size.map(|side| side * picture.samples), 1)
            } else {
                (picture.size, picture.samples)
            };
            let centers = PixelCenters::new(scenery, [0, 0, width, height], samples);
            found(&|idx| centers.item(idx));
            Ok(())
        };
        let is_single =
            config.lens == Lens::Pinhole && config.stereo.is_none() && config.crop.is_none();
        let wires = |scene: &_, camera: &_| wires::visible(scene, camera, config);
        let subject = Subject::Surfaces {
            view: &scenery.view,
            items: &items,
            scene: Some(&scenery.scene),
            wires: if is_single { Some(&wires) } else { None },
            shows_hidden: false,
        };
        let annotated = Annotated { is_shifted: config.shift.shifts_wavelengths(), subject };
        let is_uncut =
            scenery.keeps_highlights || config.sky.is_some() && config.shift.is_spectral();
        let content = DrawnContent::Light { frame, is_clipped: !is_uncut };
        canvas.finish(Drawn { content, brightest, notes, annotated }, metadata.clone(), progress)
    }
}

/// Reads a scene with its round faces.
pub fn read(config: &Config, source: &Source) -> Result<Parsed, Diagnostics> {
    ugparse::read(source, &config.reading, config.picture.camera.name.as_deref())
}

/// The scene with its vertices where they are seen and where they rest, and the stage that says so.
pub fn as_seen(mut scene: Scene, config: &Config) -> Result<Scene, Error> {
    scene.infrared = config.shift.infrared();
    if config.picture.annotations.outline {
        ugscene::cut_rounds(&mut scene, |_, _, _| Some(ugscene::FINE_SAGITTA))?;
    }
    crate::rounds::cut_on_world_lines(&mut scene, config)?;
    let is_apart = config.repeat || scene.has_changing_surfaces();
    ugscene::repeat_vertices(&mut scene, is_apart);
    let picture = &config.picture;
    let placed = PlacedBodies::move_to_camera_frame(
        &mut scene,
        &config.motion,
        &picture.camera,
        config.frame_size(),
    )?;
    let rest = placed.rest_positions(&scene);
    if config.smooth {
        let normals = ugscene::smooth_normals(&scene, &rest);
        for ((vertex, normal), body) in scene.vertices.iter_mut().zip(normals).zip(&placed.bodies) {
            let normal = placed.motions[body.index()].turned_back(normal);
            vertex.normal = vertex.normal.or((normal != DVec3::ZERO).then_some(normal));
        }
    }
    let mut points = Vec::with_capacity(rest.len());
    for ((rest, &body), vertex) in rest.into_iter().zip(&placed.bodies).zip(&scene.vertices) {
        let (seen, own_time) = placed.motions[body.index()].light(rest).map_err(|error| {
            let name = scene.names.get(vertex.name).to_string();
            match error {
                WorldLineError::NotFinite => Error::OutOfRange { name },
                _ => Error::WorldLine { vertex: name, error },
            }
        })?;
        points.push(ShownPoint { body, rest, seen, own_time });
    }
    if let Some(row) = placed.show(&mut scene, &points, points.len()) {
        return Err(Error::OutOfRange {
            name: scene.names.get(scene.vertices[row].name).to_string(),
        });
    }
    Ok(scene)
}
