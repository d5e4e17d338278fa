//! Runs the scripts of the repository that need other tools: packages, and workflows on a Slurm.

use std::io;
use std::path::Path;
use std::process::Command;

use ugtests::scenes;

use crate::programs;

/// Builds the programs and runs `batch/check.sh` with them.
pub fn cluster() -> io::Result<()> {
    run("batch/check.sh", &programs::of_this_profile())
}

/// Runs `packages/build.sh`, and `packages/check.sh` if `is_checked`.
pub fn package(is_checked: bool) -> io::Result<()> {
    let out = scenes::target_dir().join("packages");
    run("packages/build.sh", &out)?;
    if is_checked { run("packages/check.sh", &out) } else { Ok(()) }
}

fn run(name: &str, argument: &Path) -> io::Result<()> {
    let status = Command::new(scenes::root().join(name)).arg(argument).status()?;
    if status.success() { Ok(()) } else { Err(io::Error::other(format!("{name}: {status}"))) }
}
