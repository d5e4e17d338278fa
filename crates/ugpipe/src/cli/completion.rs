//! Completions of a command line, for the scripts of shells: options, words and file names; where a
//! number is needed, nothing.

use std::ffi::OsString;

use crate::cli::manual::{Entry, Manual, Value};

/// The option by which a shell asks a program for completions. The words of the command line
/// follow, up to the one that is typed.
pub const COMPLETE: &str = "--complete";

/// The line that stands for names of files.
const FILES: &str = "/";

/// The words after [`COMPLETE`], if that is the first argument.
pub(crate) fn words_of_shell(arguments: impl Iterator<Item = OsString>) -> Option<Vec<String>> {
    let mut words = arguments.skip(1);
    words.next().filter(|word| word == COMPLETE)?;
    Some(words.map(|word| word.to_string_lossy().into_owned()).collect())
}

/// The completions of the last of these words, the first of which follows the name of the program:
/// a line for each, with its meaning behind a tab, or a slash where files are meant.
pub fn completions(manual: &Manual, words: &[String]) -> String {
    let (typed, before) =
        words.split_last().map_or(("", words), |(last, before)| (last.as_str(), before));
    let mut found: Vec<(&str, &str)> = Vec::new();
    let (option, command) = context(manual, before);
    let files = match option {
        Some(option) if option.values.iter().any(Value::is_file) => true,
        Some(option) => {
            found.extend(option.words.iter().map(|(word, about)| (word.as_str(), about.as_str())));
            false
        }
        None if typed.starts_with('-') => {
            for option in options(manual) {
                found
                    .extend(option.names.iter().map(|name| (name.as_str(), option.about.as_str())));
            }
            false
        }
        None => {
            match command {
                Some(command) => {
                    let words = command.arguments.iter().flat_map(|argument| &argument.words);
                    found.extend(words.map(|(word, about)| (word.as_str(), about.as_str())));
                }
                None => {
                    let commands = manual.commands.iter();
                    found.extend(
                        commands.map(|command| (own_name(command), command.about.as_str())),
                    );
                }
            }
            true
        }
    };
    let mut lines = String::new();
    for (idx, (word, about)) in
        found.iter().enumerate().filter(|(_, (word, _))| word.starts_with(typed))
    {
        // Commands have the same options.
        if found[..idx].iter().all(|(other, _)| other != word) {
            lines += &format!("{word}\t{about}\n");
        }
    }
    if files {
        lines += &format!("{FILES}\n");
    }
    lines
}

/// The option that needs a value after these words, and the command that was given.
fn context<'m>(manual: &'m Manual, words: &[String]) -> (Option<&'m Entry>, Option<&'m Manual>) {
    let mut command = None;
    let (mut option, mut n_values): (Option<&Entry>, usize) = (None, 0);
    for word in words {
        let is_letter = |c: char| c.is_ascii_alphabetic() || c == '-';
        let is_dashed = word.strip_prefix('-').is_some_and(|rest| rest.starts_with(is_letter));
        match option {
            Some(Entry { values, .. }) if !is_dashed && n_values < values.len() => n_values += 1,
            _ => {
                option = options(manual).find(|option| is_named(option, word));
                n_values = 0;
                command =
                    manual.commands.iter().find(|command| own_name(command) == word).or(command);
            }
        }
    }
    let n_needed = |option: &Entry| option.values.iter().filter(|value| !value.is_optional).count();
    (option.filter(|option| n_values < n_needed(option)), command)
}

/// The options of the program and of its commands.
fn options(manual: &Manual) -> impl Iterator<Item = &Entry> {
    manual.options().chain(manual.commands.iter().flat_map(Manual::options))
}

/// True if `word` is a name of an option, with one dash or two.
fn is_named(option: &Entry, word: &str) -> bool {
    option.names.iter().any(|name| word == name || word.strip_prefix('-') == Some(name))
}

/// The name of a command, without that of its program.
fn own_name(command: &Manual) -> &str {
    command.name.rsplit(' ').next().unwrap_or_default()
}
