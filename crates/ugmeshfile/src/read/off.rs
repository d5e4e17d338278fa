//! Reads Geomview OFF: the keyword `[ST][C][N]OFF`, counts, vertices and faces, usually one a line.

use glam::DVec3;
use ugscene::shorten;

use super::GOES_ON;
use super::text::{Words, any_number, not_a_number, numbers};
use crate::builder::{Builder, Rgba};
use crate::decode::decode;
use crate::error::Problem;
use crate::format::off_keyword;

pub(super) fn read(bytes: &[u8], builder: &mut Builder) -> Result<(), Problem> {
    let text = decode(bytes);
    let mut words = Words::new(&text);
    let (kind, [n_vertices, n_faces]) = read_head(&mut words)?;
    if kind.has_texture {
        builder.warn("texture coordinates are not read, since OFF names no picture");
    }
    let lines =
        text.lines().skip(words.line).map(|line| line.split('#').next().unwrap_or_default().trim());
    let lines = lines.filter(|line| !line.is_empty());
    let has_lines =
        lines.clone().take((n_vertices + n_faces) as usize).count() as u64 == n_vertices + n_faces;
    let layout = Layout { has_lines, is_real: has_real_colors(lines, kind, n_vertices), ..kind };
    for n_read in 0..n_vertices {
        if words.clone().next().is_none() {
            return Err(ends_early(n_vertices, "vertices", n_read));
        }
        read_vertex(&mut words, layout, builder)?;
    }
    for n_read in 0..n_faces {
        let word = words.next().ok_or_else(|| ends_early(n_faces, "faces", n_read))?;
        read_face(word, &mut words, layout, builder)?;
    }
    if words.next().is_some() {
        builder.warn(GOES_ON.to_owned());
    }
    Ok(())
}

/// What the keyword declares, and how the numbers are written.
#[derive(Clone, Copy, Default)]
struct Layout {
    has_normal: bool,
    has_color: bool,
    has_texture: bool,
    /// There are lines enough for each vertex and face to have its own, so what is left of a line
    /// is a colour, or has no meaning.
    has_lines: bool,
    /// A colour in the file has a real number, so colours of the digits 0 and 1 are real as well.
    is_real: bool,
}

/// True if a number of a colour is real. Colours are what follows the position and normal of a
/// vertex, and the corners of a face.
fn has_real_colors<'t>(
    lines: impl Iterator<Item = &'t str>,
    kind: Layout,
    n_vertices: u64,
) -> bool {
    let n_before_color = if kind.has_normal { 6 } else { 3 };
    (0..).zip(lines).any(|(row, line)| {
        let mut words = line.split_whitespace();
        if row < n_vertices {
            kind.has_color && words.skip(n_before_color).take(4).any(is_real)
        } else {
            let n_corners = words.next().and_then(|word| word.parse().ok());
            n_corners.is_some_and(|n_corners| words.skip(n_corners).take(4).any(is_real))
        }
    })
}

fn is_real(word: &str) -> bool {
    let is_nan = || any_number(word).is_some_and(f64::is_nan);
    !word.bytes().all(|byte| byte.is_ascii_digit()) && !is_nan()
}

fn ends_early(announced: u64, what: &str, n_read: u64) -> Problem {
    Problem::new(format!(
        "{announced} {what} are declared, but the file ends after {n_read}; copy it again"
    ))
}

