//! The programs, built as people build them.

use std::io;
use std::path::PathBuf;
use std::process::Command;

use ugtests::scenes;

/// The folder of the programs in the profile of this one. They are built if need be.
pub fn of_this_profile() -> PathBuf {
    built(if cfg!(debug_assertions) { "dev" } else { "release" })
}

/// The folder of the optimised programs: minutes if they are not built yet.
pub fn released() -> PathBuf {
    built("release")
}

fn built(profile: &str) -> PathBuf {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["build", "--quiet", "--profile", profile]);
    cargo.arg("--target-dir").arg(scenes::target_dir()).current_dir(scenes::root());
    let status = cargo.status().expect("cargo runs");
    assert!(status.success(), "cargo build --profile {profile}: {status}");
    scenes::target_dir().join(if profile == "dev" { "debug" } else { profile })
}

/// Runs a command to its end, and fails if it does.
pub fn run(command: &mut Command) -> io::Result<()> {
    let status = command.status()?;
    if status.success() { Ok(()) } else { Err(io::Error::other(format!("{command:?}: {status}"))) }
}
