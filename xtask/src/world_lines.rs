//! Measures the pipe and rays on bodies that accelerate and spin, relative to the same body in
//! inertial motion, as Markdown.

use std::error::Error;
use std::io::Write;

use crate::bench::{self, CommandTimes};
use crate::mesh;

/// Runs of each command, in turn; the fastest counts.
const RUNS: usize = 5;

const MOTIONS: [(&str, &str); 3] = [
    ("`-vel .8 0 0`", "-vel .8 0 0"),
    ("`-acc .5 0 0`", "-acc .5 0 0 -9 9"),
    ("`-spin 0 0 .8`", "-spin 0 0 .8"),
];

/// The body is at the origin at time 0, and light takes 6 to the camera.
const PLACE: &str = "-an 0 0 0 -ti 6";

/// What is drawn after the body.
const TAIL: &str = "l 0.3; l sun 0.7 -1 -2 1.5; cam -ep 0 -6 1 -vc 0 0 0 -ud 0 0 1 -va 30 18;\n";

/// Prints the table for a mesh of about `triangles` triangles.
pub fn write(out: &mut impl Write, triangles: u32) -> Result<(), Box<dyn Error>> {
    bench::build(&["uglorentz", "ugdoppler", "ugrainbow", "ugphoton"])?;
    let dir = bench::target_dir().join("bench");
    std::fs::create_dir_all(&dir)?;
    let mut text = Vec::new();
    mesh::write_with(&mut text, triangles, false, "")?;
    let text = String::from_utf8(text)?;
    let mut files = Vec::new();
    for (row, (_, motion)) in MOTIONS.iter().enumerate() {
        let file = dir.join(format!("motion-{row}.ug")).display().to_string();
        std::fs::write(&file, format!("motion m {motion};\ndef mesh;\n{text}end;\ni (mesh) <m>;\n{TAIL}"))?;
        files.push(file);
    }
    writeln!(out, "{}\n", bench::machine())?;
    writeln!(out, "{triangles} triangles, 1280 × 720, processor time (elapsed time) in seconds\n")?;
    writeln!(out, "| motion | pipe | of inertial | rays | of inertial |")?;
    writeln!(out, "| --- | ---: | ---: | ---: | ---: |")?;
    let mut best = [[CommandTimes::MOST; 2]; MOTIONS.len()];
    for _ in 0..RUNS {
        for (best, file) in best.iter_mut().zip(&files) {
            for (best, command) in best.iter_mut().zip([
                format!("uglorentz -qt {PLACE} {file} | ugdoppler -qt | ugrainbow -qt -sz 1280 720 -aa 1"),
                format!("ugphoton -qt {PLACE} --no-shadows -sz 1280 720 -aa 1 {file}"),
            ]) {
                *best = best.least(CommandTimes::of(&command)?);
            }
        }
    }
    for ((name, _), [pipe, rays]) in MOTIONS.iter().zip(best) {
        let [of_pipe, of_rays] = [pipe.user / best[0][0].user, rays.user / best[0][1].user];
        writeln!(out, "| {name} | {pipe} | {of_pipe:.1} | {rays} | {of_rays:.1} |")?;
    }
    Ok(())
}
