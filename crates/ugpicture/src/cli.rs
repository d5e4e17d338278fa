//! Options of a picture on the command line, the same in every renderer, and the way of a picture
//! out of the program.

mod words;

pub use words::{BRIGHT_REMEDY, DARK_REMEDY};

use std::path::Path;

use clap::{ArgAction, ArgMatches, Args};
use ugimage::label::TextForm;
use ugimage::{Filter, Format, Tone, spelled_color};
use uglight::ColorShift;
use ugparse::{Diagnostics, Source, pipe};
use ugphysics::Hsv;
use ugpipe::{
    Context, Failure, PIXELS_PER_INCH, Preset, Side, Words, finite, number, one_of, whole,
};
use ugscene::cli::{CameraArgs, ShiftArgs};

use crate::background::Background;
use crate::channel::Channel;
use crate::explain::{Explanation, WriteSample};
use crate::exposure::Exposure;
use crate::options::{AnnotationOptions, PictureOptions, Place};
use crate::output::Output;
use crate::picture_file::PictureFile;
use crate::quantity::{IsoOptions, MapOptions, Quantity};
use crate::units::Units;
use ugtrace::lens::Lens;

/// Heading of the options of a picture in `--help`.
pub const PICTURE: &str = "Picture";

/// Heading of annotations in `--help`.
const ANNOTATIONS: &str = "Annotations";

/// Everything about a picture but its format: flatten it into the arguments of a renderer.
#[derive(Args, Clone, Debug)]
pub struct PictureArgs {
    #[command(flatten)]
    camera: CameraArgs,

    /// Size of the picture in pixels, or in mm, cm, in, pt
    ///
    /// A length, as in -sz 8.6cm 6cm, has 300 pixels to the inch, which a PNG file states; files in
    /// PDF, SVG, PostScript and EPS have that size. With -vec numbers are points, and lengths are
    /// rounded to these.
    #[arg(long, num_args = 2, value_names = ["W", "H"], action = ArgAction::Set,
          default_values = ["1024", "768"], value_parser = Side::parse,
          visible_alias = "size", help_heading = PICTURE)]
    sz: Vec<Side>,

    /// N x N samples per pixel, 1 to 16
    #[arg(long, value_name = "N", default_value = "4", value_parser = whole(1..=16),
          visible_alias = "samples", help_heading = PICTURE)]
    aa: u32,

    /// Reconstruction filter from samples to pixels: box, triangle, spline
    ///
    /// box: the mean of the pixel's own samples, as a detector measures it. triangle and spline (a
    /// quadratic B-spline) reach into the neighbouring pixels: edges and thin lines are smoother,
    /// and softer.
    #[arg(long, value_name = "FILTER", default_value = "box", value_parser = one_of("filters", Filter::ALL.map(|filter| (filter.name(), filter))), visible_alias = "filter",
          help_heading = PICTURE)]
    fl: Filter,

    /// Background colour: lightness, hue in degrees, saturation; a name, or #rrggbb [default:
    /// black]
    #[arg(long, num_args = 1..=3, value_names = ["L", "H", "S"], action = ArgAction::Set,
          visible_alias = "background", help_heading = PICTURE)]
    bg: Option<Vec<String>>,

    /// Transparent background
    #[arg(long, visible_alias = "transparent", conflicts_with = "bg", help_heading = PICTURE)]
    tb: bool,

    /// Exposure in stops, or auto
    ///
    /// Light is multiplied by 2 to the power E, and clipped only then. auto: chosen so that 99 of
    /// 100 pixels that are not black are at or below white.
    #[arg(long, value_name = "E|auto", allow_hyphen_values = true, value_parser = exposure,
          visible_alias = "exposure", help_heading = PICTURE)]
    ex: Option<Exposure>,

    /// Tone curve from light to display: clip, filmic
    ///
    /// filmic is Hable's curve of 2010, with white at 5.6. Curves are applied to luminance and keep
    /// the hue.
    #[arg(long, value_name = "CURVE", default_value = "clip", value_parser = one_of("curves", Tone::ALL.map(|tone| (tone.name(), tone))),
          visible_alias = "tone-curve", help_heading = PICTURE)]
    tc: Tone,

    /// Smaller PNG files, which take longer to compress
    ///
    /// The pixels stay the same.
    #[arg(long, visible_alias = "pack", help_heading = PICTURE)]
    pz: bool,

    /// Channels to add to an EXR picture, separated by commas: D, time, distance, Z, id,
    /// velocity, direction, position, ray
    ///
    /// Doppler factor, emission time, distance of the emission event, depth along the view, number
    /// of the face, velocity of the body, direction of the emission event in the frame of the body
    /// and the axes of the scene; position of that event, and the direction to it, in the frame of
    /// the camera; all at the middle of the pixel.
    #[arg(long, value_name = "LIST", value_parser = channels, visible_alias = "channels", help_heading = PICTURE)]
    ch: Option<Channels>,
}

