//! `include` and `execute`: the text of other files, and what programs print, in
//! place of the statements that name them.
//!
//! The outcome is one text, with lines of the C preprocessor where files begin
//! and go on, so that messages name the file and line where something was written.
//! Files are read and programs run by whoever asks; nothing here touches the system.

use std::io;
use std::path::{Component, Path, PathBuf};

use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::options::{Limit, Options};
use crate::parallel_reader::read_document;
use crate::reader::RequestStatement;
use crate::refuse_errors;
use crate::source::{LineMark, Source};

/// What a scene asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RequestKind {
    /// `include`: the bytes of a file.
    Include,
    /// `execute`: what a program writes to its standard output.
    Execute,
}

/// A text that a scene asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Request<'r> {
    /// A file's, or a program's.
    pub kind: RequestKind,
    /// The file or program, as seen from the current folder.
    pub path: &'r Path,
    /// Bytes there is room for; of a longer text, no more than one byte beyond need be read.
    pub room: u64,
}

/// Why there is no text for a [`Request`].
#[derive(Debug)]
pub enum RequestError {
    /// The file cannot be read, or the program cannot be run.
    System(io::Error),
    /// The program has run, and failed.
    Failed {
        /// How it ended: `exit status: 3`.
        status: String,
        /// The first line of its complaint; may be empty.
        complaint: String,
    },
}

impl From<io::Error> for RequestError {
    fn from(error: io::Error) -> Self {
        Self::System(error)
    }
}

/// Puts the files that a scene includes in place of its `include` statements, and
/// what programs print in place of `execute`.
///
/// `load` gives the bytes that are asked for. It is asked to run a program only
/// under [`Options::execute`]. Names are relative to the file that has the
/// statement; those in a text without a file (`<stdin>`) to the current folder,
/// those in what a program prints to the folder of the program. A file holds
/// whole statements: a definition that begins in it ends in it.
///
/// ```
/// let scene = ugparse::Source::new("house/scene.ug", "include colors.ug ; v a 0 0 0 red ;");
/// let whole = ugparse::include(scene, &ugparse::Options::default(), |request| {
///     assert_eq!(request.kind, ugparse::RequestKind::Include);
///     assert_eq!(request.path, std::path::Path::new("house/colors.ug"));
///     Ok(b"c red 1 0 ;".to_vec())
/// })?;
/// assert_eq!(ugparse::parse(&whole, &ugparse::Options::default())?.scene.colors.len(), 1);
/// # Ok::<(), ugparse::Diagnostics>(())
/// ```
///
/// # Errors
/// A file that cannot be loaded, or includes itself; a program that fails, or is
/// not allowed to run; what is wrong with the statements of a text that asks for others.
pub fn include(
    source: Source,
    options: &Options,
    mut load: impl FnMut(&Request<'_>) -> Result<Vec<u8>, RequestError>,
) -> Result<Source, Diagnostics> {
    if !may_ask(&source.text) {
        return Ok(source);
    }
    let name = source.name.clone();
    let first = Text::new(source, options)?;
    let path = plain(Path::new(&name));
    let mut inclusion =
        Inclusion { options, load: &mut load, open: vec![(path, first)], n_files: 0, out: Vec::new() };
    inclusion.run()?;
    Ok(Source { name, text: inclusion.out })
}

/// True if one of the words occurs anywhere.
fn may_ask(text: &[u8]) -> bool {
    ["include", "execute"].iter().any(|word| memchr::memmem::find(text, word.as_bytes()).is_some())
}

/// A statement that nobody has followed.
pub(crate) fn not_followed(statement: &RequestStatement) -> Diagnostic {
    let (message, label) = match statement.kind {
        RequestKind::Include => ("files are not included here", "asks for a file"),
        RequestKind::Execute => ("programs are not run here", "asks for a program"),
    };
    Diagnostic::error(statement.span, message)
        .label(label)
        .help("put its text here, or use a program that reads files")
}

/// A text that is being copied.
struct Text {
    source: Source,
    statements: Vec<RequestStatement>,
    marks: Vec<LineMark>,
    /// Statements that were followed.
    n_followed: usize,
    /// Bytes that were copied or replaced.
    n_done: usize,
}

impl Text {
    fn new(source: Source, options: &Options) -> Result<Self, Diagnostics> {
        let mut findings = Vec::new();
        let document = read_document(&source.text, options, &mut findings);
        let (statements, marks) = (document.requests, document.line_marks);
        refuse_errors(&source, &mut findings)?;
        Ok(Self { source, statements, marks, n_followed: 0, n_done: 0 })
    }
}

struct Inclusion<'i> {
    options: &'i Options,
    load: &'i mut dyn FnMut(&Request<'_>) -> Result<Vec<u8>, RequestError>,
    /// The texts we are in and their files, the scene's own first.
    open: Vec<(PathBuf, Text)>,
    n_files: u64,
    out: Vec<u8>,
}

