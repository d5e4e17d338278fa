//! Errors of the command line in the words of the programs.
//!
//! clap finds the errors. Its messages have other names for options than our documentation, no name
//! of a program, and no answer for options of other programs; so they are made anew here.

use std::error::Error;
use std::ffi::OsString;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, Command};

use crate::cli::argv::StrayNumber;
use crate::cli::values::finite;
use crate::remedies::{self, look_alike};

/// The option without which an argument would not be missing. `words`: the command line for clap.
pub(crate) fn option_in_need<'w>(
    command: &Command,
    error: &clap::Error,
    words: &'w [OsString],
) -> Option<&'w str> {
    if error.kind() != ErrorKind::MissingRequiredArgument {
        return None;
    }
    let is_option = |row: &usize| words[*row].as_encoded_bytes().starts_with(b"--");
    let rows: Vec<usize> = (1..words.len()).filter(is_option).chain([words.len()]).collect();
    let is_in_need = |ends: &&[usize]| {
        let without = words[..ends[0]].iter().chain(&words[ends[1]..]);
        let found = command.clone().try_get_matches_from(without).err();
        found.is_none_or(|found| found.kind() != ErrorKind::MissingRequiredArgument)
    };
    let option = rows.windows(2).find(is_in_need).and_then(|ends| words[ends[0]].to_str())?;
    option.split('=').next()
}

/// The message for an error of clap: one line, without the name of the program. `in_need`: the
/// option without which an argument would not be missing; `words`: the command line as it was
/// typed.
pub(crate) fn message(
    command: &Command,
    error: &clap::Error,
    in_need: Option<&str>,
    words: &[OsString],
) -> String {
    let argument = context(error, ContextKind::InvalidArg).unwrap_or_default();
    let value = context(error, ContextKind::InvalidValue).unwrap_or_default();
    let (option, values) = option_and_values(&argument);
    let number = |kind| match error.get(kind) {
        Some(ContextValue::Number(number)) => *number,
        _ => 0,
    };
    match error.kind() {
        ErrorKind::UnknownArgument if argument.starts_with('-') => {
            unknown_option(command, &argument, words)
        }
        ErrorKind::UnknownArgument => {
            // As word processors write the hyphen of an option.
            let first = |word: &OsString| word.to_str()?.get(..3).and_then(look_alike);
            words.iter().find_map(first).unwrap_or_else(|| {
                format!(
                    "`{argument}` is one argument too many: options come with a dash, and there is one file"
                )
            })
        }
        ErrorKind::InvalidValue if value.is_empty() => {
            format!("`{option}` needs a value: `{option} {values}`")
        }
        ErrorKind::InvalidValue => {
            let valid = context(error, ContextKind::ValidValue).unwrap_or_default();
            let similar = context(error, ContextKind::SuggestedValue);
            let similar =
                similar.map(|word| format!("; did you mean `{word}`?")).unwrap_or_default();
            format!("`{option}` takes {valid}, not `{value}`{similar}")
        }
        ErrorKind::ValueValidation => {
            let reason = error.source().map(ToString::to_string).unwrap_or_default();
            format!("`{value}` is not valid for `{option}`: {reason}")
        }
        ErrorKind::WrongNumberOfValues | ErrorKind::TooFewValues | ErrorKind::TooManyValues => {
            let n_given = number(ContextKind::ActualNumValues);
            let n_expected = number(ContextKind::ExpectedNumValues);
            format!(
                "`{option}` takes {} values, not {}: write `{option} {values}`",
                spelled(n_expected),
                spelled(n_given)
            )
        }
        ErrorKind::ArgumentConflict => {
            match context(error, ContextKind::PriorArg).map(|prior| option_and_values(&prior).0) {
                Some(prior) if prior == option => format!("`{option}` is given twice"),
                Some(prior) => format!("`{option}` and `{prior}` cannot be given together"),
                None => format!("`{option}` cannot be given with the other options"),
            }
        }
        ErrorKind::MissingRequiredArgument => {
            let required = format!("{option} {values}");
            let required = required.trim_end();
            let Some(in_need) = in_need.map(|option| as_typed(option, words)) else {
                return format!("`{required}` is missing");
            };
            match owned_by_another(command, &in_need) {
                Some(owned) => format!("{owned}; here it needs `{required}`"),
                None => format!("`{in_need}` needs `{required}`"),
            }
        }
        _ => {
            let text = error.to_string();
            let first = text.lines().next().unwrap_or_default();
            first.strip_prefix("error: ").unwrap_or(first).to_owned()
        }
    }
}

