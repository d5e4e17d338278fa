//! Reads glTF 2.0: the nodes of its scene, with transforms, normals and colours.

use std::borrow::Cow;
use std::rc::Rc;

use base64::Engine;
use base64::alphabet;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};
use gltf::accessor::{DataType, Dimensions};
use gltf::json::validation::Checked::Valid;
use gltf::json::validation::{Error as Invalid, Validate};
use gltf::json::{Path, Root};
use gltf::material::AlphaMode;
use gltf::mesh::{Mode, Semantic};
use gltf::{Accessor, Document, Primitive};
use rustc_hash::FxHashMap;
use serde_json::Value;
use ugphysics::srgb_encode;
use ugscene::VertexId;
use ugscene::shorten;

use super::Input;
use super::{accessor, strip};
use crate::builder::{Builder, Rgba};
use crate::error::Problem;
use crate::textures::{MAX_TEXTURE_BYTES, Textures};

pub(super) fn read(input: &Input<'_>, builder: &mut Builder) -> Result<(), Problem> {
    let (json, blob) = split(input.bytes)?;
    let (document, nodes) = parse(&json)?;
    let buffers = buffers(&document, blob, input)?;
    if let Some(copyright) = &document.as_json().asset.copyright {
        builder.comment(copyright);
    }
    let mut reader = Reader {
        builder,
        buffers,
        numbers: FxHashMap::default(),
        room: MAX_NUMBERS,
        n_skipped: 0,
        input,
        root: document.as_json(),
        textures: Textures::default(),
    };
    reader.scene(&document, &nodes)?;
    let (n_skipped, textures) = (reader.n_skipped, reader.textures);
    if document.nodes().any(|node| node.skin().is_some()) {
        builder.warn("skins are ignored: skinned meshes are read in their bind pose");
    }
    textures.warn(builder);
    builder.warn_count(
        n_skipped,
        "set of lines or points is left out",
        "sets of lines or points are left out",
    );
    Ok(())
}

type Chunks<'a> = (Cow<'a, [u8]>, Option<Cow<'a, [u8]>>);

/// Splits a file into its JSON text and, for GLB, its binary chunk.
fn split(bytes: &[u8]) -> Result<Chunks<'_>, Problem> {
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes.into(), None));
    }
    // The crate subtracts the size of the header from the length without a check.
    let length = bytes.get(8..12).and_then(|length| length.try_into().ok()).map(u32::from_le_bytes);
    if length.is_none_or(|length| length < 20 || length as usize > bytes.len()) {
        return Err(Problem::new("the file is truncated; copy it again"));
    }
    let glb = gltf::Glb::from_slice(bytes).map_err(|error| Problem::new(error.to_string()))?;
    Ok((glb.json, glb.bin))
}

/// The document, and the JSON of its nodes: the crate rounds their transforms to 32 bits.
fn parse(json: &[u8]) -> Result<(Document, Vec<Value>), Problem> {
    let bad = |error: serde_json::Error| Problem::new(error.to_string());
    let root: Root = serde_json::from_slice(json).map_err(bad)?;
    check(&root)?;
    let mut value: Value = serde_json::from_slice(json).map_err(bad)?;
    let nodes = match value.get_mut("nodes").map(Value::take) {
        Some(Value::Array(nodes)) => nodes,
        _ => Vec::new(),
    };
    Ok((Document::from_json_without_validation(root), nodes))
}

/// Extensions that do not affect the geometry, so that files that use them can be read without
/// support for them.
const HARMLESS: [&str; 6] = [
    "KHR_lights_punctual",
    "KHR_materials_",
    "KHR_mesh_quantization",
    "KHR_texture_",
    "EXT_texture_",
    "MSFT_texture_",
];

/// Checks that every index into a table is in range. The crate relies on it.
fn check(root: &Root) -> Result<(), Problem> {
    // The validation of the crate does not check this index.
    let primitives = root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let positions = primitives.filter_map(|primitive| primitive.attributes.get(&Valid(Semantic::Positions)));
    if let Some(row) = positions.map(|index| index.value()).find(|&row| row >= root.accessors.len()) {
        return Err(Problem::new(format!("`POSITION` refers to accessor {row}, which does not exist")));
    }
    let mut found = None;
    root.validate(root, Path::new, &mut |path, error| {
        let path = path();
        let path = path.as_str();
        // Bounds are not used here, and some exporters omit them.
        let is_bounds = error == Invalid::Missing && (path.ends_with(".min") || path.ends_with(".max"));
        let is_harmless = error == Invalid::Unsupported && HARMLESS.iter().any(|name| path.contains(name));
        if !is_bounds && !is_harmless && found.is_none() {
            let remedy =
                if error == Invalid::Unsupported { "export without it" } else { "export the mesh again" };
            let what = format!("`{path}`: {}; {remedy}", error.to_string().to_lowercase());
            found = Some(Problem::new(what));
        }
    });
    found.map_or(Ok(()), Err)
}

