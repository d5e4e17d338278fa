//! The scenes of the repository, for those who have only the programs.

use std::path::PathBuf;

use ugpipe::{Context, Failure};

/// Names and texts.
const SCENES: [(&str, &str); 20] = [
    ("house", include_str!("../../../../scenes/house.ug")),
    ("ship", include_str!("../../../../scenes/ship.ug")),
    ("street", include_str!("../../../../scenes/street.ug")),
    ("teapot", include_str!("../../../../scenes/teapot.ug")),
    ("cubes", include_str!("../../../../scenes/cubes.ug")),
    ("sphere", include_str!("../../../../scenes/sphere.ug")),
    ("directions", include_str!("../../../../scenes/directions.ug")),
    ("lattice", include_str!("../../../../scenes/lattice.ug")),
    ("grid", include_str!("../../../../scenes/grid.ug")),
    ("tunnel", include_str!("../../../../scenes/tunnel.ug")),
    ("dice", include_str!("../../../../scenes/dice.ug")),
    ("traffic", include_str!("../../../../scenes/traffic.ug")),
    ("lamp", include_str!("../../../../scenes/lamp.ug")),
    ("glass", include_str!("../../../../scenes/glass.ug")),
    ("mirrors", include_str!("../../../../scenes/mirrors.ug")),
    ("shadow", include_str!("../../../../scenes/shadow.ug")),
    ("room", include_str!("../../../../scenes/room.ug")),
    ("water", include_str!("../../../../scenes/water.ug")),
    ("rainbow", include_str!("../../../../scenes/rainbow.ug")),
    ("halves", include_str!("../../../../scenes/halves.ug")),
];

/// Arguments of `ugparse example`.
#[derive(clap::Args, Debug)]
pub struct ExampleArgs {
    /// Scene to write; without it, list the scenes
    #[arg(value_name = "NAME", conflicts_with = "all")]
    name: Option<String>,

    /// Write every scene to a file NAME.ug in the current folder
    #[arg(long)]
    all: bool,
}

/// Lists the scenes, or writes one or all of them.
pub fn write(args: &ExampleArgs, context: &mut Context) -> Result<(), Failure> {
    if args.all {
        return write_all(context);
    }
    let Some(name) = &args.name else {
        let lines = SCENES.map(|(name, text)| format!("{name:10} {}\n", subject(text)));
        return context.write_text(&lines.concat());
    };
    let name = name.strip_suffix(".ug").unwrap_or(name);
    let Some((_, text)) = SCENES.iter().find(|(scene, _)| *scene == name) else {
        let names = SCENES.map(|(name, _)| name).join(", ");
        return Err(Failure::usage(format!("there is no example `{name}`; there are {names}")));
    };
    context.write_text(text)
}

/// Writes all scenes to files. A file that is there with another content is kept, and then nothing
/// is written.
fn write_all(context: &mut Context) -> Result<(), Failure> {
    let mut missing = Vec::new();
    for (name, text) in SCENES {
        let path = PathBuf::from(format!("{name}.ug"));
        if !path.exists() {
            missing.push((path, text));
        } else if context.input_file(&path)?.text != text.as_bytes() {
            let path = path.display();
            return Err(Failure::Failed(format!(
                "`{path}` is there already, with another content; rename it, or use another folder"
            )));
        }
    }
    for (path, text) in &missing {
        context.write_file(path, text.as_bytes())?;
    }
    context.note(&format!("{} scenes written to the current folder", missing.len()));
    Ok(())
}

/// The first sentence of the comment at the head of a scene, or its part before a semicolon.
fn subject(text: &str) -> String {
    let comment = text.trim_start_matches('{');
    let end = [". ", ".\n", ";"].iter().filter_map(|mark| comment.find(mark)).min();
    let sentence = &comment[..end.unwrap_or(0)];
    sentence.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_has_a_subject() {
        for (name, text) in SCENES {
            let subject = subject(text);
            assert!((20..=150).contains(&subject.len()), "{name}: {subject}");
        }
    }
}
