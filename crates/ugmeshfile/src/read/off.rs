//! Reads Geomview OFF: the keyword `[ST][C][N]OFF`, counts, vertices and faces, one per line.

use glam::DVec3;
use ugscene::shorten;

use super::text::{number, numbers};
use crate::builder::{Builder, Rgba};
use crate::decode::decode;
use crate::error::Problem;
use crate::format::is_off_keyword;

pub(super) fn read(bytes: &[u8], builder: &mut Builder) -> Result<(), Problem> {
    let text = decode(bytes);
    let lines = text.lines().enumerate().map(|(idx, line)| {
        let without_comment = line.split('#').next().unwrap_or_default();
        (idx + 1, without_comment.trim())
    });
    let mut lines = lines.filter(|(_, line)| !line.is_empty());

    let (kind, [n_vertices, n_faces]) = read_head(&mut lines)?;
    let scale = Scale { is_real: has_real_colors(lines.clone(), kind, n_vertices) };
    for n_read in 0..n_vertices {
        let (line, vertex) = lines.next().ok_or_else(|| ends_early(n_vertices, "vertices", n_read))?;
        read_vertex(vertex, line, kind, scale, builder)?;
    }
    for n_read in 0..n_faces {
        let (line, face) = lines.next().ok_or_else(|| ends_early(n_faces, "faces", n_read))?;
        read_face(face, line, scale, builder)?;
    }
    Ok(())
}

/// The range of the colours of a file.
#[derive(Clone, Copy)]
struct Scale {
    /// A colour in the file has a real number, so colours of the digits 0 and 1 are real as well.
    is_real: bool,
}

/// True if a number of a colour is real. Colours are what follows the position and normal of a
/// vertex, and the corners of a face.
fn has_real_colors<'t>(lines: impl Iterator<Item = (usize, &'t str)>, kind: Kind, n_vertices: u64) -> bool {
    let n_before_color = if kind.has_normal { 6 } else { 3 };
    (0..).zip(lines).any(|(row, (_, line))| {
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
    !word.bytes().all(|byte| byte.is_ascii_digit())
}

/// The vertex attributes that the keyword declares.
#[derive(Clone, Copy, Default)]
struct Kind {
    has_normal: bool,
    has_color: bool,
}

fn ends_early(announced: u64, what: &str, n_read: u64) -> Problem {
    Problem::new(format!("{announced} {what} are declared, but the file ends after {n_read}; copy it again"))
}

/// Reads the keyword, which may be missing, and the counts, which may be on the same line.
fn read_head<'t>(lines: &mut impl Iterator<Item = (usize, &'t str)>) -> Result<(Kind, [u64; 2]), Problem> {
    let nothing = || Problem::new("the numbers of vertices and faces are missing");
    let (line, head) = lines.next().ok_or_else(nothing)?;
    let mut words: Vec<&str> = head.split_whitespace().collect();
    let mut kind = Kind::default();
    let mut line = line;
    if let Some(&keyword) = words.first()
        && is_off_keyword(keyword)
    {
        if keyword.contains(['4', 'n']) || words.contains(&"BINARY") {
            let what =
                format!("`{}` is not supported; export three-dimensional ASCII OFF, or PLY", shorten(head));
            return Err(Problem::at(line, what));
        }
        // `STOFF` has no normals, `ST` is for texture.
        let letters = keyword.trim_start_matches("ST");
        kind = Kind { has_normal: letters.contains('N'), has_color: letters.contains('C') };
        words.remove(0);
        if words.is_empty() {
            let (next_line, counts) = lines.next().ok_or_else(nothing)?;
            line = next_line;
            words = counts.split_whitespace().collect();
        }
    }
    let count = |idx: usize| words.get(idx).and_then(|word| word.parse().ok());
    match (count(0), count(1)) {
        (Some(n_vertices), Some(n_faces)) => Ok((kind, [n_vertices, n_faces])),
        _ => Err(Problem::at(line, "the numbers of vertices and faces are expected here")),
    }
}

fn read_vertex(
    vertex: &str,
    line: usize,
    kind: Kind,
    scale: Scale,
    builder: &mut Builder,
) -> Result<(), Problem> {
    let mut words = vertex.split_whitespace();
    let position = numbers::<3>(&mut words, line, "vertex")?;
    let normal =
        if kind.has_normal { Some(DVec3::from_array(numbers(&mut words, line, "normal")?)) } else { None };
    let color = if kind.has_color { color(words, line, scale)? } else { None };
    builder.line = u32::try_from(line).unwrap_or(u32::MAX);
    builder.vertex(DVec3::from_array(position), normal, color)?;
    Ok(())
}

fn read_face(face: &str, line: usize, scale: Scale, builder: &mut Builder) -> Result<(), Problem> {
    let mut words = face.split_whitespace();
    let n_corners: u64 = words
        .next()
        .and_then(|word| word.parse().ok())
        .ok_or_else(|| Problem::at(line, "a face begins with the number of its corners"))?;
    let mut corners = Vec::new();
    for n_read in 0..n_corners {
        let word = words
            .next()
            .ok_or_else(|| Problem::at(line, format!("a face of {n_corners} corners ends after {n_read}")))?;
        let corner = word.parse().ok().and_then(|idx| builder.vertex_at(idx)).ok_or_else(|| {
            let last = builder.n_vertices() as i64 - 1;
            Problem::at(
                line,
                format!(
                    "a face refers to vertex `{}`, but vertices are numbered from 0 to {last}",
                    shorten(word)
                ),
            )
        })?;
        corners.push(corner);
    }
    let color = color(words, line, scale)?.map(|color| builder.color(color));
    builder.line = u32::try_from(line).unwrap_or(u32::MAX);
    builder.face(&corners, color)
}

/// A colour of three or four numbers. One real number makes all of them real, from 0 to 1; whole
/// numbers are from 0 to 255, but in a file with real numbers 0 and 1 are real. A single number is
/// an index into a colour map that the file does not contain, and is ignored.
fn color<'w>(
    words: impl Iterator<Item = &'w str>,
    line: usize,
    scale: Scale,
) -> Result<Option<Rgba>, Problem> {
    let words: Vec<&str> = words.take(4).collect();
    let mut parts = Vec::with_capacity(4);
    for word in &words {
        parts.push(number(word, line, "colour")?);
    }
    let is_real = words.into_iter().any(is_real) || scale.is_real && parts.iter().all(|&part| part <= 1.0);
    if !is_real {
        parts.iter_mut().for_each(|part| *part /= 255.0);
    }
    Ok(match parts[..] {
        [red, green, blue] => Some(Rgba::opaque([red, green, blue])),
        [red, green, blue, alpha] => Some(Rgba([red, green, blue, alpha])),
        _ => None,
    })
}
