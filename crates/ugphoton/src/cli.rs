//! The command line.

mod words;

use std::path::Path;

use clap::builder::Resettable;
use clap::{ArgAction, Parser};
use uglight::Interpolation;
use ugparse::pipe;
use ugpicture::Output;
use ugpicture::cli::{
    AnnotationArgs, Kind, LensArgs, PICTURE, PictureArgs, Pixel, color_shift, kinds,
    picture_format, pixel, refuse_terminal, with_format, write_explanation, write_picture,
};
use ugpipe::{
    CommonArgs, Context, Failure, Look, LookArgs, Looks, ToolArgs, number, one_of, whole,
};
use ugscene::cli::{MotionArgs, RepeatArgs, ShiftArgs};
use ugscene::{HueScale, Provenance};
use ugskybox::BuiltIn;
use ugskybox::cli::SkyArgs;

use crate::config::{Config, RayOptions, Shutter};
use crate::explain::explain;
use crate::render::{PROVENANCE, PreparedScene};

/// Draws a UniGrafix scene in motion by tracing rays: mirrors, glass, shadows
///
/// Reads a scene at rest and writes a picture. A ray for each sample is followed from the eye into
/// the past, through mirrors and glass, each with its own motion; shadows lag behind moving bodies.
/// It does the work of the whole pipe by itself, exact at every sample.
#[derive(Clone, Debug, Parser)]
#[command(name = "ugphoton", version, after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    motion: MotionArgs,

    #[command(flatten, next_help_heading = COLOR)]
    shift: ShiftArgs,

    /// Interpolate wavelengths between corners, instead of hues
    #[arg(long, visible_alias = "interpolate-wavelength", conflicts_with = "sp", help_heading = COLOR)]
    iw: bool,

    /// Hues in colour statements are wavelengths in nm; implies -iw
    #[arg(long, visible_alias = "wavelengths", conflicts_with = "sp", help_heading = COLOR)]
    wi: bool,

    #[command(flatten)]
    repeat: RepeatArgs,

    /// Most reflections and refractions along a path
    #[arg(long, visible_alias = "depth", value_name = "N", default_value = "16", value_parser = whole(0..=64),
          help_heading = RAYS)]
    rd: u32,

    /// Least part of a pixel's light that is followed
    #[arg(long, visible_alias = "cut-off", value_name = "PART", default_value = "0.01",
          value_parser = number(part), help_heading = RAYS)]
    rc: f64,

    /// Accepted as in 1988, without effect: cells of a spatial subdivision
    ///
    /// Rays find what they hit in a bounding-volume hierarchy, which needs no options. In 1988,
    /// too, any N had the effect of -1: no subdivision.
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = integer, help_heading = RAYS)]
    cn: Option<i32>,

    /// Without shadows: light reaches surfaces through all others
    #[arg(long, help_heading = RAYS)]
    no_shadows: bool,

    /// The sky does not light the scene
    ///
    /// It is only seen, directly and in mirrors. Otherwise it lights the scene beside its lamps,
    /// and in place of the default lights.
    #[arg(long, help_heading = RAYS)]
    no_sky_light: bool,

    /// Fresnel's equations for mirrors and glass
    ///
    /// They divide light on transparent surfaces into reflected and transmitted light by its angle.
    /// Otherwise the parts are those of the surf statement.
    #[arg(long, help_heading = RAYS)]
    fresnel: bool,

    /// Shutter at the film, at this distance behind the pinhole
    ///
    /// Otherwise the shutter is at the pinhole. All light of the picture arrives at the film at one
    /// moment, so it passed the pinhole the earlier the nearer it is to the edge of the film. While
    /// it does, a camera that accelerates or turns counts as moving on with its velocity of that
    /// moment.
    #[arg(long, value_name = "DISTANCE", value_parser = number(distance), help_heading = RAYS)]
    film_shutter: Option<f64>,

    #[command(flatten, next_help_heading = RAYS)]
    lens: LensArgs,

    /// A picture for each of two eyes at this distance
    ///
    /// Side by side, the left eye's on the left; panoramas one above the other, the left eye's
    /// above. Each eye has half of -sz. Both rest in the frame of the camera and see at the same
    /// moment of it. In a panorama each column has eyes across its own direction (ODS).
    #[arg(long, value_name = "DISTANCE", value_parser = number(distance), conflicts_with = "cube", help_heading = RAYS)]
    stereo: Option<f64>,

    /// Adaptive samples: fewer in pixels of less contrast than this
    ///
    /// About a quarter of the N x N samples (-aa) of a pixel are traced first, and the rest only if
    /// they and their neighbours differ by more than this contrast, from 0 to 1. .05 suits most
    /// pictures. Details smaller than the distance of the first samples can be missed.
    #[arg(long, value_name = "CONTRAST", visible_alias = "adaptive", value_parser = number(part), help_heading = PICTURE)]
    ad: Option<f64>,

    /// Draw only a part of the picture: column, row, width, height
    ///
    /// The pixels are those of the whole picture of size -sz, so parts drawn on several machines
    /// can be joined.
    #[arg(long, num_args = 4, value_names = ["X", "Y", "W", "H"], action = ArgAction::Set,
          value_parser = whole(0..=u32::MAX), help_heading = PICTURE)]
    crop: Option<Vec<u32>>,

    /// Add channels of radiances at wavelengths to an EXR picture
    ///
    /// 249 channels such as S0.450nm, from 80 to 3953 nm (names as by Fichet et al. 2021): enough
    /// for `ugwarp -sp` to show a panorama (-pan) at up to 0.9c as the scene itself would be seen.
    /// It takes about 80 times as long.
    #[arg(long, help_heading = PICTURE)]
    radiances: bool,

    /// Write a coarse picture at once, and replace it by finer ones until it is done
    ///
    /// FILE (-fo) is first a picture in squares of 8 x 8 pixels with one sample each, then of 4 x 4
    /// and 2 x 2, and at last the picture itself, with the same bytes as without -pv. It is a
    /// complete file at any time, so a viewer that reloads it shows the progress.
    #[arg(long, visible_alias = "preview", conflicts_with = "explain", help_heading = PICTURE)]
    pv: bool,

    /// Smooth shading
    ///
    /// Vertices without a normal get the mean normal of their faces.
    #[arg(long, visible_alias = "smooth", help_heading = RAYS)]
    sm: bool,

    /// Format of the picture [default: by the ending of -fo, else png]
    ///
    /// png16 has 16 bits per component. exr, pfm and hdr hold linear light, neither clipped nor
    /// gamut-mapped: white is 1, and components may exceed 1 or be negative. text and json are for
    /// --explain.
    #[arg(long, value_name = "FMT", visible_alias = "format", value_parser = one_of("formats", kinds()),
          help_heading = PICTURE)]
    dt: Option<Kind>,

    /// Instead of a picture, print how the colour of the pixel in column X and row Y (from 0 at the
    /// upper left) comes about
    ///
    /// As text, or with `--format json` as JSON: every surface on the way of its light, its motion,
    /// when and where the light left it, Doppler factors, media, lamps and shadows, and every step
    /// to the bytes of the pixel.
    #[arg(long, value_name = "X,Y", value_parser = pixel, conflicts_with = "crop",
          help_heading = Resettable::Reset)]
    explain: Option<Pixel>,

    #[command(flatten)]
    sky: SkyArgs,

    /// Stand the scene on a grey ground, under a sky: day, unless -sky gives another
    ///
    /// The ground is level, at the lowest point of the scene, and rests whatever moves. The sky
    /// lights the scene, beside its lamps.
    #[arg(long, help_heading = RAYS)]
    stage: bool,

    #[command(flatten)]
    picture: PictureArgs,

    #[command(flatten)]
    annotations: AnnotationArgs,

    #[command(flatten)]
    look: LookArgs,

    #[command(flatten)]
    common: CommonArgs,
}

