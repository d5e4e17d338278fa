//! Historical spelling of options: `-vel .9 0 0` for `--vel .9 0 0`.
//!
//! clap accepts long options only with two dashes and parses `-vel` as the cluster `-v -e -l`. So
//! the arguments are rewritten before clap parses them, for exactly the long names that the
//! [`Command`] declares. Values of options are skipped, as is everything after `--`. A long name
//! takes precedence over a cluster of short ones. Words with one dash that are neither get a second
//! dash as well, so that clap reports the whole word and suggests a similar option.
//!
//! A few single letters that other programs use are accepted as well ([`abbreviated`]).
//!
//! Known limitation: a value in the argument after a *short* option is not skipped. The only short
//! options of our programs are `-h` and `-V`, which take no values.

use std::collections::VecDeque;
use std::ffi::{OsStr, OsString};
use std::path::Path;

use clap::builder::ValueRange;
use clap::{Arg, ArgAction, Command};

use crate::cli::values::finite;
use crate::side::Side;

/// Terminates the values of an option with a variable number of them. [`rewrite`] inserts it for
/// clap; users do not write it.
const END_OF_VALUES: &str = ";";

/// Prepares a command for [`rewrite`], including `--help` and `--version`.
///
/// An option with a variable number of values (`-va A [B]`) gets a value terminator, so that the
/// file in `-va 40 ship.ug` is not parsed as its second value; and so does an option whose values
/// may begin with a dash, so that the option in `-vel .9 -fo x.ug` is not parsed as one of them.
pub(crate) fn prepare(command: Command) -> Command {
    // Messages have the name of the program, whatever name it was called by.
    let name = command.get_name().to_owned();
    let mut command = command.bin_name(name).mut_args(|arg| match arg.get_num_args() {
        Some(range) if is_variable(range) && arg.get_long().is_some() => {
            arg.value_terminator(END_OF_VALUES).allow_hyphen_values(true).action(ArgAction::Set)
        }
        _ if ends_at_options(&arg) => arg.value_terminator(END_OF_VALUES),
        _ => arg,
    });
    command.build();
    command
}

/// A number after an option without values: `-lg 0`. It would be read as the name of the input.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct StrayNumber {
    /// The option, with the dashes that it was given with.
    pub option: String,
    /// The number.
    pub number: OsString,
}

/// Rewrites the arguments for clap. The first is the program name and is not changed.
///
/// # Errors
/// A number follows an option without values, and there is no file of that name.
pub(crate) fn rewrite(
    command: &Command,
    argv: impl IntoIterator<Item = OsString>,
) -> Result<Vec<OsString>, StrayNumber> {
    let mut words: VecDeque<OsString> = argv.into_iter().collect();
    let mut rewritten = Vec::from_iter(words.pop_front());
    while let Some(word) = words.pop_front() {
        if word == "--" {
            rewritten.push(word);
            rewritten.extend(words);
            break;
        }
        let number = words.front().filter(|word| is_number(word) && !Path::new(word).exists());
        let word = abbreviated(command, word, number.is_some());
        let Some(option) = LongOption::find(command, &word) else {
            rewritten.push(if is_unknown(command, &word) { with_dash(&word) } else { word });
            continue;
        };
        if let Some((name, numbers)) = option.attached_numbers(&word) {
            rewritten.push(name);
            copy_values(command, option.arg, &mut numbers.into(), &mut rewritten);
            continue;
        }
        if let (false, Some(number)) = (option.arg.get_action().takes_values(), number) {
            return Err(StrayNumber {
                option: word.to_string_lossy().into_owned(),
                number: number.clone(),
            });
        }
        rewritten.push(option.with_two_dashes(word));
        if !option.has_value {
            copy_values(command, option.arg, &mut words, &mut rewritten);
        }
    }
    Ok(rewritten)
}

/// An argument that names a long option.
struct LongOption<'a> {
    arg: &'a Arg,
    has_two_dashes: bool,
    /// The value is in the same argument: `-fi=ship.ug`.
    has_value: bool,
}

