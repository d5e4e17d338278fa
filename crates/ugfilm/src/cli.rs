//! The command line.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::{ArgMatches, Parser};
use ugimage::Format;
use ugmeshfile::Foreign;
use ugparse::{Source, pipe};
use ugpicture::Background;
use ugpicture::cli::{BRIGHT_REMEDY, DARK_REMEDY, PictureArgs};
use ugpipe::{
    CommonArgs, Context, Failure, Input, Look, LookArgs, Looks, ToolArgs, Words, finite, is_given,
    one_of, parse_words, shell_word, whole,
};
use ugscene::cli::{RepeatArgs, ShiftArgs};
use ugscene::{CameraOptions, DefaultCamera, MotionOptions, Note, Scene};
use ugsheet::film::{Caption, DEFAULT_RATE, FilmKind, FrameNames, MOST_GIF_RATE, rate};

use crate::blur::MotionBlur;
use crate::film::{Film, HeldLight, MeasuredExposure, Summary};
use crate::frame_files::{keep_exposure, kept_exposure, remove_kept_exposure};
use crate::keys;
use crate::levels::WrongBrightness;
use crate::options::{PipeArgs, ProgramOptions};
use crate::output::{Output, names_of};
use crate::pipe::{FilmSubject, Pipe};
use crate::print::{self, argument};
use crate::program::Program;
use crate::script::Script;
use crate::series::{Pictures, Series, Subjects};
use crate::sight::{Sight, Unseen};
use crate::timeline::{Ease, Quantity, Timeline};

/// Draws the frames of a film or a figure sequence
///
/// Reads a scene at rest once and draws it again and again, with numbers that change: any number
/// among the options of the programs may have several values, -ti -10..10, which it goes through in
/// the course of the film. Several numbers change together in one word, -cv '0 0 0 .. 0 .9 0'.
/// Velocities change by rapidity. Frames are numbered files, or one file with the whole film. Every
/// frame is the file that its pipe of programs draws, which --print shows; frames that are there
/// already are not drawn again.
#[derive(Debug, Parser)]
#[command(name = "ugfilm", version, after_help = EXAMPLES)]
pub struct Args {
    /// Number of frames
    #[arg(long, value_name = "N", default_value = "100", value_parser = whole(1..=10_000_000), help_heading = FILM)]
    frames: u32,

    /// Frames a second, for films in one file [default: 25]
    #[arg(long, value_name = "RATE", value_parser = rate, help_heading = FILM)]
    fps: Option<f64>,

    #[command(flatten, next_help_heading = FILM)]
    pipe: PipeArgs,

