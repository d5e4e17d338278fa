//! Measures the running time of every program, relative to `cat` of the same file, as Markdown.
//!
//! Absolute times depend on the machine and its load. The ratio to `cat`, which reads the file and
//! discards it, varies less.

use std::error::Error;
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::mesh;

/// Runs of each command; the fastest and the median are shown.
const RUNS: usize = 7;

/// Benchmarks meshes of about these numbers of triangles and prints a table for each.
pub fn write(out: &mut impl Write, sizes: &[u32]) -> Result<(), Box<dyn Error>> {
    build(&[])?;
    let dir = target_dir().join("bench");
    std::fs::create_dir_all(&dir)?;
    writeln!(out, "{}\n", machine())?;
    for &triangles in sizes {
        let bench = Bench { dir: &dir, triangles };
        bench.prepare()?;
        writeln!(out, "### {triangles} triangles, {:.1} MB of text\n", bench.megabytes("mesh")?)?;
        writeln!(out, "| task | fastest time | median time | time / `cat` | input, MB/s |")?;
        writeln!(out, "| --- | ---: | ---: | ---: | ---: |")?;
        let mut baseline = None;
        for row in bench.rows() {
            let times = match &row.work {
                Work::Shell(command) => time(RUNS, || bench.run(command))?,
                Work::InProcess(work) => time(RUNS, work)?,
            };
            let megabytes = bench.megabytes(row.input)?;
            // The first row is `cat`.
            let baseline = *baseline.get_or_insert(times.fastest);
            writeln!(
                out,
                "| {} | {:.1} ms | {:.1} ms | {:.1} | {:.0} |",
                row.name,
                ms(times.fastest),
                ms(times.median),
                ms(times.fastest) / ms(baseline),
                megabytes / times.fastest.as_secs_f64(),
            )?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// One size of mesh, and the files made from it.
struct Bench<'a> {
    dir: &'a Path,
    triangles: u32,
}

struct Row {
    name: &'static str,
    /// The file that is read: the stage of [`Bench::file`].
    input: &'static str,
    work: Work,
}

enum Work {
    /// A process, or a pipe of several.
    Shell(String),
    /// A library call on data in memory.
    InProcess(Kernel),
}

impl Bench<'_> {
    fn file(&self, stage: &str) -> String {
        self.dir.join(format!("{stage}-{}.ug", self.triangles)).display().to_string()
    }

    fn megabytes(&self, stage: &str) -> io::Result<f64> {
        Ok(std::fs::metadata(self.file(stage))?.len() as f64 / 1e6)
    }

    /// Writes the mesh, and the output of each program for the next one.
    fn prepare(&self) -> Result<(), Box<dyn Error>> {
        let mut file = io::BufWriter::new(File::create(self.file("mesh"))?);
        mesh::write(&mut file, self.triangles, false)?;
        file.flush()?;
        drop(file);
        let mut file = io::BufWriter::new(File::create(self.file("each"))?);
        mesh::write(&mut file, self.triangles, true)?;
        file.flush()?;
        drop(file);
        self.run(&format!("{LORENTZ} {} > {}", self.file("each"), self.file("each-seen")))?;
        self.run(&format!("{LORENTZ} {} > {}", self.file("mesh"), self.file("seen")))?;
        self.run(&format!("{DOPPLER} {} > {}", self.file("seen"), self.file("coloured")))
    }

    /// Runs a shell command with the programs on its path.
    fn run(&self, command: &str) -> Result<(), Box<dyn Error>> {
        let status = Command::new("bash")
            .args(["-c", &format!("set -euo pipefail; {command}")])
            .env("PATH", path_with_programs()?)
            .stdin(Stdio::null())
            .status()?;
        if status.success() { Ok(()) } else { Err(format!("`{command}` failed: {status}").into()) }
    }

    fn rows(&self) -> Vec<Row> {
        let (mesh, seen, coloured) = (self.file("mesh"), self.file("seen"), self.file("coloured"));
        let each = self.file("each-seen");
        let shell = |name, input, command: String| Row { name, input, work: Work::Shell(command) };
        let in_process = |name, input, kernel| Row { name, input, work: Work::InProcess(kernel) };
        vec![
            shell("`cat`", "mesh", format!("cat {mesh} > /dev/null")),
            in_process("reading (library)", "mesh", read(&mesh)),
            in_process("writing (library)", "mesh", write_back(&mesh)),
            in_process("drawing (library), 1280×720, 1 sample", "coloured", draw(&coloured)),
            shell("`ugparse flatten`", "mesh", format!("ugparse flatten {mesh} > /dev/null")),
            shell("`uglorentz -vel .3 0 0`", "mesh", format!("{LORENTZ} {mesh} > /dev/null")),
            shell("`ugdoppler`", "seen", format!("{DOPPLER} {seen} > /dev/null")),
            shell("`ugdoppler -sp`", "seen", format!("{DOPPLER} -sp {seen} > /dev/null")),
            shell("`ugdoppler`, own colours", "each-seen", format!("{DOPPLER} {each} > /dev/null")),
            shell("`ugdoppler -sp`, own colours", "each-seen", format!("{DOPPLER} -sp {each} > /dev/null")),
            shell("`ugrainbow -sz 1280 720 -aa 1`", "coloured", format!("{RAINBOW} {coloured} > /dev/null")),
            shell("the whole pipe", "mesh", format!("{LORENTZ} {mesh} | {DOPPLER} | {RAINBOW} > /dev/null")),
        ]
    }
}

const LORENTZ: &str = "uglorentz -qt -vel .3 0 0";
const DOPPLER: &str = "ugdoppler -qt";
const RAINBOW: &str = "ugrainbow -qt -sz 1280 720 -aa 1";

type Kernel = Box<dyn Fn() -> Result<(), Box<dyn Error>>>;

fn source(file: &str) -> Result<ugparse::Source, Box<dyn Error>> {
    Ok(ugparse::Source::new(file, std::fs::read(file)?))
}

fn read(file: &str) -> Kernel {
    let source = source(file).map_err(|error| error.to_string());
    Box::new(move || {
        let parsed = ugparse::parse(source.as_ref().map_err(Clone::clone)?, &ugparse::Options::default())?;
        std::hint::black_box(parsed);
        Ok(())
    })
}

fn write_back(file: &str) -> Kernel {
    let scene = scene(file).map_err(|error| error.to_string());
    Box::new(move || {
        std::hint::black_box(ugparse::write(scene.as_ref().map_err(Clone::clone)?));
        Ok(())
    })
}

fn draw(file: &str) -> Kernel {
    let scene = scene(file).map_err(|error| error.to_string());
    let config = ugrainbow::Config {
        picture: ugrainbow::PictureOptions {
            size: [1280, 720],
            samples: 1,
            ..ugrainbow::PictureOptions::default()
        },
        ..ugrainbow::Config::default()
    };
    Box::new(move || {
        std::hint::black_box(ugrainbow::render(scene.as_ref().map_err(Clone::clone)?, &config)?);
        Ok(())
    })
}

fn scene(file: &str) -> Result<ugscene::Scene, Box<dyn Error>> {
    Ok(ugparse::parse(&source(file)?, &ugparse::Options::default())?.scene)
}

struct Times {
    fastest: Duration,
    median: Duration,
}

/// Measures `work`, after one warm-up run.
fn time(runs: usize, work: impl Fn() -> Result<(), Box<dyn Error>>) -> Result<Times, Box<dyn Error>> {
    work()?;
    let mut times = Vec::with_capacity(runs);
    for _ in 0..runs {
        let start = Instant::now();
        work()?;
        times.push(start.elapsed());
    }
    times.sort();
    Ok(Times { fastest: times[0], median: times[runs / 2] })
}

fn ms(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

/// Builds the named programs, or all if none is named.
pub fn build(programs: &[&str]) -> Result<(), Box<dyn Error>> {
    let packages = programs.iter().flat_map(|program| ["--package", program]);
    let status =
        Command::new(env!("CARGO")).args(["build", "--quiet", "--release"]).args(packages).status()?;
    if status.success() { Ok(()) } else { Err("the programs do not build".into()) }
}

/// Cargo's target folder, in which this program was built.
pub fn target_dir() -> PathBuf {
    let exe = std::env::current_exe().unwrap_or_default();
    exe.ancestors().nth(2).map_or_else(|| PathBuf::from("target"), Path::to_path_buf)
}

/// The path of a program of the project.
pub fn program(name: &str) -> PathBuf {
    target_dir().join("release").join(name)
}

/// Runs a shell command with the programs on its path and returns its standard error.
pub fn stderr_of(command: &str) -> Result<String, Box<dyn Error>> {
    let output = Command::new("bash")
        .args(["-c", &format!("set -euo pipefail; {command}")])
        .env("PATH", path_with_programs()?)
        .stdin(Stdio::null())
        .output()?;
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    if output.status.success() { Ok(stderr) } else { Err(format!("`{command}` failed: {stderr}").into()) }
}

/// The search path, with the programs first.
pub fn path_with_programs() -> Result<std::ffi::OsString, Box<dyn Error>> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let programs = target_dir().join("release");
    Ok(std::env::join_paths(std::iter::once(programs).chain(std::env::split_paths(&path)))?)
}

/// Describes processor, number of threads and compiler, as far as they are known.
pub fn machine() -> String {
    let cpuinfo = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model =
        cpuinfo.lines().find_map(|line| line.strip_prefix("model name")).unwrap_or("unknown processor");
    let threads = std::thread::available_parallelism().map_or(0, |n| n.get());
    let rustc = Command::new("rustc").arg("--version").output();
    let rustc =
        rustc.map_or_else(|_| "rustc".into(), |out| String::from_utf8_lossy(&out.stdout).trim().to_string());
    format!("{}, {threads} threads, {rustc}", model.trim_start_matches([' ', '\t', ':']))
}

/// Times of a command in seconds.
#[derive(Clone, Copy)]
pub struct CommandTimes {
    /// Processor time in user mode, summed over threads.
    pub user: f64,
    /// Wall-clock time.
    pub wall: f64,
}

impl std::fmt::Display for CommandTimes {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:.3} ({:.3})", self.user, self.wall)
    }
}

impl CommandTimes {
    /// The least of both times.
    pub fn least(self, other: Self) -> Self {
        Self { user: self.user.min(other.user), wall: self.wall.min(other.wall) }
    }

    /// Longer than any.
    pub const MOST: Self = Self { user: f64::INFINITY, wall: f64::INFINITY };

    /// Those of a shell command, with the programs on its path.
    pub fn of(command: &str) -> Result<Self, Box<dyn Error>> {
        let times =
            stderr_of(&format!("TIMEFORMAT='%U %R'; time {{ {command} > /dev/null 2> /dev/null; }}"))?;
        let mut numbers = times.split_whitespace().map(str::parse::<f64>);
        match (numbers.next(), numbers.next()) {
            (Some(Ok(user)), Some(Ok(wall))) => Ok(Self { user, wall }),
            _ => Err(format!("`time` printed `{times}`").into()),
        }
    }
}
