//! Files of measurements at every vertex of a scene as seen (`-at`).

use std::fmt::Write;

use glam::DVec3;
use ugmeshfile::VtkPolygons;
use ugscene::{Face, Measurement, Scene, VertexId};

/// File format of measurements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Table {
    /// CSV: a header line, then one line for each vertex.
    Csv,
    /// ASCII PLY: vertices with properties, faces, and the names of the vertices as lists of bytes.
    Ply,
    /// VTK XML polygon data, for ParaView: vertices with arrays, the velocity among them, and
    /// faces.
    Vtp,
}

/// Columns of [`Table::Csv`] after the name, and vertex properties of [`Table::Ply`].
const COLUMNS: [&str; 8] = [
    "x",
    "y",
    "z",
    "emission_time",
    "doppler",
    "distance",
    "emission_angle_deg",
    "rest_emission_angle_deg",
];

impl Table {
    /// The format of files with this extension.
    pub fn by_extension(extension: &str) -> Option<Table> {
        match extension.to_ascii_lowercase().as_str() {
            "csv" => Some(Table::Csv),
            "ply" => Some(Table::Ply),
            "vtp" => Some(Table::Vtp),
            _ => None,
        }
    }

    /// The contents of the file. `rows`: from [`ugscene::measure`].
    pub fn write(self, scene: &Scene, rows: &[Measurement]) -> Vec<u8> {
        let mut text = String::new();
        let written = match self {
            Table::Csv => write_csv(&mut text, scene, rows),
            Table::Ply => write_ply(&mut text, scene, rows),
            Table::Vtp => {
                write_vtp(&mut text, scene, rows);
                Ok(())
            }
        };
        written.expect("writing to memory does not fail");
        text.into_bytes()
    }
}

fn write_csv(text: &mut String, scene: &Scene, rows: &[Measurement]) -> std::fmt::Result {
    writeln!(text, "name,{}", COLUMNS.join(","))?;
    for (vertex, row) in scene.vertices.iter().zip(rows) {
        // Names consist of letters, digits, `:`, `_` and `#`, and need no quotes.
        text.push_str(scene.names.get(vertex.name));
        for number in numbers(vertex.position, row) {
            write!(text, ",{number}")?;
        }
        text.push('\n');
    }
    Ok(())
}

fn write_ply(text: &mut String, scene: &Scene, rows: &[Measurement]) -> std::fmt::Result {
    let faces = all_polygons(scene);
    text.push_str("ply\nformat ascii 1.0\n");
    for line in scene.head.history() {
        writeln!(text, "comment {line}")?;
    }
    writeln!(text, "element vertex {}", rows.len())?;
    for column in COLUMNS {
        writeln!(text, "property double {column}")?;
    }
    writeln!(text, "element face {}\nproperty list uint uint vertex_indices", faces.len())?;
    writeln!(
        text,
        "element vertex_name {}\nproperty list uint uchar bytes\nend_header",
        rows.len()
    )?;
    for (vertex, row) in scene.vertices.iter().zip(rows) {
        let words = numbers(vertex.position, row).map(|number| number.to_string());
        writeln!(text, "{}", words.join(" "))?;
    }
    for face in faces {
        write!(text, "{}", face.len())?;
        face.iter().try_for_each(|corner| write!(text, " {}", corner.0))?;
        text.push('\n');
    }
    for vertex in &scene.vertices {
        let name = scene.names.get(vertex.name).as_bytes();
        write!(text, "{}", name.len())?;
        name.iter().try_for_each(|byte| write!(text, " {byte}"))?;
        text.push('\n');
    }
    Ok(())
}

fn write_vtp(text: &mut String, scene: &Scene, rows: &[Measurement]) {
    let mut mesh = VtkPolygons {
        history: scene.head.history(),
        points: scene.vertices.iter().map(|vertex| vertex.position).collect(),
        polygons: all_polygons(scene),
        ..VtkPolygons::default()
    };
    mesh.add_measurements(rows);
    mesh.write(text);
}

/// In the order of [`COLUMNS`].
fn numbers(position: DVec3, row: &Measurement) -> [f64; 8] {
    let [x, y, z] = position.to_array();
    let [emission_time, doppler, distance, angle, rest_angle] = row.scalars();
    [x, y, z, emission_time, doppler, distance, angle, rest_angle]
}

/// All faces, without holes.
fn all_polygons(scene: &Scene) -> Vec<Vec<VertexId>> {
    scene.faces.iter().flat_map(|face| polygons(scene, face)).collect()
}

/// A face without holes, or its triangles. If triangulation fails, the holes are lost.
fn polygons(scene: &Scene, face: &Face) -> Vec<Vec<VertexId>> {
    let outline = scene.contours.get(face.contours.start).to_vec();
    if face.contours.len() == 1 {
        return vec![outline];
    }
    let at = |corner: VertexId| scene.vertices[corner.index()].position;
    let corners = scene.face_corners(face);
    match ugpolygon::face_triangles(scene, face, at) {
        Some(triangles) => {
            triangles.iter().map(|t| t.map(|row| corners[row as usize]).to_vec()).collect()
        }
        None => vec![outline],
    }
}