    /// How numbers change from one value to the next: linear, smooth
    ///
    /// smooth begins and ends slowly, without jumps in between, and never goes beyond the values.
    #[arg(long, value_name = "WORD", default_value = "linear",
          value_parser = one_of("ways", [("linear", Ease::Linear), ("smooth", Ease::Smooth)]), help_heading = FILM)]
    ease: Ease,

    /// The film repeats: the frame after the last one would be the first
    #[arg(long = "loop", help_heading = FILM)]
    is_loop: bool,

    /// Turn the camera in every frame toward what moves
    ///
    /// The view centre (-vc) of every frame is in the middle of the bodies that move, as they are
    /// seen at its time; of all that is seen, if nothing moves. -ep, -ud and -va are as given.
    #[arg(long, conflicts_with = "warp", help_heading = FILM)]
    follow: bool,

    /// Read values at single frames from FILE: lines such as 120 -ti 0 -ep 0 -5 2
    #[arg(long, value_name = "FILE", help_heading = FILM)]
    keys: Option<PathBuf>,

    /// Draw only these frames: 40..59, or 1,5,9..12
    #[arg(long, value_name = "LIST", value_parser = ranges, help_heading = FILM)]
    only: Option<Ranges>,

    /// Also keep the frames of a film in these files, frame_%04d.png, and use those that are there
    #[arg(long, value_name = "NAMES", help_heading = FILM)]
    keep: Option<String>,

    /// Motion blur: average the light of the film over TIME, in times between two frames
    ///
    /// The shutter is open from TIME/2 before a frame to TIME/2 after it; .5 is that of a film
    /// camera. The mean is taken of linear light, before exposure and tone curve (-ex 0, if no
    /// exposure is given).
    #[arg(long, value_name = "TIME", value_parser = shutter_time, help_heading = FILM)]
    blur: Option<f64>,

    /// Moments that are averaged with -blur
    #[arg(long, value_name = "N", default_value = "16", value_parser = whole(1..=10_000), requires = "blur",
          help_heading = FILM)]
    moments: u32,

    /// On a page (-fo FILE.html), a second slider with N values of option NAME
    ///
    /// The frames are those of the first slider, over all other options with several values; they
    /// are drawn for each of the N values.
    #[arg(long, num_args = 2, value_names = ["NAME", "N"], allow_hyphen_values = true,
          conflicts_with_all = ["keys", "follow", "only", "blur", "sheet", "keep"], help_heading = FILM)]
    across: Option<Vec<String>>,

    /// Draw N frames spread over the film, or those of -only, on one sheet
    #[arg(long, num_args = 0..=1, value_name = "N", default_missing_value = "9",
          value_parser = whole(1..=10_000), help_heading = FILM)]
    sheet: Option<u32>,

    /// Print the command of every frame, or of frame N, and draw nothing
    #[arg(long, num_args = 0..=1, value_name = "N", default_missing_value = "0",
          value_parser = whole(0..=10_000_000), help_heading = FILM)]
    print: Option<u32>,

    /// Format of the film [default: by the ending of -fo]
    ///
    /// Of single frames: png, exr, pdf and all others of ugrainbow. Of films in one file: apng,
    /// gif, y4m, ppm, html, a page with a slider; mp4 and webm with ffmpeg.
    #[arg(long, value_name = "FMT", visible_alias = "format", help_heading = FILM)]
    dt: Option<String>,

    #[command(flatten)]
    options: ProgramOptions,

    #[command(flatten)]
    look: LookArgs,

    #[command(flatten)]
    common: CommonArgs,
}

const FILM: &str = "Film";

const EXAMPLES: &str = "Examples:
  ugfilm -frames 40 -vel .9 0 0 -ti 3..36 -va 90 -look shape -sz 640 240 -fo pass.gif teapot.ug
  ugfilm -frames 40 -cv '0 0 0 .. 0 .99 0' -fo drive_%04d.png street.ug
  ugfilm -rays -frames 20 -vel .95 0 0 -ti -4..4 -fo shadow.apng shadow.ug";

/// Frames by number.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Ranges(Vec<[u32; 2]>);

/// True for films of scenes: a panorama has no faces.
fn has_faces(matches: &ArgMatches) -> bool {
    !is_given(matches, "warp")
}

impl ToolArgs for Args {
    const ESSENTIAL: &'static [&'static str] = &[
        "--frames", "-vel", "-cv", "-ti", "-ep", "-look", "-ex", "-sz", "-rays", "-only",
        "--print", "-fo",
    ];

    const LOOKS: Looks = Looks {
        default: Look::Light,
        light: &[
            ShiftArgs::SPECTRA,
            RepeatArgs::APART.with(has_faces),
            PictureArgs::AUTO_EXPOSURE,
            PictureArgs::FILMIC,
        ],
        shape: &[
            ShiftArgs::REST_WAVELENGTHS,
            ShiftArgs::REST_BRIGHTNESS,
            RepeatArgs::APART.with(has_faces),
        ],
    };

    fn common(&self) -> &CommonArgs {
        &self.common
    }
}

