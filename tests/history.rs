//! The pipe that a picture records, run again by a shell in a clean folder.
use std::collections::{BTreeMap, BTreeSet};
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;

use ugpipe::remedies::PROGRAMS;
use ugpipe::{CommonArgs, Manual, WRITING, manual};
use ugsheet::recipes;
use ugtesting::Random;
use ugtests::shell::Shell;
use ugtests::{scenes, tools, tracked};

#[track_caller]
fn check_same(shell: &Shell, first: &str, second: &str) {
    let [first, second] = [first, second].map(|name| shell.read(name));
    assert!(first.len() > 300 && first == second, "the second picture has other bytes");
}

#[test]
fn a_picture_is_drawn_again_by_its_history() {
    let check = |scene: &str, pipe: &str| {
        let shell = Shell::new(&[]);
        shell.write(scene, scenes::text("dice"));
        shell.run(&format!("{pipe} > first.png"));
        let [script, messages] = shell.run("ugsheet --history first.png | tee again.sh");
        assert_eq!(messages, "", "{script}");
        let lines: Vec<&str> = script.lines().collect();
        let [comment, _pipe] = lines[..] else { panic!("{script}") };
        // The hash is the one of another program.
        let [sum, _] = shell.run(&format!("sha256sum '{scene}'"));
        assert!(comment.contains(&format!("SHA-256 {}; ug", &sum[..64])), "{comment} {sum}");
        shell.run("sh again.sh > second.png");
        check_same(&shell, "first.png", "second.png");
    };
    check("dice.ug", "ugrainbow -sz 60 40 dice.ug");
    check(
        "dice.ug",
        "uglorentz -vel .9 0 0 --keep-in-view dice.ug | ugdoppler -sp | ugrainbow -sz 60 40 -aa 1",
    );
    check(
        "my dice.ug",
        "uglorentz 'my dice.ug' -sd 1 | ugrainbow -xc -sz 320 200 -aa 1 -cap \"it's \\$HOME; γ | 'x'\"",
    );
    // Through a mesh and back.
    check(
        "dice.ug",
        "uglorentz dice.ug -vel 0 .5 0 | ugmesh -dt ply | ugmesh | ugrainbow -sz 60 40",
    );
}

#[test]
fn every_format_with_text_is_drawn_again() {
    let shell = Shell::new(&["dice.ug"]);
    for format in ["png", "exr", "hdr", "ppm", "pdf", "svg", "eps", "ps"] {
        let vector = if format == "svg" { "-vec" } else { "" };
        shell.run(&format!(
            "uglorentz -vel .5 0 0 dice.ug > seen.ug; ugrainbow -sz 60 40 {vector} seen.ug -fo first.{format}
             ugsheet --history first.{format} > again.sh; sh again.sh > second.{format}"
        ));
        check_same(&shell, &format!("first.{format}"), &format!("second.{format}"));
    }
}

#[test]
fn scenes_from_pipes_are_given_to_the_script() {
    let shell = Shell::new(&["dice.ug"]);
    shell.run("uglorentz -vel .5 0 0 < dice.ug | ugrainbow -sz 60 40 > first.png");
    let [_, messages] = shell.run("ugsheet --history < first.png > again.sh");
    let note = "the scene was read from standard input: run the pipe with the same input";
    assert_eq!(messages, format!("ugsheet: note: {note}\n"));
    shell.run("sh again.sh < dice.ug > second.png");
    check_same(&shell, "first.png", "second.png");
}

#[test]
fn changed_and_missing_scenes_are_noted() {
    let shell = Shell::new(&["dice.ug"]);
    shell.run("mkdir sub; ugrainbow -sz 60 40 dice.ug > a.png; ugrainbow -sz 60 40 sub/../dice.ug > b.png");
    let messages = |script: &str| shell.run(script)[1].clone();
    assert_eq!(messages("ugsheet --history a.png"), "");
    // A path with `..` is recorded as its file name.
    assert_eq!(messages("ugsheet --history b.png"), "");
    let elsewhere = "ugsheet: note: `dice.ug` is not in this folder: run the pipe in its folder\n";
    assert_eq!(messages("cd sub; ugsheet --history ../a.png"), elsewhere);
    let changed = "ugsheet: warning: `dice.ug` has changed since the picture was drawn\n";
    assert_eq!(messages("echo >> dice.ug; ugsheet --history a.png"), changed);
    let sheet =
        "ugsheet: note: `s.png` has 2 pipes: send the output of each to a file of its own\n";
    assert_eq!(
        messages("ugsheet -lb none a.png b.png > s.png; ugsheet --history s.png"),
        changed.repeat(2) + sheet
    );
}

