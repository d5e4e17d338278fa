//! Writes Wavefront OBJ in one file. Colours follow the coordinates of vertices, an extension that
//! most programs read.

use std::fmt::Write;

use crate::surface::Surface;

pub(super) fn write(surface: &mut Surface) -> Vec<u8> {
    if surface.is_clear() {
        surface.notes.push("OBJ has no transparent vertices: all are written as opaque".to_string());
    }
    let mut text = String::with_capacity(64 * surface.scene.vertices.len());
    // Writing to a string cannot fail.
    let _ = write_all(surface, &mut text);
    text.into_bytes()
}

fn write_all(surface: &Surface, text: &mut String) -> std::fmt::Result {
    for line in super::head_lines(&surface.scene) {
        writeln!(text, "# {line}")?;
    }
    for (row, vertex) in surface.scene.vertices.iter().enumerate() {
        let p = vertex.position;
        write!(text, "v {} {} {}", p.x, p.y, p.z)?;
        if let Some([red, green, blue, _]) = surface.colors.as_ref().map(|colors| colors[row]) {
            write!(text, " {red} {green} {blue}")?;
        }
        text.push('\n');
    }
    let mut normals = vec![None; surface.scene.vertices.len()];
    let with_normal = surface
        .scene
        .vertices
        .iter()
        .zip(&mut normals)
        .filter_map(|(vertex, number)| vertex.normal.map(|normal| (normal, number)));
    for (idx, (normal, number)) in with_normal.enumerate() {
        *number = Some(idx + 1);
        writeln!(text, "vn {} {} {}", normal.x, normal.y, normal.z)?;
    }
    for row in 0..surface.polygons.len() as u32 {
        let corners = surface.polygons.get(row);
        // A face has normals at all its corners or at none.
        let has_normals = corners.iter().all(|corner| normals[corner.index()].is_some());
        text.push('f');
        for corner in corners {
            write!(text, " {}", corner.index() + 1)?;
            if let Some(normal) = normals[corner.index()].filter(|_| has_normals) {
                write!(text, "//{normal}")?;
            }
        }
        text.push('\n');
    }
    Ok(())
}
