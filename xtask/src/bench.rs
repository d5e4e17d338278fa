//! Running times of the programs, measured by `hyperfine`, as Markdown.
//!
//! Each benchmark is a table of shell commands. Ratios within a table vary less from machine to
//! machine than times, and processor time varies less than elapsed time with what else runs.

use std::error::Error;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use clap::ValueEnum;
use serde_json::Value;
use ugtests::scenes;

use crate::programs;

pub type Outcome<T> = Result<T, Box<dyn Error>>;

/// What is measured, and how often.
#[derive(clap::Args)]
pub struct Args {
    /// Programs or kernel to measure
    #[arg(value_enum, default_value = "pipe")]
    benchmark: Benchmark,
    /// Folder with the programs of another commit, which are measured in turn: `target/release` of
    /// its worktree
    #[arg(long, value_name = "FOLDER")]
    against: Option<PathBuf>,
    /// Triangles of the meshes, roughly
    #[arg(long, value_name = "N", num_args = 1.., default_values_t = [100_000, 1_000_000],
          value_parser = clap::value_parser!(u32).range(36..=10_000_000))]
    triangles: Vec<u32>,
    /// Runs of each command, after one that is not measured
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u32).range(2..))]
    runs: u32,
}

#[derive(Clone, Copy, ValueEnum)]
enum Benchmark {
    /// Every program of the pipe, relative to `cat` of the same file
    Pipe,
    /// Drawing: sizes, samples, culling, exact pictures
    Raster,
    /// Rays against triangles, relative to Embree 3; requires g++ and libembree-dev
    Rays,
    /// The ray tracer: motion and many bodies, relative to rest
    Photon,
    /// Panoramas, relative to the filter v360 of ffmpeg, which must be installed
    Warp,
    /// Films, relative to their pipes run by a shell
    Film,
    /// Bodies that accelerate and spin, relative to inertial ones, by the pipe and by rays
    WorldLines,
}

/// A table: the commands of its rows, whose first one the others are compared with.
struct Section {
    title: String,
    /// Shell commands that make the files.
    setup: Vec<String>,
    /// Name and shell command of each row.
    rows: Vec<(&'static str, String)>,
}

/// Measures and prints the tables.
pub fn write(out: &mut impl Write, args: &Args) -> Outcome<()> {
    let folder = scenes::target_dir().join("bench");
    std::fs::create_dir_all(&folder)?;
    let programs = programs::released();
    let bench = Bench { args, programs: &programs, folder: &folder };
    writeln!(out, "{}", machine())?;
    for Section { title, setup, rows } in args.sections() {
        for command in setup {
            run(Command::new("bash")
                .args(["-c", &bench.with_programs(&programs, &command)])
                .current_dir(&folder))?;
        }
        let other = if args.against.is_some() { " other commit, ms | other / this |" } else { "" };
        writeln!(out, "\n| {title} | time, ms | processor time, ms | relative |{other}")?;
        writeln!(
            out,
            "| --- | ---: | ---: | ---: |{}",
            if other.is_empty() { "" } else { " ---: | ---: |" }
        )?;
        let mut first = None;
        for (name, command) in rows {
            let times = bench.measure(&command)?;
            let [time, processor] = times[0];
            let first = *first.get_or_insert(processor);
            write!(out, "| {name} | {time:.1} | {processor:.1} | {:.2} |", processor / first)?;
            if let Some([_, other]) = times.get(1) {
                write!(out, " {other:.1} | {:.3} |", other / processor)?;
            }
            writeln!(out)?;
            out.flush()?;
        }
    }
    Ok(())
}

struct Bench<'a> {
    args: &'a Args,
    /// The folder of the programs of this commit.
    programs: &'a Path,
    /// Where files are made.
    folder: &'a Path,
}