/// Formats that hold light as it is, which no exposure and no tone curve changes.
fn is_linear(matches: &ArgMatches) -> bool {
    let named = |id: &str| matches.try_get_raw(id).ok().flatten().into_iter().flatten().next_back();
    let by_name = named("dt").and_then(|name| Format::from_name(name.to_str()?));
    let ending = || format_named(Path::new(named("fo")?).extension()?.to_str()?).ok();
    by_name.or_else(ending).is_some_and(Format::is_linear)
}

impl PictureArgs {
    /// Exposure as a camera finds it, for the looks of a program.
    pub const AUTO_EXPOSURE: Preset =
        Preset::new(&["ex", "auto"], &["crop"]).with(|all| !is_linear(all));

    /// A filmic tone curve, for the looks of a program.
    pub const FILMIC: Preset = Preset::new(&["tc", "filmic"], &[]).with(|all| !is_linear(all));

    /// The picture options that these arguments define.
    ///
    /// # Errors
    /// The background is not a valid colour.
    pub fn options(
        &self,
        output: Output,
        annotations: AnnotationOptions,
    ) -> Result<PictureOptions, Failure> {
        let per_inch = if let Output::Vector(_) = output { 72.0 } else { PIXELS_PER_INCH };
        Ok(PictureOptions {
            camera: self.camera.options(),
            size: Side::both(&self.sz, per_inch).map_err(Failure::Usage)?,
            per_inch: self.sz.iter().any(|side| side.is_length()).then_some(per_inch),
            samples: self.aa,
            filter: self.fl,
            background: self.background()?,
            output,
            exposure: self.ex,
            tone: self.tc,
            channels: self.ch.clone().unwrap_or_default().0,
            small: self.pz,
            annotations,
            text: TextForm::default(),
            light: None,
        })
    }

    /// Samples along a side of a pixel.
    pub fn samples(&self) -> u32 {
        self.aa
    }

    fn background(&self) -> Result<Background, Failure> {
        if self.tb {
            return Ok(Background::Transparent);
        }
        color("background -bg", self.bg.as_deref().unwrap_or(&[])).map(Background::Color)
    }
}

/// The lens of a camera that sees in all directions: flatten it into the arguments of a renderer,
/// with its heading in `--help`.
#[derive(Args, Clone, Debug)]
pub struct LensArgs {
    /// Panorama of all directions
    ///
    /// Longitude across the picture, latitude down, the view direction in the middle
    /// (equirectangular). -sz W H with W = 2 H has square degrees; then a PNG file says that it is
    /// a panorama, as players of 360° pictures expect it.
    #[arg(long, visible_alias = "panorama", conflicts_with_all = ["fish", "va"])]
    pan: bool,

    /// Fisheye: ANGLE degrees in a circle, as for domes
    ///
    /// The distance to the middle of the picture is the angle to the view direction (equidistant).
    /// A dome needs 180.
    #[arg(long, value_name = "ANGLE", visible_alias = "fisheye", conflicts_with = "va", value_parser = number(fisheye))]
    fish: Option<f64>,