const COLOR: &str = "Colour";
const RAYS: &str = "Rays";

const EXAMPLES: &str = "Examples:
  ugphoton -vel .9 0 0 -in ship.ug > ship.png
  ugphoton -cv 0 .9 0 --ahead street.ug > ahead.png
  ugphoton -vel .6 0 0 -in --no-shadows -lg ship.ug > legend.png
  ugphoton -vel 0 -.2 0 -in -dt exr -ch D,time ship.ug > light.exr";

impl ToolArgs for Args {
    const ESSENTIAL: &'static [&'static str] = &[
        "-vel",
        "--keep-in-view",
        "-cv",
        "-ti",
        "-look",
        "-ep",
        "-va",
        "-sz",
        "-ex",
        "-lg",
        "--no-shadows",
        "-fo",
    ];

    const LOOKS: Looks = Looks {
        default: Look::Light,
        light: &[
            ShiftArgs::SPECTRA,
            RepeatArgs::APART,
            PictureArgs::AUTO_EXPOSURE,
            PictureArgs::FILMIC,
        ],
        shape: &[ShiftArgs::REST_WAVELENGTHS, ShiftArgs::REST_BRIGHTNESS, RepeatArgs::APART],
    };

    fn common(&self) -> &CommonArgs {
        &self.common
    }
}