impl<'a> LongOption<'a> {
    fn find(command: &'a Command, word: &OsStr) -> Option<Self> {
        let after_dash = word.as_encoded_bytes().strip_prefix(b"-")?;
        let after_dashes = after_dash.strip_prefix(b"-");
        let name_and_value = after_dashes.unwrap_or(after_dash);
        let equals = name_and_value.iter().position(|&byte| byte == b'=');
        let name =
            str::from_utf8(&name_and_value[..equals.unwrap_or(name_and_value.len())]).ok()?;
        // Short options clap parses itself.
        let is_short = |arg: &Arg| arg.get_short().is_some_and(|letter| name == letter.to_string());
        if command.get_arguments().any(is_short) {
            return None;
        }
        let arg = command.get_arguments().find(|arg| has_long_name(arg, name))?;
        Some(Self { arg, has_two_dashes: after_dashes.is_some(), has_value: equals.is_some() })
    }

    /// The option and its numbers, if `word` has several: `-sz=80x60`.
    fn attached_numbers(&self, word: &OsStr) -> Option<(OsString, Vec<OsString>)> {
        let (name, value) = word.to_str()?.split_once('=')?;
        Some((self.with_two_dashes(name.into()), joined_numbers(self.arg, value.as_ref())?))
    }

    fn with_two_dashes(&self, word: OsString) -> OsString {
        if self.has_two_dashes {
            return word;
        }
        with_dash(&word)
    }
}

/// `word` with another dash before it.
fn with_dash(word: &OsStr) -> OsString {
    let mut longer = OsString::from("-");
    longer.push(word);
    longer
}

/// True for a word with one dash that is no cluster of short options: a misspelt long option.
fn is_unknown(command: &Command, word: &OsStr) -> bool {
    let Some(letters) = word.to_str().and_then(|word| word.strip_prefix('-')) else { return false };
    let short = |letter: char| command.get_arguments().find(|arg| arg.get_short() == Some(letter));
    let takes_value =
        |letter: char| short(letter).is_some_and(|arg| arg.get_action().takes_values());
    letters.len() > 1
        && letters.starts_with(|first: char| first.is_ascii_alphabetic() && !takes_value(first))
        && !letters.chars().all(|letter| short(letter).is_some())
}

fn has_long_name(arg: &Arg, name: &str) -> bool {
    arg.get_long() == Some(name)
        || arg.get_all_aliases().is_some_and(|aliases| aliases.contains(&name))
}

/// The long name of the option that other programs call by one letter, if `command` has it and not
/// that letter; else `word`. `-v` before a number is not `--verbose`, but a mistake.
fn abbreviated(command: &Command, word: OsString, precedes_number: bool) -> OsString {
    const LETTERS: [(&str, char, &str); 5] = [
        ("-o", 'o', "fo"),
        ("-i", 'i', "fi"),
        ("-q", 'q', "qt"),
        ("-v", 'v', "vb"),
        ("-j", 'j', "nt"),
    ];
    let Some((_, letter, name)) = LETTERS.into_iter().find(|(dashed, ..)| word == *dashed) else {
        return word;
    };
    let is_free = command.get_arguments().all(|arg| arg.get_short() != Some(letter));
    let is_meant = |arg: &Arg| {
        has_long_name(arg, name) && (arg.get_action().takes_values() || !precedes_number)
    };
    if is_free && command.get_arguments().any(is_meant) { format!("--{name}").into() } else { word }
}

/// The numbers of `80x60` or `.9,0,0`, or those over the time of a film, `0 0 0 .. 0 .9 0`, if
/// `arg` takes as many.
fn joined_numbers(arg: &Arg, word: &OsStr) -> Option<Vec<OsString>> {
    let range = arg.get_num_args().filter(|range| range.max_values() > 1)?;
    let word = word.to_str()?;
    let numbers = rows_in_time(word)
        .unwrap_or_else(|| word.split([',', 'x', '×']).map(OsString::from).collect());
    let is_whole =
        numbers.len() > 1 && (range.min_values()..=range.max_values()).contains(&numbers.len());
    (is_whole && numbers.iter().all(|number| is_number(number))).then_some(numbers)
}

