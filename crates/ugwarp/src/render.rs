//! From a panorama to a picture.

use rayon::prelude::*;
use ugimage::{Development, Format, LinearFrame, Metadata};
use ugparse::{Diagnostics, Source};
use ugpicture::{
    Annotated, Annotations, Content, DepthBuffer, Error as PictureError, Exposure, Image, Layout, Note,
    Output, PictureFile, Rendering, SceneState, channel_planes,
};
use ugpipe::Progress;
use ugscene::{CameraOptions, Provenance, Remarks, Scene};
use ugsky::{Layer, Sky};

use crate::config::Config;
use crate::error::Error;
use crate::open::Opened;
use crate::stars::StarField;
use crate::warp::{Statistics, Warp, camera};

/// Least brightness at which clipping is reported; less is invisible in 8 bits.
const CLIPPED: f32 = 1.001;

/// Makes a picture of a panorama, of stars or of both.
///
/// # Errors
/// See [`Error`].
pub fn render<'s>(sky: impl Into<Sky<'s>>, config: &Config) -> Result<Rendering, Error> {
    render_with(sky.into(), config, &())
}

/// The linear light of a picture with its channels, without exposure and gamut mapping: white is 1.
/// Options for the
/// file, exposure, tone curve and annotations are ignored.
///
/// # Errors
/// See [`Error`].
pub fn light<'s>(sky: impl Into<Sky<'s>>, config: &Config) -> Result<LinearFrame, Error> {
    let sky = sky.into();
    let mut config = config.clone();
    config.picture.keep_light();
    config.picture.annotations = ugpicture::AnnotationOptions::default();
    let warp = Warp::new(sky, &config)?;
    let (mut frame, _) = seen(sky, &warp, &config, &())?;
    push_channels(&mut frame, &warp, &config);
    Ok(frame)
}

/// The light of a sky.
fn seen(
    sky: Sky<'_>,
    warp: &Warp<'_>,
    config: &Config,
    progress: &dyn Progress,
) -> Result<(LinearFrame, Statistics), Error> {
    let (mut frame, mut statistics) = warp.light(progress);
    if !sky.stars.is_empty() {
        progress.step("stars", 0);
        statistics.max_light = StarField::new(sky.stars, config)?.add(sky.stars, &mut frame);
    }
    Ok((frame, statistics))
}

/// Adds the channels that the options ask for.
fn push_channels(frame: &mut LinearFrame, warp: &Warp<'_>, config: &Config) {
    for &channel in &config.picture.channels {
        let n_pixels = frame.pixels().len();
        let planes = channel_planes(channel, n_pixels, &|idx| warp.seen_item(idx));
        planes.into_iter().for_each(|plane| frame.push_plane(plane));
    }
}

/// This program, without a command line, for the history of what it makes.
pub const PROVENANCE: Provenance<'static> =
    Provenance { program: env!("CARGO_PKG_NAME"), version: env!("CARGO_PKG_VERSION"), command: None };

/// What a picture says about its making. `origin`: hash and name of the panorama.
pub fn metadata(origin: Option<&str>, provenance: Provenance<'_>) -> Metadata {
    let remarks = Remarks { origin: origin.map(str::to_owned), ..Remarks::default() };
    ugpicture::metadata(&remarks, provenance)
}

/// Makes a picture of a panorama and packs it into a file.
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
    let prepared = Prepared::new(sky, config, progress)?;
    let (bytes, notes) = match prepared.alone(sky) {
        Some(layer) if prepared.is_plain_png() => prepared.png(layer, metadata, progress),
        _ => {
            let mut rendering = prepared.render(sky, progress)?;
            progress.step("compression", 0);
            let notes = std::mem::take(&mut rendering.notes);
            (rendering.into_file(metadata), notes)
        }
    };
    Ok(PictureFile {
        bytes,
        notes: opened.notes.iter().cloned().map(Note::Source).chain(notes).collect(),
        warnings: Diagnostics::new(&Source::new("", ""), Vec::new()),
    })
}

fn render_with(sky: Sky<'_>, config: &Config, progress: &dyn Progress) -> Result<Rendering, Error> {
    Prepared::new(sky, config, progress)?.render(sky, progress)
}

/// All that a picture needs but the light of the sky.
struct Prepared<'s> {
    /// Options of the picture without its annotations.
    config: Config,
    layout: Layout,
    warp: Warp<'s>,
}

