//! Reads Wavefront OBJ: vertices, normals, faces, colours of vertices and materials.
//!
//! Not with a crate, because the available ones duplicate the vertices of every group and texture
//! seam, so that neighbouring faces no longer share edges, and read only f32.

use std::borrow::Cow;
use std::collections::BTreeSet;

use glam::DVec3;
use rustc_hash::FxHashMap;
use ugphysics::srgb_decode;
use ugscene::{AlphaMode, ColorId, Texture, VertexId, Wrap, shorten};

use super::Input;
use super::corners::CornerSplitter;
use super::mtl::{self, MapFile, Material, Materials, without_comment};
use super::text::{any_number, not_a_number, numbers};
use crate::builder::{Builder, Rgba};
use crate::decode::decode;
use crate::error::Problem;
use crate::foreign::by_content;
use crate::textures::{LoadedTexture, TextureOrigin, Textures, tinted, with_opacity};

pub(super) fn read(input: &Input<'_>, builder: &mut Builder) -> Result<(), Problem> {
    let text = decode(input.bytes);
    let mut reader = Reader::new(input, builder);
    let mut in_head = true;
    for (line, statement) in statements(&text) {
        let statement = statement.trim();
        if let Some(comment) = statement.strip_prefix('#') {
            if in_head {
                reader.builder.comment(comment);
            }
            continue;
        }
        in_head &= statement.is_empty();
        reader.builder.line = u32::try_from(line).unwrap_or(u32::MAX);
        let at_line = |problem: Problem| Problem { line: Some(line), ..problem };
        reader.statement(line, without_comment(statement)).map_err(at_line)?;
    }
    reader.finish()
}

/// The picture with the colours and the opacity of the material in a row of those that an OBJ file
/// names.
pub(super) fn picture(input: &Input<'_>, row: usize) -> Result<Vec<u8>, Problem> {
    let text = decode(input.bytes);
    let mut builder = Builder::default();
    let mut reader = Reader::new(input, &mut builder);
    for (_, statement) in statements(&text) {
        let (keyword, rest) = mtl::split(without_comment(&statement));
        if keyword == "mtllib" {
            reader.load_materials(rest)?;
        }
    }
    let none = || Problem::new("it has no material with such a picture");
    let Material { texture, opacity, .. } = reader.materials.at(row).ok_or_else(none)?;
    let opacity = opacity.as_ref().ok_or_else(none)?;
    let colors = texture.as_ref().map(|map| &*map.file);
    with_opacity(|name| bytes_of(input, name), colors, &opacity.file).map_err(Problem::new)
}

/// The bytes of a picture file.
fn bytes_of(input: &Input<'_>, name: &str) -> Result<Vec<u8>, String> {
    Ok(input.read_picture(name)?.0)
}

/// The lines with their numbers. A backslash at the end of a line continues it on the next.
fn statements(text: &str) -> impl Iterator<Item = (usize, Cow<'_, str>)> {
    let mut lines = text.lines().enumerate();
    std::iter::from_fn(move || {
        let (idx, line) = lines.next()?;
        let mut statement = Cow::Borrowed(line);
        while statement.ends_with('\\') {
            // Appended in place, since a statement may continue over thousands of lines.
            let joined = statement.to_mut();
            joined.pop();
            joined.push(' ');
            joined.push_str(lines.next().map_or("", |(_, line)| line));
        }
        Some((idx + 1, statement))
    })
}

/// Words that begin statements of OBJ.
const KEYWORDS: [&str; 33] = [
    "v", "vt", "vn", "vp", "f", "fo", "l", "p", "o", "g", "s", "mg", "mtllib", "usemtl", "maplib",
    "usemap", "deg", "bmat", "step", "cstype", "curv", "curv2", "surf", "parm", "trim", "hole",
    "scrv", "sp", "end", "con", "bevel", "lod", "call",
];

/// Largest number of bytes of all material files of a mesh.
const MAX_MATERIAL_BYTES: u64 = 1 << 28;

struct Reader<'a> {
    input: &'a Input<'a>,
    builder: &'a mut Builder,
    normals: Vec<DVec3>,
    /// Texture coordinates, with v downwards.
    uvs: Vec<[f32; 2]>,
    /// The corners of all faces.
    corners: Vec<Corner>,
    /// For each face, its end in `corners`, its colour and its line.
    faces: Vec<(usize, Option<ColorId>, u32)>,
    /// The names of groups and objects, each with the first face that has it.
    groups: Vec<(usize, String)>,
    /// The name of the object, for faces without a group.
    object: String,
    materials: Materials,
    textures: Textures,
    /// Of colours with a texture, see [`MapFile::placement`].
    placements: FxHashMap<ColorId, [[f32; 2]; 2]>,
    /// The arguments of `mtllib` so far.
    libraries: BTreeSet<String>,
    /// How many more bytes files of materials may have.
    material_room: u64,
    /// The colour of the following faces.
    color: Option<ColorId>,
    has_vertex_colors: bool,
    n_skipped: usize,
    /// Corners whose normal does not exist.
    n_without_normal: usize,
    /// A statement of OBJ, and the first line that is none.
    has_statement: bool,
    unknown_line: Option<usize>,
    unknown_materials: BTreeSet<String>,
}

