//! Measures `ugphoton`: bodies in motion relative to bodies at rest, whole pictures relative to
//! POV-Ray, and time and memory as functions of the number of faces and of bodies, as Markdown and
//! as a plot.
//!
//! Every run is a process of its own. Runs to be compared alternate, and medians of ratios count;
//! the processor time of all threads hardly depends on what else the machine does.

use std::error::Error;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::time::Instant;

use glam::DVec3;
use ugparse::Source;
use ugphoton::{CameraOptions, Config, PictureOptions};
use ugpipe::Progress;

use crate::bench::{build, machine, program, target_dir};
use crate::mesh;
use crate::plot::{Growth, Series, logarithmic};
use crate::rays::{median, processor_time};

/// Runs that are compared.
const ROUNDS: usize = 9;

/// Runs of each row of the last two tables; the median counts.
const FEW_ROUNDS: usize = 3;

const TRIANGLES: u32 = 100_000;

/// Numbers of triangles and of bodies in the last two tables.
const FACES: [u32; 5] = [1000, 10_000, 100_000, 1_000_000, 10_000_000];
const BODIES: [u32; 4] = [1, 10, 100, 1000];

const SIZE: [u32; 2] = [1280, 720];
const EYE: DVec3 = DVec3::new(0.0, -3.2, 0.6);

/// Half the horizontal view angle, degrees.
const HALF_ANGLE: f64 = 26.0;

/// The speed of the moving body, and the greatest of many.
const BETA: f64 = 0.5;

/// Benchmarks `ugphoton`. `povray`: executable. `most`: triangles of the greatest mesh.
pub fn write(out: &mut impl Write, plot: &Path, povray: &str, most: u32) -> Result<(), Box<dyn Error>> {
    build(&["ugphoton"])?;
    let dir = target_dir().join("bench");
    std::fs::create_dir_all(&dir)?;
    writeln!(out, "{}\n", machine())?;
    compare_motion(out, &dir)?;
    compare_povray(out, &dir, povray)?;
    let faces =
        FACES.into_iter().filter(|&n| n <= most).map(|n| (n, Bodies { n: 1, triangles: n, beta: 0.0 }));
    let faces = table(out, &dir, "triangles", faces)?;
    let bodies = BODIES.map(|n| (n, Bodies { n, triangles: TRIANGLES / n, beta: BETA }));
    let bodies = table(out, &dir, "bodies of different velocities, 100 000 triangles in all", bodies)?;
    let panel = |title, unit, rows: &[(u32, Cost)]| {
        let of = |number: &dyn Fn(&Cost) -> f64| {
            rows.iter().map(|(n, cost)| [f64::from(*n), number(cost)]).collect()
        };
        let tracing = Series { name: "seconds of tracing", points: of(&|cost| cost.tracing) };
        let memory = Series { name: "GB of memory", points: of(&|cost| cost.megabytes / 1e3) };
        Growth { title, unit, series: [tracing, memory] }
    };
    let panels =
        [panel("1 body at rest", "triangles", &faces), panel("100 000 triangles", "bodies", &bodies)];
    Ok(std::fs::write(plot, logarithmic(&panels).svg()?)?)
}

/// Bumpy spheres in the unit ball, as seen from the eye.
#[derive(Clone, Copy)]
struct Bodies {
    n: u32,
    /// Triangles of each, roughly.
    triangles: u32,
    /// Their greatest speed.
    beta: f64,
}

impl Bodies {
    /// Writes the scene to a file, if it is not there yet: the bodies, a lamp, and the camera.
    fn file(&self, dir: &Path) -> Result<PathBuf, Box<dyn Error>> {
        let path = dir.join(format!("photon-{}-{}-{}.ug", self.n, self.triangles, self.beta));
        if path.exists() {
            return Ok(path);
        }
        let mut text = BufWriter::new(std::fs::File::create(&path)?);
        let (positions, triangles) = mesh::triangles(self.triangles);
        let radius = 0.9 / libm::cbrt(f64::from(self.n));
        for body in 0..self.n {
            let (place, velocity) = self.motion(body, radius);
            for (row, &position) in positions.iter().enumerate() {
                let DVec3 { x, y, z } = place + radius * position;
                writeln!(text, "v b{body}v{row} {x:.6} {y:.6} {z:.6};")?;
            }
            let motion = match velocity {
                DVec3::ZERO => String::new(),
                DVec3 { x, y, z } => format!("<{x:.6} {y:.6} {z:.6}>"),
            };
            for [a, b, c] in &triangles {
                writeln!(text, "f (b{body}v{a} b{body}v{b} b{body}v{c}) {motion};")?;
            }
        }
        let DVec3 { x, y, z } = EYE;
        writeln!(text, "l 0.2; l lamp 0.8 5 -8 6 0; cam -ep {x} {y} {z} -vc 0 0 0 -ud 0 0 1 -ps;")?;
        text.flush()?;
        Ok(path)
    }