/// The words `0..0`, `0..0.9`, `0..0` for `0 0 0 .. 0 .9 0`: each number with its values in time.
fn rows_in_time(word: &str) -> Option<Vec<OsString>> {
    let rows: Vec<Vec<&str>> =
        word.split("..").map(|row| row.split_whitespace().collect()).collect();
    let n_numbers = rows.first()?.len();
    if rows.len() < 2 || n_numbers < 2 || rows.iter().any(|row| row.len() != n_numbers) {
        return None;
    }
    let values = |column: usize| rows.iter().map(move |row| row[column]);
    Some((0..n_numbers).map(|column| in_time(values(column)).into()).collect())
}

/// The word for values over the time of a film, `0..0.9` for `0` and `.9`: a decimal point at an
/// end of a number would look like one of the dots.
fn in_time<'n>(values: impl Iterator<Item = &'n str>) -> String {
    let whole = |number: &str| {
        let number = number.trim_end_matches('.');
        if number.starts_with('.') { format!("0{number}") } else { number.to_owned() }
    };
    values.map(whole).collect::<Vec<_>>().join("..")
}

/// Joins values over the time of a film that are written with blanks: `0 .. .9 0 0` becomes
/// `0..0.9 0 0`, and `0 0 0 .. 0 .9 0` a word for each number.
fn join_times(arg: &Arg, words: &mut VecDeque<OsString>) {
    let is_part = |word: &&OsString| *word == ".." || is_number(word);
    let parts = words.iter().take_while(is_part).map_while(|word| word.to_str().map(str::to_owned));
    let parts: Vec<String> = parts.collect();
    if !parts.iter().any(|part| part == "..") {
        return;
    }
    words.drain(..parts.len());
    let max = arg.get_num_args().map_or(1, |range| range.max_values());
    let rows = rows_in_time(&parts.join(" ")).filter(|columns| columns.len() <= max);
    let joined = rows.unwrap_or_else(|| {
        let mut joined: Vec<String> = Vec::new();
        let mut parts = parts.iter();
        while let Some(part) = parts.next() {
            match (part.as_str(), joined.pop()) {
                ("..", Some(before)) => {
                    let after = parts.next().map_or("", String::as_str);
                    joined.push(in_time([before.as_str(), after].into_iter()));
                }
                (_, before) => joined.extend(before.into_iter().chain([part.clone()])),
            }
        }
        joined.into_iter().map(OsString::from).collect()
    });
    joined.into_iter().rev().for_each(|word| words.push_front(word));
}

/// Copies the values of `arg` unchanged, except that numbers joined by commas or, as in `80x60`, by
/// `x` are separated, and numbers over time are joined.
///
/// The required values come first, up to the next option. Optional values are numbers or lengths in
/// all our programs, which distinguishes them from file names. A negative number is the value of an
/// option with one value even if the option takes only positive ones, and is attached to it by `=`:
/// clap would take it for an option.
fn copy_values(
    command: &Command,
    arg: &Arg,
    words: &mut VecDeque<OsString>,
    out: &mut Vec<OsString>,
) {
    let Some(range) = arg.get_num_args().filter(|_| arg.get_action().takes_values()) else {
        return;
    };
    join_times(arg, words);
    if range == ValueRange::SINGLE
        && let Some(value) =
            next_if(words, |word| !may_be_value(command, arg, word) && is_number(word))
        && let Some(option) = out.last_mut()
    {
        option.push("=");
        option.push(value);
        return;
    }
    let mut n_taken = 0;
    if let Some(numbers) = words.front().and_then(|word| joined_numbers(arg, word)) {
        words.pop_front();
        n_taken = numbers.len();
        out.extend(numbers);
    }
    while n_taken < range.max_values() {
        let is_needed = n_taken < range.min_values();
        let belongs = |word: &OsString| {
            if is_needed {
                may_be_value(command, arg, word)
            } else {
                is_number(word) || is_length(word)
            }
        };
        let Some(value) = next_if(words, belongs) else { break };
        out.push(value);
        n_taken += 1;
    }
    let is_cut = n_taken < range.min_values() && ends_at_options(arg);
    if is_cut || (range.min_values()..range.max_values()).contains(&n_taken) {
        out.push(END_OF_VALUES.into());
    }
}

/// The first word, removed, if it fulfils a condition.
fn next_if(
    words: &mut VecDeque<OsString>,
    condition: impl FnOnce(&OsString) -> bool,
) -> Option<OsString> {
    words.front().is_some_and(condition).then(|| words.pop_front()).flatten()
}

