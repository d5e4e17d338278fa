//! Draws the frames of a film: see the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    ugpipe::main::<ugfilm::Args>(ugfilm::run)
}