    /// Cube map: six square views from left to right
    ///
    /// Right, left, up, down, front, back of the view direction: +X, -X, +Y, -Y, +Z, -Z of cube
    /// maps, each as seen from inside. -sz W H needs W = 6 H.
    #[arg(long, visible_alias = "cube-map", conflicts_with_all = ["pan", "fish", "va"])]
    cube: bool,
}

impl LensArgs {
    /// The lens that these arguments define.
    pub fn lens(&self) -> Lens {
        match self.fish {
            Some(degrees) => Lens::Fisheye { angle: degrees.to_radians() },
            None if self.pan => Lens::Panorama,
            None if self.cube => Lens::Cube,
            None => Lens::Pinhole,
        }
    }
}

/// An angle of view, in degrees.
fn fisheye(angle: f64) -> Result<f64, String> {
    if 0.0 < angle && angle <= 360.0 {
        Ok(angle)
    } else {
        Err("a fisheye shows more than 0 and at most 360 degrees".to_owned())
    }
}

/// Annotations: flatten it into the arguments of a renderer, last of its own.
#[derive(Args, Clone, Debug)]
pub struct AnnotationArgs {
    /// Title above the picture, wrapped as needed
    #[arg(long, value_name = "TEXT", help_heading = ANNOTATIONS)]
    title: Option<String>,

    /// Caption below the picture, wrapped as needed; line breaks are kept
    ///
    /// -sz is the size of the whole picture, whose view is made smaller for title, caption and
    /// legend, so that they hide nothing; a narrower -va makes it larger.
    #[arg(long, value_name = "TEXT", visible_alias = "caption", help_heading = ANNOTATIONS)]
    cap: Option<String>,

    /// Legend below the picture: spectrum, velocities, Doppler factors
    ///
    /// The visible spectrum has a scale in nm, and a bar where light of 550 nm is seen. A velocity
    /// is an arrow of unit length seen from the camera (a dot at its tail: approaching, a cross:
    /// receding), with β, γ and D.
    #[arg(long, visible_alias = "legend", help_heading = ANNOTATIONS)]
    lg: bool,

    /// Place of caption, legend and scale: below, beside, or over a corner, as top-left
    ///
    /// Below and beside it they leave a smaller picture with all of the view; in a corner (top-left,
    /// top-right, bottom-left, bottom-right) the picture keeps its size, and they cover a part.
    #[arg(long, value_name = "PLACE", visible_alias = "legend-place", value_parser = ugpipe::one_of("places", Place::NAMES),
          help_heading = ANNOTATIONS)]
    lp: Option<Place>,

    /// Outline of moving bodies as they would look at rest, centred where each body is seen
    #[arg(long, visible_alias = "undistorted", help_heading = ANNOTATIONS)]
    dl: bool,

    /// Grid of coordinates on the ground: in the plane z = 0, or at the lowest point of the scene
    /// if that is lower
    #[arg(long, visible_alias = "grid", help_heading = ANNOTATIONS)]
    gr: bool,

    /// Instead of light a quantity in false colours, with its scale: D, time, distance, speed, z
    ///
    /// Doppler factor, time and distance of emission, speed, depth along the view, in the frame of
    /// the camera. The scale ends at LOW and HIGH, or at the least and greatest value that is seen.
    /// That of D is logarithmic, from red over white at 1 to blue.
    #[arg(long, num_args = 1..=3, value_names = ["QUANTITY", "LOW", "HIGH"], action = ArgAction::Set,
          help_heading = ANNOTATIONS)]
    map: Option<Vec<String>>,

    /// Lines of equal values of a quantity over the picture: D, time, distance, speed, z
    ///
    /// The quantities are those of -map; without values they are round numbers. Lines are where the
    /// middles of neighbouring pixels show one surface.
    #[arg(long, num_args = 1..=33, value_names = ["QUANTITY", "VALUE"], action = ArgAction::Set,
          help_heading = ANNOTATIONS)]
    iso: Option<Vec<String>>,

    /// Size of text in pixels, 4 to 200 [default: 1/40 of the geometric mean of -sz]
    ///
    /// The default is at least 9 pixels, 12 where that is at most 1/32 of the mean, and 6 points if
    /// -sz has units of length.
    #[arg(long, value_name = "PIXELS", visible_alias = "text-size", value_parser = number(text_size),
          help_heading = ANNOTATIONS)]
    ts: Option<f64>,

    /// What a length of 1 in the scene is: m, km, ls (a light-second) ...; with a number, as '20 m'
    ///
    /// Legend, grid, scale and lines, and {t} and {speed} in captions of films, then have units:
    /// speeds in km/s, times as long as light takes. Units are nm, um, mm, cm, m, km, ft, mi, au,
    /// ly, pc, and lns, ls, lmin, lh, the way of light in such a time.
    #[arg(long, value_name = "UNIT", help_heading = ANNOTATIONS)]
    unit: Option<String>,

    /// The speed of light in legends and captions, as 30km/h [default: as in vacuum]
    ///
    /// Pictures stay the same: velocities are parts of the speed of light. Units are mm/s, cm/s,
    /// m/s, km/s, km/h, mph.
    #[arg(long, value_name = "SPEED", visible_alias = "speed-of-light", help_heading = ANNOTATIONS)]
    c: Option<String>,
}

