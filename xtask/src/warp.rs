//! Measures `ugwarp` relative to the filter `v360` of ffmpeg: the same view of the same panorama.
//!
//! Every run is a process of its own, and those to be compared alternate; the median of each is
//! taken. Reading and decoding are left out by subtracting runs that make a tiny picture of a small
//! part of the same file.

use std::error::Error;
use std::io::Write;
use std::path::Path;
use std::process::Command;

use crate::bench::{build, machine, program, target_dir};
use crate::photon::time;
use crate::rays::median;

/// Runs that are compared.
const ROUNDS: usize = 15;

const SIZE: [u32; 2] = [1920, 1080];

/// The view angle across, and that down which it has in this shape, degrees.
const ANGLES: [&str; 2] = ["90", "58.715507"];

/// Frames of the film that shows what `v360` needs once its map is made.
const FRAMES: u32 = 10;

/// Benchmarks `ugwarp`. `ffmpeg`: executable.
pub fn write(out: &mut impl Write, ffmpeg: &str) -> Result<(), Box<dyn Error>> {
    build(&["ugwarp"])?;
    let dir = target_dir().join("bench");
    std::fs::create_dir_all(&dir)?;
    let files = ["panorama.ppm", "panorama.png"].map(|name| dir.join(name));
    make_panorama(ffmpeg, &files[0], &files[1])?;
    writeln!(out, "{}\n", machine())?;

    let [ppm, png] = &files;
    let rows = [
        ("as at rest (geometry)", Some("--no-doppler --no-flux")),
        ("hues and brightness (the default)", Some("")),
        ("spectra (`-sp`)", Some("-sp")),
        ("`v360`, lanczos, one frame", None),
        ("`v360`, lanczos, each further frame", None),
    ];
    // Each round has four runs of ugwarp: a tiny picture, then one for each row of the table. Then
    // four of v360: a tiny and a full-size picture, each for one frame and for 1 + FRAMES frames.
    let mut rounds: Vec<Vec<[f64; 2]>> = Vec::new();
    for _ in 0..ROUNDS {
        // A small view angle, so that no mip levels of the panorama are computed.
        let mut round = vec![ugwarp(png, "--no-doppler --no-flux", "0.5", [16, 9])?];
        for options in rows.iter().filter_map(|(_, options)| *options) {
            round.push(ugwarp(png, options, ANGLES[0], SIZE)?);
        }
        for n_frames in [1, 1 + FRAMES] {
            round.push(v360(ffmpeg, ppm, [16, 9], n_frames)?);
            round.push(v360(ffmpeg, ppm, SIZE, n_frames)?);
        }
        rounds.push(round);
    }
    let typical = |idx: usize| [0, 1].map(|kind| median(rounds.iter().map(|round| round[idx][kind])));
    let mut times: Vec<[f64; 2]> = (1..4).map(|idx| minus(typical(idx), typical(0))).collect();
    let first = minus(typical(5), typical(4));
    let further = minus(minus(typical(7), typical(6)), first).map(|time| time / f64::from(FRAMES));
    times.extend([first, further]);
    writeln!(
        out,
        "| {} x {} of 8192 x 4096 pixels | time | processor time | processor time / one frame of `v360` |\n\
         | --- | ---: | ---: | ---: |",
        SIZE[0], SIZE[1]
    )?;
    for ((name, _), [time, processor]) in rows.iter().zip(&times) {
        let ratio = processor / first[1];
        writeln!(out, "| {name} | {:.0} ms | {:.0} ms | {ratio:.2} |", time * 1e3, processor * 1e3)?;
    }
    writeln!(out)?;
    Ok(out.flush()?)
}

fn minus(one: [f64; 2], other: [f64; 2]) -> [f64; 2] {
    [one[0] - other[0], one[1] - other[1]]
}

/// A fractal with noise, which has detail at every size.
fn make_panorama(ffmpeg: &str, ppm: &Path, png: &Path) -> Result<(), Box<dyn Error>> {
    if !ppm.exists() {
        let source = "mandelbrot=size=2048x1024:rate=1";
        let filter = "scale=8192:4096:flags=bicubic,noise=alls=8";
        let words =
            ["-nostdin", "-v", "error", "-y", "-f", "lavfi", "-i", source, "-frames:v", "1", "-vf", filter];
        time(Command::new(ffmpeg).args(words).args(["-pix_fmt", "rgb24"]).arg(ppm))?;
    }
    if !png.exists() {
        time(Command::new(ffmpeg).args(["-nostdin", "-v", "error", "-y", "-i"]).arg(ppm).arg(png))?;
    }
    Ok(())
}

/// Time and processor time of a picture.
fn ugwarp(png: &Path, options: &str, angle: &str, size: [u32; 2]) -> Result<[f64; 2], Box<dyn Error>> {
    let mut command = Command::new(program("ugwarp"));
    command.args(["-cv", "0", ".5", "0", "-va", angle, "-qt", "-sz"]).args(size.map(|n| n.to_string()));
    time(command.args(options.split_whitespace()).arg(png).arg("-fo").arg(png.with_extension("view.png")))
}

/// Time and processor time of `v360` for frames of one view, with its largest kernel.
fn v360(
    ffmpeg: &str,
    ppm: &Path,
    [width, height]: [u32; 2],
    n_frames: u32,
) -> Result<[f64; 2], Box<dyn Error>> {
    let filter = format!(
        "loop={n_frames}:1,v360=e:flat:h_fov={}:v_fov={}:w={width}:h={height}:interp=lanczos",
        ANGLES[0], ANGLES[1]
    );
    let mut command = Command::new(ffmpeg);
    command.args(["-nostdin", "-v", "error", "-loop", "1", "-i"]).arg(ppm).args(["-vf", &filter]);
    time(command.args(["-frames:v", &n_frames.to_string(), "-f", "null", "-"]))
}
