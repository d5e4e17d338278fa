//! Replaces `include` statements by the text of files, `execute` statements by the output of
//! programs, and the file name after `-path` by the events in that file.
//!
//! The result is one text, with line marks of the C preprocessor where files begin and continue, so
//! that messages name the original file and line. The caller reads the files and runs the programs;
//! this module does not access the system.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use rustc_hash::FxHashMap;

use ugscene::NAMED_SKIES;

use crate::diagnostic::{Diagnostic, Setting};
use crate::diagnostics::Diagnostics;
use crate::event_table;
use crate::options::{Limit, Options};
use crate::origin::Origin;
use crate::reader;
use crate::refuse_errors;
use crate::request::{Request, RequestError, RequestKind, relative_to, without_dots};
use crate::source::{Images, LineMark, Source};
use crate::statement::RequestStatement;
use crate::statements::statement;
use crate::token::{comment, escape, line_end, word};

/// Replaces `include` statements by the text of files, `execute` statements by the output of
/// programs, the file name after `-path` by the events in that file, and that of a picture or sky
/// by its path from the current folder; the bytes of pictures are kept for the scene. With the
/// feature `cli` it reads a mesh of another format, with the files that it names, and included
/// meshes become statements.
///
/// `load` returns the requested bytes. It is called for a program only with [`Options::execute`],
/// and not for a sky.
/// Names are relative to the file that contains the statement; in a text without a file (`<stdin>`)
/// to the current folder, in the output of a program to the folder of the program. A file contains
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
/// A file that cannot be loaded, or includes itself; a program that fails, or is not allowed to
/// run; syntax errors in a text with such statements. Messages quote a requested text only if it
/// begins like a scene.
pub fn include(
    source: Source,
    options: &Options,
    mut load: impl FnMut(&Request<'_>) -> Result<Vec<u8>, RequestError>,
) -> Result<Source, Diagnostics> {
    #[cfg(feature = "cli")]
    if let Some(format) = ugmeshfile::MeshFormat::detect_mesh(&source.name, &source.text) {
        return crate::mesh::read(source, format, options, load);
    }
    if !may_have_requests(&source) {
        return Ok(source);
    }
    let name = source.name.clone();
    let origin = source.origin.as_ref().map(|origin| Origin::Recorded(origin.words(&source.text)));
    let first = Text::new(source, options)?;
    let path = without_dots(Path::new(&name));
    let mut inclusion = Inclusion {
        options,
        loader: &mut load,
        n_bytes: first.source.text.len() as u64,
        open: vec![(path, first)],
        n_files: 0,
        tables: FxHashMap::default(),
        images: Images::new(),
        n_image_bytes: 0,
        #[cfg(feature = "cli")]
        n_texel_bytes: 0,
        mesh_files: FxHashMap::default(),
        out: Vec::new(),
    };
    inclusion.run()?;
    let Inclusion { out, images, .. } = inclusion;
    Ok(Source { images, ..Source::new(name, out).with_origin(origin) })
}

/// Does one of the keywords occur anywhere in the text? The name of a sky in the current folder
/// stays as it is.
fn may_have_requests(source: &Source) -> bool {
    let text = &source.text[..];
    let is_elsewhere = relative_to(&source.name, "sky") != Path::new("sky");
    let has_word = |word: &str| memchr::memmem::find(text, word.as_bytes()).is_some();
    // Programs write the events of a path in parentheses.
    let names_a_file =
        |at: usize| !matches!(text[at + PATH.len()..].trim_ascii_start(), [b'(' | b'<', ..]);
    ["include", "execute", "c_tex"].into_iter().any(has_word)
        || is_elsewhere && has_word("sky")
        || memchr::memmem::find_iter(text, PATH).any(names_a_file)
}

const PATH: &[u8] = b"-path";

/// The most bytes of the file of a picture.
const MOST_IMAGE_BYTES: u64 = 1 << 28;

/// What messages say about requests of a kind.
struct Words {
    not_replaced: &'static str,
    /// Where it is requested.
    here: &'static str,
    remedy: &'static str,
}

fn words(kind: RequestKind) -> Words {
    match kind {
        RequestKind::Include => Words {
            not_replaced: "files are not included here",
            here: "included here",
            remedy: "names are relative to the file that includes",
        },
        RequestKind::Image | RequestKind::Sky => Words {
            not_replaced: "pictures are not read here",
            here: "read here",
            remedy: "names of pictures are relative to the file that has the statement, or to the current folder in a pipe",
        },
        RequestKind::Path => Words {
            not_replaced: "tables are not read here",
            here: "read here",
            remedy: "names are relative to the file that has the motion",
        },
        RequestKind::Execute => Words {
            not_replaced: "programs are not run here",
            here: "run here",
            remedy: "names are relative to the file that has the statement; the file must be a program",
        },
    }
}

/// The error for a statement in a text that was not passed through [`include`].
pub(crate) fn not_replaced(statement: &RequestStatement) -> Diagnostic {
    let what = if statement.kind == RequestKind::Execute { "a program" } else { "a file" };
    Diagnostic::error(statement.span, words(statement.kind).not_replaced)
        .label(format!("asks for {what}"))
        .help("put its text here, or use a program that reads files")
}

/// A text during copying.
struct Text {
    source: Source,
    statements: Vec<RequestStatement>,
    marks: Vec<LineMark>,
    /// Number of statements replaced so far.
    n_replaced: usize,
    /// Number of bytes copied or replaced so far.
    n_done: usize,
    /// It has a camera of its own.
    #[cfg(feature = "cli")]
    has_camera: bool,
}

impl Text {
    fn new(source: Source, options: &Options) -> Result<Self, Diagnostics> {
        let mut findings = Vec::new();
        let document = reader::read(&source.text, options, &mut findings);
        #[cfg(feature = "cli")]
        let has_camera = document.scopes.iter().any(|scope| !scope.cameras.rows.is_empty());
        let (statements, marks) = (document.requests, document.line_marks);
        refuse_errors(&source, &mut findings)?;
        Ok(Self {
            source,
            statements,
            marks,
            n_replaced: 0,
            n_done: 0,
            #[cfg(feature = "cli")]
            has_camera,
        })
    }
}

struct Inclusion<'i> {
    options: &'i Options,
    loader: &'i mut dyn FnMut(&Request<'_>) -> Result<Vec<u8>, RequestError>,
    /// The open texts and their files, from the scene itself inwards.
    open: Vec<(PathBuf, Text)>,
    n_files: u64,
    /// The name of the first motion along each table of events. Others name that motion.
    tables: FxHashMap<PathBuf, Vec<u8>>,
    /// Bytes of all texts so far, open ones included.
    n_bytes: u64,
    images: Images,
    n_image_bytes: u64,
    /// Bytes of their pixels and mip levels, decoded.
    #[cfg(feature = "cli")]
    n_texel_bytes: u64,
    /// Meshes that pictures are within.
    mesh_files: FxHashMap<PathBuf, Arc<[u8]>>,
    out: Vec<u8>,
}

