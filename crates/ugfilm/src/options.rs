//! The options of the programs that make a frame, as options of a film.

use std::ffi::OsString;

use clap::builder::Resettable;
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, CommandFactory, FromArgMatches, Id, Parser};
use ugpipe::{CommonArgs, Failure, Look, Manual, ToolArgs, manual, parse_command};

use crate::program::Program;

/// The command line of a program that makes frames.
pub struct Tool {
    /// The contents of its help.
    pub manual: fn() -> Manual,
    /// The heading of its options in `--help`.
    heading: &'static str,
    command: fn() -> Command,
    look: Look,
    /// Parses its words, of which the first is its name.
    parse: fn(&[String]) -> Result<ParsedCommand, Failure>,
}

/// A command of a pipe, whose functions are called in this process.
pub struct ParsedCommand {
    /// The program with its options. The ending of its output file is the format of the picture,
    /// unless an option gives it.
    pub program: Program,
    /// The command line that it records in its output.
    pub line: String,
    /// The options that all programs have.
    pub common: CommonArgs,
    /// All options of the program.
    pub manual: fn() -> Manual,
}

/// The command line of the program of a crate, a variant of [`Program`] with these options.
macro_rules! tool {
    ($krate:ident, $variant:ident, $args:ident => $config:expr, $line:expr) => {
        &Tool {
            manual: manual::<$krate::Args>,
            heading: concat!("Options of ", stringify!($krate)),
            command: $krate::Args::command,
            look: <$krate::Args as ToolArgs>::LOOKS.default,
            parse: |words| {
                let ($args, line): ($krate::Args, _) =
                    parse_command(words.iter().map(OsString::from))?;
                let config = $config?;
                let line = $line(&$args, line, &config);
                let (program, common) = (Program::$variant(config), $args.common().clone());
                Ok(ParsedCommand { program, line, common, manual: manual::<$krate::Args> })
            },
        }
    };
}

/// A program that writes a scene.
macro_rules! filter {
    ($krate:ident, $variant:ident) => {
        tool!($krate, $variant, args => args.config(), |_, line, _| line)
    };
}

/// A program that writes a picture.
macro_rules! renderer {
    ($krate:ident, $variant:ident) => {
        tool!($krate, $variant, args => args.config(args.common().output()),
              |args: &$krate::Args, line: String, config| args.recorded(&line, config))
    };
}

const LORENTZ: &Tool = filter!(uglorentz, Lorentz);
const DOPPLER: &Tool = filter!(ugdoppler, Doppler);
const RAINBOW: &Tool = renderer!(ugrainbow, Rainbow);
const PHOTON: &Tool = renderer!(ugphoton, Photon);
const WARP: &Tool = renderer!(ugwarp, Warp);

/// The programs whose options a film has, in the order in which they are listed.
pub const TOOLS: [&Tool; 5] = [LORENTZ, DOPPLER, RAINBOW, PHOTON, WARP];

/// The pipe of three programs.
pub const PIPE: &[&Tool] = &[LORENTZ, DOPPLER, RAINBOW];

/// The pipe with rays for every sample (`-xc`).
pub const EXACT_PIPE: &[&Tool] = &[LORENTZ, RAINBOW];

/// The programs that draw a film: flatten it into its arguments.
#[derive(Args, Clone, Copy, Debug)]
pub struct PipeArgs {
    /// Draw by tracing rays, with mirrors, glass and shadows, instead of the pipe of three programs
    #[arg(long, conflicts_with = "warp")]
    pub rays: bool,

    /// Draw views of a panorama, or of numbered ones, instead of a scene
    ///
    /// The name of numbered panoramas has %d or %04d in place of the number, pano_%04d.png: the
    /// first frame is drawn from the one with the smallest number, and each other from the next.
    #[arg(long)]
    pub warp: bool,
}

impl PipeArgs {
    /// The programs in their order. With `-xc` the renderer computes the colours as seen of every
    /// sample, so no program colours vertices.
    pub fn tools(self, given: &[Given]) -> &'static [&'static Tool] {
        match self {
            Self { warp: true, .. } => &[WARP],
            Self { rays: true, .. } => &[PHOTON],
            _ if given.iter().any(|option| option.name == "xc") => EXACT_PIPE,
            _ => PIPE,
        }
    }
}

impl ParsedCommand {
    /// Parses the words of a command, of which the first is the name of the program. Options have
    /// dashes.
    ///
    /// ```
    /// let words = ["uglorentz", "--velocity", "0.9", "0", "0"].map(str::to_owned);
    /// let command = ugfilm::ParsedCommand::from_words(&words).expect("the words are right");
    /// assert!(matches!(command.program, ugfilm::Program::Lorentz(_)));
    /// assert_eq!(command.line, "uglorentz -vel 0.9 0 0");
    /// ```
    ///
    /// # Errors
    /// [`Failure::Usage`]: another program, or options that are wrong.
    pub fn from_words(words: &[String]) -> Result<Self, Failure> {
        let name = words.first().map_or("", String::as_str);
        let tool = TOOLS.into_iter().find(|tool| tool.name() == name).ok_or_else(|| {
            let names = TOOLS.map(Tool::name).join(", ");
            Failure::Usage(format!("`{name}` is none of the programs {names}"))
        })?;
        (tool.parse)(words)
    }
}