impl Inclusion<'_> {
    /// Copies the texts that are open, and those they ask for.
    fn run(&mut self) -> Result<(), Diagnostics> {
        while let Some((_, text)) = self.open.last_mut() {
            let Some(&statement) = text.statements.get(text.n_followed) else {
                self.out.extend_from_slice(&text.source.text[text.n_done..]);
                self.open.pop();
                self.mark();
                continue;
            };
            self.out.extend_from_slice(&text.source.text[text.n_done..statement.span.start as usize]);
            text.n_followed += 1;
            text.n_done = statement.span.end as usize;
            let next = self.follow(statement)?;
            self.open.push(next);
            self.mark();
        }
        Ok(())
    }

    /// Loads what a statement of the innermost text asks for.
    fn follow(&mut self, statement: RequestStatement) -> Result<(PathBuf, Text), Diagnostics> {
        let (_, Text { source, .. }) = self.open.last().expect("a statement stands in an open text");
        let refuse = |message: String, help: String| {
            let label = match statement.kind {
                RequestKind::Include => "included here",
                RequestKind::Execute => "run here",
            };
            let finding = Diagnostic::error(statement.file, message).label(label).help(help);
            Diagnostics::one(source, finding)
        };
        let limits = &self.options.limits;
        let shown = source.slice(statement.file);
        if statement.kind == RequestKind::Execute && !self.options.execute {
            return Err(refuse(
                format!("program `{shown}` is not run"),
                "a scene can run any program; if you trust this one, allow it with --allow-execute".into(),
            ));
        }
        let path = beside(&source.name, &shown);
        if self.open.iter().any(|(open, _)| *open == path) {
            return Err(refuse(
                format!("file `{shown}` includes itself"),
                "a file may not include itself, directly or through others".into(),
            ));
        }
        self.n_files += 1;
        if self.open.len() as u64 > limits.get(Limit::Includes) {
            let message = "files include each other too deeply".into();
            return Err(refuse(message, limits.remedy(Limit::Includes, "use fewer")));
        }
        if self.n_files > limits.get(Limit::Files) {
            let message = "too many files are included".into();
            return Err(refuse(message, limits.remedy(Limit::Files, "include fewer")));
        }
        let room = limits.get(Limit::Text).saturating_sub(self.out.len() as u64);
        let text = (self.load)(&Request { kind: statement.kind, path: &path, room }).map_err(|error| {
            refuse(complaint(statement.kind, &path, &error), remedy(statement.kind, &error))
        })?;
        if text.len() as u64 > room {
            let message = format!("with the text of `{shown}` the scene is too large");
            return Err(refuse(message, limits.remedy(Limit::Text, "split it")));
        }
        let file = Source { name: path.display().to_string(), text };
        Ok((path, Text::new(file, self.options)?))
    }

    /// Says where what follows was written, if anything does.
    fn mark(&mut self) {
        let Some((_, Text { source, marks, n_done, .. })) = self.open.last() else { return };
        let (name, line) = source.reported(marks, *n_done as u32);
        // A quote or line end would end the name.
        let name = name.replace(['"', '\n'], "?");
        self.out.extend_from_slice(format!("\n# {line} \"{name}\"\n").as_bytes());
    }
}

fn complaint(kind: RequestKind, path: &Path, error: &RequestError) -> String {
    let path = path.display();
    match (error, kind) {
        (RequestError::System(error), RequestKind::Include) => format!("cannot read `{path}`: {error}"),
        (RequestError::System(error), RequestKind::Execute) => format!("cannot run `{path}`: {error}"),
        (RequestError::Failed { status, complaint }, _) if complaint.is_empty() => {
            format!("program `{path}` failed with {status}")
        }
        (RequestError::Failed { status, complaint }, _) => {
            format!("program `{path}` failed with {status}: {}", printable(complaint))
        }
    }
}

/// At most 200 characters, control characters blanked.
fn printable(text: &str) -> String {
    text.chars().take(200).map(|c| if c.is_control() { ' ' } else { c }).collect()
}

fn remedy(kind: RequestKind, error: &RequestError) -> String {
    match (error, kind) {
        (RequestError::System(_), RequestKind::Include) => "names are relative to the file that includes",
        (RequestError::System(_), RequestKind::Execute) => {
            "names are relative to the file that has the statement; the file must be a program"
        }
        (RequestError::Failed { .. }, _) => "run it by itself to see what it lacks",
    }
    .to_string()
}

/// A name as seen from the file that has it.
fn beside(file: &str, name: &str) -> PathBuf {
    plain(&Path::new(file).parent().unwrap_or(Path::new("")).join(name))
}

/// Without `.`, and without `..` behind a folder.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for component in path.components() {
        match component {
            Component::CurDir => {}
            Component::ParentDir if matches!(plain.components().next_back(), Some(Component::Normal(_))) => {
                plain.pop();
            }
            other => plain.push(other),
        }
    }
    plain
}
