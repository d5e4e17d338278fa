//! Runs cargo-mutants on the crates of formulas: changes that no test of their crate notices.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use ugtests::scenes::{root, target_dir};

use crate::{Outcome, programs};

/// The crates whose formulas everything else relies on.
const CRATES: [&str; 3] = ["ugphysics", "uglight", "ugsky"];

/// What is changed. All of it takes hours: a change costs one build of the tests of its crate.
#[derive(clap::Args)]
pub struct Args {
    /// Crates [default: ugphysics uglight ugsky]
    #[arg(value_name = "CRATE")]
    crates: Vec<String>,
    /// Only files of this name or path, `*` for any letters; may be repeated
    #[arg(long, value_name = "FILE")]
    file: Vec<String>,
    /// Only functions and changes that match this regular expression; may be repeated
    #[arg(long, value_name = "REGEX")]
    re: Vec<String>,
    /// One part of N, from 0/N to (N - 1)/N
    #[arg(long, value_name = "K/N")]
    shard: Option<String>,
    /// Print the changes instead of making them
    #[arg(long)]
    list: bool,
}

/// Makes the changes, one by one, and prints those that no test notices. They are in
/// `target/mutants/mutants.out`, too, with the logs.
pub fn run(args: &Args) -> Outcome<()> {
    let folder = target_dir().join("mutants");
    fs::create_dir_all(&folder)?;
    let mut mutants = Command::new(program()?);
    mutants.arg("mutants").current_dir(root()).arg("--output").arg(&folder);
    // One job, since the tests of a crate use all processors.
    mutants.args(["--no-shuffle", "--jobs", "1", "--colors", "never", "--minimum-test-timeout"]);
    mutants.arg("60");
    let all = CRATES.map(str::to_owned);
    let crates = if args.crates.is_empty() { &all[..] } else { &args.crates };
    let options = [("--package", crates), ("--file", &args.file), ("--re", &args.re)];
    for (name, value) in options.iter().flat_map(|(name, all)| all.iter().map(move |v| (name, v))) {
        mutants.args([*name, value]);
    }
    mutants.args(args.shard.iter().flat_map(|shard| ["--shard", shard]));
    mutants.args(args.list.then_some("--list"));
    let status = mutants.status()?;
    // Some changes are not noticed, or take forever: that is the result.
    match status.code() {
        Some(0 | 2 | 3) => Ok(()),
        _ => Err(format!("cargo-mutants: {status}").into()),
    }
}

/// cargo-mutants, installed below the target folder if the shell has none.
fn program() -> Outcome<PathBuf> {
    const NAME: &str = "cargo-mutants";
    let folders = std::env::var_os("PATH").unwrap_or_default();
    let tools = target_dir().join("tools");
    let places = std::env::split_paths(&folders).chain([tools.join("bin")]);
    let found = places.map(|folder| folder.join(NAME)).find(|path| path.is_file());
    if let Some(found) = found {
        return Ok(found);
    }
    let mut install = Command::new(env!("CARGO"));
    install.args(["install", "--quiet", "--locked", NAME, "--root"]).arg(&tools);
    programs::run(&mut install)?;
    Ok(tools.join("bin").join(NAME))
}
