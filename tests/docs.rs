//! Runs every command in the pages of the documentation, in the folders that the pages name.

use std::collections::BTreeSet;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::{Command, Stdio};

use rayon::prelude::*;
use tempfile::TempDir;
use ugtests::documents::{Page, fill, shrunk, transcripts, with_options, written_files};
use ugtests::{programs, scenes, tools, tracked};

/// Pages with commands, the folder that they name, and the least number of commands.
const PAGES: [(&str, Folder, usize); 15] = [
    ("README.md", Folder::Examples, 18),
    ("docs/start.md", Folder::Empty, 9),
    ("docs/teaching.md", Folder::Examples, 12),
    ("docs/concepts.md", Folder::Examples, 12),
    ("docs/gallery.md", Folder::Examples, 60),
    ("docs/pipeline.md", Folder::Examples, 30),
    ("docs/meshes.md", Folder::Examples, 7),
    ("docs/film.md", Folder::Examples, 14),
    ("docs/batch.md", Folder::Examples, 3),
    ("docs/geometry.md", Folder::Examples, 1),
    ("docs/figures.md", Folder::Examples, 12),
    ("docs/motion.md", Folder::Examples, 20),
    ("docs/diagram.md", Folder::Examples, 4),
    ("docs/security.md", Folder::Examples, 1),
    ("scenes/README.md", Folder::Repository, 1),
];

/// The folder in which the reader of a page types its commands.
#[derive(Clone, Copy)]
enum Folder {
    Empty,
    /// Filled by `ugparse example --all`.
    Examples,
    /// The one of the repository, which has `scenes/`.
    Repository,
}

impl Folder {
    fn make(self, programs: &Path) -> TempDir {
        let folder = tempfile::tempdir().expect("a temporary folder");
        match self {
            Self::Empty => {}
            Self::Examples => fill(folder.path(), programs),
            Self::Repository => {
                symlink(scenes::root().join("scenes"), folder.path().join("scenes"))
                    .expect("a link");
            }
        }
        folder
    }
}

/// Beginnings of commands that are not run here, each with its page, and with what runs it or why
/// nothing does.
const RUN_ELSEWHERE: [(&str, &str, &str); 24] = [
    ("python3 -c", "crates/ugimage/font/README.md", "it made the font once"),
    ("$ ", "docs/mistakes.md", "programs_answer_as_the_pages_say"),
    ("$ ", "docs/teaching.md", "programs_answer_as_the_pages_say"),
    ("$ ", "docs/concepts.md", "programs_answer_as_the_pages_say"),
    ("$ ", "README.md", ".ci/run runs the first two, tests of xtask install"),
    ("cargo test", "CONTRIBUTING.md", ".ci/run"),
    (".ci/run", "CONTRIBUTING.md", "itself"),
    ("cargo xtask bench", "docs/performance.md", "it measures for minutes"),
    ("cargo xtask page", "web/README.md", "it needs another compiler"),
    ("cargo xtask install", "conformance/README.md", "tests of xtask"),
    ("ugconformance", "conformance/README.md", "tests of ugconformance"),
    ("pip install", "python/README.md", "cargo xtask python"),
    ("python3 -m venv", "docs/batch.md", "cargo xtask cluster"),
    ("snakemake", "docs/batch.md", "cargo xtask cluster"),
    ("batch/one-machine.sh", "docs/batch.md", "cargo xtask cluster"),
    ("exec ugfilm", "docs/batch.md", "cargo xtask cluster"),
    ("export", "docs/batch.md", "cargo xtask cluster"),
    ("seq", "docs/batch.md", "it needs GNU parallel and draws in full size"),
    ("parallel", "docs/batch.md", "it needs GNU parallel and draws in full size"),
    ("set -eu", "docs/batch.md", "cargo xtask cluster"),
    ("job=", "docs/security.md", "it needs bubblewrap and installed programs"),
    ("cp upload.ug", "docs/security.md", "it needs bubblewrap and installed programs"),
    ("timeout", "docs/security.md", "it needs bubblewrap and installed programs"),
    ("bash -o", "docs/security.md", "it needs bubblewrap and installed programs"),
];

