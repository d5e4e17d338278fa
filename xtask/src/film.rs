//! Measures `ugfilm` relative to the pipes that it prints, run one after the other by a shell.

use std::error::Error;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use rayon::ThreadPoolBuilder;
use ugparse::{Options, Source, parse};
use ugpipe::{ToolArgs, parse_words};
use ugscene::Scene;

use crate::bench::{build, machine, path_with_programs, stderr_of, target_dir};
use crate::mesh;
use crate::photon::time;
use crate::rays::median;
use crate::reading::peak_in;

/// Runs that are compared.
const ROUNDS: usize = 3;

const TRIANGLES: u32 = 100_000;

const OPTIONS: &str = "-qt -vel 0 0 0..0.9 -in -sz 1280 720";

/// Samples along a side of a pixel: one, and the default.
const SAMPLES: [u32; 2] = [1, 4];

/// Frames of which the time in each stage is measured, at speeds from 0 to 0.9.
const STAGED: u32 = 20;

const STAGES: [&str; 6] = [
    "copying the scene",
    "moving and cutting (`uglorentz`)",
    "colouring (`ugdoppler`)",
    "drawing (`ugrainbow`)",
    "compression (PNG)",
    "writing the file",
];

/// Benchmarks films of `n_frames` frames.
pub fn write(out: &mut impl Write, n_frames: u32) -> Result<(), Box<dyn Error>> {
    build(&["ugfilm", "uglorentz", "ugdoppler", "ugrainbow"])?;
    let dir = target_dir().join("bench").join("film");
    std::fs::create_dir_all(&dir)?;
    let mut file = BufWriter::new(File::create(dir.join("mesh.ug"))?);
    mesh::write(&mut file, TRIANGLES, false)?;
    file.flush()?;
    drop(file);
    writeln!(out, "{}\n", machine())?;
    for samples in SAMPLES {
        speed(out, &dir, n_frames, samples)?;
    }
    memory(out, &dir)?;
    shares(out, &dir)
}

/// The command for a film.
fn film(n_frames: u32, samples: u32, output: &str) -> String {
    format!("ugfilm --frames {n_frames} {OPTIONS} -aa {samples} mesh.ug {output}")
}

fn shell(dir: &Path, command: &str) -> Result<Command, Box<dyn Error>> {
    let mut shell = Command::new("sh");
    shell.args(["-c", command]).current_dir(dir).env("PATH", path_with_programs()?);
    shell.stdin(Stdio::null()).stderr(Stdio::null());
    Ok(shell)
}

fn speed(out: &mut impl Write, dir: &Path, n_frames: u32, samples: u32) -> Result<(), Box<dyn Error>> {
    let folder = dir.display();
    let print = film(n_frames, samples, "-fo 'pipe_%04d.png' --print > pipes.sh");
    stderr_of(&format!("cd '{folder}'; rm -f f_*.png pipe_*.png; {print}"))?;
    let rows = [
        ("the pipes, one after the other", "sh pipes.sh".to_owned()),
        ("`ugfilm`, files of frames", film(n_frames, samples, "-fo 'f_%04d.png'")),
        ("`ugfilm`, one file (Y4M)", film(n_frames, samples, "-dt y4m > /dev/null")),
    ];
    let mut rounds: Vec<Vec<[f64; 2]>> = Vec::new();
    for _ in 0..ROUNDS {
        // Frames that are there would not be drawn again.
        stderr_of(&format!("cd '{folder}'; rm -f f_*.png pipe_*.png"))?;
        let times = rows.iter().map(|(_, command)| time(&mut shell(dir, command)?));
        rounds.push(times.collect::<Result<_, _>>()?);
    }
    for number in 1..=n_frames {
        let [frame, piped] =
            ["f", "pipe"].map(|name| std::fs::read(dir.join(format!("{name}_{number:04}.png"))));
        if frame? != piped? {
            return Err(format!("frame {number} is another file than that of its pipe").into());
        }
    }
    writeln!(
        out,
        "| {n_frames} frames of 1280 x 720 pixels, `-aa {samples}` | frames a second | relative to the pipes \
         | processor time of a frame |\n| --- | ---: | ---: | ---: |"
    )?;
    let frames = f64::from(n_frames);
    for (row, (name, _)) in rows.iter().enumerate() {
        let rate = frames / median(rounds.iter().map(|round| round[row][0]));
        let ratio = median(rounds.iter().map(|round| round[0][0] / round[row][0]));
        let processor = median(rounds.iter().map(|round| round[row][1])) / frames * 1e3;
        writeln!(out, "| {name} | {rate:.2} | {ratio:.2} | {processor:.0} ms |")?;
    }
    Ok(writeln!(out)?)
}