fn text_size(pixels: f64) -> Result<f64, String> {
    if (4.0..=200.0).contains(&pixels) {
        Ok(pixels)
    } else {
        Err("text is 4 to 200 pixels large".to_owned())
    }
}

/// The quantity and the numbers of -map or -iso.
fn quantity_numbers(option: &str, words: &[String]) -> Result<(Quantity, Vec<f64>), Failure> {
    let names = Quantity::NAMES.map(|(name, _)| name).join(", ");
    let quantity = |word: &String| Quantity::NAMES.into_iter().find(|(name, _)| name == word);
    let unknown = |word: &str| {
        Failure::usage(format!("{option}: `{word}` is neither a number nor one of {names}"))
    };
    let number = |word: &String| finite(word).map_err(|_| unknown(word));
    let Some((_, quantity)) = words.first().and_then(quantity) else {
        return Err(Failure::usage(format!(
            "{option} has one quantity first, then numbers: one of {names}"
        )));
    };
    let numbers = words[1..].iter().map(number).collect::<Result<Vec<f64>, Failure>>()?;
    if quantity == Quantity::Doppler && numbers.iter().any(|number| *number <= 0.0) {
        return Err(Failure::usage(format!("the Doppler factors of {option} must be above 0")));
    }
    Ok((quantity, numbers))
}

impl AnnotationArgs {
    /// The annotation options that these arguments define.
    ///
    /// # Errors
    /// The words of -map or -iso are no quantity with its numbers.
    pub fn options(&self) -> Result<AnnotationOptions, Failure> {
        let map = |words: &Vec<String>| {
            let (quantity, numbers) = quantity_numbers("-map", words)?;
            let range = match numbers[..] {
                [] => None,
                [low, high] if low < high => Some([low, high]),
                _ => {
                    return Err(Failure::usage(
                        "-map has two numbers or none, the lower one first",
                    ));
                }
            };
            Ok::<_, Failure>(MapOptions { quantity, range })
        };
        let iso = |words: &Vec<String>| {
            let (quantity, values) = quantity_numbers("-iso", words)?;
            Ok::<_, Failure>(IsoOptions { quantity, values })
        };
        Ok(AnnotationOptions {
            title: self.title.clone().unwrap_or_default(),
            caption: self.cap.clone().unwrap_or_default(),
            place: self.lp.unwrap_or_default(),
            legend: self.lg,
            outline: self.dl,
            grid: self.gr,
            map: self.map.as_ref().map(map).transpose()?,
            iso: self.iso.as_ref().map(iso).transpose()?,
            text_size: self.ts,
            units: Units::new(self.unit.as_deref(), self.c.as_deref())
                .map_err(|error| Failure::usage(format!("-unit or -c: {error}")))?,
        })
    }
}