/// The whole program between its streams: reads the scene, draws the frames, writes them.
///
/// # Errors
/// Bad usage, a bad scene, or a stream that fails.
pub fn run(args: &Args, context: &mut Context) -> Result<(), Failure> {
    let output = Output::new(args.dt.as_deref(), args.sheet.is_some(), context.output_name())?;
    let keep = args.keep.as_deref().map(|names| names_of(names, "--keep")).transpose()?;
    let has_rate = matches!(output, Output::Film(kind) if kind != FilmKind::Ppm);
    if args.fps.is_some() && !has_rate && args.print.is_none() {
        return Err(Failure::usage(
            "numbered frames, ppm and sheets have no frames a second: leave out -fps",
        ));
    }
    if keep.is_some() && !matches!(output, Output::Film(_)) {
        return Err(Failure::usage(
            "--keep is for films in one file: leave it out, or give -fo film.apng",
        ));
    }
    if args.across.is_some()
        && !matches!(output, Output::Film(FilmKind::Html))
        && args.print.is_none()
    {
        return Err(Failure::usage("-across is for pages: give -fo FILE.html"));
    }
    let rate = args.fps.unwrap_or(DEFAULT_RATE);
    let mut script = args.script(context)?;
    let frames = args.numbers(script.n_frames)?;
    let follows = script.fixed("ex").is_some_and(|word| word == "follow");
    if follows && args.across.is_some() {
        return Err(Failure::usage(
            "-ex follow is for films with one slider: leave out -across, or give -ex hold",
        ));
    }
    if follows || script.fixed("ex").is_some_and(|word| word == "hold") {
        script.set("ex", vec!["auto".to_owned()]);
    }
    let read = Read::new(args, &mut script, &frames, context)?;
    let mut forecast = Forecast::default();
    if let Read::Scene(scene) = &read {
        if args.follow {
            follow(scene, &mut script)?;
        }
        if script.lacks_speeds() {
            script.speeds = Sight::new(scene, &script).speeds();
        }
        if args.print.is_none() && !context.is_quiet() {
            let unseen = Sight::new(scene, &script).unseen(&frames);
            tell_unseen(&unseen, context);
            forecast.empty = unseen.frames;
        }
    }
    if let (Output::Film(kind), None) = (&output, args.print) {
        check_kind(*kind, rate, &script, context)?;
    }
    let format = output.frame_format();
    let blur = args.blur.map(|open| MotionBlur { open, n_moments: args.moments });
    let mut light = HeldLight::default();
    if script.fixed("ex").as_deref() == Some("auto") {
        let subjects = read.subjects(&script);
        let film = Film { subjects, script: &script, format, blur, light: HeldLight::default() };
        let names = output.names().or(keep.as_ref()).filter(|_| args.sheet.is_none());
        let measured = exposure(&film, follows, names, args.print.is_some(), context)?;
        let least = measured.stops.iter().map(|(_, stops)| *stops).reduce(f64::min).unwrap_or(0.0);
        let most = measured.stops.iter().map(|(_, stops)| *stops).reduce(f64::max).unwrap_or(0.0);
        let told = if least == most {
            format!("one exposure for all frames: -ex {least}")
        } else {
            format!(
                "the exposure follows the light, from -ex {least} to {most}; -ex hold gives all frames one"
            )
        };
        context.note(&told);
        tell_wrong(&measured.wrong, measured.n_frames, "measured", context);
        let keys = measured
            .stops
            .iter()
            .map(|&(frame, stops)| (script.time(f64::from(frame)), vec![stops]));
        let exposure = match least == most {
            true => Timeline::Fixed(vec![least.to_string()]),
            false => Timeline::through(keys.collect(), Quantity::Plain).map_err(Failure::Failed)?,
        };
        script.set_timeline("ex", exposure);
        (forecast.wrong, light) = (measured.wrong, measured.light);
    }
    if blur.is_some() && script.get("ex").is_none() && !format.is_linear() {
        script.set("ex", vec!["0".to_owned()]);
    }
    let film = Film { subjects: read.subjects(&script), script: &script, format, blur, light };
    if let Some(number) = args.print {
        let input = args.common.input().map(Path::to_owned).map(argument);
        let chosen = frames.into_iter().filter(|&frame| number == 0 || frame == number);
        let text = print::script(&film, chosen, &output.frame_names(), input.as_deref())?;
        if text.is_empty() {
            return Err(Failure::Usage(format!("--print {number}: the film has no such frame")));
        }
        return context.print(&text);
    }
    let names = output.names().or(keep.as_ref());
    if context.output_is_terminal() && !matches!(output, Output::Files(..)) {
        return Err(Failure::usage("a film is not written to a terminal; give -fo FILE"));
    }
    if film.script.is_still() && frames.len() > 1 && !matches!(read, Read::Series(_)) {
        context.note(
            "no option has several values, so all frames are alike; give one, such as -ti 0..10",
        );
    }
    let summary = match &output {
        Output::Files(names, _) => {
            film.size()?;
            film.write_files(&frames, names, &context.steps())?
        }
        Output::Film(kind) => {
            let caption = |&frame: &u32| -> Result<Caption, Failure> {
                let input = args.common.input().map(Path::to_owned).map(argument);
                let names = output.frame_names();
                let line = print::script(&film, std::iter::once(frame), &names, input.as_deref())?;
                Ok(Caption { values: script.changing(f64::from(frame))?, line })
            };
            let captions = frames.iter().filter(|_| *kind == FilmKind::Html).map(caption);
            let captions = captions.collect::<Result<Vec<_>, _>>()?;
            film.write_film(&frames, (*kind, rate), captions, keep.as_ref(), context)?
        }
        Output::Sheet => {
            let chosen = args.sheet.filter(|_| args.only.is_none());
            let frames = chosen.map_or(frames, |most| film.spread(most));
            let (sheet, pictures) = film.sheet(&frames, &context.steps())?;
            let history = ugsheet::history(&pictures, Some(context.command_line()));
            return context.write(&Format::Png.encode(&sheet, &history));
        }
    };
    names.into_iter().for_each(|names| remove_kept_exposure(names, args.frames));
    tell(&summary, &forecast, context);
    Ok(())
}