impl Bench<'_> {
    /// A shell command that finds the programs of a folder first and fails with any part of a pipe.
    fn with_programs(&self, programs: &Path, command: &str) -> String {
        let own = std::env::current_exe().unwrap_or_default();
        let xtask = own.parent().unwrap_or(programs).display();
        format!("set -euo pipefail; PATH='{}:{xtask}':\"$PATH\"; {command}", programs.display())
    }

    /// Median elapsed and mean processor time in milliseconds of a command, with the programs of
    /// this commit and, if there is one, of the other.
    fn measure(&self, command: &str) -> Outcome<Vec<[f64; 2]>> {
        let report = self.folder.join("hyperfine.json");
        let mut hyperfine = Command::new("hyperfine");
        hyperfine.args(["--shell=bash", "--style=none", "--warmup=1", "--runs", &self.args.runs.to_string()]);
        hyperfine.arg("--export-json").arg(&report).current_dir(self.folder).stdout(Stdio::null());
        hyperfine.arg(self.with_programs(self.programs, command));
        if let Some(other) = &self.args.against {
            hyperfine.arg(self.with_programs(&other.canonicalize()?, command));
        }
        run(&mut hyperfine)?;
        let report: Value = serde_json::from_slice(&std::fs::read(report)?)?;
        let results = report["results"].as_array().ok_or("hyperfine reports no results")?;
        let number = |result: &Value, name| result[name].as_f64().ok_or("hyperfine reports no time");
        let times = |result| {
            let processor = number(result, "user")? + number(result, "system")?;
            Ok([1e3 * number(result, "median")?, 1e3 * processor])
        };
        results.iter().map(times).collect()
    }
}

/// Runs a command to its end.
fn run(command: &mut Command) -> Outcome<()> {
    match command.stdin(Stdio::null()).status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{command:?}: {status}").into()),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            Err(format!("{:?} is not installed, which this benchmark requires", command.get_program()).into())
        }
        Err(error) => Err(error.into()),
    }
}

const PICTURE: &str = "-qt -sz 1280 720";

impl Args {
    fn sections(&self) -> Vec<Section> {
        let triangles = self.triangles.iter().copied();
        match self.benchmark {
            Benchmark::Pipe => triangles.map(pipe).collect(),
            Benchmark::Raster => triangles.map(raster).collect(),
            Benchmark::Rays => triangles.flat_map(rays).collect(),
            Benchmark::Photon => triangles.map(photon).collect(),
            Benchmark::Warp => vec![warp()],
            Benchmark::Film => vec![film(1), film(4)],
            Benchmark::WorldLines => triangles.flat_map(world_lines).collect(),
        }
    }
}

fn pipe(triangles: u32) -> Section {
    let moved = "uglorentz -qt -vel .3 0 0";
    let drawn = format!("ugrainbow {PICTURE} -aa 1");
    Section {
        title: format!("the pipe, {triangles} triangles"),
        setup: vec![
            format!("xtask mesh {triangles} > mesh.ug; xtask mesh --each {triangles} > each.ug"),
            format!("{moved} mesh.ug > seen.ug; {moved} each.ug > each-seen.ug"),
            "ugdoppler -qt seen.ug > coloured.ug".into(),
        ],
        rows: vec![
            ("`cat`", "cat mesh.ug".into()),
            ("`ugparse flatten`", "ugparse flatten mesh.ug".into()),
            ("`uglorentz -vel .3 0 0`", format!("{moved} mesh.ug")),
            ("`ugdoppler`", "ugdoppler -qt seen.ug".into()),
            ("`ugdoppler -sp`", "ugdoppler -qt -sp seen.ug".into()),
            ("`ugdoppler`, own colours", "ugdoppler -qt each-seen.ug".into()),
            ("`ugdoppler -sp`, own colours", "ugdoppler -qt -sp each-seen.ug".into()),
            ("`ugrainbow -sz 1280 720 -aa 1`", format!("{drawn} coloured.ug")),
            ("the whole pipe", format!("{moved} mesh.ug | ugdoppler -qt | {drawn}")),
        ],
    }
}

