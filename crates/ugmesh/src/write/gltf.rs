//! Writes glTF 2.0: a node and a mesh for each name of faces, a primitive for each of its colours,
//! 32-bit floats, linear colours.

use std::sync::Arc;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Value, json};
use ugphysics::srgb_decode;
use ugscene::{AlphaMode, Camera, Texture, Wrap};

use super::gltf_lights::{self, node_matrix};
use crate::Error;
use crate::polygon_mesh::{GroupColor, PolygonMesh};

/// OpenGL constants for component types and buffer targets.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;
/// That for texels that are flat squares.
const NEAREST: u32 = 9728;

pub(super) fn write_glb(mesh: &mut PolygonMesh) -> Result<Vec<u8>, Error> {
    check_range(mesh)?;
    let (document, mut buffer) = document(mesh, None);
    let mut json = document.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    buffer.resize(buffer.len().next_multiple_of(4), 0);
    let chunks =
        [(json, b"JSON"), (buffer, b"BIN\0")].into_iter().filter(|(chunk, _)| !chunk.is_empty());
    let chunks: Vec<_> = chunks.collect();
    let length: usize = 12 + chunks.iter().map(|(chunk, _)| 8 + chunk.len()).sum::<usize>();
    let length = u32::try_from(length).map_err(|_| Error::TooLarge)?;
    let mut file = [*b"glTF", 2_u32.to_le_bytes(), length.to_le_bytes()].concat();
    for (chunk, kind) in chunks {
        file.extend((chunk.len() as u32).to_le_bytes());
        file.extend(kind);
        file.extend(chunk);
    }
    Ok(file)
}

pub(super) fn write_json(mesh: &mut PolygonMesh) -> Result<Vec<u8>, Error> {
    check_range(mesh)?;
    let (document, _) = document(mesh, Some("data:application/octet-stream;base64,"));
    Ok(format!("{document:#}\n").into_bytes())
}

fn check_range(mesh: &PolygonMesh) -> Result<(), Error> {
    let is_narrow = mesh.scene.vertices.iter().all(|vertex| vertex.position.as_vec3().is_finite());
    if is_narrow { Ok(()) } else { Err(Error::OutOfRange) }
}

/// The document and its buffer. If `uri` is given, the buffer is also embedded in the document, as
/// a data URI with this prefix.
fn document(mesh: &mut PolygonMesh, uri: Option<&str>) -> (Value, Vec<u8>) {
    let mut document = json!({
        "asset": {
            "version": "2.0",
            "generator": concat!("ugmesh ", env!("CARGO_PKG_VERSION")),
            "extras": { "history": super::head_lines(&mesh.scene).collect::<Vec<_>>() },
        },
    });
    let mut buffer = Buffer::default();
    let mut nodes: Vec<Value> = Vec::new();
    let mut extensions: Vec<&str> = Vec::new();
    // glTF does not allow empty lists and accessors.
    if !mesh.polygons.is_empty() {
        nodes = add_meshes(mesh, &mut document, &mut buffer, &mut extensions);
        document["accessors"] = Value::Array(buffer.accessors);
        document["bufferViews"] = Value::Array(buffer.views);
        document["buffers"] = json!([{ "byteLength": buffer.bytes.len() }]);
        if let Some(uri) = uri {
            document["buffers"][0]["uri"] =
                (uri.to_string() + &BASE64_STANDARD.encode(&buffer.bytes)).into();
        }
    }
    if let Some((camera, matrix)) = mesh.scene.camera().and_then(camera) {
        document["cameras"] = json!([camera]);
        nodes.push(json!({ "camera": 0, "matrix": matrix }));
    }
    let lights = gltf_lights::lights(&mesh.scene, &mut mesh.notes);
    if !lights.is_empty() {
        extensions.push(gltf_lights::NAME);
        let (lights, places): (Vec<Value>, Vec<Value>) = lights.into_iter().unzip();
        document["extensions"][gltf_lights::NAME] = json!({ "lights": lights });
        nodes.extend(places);
    }
    if !nodes.is_empty() {
        document["scene"] = 0.into();
        document["scenes"] = json!([{ "nodes": Vec::from_iter(0..nodes.len()) }]);
        document["nodes"] = nodes.into();
    }
    if !extensions.is_empty() {
        document["extensionsUsed"] = json!(extensions);
    }
    (document, buffer.bytes)
}

