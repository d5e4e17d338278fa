//! The scenes of the repository, a mesh and a list of stars, for those who have only the programs.

use std::path::PathBuf;

use ugpipe::{Context, Failure, one_of};

/// Names of files and texts.
const FILES: [(&str, &str); 37] = [
    ("house.ug", include_str!("../../scenes/house.ug")),
    ("houses.ug", include_str!("../../scenes/houses.ug")),
    ("ship.ug", include_str!("../../scenes/ship.ug")),
    ("street.ug", include_str!("../../scenes/street.ug")),
    ("teapot.ug", include_str!("../../scenes/teapot.ug")),
    ("cubes.ug", include_str!("../../scenes/cubes.ug")),
    ("sphere.ug", include_str!("../../scenes/sphere.ug")),
    ("directions.ug", include_str!("../../scenes/directions.ug")),
    ("lattice.ug", include_str!("../../scenes/lattice.ug")),
    ("grid.ug", include_str!("../../scenes/grid.ug")),
    ("tunnel.ug", include_str!("../../scenes/tunnel.ug")),
    ("die.ug", include_str!("../../scenes/die.ug")),
    ("poles.ug", include_str!("../../scenes/poles.ug")),
    ("lamps.ug", include_str!("../../scenes/lamps.ug")),
    ("clocks.ug", include_str!("../../scenes/clocks.ug")),
    ("wheels.ug", include_str!("../../scenes/wheels.ug")),
    ("twins.ug", include_str!("../../scenes/twins.ug")),
    ("orbit.ug", include_str!("../../scenes/orbit.ug")),
    ("ticks.ug", include_str!("../../scenes/ticks.ug")),
    ("lanterns.ug", include_str!("../../scenes/lanterns.ug")),
    ("carousel.ug", include_str!("../../scenes/carousel.ug")),
    ("departure.ug", include_str!("../../scenes/departure.ug")),
    ("spinning.ug", include_str!("../../scenes/spinning.ug")),
    ("disc.ug", include_str!("../../scenes/disc.ug")),
    ("slalom.ug", include_str!("../../scenes/slalom.ug")),
    ("dice.ug", include_str!("../../scenes/dice.ug")),
    ("traffic.ug", include_str!("../../scenes/traffic.ug")),
    ("lamp.ug", include_str!("../../scenes/lamp.ug")),
    ("glass.ug", include_str!("../../scenes/glass.ug")),
    ("mirrors.ug", include_str!("../../scenes/mirrors.ug")),
    ("shadow.ug", include_str!("../../scenes/shadow.ug")),
    ("room.ug", include_str!("../../scenes/room.ug")),
    ("water.ug", include_str!("../../scenes/water.ug")),
    ("rainbow.ug", include_str!("../../scenes/rainbow.ug")),
    ("halves.ug", include_str!("../../scenes/halves.ug")),
    ("globe.obj", include_str!("../../scenes/globe.obj")),
    ("stars.csv", include_str!("../../scenes/stars.csv")),
];

/// Arguments of `ugparse example`.
#[derive(clap::Args, Debug)]
pub struct ExampleArgs {
    /// File to write; without it, list the files
    #[arg(value_name = "NAME", conflicts_with = "all", value_parser = one_of("examples", FILES.map(|(name, _)| short(name)).into_iter().zip(0_usize..)))]
    name: Option<usize>,

    /// Write every file into the current folder
    #[arg(long)]
    all: bool,
}

/// The name of a file; of a scene, without its extension.
fn short(name: &'static str) -> &'static str {
    name.strip_suffix(".ug").unwrap_or(name)
}

/// Lists the files, or writes one or all of them.
pub fn write(args: &ExampleArgs, context: &mut Context) -> Result<(), Failure> {
    if args.all {
        return write_all(context);
    }
    match args.name {
        Some(row) => context.write_text(FILES[row].1),
        None => {
            let lines = FILES.map(|(name, text)| format!("{:10} {}\n", short(name), subject(text)));
            context.write_text(&lines.concat())
        }
    }
}

/// Writes all files. A file that is there with another content is kept, and then nothing is
/// written.
fn write_all(context: &mut Context) -> Result<(), Failure> {
    let mut missing = Vec::new();
    for (name, text) in FILES {
        let path = PathBuf::from(name);
        if !path.exists() {
            missing.push((path, text));
        } else if context.input_file(&path)?.text != text.as_bytes() {
            return Err(Failure::Failed(format!(
                "`{name}` is there already, with another content; rename it, or use another folder"
            )));
        }
    }
    for (path, text) in &missing {
        context.write_file(path, text.as_bytes())?;
    }
    context.note(&format!("{} files written to the current folder", missing.len()));
    Ok(())
}

/// The first sentence of the comment at the head of a file, or its part before a semicolon.
fn subject(text: &str) -> String {
    let comment = text.trim_start_matches(['{', '#']);
    let end = [". ", ".\n", ";"].iter().filter_map(|mark| comment.find(mark)).min();
    let sentence = &comment[..end.unwrap_or(0)];
    sentence.split_whitespace().collect::<Vec<_>>().join(" ")
}
