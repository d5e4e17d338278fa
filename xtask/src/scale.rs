//! Measures time and memory of `ugrainbow` as functions of the number of faces and pixels, as
//! Markdown and as a plot.

use std::error::Error;
use std::io::Write;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use ugparse::Source;
use ugrainbow::Config;

use crate::bench::{machine, target_dir};
use crate::mesh;
use crate::plot::{Growth, Series, logarithmic};

/// Runs of each measurement; the fastest and the least memory count.
const ROUNDS: usize = 3;

/// Approximate numbers of triangles, drawn with [`FEW_PIXELS`].
const TRIANGLES: [u32; 7] = [10_000, 30_000, 100_000, 300_000, 1_000_000, 3_000_000, 10_000_000];
const FEW_PIXELS: [u32; 2] = [1280, 720];

/// Widths and heights of the pictures of [`FEW_TRIANGLES`], pixels.
const PICTURES: [u32; 6] = [512, 1024, 2048, 4096, 8192, 16384];
const FEW_TRIANGLES: u32 = 100_000;

/// Samples along a side of a pixel, for the last table.
const SAMPLES: [u32; 4] = [1, 2, 4, 16];
const SAMPLED_PICTURE: u32 = 4096;

/// Time and memory of one run.
struct Cost {
    /// Time of reading, drawing and encoding the file.
    seconds: f64,
    /// Peak memory of the process in megabytes.
    megabytes: f64,
}

/// Runs all measurements, prints tables, and writes the plot to a file.
pub fn write(out: &mut impl Write, plot: &Path) -> Result<(), Box<dyn Error>> {
    let dir = target_dir().join("bench");
    std::fs::create_dir_all(&dir)?;
    writeln!(out, "{}\n", machine())?;
    let (mut faces, mut pixels) = (Vec::new(), Vec::new());
    head(out, "triangles, 1280×720, `-aa 1`")?;
    for n in TRIANGLES {
        let cost = row(out, &dir, n, FEW_PIXELS, 1, &n.to_string())?;
        faces.push((f64::from(n), cost));
    }
    head(out, "pixels, 100 000 triangles, `-aa 1`")?;
    for side in PICTURES {
        let cost = row(out, &dir, FEW_TRIANGLES, [side; 2], 1, &format!("{side}×{side}"))?;
        pixels.push((f64::from(side) * f64::from(side) / 1e6, cost));
    }
    head(out, "samples, 100 000 triangles, 4096×4096")?;
    for samples in SAMPLES {
        row(out, &dir, FEW_TRIANGLES, [SAMPLED_PICTURE; 2], samples, &format!("`-aa {samples}`"))?;
    }
    let panel = |title, unit, costs: &[(f64, Cost)]| {
        let of = |number: &dyn Fn(&Cost) -> f64| costs.iter().map(|(x, cost)| [*x, number(cost)]).collect();
        let seconds = Series { name: "seconds", points: of(&|cost| cost.seconds) };
        let gigabytes = Series { name: "GB of memory", points: of(&|cost| cost.megabytes / 1e3) };
        Growth { title, unit, series: [seconds, gigabytes] }
    };
    let panels = [
        panel("1280×720 pixels", "triangles", &faces),
        panel("100 000 triangles", "million pixels", &pixels),
    ];
    Ok(std::fs::write(plot, logarithmic(&panels).svg()?)?)
}

fn head(out: &mut impl Write, what: &str) -> std::io::Result<()> {
    writeln!(out, "\n| {what} | seconds | peak memory |\n| ---: | ---: | ---: |")
}

fn row(
    out: &mut impl Write,
    dir: &Path,
    triangles: u32,
    size: [u32; 2],
    samples: u32,
    name: &str,
) -> Result<Cost, Box<dyn Error>> {
    let scene = dir.join(format!("scale-{triangles}.ug"));
    if !scene.exists() {
        let mut text = std::io::BufWriter::new(std::fs::File::create(&scene)?);
        mesh::write(&mut text, triangles, false)?;
        text.flush()?;
    }
    let mut cost = Cost { seconds: f64::INFINITY, megabytes: f64::INFINITY };
    for _ in 0..ROUNDS {
        let [seconds, megabytes] = in_a_child(&scene, size, samples)?;
        cost = Cost { seconds: cost.seconds.min(seconds), megabytes: cost.megabytes.min(megabytes) };
    }
    writeln!(out, "| {name} | {:.3} | {:.0} MB |", cost.seconds, cost.megabytes)?;
    out.flush()?;
    Ok(cost)
}

fn in_a_child(scene: &Path, size: [u32; 2], samples: u32) -> Result<[f64; 2], Box<dyn Error>> {
    let numbers = [size[0], size[1], samples].map(|number| number.to_string());
    let output = Command::new(std::env::current_exe()?).arg("draw-once").arg(scene).args(numbers).output()?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into());
    }
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let (seconds, megabytes) = text.trim().split_once(' ').ok_or("no two numbers")?;
    Ok([seconds.parse()?, megabytes.parse()?])
}

/// Reads a scene, draws it, encodes a PNG, and prints the time in seconds and the peak memory of
/// this process in megabytes.
pub fn draw_once(
    out: &mut impl Write,
    scene: &Path,
    size: [u32; 2],
    samples: u32,
) -> Result<(), Box<dyn Error>> {
    let start = Instant::now();
    let source = Source::new("mesh", std::fs::read(scene)?);
    // The vertical view angle of the scene's camera is for another aspect ratio.
    let camera = ugrainbow::CameraOptions { view_angle: Some((30.0, None)), ..Default::default() };
    let config = Config {
        picture: ugrainbow::PictureOptions { size, samples, camera, ..ugrainbow::PictureOptions::default() },
        ..Config::default()
    };
    std::hint::black_box(ugrainbow::run(&config, &source)?);
    let seconds = start.elapsed().as_secs_f64();
    Ok(writeln!(out, "{seconds} {}", crate::reading::peak_memory()? as f64 / 1e6)?)
}