/// Refuses a film that its format cannot hold.
fn check_kind(
    kind: FilmKind,
    rate: f64,
    script: &Script,
    context: &Context,
) -> Result<(), Failure> {
    // A frame that is wrong is reported when it is drawn.
    let Ok(Pipe { picture, .. }) = script.pipe(1.0, &[], Format::Png) else { return Ok(()) };
    let name = kind.name();
    if !kind.has_alpha() && picture.background == Background::Transparent {
        let message =
            format!("{name} is not transparent: leave out -tb, or write an apng, gif or webm");
        return Err(Failure::Usage(message));
    }
    if picture.small {
        return Err(Failure::Usage(format!(
            "-pz packs PNG files, not a film in {name}: leave it out"
        )));
    }
    let [width, height] = picture.size.map(|side| side.next_multiple_of(2));
    if kind == FilmKind::Mp4 && picture.size != [width, height] {
        let message = format!(
            "widths and heights of mp4 are even: give -sz {width} {height}, or write a webm"
        );
        return Err(Failure::Usage(message));
    }
    if kind == FilmKind::Gif && rate > MOST_GIF_RATE {
        context.note(&format!(
            "browsers play a gif at {MOST_GIF_RATE} frames a second at most: it has this rate, not {rate}"
        ));
    }
    Ok(())
}

/// The exposure of all frames. Beside files of frames it is kept for the next start, if they can be
/// written there, unless their commands are only printed.
fn exposure(
    film: &Film<'_>,
    follows: bool,
    names: Option<&FrameNames>,
    is_printed: bool,
    context: &Context,
) -> Result<MeasuredExposure, Failure> {
    film.size()?;
    let Some(names) = names else { return film.exposure(follows, &context.steps()) };
    let key = film.exposure_key(follows)?;
    if let Some(stops) = kept_exposure(names, &key) {
        return Ok(MeasuredExposure { stops, ..MeasuredExposure::default() });
    }
    let measured = film.exposure(follows, &context.steps())?;
    if !is_printed {
        // Where it cannot be written the frames cannot either, which is told of them.
        let _ = keep_exposure(names, &key, &measured.stops);
    }
    Ok(measured)
}

/// Turns the camera of every frame toward what moves.
fn follow(scene: &Scene, script: &mut Script) -> Result<(), Failure> {
    let is_placed = matches!(script.get("vc"), Some(timeline) if timeline.is_moving());
    if is_placed {
        return Err(Failure::usage(
            "-follow moves the view centre: leave out -vc with several values",
        ));
    }
    let centers = Sight::new(scene, script).centers()?;
    script.set_timeline("vc", centers);
    Ok(())
}

