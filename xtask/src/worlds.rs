//! Laws of light in random worlds, many more than the tests check.

use std::io::{self, Write};
use std::time::Instant;

use rayon::prelude::*;
use ugtests::worlds::{LAWS, Law};

/// The check to make.
#[derive(clap::Args)]
pub struct Args {
    /// Number of the first world; those of the tests begin at 0
    #[arg(long, value_name = "SEED", default_value_t = 1_000_000)]
    from: u64,
    /// Worlds for each law
    #[arg(long, value_name = "N", default_value_t = 10_000)]
    count: u64,
    /// Only this law; repeat it for several [default: all]
    #[arg(long, value_name = "NAME", value_parser = names())]
    law: Vec<String>,
    /// Print only how many worlds of each law fail
    #[arg(long)]
    quiet: bool,
}

fn names() -> clap::builder::PossibleValuesParser {
    LAWS.iter().map(|law| law.name).collect::<Vec<_>>().into()
}

/// Checks the laws and writes what does not hold; progress goes to standard error. Fails if
/// anything was found.
pub fn write(out: &mut impl Write, args: &Args) -> io::Result<()> {
    let is_wanted =
        |law: &&Law| args.law.is_empty() || args.law.iter().any(|name| name == law.name);
    let laws: Vec<&Law> = LAWS.iter().filter(is_wanted).collect();
    let begun = Instant::now();
    let mut n_findings = vec![0; laws.len()];
    let mut seconds = vec![0.0; laws.len()];
    // In blocks, so that findings appear while the rest runs.
    for start in (0..args.count).step_by(100) {
        let seeds = args.from + start..args.from + (start + 100).min(args.count);
        for ((law, n_findings), seconds) in laws.iter().zip(&mut n_findings).zip(&mut seconds) {
            let before = Instant::now();
            let findings: Vec<String> =
                seeds.clone().into_par_iter().filter_map(|seed| law.check(seed).err()).collect();
            *n_findings += findings.len();
            *seconds += before.elapsed().as_secs_f64();
            for finding in findings.iter().filter(|_| !args.quiet) {
                writeln!(out, "{finding}\n")?;
            }
        }
        out.flush()?;
        let (n_worlds, n_all) = (start + 100, n_findings.iter().sum::<usize>());
        let elapsed = begun.elapsed().as_secs();
        writeln!(
            io::stderr(),
            "{} of {} worlds, {n_all} findings, {elapsed} s",
            n_worlds.min(args.count),
            args.count
        )?;
    }
    for ((law, n_findings), seconds) in laws.iter().zip(&n_findings).zip(&seconds) {
        writeln!(
            out,
            "{:26} {n_findings:6} of {} worlds fail, {seconds:.0} s",
            law.name, args.count
        )?;
    }
    if n_findings.iter().sum::<usize>() > 0 {
        Err(io::Error::other("a law does not hold"))
    } else {
        Ok(())
    }
}
