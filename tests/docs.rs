//! Runs every command in the documents, in a copy of `scenes/`.

use std::process::Command;

use ugtests::programs;
use ugtests::scenes::root;

/// Documents with commands for the folder `scenes/`, the section that contains them (empty for the
/// whole document), and the least number of commands.
const DOCUMENTS: [(&str, &str, usize); 3] =
    [("README.md", "## First steps", 5), ("README.md", "## How do I", 13), ("docs/gallery.md", "", 20)];

/// The commands in a section of a document.
struct Typed {
    /// Definitions of shell functions and variables, for all commands.
    definitions: String,
    /// Pipes of our programs, without comments.
    commands: Vec<String>,
}

impl Typed {
    fn read(document: &str, section: &str) -> Typed {
        let text = std::fs::read_to_string(root().join(document)).expect("the document is there");
        let start = text.find(section).expect("the section is there");
        let body = &text[start + section.len()..];
        let end = if section.is_empty() { body.len() } else { body.find("\n## ").unwrap_or(body.len()) };
        let mut typed = Typed { definitions: String::new(), commands: Vec::new() };
        for line in body[..end].lines().filter_map(|line| line.strip_prefix("    ")) {
            let name = line.trim_start_matches(|c: char| c.is_ascii_lowercase() || c == '_');
            if name.len() < line.len() && (name.starts_with("() {") || name.starts_with("='")) {
                typed.definitions.push_str(line);
                typed.definitions.push('\n');
                continue;
            }
            // In lists, commands are indented further.
            let line = line.trim_start();
            let tools = ["uglorentz ", "ugdoppler ", "ugrainbow ", "ugsheet ", "ugmesh ", "sed ", "for "];
            if tools.iter().any(|tool| line.starts_with(tool)) {
                typed.commands.push(line.split(" #").next().unwrap_or(line).trim_end().to_string());
            }
        }
        typed
    }
}

#[test]
fn commands_in_documents_work() {
    let scenes = tempfile::tempdir().expect("a temporary folder");
    for entry in std::fs::read_dir(root().join("scenes")).expect("scenes").flatten() {
        if entry.path().extension().is_some_and(|ending| ending == "ug") {
            std::fs::copy(entry.path(), scenes.path().join(entry.file_name())).expect("a copy");
        }
    }
    let programs = programs::of_this_profile();
    let path = std::env::var_os("PATH").unwrap_or_default();
    let path = std::env::join_paths(std::iter::once(programs).chain(std::env::split_paths(&path)));
    let path = path.expect("a path without colons");

    for (document, section, least) in DOCUMENTS {
        let Typed { definitions, commands } = Typed::read(document, section);
        assert!(commands.len() >= least, "{document}: {} commands", commands.len());
        for command in &commands {
            // Smaller pictures are sufficient, but they may not have the pixel of `--explain`.
            let has_size = command.contains("-sz ") || command.contains("--explain");
            let small =
                if has_size { command } else { &command.replace("ugrainbow", "ugrainbow -sz 160 120 -aa 1") };
            let output = Command::new("bash")
                .args(["-c", &format!("set -euo pipefail\n{definitions}{small}")])
                .current_dir(scenes.path())
                .env("PATH", &path)
                .output()
                .expect("bash runs");
            let talk = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success(), "{document}: {command}: {talk}");
            assert!(
                !talk.contains("nothing is drawn") && !talk.contains("is black"),
                "{document}: {command}: {talk}"
            );
            if let Some((_, file)) = command.split_once("> ").or_else(|| command.split_once("-fo ")) {
                let name = file.split([' ', ';']).next().expect("a file name");
                // A loop writes one file for each of its values.
                let names: Vec<String> = match loop_values(command) {
                    None => vec![name.to_string()],
                    Some((variable, values)) => values.map(|value| name.replace(&variable, value)).collect(),
                };
                for name in names {
                    let size = std::fs::metadata(scenes.path().join(&name)).map_or(0, |made| made.len());
                    assert!(size > 500, "{document}: {command}: {name} has {size} bytes");
                }
            }
        }
    }
}

/// `$VARIABLE` of `for VARIABLE in VALUES; …`, and the values.
fn loop_values(command: &str) -> Option<(String, impl Iterator<Item = &str>)> {
    let (variable, rest) = command.strip_prefix("for ")?.split_once(" in ")?;
    let (values, _) = rest.split_once(';')?;
    Some((format!("${variable}"), values.split_whitespace()))
}
