//! The record in the output of how it was made: the command line, and what the first program
//! read.

use std::ffi::OsStr;
use std::path::{Component, Path, PathBuf};

use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Command};
use sha2::{Digest, Sha256};

use crate::cli::args::WITHOUT_EFFECT;
use crate::shell::shell_os_word;
use crate::text::printable;

/// The program and the options that affect the content, in the historical spelling and in the
/// user's order: `uglorentz -vel .9 0 0 -sm`.
///
/// The line is safe inside a `{ … }` comment and on a terminal. Arguments are quoted such that a
/// shell parses them back unchanged.
pub(crate) fn command_line(command: &Command, matches: &ArgMatches) -> String {
    let mut options: Vec<_> = command
        .get_arguments()
        .filter(|arg| matches.value_source(arg.get_id().as_str()) == Some(ValueSource::CommandLine))
        .filter(|arg| !WITHOUT_EFFECT.contains(&arg.get_id().as_str()))
        .collect();
    options.sort_by_key(|arg| matches.index_of(arg.get_id().as_str()));

    let mut line = printable(command.get_name());
    for arg in options {
        for occurrence in matches.get_raw_occurrences(arg.get_id().as_str()).into_iter().flatten() {
            append(&mut line, &spelling(arg));
            if arg.get_action().takes_values() {
                occurrence.for_each(|value| append(&mut line, &shell_os_word(value)));
            }
        }
    }
    line
}

fn append(line: &mut String, word: &str) {
    if !word.is_empty() {
        line.push(' ');
        line.push_str(word);
    }
}

/// One dash for the option names of 1988, which have two or three letters, and two for later ones.
fn spelling(arg: &Arg) -> String {
    match (arg.get_long(), arg.get_short()) {
        (Some(long), _) if long.len() <= 3 => format!("-{long}"),
        (Some(long), _) => format!("--{long}"),
        (None, Some(short)) => format!("-{short}"),
        (None, None) => String::new(),
    }
}

/// The name of an input, quoted for a shell; `-` for standard input.
///
/// It is a path only if that leads from the current folder downwards; otherwise it is the file name
/// alone, so that outputs do not tell how folders are named.
pub(crate) fn recorded_name(path: Option<&Path>) -> String {
    let is_below = |path: &Path| {
        path.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir))
    };
    // `./a.ug` is recorded as `a.ug`, as programs downstream do.
    let plain: Option<PathBuf> = path.map(|path| {
        path.components().filter(|component| *component != Component::CurDir).collect()
    });
    let name = match &plain {
        None => OsStr::new("-"),
        Some(path) if is_below(path) => path.as_os_str(),
        Some(path) => path.file_name().unwrap_or_default(),
    };
    if name.as_encoded_bytes().len() > 1 && name.as_encoded_bytes().starts_with(b"-") {
        // Not an option.
        return shell_os_word(Path::new(".").join(name).as_os_str());
    }
    shell_os_word(name)
}

