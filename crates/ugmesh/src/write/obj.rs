//! Writes Wavefront OBJ in one file. Colours follow the coordinates of vertices, an extension that
//! most programs read.

use std::fmt::Write;

use crate::polygon_mesh::{Group, PolygonMesh};

pub(super) fn write(mesh: &mut PolygonMesh) -> Vec<u8> {
    if mesh.is_transparent() {
        mesh.notes.push("OBJ has no transparent vertices: all are written as opaque".to_string());
    }
    let groups = mesh.groups();
    let mut text = String::with_capacity(64 * mesh.scene.vertices.len());
    // Writing to a string cannot fail.
    let _ = write_all(mesh, &groups, &mut text);
    text.into_bytes()
}

fn write_all(mesh: &PolygonMesh, groups: &[Group], text: &mut String) -> std::fmt::Result {
    for line in super::head_lines(&mesh.scene) {
        writeln!(text, "# {line}")?;
    }
    for (row, vertex) in mesh.scene.vertices.iter().enumerate() {
        let p = vertex.position;
        write!(text, "v {} {} {}", p.x, p.y, p.z)?;
        if let Some([red, green, blue, _]) = mesh.colors.as_ref().map(|colors| colors[row]) {
            write!(text, " {red} {green} {blue}")?;
        }
        text.push('\n');
    }
    let mut normals = vec![None; mesh.scene.vertices.len()];
    let with_normal = mesh
        .scene
        .vertices
        .iter()
        .zip(&mut normals)
        .filter_map(|(vertex, number)| vertex.normal.map(|normal| (normal, number)));
    for (idx, (normal, number)) in with_normal.enumerate() {
        *number = Some(idx + 1);
        writeln!(text, "vn {} {} {}", normal.x, normal.y, normal.z)?;
    }
    let mut group_of = vec![0; mesh.polygons.len()];
    for (number, group) in groups.iter().enumerate() {
        group.polygons.iter().for_each(|&row| group_of[row as usize] = number);
    }
    let (mut name, mut color) = (&None, &None);
    for row in 0..mesh.polygons.len() as u32 {
        let corners = mesh.polygons.get(row);
        let group = &groups[group_of[row as usize]];
        if *name != group.name {
            name = &group.name;
            writeln!(text, "g {}", name.as_deref().unwrap_or("default"))?;
        }
        if *color != group.color.name {
            color = &group.color.name;
            // Programs that know no material of this name keep the colours of the vertices.
            writeln!(text, "usemtl {}", color.as_deref().unwrap_or("default"))?;
        }
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
