//! From a panorama to a picture.

use std::ops::Range;

use rayon::prelude::*;
use ugimage::{Development, Format, LinearFrame, Metadata};
use uglight::{ColorShift, SpectralShift};
use ugparse::{Diagnostics, Source};
use ugpicture::{
    Annotated, Annotations, Background, Content, DepthBuffer, Error as PictureError, Exposure, Image, Layout,
    Note, Output, PictureFile, Rendering, SceneState, channel_planes,
};
use ugpipe::Progress;
use ugscene::{CameraOptions, Provenance, Remarks, Scene};
use ugsky::{Basis, Panorama};

use crate::config::Config;
use crate::error::Error;
use crate::open::{Band, Opened};
use crate::sky::Sky;
use crate::stars::{StarField, parts};
use crate::warp::{Statistics, Warp, camera};

/// Wavelengths that are seen at rest, nm: those of the CIE 1931 observer.
pub(crate) const VISIBLE_NM: Range<f64> = 360.0..830.0;

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
    let mut config = options_for(sky, config);
    config.picture.keep_light();
    config.picture.annotations = ugpicture::AnnotationOptions::default();
    let warp = Warp::new(&config)?;
    let (mut frame, _) = seen(sky, &warp, &config, &())?;
    push_channels(&mut frame, &warp, &config);
    Ok(frame)
}

/// The light of a sky.
fn seen(
    sky: Sky<'_>,
    warp: &Warp,
    config: &Config,
    progress: &dyn Progress,
) -> Result<(LinearFrame, Statistics), Error> {
    let (mut frame, mut statistics) = match sky.panorama {
        Some(panorama) => warp.light(panorama, progress),
        None => warp.darkness(),
    };
    for band in sky.bands {
        progress.step("light outside the visible range", 0);
        add_band(band, &mut frame, &mut statistics, config)?;
    }
    if !sky.stars.is_empty() {
        progress.step("stars", 0);
        statistics.max_light = StarField::new(sky.stars, config)?.add(sky.stars, &mut frame);
    }
    Ok((frame, statistics))
}

/// Adds infrared or ultraviolet light, where the Doppler effect makes it visible.
fn add_band(
    band: &Band,
    frame: &mut LinearFrame,
    statistics: &mut Statistics,
    config: &Config,
) -> Result<(), Error> {
    let mut of_band = Config { basis: Basis::Grey, range_nm: band.range_nm.clone(), ..config.clone() };
    of_band.picture.background = Background::Transparent;
    let (light, _) = Warp::new(&of_band)?.light(&band.panorama, &());
    let sums = frame.pixels_mut().par_iter_mut().zip(light.pixels()).map(|(pixel, light)| {
        (0..3).for_each(|channel| pixel[channel] += light[channel]);
        pixel[..3].iter().fold(0.0, |most: f32, part| most.max(*part))
    });
    statistics.max_light = sums.reduce(|| statistics.max_light, f32::max);
    Ok(())
}

/// The options for a sky. Stars are black bodies, so their spectra are shifted. Where there is a
/// panorama of infrared or ultraviolet light, that of visible light has none.
fn options_for(sky: Sky<'_>, config: &Config) -> Config {
    let mut config = config.clone();
    for Band { range_nm, .. } in sky.bands {
        if range_nm.start >= VISIBLE_NM.end {
            config.range_nm.end = VISIBLE_NM.end;
        } else {
            config.range_nm.start = VISIBLE_NM.start;
        }
    }
    if sky.panorama.is_none() {
        let [doppler, flux] = parts(config.shift);
        config.shift = ColorShift::Spectra(SpectralShift { doppler, flux });
        // Colours of a panorama are not needed, and this basis is computed at once.
        config.basis = Basis::Planck([3500.0, 5900.0, 10_000.0]);
    }
    config
}

/// Adds the channels that the options ask for.
fn push_channels(frame: &mut LinearFrame, warp: &Warp, config: &Config) {
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
        Some(panorama) if prepared.is_plain_png() => prepared.png(panorama, metadata, progress),
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
struct Prepared {
    /// Options of the picture without its annotations.
    config: Config,
    layout: Layout,
    warp: Warp,
}

impl Prepared {
    fn new(sky: Sky<'_>, config: &Config, progress: &dyn Progress) -> Result<Self, Error> {
        config.check()?;
        let mut config = options_for(sky, config);
        let layout = Layout::new(&config.picture)?;
        config.picture = layout.of_scene(&config.picture).into_owned();
        progress.step("preparing", 0);
        Ok(Self { warp: Warp::new(&config)?, config, layout })
    }

    /// The panorama, if there is nothing else in the sky and each pixel has its final colour, of 8
    /// bits, as soon as its light is known.
    fn alone<'s>(&self, sky: Sky<'s>) -> Option<&'s Panorama> {
        let is_deep = self.config.picture.output.format().is_some_and(|format| format.is_deep());
        let is_final = sky.bands.is_empty() && sky.stars.is_empty() && !self.warp.is_uncut() && !is_deep;
        sky.panorama.filter(|_| is_final)
    }

    /// True for a PNG file of 8 bits without annotations.
    fn is_plain_png(&self) -> bool {
        let picture = &self.config.picture;
        picture.output == Output::Color(Format::Png) && !picture.annotations.is_any()
    }

    /// The file of a picture that [`is_plain_png`](Self::is_plain_png), and notes for the user.
    fn png(&self, panorama: &Panorama, metadata: &Metadata, progress: &dyn Progress) -> (Vec<u8>, Vec<Note>) {
        let (file, statistics) =
            self.warp.png(panorama, progress, metadata, self.config.picture.compression());
        (file, notes(&self.warp, &self.config, &statistics, None))
    }

    fn render(&self, sky: Sky<'_>, progress: &dyn Progress) -> Result<Rendering, Error> {
        let Self { config, layout, warp } = self;
        let (image, statistics, development) = match self.alone(sky) {
            Some(panorama) => {
                let (frame, statistics) = warp.frame(panorama, progress);
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
    warp: &Warp,
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
    warp: &Warp,
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
