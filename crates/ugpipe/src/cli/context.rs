//! The input, output and messages of a program.

use std::collections::HashSet;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use crate::cli::args::CommonArgs;
use crate::cli::failure::Failure;
use crate::cli::files::{self, Place, ProgramOutput};
use crate::cli::folder::folder_of;
use crate::cli::input::{self, Input};
use crate::cli::messages::{Host, Messages};
use crate::cli::output::Output;
use crate::cli::provenance;
use crate::cli::steps::Steps;
use crate::other_case::OtherCase;
use crate::text::{printable_json, printable_lines};

/// Largest input in bytes: 4 GiB. Inputs are read into memory whole.
pub const MAX_INPUT: u64 = u32::MAX as u64;

/// The folder of the input, or for standard input the current folder.
fn place(common: &CommonArgs) -> Place {
    if common.allow_outside {
        return Place::Anywhere;
    }
    common.input().map_or(Place::Here, |input| Place::Below(folder_of(input).to_owned()))
}

const EMPTY_INPUT: &str =
    "nothing came through the pipe: the program upstream failed, or wrote nothing";

fn within(limit: u64, input: Input) -> Result<Input, Failure> {
    if input.text.len() as u64 <= limit {
        return Ok(input);
    }
    let name = &input.name;
    Err(Failure::Failed(format!("`{name}` has more than {limit} bytes, the limit for inputs")))
}

/// A file among those in memory: the one of this path, or else of this name in any folder. As on a
/// disk, a name with `/` behind it is that of a folder.
fn in_memory<'f>(files: &'f [Input], path: &Path) -> io::Result<&'f Input> {
    let name = path.as_os_str().as_encoded_bytes();
    if name.ends_with(b"/") || name.ends_with(b"/.") {
        return Err(io::Error::new(io::ErrorKind::NotADirectory, "Not a directory"));
    }
    let by_name =
        || files.iter().find(|file| Path::new(&file.name).file_name() == path.file_name());
    let found = files.iter().find(|file| Path::new(&file.name) == path).or_else(by_name);
    found.ok_or_else(|| {
        let lower =
            |path: &Path| path.file_name().map(|name| name.to_string_lossy().to_lowercase());
        let mut names = files.iter().map(|file| Path::new(&file.name));
        match names.find(|name| lower(name) == lower(path)).and_then(Path::file_name) {
            Some(name) => OtherCase::error(path.with_file_name(name)),
            None => io::Error::new(io::ErrorKind::NotFound, "It is not among the given files"),
        }
    })
}

/// The first bytes of a file in memory.
fn first_bytes(file: &Input, limit: u64) -> Vec<u8> {
    let len = usize::try_from(limit).map_or(file.text.len(), |limit| limit.min(file.text.len()));
    file.text[..len].to_vec()
}

/// The files that were read beside the input.
#[derive(Default)]
struct Reads {
    /// Of each, its name and hash.
    records: Vec<String>,
    /// The same with their paths.
    seen: HashSet<(String, PathBuf)>,
}

/// The interface of a program to the system: its input, its output and its messages.
///
/// A filter reads the whole input, computes, and then writes the whole output. If it fails, it has
/// written nothing, so half a scene never goes downstream.
pub struct Context {
    input: Option<PathBuf>,
    is_input_named: bool,
    /// The input of a program that is called as a function.
    given: Option<Input>,
    /// Where files and programs that the input names must be.
    place: Place,
    output: Output,
    /// Additional output files.
    others: Vec<Output>,
    messages: Messages,
    command_line: String,
    /// The only files that are read, of a program that runs in memory.
    files: Option<Vec<Input>>,
    /// Files in memory that the input may name, see [`Context::beside`].
    beside: Vec<Input>,
    /// The records of the files that were read beside the input, and the same with their paths.
    reads: Mutex<Reads>,
}

impl Context {
    pub(crate) fn new(common: &CommonArgs, messages: Messages, command_line: String) -> Self {
        Self {
            input: common.input().map(Path::to_owned),
            is_input_named: common.input_named().is_some(),
            given: None,
            place: place(common),
            output: Output::new(common.output()),
            others: Vec::new(),
            messages,
            command_line,
            files: None,
            beside: Vec::new(),
            reads: Mutex::default(),
        }
    }

    /// The context of a program that runs in memory: it reads `files` and nothing else, and prints
    /// no messages. The input is the file that `common` names, or the first one. A file that
    /// another one names is found by its name, in whatever folder.
    pub fn in_memory(common: &CommonArgs, files: Vec<Input>) -> Self {
        Self { files: Some(files), ..Self::new(common, Messages::silent(), String::new()) }
    }

    /// The context of a program that another one calls for a part of its output, such as a frame of
    /// a film, on any thread: it reads files of the system and prints no messages. `given`: the
    /// content of the input, if it was read before.
    pub fn called(common: &CommonArgs, given: Option<Input>) -> Self {
        Self { given, ..Self::new(common, Messages::silent(), String::new()) }
    }