impl Args {
    /// The command line to be recorded, which states the format of the picture.
    pub fn recorded(&self, command_line: &str, config: &Config) -> String {
        with_format(command_line, config.picture.output, self.dt.is_some())
    }

    /// The configuration of the options. `output`: the file whose ending is the format unless an
    /// option gives it.
    ///
    /// # Errors
    /// [`Failure::Usage`]: options that exclude each other, or a value out of range.
    pub fn config(&self, output: Option<&Path>) -> Result<Config, Failure> {
        if self.ad.is_some() && self.picture.samples() == 1 {
            return Err(Failure::usage(
                "-ad leaves out samples, and -aa 1 has one a pixel: leave out -ad, or give more with -aa",
            ));
        }
        let format = picture_format(self.dt, output, self.explain.is_some())?;
        let mut picture =
            self.picture.options(Output::Color(format), self.annotations.options()?)?;
        picture.camera.is_ahead = self.motion.is_ahead();
        Ok(Config {
            motion: self.motion.options()?,
            shift: color_shift(&self.shift),
            picture,
            rays: RayOptions {
                depth: self.rd,
                cutoff: self.rc,
                shadows: !self.no_shadows,
                sky_light: !self.no_sky_light,
                fresnel: self.fresnel,
                shutter: self
                    .film_shutter
                    .map_or(Shutter::Pinhole, |distance| Shutter::Film { distance }),
            },
            interpolation: if self.iw { Interpolation::Wavelength } else { Interpolation::Hue },
            hue_scale: if self.wi { HueScale::Wavelengths } else { HueScale::Degrees },
            smooth: self.sm,
            repeat: self.repeat.repeats(),
            lens: self.lens.lens(),
            stereo: self.stereo,
            adaptive: self.ad,
            sky: if self.stage { self.sky.sky_or(BuiltIn::Day) } else { self.sky.sky() },
            ground: self.stage,
            crop: self.crop.as_deref().and_then(|crop| crop.try_into().ok()),
            radiances: self.radiances,
            reading: pipe::options(&self.common)?,
        })
    }
}

/// The whole program between its streams: reads the scene, draws it, writes the picture.
///
/// # Errors
/// Bad usage, a bad scene, or a stream that fails.
pub fn draw(args: &Args, context: &mut Context) -> Result<(), Failure> {
    let mut config = args.config(context.output_name())?;
    if let Some(pixel) = args.explain {
        let explain = |source: &_| explain(&config, source, pixel).map_err(Failure::of);
        return write_explanation(args.dt, &config.reading, context, explain);
    }
    refuse_terminal(config.picture.output.format(), context)?;
    let preview =
        if args.pv { Some(context.replaceable_output().ok_or_else(no_preview)?) } else { None };
    let source = pipe::read(context, &config.reading)?;
    config.sky.open_with((&source, &config.reading), &args.common, context)?;
    let command_line = args.recorded(context.command_line(), &config);
    let (command, files) = (Some(&*command_line), &context.take_files_read()[..]);
    let provenance = Provenance { command, files, ..PROVENANCE };
    let steps = context.steps();
    let (drawing, warnings) =
        PreparedScene::read(&config, &source, provenance, !context.is_quiet(), &steps)
            .map_err(Failure::of)?;
    if let Some(file) = preview {
        for side in PreparedScene::PREVIEWS {
            let preview = drawing.preview(side, &steps).map_err(Failure::of)?;
            Context::write_now(&file, &preview.into_file())?;
        }
    }
    let rendering = drawing.picture(&steps).map_err(Failure::of)?;
    drop(drawing);
    let picture = rendering.pack(warnings, &steps);
    drop(steps);
    write_picture(&picture, config.picture.size, context)
}

fn no_preview() -> Failure {
    Failure::usage(
        "-pv replaces a file by finer pictures: name one with -fo FILE, or leave out -pv",
    )
}

/// A distance.
fn distance(distance: f64) -> Result<f64, String> {
    if distance >= 0.0 { Ok(distance) } else { Err("a distance is 0 or more".to_owned()) }
}

/// A whole number, also below 0.
fn integer(word: &str) -> Result<i32, String> {
    word.parse().map_err(|_| "must be a whole number".to_owned())
}

/// A part of a whole.
fn part(part: f64) -> Result<f64, String> {
    if (0.0..=1.0).contains(&part) { Ok(part) } else { Err("a part is from 0 to 1".to_owned()) }
}
