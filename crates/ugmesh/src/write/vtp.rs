//! Writes VTK XML polygon data, for ParaView: colours, normals, and for a scene as seen what is
//! known of the light from every vertex.

use glam::DVec3;
use ugmeshfile::VtkPolygons;
use ugscene::{Measurement, RestFrames};

use crate::polygon_mesh::PolygonMesh;

/// `is_measured`: the positions are those of the scene.
pub(super) fn write(mesh: &mut PolygonMesh, is_measured: bool) -> Vec<u8> {
    if mesh.is_transparent() {
        mesh.notes
            .push("VTK files have no transparent vertices: all are written as opaque".to_string());
    }
    let seen = mesh.scene.stage.seen_geometry().map(|seen| (seen.eye, seen.time));
    if seen.is_some() && !is_measured {
        mesh.notes.push(
            "Doppler factors and times are left out: the mesh was scaled, moved or turned"
                .to_string(),
        );
    }
    let rows: Option<Vec<Measurement>> =
        seen.filter(|_| is_measured).map(|(eye, time)| ugscene::measure(&mesh.scene, eye, time));
    let scene = &mesh.scene;
    let mut file = VtkPolygons {
        history: scene.head.history(),
        points: scene.vertices.iter().map(|vertex| vertex.position).collect(),
        polygons: (0..mesh.polygons.len() as u32)
            .map(|row| mesh.polygons.get(row).to_vec())
            .collect(),
        ..VtkPolygons::default()
    };
    match rows {
        Some(rows) => file.add_measurements(&rows),
        None if is_measured => {
            let frames = RestFrames::new(scene);
            let velocity = |body| frames.velocity(body).beta();
            let velocities: Vec<DVec3> =
                ugscene::vertex_bodies(scene).into_iter().map(velocity).collect();
            file.vectors.push(("velocity", velocities));
        }
        None => {}
    }
    if let Some(colors) = &mesh.colors {
        file.vectors
            .push(("color", colors.iter().map(|color| DVec3::from_slice(&color[..3])).collect()));
    }
    file.vectors.extend(mesh.normals().map(|normals| ("normals", normals)));
    let mut text = String::new();
    file.write(&mut text);
    text.into_bytes()
}
