//! Reads STL, binary and ASCII. Corners with bit-identical positions are merged to one vertex.
//!
//! Not with a crate, because the available one stops at the first `endsolid` and reads a file that
//! begins with `solid` without a name as binary; both occur in practice.

use glam::DVec3;
use rustc_hash::FxHashMap;
use ugscene::VertexId;
use ugscene::shorten;

use super::text::numbers;
use crate::builder::Builder;
use crate::decode::decode;
use crate::error::Problem;
use crate::format::is_binary_stl;

pub(super) fn read(bytes: &[u8], builder: &mut Builder) -> Result<(), Problem> {
    let mut merged = MergedVertices { builder, by_place: FxHashMap::default() };
    let is_text = bytes.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    if is_text && !is_binary_stl(bytes) {
        read_text(&decode(bytes), &mut merged)
    } else {
        read_binary(bytes, &mut merged)
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
    let count = u32_at(header, 80);
    let available = triangles.len() / 50;
    if (available as u64) < u64::from(count) {
        let what =
            format!("{count} triangles are declared, but the file ends after {available}; copy it again");
        return Err(Problem::new(what));
    }
    for triangle in triangles.chunks_exact(50).take(count as usize) {
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

/// ASCII STL: `vertex x y z` in groups of three; all other lines only delimit these. The numbers
/// are rounded to 32 bits, as in binary STL.
fn read_text(text: &str, merged: &mut MergedVertices) -> Result<(), Problem> {
    let mut corners = Vec::with_capacity(3);
    for (idx, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        let keyword = words.next().unwrap_or_default().to_ascii_lowercase();
        match keyword.as_str() {
            "vertex" => {
                let corner: [f64; 3] = numbers(&mut words, idx + 1, "vertex")?;
                corners.push(corner.map(|x| f64::from(x as f32)));
            }
            "endloop" => {
                let Ok(triangle) = <[[f64; 3]; 3]>::try_from(&corners[..]) else {
                    let what = format!("a facet has {} corners, not 3", corners.len());
                    return Err(Problem::at(idx + 1, what));
                };
                let at_line = |problem: Problem| Problem { line: Some(idx + 1), ..problem };
                merged.triangle(triangle).map_err(at_line)?;
                corners.clear();
            }
            "solid" | "endsolid" | "facet" | "endfacet" | "outer" | "color" | "" => {}
            _ => {
                return Err(Problem::at(idx + 1, format!("`{}` is not a keyword of STL", shorten(&keyword))));
            }
        }
    }
    if corners.is_empty() { Ok(()) } else { Err(Problem::new("the file ends inside a facet; copy it again")) }
}
