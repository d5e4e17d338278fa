//! Measures the time of reading and writing scenes, relative to `tobj` on the same mesh as OBJ, and
//! memory, as Markdown.
//!
//! All input is in memory before the measurement begins. Rates refer to the size of each format's
//! own text. Runs alternate, so that other load on the machine affects all of them.

use std::error::Error;
use std::hint::black_box;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use rayon::{ThreadPool, ThreadPoolBuilder};
use ugparse::{Options, Source};
use ugscene::Scene;

use crate::bench::{machine, target_dir};
use crate::mesh;

/// Rounds of all measurements; the fastest of each counts.
const ROUNDS: usize = 9;

/// A function to measure.
struct Work<'w> {
    name: &'static str,
    /// Size of the text it reads or writes.
    megabytes: f64,
    /// Returns false on failure.
    run: &'w dyn Fn() -> bool,
}

/// Benchmarks a mesh of about this number of triangles.
pub fn write(out: &mut impl Write, triangles: u32) -> Result<(), Box<dyn Error>> {
    let dir = target_dir().join("bench");
    std::fs::create_dir_all(&dir)?;
    let path = dir.join(format!("reading-{triangles}.ug"));
    let mut text = Vec::new();
    mesh::write(&mut text, triangles, false)?;
    std::fs::write(&path, &text)?;
    let megabytes = text.len() as f64 / 1e6;
    let source = Source::new(path.display().to_string(), text);
    let scene = ugparse::parse(&source, &Options::default())?.scene;
    let obj = to_obj(&scene)?;

    writeln!(out, "{}\n", machine())?;
    writeln!(
        out,
        "### {triangles} triangles, {megabytes:.1} MB of text, {:.1} MB as OBJ\n",
        obj.len() as f64 / 1e6
    )?;
    writeln!(out, "| task | fastest time | MB/s | speed / `tobj` |")?;
    writeln!(out, "| --- | ---: | ---: | ---: |")?;
    let pools = [pool(1)?, pool(2)?];
    let [one, two] = &pools;
    let read = || ugparse::parse(&source, &Options::default());
    let write = || ugparse::write(&scene);
    let works = [
        Work { name: "`tobj`, 1 thread", megabytes: obj.len() as f64 / 1e6, run: &|| read_obj(&obj) },
        Work { name: "reading, 1 thread", megabytes, run: &|| black_box(one.install(read)).is_ok() },
        Work { name: "reading, 2 threads", megabytes, run: &|| black_box(two.install(read)).is_ok() },
        Work { name: "writing, 1 thread", megabytes, run: &|| !black_box(one.install(write)).is_empty() },
        Work { name: "writing, 2 threads", megabytes, run: &|| !black_box(two.install(write)).is_empty() },
    ];
    let seconds = fastest(&works)?;
    let rate = |row: usize| works[row].megabytes / seconds[row];
    for (row, work) in works.iter().enumerate() {
        let (ms, ratio) = (seconds[row] * 1e3, rate(row) / rate(0));
        writeln!(out, "| {} | {ms:.1} ms | {:.0} | {ratio:.1} |", work.name, rate(row))?;
    }
    for n_threads in [1, 2] {
        let peak = peak_of_child(&path, n_threads)? / 1e6;
        writeln!(
            out,
            "\nPeak memory of reading on {n_threads} thread(s), text included: {peak:.0} MB, {:.2} times the text.",
            peak / megabytes
        )?;
    }
    Ok(())
}

/// Reads a scene once and prints the peak memory of this process in bytes.
pub fn read_once(out: &mut impl Write, path: &Path, n_threads: usize) -> Result<(), Box<dyn Error>> {
    let source = Source::new("mesh", std::fs::read(path)?);
    black_box(pool(n_threads)?.install(|| ugparse::parse(&source, &Options::default()))?);
    Ok(writeln!(out, "{}", peak_memory()?)?)
}

/// Peak memory of this process so far, in bytes.
pub fn peak_memory() -> Result<u64, Box<dyn Error>> {
    let status = std::fs::read_to_string("/proc/self/status")?;
    Ok(peak_in(&status).ok_or("no VmHWM in /proc/self/status")?)
}

/// Peak memory in bytes by the status of a process.
pub fn peak_in(status: &str) -> Option<u64> {
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    peak.trim().trim_end_matches(" kB").parse().ok().map(|kib: u64| kib * 1024)
}

fn peak_of_child(path: &Path, n_threads: usize) -> Result<f64, Box<dyn Error>> {
    let exe: PathBuf = std::env::current_exe()?;
    let output = Command::new(exe).arg("read-once").arg(path).arg(n_threads.to_string()).output()?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into());
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim().parse()?)
}

fn pool(n_threads: usize) -> Result<ThreadPool, Box<dyn Error>> {
    Ok(ThreadPoolBuilder::new().num_threads(n_threads).build()?)
}

/// The fastest run of each work, in seconds.
fn fastest(works: &[Work<'_>]) -> Result<Vec<f64>, Box<dyn Error>> {
    let mut fastest = vec![f64::INFINITY; works.len()];
    for _ in 0..ROUNDS {
        for (work, fastest) in works.iter().zip(&mut fastest) {
            let start = Instant::now();
            if !(work.run)() {
                return Err("the mesh cannot be read".into());
            }
            *fastest = start.elapsed().as_secs_f64().min(*fastest);
        }
    }
    Ok(fastest)
}

/// Converts vertices and faces to OBJ.
fn to_obj(scene: &Scene) -> io::Result<Vec<u8>> {
    let mut obj = Vec::new();
    for vertex in &scene.vertices {
        let [x, y, z] = vertex.position.to_array();
        writeln!(obj, "v {x} {y} {z}")?;
    }
    for face in &scene.faces {
        write!(obj, "f")?;
        for corner in scene.contours.corners(face.contours.clone()) {
            write!(obj, " {}", corner.index() + 1)?;
        }
        writeln!(obj)?;
    }
    Ok(obj)
}

fn read_obj(obj: &[u8]) -> bool {
    let no_materials = |_: &Path| Err(tobj::LoadError::OpenFileFailed);
    black_box(tobj::load_obj_buf(&mut &*obj, &tobj::LoadOptions::default(), no_materials)).is_ok()
}
