//! The same input gives the same bytes with any number of threads, on every run, and in every build
//! profile.

#[allow(dead_code, reason = "its `main` is that of the example")]
#[path = "../crates/ugrainbow/examples/in_memory.rs"]
mod in_memory;

use std::path::Path;
use std::process::Command;

use glam::DVec3;
use ugtests::picture::decode;
use ugtests::pipe::{Pipe, Stages};
use ugtests::{programs, scenes, tools};

/// Pipes that use different code paths of the programs.
fn pipes() -> Vec<(&'static str, Pipe)> {
    let size = [160, 120];
    let mut ship = Pipe::new(0.3 * DVec3::X, size).in_place();
    ship.lorentz.smooth = true;
    let mut soft = ship.clone();
    soft.rainbow.picture.filter = ugrainbow::Filter::Spline;
    let lattice = Pipe::new(-0.9 * DVec3::Y, size).view_angle(120.0);
    let mut teapot = Pipe::new(DVec3::new(0.5, 0.5, 0.5), size).in_place();
    teapot.doppler.iris = true;
    teapot.rainbow.interpolation = ugrainbow::Interpolation::Wavelength;
    let mut street = Pipe::new(-0.6 * DVec3::Y, size).shape();
    street.doppler.repeat = true;
    street.lorentz.pieces = uglorentz::Pieces::PerEdge(3);
    let mut dice = Pipe::default().in_place();
    dice.rainbow.picture.size = size;
    let mut tunnel = Pipe::new(-0.6 * DVec3::Y, size);
    tunnel.doppler.shift = uglight::ColorShift::SPECTRA;
    tunnel.doppler.iris = true;
    let mut figure = ship.clone();
    figure.rainbow.picture.output = ugrainbow::Output::Vector(ugimage::Format::Pdf);
    let mut annotated = figure.clone();
    annotated.rainbow.picture.annotations = ugrainbow::AnnotationOptions {
        caption: "λ → λ/D".into(),
        legend: true,
        outline: true,
        grid: true,
        ..Default::default()
    };
    annotated.rainbow.picture.size = [320, 240];
    let mut glass = Pipe::new(0.9 * DVec3::X, size).in_place();
    glass.rainbow.picture.output = ugrainbow::Output::Vector(ugimage::Format::Svg);
    let mut globe = tunnel.clone();
    globe.doppler.tolerance = 0.0;
    vec![
        ("ship", ship),
        ("ship", soft),
        ("ship", figure),
        ("ship", annotated),
        ("glass", glass),
        ("lattice", lattice),
        ("teapot", teapot),
        ("street", street),
        ("dice", dice),
        ("tunnel", tunnel),
        ("sphere", globe),
    ]
}

/// Runs the pipe with a number of threads.
fn run_on(n_threads: usize, pipe: &Pipe, text: &[u8]) -> Stages {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
    pool.install(|| pipe.run(text))
}

#[test]
fn bytes_do_not_depend_on_threads_or_runs() {
    for (name, pipe) in pipes() {
        let text = scenes::text(name);
        let one = run_on(1, &pipe, &text);
        for n_threads in [2, 7] {
            assert!(run_on(n_threads, &pipe, &text) == one, "{name} on {n_threads} threads");
        }
    }
}

/// The output of every program in a shell pipe, with the programs in a folder.
fn through_a_shell(programs: &Path, scene: &Path) -> Stages {
    const SCRIPT: &str = r#"
        PATH="$1:$PATH"
        uglorentz -qt -vel .3 -.2 0 -in < "$2" | tee "$3/seen" |
            ugdoppler -qt -ir | tee "$3/colored" |
            ugrainbow -qt -sz 160 120 > "$3/file""#;
    let folder = tempfile::tempdir().unwrap();
    let mut shell = Command::new("sh");
    shell.args(["-e", "-c", SCRIPT, "sh"]).arg(programs).arg(scene).arg(folder.path());
    let output = shell.output().unwrap();
    let messages = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && messages.is_empty(), "{}: {messages}", output.status);
    let stage = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    Stages { seen: stage("seen"), colored: stage("colored"), file: stage("file") }
}

/// In `.ci/run` the programs of the shell pipe are of another profile than the libraries in this
/// process, by `UG_PROGRAMS`.
#[test]
fn a_shell_pipe_gives_the_same_bytes_in_both_profiles() {
    // With a history, to which programs do not add what libraries do not know: the name of a file.
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("cubes.ug");
    std::fs::write(&scene, [b"{ ugmesh 1: ugmesh }\n", &scenes::text("cubes")[..]].concat())
        .unwrap();
    tools::has_other_build(tools::PROFILES);
    let programs = programs::folder();
    let there = through_a_shell(programs, &scene);
    assert!(!there.file.is_empty());
    assert!(through_a_shell(programs, &scene) == there, "a second run");

    let mut pipe = Pipe::new(DVec3::new(0.3, -0.2, 0.0), [160, 120]).in_place();
    pipe.doppler.iris = true;
    pipe.lorentz_command = Some("uglorentz -vel .3 -.2 0 -in".to_string());
    pipe.doppler_command = Some("ugdoppler -ir".to_string());
    pipe.rainbow_command_line = "ugrainbow -sz 160 120".to_string();
    let here = pipe.run(&std::fs::read(&scene).unwrap());
    // Programs record the hash of what they read, which libraries do not know.
    let unrecorded = |text: &[u8]| {
        let text = String::from_utf8_lossy(text);
        let lines = text.split_inclusive('\n').filter(|line| !line.starts_with("{ SHA-256 "));
        lines.collect::<String>()
    };
    assert_eq!(unrecorded(&here.seen), unrecorded(&there.seen));
    assert!(unrecorded(&here.colored) == unrecorded(&there.colored), "ugdoppler");
    assert!(decode(&here.file) == decode(&there.file), "ugrainbow");
    // And without text between the programs.
    let in_memory = in_memory::png(&std::fs::read(&scene).unwrap()).unwrap();
    assert!(decode(&in_memory) == decode(&there.file), "the example in_memory.rs");
}