impl Inclusion<'_> {
    /// Copies the open texts and those they request.
    fn run(&mut self) -> Result<(), Diagnostics> {
        while let Some((_, text)) = self.open.last_mut() {
            let Some(&statement) = text.statements.get(text.n_replaced) else {
                self.out.extend_from_slice(&text.source.text[text.n_done..]);
                self.open.pop();
                self.mark();
                continue;
            };
            self.out
                .extend_from_slice(&text.source.text[text.n_done..statement.span.start as usize]);
            text.n_replaced += 1;
            text.n_done = statement.span.end as usize;
            match statement.kind {
                RequestKind::Path => self.events(statement)?,
                RequestKind::Image => self.image(statement)?,
                RequestKind::Sky => self.sky(statement)?,
                RequestKind::Include | RequestKind::Execute => {
                    let next = self.load(statement)?;
                    self.open.push(next);
                    self.mark();
                }
            }
        }
        Ok(())
    }

    /// Writes the events of a table, in parentheses and on one line, so that the numbers of the
    /// lines that follow stay the same.
    fn events(&mut self, statement: RequestStatement) -> Result<(), Diagnostics> {
        let source = self.source();
        let path = relative_to(&source.name, &source.slice(statement.file));
        if let Some(motion) = self.tables.get(&path) {
            self.out.push(b'<');
            self.out.extend_from_slice(motion);
            self.out.push(b'>');
            return Ok(());
        }
        let motion = statement.motion.map_or(Vec::new(), |motion| motion.of(&source.text).to_vec());
        let (path, text) = self.fetch(statement)?;
        let table =
            Source { mesh: Some(Box::new(None)), ..Source::new(path.display().to_string(), text) };
        let Some(events) = event_table::events(&table)? else {
            let message =
                format!("file `{}` is not a table of events", self.source().slice(statement.file));
            let help =
                "its first line names the columns `t`, `x`, `y` and `z`, with commas between them";
            return Err(self.refused(statement, message, help));
        };
        self.out.extend_from_slice(&events);
        self.tables.insert(path, motion);
        Ok(())
    }

    /// The path of a file that a statement names, from the current folder, as a statement can name
    /// it.
    fn path(&self, statement: RequestStatement) -> Result<(PathBuf, String), Diagnostics> {
        let path = relative_to(&self.source().name, &self.source().slice(statement.file));
        let name = path.to_string_lossy().into_owned();
        if name.contains(['"', '\n']) {
            let message = format!("the path `{name}` has a quotation mark or a line end");
            return Err(self.refused(statement, message, "rename its folder"));
        }
        Ok((path, name))
    }

    /// Writes the path of a sky, unless it has no file.
    fn sky(&mut self, statement: RequestStatement) -> Result<(), Diagnostics> {
        let name = match self.source().slice(statement.file) {
            name if NAMED_SKIES.contains(&&*name) => name.into_owned(),
            _ => self.path(statement)?.1,
        };
        self.out.extend_from_slice(format!("\"{name}\"").as_bytes());
        Ok(())
    }

    /// Writes the path of a picture, whose bytes are kept.
    fn image(&mut self, statement: RequestStatement) -> Result<(), Diagnostics> {
        let (path, name) = self.path(statement)?;
        let key = (name, statement.row);
        if !self.images.contains_key(&key) {
            let file = match self.mesh_files.get(&path) {
                Some(file) => Arc::clone(file),
                None => self.fetch(statement)?.1.into(),
            };
            let picture = self.picture(statement, &file, &path)?;
            if statement.row.is_some() {
                self.mesh_files.insert(path, file);
            }
            self.images.insert(key.clone(), picture);
        }
        self.out.push(b'"');
        self.out.extend_from_slice(key.0.as_bytes());
        self.out.push(b'"');
        Ok(())
    }

    /// The picture that a file is, or that is in a mesh.
    #[cfg(feature = "cli")]
    fn picture(
        &mut self,
        statement: RequestStatement,
        file: &Arc<[u8]>,
        path: &Path,
    ) -> Result<Arc<[u8]>, Diagnostics> {
        let picture = match statement.row {
            Some(row) => {
                let mesh = path.to_string_lossy();
                crate::mesh::picture(&mesh, file, row as usize, &mut *self.loader).map(Arc::from)
            }
            None => Ok(Arc::clone(file)),
        };
        let checked =
            picture.and_then(|picture| Ok((ugmeshfile::check_picture(&picture)?, picture)));
        let (n_bytes, picture) = checked.map_err(|problem| {
            let help = match statement.row {
                Some(_) => "give the number of a picture (PNG or JPEG) of a glTF file, from 0",
                None => "give a picture (PNG, JPEG, HDR, EXR or PFM) of at most 268435456 pixels",
            };
            let message = format!("cannot read `{}`: {problem}", path.display());
            self.refused(statement, message, help)
        })?;
        self.n_texel_bytes = self.n_texel_bytes.saturating_add(n_bytes);
        if self.n_texel_bytes > self.options.limits.get(Limit::Memory) {
            let message = format!(
                "the pixels of `{}` and of all pictures before it are {} bytes with mip levels",
                path.display(),
                self.n_texel_bytes
            );
            return Err(self.limited(statement, &message, Limit::Memory, "make them smaller"));
        }
        Ok(picture)
    }

    #[cfg(not(feature = "cli"))]
    fn picture(
        &mut self,
        _: RequestStatement,
        file: &Arc<[u8]>,
        _: &Path,
    ) -> Result<Arc<[u8]>, Diagnostics> {
        Ok(Arc::clone(file))
    }

    /// The innermost open text.
    fn source(&self) -> &Source {
        &self.open.last().expect("a statement stands in an open text").1.source
    }

    /// An error at a request in the innermost open text.
    fn refused(
        &self,
        statement: RequestStatement,
        message: impl Into<String>,
        help: &str,
    ) -> Diagnostics {
        Diagnostics::one(self.source(), finding(statement, message).help(help))
    }

    /// The same because of a limit.
    fn limited(
        &self,
        statement: RequestStatement,
        message: &str,
        limit: Limit,
        else_do: &str,
    ) -> Diagnostics {
        let limits = &self.options.limits;
        Diagnostics::one(self.source(), finding(statement, message).limited(limits, limit, else_do))
    }

    /// Loads the text requested by a statement of the innermost open text.
    fn load(&mut self, statement: RequestStatement) -> Result<(PathBuf, Text), Diagnostics> {
        let limits = &self.options.limits;
        let source = self.source();
        let shown = source.slice(statement.file);
        if statement.kind == RequestKind::Execute && !self.options.execute {
            let help = "a scene can run any program; if you trust this one, allow it";
            let finding = finding(statement, format!("program `{shown}` is not run")).help(help);
            return Err(Diagnostics::one(source, finding.setting(Setting::Execute)));
        }
        let path = relative_to(&source.name, &shown);
        if self.open.iter().any(|(open, _)| *open == path) {
            let help = "a file must not include itself, directly or through others";
            let message = format!("file `{shown}` includes itself");
            return Err(self.refused(statement, message, help));
        }
        if self.open.len() as u64 > limits.get(Limit::Includes) {
            return Err(self.limited(
                statement,
                "files include each other too deeply",
                Limit::Includes,
                "use fewer",
            ));
        }
        let (path, text) = self.fetch(statement)?;
        let file = Source::new(path.display().to_string(), text);
        #[cfg(feature = "cli")]
        let file = self.statements(file, statement)?;
        // Messages quote lines. Those of a file that is no scene, such as a list of passwords, must
        // not become visible.
        let is_scene = begins_like_a_scene(&file.text);
        let text = Text::new(file, self.options)
            .map_err(|found| if is_scene { found } else { self.not_a_scene(statement) })?;
        Ok((path, text))
    }

    /// The file itself, or the statements of a mesh, which stand for it.
    #[cfg(feature = "cli")]
    fn statements(
        &mut self,
        file: Source,
        statement: RequestStatement,
    ) -> Result<Source, Diagnostics> {
        let Some(format) = ugmeshfile::MeshFormat::detect_mesh(&file.name, &file.text) else {
            return Ok(file);
        };
        let name = file.name.clone();
        let read = crate::mesh::read(file, format, self.options, &mut *self.loader);
        // Errors would quote lines.
        let mesh = read.ok().and_then(|file| (*file.mesh?).map(|mesh| mesh.scene));
        let mut scene = mesh.ok_or_else(|| self.not_a_scene(statement))?;
        if self.open.iter().any(|(_, text)| text.has_camera) {
            // The view is that of the scene, in whatever order the cameras are.
            scene.cameras.clear();
        }
        // Statements name files relative to their own.
        let folder = Path::new(&name).parent().unwrap_or(Path::new(""));
        for file in scene.textures.iter_mut().filter_map(|texture| texture.image.file.as_mut()) {
            if let Ok(beside) = Path::new(file).strip_prefix(folder) {
                *file = beside.to_string_lossy().into_owned();
            }
        }
        let text = crate::write(&scene);
        self.n_bytes = self.n_bytes.saturating_add(text.len() as u64);
        if self.n_bytes > self.options.limits.get(Limit::Text) {
            return Err(self.limited(
                statement,
                "with the statements of this mesh the scene is too large",
                Limit::Text,
                "split it",
            ));
        }
        Ok(Source::new(name, text))
    }

    fn not_a_scene(&self, statement: RequestStatement) -> Diagnostics {
        let shown = self.source().slice(statement.file);
        let is_run = statement.kind == RequestKind::Execute;
        let text = if is_run { "the output of" } else { "file" };
        let help = "it must begin with a statement or a comment, or be a mesh; errors in it are shown if it is read by itself";
        self.refused(statement, format!("{text} `{shown}` is not UniGrafix"), help)
    }

    /// Loads the bytes requested by a statement of the innermost open text.
    fn fetch(&mut self, statement: RequestStatement) -> Result<(PathBuf, Vec<u8>), Diagnostics> {
        self.n_files += 1;
        let limits = &self.options.limits;
        let shown = self.source().slice(statement.file).into_owned();
        let path = relative_to(&self.source().name, &shown);
        if self.n_files > limits.get(Limit::Files) {
            return Err(self.limited(
                statement,
                "too many files are included",
                Limit::Files,
                "include fewer",
            ));
        }
        let is_image = statement.kind == RequestKind::Image;
        let (limit, n_before) = if is_image {
            (Limit::Memory, self.n_image_bytes)
        } else {
            (Limit::Text, self.n_bytes)
        };
        let most = if is_image { MOST_IMAGE_BYTES } else { u64::MAX };
        let room = limits.get(limit).saturating_sub(n_before).min(most);
        let kind = statement.kind;
        let text = (self.loader)(&Request { kind, path: &path, room }).map_err(|error| {
            let remedy = match error {
                RequestError::Failed { .. } => "run it separately to see the error",
                RequestError::System(_) => words(kind).remedy,
            };
            self.refused(statement, complaint(kind, &path, &error), remedy)
        })?;
        if text.len() as u64 > room {
            let what = if is_image { "picture" } else { "text" };
            let message = format!("with the {what} of `{shown}` the scene is too large");
            if room == MOST_IMAGE_BYTES {
                let help = format!(
                    "a file of a picture may have {MOST_IMAGE_BYTES} bytes; make it smaller"
                );
                return Err(self.refused(statement, message, &help));
            }
            return Err(self.limited(statement, &message, limit, "split it"));
        }
        *(if is_image { &mut self.n_image_bytes } else { &mut self.n_bytes }) += text.len() as u64;
        Ok((path, text))
    }

    /// Writes a line mark for the text that follows, if any.
    fn mark(&mut self) {
        let Some((_, Text { source, marks, n_done, .. })) = self.open.last() else { return };
        let (name, line) = source.reported(marks, *n_done as u32);
        // A quote or line end would terminate the name.
        let name = name.replace(['"', '\n', '\r'], "?");
        self.out.extend_from_slice(format!("\n# {line} \"{name}\"\n").as_bytes());
    }
}

