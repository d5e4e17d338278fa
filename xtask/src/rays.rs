//! Measures rays against the triangles of a mesh at rest, relative to Embree 3, alternately on the
//! same mesh, as Markdown.
//!
//! `embree.cpp` runs Embree; its head lists what must be installed. Both compute the directions of
//! their rays while they are measured, Embree's in single precision. Rounds are short and
//! alternate, and medians count, so that other programs on the machine disturb both alike; the
//! processor time of all threads is hardly disturbed at all.

use std::error::Error;
use std::f64::consts::PI;
use std::hint::black_box;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use glam::DVec3;
use rayon::ThreadPoolBuilder;
use ugbvh::{Bvh, Ray};

use crate::bench::{machine, target_dir};
use crate::mesh;

/// Runs of each program alternately; the median counts.
const ROUNDS: usize = 21;

/// The measured quantity.
const ROWS: [&str; 3] = ["building", "single rays", "packets"];

const WIDTH: usize = 1280;
const HEIGHT: usize = 720;

/// Packets have this many rays along a side.
const SIDE: usize = 8;

const EYE: DVec3 = DVec3::new(0.0, -3.2, 0.6);

/// Horizontal view angle, degrees.
const VIEW_ANGLE: f64 = 52.0;

/// Benchmarks meshes of about these numbers of triangles.
pub fn write(
    out: &mut impl Write,
    sizes: &[u32],
    compiler: &str,
    threads: usize,
) -> Result<(), Box<dyn Error>> {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build()?;
    let dir = target_dir().join("bench");
    std::fs::create_dir_all(&dir)?;
    compile(compiler, &dir.join(PROGRAM))?;
    writeln!(out, "{}, {threads} used, {WIDTH}×{HEIGHT} rays\n", machine())?;
    writeln!(
        out,
        "| triangles | bytes per triangle | | `ugbvh` | Embree 3 | speed / Embree's | processor time | Embree's | ratio |\n\
         | ---: | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: |"
    )?;
    for &size in sizes {
        let (positions, triangles) = rounded_mesh(size);
        let mut embree = Embree::start(&positions, &triangles, &dir, threads)?;
        let mut rounds = [const { Vec::new() }; 3];
        let mut bvh = pool.install(|| Bvh::new(&positions, &triangles));
        check_same(&pool, &bvh, &mut embree)?;
        for _ in 0..ROUNDS {
            // Neither program's time includes freeing the hierarchy before.
            drop(bvh);
            let (built, ours) = measured(|| pool.install(|| Bvh::new(black_box(&positions), &triangles)))?;
            bvh = built;
            rounds[0].push([ours, embree.run("build")?.0]);
            let (_, ours) = measured(|| black_box(pool.install(|| trace(&bvh, trace_single))))?;
            rounds[1].push([ours, embree.run("single")?.0]);
            let (_, ours) = measured(|| black_box(pool.install(|| trace(&bvh, trace_packet))))?;
            rounds[2].push([ours, embree.run("packet")?.0]);
        }
        let n_bytes = bvh.n_bytes() as f64 / triangles.len() as f64;
        let head = format!("| {} | {n_bytes:.0} |", triangles.len());
        for (name, rounds) in ROWS.into_iter().zip(&rounds) {
            write!(out, "{head} {name}")?;
            for of in [|time: &Time| time.wall, |time: &Time| time.processor] {
                let [ours, theirs] =
                    [0, 1].map(|program| median(rounds.iter().map(|round| of(&round[program]))));
                let ratio = median(rounds.iter().map(|[ours, theirs]| of(theirs) / of(ours)));
                write!(out, " | {:.1} ms | {:.1} ms | {ratio:.2}", ours * 1e3, theirs * 1e3)?;
            }
            writeln!(out, " |")?;
            out.flush()?;
        }
    }
    Ok(())
}

/// How long something took, seconds.
#[derive(Clone, Copy)]
struct Time {
    wall: f64,
    /// The sum of all threads.
    processor: f64,
}