    /// The files of a program that ran in memory.
    pub fn into_files(self) -> Vec<Input> {
        self.files.unwrap_or_default()
    }

    /// Reads the input, or another file.
    fn read(&self, path: Option<&Path>, limit: u64) -> Result<Input, Failure> {
        let Some(files) = &self.files else { return input::read(path, limit) };
        let found = match path {
            Some(path) => in_memory(files, path),
            None => files.first().ok_or_else(|| io::ErrorKind::NotFound.into()),
        };
        let name = path.map_or_else(|| "-".to_owned(), |path| path.display().to_string());
        match found {
            Ok(file) => Ok(Input { name: file.name.clone(), text: first_bytes(file, limit) }),
            Err(error) => Err(Failure::Read { name, error }),
        }
    }

    /// The interface of a program that is called as a function in another process, which receives
    /// its messages. `command_line`: from [`crate::parse_command`]; `given`: the input, unless
    /// `common` names a file.
    pub fn hosted(
        common: &CommonArgs,
        program: &str,
        command_line: String,
        given: Option<Input>,
        host: Arc<dyn Host>,
    ) -> Self {
        Self { given, ..Self::new(common, Messages::to_host(program, host), command_line) }
    }

    /// With files in memory: where the input names one of them by its path, it is read in place of
    /// the file of the system, and stands for the output of a program of this path.
    #[must_use]
    pub fn beside(self, files: Vec<Input>) -> Self {
        Self { beside: files, ..self }
    }

    /// The file of this path among those in memory.
    fn found_beside(&self, path: &Path, limit: u64) -> Option<Vec<u8>> {
        let found = self.beside.iter().find(|file| Path::new(&file.name) == path)?;
        Some(first_bytes(found, limit))
    }

    /// Reads the whole input: the file that the user named, or standard input. Call it only once: a
    /// second call would find standard input empty.
    ///
    /// # Errors
    /// [`Failure::Read`] if there is no such file or it cannot be read; [`Failure::Failed`] if it
    /// has more than [`MAX_INPUT`] bytes.
    pub fn input(&mut self) -> Result<Input, Failure> {
        within(MAX_INPUT, self.input_up_to(MAX_INPUT + 1)?)
    }

    /// Like [`Context::input`], and reads at most `limit` bytes.
    ///
    /// # Errors
    /// [`Failure::Read`] if there is no such file or it cannot be read; [`Failure::Failed`] if
    /// a pipe is empty, so that a failure upstream is a failure of the whole pipe.
    pub fn input_up_to(&mut self, limit: u64) -> Result<Input, Failure> {
        if let Some(input) = self.given.take() {
            return Ok(input);
        }
        if self.files.is_none() && !self.is_input_named && input::stdin_is_terminal() {
            self.note("reading standard input; -h for help");
        }
        let input = self.read(self.input.as_deref(), limit)?;
        if self.files.is_none()
            && self.input.is_none()
            && input.text.is_empty()
            && input::stdin_is_pipe()
        {
            return Err(Failure::Failed(EMPTY_INPUT.to_owned()));
        }
        Ok(input)
    }

    /// Reads an additional input file.
    ///
    /// # Errors
    /// See [`Context::input`].
    pub fn input_file(&self, path: &Path) -> Result<Input, Failure> {
        let input = within(MAX_INPUT, self.read(Some(path), MAX_INPUT + 1)?)?;
        self.note_read(path, Some(&input.text));
        Ok(input)
    }

    /// Hash and name of every file that was read beside the input, and of the output of every
    /// program, since the last call, for the record in the output: `SHA-256 3b1c… hull.png`. Where
    /// a file that an input names could not be read, the hash is `none`.
    pub fn take_files_read(&self) -> Vec<String> {
        std::mem::take(&mut *self.reads.lock().unwrap_or_else(PoisonError::into_inner)).records
    }

    /// The same, with the input first.
    pub fn take_record(&self, input: &Input) -> Vec<String> {
        let input = format!("SHA-256 {} {}", provenance::sha256(&input.text), self.recorded_name());
        std::iter::once(input).chain(self.take_files_read()).collect()
    }

    /// Every file that this program opens, but its input, is reported here.
    fn note_read(&self, path: &Path, text: Option<&[u8]>) {
        let words = match text {
            Some(text) => {
                let name = provenance::recorded_name(Some(path));
                format!("SHA-256 {} {name}", provenance::sha256(text))
            }
            // Meshes name files by paths of other machines, which nobody needs to know.
            None => {
                let name = path.file_name().map(Path::new);
                format!("SHA-256 none {}", provenance::recorded_name(name))
            }
        };
        let mut reads = self.reads.lock().unwrap_or_else(PoisonError::into_inner);
        // Each is told once, however often it is read.
        if reads.seen.insert((words.clone(), path.to_owned())) {
            reads.records.push(words);
        }
    }