/// The message for a number after an option without values.
pub(crate) fn stray_number(stray: &StrayNumber) -> String {
    let (option, number) = (in_documented_form(&stray.option), stray.number.to_string_lossy());
    format!("`{option}` takes no value: leave out `{number}`")
}

/// A small number in letters.
fn spelled(number: isize) -> String {
    let words = ["no", "one", "two", "three", "four", "five"];
    let word = usize::try_from(number).ok().and_then(|number| words.get(number));
    word.map_or_else(|| number.to_string(), |word| (*word).to_owned())
}

/// The first text of a kind in the context of an error; several are joined with commas.
fn context(error: &clap::Error, kind: ContextKind) -> Option<String> {
    match error.get(kind)? {
        ContextValue::String(text) => Some(text.clone()),
        ContextValue::Strings(texts) => Some(texts.join(", ")),
        _ => None,
    }
}

/// The name of an option as our documentation writes it, and the names of its values: `-vel` and
/// `X Y Z` of `--vel <X> <Y> <Z>`.
fn option_and_values(argument: &str) -> (String, String) {
    let (option, values) = argument.split_once([' ', '=']).unwrap_or((argument, ""));
    (in_documented_form(option), values.replace(['<', '>'], ""))
}

/// An option with one dash if its name is one of the short names of 1988, else with two.
pub(crate) fn in_documented_form(option: &str) -> String {
    match option.strip_prefix("--") {
        Some(name) if is_short_name(name) => format!("-{name}"),
        _ => option.to_owned(),
    }
}

/// True for the names that are documented with one dash: `vel`, `fo`; not `no-flux`.
pub(crate) fn is_short_name(name: &str) -> bool {
    const LONGEST: usize = 4;
    /// Options that have two dashes in most programs of other families.
    const WORDS: [&str; 2] = ["all", "help"];
    !WORDS.contains(&name)
        && (1..=LONGEST).contains(&name.len())
        && name.bytes().all(|byte| byte.is_ascii_lowercase())
}

fn unknown_option(command: &Command, argument: &str, words: &[OsString]) -> String {
    let name = argument.trim_start_matches('-');
    let name = name.split('=').next().unwrap_or(name);
    let argument = argument.split('=').next().unwrap_or(argument);
    let shown = as_typed(argument, words);
    let names = || command.get_arguments().filter(|arg| !arg.is_hide_set()).flat_map(long_names);
    let has = |name: &str| names().any(|other| other == name);
    if let Some((_, ours, why)) =
        ANSWERS.iter().find(|(foreign, ours, _)| foreign.contains(&name) && has(ours))
    {
        return format!("there is no option `{shown}`; {why} `-{ours}`");
    }
    if let Some(owned) = owned_by_another(command, &shown) {
        return owned;
    }
    if let Some((ours, number)) = with_number(name).filter(|(ours, _)| has(ours)) {
        let ours = in_documented_form(&format!("--{ours}"));
        return format!(
            "there is no option `{shown}`; write a blank before the number: `{ours} {number}`"
        );
    }
    match nearest(name, names()).or_else(|| containing(name, names())) {
        Some(near) => format!(
            "there is no option `{shown}`; did you mean `{}`?",
            in_documented_form(&format!("--{near}"))
        ),
        None => format!("there is no option `{shown}`"),
    }
}

/// An option with the dashes that it was typed with: clap gets two.
fn as_typed(argument: &str, words: &[OsString]) -> String {
    let options = words.iter().filter_map(|word| word.to_str()?.split('=').next());
    let mut same =
        options.filter(|word| argument.strip_prefix('-') == Some(word) || argument == *word);
    same.next().map_or_else(|| in_documented_form(argument), str::to_owned)
}

