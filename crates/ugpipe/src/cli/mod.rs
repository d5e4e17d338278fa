//! The command line and the system: arguments, help, streams, files, messages, exit status.

use std::process::ExitCode;

mod args;
mod argv;
#[cfg(unix)]
mod at_start;
#[cfg(unix)]
mod cleanup;
mod completion;
mod context;
mod failure;
mod files;
mod folder;
mod help;
#[cfg(unix)]
mod identity;
mod input;
mod look;
mod manual;
mod messages;
#[cfg(not(unix))]
mod no_system;
#[cfg(unix)]
mod output;
mod parse;
mod provenance;
#[cfg(unix)]
mod run;
pub mod stale;
#[cfg(unix)]
mod steps;
#[cfg(unix)]
mod streams;
mod usage;
mod values;

#[cfg(not(unix))]
use no_system::{cleanup, output, run, steps};

pub use args::{CommonArgs, ToolArgs, WRITING, globally};
#[cfg(unix)]
pub use cleanup::leave_signals;
pub use cleanup::{Claim, Running, is_occupied};
pub use completion::{COMPLETE, completions};
pub use context::{Context, MAX_INPUT};
pub use failure::{Failure, Words};
pub use files::ProgramOutput;
pub use help::{DASHES, DOCUMENTATION, EXIT_STATUS};
pub use input::Input;
pub use look::{Look, LookArgs, Looks, Preset, is_given};
pub use manual::{Entry, Group, Manual, Value, manual};
pub use messages::Host;
pub use parse::{parse_command, parse_words};
pub use provenance::sha256;
pub use run::main;
pub use steps::Steps;
pub use values::{finite, number, one_of, vector, view_angle, whole};

/// As [`main`], for commands whose result can be negative: then `run` returns false, its output is
/// kept, and the exit status is 1.
pub fn main_of_verdicts<A: ToolArgs>(
    run: impl FnOnce(&A, &mut Context) -> Result<bool, Failure>,
) -> ExitCode {
    let mut is_positive = true;
    let status = main(|args: &A, context: &mut Context| {
        is_positive = run(args, context)?;
        Ok(())
    });
    if is_positive { status } else { ExitCode::FAILURE }
}
