//! The command line of `ugsheet`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{ArgAction, Parser, ValueEnum};
use ugimage::{
    Format, Frame, Metadata, PictureLimits, ReadError, read_history, read_png, read_png_header,
    spelled_color,
};
use ugpipe::{
    CommonArgs, Context, Failure, Input, MAX_INPUT, PIXELS_PER_INCH, Side, ToolArgs, Words, finite,
    one_of, sha256, whole,
};

use crate::film::{self, Caption, FilmFile, FilmKind, Footage, FrameNames, Joined};
use crate::recipe::{Recipe, recipes};
use crate::{Config, Error, Labels, Motion, Picture, Sheet, history, join, recorded_files};

/// Arranges several pictures or films on one sheet, with labels
///
/// Reads PNG files and arranges them in a grid, without resampling them unless -sz gives the width
/// of the sheet. By default the labels are the speeds and times recorded in the history of the
/// pictures, if these differ; otherwise the file names.
///
/// Films are joined to one film, frame by frame: GIF, animated PNG, names of numbered files as
/// frame_%04d.png, or folders of these. A film that ends before the others holds its last frame; a
/// picture is shown all the time.
#[derive(Parser, Debug)]
#[command(name = "ugsheet", version, after_help = EXAMPLES)]
pub struct Args {
    /// Pictures per row [default: about as many as rows]
    #[arg(long, value_name = "N", visible_alias = "columns", value_parser = whole(1..=u32::MAX))]
    cols: Option<u32>,

    /// Label of a picture; give it once for each picture, in order
    #[arg(long, value_name = "TEXT", action = ArgAction::Append, conflicts_with = "lb")]
    label: Vec<String>,

    /// Kind of labels if --label is not given
    #[arg(long, value_name = "KIND", default_value = "auto", visible_alias = "labels", value_enum)]
    lb: LabelKind,

    /// Number the labels with (a), (b), …
    #[arg(long, visible_alias = "letters")]
    lt: bool,

    /// Title above the pictures
    #[arg(long, value_name = "TEXT")]
    title: Option<String>,

    /// Caption below the pictures; long lines are wrapped
    #[arg(long, value_name = "TEXT", visible_alias = "caption")]
    cap: Option<String>,

    /// Text size of labels in pixels [default: 1/28 of the size of the pictures, 10 to 48]
    #[arg(long, value_name = "PIXELS", value_parser = text_size, visible_alias = "text-size")]
    ts: Option<f64>,

    /// Width and height of the sheet in pixels, or in mm, cm, in, pt
    ///
    /// All pictures are scaled by one factor. A length has as many pixels to the inch as the
    /// pictures state, otherwise 300, which the sheet states; its labels have 8 pt by default.
    /// Without -sz the sheet states the resolution of its pictures.
    #[arg(long, num_args = 1..=2, value_names = ["W", "H"], action = ArgAction::Set,
          value_parser = Side::parse, visible_alias = "size")]
    sz: Option<Vec<Side>>,

    /// Frames a second of a film [default: those of the films that are joined, else 25]
    #[arg(long, value_name = "RATE", value_parser = film::rate)]
    fps: Option<f64>,

    /// Pixels between pictures, and margin M around all [default: 0.9 of the text size]
    #[arg(long, num_args = 1..=2, value_names = ["N", "M"], action = ArgAction::Set,
          value_parser = whole(0..=10_000))]
    gap: Option<Vec<u32>>,

    /// Background colour: lightness, hue in degrees, saturation; a name, or #rrggbb [default:
    /// white]
    #[arg(long, num_args = 1..=3, value_names = ["L", "H", "S"], action = ArgAction::Set,
          visible_alias = "background")]
    bg: Option<Vec<String>>,

    /// Output format [default: by the extension of -fo, else png]
    ///
    /// Of films: apng, gif, y4m, ppm, html, mp4 and webm with ffmpeg; or numbered files, -fo
    /// sheet_%04d.png. Their widths and heights are even.
    #[arg(long, value_name = "FMT", visible_alias = "format", value_parser = one_of("formats", FORMATS.map(|name| (name, name.to_owned()))))]
    dt: Option<String>,

    /// Instead of a sheet, print the pipe that drew a picture, for a shell
    ///
    /// For files in png, exr, hdr, ppm, pdf, svg, eps and ps, in the folder where the pipe was run.
    /// A comment has the SHA-256 of the scene, and a warning says whether the scene has changed.
    /// Pipes that run other programs or write files are refused, and those with --allow-execute or
    /// --allow-outside, unless that option is given here, too.
    #[arg(long, conflicts_with_all = ["cols", "label", "lb", "lt", "title", "cap", "ts", "gap", "bg", "dt", "sz", "fps"])]
    history: bool,

    /// Join the tiles of a picture, drawn with -crop, to the whole picture
    ///
    /// Tiles are PNG files that were drawn by one command but for their -crop. The result is the
    /// file that the command without -crop writes. Their order does not matter.
    #[arg(long, conflicts_with_all = ["history", "cols", "label", "lb", "lt", "title", "cap", "ts", "gap", "bg", "dt", "sz", "fps"])]
    tiles: bool,

    #[command(flatten)]
    common: CommonArgs,

    /// More files to read, one for each picture
    #[arg(value_name = "FILE")]
    files: Vec<PathBuf>,
}

