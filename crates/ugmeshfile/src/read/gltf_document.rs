//! The parts of a glTF 2.0 document that are read here. Everything else may be anything, since
//! exporters write much that Khronos' validator accepts and a full data model refuses.

use std::borrow::Cow;
use std::collections::BTreeMap;

use serde::Deserialize;

use crate::error::Problem;

/// An index or a count, which some exporters write with a decimal point.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(try_from = "f64")]
pub(super) struct Whole(pub usize);

impl TryFrom<f64> for Whole {
    type Error = String;

    fn try_from(number: f64) -> Result<Self, String> {
        let whole = number as usize;
        if whole as f64 == number { Ok(Self(whole)) } else { Err(format!("{number} is not a whole number")) }
    }
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct Document {
    pub asset: Asset,
    pub extensions_required: Vec<String>,
    pub scene: Option<Whole>,
    pub scenes: Vec<SceneRoots>,
    pub nodes: Vec<Node>,
    pub meshes: Vec<Mesh>,
    pub materials: Vec<Material>,
    pub textures: Vec<Texture>,
    pub images: Vec<Image>,
    pub accessors: Vec<Accessor>,
    pub buffer_views: Vec<BufferView>,
    pub buffers: Vec<Buffer>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Asset {
    pub version: String,
    pub copyright: Option<String>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct SceneRoots {
    pub nodes: Vec<Whole>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Node {
    pub name: Option<String>,
    pub children: Vec<Whole>,
    pub mesh: Option<Whole>,
    pub skin: Option<Whole>,
    pub matrix: Option<[f64; 16]>,
    pub translation: Option<[f64; 3]>,
    pub rotation: Option<[f64; 4]>,
    pub scale: Option<[f64; 3]>,
    pub extensions: NodeExtensions,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct NodeExtensions {
    #[serde(rename = "EXT_mesh_gpu_instancing")]
    pub instances: Option<Instances>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Instances {
    pub attributes: BTreeMap<String, Whole>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Mesh {
    pub name: Option<String>,
    pub primitives: Vec<Primitive>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Primitive {
    pub attributes: BTreeMap<String, Whole>,
    pub indices: Option<Whole>,
    pub material: Option<Whole>,
    pub mode: Option<Whole>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct Material {
    pub name: String,
    pub alpha_mode: String,
    pub pbr_metallic_roughness: BaseColor,
    pub extensions: MaterialExtensions,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct MaterialExtensions {
    #[serde(rename = "KHR_materials_pbrSpecularGlossiness")]
    pub specular_glossiness: Option<BaseColor>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct BaseColor {
    #[serde(rename = "baseColorFactor", alias = "diffuseFactor")]
    pub factor: Option<[f64; 4]>,
    #[serde(rename = "baseColorTexture", alias = "diffuseTexture")]
    pub texture: Option<TextureUse>,
}

#[derive(Debug, Deserialize)]
pub(super) struct TextureUse {
    pub index: Whole,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Texture {
    pub source: Option<Whole>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct Image {
    pub uri: Option<String>,
    pub buffer_view: Option<Whole>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct Accessor {
    pub buffer_view: Option<Whole>,
    pub byte_offset: Whole,
    pub component_type: Whole,
    pub normalized: bool,
    pub count: Whole,
    #[serde(rename = "type")]
    pub shape: String,
    pub sparse: Option<Sparse>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Sparse {
    pub count: Whole,
    pub indices: SparsePart,
    pub values: SparsePart,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct SparsePart {
    pub buffer_view: Whole,
    pub byte_offset: Whole,
    /// Of indices.
    pub component_type: Whole,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct BufferView {
    pub buffer: Whole,
    pub byte_offset: Whole,
    pub byte_length: Whole,
    pub byte_stride: Option<Whole>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct Buffer {
    pub uri: Option<String>,
    pub byte_length: Whole,
}

/// Beginnings of the names of extensions that a file may require: they do not affect the geometry.
const HARMLESS: [&str; 7] = [
    "EXT_mesh_gpu_instancing",
    "KHR_lights_punctual",
    "KHR_materials_",
    "KHR_mesh_quantization",
    "KHR_texture_",
    "EXT_texture_",
    "MSFT_texture_",
];

impl Document {
    /// Parses the JSON text of a file.
    pub fn parse(json: &[u8]) -> Result<Self, Problem> {
        let parsed = serde_json::from_slice::<Self>(json);
        // glTF 1.0 has objects where 2.0 has arrays.
        let version = match &parsed {
            Ok(document) => document.asset.version.clone(),
            Err(_) => {
                let value = serde_json::from_slice::<serde_json::Value>(json).unwrap_or_default();
                value["asset"]["version"].as_str().unwrap_or_default().to_owned()
            }
        };
        if version.starts_with("1.") || version == "1" {
            return Err(Problem::new("glTF 1.0 is not read; convert the mesh to glTF 2.0"));
        }
        let document = parsed.map_err(|error| Problem::new(error.to_string()))?;
        if version.is_empty() {
            return Err(Problem::new("this is not a glTF document: it has no `asset` with a version"));
        }
        let required = &document.extensions_required;
        if let Some(name) = required.iter().find(|name| !HARMLESS.iter().any(|known| name.starts_with(known)))
        {
            let name = ugscene::shorten(name);
            return Err(Problem::new(match name.as_str() {
                "KHR_draco_mesh_compression" => {
                    "the mesh has Draco compression (KHR_draco_mesh_compression); export without it"
                        .to_owned()
                }
                "EXT_meshopt_compression" | "KHR_meshopt_compression" => {
                    format!("the mesh has meshopt compression ({name}); export without it")
                }
                _ => format!("the mesh requires `{name}`, which is not read; export without it"),
            }));
        }
        Ok(document)
    }

    /// The node or other row with an index of the file; `what` names the table in errors.
    pub fn row<'t, T>(table: &'t [T], index: Whole, what: &str) -> Result<&'t T, Problem> {
        table
            .get(index.0)
            .ok_or_else(|| Problem::new(format!("{what} {} does not exist; export the mesh again", index.0)))
    }
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
        Some(1) => return Err(Problem::new("glTF 1.0 is not read; convert the mesh to glTF 2.0")),
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

/// The bytes of a part of a buffer.
pub(super) fn view_bytes<'b>(view: &BufferView, buffers: &'b [Cow<'_, [u8]>]) -> Option<&'b [u8]> {
    let end = view.byte_offset.0.checked_add(view.byte_length.0)?;
    buffers.get(view.buffer.0)?.get(view.byte_offset.0..end)
}
