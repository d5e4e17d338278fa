//! From a panorama to a picture.

use std::borrow::Cow;

use glam::DVec3;
use ugimage::{LinearFrame, Metadata};
use uglight::ColorShift;
use ugparse::{Diagnostics, Source};
use ugpicture::{
    Annotated, Canvas, Drawn, DrawnContent, FoundItems, Note, PictureFile, Rendering, Subject,
};
use ugpipe::Progress;
use ugscene::{CameraError, CameraOptions, Head, Provenance, Scene, View};
use ugsky::{Basis, Layer, Sky};
use ugskybox::{Opened, SkyPicture, StarField, Statistics, Warp, sky_colors};
use ugtrace::lens::Film;

use crate::config::Config;
use crate::error::Error;

/// Makes a picture of a panorama, of stars or of both.
///
/// # Errors
/// See [`Error`].
pub fn render<'s>(sky: impl Into<Sky<'s>>, config: &Config) -> Result<Rendering, Error> {
    render_with(sky, config, &())
}

/// Like [`render`], and reports progress.
///
/// # Errors
/// See [`Error`].
pub fn render_with<'s>(
    sky: impl Into<Sky<'s>>,
    config: &Config,
    progress: &dyn Progress,
) -> Result<Rendering, Error> {
    let sky = sky.into();
    let metadata = Metadata { panorama: config.panorama(), ..metadata(&[], PROVENANCE) };
    Prepared::new(sky, config, progress)?.render(sky, &metadata, progress)
}

/// The linear light of a picture with its channels, without exposure and gamut mapping: white is 1.
/// Options for the file, exposure, tone curve and annotations are ignored.
///
/// # Errors
/// See [`Error`].
pub fn light<'s>(sky: impl Into<Sky<'s>>, config: &Config) -> Result<LinearFrame, Error> {
    let sky = sky.into();
    let mut config = config.clone();
    config.picture.keep_light();
    config.check()?;
    let (picture, _) = sky_picture(&config)?;
    let warp = Warp::new(sky, &picture)?;
    let (mut frame, _) = seen(sky, &warp, &picture, &());
    push_channels(&mut frame, &warp, &config);
    Ok(frame)
}

/// The light of a sky.
fn seen(
    sky: Sky<'_>,
    warp: &Warp<'_>,
    picture: &SkyPicture,
    progress: &dyn Progress,
) -> (LinearFrame, Statistics) {
    let (mut frame, mut statistics) = warp.light(progress);
    if !sky.stars.is_empty() {
        progress.step("stars", 0);
        statistics.max_light = StarField::new(sky.stars, picture).add(sky.stars, &mut frame);
    }
    (frame, statistics)
}

/// The view of a picture: from the middle of the sky along +y, unless the camera or options say
/// otherwise.
fn view(config: &Config, samples: [u32; 2]) -> Result<View, CameraError> {
    let (camera, options) = (&config.camera, &config.picture.camera);
    let eye = options.eye.or(camera.eye).unwrap_or_default();
    let center = options.center.or(camera.center).unwrap_or(eye + DVec3::Y);
    let options = CameraOptions { eye: Some(eye), center: Some(center), ..options.clone() };
    View::without_scene(camera, &options, samples)
}

/// What the picture of a sky depends on, and whether the camera was parallel to its up direction.
fn sky_picture(config: &Config) -> Result<(SkyPicture, bool), CameraError> {
    let picture = &config.picture;
    let [across, down] = config.lens.frames(false);
    let [width, height] = picture.size;
    let film = |samples: u32| {
        let frame = [width / across * samples, height / down * samples];
        let view = view(config, frame)?;
        Ok::<_, CameraError>((Film::new(config.lens, None, &view, frame), view.is_up_replaced))
    };
    let (samples_film, is_up_replaced) = film(picture.samples)?;
    let sky_picture = SkyPicture {
        part: [0, 0, width, height],
        samples: picture.samples,
        filter: picture.filter,
        background: picture.background,
        lens: config.lens,
        film: samples_film,
        pixel_film: film(1)?.0,
        velocity: config.velocity,
        colors: sky_colors(config.shift, config.basis),
        range_nm: config.range_nm.clone(),
        keeps_light: picture.keeps_light(),
        stars: config.stars,
    };
    Ok((sky_picture, is_up_replaced))
}

/// Adds the channels that the options ask for.
fn push_channels(frame: &mut LinearFrame, warp: &Warp<'_>, config: &Config) {
    ugpicture::push_channels(frame, &config.picture.channels, DVec3::ZERO, &|idx| {
        warp.seen_item(idx)
    });
}

/// This program, without a command line, for the history of what it makes.
pub const PROVENANCE: Provenance<'static> = Provenance {
    program: env!("CARGO_PKG_NAME"),
    version: env!("CARGO_PKG_VERSION"),
    command: None,
    files: &[],
};

/// The record in a picture of how it was made. `files`: hash and name of every file that was read,
/// the panorama first.
pub fn metadata(files: &[String], provenance: Provenance<'_>) -> Metadata {
    let head = Head { files: files.to_vec(), ..Head::default() };
    ugpicture::metadata(&head, provenance)
}

