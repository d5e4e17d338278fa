//! The program itself: streams, exit codes, messages, files.

use std::fs;
use std::io::{Cursor, Read};
use std::process::{Output, Stdio};

use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use tempfile::tempdir;
use ugtesting::run::{BuiltProgram, fed_as_it_is, messages};

pub const UGRAINBOW: BuiltProgram = BuiltProgram::new(env!("CARGO_BIN_EXE_ugrainbow"));
const SCENE: &str = "\
{ A square. }
{ uglorentz 0.1.0: uglorentz -vel .1 0 0 }
c green 1 120; l 1;
v a -1 -1 0; v b 1 -1 0; v c 1 1 0; v d -1 1 0; f (a b c d) green;
cam -ep 0 -1 4 -vc 0 0 0;
";

/// Size, colour type and `Comment` of a PNG file.
fn png_facts(file: &[u8]) -> (u32, u32, png::ColorType, String) {
    let reader = png::Decoder::new(Cursor::new(file)).read_info().unwrap();
    let info = reader.info();
    let comment =
        info.uncompressed_latin1_text.iter().find(|text| text.keyword == "Comment").unwrap();
    (info.width, info.height, info.color_type, comment.text.clone())
}

#[test]
fn a_picture_says_how_the_whole_pipe_was_called() {
    let output = UGRAINBOW.run("-sz 20 10 -nt 2 -qt -aa 2", SCENE);
    assert_eq!((output.status.code(), messages(&output).as_str()), (Some(0), ""));
    let history = "uglorentz -vel .1 0 0\nugrainbow -sz 20 10 -aa 2";
    assert_eq!(png_facts(&output.stdout), (20, 10, png::ColorType::Rgb, history.to_owned()));
    UGRAINBOW.ends_at_a_closed_pipe("-sz 20 10 -dt ps", SCENE);
}

#[test]
fn a_size_may_be_a_length() {
    let file = UGRAINBOW.output("-sz 2.54cm 36pt -aa 1", SCENE);
    let reader = png::Decoder::new(Cursor::new(file)).read_info().unwrap();
    let info = reader.info();
    let dots = info.pixel_dims.map(|dims| (dims.xppu, dims.yppu, dims.unit));
    assert_eq!((info.width, info.height, dots), (300, 150, Some((11811, 11811, png::Unit::Meter))));
    let svg = String::from_utf8(UGRAINBOW.output("-sz 1in 12.7mm -vec -dt svg", SCENE)).unwrap();
    assert!(svg.contains("width=\"72pt\" height=\"36pt\""), "{svg}");
    for wrong in ["0cm 1cm", "1cm nancm", "2000in 1in", "8.6 6", "3km 1km"] {
        UGRAINBOW.refuses(&format!("-sz {wrong}"), SCENE, 2, "for `-sz`");
    }
}

#[test]
fn a_scene_without_a_camera_is_drawn_with_a_note() {
    let scene = SCENE.replace("cam -ep 0 -1 4 -vc 0 0 0;", "");
    let note = UGRAINBOW.notes("-sz 20 10", &scene);
    let options =
        note.strip_prefix("ugrainbow: note: no camera in the scene: seen as with ").unwrap();
    let drawn = |options: &str| UGRAINBOW.output(&format!("-sz 20 10 -dt pfm {options}"), &scene);
    let (by_default, as_noted) = (drawn(""), drawn(&format!("{} -ud 0 0 1", options.trim_end())));
    assert_eq!(by_default.len(), as_noted.len());
    let is_same = |(a, b): (&[u8], &[u8])| {
        let [a, b] = [a, b].map(|bytes| f32::from_le_bytes(bytes.try_into().unwrap()));
        (a - b).abs() < 0.1
    };
    // The numbers of the note are rounded, which may move the outline by a part of a pixel.
    let [one, other] =
        [&by_default, &as_noted].map(|file| file[file.len() - 2400..].chunks_exact(4));
    let n_same = one.zip(other).filter(|&pair| is_same(pair)).count();
    assert!(n_same > 570, "{n_same} of 600");
}

#[test]
fn options_have_two_spellings() {
    let short = "-sz 20 10 -aa 2 -ep 1 -2 5 -vc 0 0 .1 -ud 0 1 0 -va 30 -bg .2 200 .5 -iw -dt eps";
    let long = "--size 20 10 --samples 2 --eye 1 -2 5 --center 0 0 .1 --up 0 1 0 --view-angle 30 \
                --background .2 200 .5 --interpolate-wavelength --format eps";
    UGRAINBOW.same(short, long, SCENE);
}

#[test]
fn the_ending_of_the_file_is_the_format() {
    let folder = tempdir().unwrap();
    let ugrainbow = UGRAINBOW.in_folder(&folder);
    for (name, start) in [
        ("a.png", &b"\x89PNG"[..]),
        ("a.EPS", b"%!PS-Adobe-3.0 EPSF-3.0"),
        ("a.ps", b"%!PS-Adobe-3.0\n"),
        ("a.pdf", b"%PDF-1.7"),
        ("a.svg", b"<svg xmlns="),
        ("picture", b"\x89PNG"),
    ] {
        assert_eq!(ugrainbow.output(&format!("-sz 8 8 -fo {name}"), SCENE), b"");
        assert!(fs::read(folder.path().join(name)).unwrap().starts_with(start), "{name}");
    }
    ugrainbow.output("-sz 8 8 -tb -dt png -fo b.ps", SCENE);
    assert_eq!(png_facts(&fs::read(folder.path().join("b.ps")).unwrap()).2, png::ColorType::Rgba);
}