fn measured<T>(work: impl FnOnce() -> T) -> Result<(T, Time), Box<dyn Error>> {
    let (start, processor_start) = (Instant::now(), processor_time()?);
    let result = work();
    let wall = start.elapsed().as_secs_f64();
    Ok((result, Time { wall, processor: processor_time()? - processor_start }))
}

/// Processor time of all threads of this process, seconds. Threads that ended do not count.
pub fn processor_time() -> Result<f64, Box<dyn Error>> {
    let mut nanoseconds = 0;
    for thread in std::fs::read_dir("/proc/self/task")? {
        // Threads of others may end meanwhile.
        let Ok(text) = std::fs::read_to_string(thread?.path().join("schedstat")) else { continue };
        nanoseconds += text.split_whitespace().next().unwrap_or("0").parse::<u64>()?;
    }
    Ok(nanoseconds as f64 * 1e-9)
}

/// The upper one of two.
pub fn median(numbers: impl Iterator<Item = f64>) -> f64 {
    let mut numbers: Vec<f64> = numbers.collect();
    numbers.sort_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}

/// The mesh with positions rounded to single precision, so that both programs have the same.
fn rounded_mesh(size: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let (mut positions, triangles) = mesh::triangles(size);
    for position in &mut positions {
        *position = position.as_vec3().as_dvec3();
    }
    (positions, triangles)
}

/// Fails if single rays and packets have different hits, or others than Embree.
/// Embree's rays are rounded, so a few at the outline may differ.
fn check_same(pool: &rayon::ThreadPool, bvh: &Bvh, embree: &mut Embree) -> Result<(), Box<dyn Error>> {
    let ours = pool.install(|| trace(bvh, trace_single));
    let packets = pool.install(|| trace(bvh, trace_packet));
    let theirs = [embree.run("single")?.1, embree.run("packet")?.1];
    if ours != packets || theirs.iter().any(|theirs| theirs.abs_diff(ours) > WIDTH * HEIGHT / 1000) {
        let hits = format!("{ours} of single rays, {packets} of packets");
        return Err(format!("hits: {hits}, {theirs:?} of Embree").into());
    }
    Ok(())
}

/// The camera of the benchmark.
struct Camera {
    forward: DVec3,
    right: DVec3,
    up: DVec3,
}

impl Camera {
    fn new() -> Self {
        let forward = -EYE.normalize();
        let right = forward.cross(DVec3::Z).normalize();
        let up = right.cross(forward);
        let half = libm::tan(VIEW_ANGLE * PI / 360.0);
        Self { forward, right: right * half, up: up * (half * HEIGHT as f64 / WIDTH as f64) }
    }

    #[inline(always)]
    fn direction(&self, column: usize, row: usize) -> DVec3 {
        let x = 2.0 * (column as f64 + 0.5) / WIDTH as f64 - 1.0;
        let y = 1.0 - 2.0 * (row as f64 + 0.5) / HEIGHT as f64;
        (self.forward + x * self.right + y * self.up).normalize()
    }
}

/// Calls `tile` with the column and row of each tile, on all threads. Returns the number of hits.
fn trace(bvh: &Bvh, tile: impl Fn(&Bvh, &Camera, usize, usize) -> usize + Sync) -> usize {
    let camera = Camera::new();
    let n_hits = AtomicUsize::new(0);
    rayon::scope(|scope| {
        for row in (0..HEIGHT).step_by(SIDE) {
            let (camera, n_hits, tile) = (&camera, &n_hits, &tile);
            scope.spawn(move |_| {
                let found: usize =
                    (0..WIDTH).step_by(SIDE).map(|column| tile(bvh, camera, column, row)).sum();
                n_hits.fetch_add(found, Ordering::Relaxed);
            });
        }
    });
    n_hits.into_inner()
}

