//! Files that are neither a scene nor a mesh, whatever their names say.

use std::fmt;
use std::path::Path;

use ugpipe::remedies;

/// Data that are neither a scene nor a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Foreign {
    /// Text of two bytes per character.
    Utf16,
    /// An archive or a compressed file.
    Compressed,
    /// What Git LFS leaves in the place of a file that was not fetched.
    GitLfs,
    /// A web page, as servers send in the place of a file.
    WebPage,
    /// A picture.
    Picture,
    /// A mesh or scene in a format that no program reads.
    Model,
    /// Numbers in lines, separated by commas.
    Table,
}

impl Foreign {
    /// What to do with such a file in the place of a mesh.
    pub fn remedy(self) -> &'static str {
        self.words()[1]
    }

    /// What it is, and the remedy.
    fn words(self) -> [&'static str; 2] {
        match self {
            Self::Utf16 => ["UTF-16 text", "save it as UTF-8 or ASCII"],
            Self::Compressed => ["compressed data", "decompress it first"],
            Self::GitLfs => ["a Git LFS pointer", "fetch the file itself with `git lfs pull`"],
            Self::WebPage => ["a web page", "download the file itself"],
            Self::Picture => ["a picture", "name a mesh"],
            Self::Model => ["a model in a format that is not read", remedies::EXPORT_MESH],
            Self::Table => ["a table", "name a mesh"],
        }
    }
}

impl fmt::Display for Foreign {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.words()[0])
    }
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

/// The kind of data by their first bytes.
pub(crate) fn by_content(bytes: &[u8]) -> Option<Foreign> {
    let begins = |words: &[&[u8]]| words.iter().any(|word| bytes.starts_with(word));
    let start = bytes.trim_ascii_start();
    let is_page = [&b"<!doctype html"[..], b"<html"]
        .iter()
        .any(|word| start.get(..word.len()).is_some_and(|start| start.eq_ignore_ascii_case(word)));
    if begins(&[b"\xff\xfe", b"\xfe\xff"]) {
        Some(Foreign::Utf16)
    } else if begins(&[b"version https://git-lfs.github.com/spec/"]) {
        Some(Foreign::GitLfs)
    } else if is_page {
        Some(Foreign::WebPage)
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