const EXAMPLES: &str = "Examples:
  ugsheet -cols 2 rest.png 0.5c.png 0.9c.png 0.99c.png > sheet.png
  ugsheet -lt --label 'at rest' --label 'β = 0.9' -cap 'A ship passes' rest.png fast.png > ship.png
  ugsheet -sz 17.8cm -lt -fo figure.png rest.png fast.png
  ugsheet -fo both.gif film.gif frame_%04d.png
  ugsheet --tiles tile_*.png > whole.png
  ugsheet --history rest.png";

#[derive(Clone, Copy, Debug, ValueEnum)]
enum LabelKind {
    /// Speed and time if the pictures differ in them, else file names
    Auto,
    /// File names
    Names,
    /// No labels
    None,
}

const NO_TERMINAL: &str =
    "a picture is not written to a terminal; send it to a file with `> FILE` or -fo FILE";

/// Largest text size, in pixels.
const LARGEST: f64 = 1000.0;

fn text_size(word: &str) -> Result<f64, String> {
    let size = finite(word)?;
    if (4.0..=LARGEST).contains(&size) {
        Ok(size)
    } else {
        Err(format!("the text size must be from 4 to {LARGEST} pixels"))
    }
}

/// Names of formats of pictures and of films.
const FORMATS: [&str; 12] =
    ["png", "ppm", "eps", "ps", "pdf", "svg", "apng", "gif", "y4m", "html", "mp4", "webm"];

fn picture_format(name: &str) -> Option<Format> {
    Format::from_name(name).filter(|format| !format.is_deep())
}

/// Text size of labels on a sheet whose width is a length, in points.
const LABEL_POINTS: f64 = 8.0;

impl ToolArgs for Args {
    const ESSENTIAL: &'static [&'static str] =
        &["-sz", "-cols", "--label", "-lb", "-lt", "-cap", "-ts", "-gap", "-bg", "-dt", "-fo"];

    fn common(&self) -> &CommonArgs {
        &self.common
    }
}

impl Args {
    /// `per_inch`: pixels in an inch of the pictures, if they state it.
    fn config(&self, per_inch: Option<f64>) -> Result<(Config, Option<f64>), Failure> {
        let kind = match self.lb {
            LabelKind::Auto => Labels::Auto,
            LabelKind::Names => Labels::Names,
            LabelKind::None => Labels::None,
        };
        let mut size = None;
        let mut text_size = self.ts;
        let mut resolution = per_inch;
        if let Some(sides) = &self.sz {
            let density = per_inch.unwrap_or(PIXELS_PER_INCH);
            let is_length = sides.iter().any(|side| side.is_length());
            let pair = [sides[0], sides.get(1).copied().unwrap_or(sides[0])];
            let [width, height] = Side::both(&pair, density).map_err(Failure::Usage)?;
            size = Some((width, sides.get(1).map(|_| height)));
            resolution = is_length.then_some(density);
            text_size = text_size.or(resolution.map(|density| LABEL_POINTS / 72.0 * density));
        }
        let config = Config {
            columns: self.cols,
            labels: if self.label.is_empty() { kind } else { Labels::Given(self.label.clone()) },
            letters: self.lt,
            title: self.title.clone().unwrap_or_default(),
            caption: self.cap.clone().unwrap_or_default(),
            background: self.background()?,
            gap: self.gap.as_ref().map(|gap| [gap[0], gap.get(1).copied().unwrap_or(gap[0])]),
            text_size,
            size,
            is_even: false,
        };
        Ok((config, resolution))
    }

