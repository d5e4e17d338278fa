//! The program itself: streams, exit codes, messages, metadata, hostile files.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

use std::io::{Cursor, Read, Write};
use std::os::unix::process::ExitStatusExt;
use std::process::{Command, Output, Stdio};

use ugimage::{Format, Frame, LinearFrame, Metadata, PanoramaArea};
use ugtesting::run::{assert_refused, messages};

/// A small panorama as PNG.
fn sky() -> Vec<u8> {
    let pixel = |idx: u32| [(idx % 64 * 4) as u8, (idx / 64 * 8) as u8, 90, 255];
    let frame = Frame::new([64, 32], true, (0..64 * 32).map(pixel).collect());
    Format::Png.encode(&frame, &Metadata::default())
}

fn ugwarp(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ugwarp"));
    command.args(args).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Runs the program with `file` on its standard input.
fn fed(args: &[&str], file: &[u8]) -> Output {
    ugtesting::run::fed(&mut ugwarp(args), file)
}

#[track_caller]
fn refused(args: &[&str], file: &[u8], status: i32, expected: &str) {
    assert_refused(&mut ugwarp(args), file, status, expected);
}

#[test]
fn a_picture_says_how_it_was_made() {
    let output = fed(&["-sz", "20", "10", "-nt", "2", "-qt", "-cv", "0", ".1", "0"], &sky());
    assert_eq!((output.status.code(), messages(&output)), (Some(0), String::new()));
    let reader = png::Decoder::new(Cursor::new(output.stdout)).read_info().unwrap();
    let info = reader.info();
    let texts = &info.uncompressed_latin1_text;
    let text = |keyword: &str| texts.iter().find(|text| text.keyword == keyword).unwrap().text.clone();
    assert_eq!((info.width, info.height), (20, 10));
    assert!(text("Software").starts_with("ugwarp "));
    let comment = text("Comment");
    let (command, recipe) = comment.split_once('\n').unwrap();
    assert_eq!(command, "ugwarp -sz 20 10 -cv 0 .1 0");
    assert!(recipe.starts_with(&format!("{command} # SHA-256 ")), "{recipe}");
}

/// Viewers of 360° pictures are told of panoramas, whether they are written while they are drawn or
/// after it.
#[test]
fn only_panoramas_are_stated_for_viewers() {
    let area = |options: &str| {
        let output = fed(&options.split(' ').collect::<Vec<_>>(), &sky());
        assert_eq!(output.status.code(), Some(0), "{options}: {}", messages(&output));
        ugimage::read_png_header(&output.stdout).unwrap().1.panorama
    };
    let whole = Some(PanoramaArea { whole: [40, 20], corner: [0, 0] });
    for options in ["-pan -sz 40 20", "-pan -sz 40 20 -ex auto", "-pan -sz 40 20 -dt png16"] {
        assert_eq!(area(options), whole, "{options}");
    }
    for options in
        ["-pan -sz 40 30", "-pan -sz 400 200 -cap text", "-sz 40 20", "-fish 180", "-cube -sz 60 10"]
    {
        assert_eq!(area(options), None, "{options}");
    }
}

#[test]
fn options_have_two_spellings() {
    let short = "-sz 20 10 -vel .1 0 0 -dt pfm -sp -pan -aa 2";
    let long = "--size 20 10 --velocity .1 0 0 --format pfm --spectral --panorama --samples 2";
    let run = |options: &str| fed(&options.split(' ').collect::<Vec<_>>(), &sky());
    let (short, long) = (run(short), run(long));
    assert_eq!(short.status.code(), Some(0), "{}", messages(&short));
    assert!(short.stdout.starts_with(b"PF") && short.stdout == long.stdout);
    // The surroundings that move by are those that a camera with the opposite velocity passes.
    let camera = run("-sz 20 10 -cv -.1 0 0 -dt pfm -sp -pan -aa 2");
    assert_eq!(short.stdout, camera.stdout);
}

#[test]
fn the_same_bytes_on_any_number_of_threads() {
    let run = |threads: &str| {
        let options = ["-sz", "80", "60", "-cv", "0", ".8", "0", "-va", "120", "-sp", "-qt"];
        fed(&[&options[..], &["-nt", threads]].concat(), &sky()).stdout
    };
    let one = run("1");
    assert!(one.starts_with(b"\x89PNG") && one == run("2") && one == run("7"));
}

#[test]
fn mistakes_have_answers() {
    let sky = sky();
    refused(&["-vel", "1", "0", "0"], &sky, 2, "it must be below 1");
    refused(&["-vel", ".1", "0", "0", "-cv", ".1", "0", "0"], &sky, 2, "-cv");
    refused(&["-og"], &sky, 2, "there is no -og");
    refused(&["-gr"], &sky, 2, "are for scenes");
    refused(&["-cube"], &sky, 2, "give -sz W H with W = 6 H");
    refused(&["-dt", "exr", "-ch", "time"], &sky, 2, "the channels of a panorama are D, direction");
    refused(&["--basis", "green"], &sky, 2, "--basis takes mixture or three temperatures");
    refused(&["--basis", "5000", "5000", "9000"], &sky, 2, "are no basis of colours");
    refused(&["-part", "10", "-10", "0", "20"], &sky, 2, "must increase from west to east");
    refused(&["-vc", "0", "0", "0"], &sky, 1, "no direction to look in");
    refused(&["no-such-file.png"], &sky, 1, "No such file");
}

#[test]
fn what_is_no_panorama_is_refused() {
    refused(&[], b"GIF89a", 1, "not a picture of a kind that is read: PNG, JPEG, HDR, EXR or PFM");
    refused(&[], b"\xff\xd8\xff\xe0", 1, "not a readable JPEG file: the file is truncated");
    refused(&[], b"#?RADIANCE\n", 1, "not a readable HDR file");
    refused(&[], b"\x76\x2f\x31\x01", 1, "not a readable EXR file");
    let shaped = |size: [u32; 2]| {
        let pixels = vec![[9, 9, 9, 255]; (size[0] * size[1]) as usize];
        Format::Png.encode(&Frame::new(size, true, pixels), &Metadata::default())
    };
    refused(&[], &shaped([60, 40]), 1, "60 x 40 pixels are not the shape of a panorama");
    refused(&[], &shaped([8, 4]), 1, "has too few pixels");
    let strip = fed(&["-sz", "20", "10", "-part", "-60", "60", "-40", "40"], &shaped([60, 40]));
    assert_eq!(strip.status.code(), Some(0), "{}", messages(&strip));
    let file = sky();
    for length in (0..file.len() - 30).step_by(37) {
        assert_eq!(fed(&["-sz", "8", "8"], &file[..length]).status.code(), Some(1), "{length}");
    }
}

/// Light that is not finite is counted, and drawn as a finite number.
#[test]
fn light_that_is_not_finite_is_bounded() {
    let mut frame = LinearFrame::new([64, 32], true, vec![[0.5, 0.5, 0.5, 1.0]; 64 * 32]);
    let file = |frame: &LinearFrame| {
        Format::Exr.encode_linear(frame, &Metadata::default(), ugimage::Compression::Fast)
    };
    let options = ["-sz", "8", "8", "-dt", "pfm", "--no-doppler", "--no-flux"];
    let plain = fed(&options, &file(&frame));
    assert_eq!((plain.status.code(), messages(&plain)), (Some(0), String::new()));
    let middle = 16 * 64 + 32;
    frame.pixels_mut()[middle] = [f32::NAN, 0.5, f32::NAN, 1.0];
    frame.pixels_mut()[middle + 1] = [0.5, f32::INFINITY, f32::NEG_INFINITY, 1.0];
    let output = fed(&options, &file(&frame));
    assert_eq!(output.status.code(), Some(0), "{}", messages(&output));
    assert!(messages(&output).contains("2 pixels of the panorama are not finite"), "{}", messages(&output));
    let numbers = output.stdout[output.stdout.len() - 4 * 3 * 64..].chunks_exact(4);
    for number in numbers {
        assert!(f32::from_le_bytes(number.try_into().unwrap()).is_finite());
    }
}

#[test]
fn a_closed_pipe_ends_the_program() {
    let mut child = ugwarp(&["-sz", "2000", "2000", "-ex", "0", "-dt", "ppm"]).spawn().unwrap();
    child.stdin.take().unwrap().write_all(&sky()).unwrap();
    let mut stdout = child.stdout.take().unwrap();
    stdout.read_exact(&mut [0; 9]).unwrap();
    drop(stdout);
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.signal(), messages(&output)), (Some(13), String::new()));
}