/// The shift of colours that these arguments define.
pub fn color_shift(
    &ShiftArgs { br, sp, no_doppler, no_flux, infrared_rule }: &ShiftArgs,
) -> ColorShift {
    ColorShift::new(sp, !no_doppler, !no_flux, br).with_infrared(infrared_rule.unwrap_or_default())
}

/// The command line to be recorded. A format that follows from the ending of -fo is part of it, so
/// that the pipe can be run again with another output. `is_stated`: it is there already.
pub fn with_format(command_line: &str, output: Output, is_stated: bool) -> String {
    match output {
        Output::Color(format) | Output::Vector(format) if !is_stated && format != Format::Png => {
            format!("{command_line} -dt {}", format.name())
        }
        _ => command_line.to_owned(),
    }
}

/// A column and a row.
pub type Pixel = [u32; 2];

/// The kind of output: a picture or a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A picture.
    Picture(Format),
    /// An explanation.
    Report(ExplanationFormat),
}

/// Format of the explanation of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExplanationFormat {
    /// For people.
    Text,
    /// For scripts.
    Json,
}

/// Each [`Kind`] with its name: formats of pictures, and those of explanations.
pub fn kinds() -> impl Iterator<Item = (&'static str, Kind)> {
    let reports = [("text", ExplanationFormat::Text), ("json", ExplanationFormat::Json)];
    let pictures = Format::ALL.map(|format| (format.name(), Kind::Picture(format)));
    pictures.into_iter().chain(reports.map(|(name, format)| (name, Kind::Report(format))))
}

/// Value parser: a pixel, `320,240`.
///
/// # Errors
/// These are not two numbers.
pub fn pixel(word: &str) -> Result<Pixel, String> {
    let numbers = word
        .split_once(',')
        .and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]));
    numbers.ok_or_else(|| "a pixel is its column and row, such as 320,240".to_owned())
}

/// The format of the picture. `given`: with -dt. `file`: the output. While a pixel is explained, it
/// is the default.
///
/// # Errors
/// The format is one of explanations, or the ending of the file is that of no format.
pub fn picture_format(
    given: Option<Kind>,
    file: Option<&Path>,
    is_explained: bool,
) -> Result<Format, Failure> {
    match given {
        _ if is_explained => Ok(Format::Png),
        Some(Kind::Picture(format)) => Ok(format),
        None => format_for(None, file),
        Some(Kind::Report(_)) => Err(Failure::Usage(
            "`text` and `json` explain a pixel: add --explain X,Y, or name a format of pictures"
                .into(),
        )),
    }
}

/// The format of the explanation. `given`: with -dt. `file`: the output.
fn report_format(given: Option<Kind>, file: Option<&Path>) -> Result<ExplanationFormat, Failure> {
    let is_json =
        |file: &Path| file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("json"));
    match given {
        Some(Kind::Report(report)) => Ok(report),
        Some(Kind::Picture(_)) => Err(Failure::Usage(
            "a pixel is explained as text or JSON: give --format json, or leave --format out"
                .into(),
        )),
        None if file.is_some_and(is_json) => Ok(ExplanationFormat::Json),
        None => Ok(ExplanationFormat::Text),
    }
}

