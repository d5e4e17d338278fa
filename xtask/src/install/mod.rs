//! Installs the programs, their man pages and their completions.
//!
//! | folder below the prefix | contents |
//! | --- | --- |
//! | `bin` | the programs |
//! | `share/man/man1`, `man5`, `man7` | a page for each program, `unigrafix(5)`, `ugtools(7)` |
//! | `share/bash-completion/completions` | completions for bash |
//! | `share/zsh/site-functions` | completions for zsh |
//! | `share/fish/vendor_completions.d` | completions for fish |
//! | `share/doc/ugtools` | the pages of the documentation, and the record of what was installed |
//!
//! Pages are made from the definitions of the options, as the help is, and completions are scripts
//! that ask the program (`ugpipe::completions`). clap_mangen and clap_complete do not fit: both
//! write options with two dashes, the pages lack second names and join the lines of examples, and
//! the completions do not know where the three numbers of `-vel` end.

mod completions;
mod man;
mod markdown;
mod record;
mod roff;

use std::ffi::OsStr;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use ugpipe::{Manual, manual};
use ugtests::scenes;

use crate::programs;

use record::Record;

/// The files to install, and their places.
#[derive(clap::Args)]
pub struct Args {
    /// Folder in which bin and share are made, such as ~/.local
    #[arg(long, value_name = "DIR")]
    prefix: PathBuf,
    /// Folder of the programs [default: those of the release profile, built if need be]
    #[arg(long, value_name = "FOLDER")]
    programs: Option<PathBuf>,
}

/// The manuals of all programs.
fn manuals() -> [Manual; 11] {
    [
        manual::<uglorentz::Args>(),
        manual::<ugdoppler::Args>(),
        manual::<ugrainbow::Args>(),
        manual::<ugphoton::Args>(),
        manual::<ugwarp::Args>(),
        manual::<ugmesh::Args>(),
        manual::<ugparse::Args>(),
        manual::<ugsheet::Args>(),
        manual::<ugfilm::Args>(),
        manual::<ugdiagram::Args>(),
        manual::<ugconformance::Args>(),
    ]
}

/// The place of an installation that is removed.
#[derive(clap::Args)]
pub struct UninstallArgs {
    /// Folder with bin and share, as given to install
    #[arg(long, value_name = "DIR")]
    prefix: PathBuf,
}

/// Removes what was installed, and prints the name of every file.
pub fn remove(out: &mut impl Write, args: &UninstallArgs) -> io::Result<()> {
    record::remove(out, &args.prefix)
}

/// The content of a file to install.
enum Content {
    /// That of another file.
    Of(PathBuf),
    Text(String),
}

/// Installs everything, and prints the name of every file. `path`: the folders in which the shell
/// finds programs.
pub fn write(out: &mut impl Write, args: &Args, path: Option<&OsStr>) -> io::Result<()> {
    let Args { prefix, programs } = args;
    let programs = programs.clone().unwrap_or_else(programs::released);
    let mut files: Vec<(String, Content)> = manuals()
        .map(|manual| (format!("bin/{}", manual.name), Content::Of(programs.join(&manual.name))))
        .into();
    files.extend(
        documents().into_iter().map(|(name, text)| (format!("share/{name}"), Content::Text(text))),
    );
    files.extend(
        pages(scenes::root())?
            .into_iter()
            .map(|page| (format!("{PAGES}/{page}"), Content::Of(scenes::root().join(page)))),
    );
    let mut record = Record::read(prefix)?;
    files
        .iter()
        .map(|(name, _)| name.as_str())
        .chain([record::FILE])
        .for_each(|name| record.add(prefix, name));
    // First, so that an interrupted installation can be removed.
    files.insert(0, (record::FILE.to_owned(), Content::Text(record.text())));
    for (name, content) in &files {
        let file = prefix.join(name);
        replace(&file, |new| match content {
            Content::Of(other) => fs::copy(other, new).map(drop),
            Content::Text(text) => fs::write(new, text),
        })
        .map_err(|error| io::Error::new(error.kind(), format!("{}: {error}", file.display())))?;
        writeln!(out, "{}", file.display())?;
    }
    write!(out, "{}", path_note(&fs::canonicalize(prefix.join("bin"))?, path))
}