/// Says before a film is drawn in which frames nothing will be in the picture.
fn tell_unseen(unseen: &Unseen, context: &Context) {
    let Unseen { n_frames, frames, when } = unseen;
    if frames.is_empty() {
        return;
    }
    let remedy = match when {
        Some(when) => format!("what moves is in it with -ti {when}"),
        None => "move the eye (-ep) or the view centre (-vc), widen -va, or try -in or -follow"
            .to_owned(),
    };
    let (count, list) = (frames.len(), ranges_of(frames));
    context.note(&format!(
        "nothing will be in the picture in {count} of {n_frames} frames, {list}: {remedy}"
    ));
}

/// Says which of `n_frames` frames that were measured or drawn are nearly black or overexposed.
fn tell_wrong(wrong: &WrongBrightness, n_frames: usize, what_was_done: &str, context: &Context) {
    let findings = [
        (&wrong.nearly_black, ugpicture::Note::NearlyBlack { is_exposed: true }, DARK_REMEDY),
        (&wrong.overexposed, ugpicture::Note::Overexposed, BRIGHT_REMEDY),
    ];
    for (frames, finding, remedy) in findings.into_iter().filter(|(frames, ..)| !frames.is_empty())
    {
        // Measured frames are spread over the film, so a list of all of them is long.
        let which = match frames.len() {
            count if count == n_frames => {
                format!("all {n_frames} frames that were {what_was_done}")
            }
            count => {
                format!(
                    "{count} of {n_frames} frames that were {what_was_done}, {}",
                    ranges_of(frames)
                )
            }
        };
        context.note(&format!("{finding} in {which}: {remedy}"));
    }
}

/// The findings about frames that were printed before the film is drawn.
#[derive(Default)]
struct Forecast {
    /// Frames in which nothing will be in the picture.
    empty: Vec<u32>,
    /// Frames whose brightness will be wrong.
    wrong: WrongBrightness,
}

/// Says after a film is drawn what its forecast does not name.
fn tell(summary: &Summary, forecast: &Forecast, context: &Context) {
    let is_of_levels =
        |note: &crate::note::Note| note.of_picture().is_some_and(ugpicture::Note::is_of_levels);
    let notes =
        summary.notes.iter().filter(|note| !is_of_levels(note)).flat_map(crate::note::Note::words);
    notes.for_each(|note| context.note(&format!("first frame: {note}")));
    let Summary { n_drawn, n_done, n_elsewhere, empty, black, wrong, .. } = summary;
    let empty = &unless_all_are_in(&forecast.empty, empty);
    let wrong = WrongBrightness {
        nearly_black: unless_all_are_in(&forecast.wrong.nearly_black, &wrong.nearly_black),
        overexposed: unless_all_are_in(&forecast.wrong.overexposed, &wrong.overexposed),
    };
    let shares = [
        (
            empty,
            "nothing is in the picture",
            "try other times -ti, -in, another -vc or a wider -va",
        ),
        (black, "all that is in the picture is black", "try -look light, or -look shape"),
    ];
    for (frames, finding, remedy) in shares.into_iter().filter(|(frames, ..)| !frames.is_empty()) {
        let (count, list) = (frames.len(), ranges_of(frames));
        context.note(&format!(
            "{finding} in {count} of {n_drawn} frames that were drawn, {list}: {remedy}"
        ));
    }
    tell_wrong(&wrong, *n_drawn as usize, "drawn", context);
    if *n_done + *n_elsewhere > 0 {
        let elsewhere = match n_elsewhere {
            0 => String::new(),
            _ => format!(", {n_elsewhere} are drawn by another process"),
        };
        context.note(&format!("{n_drawn} frames drawn, {n_done} were there already{elsewhere}"));
    }
}

/// Frames, unless all of them are among those of a forecast. Both increase.
fn unless_all_are_in(forecast: &[u32], frames: &[u32]) -> Vec<u32> {
    let is_told = frames.iter().all(|frame| forecast.binary_search(frame).is_ok());
    if is_told { Vec::new() } else { frames.to_vec() }
}