/// Largest number of bytes of all buffers, as the mesh states them.
const MAX_BUFFER_BYTES: u64 = u32::MAX as u64;

/// All buffers: of the file itself, from data URIs and from separate files.
fn buffers<'a>(
    document: &Document,
    mut blob: Option<Cow<'a, [u8]>>,
    input: &Input<'_>,
) -> Result<Vec<Cow<'a, [u8]>>, Problem> {
    let mut buffers = Vec::new();
    let mut room = MAX_BUFFER_BYTES;
    for buffer in document.buffers() {
        room = room.checked_sub(buffer.length() as u64).ok_or_else(|| {
            let what = "the buffers have more than";
            Problem::new(format!("{what} {MAX_BUFFER_BYTES} bytes together, the limit; split the mesh"))
        })?;
        let bytes: Cow<[u8]> = match buffer.source() {
            gltf::buffer::Source::Bin => {
                blob.take().ok_or_else(|| Problem::new("the binary chunk is missing; copy the file again"))?
            }
            gltf::buffer::Source::Uri(uri) => load(uri, buffer.length() as u64, input)?.into(),
        };
        if bytes.len() < buffer.length() {
            let (index, length) = (buffer.index(), buffer.length());
            let what = format!("buffer {index} has only {} of {length} bytes; copy it again", bytes.len());
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

/// The content of a buffer. Of a file, the first `length` bytes are read.
fn load(uri: &str, length: u64, input: &Input<'_>) -> Result<Vec<u8>, Problem> {
    if let Some(data) = uri.strip_prefix("data:") {
        let (_, code) = data
            .split_once(";base64,")
            .ok_or_else(|| Problem::new("a data URI is not base64; export the mesh as GLB"))?;
        return BASE64.decode(code).map_err(|error| Problem::new(format!("a data URI is damaged: {error}")));
    }
    let name = percent_decoded(uri);
    if name.contains("://") {
        return Err(Problem::new(format!(
            "`{}` is a network address; download it and refer to the file instead",
            shorten(&name)
        )));
    }
    (input.read_file)(&name, length).map_err(|error| {
        Problem::new(format!("cannot read `{}`: {error}; put it in the folder of the mesh", shorten(&name)))
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

struct Reader<'a, 'b> {
    builder: &'a mut Builder,
    buffers: Vec<Cow<'b, [u8]>>,
    /// The numbers of accessors that were already read: primitives may share accessors.
    numbers: FxHashMap<usize, Rc<Vec<f64>>>,
    /// How many more numbers accessors may have.
    room: usize,
    n_skipped: usize,
    input: &'a Input<'a>,
    root: &'a Root,
    textures: Textures,
}

impl Reader<'_, '_> {
    /// Reads all nodes of the default scene or, if there is none, of the first scene. Without any
    /// scene, the nodes without parents are the roots.
    fn scene(&mut self, document: &Document, nodes: &[Value]) -> Result<(), Problem> {
        let scene = document.default_scene().or_else(|| document.scenes().next());
        let roots: Vec<gltf::Node> = match scene {
            Some(scene) => scene.nodes().collect(),
            None => {
                let mut is_child = vec![false; document.nodes().len()];
                document
                    .nodes()
                    .flat_map(|node| node.children())
                    .for_each(|node| is_child[node.index()] = true);
                document.nodes().filter(|node| !is_child[node.index()]).collect()
            }
        };
        let mut is_visited = vec![false; document.nodes().len()];
        let mut todo: Vec<_> = roots.into_iter().map(|node| (node, DAffine3::IDENTITY)).collect();
        todo.reverse();
        while let Some((node, scene_from_parent)) = todo.pop() {
            if std::mem::replace(&mut is_visited[node.index()], true) {
                let what = format!("node {} has two parents; export the mesh again", node.index());
                return Err(Problem::new(what));
            }
            let scene_from_node = scene_from_parent * local_transform(nodes.get(node.index()));
            let mesh = node.mesh();
            let name = node.name().or(mesh.as_ref().and_then(gltf::Mesh::name));
            self.builder.name_faces(name.unwrap_or_default());
            for primitive in mesh.iter().flat_map(|mesh| mesh.primitives()) {
                self.primitive(&primitive, scene_from_node)?;
            }
            let children: Vec<_> = node.children().map(|child| (child, scene_from_node)).collect();
            todo.extend(children.into_iter().rev());
        }
        Ok(())
    }

    fn primitive(&mut self, primitive: &Primitive, scene_from_node: DAffine3) -> Result<(), Problem> {
        if !matches!(primitive.mode(), Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            self.n_skipped += 1;
            return Ok(());
        }
        let Some(accessor) = primitive.get(&Semantic::Positions) else { return Ok(()) };
        let positions = self.vectors(&accessor, "POSITION")?;
        let n_positions = positions.len() / 3;
        let normals = match primitive.get(&Semantic::Normals) {
            Some(accessor) => Some(self.vectors(&accessor, "NORMAL")?),
            None => None,
        };
        let mut material = Material::new(primitive);
        if let Some(mean) = self.texture_mean(primitive) {
            material.factor.iter_mut().zip(mean).for_each(|(factor, mean)| *factor *= mean);
        }
        let colors = self.colors(primitive, &material)?;
        let corners = self.corners(primitive, n_positions)?;

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
            let normal = normal.map(|normals| (normal_matrix * vector(normals, row)).normalize_or_zero());
            let color = colors.as_ref().and_then(|colors| colors.get(row)).copied();
            vertices[row] = self.builder.vertex(position, normal, color)?;
        }
        let color = if colors.is_some() { None } else { material.color() };
        let name = primitive.material().name().unwrap_or_default().to_string();
        let color = color.map(|color| self.builder.material(color, &name));
        // A reflection reverses the orientation of triangles.
        let is_mirrored = scene_from_node.matrix3.determinant() < 0.0;
        for [a, b, c] in triangles(primitive.mode(), corners.len()) {
            let triangle = if is_mirrored { [a, c, b] } else { [a, b, c] };
            self.builder.face(&triangle.map(|corner| vertices[corners[corner]]), color)?;
        }
        Ok(())
    }

    /// The mean linear light of the texture of a primitive's base colour. The JSON is read here,
    /// because the crate panics if an image has no source.
    fn texture_mean(&mut self, primitive: &Primitive) -> Option<[f64; 3]> {
        let texture = primitive.material().pbr_metallic_roughness().base_color_texture()?;
        let index = texture.texture().source().index();
        let image = self.root.images.get(index)?;
        let number = format!("image {index}");
        let (buffers, input) = (&self.buffers, self.input);
        if let Some(uri) = &image.uri {
            let name = if uri.starts_with("data:") { number } else { percent_decoded(uri) };
            let load = || load(uri, MAX_TEXTURE_BYTES, input).map_err(|problem| problem.what);
            return self.textures.mean(&name, load);
        }
        let view = image.buffer_view.and_then(|view| self.root.buffer_views.get(view.value()));
        let bytes = || {
            let view = view?;
            let start = view.byte_offset.unwrap_or_default().0 as usize;
            let end = start.checked_add(view.byte_length.0 as usize)?;
            Some(buffers.get(view.buffer.value())?.get(start..end)?.to_vec())
        };
        self.textures.mean(&number, || bytes().ok_or_else(|| "it is not in the buffers".to_owned()))
    }

    /// The index of the primitive's vertex for each corner.
    fn corners(&mut self, primitive: &Primitive, n_positions: usize) -> Result<Vec<usize>, Problem> {
        let Some(accessor) = primitive.indices() else { return Ok((0..n_positions).collect()) };
        if !matches!(accessor.data_type(), DataType::U8 | DataType::U16 | DataType::U32)
            || accessor.dimensions() != Dimensions::Scalar
        {
            return Err(Problem::new("indices are not unsigned integers; export the mesh again"));
        }
        let corners: Vec<usize> = self.numbers(&accessor)?.iter().map(|&row| row as usize).collect();
        match corners.iter().find(|&&row| row >= n_positions) {
            Some(row) => {
                Err(Problem::new(format!("a triangle refers to vertex {row}, but there are {n_positions}")))
            }
            None => Ok(corners),
        }
    }

    /// `COLOR_0` times the colour of the material (both linear), display-encoded.
    fn colors(&mut self, primitive: &Primitive, material: &Material) -> Result<Option<Vec<Rgba>>, Problem> {
        let Some(accessor) = primitive.get(&Semantic::Colors(0)) else { return Ok(None) };
        let n_components = match accessor.dimensions() {
            Dimensions::Vec3 => 3,
            Dimensions::Vec4 => 4,
            _ => return Err(Problem::new("`COLOR_0` must have three or four components")),
        };
        let numbers = self.numbers(&accessor)?;
        let colors = numbers.chunks_exact(n_components).map(|part| {
            let alpha = part.get(3).copied().unwrap_or(1.0);
            material.display_color([part[0], part[1], part[2], alpha])
        });
        Ok(Some(colors.collect()))
    }

    fn vectors(&mut self, accessor: &Accessor, name: &str) -> Result<Rc<Vec<f64>>, Problem> {
        if accessor.dimensions() != Dimensions::Vec3 {
            return Err(Problem::new(format!("`{name}` must have three components; export the mesh again")));
        }
        self.numbers(accessor)
    }

    fn numbers(&mut self, accessor: &Accessor) -> Result<Rc<Vec<f64>>, Problem> {
        if let Some(known) = self.numbers.get(&accessor.index()) {
            return Ok(Rc::clone(known));
        }
        let n_numbers = accessor.count().saturating_mul(accessor.dimensions().multiplicity());
        self.room = self.room.checked_sub(n_numbers).ok_or_else(|| {
            Problem::new(format!(
                "the accessors have more than {MAX_NUMBERS} numbers together; split the mesh"
            ))
        })?;
        let numbers = Rc::new(accessor::read(accessor, &self.buffers)?);
        self.numbers.insert(accessor.index(), Rc::clone(&numbers));
        Ok(numbers)
    }
}

fn vector(numbers: &[f64], row: usize) -> DVec3 {
    DVec3::from_slice(&numbers[3 * row..3 * row + 3])
}

/// The triangles of `len` corners, as indices of corners.
fn triangles(mode: Mode, len: usize) -> Vec<[usize; 3]> {
    match mode {
        Mode::TriangleStrip => strip(len).collect(),
        Mode::TriangleFan => (2..len).map(|last| [0, last - 1, last]).collect(),
        _ => (0..len / 3).map(|idx| [3 * idx, 3 * idx + 1, 3 * idx + 2]).collect(),
    }
}

/// The transform of a node from its JSON: a column-major matrix, or scale, rotation and
/// translation.
fn local_transform(node: Option<&Value>) -> DAffine3 {
    let numbers =
        |key: &str| -> Option<Vec<f64>> { node?.get(key)?.as_array()?.iter().map(Value::as_f64).collect() };
    if let Some(matrix) = numbers("matrix").and_then(|m| <[f64; 16]>::try_from(m).ok()) {
        return DAffine3::from_mat4(DMat4::from_cols_array(&matrix));
    }
    let vector = |key: &str, default: DVec3| match numbers(key).as_deref() {
        Some(&[x, y, z]) => DVec3::new(x, y, z),
        _ => default,
    };
    let rotation = match numbers("rotation").as_deref() {
        // Exporters round quaternions to 32 bits, so they are normalized to pure rotations.
        Some(&[x, y, z, w]) if x * x + y * y + z * z + w * w > 0.0 => {
            DQuat::from_xyzw(x, y, z, w).normalize()
        }
        _ => DQuat::IDENTITY,
    };
    let (scale, translation) = (vector("scale", DVec3::ONE), vector("translation", DVec3::ZERO));
    DAffine3::from_scale_rotation_translation(scale, rotation, translation)
}

struct Material {
    /// Linear red, green and blue, and alpha.
    factor: [f64; 4],
    is_given: bool,
    is_blended: bool,
}

impl Material {
    fn new(primitive: &Primitive) -> Self {
        let material = primitive.material();
        let surface = material.pbr_metallic_roughness();
        Self {
            factor: surface.base_color_factor().map(f64::from),
            is_given: material.index().is_some(),
            is_blended: material.alpha_mode() == AlphaMode::Blend,
        }
    }

    /// The display-encoded product of the linear colour `part` and the colour of the material.
    fn display_color(&self, part: [f64; 4]) -> Rgba {
        let [red, green, blue, alpha] = [0, 1, 2, 3].map(|idx| part[idx] * self.factor[idx]);
        // Exactly 1 for white, where the transfer function has a rounding error.
        let encode = |linear: f64| if linear == 1.0 { 1.0 } else { srgb_encode(linear) };
        let alpha = if self.is_blended { alpha } else { 1.0 };
        Rgba([encode(red), encode(green), encode(blue), alpha])
    }

    fn color(&self) -> Option<Rgba> {
        self.is_given.then(|| self.display_color([1.0; 4]))
    }
}