/// Reads the keyword, which may be missing, and the counts, which may be on the same line, even
/// without a blank between them.
fn read_head(words: &mut Words<'_>) -> Result<(Layout, [u64; 2]), Problem> {
    let nothing = || Problem::new("the numbers of vertices and faces are missing");
    let mut kind = Layout::default();
    let mut first = words.next().ok_or_else(nothing)?;
    if let Some((keyword, glued)) = off_keyword(first) {
        let is_binary = words.clone().rest_of_line().any(|word| word == "BINARY");
        if keyword.contains(['4', 'n']) || is_binary {
            let binary = if is_binary { " BINARY" } else { "" };
            let what = format!(
                "`{keyword}{binary}` is not supported; export three-dimensional ASCII OFF, or PLY"
            );
            return Err(Problem::at(words.line, what));
        }
        // `STOFF` has no normals, `ST` is for texture.
        let letters = keyword.trim_start_matches("ST");
        kind = Layout {
            has_normal: letters.contains('N'),
            has_color: letters.contains('C'),
            has_texture: letters.len() < keyword.len(),
            ..kind
        };
        first = if glued.is_empty() { words.next().ok_or_else(nothing)? } else { glued };
    }
    let line = words.line;
    match (first.parse::<u32>(), words.next_in_line().and_then(|word| word.parse::<u32>().ok())) {
        (Ok(n_vertices), Some(n_faces)) => {
            // The number of edges, which may be missing, has no meaning.
            words.next_in_line();
            Ok((kind, [n_vertices.into(), n_faces.into()]))
        }
        _ => Err(Problem::at(line, "the numbers of vertices and faces are expected here")),
    }
}

fn read_vertex(
    words: &mut Words<'_>,
    layout: Layout,
    builder: &mut Builder,
) -> Result<(), Problem> {
    let n_numbers = 3 + 3 * usize::from(layout.has_normal) + 4 * usize::from(layout.has_color);
    let mut fields: Vec<&str> = words.next().into_iter().collect();
    let line = words.line;
    if layout.has_lines {
        fields.extend(words.rest_of_line());
    } else {
        fields.extend(words.take(n_numbers - 1));
    }
    let mut fields = fields.into_iter();
    let position = numbers::<3>(&mut fields, line, "vertex")?;
    let normal =
        if layout.has_normal { Some(numbers::<3>(&mut fields, line, "normal")?) } else { None };
    let color = if layout.has_color { color(fields, line, layout)? } else { None };
    builder.line = u32::try_from(line).unwrap_or(u32::MAX);
    builder.vertex(DVec3::from_array(position), normal.map(DVec3::from_array), color)?;
    Ok(())
}

fn read_face(
    first: &str,
    words: &mut Words<'_>,
    layout: Layout,
    builder: &mut Builder,
) -> Result<(), Problem> {
    let line = words.line;
    let n_corners: u64 = first
        .parse()
        .map_err(|_| Problem::at(line, "a face begins with the number of its corners"))?;
    let mut corners = Vec::new();
    for n_read in 0..n_corners {
        let word = words.next().ok_or_else(|| {
            Problem::at(line, format!("a face of {n_corners} corners ends after {n_read}"))
        })?;
        let corner = word.parse().ok().and_then(|idx| builder.vertex_at(idx)).ok_or_else(|| {
            let last = builder.n_vertices() as i64 - 1;
            let what = format!(
                "a face refers to vertex `{}`, but vertices are numbered from 0 to {last}",
                shorten(word)
            );
            Problem::at(words.line, what)
        })?;
        corners.push(corner);
    }
    let rest = if layout.has_lines { words.rest_of_line() } else { "".split_whitespace() };
    let color = color(rest, words.line, layout)?.and_then(|color| builder.color(color));
    builder.line = u32::try_from(line).unwrap_or(u32::MAX);
    builder.face(&corners, color)
}

/// A colour of three or four numbers. One real number makes all of them real, from 0 to 1; whole
/// numbers are from 0 to 255, but in a file with real numbers 0 and 1 are real. A single number is
/// an index into a colour map that the file does not contain, and is ignored.
fn color<'w>(
    words: impl Iterator<Item = &'w str>,
    line: usize,
    layout: Layout,
) -> Result<Option<Rgba>, Problem> {
    let words: Vec<&str> = words.take(4).collect();
    let mut parts = Vec::with_capacity(4);
    for word in &words {
        let what = "in a colour is not a number";
        parts.push(any_number(word).ok_or_else(|| not_a_number(word, line, what))?);
    }
    let is_real =
        words.into_iter().any(is_real) || layout.is_real && parts.iter().all(|&part| part <= 1.0);
    if !is_real {
        parts.iter_mut().for_each(|part| *part /= 255.0);
    }
    Ok(match parts[..] {
        [red, green, blue] => Some(Rgba::opaque([red, green, blue])),
        [red, green, blue, alpha] => Some(Rgba([red, green, blue, alpha])),
        _ => None,
    })
}