/// Like [`render_with`], with the camera of the scene that was read with the sky, if there is one.
///
/// # Errors
/// See [`Error`].
pub fn render_opened(
    opened: &Opened,
    config: &Config,
    progress: &dyn Progress,
) -> Result<Rendering, Error> {
    render_with(opened, &*seen_from(opened, config)?, progress)
}

/// The options with the camera of a scene.
pub(crate) fn seen_from<'c>(opened: &Opened, config: &'c Config) -> Result<Cow<'c, Config>, Error> {
    let carried = |scene: &Scene| config.with_camera_of(scene).map(Cow::Owned);
    opened.scene.as_deref().map_or(Ok(Cow::Borrowed(config)), carried)
}

/// Makes a picture of a panorama and packs it into a file, which says if it is a panorama itself.
///
/// # Errors
/// See [`Error`].
pub fn run(
    config: &Config,
    opened: &Opened,
    metadata: &Metadata,
    progress: &dyn Progress,
) -> Result<PictureFile, Error> {
    let sky = opened.into();
    let config = &*seen_from(opened, config)?;
    let metadata = &Metadata { panorama: config.panorama(), ..metadata.clone() };
    let prepared = Prepared::new(sky, config, progress)?;
    let warnings = Diagnostics::new(&Source::new("", ""), Vec::new());
    let mut file = prepared.render(sky, metadata, progress)?.pack(warnings, progress);
    file.notes.splice(0..0, opened.notes.iter().cloned().map(Note::Source));
    Ok(file)
}

/// All that a picture needs but the light of the sky.
pub(crate) struct Prepared<'s> {
    /// Options of the picture without its annotations.
    config: Config,
    canvas: Canvas,
    picture: SkyPicture,
    pub(crate) warp: Warp<'s>,
    /// The camera was parallel to its up direction.
    is_up_replaced: bool,
}

impl<'s> Prepared<'s> {
    pub(crate) fn new(
        sky: Sky<'s>,
        config: &Config,
        progress: &dyn Progress,
    ) -> Result<Self, Error> {
        config.check()?;
        let mut config = config.clone();
        let canvas = Canvas::new(&config.picture)?;
        config.picture = canvas.options().clone();
        progress.step("preparing", 0);
        let (picture, is_up_replaced) = sky_picture(&config)?;
        Ok(Self { warp: Warp::new(sky, &picture)?, picture, is_up_replaced, config, canvas })
    }

    /// The panorama, if there is nothing else in the sky and each pixel has its final colour, of 8
    /// bits, as soon as its light is known.
    fn alone(&self, sky: Sky<'_>) -> Option<&Layer<'s>> {
        let is_deep = self.config.picture.output.format().is_deep();
        self.warp.clipped().filter(|_| sky.stars.is_empty() && !is_deep)
    }

    fn render(
        &self,
        sky: Sky<'_>,
        metadata: &Metadata,
        progress: &dyn Progress,
    ) -> Result<Rendering, Error> {
        let Self { config, canvas, picture, warp, is_up_replaced } = self;
        let (content, statistics) = match self.alone(sky) {
            Some(layer) => {
                let (frame, statistics) = warp.frame(layer, progress);
                (DrawnContent::Display(frame), statistics)
            }
            None => {
                let (mut frame, statistics) = seen(sky, warp, picture, progress);
                push_channels(&mut frame, warp, config);
                (DrawnContent::Light { frame, is_clipped: !warp.keeps_highlights() }, statistics)
            }
        };
        let items = |each_sample: bool, found: &mut dyn FnMut(&FoundItems<'_>)| {
            if each_sample {
                found(&|idx| warp.seen_sample(idx))
            } else {
                found(&|idx| warp.seen_item(idx))
            }
            Ok(())
        };
        let view = view(config, config.picture.size)?;
        let subject = Subject::Surfaces {
            view: &view,
            items: &items,
            scene: None,
            wires: None,
            shows_hidden: false,
        };
        let annotated = Annotated { is_shifted: config.shift.shifts_wavelengths(), subject };
        let (brightest, mut notes) =
            (statistics.max_light, notes(config, *is_up_replaced, &statistics));
        if sky.panorama.is_none() && sky.bands.is_empty() && sky.stars.is_empty() {
            notes = vec![Note::NoStars];
        }
        canvas.finish(Drawn { content, brightest, notes, annotated }, metadata.clone(), progress)
    }
}

/// A part of one in so many pixels may be below black beside edges, where the kernel undershoots.
const FEW: u64 = 20;

/// The notes on a picture.
fn notes(config: &Config, is_up_replaced: bool, statistics: &Statistics) -> Vec<Note> {
    let has_amounts =
        matches!(config.basis, Basis::Planck(_)) && matches!(config.shift, ColorShift::Spectra(_));
    let mut notes = Vec::new();
    if is_up_replaced {
        notes.push(Note::UpReplaced);
    }
    if statistics.n_covered == 0 {
        notes.push(Note::NoPanorama);
    } else if statistics.max_light == 0.0 {
        notes.push(Note::BlackPanorama);
    } else if has_amounts && statistics.n_negative > statistics.n_covered / FEW {
        let percent = 100.0 * statistics.n_negative as f64 / statistics.n_covered as f64;
        notes.push(Note::NegativeLight { percent });
    }
    notes
}
