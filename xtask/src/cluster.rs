//! Runs the workflows of `batch/` on a Slurm of this machine.

use std::io;
use std::process::Command;

use ugtests::scenes;

use crate::programs;

/// Builds the programs and runs `batch/check.sh` with them.
pub fn check() -> io::Result<()> {
    let programs = programs::of_this_profile();
    let status = Command::new(scenes::root().join("batch/check.sh")).arg(programs).status()?;
    if status.success() { Ok(()) } else { Err(io::Error::other(format!("batch/check.sh: {status}"))) }
}
