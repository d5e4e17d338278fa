//! From the words of a command line to arguments.

use std::ffi::OsString;

use clap::{ArgMatches, Command};

use crate::cli::args::ToolArgs;
use crate::cli::failure::Failure;
use crate::cli::{argv, look, provenance, usage};

/// Why arguments were not parsed.
pub(crate) enum Unparsed {
    /// They are wrong: the message.
    Usage(String),
    /// A request for help or the version.
    Help(clap::Error),
}

/// Parses the command line of a program that is not run but whose functions are called. `words`:
/// the name of the program first.
///
/// # Errors
/// [`Failure::Usage`] with the message of the program.
pub fn parse_words<A: ToolArgs>(words: impl IntoIterator<Item = OsString>) -> Result<A, Failure> {
    Ok(parse_command(words)?.0)
}

/// Like [`parse_words`], and returns the command line that the program would record in its output
/// ([`crate::Context::command_line`]).
///
/// # Errors
/// See [`parse_words`].
pub fn parse_command<A: ToolArgs>(
    words: impl IntoIterator<Item = OsString>,
) -> Result<(A, String), Failure> {
    let mut command = argv::prepare(A::command());
    match parse(&mut command, words) {
        Ok((args, matches)) => Ok((args, provenance::command_line(&command, &matches))),
        Err(Unparsed::Usage(message)) => Err(Failure::Usage(message)),
        Err(Unparsed::Help(text)) => {
            Err(Failure::Usage(usage::message(&command, &text, None, &[])))
        }
    }
}

/// Parses the words of a command line.
pub(crate) fn parse<A: ToolArgs>(
    command: &mut Command,
    words: impl IntoIterator<Item = OsString>,
) -> Result<(A, ArgMatches), Unparsed> {
    let words: Vec<OsString> = words.into_iter().collect();
    let rewritten = argv::rewrite(command, words.iter().cloned());
    let rewritten = rewritten.map_err(|stray| Unparsed::Usage(usage::stray_number(&stray)))?;
    match_words(command, rewritten.clone()).map_err(|error| match error.use_stderr() {
        true => {
            let in_need = usage::option_in_need(command, &error, &rewritten);
            Unparsed::Usage(usage::message(command, &error, in_need, &words))
        }
        false => Unparsed::Help(error),
    })
}

/// Parses words for clap. The matches are those of the words alone, the arguments have the options
/// of a look as well.
fn match_words<A: ToolArgs>(
    command: &mut Command,
    mut words: Vec<OsString>,
) -> Result<(A, ArgMatches), clap::Error> {
    let matches = command.try_get_matches_from_mut(&words)?;
    let of_look = look::words(&matches, &A::LOOKS);
    let with_look = if of_look.is_empty() {
        None
    } else {
        let after_name = words.len().min(1);
        words.splice(after_name..after_name, of_look.into_iter().map(OsString::from));
        Some(command.try_get_matches_from_mut(&words)?)
    };
    let args = A::from_arg_matches(with_look.as_ref().unwrap_or(&matches));
    Ok((args.map_err(|error| error.format(command))?, matches))
}
