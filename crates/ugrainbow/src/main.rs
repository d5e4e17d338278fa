//! Draws a UniGrafix scene: see the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    ugpipe::main::<ugrainbow::Args>(ugrainbow::draw)
}
