//! The `main` of every program: from the command line to the exit status.

use std::env;
use std::io;
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::AtomicBool;
use std::sync::mpsc::{self, Sender};
use std::thread;

use anstream::{AutoStream, ColorChoice};
use clap::Command;
use rayon::{ThreadBuilder, ThreadPoolBuilder};
use rustix::process::{Resource, getrlimit};
use signal_hook::consts::{SIGABRT, SIGPIPE};
use signal_hook::flag::register_conditional_shutdown;
use signal_hook::low_level::emulate_default_handler;

use crate::cli::args::ToolArgs;
use crate::cli::context::Context;
use crate::cli::failure::{Failure, reason};
use crate::cli::manual::manual;
use crate::cli::messages::Messages;
use crate::cli::output::Output;
use crate::cli::parse::{Unparsed, parse};
use crate::cli::{argv, cleanup, completion, help, provenance, streams};

const BAD_INPUT: u8 = 1;
const BAD_USAGE: u8 = 2;

/// The whole `main` of a program: parses the command line, calls `run`, and converts the result to
/// an exit status.
///
/// | status | meaning |
/// | --- | --- |
/// | 0 | success |
/// | 1 | invalid scene, I/O error, or lack of memory |
/// | 2 | invalid usage |
/// | killed by SIGPIPE (141 in a shell) | the reading end of the output pipe was closed |
///
/// # A whole program
///
/// ```no_run
/// use std::process::ExitCode;
///
/// use clap::{ArgAction, Parser};
/// use ugpipe::{CommonArgs, Context, Failure, ToolArgs};
///
/// /// Copies a scene at rest
/// #[derive(Parser)]
/// #[command(name = "ugstill", version, after_help = "Examples:\n  ugstill ship.ug > copy.ug")]
/// struct Args {
///     /// Velocity of all objects, fraction of c
///     #[arg(long, visible_alias = "velocity", num_args = 3, value_names = ["X", "Y", "Z"],
///           action = ArgAction::Set, allow_hyphen_values = true, value_parser = ugpipe::finite)]
///     vel: Option<Vec<f64>>,
///
///     #[command(flatten)]
///     common: CommonArgs,
/// }
///
/// impl ToolArgs for Args {
///     const ESSENTIAL: &'static [&'static str] = &["-vel", "-fo"];
///
///     fn common(&self) -> &CommonArgs {
///         &self.common
///     }
/// }
///
/// fn main() -> ExitCode {
///     ugpipe::main(run)
/// }
///
/// fn run(args: &Args, context: &mut Context) -> Result<(), Failure> {
///     let velocity = ugpipe::vector(args.vel.as_deref()).unwrap_or_default();
///     if velocity != [0.0; 3] {
///         return Err(Failure::usage("cannot move; leave out `-vel`"));
///     }
///     let input = context.input()?;
///     context.note(&format!("{}: {} bytes at rest", input.name, input.text.len()));
///     context.write(&input.text)
/// }
/// ```
pub fn main<A: ToolArgs>(run: impl FnOnce(&A, &mut Context) -> Result<(), Failure>) -> ExitCode {
    exit_on_abort();
    cleanup::survive_size_limits();
    if let Some(words) = completion::words_of_shell(env::args_os()) {
        let manual = manual::<A>();
        return print(&manual.name, &completion::completions(&manual, &words));
    }
    let mut command = argv::prepare(A::command());
    let mut parsed = parse::<A>(&mut command, env::args_os());
    if let Err(Unparsed::Help(_)) = parsed {
        // Not before they are needed: making the texts takes longer than parsing.
        command = help::install(command, A::ESSENTIAL);
        parsed = parse::<A>(&mut command, env::args_os());
    }
    let (args, matches) = match parsed {
        Ok(parsed) => parsed,
        Err(Unparsed::Usage(message)) => return refuse(&command, message),
        Err(Unparsed::Help(text)) => return print(command.get_name(), &styled(&text)),
    };
    let mut messages = Messages::new(command.get_name());
    let mut common = args.common().clone();
    common.fo = common.fo.or_else(|| args.default_output().map(Path::to_owned));
    let opened = streams::check(&common, &matches).and_then(|()| messages.configure(&common));
    let mut context = Context::new(&common, messages, provenance::command_line(&command, &matches));
    let outcome = opened
        .and_then(|()| start_threads(args.common().nt))
        .and_then(|()| run(&args, &mut context));
    match context.end(outcome) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) if failure.is_closed_pipe() => die_of_sigpipe(),
        Err(Failure::Usage(_)) => BAD_USAGE.into(),
        Err(_) => BAD_INPUT.into(),
    }
}

