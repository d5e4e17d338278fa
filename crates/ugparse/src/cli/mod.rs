//! The command line of `ugparse`.

mod count;
mod measure;

use std::cell::Cell;
use std::process::ExitCode;

use clap::{Arg, Parser, Subcommand, ValueEnum};
use serde_json::{Value, json};
use ugpipe::{CommonArgs, Failure, Stage, ToolArgs};

use crate::pipe::{self, refused};
use crate::{Diagnostics, Options, Parsed, Severity, Source};

/// Checks, tidies, flattens and measures UniGrafix scenes
///
/// Without a job it checks: ugparse FILE is ugparse check FILE.
#[derive(Parser, Debug)]
#[command(name = "ugparse", version, before_help = ugpipe::ONE_DASH, after_help = EXAMPLES,
          disable_help_subcommand = true, mut_args(before_the_job))]
struct Args {
    #[command(subcommand)]
    job: Option<Job>,

    #[command(flatten)]
    rest: JobArgs,
}

const EXAMPLES: &str = "Examples:
  ugparse ship.ug
  ugparse check -format json ship.ug | jq '.findings[].message'
  ugparse tidy ship.ug > tidy.ug
  ugparse flatten ship.ug | head
  ugparse count ship.ug";

/// Options may stand before the job as well as behind it, but for the one that names the file.
fn before_the_job(arg: Arg) -> Arg {
    if arg.is_positional() || arg.get_id() == "fi" { arg } else { arg.global(true) }
}

#[derive(Subcommand, Debug)]
enum Job {
    /// Say what is wrong with the scene; status 1 if it cannot be used
    Check(JobArgs),
    /// Lay the text out anew: one statement a line, nothing flattened or left out
    Tidy(JobArgs),
    /// Write the flat scene, as the other programs do
    Flatten(JobArgs),
    /// Count statements, and measure the faces
    Count(JobArgs),
}

#[derive(clap::Args, Debug)]
struct JobArgs {
    /// What check and count print
    #[arg(long, value_name = "FORMAT", value_enum, default_value_t = Format::Text)]
    format: Format,

    #[command(flatten)]
    common: CommonArgs,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For people
    Text,
    /// For programs
    Json,
}

impl ToolArgs for Args {
    fn common(&self) -> &CommonArgs {
        &self.job().common
    }
}

impl Args {
    fn job(&self) -> &JobArgs {
        match &self.job {
            Some(Job::Check(args) | Job::Tidy(args) | Job::Flatten(args) | Job::Count(args)) => args,
            None => &self.rest,
        }
    }
}

/// The whole program.
pub fn main() -> ExitCode {
    // A check of a bad scene that ends with its report written has done its
    // work, so its output is kept; only the status says what was found.
    let is_usable = Cell::new(true);
    let status = ugpipe::main(|args: &Args, stage: &mut Stage| {
        is_usable.set(run(args, stage)?);
        Ok(())
    });
    if is_usable.get() { status } else { ExitCode::FAILURE }
}

/// Does the job; false if the scene was found to be unusable.
fn run(args: &Args, stage: &mut Stage) -> Result<bool, Failure> {
    let JobArgs { format, common } = args.job();
    let is_json = *format == Format::Json;
    if is_json && matches!(args.job, Some(Job::Tidy(_) | Job::Flatten(_))) {
        return Err(Failure::usage("a scene is not written as JSON; -format is for check and count"));
    }
    if args.job.is_some() && args.rest.common.input().is_some() {
        return Err(Failure::usage("the job stands before the file: `ugparse tidy FILE`"));
    }
    let options = pipe::options(common)?;
    let input = stage.input()?;
    let source = Source::new(input.name, input.text);
    match args.job {
        None | Some(Job::Check(_)) => return check(source, &options, is_json, stage),
        Some(Job::Tidy(_)) => stage.write(&crate::tidy(&source, &options).map_err(refused)?)?,
        Some(Job::Flatten(_)) => {
            let (_, parsed) = read(source, &options, stage).map_err(refused)?;
            warn(&parsed.warnings, stage);
            stage.write_with(|out| crate::write_to(&parsed.scene, out))?;
        }
        Some(Job::Count(_)) => {
            let (source, parsed) = read(source, &options, stage).map_err(refused)?;
            warn(&parsed.warnings, stage);
            let counts = count::Counts::new(&source, &parsed, &options);
            let text = if is_json { pretty(&counts.json()) } else { counts.text() };
            stage.write(text.as_bytes())?;
        }
    }
    Ok(true)
}

fn read(source: Source, options: &Options, stage: &Stage) -> Result<(Source, Parsed), Diagnostics> {
    let source = pipe::follow(source, options, stage)?;
    let parsed = crate::parse(&source, options)?;
    Ok((source, parsed))
}

fn warn(warnings: &Diagnostics, stage: &Stage) {
    if !warnings.is_empty() {
        stage.report(&warnings.render(true));
    }
}

/// Reports all findings; false if the scene cannot be used.
fn check(source: Source, options: &Options, is_json: bool, stage: &mut Stage) -> Result<bool, Failure> {
    let name = source.name.clone();
    let (is_usable, findings) = match read(source, options, stage) {
        Ok((_, parsed)) => (true, parsed.warnings),
        Err(findings) => (false, findings),
    };
    if is_json {
        let report = json!({
            "usable": is_usable,
            "findings": findings_json(&findings),
            "omitted": findings.omitted,
        });
        stage.write(pretty(&report).as_bytes())?;
        return Ok(is_usable);
    }
    let verdict = if is_usable { "can be used" } else { "cannot be used" };
    stage.note(&format!("{name} {verdict}: {}", summary(&findings)));
    if !is_usable {
        return Err(refused(findings));
    }
    warn(&findings, stage);
    Ok(true)
}

/// `2 errors, 1 warning`
fn summary(findings: &Diagnostics) -> String {
    let of = |severity| findings.list.iter().filter(|finding| finding.severity == severity).count();
    let several = |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let (errors, warnings) = (of(Severity::Error), of(Severity::Warning));
    let more = if findings.omitted > 0 { format!(", and {} more", findings.omitted) } else { String::new() };
    format!("{}, {}{more}", several(errors, "error"), several(warnings, "warning"))
}

fn findings_json(findings: &Diagnostics) -> Value {
    let places = findings.locations().into_iter().zip(findings.other_locations());
    let rows = findings.list.iter().zip(places).map(|(finding, (place, other))| {
        let other = other.map(|(place, label)| {
            json!({ "file": place.file, "line": place.line, "column": place.column, "label": label })
        });
        json!({
            "severity": match finding.severity {
                Severity::Error => "error",
                Severity::Warning => "warning",
            },
            "message": finding.message,
            "file": place.file,
            "line": place.line,
            "column": place.column,
            "label": finding.label,
            "other": other,
            "help": finding.help,
        })
    });
    rows.collect()
}

fn pretty(value: &Value) -> String {
    format!("{value:#}\n")
}