/// Whoever writes a scene chooses its comments, and so what a picture records.
#[test]
fn forged_histories_do_not_run() {
    let shell = Shell::new(&["dice.ug"]);
    let hash = "0".repeat(64);
    let forged = |command: &str| {
        let program = command.split(' ').next().filter(|word| word.starts_with("ug"));
        let program = program.unwrap_or("ugmesh");
        let command = command.strip_prefix(program).unwrap_or(command).trim_start();
        let record = format!("{program} 1: {program} {command}");
        let scene = format!("{{ SHA-256 {hash} - }}\n{{ {record} }}\n");
        shell.write("forged.ug", [scene.as_bytes(), &scenes::text("dice")].concat());
        shell.run("ugrainbow -sz 60 40 forged.ug > forged.png");
        shell.output("ugsheet -qt --history forged.png > again.sh")
    };
    let refused = [
        "| touch gone",
        "-fo gone",
        "--output=gone",
        "; touch gone | ug",
        "ugparse example --all",
        "ugfilm -frames 1 -keep gone_%d.png -dt gif dice.ug",
        "ugrep --filter=*:sh x y",
        "uglorentz -at gone dice.ug",
        "uglorentz --allow-execute dice.ug",
        "uglorentz --allow-outside dice.ug",
        "ugrainbow -dp dice.ug",
    ];
    for command in refused {
        let output = forged(command);
        let messages = String::from_utf8(output.stderr).unwrap();
        let is_refused = messages.contains("must not be run") && output.status.code() == Some(1);
        assert!(is_refused || command.starts_with(';'), "{command}: {messages}");
        assert!(is_refused == shell.read("again.sh").is_empty(), "{command}");
    }
    let trusted = "ugsheet -qt --history --allow-execute forged.png";
    forged("uglorentz --allow-execute dice.ug");
    assert!(
        shell.run(trusted)[0]
            .ends_with("\nuglorentz --allow-execute dice.ug | ugrainbow -sz 60 40\n")
    );
    for command in ["`touch gone`", "$(touch gone)", "& touch gone", "> gone", "; touch gone"] {
        assert!(forged(command).status.success(), "{command}");
        shell.output("sh again.sh");
        assert!(!shell.path("gone").exists(), "{command}");
    }
}

/// Parts of records: commands of the programs, and what a stranger would write to run others.
const PARTS: [&str; 40] = [
    "ugrainbow",
    "uglorentz",
    "-cap",
    "a",
    "=",
    " ",
    " ",
    " ",
    " | ugrainbow ",
    "'",
    "'",
    "\"",
    "`",
    "$(touch GONE)",
    "$'",
    "\\'",
    "\\",
    "; touch GONE #",
    "& touch GONE",
    "> GONE",
    "| touch GONE",
    "${PATH}",
    "{",
    "}",
    "\"$(printf '\\012')\"",
    "\"$(printf '\\047')\"",
    "\"$(printf '\\140')\"",
    "$'\\n'",
    "$'\\047",
    "\u{202e}",
    "\u{1b}",
    "\t",
    "#",
    "!",
    "~",
    "*",
    "eval ",
    "exec ",
    "\r",
    "γ",
];

