//! Reads Stanford PLY: vertices, faces and triangle strips, in all three encodings.

use std::borrow::Cow;
use std::io::Cursor;

use glam::DVec3;
use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{Header, Property, PropertyAccess, PropertyAccessResult, PropertyType};
use ugscene::VertexId;
use ugscene::shorten;

use super::strip;
use crate::builder::{Builder, Rgba};
use crate::error::Problem;

pub(super) fn read(bytes: &[u8], builder: &mut Builder) -> Result<(), Problem> {
    let bytes = &*with_line_feeds(bytes);
    let parser = Parser::<Row>::new();
    let mut reader = Reader::new(Cursor::new(bytes));
    let header = parser.read_header(&mut reader).map_err(problem)?;
    check(&header, bytes.len())?;
    let mut payload = parser.read_payload(&mut reader, &header).map_err(problem)?;

    header.comments.iter().for_each(|comment| builder.comment(comment));
    for vertex in payload.swap_remove("vertex").unwrap_or_default() {
        let position = DVec3::new(vertex.get("x"), vertex.get("y"), vertex.get("z"));
        let normal = DVec3::new(vertex.get("nx"), vertex.get("ny"), vertex.get("nz"));
        builder.vertex(position, Some(normal), vertex.color())?;
    }
    for face in payload.swap_remove("face").unwrap_or_default() {
        let corners = face.corners.iter().map(|&idx| corner(builder, idx)).collect::<Result<Vec<_>, _>>()?;
        let color = face.color().map(|color| builder.color(color));
        builder.face(&corners, color)?;
    }
    for strips in payload.swap_remove("tristrips").unwrap_or_default() {
        // −1 ends a strip.
        for corners in strips.corners.split(|&idx| idx < 0) {
            let corners = corners.iter().map(|&idx| corner(builder, idx)).collect::<Result<Vec<_>, _>>()?;
            for [a, b, c] in strip(corners.len()) {
                builder.face(&[corners[a], corners[b], corners[c]], None)?;
            }
        }
    }
    Ok(())
}

/// The file with line feeds where it has carriage returns alone, which the parser does not accept:
/// in the header, and in rows of text.
fn with_line_feeds(bytes: &[u8]) -> Cow<'_, [u8]> {
    const LAST: &[u8] = b"\rend_header\r";
    if !bytes.starts_with(b"ply\r") || bytes.starts_with(b"ply\r\n") {
        return bytes.into();
    }
    let Some(at) = bytes.windows(LAST.len()).position(|word| word == LAST) else { return bytes.into() };
    let is_text = bytes[..at].windows(6).any(|word| word == b" ascii");
    let n_converted = if is_text { bytes.len() } else { at + LAST.len() };
    let mut converted = bytes.to_vec();
    for byte in &mut converted[..n_converted] {
        *byte = if *byte == b'\r' { b'\n' } else { *byte };
    }
    converted.into()
}

/// Rejects what the parser would accept: more rows than the file can contain, and vertices without
/// coordinates.
fn check(header: &Header, n_bytes: usize) -> Result<(), Problem> {
    for element in header.elements.values() {
        // Every row takes at least one byte, unless it has no properties, which is useless.
        if element.count > n_bytes || (element.properties.is_empty() && element.count > 0) {
            let (count, name) = (element.count, shorten(&element.name));
            return Err(Problem::new(format!(
                "{count} rows of `{name}` are declared, but the file has fewer; copy it again"
            )));
        }
    }
    let Some(vertex) = header.elements.get("vertex") else {
        return Err(Problem::new("the element `vertex` is missing"));
    };
    let is_number = |name: &&str| {
        vertex
            .properties
            .get(*name)
            .is_some_and(|property| matches!(property.data_type, PropertyType::Scalar(_)))
    };
    match ["x", "y", "z"].iter().find(|name| !is_number(name)) {
        Some(name) => Err(Problem::new(format!("vertices have no property `{name}`"))),
        None => Ok(()),
    }
}

