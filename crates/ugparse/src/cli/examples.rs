//! The scenes of the repository, a mesh, pictures and a list of stars, for those who have only the
//! programs.

use std::path::PathBuf;

use ugpipe::{Context, Failure, one_of};

macro_rules! files {
    ($($name:literal)*) => { [$(($name, include_bytes!(concat!("../../scenes/", $name)) as &[u8])),*] };
}

/// The scenes of the repository, with the pictures they name, a mesh and a list of stars: names of
/// files and their bytes.
pub const EXAMPLE_FILES: [(&str, &[u8]); 58] = files![
    "house.ug" "houses.ug" "ship.ug" "street.ug" "teapot.ug" "cubes.ug" "sphere.ug" "directions.ug"
    "lattice.ug" "grid.ug" "tunnel.ug" "die.ug" "poles.ug" "lamps.ug" "clocks.ug" "wheels.ug"
    "twins.ug" "orbit.ug" "ticks.ug" "lanterns.ug" "carousel.ug" "departure.ug" "spinning.ug"
    "disc.ug" "slalom.ug" "dice.ug" "traffic.ug" "lamp.ug" "glass.ug" "mirrors.ug" "shadow.ug"
    "room.ug" "water.ug" "marbles.ug" "rainbow.ug" "halves.ug" "avenue.ug" "town.ug" "saturn.ug"
    "stones.ug" "tram.ug" "jet.ug" "snapshot.ug" "rolling.ug" "city.ug" "train.ug" "doors.ug"
    "string.ug" "barn.ug" "bell.ug" "facade.png" "facade-yellow.png" "facade-brown.png"
    "facade-grey.png" "paving.png" "crate.gltf" "globe.obj" "stars.csv"
];

/// Arguments of `ugparse example`.
#[derive(clap::Args, Debug)]
pub struct ExampleArgs {
    /// File to write; without it, list the files
    #[arg(value_name = "NAME", conflicts_with = "all", value_parser = one_of("examples", EXAMPLE_FILES.map(|(name, _)| short(name)).into_iter().zip(0_usize..)))]
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
        Some(row) => context.write(EXAMPLE_FILES[row].1),
        None => {
            let lines = EXAMPLE_FILES
                .map(|(name, text)| format!("{:10} {}\n", short(name), example_subject(text)));
            context.write_text(&lines.concat())
        }
    }
}

/// Writes all files. A file that is there with another content is kept, and then nothing is
/// written.
fn write_all(context: &mut Context) -> Result<(), Failure> {
    let mut missing = Vec::new();
    for (name, text) in EXAMPLE_FILES {
        let path = PathBuf::from(name);
        if !path.exists() {
            missing.push((path, text));
        } else if context.input_file(&path)?.text != text {
            return Err(Failure::Failed(format!(
                "`{name}` is there already, with another content; rename it, or use another folder"
            )));
        }
    }
    for (path, text) in &missing {
        context.write_file(path, text)?;
    }
    context.note(&format!("{} files written to the current folder", missing.len()));
    Ok(())
}

/// What an example shows: the first sentence of the comment at the head of a file or of the history
/// of a mesh, or its part before a semicolon.
pub fn example_subject(text: &[u8]) -> String {
    let Ok(text) = str::from_utf8(text) else { return "a picture on walls of `town`".to_owned() };
    let history = text.split_once("\"history\": [").map(|(_, rows)| rows.trim_start());
    let comment = history.unwrap_or(text).trim_start_matches(['{', '#', '"']);
    let end = [". ", ".\n", ".\"", ";"].iter().filter_map(|mark| comment.find(mark)).min();
    let sentence = &comment[..end.unwrap_or(0)];
    sentence.split_whitespace().collect::<Vec<_>>().join(" ")
}
