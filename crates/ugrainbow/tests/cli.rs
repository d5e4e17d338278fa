//! The program itself: streams, exit codes, messages, files.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

use std::fs;
use std::io::{Cursor, Read, Write};
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use tempfile::tempdir;
use ugtesting::run::{fed, fed_as_it_is, messages};

const SCENE: &str = "\
{ A square. }
{ uglorentz 0.1.0: uglorentz -vel .1 0 0 }
c green 1 120; l 1;
v a -1 -1 0; v b 1 -1 0; v c 1 1 0; v d -1 1 0; f (a b c d) green;
cam -ep 0 -1 4 -vc 0 0 0;
";

fn ugrainbow(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ugrainbow"));
    command.args(args).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Size, colour type and `Comment` of a PNG file.
fn png_facts(file: &[u8]) -> (u32, u32, png::ColorType, String) {
    let reader = png::Decoder::new(Cursor::new(file)).read_info().unwrap();
    let info = reader.info();
    let comment = info.uncompressed_latin1_text.iter().find(|text| text.keyword == "Comment").unwrap();
    (info.width, info.height, info.color_type, comment.text.clone())
}

#[test]
fn a_picture_says_how_the_whole_pipe_was_called() {
    let output = fed(&mut ugrainbow(&["-sz", "20", "10", "-nt", "2", "-qt", "-aa", "2"]), SCENE);
    assert!(output.status.success(), "{}", messages(&output));
    assert_eq!(messages(&output), "");
    let history = "uglorentz -vel .1 0 0\nugrainbow -sz 20 10 -aa 2";
    assert_eq!(png_facts(&output.stdout), (20, 10, png::ColorType::Rgb, history.to_owned()));
}

#[test]
fn a_scene_without_a_camera_is_drawn_with_a_note() {
    let scene = SCENE.replace("cam -ep 0 -1 4 -vc 0 0 0;", "");
    let output = fed(&mut ugrainbow(&["-sz", "20", "10"]), &scene);
    let note = messages(&output);
    let options = note.strip_prefix("ugrainbow: note: no camera in the scene: seen as with ").unwrap();
    let drawn =
        |args: &[&str]| fed(&mut ugrainbow(&[&["-sz", "20", "10", "-dt", "pfm"], args].concat()), &scene);
    let options: Vec<&str> = options.split_whitespace().collect();
    let (by_default, as_noted) = (drawn(&[]), drawn(&[&options[..], &["-ud", "0", "0", "1"]].concat()));
    assert!(as_noted.status.success(), "{}", messages(&as_noted));
    assert_eq!(by_default.stdout.len(), as_noted.stdout.len());
    let is_same = |(a, b): (&[u8], &[u8])| {
        let [a, b] = [a, b].map(|bytes| f32::from_le_bytes(bytes.try_into().unwrap()));
        (a - b).abs() < 0.1
    };
    // The numbers of the note are rounded, which may move the outline by a part of a pixel.
    let [one, other] =
        [&by_default.stdout, &as_noted.stdout].map(|file| file[file.len() - 2400..].chunks_exact(4));
    let n_same = one.zip(other).filter(|&pair| is_same(pair)).count();
    assert!(n_same > 570, "{n_same} of 600");
}

#[test]
fn options_have_two_spellings() {
    let short = "-sz 20 10 -aa 2 -ep 1 -2 5 -vc 0 0 .1 -ud 0 1 0 -va 30 -bg .2 200 .5 -iw -dt eps";
    let long = "--size 20 10 --samples 2 --eye 1 -2 5 --center 0 0 .1 --up 0 1 0 --view-angle 30 \
                --background .2 200 .5 --interpolate-wavelength --format eps";
    let [short, long] = [short, long].map(|line| {
        let args: Vec<&str> = line.split_whitespace().collect();
        let output = fed(&mut ugrainbow(&args), SCENE);
        assert!(output.status.success(), "{}", messages(&output));
        output.stdout
    });
    assert!(short == long);
    assert!(short.starts_with(b"%!PS-Adobe-3.0 EPSF-3.0\n"));
}

#[test]
fn the_ending_of_the_file_is_the_format() {
    let folder = tempdir().unwrap();
    let rows = [
        ("a.png", "\u{89}PNG".chars().map(|c| c as u8).collect::<Vec<u8>>()),
        ("a.EPS", b"%!PS-Adobe-3.0 EPSF-3.0".to_vec()),
        ("a.ps", b"%!PS-Adobe-3.0\n".to_vec()),
        ("a.pdf", b"%PDF-1.7".to_vec()),
        ("a.svg", b"<svg xmlns=".to_vec()),
        ("picture", b"\x89PNG".to_vec()),
    ];
    for (name, start) in rows {
        let path = folder.path().join(name);
        let output = fed(&mut ugrainbow(&["-sz", "8", "8", "-fo", path.to_str().unwrap()]), SCENE);
        assert!(output.status.success(), "{}", messages(&output));
        assert_eq!(output.stdout, b"");
        assert!(fs::read(path).unwrap().starts_with(&start), "{name}");
    }
    let path = folder.path().join("b.ps");
    fed(&mut ugrainbow(&["-sz", "8", "8", "-tb", "-dt", "png", "-fo", path.to_str().unwrap()]), SCENE);
    assert_eq!(png_facts(&fs::read(path).unwrap()).2, png::ColorType::Rgba);
}

#[test]
fn bad_usage_ends_with_2() {
    #[track_caller]
    fn check(args: &str, message: &str) {
        let args: Vec<&str> = args.split_whitespace().collect();
        let output = fed(&mut ugrainbow(&args), SCENE);
        assert_eq!(output.status.code(), Some(2), "{}", messages(&output));
        assert_eq!(output.stdout, b"");
        assert!(messages(&output).contains(message), "{}", messages(&output));
    }
    check("-dt jpg", "none of the formats png, png16, eps, ps, pdf, svg, ppm, exr, pfm, hdr");
    check(
        "-fo a.jpg",
        "`.jpg` is none of the formats png, png16, eps, ps, pdf, svg, ppm, exr, pfm, hdr; name one with -dt",
    );
    check(
        "-sz 32768 16384",
        "a picture of 32768 x 16384 pixels cannot be made: the limit is 268435456 pixels",
    );
    check("-sz 0 8", "must be a whole number, 1 or more");
    check("-sz 8", "takes two values, not one");
    check("-fl gauss", "none of the filters box, triangle, spline");
    check(
        "-vec -dt pdf -fl spline",
        "vector graphics (-vec) have no samples to filter: leave out -fl or -vec",
    );
    check("-aa 17", "must be a whole number from 1 to 16");
    check("-aa 0", "must be a whole number from 1 to 16");
    check("-va 180", "the view angle must be above 0 and below 180 degrees");
    check("-va nan", "not a finite number");
    check("-ep 1 2", "takes three values, not two");
    check("-ud 0 0 0", "-ud 0 0 0 has no direction; give one, such as -ud 0 0 1");
    check("-bg 1.5", "lightness and saturation of the background -bg are from 0 to 1");
    check("-bg .5 -tb", "cannot be given together");
    check("-ih -wi", "cannot be given together");
    check("-vec", "this format has only pixels: with -vec write -dt eps, ps, pdf or svg");
    check("-zz", "there is no option");
}

#[test]
fn bad_scenes_end_with_1() {
    #[track_caller]
    fn check(scene: &str, message: &str) {
        let output = fed(&mut ugrainbow(&["-sz", "8", "8"]), scene);
        assert_eq!(output.status.code(), Some(1), "{}", messages(&output));
        assert_eq!(output.stdout, b"");
        assert!(messages(&output).contains(message), "{}", messages(&output));
    }
    check("", "nothing came through the pipe");
    check("l 1; v a 0 0 0;", "the scene has no faces and no wires");
    // Truncated, as by an upstream program that crashed.
    check(&SCENE[..SCENE.len() - 10], "<stdin>:");
    check(&SCENE[..SCENE.find("-ep").unwrap()], "<stdin>:");
    check(&SCENE.replace("b c d)", "b c x)"), "`x`");
    check(&SCENE.replace("-vc 0 0 0", "-vc 0 -1 4"), "the eye point 0 -1 4 is also the view centre");
}

#[test]
fn a_missing_file_is_named() {
    let output = ugrainbow(&["-fi", "no-such-scene.ug"]).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(messages(&output).contains("`no-such-scene.ug`"), "{}", messages(&output));
}

#[test]
fn a_reader_that_leaves_kills_quietly() {
    let mut child = ugrainbow(&["-sz", "400", "400", "-dt", "ps"]).spawn().unwrap();
    child.stdin.take().unwrap().write_all(SCENE.as_bytes()).unwrap();
    let mut stdout = child.stdout.take().unwrap();
    stdout.read_exact(&mut [0; 4]).unwrap();
    drop(stdout);
    let output = child.wait_with_output().unwrap();
    // SIGPIPE is 13 on all supported systems.
    assert_eq!(output.status.signal(), Some(13), "{:?}", output.status);
    assert_eq!(messages(&output), "");
}

/// Runs the program in `folder` with its standard output on a terminal. Also returns what the
/// terminal received.
fn on_terminal(args: &[&str], folder: &Path) -> (Output, Vec<u8>) {
    let master = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).unwrap();
    grantpt(&master).unwrap();
    unlockpt(&master).unwrap();
    let name = ptsname(&master, Vec::new()).unwrap().into_string().unwrap();
    let terminal = fs::OpenOptions::new().read(true).write(true).open(name).unwrap();
    let mut command = ugrainbow(args);
    let output = fed_as_it_is(command.current_dir(folder).stdout(terminal), SCENE);
    // Our copy of the terminal is in the command; with the last copy gone, reading ends with
    // an error instead of waiting.
    drop(command);
    let mut shown = Vec::new();
    let _ = fs::File::from(master).read_to_end(&mut shown);
    (output, shown)
}