fn raster(triangles: u32) -> Section {
    let drawn = |options: &str| format!("ugrainbow -qt {options} mesh.ug");
    Section {
        title: format!("`ugrainbow`, {triangles} triangles"),
        setup: vec![format!("xtask mesh {triangles} > mesh.ug")],
        rows: vec![
            ("`-sz 16 9 -aa 1`, mostly reading", drawn("-sz 16 9 -aa 1")),
            ("`-sz 1280 720 -aa 1`", drawn("-sz 1280 720 -aa 1")),
            ("`-sz 1280 720 -aa 1 -cb`", drawn("-sz 1280 720 -aa 1 -cb")),
            ("`-sz 1280 720 -aa 4`", drawn("-sz 1280 720 -aa 4")),
            ("`-sz 1280 720 -aa 4 -fl spline`", drawn("-sz 1280 720 -aa 4 -fl spline")),
            ("`-sz 1280 720 -aa 1 -xc`", drawn("-sz 1280 720 -aa 1 -xc")),
            ("`-sz 1920 1080 -aa 1`", drawn("-sz 1920 1080 -aa 1")),
            ("`-sz 8192 8192 -aa 1`", drawn("-sz 8192 8192 -aa 1")),
        ],
    }
}

/// Both programs build the hierarchy, and trace this many pictures.
const TRACED: u32 = 20;

fn rays(triangles: u32) -> impl Iterator<Item = Section> {
    let compile = format!(
        "g++ -O3 -march=native -pthread '{}' -o embree -lembree3",
        Path::new(env!("CARGO_MANIFEST_DIR")).join("embree.cpp").display()
    );
    ["build", "single", "packet"].into_iter().map(move |work| Section {
        title: format!("{work}, {TRACED} times, {triangles} triangles, 2 threads"),
        setup: vec![compile.clone(), format!("xtask trace-rays mesh {triangles} > rays.bin")],
        rows: vec![
            ("Embree", format!("./embree rays.bin {work} {TRACED}")),
            ("`ugbvh`", format!("RAYON_NUM_THREADS=2 xtask trace-rays {work} {triangles} {TRACED}")),
        ],
    })
}

/// The faces of a mesh as the definition `mesh`.
fn definition(triangles: u32) -> String {
    format!("echo 'def mesh;'; xtask mesh {triangles} | grep -v '^l \\|^cam '; echo 'end;'")
}

const CAMERA: &str = "l 0.3; l sun 0.7 -1 -2 1.5; cam -ep 0 -6 1 -vc 0 0 0 -ud 0 0 1 -va 30 18;";

fn photon(triangles: u32) -> Section {
    let scene = |mesh: u32, bodies: &str, file: &str| {
        format!("{{ {}; {bodies}; echo '{CAMERA}'; }} > {file}.ug", definition(mesh))
    };
    // Places and velocities spread evenly by multiples of irrational numbers.
    let many = "awk 'BEGIN { for (i = 0; i < 100; i++) printf \"i (mesh -sa .15 -tx %f -ty %f -tz %f) <%f %f 0>;\\n\", \
                i*.819%1-.5, i*.671%1-.5, i*.550%1-.5, i*.857%1*.8-.4, i*.734%1*.8-.4 }'";
    let drawn = |options: &str| format!("ugphoton {PICTURE} -aa 1 {options}");
    Section {
        title: format!("`ugphoton`, {triangles} triangles"),
        setup: vec![
            scene(triangles, "echo 'i (mesh);'", "rest"),
            scene(triangles, "echo 'i (mesh) <.5 0 0>;'", "moving"),
            scene((triangles / 100).max(36), many, "many"),
        ],
        rows: vec![
            ("a body at rest", drawn("rest.ug")),
            ("a body at 0.5c", drawn("-in moving.ug")),
            ("a body at 0.5c, no shadows", drawn("-in --no-shadows moving.ug")),
            ("100 bodies with velocities of their own", drawn("-in many.ug")),
        ],
    }
}

