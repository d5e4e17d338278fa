//! How the instructions of the programs grow with each count of a scene.
//!
//! Scenes of one kind with n, 2n and 4n parts: without what a program does for any scene, their
//! instructions differ by the powers of 2 of the exponent. n log n is about 1.1; what is above
//! [`MOST`] is a fault, or a row of [`STATED`].

use std::fmt::Write as _;
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::Outcome;
use crate::{instructions, programs};

/// The greatest exponent.
const MOST: f64 = 1.3;

/// Counts whose work grows faster, and why: part of the name, program, reason.
const STATED: [(&str, &str, &str); 2] = [
    ("colours at one vertex", "uglorentz", "mixtures of n colours at n new vertices, with a limit"),
    (
        "",
        "ugrainbow -vec",
        "pairs of areas that overlap, with a limit; edges that a row of a polygon crosses",
    ),
];

/// What reads each scene.
const COMMANDS: [&str; 7] = [
    "ugparse flatten",
    "uglorentz -vel .5 0 0",
    "ugdoppler -li",
    "ugrainbow -sz 16 12 -fo p.png",
    "ugrainbow -vec -sz 64 48 -fo p.svg",
    "ugphoton -sz 16 12 -fo p.png",
    "ugmesh -dt glb -fo m.glb",
];

#[derive(clap::Args)]
pub struct Args {
    /// Only kinds of scenes and commands that contain WORD
    #[arg(long, value_name = "WORD", default_value = "")]
    only: String,
    /// Folder of the programs [default: those of the release profile, built if need be]
    #[arg(long, value_name = "FOLDER")]
    programs: Option<PathBuf>,
}

/// Prints the exponents as Markdown, and fails if one is too large.
pub fn write(out: &mut impl Write, args: &Args) -> Outcome<()> {
    let programs = args.programs.as_ref().map(std::path::absolute).transpose()?;
    let programs = programs.unwrap_or_else(programs::released);
    let mut faults = Vec::new();
    writeln!(
        out,
        "| count | command | instructions, millions | exponent |\n| --- | --- | ---: | ---: |"
    )?;
    for (name, n, scene) in KINDS {
        for command in COMMANDS {
            let is_named = name.contains(&args.only) || command.contains(&args.only);
            // Meshes have no camera.
            if !is_named || name.ends_with(".obj") && command != "ugmesh -dt glb -fo m.glb" {
                continue;
            }
            let counted =
                counts(&programs, command, name, [n, 2 * n, 4 * n].map(|n| (n, scene(n))));
            let [a, b, c] = match counted {
                // Bodies that move need uglorentz first.
                Err(error) if error.to_string().contains("are not as seen yet") => continue,
                counted => counted?,
            };
            let growth = if b > a { (c - b) / (b - a) } else { c / b };
            // Differences within the noise of the count have no exponent.
            let exponent = if c - b < 0.02 * b { 0.0 } else { libm::log2(growth) };
            let stated =
                STATED.iter().find(|row| name.contains(row.0) && command.starts_with(row.1));
            let why = stated.map_or("", |row| row.2);
            writeln!(
                out,
                "| {n} {name} | {command} | {a:.1}, {b:.1}, {c:.1} | {exponent:.2} {why} |"
            )?;
            out.flush()?;
            if exponent > MOST && stated.is_none() {
                faults.push(format!("{name}: {command}"));
            }
        }
    }
    if faults.is_empty() {
        Ok(())
    } else {
        Err(format!("faster than linear: {}", faults.join("; ")).into())
    }
}

/// The instructions of a command for three scenes, in millions.
fn counts(
    programs: &Path,
    command: &str,
    name: &str,
    scenes: [(usize, String); 3],
) -> Outcome<[f64; 3]> {
    let mut counts = [0.0; 3];
    for (count, (n, scene)) in counts.iter_mut().zip(scenes) {
        let folder = tempfile::tempdir()?;
        let write = |file: &str, text: &str| std::fs::write(folder.path().join(file), text);
        let (file, camera) = if name.ends_with(".obj") {
            ("s.obj", "")
        } else {
            ("s.ug", "cam -ep 0 -12 3 -vc 0 0 0;\n")
        };
        write(file, &format!("{camera}{scene}"))?;
        write("m.mtl", &lines(n, |k| format!("newmtl m{k}\nKd .{k} .5 .5")))?;
        write("p.csv", &format!("t,x,y,z\n{}", lines(n, |k| format!("{k},0,0,0"))))?;
        *count = instructions::count(programs, &format!("{command} {file}"), folder.path())?;
    }
    Ok(counts)
}

