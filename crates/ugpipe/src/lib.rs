//! The Unix interface of the ug programs: arguments, streams, messages, exit status.
//!
//! Every ug program is a filter: it reads a scene, computes, and writes a scene or a picture.
//!
//! ```text
//! uglorentz -vel .6 0 0 -in < ship.ug | ugdoppler | ugrainbow > ship.png
//! ```
//!
//! The duties of a well-behaved filter, implemented once for all programs.
//! The programs use a [`Context`], and never arguments, streams or the exit status directly.
//!
//! - **Options.** The options of 1988 keep their syntax, with one dash and separate values,
//!   including negative numbers: `-vel -.9 0 0`. For clap they are ordinary long options
//!   ([`finite`], [`number`], [`whole`] and [`vector`] parse their numbers); the second dash is
//!   added before clap parses them. An option with a variable number of values (`num_args = 1..=2`)
//!   takes the required values and then only numbers, so a file name may follow it; only `num_args`
//!   has to be declared for that.
//! - **Help.** `-h` is one screenful with the options that [`ToolArgs::ESSENTIAL`] names and two
//!   examples; `--help` has everything. Both are made of the clap definitions, and so is the
//!   [`Manual`] for man pages and completions. The examples are the `after_help` of the program.
//! - **Streams.** Data goes to standard output, messages to standard error; [`CommonArgs`]
//!   redirects both to files. A program reads the whole input, computes, and then writes the whole
//!   output, so an error on the last line of a scene cannot pass half a scene downstream.
//! - **Files and programs** that an input names are read and run with size limits, without
//!   searching any path, and only in the folder of the input or below it
//!   ([`Context::read_named`], [`Context::run_named`]).
//! - **Output files** are replaced atomically: written to a temporary file in the same folder,
//!   which is renamed when the run succeeds. Links are followed, permissions kept, devices written
//!   to directly.
//! - **Messages** are lines such as `uglorentz: warning: …`, each written with one system call
//!   because the programs of a pipe share the terminal. They are coloured only on a terminal, and
//!   not if `NO_COLOR` is set. They may contain names and words from outside as they are: whatever
//!   a terminal would obey in them is replaced when they are printed, and in reports, too
//!   ([`Context::write_text`]).
//! - **Progress.** On a terminal, runs longer than a second show a progress bar; `-vb` prints the
//!   time of each step. Computations report to a [`Progress`] and do not depend on how it is shown.
//! - **Closed streams.** A program that needs standard input or output fails if it was started
//!   without (`>&-`), where other programs in Rust read and write `/dev/null`.
//! - **Exit status** 0 for success, 1 for an invalid scene, an I/O error or lack of memory, 2 for
//!   invalid usage. If
//!   the reading end of the output pipe is closed early, the program dies of SIGPIPE without a
//!   message, like filters written in C.
//! - **Reproducible output.** The bytes do not depend on `-nt` or on the names of output files:
//!   [`Context::command_line`], which is recorded in the output, contains only the options that
//!   affect the content, and [`Context::recorded_name`] the name of the input.
//!
//! Where there is no Unix system, as in a browser, command lines are parsed as everywhere, and
//! programs run [in memory](Context::in_memory).
//!
//! Limitations: output is not flushed to disk (`fsync`), so a power failure may undo a finished
//! run. A program that SIGKILL, a fault or lack of memory ends while it writes a file leaves the
//! temporary file, `.ug-` and six letters, in the same folder; the next one that writes a file
//! there deletes it. Other signals leave nothing.
//!
//! A library that only reports progress disables the feature `cli`. Then only [`Progress`],
//! [`printable`], [`shell_word`] and the messages of [`remedies`] are compiled, and clap is not built.
//!
//! # Example
//!
//! A computation reports its progress, and gives up when its caller stops it:
//!
//! ```
//! use std::sync::atomic::{AtomicU64, Ordering};
//!
//! use ugpipe::{Progress, Stopped};
//!
//! fn sum(numbers: &[u64], progress: &dyn Progress) -> Result<u64, Stopped> {
//!     progress.step("adding", numbers.len() as u64);
//!     numbers.iter().try_fold(0, |sum, number| {
//!         progress.check()?;
//!         progress.done(1);
//!         Ok(sum + number)
//!     })
//! }
//!
//! /// Stops after two parts.
//! struct Impatient(AtomicU64);
//!
//! impl Progress for Impatient {
//!     fn step(&self, _name: &'static str, _parts: u64) {}
//!
//!     fn done(&self, parts: u64) {
//!         self.0.fetch_add(parts, Ordering::Relaxed);
//!     }
//!
//!     fn is_stopped(&self) -> bool {
//!         self.0.load(Ordering::Relaxed) >= 2
//!     }
//! }
//!
//! assert_eq!(sum(&[1, 2, 3], &()), Ok(6));
//! assert_eq!(sum(&[1, 2, 3], &Impatient(AtomicU64::new(0))), Err(Stopped));
//! ```
//!
//! [`main`] has a whole program.

// Without a system, nothing is printed.
#![cfg_attr(not(unix), allow(dead_code))]

#[cfg(feature = "cli")]
mod cli;
mod other_case;
mod progress;
pub mod remedies;
mod shell;
mod side;
mod text;

#[cfg(feature = "cli")]
pub use cli::*;
pub use other_case::OtherCase;
pub use progress::{Progress, Stopped};
pub use shell::{shell_os_word, shell_pipe, shell_word};
pub use side::{PIXELS_PER_INCH, Side};
pub use text::{is_printable, message, printable};