    /// Where a body is at the moment of the picture, and its velocity. It is seen where it was
    /// when light left for the eye: spread evenly in the ball, a single one in the middle.
    fn motion(&self, body: u32, radius: f64) -> (DVec3, DVec3) {
        if self.n == 1 {
            let velocity = DVec3::X * self.beta;
            return (velocity * EYE.length(), velocity);
        }
        // Multiples of powers of the solutions of x⁴ = x + 1 and x⁵ = x + 1 fill a cube evenly.
        let point = |ratios: [f64; 3]| {
            DVec3::from_array(ratios.map(|ratio| 2.0 * (0.5 + ratio * f64::from(body)).fract() - 1.0))
        };
        let place = point([0.819_172_513, 0.671_043_606, 0.549_700_478]) * (1.0 - radius);
        let velocity = point([0.856_674_884, 0.733_891_857, 0.628_706_721]) * (self.beta / 3_f64.sqrt());
        (place + velocity * (place - EYE).length(), velocity)
    }
}

/// The cost of a picture.
#[derive(Clone, Copy)]
struct Cost {
    /// From text to PNG.
    seconds: f64,
    /// Processor time of tracing and shading rays.
    tracing: f64,
    /// Peak memory of the process.
    megabytes: f64,
}

impl Cost {
    fn measure(scene: &Path) -> Result<Self, Box<dyn Error>> {
        let output = Command::new(std::env::current_exe()?).arg("trace-once").arg(scene).output()?;
        if !output.status.success() {
            return Err(String::from_utf8_lossy(&output.stderr).into());
        }
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let numbers = text.split_whitespace().map(str::parse).collect::<Result<Vec<f64>, _>>()?;
        let &[seconds, tracing, megabytes] = &numbers[..] else { return Err("no three numbers".into()) };
        Ok(Self { seconds, tracing, megabytes })
    }

    fn median(costs: &[Self]) -> Self {
        let of = |number: &dyn Fn(&Self) -> f64| median(costs.iter().map(number));
        Self {
            seconds: of(&|cost| cost.seconds),
            tracing: of(&|cost| cost.tracing),
            megabytes: of(&|cost| cost.megabytes),
        }
    }
}

fn compare_motion(out: &mut impl Write, dir: &Path) -> Result<(), Box<dyn Error>> {
    let scenes = [0.0, BETA].map(|beta| Bodies { n: 1, triangles: TRIANGLES, beta }.file(dir));
    let [at_rest, moving] = scenes;
    let (at_rest, moving) = (at_rest?, moving?);
    let mut rounds = Vec::new();
    for _ in 0..ROUNDS {
        rounds.push([Cost::measure(&at_rest)?, Cost::measure(&moving)?]);
    }
    let of = |body: usize| median(rounds.iter().map(|round| round[body].tracing)) * 1e3;
    let ratio = median(rounds.iter().map(|[at_rest, moving]| moving.tracing / at_rest.tracing));
    writeln!(
        out,
        "| processor time of tracing, body at rest | body at {BETA} c | ratio |\n| ---: | ---: | ---: |\n\
         | {:.0} ms | {:.0} ms | {ratio:.2} |\n",
        of(0),
        of(1)
    )?;
    Ok(out.flush()?)
}

fn compare_povray(out: &mut impl Write, dir: &Path, povray: &str) -> Result<(), Box<dyn Error>> {
    let ours = Bodies { n: 1, triangles: TRIANGLES, beta: 0.0 }.file(dir)?;
    let theirs = dir.join("photon.pov");
    write_povray(&mut BufWriter::new(std::fs::File::create(&theirs)?))?;
    let [width, height] = SIZE.map(|side| side.to_string());
    let mut rounds = Vec::new();
    for _ in 0..ROUNDS {
        let mut tracer = Command::new(program("ugphoton"));
        tracer.args(["-qt", "-aa", "1", "-va", "52", "-sz", &width, &height]).arg(&ours);
        tracer.stdout(std::fs::File::create(dir.join("photon.png"))?);
        let mut peer = Command::new(povray);
        peer.arg(format!("+I{}", theirs.display())).arg(format!("+O{}", dir.join("povray.png").display()));
        peer.args([format!("+W{width}"), format!("+H{height}"), "-A".into(), "-D".into()]);
        peer.stderr(std::process::Stdio::null()).stdout(std::process::Stdio::null());
        rounds.push([time(&mut tracer)?, time(&mut peer)?]);
    }
    writeln!(
        out,
        "| whole picture with shadows | `ugphoton` | POV-Ray | ratio |\n| --- | ---: | ---: | ---: |"
    )?;
    for (name, kind) in [("time", 0), ("processor time", 1)] {
        let [ours, theirs] =
            [0, 1].map(|program| median(rounds.iter().map(|round| round[program][kind])) * 1e3);
        let ratio = median(rounds.iter().map(|[ours, theirs]| theirs[kind] / ours[kind]));
        writeln!(out, "| {name} | {ours:.0} ms | {theirs:.0} ms | {ratio:.1} |")?;
    }
    writeln!(out)?;
    Ok(out.flush()?)
}

