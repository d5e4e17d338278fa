//! `-look`: one word for a set of options.

use clap::parser::ValueSource;
use clap::{ArgMatches, Args};

use crate::cli::values::one_of;

/// How pictures are meant to look: flatten it into the arguments of a program that has
/// [`crate::ToolArgs::LOOKS`].
#[derive(Args, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LookArgs {
    /// Look of the picture, in one word: 1988, light, shape [default: light in ugphoton, ugwarp
    /// and ugfilm, 1988 in the others]
    ///
    /// 1988: the colours of the report of 1988, one wavelength each. light: spectra, exposed as a
    /// camera does. shape: the colours at rest. The word stands for options of this program, all
    /// listed in docs/pipeline.md; an option that is given itself comes before those of the look.
    #[arg(id = LOOK, long = LOOK, value_name = "LOOK", value_parser = one_of("looks", Look::ALL.map(|look| (look.name(), look))))]
    look: Option<Look>,
}

impl LookArgs {
    /// The look that the command line names; `None` for the default.
    pub fn given(&self) -> Option<Look> {
        self.look
    }
}

/// Id and name of the option.
const LOOK: &str = "look";

/// A look of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// As in the report of 1988, whose options are the defaults.
    Report,
    /// As light and a camera.
    Light,
    /// As at rest, with the shape in motion.
    Shape,
}

impl Look {
    /// All looks.
    pub const ALL: [Self; 3] = [Self::Report, Self::Light, Self::Shape];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Report => "1988",
            Self::Light => "light",
            Self::Shape => "shape",
        }
    }
}

/// The options that looks stand for in a program; [`Look::Report`] stands for none.
#[derive(Clone, Copy, Debug)]
pub struct Looks {
    /// The look unless one is given.
    pub default: Look,
    /// Of [`Look::Light`].
    pub light: &'static [Preset],
    /// Of [`Look::Shape`].
    pub shape: &'static [Preset],
}

/// An option of a look, which one that is given replaces.
#[derive(Clone, Copy, Debug)]
pub struct Preset {
    /// The long name of the option, and its values.
    pub words: &'static [&'static str],
    /// Other options, by their long names, that replace it.
    pub unless: &'static [&'static str],
    /// True if it suits the command line.
    pub suits: fn(&ArgMatches) -> bool,
}

impl Looks {
    /// Of a program without options that looks stand for.
    pub const NONE: Self = Self { default: Look::Report, light: &[], shape: &[] };
}

impl Preset {
    /// An option that suits every command line.
    pub const fn new(words: &'static [&'static str], unless: &'static [&'static str]) -> Self {
        Self { words, unless, suits: |_| true }
    }

    /// The same for command lines that it suits.
    pub const fn with(self, suits: fn(&ArgMatches) -> bool) -> Self {
        Self { suits, ..self }
    }

    fn is_replaced(&self, matches: &ArgMatches) -> bool {
        self.words[..1].iter().chain(self.unless).any(|name| is_given(matches, name))
    }
}

/// True if an option is on the command line. `name`: its long name.
pub fn is_given(matches: &ArgMatches, name: &str) -> bool {
    let is_name = |id: &clap::Id| id.as_str().replace('_', "-") == name;
    let id = matches.ids().find(|id| is_name(id));
    id.is_some_and(|id| matches.value_source(id.as_str()) == Some(ValueSource::CommandLine))
}

/// The words of the look on a command line, with two dashes.
pub(crate) fn words(matches: &ArgMatches, looks: &Looks) -> Vec<String> {
    let presets = match matches.try_get_one(LOOK).ok().flatten().unwrap_or(&looks.default) {
        Look::Light => looks.light,
        Look::Shape => looks.shape,
        Look::Report => return Vec::new(),
    };
    let presets =
        presets.iter().filter(|preset| !preset.is_replaced(matches) && (preset.suits)(matches));
    let words = |preset: &Preset| {
        let [name, values @ ..] = preset.words else { return Vec::new() };
        std::iter::once(format!("--{name}"))
            .chain(values.iter().map(|value| (*value).to_owned()))
            .collect()
    };
    presets.flat_map(words).collect()
}
