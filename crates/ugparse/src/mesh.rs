//! Meshes of other programs in the place of a scene.

use std::cell::RefCell;
use std::io;
use std::path::Path;

use ugmeshfile::{Lines, MeshFormat, MeshScene, Problem};
use ugscene::Scene;

use crate::diagnostic::Diagnostic;
use crate::diagnostics::Diagnostics;
use crate::expand::Origins;
use crate::options::Options;
use crate::request::{Request, RequestError, RequestKind};
use crate::source::{Source, Span};
use crate::{Parsed, check_length, flatness};

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
    let read_file = |name: &str, limit: u64| beside(&source, name, limit, &mut *load.borrow_mut());
    let mesh = ugmeshfile::read(format, &source.text, &read_file, "")
        .map_err(|problem| Diagnostics::one(&source, malformed(&source, format, problem)))?;
    source.mesh = Some(Box::new(Some(parsed(&source, format, mesh))));
    Ok(source)
}

/// Loads a file in the folder of the mesh. A mesh from a pipe has no folder.
fn beside(
    source: &Source,
    name: &str,
    limit: u64,
    load: &mut dyn FnMut(&Request<'_>) -> Result<Vec<u8>, RequestError>,
) -> io::Result<Vec<u8>> {
    if source.name.starts_with('<') {
        return Err(io::Error::other("standard input has no folder; name the mesh on the command line"));
    }
    let path = Path::new(&source.name).parent().unwrap_or(Path::new("")).join(name);
    // One byte more than the room is read.
    let request = Request { kind: RequestKind::Include, path: &path, room: limit.saturating_sub(1) };
    load(&request).map_err(|error| match error {
        RequestError::System(error) => error,
        RequestError::Failed { status, .. } => io::Error::other(status),
    })
}

fn malformed(source: &Source, format: MeshFormat, Problem { line, what }: Problem) -> Diagnostic {
    let lines = LineSpans::new(&source.text);
    let span = line.map_or(Span::WHOLE_FILE, |line| lines.span(u32::try_from(line).unwrap_or(u32::MAX)));
    Diagnostic::error(span, format!("cannot read this as {format}: {what}"))
}

fn parsed(source: &Source, format: MeshFormat, mesh: MeshScene) -> Parsed {
    let origins = origins(source, &mesh.lines);
    let mut findings: Vec<Diagnostic> =
        mesh.warnings.iter().map(|warning| Diagnostic::warning(Span::WHOLE_FILE, warning.clone())).collect();
    let scene: Scene = mesh.z_up(format.up());
    let bent = ugscene::bent_faces(&scene);
    findings.extend(flatness::warning(source, &origins, &bent));
    Parsed { scene, origins, bent, warnings: Diagnostics::new(source, findings) }
}

fn origins(source: &Source, lines: &Lines) -> Origins {
    let spans = LineSpans::new(&source.text);
    let of = |lines: &[u32]| lines.iter().map(|&line| spans.span(line)).collect();
    Origins { vertices: of(&lines.vertices), faces: of(&lines.faces), cameras: Vec::new() }
}

/// The spans of the lines of a text, which end as [`ugmeshfile`] counts them: with LF, CR or both.
struct LineSpans<'t> {
    text: &'t [u8],
    starts: Vec<u32>,
}

impl<'t> LineSpans<'t> {
    fn new(text: &'t [u8]) -> Self {
        let is_end =
            |idx: usize| text[idx] == b'\n' || (text[idx] == b'\r' && text.get(idx + 1) != Some(&b'\n'));
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

#[cfg(test)]
mod tests {
    use super::*;

    fn read_text(name: &str, text: &str) -> Result<Parsed, Diagnostics> {
        let options = Options::default();
        let source = crate::include(Source::new(name, text), &options, |request| {
            assert_eq!(request.path, Path::new("folder/a.mtl"));
            Ok(b"newmtl red\nKd 1 0 0\n".to_vec())
        })?;
        crate::parse(&source, &options)
    }

    const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";

    #[test]
    fn a_mesh_is_a_scene() {
        let text = format!("mtllib a.mtl\n{SQUARE}v 0 1 0\nusemtl red\nf 1 2 3 4\n");
        let parsed = read_text("folder/square.obj", &text).unwrap();
        assert!(parsed.warnings.is_empty(), "{}", parsed.warnings);
        let out = String::from_utf8(crate::write(&parsed.scene)).unwrap();
        assert!(out.contains("c_rgb red 1 0 0;") && out.contains("v v3 1 0 1;"), "{out}");
        assert!(out.ends_with("f (v1 v2 v3 v4) red;\n"), "{out}");
    }

    #[test]
    fn messages_have_the_lines_of_the_mesh() {
        let check = |text: &str, expected: &str| {
            let shown = match read_text("square.obj", text) {
                Ok(parsed) => parsed.warnings.to_string(),
                Err(findings) => findings.to_string(),
            };
            // The carriage return is shown as a blank.
            assert_eq!(shown.replace(" \n", "\n"), expected);
        };
        for end in ["\n", "\r\n"] {
            let bent = format!("{SQUARE}v 0 1 .5\nf 1 2 3\nf 1 2 3 4\n").replace('\n', end);
            check(
                &bent,
                "warning: face is not flat\n --> square.obj:6:1\n  |\n6 | f 1 2 3 4\n  | ^ a corner is off by 7.9e-2 of its size\n  |\n\
                 help: cut it into triangles: it is drawn as triangles, perhaps not as those that are meant",
            );
        }
        check(
            &format!("{SQUARE}f 1 2 7\n"),
            "error: cannot read this as OBJ: a face refers to vertex `7`, but there are 3 before it\n \
             --> square.obj:4:1\n  |\n4 | f 1 2 7\n  | ^^^^^^^",
        );
        check("# 7 \"other\"\nv 0 0 0\n", "warning: the mesh has no faces\n--> square.obj");
    }
}