/// The counted parts, their smallest number, and the scene of a number of them.
type Kind = (&'static str, usize, fn(usize) -> String);

const KINDS: [Kind; 19] = [
    ("vertices of a wire", 1000, |n| {
        let wires =
            lines(n, |k| format!("v p{k} {} 0 {}; w (p{k} p0);", angle(k, n).0, angle(k, n).1));
        format!("{wires}{}", triangle(0, 1, "", ""))
    }),
    ("faces", 500, |n| lines(n, |k| triangle(k, n, "", ""))),
    ("colours", 500, |n| {
        lines(n, |k| format!("c_rgb k{k} .{k} .5 .2; {}", triangle(k, n, &format!("k{k}"), "")))
    }),
    ("colours at one vertex", 50, |n| {
        let face = |k| {
            format!(
                "c k{k} .5 {} 1; v c{k} 1 .5 {}; f (a b c{k}) k{k};",
                k % 360,
                k as f64 / n as f64
            )
        };
        format!("v a 0 0 0; v b 1 0 0;\n{}", lines(n, face))
    }),
    ("tables of colours", 250, |n| {
        let face =
            |k| format!("c_time t{k} 0 r {} z; {}", k + 1, triangle(k, n, &format!("t{k}"), ""));
        format!("c r 1 0; c z 0;\n{}", lines(n, face))
    }),
    ("rows of a table of colours", 1000, |n| {
        format!(
            "c r 1 0; c z 0; c_time t {};\n{}",
            lines(n, |k| format!("{k} {}", ["r", "z"][k % 2])),
            triangle(0, 1, "t", "")
        )
    }),
    ("corners of a circle", 500, |n| polygon(n, |_| 1.0)),
    ("corners of a star", 500, |n| polygon(n, |k| 1.0 + (k % 2) as f64)),
    ("holes", 100, |n| {
        let hole = |k| {
            let x = k as f64 / n as f64;
            format!("v a{k} {x} 0 0; v b{k} {x} 0 .1; v c{k} {} 0 .1;", x + 0.3 / n as f64)
        };
        let holes = lines(n, |k| format!("(a{k} b{k} c{k})"));
        format!(
            "{}v a -1 0 -1; v b 2 0 -1; v c 2 0 1; v d -1 0 1; f (a b c d) {holes};",
            lines(n, hole)
        )
    }),
    ("bodies with shared vertices", 500, |n| {
        let face = |k| format!("f (a b c) <{} 0 0>;", 0.9 * k as f64 / n as f64);
        format!("v a 0 0 0; v b 1 0 0; v c 0 0 1;\n{}", lines(n, face))
    }),
    ("motions", 100, |n| {
        lines(n, |k| {
            format!("motion m{k} -acc .01 0 0; {}", triangle(k, n, "", &format!("<m{k}>")))
        })
    }),
    ("motions along one table", 100, |n| {
        lines(n, |k| format!("motion m{k} -path p.csv; {}", triangle(k, n, "", &format!("<m{k}>"))))
    }),
    ("events of a path", 500, |_| format!("motion m -path p.csv; {}", triangle(0, 1, "", "<m>"))),
    ("instances", 500, |n| {
        format!(
            "def t; {} end;\n{}",
            triangle(0, 1, "", ""),
            lines(n, |k| format!("i (t -tx {});", k as f64 / n as f64))
        )
    }),
    ("copies of an array", 500, |n| {
        format!("def t; {} end; a (t) {n} -tx .001;", triangle(0, 1, "", ""))
    }),
    ("lamps", 100, |n| {
        format!(
            "{}\n{}",
            triangle(0, 1, "", ""),
            lines(n, |k| format!("l .1 {} 0 3 5 <.{k} 0 0>;", k % 7))
        )
    }),
    ("cameras and comments", 1000, |n| {
        format!(
            "{}\n{}",
            triangle(0, 1, "", ""),
            lines(n, |k| format!("{{ {k} }} cam c{k} -ep 0 -9 {k} -vc 0 0 0;"))
        )
    }),
    ("materials.obj", 500, |n| {
        let face = |k| format!("v 0 0 {k}\nv 1 0 {k}\nv 0 1 {k}\nusemtl m{k}\nf -1 -2 -3");
        format!("mtllib m.mtl\n{}", lines(n, face))
    }),
    ("names in mtllib.obj", 250, |n| {
        format!(
            "mtllib {}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
            lines(n, |k| format!("x{k}.mtl")).replace('\n', " ")
        )
    }),
];

fn lines(n: usize, line: impl Fn(usize) -> String) -> String {
    (0..n).fold(String::new(), |mut text, k| {
        // Writing to a string does not fail.
        let _ = writeln!(text, "{}", line(k));
        text
    })
}

fn angle(k: usize, n: usize) -> (f64, f64) {
    let angle = std::f64::consts::TAU * k as f64 / n as f64;
    (libm::cos(angle), libm::sin(angle))
}

fn triangle(k: usize, n: usize, color: &str, motion: &str) -> String {
    let (x, z) = angle(k, n);
    format!(
        "v a{k} {x} 0 {z}; v b{k} {} .2 {z}; v c{k} {x} .1 {}; f (a{k} b{k} c{k}) {color} {motion};",
        x + 0.1,
        z + 0.1
    )
}

fn polygon(n: usize, radius: impl Fn(usize) -> f64) -> String {
    let corner =
        |k| format!("v a{k} {} 0 {};", radius(k) * angle(k, n).0, radius(k) * angle(k, n).1);
    format!("{}f ({});", lines(n, corner), lines(n, |k| format!("a{k}")))
}