impl<'a> Reader<'a> {
    fn new(input: &'a Input<'a>, builder: &'a mut Builder) -> Self {
        Self {
            input,
            builder,
            normals: Vec::new(),
            uvs: Vec::new(),
            corners: Vec::new(),
            faces: Vec::new(),
            groups: Vec::new(),
            object: String::new(),
            materials: Materials::default(),
            textures: Textures::new(input.memory),
            placements: FxHashMap::default(),
            libraries: BTreeSet::new(),
            material_room: MAX_MATERIAL_BYTES,
            color: None,
            has_vertex_colors: false,
            n_skipped: 0,
            n_without_normal: 0,
            has_statement: false,
            unknown_line: None,
            unknown_materials: BTreeSet::new(),
        }
    }

    fn statement(&mut self, line: usize, statement: &str) -> Result<(), Problem> {
        let (keyword, rest) = mtl::split(statement);
        self.has_statement |= KEYWORDS.contains(&keyword);
        match keyword {
            "v" => self.vertex(line, rest)?,
            "vn" => self.normal(rest)?,
            "vt" => self.uv(rest),
            "f" | "fo" => self.face(rest)?,
            "l" | "p" | "curv" | "curv2" | "surf" => {
                self.n_skipped += 1;
                self.builder.others.has_lines |= keyword != "p";
            }
            "mtllib" => self.load_materials(rest)?,
            "usemtl" => self.use_material(rest),
            "o" => {
                self.object = rest.to_string();
                self.groups.push((self.faces.len(), self.object.clone()));
            }
            "g" => {
                // The standard calls faces without a group so.
                let name = if matches!(rest, "" | "default") { &self.object } else { rest };
                self.groups.push((self.faces.len(), name.to_string()));
            }
            "" => {}
            _ => self.unknown_line = self.unknown_line.or(Some(line)),
        }
        Ok(())
    }

    /// `v x y z`, optionally followed by a weight or by red, green and blue.
    fn vertex(&mut self, line: usize, rest: &str) -> Result<(), Problem> {
        let mut words = rest.split_whitespace();
        let position = numbers::<3>(&mut words, line, "vertex")?;
        let has_color = words.clone().count() >= 3;
        self.has_vertex_colors |= has_color;
        let color = if has_color { Some(vertex_color(&mut words, line)?) } else { None };
        self.builder.vertex(DVec3::from_array(position), None, color)?;
        Ok(())
    }

    /// NaN is accepted: some exporters write `nan` for faces without area.
    fn normal(&mut self, rest: &str) -> Result<(), Problem> {
        let mut parts = rest.split_whitespace().map_while(any_number);
        let (Some(x), Some(y), Some(z)) = (parts.next(), parts.next(), parts.next()) else {
            return Err(Problem::new("a normal needs 3 numbers"));
        };
        self.normals.push(DVec3::new(x, y, z) + DVec3::ZERO);
        Ok(())
    }

    /// `vt u [v]`. If a coordinate is not a number, vertices that use it have no texture
    /// coordinates.
    fn uv(&mut self, rest: &str) {
        let mut parts = rest.split_whitespace().map_while(any_number);
        let (u, v) = (parts.next().unwrap_or(f64::NAN), parts.next().unwrap_or(0.0));
        self.uvs.push([u as f32, (1.0 - v) as f32]);
    }

    fn face(&mut self, rest: &str) -> Result<(), Problem> {
        for word in rest.split_whitespace() {
            let corner = self.corner(word)?;
            self.corners.push(corner);
        }
        self.faces.push((self.corners.len(), self.color, self.builder.line));
        Ok(())
    }

    /// A corner `v`, `v/vt`, `v//vn` or `v/vt/vn`, with indices counted from 1, or backwards from
    /// −1.
    fn corner(&mut self, word: &str) -> Result<Corner, Problem> {
        let mut parts = word.split('/');
        let [position, uv, normal] = std::array::from_fn(|_| parts.next().unwrap_or_default());
        let n_vertices = self.builder.n_vertices();
        let vertex = row(position, n_vertices)
            .and_then(|row| self.builder.vertex_at(row))
            .ok_or_else(|| {
                Problem::new(format!(
                    "a face refers to vertex `{}`, but there are {n_vertices} before it",
                    shorten(position)
                ))
            })?;
        let uv = row(uv, self.uvs.len())
            .filter(|&row| row < self.uvs.len() as u64)
            .map(|row| row as u32);
        if normal.is_empty() {
            return Ok(Corner { vertex, uv, normal: None });
        }
        let normal = row(normal, self.normals.len()).filter(|&row| row < self.normals.len() as u64);
        self.n_without_normal += usize::from(normal.is_none());
        Ok(Corner { vertex, uv, normal: normal.map(|row| row as u32) })
    }