/// Every line of code that begins like a command is run here, or listed with what runs it.
#[test]
fn no_command_of_a_page_is_forgotten() {
    const FIRST_WORDS: [&str; 30] = [
        "ug",
        "for ",
        "sed ",
        "$ ",
        "cargo ",
        ".ci/",
        "pip ",
        "python",
        "snakemake ",
        "batch/",
        "scenes/",
        "exec ",
        "export ",
        "seq ",
        "parallel ",
        "set ",
        "job=",
        "cp ",
        "timeout ",
        "bash ",
        "sh ",
        "cat ",
        "echo ",
        "printf ",
        "mkdir ",
        "man ",
        "npm ",
        "docker ",
        "curl ",
        "apt",
    ];
    let mut n_found = 0;
    let mut forgotten = Vec::new();
    let mut used = BTreeSet::new();
    for path in tracked::files() {
        let path = path.strip_prefix(scenes::root()).expect("a file of the repository");
        let is_page = path.extension().is_some_and(|ending| ending == "md");
        let name = path.to_str().expect("a name in UTF-8");
        // What changed, what is built how, and cases of fuzzing are not for readers who type.
        if !is_page || ["CHANGELOG.md", "STYLE.md", "ARCHITECTURE.md"].contains(&name) {
            continue;
        }
        let page = Page::read(name);
        let is_run = PAGES.iter().any(|(path, ..)| *path == name);
        let commands = page.commands.iter().filter(|_| is_run);
        let lines: Vec<&str> = commands.flat_map(|command| command.lines()).collect();
        // Between fences is code in other languages.
        let parts = page.text.split("```").step_by(2);
        let code = parts.flat_map(str::lines).filter_map(|line| line.strip_prefix("    "));
        for line in code {
            let line = line.trim_start();
            let code = line.split(" #").next().unwrap_or(line).trim_end();
            // A program's message is no command.
            let is_message = line.split(' ').next().is_some_and(|word| word.ends_with(':'));
            if is_message || !FIRST_WORDS.iter().any(|word| line.starts_with(word)) {
                continue;
            }
            n_found += 1;
            let elsewhere = RUN_ELSEWHERE
                .iter()
                .position(|(word, page, _)| *page == name && line.starts_with(word));
            used.extend(elsewhere);
            if !lines.contains(&code) && elsewhere.is_none() {
                forgotten.push(format!("{name}: {line}"));
            }
        }
    }
    assert!(forgotten.is_empty(), "run these in PAGES, or name what does: {forgotten:#?}");
    assert!(n_found > 300, "{n_found}");
    assert_eq!(used.len(), RUN_ELSEWHERE.len(), "an entry of RUN_ELSEWHERE is of no page");
}

#[test]
fn commands_in_documents_work() {
    let has_ffmpeg = tools::has(&[tools::FFMPEG]);
    PAGES.into_par_iter().for_each(|(path, folder, least)| {
        let programs = programs::folder();
        let folder = folder.make(programs);
        let page = Page::read(path);
        assert!(page.commands.len() >= least, "{path}: {} commands", page.commands.len());
        let is_possible = |command: &&String| has_ffmpeg || !command.contains(".mp4");
        for command in page.commands.iter().filter(is_possible) {
            let small = shrunk(command);
            // An option is given once; vectors and diagrams have no samples.
            let has_samples =
                [" -aa ", " -vec ", "ugdiagram "].iter().all(|word| !small.contains(word));
            let small = if !has_samples { small } else { with_options(&small, "-aa 1") };
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

/// Pictures of the sizes that a page gives fit on its sheets without being scaled.
#[test]
fn sheets_of_the_pages_keep_the_pixels_of_their_pictures() {
    let programs = programs::folder();
    let folder = Folder::Examples.make(programs);
    let page = Page::read("docs/figures.md");
    let mut n_sheets = 0;
    for command in &page.commands {
        let size = command.split_once("-sz ").map(|(_, rest)| rest.splitn(3, ' '));
        let size: Vec<&str> = size.into_iter().flatten().take(2).collect();
        if command.contains("ugsheet -") && !command.contains(".gif") {
            let messages = page.run(command, folder.path(), programs).expect("a sheet");
            assert!(!messages.contains("scaled"), "{command}: {messages}");
            n_sheets += 1;
        } else if size.len() == 2 && size.iter().all(|side| side.ends_with("cm")) {
            for file in written_files(command) {
                let [size, file] = [size.join(" "), file.display().to_string()];
                let draw = format!("ugrainbow -qt -aa 1 -sz {size} -fo {file} die.ug");
                page.run(&draw, folder.path(), programs).expect("a picture");
            }
        }
    }
    assert!(n_sheets >= 3, "{n_sheets}");
}

#[test]
fn programs_answer_as_the_pages_say() {
    if !tools::has(&[tools::SCRIPT]) {
        return;
    }
    let programs = programs::folder();
    let folder = Folder::Examples.make(programs);
    for (page, least) in
        [("docs/mistakes.md", 10), ("docs/teaching.md", 11), ("docs/concepts.md", 8)]
    {
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
