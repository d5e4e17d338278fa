//! Reads STL, binary and ASCII. Corners with bit-identical positions are merged to one vertex.
//!
//! Not with a crate, because the available one stops at the first `endsolid` and reads a file that
//! begins with `solid` without a name as binary; both occur in practice.

use glam::DVec3;
use rustc_hash::FxHashMap;
use ugscene::{VertexId, shorten};

use super::text::{Words, any_number, numbers};
use crate::builder::Builder;
use crate::decode::decode;
use crate::error::Problem;
use crate::format::is_binary_stl;

pub(super) fn read(bytes: &[u8], builder: &mut Builder) -> Result<(), Problem> {
    let mut merged = MergedVertices { builder, by_place: FxHashMap::default() };
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let is_text =
        bytes.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    // Headers of binary files may begin so, too.
    let has_zeros = bytes[..bytes.len().min(1024)].contains(&0);
    match (is_text, bytes.is_empty() || has_zeros || is_binary_stl(bytes)) {
        (true, false) => read_text(&decode(bytes), &mut merged),
        (false, false) => Err(Problem::new("it is text, and STL as text begins with `solid`")),
        (_, true) => read_binary(bytes, &mut merged),
    }
}

struct MergedVertices<'a> {
    builder: &'a mut Builder,
    by_place: FxHashMap<[u64; 3], VertexId>,
}

impl MergedVertices<'_> {
    fn triangle(&mut self, corners: [[f64; 3]; 3]) -> Result<(), Problem> {
        let mut ids = [VertexId(0); 3];
        for (id, corner) in ids.iter_mut().zip(corners) {
            // −0 and 0 have the same key, because the builder replaces −0 by 0.
            let key = corner.map(|x| (x + 0.0).to_bits());
            *id = match self.by_place.get(&key) {
                Some(&known) => known,
                None => self.builder.vertex(DVec3::from_array(corner), None, None)?,
            };
            self.by_place.insert(key, *id);
        }
        self.builder.face(&ids, None)
    }
}

/// Binary STL: a header of 80 bytes, the count, and for each triangle a normal, three corners and
/// two bytes without a standard meaning.
fn read_binary(bytes: &[u8], merged: &mut MergedVertices) -> Result<(), Problem> {
    let Some((header, triangles)) = bytes.split_at_checked(84) else {
        return Err(Problem::new("the file is too short for STL"));
    };
    let declared = u32_at(header, 80) as usize;
    let available = triangles.len() / 50;
    if available < declared {
        let what = format!(
            "{declared} triangles are declared, but the file ends after {available}; copy it again"
        );
        return Err(Problem::new(what));
    }
    if available > declared {
        merged.builder.warn(format!(
            "{declared} triangles are declared, and all {available} of the file are read"
        ));
    }
    // Two conventions: colours by a word in the header, or by the highest bit of the last two
    // bytes.
    let is_colored = |triangle: &[u8]| triangle[49] & 0x80 != 0;
    let has_word = header.windows(6).any(|window| window == b"COLOR=");
    if has_word || available > 0 && triangles.chunks_exact(50).all(is_colored) {
        merged
            .builder
            .warn("colours of triangles are not read, since STL has no standard for them");
    }
    for triangle in triangles.chunks_exact(50) {
        let corner = |first: usize| {
            [0, 4, 8].map(|offset| f64::from(f32::from_bits(u32_at(triangle, first + offset))))
        };
        merged.triangle([corner(12), corner(24), corner(36)])?;
    }
    Ok(())
}

fn u32_at(bytes: &[u8], offset: usize) -> u32 {
    u32::from_le_bytes([bytes[offset], bytes[offset + 1], bytes[offset + 2], bytes[offset + 3]])
}

/// ASCII STL: `vertex x y z` in groups of three; all other words only delimit these, over any
/// lines. The numbers are rounded to 32 bits, as in binary STL.
fn read_text(text: &str, merged: &mut MergedVertices) -> Result<(), Problem> {
    let mut corners = Vec::with_capacity(3);
    let mut words = Words::new(text);
    // Within a name, which ends with its line, or with the next facet where all is in one line.
    let mut name_line = None;
    while let Some(word) = words.next() {
        let line = words.line;
        let keyword = word.to_ascii_lowercase();
        if name_line == Some(line) && !matches!(&*keyword, "facet" | "solid" | "endsolid") {
            continue;
        }
        name_line = None;
        match keyword.as_str() {
            "vertex" => {
                let corner: [f64; 3] = numbers(&mut words, line, "vertex")?;
                corners.push(corner.map(|x| f64::from(x as f32)));
            }
            "endloop" => {
                let Ok(triangle) = <[[f64; 3]; 3]>::try_from(&corners[..]) else {
                    return Err(Problem::at(
                        line,
                        format!("a facet has {} corners, not 3", corners.len()),
                    ));
                };
                let at_line = |problem: Problem| Problem { line: Some(line), ..problem };
                merged.triangle(triangle).map_err(at_line)?;
                corners.clear();
            }
            "solid" | "endsolid" => name_line = Some(line),
            "facet" | "endfacet" | "outer" | "loop" | "normal" | "color" => {}
            // Of normals and colours.
            _ if any_number(word).is_some() => {}
            _ => {
                return Err(Problem::at(
                    line,
                    format!("`{}` is not a keyword of STL", shorten(word)),
                ));
            }
        }
    }
    if corners.is_empty() {
        Ok(())
    } else {
        Err(Problem::new("the file ends inside a facet; copy it again"))
    }
}