/// Increasing numbers as ranges: `1..12, 17, 20..40`.
fn ranges_of(numbers: &[u32]) -> String {
    let runs = numbers.chunk_by(|a, b| a + 1 == *b).map(|run| match run {
        [first, .., last] => format!("{first}..{last}"),
        [only] => only.to_string(),
        [] => String::new(),
    });
    runs.collect::<Vec<_>>().join(", ")
}

/// The input that was read.
enum Read {
    /// A scene.
    Scene(Box<Scene>),
    /// A panorama, and the record of the files that were read for it.
    Panorama(Box<ugwarp::Opened>, Vec<String>),
    /// Panoramas that are opened frame by frame.
    Series(Box<Series>),
}

impl Read {
    /// Reads the input. A scene without a camera gets one for all frames. `frames`: those to draw.
    fn new(
        args: &Args,
        script: &mut Script,
        frames: &[u32],
        context: &mut Context,
    ) -> Result<Self, Failure> {
        if args.pipe.warp {
            if let Some(series) = Series::of_files(&args.common, script, frames, context)? {
                return Ok(Self::Series(series.into()));
            }
            let input = context.input()?;
            if script.opens_each() {
                let path = args.common.input().map(Path::to_owned);
                let pictures = Pictures::One(path, input);
                return Ok(Self::Series(Series::new(pictures, script, context)?.into()));
            }
            let opened = args.panorama(script, &input, context)?;
            opened.notes.iter().for_each(|note| context.note(note));
            return Ok(Self::Panorama(Box::new(opened), context.take_record(&input)));
        }
        let reading = pipe::options(&args.common)?;
        let input = pipe::input(context, &reading)?;
        let source = pipe::follow(input, &reading, context).map_err(pipe::refused)?;
        let camera = script.fixed("cam");
        let mut parsed = ugparse::read(&source, &reading, camera.as_deref())
            .map_err(|findings| refused_sky(&source).unwrap_or_else(|| pipe::refused(findings)))?;
        if !parsed.warnings.is_empty() {
            context.report(&parsed.warnings.report());
        }
        if parsed.scene.drawn_texture_name().is_some() {
            script.draw_textures();
        }
        script.open_sky((&source, &reading), &args.common, context)?;
        parsed.scene.head.files.extend(context.take_files_read());
        if args.print.is_some() && !args.pipe.rays {
            let note = pipe::outside_files(&parsed.scene, context);
            note.into_iter().for_each(|note| context.note(note));
        }
        if let Some(camera) = default_camera(&parsed.scene, script)? {
            context.note(&format!("{}, in all frames", Note::DefaultCamera(camera).words()));
            let words = |point: [f64; 3]| point.map(|part| part.to_string()).to_vec();
            script.set("ep", words(camera.eye.to_array()));
            script.set("vc", words(camera.center.to_array()));
            script.set("va", vec![camera.view_angle_deg.to_string()]);
        }
        Ok(Self::Scene(Box::new(parsed.scene)))
    }

    fn subjects<'s>(&'s self, script: &'s Script) -> Subjects<'s> {
        match self {
            Self::Scene(scene) => Subjects::Same(FilmSubject::Scene(scene)),
            Self::Panorama(opened, files) => Subjects::Same(FilmSubject::Panorama(opened, files)),
            Self::Series(series) => Subjects::Each(series, script),
        }
    }
}

/// The failure for a file that is a picture or a list of stars.
fn refused_sky(source: &Source) -> Option<Failure> {
    if source.name.starts_with('<') {
        return None;
    }
    let (is, what) = match ugmeshfile::foreign_data(&source.name, &source.text)? {
        Foreign::Picture => ("a picture", "it as the sky around an observer in motion"),
        Foreign::Table => ("a table", "a list of stars"),
        _ => return None,
    };
    let (name, argument) = (&source.name, shell_word(&source.name));
    Some(Failure::failed(format!(
        "`{name}` is not a scene but {is}; with -warp, ugfilm shows {what}, as `ugwarp {argument}` does in one picture"
    )))
}

