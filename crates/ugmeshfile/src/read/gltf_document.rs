//! glTF 2.0 documents. Only what is read has to be valid, since exporters write much that Khronos'
//! validator accepts and a full data model refuses.

use std::borrow::Cow;

use serde_json::Value;
use ugscene::shorten;

use crate::error::Problem;

/// The JSON of a file, of which what is not read may be anything.
pub(super) struct Document(pub Value);

/// Beginnings of the names of extensions that a file may require: they do not affect the geometry.
const HARMLESS: [&str; 8] = [
    "EXT_mesh_gpu_instancing",
    "KHR_lights_punctual",
    "KHR_materials_",
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "KHR_texture_",
    "EXT_texture_",
    "MSFT_texture_",
];

/// Extensions that are read.
const READ: [&str; 9] = [
    "EXT_mesh_gpu_instancing",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "KHR_texture_transform",
    // Told with its texture, which has a picture of another kind or none.
    "EXT_texture_webp",
];

/// The most extensions that are named in a warning.
const MOST_NAMED: usize = 12;

impl Document {
    /// Parses the JSON text of a file.
    pub fn parse(json: &[u8]) -> Result<Self, Problem> {
        let document: Value =
            serde_json::from_slice(json).map_err(|error| Problem::new(error.to_string()))?;
        let asset = &document["asset"];
        let stated = |name: &str| asset[name].as_str();
        let version = stated("minVersion").or(stated("version"));
        let version = version.ok_or_else(|| {
            Problem::new("this is JSON, but not a glTF document: it has no `asset` with a version")
        })?;
        if version.split('.').next() != Some("2") {
            return Err(not_two(version));
        }
        let required = document["extensionsRequired"]
            .as_array()
            .into_iter()
            .flatten()
            .filter_map(Value::as_str);
        let mut unknown =
            required.filter(|name| !HARMLESS.iter().any(|known| name.starts_with(known)));
        match unknown.next().map(shorten) {
            None => Ok(Self(document)),
            Some(name) => {
                let compression = ["draco", "meshopt"].into_iter().find(|kind| name.contains(kind));
                Err(Problem::new(match compression {
                    Some(kind) => {
                        format!("the mesh has {kind} compression ({name}); export without it")
                    }
                    None => {
                        format!("the mesh requires `{name}`, which is not read; export without it")
                    }
                }))
            }
        }
    }

    /// The extensions that the file uses and that are not read.
    pub fn unread_extensions(&self) -> Vec<String> {
        let used = self.0["extensionsUsed"].as_array().into_iter().flatten();
        let unread = used.filter_map(Value::as_str).filter(|name| !READ.contains(name));
        unread.take(MOST_NAMED).map(shorten).map(|name| format!("`{name}`")).collect()
    }

    /// The rows of a table.
    pub fn table(&self, name: &str) -> &[Value] {
        self.0[name].as_array().map_or(&[], Vec::as_slice)
    }

    /// The row of a table with an index of the file.
    pub fn row(&self, table: &str, index: usize) -> Result<&Value, Problem> {
        let none =
            || Problem::new(format!("`{table}[{index}]` does not exist; export the mesh again"));
        self.table(table).get(index).ok_or_else(none)
    }

    /// The bytes of a buffer view.
    pub fn view<'b>(&self, index: usize, buffers: &'b [Cow<'_, [u8]>]) -> Option<&'b [u8]> {
        let view = self.table("bufferViews").get(index)?;
        let start = whole(&view["byteOffset"]).unwrap_or(0);
        let end = start.checked_add(whole(&view["byteLength"])?)?;
        buffers.get(whole(&view["buffer"])?)?.get(start..end)
    }
}

/// An index or a count, which some exporters write with a decimal point.
pub(super) fn whole(value: &Value) -> Option<usize> {
    let number = value.as_f64()?;
    Some(number as usize).filter(|&whole| whole as f64 == number)
}

/// Numbers of an array.
pub(super) fn numbers<const N: usize>(value: &Value) -> Option<[f64; N]> {
    let numbers: Option<Vec<f64>> = value.as_array()?.iter().map(Value::as_f64).collect();
    numbers?.try_into().ok()
}

fn not_two(version: &str) -> Problem {
    Problem::new(format!("glTF {} is not read; convert the mesh to glTF 2.0", shorten(version)))
}

/// The JSON text of a file and, of GLB, its binary chunk.
pub(super) fn split(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), Problem> {
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), None));
    }
    let truncated = || Problem::new("the file is truncated; copy it again");
    let number = |at: usize| {
        let four = bytes.get(at..at + 4)?.try_into().ok()?;
        usize::try_from(u32::from_le_bytes(four)).ok()
    };
    match number(4) {
        Some(2) => {}
        Some(1) => return Err(not_two("1.0")),
        _ => return Err(truncated()),
    }
    let mut rest = number(8).and_then(|len| bytes.get(12..len)).ok_or_else(truncated)?;
    let (mut json, mut binary) = (None, None);
    while let [l0, l1, l2, l3, kind @ ..] = rest {
        let length = u32::from_le_bytes([*l0, *l1, *l2, *l3]) as usize;
        let (kind, after) = kind.split_at_checked(4).ok_or_else(truncated)?;
        let (chunk, next) = after.split_at_checked(length).ok_or_else(truncated)?;
        match kind {
            b"JSON" => json = json.or(Some(chunk)),
            b"BIN\0" => binary = binary.or(Some(chunk)),
            _ => {}
        }
        rest = next;
    }
    // Padded by blanks; some exporters pad by NUL.
    let json = json.ok_or_else(truncated)?;
    let end = json.iter().rposition(|&byte| byte != 0).map_or(0, |last| last + 1);
    Ok((&json[..end], binary))
}