/// Adds meshes and materials; returns their nodes.
fn add_meshes(
    mesh: &mut PolygonMesh,
    document: &mut Value,
    buffer: &mut Buffer,
    extensions: &mut Vec<&str>,
) -> Vec<Value> {
    let attributes = attributes(mesh, buffer);
    let groups = mesh.groups();
    let names = distinct(groups.iter().map(|group| &group.name));
    let colors = distinct(groups.iter().map(|group| &group.color));
    let mut meshes = vec![Vec::new(); names.len()];
    let mut is_transparent = vec![false; colors.len()];
    for group in &groups {
        let at = names.iter().position(|&name| *name == group.name);
        let color = colors.iter().position(|&color| *color == group.color);
        let (Some(at), Some(material)) = (at, color) else { continue };
        is_transparent[material] |=
            group.polygons.iter().any(|&polygon| mesh.is_transparent_at(polygon));
        let indices = indices(mesh, &group.polygons, buffer);
        meshes[at].push(
            json!({ "attributes": attributes, "indices": indices, "material": material, "mode": 4 }),
        );
    }
    let meshes = meshes.into_iter().zip(&names);
    document["meshes"] =
        meshes.map(|(list, name)| named(json!({ "primitives": list }), name)).collect();
    let mut pictures = Pictures::default();
    let materials = is_transparent.into_iter().zip(&colors);
    let materials = materials.map(|(is_clear, color)| {
        let GroupColor { name, texture, emitted, level } = color;
        let mut material = material(is_clear);
        if let Some((light, texture)) = emitted {
            let emitted = (*light, texture.as_ref());
            pictures.add_emitted(emitted, &mut material, buffer, &mut mesh.notes);
        }
        if let Some(texture) = texture {
            pictures.add(texture, &mut material, buffer, &mut mesh.notes);
        }
        if let Some(level) = level {
            add_level(*level, &mut material);
            pictures.is_unlit = true;
        }
        named(material, name)
    });
    document["materials"] = materials.collect();
    pictures.write(document, extensions);
    let nodes = names.iter().enumerate();
    nodes.map(|(row, name)| named(json!({ "mesh": row }), name)).collect()
}

/// Makes a material emit its colour times a light level, whatever lights it.
fn add_level(level: f64, material: &mut Value) {
    material["extensions"]["KHR_materials_unlit"] = json!({});
    if level < 1.0 {
        let surface = &mut material["pbrMetallicRoughness"];
        let number = |channel: usize| surface["baseColorFactor"][channel].as_f64().unwrap_or(1.0);
        let [red, green, blue] = [0, 1, 2].map(|channel| (number(channel) * level) as f32);
        surface["baseColorFactor"] = json!([red, green, blue, number(3) as f32]);
    }
}

/// A camera of a scene with all its values, and the matrix of its node by columns. It looks along
/// its −z axis, with y up.
fn camera(camera: &Camera) -> Option<(Value, [f32; 16])> {
    /// Clipping distances, as parts of the distance to the view centre.
    const CLIP: [f64; 2] = [1e-3, 1e3];
    let (eye, center, up) = (camera.eye?, camera.center?, camera.up?);
    let matrix = node_matrix(eye, (eye - center).normalize(), up);
    let number = |x: f64| (x as f32).clamp(f32::MIN_POSITIVE, f32::MAX);
    let [near, far] = CLIP.map(|part| number(part * eye.distance(center)));
    let lens = match (camera.view_angle, camera.film_size) {
        (Some([across, down]), _) => {
            let [across, down] =
                [across, down].map(|degrees| libm::tan(degrees.to_radians() / 2.0));
            json!({ "type": "perspective", "perspective": {
                "aspectRatio": number(across / down), "yfov": 2.0 * libm::atan(down), "znear": near, "zfar": far,
            } })
        }
        (None, Some([across, down])) => json!({ "type": "orthographic", "orthographic": {
            "xmag": number(across / 2.0), "ymag": number(down / 2.0), "znear": near, "zfar": far,
        } }),
        (None, None) => return None,
    };
    matrix.iter().all(|number| number.is_finite()).then_some((lens, matrix))
}

/// The values in order of first appearance, each once.
fn distinct<'a, T: PartialEq>(values: impl Iterator<Item = &'a T>) -> Vec<&'a T> {
    let mut list = Vec::new();
    values.for_each(|value| {
        if !list.contains(&value) {
            list.push(value);
        }
    });
    list
}

/// The object with its name, if it has one.
fn named(mut object: Value, name: &Option<String>) -> Value {
    if let Some(name) = name {
        object["name"] = name.as_str().into();
    }
    object
}