/// True if `word` can be a value of `arg`: a word with a leading dash only if clap would accept it
/// and it is not the next option, so that `-fi -fo x` is reported as a missing value of `-fi`.
fn may_be_value(command: &Command, arg: &Arg, word: &OsStr) -> bool {
    let is_dashed = word.as_encoded_bytes().starts_with(b"-") && word != "-";
    let is_option = || ends_at_options(arg) && LongOption::find(command, word).is_some();
    !is_dashed || (arg.is_allow_hyphen_values_set() && !is_option())
}

/// True for options whose values may begin with a dash, as negative numbers do, but are no text.
fn ends_at_options(arg: &Arg) -> bool {
    let is_text =
        arg.get_value_names().is_some_and(|names| names.iter().any(|name| name == "TEXT"));
    arg.is_allow_hyphen_values_set() && !is_text
}

/// True for a number, and for numbers over the time of a film: `-10..10`.
fn is_number(word: &OsStr) -> bool {
    word.to_str().is_some_and(|word| word.split("..").all(|number| finite(number.trim()).is_ok()))
}

/// True for a number with a unit of length: `6cm`.
fn is_length(word: &OsStr) -> bool {
    word.to_str().and_then(|word| Side::parse(word).ok()).is_some_and(Side::is_length)
}

fn is_variable(range: ValueRange) -> bool {
    range.min_values() < range.max_values()
}

#[cfg(test)]
mod tests {
    use std::os::unix::ffi::OsStringExt;

    use super::*;

    fn tool() -> Command {
        let number = |name| Arg::new(name).long(name).value_parser(finite);
        let flag = |name| Arg::new(name).long(name).action(ArgAction::SetTrue);
        prepare(
            Command::new("tool")
                .version("1")
                .arg(
                    number("vel")
                        .alias("velocity")
                        .num_args(3)
                        .action(ArgAction::Set)
                        .allow_hyphen_values(true),
                )
                .arg(number("ti").allow_hyphen_values(true))
                .arg(number("va").num_args(1..=2))
                .arg(Arg::new("an").long("an").num_args(1..=3))
                .arg(number("lg").num_args(0..=1).default_missing_value("7"))
                .arg(Arg::new("title").long("title").value_name("TEXT").allow_hyphen_values(true))
                .arg(Arg::new("fi").long("fi"))
                .arg(flag("gw"))
                .arg(flag("no-flux"))
                .arg(flag("w").short('w'))
                .arg(flag("g").short('g'))
                .arg(Arg::new("t").short('t').allow_hyphen_values(true).value_parser(finite))
                .arg(Arg::new("file")),
        )
    }

    /// Rewrites a line of words without blanks, and lets clap read it.
    fn parse(line: &str) -> (String, Result<clap::ArgMatches, clap::Error>) {
        let command = tool();
        let words =
            rewrite(&command, format!("tool {line}").split_whitespace().map(OsString::from))
                .unwrap();
        let rewritten =
            Vec::from_iter(words[1..].iter().map(|word| word.to_str().unwrap())).join(" ");
        (rewritten, command.try_get_matches_from(words))
    }

