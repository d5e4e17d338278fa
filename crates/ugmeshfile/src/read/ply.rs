//! Reads Stanford PLY: vertices, faces and triangle strips, in all three encodings.
//!
//! Not with a crate, because the available one refuses numbers such as `.5` and `nan` in text, and
//! keeps every row of every element in memory.

use glam::DVec3;
use ugscene::{VertexId, shorten};

use super::kind::Kind;
use super::text::{any_number, not_a_number};
use super::{GOES_ON, strip};
use crate::builder::{Builder, Rgba};
use crate::error::Problem;

pub(super) fn read(bytes: &[u8], builder: &mut Builder) -> Result<(), Problem> {
    let (elements, mut body) = read_header(bytes, builder)?;
    let vertex = elements.iter().find(|element| element.name == "vertex");
    let vertex = vertex.ok_or_else(|| Problem::new("the element `vertex` is missing"))?;
    let has =
        |slot: usize| vertex.properties.iter().any(|property| property.role == Role::Number(slot));
    if let Some(slot) = (0..3).find(|&slot| !has(slot)) {
        return Err(Problem::new(format!("vertices have no property `{}`", NUMBERS[slot])));
    }
    // Faces before the vertices are read after them.
    let mut postponed = Vec::new();
    let mut is_ahead = true;
    for element in &elements {
        is_ahead &= element.name != "vertex";
        if is_ahead {
            postponed.push((element, body.clone()));
        }
        read_element(element, &mut body, is_ahead, builder)?;
    }
    for (element, mut body) in postponed {
        read_element(element, &mut body, false, builder)?;
    }
    if !body.bytes[body.at..].trim_ascii().is_empty() {
        builder.warn(GOES_ON.to_owned());
    }
    Ok(())
}

/// The numbers of vertices and faces that are used here.
const NUMBERS: [&str; 10] = ["x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "alpha"];

/// The first colour in [`NUMBERS`].
const RED: usize = 6;

/// Alternative names of colours.
const ALIASES: [(&str, &str); 6] = [
    ("diffuse_red", "red"),
    ("diffuse_green", "green"),
    ("diffuse_blue", "blue"),
    ("r", "red"),
    ("g", "green"),
    ("b", "blue"),
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

fn read_header<'a>(
    bytes: &'a [u8],
    builder: &mut Builder,
) -> Result<(Vec<Element>, Body<'a>), Problem> {
    let mut rest = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut elements: Vec<Element> = Vec::new();
    let mut format = None;
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
            (Some("comment"), _) => {
                builder.comment(text.trim_start().strip_prefix("comment").unwrap_or_default());
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
                return Ok((elements, body));
            }
            _ => return Err(bad()),
        }
    }
    unreachable!("lines end before they can be counted no more")
}

fn role(name: &str, length: Option<Kind>) -> Role {
    if length.is_some() {
        return if matches!(name, "vertex_indices" | "vertex_index") {
            Role::Corners
        } else {
            Role::Ignored
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
    builder: &mut Builder,
) -> Result<(), Problem> {
    let mut corners = Vec::new();
    for row in 0..element.count {
        let mut numbers = [f64::NAN; NUMBERS.len()];
        corners.clear();
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
                        let full = if slot >= RED { property.kind.full() } else { 1.0 };
                        numbers[slot] = number / full;
                    }
                }
                Some(length) => {
                    let length = body.number(length).map_err(place)?;
                    for _ in 0..length.max(0.0) as u64 {
                        let number = body.number(property.kind).map_err(place)?;
                        if property.role == Role::Corners {
                            corners.push(number as i64);
                        }
                    }
                }
            }
        }
        builder.line = body.line.map_or(0, |line| u32::try_from(line).unwrap_or(u32::MAX));
        let at_line = |problem: Problem| Problem { line: body.line, ..problem };
        if !is_skipped {
            add_row(&element.name, &numbers, &corners, builder).map_err(at_line)?;
        }
    }
    Ok(())
}

fn add_row(
    name: &str,
    numbers: &[f64; 10],
    corners: &[i64],
    builder: &mut Builder,
) -> Result<(), Problem> {
    let [x, y, z, nx, ny, nz, red, green, blue, alpha] = *numbers;
    let alpha = if alpha.is_nan() { 1.0 } else { alpha };
    let color = (!(red + green + blue).is_nan()).then_some(Rgba([red, green, blue, alpha]));
    match name {
        "vertex" => {
            builder.vertex(DVec3::new(x, y, z), Some(DVec3::new(nx, ny, nz)), color)?;
        }
        "face" => {
            let corners = vertices(builder, corners)?;
            let color = color.map(|color| builder.color(color));
            builder.face(&corners, color)?;
        }
        "tristrips" => {
            // −1 ends a strip.
            for corners in corners.split(|&idx| idx < 0) {
                let corners = vertices(builder, corners)?;
                for [a, b, c] in strip(corners.len()) {
                    builder.face(&[corners[a], corners[b], corners[c]], None)?;
                }
            }
        }
        _ => {}
    }
    Ok(())
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