/// A diffuse, two-sided material, as the faces of scenes are.
fn material(is_transparent: bool) -> Value {
    let mut material = json!({
        "pbrMetallicRoughness": { "metallicFactor": 0, "roughnessFactor": 1 },
        "doubleSided": true,
    });
    if is_transparent {
        material["alphaMode"] = "BLEND".into();
    }
    material
}

/// The pictures of materials, each of which is written once.
#[derive(Default)]
struct Pictures {
    images: Vec<Value>,
    samplers: Vec<Value>,
    textures: Vec<Value>,
    /// The bytes of the images.
    known: Vec<Arc<[u8]>>,
    /// A material emits more than a factor of 1.
    has_strength: bool,
    /// A material is not lit.
    is_unlit: bool,
}

impl Pictures {
    /// Adds a texture; its row, unless glTF has no such pictures.
    fn row(
        &mut self,
        texture: &Texture,
        buffer: &mut Buffer,
        notes: &mut Vec<String>,
    ) -> Option<usize> {
        let bytes = &texture.image.bytes;
        let kind = match bytes[..] {
            [0x89, b'P', b'N', b'G', ..] => "image/png",
            [0xff, 0xd8, 0xff, ..] => "image/jpeg",
            _ => {
                let file = texture.image.file.as_deref().unwrap_or("of a mesh");
                notes.push(format!("picture `{file}` is left out: glTF has only PNG and JPEG"));
                return None;
            }
        };
        let source = self.known.iter().position(|known| known == bytes).unwrap_or_else(|| {
            self.images.push(json!({ "bufferView": buffer.picture(bytes), "mimeType": kind }));
            self.known.push(Arc::clone(bytes));
            self.known.len() - 1
        });
        let [s, t] = texture.wrap.map(|wrap| match wrap {
            Wrap::Repeat => 10497,
            Wrap::Clamp => 33071,
            Wrap::Mirror => 33648,
        });
        let mut sampler = json!({ "wrapS": s, "wrapT": t });
        if texture.is_nearest {
            (sampler["magFilter"], sampler["minFilter"]) = (json!(NEAREST), json!(NEAREST));
        }
        let sampler = row(&mut self.samplers, sampler);
        Some(row(&mut self.textures, json!({ "source": source, "sampler": sampler })))
    }

    /// Describes the light that a material emits, and adds its picture.
    fn add_emitted(
        &mut self,
        (light, texture): ([f64; 3], Option<&Texture>),
        material: &mut Value,
        buffer: &mut Buffer,
        notes: &mut Vec<String>,
    ) {
        let picture =
            texture.and_then(|texture| Some((texture, self.row(texture, buffer, notes)?)));
        let factor = match picture {
            Some((texture, number)) => {
                material["emissiveTexture"] = json!({ "index": number });
                [0, 1, 2].map(|at| f64::from(texture.factor[at]))
            }
            None => light,
        };
        let strength = factor.into_iter().fold(1.0, f64::max);
        material["emissiveFactor"] = json!(factor.map(|part| (part / strength) as f32));
        if strength > 1.0 {
            material["extensions"]["KHR_materials_emissive_strength"] =
                json!({ "emissiveStrength": strength });
            self.has_strength = true;
        }
    }

    /// Adds a texture and describes it in its material.
    fn add(
        &mut self,
        texture: &Texture,
        material: &mut Value,
        buffer: &mut Buffer,
        notes: &mut Vec<String>,
    ) {
        let Some(number) = self.row(texture, buffer, notes) else { return };
        let surface = &mut material["pbrMetallicRoughness"];
        surface["baseColorTexture"] = json!({ "index": number });
        if texture.factor != [1.0; 4] {
            surface["baseColorFactor"] = json!(texture.factor.map(|part| part.min(1.0)));
        }
        match texture.alpha {
            AlphaMode::Opaque => {
                material.as_object_mut().map(|material| material.remove("alphaMode"));
            }
            AlphaMode::Mask(cutoff) => {
                material["alphaMode"] = "MASK".into();
                // Factors of glTF are at most 1.
                material["alphaCutoff"] = json!(cutoff / texture.factor[3].max(1.0));
            }
            AlphaMode::Blend => material["alphaMode"] = "BLEND".into(),
        }
    }

