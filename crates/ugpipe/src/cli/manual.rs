//! The contents of the help, the man page and the completions of a program, as data.

use clap::{Arg, Command, CommandFactory};

use crate::cli::args::{COMMON, ToolArgs};
use crate::cli::{argv, usage};

/// A program, or a command of a program such as `ugparse tidy`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Manual {
    /// Name, with the program before it: `ugparse tidy`.
    pub name: String,
    /// Version of the program.
    pub version: String,
    /// One line on what it does.
    pub about: String,
    /// More about it, one paragraph each.
    pub description: Vec<String>,
    /// How arguments are given, as in `ugparse [OPTIONS] [FILE]`.
    pub usage: String,
    /// Command lines, the most useful first, with comments after ` # `.
    pub examples: Vec<String>,
    /// Names of the options that most people need, as in [`ToolArgs::ESSENTIAL`].
    pub essential: Vec<String>,
    /// Arguments without a dash.
    pub arguments: Vec<Entry>,
    /// Options, by headings.
    pub groups: Vec<Group>,
    /// Commands, which come before options.
    pub commands: Vec<Manual>,
}

/// Options under a heading.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Group {
    /// The heading.
    pub heading: String,
    /// The options, in the order of their definition.
    pub options: Vec<Entry>,
}

/// An option, or an argument without a dash.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Entry {
    /// Names as documented, the usual one first: `-vel`, `--velocity`. Arguments have none.
    pub names: Vec<String>,
    /// Values, in order: optional ones come last.
    pub values: Vec<Value>,
    /// True if the last value may be repeated.
    pub is_repeated: bool,
    /// One line on what it does.
    pub about: String,
    /// The default, as in `the scene's, else 0`, or empty.
    pub default: String,
    /// More about it, one paragraph each.
    pub details: Vec<String>,
    /// Words that are valid as a value, with their meaning or an empty text.
    pub words: Vec<(String, String)>,
    /// True for options that every program has.
    pub is_common: bool,
}

/// A value of an option.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Value {
    /// Name, as in `X`.
    pub name: String,
    /// True if it may be left out.
    pub is_optional: bool,
}

impl Value {
    /// True if the value is the name of a file.
    pub fn is_file(&self) -> bool {
        self.name == "FILE"
    }
}

impl Entry {
    /// Values as documented: `W H`, `A [B]`, `[FILE]...`.
    pub fn syntax(&self) -> String {
        let value = |value: &Value| match value.is_optional {
            true => format!("[{}]", value.name),
            false => value.name.clone(),
        };
        let values: Vec<String> = self.values.iter().map(value).collect();
        values.join(" ") + if self.is_repeated { "..." } else { "" }
    }

    /// What it does, with its valid words.
    pub fn effect(&self) -> String {
        let is_told = self.words.iter().all(|(word, _)| self.about.contains(word.as_str()));
        let words: Vec<&str> = self.words.iter().map(|(word, _)| word.as_str()).collect();
        let words = if is_told { String::new() } else { format!(": {}", words.join(", ")) };
        format!("{}{words}", self.about)
    }
}

impl Manual {
    /// All options.
    pub fn options(&self) -> impl Iterator<Item = &Entry> {
        self.groups.iter().flat_map(|group| &group.options)
    }

    /// The options that most people need, each with the name by which [`ToolArgs::ESSENTIAL`]
    /// calls it. Options that are not there are left out.
    pub fn essential_options(&self) -> Vec<(&str, &Entry)> {
        let named = |name: &str| {
            let mut names =
                self.options().flat_map(|entry| entry.names.iter().map(move |name| (name, entry)));
            names
                .find(|(other, _)| other.as_str() == name)
                .map(|(name, entry)| (name.as_str(), entry))
        };
        self.essential.iter().filter_map(|name| named(name)).collect()
    }
}

/// The manual of the program that has these arguments.
pub fn manual<A: ToolArgs + CommandFactory>() -> Manual {
    of_command(&argv::prepare(A::command()), A::ESSENTIAL, "")
}

