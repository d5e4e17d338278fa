//! Spheres of radius 1 whose faces share vertices.

use crate::globe::{Direction, Globe};
use crate::short::ShortPoint;
use glam::DVec3;
use std::io::{self, Write};

/// The unit vector in a direction.
pub fn unit_vector(direction: Direction) -> DVec3 {
    let (sin_theta, cos_theta) = libm::sincos(direction.theta);
    let (sin_phi, cos_phi) = libm::sincos(direction.phi);
    DVec3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta)
}

/// Writes a sphere of one colour with vertex normals, for smooth shading.
pub fn write(out: &mut impl Write, bands: u32) -> io::Result<()> {
    let globe = Globe::with_bands(bands);
    writeln!(
        out,
        "{{ A sphere of radius 1 about the origin, {bands} bands from pole to pole, shaded smooth.
  z is up; faces run counterclockwise seen from outside.
  Made by `cargo xtask sphere --bands {bands}`. CC0 1.0.
}}
c 0.9 210 0.4 ;"
    )?;
    for (i, direction) in globe.directions().enumerate() {
        let p = ShortPoint(unit_vector(direction));
        writeln!(out, "v v{i} {p} {p} ;")?;
    }
    for cell in (0..bands).flat_map(|band| globe.cells(band)) {
        write_face(out, &cell, None)?;
    }
    write_view(out)
}

/// Writes a sphere whose northern half is red and southern half green. Vertices have no normals,
/// and both halves share those on the equator.
pub fn write_halves(out: &mut impl Write, bands: u32) -> io::Result<()> {
    let globe = Globe::with_bands(bands);
    writeln!(
        out,
        "{{ A sphere with a red northern and a green southern half that share the vertices of
  the equator. What colour has a vertex that belongs to faces of two colours?

    ugdoppler < halves.ug | ugrainbow > mixed.png      a mixture: the halves flow together
    ugdoppler -vr < halves.ug | ugrainbow > sharp.png  one vertex for each colour: a sharp edge

  z is up; faces run counterclockwise seen from outside.
  Made by `cargo xtask sphere --halves --bands {bands}`. CC0 1.0.
}}
c red   0.9   0 0.8 ;
c green 0.8 120 0.8 ;"
    )?;
    for (i, direction) in globe.directions().enumerate() {
        writeln!(out, "v v{i} {} ;", ShortPoint(unit_vector(direction)))?;
    }
    for band in 0..bands {
        let color = if 2 * band < bands { "red" } else { "green" };
        for cell in globe.cells(band) {
            write_face(out, &cell, Some(color))?;
        }
    }
    write_view(out)
}

fn write_face(out: &mut impl Write, cell: &[u32], color: Option<&str>) -> io::Result<()> {
    let mut separator = "f (";
    for vertex in cell {
        write!(out, "{separator}v{vertex}")?;
        separator = " ";
    }
    match color {
        Some(color) => writeln!(out, ") {color} ;"),
        None => writeln!(out, ") ;"),
    }
}

/// Lights and a camera.
pub fn write_view(out: &mut impl Write) -> io::Result<()> {
    writeln!(
        out,
        "l 0.3 ;
l sun 0.7 -1 -2 1.5 ;
cam -ep 0 -6 1 -vc 0 0 0 -ud 0 0 1 -ps -va 30 24 ;"
    )
}
