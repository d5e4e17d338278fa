//! Traces rays through a UniGrafix scene: see the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    ugpipe::main::<ugphoton::Args>(ugphoton::draw)
}
