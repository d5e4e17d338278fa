//! All programs in one: the name it is called by selects which it is.

use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let called = std::env::args_os().next().unwrap_or_default();
    match Path::new(&called).file_name().and_then(|name| name.to_str()) {
        Some("ugdiagram") => ugpipe::main::<ugdiagram::Args>(ugdiagram::draw),
        Some("ugdoppler") => ugdoppler::main(),
        Some("ugfilm") => ugpipe::main::<ugfilm::Args>(ugfilm::run),
        Some("uglorentz") => uglorentz::main(),
        Some("ugmesh") => ugmesh::main(),
        Some("ugparse") => ugparse::main(),
        Some("ugphoton") => ugpipe::main::<ugphoton::Args>(ugphoton::draw),
        Some("ugrainbow") => ugpipe::main::<ugrainbow::Args>(ugrainbow::draw),
        Some("ugsheet") => ugsheet::main(),
        Some("ugwarp") => ugpipe::main::<ugwarp::Args>(ugwarp::draw),
        _ => ExitCode::FAILURE,
    }
}
