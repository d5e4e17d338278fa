//! From the command line to the exit status.

use std::env;
use std::io;
use std::process::ExitCode;

use clap::{ArgMatches, Command};
use signal_hook::consts::SIGPIPE;
use signal_hook::low_level::emulate_default_handler;

use crate::args::CommonArgs;
use crate::failure::Failure;
use crate::messages::Messages;
use crate::stage::Stage;
use crate::{argv, provenance};

/// Arguments of a program of the family.
pub trait ToolArgs: clap::Parser {
    /// The options every program has.
    fn common(&self) -> &CommonArgs;
}

const BAD_INPUT: u8 = 1;
const BAD_USAGE: u8 = 2;

/// The whole `main` of a program: reads the command line, runs `run`, and turns the
/// result into an exit status.
///
/// | status | meaning |
/// | --- | --- |
/// | 0 | done |
/// | 1 | bad scene, or input and output failed |
/// | 2 | bad usage |
/// | killed by SIGPIPE (141 in a shell) | the reader of the output left early |
pub fn main<A: ToolArgs>(run: impl FnOnce(&A, &mut Stage) -> Result<(), Failure>) -> ExitCode {
    let mut command = argv::prepare(A::command());
    let (args, matches) = match parse::<A>(&mut command) {
        Ok(parsed) => parsed,
        Err(error) => return answer(&error),
    };
    let mut messages = Messages::new(command.get_name());
    let opened = messages.follow(args.common());
    let mut stage = Stage::new(args.common(), messages, provenance::command_line(&command, &matches));
    let outcome =
        opened.and_then(|()| start_threads(args.common().threads())).and_then(|()| run(&args, &mut stage));
    match stage.end(outcome) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) if failure.is_closed_pipe() => die_of_sigpipe(),
        Err(Failure::Usage(_)) => BAD_USAGE.into(),
        Err(_) => BAD_INPUT.into(),
    }
}

fn parse<A: ToolArgs>(command: &mut Command) -> Result<(A, ArgMatches), clap::Error> {
    let words = argv::rewrite(command, env::args_os());
    let matches = command.try_get_matches_from_mut(words)?;
    let args = A::from_arg_matches(&matches).map_err(|error| error.format(command))?;
    Ok((args, matches))
}

/// Prints help and version to standard output, complaints to standard error.
fn answer(error: &clap::Error) -> ExitCode {
    match error.print() {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => die_of_sigpipe(),
        Err(_) => BAD_INPUT.into(),
        Ok(()) if error.use_stderr() => BAD_USAGE.into(),
        Ok(()) => ExitCode::SUCCESS,
    }
}

/// Sets the number of threads for the process.
///
/// The run itself stays on the main thread and has its stack, whatever `-nt` says.
fn start_threads(n_threads: Option<usize>) -> Result<(), Failure> {
    let Some(n_threads) = n_threads else { return Ok(()) };
    rayon::ThreadPoolBuilder::new()
        .num_threads(n_threads)
        .build_global()
        .map_err(|error| Failure::Failed(format!("cannot start {n_threads} threads: {error}")))
}

/// Ends as every C filter does when its reader has left. Rust ignores the signal at
/// the start, so its default action is brought back first.
fn die_of_sigpipe() -> ExitCode {
    // Returns only where the system refuses; the status then says what a shell would.
    let _ = emulate_default_handler(SIGPIPE);
    ExitCode::from(141)
}
