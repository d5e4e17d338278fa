//! Hostile inputs, many more than the tests run.

use std::io::{self, Write};
use std::path::PathBuf;
use std::time::{Duration, Instant};

use rayon::prelude::*;
use ugtests::hostile::{Case, Kind};

use crate::programs;

/// Cases that take longer are named.
const SLOW: Duration = Duration::from_secs(10);

/// The job to run.
#[derive(clap::Args)]
pub struct Args {
    /// Cases to run
    #[arg(value_name = "N", default_value_t = 50_000)]
    cases: u64,
    /// Number of the first case; those of the tests begin at 0
    #[arg(long, value_name = "SEED", default_value_t = 1_000_000)]
    first: u64,
    /// Only possible inputs and options, so that most pipes run to their end
    #[arg(long)]
    mild: bool,
    /// Write the files of the first case into this folder, and run nothing
    #[arg(long, value_name = "FOLDER")]
    extract: Option<PathBuf>,
    /// Folder of the programs [default: those of the release profile, built if need be]
    #[arg(long, value_name = "FOLDER")]
    programs: Option<PathBuf>,
}

/// Runs the cases and writes what was found; progress goes to standard error. Fails if anything was
/// found.
pub fn write(out: &mut impl Write, args: &Args) -> io::Result<()> {
    let kind = if args.mild { Kind::Mild } else { Kind::Wild };
    let case_of = |seed| Case::new(seed, kind);
    if let Some(folder) = &args.extract {
        let case = case_of(args.first);
        case.write_to(folder)?;
        return writeln!(out, "{case:#?}");
    }
    let programs = args.programs.clone().unwrap_or_else(programs::released);
    let begun = Instant::now();
    let (mut n_findings, mut n_drawn) = (0, 0);
    // In blocks, so that findings appear while the rest runs.
    for start in (0..args.cases).step_by(1000) {
        let seeds = args.first + start..args.first + (start + 1000).min(args.cases);
        let timed = |seed: u64| {
            let begun = Instant::now();
            (case_of(seed).run(&programs), seed, begun.elapsed())
        };
        let timed: Vec<_> = seeds.clone().into_par_iter().map(timed).collect();
        for (_, seed, taken) in timed.iter().filter(|(.., taken)| *taken > SLOW) {
            writeln!(io::stderr(), "case {seed} takes {} s", taken.as_secs())?;
        }
        let results: Vec<_> = timed.into_iter().map(|(result, ..)| result).collect();
        n_drawn += results.iter().filter(|result| **result == Ok(true)).count();
        for finding in results.into_iter().filter_map(Result::err) {
            n_findings += 1;
            writeln!(out, "{finding}\n")?;
        }
        out.flush()?;
        let (n_run, seconds) = (seeds.end - args.first, begun.elapsed().as_secs());
        writeln!(
            io::stderr(),
            "{n_run} of {} cases, {n_findings} findings, {seconds} s",
            args.cases
        )?;
    }
    let seconds = begun.elapsed().as_secs_f64();
    writeln!(
        out,
        "{} cases, {n_drawn} pipes succeed, {n_findings} findings, {seconds:.0} s",
        args.cases
    )?;
    if n_findings > 0 { Err(io::Error::other("something does not hold")) } else { Ok(()) }
}
