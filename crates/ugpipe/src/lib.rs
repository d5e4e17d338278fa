//! The Unix edge of the ug programs: arguments, streams, messages, exit status.
//!
//! Every program of the family is a filter: it reads a scene, computes, and writes a
//! scene or a picture.
//!
//! ```text
//! uglorentz -vel .9 0 0 < ship.ug | ugdoppler | ugrainbow > ship.png
//! ```
//!
//! What makes a filter a good neighbour in a pipe is the same for all of them, so it is
//! here once, and the programs do not touch the process at all.
//!
//! - **Options.** The names of 1988 work as they did, with one dash and separate values,
//!   negative numbers included: `-vel -.9 0 0`. They are ordinary long options to clap
//!   ([`finite`] and [`vector`] read their numbers), and get their second dash before clap
//!   sees them. An option with a variable number of values (`num_args = 1..=2`) takes those
//!   it needs and then only numbers, so a file name may follow it; nothing but `num_args`
//!   has to be declared for that.
//! - **Streams.** Data on standard output only, all talk on standard error. [`CommonArgs`]
//!   sends them to files instead. A program reads all, computes, and writes all, so that a
//!   mistake on the last line of a scene cannot leave half a scene to the next program.
//! - **Files and programs** that an input names are read and run ([`read_file`],
//!   [`run_program`]) with bounds, and never searched for.
//! - **Files** appear whole or not at all: written beside their place and renamed when the
//!   run has ended well. Links are followed, permissions kept, devices written to directly.
//! - **Messages** are lines such as `uglorentz: warning: …`, each written in one piece since
//!   programs of a pipe share the terminal. Colour appears only on a terminal, and not
//!   under `NO_COLOR`.
//! - **Long runs** show a bar on a terminal after a second, and tell the times of their steps
//!   under `-vb`: computations tell a [`Progress`] how far they are, and do not know who listens.
//! - **Exit status** 0 when done, 1 for a bad scene or failed input and output, 2 for bad
//!   usage. When the reader of a pipe leaves early, the program dies of SIGPIPE without a
//!   word, as C filters do.
//! - **The same bytes** whatever `-nt` says and wherever the files are:
//!   [`Stage::command_line`], made for the comment at the head of an output, names only the
//!   options that affect the content.
//!
//! What we do not do: no output is flushed to the disk itself (`fsync`), so a power failure
//! may undo a finished run; and a program that is killed while it writes a file leaves the
//! temporary file, `.ug-` and six letters, beside it.
//!
//! A library that only reports its progress does without the feature `cli`: then
//! [`Progress`] is all there is, and clap is not built.
//!
//! # A whole program
//!
//! ```no_run
//! use std::process::ExitCode;
//!
//! use clap::{ArgAction, Parser};
//! use ugpipe::{CommonArgs, Failure, Stage, ToolArgs};
//!
//! /// Moves nothing, and says so
//! #[derive(Parser)]
//! #[command(name = "ugstill", version, before_help = ugpipe::ONE_DASH)]
//! struct Args {
//!     /// Velocity of all objects, fraction of c
//!     #[arg(long, visible_alias = "velocity", num_args = 3, value_names = ["X", "Y", "Z"],
//!           action = ArgAction::Set, allow_hyphen_values = true, value_parser = ugpipe::finite)]
//!     vel: Option<Vec<f64>>,
//!
//!     #[command(flatten)]
//!     common: CommonArgs,
//! }
//!
//! impl ToolArgs for Args {
//!     fn common(&self) -> &CommonArgs {
//!         &self.common
//!     }
//! }
//!
//! fn main() -> ExitCode {
//!     ugpipe::main(run)
//! }
//!
//! fn run(args: &Args, stage: &mut Stage) -> Result<(), Failure> {
//!     let velocity = ugpipe::vector(args.vel.as_deref()).unwrap_or_default();
//!     if velocity != [0.0; 3] {
//!         return Err(Failure::usage("cannot move; leave out `-vel`"));
//!     }
//!     let input = stage.input()?;
//!     stage.note(&format!("{}: {} bytes at rest", input.name, input.text.len()));
//!     stage.write(&input.text)
//! }
//! ```

#[cfg(feature = "cli")]
mod args;
#[cfg(feature = "cli")]
mod argv;
#[cfg(feature = "cli")]
mod failure;
#[cfg(feature = "cli")]
mod files;
#[cfg(feature = "cli")]
mod input;
#[cfg(feature = "cli")]
mod messages;
#[cfg(feature = "cli")]
mod output;
mod progress;
#[cfg(feature = "cli")]
mod provenance;
#[cfg(feature = "cli")]
mod run;
#[cfg(feature = "cli")]
mod stage;
#[cfg(feature = "cli")]
mod steps;
#[cfg(feature = "cli")]
mod text;

#[cfg(feature = "cli")]
pub use args::{CommonArgs, ONE_DASH, finite, vector, view_angle};
#[cfg(feature = "cli")]
pub use failure::Failure;
#[cfg(feature = "cli")]
pub use files::{Printed, read_file, run_program};
#[cfg(feature = "cli")]
pub use input::Input;
pub use progress::Progress;
#[cfg(feature = "cli")]
pub use run::{ToolArgs, main};
#[cfg(feature = "cli")]
pub use stage::Stage;
#[cfg(feature = "cli")]
pub use steps::Steps;