    /// `mtllib` allows several names, but a single name with spaces is more common, so that is
    /// tried first.
    fn load_materials(&mut self, rest: &str) -> Result<(), Problem> {
        if !self.libraries.insert(rest.to_owned()) {
            return Ok(());
        }
        if let Ok((bytes, _)) = self.input.read_named(rest, self.material_room + 1) {
            return self.add_materials(rest, &bytes);
        }
        for name in rest.split_whitespace() {
            match self.input.read_named(name, self.material_room + 1) {
                Ok((bytes, _)) => self.add_materials(name, &bytes)?,
                Err(error) => {
                    self.builder.warn(format!(
                        "colours are missing: cannot read `{}`: {error}",
                        shorten(name)
                    ));
                }
            }
        }
        Ok(())
    }

    fn add_materials(&mut self, name: &str, bytes: &[u8]) -> Result<(), Problem> {
        if let Some(foreign) = by_content(bytes) {
            let (name, remedy) = (shorten(name), foreign.remedy());
            self.builder.warn(format!("colours are missing: `{name}` is {foreign}; {remedy}"));
        }
        self.material_room = self.material_room.checked_sub(bytes.len() as u64).ok_or_else(|| {
            Problem::new(format!(
                "the files of materials have more than {MAX_MATERIAL_BYTES} bytes together, the limit"
            ))
        })?;
        self.materials.add(bytes, self.builder);
        Ok(())
    }

    fn use_material(&mut self, name: &str) {
        let Some((row, material)) = self.materials.get(name) else {
            self.unknown_materials.insert(name.to_string());
            self.color = None;
            return;
        };
        let material = material.clone();
        let mut color = material.color;
        let emitted = self.emitted(&material, name);
        let (loaded, mode) = self.pictures(&material, row, name);
        // Exporters write so where the texture alone has the colour.
        if material.texture.is_some() && color.0[..3] == [0.0; 3] {
            self.builder.warn(format!(
                "material `{}` is black and has a texture, which alone colours its faces",
                shorten(name)
            ));
            color = Rgba([1.0, 1.0, 1.0, color.0[3]]);
        }
        let map = material.texture.or(material.opacity).unwrap_or_default();
        let texture = loaded.as_ref().map(|LoadedTexture { image, .. }| {
            let [red, green, blue, alpha] = color.0;
            let factor = [red, green, blue].map(|part| srgb_decode(part.clamp(0.0, 1.0)) as f32);
            let wrap = [if map.is_clamped { Wrap::Clamp } else { Wrap::Repeat }; 2];
            Texture {
                factor: [factor[0], factor[1], factor[2], alpha.clamp(0.0, 1.0) as f32],
                wrap,
                alpha: if alpha < 1.0 { AlphaMode::Blend } else { mode },
                ..Texture::new(ColorId::from_index(0), image.clone())
            }
        });
        let tinted = loaded.map_or(color, |LoadedTexture { mean, .. }| tinted(color, mean));
        let id = self.builder.material(tinted, name, texture, emitted);
        self.placements.extend(map.placement.map(|placement| (id, placement)));
        self.color = Some(id);
    }

    /// The picture of a material, with its opacity.
    fn pictures(
        &mut self,
        material: &Material,
        row: usize,
        name: &str,
    ) -> (Option<LoadedTexture>, AlphaMode) {
        let (texture, Some(opacity)) = (&material.texture, &material.opacity) else {
            let file = material.texture.as_ref().map(|map| &map.file);
            return (file.and_then(|file| self.texture(file)), AlphaMode::Opaque);
        };
        let plain = texture.as_ref().and_then(|map| self.texture(&map.file));
        match texture {
            // Of one picture, alpha is the opacity.
            Some(map) if map.file == opacity.file => return (plain, AlphaMode::Blend),
            Some(map) if map.placement != opacity.placement => {
                self.builder.warn(format!(
                    "`map_d` of material `{}` is not read, since it is placed otherwise than `map_Kd`",
                    shorten(name)
                ));
                return (plain, AlphaMode::Opaque);
            }
            _ => {}
        }
        let input = self.input;
        let base = texture.as_ref().filter(|_| plain.is_some()).map(|map| &*map.file);
        let key = format!("{} {}", base.unwrap_or_default(), opacity.file);
        let load = || {
            let both = with_opacity(|name| bytes_of(input, name), base, &opacity.file)?;
            Ok((both, TextureOrigin::Within(row)))
        };
        match self.textures.load(key.trim_start(), load) {
            Some(both) => (Some(both), AlphaMode::Blend),
            None => (plain, AlphaMode::Opaque),
        }
    }

