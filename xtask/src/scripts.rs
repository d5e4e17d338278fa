//! Runs the scripts of the repository that need other tools: benchmarks, packages, the Python
//! package, and workflows on a Slurm.

use std::ffi::{OsStr, OsString};
use std::io;
use std::process::Command;

use ugtests::scenes;

use crate::programs;

/// Builds the programs and runs `xtask/bench.sh` with them, this program, and more `words`.
pub fn bench(words: &[OsString]) -> io::Result<()> {
    let [programs, xtask] = [programs::released(), std::env::current_exe()?];
    let own = [programs.as_os_str(), xtask.as_os_str()];
    run(
        "xtask/bench.sh",
        &own.into_iter().chain(words.iter().map(|word| word.as_os_str())).collect::<Vec<_>>(),
    )
}

/// Builds the programs and runs `batch/check.sh` with them.
pub fn cluster() -> io::Result<()> {
    run("batch/check.sh", &[programs::of_this_profile().as_ref()])
}

/// Builds the programs, with which files are compared, and runs `python/check.sh`.
pub fn python() -> io::Result<()> {
    run("python/check.sh", &[programs::released().as_os_str()])
}

/// Runs `packages/build.sh`, and `packages/check.sh` if `is_checked`.
pub fn package(is_checked: bool) -> io::Result<()> {
    let out = scenes::target_dir().join("packages");
    run("packages/build.sh", &[out.as_ref()])?;
    if is_checked { run("packages/check.sh", &[out.as_ref()]) } else { Ok(()) }
}

fn run(name: &str, arguments: &[&OsStr]) -> io::Result<()> {
    programs::run(Command::new(scenes::root().join(name)).args(arguments))
}
