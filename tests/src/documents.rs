//! Commands in the pages of the documentation, as a reader would type them.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use crate::scenes;

/// First words of the commands that a reader types in the folder of a page.
const PROGRAMS: [&str; 12] = [
    "uglorentz ",
    "ugdoppler ",
    "ugrainbow ",
    "ugphoton ",
    "ugwarp ",
    "ugsheet ",
    "ugmesh ",
    "ugparse ",
    "ugfilm ",
    "ugdiagram ",
    "sed ",
    "for ",
];

/// The commands of a page.
pub struct Page {
    /// Path in the repository.
    pub path: String,
    /// Its text.
    pub text: String,
    /// Definitions of shell functions and variables, for all commands.
    definitions: String,
    /// One command per line, without comments.
    pub commands: Vec<String>,
}

impl Page {
    /// Reads a page of the repository.
    #[must_use]
    pub fn read(path: &str) -> Self {
        let text = fs::read_to_string(scenes::root().join(path))
            .unwrap_or_else(|error| panic!("{path}: {error}"));
        let (mut definitions, mut commands) = (String::new(), Vec::<String>::new());
        let mut is_open = false;
        // Code is indented by four columns, in lists by more.
        for line in text.lines().filter_map(|line| line.strip_prefix("    ")) {
            let name = line.trim_start_matches(|c: char| c.is_ascii_lowercase() || c == '_');
            let is_limit = line.starts_with("ulimit ");
            if is_limit
                || name.len() < line.len() && (name.starts_with("() {") || name.starts_with("='"))
            {
                definitions.push_str(line);
                definitions.push('\n');
                continue;
            }
            let line = line.trim_start();
            let code = line.split(" #").next().unwrap_or(line).trim_end();
            if let Some(command) = commands.last_mut().filter(|_| is_open) {
                command.push('\n');
                command.push_str(code);
                is_open = code != "done";
            } else if PROGRAMS.iter().any(|program| line.starts_with(program)) {
                commands.push(code.to_owned());
                is_open = code.starts_with("for ") && !code.ends_with("done");
            }
        }
        Self { path: path.to_owned(), text, definitions, commands }
    }

    /// Commands of another text, one per line, with comments after ` #`.
    #[must_use]
    pub fn of_commands(path: &str, commands: &[String]) -> Self {
        let code =
            |command: &String| command.split(" #").next().unwrap_or(command).trim_end().to_owned();
        let commands = commands.iter().map(code).collect();
        Self { path: path.to_owned(), text: String::new(), definitions: String::new(), commands }
    }

    /// Runs a command in a folder, with the programs in another folder. Returns what the command
    /// wrote to standard error.
    ///
    /// # Errors
    /// The command with its messages, if its status is not 0.
    pub fn run(&self, command: &str, folder: &Path, programs: &Path) -> Result<String, String> {
        let path = std::env::var_os("PATH").unwrap_or_default();
        let path = std::env::join_paths(
            std::iter::once(programs.to_owned()).chain(std::env::split_paths(&path)),
        );
        let output = Command::new("bash")
            .args(["-c", &format!("set -euo pipefail\n{}{command}", self.definitions)])
            .current_dir(folder)
            .env("PATH", path.expect("a path without colons"))
            .output()
            .expect("bash runs");
        let messages = String::from_utf8_lossy(&output.stderr).into_owned();
        if output.status.success() {
            Ok(messages)
        } else {
            Err(format!("{}: {command}: {messages}", self.path))
        }
    }
}

/// The commands of a page after the prompt `$ `, each with the code that follows it before other
/// text.
#[must_use]
pub fn transcripts(path: &str) -> Vec<(String, String)> {
    let text = fs::read_to_string(scenes::root().join(path))
        .unwrap_or_else(|error| panic!("{path}: {error}"));
    let mut transcripts: Vec<(String, String)> = Vec::new();
    let mut is_open = false;
    for line in text.lines().filter(|line| !line.is_empty()) {
        let Some(line) = line.strip_prefix("    ") else {
            is_open = false;
            continue;
        };
        if let Some(command) = line.strip_prefix("$ ") {
            transcripts.push((command.to_owned(), String::new()));
            is_open = true;
        } else if let Some((_, answer)) = transcripts.last_mut().filter(|_| is_open) {
            answer.push_str(line);
            answer.push('\n');
        }
    }
    transcripts
}