/// Peak memory of films of different lengths.
fn memory(out: &mut impl Write, dir: &Path) -> Result<(), Box<dyn Error>> {
    writeln!(out, "| frames | peak memory of `ugfilm` |\n| ---: | ---: |")?;
    for n_frames in [5, 20, 80] {
        // The shell is replaced, so that the process is that of the program.
        let command = format!("rm -f m_*.png; exec {}", film(n_frames, 4, "-fo 'm_%04d.png'"));
        writeln!(out, "| {n_frames} | {:.0} MB |", peak_of(&mut shell(dir, &command)?)? / 1e6)?;
    }
    Ok(writeln!(out)?)
}

/// Peak memory of a command in bytes, looked up while it runs.
fn peak_of(command: &mut Command) -> Result<f64, Box<dyn Error>> {
    let mut child = command.spawn()?;
    let status = format!("/proc/{}/status", child.id());
    let mut peak = 0;
    let ended = loop {
        if let Some(ended) = child.try_wait()? {
            break ended;
        }
        // A process that has just ended has none.
        peak = std::fs::read_to_string(&status).ok().and_then(|text| peak_in(&text)).unwrap_or(0).max(peak);
        sleep(Duration::from_millis(2));
    };
    if ended.success() { Ok(peak as f64) } else { Err(format!("the film failed: {ended}").into()) }
}

/// The share of time in each stage, on one thread: the functions that `ugfilm` calls for a frame.
fn shares(out: &mut impl Write, dir: &Path) -> Result<(), Box<dyn Error>> {
    let source = Source::new("mesh.ug", std::fs::read(dir.join("mesh.ug"))?);
    let scene = parse(&source, &Options::default())?.scene;
    let pool = ThreadPoolBuilder::new().num_threads(1).build()?;
    let file = dir.join("staged.png");
    let sum = |samples: u32| -> Result<[f64; STAGES.len()], Box<dyn Error + Send + Sync>> {
        let mut times = [0.0; STAGES.len()];
        for row in 0..STAGED {
            let speed = 0.9 * f64::from(row) / f64::from(STAGED - 1);
            let stages = stages(&scene, speed, samples, &file)?;
            times.iter_mut().zip(stages).for_each(|(sum, time)| *sum += time);
        }
        Ok(times)
    };
    let [one, many] = SAMPLES.map(|samples| pool.install(|| sum(samples)).map_err(|error| error.to_string()));
    let (one, many) = (one?, many?);
    writeln!(
        out,
        "| stage of a frame, on one thread | `-aa {}` | share | `-aa {}` | share |\n\
         | --- | ---: | ---: | ---: | ---: |",
        SAMPLES[0], SAMPLES[1]
    )?;
    let cells = |times: &[f64], row: usize| {
        let share = 100.0 * times[row] / times.iter().sum::<f64>();
        format!("{:.1} ms | {share:.0} %", times[row] / f64::from(STAGED) * 1e3)
    };
    for (row, name) in STAGES.iter().enumerate() {
        writeln!(out, "| {name} | {} | {} |", cells(&one, row), cells(&many, row))?;
    }
    writeln!(out)?;
    Ok(out.flush()?)
}

/// Seconds in each stage of one frame.
fn stages(
    scene: &Scene,
    speed: f64,
    samples: u32,
    file: &Path,
) -> Result<[f64; STAGES.len()], Box<dyn Error + Send + Sync>> {
    let mut ends = vec![Instant::now()];
    let mut end = || ends.push(Instant::now());
    let moving = parsed::<uglorentz::Args>(&format!("uglorentz -vel 0 0 {speed} -in"))?.config();
    let coloring = parsed::<ugdoppler::Args>("ugdoppler")?.config();
    let drawing = parsed::<ugrainbow::Args>(&format!("ugrainbow -sz 1280 720 -aa {samples}"))?.config(None);
    let copy = scene.clone();
    end();
    let (seen, _) = uglorentz::apply(copy, &moving.map_err(text)?)?;
    end();
    let (colored, _) = ugdoppler::apply(seen, &coloring.map_err(text)?)?;
    end();
    let rendering = ugrainbow::render(&colored, &drawing.map_err(text)?)?;
    end();
    let bytes = rendering.into_file();
    end();
    std::fs::write(file, bytes)?;
    end();
    drop(colored);
    let mut times = [0.0; STAGES.len()];
    for (time, ends) in times.iter_mut().zip(ends.windows(2)) {
        *time = (ends[1] - ends[0]).as_secs_f64();
    }
    Ok(times)
}

fn parsed<A: ToolArgs>(line: &str) -> Result<A, String> {
    parse_words::<A>(line.split_whitespace().map(Into::into)).map_err(text)
}

fn text(error: impl std::fmt::Display) -> String {
    error.to_string()
}
