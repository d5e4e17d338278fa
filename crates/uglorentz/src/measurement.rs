//! Measurements at every vertex of a scene as seen (`-at`).

use std::fmt::Write;

use glam::DVec3;
use ugparse::{Face, Scene, VertexId};
use ugphysics::{Velocity, aberrate, doppler_at};
use ugscene::{Geometry, RestFrames};

use crate::vtk_polygons::{self, VtkPolygons};

/// Measurements at one vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement {
    /// Apparent distance |p| from the eye, in the frame of the camera.
    pub distance: f64,
    /// Emission time on the clock of the camera: the time of the picture minus the distance.
    /// Without time of flight, the time of the picture.
    pub emission_time: f64,
    /// Doppler factor D = f_observed/f_emitted.  Eq. (P10)
    ///
    /// 1 at rest.
    pub doppler: f64,
    /// Angle between the velocity and the direction of the light to the eye, in the frame of the
    /// camera, degrees. NaN at rest and at the eye, where it is undefined.
    pub emission_angle_deg: f64,
    /// The same angle in the rest frame of the body, (P6).
    pub rest_emission_angle_deg: f64,
    /// Velocity of the body in the frame of the camera, fraction of c.
    pub velocity: DVec3,
}

/// Measures the result of [`crate::apply`], one row for each vertex.
///
/// `eye`: in scene coordinates. `time`: of the picture, on the clock of the camera.
pub fn measure(scene: &Scene, eye: DVec3, time: f64) -> Vec<Measurement> {
    let frames = RestFrames::new(scene);
    let has_flight_time = Geometry::of(scene).flight_time;
    let bodies = ugscene::vertex_bodies(scene);
    let one = |seen: DVec3, v: Velocity| {
        let distance = seen.length();
        Measurement {
            distance,
            emission_time: if has_flight_time { time - distance } else { time },
            doppler: if v.is_zero() { 1.0 } else { doppler_at(seen, v) },
            emission_angle_deg: angle_to_motion_deg(-seen, v),
            rest_emission_angle_deg: angle_to_motion_deg(-aberrate(seen, v), v),
            velocity: v.beta(),
        }
    };
    let vertices = scene.vertices.iter().zip(bodies);
    vertices.map(|(vertex, body)| one(vertex.position - eye, frames.velocity(body))).collect()
}

fn angle_to_motion_deg(direction: DVec3, v: Velocity) -> f64 {
    if v.is_zero() || direction == DVec3::ZERO {
        return f64::NAN;
    }
    // Against overflow and underflow of squares.
    let direction = direction / direction.abs().max_element();
    let (sine, cosine) = (direction.cross(v.direction()).length(), direction.dot(v.direction()));
    libm::atan2(sine, cosine).to_degrees()
}

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
const COLUMNS: [&str; 8] =
    ["x", "y", "z", "emission_time", "doppler", "distance", "emission_angle_deg", "rest_emission_angle_deg"];

/// Those of [`COLUMNS`] that are not coordinates.
const SCALARS: [&str; 5] =
    ["emission_time", "doppler", "distance", "emission_angle_deg", "rest_emission_angle_deg"];

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

    /// The contents of the file. `rows`: from [`measure`].
    pub fn write(self, scene: &Scene, rows: &[Measurement]) -> Vec<u8> {
        let mut text = String::new();
        let written = match self {
            Table::Csv => write_csv(&mut text, scene, rows),
            Table::Ply => write_ply(&mut text, scene, rows),
            Table::Vtp => write_vtp(&mut text, scene, rows),
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
    for line in ugscene::history(scene) {
        writeln!(text, "comment {line}")?;
    }
    writeln!(text, "element vertex {}", rows.len())?;
    for column in COLUMNS {
        writeln!(text, "property double {column}")?;
    }
    writeln!(text, "element face {}\nproperty list uint uint vertex_indices", faces.len())?;
    writeln!(text, "element vertex_name {}\nproperty list uint uchar bytes\nend_header", rows.len())?;
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

fn write_vtp(text: &mut String, scene: &Scene, rows: &[Measurement]) -> std::fmt::Result {
    let numbers: Vec<[f64; 5]> = rows.iter().map(scalars).collect();
    let column = |(idx, name)| (name, numbers.iter().map(|row| row[idx]).collect());
    let mesh = VtkPolygons {
        history: ugscene::history(scene),
        points: scene.vertices.iter().map(|vertex| vertex.position).collect(),
        scalars: SCALARS.into_iter().enumerate().map(column).collect(),
        velocities: rows.iter().map(|row| row.velocity).collect(),
        polygons: all_polygons(scene),
    };
    vtk_polygons::write(text, &mesh)
}

/// In the order of [`COLUMNS`].
fn numbers(position: DVec3, row: &Measurement) -> [f64; 8] {
    let [x, y, z] = position.to_array();
    let [emission_time, doppler, distance, angle, rest_angle] = scalars(row);
    [x, y, z, emission_time, doppler, distance, angle, rest_angle]
}

/// In the order of [`SCALARS`].
fn scalars(row: &Measurement) -> [f64; 5] {
    [row.emission_time, row.doppler, row.distance, row.emission_angle_deg, row.rest_emission_angle_deg]
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
    let at = |corner: &VertexId| scene.vertices[corner.index()].position;
    let rings: Vec<Vec<DVec3>> =
        scene.face_contours(face).map(|contour| contour.iter().map(at).collect()).collect();
    let corners = scene.contours.corners(face.contours.clone());
    match ugscene::triangulate(&rings) {
        Some(triangles) => triangles.iter().map(|t| t.map(|row| corners[row as usize]).to_vec()).collect(),
        None => vec![outline],
    }
}
