//! The command line of `ugconformance`.

use std::cell::Cell;
use std::fmt::Write;
use std::process::ExitCode;

use clap::{Arg, Parser, Subcommand};
use ugpipe::{CommonArgs, Failure, Stage, ToolArgs};

use crate::answer::answer;
use crate::picture::{self, PictureCase};
use crate::scorecard::{Answers, Scorecard, read_answers};
use crate::suite::{Topic, topics};

/// Judges relativistic renderers
///
/// Any program can answer the questions or draw the pictures; conformance/README.md says what they mean.
#[derive(Parser, Debug)]
#[command(name = "ugconformance", version, before_help = ugpipe::ONE_DASH, after_help = EXAMPLES,
          disable_help_subcommand = true, subcommand_required = true, mut_args(before_the_job))]
struct Args {
    #[command(subcommand)]
    job: Job,

    #[command(flatten)]
    rest: CommonArgs,
}

const EXAMPLES: &str = "Examples:
  ugconformance questions | my-program | ugconformance score
  ugconformance questions | ugconformance answer | ugconformance score
  ugconformance draw sphere > sphere.png
  ugconformance score-image sphere sphere.png";

/// Options may stand before the job as well as behind it, but for the one that names the file.
fn before_the_job(arg: Arg) -> Arg {
    if arg.is_positional() || arg.get_id() == "fi" { arg } else { arg.global(true) }
}

#[derive(Subcommand, Debug)]
enum Job {
    /// Write the questions, one a line
    Questions(CommonArgs),
    /// Answer questions with the crates of this project
    Answer(CommonArgs),
    /// Compare answers with what is right; status 1 if one is wrong
    Score(CommonArgs),
    /// Measure a PNG of a scene; status 1 if a number is wrong
    ScoreImage(ImageArgs),
    /// Draw a scene with the programs of this project
    Draw(ImageArgs),
    /// Answer, draw and compare everything; status 1 if something is wrong
    Check(CommonArgs),
}

#[derive(clap::Args, Debug)]
struct ImageArgs {
    /// Which picture
    #[arg(value_parser = picture_case)]
    case: &'static str,

    #[command(flatten)]
    common: CommonArgs,
}

fn picture_case(name: &str) -> Result<&'static str, String> {
    picture::case(name).map(|case| case.name).ok_or_else(|| {
        let names = picture::CASES.iter().map(|case| case.name);
        format!("there is no such picture; there are {}", names.collect::<Vec<_>>().join(", "))
    })
}

impl ToolArgs for Args {
    fn common(&self) -> &CommonArgs {
        match &self.job {
            Job::Questions(common) | Job::Answer(common) | Job::Score(common) | Job::Check(common) => common,
            Job::ScoreImage(image) | Job::Draw(image) => &image.common,
        }
    }
}

/// The whole program.
pub fn main() -> ExitCode {
    // A score that says what is wrong has done its work, so it is kept; only the status tells.
    let is_right = Cell::new(true);
    let status = ugpipe::main(|args: &Args, stage: &mut Stage| {
        is_right.set(run(args, stage)?);
        Ok(())
    });
    if is_right.get() { status } else { ExitCode::FAILURE }
}

/// Does the job; false if something was found wrong.
fn run(args: &Args, stage: &mut Stage) -> Result<bool, Failure> {
    if args.rest.input().is_some() {
        return Err(Failure::usage("the job stands before the file: `ugconformance score FILE`"));
    }
    let topics = topics().map_err(Failure::failed)?;
    match &args.job {
        Job::Questions(_) => stage.write(questions(&topics).as_bytes())?,
        Job::Answer(_) => {
            let input = stage.input()?;
            stage.write(answers(&String::from_utf8_lossy(&input.text)).as_bytes())?;
        }
        Job::Score(_) => {
            let input = stage.input()?;
            let answers = read_answers(&String::from_utf8_lossy(&input.text), &topics)
                .map_err(|error| Failure::failed(format!("{}:{error}", input.name)))?;
            let card = Scorecard::new(&topics, &answers);
            stage.write(card.to_string().as_bytes())?;
            return Ok(card.counts()[1] == 0);
        }
        Job::ScoreImage(image) => {
            let case = known(image.case)?;
            let input = stage.input()?;
            let (text, is_right) = score_image(case, &input.text)
                .map_err(|problem| Failure::failed(format!("{}: {problem}", input.name)))?;
            stage.write(text.as_bytes())?;
            return Ok(is_right);
        }
        Job::Draw(image) => {
            if stage.output_is_terminal() {
                return Err(Failure::usage(
                    "a picture is not written to a terminal; add `> FILE` or -fo FILE",
                ));
            }
            stage.write(&known(image.case)?.draw().map_err(Failure::failed)?)?;
        }
        Job::Check(_) => {
            let (text, is_right) = check(&topics);
            stage.write(text.as_bytes())?;
            return Ok(is_right);
        }
    }
    Ok(true)
}

fn known(name: &str) -> Result<&'static PictureCase, Failure> {
    picture::case(name).ok_or_else(|| Failure::usage("there is no such picture"))
}

/// All questions as text.
pub fn questions(topics: &[Topic]) -> String {
    let cases = topics.iter().flat_map(|topic| &topic.cases);
    cases.map(|case| case.question() + "\n").collect()
}

/// Answers to questions as text; a question that is not understood gets `-`.
pub fn answers(questions: &str) -> String {
    let mut text = String::new();
    for line in questions.lines() {
        let mut words = line.split_ascii_whitespace();
        let Some(id) = words.next().filter(|word| !word.starts_with('#')) else { continue };
        let kind = words.next().unwrap_or_default();
        let given: Option<Vec<f64>> = words.map(|word| word.parse().ok()).collect();
        // Writing to a string does not fail.
        let _ = write!(text, "{id}");
        match given.and_then(|given| answer(kind, &given)) {
            Some(values) => values.iter().for_each(|value| {
                let _ = write!(text, " {value:?}");
            }),
            None => text.push_str(" -"),
        }
        text.push('\n');
    }
    text
}

/// What was measured, one line each, and whether all of it is right.
///
/// # Errors
/// The picture cannot be measured.
pub fn score_image(case: &PictureCase, png: &[u8]) -> Result<(String, bool), String> {
    let measured = case.measure(png)?;
    let mut text = format!("{}: {}\n", case.name, case.about);
    measured.iter().for_each(|number| text += &format!("{number}\n"));
    Ok((text, measured.iter().all(picture::Measured::passes)))
}

/// The scorecard of this project, and its pictures; then a line with all that is wrong.
fn check(topics: &[Topic]) -> (String, bool) {
    // A mistake in a program may make its answers impossible to read, too.
    let answers = read_answers(&answers(&questions(topics)), topics).unwrap_or_else(|_| Answers::new());
    let card = Scorecard::new(topics, &answers);
    let mut text = card.to_string();
    let mut wrong: Vec<String> = card.failed().map(str::to_string).collect();
    for case in &picture::CASES {
        let (scored, is_right) = case
            .draw()
            .and_then(|png| score_image(case, &png))
            .unwrap_or_else(|problem| (format!("{}: {problem}\n", case.name), false));
        text += &format!("\n{scored}");
        if !is_right {
            wrong.push(case.name.to_string());
        }
    }
    if card.counts()[0] == 0 {
        wrong.push("everything".to_string());
    }
    text += &format!("\nwrong: {}\n", if wrong.is_empty() { "nothing".to_string() } else { wrong.join(" ") });
    (text, wrong.is_empty())
}
