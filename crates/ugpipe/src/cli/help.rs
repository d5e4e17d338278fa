//! The texts of `-h`, one screenful, and `--help`, everything.
//!
//! clap prints them, but does not write them: it writes long options with two dashes, joins the
//! lines of examples, and has one list of options for both.

use clap::Command;
use clap::builder::styling::Style;

use crate::cli::manual::{Entry, Manual, of_command};

/// Columns of the text.
const WIDTH: usize = 80;

/// Columns before the explanation of an option in the short help, at most.
const MARGIN: usize = 25;

/// How the program ends, for help and man pages: status and meaning.
pub const EXIT_STATUS: [(&str, &str); 4] = [
    ("0", "success"),
    ("1", "an invalid scene, a file that cannot be read or written, or lack of memory"),
    ("2", "invalid usage"),
    ("141", "killed by SIGPIPE: the program that reads the output has ended"),
];

/// A sentence on the dashes of options, for help and man pages.
pub const DASHES: &str = "Options have one dash or two: -fo FILE, --fo FILE or -fo=FILE.";

/// Where more is written, for help and man pages.
pub const DOCUMENTATION: &str = "Man page `ugtools` is an overview, and `unigrafix` is the scene language. The pages in \
     share/doc/ugtools/docs of the installation, or docs of the source, are: \
     start.md (a first scene, and the effects of motion one by one), pipeline.md (all programs \
     and options), unigrafix.md (the scene language), physics.md (numbered equations).";

/// Has clap print the texts of this module, for the command and those it contains. `command` is
/// built.
pub(crate) fn install(command: Command, essential: &[&str]) -> Command {
    with_texts(command, essential, "")
}

fn with_texts(mut command: Command, essential: &[&str], program: &str) -> Command {
    let manual = of_command(&command, essential, program);
    let within = format!("{} ", manual.name);
    for sub in command.get_subcommands_mut() {
        let text = with_texts(std::mem::take(sub), essential, &within);
        *sub = text;
    }
    command
        .term_width(0)
        .help_template("{before-help}")
        .before_help(short(&manual))
        .before_long_help(long(&manual))
}

/// One screenful: examples, and the options that most people need.
pub(crate) fn short(manual: &Manual) -> String {
    let mut text = head(manual);
    text += &examples(manual, 2);
    let program = format!("{} ", manual.name);
    let name = |sub: &Manual| sub.name.strip_prefix(&program).unwrap_or(&sub.name).to_owned();
    let commands = manual.commands.iter().map(|sub| (name(sub), sub.about.clone()));
    text += &section("Commands", &table(commands.collect()));
    let (mut rows, mut defaults) = (Vec::new(), Vec::new());
    let options = manual.essential_options();
    let own = manual.options().filter(|entry| !entry.is_common && manual.name.contains(' '));
    let own = own.filter(|entry| options.iter().all(|(_, other)| other.names != entry.names));
    let own = own.filter_map(|entry| Some((entry.names.first()?.as_str(), entry)));
    for (name, entry) in own.chain(options.iter().copied()) {
        rows.push((format!("{name} {}", entry.syntax()).trim_end().to_owned(), entry.effect()));
        defaults.push(default(entry));
    }
    // Default values are shown where they fit on the line.
    let margin = margin(&rows);
    for ((_, about), default) in rows.iter_mut().zip(defaults) {
        if margin + about.chars().count() + default.chars().count() <= WIDTH {
            *about += &default;
        }
    }
    text += &section("Options that most people need", &table(rows));
    text + &format!("\nAll options, and where the documentation is: {} --help\n", manual.name)
}

/// Everything.
pub(crate) fn long(manual: &Manual) -> String {
    let mut text = head(manual);
    for paragraph in &manual.description {
        text += &format!("\n{}", wrapped(paragraph, 0));
    }
    text += &examples(manual, usize::MAX);
    let commands = manual.commands.iter().map(|sub| (sub.name.clone(), sub.about.clone()));
    text += &section("Commands", &table(commands.collect()));
    let all_explained = |entries: &[Entry]| entries.iter().map(explained).collect::<String>();
    text += &section("Arguments", &all_explained(&manual.arguments));
    for group in &manual.groups {
        let is_common = group.options.iter().all(|entry| entry.is_common);
        let dashes = if is_common { wrapped(DASHES, 2) + "\n" } else { String::new() };
        text += &section(&group.heading, &(dashes + &all_explained(&group.options)));
    }
    let statuses = EXIT_STATUS.map(|(status, meaning)| (status.to_owned(), meaning.to_owned()));
    text += &section("Exit status", &table(statuses.into()));
    text + &section("Documentation", &wrapped(DOCUMENTATION, 2))
}

/// A part of the text under a heading, if there is anything in it.
fn section(title: &str, body: &str) -> String {
    if body.is_empty() { String::new() } else { format!("\n{}\n{body}", heading(title)) }
}

fn examples(manual: &Manual, n_most: usize) -> String {
    let lines = manual.examples.iter().take(n_most).map(|example| format!("  {example}\n"));
    section("Examples", &lines.collect::<String>())
}

/// The purpose of the program, and its usage.
fn head(manual: &Manual) -> String {
    let usage = heading("Usage");
    format!("{}\n\n{usage} {}\n", wrapped(&manual.about, 0).trim_end(), manual.usage)
}

fn heading(text: &str) -> String {
    let style = Style::new().bold();
    format!("{style}{text}:{style:#}")
}

/// The default value, to be added to [`Entry::effect`].
fn default(entry: &Entry) -> String {
    match entry.default.as_str() {
        "" => String::new(),
        default => format!(" [default: {default}]"),
    }
}

/// An option with everything about it.
fn explained(entry: &Entry) -> String {
    let name = format!("{} {}", entry.names.join(", "), entry.syntax());
    let mut text =
        format!("  {}\n{}", name.trim(), wrapped(&(entry.effect() + &default(entry)), INDENT));
    entry.details.iter().for_each(|paragraph| text += &format!("\n{}", wrapped(paragraph, INDENT)));
    let meanings = entry.words.iter().filter(|(_, meaning)| !meaning.is_empty());
    let meanings: Vec<String> = meanings
        .map(|(word, meaning)| wrapped(&format!("{word}: {meaning}"), INDENT + 2))
        .collect();
    if !meanings.is_empty() {
        text += &format!("\n{}", meanings.concat());
    }
    text
}

/// Columns before the explanation of an option in `--help`.
const INDENT: usize = 10;

/// Rows of two columns.
fn table(rows: Vec<(String, String)>) -> String {
    let margin = margin(&rows);
    let row = |(name, about): (String, String)| {
        let about = wrapped(&about, margin);
        if name.chars().count() + 4 > margin {
            return format!("  {name}\n{about}");
        }
        format!("  {name:width$}{}", about.trim_start(), width = margin - 2)
    };
    rows.into_iter().map(row).collect()
}

/// Columns before the second column of a table.
fn margin(rows: &[(String, String)]) -> usize {
    rows.iter().map(|(name, _)| name.chars().count() + 4).max().unwrap_or_default().min(MARGIN)
}

/// Breaks a text into indented lines.
fn wrapped(text: &str, indent: usize) -> String {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let length = lines.last().map_or(0, |line| line.chars().count());
        if length > 0 && indent + length + 1 + word.chars().count() > WIDTH {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
    }
    lines.iter().map(|line| format!("{:indent$}{line}\n", "")).collect()
}