/// The message for an option that another program has, as typed.
fn owned_by_another(command: &Command, option: &str) -> Option<String> {
    let name = option.strip_prefix('-')?.trim_start_matches('-');
    let owner = remedies::program_with_option(name).filter(|owner| *owner != command.get_name())?;
    Some(format!("`{option}` is an option of {owner}, not of {}", command.get_name()))
}

/// The name of an option and the number that is attached to it: `vel.9`.
fn with_number(word: &str) -> Option<(&str, &str)> {
    let (name, number) = word.split_at(word.find(|c: char| !c.is_ascii_alphabetic() && c != '-')?);
    let (name, number) = match name.strip_suffix('-') {
        Some(shorter) => (shorter, &word[shorter.len()..]),
        None => (name, number),
    };
    finite(number).ok().map(|_| (name, number))
}

/// All long names of an option.
fn long_names(arg: &Arg) -> impl Iterator<Item = &str> {
    arg.get_long().into_iter().chain(arg.get_all_aliases().unwrap_or_default())
}

/// Options of other programs, the one of ours that does the same, and what it is.
const ANSWERS: [(&[&str], &str, &str); 13] = [
    (&["width", "height", "w", "resolution", "geometry"], "sz", "the size of the picture is"),
    (&["fov", "angle"], "va", "the view angle is"),
    (&["look-at", "lookat", "target"], "vc", "the point in the middle of the picture is"),
    (&["antialias", "spp"], "aa", "the samples per pixel are"),
    (&["t"], "ti", "the time of the picture is"),
    (&["f"], "fi", "the file to read is"),
    (&["silent"], "qt", "to print only errors, use"),
    (&["debug"], "vb", "to print what is done, use"),
    (&["gamma"], "ex", "brightness is set by"),
    (&["gamma", "speed", "v", "beta"], "vel", "the velocity along x, y and z is"),
    (&["cam-vel"], "cv", "the velocity of the camera is"),
    (&["duration", "seconds"], "frames", "the number of frames is"),
    (&["bgcolor"], "bg", "the background is"),
];

/// The name with the fewest typing errors, at most one in short names and two in longer ones.
fn nearest<'n>(word: &str, names: impl Iterator<Item = &'n str>) -> Option<&'n str> {
    const MAX_LENGTH: usize = 64;
    let word = word.to_ascii_lowercase();
    let most = if word.len() < 6 { 1 } else { 2 };
    let near =
        names.filter(|name| name.len() <= MAX_LENGTH && name.len().abs_diff(word.len()) <= most);
    let near = near.map(|name| (strsim::osa_distance(&word, name), name));
    near.filter(|&(distance, name)| distance <= most && distance < name.len())
        .min()
        .map(|(_, name)| name)
}

/// The only name that has `word` between its hyphens: `keep-in-view` for `keep`.
fn containing<'n>(word: &str, names: impl Iterator<Item = &'n str>) -> Option<&'n str> {
    let mut found = names.filter(|name| name.split('-').any(|part| part == word));
    found.next().filter(|_| found.next().is_none())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_1988_have_one_dash() {
        for (option, expected) in [
            ("--vel", "-vel"),
            ("--fo", "-fo"),
            ("--no-flux", "--no-flux"),
            ("--help", "--help"),
            ("--keep-in-view", "--keep-in-view"),
            ("-q", "-q"),
        ] {
            assert_eq!(in_documented_form(option), expected);
        }
    }

    #[test]
    fn nearest_names() {
        let names = ["vel", "vec", "velocity", "sz", "no-flux"];
        for (word, expected) in [
            ("vell", Some("vel")),
            ("Vel", Some("vel")),
            ("velocty", Some("velocity")),
            ("noflux", Some("no-flux")),
            ("zz", Some("sz")),
            ("banana", None),
        ] {
            assert_eq!(nearest(word, names.into_iter()), expected, "{word}");
        }
    }

    #[test]
    fn names_with_a_word() {
        let names = ["keep-in-view", "no-flux", "no-shadows"];
        for (word, expected) in [
            ("keep", Some("keep-in-view")),
            ("shadows", Some("no-shadows")),
            ("no", None),
            ("x", None),
        ] {
            assert_eq!(containing(word, names.into_iter()), expected, "{word}");
        }
    }
}