    /// The colour that a material emits, whose factor is display-encoded up to 1.
    fn emitted(&mut self, material: &Material, name: &str) -> Option<ColorId> {
        let (factor, file) = &material.emitted;
        let picture = file.as_ref().and_then(|MapFile { file, .. }| self.texture(file));
        let picture = picture.map(|it| (Texture::new(ColorId::from_index(0), it.image), it.mean));
        // Exporters write black where the texture alone has the colour.
        let is_bare = picture.is_some() && *factor == [0.0; 3];
        let factor = if is_bare { [1.0; 3] } else { *factor };
        let scale = factor.into_iter().fold(1.0, f64::max);
        self.builder.emitted(factor.map(|part| scale * srgb_decode(part / scale)), name, picture)
    }

    fn texture(&mut self, file: &str) -> Option<LoadedTexture> {
        let input = self.input;
        self.textures.load(file, || input.read_picture(file))
    }

    /// Builds the faces, after all vertices have been read.
    fn finish(mut self) -> Result<(), Problem> {
        if let (false, Some(line)) = (self.has_statement, self.unknown_line) {
            return Err(Problem::at(
                line,
                "this is not an OBJ file: no line of it is a statement of OBJ",
            ));
        }
        let mut splitter = CornerSplitter::new(self.builder.n_vertices());
        let mut start = 0;
        let mut groups = self.groups.iter().peekable();
        for (row, &(end, color, line)) in self.faces.iter().enumerate() {
            self.builder.line = line;
            let begun = std::iter::from_fn(|| groups.next_if(|(first, _)| *first <= row));
            if let Some((_, name)) = begun.last() {
                self.builder.name_faces(name);
            }
            // Without a texture, seams would only divide the faces.
            let has_texture = color.is_some_and(|color| self.builder.has_texture(color));
            let corners = self.corners[start..end].iter().map(|&Corner { vertex, uv, normal }| {
                let normal = normal.map(|row| self.normals[row as usize]).filter(|n| n.is_finite());
                let uv = uv.filter(|_| has_texture).map(|row| self.uvs[row as usize]);
                let uv =
                    uv.map(|[u, v]| match color.and_then(|color| self.placements.get(&color)) {
                        // v downwards, the placement is for upwards.
                        Some([s, o]) => [u * s[0] + o[0], 1.0 - ((1.0 - v) * s[1] + o[1])],
                        None => [u, v],
                    });
                splitter.vertex(self.builder, vertex, normal, uv)
            });
            let corners = corners.collect::<Result<Vec<_>, _>>()?;
            self.builder.face(&corners, color)?;
            start = end;
        }
        self.warn();
        Ok(())
    }

    fn warn(&mut self) {
        // Colours at the vertices need no materials.
        if self.libraries.is_empty() && self.has_vertex_colors {
            self.unknown_materials.clear();
        }
        let names: Vec<String> = self
            .unknown_materials
            .iter()
            .take(5)
            .map(|name| format!("`{}`", shorten(name)))
            .collect();
        if !names.is_empty() {
            let more = if self.unknown_materials.len() > names.len() { ", …" } else { "" };
            self.builder.warn(format!("materials without colour: {}{more}", names.join(", ")));
        }
        self.textures.ignored.append(&mut self.materials.ignored);
        self.textures.warn(self.builder);
        self.builder.warn_count(
            self.n_without_normal,
            "corner refers to a normal that does not exist, and has none",
            "corners refer to normals that do not exist, and have none",
        );
        self.builder.warn_count(
            self.n_skipped,
            "line, point or curve is left out",
            "lines, points or curves are left out",
        );
    }
}

/// Three numbers, of which any may be NaN.
fn vertex_color<'t>(
    words: &mut impl Iterator<Item = &'t str>,
    line: usize,
) -> Result<Rgba, Problem> {
    let mut color = [0.0; 3];
    for (part, word) in color.iter_mut().zip(words) {
        let what = "in a vertex colour is not a number";
        *part = any_number(word).ok_or_else(|| not_a_number(word, line, what))?;
    }
    Ok(Rgba::opaque(color))
}

/// A corner of a face.
#[derive(Clone, Copy)]
struct Corner {
    vertex: VertexId,
    /// Row of the texture coordinates.
    uv: Option<u32>,
    /// Row of the normals.
    normal: Option<u32>,
}

/// The row, counted from 0, for an index counted from 1, or backwards from −1.
fn row(word: &str, n_rows: usize) -> Option<u64> {
    let number: i64 = word.parse().ok()?;
    let row = if number < 0 { number.checked_add_unsigned(n_rows as u64)? } else { number - 1 };
    u64::try_from(row).ok()
}
