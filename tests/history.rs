//! The pipe that a picture records, run again by a shell in a clean folder.
use ugtests::scenes;
use ugtests::shell::Shell;

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
        let scene = format!("{{ SHA-256 {hash} dice.ug }}\n{{ ugmesh 1: ugmesh {command} }}\n");
        shell.write("forged.ug", [scene.as_bytes(), &scenes::text("dice")].concat());
        shell.run("ugrainbow -sz 60 40 forged.ug > forged.png");
        shell.output("ugsheet -qt --history forged.png > again.sh")
    };
    for command in ["| touch gone", "-fo gone", "--output=gone", "; touch gone | ug"] {
        let output = forged(command);
        let messages = String::from_utf8(output.stderr).unwrap();
        let is_refused = messages.contains("must not be run") && output.status.code() == Some(1);
        assert!(is_refused || command.starts_with(';'), "{command}: {messages}");
        assert!(is_refused == shell.read("again.sh").is_empty(), "{command}");
    }
    for command in ["`touch gone`", "$(touch gone)", "& touch gone", "> gone", "; touch gone"] {
        assert!(forged(command).status.success(), "{command}");
        shell.output("sh again.sh");
        assert!(!shell.path("gone").exists(), "{command}");
    }
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
