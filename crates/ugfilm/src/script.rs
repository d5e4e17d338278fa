//! The command lines of every frame.

use std::fmt::Write;

use ugimage::Format;
use ugpipe::{Failure, shell_word};

use crate::options::{Given, options_of};
use crate::program::{Method, Program};
use crate::timeline::{Ease, Quantity, Timeline};

/// Options that more than one program of a pipe must know; all others are given to the first that
/// has them, which passes them on in the scene.
const FOR_ALL: [&str; 2] = ["sz", "va"];

/// Options that are velocities.
const VELOCITIES: [&str; 2] = ["vel", "cv"];

/// What is drawn in every frame.
#[derive(Clone, Debug)]
pub struct Script {
    /// How frames are drawn.
    pub method: Method,
    /// How many there are.
    pub n_frames: u32,
    /// How numbers go from one value to the next.
    pub ease: Ease,
    /// The last frame comes before the first again, so it is not the same.
    pub is_loop: bool,
    /// Words that every program gets: options for reading.
    pub reading: Vec<String>,
    /// Names of the programs of the pipe.
    names: Vec<String>,
    options: Vec<Setting>,
}

/// An option over the film.
#[derive(Clone, Debug)]
struct Setting {
    name: String,
    /// The programs of the pipe that are given it.
    owners: Vec<usize>,
    timeline: Timeline,
}

/// The commands of a frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Commands {
    /// Each with its program; the words begin with its name.
    pub stages: Vec<(Program, Vec<String>)>,
}

impl Script {
    /// A script without options. `n_frames`: 1 or more.
    pub fn new(method: Method, n_frames: u32) -> Self {
        Self {
            method,
            n_frames,
            ease: Ease::Linear,
            is_loop: false,
            reading: Vec::new(),
            names: method.programs().iter().map(|program| program.command().get_name().to_owned()).collect(),
            options: Vec::new(),
        }
    }

    /// Adds an option as it was given.
    ///
    /// # Errors
    /// No program of the pipe has this option, or a value is invalid.
    pub fn add(&mut self, option: &Given) -> Result<(), Failure> {
        let timeline = Timeline::new(option.values.clone(), quantity(&option.name));
        let timeline = timeline.map_err(|why| refused(&option.name, &why))?;
        self.add_timeline(&option.name, timeline)
    }

    /// Adds an option with its values over the film.
    ///
    /// # Errors
    /// No program of the pipe has this option, or it was added before.
    pub fn add_timeline(&mut self, name: &str, timeline: Timeline) -> Result<(), Failure> {
        if self.get(name).is_some() {
            return Err(refused(name, "it is given twice"));
        }
        let owners = self.owners(name);
        if owners.is_empty() {
            let others = Program::ALL.into_iter().filter(|&program| has(program, name));
            let owners: Vec<String> = others.map(|program| program.command().get_name().to_owned()).collect();
            let why = match owners[..] {
                [] => "no program has it".to_owned(),
                _ => format!("it is an option of {}, which draws no frame here", owners.join(" and ")),
            };
            return Err(refused(name, &why));
        }
        self.options.push(Setting { name: name.to_owned(), owners, timeline });
        Ok(())
    }

    /// Replaces the values of an option, or adds it.
    pub fn set(&mut self, name: &str, values: Vec<String>) {
        let timeline = Timeline::Fixed(values);
        if let Some(setting) = self.options.iter_mut().find(|setting| setting.name == name) {
            setting.timeline = timeline;
        } else {
            self.options.push(Setting { name: name.to_owned(), owners: self.owners(name), timeline });
        }
    }

    /// The only word of an option that does not change.
    pub fn fixed(&self, name: &str) -> Option<String> {
        match self.get(name) {
            Some(Timeline::Fixed(words)) => words.first().cloned(),
            _ => None,
        }
    }

    /// True if no option changes over the film.
    pub fn is_still(&self) -> bool {
        self.options.iter().all(|setting| matches!(setting.timeline, Timeline::Fixed(_)))
    }

    /// The programs of the pipe that are given an option.
    fn owners(&self, name: &str) -> Vec<usize> {
        let programs = self.method.programs().iter().enumerate();
        let owners = programs.filter(|(_, program)| has(**program, name)).map(|(row, _)| row);
        owners.take(if FOR_ALL.contains(&name) { usize::MAX } else { 1 }).collect()
    }

    /// The values of an option, if it is given.
    pub fn get(&self, name: &str) -> Option<&Timeline> {
        self.options.iter().find(|setting| setting.name == name).map(|setting| &setting.timeline)
    }

    /// The time of a frame, from 0 to 1. Frames are counted from 1, and `frame` may lie between
    /// two.
    pub fn time(&self, frame: f64) -> f64 {
        let steps = if self.is_loop { self.n_frames } else { self.n_frames - 1 };
        let time = if steps == 0 { 0.0 } else { (frame - 1.0) / f64::from(steps) };
        // With motion blur, the first frame of a film that repeats begins at its end.
        if self.is_loop && time < 0.0 { time.rem_euclid(1.0) } else { time }
    }

