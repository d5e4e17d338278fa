//! Reads glTF 2.0: the nodes of its scene, with transforms, normals and colours.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::rc::Rc;

use base64::Engine;
use base64::alphabet;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};
use rustc_hash::FxHashMap;
use serde_json::Value;
use ugphysics::srgb_encode;
use ugscene::{AlphaMode, ColorId, Texture, VertexId, Wrap, shorten};

use super::gltf_document::{Document, numbers, split, whole};
use super::gltf_eyes_and_lamps::EyesAndLamps;
use super::{Input, accessor, strip};
use crate::builder::{Builder, Rgba};
use crate::error::Problem;
use crate::textures::{LoadedTexture, MAX_TEXTURE_BYTES, TextureOrigin, Textures};

pub(super) fn read(input: &Input<'_>, builder: &mut Builder) -> Result<(), Problem> {
    let (json, blob) = split(input.bytes)?;
    let document = Document::parse(json)?;
    if let Some(copyright) = document.0["asset"]["copyright"].as_str() {
        builder.comment(copyright);
    }
    let mut reader = Reader {
        builder,
        buffers: buffers(&document, blob, input)?,
        document: &document,
        numbers: FxHashMap::default(),
        room: MAX_NUMBERS,
        n_skipped: 0,
        n_without_positions: 0,
        input,
        textures: Textures::new(input.memory),
        eyes_and_lamps: EyesAndLamps::default(),
    };
    reader.scene()?;
    let Reader { n_skipped, n_without_positions, mut textures, eyes_and_lamps, .. } = reader;
    eyes_and_lamps.finish(input, builder);
    if document.table("nodes").iter().any(|node| !node["skin"].is_null()) {
        builder.warn("skins are ignored: skinned meshes are read in their bind pose");
    }
    if !document.table("animations").is_empty() {
        builder.warn("animations are not read: everything is at rest where its node is");
    }
    textures.warn(builder);
    let unread = document.unread_extensions();
    if !unread.is_empty() {
        builder.warn(format!("extensions that are not read: {}", unread.join(", ")));
    }
    builder.warn_count(
        n_skipped,
        "set of lines or points is left out",
        "sets of lines or points are left out",
    );
    builder.warn_count(
        n_without_positions,
        "set of triangles without positions is left out",
        "sets of triangles without positions are left out",
    );
    Ok(())
}

/// The bytes of a picture of a glTF file, by its row.
pub(super) fn picture(input: &Input<'_>, row: usize) -> Result<Vec<u8>, Problem> {
    let (json, blob) = split(input.bytes)?;
    let document = Document::parse(json)?;
    let image = document.row("images", row)?;
    if let Some(uri) = image["uri"].as_str() {
        return load(uri, MAX_TEXTURE_BYTES, input).map(|(bytes, _)| bytes);
    }
    let buffers = buffers(&document, blob, input)?;
    let view = whole(&image["bufferView"]).and_then(|view| document.view(view, &buffers));
    view.map(<[u8]>::to_vec).ok_or_else(|| Problem::new("it is not in the buffers"))
}

/// Largest number of bytes of all buffers, as the mesh states them.
const MAX_BUFFER_BYTES: u64 = u32::MAX as u64;

/// All buffers: of the file itself, from data URIs and from separate files. A buffer with none of
/// these is empty: nothing may use it, as fallbacks of compressed ones.
fn buffers<'a>(
    document: &Document,
    mut blob: Option<&'a [u8]>,
    input: &Input<'_>,
) -> Result<Vec<Cow<'a, [u8]>>, Problem> {
    let mut buffers = Vec::new();
    let mut room = MAX_BUFFER_BYTES;
    for (index, buffer) in document.table("buffers").iter().enumerate() {
        let length = whole(&buffer["byteLength"]).unwrap_or(0);
        room = room.checked_sub(length as u64).ok_or_else(|| {
            let what = "the buffers have more than";
            Problem::new(format!(
                "{what} {MAX_BUFFER_BYTES} bytes together, the limit; split the mesh"
            ))
        })?;
        let bytes: Cow<[u8]> = match buffer["uri"].as_str() {
            Some(uri) => load(uri, length as u64, input)?.0.into(),
            None => match blob.take() {
                Some(blob) => blob.into(),
                None => {
                    buffers.push(Cow::default());
                    continue;
                }
            },
        };
        if bytes.len() < length {
            let what =
                format!("buffer {index} has only {} of {length} bytes; copy it again", bytes.len());
            return Err(Problem::new(what));
        }
        buffers.push(bytes);
    }
    Ok(buffers)
}

