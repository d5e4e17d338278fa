//! Reads Stanford PLY: vertices, faces and triangle strips, in all three encodings; textures as
//! MeshLab and scanners state them, by a comment `TextureFile` and coordinates of vertices
//! (`texture_u`, `texture_v`; `s`, `t`; `u`, `v`) or of the corners of faces (`texcoord`).
//!
//! Not with a crate, because the available one refuses numbers such as `.5` and `nan` in text, and
//! keeps every row of every element in memory.

use glam::DVec3;
use ugscene::{ColorId, Texture, VertexId, shorten};

use super::corners::CornerSplitter;
use super::kind::Kind;
use super::text::{any_number, not_a_number};
use super::{GOES_ON, Input, strip};
use crate::builder::{Builder, Rgba};
use crate::error::Problem;
use crate::textures::{LoadedTexture, Textures, tinted};

pub(super) fn read(input: &Input<'_>, builder: &mut Builder) -> Result<(), Problem> {
    let Header { elements, mut body, pictures } = read_header(input.bytes, builder)?;
    let vertex = elements.iter().find(|element| element.name == "vertex");
    let vertex = vertex.ok_or_else(|| Problem::new("the element `vertex` is missing"))?;
    if let Some(slot) = (0..3).find(|&slot| !vertex.has(Role::Number(slot))) {
        return Err(Problem::new(format!("vertices have no property `{}`", NUMBERS[slot])));
    }
    let is_splat = |name: &str| vertex.properties.iter().any(|property| property.name == name);
    builder.others.has_splats = is_splat("f_dc_0") && is_splat("scale_0");
    let mut rows = Rows::new(input, &elements, &pictures, builder);
    // Faces before the vertices are read after them.
    let mut postponed = Vec::new();
    let mut is_ahead = true;
    for element in &elements {
        is_ahead &= element.name != "vertex";
        if is_ahead {
            postponed.push((element, body.clone()));
        }
        read_element(element, &mut body, is_ahead, &mut rows, builder)?;
    }
    for (element, mut body) in postponed {
        read_element(element, &mut body, false, &mut rows, builder)?;
    }
    if !body.bytes[body.at..].trim_ascii().is_empty() {
        builder.warn(GOES_ON.to_owned());
    }
    Ok(())
}

/// The numbers of vertices and faces that are used here.
const NUMBERS: [&str; 13] = [
    "x",
    "y",
    "z",
    "nx",
    "ny",
    "nz",
    "red",
    "green",
    "blue",
    "alpha",
    "texture_u",
    "texture_v",
    "texnumber",
];

/// The first colour in [`NUMBERS`], and alpha, the last.
const RED: usize = 6;
const ALPHA: usize = 9;
/// The first texture coordinate.
const TEXTURE_U: usize = 10;

/// Alternative names.
const ALIASES: [(&str, &str); 12] = [
    ("diffuse_red", "red"),
    ("diffuse_green", "green"),
    ("diffuse_blue", "blue"),
    ("r", "red"),
    ("g", "green"),
    ("b", "blue"),
    ("s", "texture_u"),
    ("t", "texture_v"),
    ("u", "texture_u"),
    ("v", "texture_v"),
    ("texture_s", "texture_u"),
    ("texture_t", "texture_v"),
];

fn kind(word: &str) -> Option<Kind> {
    Some(match word {
        "char" | "int8" => Kind::I8,
        "uchar" | "uint8" => Kind::U8,
        "short" | "int16" => Kind::I16,
        "ushort" | "uint16" => Kind::U16,
        "int" | "int32" => Kind::I32,
        "uint" | "uint32" => Kind::U32,
        "float" | "float32" => Kind::F32,
        "double" | "float64" => Kind::F64,
        _ => return None,
    })
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    /// A row of [`NUMBERS`].
    Number(usize),
    Corners,
    /// Texture coordinates of corners, u and v of each.
    TextureCorners,
    Ignored,
}

struct Property {
    name: String,
    role: Role,
    kind: Kind,
    /// The type of the length of a list.
    length: Option<Kind>,
}

struct Element {
    name: String,
    count: usize,
    properties: Vec<Property>,
}

impl Element {
    fn has(&self, role: Role) -> bool {
        self.properties.iter().any(|property| property.role == role)
    }

    fn has_color(&self) -> bool {
        (RED..RED + 3).all(|slot| self.has(Role::Number(slot)))
    }
}

