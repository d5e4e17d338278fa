//! What a user and a shell see of the program.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

use std::io::{Read, Write};
use std::os::unix::process::ExitStatusExt;
use std::process::{Command, Output, Stdio};

const TILE: &str = "v a 3 0 1; v b 4 0 1; v c 3 1 1;\nf (a b c) ;\n";
const SIGPIPE: i32 = 13;

fn program(args: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_uglorentz"));
    command.args(args.split_whitespace());
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

fn run(args: &str, scene: &str) -> Output {
    ugtesting::run::fed(&mut program(args), scene)
}

#[test]
fn scenes_come_out_as_seen() {
    let output = run("-vel -0.6 0 0 -ep 0 0 1 -sd 1", TILE);
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
    assert_eq!(output.status.code(), Some(0));
    let text = String::from_utf8(output.stdout).unwrap();
    let (origin, text) = text.split_once('\n').unwrap();
    assert!(origin.starts_with("{ SHA-256 ") && origin.ends_with(" - }"), "{origin}");
    assert_eq!(
        text,
        "{ uglorentz 0.1.0: uglorentz -vel -0.6 0 0 -ep 0 0 1 -sd 1 }
(ugstage 1 geometry as-seen eye 0 0 1)
v a 6 0 1;
v b 8 0 1;
v c 6.1217082451262845 1 1;
f (a b c) <-0.6 0 0>;
cam -ep 0 0 1;
"
    );
}

#[test]
fn a_scene_without_a_camera_is_seen_by_the_default_one() {
    let output = run("-vel .5 0 0 -in", TILE);
    let note = String::from_utf8(output.stderr).unwrap();
    let camera = note.strip_prefix("uglorentz: note: no camera in the scene: seen as with ").unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let statement = text.lines().find(|line| line.starts_with("cam ")).unwrap();
    let eye =
        |options: &str| options.split_whitespace().skip(1).take(3).map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(eye(camera), eye(&statement[4..]), "{note} {text}");
}

#[test]
fn options_have_two_spellings() {
    let check = |historical: &str, descriptive: &str| {
        let [one, two] = [historical, descriptive].map(|args| run(args, TILE));
        assert_eq!(one.status.code(), Some(0), "{historical}: {}", String::from_utf8_lossy(&one.stderr));
        assert_eq!(one.stdout, two.stdout, "{historical}");
    };
    check("-vel .5 0 0", "--velocity .5 0 0");
    check("-vel .5 0 0 -ti -2.5 -ep 0 0 -1", "--velocity .5 0 0 --time -2.5 --eye 0 0 -1");
    check("-vel .5 0 0 -in", "--velocity .5 0 0 --keep-in-view");
    check("-vel .5 0 0 -in -an 3 0 1 -se 1", "--vel .5 0 0 --in-place --anchor 3 0 1 --error 1");
    check("-vel .5 0 0 -an center -sd 2 -sm", "--vel .5 0 0 --anchor center --pieces 2 --smooth");
    check("-cv .5 0 0", "--camera-velocity .5 0 0");
    check(
        "-cull -vc 3 1 1 -ud 0 1 0 -va 50 40 -og -sz 4 3",
        "--cull --center 3 1 1 --up 0 1 0 --view-angle 50 40 --orthographic --size 4 3",
    );
    check("-vel .5 0 0 -sc .5", "--vel .5 0 0 --color-error .5");
    check("-vel .5 0 0 -sc off", "--velocity .5 0 0 --color-error off");
    check("-vel .5 0 0 -nc -no-flight-time", "--vel .5 0 0 --no-contraction --no-flight-time");
}

/// A chosen camera's eye is the one from which things are seen, here and in the programs behind.
#[test]
fn one_of_several_cameras_can_be_chosen() {
    let scene = format!("{TILE} cam -ep 0 -9 0; cam side -ep 7 1 0;");
    let output = run("-vel .5 0 0 -cam side", &scene);
    let text = String::from_utf8(output.stdout).unwrap();
    let body = |text: &str| {
        text.lines().filter(|line| !line.starts_with('{')).map(str::to_owned).collect::<Vec<_>>()
    };
    assert!(text.contains("cam -ep 7 1 0;\ncam -ep 0 -9 0;\n"), "{text}");
    let alone = run("-vel .5 0 0", &format!("{TILE} cam -ep 7 1 0; cam -ep 0 -9 0;"));
    assert_eq!(body(&text), body(&String::from_utf8(alone.stdout).unwrap()));
}

#[test]
fn complaints() {
    let check = |args: &str, scene: &str, status: i32, expected: &str| {
        let output = run(args, scene);
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert!(stderr.contains(expected), "{args}: {stderr}");
        assert_eq!((output.status.code(), output.stdout), (Some(status), Vec::new()), "{args}");
    };
    check("-vel 1 0 0", TILE, 2, "error: -vel: speed is 1 c: it must be below 1");
    check("-vel nan 0 0", TILE, 2, "not a finite number");
    check("-vel .5 0", TILE, 2, "takes three values, not two");
    check("-se 0", TILE, 2, "the bound of -se is 0 milliradians: give a number above 0");
    check("-se -1", TILE, 2, "the bound of -se is -1 milliradians: give a number above 0");
    check("-ud 0 0 0", TILE, 2, "-ud 0 0 0 has no direction; give one, such as -ud 0 0 1");
    let no_direction = "the eye point 1 1e-300 1 is also the view centre, so there is no direction to look in; \
                        move the eye with -ep or the centre with -vc";
    check("-ep 1 1e-300 1 -vc 1 1e-300 1", TILE, 1, no_direction);
    check("-ep 1 1e-300 1", &format!("{TILE} cam -vc 1 1e-300 1;"), 1, no_direction);
    check("-va 5e-324", TILE, 1, "degrees cannot be projected on a flat picture");
    check("-sd 0", TILE, 2, "-sd 0 would make no pieces: give 1 or more");
    check("-sd 2 -se 1", TILE, 2, "cannot be given together");
    check("-an nose", TILE, 2, "`nose` is not an anchor: -an takes eye, origin, center or three numbers");
    check("-an 1 2", TILE, 2, "`1 2` is not an anchor");
    check("-cam side", TILE, 1, "no camera is called `side`");
    check("-speed 3", TILE, 2, "there is no option");
    check("-vel .5 0 0 no-such-file.ug", TILE, 1, "no-such-file.ug");
    check("", "v a 0 0 0;\nf (a b c);", 1, "<stdin>:2:");
    check("", "v a 1 0 0; v b 1 1 0; v c 0 1 0;\nf (a b c) <0 1.5 0>;", 1, "<stdin>:2:");
    check("-vel .5 0 0 -ep 3 0 1", TILE, 1, "vertex `a` lies at the eye, where no direction to it exists");
    check("-vel .5 0 0 -ep 3 0 1", TILE, 1, "move the eye (-ep) or the vertex");
}

#[test]
fn warnings_do_not_stop_it() {
    let bent = "v a 3 0 1; v b 4 0 1; v c 4 1 1.02; v d 3 1 1; f (a b c d);";
    let warned = run("-vel .5 0 0", bent);
    assert_eq!(warned.status.code(), Some(0));
    assert!(String::from_utf8_lossy(&warned.stderr).contains("face is not flat"));
    let quiet = run("-vel .5 0 0 -qt", bent);
    assert_eq!((quiet.stdout, quiet.stderr), (warned.stdout, Vec::new()));
    let talk = String::from_utf8(run("-vel .5 0 0 -vb", TILE).stderr).unwrap();
    assert!(talk.contains("subdivision added"), "{talk}");
}

#[test]
fn a_closed_pipe_ends_it_quietly() {
    // More than a pipe holds, so that writing meets the closed end.
    let many: String = (0..20_000).map(|idx| format!("v v{idx} {idx} 1 2;\n")).collect();
    let mut child = program("-vel .5 0 0 -ep 0 0 0").spawn().unwrap();
    drop(child.stdout.take());
    child.stdin.take().unwrap().write_all(many.as_bytes()).unwrap();
    let mut stderr = String::new();
    child.stderr.take().unwrap().read_to_string(&mut stderr).unwrap();
    assert_eq!((child.wait().unwrap().signal(), stderr.as_str()), (Some(SIGPIPE), ""));
}

#[test]
fn help_names_every_option() {
    let help = String::from_utf8(run("--help", "").stdout).unwrap();
    for option in ["-vel", "-ep", "-ti", "-an", "-in", "-se", "-sd", "-sm", "-nc", "--no-flight-time"] {
        assert!(
            help.contains(&format!("\n  {option}, ")) || help.contains(&format!("\n  {option}\n")),
            "{option}"
        );
    }
}

#[test]
fn measurements_go_to_a_file_that_does_not_change_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).display().to_string();
    let plain = run("-vel .6 0 0 -ep 0 0 0", TILE);
    let output = run(&format!("-vel .6 0 0 -ep 0 0 0 -at {}", file("t.csv")), TILE);
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
    assert_eq!(output.stdout, plain.stdout);
    assert!(std::fs::read_to_string(file("t.csv")).unwrap().starts_with("name,x,y,z,"));

    let fails = |args: &str, scene: &str, status: i32, expected: &str| {
        let output = run(args, scene);
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(status), "{stderr}");
        assert!(stderr.contains(expected), "{stderr}");
        assert!(output.stdout.is_empty());
    };
    fails("-at t.txt", TILE, 2, "the name of its file must end with .csv, .ply or .vtp");
    fails(&format!("-at {0} -fo {0}", file("both.ply")), TILE, 2, "two outputs cannot go to one file");
    fails(&format!("-at {}", file("none.csv")), "f (a b c);", 1, "`a` is not defined");
    fails(&format!("-at {}", file("no/folder.csv")), TILE, 1, "cannot write");
    // The scene could not be written, so there is no table either.
    fails(&format!("-at {} -fo {}", file("late.csv"), file("no/scene.ug")), TILE, 1, "cannot write");
    let left: Vec<_> =
        std::fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left, ["t.csv"]);
}