/// The manual of a command that is built. `program`: the name of the program with a blank, if this
/// is one of its commands.
pub(crate) fn of_command(command: &Command, essential: &[&str], program: &str) -> Manual {
    let name = format!("{program}{}", command.get_name());
    let all = || command.get_arguments().filter(|arg| !arg.is_hide_set());
    let arguments: Vec<Entry> = all().filter(|arg| arg.is_positional()).map(entry).collect();
    let mut groups: Vec<Group> = Vec::new();
    for arg in all().filter(|arg| !arg.is_positional()) {
        let is_own = !["help", "version"].contains(&arg.get_id().as_str());
        let heading = if is_own { arg.get_help_heading().unwrap_or("Options") } else { COMMON };
        let option = Entry { is_common: heading == COMMON, ..entry(arg) };
        match groups.iter_mut().find(|group| group.heading == heading) {
            Some(group) => group.options.push(option),
            None => groups.push(Group { heading: heading.to_owned(), options: vec![option] }),
        }
    }
    // The same order in every program: its own options first.
    groups.sort_by_key(|group| (group.heading == COMMON, group.heading != "Options"));
    let (about, mut description) = paragraphs(command.get_long_about().or(command.get_about()));
    let examples = command.get_after_help().map(ToString::to_string).unwrap_or_default();
    let examples = examples.lines().skip(1).map(|line| line.trim().to_owned());
    let commands: Vec<Manual> = command
        .get_subcommands()
        .filter(|sub| !sub.is_hide_set())
        .map(|sub| of_command(sub, essential, &format!("{name} ")))
        .collect();
    let parts = [
        name.clone(),
        if commands.is_empty() { String::new() } else { "[COMMAND]".to_owned() },
        "[OPTIONS]".to_owned(),
    ];
    let values = arguments.iter().map(Entry::syntax);
    let usage = parts
        .into_iter()
        .chain(values)
        .filter(|part| !part.is_empty())
        .collect::<Vec<_>>()
        .join(" ");
    description.retain(|paragraph| !paragraph.is_empty());
    Manual {
        name,
        version: command.get_version().unwrap_or_default().to_owned(),
        about,
        description,
        usage,
        examples: examples.collect(),
        essential: essential.iter().map(|name| (*name).to_owned()).collect(),
        arguments,
        groups,
        commands,
    }
}

fn entry(arg: &Arg) -> Entry {
    let long = arg.get_long().map(|name| usage::in_documented_form(&format!("--{name}")));
    // The second names explain the first ones, so they are words.
    let aliases = arg.get_visible_aliases().into_iter().flatten().map(|name| format!("--{name}"));
    let (about, details) = match arg.get_id().as_str() {
        "help" => ("Print the most important options; --help prints all".to_owned(), Vec::new()),
        _ => paragraphs(arg.get_long_help().or(arg.get_help())),
    };
    let takes_values = arg.get_action().takes_values();
    let words = arg.get_possible_values();
    let words = words.iter().filter(|word| takes_values && !word.is_hide_set());
    let meaning =
        |text: Option<&clap::builder::StyledStr>| text.map(ToString::to_string).unwrap_or_default();
    let defaults =
        arg.get_default_values().iter().map(|value| value.to_string_lossy().into_owned());
    let (about, default) = match about.split_once(" [default: ") {
        Some((about, default)) => (about.to_owned(), default.trim_end_matches(']').to_owned()),
        None if takes_values => (about, defaults.collect::<Vec<_>>().join(" ")),
        None => (about, String::new()),
    };
    Entry {
        names: arg
            .get_short()
            .map(|letter| format!("-{letter}"))
            .into_iter()
            .chain(long)
            .chain(aliases)
            .collect(),
        values: if takes_values { values(arg) } else { Vec::new() },
        is_repeated: arg.is_positional()
            && arg.get_num_args().is_some_and(|range| range.max_values() > 1),
        about,
        details,
        words: words.map(|word| (word.get_name().to_owned(), meaning(word.get_help()))).collect(),
        default,
        is_common: false,
    }
}

/// The values of an option. One name stands for any number of values.
fn values(arg: &Arg) -> Vec<Value> {
    let range = arg.get_num_args().unwrap_or_default();
    let n_needed =
        if arg.is_positional() && !arg.is_required_set() { 0 } else { range.min_values() };
    let names: Vec<String> = match arg.get_value_names() {
        Some(names) => names.iter().map(ToString::to_string).collect(),
        None => vec![arg.get_id().as_str().to_uppercase()],
    };
    let value = |(idx, name)| Value { name, is_optional: idx >= n_needed };
    names.into_iter().enumerate().map(value).collect()
}

/// The first paragraph, without line breaks and full stop, and the others.
fn paragraphs(text: Option<&clap::builder::StyledStr>) -> (String, Vec<String>) {
    let text = text.map(ToString::to_string).unwrap_or_default();
    let mut paragraphs =
        text.split("\n\n").map(|paragraph| paragraph.replace('\n', " ").trim().to_owned());
    let first = paragraphs.next().unwrap_or_default();
    (first.strip_suffix('.').unwrap_or(&first).to_owned(), paragraphs.collect())
}