struct Header<'a> {
    elements: Vec<Element>,
    body: Body<'a>,
    /// The files of textures.
    pictures: Vec<String>,
}

/// The rows of a file that are not yet read.
#[derive(Clone)]
struct Body<'a> {
    bytes: &'a [u8],
    at: usize,
    /// The line at `at` in a file of text.
    line: Option<usize>,
    is_little_endian: bool,
}

/// The first line of `bytes`, and the bytes after it.
fn next_line(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let len = bytes.iter().position(|byte| matches!(byte, b'\n' | b'\r'))?;
    let after = if bytes[len..].starts_with(b"\r\n") { len + 2 } else { len + 1 };
    Some((&bytes[..len], &bytes[after..]))
}

fn read_header<'a>(bytes: &'a [u8], builder: &mut Builder) -> Result<Header<'a>, Problem> {
    let mut rest = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut elements: Vec<Element> = Vec::new();
    let mut format = None;
    let mut pictures = Vec::new();
    for line in 1.. {
        let (text, after) = next_line(rest)
            .ok_or_else(|| Problem::at(line, "the header has no line `end_header`"))?;
        rest = after;
        let text = String::from_utf8_lossy(text);
        let bad =
            || Problem::at(line, format!("`{}` is not a line of a PLY header", shorten(&text)));
        let mut words = text.split_whitespace();
        match (words.next(), words.next()) {
            (Some("ply"), None) if line == 1 => {}
            _ if line == 1 => return Err(Problem::at(1, "a PLY file begins with the line `ply`")),
            (Some("comment"), word) => {
                let comment = text.trim_start().strip_prefix("comment").unwrap_or_default();
                builder.comment(comment);
                if word == Some("TextureFile") {
                    let name = comment.trim_start().strip_prefix("TextureFile");
                    pictures.push(name.unwrap_or_default().trim().to_owned());
                }
            }
            (Some("obj_info") | None, _) => {}
            (
                Some("format"),
                Some(kind @ ("ascii" | "binary_little_endian" | "binary_big_endian")),
            ) => {
                format = Some((kind == "ascii", kind == "binary_little_endian"));
            }
            (Some("element"), Some(name)) => {
                let count = words.next().and_then(|word| word.parse().ok()).ok_or_else(bad)?;
                elements.push(Element { name: name.to_owned(), count, properties: Vec::new() });
            }
            (Some("property"), Some(first)) => {
                let element = elements.last_mut().ok_or_else(bad)?;
                let mut next_kind = || words.next().and_then(kind).ok_or_else(bad);
                let (length, kind) = match first {
                    "list" => (Some(next_kind()?), next_kind()?),
                    _ => (None, kind(first).ok_or_else(bad)?),
                };
                let name = words.next().ok_or_else(bad)?;
                element.properties.push(Property {
                    name: name.to_owned(),
                    role: role(name, length),
                    kind,
                    length,
                });
            }
            (Some("end_header"), None) => {
                check_counts(&elements, rest.len())?;
                let (is_text, is_little_endian) =
                    format.ok_or_else(|| Problem::at(line, "the header has no line `format`"))?;
                let body = Body {
                    bytes: rest,
                    at: 0,
                    line: is_text.then_some(line + 1),
                    is_little_endian,
                };
                return Ok(Header { elements, body, pictures });
            }
            _ => return Err(bad()),
        }
    }
    unreachable!("lines end before they can be counted no more")
}

fn role(name: &str, length: Option<Kind>) -> Role {
    if length.is_some() {
        return match name {
            "vertex_indices" | "vertex_index" => Role::Corners,
            "texcoord" => Role::TextureCorners,
            _ => Role::Ignored,
        };
    }
    let name = ALIASES.iter().find(|(alias, _)| *alias == name).map_or(name, |(_, name)| name);
    NUMBERS.iter().position(|known| *known == name).map_or(Role::Ignored, Role::Number)
}

/// Rejects more rows than the file can contain.
fn check_counts(elements: &[Element], n_bytes: usize) -> Result<(), Problem> {
    for element in elements {
        // Every row takes at least one byte, unless it has no properties, which is useless.
        if element.count > n_bytes || (element.properties.is_empty() && element.count > 0) {
            let (count, name) = (element.count, shorten(&element.name));
            return Err(Problem::new(format!(
                "{count} rows of `{name}` are declared, but the file has fewer; copy it again"
            )));
        }
    }
    Ok(())
}