fn corner(builder: &Builder, idx: i64) -> Result<VertexId, Problem> {
    u64::try_from(idx).ok().and_then(|idx| builder.vertex_at(idx)).ok_or_else(|| {
        let last = builder.n_vertices() as i64 - 1;
        Problem::new(format!("a face refers to vertex {idx}, but vertices are numbered from 0 to {last}"))
    })
}

/// The first line of the parser's message, which has several.
fn problem(error: ply_rs_bw::parser::ParseError) -> Problem {
    let text = error.to_string();
    let first = text.lines().next().unwrap_or_default();
    let what = first.split_once(": ").filter(|_| error.line().is_some()).map_or(first, |(_, what)| what);
    let what: String = what.trim_end_matches('.').chars().take(200).collect();
    let mut letters = what.chars();
    let what = letters.next().map(|c| c.to_ascii_lowercase()).into_iter().chain(letters).collect::<String>();
    Problem { line: error.line(), what }
}

/// The properties of a vertex, face or strip that are used here.
struct Row {
    /// The properties in the order of [`NUMBERS`]; NaN if the file does not have them.
    numbers: [f64; NUMBERS.len()],
    corners: Vec<i64>,
}

const NUMBERS: [&str; 10] = ["x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "alpha"];

/// Alternative names of colour properties.
const ALIASES: [(&str, &str); 6] = [
    ("diffuse_red", "red"),
    ("diffuse_green", "green"),
    ("diffuse_blue", "blue"),
    ("r", "red"),
    ("g", "green"),
    ("b", "blue"),
];

impl Row {
    fn index(name: &str) -> Option<usize> {
        let name = ALIASES.iter().find(|(alias, _)| *alias == name).map_or(name, |(_, name)| name);
        NUMBERS.iter().position(|known| *known == name)
    }

    fn get(&self, name: &str) -> f64 {
        Self::index(name).map_or(f64::NAN, |idx| self.numbers[idx])
    }

    fn color(&self) -> Option<Rgba> {
        let [red, green, blue, alpha] = ["red", "green", "blue", "alpha"].map(|name| self.get(name));
        let alpha = if alpha.is_nan() { 1.0 } else { alpha };
        (!(red + green + blue).is_nan()).then_some(Rgba([red, green, blue, alpha]))
    }

    fn set(&mut self, name: &str, number: f64, full: f64) -> PropertyAccessResult {
        let Some(idx) = Self::index(name) else { return PropertyAccessResult::Ignored };
        // Integer colours use the full range of their type.
        let is_color = idx >= 6;
        self.numbers[idx] = if is_color { number / full } else { number };
        PropertyAccessResult::Set
    }

    fn set_corners<I: Into<i64>>(&mut self, name: &str, list: Vec<I>) -> PropertyAccessResult {
        if !matches!(name, "vertex_indices" | "vertex_index") {
            return PropertyAccessResult::Ignored;
        }
        self.corners = list.into_iter().map(Into::into).collect();
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Row {
    fn new() -> Self {
        Self { numbers: [f64::NAN; NUMBERS.len()], corners: Vec::new() }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        match property {
            Property::Char(n) => self.set(name, n.into(), i8::MAX.into()),
            Property::UChar(n) => self.set(name, n.into(), u8::MAX.into()),
            Property::Short(n) => self.set(name, n.into(), i16::MAX.into()),
            Property::UShort(n) => self.set(name, n.into(), u16::MAX.into()),
            Property::Int(n) => self.set(name, n.into(), i32::MAX.into()),
            Property::UInt(n) => self.set(name, n.into(), u32::MAX.into()),
            Property::Float(n) => self.set(name, n.into(), 1.0),
            Property::Double(n) => self.set(name, n, 1.0),
            Property::ListChar(list) => self.set_corners(name, list),
            Property::ListUChar(list) => self.set_corners(name, list),
            Property::ListShort(list) => self.set_corners(name, list),
            Property::ListUShort(list) => self.set_corners(name, list),
            Property::ListInt(list) => self.set_corners(name, list),
            Property::ListUInt(list) => self.set_corners(name, list),
            Property::ListFloat(_) | Property::ListDouble(_) => PropertyAccessResult::Ignored,
        }
    }
}
