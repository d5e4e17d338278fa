//! Installs the programs, their man pages and their completions.
//!
//! | folder below the prefix | contents |
//! | --- | --- |
//! | `bin` | the programs |
//! | `share/man/man1`, `man7` | a page for each program, and `ugtools(7)`, the overview |
//! | `share/bash-completion/completions` | completions for bash |
//! | `share/zsh/site-functions` | completions for zsh |
//! | `share/fish/vendor_completions.d` | completions for fish |
//!
//! Pages and completions are made from the definitions of the options, as the help is. clap_mangen
//! and clap_complete do not fit: both write options with two dashes, the pages lack second names
//! and join the lines of examples, and the completions do not know where the three numbers of
//! `-vel` end.

mod completions;
mod man;

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use ugpipe::Manual;
use ugtests::programs;

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
fn manuals() -> [Manual; 10] {
    [
        uglorentz::manual(),
        ugdoppler::manual(),
        ugrainbow::manual(),
        ugphoton::manual(),
        ugwarp::manual(),
        ugmesh::manual(),
        ugparse::manual(),
        ugsheet::manual(),
        ugfilm::manual(),
        ugconformance::manual(),
    ]
}

/// Installs everything, and prints the name of every file.
pub fn write(out: &mut impl Write, args: &Args) -> io::Result<()> {
    let programs = args.programs.clone().unwrap_or_else(programs::released);
    for manual in manuals() {
        let file = args.prefix.join("bin").join(&manual.name);
        replace(&file, |new| fs::copy(programs.join(&manual.name), new).map(drop))?;
        writeln!(out, "{}", file.display())?;
    }
    for (name, text) in documents() {
        let file = args.prefix.join("share").join(name);
        replace(&file, |new| fs::write(new, &text))?;
        writeln!(out, "{}", file.display())?;
    }
    Ok(())
}

/// Man pages and completions: paths below `share`, and contents.
fn documents() -> Vec<(String, String)> {
    let manuals = manuals();
    let mut files = vec![("man/man7/ugtools.7".to_owned(), man::overview(&manuals))];
    for manual in &manuals {
        let name = &manual.name;
        files.extend([
            (format!("man/man1/{name}.1"), man::page(manual)),
            (format!("bash-completion/completions/{name}"), completions::bash(manual)),
            (format!("zsh/site-functions/_{name}"), completions::zsh(manual)),
            (format!("fish/vendor_completions.d/{name}.fish"), completions::fish(manual)),
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

    /// The output of a script, in a folder with two files.
    fn printed(shell: &str, options: &[&str], script: &str) -> String {
        let place = tempfile::tempdir().expect("a folder");
        fs::write(place.path().join("ship one.ug"), "").expect("a file");
        let output = Command::new(shell)
            .args(options)
            .args(["-c", script])
            .current_dir(place.path())
            .env("HOME", place.path())
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

    #[test]
    fn programs_pages_and_completions_are_installed() {
        let (from, to) = (tempfile::tempdir().expect("a folder"), tempfile::tempdir().expect("a folder"));
        for manual in manuals() {
            fs::write(from.path().join(&manual.name), &manual.name).expect("a file");
        }
        let args = Args { prefix: to.path().to_owned(), programs: Some(from.path().to_owned()) };
        // The second time, everything is replaced.
        for _ in 0..2 {
            let mut listed = Vec::new();
            write(&mut listed, &args).expect("everything is installed");
            let listed = String::from_utf8(listed).expect("text");
            assert_eq!(listed.lines().count(), 10 + 1 + 10 * 4, "{listed}");
            assert!(listed.lines().all(|file| Path::new(file).is_file()), "{listed}");
        }
        assert_eq!(fs::read_to_string(to.path().join("bin/ugrainbow")).expect("a file"), "ugrainbow");
        let left = fs::read_dir(to.path().join("bin")).expect("a folder").count();
        assert_eq!(left, 10);
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
                let output = Command::new("mandoc").args(options).arg(&page).output().expect("mandoc");
                (output.status.success(), String::from_utf8(output.stdout).expect("text"))
            };
            assert_eq!(run(&["-T", "lint", "-W", "warning"]), (true, String::new()), "{name}");
            let (_, text) = run(&["-T", "html"]);
            assert!(text.contains("EXIT_STATUS") && text.contains("SEE_ALSO"), "{text}");
            n_pages += 1;
        }
        assert_eq!(n_pages, manuals().len() + 1);
    }

    #[test]
    fn man_pages_have_every_option() {
        for manual in manuals() {
            let page = man::page(&manual).replace("\\-", "-").replace("\\(aq", "'").replace("\\[u03B2]", "β");
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
            let found = printed("bash", &["--norc"], &script);
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
            let program = line.split(' ').next().unwrap_or_default();
            let file = folder.path().join(format!("fish/vendor_completions.d/{program}.fish"));
            let script = format!("source {}; complete -C '{line}'", file.display());
            let found = printed("fish", &["--no-config"], &script);
            // Words, without their explanations; fish escapes the blank of the file.
            let found: Vec<String> =
                found.lines().filter_map(|line| Some(line.split('\t').next()?.replace('\\', ""))).collect();
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
                 zpty -w shell 'PS1=; unsetopt beep; fpath=({} $fpath); autoload -Uz compinit; compinit -u -D; \
                 show() {{ print -r -- \"<$BUFFER>\" > shown; exit }}; zle -N show; bindkey \"^X\" show; touch ready'; \
                 until [[ -e ready ]]; do zpty -r -t shell drained; sleep .05; done; \
                 zpty -w -n shell $'{line}\\t\\x18'; \
                 until [[ -s shown ]]; do zpty -r -t shell drained; sleep .05; done; cat shown",
                folder.path().join("zsh/site-functions").display()
            );
            printed("zsh", &["-f"], &script)
        };
        for (line, expected) in CASES {
            let before = line.rsplit_once(' ').map_or("", |(before, _)| before);
            let whole = match expected {
                [word] => format!("<{before} {} >", word.replace(' ', "\\ ")),
                _ => format!("<{line}>"),
            };
            assert_eq!(completed(line), whole, "{line}");
        }
    }
}