    /// The commands of a frame.
    ///
    /// # Errors
    /// A caption asks for what the frame does not have.
    pub fn commands(&self, frame: f64) -> Result<Commands, Failure> {
        self.commands_without(frame, &[])
    }

    /// The commands for the light of a moment: those of a frame without what is done to light.
    ///
    /// # Errors
    /// As of [`Script::commands`].
    pub fn light_commands(&self, moment: f64) -> Result<Commands, Failure> {
        self.commands_without(moment, &["cap", "ex", "tc"])
    }

    /// The options for the exposure and tone curve of a frame, in words.
    pub fn development(&self, frame: f64) -> String {
        let words = |name: &str| {
            let values = self.get(name)?.at(self.time(frame), self.ease);
            Some(format!("{} {}", spelling(name), values.join(" ")))
        };
        let options: Vec<String> = ["ex", "tc"].into_iter().filter_map(words).collect();
        format!(", developed with {}", options.join(" "))
    }

    fn commands_without(&self, frame: f64, left_out: &[&str]) -> Result<Commands, Failure> {
        let time = self.time(frame);
        let programs = self.method.programs().iter().zip(&self.names);
        let mut stages: Vec<(Program, Vec<String>)> = programs
            .map(|(&program, name)| (program, [name].into_iter().chain(&self.reading).cloned().collect()))
            .collect();
        let is_kept = |setting: &&Setting| !left_out.contains(&setting.name.as_str());
        for Setting { name, owners, timeline } in self.options.iter().filter(is_kept) {
            let mut values = timeline.at(time, self.ease);
            if name == "cap" {
                for text in &mut values {
                    *text = self.filled(text, frame, time)?;
                }
            }
            for &row in owners {
                stages[row].1.push(spelling(name));
                stages[row].1.extend(values.iter().cloned());
            }
        }
        Ok(Commands { stages })
    }

    /// A caption with the numbers of a frame: `{frame}`, `{beta}`, `{gamma}`, `{t}`, and the names
    /// of options with one number.
    fn filled(&self, text: &str, frame: f64, time: f64) -> Result<String, Failure> {
        let mut filled = String::new();
        let mut rest = text;
        while let Some((before, after)) = rest.split_once('{') {
            let Some((name, after)) = after.split_once('}') else { break };
            filled += before;
            filled += &self.number(name, frame, time).ok_or_else(|| {
                let known =
                    "{frame}, {beta}, {gamma}, {t}, or an option of this film with one number, as {ti}";
                refused("cap", &format!("`{{{name}}}` is not one of {known}"))
            })?;
            rest = after;
        }
        Ok(filled + rest)
    }

    fn number(&self, name: &str, frame: f64, time: f64) -> Option<String> {
        let numbers = |name: &str| self.get(name).map(|timeline| timeline.numbers(time, self.ease));
        let speed = || {
            let velocity = VELOCITIES.iter().rev().find_map(|name| numbers(name)).unwrap_or_default();
            velocity.iter().fold(0.0, |sum, part| libm::hypot(sum, *part))
        };
        Some(match name {
            "frame" => format!("{frame}"),
            "beta" => format!("{:.3}", speed()),
            "gamma" => {
                let speed: f64 = speed();
                format!("{:.2}", 1.0 / ((1.0 - speed) * (1.0 + speed)).sqrt())
            }
            "t" => format!("{:.2}", numbers("ti").and_then(|list| list.first().copied()).unwrap_or(0.0)),
            _ => match numbers(name)?[..] {
                [number] => format!("{number:.2}"),
                _ => return None,
            },
        })
    }
}

impl Commands {
    /// States the format of the picture, unless it is the default.
    pub fn set_format(&mut self, format: Format) {
        if let (Some((_, words)), true) = (self.stages.last_mut(), format != Format::Png) {
            words.extend(["-dt".to_owned(), format.name().to_owned()]);
        }
    }

    /// The pipe for a shell. `input`: the scene, `None` for standard input; `output`: the file.
    pub fn line(&self, input: Option<&str>, output: Option<&str>) -> String {
        let mut line = String::new();
        for (row, (_, words)) in self.stages.iter().enumerate() {
            let mut words = words.iter();
            line += if row > 0 { " | " } else { "" };
            line.extend(words.next().map(|name| shell_word(name)));
            line.extend(input.filter(|_| row == 0).map(|name| format!(" {}", shell_word(name))));
            line.extend(words.map(|word| format!(" {}", shell_word(word))));
        }
        if let Some(output) = output {
            // Writing to a string cannot fail.
            let _ = write!(line, " > {}", shell_word(output));
        }
        line
    }
}

/// What the numbers of an option are.
pub fn quantity(name: &str) -> Quantity {
    if VELOCITIES.contains(&name) { Quantity::Velocity } else { Quantity::Plain }
}

fn has(program: Program, name: &str) -> bool {
    options_of(program).iter().any(|arg| arg.get_long() == Some(name))
}

/// An option as our documentation writes it.
fn spelling(name: &str) -> String {
    if name.len() <= 3 { format!("-{name}") } else { format!("--{name}") }
}

fn refused(name: &str, why: &str) -> Failure {
    Failure::Usage(format!("`{}`: {why}", spelling(name)))
}
