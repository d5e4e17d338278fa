//! Options that are the same in every program.

use std::path::{Path, PathBuf};

use crate::cli::look::Looks;
use crate::cli::values::whole;

/// The arguments of a ug program.
pub trait ToolArgs: clap::Parser {
    /// The options that most people need, about ten, as documented (`-vel`, `--keep-in-view`): `-h`
    /// lists them, by these names and in this order.
    const ESSENTIAL: &'static [&'static str];

    /// The options that the looks of [`crate::LookArgs`] stand for, if it has these.
    const LOOKS: Looks = Looks::NONE;

    /// The options that every program has.
    fn common(&self) -> &CommonArgs;

    /// The file that is written if `-fo` is not given; `None` is standard output.
    fn default_output(&self) -> Option<&Path> {
        None
    }
}

/// Ids of the options for files, messages and threads: those below, `files` for additional input
/// files ([`crate::Context::input_file`]), `at` for a second output file
/// ([`crate::Context::write_file`]), `pv` for previews in the place of the output
/// ([`crate::Context::write_now`]), `dp` for the output ([`ToolArgs::default_output`]), and `cn`,
/// which is accepted as in 1988. They do not affect the
/// content of the output, so the recorded command line omits them.
pub(crate) const WITHOUT_EFFECT: [&str; 12] =
    ["file", "files", "fi", "fo", "fm", "qt", "vb", "nt", "at", "pv", "dp", "cn"];

/// Names of the options, in any program, that write files: all but standard output. They are never
/// recorded, so a record that has one was made by somebody else. `tests/history.rs` finds those
/// that are missing here.
pub const WRITING: [&str; 12] = [
    "fo",
    "output",
    "o",
    "fm",
    "messages",
    "at",
    "attributes",
    "pv",
    "preview",
    "keep",
    "all",
    "dp",
];

/// The options that every program has. Put them last in the program's own arguments:
/// `#[command(flatten)] common: CommonArgs`.
#[derive(clap::Args, Clone, Debug, Default, PartialEq, Eq)]
pub struct CommonArgs {
    /// File to read [default: `-`, standard input]
    #[arg(id = "file", value_name = "FILE", conflicts_with = "fi")]
    file: Option<PathBuf>,

    /// Read FILE; `-` is standard input
    ///
    /// The same as a bare FILE.
    #[arg(long, value_name = "FILE", visible_alias = "input", help_heading = COMMON)]
    fi: Option<PathBuf>,

    /// Write FILE; `-` is standard output
    ///
    /// A regular FILE is written atomically: to a temporary file in the same folder, which is
    /// renamed when the program succeeds.
    #[arg(long, value_name = "FILE", visible_alias = "output", help_heading = COMMON)]
    pub(crate) fo: Option<PathBuf>,

    /// Write messages to FILE; `-` is standard error
    #[arg(long, value_name = "FILE", visible_alias = "messages", help_heading = COMMON)]
    fm: Option<PathBuf>,

    /// Warn about unknown statements and pass them on
    ///
    /// Without this option they are errors.
    #[arg(long, help_heading = COMMON)]
    pub lax: bool,

    /// Run the programs that `execute` statements name
    ///
    /// These programs run with your permissions, so use this only for scenes you trust. Without
    /// this option such statements are errors.
    #[arg(long, help_heading = COMMON)]
    pub allow_execute: bool,

    /// Read files that the input names outside its folder
    ///
    /// Files and programs that the input names (include, execute, mtllib, buffers of glTF) must be
    /// in the folder of the input or below it; for standard input, in the current folder. Links are
    /// followed first. Use this option only for inputs you trust.
    #[arg(long, help_heading = COMMON)]
    pub allow_outside: bool,

    /// Change a limit on the size of scenes
    ///
    /// As in statements=100000000. Names of limits: text, includes, files, nesting, chain,
    /// statements, corners, names, memory; see docs/unigrafix.md. May be given more than once.
    #[arg(long, value_name = "NAME=N", value_parser = limit, help_heading = COMMON)]
    pub limit: Vec<(String, u64)>,