/// What to do so that the shell finds the programs in the folder `bin`; empty if it does.
fn path_note(bin: &Path, path: Option<&OsStr>) -> String {
    let is_bin = |folder: PathBuf| fs::canonicalize(folder).is_ok_and(|folder| folder == bin);
    if path.is_some_and(|path| std::env::split_paths(path).any(is_bin)) {
        return String::new();
    }
    let bin = bin.display();
    format!(
        "\nThe shell does not find the programs: {bin} is not in PATH. Add this line to ~/.profile\n\
         (for fish, run `fish_add_path {bin}` once), and log in again:\n\n    \
         export PATH=\"$PATH:{bin}\"\n"
    )
}

/// The folder of the pages of the documentation, below the prefix.
const PAGES: &str = "share/doc/ugtools";

/// The pages of the documentation with their pictures and all that they link to: paths in the
/// repository.
pub fn pages(root: &Path) -> io::Result<Vec<String>> {
    let mut pages: Vec<String> = [
        "CITATION.cff",
        "LICENSE",
        "LICENSE-APACHE",
        "LICENSE-MIT",
        "conformance/README.md",
        "conformance/renderer.py",
        "python/README.md",
        "web/README.md",
        "crates/ugrainbow/examples/in_memory.rs",
        "scenes/README.md",
    ]
    .map(str::to_owned)
    .into();
    for entry in fs::read_dir(root)? {
        let name = entry?.file_name().to_string_lossy().into_owned();
        pages.extend((name.ends_with(".md")).then_some(name));
    }
    let mut folders = vec!["docs".to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(root.join(&folder))? {
            let entry = entry?;
            let path = format!("{folder}/{}", entry.file_name().to_string_lossy());
            if entry.file_type()?.is_dir() { folders.push(path) } else { pages.push(path) }
        }
    }
    pages.sort();
    Ok(pages)
}

/// Man pages and completions: paths below `share`, and contents.
fn documents() -> Vec<(String, String)> {
    let manuals = manuals();
    let mut files = vec![
        ("man/man7/ugtools.7".to_owned(), man::overview(&manuals)),
        ("man/man5/unigrafix.5".to_owned(), man::language(&manuals[0].version)),
    ];
    for manual in &manuals {
        let name = &manual.name;
        files.extend([
            (format!("man/man1/{name}.1"), man::page(manual)),
            (format!("bash-completion/completions/{name}"), completions::bash(name)),
            (format!("zsh/site-functions/_{name}"), completions::zsh(name)),
            (format!("fish/vendor_completions.d/{name}.fish"), completions::fish(name)),
        ]);
    }
    files
}