    #[test]
    fn options_with_one_dash() {
        #[track_caller]
        fn check(line: &str, expected: &str) {
            let (rewritten, read) = parse(line);
            assert_eq!(rewritten, expected, "{line}");
            assert!(read.is_ok(), "{line}: {}", read.unwrap_err());
        }
        check("", "");
        check("-vel .9 0 0", "--vel .9 0 0");
        // Numbers may be joined.
        check("-vel .9,0,-1e-3 -gw", "--vel .9 0 -1e-3 --gw");
        check("-vel -.9,0,0", "--vel -.9 0 0");
        check("-velocity=.9,0,0 -gw", "--velocity .9 0 0 --gw");
        check("-va 40x30 ship.ug", "--va 40 30 ship.ug");
        check("-an 2in 72pt ship.ug", "--an 2in 72pt ; ship.ug");
        check("-title a,b", "--title a,b");
        // Values over time may have blanks.
        check("-title 0 .. 5", "--title 0..5");
        check("-vel -.9 0 -1e-3", "--vel -.9 0 -1e-3");
        check("-vel -.9 0 -1e-3 -gw", "--vel -.9 0 -1e-3 --gw");
        check("--vel -5.e-1 0 0 -gw", "--vel -5.e-1 0 0 --gw");
        check("-velocity .9 0 0", "--velocity .9 0 0");
        check("--velocity .9 0 0", "--velocity .9 0 0");
        check("-ti -5", "--ti -5");
        check("-ti=-.5 -gw", "--ti=-.5 --gw");
        check("--ti=-.5 -gw", "--ti=-.5 --gw");
        check("-no-flux ship.ug", "--no-flux ship.ug");
        // A single dash is a file name.
        check("-", "-");
        check("-fi -", "--fi -");
        check("-fi - -gw", "--fi - --gw");
        check("-fi=ship.ug", "--fi=ship.ug");
        // Values are never options.
        check("-title -vel", "--title -vel");
        check("-title -vel -gw", "--title -vel --gw");
        check("-title -- -gw", "--title -- --gw");
        check("-title=-vel", "--title=-vel");
        // Nor are files after two dashes.
        check("-- -vel", "-- -vel");
        check("-gw -- -gw", "--gw -- -gw");
        // Short options, single and in clusters, are not changed; a long name takes precedence.
        check("-w", "-w");
        check("-wg", "-wg");
        check("-gw", "--gw");
        check("-t-3", "-t-3");
        check("-t -3", "-t -3");
        // A number is a value even where only positive ones are valid.
        check("-fi -3 -gw", "--fi=-3 --gw");
        check("-fi -.5e1 -gw", "--fi=-.5e1 --gw");
    }

    #[test]
    fn rows_become_values_of_each_number() {
        let words = |word: &str| {
            rows_in_time(word).map(|words| words.join(" ".as_ref()).into_string().unwrap())
        };
        assert_eq!(words("0 0 0 .. 0 .9 0").as_deref(), Some("0..0 0..0.9 0..0"));
        assert_eq!(words("1. 2..3 4 .. -5. 6").as_deref(), Some("1..3..-5 2..4..6"));
        for word in ["-10..10", "0 0 0", "0 0 .. 1", ".. 1 2", "a b"] {
            assert_eq!(words(word), None, "{word}");
        }
    }

    #[test]
    fn optional_values_end_at_the_first_word_that_is_not_a_number() {
        #[track_caller]
        fn check(line: &str, expected: &str, name: &str, values: &[&str], file: Option<&str>) {
            let (rewritten, read) = parse(line);
            assert_eq!(rewritten, expected, "{line}");
            let read = read.unwrap_or_else(|error| panic!("{line}: {error}"));
            let raw = read.get_raw(name).into_iter().flatten();
            assert_eq!(Vec::from_iter(raw.map(|value| value.to_str().unwrap())), values, "{line}");
            assert_eq!(read.get_one::<String>("file").map(String::as_str), file, "{line}");
        }
        check("-va 40", "--va 40 ;", "va", &["40"], None);
        check("-va 40 30", "--va 40 30", "va", &["40", "30"], None);
        check("-va 40 30 ship.ug", "--va 40 30 ship.ug", "va", &["40", "30"], Some("ship.ug"));
        check("-va 40 ship.ug", "--va 40 ; ship.ug", "va", &["40"], Some("ship.ug"));
        check("-va 40 -gw", "--va 40 ; --gw", "va", &["40"], None);
        check("-va 40 - -gw", "--va 40 ; - --gw", "va", &["40"], Some("-"));
        check("-va -.5 -1e-3 -gw", "--va -.5 -1e-3 --gw", "va", &["-.5", "-1e-3"], None);
        check("-va=40 ship.ug", "--va=40 ship.ug", "va", &["40"], Some("ship.ug"));
        check("-an eye ship.ug", "--an eye ; ship.ug", "an", &["eye"], Some("ship.ug"));
        check(
            "-an -.5 0 -1e-3 ship.ug",
            "--an -.5 0 -1e-3 ship.ug",
            "an",
            &["-.5", "0", "-1e-3"],
            Some("ship.ug"),
        );
        check("-an center -- -gw", "--an center ; -- -gw", "an", &["center"], Some("-gw"));
        check("-lg ship.ug", "--lg ; ship.ug", "lg", &["7"], Some("ship.ug"));
        check("-lg 3 ship.ug", "--lg 3 ship.ug", "lg", &["3"], Some("ship.ug"));
        check("-lg -gw", "--lg ; --gw", "lg", &["7"], None);
    }

