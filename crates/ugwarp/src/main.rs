//! Shows a panorama as a fast traveller sees it: see the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    ugpipe::main::<ugwarp::Args>(ugwarp::draw)
}