/// Writes a file beside its place and renames it, so that a program that is running can be
/// replaced.
fn replace(file: &Path, write: impl FnOnce(&Path) -> io::Result<()>) -> io::Result<()> {
    let folder = file.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(folder)?;
    let new = tempfile::Builder::new().prefix(".ug-").tempdir_in(folder)?;
    let path = new.path().join("new");
    write(&path)?;
    fs::rename(path, file)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::os::unix::fs::PermissionsExt;
    use std::process::Command;
    use ugtests::tools::{self, BASH, FISH, MANDOC, ZSH};

    /// Writes the documents into a folder.
    fn folder() -> tempfile::TempDir {
        let folder = tempfile::tempdir().expect("a folder");
        for (name, text) in documents() {
            replace(&folder.path().join(name), |new| fs::write(new, &text)).expect("a file");
        }
        folder
    }

    /// Writes a program that completes one command line as the program of this name does.
    fn write_program(folder: &Path, line: &str) {
        let words: Vec<String> = line.split(' ').skip(1).map(str::to_owned).collect();
        let (name, asked) = line.split_once(' ').expect("a program and a word");
        let manual = manuals().into_iter().find(|manual| manual.name == name).expect("a program");
        let answer = ugpipe::completions(&manual, &words);
        let script = format!(
            "#!/bin/sh\n[ \"$*\" = '{} {asked}' ] || exit 1\ncat << 'END'\n{answer}END\n",
            ugpipe::COMPLETE
        );
        let program = folder.join("bin").join(name);
        replace(&program, |new| fs::write(new, &script)).expect("a file");
        fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).expect("a program");
    }

    /// The output of a script, in a folder with two files. `programs`: a folder with `bin`.
    fn printed(shell: &str, options: &[&str], programs: &Path, script: &str) -> String {
        let place = tempfile::tempdir().expect("a folder");
        fs::write(place.path().join("ship one.ug"), "").expect("a file");
        let path = std::env::var_os("PATH").unwrap_or_default();
        let path = [programs.join("bin")].into_iter().chain(std::env::split_paths(&path));
        let output = Command::new(shell)
            .args(options)
            .args(["-c", script])
            .current_dir(place.path())
            .env("HOME", place.path())
            .env("PATH", std::env::join_paths(path).expect("a path without colons"))
            .env("TERM", "dumb")
            .output()
            .expect("a shell");
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(errors.is_empty() && output.status.success(), "{shell}: {errors}");
        String::from_utf8(output.stdout).expect("text").trim_end().to_owned()
    }

    /// Command lines with a word to complete, and the completed lines; `None`: several words, among
    /// them the one given.
    const CASES: [(&str, &[&str]); 15] = [
        ("uglorentz -ve", &["-vel"]),
        ("uglorentz --keep", &["--keep-in-view"]),
        ("uglorentz -vel ", &[]),
        ("uglorentz -vel .9 0 ", &[]),
        ("uglorentz -vel -.9 ", &[]),
        ("uglorentz -vel .9 0 0 shi", &["ship one.ug"]),
        ("uglorentz -fi shi", &["ship one.ug"]),
        ("ugrainbow -va 40 shi", &["ship one.ug"]),
        ("ugrainbow -dt pd", &["pdf"]),
        ("ugrainbow --tone-curve ", &["clip", "filmic"]),
        ("ugparse tid", &["tidy"]),
        ("ugparse tidy shi", &["ship one.ug"]),
        ("ugparse example lat", &["lattice"]),
        ("ugconformance score-im", &["score-image"]),
        ("ugconformance table cam", &["cameras"]),
    ];

    /// Installs into a folder, with programs of some bytes; returns what was printed.
    fn installed(to: &Path) -> String {
        let from = tempfile::tempdir().expect("a folder");
        for manual in manuals() {
            fs::write(from.path().join(&manual.name), &manual.name).expect("a file");
        }
        let args = Args { prefix: to.to_owned(), programs: Some(from.path().to_owned()) };
        let path = std::env::join_paths([to.join("bin")]).expect("a path without colons");
        let mut listed = Vec::new();
        write(&mut listed, &args, Some(&path)).expect("everything is installed");
        String::from_utf8(listed).expect("text")
    }

    /// The files and folders below a folder.
    fn below(folder: &Path) -> Vec<PathBuf> {
        let entries =
            fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
        entries
            .flat_map(|path| {
                if path.is_dir() { [vec![path.clone()], below(&path)].concat() } else { vec![path] }
            })
            .collect()
    }

    #[test]
    fn programs_pages_and_completions_are_installed() {
        let to = tempfile::tempdir().expect("a folder");
        // The second time, everything is replaced.
        for _ in 0..2 {
            let listed = installed(to.path());
            let n_pages = pages(scenes::root()).expect("pages").len();
            assert!(n_pages > 60, "{n_pages}");
            assert_eq!(listed.lines().count(), 11 + 2 + 11 * 4 + n_pages + 1, "{listed}");
            assert!(listed.lines().all(|file| Path::new(file).is_file()), "{listed}");
        }
        assert_eq!(
            fs::read_to_string(to.path().join("bin/ugrainbow")).expect("a file"),
            "ugrainbow"
        );
        assert_eq!(below(&to.path().join("bin")).len(), 11);
    }

    /// Every link in an installed page leads to a file that is installed, too.
    #[test]
    fn links_of_installed_pages_hold() {
        let root = scenes::root();
        let pages = pages(root).expect("pages");
        let mut n_links = 0;
        for page in pages.iter().filter(|page| page.ends_with(".md")) {
            let text = fs::read_to_string(root.join(page)).expect("a page");
            let links =
                text.split("](").skip(1).filter_map(|rest| rest.split([')', '#', ' ']).next());
            for link in links.filter(|link| !link.is_empty() && !link.contains(':')) {
                let file = root.join(page).parent().expect("a folder").join(link);
                let file = fs::canonicalize(&file)
                    .unwrap_or_else(|error| panic!("{page}: {link}: {error}"));
                let root = fs::canonicalize(root).expect("a folder");
                let name = file
                    .strip_prefix(&root)
                    .expect("a file of the repository")
                    .display()
                    .to_string();
                assert!(pages.contains(&name) || file.is_dir(), "{page}: {link} is not installed");
                n_links += 1;
            }
        }
        assert!(n_links > 150, "{n_links}");
    }

    #[test]
    fn uninstalling_leaves_what_was_there() {
        let to = tempfile::tempdir().expect("a folder");
        let remove = || {
            let mut listed = Vec::new();
            remove(&mut listed, &UninstallArgs { prefix: to.path().to_owned() }).map(|()| listed)
        };
        let error = remove().expect_err("nothing is installed").to_string();
        assert!(
            error.starts_with("nothing was installed in ") && error.contains("installed.txt"),
            "{error}"
        );

        installed(to.path());
        installed(to.path());
        remove().expect("everything is removed");
        assert_eq!(below(to.path()), <[PathBuf; 0]>::default());

        // Files and folders of others stay, empty ones too.
        let theirs = ["bin", "bin/theirs", "share", "share/doc", "share/man", "share/man/man1"];
        for name in theirs {
            let path = to.path().join(name);
            if name.ends_with("theirs") { fs::write(path, "") } else { fs::create_dir(path) }
                .expect("written");
        }
        installed(to.path());
        let later = to.path().join("share/doc/ugtools/notes.txt");
        fs::write(&later, "").expect("a file");
        fs::remove_file(to.path().join("bin/ugwarp")).expect("a file");
        let listed = String::from_utf8(remove().expect("everything is removed")).expect("text");
        assert!(!listed.contains("bin/ugwarp\n") && listed.contains("bin/ugphoton\n"), "{listed}");
        let expected = theirs.map(|name| to.path().join(name)).into_iter();
        let mut expected: Vec<PathBuf> =
            expected.chain([later.clone(), later.parent().expect("a folder").to_owned()]).collect();
        let mut left = below(to.path());
        expected.sort();
        left.sort();
        assert_eq!(left, expected);
    }

    #[test]
    fn only_paths_below_the_prefix_are_removed() {
        let to = tempfile::tempdir().expect("a folder");
        for line in ["../outside", "/etc/none", "bin/../../outside", ""] {
            replace(&to.path().join(record::FILE), |new| {
                fs::write(new, format!("bin/a\n{line}\n"))
            })
            .expect("a file");
            let args = UninstallArgs { prefix: to.path().to_owned() };
            let error = remove(&mut Vec::new(), &args).expect_err("refused").to_string();
            assert!(error.ends_with("is not a path below the prefix"), "{error}");
        }
    }

    #[test]
    fn a_missing_path_is_told() {
        let bin = tempfile::tempdir().expect("a folder");
        let bin = fs::canonicalize(bin.path()).expect("a folder");
        let line = format!("export PATH=\"$PATH:{}\"", bin.display());
        for path in [None, Some("/usr/bin"), Some("")] {
            let note = path_note(&bin, path.map(OsStr::new));
            assert!(note.contains(&line), "{note}");
        }
        let path = format!("/usr/bin:{}/", bin.display());
        assert_eq!(path_note(&bin, Some(OsStr::new(&path))), "");
    }

    #[test]
    fn man_pages_pass_mandoc() {
        if !tools::has(&[MANDOC]) {
            return;
        }
        let folder = folder();
        let mut n_pages = 0;
        for (name, _) in documents().iter().filter(|(name, _)| name.starts_with("man/")) {
            let page = folder.path().join(name);
            let run = |options: &[&str]| {
                let output =
                    Command::new("mandoc").args(options).arg(&page).output().expect("mandoc");
                (output.status.success(), String::from_utf8(output.stdout).expect("text"))
            };
            assert_eq!(run(&["-T", "lint", "-W", "warning"]), (true, String::new()), "{name}");
            let (_, text) = run(&["-T", "html"]);
            assert!(text.contains("SEE_ALSO"), "{text}");
            assert!(text.contains("EXIT_STATUS") != name.ends_with(".5"), "{name}");
            n_pages += 1;
        }
        assert_eq!(n_pages, manuals().len() + 2);
    }

    /// The page of the scene language has all headings, tables and examples of the documentation.
    #[test]
    fn the_scene_language_has_a_page() {
        let page = man::language("1");
        let markdown = include_str!("../../../docs/unigrafix.md");
        let plain = |text: &str| text.replace('`', "").trim().replace('-', "\\-");
        let mut n_found = 0;
        for heading in markdown.lines().filter_map(|line| line.strip_prefix("## ")) {
            assert!(page.contains(&format!(".SS {}\n", plain(heading))), "{heading}");
            n_found += 1;
        }
        assert!(n_found > 15, "{n_found}");
        for text in [
            ".SH PART 3: WHAT IS NOT SUPPORTED\n",
            "v nose 3.5 0 0.2 red 1 0 0 ;\n",
            ".TP\n\\fB\\-ep x y z\\fR\neye point; default: the origin",
        ] {
            assert!(page.contains(text), "{text}: {page}");
        }
    }

    #[test]
    fn man_pages_have_every_option() {
        for manual in manuals() {
            let page = man::page(&manual)
                .replace("\\-", "-")
                .replace("\\(aq", "'")
                .replace("\\[u03B2]", "β");
            for name in manual.options().flat_map(|option| &option.names) {
                assert!(page.contains(&format!("\\fB{name}\\fR")), "{name}: {page}");
            }
            manual.examples.iter().for_each(|line| assert!(page.contains(line), "{line}"));
        }
    }

    #[test]
    fn bash_completes() {
        if !tools::has(&[BASH]) {
            return;
        }
        let folder = folder();
        for (line, expected) in CASES {
            write_program(folder.path(), line);
            let program = line.split(' ').next().unwrap_or_default();
            let file = folder.path().join("bash-completion/completions").join(program);
            let words: Vec<String> = line.split(' ').map(|word| format!("'{word}'")).collect();
            let script = format!(
                "compopt() {{ :; }}; source {}; COMP_WORDS=({}); COMP_CWORD={}; _{program}; \
                 ((${{#COMPREPLY[@]}} == 0)) || printf '%s\\n' \"${{COMPREPLY[@]}}\"",
                file.display(),
                words.join(" "),
                words.len() - 1
            );
            let found = printed("bash", &["--norc"], folder.path(), &script);
            assert_eq!(found.lines().collect::<Vec<_>>(), expected, "{line}");
        }
    }

    #[test]
    fn fish_completes() {
        if !tools::has(&[FISH]) {
            return;
        }
        let folder = folder();
        for (line, expected) in CASES {
            write_program(folder.path(), line);
            let program = line.split(' ').next().unwrap_or_default();
            let file = folder.path().join(format!("fish/vendor_completions.d/{program}.fish"));
            let script = format!("source {}; complete -C '{line}'", file.display());
            let found = printed("fish", &["--no-config"], folder.path(), &script);
            // Words, without their explanations; fish escapes the blank of the file.
            let found: Vec<String> = found
                .lines()
                .filter_map(|line| Some(line.split('\t').next()?.replace('\\', "")))
                .collect();
            assert_eq!(found, expected, "{line}");
        }
    }

    /// Types the lines into an interactive zsh, and has a key show what each has become.
    #[test]
    fn zsh_completes() {
        if !tools::has(&[ZSH]) {
            return;
        }
        let folder = folder();
        let completed = |line: &str| {
            let script = format!(
                "zmodload zsh/zpty; zpty shell zsh -f -i; \
                 zpty -w shell 'PS1=; KEYTIMEOUT=1; unsetopt beep; fpath=({} $fpath); autoload -Uz compinit; compinit -u -d dump; \
                 show() {{ print -r -- \"<$BUFFER>\" > shown; exit }}; zle -N show; bindkey \"^X\" show; touch ready'; \
                 until [[ -e ready ]]; do zpty -r -t shell drained; sleep .05; done; \
                 zpty -w -n shell $'{line}\\t\\x18'; \
                 until [[ -s shown ]]; do zpty -r -t shell drained; sleep .05; done; cat shown",
                folder.path().join("zsh/site-functions").display()
            );
            printed("zsh", &["-f"], folder.path(), &script)
        };
        for (line, expected) in CASES {
            write_program(folder.path(), line);
            let before = line.rsplit_once(' ').map_or("", |(before, _)| before);
            let whole = match expected {
                [word] => format!("<{before} {} >", word.replace(' ', "\\ ")),
                _ => format!("<{line}>"),
            };
            assert_eq!(completed(line), whole, "{line}");
        }
    }
}