/// Fills a folder as a reader does who has only the programs.
pub fn fill(folder: &Path, programs: &Path) {
    let page = Page::of_commands("examples", &[]);
    let filled = page.run("ugparse -qt example --all", folder, programs);
    filled.unwrap_or_else(|message| panic!("{message}"));
}

/// Makes the files that examples of `--help` take for granted: a mesh of the reader's own, in
/// several formats, its lights and camera, a scene that has been through `uglorentz`, and a
/// panorama.
const PREPARATION: &str = "\
    ugmesh -dt obj teapot.ug -fo teapot.obj; \
    ugmesh -dt ply globe.obj -fo globe.ply; \
    printf 'cam -ep 0 -6 1 -vc 0 0 0 -ud 0 0 1 -va 40 30 ; l .3 ; l .7 0 -1 1 ;' > stage.ug; \
    uglorentz -vel .3 0 0 -in ship.ug | ugdoppler > seen.ug; \
    ugphoton -qt -pan -aa 1 -sz 256 128 tunnel.ug -fo sky.png";

/// Fills a folder with what a reader of `--help` has when typing commands: the scenes and stars of
/// the repository, and the files that examples take for granted.
pub fn prepare(folder: &Path, programs: &Path) {
    static MADE: OnceLock<Vec<(OsString, Vec<u8>)>> = OnceLock::new();
    copy_scenes(folder);
    let made = MADE.get_or_init(|| {
        let folder = tempfile::tempdir().expect("a temporary folder");
        copy_scenes(folder.path());
        let page = Page::of_commands("preparation", &[]);
        page.run(PREPARATION, folder.path(), programs)
            .unwrap_or_else(|message| panic!("{message}"));
        let entries = fs::read_dir(folder.path()).expect("a folder").flatten();
        let files = entries.filter(|entry| entry.path().is_file());
        files.map(|file| (file.file_name(), fs::read(file.path()).expect("a file"))).collect()
    });
    for (name, bytes) in made {
        fs::write(folder.join(name), bytes).expect("a copy");
    }
}

/// Files of `scenes/` that commands and scenes read.
const OTHER_FILES: [&str; 8] = [
    "stars.csv",
    "globe.obj",
    "crate.gltf",
    "facade.png",
    "facade-yellow.png",
    "facade-brown.png",
    "facade-grey.png",
    "paving.png",
];

fn copy_scenes(folder: &Path) {
    for name in scenes::names() {
        fs::write(folder.join(format!("{name}.ug")), scenes::text(&name)).expect("a copy");
    }
    for name in OTHER_FILES {
        fs::copy(scenes::root().join("scenes").join(name), folder.join(name)).expect("a copy");
    }
}

/// Programs that draw pictures.
const RENDERERS: [&str; 5] = ["ugrainbow ", "ugphoton ", "ugwarp ", "ugfilm ", "ugdiagram "];

/// The command with smaller pictures and shorter films, for tests. Pictures with text keep their
/// size in pixels, so that it fits, and so do those of `-crop`, which names pixels.
#[must_use]
pub fn shrunk(command: &str) -> String {
    let coarse = coarse(command);
    let keeps_size = coarse != command
        || ["ugdiagram ", "-lg", "-cap", "-crop", "-map"]
            .iter()
            .any(|option| command.contains(option));
    shortened(&if keeps_size { coarse } else { resized(&coarse, [640, 480], 0.125) })
}

/// The command with sizes in centimetres replaced by pixels, 40 to the centimetre.
fn coarse(command: &str) -> String {
    let mut parts = command.split("-sz ");
    let before = parts.next().unwrap_or_default().to_owned();
    parts.fold(before, |before, part| {
        let words: Vec<&str> = part.splitn(3, ' ').collect();
        let pixels = |length: &str| Some(40.0 * length.strip_suffix("cm")?.parse::<f64>().ok()?);
        match words[..] {
            [width, height, rest]
                if let (Some(width), Some(height)) = (pixels(width), pixels(height)) =>
            {
                format!("{before}-sz {width:.0} {height:.0} {rest}")
            }
            // The width of a sheet.
            [width, ..] if let Some(pixels) = pixels(width) => {
                format!("{before}-sz {pixels:.0}{}", &part[width.len()..])
            }
            _ => format!("{before}-sz {part}"),
        }
    })
}

