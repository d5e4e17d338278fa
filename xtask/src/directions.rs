//! The sphere of directions around an observer, with a pattern, at rest and in motion.

use std::error::Error;
use std::io::Write;

use glam::DVec3;
use ugphysics::{Velocity, aberrate};

use crate::globe::Direction;
use crate::short::{Short, ShortPoint};
use crate::sphere::unit_vector;

/// Checks from pole to pole; there are twice as many around.
const BANDS: u32 = 12;

/// The greatest side of a face, degrees.
const STEP_DEG: f64 = 5.0;

/// Writes two spheres side by side, the second as seen by an observer who moves with `beta` towards
/// the north pole.  Eq. (P6)
pub fn write(out: &mut impl Write, beta: f64) -> Result<(), Box<dyn Error>> {
    let motion = Velocity::from_beta(beta * DVec3::Z)?;
    writeln!(
        out,
        "{{ Directions around an observer, as a globe of checks seen from outside, after Weiskopf (2000),
  figure 1. On the left they are as at rest, on the right where an observer who moves towards the
  north pole at {beta}c sees them. Aberration gathers them there.

    ugrainbow < directions.ug > directions.png

  The texture is made of faces: {BANDS} bands of checks, of a colour each, from red in the south to blue
  in the north. Every sphere is one strip of it, repeated around.
  Radius 1; z is up, north; faces run counterclockwise seen from outside; vertices carry normals.
  Made by `cargo xtask directions --beta {beta}`. CC0 1.0: no rights reserved.
}}
c white 0.95 45 0.1 ;"
    )?;
    for band in 0..BANDS {
        writeln!(
            out,
            "c band{band} 0.9 {} 0.8 ;",
            Short(240.0 - 240.0 * f64::from(band) / f64::from(BANDS - 1))
        )?;
    }
    write_globe(out, "rest", Velocity::ZERO)?;
    write_globe(out, "moving", motion)?;
    Ok(writeln!(
        out,
        "def ahead ; v a 0 0 1 ; v b 0 0 1.4 ; v c 0.05 0 1.3 ; v d -0.05 0 1.3 ; w (a b) (c b d) white ; end ;
i (rest -tx -1.2) ; i (moving -tx 1.2) ; i (ahead -tx 1.2) ;
l 0.45 ;
l sun 0.55 -1 -2 1.5 ;
cam -ep 0 -9 5 -vc 0 0 0.08 -ud 0 0 1 -ps -va 27 14 ;"
    )?)
}

/// A sphere of which all points of a circle of latitude are moved to another one.
fn write_globe(out: &mut impl Write, name: &str, motion: Velocity) -> Result<(), Box<dyn Error>> {
    let side = 180.0 / f64::from(BANDS);
    let columns = (side / STEP_DEG).ceil() as u32;
    writeln!(out, "def {name}_strip ;")?;
    for band in 0..BANDS {
        let [north, south] = [band, band + 1].map(|edge| seen(f64::from(edge) * side, motion));
        let rows = ((south - north) / STEP_DEG).ceil() as u32;
        for column in 0..2 {
            let check = format!("{}{band}_", ["a", "b"][column as usize]);
            let color = if (band + column) % 2 == 0 { format!("band{band}") } else { "white".to_owned() };
            for row in 0..=rows {
                for step in 0..=columns {
                    let theta = north + (south - north) * f64::from(row) / f64::from(rows);
                    let phi = side * (f64::from(column) + f64::from(step) / f64::from(columns));
                    let place = unit_vector(Direction { theta: theta.to_radians(), phi: phi.to_radians() });
                    let place = ShortPoint(place);
                    writeln!(out, "v {check}{row}_{step} {place}  {place} ;")?;
                }
            }
            for row in 0..rows {
                let faces = (0..columns).map(|step| face(band, [row, rows], step, &check, &color));
                writeln!(out, "{}", faces.collect::<Vec<_>>().join(" "))?;
            }
        }
    }
    Ok(writeln!(out, "end ;\ndef {name} ; a ({name}_strip) {BANDS} -rz {} ; end ;", Short(2.0 * side))?)
}

/// A cell of a check: a triangle at the poles.
fn face(band: u32, [row, rows]: [u32; 2], step: u32, check: &str, color: &str) -> String {
    let mut corners = vec![[row, step], [row + 1, step], [row + 1, step + 1], [row, step + 1]];
    if band == 0 && row == 0 {
        corners.pop();
    }
    if band + 1 == BANDS && row + 1 == rows {
        corners.remove(2);
    }
    let names: Vec<_> = corners.iter().map(|[row, step]| format!("{check}{row}_{step}")).collect();
    format!("f ({}) {color} ;", names.join(" "))
}

/// The angle to the motion at which an observer sees what is seen at the angle `theta` at rest,
/// degrees.
fn seen(theta: f64, motion: Velocity) -> f64 {
    let (sin, cos) = libm::sincos(theta.to_radians());
    let seen = aberrate(DVec3::new(sin, 0.0, cos), motion);
    libm::atan2(seen.x, seen.z).to_degrees()
}

#[cfg(test)]
mod tests {
    use super::{DVec3, Velocity, seen};

    /// At 0.9c, what was abeam is seen at acos 0.9 from straight ahead, and poles stay.
    #[test]
    fn directions_are_gathered_ahead() {
        let motion = Velocity::from_beta(0.9 * DVec3::Z).unwrap();
        for (at_rest, moving) in [(0.0, 0.0), (90.0, 25.841932763167122), (180.0, 180.0)] {
            assert!((seen(at_rest, motion) - moving).abs() < 1e-9, "{at_rest}");
        }
    }
}
