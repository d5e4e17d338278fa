//! The commands of a pipe.

use ugfilm::{ParsedCommand, Pipe, Program};
use ugpipe::CommonArgs;

use crate::{printed, python};

/// Options that decide how the input is read, or whether it suits them.
const OF_READING: [&str; 21] = [
    "lax",
    "limit",
    "allow-execute",
    "allow-outside",
    "cam",
    "from",
    "part",
    "highlights",
    "infrared",
    "infrared-to",
    "ultraviolet",
    "ultraviolet-from",
    "stars",
    "scene",
    "star-width",
    "white",
    "aa",
    "fl",
    "br",
    "basis",
    "sp",
];

/// A pipe of commands, parsed.
pub struct Commands {
    /// The words of each.
    words: Vec<Vec<String>>,
    parsed: Vec<ParsedCommand>,
    /// The options that all programs have, of the first one.
    pub common: CommonArgs,
}

/// The words of commands in JSON.
pub fn words(json: &str) -> Result<Vec<Vec<String>>, String> {
    serde_json::from_str(json).map_err(|error| format!("these are no commands: {error}"))
}

impl Commands {
    /// Parses the words of commands in JSON.
    pub fn parse(json: &str) -> Result<Self, String> {
        let words = words(json)?;
        let parse = |words: &Vec<String>| {
            let program = words.first().map_or("", String::as_str);
            ParsedCommand::from_words(words).map_err(|failure| printed(program, &failure))
        };
        let parsed = words.iter().map(parse).collect::<Result<Vec<_>, _>>()?;
        let common = parsed.first().map(|command| command.common.clone());
        Ok(Self { words, parsed, common: common.ok_or("there are no commands")? })
    }

    /// The pipe that draws.
    pub fn pipe(&self) -> Pipe {
        let mut pipe =
            Pipe::new(self.parsed.iter().map(|command| command.program.clone()).collect());
        pipe.lines = self.parsed.iter().map(|command| command.line.clone()).collect();
        pipe
    }

    /// The pipe in Python.
    pub fn python(&self) -> String {
        let manuals = self.parsed.iter().map(|command| (command.manual)());
        python::lines(self.words.iter().map(Vec::as_slice).zip(manuals))
    }

    /// The words of the first command, which reads the input.
    pub fn first(&self) -> &[String] {
        self.words.first().map_or(&[], Vec::as_slice)
    }

    /// The name of the first program.
    pub fn program(&self) -> &str {
        self.first().first().map_or("", String::as_str)
    }

    /// True if the pipe draws a panorama or stars.
    pub fn is_of_sky(&self) -> bool {
        matches!(self.parsed.first().map(|command| &command.program), Some(Program::Warp(_)))
    }

    /// The camera that the scene is read with.
    pub fn camera(&self) -> Option<&str> {
        match &self.parsed.first()?.program {
            Program::Lorentz(config) => config.camera.name.as_deref(),
            Program::Rainbow(config) => config.picture.camera.name.as_deref(),
            Program::Photon(config) => config.picture.camera.name.as_deref(),
            Program::Doppler(_) | Program::Warp(_) => None,
        }
    }

    /// What the input depends on: commands with equal keys read the same.
    pub fn key(&self) -> String {
        let sky = self.pipe().sky().map(|sky| sky.source.clone());
        let mut key = format!("{} {:?} {sky:?}", self.is_of_sky(), self.common.input());
        let line = self.parsed.first().map_or("", |command| command.line.as_str());
        let mut is_kept = false;
        for word in line.split(' ').skip(1) {
            let name = word.trim_start_matches('-');
            if name.len() < word.len() && name.starts_with(|c: char| c.is_ascii_alphabetic()) {
                is_kept = OF_READING.contains(&name);
            }
            if is_kept {
                key = key + " " + word;
            }
        }
        key
    }
}
