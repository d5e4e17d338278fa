//! Measurements as VTK XML polygon data (`.vtp`), for ParaView.
//!
//! Arrays are base64 of a length in bytes and little-endian numbers. As text, VTK does not read NaN.

use std::fmt::Write;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use glam::DVec3;
use ugparse::{Scene, VertexId};

use crate::measurement::Measurement;

/// The whole file. `polygons`: corners of each polygon. `columns`: names of the scalars of
/// `scalars`, which returns those of a vertex.
pub(crate) fn write<const N: usize>(
    text: &mut String,
    scene: &Scene,
    rows: &[Measurement],
    polygons: &[Vec<VertexId>],
    columns: [&str; N],
    scalars: impl Fn(&Measurement) -> [f64; N],
) -> std::fmt::Result {
    let n_polygons = polygons.len();
    writeln!(text, "<?xml version=\"1.0\"?>")?;
    writeln!(
        text,
        "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>"
    )?;
    write_history(text, scene)?;
    writeln!(
        text,
        "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" \
         NumberOfPolys=\"{n_polygons}\">",
        rows.len()
    )?;
    text.push_str("<Points>\n");
    let positions = scene.vertices.iter().map(|vertex| vertex.position);
    vectors(text, "Points", positions)?;
    text.push_str("</Points>\n<PointData Scalars=\"doppler\" Vectors=\"velocity\">\n");
    let numbers: Vec<[f64; N]> = rows.iter().map(scalars).collect();
    for (column, name) in columns.iter().enumerate() {
        let bytes = numbers.iter().flat_map(|row| row[column].to_le_bytes()).collect();
        array(text, "Float64", name, 1, bytes)?;
    }
    vectors(text, "velocity", rows.iter().map(|row| row.velocity))?;
    text.push_str("</PointData>\n<Polys>\n");
    let corners = polygons.iter().flatten().flat_map(|corner| i64::from(corner.0).to_le_bytes()).collect();
    array(text, "Int64", "connectivity", 1, corners)?;
    let mut end = 0;
    let ends = polygons.iter().flat_map(|polygon| {
        end += polygon.len() as i64;
        end.to_le_bytes()
    });
    array(text, "Int64", "offsets", 1, ends.collect())?;
    text.push_str("</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n");
    Ok(())
}

/// The command lines, as an array of strings: codes of their bytes, each string with a 0 at its end.
fn write_history(text: &mut String, scene: &Scene) -> std::fmt::Result {
    let lines = ugscene::history(scene);
    write!(
        text,
        "<FieldData>\n<Array type=\"String\" Name=\"history\" NumberOfTuples=\"{}\" format=\"ascii\">",
        lines.len()
    )?;
    for line in lines {
        line.bytes().chain([0]).try_for_each(|byte| write!(text, " {byte}"))?;
    }
    text.push_str("</Array>\n</FieldData>\n");
    Ok(())
}

fn vectors(text: &mut String, name: &str, rows: impl Iterator<Item = DVec3>) -> std::fmt::Result {
    array(text, "Float64", name, 3, rows.flat_map(|v| v.to_array()).flat_map(f64::to_le_bytes).collect())
}

fn array(text: &mut String, kind: &str, name: &str, n_components: usize, bytes: Vec<u8>) -> std::fmt::Result {
    let length = (bytes.len() as u64).to_le_bytes();
    let content = BASE64_STANDARD.encode([&length[..], &bytes].concat());
    writeln!(
        text,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{n_components}\" \
         format=\"binary\">{content}</DataArray>"
    )
}