    /// Reads at most `limit` bytes of a file that the input names. It has to be a regular file, in
    /// the folder of the input or below (for standard input, in the current folder), links
    /// followed, unless the user allows others (`--allow-outside`).
    ///
    /// # Errors
    /// The file is elsewhere or of another kind, or cannot be read; the error has the system's
    /// message.
    pub fn read_named(&self, path: &Path, limit: u64) -> io::Result<Vec<u8>> {
        self.read_at(path, &self.place, limit)
    }

    /// True if the input may name files in any folder (`--allow-outside`).
    pub fn allows_outside(&self) -> bool {
        self.place == Place::Anywhere
    }

    /// Runs a program that the input names, at the places of [`Context::read_named`], without a
    /// shell, arguments or input, and reads at most `limit` bytes of its standard output. A program
    /// that prints as much is killed. `PATH` is not searched.
    ///
    /// # Errors
    /// The program is elsewhere, or cannot be run; the error has the system's message.
    pub fn run_named(&self, path: &Path, limit: u64) -> io::Result<ProgramOutput> {
        if self.files.is_some() {
            return Err(io::Error::new(io::ErrorKind::Unsupported, "No programs are run here"));
        }
        if let Some(text) = self.found_beside(path, limit) {
            self.note_read(path, Some(&text));
            return Ok(ProgramOutput { text, error_line: String::new(), failure: None });
        }
        let ran = files::run_program(path, &self.place, limit)?;
        self.note_read(path, Some(&ran.text));
        Ok(ran)
    }

    /// The program and those of its options that affect the content, for the history comment at the
    /// head of the output: `uglorentz -vel .9 0 0`.
    ///
    /// Options have the historical spelling and the user's order. Options for files, threads and
    /// messages (`-fi -fo -fm -nt -qt -vb`) are omitted, since equal content must give equal bytes.
    /// Arguments are quoted as by [`crate::shell_os_word`].
    pub fn command_line(&self) -> &str {
        &self.command_line
    }

    /// The name of the input for the history, quoted as in [`Context::command_line`]; `-` for
    /// standard input. Of a path that leads out of the current folder it is the file name alone.
    pub fn recorded_name(&self) -> String {
        provenance::recorded_name(self.input.as_deref())
    }

    /// Reads at most `limit` bytes of a regular file in the current folder or below.
    ///
    /// # Errors
    /// See [`Context::read_named`].
    pub fn read_here(&self, path: &Path, limit: u64) -> io::Result<Vec<u8>> {
        self.read_at(path, &Place::Here, limit)
    }

    fn read_at(&self, path: &Path, place: &Place, limit: u64) -> io::Result<Vec<u8>> {
        let read = match (self.found_beside(path, limit), &self.files) {
            (Some(found), _) => Ok(found),
            (None, Some(files)) => in_memory(files, path).map(|file| first_bytes(file, limit)),
            (None, None) => files::read_file(path, place, limit),
        };
        self.note_read(path, read.as_deref().ok());
        read
    }

    /// Writes the whole output. Call it once, after everything else has succeeded.
    ///
    /// A named file is replaced when the program succeeds, not before. A second call appends.
    ///
    /// # Errors
    /// [`Failure::Write`] if the disk is full, the reading end of the pipe is closed, or the user
    /// has no permission to write.
    pub fn write(&mut self, data: &[u8]) -> Result<(), Failure> {
        self.write_with(|out| out.write_all(data))
    }

    /// Writes a report for people, of several lines. What a terminal would obey in names from
    /// outside is replaced by U+FFFD.
    ///
    /// # Errors
    /// See [`Context::write`].
    pub fn write_text(&mut self, text: &str) -> Result<(), Failure> {
        self.write(printable_lines(text).as_bytes())
    }

    /// Writes a report as JSON. What a terminal would obey in names from outside is escaped.
    ///
    /// # Errors
    /// See [`Context::write`].
    pub fn write_json(&mut self, json: &str) -> Result<(), Failure> {
        self.write(printable_json(json).as_bytes())
    }

    /// Prints text to standard output, whatever the output is. What a terminal would obey in names
    /// from outside is replaced by U+FFFD.
    ///
    /// # Errors
    /// See [`Context::write`].
    pub fn print(&self, text: &str) -> Result<(), Failure> {
        let mut stdout = Output::new(None);
        stdout.write_with(|out| out.write_all(printable_lines(text).as_bytes()))
    }