/// Options that a film has itself or does without, because they write something else than a
/// picture or have no effect.
const LEFT_OUT: [&str; 9] = ["dt", "dp", "at", "explain", "needs", "crop", "pv", "cn", "look"];

/// An option as it was given.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Given {
    /// Its name without dashes.
    pub name: String,
    /// Its values; none for an option that has none.
    pub values: Vec<String>,
}

/// The options of the programs that make a frame, in the order in which they were given.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ProgramOptions {
    /// The options.
    pub given: Vec<Given>,
}

/// The arguments that all programs have.
#[derive(Parser)]
struct Bare {
    #[command(flatten)]
    _common: CommonArgs,
}

impl Tool {
    /// Its name.
    pub fn name(&self) -> &'static str {
        self.heading.trim_start_matches("Options of ")
    }

    /// Words before all options, so that nothing but these decides the picture: a look of its own
    /// would add others.
    pub fn first_words(&self) -> &'static [&'static str] {
        if self.look == Look::Report { &[] } else { &["--look", "1988"] }
    }

    /// Its options that a film has, too.
    pub fn options(&self) -> Vec<Arg> {
        let common = Bare::command();
        let is_common = |name: &str| common.get_arguments().any(|arg| arg.get_long() == Some(name));
        let is_own = |arg: &&Arg| {
            arg.get_long().is_some_and(|name| {
                !is_common(name) && !LEFT_OUT.contains(&name) && !arg.is_hide_set()
            })
        };
        (self.command)().get_arguments().filter(is_own).cloned().collect()
    }

    /// True if one of these options has this long name.
    pub fn has(&self, name: &str) -> bool {
        self.options().iter().any(|arg| arg.get_long() == Some(name))
    }
}

/// An option as that of a film: its numbers may be words for the time, so its values and what they
/// exclude are checked by the program.
fn of_film(arg: Arg, heading: &'static str) -> Arg {
    let none = || Resettable::<Id>::Reset;
    let free = arg.help_heading(heading).conflicts_with(none()).requires(none()).required(false);
    if !free.get_action().takes_values() {
        return free;
    }
    free.action(ArgAction::Set)
        .default_value(Resettable::Reset)
        .value_parser(clap::value_parser!(OsString))
        .allow_hyphen_values(true)
}

/// The long name of an option and its other names.
fn all_names(arg: &Arg) -> impl Iterator<Item = &str> {
    arg.get_long().into_iter().chain(arg.get_visible_aliases().unwrap_or_default())
}

/// The size of the frames. uglorentz has the option as well, but uses its aspect ratio alone, so
/// the renderers describe it.
const SIZE: &str = "sz";

/// Its help in short, and what the long help adds.
const SIZE_HELP: [&str; 2] = [
    "Size of every frame in pixels, or in mm, cm, in, pt [default: 1024 768]",
    "All frames of a film have the same size. With -sheet it is the size of each frame on the sheet; with \
    -vec it is in points. Widths and heights of mp4 are even.",
];

/// The exposure, which a film may measure.
const EXPOSURE: &str = "ex";

/// Its help in short, and what the long help adds.
const EXPOSURE_HELP: [&str; 2] = [
    "Exposure in stops, or auto, hold, follow",
    "auto and hold: one for all frames, so that 99 of 100 pixels of the film that are not black are at or \
    below white. follow: each frame has that of its own light, smoothed over an eighth of the film, 12 \
    frames at most on either side.",
];

/// The options of all programs; of those with one name the first.
fn all_options() -> Vec<Arg> {
    let mut options: Vec<Arg> = Vec::new();
    for tool in TOOLS {
        for arg in tool.options() {
            let is_size = arg.get_long() == Some(SIZE);
            if is_size && tool.name() == LORENTZ.name() {
                continue;
            }
            if options.iter().any(|other| other.get_long() == arg.get_long()) {
                continue;
            }
            let is_exposure = arg.get_long() == Some(EXPOSURE);
            let is_taken = |alias: &str| {
                options.iter().any(|other| all_names(other).any(|name| name == alias))
            };
            // Options of two programs may have the same second name.
            let has_own_names = all_names(&arg).skip(1).all(|alias| !is_taken(alias));
            let mut arg = of_film(arg, tool.heading);
            if is_size {
                arg = arg.help(SIZE_HELP[0]).long_help(SIZE_HELP.join("\n\n"));
            }
            if is_exposure {
                arg = arg.help(EXPOSURE_HELP[0]).long_help(EXPOSURE_HELP.join("\n\n"));
                arg = arg.value_name("E|WORD");
            }
            options.push(if has_own_names { arg } else { arg.visible_alias(Resettable::Reset) });
        }
    }
    options
}

impl Args for ProgramOptions {
    fn augment_args(command: Command) -> Command {
        command.args(all_options())
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for ProgramOptions {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut given = Vec::new();
        for arg in all_options() {
            let id = arg.get_id().as_str();
            if matches.value_source(id) != Some(ValueSource::CommandLine) {
                continue;
            }
            let values = if arg.get_action().takes_values() {
                let raw = matches.get_raw(id).into_iter().flatten();
                raw.map(|value| value.to_string_lossy().into_owned()).collect()
            } else {
                Vec::new()
            };
            let name = arg.get_long().unwrap_or(id).to_owned();
            given.push((matches.index_of(id), Given { name, values }));
        }
        given.sort_by_key(|(index, _)| *index);
        Ok(Self { given: given.into_iter().map(|(_, option)| option).collect() })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}