fn trace_single(bvh: &Bvh, camera: &Camera, column: usize, row: usize) -> usize {
    (0..SIDE * SIDE)
        .filter(|idx| {
            let direction = camera.direction(column + idx % SIDE, row + idx / SIDE);
            bvh.closest(&Ray { origin: EYE, direction }, 0.0..f64::INFINITY).is_some()
        })
        .count()
}

fn trace_packet(bvh: &Bvh, camera: &Camera, column: usize, row: usize) -> usize {
    let directions: [DVec3; SIDE * SIDE] =
        std::array::from_fn(|idx| camera.direction(column + idx % SIDE, row + idx / SIDE));
    let mut hits = [None; SIDE * SIDE];
    bvh.closest_packet(EYE, &directions, 0.0..f64::INFINITY, &mut hits);
    hits.iter().flatten().count()
}

/// The program that `embree.cpp` becomes.
const PROGRAM: &str = "embree";

/// A running `embree.cpp` that waits for requests.
struct Embree {
    child: Child,
    requests: ChildStdin,
    answers: BufReader<ChildStdout>,
}

impl Embree {
    fn start(
        positions: &[DVec3],
        triangles: &[[u32; 3]],
        dir: &Path,
        threads: usize,
    ) -> Result<Self, Box<dyn Error>> {
        let (program, mesh) = (dir.join(PROGRAM), dir.join("rays.bin"));
        let mut bytes = Vec::new();
        for count in [positions.len(), triangles.len()] {
            bytes.extend(u32::try_from(count)?.to_le_bytes());
        }
        bytes.extend(positions.iter().flat_map(|at| at.as_vec3().to_array()).flat_map(|x| x.to_le_bytes()));
        bytes.extend(triangles.iter().flatten().flat_map(|row| row.to_le_bytes()));
        std::fs::write(&mesh, bytes)?;
        let mut child = Command::new(program)
            .arg(mesh)
            .args([WIDTH, HEIGHT, threads].map(|number| number.to_string()))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()?;
        let requests = child.stdin.take().ok_or("no standard input")?;
        let answers = BufReader::new(child.stdout.take().ok_or("no standard output")?);
        Ok(Self { child, requests, answers })
    }

    /// Returns the time and the number of hits.
    fn run(&mut self, request: &str) -> Result<(Time, usize), Box<dyn Error>> {
        writeln!(self.requests, "{request}")?;
        self.requests.flush()?;
        let mut line = String::new();
        if self.answers.read_line(&mut line)? == 0 {
            return Err(format!("embree.cpp stopped: {}", self.child.wait()?).into());
        }
        let mut words = line.split_whitespace();
        let mut next = || words.next().ok_or("embree.cpp answered with fewer than three numbers");
        let time = Time { wall: next()?.parse()?, processor: next()?.parse()? };
        Ok((time, next()?.parse()?))
    }
}

/// Compiles `embree.cpp`.
fn compile(compiler: &str, program: &Path) -> Result<(), Box<dyn Error>> {
    const REMEDY: &str = "the benchmark requires a C++ compiler and Embree 3: on Debian 12 and Ubuntu 22.04, \
                          `apt-get install g++ libembree-dev`";
    let output = Command::new(compiler)
        .args(["-O3", "-march=native", "-pthread"])
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("embree.cpp"))
        .arg("-o")
        .arg(program)
        .arg("-lembree3")
        .output()
        .map_err(|error| format!("`{compiler}` could not be run: {error}; {REMEDY}"))?;
    if output.status.success() {
        return Ok(());
    }
    let message = String::from_utf8_lossy(&output.stderr);
    let first = message.lines().find(|line| line.contains("error") || line.contains("cannot find"));
    Err(format!("`{compiler}` could not compile embree.cpp: {}; {REMEDY}", first.unwrap_or("no message"))
        .into())
}

impl Drop for Embree {
    fn drop(&mut self) {
        // The program ends with its input anyway, so a failure to kill it can be ignored.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
