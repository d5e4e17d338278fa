//! Inputs that are not scenes at all: one error says so, in place of one for each of their words.

use std::path::Path;

use ugpipe::remedies;

use crate::diagnostic::Diagnostic;
use crate::source::{Source, Span};

/// The error for a text that is not UniGrafix, by its first bytes or the extension of its name.
/// Call it only for texts with errors: a scene may have any name.
pub(crate) fn error(source: &Source) -> Option<Diagnostic> {
    let text = source.text.as_slice();
    let begins = |words: &[&[u8]]| words.iter().any(|word| text.starts_with(word));
    let (what, help) = if begins(&[b"\xff\xfe", b"\xfe\xff"]) {
        ("UTF-16 text", "save it as UTF-8 or ASCII")
    } else if begins(&[b"\xef\xbb\xbf"]) {
        ("text with a byte order mark", "save it as UTF-8 without the mark")
    } else if begins(&[b"\x1f\x8b", b"PK\x03\x04", b"\xfd7zXZ", b"\x28\xb5\x2f\xfd", b"BZh"]) {
        ("compressed data", "decompress it first")
    } else if begins(&[
        b"\x89PNG",
        b"P6",
        b"PF",
        b"%PDF",
        b"%!PS",
        b"<svg",
        b"\x76\x2f\x31\x01",
        b"#?RADIANCE",
    ]) {
        ("a picture", "give the scene that it was drawn from")
    } else if begins(&[b"ply\n", b"ply\r", b"glTF", b"OFF", b"solid "]) || has_mesh_extension(source) {
        ("a mesh", remedies::CONVERT_MESH)
    } else {
        return None;
    };
    Some(Diagnostic::error(Span::default(), format!("this is not a UniGrafix scene but {what}")).help(help))
}

fn has_mesh_extension(source: &Source) -> bool {
    const EXTENSIONS: [&str; 6] = ["obj", "ply", "stl", "off", "gltf", "glb"];
    /// Number of bytes in which a scene has the end of a statement, and a mesh has none.
    const PEEK: usize = 4096;
    if source.text[..source.text.len().min(PEEK)].contains(&b';') {
        return false;
    }
    let extension = Path::new(&source.name).extension().map(|extension| extension.to_ascii_lowercase());
    extension.is_some_and(|extension| EXTENSIONS.iter().any(|&known| extension == known))
}