impl<'s> Prepared<'s> {
    fn new(sky: Sky<'s>, config: &Config, progress: &dyn Progress) -> Result<Self, Error> {
        config.check()?;
        let mut config = config.clone();
        let layout = Layout::new(&config.picture)?;
        config.picture = layout.of_scene(&config.picture).into_owned();
        progress.step("preparing", 0);
        Ok(Self { warp: Warp::new(sky, &config)?, config, layout })
    }

    /// The panorama, if there is nothing else in the sky and each pixel has its final colour, of 8
    /// bits, as soon as its light is known.
    fn alone(&self, sky: Sky<'_>) -> Option<&Layer<'s>> {
        let is_deep = self.config.picture.output.format().is_some_and(|format| format.is_deep());
        self.warp.clipped().filter(|_| sky.stars.is_empty() && !is_deep)
    }

    /// True for a PNG file of 8 bits without annotations.
    fn is_plain_png(&self) -> bool {
        let picture = &self.config.picture;
        picture.output == Output::Color(Format::Png) && !picture.annotations.is_any()
    }

    /// The file of a picture that [`is_plain_png`](Self::is_plain_png), and notes for the user.
    fn png(&self, layer: &Layer<'s>, metadata: &Metadata, progress: &dyn Progress) -> (Vec<u8>, Vec<Note>) {
        let (file, statistics) = self.warp.png(layer, progress, metadata, self.config.picture.compression());
        (file, notes(&self.warp, &self.config, &statistics, None))
    }

    fn render(&self, sky: Sky<'_>, progress: &dyn Progress) -> Result<Rendering, Error> {
        let Self { config, layout, warp } = self;
        let (image, statistics, development) = match self.alone(sky) {
            Some(layer) => {
                let (frame, statistics) = warp.frame(layer, progress);
                (Image::Display(frame), statistics, None)
            }
            None => {
                let (mut frame, statistics) = seen(sky, warp, config, progress)?;
                push_channels(&mut frame, warp, config);
                let (image, development) = Image::developed(frame, &config.picture, !warp.is_uncut());
                (image, statistics, development)
            }
        };
        progress.step("annotating", 0);
        let annotations = annotate(layout, warp, config, development)?;
        let mut notes = notes(warp, config, &statistics, development);
        notes.extend(annotations.notes.iter().cloned());
        Ok(Rendering::new(Content::Image(annotations.composite(image)), &config.picture, notes))
    }
}

fn annotate(
    layout: &Layout,
    warp: &Warp<'_>,
    config: &Config,
    development: Option<Development>,
) -> Result<Annotations, Error> {
    let picture = &config.picture;
    let n_pixels = picture.size[0] as usize * picture.size[1] as usize;
    let seen: Option<Vec<_>> = picture
        .annotations
        .legend
        .then(|| (0..n_pixels).into_par_iter().map(|idx| warp.seen_item(idx)).collect());
    let annotated = Annotated {
        scene: &Scene::default(),
        camera: &camera(&picture.camera),
        is_shifted: config.shift.shifts_wavelengths(),
        seen: seen.as_deref(),
    };
    // Only grids and outlines need depths, and a sky has neither.
    let depths = |_: &Scene, _: &CameraOptions, _: SceneState| -> Result<DepthBuffer, PictureError> {
        Ok(DepthBuffer { size: picture.size, seen: vec![None; n_pixels] })
    };
    Ok(layout.annotate(annotated, picture, development, depths)?)
}

/// The notes on a picture.
fn notes(
    warp: &Warp<'_>,
    config: &Config,
    statistics: &Statistics,
    development: Option<Development>,
) -> Vec<Note> {
    let picture = &config.picture;
    let mut notes = Vec::new();
    if warp.is_up_replaced {
        notes.push(Note::UpReplaced);
    }
    if statistics.n_covered == 0 {
        notes.push(Note::NoPanorama);
    } else if statistics.max_light == 0.0 {
        notes.push(Note::BlackPanorama);
    }
    if picture.output.is_linear() {
        return notes;
    }
    if let (Some(Exposure::Auto), Some(Development { stops, .. })) = (picture.exposure, development) {
        notes.push(Note::Exposure(stops));
    } else if picture.exposure.is_none()
        && picture.tone == ugimage::Tone::Clip
        && statistics.max_light > CLIPPED
    {
        // As the frame has it.
        notes.push(Note::ClippedLight(f64::from(statistics.max_light.min(f32::MAX))));
    }
    notes
}