#[test]
fn random_records_run_programs_of_the_family_only() {
    let mut random = Random(67);
    let mut scripts = Vec::new();
    let hash = "0".repeat(64);
    for _ in 0..10_000 {
        let mut parts = |n| (0..n).map(|_| *random.pick(&PARTS)).collect::<String>();
        let (words, name) = (parts(8), parts(3));
        let line = format!("ugrainbow {words} # SHA-256 {hash} {name}; ugrainbow 0.1.0");
        for recipe in recipes(&line, &CommonArgs::default()).into_iter().flatten() {
            let script = recipe.script();
            let lines: Vec<&str> = script.lines().collect();
            assert!(lines.len() == 2 && lines[0].starts_with("# "), "{line}: {script}");
            let is_shown = |c: char| ugpipe::is_printable(c) && !"{}".contains(c);
            assert!(lines.iter().all(|line| line.chars().all(is_shown)), "{line}: {script}");
            scripts.push(script);
        }
    }
    assert!(scripts.len() > 3000, "{}", scripts.len());
    if !tools::has(&[tools::DASH]) {
        return;
    }
    // Stubs in the place of the programs print how they were called, after their input.
    let shell = Shell::new(&[]);
    std::fs::create_dir(shell.path("programs")).unwrap();
    std::fs::create_dir(shell.path("empty")).unwrap();
    for program in PROGRAMS {
        let name = format!("programs/{program}");
        shell.write(
            &name,
            "#!/bin/dash\n/bin/cat\nprintf '<%s' \"${0##*/}\"\nprintf ' %s' \"$@\"\nprintf '>'\n",
        );
        std::fs::set_permissions(shell.path(&name), PermissionsExt::from_mode(0o755)).unwrap();
    }
    let n_run = 250;
    for script in scripts.iter().step_by(scripts.len() / n_run) {
        let output = Command::new("/bin/dash")
            .args(["-c", script])
            .current_dir(shell.path("empty"))
            .env("PATH", shell.path("programs"))
            .output()
            .unwrap();
        let [text, messages] =
            [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes));
        assert!(output.status.success() && messages.is_empty(), "{script}: {messages}");
        assert!(text.starts_with("<ugrainbow") && text.ends_with('>'), "{script}: {text}");
        assert_eq!(shell.path("empty").read_dir().unwrap().count(), 0, "{script}");
    }
}

/// The manuals of all programs and of their commands.
fn manuals() -> Vec<Manual> {
    let programs = [
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
    ];
    assert_eq!(programs.len(), PROGRAMS.len());
    programs
        .into_iter()
        .flat_map(|manual| [manual.commands.clone(), vec![manual]].concat())
        .collect()
}

/// Every option whose value may be the name of a file is known to read it or to write it.
#[test]
fn options_that_name_files_read_or_write_them() {
    /// Options that read the file which they name, and those whose text names none.
    const NOT_WRITING: &str = "fi input keys scene infrared ultraviolet sky stars cam camera name \
        title cap label caption across ch channels only show points";
    /// Names of values that are numbers, or words that the program knows.
    const OTHERS: &str = "A ANGLE AXIS B BASIS CONTRAST CURVE DISTANCE EAST ERR EVENT E|WORD E|auto \
        FAR FILTER FMT FORMAT FRAME FROM H HIGH KIND L LAW LEAST LOOK LOW M MAG N NAME=EVENT \
        NAME=N NEAR NM NORTH PART PERCENT PIXELS PLACE POINT QUANTITY RATE RULE S SOUTH SPEED \
        STOPS STYLE T T2 T3 TIME TO UNIT VALUE W WEST WORD X X,Y Y Z";
    let is_in = |list: &str, name: &str| list.split_whitespace().any(|other| other == name);
    let (mut written, mut unknown) = (BTreeSet::new(), BTreeMap::new());
    let manuals = manuals();
    for manual in &manuals {
        for option in manual.options() {
            let names: Vec<&str> =
                option.names.iter().map(|name| name.trim_start_matches('-')).collect();
            let n_writing = names.iter().filter(|name| WRITING.contains(name)).count();
            if n_writing > 0 {
                assert_eq!(
                    n_writing,
                    names.len(),
                    "all names of {names:?} belong to ugpipe::WRITING"
                );
                written.extend(names);
                continue;
            }
            let is_known = names.iter().any(|name| is_in(NOT_WRITING, name));
            let is_other = option.values.iter().all(|value| is_in(OTHERS, &value.name));
            if !is_known && !is_other {
                unknown.insert(names.join(" "), option.syntax());
            }
        }
    }
    assert!(
        unknown.is_empty(),
        "does the option read the file that its value names (NOT_WRITING), write it \
         (ugpipe::WRITING), or has it no file (OTHERS)? {unknown:#?}"
    );
    // `-o` is another spelling of `-fo`, and in no manual.
    let missing: Vec<_> = WRITING.iter().filter(|name| !written.contains(**name)).collect();
    assert_eq!(missing, [&"o"]);
}

