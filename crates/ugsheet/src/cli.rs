//! The command line of `ugsheet`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{ArgAction, Parser, ValueEnum};
use ugimage::{Format, PictureLimits, ReadError, read_history, read_png, read_png_header, spelled_color};
use ugpipe::{
    CommonArgs, Context, Failure, Input, MAX_INPUT, ToolArgs, Words, finite, one_of, sha256, whole,
};

use crate::recipe::{Recipe, recipes};
use crate::{Config, Error, Labels, Motion, Picture, history, join, sheet};

/// Arranges several pictures on one sheet, with labels
///
/// Reads PNG files and arranges them in a grid without resampling them. By default the labels are
/// the speeds and times recorded in the history of the pictures, if these differ; otherwise the
/// file names.
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
    lb: Kind,

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

    /// Pixels between pictures, and margin M around all [default: 0.9 of the text size]
    #[arg(long, num_args = 1..=2, value_names = ["N", "M"], action = ArgAction::Set,
          value_parser = whole(0..=10_000))]
    gap: Option<Vec<u32>>,

    /// Background colour: lightness, hue in degrees, saturation; a name, or #rrggbb [default: white]
    #[arg(long, num_args = 1..=3, value_names = ["L", "H", "S"], action = ArgAction::Set,
          visible_alias = "background")]
    bg: Option<Vec<String>>,

    /// Output format: png, ppm, eps, ps, pdf, svg [default: by the extension of -fo, else png]
    #[arg(long, value_name = "FMT", visible_alias = "format", value_parser = one_of("formats", FORMATS.map(|format| (format.name(), format))))]
    dt: Option<Format>,

    /// Instead of a sheet, print the pipe that drew a picture, for a shell
    ///
    /// For files in png, exr, hdr, ppm, pdf, svg, eps and ps, in the folder where the pipe was run.
    /// A comment has the SHA-256 of the scene, and a warning says whether the scene has changed.
    #[arg(long, conflicts_with_all = ["cols", "label", "lb", "lt", "title", "cap", "ts", "gap", "bg", "dt"])]
    history: bool,

    /// Join the tiles of a picture, drawn with -crop, to the whole picture
    ///
    /// Tiles are PNG files that were drawn by one command but for their -crop. The result is the
    /// file that the command without -crop writes. Their order does not matter.
    #[arg(long, conflicts_with_all = ["history", "cols", "label", "lb", "lt", "title", "cap", "ts", "gap", "bg", "dt"])]
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
  ugsheet --tiles tile_*.png > whole.png
  ugsheet --history rest.png";

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Kind {
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

/// Formats of sheets: those without linear light.
const FORMATS: [Format; 6] = [Format::Png, Format::Ppm, Format::Eps, Format::Ps, Format::Pdf, Format::Svg];

impl ToolArgs for Args {
    const ESSENTIAL: &'static [&'static str] =
        &["-cols", "--label", "-lb", "-lt", "--title", "-cap", "-ts", "-gap", "-bg", "-dt", "-fo"];

    fn common(&self) -> &CommonArgs {
        &self.common
    }
}

