//! Files that are neither a scene nor a mesh, whatever their names say.

use std::fmt;
use std::path::Path;

use ugimage::{ForeignKind, foreign_kind};
use ugpipe::remedies;

/// Data that are neither a scene nor a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Foreign {
    /// Another kind than the following ones.
    Other(ForeignKind),
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
            Self::Other(kind) => [kind.what, kind.remedy],
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
            "3ds" | "3mf" | "abc" | "blend" | "bpt" | "c4d" | "dae" | "dxf" | "fbx" | "iges"
            | "igs" | "lwo" | "ma" | "max" | "mb" | "pbrt" | "pov" | "skp" | "step" | "stp"
            | "usd" | "usda" | "usdc" | "usdz" | "wrl" | "x3d" => Some(Foreign::Model),
            "csv" | "tsv" => Some(Foreign::Table),
            _ => None,
        }
    })
}

/// The kind of data by their first bytes.
pub(crate) fn by_content(bytes: &[u8]) -> Option<Foreign> {
    let begins = |words: &[&[u8]]| words.iter().any(|word| bytes.starts_with(word));
    if let Some(kind) = foreign_kind(bytes) {
        Some(if kind.is_picture { Foreign::Picture } else { Foreign::Other(kind) })
    } else if begins(&[b"\x89PNG", b"\xff\xd8\xff", b"P6", b"PF", b"%!PS", b"<svg"])
        || begins(&[b"\x76\x2f\x31\x01", b"#?RADIANCE"])
    {
        Some(Foreign::Picture)
    } else {
        begins(&[b"Kaydara FBX", b"BLENDER", b"ISO-10303"]).then_some(Foreign::Model)
    }
}
