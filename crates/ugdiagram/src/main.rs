//! Draws the spacetime diagram of a scene: see the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    ugpipe::main::<ugdiagram::Args>(ugdiagram::draw)
}