/// Reads the rows of an element, without using them if `is_skipped`.
fn read_element(
    element: &Element,
    body: &mut Body<'_>,
    is_skipped: bool,
    rows: &mut Rows,
    builder: &mut Builder,
) -> Result<(), Problem> {
    let has_color = element.has_color();
    let mut read = Row { numbers: [f64::NAN; NUMBERS.len()], corners: Vec::new(), uvs: Vec::new() };
    for row in 0..element.count {
        let Row { numbers, corners, uvs } = &mut read;
        *numbers = [f64::NAN; NUMBERS.len()];
        corners.clear();
        uvs.clear();
        for property in &element.properties {
            let place = |problem: Problem| Problem {
                what: format!(
                    "{} {}, {}: {}",
                    shorten(&element.name),
                    row,
                    shorten(&property.name),
                    problem.what
                ),
                ..problem
            };
            match property.length {
                None => {
                    let number = body.number(property.kind).map_err(place)?;
                    if let Role::Number(slot) = property.role {
                        // Integer colours use the full range of their type.
                        let is_color = (RED..=ALPHA).contains(&slot);
                        let full = if is_color { property.kind.full() } else { 1.0 };
                        numbers[slot] = number / full;
                    }
                }
                Some(length) => {
                    let length = body.number(length).map_err(place)?;
                    for _ in 0..length.max(0.0) as u64 {
                        let number = body.number(property.kind).map_err(place)?;
                        match property.role {
                            Role::Corners => corners.push(number as i64),
                            Role::TextureCorners => uvs.push(number),
                            Role::Number(_) | Role::Ignored => {}
                        }
                    }
                }
            }
        }
        builder.line = body.line.map_or(0, |line| u32::try_from(line).unwrap_or(u32::MAX));
        let at_line = |problem: Problem| Problem { line: body.line, ..problem };
        if !is_skipped {
            rows.add(&element.name, &read, has_color, builder).map_err(at_line)?;
        }
    }
    Ok(())
}

/// A row of an element.
struct Row {
    numbers: [f64; NUMBERS.len()],
    corners: Vec<i64>,
    /// u and v of each corner; empty without.
    uvs: Vec<f64>,
}

/// What rows become.
struct Rows {
    /// The colours of faces with a texture, by the number of the texture; `None` if its picture
    /// cannot be read.
    textures: Vec<Option<ColorId>>,
    /// Divides vertices with several texture coordinates.
    splitter: Option<CornerSplitter>,
}

impl Rows {
    /// Reads the textures, and tells what is not read.
    fn new(
        input: &Input<'_>,
        elements: &[Element],
        pictures: &[String],
        builder: &mut Builder,
    ) -> Self {
        let has = |role| elements.iter().any(|element| element.has(role));
        let has_uvs = has(Role::TextureCorners)
            || has(Role::Number(TEXTURE_U)) && has(Role::Number(TEXTURE_U + 1));
        let mut textures = Textures::new(input.memory);
        let loaded: Vec<Option<LoadedTexture>> = pictures
            .iter()
            .filter(|_| has_uvs)
            .map(|name| textures.load(name, || input.read_picture(name)))
            .collect();
        textures.warn(builder);
        let mut color = |texture: LoadedTexture| {
            let LoadedTexture { mean, image } = texture;
            let color = tinted(Rgba::opaque([1.0; 3]), mean);
            let texture = Texture::new(ColorId::from_index(0), image);
            builder.material(color, "", Some(texture), None)
        };
        let textures: Vec<_> = loaded.into_iter().map(|texture| texture.map(&mut color)).collect();
        if has_uvs && pictures.is_empty() {
            builder.warn(
                "texture coordinates are not read, since no `comment TextureFile` names a picture",
            );
        } else if !pictures.is_empty() && !has_uvs {
            let name = shorten(&pictures[0]);
            builder.warn(format!("texture `{name}` is not read: there are no coordinates"));
        }
        if textures.iter().any(Option::is_some) && elements.iter().any(Element::has_color) {
            builder.warn("colours of vertices and faces are not read, since there is a texture");
        }
        let is_read = |name: &str| matches!(name, "vertex" | "face" | "tristrips");
        let unread = elements.iter().filter(|it| it.count > 0 && !is_read(&it.name));
        let unread: Vec<_> = unread.take(5).map(|it| format!("`{}`", shorten(&it.name))).collect();
        if !unread.is_empty() {
            builder.warn(format!("elements that are not read: {}", unread.join(", ")));
        }
        Self { textures, splitter: None }
    }

