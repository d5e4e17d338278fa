//! Meshes as VTK XML polygon data (`.vtp`), for ParaView.
//!
//! Arrays are base64 of a length in bytes and little-endian numbers. As text, VTK does not read
//! NaN.

use std::fmt::Write;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use glam::DVec3;
use ugscene::{Measurement, VertexId};

/// A mesh with numbers at its points.
#[derive(Clone, Debug, Default)]
pub struct VtkPolygons<'a> {
    /// Command lines, for people.
    pub history: Vec<&'a str>,
    /// The points.
    pub points: Vec<DVec3>,
    /// Name and numbers of each array with one number at each point. VTK shows `doppler` first.
    pub scalars: Vec<(&'a str, Vec<f64>)>,
    /// The same with a vector at each point; `velocity` is the one that VTK shows as arrows, and
    /// `normals` is used for shading.
    pub vectors: Vec<(&'a str, Vec<DVec3>)>,
    /// Corners of each polygon.
    pub polygons: Vec<Vec<VertexId>>,
}

impl VtkPolygons<'_> {
    /// Adds one array for each quantity. `rows`: one for each point.
    pub fn add_measurements(&mut self, rows: &[Measurement]) {
        let numbers: Vec<[f64; 5]> = rows.iter().map(Measurement::scalars).collect();
        for (idx, name) in Measurement::SCALARS.into_iter().enumerate() {
            self.scalars.push((name, numbers.iter().map(|row| row[idx]).collect()));
        }
        self.vectors.push(("velocity", rows.iter().map(|row| row.velocity).collect()));
    }

    /// Appends the whole file.
    pub fn write(&self, text: &mut String) {
        // Writing to memory does not fail.
        let _ = self.try_write(text);
    }

    fn try_write(&self, text: &mut String) -> std::fmt::Result {
        let Self { history, points, scalars, vectors, polygons } = self;
        let n_polygons = polygons.len();
        writeln!(text, "<?xml version=\"1.0\"?>")?;
        writeln!(
            text,
            "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>"
        )?;
        write_history(text, history)?;
        writeln!(
            text,
            "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" \
             NumberOfPolys=\"{n_polygons}\">",
            points.len()
        )?;
        text.push_str("<Points>\n");
        write_vectors(text, "Points", points)?;
        text.push_str("</Points>\n<PointData");
        let has = |name: &str| scalars.iter().map(|(name, _)| *name).any(|other| other == name);
        let has_vectors = |name: &str| vectors.iter().any(|(other, _)| *other == name);
        for (kind, name, is_there) in [
            ("Scalars", "doppler", has("doppler")),
            ("Vectors", "velocity", has_vectors("velocity")),
            ("Normals", "normals", has_vectors("normals")),
        ] {
            if is_there {
                write!(text, " {kind}=\"{name}\"")?;
            }
        }
        text.push_str(">\n");
        for (name, numbers) in scalars {
            array(
                text,
                "Float64",
                name,
                1,
                numbers.iter().flat_map(|x| x.to_le_bytes()).collect(),
            )?;
        }
        for (name, rows) in vectors {
            write_vectors(text, name, rows)?;
        }
        text.push_str("</PointData>\n<Polys>\n");
        let corners = polygons
            .iter()
            .flatten()
            .flat_map(|corner| i64::from(corner.0).to_le_bytes())
            .collect();
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
}

/// The command lines, as an array of strings: codes of their bytes, each string with a 0 at its
/// end.
fn write_history(text: &mut String, lines: &[&str]) -> std::fmt::Result {
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

fn write_vectors(text: &mut String, name: &str, rows: &[DVec3]) -> std::fmt::Result {
    array(
        text,
        "Float64",
        name,
        3,
        rows.iter().flat_map(|v| v.to_array()).flat_map(f64::to_le_bytes).collect(),
    )
}

fn array(
    text: &mut String,
    kind: &str,
    name: &str,
    n_components: usize,
    bytes: Vec<u8>,
) -> std::fmt::Result {
    let length = (bytes.len() as u64).to_le_bytes();
    let content = BASE64_STANDARD.encode([&length[..], &bytes].concat());
    writeln!(
        text,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{n_components}\" \
         format=\"binary\">{content}</DataArray>"
    )
}
