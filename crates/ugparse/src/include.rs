//! `include`: the text of other files in place of the statements that name them.
//!
//! The outcome is one text, with lines of the C preprocessor where files begin
//! and go on, so that messages name the file and line where something was written.

use std::io;
use std::path::{Component, Path, PathBuf};

use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::parts::read_all;
use crate::reader::Include;
use crate::source::{LineMark, Source};
use crate::{MAX_TEXT, Options, refuse_errors};

/// How deep files may include files.
const MAX_DEPTH: usize = 64;

/// How many files a scene may include in all, counted as often as they are.
const MAX_FILES: usize = 10_000;

/// Puts the files that a scene includes in place of its `include` statements.
///
/// `load` gives the bytes of a file. Names are relative to the file that
/// includes; those in a text without a file (`<stdin>`) to the current folder.
/// A file holds whole statements: a definition that begins in it ends in it.
///
/// ```
/// let scene = ugparse::Source::new("house/scene.ug", "include colors.ug ; v a 0 0 0 red ;");
/// let whole = ugparse::include(scene, &ugparse::Options::default(), |path| {
///     assert_eq!(path, std::path::Path::new("house/colors.ug"));
///     Ok(b"c red 1 0 ;".to_vec())
/// })?;
/// assert_eq!(ugparse::parse(&whole, &ugparse::Options::default())?.scene.colors.len(), 1);
/// # Ok::<(), ugparse::Diagnostics>(())
/// ```
///
/// # Errors
/// A file that cannot be loaded, or includes itself; what is wrong with the
/// statements of a text that includes others.
pub fn include(
    source: Source,
    options: &Options,
    mut load: impl FnMut(&Path) -> io::Result<Vec<u8>>,
) -> Result<Source, Diagnostics> {
    if !may_include(&source.text) {
        return Ok(source);
    }
    let open = vec![plain(Path::new(&source.name))];
    let mut inclusion = Inclusion { options, load: &mut load, open, n_files: 0, out: Vec::new() };
    inclusion.text(&source)?;
    Ok(Source { name: source.name, text: inclusion.out })
}

/// True if the word occurs anywhere.
fn may_include(text: &[u8]) -> bool {
    memchr::memmem::find(text, b"include").is_some()
}

/// An `include` that nobody has followed.
pub(crate) fn not_followed(include: &Include) -> Diagnostic {
    Diagnostic::error(include.span, "files are not included here")
        .label("asks for a file")
        .help("put its text here, or use a program that reads files")
}

struct Inclusion<'i> {
    options: &'i Options,
    load: &'i mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
    /// The files we are in, the scene's own first.
    open: Vec<PathBuf>,
    n_files: usize,
    out: Vec<u8>,
}

impl Inclusion<'_> {
    /// Appends a text and what it includes.
    fn text(&mut self, source: &Source) -> Result<(), Diagnostics> {
        let mut findings = Vec::new();
        let document = read_all(&source.text, self.options.lax, &mut findings);
        refuse_errors(source, &mut findings)?;
        let mut done = 0;
        for include in &document.includes {
            self.out.extend_from_slice(&source.text[done..include.span.start as usize]);
            done = include.span.end as usize;
            self.file(source, include)?;
            self.mark(source, &document.line_marks, include.span.end);
        }
        self.out.extend_from_slice(&source.text[done..]);
        Ok(())
    }

    /// Appends an included file.
    fn file(&mut self, source: &Source, include: &Include) -> Result<(), Diagnostics> {
        let refuse = |message: String, help: &str| {
            let finding = Diagnostic::error(include.file, message).label("included here").help(help);
            Diagnostics::one(source, finding)
        };
        let shown = source.slice(include.file);
        let path = beside(&source.name, &shown);
        if self.open.contains(&path) {
            return Err(refuse(
                format!("file `{shown}` includes itself"),
                "a file may not include itself, directly or through others",
            ));
        }
        self.n_files += 1;
        if self.open.len() > MAX_DEPTH {
            return Err(refuse("files include each other too deeply".into(), "the limit is 64 levels"));
        }
        if self.n_files > MAX_FILES || self.out.len() > MAX_TEXT {
            return Err(refuse("too many files are included".into(), "the limits are 10000 files and 4 GiB"));
        }
        let text = (self.load)(&path).map_err(|error| {
            refuse(
                format!("cannot read `{}`: {error}", path.display()),
                "names are relative to the file that includes",
            )
        })?;
        let file = Source { name: path.display().to_string(), text };
        self.open.push(path);
        self.mark(&file, &[], 0);
        self.text(&file)?;
        self.open.pop();
        Ok(())
    }

    /// Says that what follows is `source` from `position` on.
    fn mark(&mut self, source: &Source, marks: &[LineMark], position: u32) {
        let (name, line) = source.reported(marks, position);
        // A quote or line end would end the name.
        let name = name.replace(['"', '\n'], "?");
        self.out.extend_from_slice(format!("\n# {line} \"{name}\"\n").as_bytes());
    }
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
