//! The command line of `ugconformance`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use serde_json::Value;
use ugpipe::{CommonArgs, Context, Failure, ToolArgs, one_of};

use crate::compare::Comparison;
use crate::picture::{self, DrawnBy, MeasuredQuantity, PictureCase};
use crate::precision::Precision;
use crate::scorecard::{Scorecard, read_answers};
use crate::suite::{Topic, topics};

/// Tests relativistic renderers
///
/// Any program can answer the questions or draw the pictures; conformance/README.md defines them.
#[derive(Parser, Debug)]
#[command(name = "ugconformance", version, after_help = EXAMPLES,
          disable_help_subcommand = true, mut_args(ugpipe::globally))]
pub struct Args {
    #[command(subcommand)]
    command: Option<Command>,

    #[command(flatten)]
    rest: CommonArgs,
}

const EXAMPLES: &str = "Examples:
  ugconformance questions | my-program | ugconformance score
  ugconformance draw sphere > sphere.png
  ugconformance draw --rays sphere > sphere.png
  ugconformance score-image sphere sphere.png
  ugconformance compare mine.png truth.png";

#[derive(Subcommand, Debug)]
enum Command {
    /// Write the questions, one per line
    Questions(CommonArgs),
    /// Compare answers with the expected ones; status 1 if one is wrong
    Score(ScoreArgs),
    /// Measure a PNG of a scene; status 1 if a number is wrong
    ScoreImage(ScoreImageArgs),
    /// Compare two pictures; status 1 if too many pixels differ
    Compare(CompareArgs),
    /// Draw a scene with the programs of this project
    Draw(DrawArgs),
    /// Write a scene as OBJ, for renderers that do not read UniGrafix
    Mesh(ImageArgs),
    /// Write a table: objects (velocity, colour, wavelength) or cameras
    Table(TableArgs),
    /// Test the programs of this project; status 1 if one is wrong
    ///
    /// Draws all scenes, also by rays, and measures them.
    Check(CommonArgs),
}

#[derive(clap::Args, Debug)]
struct ScoreArgs {
    /// Precision of the program's numbers: double, single
    ///
    /// In single precision the tolerance of a question is what rounding to 24 bits costs there:
    /// see conformance/README.md.
    #[arg(long, value_name = "CLASS", default_value = "double")]
    precision: Precision,

    #[command(flatten)]
    report: ReportArgs,

    #[command(flatten)]
    common: CommonArgs,
}

#[derive(clap::Args, Debug)]
struct ReportArgs {
    /// Form of the result: text, json
    #[arg(long, value_name = "FORM", default_value = "text", value_parser = ["text", "json"])]
    format: String,
}

impl ReportArgs {
    /// Writes a result.
    fn write(&self, context: &mut Context, text: &str, json: &Value) -> Result<(), Failure> {
        if self.format == "json" {
            context.write_text(&format!("{json:#}\n"))
        } else {
            context.write_text(text)
        }
    }
}

#[derive(clap::Args, Debug)]
struct ScoreImageArgs {
    #[command(flatten)]
    report: ReportArgs,

    #[command(flatten)]
    image: ImageArgs,
}

#[derive(clap::Args, Debug)]
struct ImageArgs {
    /// Name of the picture
    #[arg(value_parser = one_of("pictures", picture::CASES.iter().map(|case| (case.name, case))))]
    case: &'static PictureCase,

    #[command(flatten)]
    common: CommonArgs,
}

#[derive(clap::Args, Debug)]
struct TableArgs {
    /// Contents of the table, of all pictures
    #[arg(value_parser = one_of("tables", TABLES))]
    table: Table,

    #[command(flatten)]
    common: CommonArgs,
}

/// Writes a table of all pictures.
type Table = fn() -> Result<String, String>;

const TABLES: [(&str, Table); 2] = [("objects", picture::objects), ("cameras", picture::cameras)];

/// Compares FILE with TRUTH: PNG, EXR, HDR or PFM, of one size.
#[derive(clap::Args, Debug)]
struct CompareArgs {
    /// Difference of a pixel that is allowed, in linear light, relative to the brightest of TRUTH
    ///
    /// That of the channel that differs most.
    #[arg(long, value_name = "T", default_value = "0.01", value_parser = part)]
    tolerance: f64,

    /// Share of the pixels that may differ by more than that, 0 to 1
    #[arg(long, value_name = "S", default_value = "0", value_parser = part)]
    share: f64,

    #[command(flatten)]
    common: CommonArgs,

    /// The picture to compare with
    #[arg(id = "files", value_name = "TRUTH")]
    truth: Option<PathBuf>,
}

/// Value parser of numbers from 0 to 1.
fn part(word: &str) -> Result<f64, String> {
    let part = ugpipe::finite(word)?;
    if (0.0..=1.0).contains(&part) { Ok(part) } else { Err("must be from 0 to 1".to_string()) }
}

#[derive(clap::Args, Debug)]
struct DrawArgs {
    /// Trace rays with ugphoton, instead of the pipe of three programs
    #[arg(long)]
    rays: bool,

    #[command(flatten)]
    image: ImageArgs,
}

impl ToolArgs for Args {
    const ESSENTIAL: &'static [&'static str] = &["-fo", "-qt"];

    fn common(&self) -> &CommonArgs {
        match &self.command {
            None => &self.rest,
            Some(Command::Questions(common) | Command::Check(common)) => common,
            Some(Command::Table(table)) => &table.common,
            Some(Command::Score(score)) => &score.common,
            Some(Command::Compare(compare)) => &compare.common,
            Some(
                Command::ScoreImage(ScoreImageArgs { image, .. })
                | Command::Mesh(image)
                | Command::Draw(DrawArgs { image, .. }),
            ) => &image.common,
        }
    }
}