    /// Like [`Context::write`], for an output that is written in chunks while it is computed, so
    /// that it need not be in memory as a whole. `fill` writes it, in large chunks. Only writing
    /// may fail in it, since a chunk that has been written cannot be taken back.
    ///
    /// # Errors
    /// [`Failure::Write`] with the error of `fill`.
    pub fn write_with(
        &mut self,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Failure> {
        let begun = self.messages.elapsed();
        self.output.write_with(fill)?;
        self.detail(&format!(
            "writing took {:.3} s",
            (self.messages.elapsed() - begun).as_secs_f64()
        ));
        Ok(())
    }

    /// Writes an additional output file. Like the output it is replaced atomically when the program
    /// succeeds, just before the output.
    ///
    /// # Errors
    /// [`Failure::Write`] as in [`Context::write`].
    pub fn write_file(&mut self, path: &Path, data: &[u8]) -> Result<(), Failure> {
        let mut file = Output::new(Some(path));
        file.write_with(|out| out.write_all(data))?;
        self.others.push(file);
        Ok(())
    }

    /// Writes a file that is kept whatever happens afterwards, such as a frame of a film. It is
    /// replaced atomically, now.
    ///
    /// # Errors
    /// [`Failure::Write`] as in [`Context::write`].
    pub fn write_now(path: &Path, data: &[u8]) -> Result<(), Failure> {
        let mut file = Output::new(Some(path));
        file.write_with(|out| out.write_all(data))?;
        file.finish()
    }

    /// Lets another program write the output file: `fill` gets the name of a temporary file with
    /// the same ending, which replaces the output when the program succeeds, and the receiver of
    /// progress reports.
    ///
    /// # Errors
    /// [`Failure::Write`] if no file can be created, [`Failure::Usage`] if the output is not a
    /// file; errors of `fill`.
    pub fn write_by_name(
        &mut self,
        fill: impl FnOnce(&Path, &Steps<'_>) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let Some(path) = self.output.temporary_name()? else {
            return Err(Failure::usage("this format is written to a file: give -fo FILE"));
        };
        fill(&path, &Steps::new(&self.messages))
    }

    /// Writes an output while it is computed, which takes long: `fill` gets the receiver of
    /// progress reports as well. It ends with a failure of the computation, or with the error of
    /// writing.
    ///
    /// # Errors
    /// See [`Context::write`]; failures of `fill`.
    pub fn write_stream(
        &mut self,
        fill: impl FnOnce(&mut dyn Write, &Steps<'_>) -> Result<io::Result<()>, Failure>,
    ) -> Result<(), Failure> {
        let mut outcome = Ok(());
        let steps = Steps::new(&self.messages);
        self.output.write_with(|out| match fill(out, &steps) {
            Ok(written) => written,
            Err(failure) => {
                outcome = Err(failure);
                Ok(())
            }
        })?;
        outcome
    }

    /// True if the output goes to a terminal, where binary files must not be printed.
    pub fn output_is_terminal(&self) -> bool {
        self.output.is_terminal()
    }

    /// The output file, unless it is standard output. Its extension may select a format.
    pub fn output_name(&self) -> Option<&Path> {
        self.output.path()
    }

    /// The output file, if it can be replaced while the program runs ([`Context::write_now`]):
    /// neither standard output nor a device or a pipe.
    pub fn replaceable_output(&self) -> Option<PathBuf> {
        let is_device =
            |path: &Path| std::fs::metadata(path).is_ok_and(|metadata| !metadata.is_file());
        self.output.path().filter(|path| !is_device(path)).map(Path::to_owned)
    }

    /// True if `-qt` is given: notes and warnings are not printed.
    pub fn is_quiet(&self) -> bool {
        self.messages.is_quiet()
    }

    /// Prints a note, unless `-qt` is given.
    pub fn note(&self, text: &str) {
        self.messages.note(text);
    }

    /// Prints a warning, unless `-qt` is given.
    pub fn warn(&self, text: &str) {
        self.messages.warn(text);
    }

    /// Prints rendered diagnostics: warnings with their own locations and headings, each after the
    /// name of the program. Always render them with terminal styles, which are removed if the
    /// output is not a terminal. Prints nothing if `-qt` is given.
    ///
    /// For errors, end the run with [`Failure::Report`] instead.
    pub fn report(&self, text: &str) {
        self.messages.warn_report(text);
    }

    /// Prints what was done, with the time since the start, if `-vb` is given.
    pub fn detail(&self, text: &str) {
        self.messages.detail(text);
    }

    /// The receiver of progress reports. With `-vb` it prints the time of each step. If standard
    /// error is a terminal and `-qt` is not given, a progress bar appears for a step that is still
    /// running one second after the start of the program. Drop it before printing other messages.
    pub fn steps(&self) -> Steps<'_> {
        Steps::new(&self.messages)
    }

    /// Completes or discards the output, and prints why a run failed.
    ///
    /// # Errors
    /// Those of the run; an output cannot be completed.
    pub fn end(mut self, outcome: Result<(), Failure>) -> Result<(), Failure> {
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
