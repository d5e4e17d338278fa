//! A small program that uses `ugpipe`: copies its input to its output, and prints messages or fails
//! on request.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{ArgAction, Parser, ValueEnum};
use ugpipe::{CommonArgs, Context, Failure, Progress, ToolArgs};

/// Copies its input to its output
#[derive(Parser)]
#[command(name = "ugcat", version, after_help = "Examples:\n  ugcat -head ship.ug > copy.ug")]
struct Args {
    /// Velocity, recorded in the head comment only
    #[arg(long, visible_alias = "velocity", value_names = ["X", "Y", "Z"], num_args = 3,
          action = ArgAction::Set, allow_hyphen_values = true, value_parser = ugpipe::finite)]
    vel: Option<Vec<f64>>,

    /// View angle, recorded in the head comment only
    #[arg(long, value_names = ["A", "B"], num_args = 1..=2, value_parser = ugpipe::finite)]
    va: Option<Vec<f64>>,

    /// Title, recorded in the head comment only
    #[arg(long, allow_hyphen_values = true)]
    title: Option<String>,

    /// Write the command line first
    #[arg(long)]
    head: bool,

    /// Print a message of every kind
    #[arg(long)]
    say: bool,

    /// Work in two steps, the second of which takes WORK seconds
    #[arg(long, value_parser = ugpipe::finite)]
    work: Option<f64>,

    /// Write a second file
    #[arg(long)]
    at: Option<PathBuf>,

    /// Run a program and print its first line of error output as a note
    #[arg(long)]
    execute: Option<PathBuf>,

    /// Wait after writing the output, in seconds
    #[arg(long, value_parser = ugpipe::finite)]
    linger: Option<f64>,

    /// Fail in this way after writing the output
    #[arg(long)]
    fail: Option<Way>,

    #[command(flatten)]
    common: CommonArgs,
}

#[derive(Clone, Copy, ValueEnum)]
enum Way {
    Usage,
    Work,
    Report,
}

impl ToolArgs for Args {
    const ESSENTIAL: &'static [&'static str] = &["-vel", "-va", "--title", "-head", "-fo"];

    fn common(&self) -> &CommonArgs {
        &self.common
    }
}

fn main() -> ExitCode {
    ugpipe::main(run)
}

fn run(args: &Args, context: &mut Context) -> Result<(), Failure> {
    if args.say {
        say(context);
    }
    if let Some(seconds) = args.work {
        work(&context.steps(), seconds);
    }
    let input = context.input()?;
    let mut output = Vec::new();
    if args.head {
        output.extend(format!("{{ {} }}\n", context.command_line()).into_bytes());
    }
    output.extend(input.text);
    if let Some(path) = &args.at {
        context.write_file(path, b"a table\n")?;
    }
    context.write(&output)?;
    if let Some(program) = &args.execute {
        let printed = context.run_named(program, 1000).map_err(Failure::failed)?;
        context.note(&printed.error_line);
    }
    if let Some(seconds) = args.linger {
        std::thread::sleep(std::time::Duration::from_secs_f64(seconds));
    }
    match args.fail {
        None => Ok(()),
        Some(Way::Usage) => Err(Failure::usage("`-vel` is too fast; stay below 1")),
        Some(Way::Work) => Ok("ten".parse::<i32>().map(drop)?),
        Some(Way::Report) => {
            Err(Failure::Report("\x1b[1merror\x1b[0m: no face\n --> x.ug:1:2".to_owned()))
        }
    }
}

fn work(progress: &dyn Progress, seconds: f64) {
    progress.step("thinking", 0);
    progress.step("working", 4);
    for _ in 0..4 {
        std::thread::sleep(std::time::Duration::from_secs_f64(seconds / 4.0));
        progress.done(1);
    }
}

fn say(context: &Context) {
    context.note("all is well");
    context.warn("nearly all");
    context.report("\x1b[1mwarning\x1b[0m: this face\n --> x.ug:1:2\n");
    context.detail("24 faces");
    let (is_terminal, name) = (context.output_is_terminal(), context.output_name());
    let n_threads = rayon::current_num_threads();
    context.note(&format!("terminal {is_terminal}, name {name:?}, threads {n_threads}"));
}