    /// Print only errors, no notes or warnings
    #[arg(long, visible_alias = "quiet", conflicts_with = "vb", help_heading = COMMON)]
    pub qt: bool,

    /// Print what was done, with timings
    #[arg(long, visible_alias = "verbose", help_heading = COMMON)]
    pub vb: bool,

    /// Use N threads [default: all]
    ///
    /// The output does not depend on N.
    #[arg(long, value_name = "N", visible_alias = "threads", help_heading = COMMON,
          value_parser = whole(1..=1024))]
    pub nt: Option<u32>,
}

/// Heading of these options in `--help`.
pub(crate) const COMMON: &str = "Common options";

impl CommonArgs {
    /// The input file; `None` is standard input.
    pub fn input(&self) -> Option<&Path> {
        self.input_named().filter(|path| !is_dash(path))
    }

    /// The output file; `None` is standard output.
    pub fn output(&self) -> Option<&Path> {
        self.fo.as_deref().filter(|path| !is_dash(path))
    }

    /// The file for messages; `None` is standard error.
    pub fn messages(&self) -> Option<&Path> {
        self.fm.as_deref().filter(|path| !is_dash(path))
    }

    /// The limit `memory` that was set, in bytes.
    pub fn memory_limit(&self) -> Option<u64> {
        self.limit.iter().rev().find(|(name, _)| name == "memory").map(|(_, bytes)| *bytes)
    }

    /// What to add to the message about an input that needs more than the limit `memory`.
    pub fn memory_remedy(needed: Option<u64>) -> String {
        needed.map_or_else(String::new, |bytes| format!("; allow it with --limit memory={bytes}"))
    }

    /// The options for reading as they would be given to another program.
    pub fn reading_words(&self) -> Vec<String> {
        let flags = [
            (self.lax, "-lax"),
            (self.allow_execute, "--allow-execute"),
            (self.allow_outside, "--allow-outside"),
        ];
        let mut words: Vec<String> = flags
            .iter()
            .filter(|(is_given, _)| *is_given)
            .map(|(_, word)| (*word).to_owned())
            .collect();
        words.extend(
            self.limit
                .iter()
                .flat_map(|(name, value)| ["--limit".to_owned(), format!("{name}={value}")]),
        );
        words
    }

    /// The input file as given by the user, including `-`.
    pub(crate) fn input_named(&self) -> Option<&Path> {
        self.fi.as_deref().or(self.file.as_deref())
    }
}

/// For programs with commands: allows options before the command as well as after it, except the
/// one that names the file: `#[command(mut_args(ugpipe::globally))]`.
pub fn globally(arg: clap::Arg) -> clap::Arg {
    if arg.is_positional() || arg.get_id() == "fi" { arg } else { arg.global(true) }
}

fn is_dash(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Value parser for `NAME=N`.
fn limit(word: &str) -> Result<(String, u64), String> {
    let (name, value) = word.split_once('=').ok_or("write NAME=N")?;
    let is_whole = !value.is_empty() && value.bytes().all(|byte| byte.is_ascii_digit());
    let value =
        value.parse().ok().filter(|_| is_whole).ok_or("N must be a whole number below 2^64")?;
    Ok((name.to_owned(), value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_a_name_and_a_whole_number() {
        fn check(word: &str, expected: Option<(&str, u64)>) {
            let expected = expected.map(|(name, value)| (name.to_owned(), value));
            assert_eq!(limit(word).ok(), expected, "{word}");
        }
        check("files=3", Some(("files", 3)));
        check("files=007", Some(("files", 7)));
        check("=3", Some(("", 3)));
        check("files", None);
        check("files=", None);
        check("files=+3", None);
        check("files=-3", None);
        check("files=1e3", None);
        check("files=99999999999999999999", None);
    }
}
