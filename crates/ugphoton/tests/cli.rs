//! The program itself: streams, exit codes, messages, metadata.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

use std::io::{Cursor, Read, Write};
use std::os::unix::process::ExitStatusExt;
use std::process::{Command, Output, Stdio};

use ugimage::PanoramaArea;
use ugtesting::run::{assert_refused, messages};

const SCENE: &str = "\
{ A square. }
c green 1 120; l 1;
v a -1 -1 0; v b 1 -1 0; v c 1 1 0; v d -1 1 0; f (a b c d) green;
cam -ep 0 -1 4 -vc 0 0 0;
";

fn ugphoton(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ugphoton"));
    command.args(args).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Runs the program with `scene` on its standard input.
fn fed(args: &[&str], scene: &str) -> Output {
    ugtesting::run::fed(&mut ugphoton(args), scene)
}

#[track_caller]
fn refused(args: &[&str], scene: &str, status: i32, expected: &str) {
    assert_refused(&mut ugphoton(args), scene, status, expected);
}

#[test]
fn a_picture_says_how_it_was_made() {
    let output = fed(&["-sz", "20", "10", "-nt", "2", "-qt", "-vel", ".1", "0", "0"], SCENE);
    assert_eq!((output.status.code(), messages(&output)), (Some(0), String::new()));
    let reader = png::Decoder::new(Cursor::new(output.stdout)).read_info().unwrap();
    let info = reader.info();
    let texts = &info.uncompressed_latin1_text;
    let text = |keyword: &str| texts.iter().find(|text| text.keyword == keyword).unwrap().text.clone();
    assert_eq!((info.width, info.height), (20, 10));
    assert!(text("Software").starts_with("ugphoton "));
    let comment = text("Comment");
    let (command, recipe) = comment.split_once('\n').unwrap();
    assert_eq!(command, "ugphoton -sz 20 10 -vel .1 0 0");
    // The pipe in one line, with the hash of the scene.
    assert!(recipe.starts_with(&format!("{command} # SHA-256 ")), "{recipe}");
}

/// Viewers of 360° pictures are told of whole panoramas and their parts, and of no other picture.
#[test]
fn only_panoramas_are_stated_for_viewers() {
    let area = |options: &str| {
        let output = fed(&options.split(' ').collect::<Vec<_>>(), SCENE);
        assert_eq!(output.status.code(), Some(0), "{options}: {}", messages(&output));
        ugimage::read_png_header(&output.stdout).unwrap().1.panorama
    };
    let part = |corner| Some(PanoramaArea { whole: [40, 20], corner });
    assert_eq!(area("-pan -sz 40 20"), part([0, 0]));
    assert_eq!(area("-pan -sz 40 20 -dt png16"), part([0, 0]));
    assert_eq!(area("-pan -sz 40 20 -ex 0 -crop 8 4 10 6"), part([8, 4]));
    // Degrees that are not square, two eyes, rows with text, other lenses.
    for options in ["-pan -sz 40 30", "-pan -sz 40 20 -stereo .1", "-pan -sz 400 200 -lg", "-sz 40 20"] {
        assert_eq!(area(options), None, "{options}");
    }
    for options in ["-fish 180 -sz 40 20", "-cube -sz 60 10", "-stereo .1 -sz 40 20"] {
        assert_eq!(area(options), None, "{options}");
    }
    for format in ["ppm", "exr", "hdr", "svg"] {
        let file = fed(&["-pan", "-sz", "40", "20", "-dt", format], SCENE).stdout;
        assert!(file.len() > 100 && !file.windows(5).any(|bytes| bytes == b"GPano"), "{format}");
    }
}

/// The option of the manual page of 1988.
#[test]
fn cells_are_accepted_without_effect() {
    let expected = fed(&["-sz", "20", "10"], SCENE);
    for cells in ["-1", "0", "20"] {
        let output = fed(&["-cn", cells, "-sz", "20", "10"], SCENE);
        assert_eq!(output.status.code(), Some(0), "{}", messages(&output));
        assert!(output.stdout == expected.stdout, "-cn {cells}");
    }
    refused(
        &["-cn", "few"],
        SCENE,
        2,
        "ugphoton: error: `few` is not valid for `-cn`: must be a whole number\ntry `ugphoton -h`\n",
    );
}

#[test]
fn options_have_two_spellings() {
    let short = "-sz 20 10 -vel .1 0 0 -cv 0 .1 0 -ti 1 -an center -in -rd 3 -rc .01 -sm -dt pfm -sp";
    let long = "--size 20 10 --velocity .1 0 0 --camera-velocity 0 .1 0 --time 1 --anchor center --keep-in-view \
                --depth 3 --cut-off .01 --smooth --format pfm --spectral";
    let run = |options: &str| fed(&options.split(' ').collect::<Vec<_>>(), SCENE);
    let (short, long) = (run(short), run(long));
    assert_eq!(short.status.code(), Some(0), "{}", messages(&short));
    assert!(short.stdout.starts_with(b"PF") && short.stdout == long.stdout);
}

#[test]
fn mistakes_have_answers() {
    refused(&["-vel", "1", "0", "0"], SCENE, 2, "-vel");
    refused(&["-vell", ".1", "0", "0"], SCENE, 2, "-vel");
    refused(&["-pan", "-gr"], SCENE, 2, "are straight lines of pinhole cameras");
    refused(&["-pan", "-fish", "180"], SCENE, 2, "-fish");
    refused(&["-cube"], SCENE, 2, "give -sz W H with W = 6 H, such as -sz 3072 512");
    refused(&["-cube", "-pan"], SCENE, 2, "-pan");
    refused(&["-cube", "-stereo", "1"], SCENE, 2, "-stereo");
    refused(&["-stereo", "-1"], SCENE, 2, "a distance is 0 or more");
    refused(&["-stereo", ".1", "-lg"], SCENE, 2, "leave them out, or -cube and -stereo");
    refused(&["-fish", "400"], SCENE, 2, "at most 360 degrees");
    refused(&["-crop", "0", "0", "9999", "1"], SCENE, 2, "is not in the picture of 1024 x 768 pixels");
    refused(&["-og"], SCENE, 1, "leave out -og");
    refused(&[], "v a 0 0 0;", 1, "no faces");
    refused(&[], "", 1, "ugphoton: error: ");
    refused(&[], "f (a b c);", 1, "vertex `a` is not defined");
    let seen = "(ugstage 1 geometry as-seen eye 0 0 0) v a 0 1 0; v b 1 1 0; v c 0 1 1; f (a b c);";
    refused(&[], seen, 1, "give the scene at rest");
    let glowing = "c_bb hot 3000 1; v a 0 9 0; v b 1 9 0; v c 0 9 1; f (a b c) hot <.5 0 0>; cam -ep 0 0 0;";
    refused(&["-look", "1988"], glowing, 1, "give -sp");
}

#[test]
fn notes_say_what_is_missing() {
    let check = |scene: &str, expected: &str| {
        let output = fed(&["-sz", "20", "10"], scene);
        assert_eq!(output.status.code(), Some(0));
        assert!(messages(&output).contains(expected), "{}", messages(&output));
    };
    check(&SCENE.replace("l 1;", ""), "no lights in the scene");
    check(&SCENE.replace("l 1;", "l 0;"), "all that is in the picture is black");
    check(&format!("{SCENE} w (a c);"), "wires are left out");
    check(&SCENE.replace("-vc 0 0 0", "-vc 0 -1 9"), "nothing is drawn");
}

#[test]
fn a_closed_pipe_ends_it_silently() {
    let mut child = ugphoton(&["-sz", "600", "600", "-ex", "0", "-aa", "1", "-dt", "ppm"]).spawn().unwrap();
    let _ = child.stdin.take().unwrap().write_all(SCENE.as_bytes());
    let mut pipe = child.stdout.take().unwrap();
    pipe.read_exact(&mut [0; 2]).unwrap();
    drop(pipe);
    let output = child.wait_with_output().unwrap();
    const SIGPIPE: i32 = 13;
    assert_eq!((output.status.signal(), messages(&output)), (Some(SIGPIPE), String::new()));
}
