//! Meshes of other programs in the place of a scene.

use std::cell::RefCell;
use std::io;
use std::path::Path;

use ugmeshfile::{Lines, MeshFormat, MeshScene, Problem};

use crate::diagnostic::Diagnostic;
use crate::diagnostics::Diagnostics;
use crate::expand::Origins;
use crate::options::{Limit, Options};
use crate::request::{Request, RequestError, RequestKind, name_pictures};
use crate::source::{Source, Span};
use crate::{Parsed, check_length};

/// Reads the mesh in a source as a scene with z as the up axis. `load` reads the files that it
/// names, as those of [`crate::include`].
pub(crate) fn read(
    mut source: Source,
    format: MeshFormat,
    options: &Options,
    load: impl FnMut(&Request<'_>) -> Result<Vec<u8>, RequestError>,
) -> Result<Source, Diagnostics> {
    source.mesh = Some(Box::new(None));
    check_length(&source, options)?;
    let load = RefCell::new(load);
    let read_file =
        |name: &str, limit: u64| beside(&source.name, name, limit, &mut *load.borrow_mut());
    let memory = options.limits.get(Limit::Memory);
    let mesh = ugmeshfile::read_within(format, &source.text, &read_file, "", memory)
        .map_err(|problem| Diagnostics::one(&source, malformed(&source, format, problem)))?;
    source.mesh = Some(Box::new(Some(parsed(&source, format, mesh))));
    Ok(source)
}

/// The bytes of a picture that a scene names by a mesh and a row. `load`: as for [`read`].
pub(crate) fn picture(
    mesh: &str,
    bytes: &[u8],
    row: usize,
    load: impl FnMut(&Request<'_>) -> Result<Vec<u8>, RequestError>,
) -> Result<Vec<u8>, String> {
    let load = RefCell::new(load);
    let read_file = |name: &str, limit: u64| beside(mesh, name, limit, &mut *load.borrow_mut());
    ugmeshfile::picture_within(bytes, row, &read_file)
}

/// Loads a file in the folder of the mesh. A mesh from a pipe has no folder.
fn beside(
    mesh: &str,
    name: &str,
    limit: u64,
    load: &mut dyn FnMut(&Request<'_>) -> Result<Vec<u8>, RequestError>,
) -> io::Result<Vec<u8>> {
    if mesh.starts_with('<') {
        return Err(io::Error::other(
            "standard input has no folder; name the mesh on the command line",
        ));
    }
    let path = Path::new(mesh).parent().unwrap_or(Path::new("")).join(name);
    // One byte more than the room is read.
    let request =
        Request { kind: RequestKind::Include, path: &path, room: limit.saturating_sub(1) };
    load(&request).map_err(|error| match error {
        RequestError::System(error) => error,
        RequestError::Failed { status, .. } => io::Error::other(status),
    })
}

fn malformed(source: &Source, format: MeshFormat, Problem { line, what }: Problem) -> Diagnostic {
    let lines = LineSpans::new(&source.text);
    let span =
        line.map_or(Span::WHOLE_FILE, |line| lines.span(u32::try_from(line).unwrap_or(u32::MAX)));
    Diagnostic::error(span, format!("cannot read this as {format}: {what}"))
}

fn parsed(source: &Source, format: MeshFormat, mesh: MeshScene) -> Parsed {
    let origins = origins(source, &mesh.lines);
    let warnings =
        mesh.warnings.iter().map(|warning| Diagnostic::warning(Span::WHOLE_FILE, warning.clone()));
    let notes = mesh.notes.iter().map(|note| Diagnostic::note(Span::WHOLE_FILE, note.clone()));
    let findings = warnings.chain(notes).collect();
    let mut scene = mesh.z_up(format.up());
    name_pictures(&mut scene, &source.name);
    Parsed::new(source, scene, origins, findings)
}

fn origins(source: &Source, lines: &Lines) -> Origins {
    let spans = LineSpans::new(&source.text);
    let of = |lines: &[u32]| lines.iter().map(|&line| spans.span(line)).collect();
    Origins { vertices: of(&lines.vertices), faces: of(&lines.faces), ..Origins::default() }
}

/// The spans of the lines of a text, which end as [`ugmeshfile`] counts them: with LF, CR or both.
struct LineSpans<'t> {
    text: &'t [u8],
    starts: Vec<u32>,
}

impl<'t> LineSpans<'t> {
    fn new(text: &'t [u8]) -> Self {
        let is_end = |idx: usize| {
            text[idx] == b'\n' || (text[idx] == b'\r' && text.get(idx + 1) != Some(&b'\n'))
        };
        let ends = memchr::memchr2_iter(b'\n', b'\r', text).filter(|&idx| is_end(idx));
        Self { text, starts: std::iter::once(0).chain(ends.map(|idx| idx as u32 + 1)).collect() }
    }

    /// The span of a line, counted from 1, without its end; empty at the beginning of the text for
    /// others.
    fn span(&self, line: u32) -> Span {
        let row = (line as usize).wrapping_sub(1);
        let Some(&start) = self.starts.get(row) else { return Span::default() };
        let end = self.starts.get(row + 1).map_or(self.text.len(), |&next| next as usize - 1);
        let line = &self.text[start as usize..end.max(start as usize)];
        Span { start, end: start + line.trim_ascii_end().len() as u32 }
    }
}