/// An error at a request.
fn finding(statement: RequestStatement, message: impl Into<String>) -> Diagnostic {
    Diagnostic::error(statement.file, message).label(words(statement.kind).here)
}

/// What went wrong, for messages, with the beginning of what a program says.
fn complaint(kind: RequestKind, path: &Path, error: &RequestError) -> String {
    let path = path.display();
    match error {
        RequestError::System(error) if kind == RequestKind::Execute => {
            format!("cannot run `{path}`: {error}")
        }
        RequestError::System(error) => format!("cannot read `{path}`: {error}"),
        RequestError::Failed { status, complaint } => {
            let colon = if complaint.is_empty() { "" } else { ": " };
            let beginning: String = complaint.chars().take(200).collect();
            format!("program `{path}` failed with {status}{colon}{beginning}")
        }
    }
}

/// Is the first word after comments, escapes and line marks a keyword?
fn begins_like_a_scene(mut text: &[u8]) -> bool {
    loop {
        text = text.trim_ascii_start();
        let skipped = match text.first() {
            Some(b'{') => comment(text).map(|(rest, _)| rest),
            Some(b'(') => escape(text).map(|(rest, _)| rest),
            Some(b';') => Ok(&text[1..]),
            Some(b'#') if is_line_mark(text) => Ok(&text[line_end(text)..]),
            _ => break,
        };
        match skipped {
            Ok(rest) => text = rest,
            Err(_) => return false,
        }
    }
    word(text).is_ok_and(|(_, word)| statement(word).is_some())
}

fn is_line_mark(text: &[u8]) -> bool {
    let number = text.strip_prefix(b"#line").unwrap_or(&text[1..]).trim_ascii_start();
    number.first().is_some_and(u8::is_ascii_digit)
}