#[test]
fn a_png_is_not_written_to_a_terminal() {
    let folder = tempdir().unwrap();
    let (output, shown) = on_terminal(&["-sz", "8", "8"], folder.path());
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(shown, b"");
    assert_eq!(
        messages(&output),
        "ugrainbow: error: a picture is not written to a terminal; send it to a file with `> FILE` or -fo FILE\n\
         try `ugrainbow -h`\n"
    );
    let (output, _) = on_terminal(&["-sz", "8", "8", "-fo", "a.png"], folder.path());
    assert!(output.status.success(), "{}", messages(&output));
    assert!(folder.path().join("a.png").exists());
}

#[test]
fn help_and_version() {
    let output = ugrainbow(&["--version"]).output().unwrap();
    assert_eq!(output.stdout, concat!("ugrainbow ", env!("CARGO_PKG_VERSION"), "\n").as_bytes());
    let output = ugrainbow(&["-help"]).output().unwrap();
    assert!(output.status.success());
    let help = String::from_utf8(output.stdout).unwrap();
    for option in ["-ih", "-iw", "-wi", "-dt", "-ep", "-vc", "-ud", "-va", "-og", "-sz", "-aa", "-vec"] {
        assert!(help.contains(&format!("\n  {option}, ")), "{option}");
    }
}
