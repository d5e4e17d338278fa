//! Reads glTF 2.0: the nodes of its scene, with transforms, normals and colours.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::rc::Rc;

use base64::Engine;
use base64::alphabet;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};
use rustc_hash::FxHashMap;
use ugphysics::srgb_encode;
use ugscene::{VertexId, shorten};

use super::gltf_document::{Document, Instances, Material, Node, Primitive, Whole, split, view_bytes};
use super::{Input, strip};
use crate::builder::{Builder, Rgba};
use crate::error::Problem;
use crate::textures::{MAX_TEXTURE_BYTES, Textures};

pub(super) fn read(input: &Input<'_>, builder: &mut Builder) -> Result<(), Problem> {
    let (json, blob) = split(input.bytes)?;
    let document = Document::parse(json)?;
    if let Some(copyright) = &document.asset.copyright {
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
        textures: Textures::default(),
    };
    reader.scene()?;
    let Reader { n_skipped, n_without_positions, textures, .. } = reader;
    if document.nodes.iter().any(|node| node.skin.is_some()) {
        builder.warn("skins are ignored: skinned meshes are read in their bind pose");
    }
    textures.warn(builder);
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
    for (index, buffer) in document.buffers.iter().enumerate() {
        let length = buffer.byte_length.0;
        room = room.checked_sub(length as u64).ok_or_else(|| {
            let what = "the buffers have more than";
            Problem::new(format!("{what} {MAX_BUFFER_BYTES} bytes together, the limit; split the mesh"))
        })?;
        let bytes: Cow<[u8]> = match &buffer.uri {
            Some(uri) => load(uri, length as u64, input)?.into(),
            None => match blob.take() {
                Some(blob) => blob.into(),
                None => {
                    buffers.push(Cow::default());
                    continue;
                }
            },
        };
        if bytes.len() < length {
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
}

impl Reader<'_, '_> {
    /// Reads all nodes of the default scene or, if there is none, of the first scene. Without any
    /// scene, the nodes without parents are the roots.
    fn scene(&mut self) -> Result<(), Problem> {
        let Document { nodes, meshes, scenes, .. } = self.document;
        let roots: Vec<Whole> = match scenes.get(self.document.scene.unwrap_or_default().0) {
            Some(scene) => scene.nodes.clone(),
            None => {
                let children = nodes.iter().flat_map(|node| &node.children).map(|child| child.0);
                let children: BTreeSet<usize> = children.collect();
                (0..nodes.len()).filter(|row| !children.contains(row)).map(Whole).collect()
            }
        };
        let mut is_visited = vec![false; nodes.len()];
        let mut todo: Vec<_> = roots.into_iter().map(|node| (node, DAffine3::IDENTITY)).collect();
        todo.reverse();
        while let Some((index, scene_from_parent)) = todo.pop() {
            let node = Document::row(nodes, index, "node")?;
            if std::mem::replace(&mut is_visited[index.0], true) {
                let what = format!("node {} has two parents; export the mesh again", index.0);
                return Err(Problem::new(what));
            }
            let scene_from_node = scene_from_parent * local_transform(node);
            if let Some(mesh) = node.mesh {
                let mesh = Document::row(meshes, mesh, "mesh")?;
                self.builder.name_faces(node.name.as_deref().or(mesh.name.as_deref()).unwrap_or_default());
                // Joints place a mesh with a skin; its node does not.
                let placed = if node.skin.is_some() { DAffine3::IDENTITY } else { scene_from_node };
                for node_from_instance in self.instances(node)? {
                    for primitive in &mesh.primitives {
                        self.primitive(primitive, placed * node_from_instance)?;
                    }
                }
            }
            todo.extend(node.children.iter().rev().map(|&child| (child, scene_from_node)));
        }
        Ok(())
    }

    /// The transforms of the instances of a node's mesh; the identity if it states none.
    fn instances(&mut self, node: &Node) -> Result<Vec<DAffine3>, Problem> {
        let Some(Instances { attributes }) = &node.extensions.instances else {
            return Ok(vec![DAffine3::IDENTITY]);
        };
        let mut rows = |name: &str, n_components: usize| match attributes.get(name) {
            Some(&index) => self.rows(index, n_components, name).map(Some),
            None => Ok(None),
        };
        let (places, turns, sizes) = (rows("TRANSLATION", 3)?, rows("ROTATION", 4)?, rows("SCALE", 3)?);
        let lengths = [(&places, 3), (&turns, 4), (&sizes, 3)];
        let count = lengths.iter().filter_map(|(rows, width)| Some(rows.as_ref()?.len() / width)).min();
        let row = |rows: &Option<Rc<Vec<f64>>>, row: usize, width: usize| {
            rows.as_ref().map(|rows| rows[width * row..width * (row + 1)].to_vec())
        };
        let instance = |idx: usize| {
            let part = |rows, width| row(rows, idx, width);
            transform(
                part(&places, 3).and_then(|part| part.try_into().ok()),
                part(&turns, 4).and_then(|part| part.try_into().ok()),
                part(&sizes, 3).and_then(|part| part.try_into().ok()),
            )
        };
        Ok((0..count.unwrap_or(1)).map(instance).collect())
    }

    fn primitive(&mut self, primitive: &Primitive, scene_from_node: DAffine3) -> Result<(), Problem> {
        let mode = primitive.mode.map_or(TRIANGLES, |mode| mode.0);
        if !(TRIANGLES..=TRIANGLE_FAN).contains(&mode) {
            self.n_skipped += 1;
            return Ok(());
        }
        let Some(&positions) = primitive.attributes.get("POSITION") else {
            self.n_without_positions += 1;
            return Ok(());
        };
        let positions = self.rows(positions, 3, "POSITION")?;
        let n_positions = positions.len() / 3;
        let normals = match primitive.attributes.get("NORMAL") {
            Some(&normals) => Some(self.rows(normals, 3, "NORMAL")?),
            None => None,
        };
        let material = match primitive.material {
            Some(index) => Some(Document::row(&self.document.materials, index, "material")?),
            None => None,
        };
        let surface = self.surface(material);
        let colors = self.colors(primitive, &surface)?;
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
        let color = match (&colors, material) {
            (None, Some(material)) => {
                Some(self.builder.material(surface.display_color([1.0; 4]), &material.name))
            }
            _ => None,
        };
        // A reflection reverses the orientation of triangles.
        let is_mirrored = scene_from_node.matrix3.determinant() < 0.0;
        for [a, b, c] in triangles(mode, corners.len()) {
            let triangle = if is_mirrored { [a, c, b] } else { [a, b, c] };
            self.builder.face(&triangle.map(|corner| vertices[corners[corner]]), color)?;
        }
        Ok(())
    }

    /// The colour of a material, times the mean of its texture; white without one.
    fn surface(&mut self, material: Option<&Material>) -> Surface {
        let Some(material) = material else { return Surface { factor: [1.0; 4], is_blended: false } };
        let specular = material.extensions.specular_glossiness.as_ref();
        let color = specular.unwrap_or(&material.pbr_metallic_roughness);
        let mut factor = color.factor.unwrap_or([1.0; 4]);
        if let Some(mean) = color.texture.as_ref().and_then(|texture| self.texture_mean(texture.index)) {
            factor.iter_mut().zip(mean).for_each(|(factor, mean)| *factor *= mean);
        }
        Surface { factor, is_blended: material.alpha_mode == "BLEND" }
    }

    /// The mean linear light of a texture.
    fn texture_mean(&mut self, index: Whole) -> Option<[f64; 3]> {
        let Document { textures, images, buffer_views, .. } = self.document;
        let (buffers, input) = (&self.buffers, self.input);
        let source = textures.get(index.0).and_then(|texture| texture.source);
        let Some(image) = source.and_then(|source| images.get(source.0)) else {
            let none = || Err("it has no PNG or JPEG picture".to_owned());
            return self.textures.mean(&format!("texture {}", index.0), none);
        };
        let number = format!("image {}", source.unwrap_or_default().0);
        if let Some(uri) = &image.uri {
            let name = if uri.starts_with("data:") { number } else { percent_decoded(uri) };
            let load = || load(uri, MAX_TEXTURE_BYTES, input).map_err(|problem| problem.what);
            return self.textures.mean(&name, load);
        }
        let view = image.buffer_view.and_then(|view| buffer_views.get(view.0));
        let bytes = view.and_then(|view| view_bytes(view, buffers));
        self.textures
            .mean(&number, || bytes.map(<[u8]>::to_vec).ok_or_else(|| "it is not in the buffers".to_owned()))
    }

    /// The index of the primitive's vertex for each corner.
    fn corners(&mut self, primitive: &Primitive, n_positions: usize) -> Result<Vec<usize>, Problem> {
        let Some(index) = primitive.indices else { return Ok((0..n_positions).collect()) };
        if !Document::row(&self.document.accessors, index, "accessor")?.is_index() {
            return Err(Problem::new("indices are not unsigned integers; export the mesh again"));
        }
        let corners: Vec<usize> = self.numbers(index)?.iter().map(|&row| row as usize).collect();
        match corners.iter().find(|&&row| row >= n_positions) {
            Some(row) => {
                Err(Problem::new(format!("a triangle refers to vertex {row}, but there are {n_positions}")))
            }
            None => Ok(corners),
        }
    }

    /// `COLOR_0` times the colour of the material (both linear), display-encoded.
    fn colors(&mut self, primitive: &Primitive, surface: &Surface) -> Result<Option<Vec<Rgba>>, Problem> {
        let Some(&index) = primitive.attributes.get("COLOR_0") else { return Ok(None) };
        let n_components = Document::row(&self.document.accessors, index, "accessor")?.n_components()?;
        if !(3..=4).contains(&n_components) {
            return Err(Problem::new("`COLOR_0` must have three or four components"));
        }
        let numbers = self.numbers(index)?;
        let colors = numbers.chunks_exact(n_components).map(|part| {
            let alpha = part.get(3).copied().unwrap_or(1.0);
            surface.display_color([part[0], part[1], part[2], alpha])
        });
        Ok(Some(colors.collect()))
    }

    /// The numbers of an accessor with rows of `width` components.
    fn rows(&mut self, index: Whole, width: usize, name: &str) -> Result<Rc<Vec<f64>>, Problem> {
        let accessor = Document::row(&self.document.accessors, index, "accessor")?;
        if accessor.n_components()? != width {
            return Err(Problem::new(format!(
                "`{name}` must have {width} components; export the mesh again"
            )));
        }
        self.numbers(index)
    }

    fn numbers(&mut self, index: Whole) -> Result<Rc<Vec<f64>>, Problem> {
        if let Some(known) = self.numbers.get(&index.0) {
            return Ok(Rc::clone(known));
        }
        let accessor = Document::row(&self.document.accessors, index, "accessor")?;
        let n_numbers = accessor.count.0.saturating_mul(accessor.n_components()?);
        self.room = self.room.checked_sub(n_numbers).ok_or_else(|| {
            Problem::new(format!(
                "the accessors have more than {MAX_NUMBERS} numbers together; split the mesh"
            ))
        })?;
        let numbers = Rc::new(accessor.read(self.document, &self.buffers)?);
        self.numbers.insert(index.0, Rc::clone(&numbers));
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
fn local_transform(node: &Node) -> DAffine3 {
    match &node.matrix {
        Some(matrix) => DAffine3::from_mat4(DMat4::from_cols_array(matrix)),
        None => transform(node.translation, node.rotation, node.scale),
    }
}

fn transform(translation: Option<[f64; 3]>, rotation: Option<[f64; 4]>, scale: Option<[f64; 3]>) -> DAffine3 {
    // Exporters round quaternions to 32 bits, so they are normalized to pure rotations.
    let rotation = DQuat::from_array(rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]));
    let rotation = if rotation.length_squared() > 0.0 { rotation.normalize() } else { DQuat::IDENTITY };
    let [scale, translation] = [scale.unwrap_or([1.0; 3]), translation.unwrap_or_default()].map(DVec3::from);
    DAffine3::from_scale_rotation_translation(scale, rotation, translation)
}

/// The colour of a primitive: linear red, green and blue, and alpha.
struct Surface {
    factor: [f64; 4],
    is_blended: bool,
}

impl Surface {
    /// The display-encoded product of the linear colour `part` and the colour of the material.
    fn display_color(&self, part: [f64; 4]) -> Rgba {
        let [red, green, blue, alpha] = [0, 1, 2, 3].map(|idx| part[idx] * self.factor[idx]);
        // Exactly 1 for white, where the transfer function has a rounding error.
        let encode = |linear: f64| if linear == 1.0 { 1.0 } else { srgb_encode(linear) };
        let alpha = if self.is_blended { alpha } else { 1.0 };
        Rgba([encode(red), encode(green), encode(blue), alpha])
    }
}
