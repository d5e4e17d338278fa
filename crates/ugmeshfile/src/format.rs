//! Mesh formats and their detection.

use std::fmt;
use std::path::Path;

use serde_json::{Deserializer, Value};

use crate::axes::Axis;
use crate::decode::decode;

/// An input format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshFormat {
    /// UniGrafix.
    Ug,
    /// Wavefront OBJ.
    Obj,
    /// Stanford PLY, ASCII or binary.
    Ply,
    /// STL, ASCII or binary.
    Stl,
    /// Geomview OFF, with its variants COFF, NOFF, STOFF.
    Off,
    /// glTF 2.0, as JSON or as GLB.
    Gltf,
}

impl MeshFormat {
    /// The up axis by the specification or the convention of the format.
    pub fn up(self) -> Axis {
        match self {
            Self::Obj | Self::Gltf => Axis::Y,
            Self::Ug | Self::Ply | Self::Stl | Self::Off => Axis::Z,
        }
    }

    /// Detects the format of `bytes`: by magic number, then by file extension, then by content.
    pub fn detect(name: &str, bytes: &[u8]) -> Option<Self> {
        Self::by_magic(bytes).or_else(|| Self::by_ending(name)).or_else(|| Self::by_looks(bytes))
    }

    /// Detects a mesh among scenes, which may have any name but that of a glTF file: by magic
    /// number or, in a text whose beginning has no `;`, as [`MeshFormat::detect`] does. Statements
    /// of scenes end with one. JSON is never a scene.
    pub fn detect_mesh(name: &str, bytes: &[u8]) -> Option<Self> {
        /// Number of bytes in which a scene has the end of a statement.
        const FEW: usize = 4096;
        let start = &bytes[..bytes.len().min(FEW)];
        let mut lines = start.split(|&byte| byte == b'\n').filter(|line| !line.starts_with(b"#"));
        let has_statement = lines.any(|line| line.contains(&b';'));
        let ending = Self::by_ending(name);
        let format = Self::by_magic(bytes).or_else(|| match (ending, Self::by_looks(bytes)) {
            (Some(Self::Gltf), _) => ending,
            (_, Some(looks @ (Self::Gltf | Self::Ug))) => Some(looks),
            (_, looks) if looks == ending => ending,
            _ if has_statement && !is_binary_stl(bytes) => None,
            (_, looks) => ending.or(looks),
        });
        format.filter(|format| *format != Self::Ug)
    }

    fn by_magic(bytes: &[u8]) -> Option<Self> {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        if bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r") {
            Some(Self::Ply)
        } else if bytes.starts_with(b"glTF") {
            Some(Self::Gltf)
        } else {
            None
        }
    }

    fn by_ending(name: &str) -> Option<Self> {
        match Path::new(name).extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "ug" => Some(Self::Ug),
            "obj" => Some(Self::Obj),
            "ply" => Some(Self::Ply),
            "stl" => Some(Self::Stl),
            "off" | "coff" | "noff" => Some(Self::Off),
            "gltf" | "glb" => Some(Self::Gltf),
            _ => None,
        }
    }

    fn by_looks(bytes: &[u8]) -> Option<Self> {
        if is_binary_stl(bytes) {
            return Some(Self::Stl);
        }
        let text = decode(&bytes[..bytes.len().min(PEEK)]);
        let text = text.trim_start();
        if let Some(inside) = text.strip_prefix('{') {
            // A JSON object begins with a quoted key, a UniGrafix comment with any text.
            let may_be_json = inside.trim_start().starts_with('"');
            return Some(if may_be_json && is_json(bytes) { Self::Gltf } else { Self::Ug });
        }
        let line =
            text.lines().map(str::trim).find(|line| !line.is_empty() && !line.starts_with('#'))?;
        let mut words = line.split_whitespace();
        let first = words.next()?;
        if first.eq_ignore_ascii_case("solid") {
            Some(Self::Stl)
        } else if off_keyword(first).is_some() {
            Some(Self::Off)
        } else if is_obj_line(line) {
            Some(Self::Obj)
        } else if UG_KEYWORDS.contains(&first) || line.starts_with('(') {
            Some(Self::Ug)
        } else {
            None
        }
    }
}

/// Number of bytes that are examined: some exporters write long comments at the head.
const PEEK: usize = 1 << 16;

/// True for JSON, complete or cut off: a scene may begin with a comment in braces that is JSON, but
/// statements follow it.
fn is_json(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut values = Deserializer::from_slice(bytes).into_iter::<Value>();
    match values.next() {
        Some(Ok(_)) => bytes[values.byte_offset()..].trim_ascii().is_empty(),
        Some(Err(error)) if error.is_eof() => true,
        // Some exporters write `NaN`, which JSON does not have.
        _ => bytes.windows(ASSET.len()).any(|window| window == ASSET),
    }
}

/// The key that every glTF document has.
const ASSET: &[u8] = b"\"asset\"";

/// The keywords of scenes; a test of `ugparse` finds missing ones.
const UG_KEYWORDS: [&str; 29] = [
    "v", "w", "label", "f", "sphere", "cylinder", "tube", "disc", "c", "c_rgb", "c_xyz", "c_bb",
    "c_spd", "c_refl", "c_mix", "c_time", "c_tex", "c_emit", "surf", "l", "cam", "motion", "sky",
    "def", "end", "i", "a", "include", "execute",
];

/// True for binary STL. It has no magic number, and its header may even begin with `solid`, but its
/// length is determined by its triangle count.
pub(crate) fn is_binary_stl(bytes: &[u8]) -> bool {
    let count = bytes.get(80..84).and_then(|count| count.try_into().ok()).map(u32::from_le_bytes);
    count.is_some_and(|count| bytes.len() as u64 == 84 + 50 * u64::from(count))
}

/// `OFF` with any of its prefixes (texture, colour, normal, 4-D, n-D), and a number that follows it
/// without a blank, as in many files of ModelNet.
pub(crate) fn off_keyword(word: &str) -> Option<(&str, &str)> {
    let end = word.find("OFF")? + 3;
    let (keyword, glued) = word.split_at(end);
    let prefix = &keyword[..end - 3];
    let prefix = prefix.strip_prefix("ST").unwrap_or(prefix);
    let prefix = prefix.strip_prefix('C').unwrap_or(prefix);
    let prefix = prefix.strip_prefix('N').unwrap_or(prefix);
    let prefix = prefix.strip_prefix('4').unwrap_or(prefix);
    (matches!(prefix, "" | "n") && glued.bytes().all(|byte| byte.is_ascii_digit()))
        .then_some((keyword, glued))
}

/// True for a line of OBJ. It shares `v` and `f` with UniGrafix, but UniGrafix statements end with
/// `;` and its vertices have names.
fn is_obj_line(line: &str) -> bool {
    if line.contains([';', '{', '(']) {
        return false;
    }
    let mut words = line.split_whitespace();
    match words.next() {
        Some("mtllib" | "usemtl" | "o" | "g" | "s" | "vn" | "vt" | "vp") => true,
        Some("v") => words.clone().count() >= 3 && words.all(|word| word.parse::<f64>().is_ok()),
        _ => false,
    }
}

impl fmt::Display for MeshFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Ug => "UniGrafix",
            Self::Obj => "OBJ",
            Self::Ply => "PLY",
            Self::Stl => "STL",
            Self::Off => "OFF",
            Self::Gltf => "glTF",
        })
    }
}