/// Runs the program.
pub fn main() -> ExitCode {
    ugpipe::main_of_verdicts(run)
}

/// Runs the command; returns false if something is wrong.
fn run(args: &Args, context: &mut Context) -> Result<bool, Failure> {
    let Some(command) = &args.command else { return Err(no_command(args.rest.input())) };
    if args.rest.input().is_some() {
        return Err(Failure::usage(
            "the command must come before the file: `ugconformance score FILE`",
        ));
    }
    let topics = topics().map_err(Failure::failed)?;
    match command {
        Command::Questions(_) => context.write_text(&questions(&topics))?,
        Command::Score(ScoreArgs { precision, report, .. }) => {
            let input = context.input()?;
            let answers = read_answers(&String::from_utf8_lossy(&input.text), &topics)
                .map_err(|error| Failure::failed(format!("{}:{error}", input.name)))?;
            let card = Scorecard::new(&topics, &answers, *precision);
            report.write(context, &card.to_string(), &card.json())?;
            return Ok(card.counts()[1] == 0);
        }
        Command::ScoreImage(ScoreImageArgs { report, image }) => {
            let input = context.input()?;
            let mistakes = picture::recognized(image.case, &input.text);
            let measured = image.case.measure(&input.text).map_err(|problem| {
                let text = format!("{}: {problem}\n{}", input.name, picture::lines(&mistakes));
                Failure::failed(text.trim_end())
            })?;
            let text = measured_text(image.case, &measured) + &picture::lines(&mistakes);
            report.write(context, &text, &picture::json(image.case, &measured, &mistakes))?;
            return Ok(all_pass(&measured));
        }
        Command::Compare(compare) => {
            let comparison = compare.compared(context)?;
            context.write_text(&comparison.to_string())?;
            return Ok(comparison.share() <= compare.share);
        }
        Command::Draw(DrawArgs { rays, image }) => {
            if context.output_is_terminal() {
                return Err(Failure::usage(
                    "a picture is not written to a terminal; add `> FILE` or -fo FILE",
                ));
            }
            let drawn_by = if *rays { DrawnBy::Rays } else { DrawnBy::Pipe };
            context.write(&image.case.draw(drawn_by).map_err(Failure::failed)?)?;
        }
        Command::Mesh(image) => context.write(&image.case.mesh().map_err(Failure::failed)?)?,
        Command::Table(TableArgs { table, .. }) => {
            context.write_text(&table().map_err(Failure::failed)?)?;
        }
        Command::Check(_) => {
            let (text, is_right) = check();
            context.write_text(&text)?;
            return Ok(is_right);
        }
    }
    Ok(true)
}

impl CompareArgs {
    fn compared(&self, context: &mut Context) -> Result<Comparison, Failure> {
        let Some(truth) = &self.truth else {
            return Err(Failure::usage(
                "compare requires two pictures: `ugconformance compare MINE TRUTH`",
            ));
        };
        let (mine, truth) = (context.input()?, context.input_file(truth)?);
        Comparison::new((&mine.name, &mine.text), (&truth.name, &truth.text), self.tolerance)
            .map_err(Failure::failed)
    }
}

/// The error for a command line without a command. A word before it is the name of a file.
fn no_command(word: Option<&Path>) -> Failure {
    let commands =
        "commands are questions, score, score-image, compare, draw, mesh, table and check";
    Failure::Usage(match word {
        Some(word) => format!("`{}` is not a command; {commands}", word.display()),
        None => format!("a command is missing; {commands}"),
    })
}

/// Writes all questions as text.
pub fn questions(topics: &[Topic]) -> String {
    let cases = topics.iter().flat_map(|topic| &topic.cases);
    cases.map(|case| case.question() + "\n").collect()
}

/// Returns the measurements as lines of text, and whether all are within their tolerance.
///
/// # Errors
/// The picture cannot be measured.
pub fn score_image(case: &PictureCase, png: &[u8]) -> Result<(String, bool), String> {
    let measured = case.measure(png)?;
    Ok((measured_text(case, &measured), all_pass(&measured)))
}

fn measured_text(case: &PictureCase, measured: &[MeasuredQuantity]) -> String {
    let lines = measured.iter().map(|number| format!("{number}\n"));
    std::iter::once(format!("{}: {}\n", case.name, case.about)).chain(lines).collect()
}

fn all_pass(measured: &[MeasuredQuantity]) -> bool {
    measured.iter().all(MeasuredQuantity::passes)
}

/// Draws and measures all pictures. Returns the measurements, with a last line that lists
/// everything wrong, and whether all are right.
fn check() -> (String, bool) {
    let mut text = String::new();
    let mut wrong: Vec<String> = Vec::new();
    for (case, drawn_by) in
        picture::CASES.iter().flat_map(|case| case.renderers().iter().map(move |by| (case, *by)))
    {
        let (title, name) = match drawn_by {
            DrawnBy::Pipe => ("", case.name.to_string()),
            DrawnBy::Rays => ("By rays: ", format!("{}-by-rays", case.name)),
        };
        let (scored, is_right) = case
            .draw(drawn_by)
            .and_then(|png| score_image(case, &png))
            .unwrap_or_else(|problem| (format!("{}: {problem}\n", case.name), false));
        text += &format!("{title}{scored}\n");
        if !is_right {
            wrong.push(name);
        }
    }
    text += &format!(
        "wrong: {}\n",
        if wrong.is_empty() { "nothing".to_string() } else { wrong.join(" ") }
    );
    (text, wrong.is_empty())
}
