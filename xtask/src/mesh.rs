//! A bumpy sphere with coloured vertices and any number of triangles, for benchmarks.

use crate::globe::{Direction, Globe};
use crate::short::{Short, ShortPoint};
use glam::DVec3;
use std::f64::consts::{PI, TAU};
use std::io::{self, Write};

/// The palette: hues from red to blue and back by longitude, saturations by colatitude. It has no
/// purples, which have no wavelength.
const HUES: u32 = 36;
const SATURATIONS: u32 = 8;

/// Writes a mesh of about `triangles` triangles; if `each`, every vertex has its own colour.
pub fn write(out: &mut impl Write, triangles: u32, each: bool) -> io::Result<()> {
    let globe = globe(triangles);
    let bands = globe.bands;
    writeln!(
        out,
        "{{ A bumpy sphere, r = 1 + 0.05 sin 12 theta cos 9 phi, with {} triangles and {}
  on its vertices: something to measure speed on.
  z is up; faces run counterclockwise seen from outside.
  Made by `cargo xtask mesh {triangles}{}`. CC0 1.0.
}}",
        4 * bands * (bands - 1),
        if each { "as many colours as there are".into() } else { format!("{} colours", HUES * SATURATIONS) },
        if each { " --each" } else { "" },
    )?;
    if each {
        for (i, direction) in globe.directions().enumerate() {
            writeln!(out, "c c{i} {} ;", own_color(i, direction))?;
        }
    } else {
        write_palette(out)?;
    }
    for (i, direction) in globe.directions().enumerate() {
        let p = position(direction);
        let color = if each { format!("c{i}") } else { color_name(direction) };
        writeln!(out, "v v{i} {} {color} ;", ShortPoint(p))?;
    }
    for [a, b, c] in corners(&globe) {
        writeln!(out, "f (v{a} v{b} v{c}) ;")?;
    }
    writeln!(
        out,
        "l 0.3 ;
l sun 0.7 -1 -2 1.5 ;
cam -ep 0 -6 1 -vc 0 0 0 -ud 0 0 1 -ps -va 30 24 ;"
    )
}

/// The positions and triangles of the same mesh.
pub fn triangles(triangles: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let globe = globe(triangles);
    (globe.directions().map(position).collect(), corners(&globe).collect())
}

fn globe(triangles: u32) -> Globe {
    // A globe of n bands and 2 n sectors has 4 n (n - 1) triangles.
    Globe::with_bands((f64::from(triangles) / 4.0).sqrt().round() as u32)
}

fn corners(globe: &Globe) -> impl Iterator<Item = [u32; 3]> {
    (0..globe.bands).flat_map(|band| globe.cells(band)).flat_map(|cell| {
        (2..cell.len()).map(|last| [cell[0], cell[last - 1], cell[last]]).collect::<Vec<_>>()
    })
}

fn position(direction: Direction) -> DVec3 {
    radius(direction) * direction.unit()
}

fn write_palette(out: &mut impl Write) -> io::Result<()> {
    for h in 0..HUES {
        for s in 0..SATURATIONS {
            let hue = 240.0 * f64::from(h) / f64::from(HUES - 1);
            let saturation = f64::from(s + 1) / f64::from(SATURATIONS);
            writeln!(out, "c {} 0.9 {} {} ;", name(h, s), Short(hue), Short(saturation))?;
        }
    }
    Ok(())
}

/// Value, hue and saturation similar to the palette in that direction, but unique for every vertex.
fn own_color(i: usize, direction: Direction) -> String {
    let there_and_back = 1.0 - (2.0 * direction.phi / TAU - 1.0).abs();
    // Multiples of the golden ratio are evenly distributed and do not repeat for many millions of
    // steps.
    let value = 0.5 + 0.5 * (i as f64 * 0.618_033_988_749_895).fract();
    format!("{value:.9} {} {}", Short(240.0 * there_and_back), Short(0.1 + 0.9 * direction.theta / PI))
}

fn radius(direction: Direction) -> f64 {
    1.0 + 0.05 * libm::sin(12.0 * direction.theta) * libm::cos(9.0 * direction.phi)
}

fn color_name(direction: Direction) -> String {
    let step = |part: f64, steps: u32| ((part * f64::from(steps)) as u32).min(steps - 1);
    // 0 at longitude 0, 1 on the opposite side.
    let there_and_back = 1.0 - (2.0 * direction.phi / TAU - 1.0).abs();
    name(step(there_and_back, HUES), step(direction.theta / PI, SATURATIONS))
}

fn name(hue_step: u32, saturation_step: u32) -> String {
    format!("h{hue_step}s{saturation_step}")
}
