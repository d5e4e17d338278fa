//! Runs every command in the pages of the documentation, in a copy of `scenes/`.

use std::path::Path;
use std::process::{Command, Stdio};

use rayon::prelude::*;
use ugtests::documents::{Page, prepare, shrunk, transcripts, with_options, written_files};
use ugtests::{programs, tools};

/// Pages with commands for a folder with scenes, and the least number of commands.
const PAGES: [(&str, usize); 10] = [
    ("README.md", 18),
    ("docs/start.md", 9),
    ("docs/teaching.md", 12),
    ("docs/gallery.md", 60),
    ("docs/pipeline.md", 18),
    ("docs/meshes.md", 4),
    ("docs/film.md", 8),
    ("docs/batch.md", 3),
    ("docs/geometry.md", 1),
    ("docs/figures.md", 10),
];

#[test]
fn commands_in_documents_work() {
    let has_ffmpeg = tools::has(&[tools::FFMPEG]);
    PAGES.into_par_iter().for_each(|(path, least)| {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let programs = programs::folder();
        prepare(folder.path(), programs);
        let page = Page::read(path);
        assert!(page.commands.len() >= least, "{path}: {} commands", page.commands.len());
        let is_possible = |command: &&String| has_ffmpeg || !command.contains(".mp4");
        for command in page.commands.iter().filter(is_possible) {
            let small = shrunk(command);
            // An option is given once.
            let small = if small.contains(" -aa ") || small.contains(" -vec ") {
                small
            } else {
                with_options(&small, "-aa 1")
            };
            let messages = page
                .run(&small, folder.path(), programs)
                .unwrap_or_else(|message| panic!("{message}"));
            // Frames of a film may be empty, before a body comes; lines may be black.
            let is_drawn = command.starts_with("for ")
                || command.starts_with("ugfilm ")
                || command.contains("-lc 0")
                || !messages.contains("nothing is drawn") && !messages.contains("is black");
            assert!(is_drawn, "{path}: {command}: {messages}");
            // What is only printed writes no file.
            for file in written_files(command).into_iter().filter(|_| !command.contains("--print"))
            {
                let size =
                    std::fs::metadata(folder.path().join(&file)).map_or(0, |made| made.len());
                assert!(size > 300, "{path}: {command}: {} has {size} bytes", file.display());
            }
        }
    });
}

#[test]
fn programs_answer_as_the_pages_say() {
    if !tools::has(&[tools::SCRIPT]) {
        return;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let programs = programs::folder();
    prepare(folder.path(), programs);
    for (page, least) in [("docs/mistakes.md", 10), ("docs/teaching.md", 11)] {
        let transcripts = transcripts(page);
        assert!(transcripts.len() >= least, "{page}: {}", transcripts.len());
        for (command, answer) in transcripts {
            // For the bytes of a pixel the whole picture is drawn, unless its exposure is known.
            let typed_command = command.replace("--explain", "-ex 0 --explain");
            // Drawing may take more than a second, and then shows its progress on a terminal.
            let has_terminal = page == "docs/mistakes.md" && !command.contains("-sz ");
            assert_eq!(
                typed(&typed_command, folder.path(), programs, has_terminal),
                answer,
                "$ {command}"
            );
        }
    }
}

/// The output of a command, on a terminal or not, without white space at the ends of lines.
fn typed(command: &str, folder: &Path, programs: &Path, has_terminal: bool) -> String {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let path = std::env::join_paths(
        std::iter::once(programs.to_owned()).chain(std::env::split_paths(&path)),
    );
    let mut shell = if has_terminal { Command::new("script") } else { Command::new("bash") };
    if has_terminal {
        shell.args(["-qec", command, "/dev/null"]);
    } else {
        shell.args(["-c", &format!("{{ {command}; }} 2>&1")]);
    }
    shell
        .current_dir(folder)
        .env("PATH", path.expect("a path without colons"))
        .env("NO_COLOR", "1");
    let output = shell.stdin(Stdio::null()).output().expect("the shell runs");
    // `script` types the end of its empty input, which the terminal echoes.
    let text =
        String::from_utf8_lossy(&output.stdout).replace('\r', "").replace("^D\u{8}\u{8}", "");
    text.lines().map(|line| format!("{}\n", line.trim_end())).collect()
}