/// The command with pictures of other sizes: sizes in it are multiplied by `scale`, and `default`
/// (width and height in pixels) is added to every renderer without a size, times `scale`.
///
/// A command with `--explain` is not changed, because its pixel may not be in a smaller picture.
#[must_use]
pub fn resized(command: &str, default: [u32; 2], scale: f64) -> String {
    if command.contains("--explain") {
        return command.to_owned();
    }
    let scaled = |length: u32| (f64::from(length) * scale).round().max(1.0) as u32;
    let stage = |stage: &str| {
        let split = |name: &'static str| {
            stage.split_once(name).map(|(before, after)| (before, name, after))
        };
        let Some((before, name, after)) = RENDERERS.into_iter().find_map(split) else {
            return stage.to_owned();
        };
        if let Some((options, rest)) = after.split_once("-sz ") {
            let mut words = rest.splitn(3, ' ');
            let lengths =
                [words.next(), words.next()].map(|word| word.and_then(|word| word.parse().ok()));
            if let [Some(width), Some(height)] = lengths {
                let rest = words.next().map(|rest| format!(" {rest}")).unwrap_or_default();
                return format!(
                    "{before}{name}{options}-sz {} {}{rest}",
                    scaled(width),
                    scaled(height)
                );
            }
            // Lengths stay.
            return stage.to_owned();
        }
        let [width, height] = default.map(scaled);
        format!("{before}{name}-sz {width} {height} {after}")
    };
    command.split('|').map(stage).collect::<Vec<_>>().join("|")
}

/// The command with further options for every renderer.
#[must_use]
pub fn with_options(command: &str, options: &str) -> String {
    RENDERERS.iter().fold(command.to_owned(), |command, name| {
        command.replace(name, &format!("{name}{options} "))
    })
}

/// The command with at most four frames in a film, unless it names frames.
fn shortened(command: &str) -> String {
    let names_frames =
        ["-only ", "-keys ", "--print "].iter().any(|option| command.contains(option));
    let Some((before, after)) = command.split_once("-frames ").filter(|_| !names_frames) else {
        return command.to_owned();
    };
    let n_digits = after.bytes().take_while(u8::is_ascii_digit).count();
    let n_frames: u32 = after[..n_digits].parse().unwrap_or(4);
    format!("{before}-frames {}{}", n_frames.min(4), &after[n_digits..])
}

/// The files that a command writes, by its redirections and `-fo`; those of a loop for each of its
/// values, and of the numbered frames of a film the first.
#[must_use]
pub fn written_files(command: &str) -> Vec<PathBuf> {
    let marks = command.match_indices("> ").chain(command.match_indices("-fo "));
    let names =
        marks.filter_map(|(at, mark)| command[at + mark.len()..].split([' ', ';', '\n']).next());
    let names = names.flat_map(|name| loop_values(command, name.trim_matches('"')));
    names.map(|name| PathBuf::from(name.replace("%04d", "0001"))).collect()
}

/// `name` with the variables of the `for` loops of a command replaced by each of their values.
fn loop_values(command: &str, name: &str) -> Vec<String> {
    let mut names = vec![name.to_owned()];
    for rest in command.split("for ").skip(1) {
        let Some((variable, values)) = rest.split_once(" in ") else { continue };
        let Some((values, _)) = values.split_once(';').filter(|(values, _)| !values.contains('$'))
        else {
            continue;
        };
        let variable = format!("${variable}");
        if name.contains(&variable) {
            let with = |name: &String| {
                values.split_whitespace().map(|value| name.replace(&variable, value)).collect()
            };
            names = names.iter().flat_map::<Vec<String>, _>(with).collect();
        }
    }
    names.retain(|name| !name.contains('$'));
    names
}
