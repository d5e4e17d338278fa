//! The command line of `ugparse`.

mod count;
mod examples;
mod measure;

use std::process::ExitCode;

pub use examples::{EXAMPLE_FILES, example_subject};

use clap::{Parser, Subcommand, ValueEnum};
use serde_json::{Value, json};
use ugpipe::{CommonArgs, Context, Failure, ToolArgs};

use crate::pipe::{self, refused};
use crate::writer::write_to;
use crate::{Diagnostics, Options, Parsed, Severity, Source};

/// Checks, formats, flattens and measures UniGrafix scenes
///
/// The default command is check: ugparse FILE is ugparse check FILE.
#[derive(Parser, Debug)]
#[command(name = "ugparse", version, after_help = EXAMPLES,
          disable_help_subcommand = true, mut_args(ugpipe::globally))]
pub struct Args {
    #[command(subcommand)]
    command: Option<Command>,

    #[command(flatten)]
    rest: CommandArgs,
}

const EXAMPLES: &str = "Examples:
  ugparse ship.ug
  ugparse check --format json ship.ug
  ugparse tidy ship.ug > tidy.ug
  ugparse flatten ship.ug > flat.ug
  ugparse count ship.ug
  ugparse example ship > ship.ug";

#[derive(Subcommand, Debug)]
enum Command {
    /// Report errors and warnings; status 1 if the scene is invalid
    Check(CommandArgs),
    /// Format the text: one statement per line, nothing flattened or omitted
    Tidy(CommandArgs),
    /// Write the flat scene, as the other programs do
    Flatten(CommandArgs),
    /// Count statements, and measure faces
    Count(CommandArgs),
    /// Write an example scene, or list them
    Example(examples::ExampleArgs),
}

#[derive(clap::Args, Debug)]
struct CommandArgs {
    /// Output format of check and count
    #[arg(long, value_name = "FORMAT", value_enum, default_value_t = Format::Text)]
    format: Format,

    /// Write c_rgb colours as hues (flatten), which mix by hue, as in 1988
    ///
    /// Between corners of different colours, red, green and blue (c_rgb, and the colours of meshes)
    /// are mixed as light; hues (c) are mixed by hue, through the rainbow.
    #[arg(long)]
    hues: bool,

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
    const ESSENTIAL: &'static [&'static str] =
        &["--format", "-lax", "--limit", "-qt", "-vb", "-fo"];

    fn common(&self) -> &CommonArgs {
        &self.command_args().common
    }
}

impl Args {
    fn command_args(&self) -> &CommandArgs {
        match &self.command {
            Some(
                Command::Check(args)
                | Command::Tidy(args)
                | Command::Flatten(args)
                | Command::Count(args),
            ) => args,
            Some(Command::Example(_)) | None => &self.rest,
        }
    }
}

/// Runs the program.
pub fn main() -> ExitCode {
    ugpipe::main_of_verdicts(run)
}

/// Runs the command; returns false if the scene is invalid.
fn run(args: &Args, context: &mut Context) -> Result<bool, Failure> {
    let CommandArgs { format, hues, common } = args.command_args();
    let is_json = *format == Format::Json;
    if is_json && matches!(args.command, Some(Command::Tidy(_) | Command::Flatten(_))) {
        return Err(Failure::usage(
            "a scene is not written as JSON; -format is for check and count",
        ));
    }
    if *hues && !matches!(args.command, Some(Command::Flatten(_))) {
        return Err(Failure::usage(
            "--hues changes colours in a scene that is written: `ugparse flatten --hues`",
        ));
    }
    if args.command.is_some() && args.rest.common.input().is_some() {
        return Err(Failure::usage("the command must come before the file: `ugparse tidy FILE`"));
    }
    if let Some(Command::Example(args)) = &args.command {
        examples::write(args, context)?;
        return Ok(true);
    }
    let options = pipe::options(common)?;
    let source = pipe::input(context, &options)?;
    match args.command {
        None | Some(Command::Check(_) | Command::Example(_)) => {
            return check(source, &options, is_json, context);
        }
        Some(Command::Tidy(_)) => {
            let text = crate::tidy(&source, &options).map_err(refused)?;
            context.write(if text.is_empty() { EMPTY } else { &text })?;
        }
        Some(Command::Flatten(_)) => {
            let (_, mut parsed) = read(source, &options, context).map_err(refused)?;
            warn(&parsed.warnings, context);
            if *hues {
                ugscene::write_display_as_hues(&mut parsed.scene);
            }
            context.write_with(|out| match write_to(&parsed.scene, &parsed.passed_on, out)? {
                0 => out.write_all(EMPTY),
                _ => Ok(()),
            })?;
        }
        Some(Command::Count(_)) => {
            let (source, parsed) = read(source, &options, context).map_err(refused)?;
            warn(&parsed.warnings, context);
            let counts = count::Counts::new(&source, &parsed, &options);
            if is_json {
                context.write_json(&pretty(&counts.json()))?;
            } else {
                context.write_text(&counts.text())?;
            }
        }
    }
    Ok(true)
}

/// Written for an empty scene, because the next program in the pipe takes no input at all for a
/// failure of this one.
const EMPTY: &[u8] = b"\n";

fn read(
    source: Source,
    options: &Options,
    context: &Context,
) -> Result<(Source, Parsed), Diagnostics> {
    let source = pipe::follow(source, options, context)?;
    let parsed = crate::parse(&source, options)?;
    Ok((source, parsed))
}

fn warn(warnings: &Diagnostics, context: &Context) {
    if !warnings.is_empty() {
        context.report(&warnings.report());
    }
}

/// Reports all findings; returns false if the scene is invalid.
fn check(
    source: Source,
    options: &Options,
    is_json: bool,
    context: &mut Context,
) -> Result<bool, Failure> {
    let name = source.name.clone();
    let (is_usable, findings) = match read(source, options, context) {
        Ok((_, parsed)) => (true, parsed.warnings),
        Err(findings) => (false, findings),
    };
    if is_json {
        let report = json!({
            "usable": is_usable,
            "findings": findings_json(&findings),
            "omitted": findings.omitted,
        });
        context.write_json(&pretty(&report))?;
        return Ok(is_usable);
    }
    let verdict = if is_usable { "can be used" } else { "cannot be used" };
    context.note(&format!("{name} {verdict}: {}", summary(&findings)));
    if !is_usable {
        return Err(refused(findings));
    }
    warn(&findings, context);
    Ok(true)
}

/// `2 errors, 1 warning`
fn summary(findings: &Diagnostics) -> String {
    let of = |severity| findings.list.iter().filter(|finding| finding.severity == severity).count();
    let several =
        |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let (errors, warnings) = (of(Severity::Error), of(Severity::Warning));
    let more = if findings.omitted > 0 {
        format!(", and {} more", findings.omitted)
    } else {
        String::new()
    };
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
                Severity::Note => "note",
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