    /// The background colour.
    fn background(&self) -> Result<[u8; 3], Failure> {
        let Some(words) = &self.bg else { return Ok([255; 3]) };
        let color = spelled_color(words, finite)
            .map_err(|error| Failure::usage(format!("background -bg: {error}")))?;
        Ok(color.to_rgb().map(|part| (255.0 * part).round() as u8))
    }

    /// The limits of each picture that is read.
    fn limits(&self) -> PictureLimits {
        let default = PictureLimits::default();
        PictureLimits { bytes: self.common.memory_limit().unwrap_or(default.bytes), ..default }
    }

    /// The format by name: that of -dt, or the ending of a file.
    fn format_name(&self, file: Option<&Path>) -> Option<String> {
        let ending = || Some(file?.extension()?.to_string_lossy().into_owned());
        self.dt.clone().or_else(ending)
    }

    fn format(&self, file: Option<&Path>) -> Result<Format, Failure> {
        let Some(name) = self.format_name(file) else { return Ok(Format::Png) };
        picture_format(&name).ok_or_else(|| match FilmKind::from_name(&name) {
            Some(_) => Failure::Usage(format!(
                "`{name}` is a format of films, and the pictures are no films"
            )),
            None => {
                let names = FORMATS.join(", ");
                Failure::Usage(format!(
                    "`.{name}` is not one of the formats {names}; name one with -dt"
                ))
            }
        })
    }
}

/// The picture of an input, without its pixels. `path` is its file, `None` for standard input.
fn picture(path: Option<&Path>, input: &Input) -> Result<Picture, Failure> {
    let (size, history) =
        read_png_header(&input.text).map_err(|error| unreadable(input, &error))?;
    let name = path.and_then(Path::file_stem).map(|stem| stem.to_string_lossy().into_owned());
    let motion = Motion::recorded(&history);
    Ok(Picture { name: name.unwrap_or_default(), size, motion, history })
}

/// The failure of a sheet that cannot be laid out.
fn refused(error: &Error) -> Failure {
    match error {
        Error::Count { .. } | Error::Text { .. } | Error::Narrow => Failure::usage(error.words()),
        error => Failure::failed(error.words()),
    }
}

/// Joins tiles to a whole picture.
fn print_joined(args: &Args, context: &mut Context) -> Result<(), Failure> {
    if context.output_is_terminal() {
        return Err(Failure::usage(NO_TERMINAL));
    }
    if args.format(context.output_name())? != Format::Png {
        return Err(Failure::usage("--tiles writes the picture as PNG, the format of its tiles"));
    }
    let limits = args.limits();
    let mut inputs = vec![context.input()?];
    for path in &args.files {
        inputs.push(context.input_file(path)?);
    }
    let tile = |input: &Input| {
        let (size, history) =
            read_png_header(&input.text).map_err(|error| unreadable(input, &error))?;
        Ok(Picture { name: input.name.clone(), size, motion: Motion::default(), history })
    };
    let tiles =
        inputs.iter().map(tile).collect::<Result<Vec<_>, Error>>().map_err(Failure::failed)?;
    let frame_of = |idx: usize| {
        // Each file is needed once.
        let input = Input { text: std::mem::take(&mut inputs[idx].text), ..inputs[idx].clone() };
        read_png(&input.text, &limits)
            .map(|(frame, _)| frame)
            .map_err(|error| unreadable(&input, &error))
    };
    let (frame, history) =
        join(&tiles, frame_of).map_err(|error| Failure::failed(error.words()))?;
    context.write(&Format::Png.encode(&frame, &history))
}

fn unreadable(input: &Input, error: &ReadError) -> Error {
    if let Some(format) = vector_format(&input.text) {
        return Error::Picture(format!(
            "`{}` is a {format} file, and a sheet consists of PNG files; draw it as PNG, or place the \
             figures side by side in LaTeX, each with `\\includegraphics` in a `minipage`",
            input.name
        ));
    }
    let remedy = CommonArgs::memory_remedy(error.needed_memory());
    Error::Picture(format!("`{}`: {error}{remedy}", input.name))
}