/// Every place where a library writes a file, or lets a program write it, besides its output.
#[test]
fn options_that_write_files_are_known() {
    /// Places, how many, and the options of `ugpipe::WRITING` that lead there.
    const PLACES: [(&str, usize, &str); 9] = [
        ("crates/ugdiagram/src/cli.rs", 1, "at"),
        ("crates/ugfilm/src/film.rs", 2, "fo keep"),
        ("crates/ugfilm/src/frame_files.rs", 1, "fo keep"),
        ("crates/uglorentz/src/cli.rs", 1, "at"),
        ("crates/ugmesh/src/cli.rs", 1, "fo"),
        ("crates/ugparse/src/cli/examples.rs", 1, "all"),
        ("crates/ugphoton/src/cli.rs", 1, "pv"),
        ("crates/ugsheet/src/cli.rs", 1, "fo"),
        ("crates/ugsheet/src/film/encode.rs", 1, "fo"),
    ];
    const CALLS: [&str; 9] = [
        ".write_file(&",
        ".write_file(path",
        "Context::write_now(",
        ".write_by_name(",
        "fs::write(",
        "fs::copy(",
        "fs::rename(",
        "File::create",
        "OpenOptions",
    ];
    let mut found = BTreeMap::new();
    for path in tracked::files() {
        let path = path.strip_prefix(scenes::root()).unwrap();
        let is_source = path.extension().is_some_and(|ending| ending == "rs")
            && path.starts_with("crates")
            && path.components().nth(2).is_some_and(|part| part.as_os_str() == "src");
        // `ugpipe` writes what the others give to it.
        if !is_source || path.starts_with("crates/ugpipe") {
            continue;
        }
        let text = std::fs::read_to_string(scenes::root().join(path)).unwrap();
        let text = text.split("#[cfg(test)]").next().unwrap();
        let n_calls: usize = CALLS.iter().map(|call| text.matches(call).count()).sum();
        if n_calls > 0 {
            found.insert(path.to_owned(), n_calls);
        }
    }
    let expected: BTreeMap<_, _> =
        PLACES.iter().map(|(path, n, _)| (Path::new(path).to_owned(), *n)).collect();
    assert_eq!(
        found, expected,
        "a file is written at another place: add its option to ugpipe::WRITING, and the place here"
    );
    let options = PLACES.iter().flat_map(|(_, _, options)| options.split(' '));
    options.for_each(|option| assert!(WRITING.contains(&option), "{option}"));
}

#[test]
fn files_without_a_history_are_an_error() {
    let shell = Shell::new(&["dice.ug"]);
    let output = shell.output("ugsheet --history dice.ug");
    let expected = "ugsheet: error: `dice.ug` has no history that can be run: another program drew it, or its \
                    texts were removed\n";
    assert_eq!(String::from_utf8(output.stderr).unwrap(), expected);
    assert_eq!((output.status.code(), output.stdout.len()), (Some(1), 0));
}