    #[test]
    fn usage_errors_name_the_option_and_value() {
        #[track_caller]
        fn check(line: &str, expected: &str) {
            let error = parse(line).1.expect_err(line).to_string();
            assert_eq!(error.lines().next(), Some(expected), "{line}");
        }
        check(
            "-vel .9 0",
            "error: 3 values required for '--vel <vel> <vel> <vel>' but 2 were provided",
        );
        check(
            "-vel .9 0 -gw",
            "error: 3 values required for '--vel <vel> <vel> <vel>' but 2 were provided",
        );
        check("-ti -gw", "error: a value is required for '--ti <ti>' but none was supplied");
        check(
            "-vel .9 0 nan",
            "error: invalid value 'nan' for '--vel <vel> <vel> <vel>': not a finite number",
        );
        check("-ti 1e999", "error: invalid value '1e999' for '--ti <ti>': not a finite number");
        check(
            "-vel .9 0 0 -vel .5 0 0",
            "error: the argument '--vel <vel> <vel> <vel>' cannot be used multiple times",
        );
        check("-fi -gw", "error: a value is required for '--fi <fi>' but none was supplied");
        check("-va", "error: a value is required for '--va <va>...' but none was supplied");
        check("-va -gw", "error: a value is required for '--va <va>...' but none was supplied");
        check("-va 1 2 3 4", "error: unexpected argument '4' found");
        check("---gw", "error: unexpected argument '---gw' found");
        check("-q", "error: unexpected argument '-q' found");
        check(
            "-vel .9,0",
            "error: 3 values required for '--vel <vel> <vel> <vel>' but 1 was provided",
        );
        check("-velo .9 0 0", "error: unexpected argument '--velo' found");
        check("-gx", "error: unexpected argument '--gx' found");
    }

    #[test]
    fn numbers_after_options_without_values() {
        let check = |line: &str, expected: Option<(&str, &str)>| {
            let words = format!("tool {line}");
            let rewritten = rewrite(&tool(), words.split_whitespace().map(OsString::from));
            let stray = rewritten.err().map(|stray| (stray.option, stray.number));
            assert_eq!(
                stray,
                expected.map(|(option, number)| (option.into(), number.into())),
                "{line}"
            );
        };
        check("-gw 0 ship.ug", Some(("-gw", "0")));
        check("--no-flux -.5", Some(("--no-flux", "-.5")));
        check("-gw ship.ug", None);
        check("-gw -- 0", None);
        check("-lg 0", None);
        check("-title -gw 0", None);
    }

    #[test]
    fn help_and_version_come_with_one_dash() {
        for (line, kind) in [
            ("-help", clap::error::ErrorKind::DisplayHelp),
            ("-version", clap::error::ErrorKind::DisplayVersion),
        ] {
            assert_eq!(parse(line).1.expect_err(line).kind(), kind);
        }
    }

    #[test]
    fn arguments_need_not_be_utf_8() {
        #[track_caller]
        fn check(words: &[&[u8]], expected: &[&[u8]]) {
            let words = words.iter().map(|word| OsString::from_vec(word.to_vec()));
            let rewritten = rewrite(&tool(), words).unwrap().into_iter().map(OsString::into_vec);
            assert_eq!(Vec::from_iter(rewritten), expected);
        }
        check(&[], &[]);
        check(&[b"\xff"], &[b"\xff"]);
        check(&[b"-vel"], &[b"-vel"]);
        check(&[b"tool", b"-fi", b"\xff.ug", b"-gw"], &[b"tool", b"--fi", b"\xff.ug", b"--gw"]);
        check(&[b"tool", b"-fi=\xff.ug"], &[b"tool", b"--fi=\xff.ug"]);
        check(&[b"tool", b"-\xff", b"-gw"], &[b"tool", b"-\xff", b"--gw"]);
        check(&[b"tool", b"-va", b"40", b"\xff"], &[b"tool", b"--va", b"40", b";", b"\xff"]);
    }
}
