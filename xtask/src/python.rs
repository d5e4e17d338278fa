//! Builds and tests the Python package.

use std::io;
use std::process::Command;

use ugtests::scenes;

use crate::programs;

/// Builds the programs, with which files are compared, and runs `python/check.sh`.
pub fn check(manylinux: bool) -> io::Result<()> {
    let mut script = Command::new(scenes::root().join("python/check.sh"));
    script.arg(programs::released()).args(manylinux.then_some("--manylinux"));
    let status = script.status()?;
    if status.success() { Ok(()) } else { Err(io::Error::other(format!("python/check.sh: {status}"))) }
}