/// A list of stars is drawn in place of a panorama or in front of one, with the same bytes on any
/// number of threads.
#[test]
fn lists_of_stars_are_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("stars.csv");
    let star = |idx: u32| {
        let [ra, dec] = [idx * 7 % 360, idx * 11 % 180].map(f64::from);
        format!("{ra},{},{},{}\n", dec - 90.0, idx % 5, 3000 + 50 * idx)
    };
    let list: String = (0..300).map(star).collect();
    let list = format!("ra,dec,mag,kelvin\n{list}");
    std::fs::write(&path, &list).unwrap();
    let path = path.to_str().unwrap();
    for options in [vec!["-fish", "180"], vec!["-pan"], vec!["-va", "100"], vec!["-cube", "-sz", "240", "40"]]
    {
        let run = |threads: &str, more: &[&str], input: &[u8]| {
            let size = if options[0] == "-cube" { vec![] } else { vec!["-sz", "80", "60"] };
            let args = [&options[..], &size, &["-cv", ".4", ".6", "0", "-qt", "-nt", threads], more].concat();
            let output = fed(&args, input);
            assert_eq!(output.status.code(), Some(0), "{}", messages(&output));
            output.stdout
        };
        let one = run("1", &[], list.as_bytes());
        assert_eq!(one, run("7", &[], list.as_bytes()));
        let both = run("1", &["--stars", path, "-sp"], &sky());
        assert_eq!(both, run("7", &["--stars", path, "-sp"], &sky()));
        assert!(both != one && both != run("2", &["-sp"], &sky()));
    }
    refused(&["--stars", path, "--br", "photon"], &sky(), 2, "`-br`");
    refused(
        &["-part", "-10", "10", "-5", "5"],
        list.as_bytes(),
        2,
        "the input is a list of stars: leave out -from",
    );
    refused(&["--basis", "mixture"], list.as_bytes(), 2, "leave out -br, --basis");
    refused(&["--star-width", "0"], list.as_bytes(), 2, "0.5 to 50 pixels wide");
    refused(&[], b"ra,dec,mag,kelvin\n1,2,3,x\n", 1, "<stdin>:2:7");
    refused(&["--stars", "no-such-list.csv"], &sky(), 1, "No such file");
}