/// The text of the help or the version, with styles if standard output shows them.
fn styled(text: &clap::Error) -> String {
    match AutoStream::choice(&io::stdout()) {
        ColorChoice::Never => text.render().to_string(),
        _ => text.render().ansi().to_string(),
    }
}

/// Prints text to standard output instead of running the program.
fn print(program: &str, text: &str) -> ExitCode {
    match Output::new(None).write_with(|out| out.write_all(text.as_bytes())) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) if failure.is_closed_pipe() => die_of_sigpipe(),
        Err(failure) => {
            Messages::new(program).failure(&failure);
            BAD_INPUT.into()
        }
    }
}

/// Prints an error of usage.
fn refuse(command: &Command, message: String) -> ExitCode {
    Messages::new(command.get_name()).failure(&Failure::Usage(message));
    BAD_USAGE.into()
}

/// Address space that is set aside for each thread, in bytes: the allocator of the system maps 64
/// to 128 MB for one, and its stack has 2 MB. Where that fails, so do the smallest allocations.
const SPACE_PER_THREAD: u64 = 200 << 20;

/// The number of threads for which the address space suffices that `ulimit -v` leaves.
fn n_threads_in_space() -> usize {
    let space = getrlimit(Resource::As).current.map_or(u64::MAX, |bytes| bytes / SPACE_PER_THREAD);
    usize::try_from(space).unwrap_or(usize::MAX)
}

/// Starts the worker threads of the process: `n_threads`, or as many as the system allows, up to
/// one per core; fewer where there is little address space. The variable of rayon has no effect.
///
/// The run itself stays on the main thread with its larger stack, for any value of `-nt`.
fn start_threads(n_threads: Option<u32>) -> Result<(), Failure> {
    let wanted = n_threads
        .map_or_else(|| thread::available_parallelism().map_or(1, usize::from), |n| n as usize);
    // rayon panics if a thread cannot be started, so the threads are started first.
    let mut waiting = Vec::new();
    for _ in 0..wanted.min(n_threads_in_space()) {
        match waiting_thread() {
            Ok(thread) => waiting.push(thread),
            Err(error) if n_threads.is_some() => {
                let why = reason(&error);
                let message =
                    format!("cannot start {wanted} threads: {why}; give a smaller number to -nt");
                return Err(Failure::Failed(message));
            }
            Err(_) => break,
        }
    }
    let pool = ThreadPoolBuilder::new();
    if waiting.is_empty() {
        return Ok(pool.num_threads(1).use_current_thread().build_global()?);
    }
    let pool = pool.num_threads(waiting.len());
    Ok(pool
        .spawn_handler(|thread| {
            waiting[thread.index()].send(thread).map_err(|_| io::ErrorKind::BrokenPipe.into())
        })
        .build_global()?)
}

/// Starts a thread that waits for its work.
fn waiting_thread() -> io::Result<Sender<ThreadBuilder>> {
    let (sender, receiver) = mpsc::channel();
    let work = move || receiver.recv().map_or((), ThreadBuilder::run);
    thread::Builder::new().spawn(work)?;
    Ok(sender)
}

/// Makes lack of memory end the program with status 1: the standard library prints how many bytes
/// could not be allocated, and aborts.
fn exit_on_abort() {
    static ALWAYS: AtomicBool = AtomicBool::new(true);
    // Without the handler the program is killed by SIGABRT, as any other.
    let _ = register_conditional_shutdown(SIGABRT, BAD_INPUT.into(), &ALWAYS);
}

/// Ends like filters written in C when the reading end of their pipe is closed. Rust programs
/// ignore the signal by default, so its default action is restored first.
fn die_of_sigpipe() -> ExitCode {
    // Returns only if this fails; the exit status is then the one that a shell would report.
    let _ = emulate_default_handler(SIGPIPE);
    ExitCode::from(141)
}