/// The format of a file that may hold a vector figure; `None` for other files.
fn vector_format(file: &[u8]) -> Option<&'static str> {
    let file = file.strip_prefix(b"\xef\xbb\xbf").unwrap_or(file).trim_ascii_start();
    match file {
        [b'%', b'P', b'D', b'F', b'-', ..] => Some("PDF"),
        [b'%', b'!', ..] => Some("PostScript"),
        [b'<', ..] => Some("SVG"),
        _ => None,
    }
}

impl Words for Error {
    fn words(&self) -> String {
        let remedy = match self {
            Self::Count { .. } => ": give -label once for each picture, in order, or not at all",
            Self::Text { .. } => "; change the text, or use -label or -lb none",
            Self::Narrow => "; make it larger with -sz, or give fewer -cols, a smaller -ts or -gap",
            Self::NoPart { .. } => " (-crop)",
            Self::NoWholeSize { .. } => ": draw all tiles with -sz W H",
            Self::Memory { .. } => "; make it smaller with -ts, fewer pictures or smaller ones",
            Self::Empty | Self::Size | Self::Picture(_) => "",
        };
        format!("{self}{remedy}")
    }
}

/// Prints the pipes that drew the pictures.
fn print_history(args: &Args, context: &mut Context) -> Result<(), Failure> {
    let mut inputs = vec![context.input()?];
    for path in &args.files {
        inputs.push(context.input_file(path)?);
    }
    let mut script = String::new();
    for Input { name, text } in &inputs {
        let history = read_history(text).unwrap_or_default();
        let recipes = recipes(&history, &args.common);
        let recipes = recipes.map_err(|why| {
            Failure::failed(format!("the history of `{name}` must not be run: {why}"))
        })?;
        if recipes.is_empty() {
            return Err(Failure::failed(format!(
                "`{name}` has no history that can be run: another program drew it, or its texts were removed"
            )));
        }
        for recipe in &recipes {
            inspect(recipe, context);
            script += &recipe.script();
        }
        recorded_files::inspect(&history, context);
        if recipes.len() > 1 {
            let n = recipes.len();
            context.note(&format!(
                "`{name}` has {n} pipes: send the output of each to a file of its own"
            ));
        }
    }
    context.write_text(&script)
}

/// Says what a pipe needs to give the same picture.
fn inspect(recipe: &Recipe, context: &Context) {
    match &recipe.scene {
        None => {
            context.note("the scene was read from standard input: run the pipe with the same input")
        }
        Some(scene) => match context.read_here(Path::new(scene), MAX_INPUT) {
            Ok(text) if sha256(&text) == recipe.sha256 => {}
            Ok(_) => context.warn(&format!("`{scene}` has changed since the picture was drawn")),
            Err(_) => context
                .note(&format!("`{scene}` is not in this folder: run the pipe in its folder")),
        },
    }
    let version = env!("CARGO_PKG_VERSION");
    if recipe.versions.split(", ").any(|program| program.split(' ').next_back() != Some(version)) {
        let versions = &recipe.versions;
        context.note(&format!("drawn by {versions}; other versions may draw another picture"));
    }
}

/// The program.
pub fn main() -> ExitCode {
    ugpipe::main(|args: &Args, context: &mut Context| {
        if args.history {
            return print_history(args, context);
        }
        if args.tiles {
            return print_joined(args, context);
        }
        let paths: Vec<Option<&Path>> = std::iter::once(args.common.input())
            .chain(args.files.iter().map(|path| Some(path.as_path())))
            .collect();
        let mut inputs = Vec::new();
        for (row, path) in paths.iter().enumerate() {
            inputs.push(match path {
                Some(path) if film::names_frames(path) => None,
                Some(path) if row > 0 => Some(context.input_file(path)?),
                _ => Some(context.input()?),
            });
        }
        let is_picture = |input: &Input| !film::is_film(&input.text);
        if inputs.iter().all(|input| input.as_ref().is_some_and(is_picture)) {
            let inputs: Vec<Input> = inputs.into_iter().flatten().collect();
            return print_sheet(args, &paths, &inputs, context);
        }
        let (limits, mut films) = (args.limits(), Vec::new());
        for (path, input) in paths.into_iter().zip(inputs) {
            films.push(match (input, path) {
                (Some(input), _) => Footage::in_file(path, input, limits)?,
                (None, path) => Footage::in_files(path.unwrap_or(Path::new(".")), context, limits)?,
            });
        }
        print_film(args, &films, context)
    })
}