/// SHA-256 of some bytes in hexadecimal digits, as `sha256sum` prints it.
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use std::ffi::OsString;
    use std::os::unix::ffi::OsStringExt;

    use clap::{Args, Parser};

    use super::*;
    use crate::CommonArgs;
    use crate::cli::argv;

    /// The command line recorded for `words`, by a program with an option of every kind.
    fn recorded(words: Vec<OsString>) -> String {
        let option = |name| Arg::new(name).long(name).allow_hyphen_values(true);
        let command = Command::new("tool")
            .arg(option("vel").alias("velocity").num_args(3))
            .arg(option("va").num_args(1..=2))
            .arg(option("ti").default_value("0"))
            .arg(option("title").value_name("TEXT").value_parser(clap::value_parser!(OsString)))
            .arg(Arg::new("gw").long("gw").action(clap::ArgAction::SetTrue))
            .arg(Arg::new("no-flux").long("no-flux").action(clap::ArgAction::SetTrue));
        let mut command = argv::prepare(CommonArgs::augment_args(command));
        let words = argv::rewrite(&command, std::iter::once("tool".into()).chain(words)).unwrap();
        let matches = command.try_get_matches_from_mut(words).unwrap();
        command_line(&command, &matches)
    }

    #[test]
    fn options_that_affect_the_content() {
        #[track_caller]
        fn check(words: &str, expected: &str) {
            assert_eq!(recorded(words.split_whitespace().map(OsString::from).collect()), expected);
        }
        check("", "tool");
        check("-vel .9 0 0", "tool -vel .9 0 0");
        check("--velocity -.9 0 -1e-3", "tool -vel -.9 0 -1e-3");
        check("--ti=-.5", "tool -ti -.5");
        check("--no-flux -gw -va 40 ship.ug", "tool --no-flux -gw -va 40");
        check("-va 40 30 -ti 0", "tool -va 40 30 -ti 0");
        check("-fi a.ug -fo b.ug -fm c -lax -qt -nt 3", "tool -lax");
        check("--input a.ug --output b.ug --messages c -verbose -threads 1 -gw", "tool -gw");
    }

    #[test]
    fn values_are_safe_in_a_shell_and_in_a_comment() {
        #[track_caller]
        fn check(title: &[u8], expected: &str) {
            let words = vec!["-title".into(), OsString::from_vec(title.to_vec())];
            assert_eq!(recorded(words), format!("tool --title {expected}"));
        }
        check(b"ship", "ship");
        check(b"", "''");
        check(b"a ship", "'a ship'");
        check(b"-vel", "-vel");
        check(b"it's", r"'it'\''s'");
        check(b"$HOME;*", "'$HOME;*'");
        check(b"}{", r#""$(printf '\175\173')""#);
        check(
            b"a\nbc\t\x1b[1m\x7f",
            "'a'\"$(printf '\\012\\142')\"'c'\"$(printf '\\011\\033')\"'[1m'\
             \"$(printf '\\177')\"",
        );
        check(b"it's{}", r#"'it'\''s'"$(printf '\173\175')""#);
        check(b"\xff\xfe7", r#""$(printf '\377\376')"'7'"#);
        check("\u{202e}γ".as_bytes(), r#""$(printf '\342\200\256')"'γ'"#);
        check("\u{fffd}".as_bytes(), "'\u{fffd}'");
        check("γ".as_bytes(), "'γ'");
        check(b"=ls", "'=ls'");
    }

    #[test]
    fn hashes_are_those_of_the_standard() {
        // FIPS 180-4, example of one block.
        let hash = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(sha256(b"abc"), hash);
    }

    #[test]
    fn names_of_inputs_do_not_lead_upwards() {
        let check = |path: Option<&str>, name: &str| {
            assert_eq!(recorded_name(path.map(Path::new)), name);
        };
        check(None, "-");
        check(Some("ship.ug"), "ship.ug");
        check(Some("./scenes/./my ship.ug"), "'scenes/my ship.ug'");
        check(Some("/scenes/ship.ug"), "ship.ug");
        check(Some("../ship.ug"), "ship.ug");
        check(Some("a/../../ship.ug"), "ship.ug");
        check(Some("-vel"), "./-vel");
        check(Some("}.ug"), r#""$(printf '\175')"'.ug'"#);
    }

    #[test]
    fn every_common_option_is_recorded_or_listed_as_without_effect() {
        #[derive(Parser)]
        struct Bare {
            #[command(flatten)]
            _common: CommonArgs,
        }
        let command = <Bare as clap::CommandFactory>::command();
        let ids = command.get_arguments().map(|arg| arg.get_id().as_str());
        let with_effect = Vec::from_iter(ids.filter(|id| !WITHOUT_EFFECT.contains(id)));
        assert_eq!(with_effect, ["lax", "allow_execute", "allow_outside", "limit"]);
    }
}