impl Args {
    fn config(&self) -> Result<Config, Failure> {
        let kind = match self.lb {
            Kind::Auto => Labels::Auto,
            Kind::Names => Labels::Names,
            Kind::None => Labels::None,
        };
        Ok(Config {
            columns: self.cols,
            labels: if self.label.is_empty() { kind } else { Labels::Given(self.label.clone()) },
            letters: self.lt,
            title: self.title.clone().unwrap_or_default(),
            caption: self.cap.clone().unwrap_or_default(),
            background: self.background()?,
            gap: self.gap.as_ref().map(|gap| [gap[0], gap.get(1).copied().unwrap_or(gap[0])]),
            text_size: self.ts,
        })
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

    fn format(&self, file: Option<&Path>) -> Result<Format, Failure> {
        let ending = file.and_then(Path::extension).map(|ending| ending.to_string_lossy().into_owned());
        match (self.dt, ending) {
            (Some(format), _) => Ok(format),
            (None, None) => Ok(Format::Png),
            (None, Some(ending)) => {
                let format = Format::from_name(&ending).filter(|format| FORMATS.contains(format));
                format.ok_or_else(|| {
                    let all = FORMATS.map(Format::name).join(", ");
                    let message = format!("`.{ending}` is not one of the formats {all}; name one with -dt");
                    Failure::Usage(message)
                })
            }
        }
    }
}

/// The picture of an input, without its pixels. `path` is its file, `None` for standard input.
fn picture(path: Option<&Path>, input: &Input) -> Result<Picture, Failure> {
    let (size, history) = read_png_header(&input.text).map_err(|error| unreadable(input, &error))?;
    let name = path.and_then(Path::file_stem).map(|stem| stem.to_string_lossy().into_owned());
    let motion = Motion::recorded(&history);
    Ok(Picture { name: name.unwrap_or_default(), size, motion, history })
}

fn refused(error: Error) -> Failure {
    match error {
        Error::Count { .. } | Error::Text { .. } => Failure::usage(error.words()),
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
        let (size, history) = read_png_header(&input.text).map_err(|error| unreadable(input, &error))?;
        Ok(Picture { name: input.name.clone(), size, motion: Motion::default(), history })
    };
    let tiles = inputs.iter().map(tile).collect::<Result<Vec<_>, Error>>().map_err(Failure::failed)?;
    let frame_of = |idx: usize| {
        // Each file is needed once.
        let input = Input { text: std::mem::take(&mut inputs[idx].text), ..inputs[idx].clone() };
        read_png(&input.text, &limits).map(|(frame, _)| frame).map_err(|error| unreadable(&input, &error))
    };
    let (frame, history) = join(&tiles, frame_of).map_err(|error| Failure::failed(error.words()))?;
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
        let recipes = recipes(&read_history(text).unwrap_or_default());
        let recipes = recipes
            .map_err(|why| Failure::failed(format!("the history of `{name}` must not be run: {why}")))?;
        if recipes.is_empty() {
            return Err(Failure::failed(format!(
                "`{name}` has no history that can be run: another program drew it, or its texts were removed"
            )));
        }
        for recipe in &recipes {
            inspect(recipe, context);
            script += &recipe.script();
        }
        if recipes.len() > 1 {
            let n = recipes.len();
            context.note(&format!("`{name}` has {n} pipes: send the output of each to a file of its own"));
        }
    }
    context.write_text(&script)
}

/// Says what a pipe needs to give the same picture.
fn inspect(recipe: &Recipe, context: &Context) {
    match &recipe.scene {
        None => context.note("the scene was read from standard input: run the pipe with the same input"),
        Some(scene) => match context.read_here(Path::new(scene), MAX_INPUT) {
            Ok(text) if sha256(&text) == recipe.sha256 => {}
            Ok(_) => context.warn(&format!("`{scene}` has changed since the picture was drawn")),
            Err(_) => context.note(&format!("`{scene}` is not in this folder: run the pipe in its folder")),
        },
    }
    let version = env!("CARGO_PKG_VERSION");
    if recipe.versions.split(", ").any(|program| program.split(' ').next_back() != Some(version)) {
        let versions = &recipe.versions;
        context.note(&format!("drawn by {versions}; other versions may draw another picture"));
    }
    if let Some(option) = recipe.permission() {
        context.warn(&format!("the pipe has the option {option}: run it only if you trust the scene"));
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
        let (config, limits) = (args.config()?, args.limits());
        let format = args.format(context.output_name())?;
        if context.output_is_terminal() && format.is_binary() {
            return Err(Failure::usage(NO_TERMINAL));
        }
        let mut inputs = vec![context.input()?];
        for path in &args.files {
            inputs.push(context.input_file(path)?);
        }
        let paths =
            std::iter::once(args.common.input()).chain(args.files.iter().map(|path| Some(path.as_path())));
        let pictures =
            paths.zip(&inputs).map(|(path, input)| picture(path, input)).collect::<Result<Vec<_>, _>>()?;
        // The pixels of a picture need much more memory than its file.
        let frame_of = |idx: usize| {
            let input: &Input = &inputs[idx];
            read_png(&input.text, &limits).map(|(frame, _)| frame).map_err(|error| unreadable(input, &error))
        };
        let frame = sheet(&config, &pictures, frame_of).map_err(refused)?;
        context.detail(&format!(
            "{} pictures on {} x {} pixels",
            pictures.len(),
            frame.width(),
            frame.height()
        ));
        context.write(&format.encode(&frame, &history(&pictures, Some(context.command_line()))))
    })
}
