//! The texts of `-h` and `--help`.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use ugpipe::remedies::program_with_option;
use ugpipe::{Manual, manual};
use ugtests::documents::{Page, prepare, shrunk, written_files};
use ugtests::{programs, scenes};

/// The manual of a program.
macro_rules! manuals {
    ($($program:ident),*) => { [$(manual::<$program::Args>()),*] };
}

/// Lines and columns of `-h`.
const SCREEN: [usize; 2] = [24, 100];

fn printed(folder: &Path, program: &str, option: &str) -> String {
    let mut words = program.split(' ');
    let name = words.next().unwrap();
    let output = Command::new(folder.join(name)).args(words).arg(option).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{program} {option}");
    assert!(output.stderr.is_empty(), "{program} {option}");
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn short_help_is_one_screenful() {
    let folder = programs::folder();
    for manual in manuals!(
        uglorentz, ugdoppler, ugrainbow, ugphoton, ugwarp, ugmesh, ugparse, ugsheet, ugfilm,
        ugdiagram
    ) {
        for part in manual.commands.iter().chain([&manual]) {
            let name = &part.name;
            let help = printed(folder, name, "-h");
            let lines = help.lines().count();
            let columns = help.lines().map(|line| line.chars().count()).max().unwrap();
            assert!(
                lines <= SCREEN[0] && columns <= SCREEN[1],
                "{name}: {lines} x {columns}\n{help}"
            );
            assert!(help.starts_with(&format!("{}\n", part.about)), "{help}");
            assert!(help.contains(&format!("\nUsage: {name} ")), "{help}");
            let options = help.lines().filter(|line| line.starts_with("  -"));
            assert!(options.count() >= 5, "{help}");
            assert!(help.ends_with(&format!(": {name} --help\n")), "{help}");
        }
        // Every name that a program calls essential is one of its options.
        let found: Vec<&str> =
            manual.essential_options().into_iter().map(|(name, _)| name).collect();
        assert_eq!(found, manual.essential, "{}", manual.name);
        assert!((5..=12).contains(&found.len()), "{found:?}");
    }
}

#[test]
fn help_has_everything_as_documented() {
    let folder = programs::folder();
    for manual in manuals!(
        uglorentz, ugdoppler, ugrainbow, ugphoton, ugwarp, ugmesh, ugparse, ugsheet, ugfilm,
        ugdiagram
    ) {
        for part in manual.commands.iter().chain([&manual]) {
            let help = printed(folder, &part.name, "--help");
            for heading in ["Usage", "Common options", "Exit status", "Documentation"] {
                assert!(help.contains(&format!("\n{heading}:")), "{heading}: {help}");
            }
            part.examples
                .iter()
                .for_each(|line| assert!(help.contains(&format!("\n  {line}\n")), "{help}"));
            let mut n_options = 0;
            for option in part.options() {
                let line = format!("  {} {}", option.names.join(", "), option.syntax());
                assert!(help.lines().any(|other| other == line.trim_end()), "{line}: {help}");
                n_options += 1;
            }
            assert!(n_options >= 12, "{}: {n_options}", part.name);
            // One dash before the short names, and no name that does not exist.
            let is_option = |line: &&str| line.starts_with("  -");
            for line in help.lines().filter(is_option) {
                let first = line.trim_start().split([' ', ',']).next().unwrap();
                let is_short = first.trim_start_matches('-').len() <= 4
                    && !["--help", "--all"].contains(&first);
                assert_eq!(first.starts_with("--"), !is_short, "{first}: {help}");
            }
            let words = help.lines().filter(is_option).flat_map(|line| line.split(' '));
            for name in
                words.filter(|word| word.starts_with('-')).map(|word| word.trim_end_matches(','))
            {
                assert!(
                    part.options().any(|option| option.names.iter().any(|other| other == name)),
                    "{name}"
                );
            }
        }
    }
}

/// Every name of an option is accepted as it is printed: with an invalid neighbour, the message is
/// about the neighbour.
#[test]
fn names_in_help_are_accepted() {
    let folder = programs::folder();
    for manual in manuals!(
        uglorentz, ugdoppler, ugrainbow, ugphoton, ugwarp, ugmesh, ugparse, ugsheet, ugfilm,
        ugdiagram
    ) {
        for option in manual.options() {
            for name in option
                .names
                .iter()
                .filter(|name| !["-h", "--help", "-V", "--version"].contains(&name.as_str()))
            {
                let mut command = Command::new(folder.join(&manual.name));
                command.arg(name);
                // A value that is missing is an error that names the option; a flag is accepted,
                // and then the file is missing.
                let flag = option.values.is_empty() || option.values[0].is_optional;
                let output = command.args(flag.then_some("no-such-file")).output().unwrap();
                let message = String::from_utf8(output.stderr).unwrap();
                let is_known = if flag {
                    !message.contains("there is no option")
                } else {
                    message.contains("needs a value") || message.contains("values, not")
                };
                assert!(is_known && output.status.code() != Some(0), "{name}: {message}");
            }
        }
    }
}

/// "`-vel` is an option of uglorentz": each name of an option, behind the first program whose short
/// help has it, or else that has it at all.
#[test]
fn remedies_know_the_options_of_all_programs() {
    let manuals = manuals!(
        uglorentz, ugdoppler, ugrainbow, ugphoton, ugwarp, ugmesh, ugparse, ugsheet, ugdiagram
    );
    let mut owners: BTreeMap<String, usize> = BTreeMap::new();
    for is_in_short_help in [true, false] {
        for (row, manual) in manuals.iter().enumerate() {
            for option in manual.options().filter(|option| !option.is_common) {
                let is_essential = option.names.iter().any(|name| manual.essential.contains(name));
                if is_essential || !is_in_short_help {
                    for name in &option.names {
                        owners.entry(name.trim_start_matches('-').to_owned()).or_insert(row);
                    }
                }
            }
        }
    }
    let line = |(row, manual): (usize, &Manual)| {
        let names =
            owners.iter().filter(|(_, owner)| **owner == row).map(|(name, _)| name.as_str());
        format!("{}: {}\n", manual.name, names.collect::<Vec<_>>().join(" "))
    };
    let expected: String = manuals.iter().enumerate().map(line).collect();
    let path = scenes::root().join("crates/ugpipe/src/options_of_programs.txt");
    if std::env::var_os("UG_BLESS").is_some() {
        std::fs::write(&path, &expected).unwrap();
    }
    let recorded = std::fs::read_to_string(&path).unwrap();
    assert!(
        recorded == expected,
        "write options_of_programs.txt anew, with UG_BLESS=1:\n{expected}"
    );
    for (name, program) in
        [("vel", "uglorentz"), ("gw", "ugdoppler"), ("sz", "ugrainbow"), ("rd", "ugphoton")]
    {
        assert_eq!(program_with_option(name), Some(program), "{name}");
    }
    assert_eq!(program_with_option("no-such-option"), None);
}

#[test]
fn examples_in_help_work() {
    let folder = tempfile::tempdir().unwrap();
    let programs = programs::folder();
    prepare(folder.path(), programs);
    let pictures = Page::of_commands("pictures", &[
        "ugrainbow -sz 90 60 ship.ug -fo rest.png; for name in fast 0.5c 0.9c 0.99c; do cp rest.png $name.png; done; \
         ugrainbow -vec -sz 90 60 ship.ug -fo rest.pdf; cp rest.pdf fast.pdf; \
         for y in 0 8; do ugphoton -sz 16 16 -crop 0 $y 16 8 ship.ug > tile_$y.png; done; \
         for file in film.gif frame_%04d.png; do ugfilm -frames 2 -sz 16 16 ship.ug -fo $file; done".to_owned(),
    ]);
    pictures.run(&pictures.commands[0], folder.path(), programs).unwrap();
    for manual in manuals!(
        uglorentz, ugdoppler, ugrainbow, ugphoton, ugwarp, ugmesh, ugparse, ugsheet, ugfilm,
        ugdiagram
    ) {
        let page = Page::of_commands("--help", &manual.examples);
        assert!(page.commands.len() >= 2, "{}", manual.name);
        for command in &page.commands {
            let messages = page
                .run(&shrunk(command), folder.path(), programs)
                .unwrap_or_else(|message| panic!("{message}"));
            // The first frame of a film may be empty, before a body comes.
            let is_drawn = command.starts_with("ugfilm ")
                || !messages.contains("nothing is drawn") && !messages.contains("is black");
            assert!(is_drawn, "{command}: {messages}");
            for file in written_files(command) {
                let size =
                    std::fs::metadata(folder.path().join(&file)).map_or(0, |made| made.len());
                assert!(size > 300, "{command}: {} has {size} bytes", file.display());
            }
        }
    }
}

/// A shell asks for completions: options with their meaning, and a slash where files are meant.
#[test]
fn programs_complete_command_lines() {
    let folder = programs::folder();
    let completed = |program: &str, words: &[&str]| {
        let output =
            Command::new(folder.join(program)).arg("--complete").args(words).output().unwrap();
        assert!(output.status.success() && output.stderr.is_empty());
        String::from_utf8(output.stdout).unwrap()
    };
    assert_eq!(completed("uglorentz", &["-ve"]), "-vel\tVelocity of all objects, fraction of c\n");
    assert_eq!(completed("uglorentz", &["-vel", "-.9", ""]), "");
    assert_eq!(completed("uglorentz", &["-vel", "-.9", "0", "0", ""]), "/\n");
    assert!(completed("ugparse", &["ti"]).starts_with("tidy\t"));
}