/// Runs a command. Returns its time and its processor time in seconds.
pub fn time(command: &mut Command) -> Result<[f64; 2], Box<dyn Error>> {
    let name = command.get_program().to_string_lossy().into_owned();
    let (start, processor_start) = (Instant::now(), processor_time_of_children()?);
    let status = command.status().map_err(|error| format!("`{name}` could not be run: {error}"))?;
    if !status.success() {
        return Err(format!("`{name}` failed: {status}").into());
    }
    Ok([start.elapsed().as_secs_f64(), processor_time_of_children()? - processor_start])
}

/// Processor time of all ended children, seconds, in steps of a hundredth.
fn processor_time_of_children() -> Result<f64, Box<dyn Error>> {
    let text = std::fs::read_to_string("/proc/self/stat")?;
    // The name of the program, in parentheses, may contain spaces.
    let numbers = text.rsplit(')').next().unwrap_or_default();
    let ticks = |word| numbers.split_whitespace().nth(word).unwrap_or("0").parse::<f64>();
    Ok((ticks(13)? + ticks(14)?) / 100.0)
}

/// The mesh, the lamp and the camera for POV-Ray, whose axes are left-handed.
fn write_povray(out: &mut impl Write) -> std::io::Result<()> {
    let (positions, triangles) = mesh::triangles(TRIANGLES);
    writeln!(
        out,
        "#version 3.7; global_settings {{ assumed_gamma 1 }}\n\
         camera {{ location <{}, {}, {}> right -x * {} / {} sky z angle {} look_at 0 }}\n\
         light_source {{ <5, -8, 6> rgb 1 }}",
        EYE.x,
        EYE.y,
        EYE.z,
        SIZE[0],
        SIZE[1],
        2.0 * HALF_ANGLE
    )?;
    write!(out, "mesh2 {{ vertex_vectors {{ {}", positions.len())?;
    for position in &positions {
        let DVec3 { x, y, z } = 0.9 * *position;
        write!(out, ",\n<{x:.6},{y:.6},{z:.6}>")?;
    }
    write!(out, "\n}} face_indices {{ {}", triangles.len())?;
    for [a, b, c] in &triangles {
        write!(out, ",\n<{a},{b},{c}>")?;
    }
    writeln!(out, "\n}} pigment {{ rgb 1 }} finish {{ ambient .2 diffuse .8 }} }}")
}

fn table(
    out: &mut impl Write,
    dir: &Path,
    what: &str,
    rows: impl IntoIterator<Item = (u32, Bodies)>,
) -> Result<Vec<(u32, Cost)>, Box<dyn Error>> {
    writeln!(
        out,
        "| {what} | from text to PNG | processor time of tracing | peak memory |\n| ---: | ---: | ---: | ---: |"
    )?;
    let mut costs = Vec::new();
    for (n, bodies) in rows {
        let scene = bodies.file(dir)?;
        let runs = (0..FEW_ROUNDS).map(|_| Cost::measure(&scene)).collect::<Result<Vec<_>, _>>()?;
        let cost = Cost::median(&runs);
        let Cost { seconds, tracing, megabytes } = cost;
        writeln!(out, "| {n} | {seconds:.2} s | {tracing:.2} s | {megabytes:.0} MB |")?;
        out.flush()?;
        costs.push((n, cost));
    }
    writeln!(out)?;
    Ok(costs)
}

/// Processor time at the beginning of each step.
#[derive(Default)]
struct Steps(Mutex<Vec<(&'static str, f64)>>);

impl Progress for Steps {
    fn step(&self, name: &'static str, _parts: u64) {
        if let (Ok(mut steps), Ok(time)) = (self.0.lock(), processor_time()) {
            steps.push((name, time));
        }
    }

    fn done(&self, _parts: u64) {}
}

/// Draws a scene and prints the time in seconds, the processor time of tracing, and the peak memory
/// of this process in megabytes.
pub fn trace_once(out: &mut impl Write, scene: &Path) -> Result<(), Box<dyn Error>> {
    let start = Instant::now();
    let source = Source::new("mesh", std::fs::read(scene)?);
    let camera = CameraOptions { view_angle: Some((2.0 * HALF_ANGLE, None)), ..CameraOptions::default() };
    let picture = PictureOptions { size: SIZE, samples: 1, camera, ..PictureOptions::default() };
    let steps = Steps::default();
    std::hint::black_box(ugphoton::run(
        &Config { picture, ..Config::default() },
        &source,
        ugphoton::PROVENANCE,
        &steps,
    )?);
    let seconds = start.elapsed().as_secs_f64();
    let steps = steps.0.into_inner()?;
    let tracing = steps.iter().position(|(name, _)| *name == "tracing rays").ok_or("no step of tracing")?;
    let next = steps.get(tracing + 1).ok_or("no step after tracing")?;
    let tracing = next.1 - steps[tracing].1;
    Ok(writeln!(out, "{seconds} {tracing} {}", crate::reading::peak_memory()? as f64 / 1e6)?)
}
