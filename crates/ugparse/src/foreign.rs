//! Inputs that are not scenes at all: one error says so, in place of one for each of their words.

use std::path::Path;

#[cfg(feature = "report")]
use crate::{Diagnostic, Source, Span};

/// The error for a text that is not UniGrafix, by its first bytes or the extension of its name.
/// Call it only for texts with errors: a scene may have any name.
#[cfg(feature = "report")]
pub(crate) fn error(source: &Source) -> Option<Diagnostic> {
    use ugpipe::remedies;
    let file = Some(&*source.name).filter(|name| !name.starts_with('<'));
    let (what, help) = match foreign_data(&source.name, &source.text) {
        Some(Foreign::Utf16) => ("UTF-16 text", "save it as UTF-8 or ASCII".to_owned()),
        Some(Foreign::ByteOrderMark) => {
            ("text with a byte order mark", "save it as UTF-8 without the mark".to_owned())
        }
        Some(Foreign::Compressed) => ("compressed data", "decompress it first".to_owned()),
        Some(Foreign::Picture) => ("a picture", remedies::picture_is_complete(file)),
        Some(Foreign::Model) => ("a model in a format that is not read", remedies::EXPORT_MESH.to_owned()),
        Some(Foreign::Table) => ("a table", remedies::draw_stars(file)),
        #[cfg(feature = "cli")]
        None if ugmeshfile::MeshFormat::detect_mesh(&source.name, &source.text).is_some() => {
            ("a mesh", remedies::convert_mesh(file))
        }
        None => return None,
    };
    Some(Diagnostic::error(Span::default(), format!("this is not a UniGrafix scene but {what}")).help(help))
}

/// Data that are neither a scene nor a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Foreign {
    /// Text of two bytes per character.
    Utf16,
    /// Text that begins with the byte order mark of UTF-8.
    ByteOrderMark,
    /// An archive or a compressed file.
    Compressed,
    /// A picture.
    Picture,
    /// A mesh or scene in a format that no program reads.
    Model,
    /// Numbers in lines, separated by commas.
    Table,
}

/// The kind of data that are neither a scene nor a mesh, by their first bytes, or else by the
/// extension of the name.
pub fn foreign_data(name: &str, bytes: &[u8]) -> Option<Foreign> {
    by_content(bytes).or_else(|| {
        let extension = Path::new(name).extension()?.to_str()?.to_ascii_lowercase();
        match extension.as_str() {
            "3ds" | "3mf" | "abc" | "blend" | "bpt" | "c4d" | "dae" | "dxf" | "fbx" | "iges" | "igs"
            | "lwo" | "ma" | "max" | "mb" | "pbrt" | "pov" | "skp" | "step" | "stp" | "usd" | "usda"
            | "usdc" | "usdz" | "wrl" | "x3d" => Some(Foreign::Model),
            "csv" | "tsv" => Some(Foreign::Table),
            _ => None,
        }
    })
}

fn by_content(bytes: &[u8]) -> Option<Foreign> {
    let begins = |words: &[&[u8]]| words.iter().any(|word| bytes.starts_with(word));
    if begins(&[b"\xff\xfe", b"\xfe\xff"]) {
        Some(Foreign::Utf16)
    } else if begins(&[b"\xef\xbb\xbf"]) {
        Some(Foreign::ByteOrderMark)
    } else if begins(&[b"\x1f\x8b", b"PK\x03\x04", b"\xfd7zXZ", b"\x28\xb5\x2f\xfd", b"BZh"]) {
        Some(Foreign::Compressed)
    } else if begins(&[b"\x89PNG", b"\xff\xd8\xff", b"GIF8", b"P6", b"PF", b"%PDF", b"%!PS", b"<svg"])
        || begins(&[b"\x76\x2f\x31\x01", b"#?RADIANCE"])
    {
        Some(Foreign::Picture)
    } else if begins(&[b"Kaydara FBX", b"BLENDER", b"ISO-10303"]) {
        Some(Foreign::Model)
    } else {
        None
    }
}