    fn write(self, document: &mut Value, extensions: &mut Vec<&str>) {
        let used = [
            (self.has_strength, "KHR_materials_emissive_strength"),
            (self.is_unlit, "KHR_materials_unlit"),
        ];
        extensions.extend(used.into_iter().filter(|used| used.0).map(|used| used.1));
        if !self.images.is_empty() {
            document["images"] = self.images.into();
            document["samplers"] = self.samplers.into();
            document["textures"] = self.textures.into();
        }
    }
}

/// The row of a value in a list, to which it is added if it is new.
fn row(list: &mut Vec<Value>, value: Value) -> usize {
    list.iter().position(|known| *known == value).unwrap_or_else(|| {
        list.push(value);
        list.len() - 1
    })
}

fn attributes(mesh: &mut PolygonMesh, buffer: &mut Buffer) -> Value {
    let positions: Vec<[f32; 3]> =
        mesh.scene.vertices.iter().map(|vertex| vertex.position.as_vec3().to_array()).collect();
    let mut attributes = json!({ "POSITION": buffer.rows(&positions, "VEC3") });
    let (low, high) = bounds(&positions);
    let position = buffer.accessors.last_mut().expect("just added");
    (position["min"], position["max"]) = (json!(low), json!(high));

    match mesh.normals() {
        Some(normals) => {
            let normals: Vec<[f32; 3]> =
                normals.iter().map(|normal| normal.as_vec3().to_array()).collect();
            attributes["NORMAL"] = buffer.rows(&normals, "VEC3").into();
        }
        None if mesh.scene.vertices.iter().any(|vertex| vertex.normal.is_some()) => {
            mesh.notes.push("normals are left out: not every vertex has one".to_string());
        }
        None => {}
    }
    if !mesh.scene.textures.is_empty() {
        let uvs: Vec<[f32; 2]> =
            mesh.scene.vertices.iter().map(|vertex| vertex.uv.unwrap_or_default()).collect();
        attributes["TEXCOORD_0"] = buffer.rows(&uvs, "VEC2").into();
    }
    if let Some(colors) = &mesh.colors {
        let linear = |&[red, green, blue, alpha]: &[f64; 4]| {
            let [red, green, blue] = [red, green, blue].map(|part| srgb_decode(part) as f32);
            [red, green, blue, alpha as f32]
        };
        let colors: Vec<[f32; 4]> = colors.iter().map(linear).collect();
        attributes["COLOR_0"] = buffer.rows(&colors, "VEC4").into();
    }
    attributes
}

fn indices(mesh: &PolygonMesh, polygons: &[u32], buffer: &mut Buffer) -> usize {
    let corners = polygons.iter().flat_map(|&row| mesh.polygons.get(row));
    let bytes: Vec<u8> = corners.flat_map(|corner| corner.0.to_le_bytes()).collect();
    buffer.add(&bytes, bytes.len() / 4, UNSIGNED_INT, "SCALAR", ELEMENT_ARRAY_BUFFER)
}

fn bounds(positions: &[[f32; 3]]) -> ([f32; 3], [f32; 3]) {
    let first = positions.first().copied().unwrap_or_default();
    positions.iter().fold((first, first), |(low, high), p| {
        (std::array::from_fn(|i| low[i].min(p[i])), std::array::from_fn(|i| high[i].max(p[i])))
    })
}

/// The binary buffer, with its views and accessors. All its parts are multiples of four bytes long.
#[derive(Default)]
struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Buffer {
    fn rows<const N: usize>(&mut self, rows: &[[f32; N]], kind: &str) -> usize {
        let bytes: Vec<u8> = rows.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        self.add(&bytes, rows.len(), FLOAT, kind, ARRAY_BUFFER)
    }

    /// Appends a picture, padded to four bytes, and describes it by a view. Returns the index of
    /// the view.
    fn picture(&mut self, bytes: &[u8]) -> usize {
        self.views.push(json!({
            "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len(),
        }));
        self.bytes.extend_from_slice(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.len() - 1
    }

    /// Appends data and describes it by a view and an accessor. Returns the index of the accessor.
    fn add(
        &mut self,
        bytes: &[u8],
        count: usize,
        component: u32,
        kind: &str,
        target: u32,
    ) -> usize {
        self.views.push(json!({
            "buffer": 0,
            "byteOffset": self.bytes.len(),
            "byteLength": bytes.len(),
            "target": target,
        }));
        self.bytes.extend_from_slice(bytes);
        self.accessors.push(json!({
            "bufferView": self.views.len() - 1,
            "componentType": component,
            "count": count,
            "type": kind,
        }));
        self.accessors.len() - 1
    }
}
