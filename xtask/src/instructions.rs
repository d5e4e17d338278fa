//! Counts the instructions that the programs execute on fixed work, and compares them with the
//! table
//! `xtask/instructions.csv`.
//!
//! callgrind counts them, on one thread. A count repeats to about a ten-thousandth however busy the
//! machine is. It depends on the compiler, the C library, and the features of the processor that
//! valgrind passes on (AVX2 and FMA, but neither AVX-512 nor the instructions for SHA-256), so the
//! table is for x86-64 processors with AVX2. A count is not a time: waiting for memory is not in
//! it.

use std::fmt::Write as _;
use std::io::Write;
use std::path::Path;
use std::process::Command;

use image::{Rgb, RgbImage};

use crate::Outcome;
use crate::mesh::Mesh;
use crate::programs;

/// The table: name of the work, command, millions of instructions, and why the row was raised.
/// Commands run in this order in a folder with the scenes below, and may read what an earlier one
/// has written.
const TABLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/instructions.csv");

/// The greatest ratio of a count to that of the table.
const MOST: f64 = 1.02;

#[derive(clap::Args)]
pub struct Args {
    /// Only work whose command contains WORD, and nothing that it reads
    #[arg(long, value_name = "WORD", default_value = "")]
    only: String,
    /// Write the counts into the table
    #[arg(long)]
    bless: bool,
}

/// Prints the counts as Markdown, and fails if one is too large.
pub fn write(out: &mut impl Write, args: &Args) -> Outcome<()> {
    let table = std::fs::read_to_string(TABLE)?;
    let (head, rows) = table.split_once('\n').ok_or("the table has no rows")?;
    let rows: Vec<[&str; 4]> =
        rows.lines().map(cells).collect::<Option<_>>().ok_or("a row has 4 cells")?;
    let programs = programs::released();
    let folder = tempfile::tempdir()?;
    write_scenes(folder.path())?;
    writeln!(
        out,
        "| work | instructions, millions | in the table | ratio |\n| --- | ---: | ---: | ---: |"
    )?;
    let (mut blessed, mut raised) = (format!("{head}\n"), Vec::new());
    for [work, command, before, why] in rows {
        if !command.contains(&args.only) {
            writeln!(blessed, "{work},{command},{before},{why}")?;
            continue;
        }
        let now = count(&programs, command, folder.path())?;
        // A row without a count fails, too.
        let ratio = now / before.parse::<f64>().unwrap_or(0.0);
        writeln!(out, "| {work} | {now:.1} | {before} | {ratio:.3} |")?;
        out.flush()?;
        writeln!(blessed, "{work},{command},{now:.1},{why}")?;
        raised.extend((ratio > MOST).then_some(work));
    }
    if args.bless {
        std::fs::write(TABLE, blessed)?;
    } else if !raised.is_empty() {
        let raised = raised.join(", ");
        return Err(format!(
            "more instructions than in {TABLE}: {raised}; who raises a row says why in it"
        )
        .into());
    }
    Ok(())
}

fn cells(row: &str) -> Option<[&str; 4]> {
    row.split(',').collect::<Vec<_>>().try_into().ok()
}

/// Millions of instructions of a command.
pub fn count(programs: &Path, command: &str, folder: &Path) -> Outcome<f64> {
    let mut words = command.split(' ');
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(programs.join(words.next().unwrap_or_default()))
        .args(words.chain(["-qt", "-nt", "1"]))
        .current_dir(folder)
        .output()
        .map_err(|error| format!("valgrind (the Debian package valgrind): {error}"))?;
    let text = String::from_utf8_lossy(&output.stderr);
    let counted =
        text.lines().find_map(|line| line.split_once("Collected : ")?.1.parse::<f64>().ok());
    match counted.filter(|_| output.status.success()) {
        Some(counted) => Ok(counted / 1e6),
        None => Err(format!("`{command}` failed: {text}").into()),
    }
}

fn write_scenes(folder: &Path) -> Outcome<()> {
    std::fs::write(folder.join("mesh.ug"), Mesh::of_rows(60).scene(false)?)?;
    std::fs::write(folder.join("cubes.ug"), cubes()?)?;
    let pixel = |x: u32, y: u32| {
        Rgb([0, 1, 2].map(|shift| (((x * 7 + y * 3) ^ ((x * y) >> 4)) >> shift) as u8))
    };
    Ok(RgbImage::from_fn(2048, 1024, pixel).save(folder.join("panorama.png"))?)
}

/// 256 instances of a cube, whose long edges are cut.
fn cubes() -> Result<String, std::fmt::Error> {
    let mut text = String::from("c_rgb red .9 .2 .1 ;\nc_rgb blue .1 .3 .9 ;\ndef cube ;\n");
    for k in 0..8 {
        writeln!(text, "v c{k} {} {} {} ;", k & 1, k >> 1 & 1, k >> 2 & 1)?;
    }
    let sides =
        ["c0 c2 c3 c1", "c4 c5 c7 c6", "c0 c1 c5 c4", "c2 c6 c7 c3", "c0 c4 c6 c2", "c1 c3 c7 c5"];
    for (k, corners) in sides.into_iter().enumerate() {
        writeln!(text, "f s{k} ({corners}) {} ;", if k % 2 == 1 { "red" } else { "blue" })?;
    }
    text += "end ;\n";
    for i in 0..256 {
        writeln!(text, "i i{i} (cube -tx {} -ty {} -tz {}) ;", 2 * (i % 16), 2 * (i / 16), i % 3)?;
    }
    Ok(text)
}