/// Steps from the first frame to the last, at which the camera of all frames is fitted.
const FITTED_STEPS: u32 = 16;

/// The camera of all frames, if the scene has none and the options give none.
fn default_camera(scene: &Scene, script: &Script) -> Result<Option<DefaultCamera>, Failure> {
    if ["ep", "vc", "va"].iter().any(|name| script.get(name).is_some()) {
        return Ok(None);
    }
    // Frames that are wrong are reported when they are drawn.
    let motion = |step: u32| {
        let frame =
            1.0 + f64::from(step) / f64::from(FITTED_STEPS) * f64::from(script.n_frames - 1);
        script.pipe(frame, &[], Format::Png).ok()?.programs().iter().find_map(Program::motion)
    };
    let motions: Vec<MotionOptions> = (0..=FITTED_STEPS).filter_map(motion).collect();
    let options =
        CameraOptions { is_ahead: script.get("ahead").is_some(), ..CameraOptions::default() };
    ugscene::common_camera(scene, &options, [4, 3], &motions)
        .map_err(|error| Failure::failed(error.words()))
}

impl Args {
    fn script(&self, context: &Context) -> Result<Script, Failure> {
        let mut script = Script::new(self.pipe.tools(&self.options.given), self.frames);
        script.ease = self.ease;
        script.is_loop = self.is_loop;
        script.reading = self.common.reading_words();
        self.options.given.iter().try_for_each(|option| script.add(option))?;
        if let Some([name, n_values]) = self.across.as_deref() {
            let n_values = whole(1..=1_000)(n_values)
                .map_err(|why| Failure::Usage(format!("-across: {why}")))?;
            script.set_across(name.trim_start_matches('-'), n_values)?;
        }
        if let Some(path) = &self.keys {
            let file = context.input_file(path)?;
            let text = String::from_utf8_lossy(&file.text);
            keys::add(&mut script, &file.name, &text).map_err(Failure::Failed)?;
            // Its numbers are in the commands of the frames, which do not read it.
            context.take_files_read();
        }
        script.leave_whole();
        Ok(script)
    }

    /// The panorama of a file, of which the first frame says which part of the sphere it is, and
    /// stars.
    fn panorama(
        &self,
        script: &Script,
        input: &Input,
        context: &Context,
    ) -> Result<ugwarp::Opened, Failure> {
        let words = script.opening(1.0)?;
        parse_words::<ugwarp::Args>(words.into_iter().map(OsString::from))?.open(input, context)
    }

    /// The numbers of the frames to draw.
    fn numbers(&self, n_frames: u32) -> Result<Vec<u32>, Failure> {
        let Some(Ranges(ranges)) = &self.only else { return Ok((1..=n_frames).collect()) };
        let mut ranges = ranges.clone();
        ranges.sort_unstable();
        // No frame twice, however often it is given.
        let mut frames: Vec<u32> = Vec::new();
        for [first, last] in ranges {
            if last > n_frames {
                return Err(Failure::Usage(format!("--only: the film has {n_frames} frames")));
            }
            let next = frames.last().map_or(1, |frame| frame + 1);
            frames.extend(first.max(next)..=last);
        }
        Ok(frames)
    }
}

/// `1,5,9..12`.
fn ranges(list: &str) -> Result<Ranges, String> {
    let number = |word: &str| word.parse().ok().filter(|number: &u32| *number > 0);
    let range = |part: &str| {
        let (first, last) = part.split_once("..").unwrap_or((part, part));
        let range = [number(first)?, number(last)?];
        (range[0] <= range[1]).then_some(range)
    };
    let ranges: Option<Vec<[u32; 2]>> = list.split(',').map(range).collect();
    ranges.map(Ranges).ok_or_else(|| "write frames as 40..59 or 1,5,9".to_owned())
}

fn shutter_time(word: &str) -> Result<f64, String> {
    let time = finite(word)?;
    if time > 0.0 && time <= 1000.0 { Ok(time) } else { Err("above 0, at most 1000".to_owned()) }
}