/// Some exporters omit the padding `=` at the end.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &alphabet::STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// The content of a buffer, and the name of its file. Of a file, the first `length` bytes are read.
fn load(uri: &str, length: u64, input: &Input<'_>) -> Result<(Vec<u8>, String), Problem> {
    if let Some(data) = uri.strip_prefix("data:") {
        let (_, code) = data
            .split_once(";base64,")
            .ok_or_else(|| Problem::new("a data URI is not base64; export the mesh as GLB"))?;
        let damaged = |error| Problem::new(format!("a data URI is damaged: {error}"));
        return BASE64.decode(code).map(|bytes| (bytes, String::new())).map_err(damaged);
    }
    let name = percent_decoded(uri);
    if name.contains("://") {
        return Err(Problem::new(format!(
            "`{}` is a network address; download it and refer to the file instead",
            shorten(&name)
        )));
    }
    input.read_named(&name, length).map_err(|error| {
        let name = shorten(&name);
        Problem::new(format!("cannot read `{name}`: {error}; put it in the folder of the mesh"))
    })
}

fn percent_decoded(uri: &str) -> String {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let [first, after @ ..] = rest {
        let code = after.get(..2).and_then(|hex| str::from_utf8(hex).ok());
        match code.and_then(|hex| u8::from_str_radix(hex, 16).ok()) {
            Some(byte) if *first == b'%' => {
                bytes.push(byte);
                rest = &after[2..];
            }
            _ => {
                bytes.push(*first);
                rest = after;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Largest number of numbers in all accessors: 2 GiB as `f64`.
const MAX_NUMBERS: usize = 1 << 28;

/// The numbers of an accessor, and how many each row has.
type Rows = (Rc<Vec<f64>>, usize);

struct Reader<'a, 'b> {
    builder: &'a mut Builder,
    document: &'a Document,
    buffers: Vec<Cow<'b, [u8]>>,
    /// The numbers of accessors that were already read: primitives may share accessors.
    numbers: FxHashMap<usize, Rc<Vec<f64>>>,
    /// How many more numbers accessors may have.
    room: usize,
    /// Sets of lines or points.
    n_skipped: usize,
    /// Sets of triangles without positions.
    n_without_positions: usize,
    input: &'a Input<'a>,
    textures: Textures,
    eyes_and_lamps: EyesAndLamps,
}

impl Reader<'_, '_> {
    /// Reads all nodes of the default scene or, if there is none, of the first scene. Without any
    /// scene, the nodes without parents are the roots.
    fn scene(&mut self) -> Result<(), Problem> {
        let nodes = self.document.table("nodes");
        let children = |node: &Value| -> Vec<usize> {
            node.as_array().into_iter().flatten().filter_map(whole).collect()
        };
        let scene = whole(&self.document.0["scene"]).unwrap_or(0);
        let roots: Vec<usize> = match self.document.table("scenes").get(scene) {
            Some(scene) => children(&scene["nodes"]),
            None => {
                let inner: BTreeSet<usize> =
                    nodes.iter().flat_map(|node| children(&node["children"])).collect();
                (0..nodes.len()).filter(|row| !inner.contains(row)).collect()
            }
        };
        let mut is_visited = vec![false; nodes.len()];
        let mut todo: Vec<_> = roots.into_iter().map(|node| (node, DAffine3::IDENTITY)).collect();
        todo.reverse();
        while let Some((index, scene_from_parent)) = todo.pop() {
            let node = self.document.row("nodes", index)?;
            if std::mem::replace(&mut is_visited[index], true) {
                let what = format!("node {index} has two parents; export the mesh again");
                return Err(Problem::new(what));
            }
            if node["extensions"]["KHR_node_visibility"]["visible"] == false {
                continue;
            }
            let scene_from_node = scene_from_parent * local_transform(node);
            self.eyes_and_lamps.add(self.document, node, &scene_from_node)?;
            if let Some(mesh) = whole(&node["mesh"]) {
                let mesh = self.document.row("meshes", mesh)?;
                self.builder.name_faces(
                    node["name"].as_str().or(mesh["name"].as_str()).unwrap_or_default(),
                );
                // Joints place a mesh with a skin; its node does not.
                let placed =
                    if node["skin"].is_null() { scene_from_node } else { DAffine3::IDENTITY };
                for node_from_instance in self.instances(node)? {
                    for primitive in mesh["primitives"].as_array().into_iter().flatten() {
                        self.primitive(primitive, placed * node_from_instance)?;
                    }
                }
            }
            todo.extend(
                children(&node["children"]).into_iter().rev().map(|child| (child, scene_from_node)),
            );
        }
        Ok(())
    }

    /// The transforms of the instances of a node's mesh; the identity if it states none.
    fn instances(&mut self, node: &Value) -> Result<Vec<DAffine3>, Problem> {
        let attributes = &node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
        if attributes.is_null() {
            return Ok(vec![DAffine3::IDENTITY]);
        }
        let places = self.rows(&attributes["TRANSLATION"], 3, "TRANSLATION")?;
        let turns = self.rows(&attributes["ROTATION"], 4, "ROTATION")?;
        let sizes = self.rows(&attributes["SCALE"], 3, "SCALE")?;
        let lengths = [(&places, 3), (&turns, 4), (&sizes, 3)];
        let count =
            lengths.iter().filter_map(|(rows, width)| Some(rows.as_ref()?.len() / width)).min();
        self.builder.count_corners(count.unwrap_or(1))?;
        let instance = |idx: usize| {
            let triple = |rows: &Option<Rc<Vec<f64>>>| {
                rows.as_ref().map(|rows| vector(rows, idx).to_array())
            };
            let turn = turns.as_ref().and_then(|rows| rows[4 * idx..4 * idx + 4].try_into().ok());
            transform(triple(&places), turn, triple(&sizes))
        };
        Ok((0..count.unwrap_or(1)).map(instance).collect())
    }

    fn primitive(&mut self, primitive: &Value, scene_from_node: DAffine3) -> Result<(), Problem> {
        let mode = whole(&primitive["mode"]).unwrap_or(TRIANGLES);
        if !(TRIANGLES..=TRIANGLE_FAN).contains(&mode) {
            self.n_skipped += 1;
            let others = &mut self.builder.others;
            others.has_splats |= !primitive["extensions"]["KHR_gaussian_splatting"].is_null();
            others.has_points |= mode == 0;
            others.has_lines |= mode != 0;
            return Ok(());
        }
        let attributes = &primitive["attributes"];
        let Some(positions) = self.rows(&attributes["POSITION"], 3, "POSITION")? else {
            self.n_without_positions += 1;
            return Ok(());
        };
        let n_positions = positions.len() / 3;
        // Each primitive goes through all rows of its positions, which others may use, too.
        self.builder.count_corners(n_positions / 16)?;
        let normals = self.rows(&attributes["NORMAL"], 3, "NORMAL")?;
        let material = match whole(&primitive["material"]) {
            Some(index) => Some(self.document.row("materials", index)?),
            None => None,
        };
        let surface = self.surface(material);
        self.builder.is_unlit = surface.is_unlit;
        if !primitive["targets"].is_null() {
            self.builder.warn_once("morph targets are not read: meshes have their base shape");
        }
        let colors = self.colors(&attributes["COLOR_0"])?;
        let emission = surface.emission.as_ref();
        let mapped = surface.texture.as_ref().or_else(|| emission?.1.as_ref());
        let uvs = match mapped {
            Some(texture) => {
                let name = format!("TEXCOORD_{}", texture.set);
                self.rows(&attributes[&name], 2, &name)?
            }
            None => None,
        };
        let corners = self.corners(&primitive["indices"], n_positions)?;

        // The inverse transpose keeps normals perpendicular to surfaces under non-uniform scaling.
        let normal_matrix: DMat3 = scene_from_node.matrix3.inverse().transpose();
        // Primitives often share one long list of vertices. Only the ones in use become vertices of
        // the scene.
        let mut is_used = vec![false; n_positions];
        corners.iter().for_each(|&corner| is_used[corner] = true);
        let mut vertices = vec![VertexId(0); n_positions];
        for row in (0..n_positions).filter(|&row| is_used[row]) {
            let position = scene_from_node.transform_point3(vector(&positions, row));
            let normal = normals.as_ref().filter(|normals| normals.len() >= 3 * row + 3);
            let normal =
                normal.map(|normals| (normal_matrix * vector(normals, row)).normalize_or_zero());
            let color = colors.as_ref().and_then(|(numbers, n)| numbers.chunks_exact(*n).nth(row));
            let color = color.map(|part| surface.display_color(part));
            vertices[row] = self.builder.vertex(position, normal, color)?;
            let uv = uvs.as_ref().and_then(|uvs| uvs.get(2 * row..2 * row + 2));
            if let (Some(texture), Some(&[u, v])) = (mapped, uv) {
                self.builder.set_uv(vertices[row], Some(texture.placed([u, v])));
            }
        }
        let color = self.face_color(&surface, material, [uvs.is_some(), colors.is_some()]);
        // A reflection reverses the orientation of triangles.
        let is_mirrored = scene_from_node.matrix3.determinant() < 0.0;
        for [a, b, c] in triangles(mode, corners.len()) {
            let triangle = if is_mirrored { [a, c, b] } else { [a, b, c] };
            self.builder.face(&triangle.map(|corner| vertices[corners[corner]]), color)?;
        }
        Ok(())
    }

    /// The colour of the faces of a primitive; `None` if the colours of its vertices are enough.
    /// `has_uvs`: it has texture coordinates; `has_colors`: its vertices have colours.
    fn face_color(
        &mut self,
        surface: &Surface,
        material: Option<&Value>,
        [has_uvs, has_colors]: [bool; 2],
    ) -> Option<ColorId> {
        let texture = surface.texture.as_ref().filter(|_| has_uvs).map(|texture| {
            let mut drawn = texture.texture.clone();
            if has_colors {
                // The colours of vertices contain those of the material.
                let part = |mean: f64| if mean > 0.0 { (1.0 / mean) as f32 } else { 0.0 };
                let [red, green, blue] = texture.mean.map(part);
                drawn.factor = [red, green, blue, drawn.factor[3]];
            }
            drawn
        });
        if has_colors && texture.is_none() && surface.emission.is_none() {
            return None;
        }
        let name = material?["name"].as_str().unwrap_or_default();
        let emitted = surface.emission.as_ref().and_then(|(factor, texture)| {
            let picture = texture.as_ref().map(|it| (it.texture.clone(), it.mean));
            self.builder.emitted(*factor, name, picture)
        });
        Some(self.builder.material(surface.display_color(&[]), name, texture, emitted))
    }

    /// The colour of a material, times the mean of its texture; white without one.
    fn surface(&mut self, material: Option<&Value>) -> Surface {
        let Some(material) = material else {
            return Surface {
                factor: [1.0; 4],
                is_blended: false,
                is_unlit: false,
                texture: None,
                emission: None,
            };
        };
        let metallic = &material["pbrMetallicRoughness"];
        let glossy = &material["extensions"]["KHR_materials_pbrSpecularGlossiness"];
        let (factor, texture) = if glossy.is_null() {
            (&metallic["baseColorFactor"], &metallic["baseColorTexture"])
        } else {
            (&glossy["diffuseFactor"], &glossy["diffuseTexture"])
        };
        let roughness = &metallic["metallicRoughnessTexture"];
        let is_unlit = !material["extensions"]["KHR_materials_unlit"].is_null();
        if !is_unlit {
            self.textures.ignored.extend(ignored_textures(material, roughness));
        }
        let mut factor: [f64; 4] = numbers(factor).unwrap_or([1.0; 4]);
        let mut is_blended = material["alphaMode"] == "BLEND";
        let cutoff = material["alphaCutoff"].as_f64().unwrap_or(0.5).clamp(0.0, 2.0);
        let loaded = whole(&texture["index"]).and_then(|index| Some((index, self.texture(index)?)));
        let texture = loaded.map(|(index, LoadedTexture { mean, image })| {
            let factor_of_texels =
                factor.map(|part| if part.is_finite() { part.max(0.0) as f32 } else { 1.0 });
            let alpha = match material["alphaMode"].as_str() {
                Some("MASK") => AlphaMode::Mask(cutoff as f32),
                Some("BLEND") => AlphaMode::Blend,
                _ => AlphaMode::Opaque,
            };
            factor.iter_mut().zip(mean).for_each(|(factor, mean)| *factor *= mean);
            let none = ColorId::from_index(0);
            let sampled = self.sampled(index, Texture::new(none, image));
            let drawn = Texture { factor: factor_of_texels, alpha, ..sampled };
            SurfaceTexture::new(drawn, mean, texture)
        });
        if texture.is_none() && material["alphaMode"] == "MASK" && factor[3] < cutoff {
            // Without a picture, alpha is cut off everywhere or nowhere.
            (is_blended, factor[3]) = (true, 0.0);
        }
        let emission = if is_unlit { None } else { self.emission(material, texture.as_ref()) };
        Surface { factor, is_blended, is_unlit, texture, emission }
    }

    /// The light that a material emits: its factor, and a picture. One with other coordinates than
    /// the base colour's has to lend its mean light.
    fn emission(
        &mut self,
        material: &Value,
        base: Option<&SurfaceTexture>,
    ) -> Option<([f64; 3], Option<SurfaceTexture>)> {
        let factor: [f64; 3] = numbers(&material["emissiveFactor"])?;
        let strong = &material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"];
        let factor = factor.map(|part| part * strong.as_f64().unwrap_or(1.0));
        if factor == [0.0; 3] {
            return None;
        }
        let info = &material["emissiveTexture"];
        let loaded = whole(&info["index"]).and_then(|index| Some((index, self.texture(index)?)));
        let Some((index, LoadedTexture { mean, image })) = loaded else {
            return Some((factor, None));
        };
        let none = ColorId::from_index(0);
        let drawn = self.sampled(index, Texture::new(none, image));
        let texture = SurfaceTexture::new(drawn, mean, info);
        if base.is_some_and(|base| (base.set, base.transform) != (texture.set, texture.transform)) {
            self.textures.ignored.insert("emissive (with coordinates of their own)");
            return Some(([0, 1, 2].map(|at| factor[at] * mean[at]), None));
        }
        Some((factor, Some(texture)))
    }

    /// A texture with what its sampler states: what is beyond its edges, and whether its texels are
    /// flat squares where they are large.
    fn sampled(&self, index: usize, texture: Texture) -> Texture {
        let known = self.document.table("textures").get(index);
        let sampler = known.and_then(|texture| whole(&texture["sampler"]));
        let sampler = sampler.and_then(|sampler| self.document.table("samplers").get(sampler));
        let wrap = ["wrapS", "wrapT"].map(|axis| {
            match sampler.and_then(|sampler| whole(&sampler[axis])) {
                Some(33071) => Wrap::Clamp,
                Some(33648) => Wrap::Mirror,
                _ => Wrap::Repeat,
            }
        });
        let filter = sampler.and_then(|sampler| whole(&sampler["magFilter"]));
        Texture { wrap, is_nearest: filter == Some(9728), ..texture }
    }

    /// A texture, if it can be read.
    fn texture(&mut self, index: usize) -> Option<LoadedTexture> {
        let (document, buffers, input) = (self.document, &self.buffers, self.input);
        let source =
            document.table("textures").get(index).and_then(|texture| whole(&texture["source"]));
        let image = source.and_then(|source| Some((source, document.table("images").get(source)?)));
        let Some((source, image)) = image else {
            let none = || Err("it has no PNG or JPEG picture".to_owned());
            return self.textures.load(&format!("texture {index}"), none);
        };
        let number = format!("image {source}");
        if let Some(uri) = image["uri"].as_str() {
            let is_within = uri.starts_with("data:");
            let name = if is_within { number } else { percent_decoded(uri) };
            let load = || {
                let (bytes, file) =
                    load(uri, MAX_TEXTURE_BYTES, input).map_err(|problem| problem.what)?;
                let origin = if is_within {
                    TextureOrigin::Within(source)
                } else {
                    TextureOrigin::File(file)
                };
                Ok((bytes, origin))
            };
            return self.textures.load(&name, load);
        }
        let bytes = whole(&image["bufferView"]).and_then(|view| document.view(view, buffers));
        let copied = || match bytes {
            Some(bytes) => Ok((bytes.to_vec(), TextureOrigin::Within(source))),
            None => Err("it is not in the buffers".to_owned()),
        };
        self.textures.load(&number, copied)
    }

    /// The index of the primitive's vertex for each corner.
    fn corners(&mut self, indices: &Value, n_positions: usize) -> Result<Vec<usize>, Problem> {
        let Some(index) = whole(indices) else { return Ok((0..n_positions).collect()) };
        if !accessor::is_index(self.document.row("accessors", index)?) {
            return Err(Problem::new("indices are not unsigned integers; export the mesh again"));
        }
        let corners: Vec<usize> = self.numbers(index)?.iter().map(|&row| row as usize).collect();
        match corners.iter().find(|&&row| row >= n_positions) {
            Some(row) => Err(Problem::new(format!(
                "a triangle refers to vertex {row}, but there are {n_positions}"
            ))),
            None => Ok(corners),
        }
    }

    /// The numbers of `COLOR_0`.
    fn colors(&mut self, colors: &Value) -> Result<Option<Rows>, Problem> {
        let Some(index) = whole(colors) else { return Ok(None) };
        let [n_components, _] = accessor::shape(self.document.row("accessors", index)?)?;
        if !(3..=4).contains(&n_components) {
            return Err(Problem::new("`COLOR_0` must have three or four components"));
        }
        Ok(Some((self.numbers(index)?, n_components)))
    }

    /// The numbers of an accessor with rows of `width` components; `None` without an index.
    fn rows(
        &mut self,
        index: &Value,
        width: usize,
        name: &str,
    ) -> Result<Option<Rc<Vec<f64>>>, Problem> {
        let Some(index) = whole(index) else { return Ok(None) };
        if accessor::shape(self.document.row("accessors", index)?)?[0] != width {
            return Err(Problem::new(format!(
                "`{name}` must have {width} components; export the mesh again"
            )));
        }
        self.numbers(index).map(Some)
    }

    fn numbers(&mut self, index: usize) -> Result<Rc<Vec<f64>>, Problem> {
        if let Some(known) = self.numbers.get(&index) {
            return Ok(Rc::clone(known));
        }
        let accessor = self.document.row("accessors", index)?;
        let [n_components, count] = accessor::shape(accessor)?;
        self.room = self.room.checked_sub(count.saturating_mul(n_components)).ok_or_else(|| {
            Problem::new(format!(
                "the accessors have more than {MAX_NUMBERS} numbers together; split the mesh"
            ))
        })?;
        let numbers = Rc::new(accessor::read(accessor, self.document, &self.buffers)?);
        self.numbers.insert(index, Rc::clone(&numbers));
        Ok(numbers)
    }
}

fn vector(numbers: &[f64], row: usize) -> DVec3 {
    DVec3::from_slice(&numbers[3 * row..3 * row + 3])
}

/// Modes of primitives that have surfaces; the modes before these are points and lines.
const TRIANGLES: usize = 4;
const TRIANGLE_STRIP: usize = 5;
const TRIANGLE_FAN: usize = 6;

/// The triangles of `len` corners, as indices of corners.
fn triangles(mode: usize, len: usize) -> Vec<[usize; 3]> {
    match mode {
        TRIANGLE_STRIP => strip(len).collect(),
        TRIANGLE_FAN => (2..len).map(|last| [0, last - 1, last]).collect(),
        _ => (0..len / 3).map(|idx| [3 * idx, 3 * idx + 1, 3 * idx + 2]).collect(),
    }
}

/// The transform of a node: a column-major matrix, or scale, rotation and translation.
fn local_transform(node: &Value) -> DAffine3 {
    match numbers(&node["matrix"]) {
        Some(matrix) => DAffine3::from_mat4(DMat4::from_cols_array(&matrix)),
        None => transform(
            numbers(&node["translation"]),
            numbers(&node["rotation"]),
            numbers(&node["scale"]),
        ),
    }
}

fn transform(
    translation: Option<[f64; 3]>,
    rotation: Option<[f64; 4]>,
    scale: Option<[f64; 3]>,
) -> DAffine3 {
    // Exporters round quaternions to 32 bits, so they are normalized to pure rotations.
    let rotation = DQuat::from_array(rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]));
    let rotation =
        if rotation.length_squared() > 0.0 { rotation.normalize() } else { DQuat::IDENTITY };
    let [scale, translation] =
        [scale.unwrap_or([1.0; 3]), translation.unwrap_or_default()].map(DVec3::from);
    DAffine3::from_scale_rotation_translation(scale, rotation, translation)
}

/// The colour of a primitive: linear red, green and blue, and alpha.
struct Surface {
    factor: [f64; 4],
    is_blended: bool,
    /// It emits its colour, whatever lights it.
    is_unlit: bool,
    texture: Option<SurfaceTexture>,
    /// See [`Reader::emission`].
    emission: Option<([f64; 3], Option<SurfaceTexture>)>,
}

/// The texture of a material.
struct SurfaceTexture {
    texture: Texture,
    mean: [f64; 3],
    /// The number of its texture coordinates.
    set: usize,
    /// The transform of these (`KHR_texture_transform`), if there is one: u and v from u, v and 1.
    transform: Option<[[f64; 3]; 2]>,
}

impl SurfaceTexture {
    /// `info`: the reference to the texture in the material.
    fn new(texture: Texture, mean: [f64; 3], info: &Value) -> Self {
        let placed = &info["extensions"]["KHR_texture_transform"];
        let set = whole(&placed["texCoord"]).or(whole(&info["texCoord"])).unwrap_or(0);
        let transform = (!placed.is_null()).then(|| {
            let [x, y] = numbers(&placed["offset"]).unwrap_or([0.0; 2]);
            let [width, height] = numbers(&placed["scale"]).unwrap_or([1.0; 2]);
            let turn = placed["rotation"].as_f64().unwrap_or(0.0);
            let (sin, cos) = (libm::sin(turn), libm::cos(turn));
            [[cos * width, sin * height, x], [-sin * width, cos * height, y]]
        });
        Self { texture, mean, set, transform }
    }

    /// Texture coordinates after the transform.
    fn placed(&self, [u, v]: [f64; 2]) -> [f32; 2] {
        match self.transform {
            Some(rows) => {
                rows.map(|[along, across, offset]| (along * u + across * v + offset) as f32)
            }
            None => [u as f32, v as f32],
        }
    }
}

/// The kinds of textures of a material that scenes do not have.
fn ignored_textures(
    material: &Value,
    roughness: &Value,
) -> impl Iterator<Item = &'static str> + use<> {
    let kinds = [
        ("metallic-roughness", roughness),
        ("normal", &material["normalTexture"]),
        ("occlusion", &material["occlusionTexture"]),
    ];
    kinds.map(|(kind, texture)| (!texture.is_null()).then_some(kind)).into_iter().flatten()
}

impl Surface {
    /// The display-encoded product of the linear colour `part`, perhaps with alpha, and the colour
    /// of the material.
    fn display_color(&self, part: &[f64]) -> Rgba {
        let [red, green, blue, alpha] =
            [0, 1, 2, 3].map(|idx| part.get(idx).unwrap_or(&1.0) * self.factor[idx]);
        // Exactly 1 for white, where the transfer function has a rounding error.
        let encode = |linear: f64| if linear == 1.0 { 1.0 } else { srgb_encode(linear) };
        let alpha = if self.is_blended { alpha } else { 1.0 };
        Rgba([encode(red), encode(green), encode(blue), alpha])
    }
}