/// The file that joins the tiles of a picture is the one that a single command writes.
#[test]
fn tiles_are_joined_to_the_bytes_of_the_whole_picture() {
    let shell = Shell::new(&["dice.ug"]);
    let draw = "ugphoton -vel .5 0 0 dice.ug -aa 2 -sz 50 40";
    for options in ["", "-sp -ex -1", "-tb"] {
        shell.run(&format!("{draw} {options} > whole.png"));
        for part in ["0 0 20 25", "20 0 30 25", "0 25 33 15", "33 25 17 15"] {
            shell.run(&format!("{draw} {options} -crop {part} > \"tile-{part}.png\""));
        }
        shell.run("ugsheet --tiles tile-*.png > joined.png; ls -r tile-* | xargs -d '\\n' ugsheet --tiles -fo again.png");
        check_same(&shell, "whole.png", "joined.png");
        check_same(&shell, "whole.png", "again.png");
        let [history, _] = shell.run("ugsheet --history joined.png");
        assert!(history.contains("-sz 50 40") && !history.contains("crop"), "{history}");
    }
    // The same size as lengths.
    let lengths = draw.replace("50 40", "12pt 9.6pt");
    shell.run(&format!("{lengths} > exact.png; {lengths} -crop 0 0 50 25 > upper.png"));
    shell.run(&format!(
        "{lengths} -crop 0 25 50 15 > lower.png; ugsheet --tiles lower.png upper.png > joined.png"
    ));
    check_same(&shell, "exact.png", "joined.png");
    let message = |script: &str| {
        let output = shell.output(script);
        assert!(!output.status.success() && output.stdout.is_empty(), "{script}");
        String::from_utf8(output.stderr).unwrap()
    };
    shell.run("rm tile-0*25.png");
    assert_eq!(
        message("ugsheet --tiles tile-*.png"),
        "ugsheet: error: the tiles have 1500 of the 2000 pixels of the picture: draw those missing\n"
    );
    shell.run(&format!("echo >> dice.ug; {draw} -tb -crop 0 0 20 25 > other.png"));
    let other = message("ugsheet --tiles tile-*.png other.png");
    assert!(
        other.starts_with("ugsheet: error: `other.png`: not drawn by the command that"),
        "{other}"
    );
    assert!(message("ugsheet --tiles whole.png").contains("which part of a picture it is (-crop)"));
    assert!(
        message("ugsheet --tiles -fo a.pdf tile-*.png")
            .contains("--tiles writes the picture as PNG")
    );
    assert!(message("ugsheet --tiles -cols 2 tile-*.png").contains("-cols"));
}

/// The options of the manual pages of 1988 (Nguyen, appendix B).
#[test]
fn options_of_1988_are_accepted() {
    let shell = Shell::new(&["dice.ug"]);
    shell.run(
        "uglorentz -vel .5 0 0 -fi dice.ug -fo seen.ug
         ugdoppler -vel 0 0 0 -fi seen.ug -fo colours.ug -fm messages.txt -gw
         ugdoppler -qt seen.ug -fo hues.ug
         for option in '-ih' '-iw' '-wi'; do
             file=colours.ug; [ $option = -ih ] && file=hues.ug
             ugrainbow -qt -sz 60 40 $option < $file > picture$option.png
         done
         ugphoton -qt -vel .5 0 0 -cn -1 -sz 16 12 -aa 1 dice.ug > rays.png
         ugrainbow -qt -sz 60 40 -dp hues.ug > out
         ugrainbow -qt -sz 60 40 -dt ps -fo same.ps hues.ug
         ugrainbow -qt -sz 60 40 -dp -fo named hues.ug",
    );
    // `-dp` writes PostScript into a file of this name, and is recorded as the format.
    check_same(&shell, "POSTSCRIPTFILE", "same.ps");
    check_same(&shell, "POSTSCRIPTFILE", "named");
    assert!(shell.read("POSTSCRIPTFILE").starts_with(b"%!PS") && shell.read("out").is_empty());
    let [script, _] = shell.run("ugsheet -qt --history POSTSCRIPTFILE");
    assert!(script.ends_with(" | ugrainbow -sz 60 40 -dt ps\n"), "{script}");
    for name in ["picture-ih.png", "picture-iw.png", "picture-wi.png", "rays.png"] {
        assert!(shell.read(name).len() > 300, "{name}");
    }
    let (status, message) = shell.fail("ugrainbow -dp -dt png hues.ug");
    assert!(status == Some(2) && message.contains("-dp"), "{message}");
    // Two outputs are never one file.
    let (status, message) = shell.fail("ugrainbow -dp -fm POSTSCRIPTFILE hues.ug");
    assert!(status == Some(2) && message.contains("two outputs"), "{message}");
}