    fn add(
        &mut self,
        name: &str,
        row: &Row,
        has_color: bool,
        builder: &mut Builder,
    ) -> Result<(), Problem> {
        let [x, y, z, nx, ny, nz, red, green, blue, alpha, u, v, texture] = row.numbers;
        let alpha = if alpha.is_nan() { 1.0 } else { alpha };
        let has_texture = self.textures.iter().any(Option::is_some);
        let color = (has_color && !has_texture).then_some(Rgba([red, green, blue, alpha]));
        match name {
            "vertex" => {
                let normal = DVec3::new(nx, ny, nz);
                let vertex = builder.vertex(DVec3::new(x, y, z), Some(normal), color)?;
                if has_texture {
                    builder.set_uv(vertex, Some(placed([u, v])));
                }
            }
            "face" => {
                let mut corners = vertices(builder, &row.corners)?;
                let texture = self.texture(texture);
                if texture.is_some() && row.uvs.len() == 2 * corners.len() {
                    self.divide(&mut corners, &row.uvs, builder)?;
                }
                let color = texture.or_else(|| color.and_then(|color| builder.color(color)));
                builder.face(&corners, color)?;
            }
            "tristrips" => {
                let color = self.texture(texture);
                // −1 ends a strip.
                for corners in row.corners.split(|&idx| idx < 0) {
                    let corners = vertices(builder, corners)?;
                    for [a, b, c] in strip(corners.len()) {
                        builder.face(&[corners[a], corners[b], corners[c]], color)?;
                    }
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// The colour of a face with the texture of this number, by default the first.
    fn texture(&self, number: f64) -> Option<ColorId> {
        let row = if number.is_nan() { 0.0 } else { number };
        let row = (row >= 0.0 && row.fract() == 0.0).then_some(row as usize)?;
        *self.textures.get(row)?
    }

    /// Replaces corners by vertices with their texture coordinates.
    fn divide(
        &mut self,
        corners: &mut [VertexId],
        uvs: &[f64],
        builder: &mut Builder,
    ) -> Result<(), Problem> {
        let n_vertices = builder.n_vertices();
        let splitter = self.splitter.get_or_insert_with(|| CornerSplitter::new(n_vertices));
        for (corner, uv) in corners.iter_mut().zip(uvs.as_chunks::<2>().0) {
            let normal = builder.scene().vertices[corner.index()].normal;
            let uv = placed(*uv);
            *corner = splitter.vertex(builder, *corner, normal, Some(uv))?;
        }
        Ok(())
    }
}

/// Texture coordinates with v downwards.
fn placed([u, v]: [f64; 2]) -> [f32; 2] {
    [u as f32, (1.0 - v) as f32]
}

fn vertices(builder: &Builder, corners: &[i64]) -> Result<Vec<VertexId>, Problem> {
    let vertex = |&idx: &i64| {
        u64::try_from(idx).ok().and_then(|idx| builder.vertex_at(idx)).ok_or_else(|| {
            let last = builder.n_vertices() as i64 - 1;
            Problem::new(format!(
                "a face refers to vertex {idx}, but vertices are numbered from 0 to {last}"
            ))
        })
    };
    corners.iter().map(vertex).collect()
}

impl Body<'_> {
    fn number(&mut self, kind: Kind) -> Result<f64, Problem> {
        let ends = |line| Problem { line, what: "the file ends here; copy it again".to_owned() };
        let Some(line) = &mut self.line else {
            let bytes = self.bytes.get(self.at..self.at + kind.size()).ok_or_else(|| ends(None))?;
            self.at += bytes.len();
            return Ok(kind.decode(bytes, self.is_little_endian));
        };
        while let Some(byte) = self.bytes.get(self.at).filter(|byte| byte.is_ascii_whitespace()) {
            let is_crlf = *byte == b'\r' && self.bytes.get(self.at + 1) == Some(&b'\n');
            *line += usize::from(matches!(byte, b'\n' | b'\r') && !is_crlf);
            self.at += 1;
        }
        let rest = &self.bytes[self.at..];
        let len = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        if len == 0 {
            return Err(ends(Some(*line)));
        }
        self.at += len;
        let word = std::str::from_utf8(&rest[..len]).unwrap_or("\u{fffd}");
        let number =
            any_number(word).ok_or_else(|| not_a_number(word, *line, "is not a number"))?;
        // As in a binary file.
        Ok(if kind == Kind::F32 { f64::from(number as f32) } else { number })
    }
}