fn warp() -> Section {
    // A fractal with noise, which has detail at every size.
    let panorama = "[ -e panorama.png ] || ffmpeg -nostdin -v error -f lavfi -i mandelbrot=size=2048x1024:rate=1 \
                    -frames:v 1 -vf scale=8192:4096:flags=bicubic,noise=alls=8 -pix_fmt rgb24 panorama.png";
    let drawn = |options: &str| format!("ugwarp -qt -cv 0 .5 0 -va 90 -sz 1920 1080 {options} panorama.png");
    let v360 = "ffmpeg -nostdin -v error -i panorama.png -vf \
                v360=e:flat:h_fov=90:v_fov=58.715507:w=1920:h=1080:interp=lanczos -frames:v 1 -f null -";
    Section {
        title: "1920 × 1080 of a panorama of 8192 × 4096 pixels".into(),
        setup: vec![panorama.into()],
        rows: vec![
            ("`v360` of ffmpeg, lanczos", v360.into()),
            ("`ugwarp -sz 16 9 -va .5`, mostly reading", "ugwarp -qt -va .5 -sz 16 9 panorama.png".into()),
            ("`ugwarp --no-doppler --no-flux`", drawn("--no-doppler --no-flux")),
            ("`ugwarp -look 1988`, hues", drawn("-look 1988")),
            ("`ugwarp -sp`, spectra", drawn("-sp")),
            ("`ugwarp`, the default look: spectra, exposure", drawn("")),
        ],
    }
}

fn film(samples: u32) -> Section {
    let film = format!("ugfilm -qt --frames 24 -vel 0 0 0..0.9 -in -sz 1280 720 -aa {samples} mesh.ug");
    Section {
        title: format!("24 frames of 1280 × 720, `-aa {samples}`"),
        setup: vec![
            "xtask mesh 100000 > mesh.ug".into(),
            format!("{film} -fo 'pipe_%04d.png' --print > pipes.sh"),
        ],
        rows: vec![
            ("the pipes, one after the other", "sh pipes.sh".into()),
            // Frames that are there would not be drawn again.
            ("`ugfilm`, files of frames", format!("rm -f f_*.png; {film} -fo 'f_%04d.png'")),
            ("`ugfilm`, one file (Y4M)", format!("{film} -dt y4m")),
            ("`ugfilm -look 1988`, one file", format!("{film} -look 1988 -dt y4m")),
        ],
    }
}

fn world_lines(triangles: u32) -> impl Iterator<Item = Section> {
    const MOTIONS: [(&str, &str, &str); 3] = [
        ("inertial", "`-vel .8 0 0`", "-vel .8 0 0"),
        ("accelerated", "`-acc .5 0 0 -9 9`", "-acc .5 0 0 -9 9"),
        ("spinning", "`-spin 0 0 .8`", "-spin 0 0 .8"),
    ];
    // The body is at the origin at time 0, and light takes 6 to the camera.
    let pipe = format!("uglorentz -qt -an 0 0 0 -ti 6 FILE | ugdoppler -qt | ugrainbow {PICTURE} -aa 1");
    let rays = format!("ugphoton {PICTURE} -an 0 0 0 -ti 6 --no-shadows -aa 1 FILE");
    let mesh = definition(triangles);
    let setup = MOTIONS.map(|(file, _, motion)| {
        format!("{{ echo 'motion m {motion};'; {mesh}; echo 'i (mesh) <m>; {CAMERA}'; }} > {file}.ug")
    });
    [("by the pipe", pipe), ("by rays", rays)].into_iter().map(move |(title, command)| Section {
        title: format!("{title}, {triangles} triangles"),
        setup: setup.clone().into(),
        rows: MOTIONS.map(|(file, name, _)| (name, command.replace("FILE", &format!("{file}.ug")))).into(),
    })
}

/// Describes processor, number of threads and compiler, as far as they are known.
fn machine() -> String {
    let cpuinfo = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model =
        cpuinfo.lines().find_map(|line| line.strip_prefix("model name")).unwrap_or("unknown processor");
    let threads = std::thread::available_parallelism().map_or(0, |n| n.get());
    let rustc = Command::new("rustc").arg("--version").output();
    let rustc =
        rustc.map_or_else(|_| "rustc".into(), |out| String::from_utf8_lossy(&out.stdout).trim().to_string());
    format!("{}, {threads} threads, {rustc}", model.trim_start_matches([' ', '\t', ':']))
}
