//! Writes Stanford PLY, binary little-endian or ASCII.

use std::io::{self, Write};

use crate::polygon_mesh::PolygonMesh;

pub(super) fn write(mesh: &mut PolygonMesh, is_ascii: bool) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(48 * mesh.scene.vertices.len());
    // Writing to memory cannot fail.
    let _ = write_all(mesh, is_ascii, &mut bytes);
    bytes
}

fn write_all(mesh: &PolygonMesh, is_ascii: bool, out: &mut Vec<u8>) -> io::Result<()> {
    let vertices = &mesh.scene.vertices;
    let normals = mesh.normals();
    let is_narrow = |x: f64| f64::from(x as f32) == x;
    let is_float =
        vertices.iter().all(|vertex| vertex.position.to_array().into_iter().all(is_narrow));
    let n_parts = if mesh.is_transparent() { 4 } else { 3 };
    let longest = (0..mesh.polygons.len() as u32).map(|row| mesh.polygons.get(row).len()).max();
    let is_short = longest.unwrap_or(0) <= usize::from(u8::MAX);

    writeln!(out, "ply")?;
    writeln!(out, "format {} 1.0", if is_ascii { "ascii" } else { "binary_little_endian" })?;
    for line in super::head_lines(&mesh.scene) {
        writeln!(out, "comment {line}")?;
    }
    writeln!(out, "element vertex {}", vertices.len())?;
    for name in ["x", "y", "z"] {
        writeln!(out, "property {} {name}", if is_float { "float" } else { "double" })?;
    }
    for name in normals.iter().flat_map(|_| ["nx", "ny", "nz"]) {
        writeln!(out, "property float {name}")?;
    }
    for name in mesh.colors.iter().flat_map(|_| &["red", "green", "blue", "alpha"][..n_parts]) {
        writeln!(out, "property uchar {name}")?;
    }
    writeln!(out, "element face {}", mesh.polygons.len())?;
    let length = if is_short { "uchar" } else { "uint" };
    let index = if i32::try_from(vertices.len()).is_ok() { "int" } else { "uint" };
    writeln!(out, "property list {length} {index} vertex_indices")?;
    writeln!(out, "end_header")?;

    let mut row = Row { out, is_ascii };
    for (idx, vertex) in vertices.iter().enumerate() {
        for x in vertex.position.to_array() {
            if is_float {
                row.number(x as f32, f32::to_le_bytes)?
            } else {
                row.number(x, f64::to_le_bytes)?
            }
        }
        for x in normals.iter().flat_map(|normals| normals[idx].to_array()) {
            row.number(x as f32, f32::to_le_bytes)?;
        }
        for part in mesh.colors.iter().flat_map(|colors| colors[idx][..n_parts].to_vec()) {
            row.number((part * 255.0).round() as u8, u8::to_le_bytes)?;
        }
        row.end();
    }
    for idx in 0..mesh.polygons.len() as u32 {
        let corners = mesh.polygons.get(idx);
        match u8::try_from(corners.len()) {
            Ok(len) if is_short => row.number(len, u8::to_le_bytes)?,
            _ => row.number(corners.len() as u32, u32::to_le_bytes)?,
        }
        for corner in corners {
            row.number(corner.0, u32::to_le_bytes)?;
        }
        row.end();
    }
    Ok(())
}

/// Writes a row of numbers, as text or as bytes.
struct Row<'a> {
    out: &'a mut Vec<u8>,
    is_ascii: bool,
}

impl Row<'_> {
    fn number<T: Copy + std::fmt::Display, const N: usize>(
        &mut self,
        number: T,
        bytes: impl Fn(T) -> [u8; N],
    ) -> io::Result<()> {
        if !self.is_ascii {
            self.out.extend_from_slice(&bytes(number));
            return Ok(());
        }
        if self.out.last() != Some(&b'\n') {
            self.out.push(b' ');
        }
        write!(self.out, "{number}")
    }

    fn end(&mut self) {
        if self.is_ascii {
            self.out.push(b'\n');
        }
    }
}
