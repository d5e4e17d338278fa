//! One program's place in a pipe.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

use crate::args::CommonArgs;
use crate::failure::Failure;
use crate::input::{self, Input};
use crate::messages::Messages;
use crate::output::Output;
use crate::steps::Steps;
use crate::text;

/// What a program sees of the world: its input, its output and its messages.
///
/// Read all, compute, then write all: a filter that fails has written nothing, so the
/// next program never draws half a scene.
pub struct Stage {
    input: Option<PathBuf>,
    is_input_named: bool,
    output: Output,
    /// Beside it.
    others: Vec<Output>,
    messages: Messages,
    command_line: String,
}

impl Stage {
    pub(crate) fn new(common: &CommonArgs, messages: Messages, command_line: String) -> Self {
        Self {
            input: common.input().map(Path::to_owned),
            is_input_named: common.input_named().is_some(),
            output: Output::new(common.output()),
            others: Vec::new(),
            messages,
            command_line,
        }
    }

    /// Reads the whole input: the file the user named, or standard input. Call it once,
    /// for standard input is empty the second time.
    ///
    /// # Errors
    /// [`Failure::Read`] if there is no such file or it cannot be read.
    pub fn input(&mut self) -> Result<Input, Failure> {
        if !self.is_input_named && input::stdin_is_terminal() {
            self.note("reading standard input; --help for help");
        }
        input::read(self.input.as_deref())
    }

    /// Reads another input, from a file.
    ///
    /// # Errors
    /// [`Failure::Read`] if there is no such file or it cannot be read.
    pub fn input_file(&self, path: &Path) -> Result<Input, Failure> {
        input::read(Some(path))
    }

    /// The program and those of its options that affect the content, for the output's
    /// head comment: `uglorentz -vel .9 0 0`.
    ///
    /// Options stand in the historical spelling and the user's order; files, threads and
    /// talk (`-fi -fo -fm -nt -qt -vb`) are left out, since equal content must be equal
    /// bytes. There are no braces and no control characters in it: they show as `?`.
    pub fn command_line(&self) -> &str {
        &self.command_line
    }

    /// Writes the whole output. Call it once, when everything else has succeeded.
    ///
    /// A named file takes its place when the program ends well, not before. A second
    /// call appends.
    ///
    /// # Errors
    /// [`Failure::Write`] if the disk is full, the reader has left, or the place is not ours
    /// to write to.
    pub fn write(&mut self, data: &[u8]) -> Result<(), Failure> {
        self.write_with(|out| out.write_all(data))
    }

    /// The same for an output that is sent in pieces while it is made, so that it need not
    /// be in memory as a whole. `fill` sends it, in large pieces, and can fail by writing only:
    /// with one half written there is no way back.
    ///
    /// # Errors
    /// [`Failure::Write`] with the error of `fill`.
    pub fn write_with(&mut self, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Failure> {
        let begun = Instant::now();
        self.output.write_with(fill)?;
        self.detail(&format!("writing took {:.3} s", begun.elapsed().as_secs_f64()));
        Ok(())
    }

    /// Writes another file beside the output, whole or not at all: it takes its place when the program ends
    /// well, before the output does.
    ///
    /// # Errors
    /// [`Failure::Usage`] if the output goes to that file; [`Failure::Write`] as for [`Stage::write`].
    pub fn write_file(&mut self, path: &Path, data: &[u8]) -> Result<(), Failure> {
        if self.output.path() == Some(path) {
            return Err(Failure::Usage(format!("two outputs cannot go to one file, `{}`", text::path(path))));
        }
        let mut file = Output::new(Some(path));
        file.write_with(|out| out.write_all(data))?;
        self.others.push(file);
        Ok(())
    }

    /// Whether the output would appear on the screen of a person: pictures must not.
    pub fn output_is_terminal(&self) -> bool {
        self.output.is_terminal()
    }

    /// File of the output, if it is not standard output. Its ending may choose a format.
    pub fn output_name(&self) -> Option<&Path> {
        self.output.path()
    }

    /// Sends the output to a file the user did not name, as some programs did in 1988
    /// when their output was a terminal. Call it before [`Stage::write`].
    pub fn set_output_name(&mut self, path: impl AsRef<Path>) {
        self.output.set_path(path.as_ref());
    }

    /// Tells the user something worth knowing. Silent under `-qt`.
    pub fn note(&self, text: &str) {
        self.messages.note(text);
    }

    /// Tells the user of something that may be wrong. Silent under `-qt`.
    pub fn warn(&self, text: &str) {
        self.messages.warn(text);
    }

    /// Prints finished diagnostics as they are: warnings with their own places and
    /// headings. Terminal styles in them are left out where they do not belong, so render
    /// them styled always. Silent under `-qt`.
    ///
    /// Errors of this kind end the run as [`Failure::Report`].
    pub fn report(&self, text: &str) {
        self.messages.warn_report(text);
    }

    /// Says what was done, with the time since the start. Only under `-vb`.
    pub fn detail(&self, text: &str) {
        self.messages.detail(text);
    }

    /// Whom a computation tells how far it is. `-vb` says what each step took; a step that is not done when
    /// the program has run for a second shows a bar, if standard error is a terminal, but not under `-qt`.
    /// Drop it before other messages are to appear.
    pub fn steps(&self) -> Steps<'_> {
        Steps::new(&self.messages)
    }

    /// Keeps or discards the output, and says why a run failed.
    pub(crate) fn end(mut self, outcome: Result<(), Failure>) -> Result<(), Failure> {
        let outcome = outcome.and_then(|()| self.others.iter_mut().try_for_each(Output::finish));
        let outcome = outcome.and_then(|()| self.output.finish());
        if let Err(failure) = &outcome
            && !failure.is_closed_pipe()
        {
            self.messages.failure(failure);
        }
        outcome
    }
}
