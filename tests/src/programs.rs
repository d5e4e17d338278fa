//! The programs, built as people build them.

use std::path::PathBuf;
use std::process::Command;

use crate::scenes;

/// The folder of the programs with all optimisation.
///
/// They are built if need be, all of them at once and in no other way than `scenes/figures.sh` does: cargo chooses the
/// features of dependencies by what is asked for together, and would compile everything anew for a part of them.
pub fn released() -> PathBuf {
    built("release")
}

/// The folder of the programs in the profile, `dev` or `release`, that this test is not built in.
pub fn of_other_profile() -> PathBuf {
    built(if cfg!(debug_assertions) { "release" } else { "dev" })
}

fn built(profile: &str) -> PathBuf {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["build", "--quiet", "--profile", profile]);
    cargo.arg("--target-dir").arg(scenes::target_dir()).current_dir(scenes::root());
    let status = cargo.status().expect("cargo runs");
    assert!(status.success(), "cargo build --profile {profile}: {status}");
    scenes::target_dir().join(if profile == "dev" { "debug" } else { profile })
}