/// Reads a scene, prints its warnings, and writes the explanation of a pixel. `given`: the format
/// with -dt.
///
/// # Errors
/// The format is one of pictures; errors of reading, of `explain` and of writing.
pub fn write_explanation<S: WriteSample>(
    given: Option<Kind>,
    reading: &ugparse::Options,
    context: &mut Context,
    explain: impl FnOnce(&Source) -> Result<(Explanation<S>, Diagnostics), Failure>,
) -> Result<(), Failure> {
    let report = report_format(given, context.output_name())?;
    let source = pipe::read(context, reading)?;
    let (explanation, warnings) = explain(&source)?;
    if !warnings.is_empty() {
        context.report(&warnings.report());
    }
    match report {
        ExplanationFormat::Text => context.write_text(&explanation.text()),
        ExplanationFormat::Json => context.write_json(&explanation.json()),
    }
}

/// The format given, otherwise that of the ending of the output file, otherwise PNG.
///
/// # Errors
/// The ending is that of no format.
pub fn format_for(given: Option<Format>, file: Option<&Path>) -> Result<Format, Failure> {
    let ending = file.and_then(Path::extension).map(|ending| ending.to_string_lossy());
    match (given, ending) {
        (Some(format), _) => Ok(format),
        (None, None) => Ok(Format::Png),
        (None, Some(ending)) => format_named(&ending)
            .map_err(|error| Failure::Usage(format!("`.{ending}` is {error}; name one with -dt"))),
    }
}

/// Refuses a picture that a terminal cannot show.
///
/// # Errors
/// The output is a terminal, and the format is binary.
pub fn refuse_terminal(format: Format, context: &Context) -> Result<(), Failure> {
    if context.output_is_terminal() && format.is_binary() {
        return Err(Failure::Usage(
            "a picture is not written to a terminal; send it to a file with `> FILE` or -fo FILE"
                .into(),
        ));
    }
    Ok(())
}

/// Prints the warnings and notes of a picture, and writes it. `size`: in pixels.
///
/// # Errors
/// The output cannot be written.
pub fn write_picture(
    picture: &PictureFile,
    size: [u32; 2],
    context: &mut Context,
) -> Result<(), Failure> {
    if !picture.warnings.is_empty() {
        context.report(&picture.warnings.report());
    }
    picture.notes.iter().for_each(|note| context.note(&note.words()));
    context.detail(&format!("drew {} x {} pixels", size[0], size[1]));
    context.write(&picture.bytes)
}

/// Value of `-ch`.
#[derive(Clone, Debug, Default)]
struct Channels(Vec<Channel>);

/// Value parser: a format of pictures.
///
/// # Errors
/// There is no such format.
pub fn format_named(name: &str) -> Result<Format, String> {
    Format::from_name(name).ok_or_else(|| format!("none of the formats {}", Format::list()))
}

/// The colour of an option called `name`, see [`spelled_color`].
///
/// # Errors
/// The words are no colour.
pub fn color(name: &str, words: &[String]) -> Result<Hsv, Failure> {
    spelled_color(words, finite).map_err(|error| Failure::Usage(format!("{name}: {error}")))
}

/// Beyond the exponents of single precision, in which light is kept.
const MOST_STOPS: f64 = 300.0;

/// Stops, or `auto`.
fn exposure(word: &str) -> Result<Exposure, String> {
    if word == "auto" {
        return Ok(Exposure::Auto);
    }
    match finite(word).map_err(|error| format!("{error}, nor is it `auto`"))? {
        stops if stops.abs() <= MOST_STOPS => Ok(Exposure::Stops(stops)),
        _ => Err(format!("an exposure is between -{MOST_STOPS} and {MOST_STOPS} stops")),
    }
}

/// Names of channels, each once, in the order given.
fn channels(list: &str) -> Result<Channels, String> {
    let mut channels = Vec::new();
    for name in list.split(',') {
        let Some((_, channel)) = Channel::NAMES.into_iter().find(|(known, _)| *known == name)
        else {
            let names = Channel::NAMES.map(|(name, _)| name).join(", ");
            return Err(format!("`{name}` is none of the channels {names}"));
        };
        if !channels.contains(&channel) {
            channels.push(channel);
        }
    }
    Ok(Channels(channels))
}