/// The camera of a scene, by name and with a path from a table beside it, looks where it is told.
#[test]
fn cameras_come_from_scenes() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    file("flight.csv", "t,x,y,z\n0,0,0,0\n10,0,5,0\n20,0,10,0\n");
    let scene = file(
        "flight.ug",
        "motion ship -path flight.csv; cam -ep 0 0 0 -vc 1 0 0 <ship>;
         cam ahead -ep 0 0 0 -vc 0 1 0 -va 70 <ship>;",
    );
    let bare = file("bare.ug", "v a 0 0 0;");
    let broken = file("broken.ug", "v a 0 0;");
    let bytes = |args: &[&str]| {
        let base = ["-sz", "40", "30", "-dt", "pfm", "-sp", "--allow-outside"];
        let output = fed(&[&base, args].concat(), &sky());
        assert_eq!((output.status.code(), messages(&output)), (Some(0), String::new()), "{args:?}");
        output.stdout
    };
    let numbers = |bytes: Vec<u8>| {
        let data = &bytes[bytes.len() - 40 * 30 * 12..];
        let words = data.chunks(4).map(|word| f32::from_le_bytes(word.try_into().unwrap()));
        words.collect::<Vec<f32>>()
    };
    let check = |scene: &[&str], plain: &[&str]| {
        let [seen, expected] = [scene, plain].map(|args| numbers(bytes(args)));
        for (seen, expected) in seen.iter().zip(&expected) {
            assert!(
                (seen - expected).abs() < 1e-4 * expected.abs().max(0.01),
                "{scene:?}: {seen} {expected}"
            );
        }
    };
    let base = ["--scene", &scene, "--time", "3"];
    check(&base, &["-cv", "0", ".5", "0", "-vc", "1", "0", "0"]);
    check(&[&base[..], &["-cam", "ahead"]].concat(), &["-cv", "0", ".5", "0", "-va", "70"]);
    check(
        &[&base[..], &["-cam", "ahead", "-vc", "0", "0", "1", "-ud", "1", "0", "0", "-va", "30"]].concat(),
        &["-cv", "0", ".5", "0", "-vc", "0", "0", "1", "-ud", "1", "0", "0", "-va", "30"],
    );
    refused(&["--scene", &scene, "-cv", "0", "0", "0"], &sky(), 2, "cannot be given together");
    refused(&["-ti", "2"], &sky(), 2, "--scene");
    refused(&["-cam", "ahead"], &sky(), 2, "name the scene of the camera with --scene");
    refused(&["--scene", &scene, "--allow-outside", "-cam", "astern"], &sky(), 1, "astern");
    refused(&["--scene", &scene, "--allow-outside", "-og"], &sky(), 2, "leave it out");
    refused(&["--scene", &bare], &sky(), 1, "the scene has no camera: add a `cam` statement");
    refused(&["--scene", &broken], &sky(), 1, "broken.ug:1");
}

/// Infrared light is a file of its own, and white infrared light brightens what is ahead.
#[test]
fn infrared_light_is_a_second_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("infrared.png");
    let white = Frame::new([64, 32], true, vec![[255; 4]; 64 * 32]);
    std::fs::write(&path, Format::Png.encode(&white, &Metadata::default())).unwrap();
    let path = path.to_str().unwrap();
    let mean = |options: &[&str]| {
        let base = ["-sz", "8", "8", "-va", "30", "-dt", "ppm", "-cv", "0", ".6", "0", "-ex", "-3"];
        let output = fed(&[&base, options].concat(), &sky());
        assert_eq!(output.status.code(), Some(0), "{}", messages(&output));
        output.stdout[output.stdout.len() - 192..].iter().map(|&byte| f64::from(byte)).sum::<f64>() / 192.0
    };
    let (all, none) = (mean(&["--infrared", path]), mean(&["--infrared", path, "--infrared-to", "831"]));
    assert!(all > none + 30.0, "{all} {none}");
    refused(&["--infrared", path, "-br", "photon"], &sky(), 2, "-br");
    refused(&["--infrared", path, "--infrared-to", "700"], &sky(), 2, "more than 830 nm");
    refused(&["--ultraviolet", "no-such-file.png"], &sky(), 1, "no-such-file.png");
    refused(&["--ultraviolet", path], b"ra,dec,mag,kelvin\n", 2, "leave out");
}