/// Makes a sheet of pictures.
fn print_sheet(
    args: &Args,
    paths: &[Option<&Path>],
    inputs: &[Input],
    context: &mut Context,
) -> Result<(), Failure> {
    let pictures = paths.iter().zip(inputs).map(|(path, input)| picture(*path, input));
    let pictures = pictures.collect::<Result<Vec<_>, _>>()?;
    let format = args.format(context.output_name())?;
    if context.output_is_terminal() && format.is_binary() {
        return Err(Failure::usage(NO_TERMINAL));
    }
    let stated: Vec<f64> = pictures.iter().filter_map(|picture| picture.history.per_inch).collect();
    let per_inch =
        stated.first().copied().filter(|first| stated.iter().all(|other| other == first));
    if per_inch.is_none() && !stated.is_empty() && args.sz.is_none() {
        context.note(
            "the pictures have different resolutions, so the sheet states none: give its width, -sz 17.8cm",
        );
    }
    let (config, per_inch) = args.config(per_inch)?;
    let sheet = Sheet::new(&config, &pictures).map_err(|error| refused(&error))?;
    tell_scaled(&sheet, context);
    // The pixels of a picture need much more memory than its file.
    let limits = args.limits();
    let frame_of = |idx: usize| {
        let input: &Input = &inputs[idx];
        read_png(&input.text, &limits)
            .map(|(frame, _)| frame)
            .map_err(|error| unreadable(input, &error))
    };
    let frame = sheet.draw(frame_of).map_err(|error| refused(&error))?;
    let (width, height) = (frame.width(), frame.height());
    context.detail(&format!("{} pictures on {width} x {height} pixels", pictures.len()));
    let history = Metadata { per_inch, ..history(&pictures, Some(context.command_line())) };
    context.write(&format.encode(&frame, &history))
}

/// Says how large pictures are drawn that need not be resampled.
fn tell_scaled(sheet: &Sheet, context: &Context) {
    let mut sizes = sheet.pictures().iter().map(|picture| picture.size).zip(sheet.picture_sizes());
    if let Some((from, [width, height])) = sizes.find(|(from, to)| from != to) {
        let factor = f64::from(width) / f64::from(from[0]);
        context.note(&format!(
            "pictures are scaled by {factor:.3}; drawn with -sz {width} {height} they keep their pixels"
        ));
    }
}

/// Joins films to one.
fn print_film(args: &Args, films: &[Footage], context: &mut Context) -> Result<(), Failure> {
    let name = args.format_name(context.output_name());
    let pattern = context.output_name().and_then(|path| FrameNames::new(&path.to_string_lossy()));
    let kind = name.as_deref().and_then(FilmKind::from_name);
    let (config, per_inch) = args.config(None)?;
    let pictures: Vec<Picture> = films.iter().map(Footage::picture).collect();
    let sheet = Sheet::new(&Config { is_even: true, ..config }, &pictures)
        .map_err(|error| refused(&error))?;
    tell_scaled(&sheet, context);
    let joined = Joined::new(films, sheet, args.fps)?;
    joined.tell_held(context);
    let command = context.command_line().to_owned();
    if let (Some(names), None | Some(FilmKind::Ppm)) = (&pattern, kind) {
        let format = args.format(context.output_name())?;
        let write = |number, frame: &Frame, history: &Metadata| {
            let history = Metadata { per_inch, ..history.clone() };
            Context::write_now(&names.path(number), &format.encode(frame, &history))
        };
        return joined.draw(&command, &context.steps(), write);
    }
    if let (Some(_), Some(kind)) = (&pattern, kind) {
        let name = kind.name();
        return Err(Failure::Usage(format!(
            "{name} is a whole film, not a frame: give a name without %d"
        )));
    }
    let Some(kind) = kind else {
        return Err(Failure::usage(
            "these are films: give -fo FILE with gif, apng, y4m, html, mp4 or webm, or numbered files, \
             -fo sheet_%04d.png",
        ));
    };
    if context.output_is_terminal() {
        return Err(Failure::usage("a film is not written to a terminal; give -fo FILE"));
    }
    let captions = (1..=joined.shape.n_frames)
        .map(|number| Caption { values: number.to_string(), line: command.clone() });
    let captions = captions.filter(|_| kind == FilmKind::Html).collect();
    let film = FilmFile { kind, shape: joined.shape, is_opaque: true, surround: None };
    film::write(context, &film, captions, |steps, push| {
        joined.draw(&command, steps, |_, frame, _| push(frame))
    })
}
