//! Notes, warnings and errors: to standard error or the file of `-fm`.
//!
//! All messages of a program leave through this module. Text from outside is
//! made [printable] here: a message with a heading is one line, so it cannot contain a line that
//! looks like another message.

use std::fs::File;
use std::io::{self, Write};
use std::sync::Arc;
use std::time::{Duration, Instant};

use anstream::adapter::strip_str;
use anstream::{AutoStream, ColorChoice};
use clap::builder::styling::{AnsiColor, Style};

use crate::cli::args::CommonArgs;
use crate::cli::failure::Failure;
use crate::progress::Progress;
use crate::text::{message, printable, printable_styled};

const ERROR: Style = AnsiColor::Red.on_default().bold();
const WARNING: Style = AnsiColor::Yellow.on_default().bold();
const NOTE: Style = AnsiColor::Cyan.on_default().bold();

/// The process that calls a program as a function: it receives progress reports and messages, and
/// may stop the program.
pub trait Host: Progress + Send {
    /// Receives a note or a warning, without the name of the program.
    fn message(&self, text: &str);
}

/// Prints messages, as far as the options allow.
pub(crate) struct Messages {
    program: String,
    /// Receives everything instead of the terminal.
    host: Option<Arc<dyn Host>>,
    file: Option<File>,
    is_quiet: bool,
    is_verbose: bool,
    /// `None` where there is no clock.
    start: Option<Instant>,
}

impl Messages {
    /// All messages go to standard error until [`Messages::configure`] applies the options.
    pub(crate) fn new(program: &str) -> Self {
        let program = program.to_owned();
        let start = cfg!(unix).then(Instant::now);
        Self { program, host: None, file: None, is_quiet: false, is_verbose: false, start }
    }

    /// Messages of a program that is called as a function.
    pub(crate) fn to_host(program: &str, host: Arc<dyn Host>) -> Self {
        Self { host: Some(host), ..Self::new(program) }
    }

    pub(crate) fn host(&self) -> Option<&dyn Host> {
        self.host.as_deref()
    }

    /// Messages that nobody reads.
    pub(crate) fn silent() -> Self {
        Self { is_quiet: true, ..Self::new("") }
    }

    /// Applies the options `-qt`, `-vb` and `-fm`. The file of `-fm` is truncated immediately.
    pub(crate) fn configure(&mut self, common: &CommonArgs) -> Result<(), Failure> {
        self.is_quiet = common.qt;
        self.is_verbose = common.vb;
        if let Some(path) = common.messages() {
            let created = File::create(path);
            self.file = Some(
                created
                    .map_err(|error| Failure::Write { name: path.display().to_string(), error })?,
            );
        }
        Ok(())
    }

    pub(crate) fn program(&self) -> &str {
        &self.program
    }

    pub(crate) fn is_quiet(&self) -> bool {
        self.is_quiet
    }

    /// Time since the start of the program.
    pub(crate) fn elapsed(&self) -> Duration {
        self.start.map_or(Duration::ZERO, |start| start.elapsed())
    }

    pub(crate) fn note(&self, text: &str) {
        if !self.is_quiet {
            self.headed("note", NOTE, text);
        }
    }

    pub(crate) fn warn(&self, text: &str) {
        if !self.is_quiet {
            self.headed("warning", WARNING, text);
        }
    }

    pub(crate) fn warn_report(&self, text: &str) {
        if !self.is_quiet {
            self.report(text);
        }
    }

    pub(crate) fn detail(&self, text: &str) {
        if self.is_verbose {
            let seconds = self.elapsed().as_secs_f64();
            self.print(&format!("{}: {seconds:.3} s: {}", self.program, printable(text)));
        }
    }

    pub(crate) fn failure(&self, failure: &Failure) {
        match failure {
            // The caller receives it as an error.
            _ if self.host.is_some() => {}
            Failure::Report(text) => self.report(text),
            Failure::Usage(text) => {
                let line = self.line("error", ERROR, text);
                self.print(&format!("{line}\ntry `{} -h`", self.program));
            }
            _ => self.headed("error", ERROR, &failure.to_string()),
        }
    }

    /// Prints a report, whose messages have an empty line between them.
    fn report(&self, text: &str) {
        let text = printable_styled(text.trim_end_matches('\n'));
        if let Some(host) = self.host() {
            return host.message(&strip_str(&text).to_string());
        }
        let messages = text.split("\n\n").map(|message| format!("{}: {message}", self.program));
        self.print(&messages.collect::<Vec<_>>().join("\n\n"));
    }

    fn headed(&self, heading: &str, style: Style, text: &str) {
        if let Some(host) = self.host() {
            return host.message(&message(text.trim_end_matches('\n')));
        }
        self.print(&self.line(heading, style, text));
    }

    fn line(&self, heading: &str, style: Style, text: &str) -> String {
        format!(
            "{}: {style}{heading}:{style:#} {}",
            self.program,
            message(text.trim_end_matches('\n'))
        )
    }

    /// Prints a message with a single write, because the programs of a pipe share the terminal.
    ///
    /// A message that cannot be written to the file goes to standard error. If that fails too, it
    /// is lost.
    fn print(&self, text: &str) {
        let text = format!("{}\n", text.trim_end_matches('\n'));
        let plain = strip_str(&text).to_string();
        let is_in_file =
            self.file.as_ref().is_some_and(|mut file| file.write_all(plain.as_bytes()).is_ok());
        if is_in_file {
            return;
        }
        let stderr = io::stderr();
        let is_colored = AutoStream::choice(&stderr) != ColorChoice::Never;
        let shown = if is_colored { text } else { plain };
        let _ = stderr.lock().write_all(shown.as_bytes());
    }
}