#[test]
fn bad_usage_ends_with_2() {
    let check = |args: &str, message: &str| UGRAINBOW.refuses(args, SCENE, 2, message);
    let formats = "none of the formats png, png16, eps, ps, pdf, svg, ppm, exr, pfm, hdr";
    check("-dt jpg", formats);
    check("-fo a.jpg", &format!("`.jpg` is {formats}; name one with -dt"));
    let too_large =
        "a picture of 32768 x 16384 pixels cannot be made: the limit is 268435456 pixels";
    check("-sz 32768 16384", too_large);
    check("-sz 0 8", "must be a whole number, 1 or more");
    check("-sz 8", "takes two values, not one");
    check("-fl gauss", "none of the filters box, triangle, spline");
    let no_samples = "vector graphics have no samples to filter: leave out -fl or -vec";
    check("-vec -dt pdf -fl spline", no_samples);
    check("-aa 17", "must be a whole number from 1 to 16");
    check("-aa 0", "must be a whole number from 1 to 16");
    check("-va 180", "the view angle must be above 0 and below 180 degrees");
    check("-va nan", "not a finite number");
    check("-ep 1 2", "takes three values, not two");
    check("-ud 0 0 0", "-ud 0 0 0 has no direction; give one, such as -ud 0 0 1");
    check("-bg 1.5", "background -bg: lightness and saturation are from 0 to 1");
    check("-vec", "this format has only pixels: with -vec write -dt eps, ps, pdf or svg");
    check("-zz", "there is no option");
    for both in ["-bg .5 -tb", "-ih -wi"] {
        check(both, "cannot be given together");
    }
}

#[test]
fn bad_scenes_end_with_1() {
    let check = |scene: &str, message: &str| UGRAINBOW.refuses("-sz 8 8", scene, 1, message);
    check("", "nothing came through the pipe");
    check("l 1; v a 0 0 0;", "the scene has no faces and no wires");
    // Truncated, as by an upstream program that crashed.
    check(&SCENE[..SCENE.len() - 10], "<stdin>:");
    check(&SCENE[..SCENE.find("-ep").unwrap()], "<stdin>:");
    check(&SCENE.replace("b c d)", "b c x)"), "`x`");
    check(
        &SCENE.replace("-vc 0 0 0", "-vc 0 -1 4"),
        "the eye point 0 -1 4 is also the view centre",
    );
    UGRAINBOW.refuses("-fi no-such-scene.ug", "", 1, "`no-such-scene.ug`");
}

/// Runs the program with its standard output on a terminal. Also returns what that received.
fn on_terminal(ugrainbow: &BuiltProgram, args: &str) -> (Output, Vec<u8>) {
    let master = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).unwrap();
    grantpt(&master).unwrap();
    unlockpt(&master).unwrap();
    let name = ptsname(&master, Vec::new()).unwrap().into_string().unwrap();
    let terminal = fs::OpenOptions::new().read(true).write(true).open(name).unwrap();
    let mut command = ugrainbow.command(args);
    let output = fed_as_it_is(command.stdout(terminal).stderr(Stdio::piped()), SCENE);
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
    let ugrainbow = UGRAINBOW.in_folder(&folder);
    let (output, shown) = on_terminal(&ugrainbow, "-sz 8 8");
    assert_eq!((output.status.code(), shown.as_slice()), (Some(2), &b""[..]));
    assert_eq!(
        messages(&output),
        "ugrainbow: error: a picture is not written to a terminal; send it to a file with `> FILE` or -fo FILE\n\
         try `ugrainbow -h`\n"
    );
    let (output, _) = on_terminal(&ugrainbow, "-sz 8 8 -fo a.png");
    assert!(output.status.success(), "{}", messages(&output));
    assert!(folder.path().join("a.png").exists());
}

/// Options that contradict a sky.
#[test]
fn skies_exclude_what_does_not_show_them() {
    let file = tempfile::Builder::new().suffix(".csv").tempfile().unwrap();
    fs::write(file.path(), "ra,dec,mag,kelvin\n0,0,-9,6000\n").unwrap();
    let sky = format!("-sz 40 30 -sky {}", file.path().display());
    for (options, status, expected) in [
        ("-vec -dt svg", 2, "a sky is drawn as pixels: leave out -vec or -sky"),
        ("-tb", 2, "leave out -tb or -sky"),
        ("-og", 1, "leave out -og (in the scene, too), or -sky"),
        ("--explain 1,1", 2, "leave out -sky"),
    ] {
        UGRAINBOW.refuses(&format!("{sky} {options}"), SCENE, status, expected);
    }
    let ahead = "cam -ep 0 0 0 -vc 0 1 0;";
    assert_ne!(
        UGRAINBOW.output(&sky, ahead),
        UGRAINBOW.output(&format!("{sky} --sky-turn 0 0 180"), ahead)
    );
}
