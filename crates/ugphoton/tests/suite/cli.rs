//! The program itself: streams, exit codes, messages, metadata.

use ugimage::PanoramaArea;
use ugtesting::run::{BuiltProgram, messages};

pub const UGPHOTON: BuiltProgram = BuiltProgram::new(env!("CARGO_BIN_EXE_ugphoton"));
const SCENE: &str = "\
{ A square. }
c green 1 120; l 1;
v a -1 -1 0; v b 1 -1 0; v c 1 1 0; v d -1 1 0; f (a b c d) green;
cam -ep 0 -1 4 -vc 0 0 0;
";

#[test]
fn a_picture_says_how_it_was_made() {
    let output = UGPHOTON.run("-sz 20 10 -nt 2 -qt -vel .1 0 0", SCENE);
    assert_eq!((output.status.code(), messages(&output).as_str()), (Some(0), ""));
    let (size, metadata) = ugimage::read_png_header(&output.stdout).unwrap();
    assert_eq!(size, [20, 10]);
    assert!(metadata.software.starts_with("ugphoton "));
    let (command, recipe) = metadata.comment.split_once('\n').unwrap();
    assert_eq!(command, "ugphoton -sz 20 10 -vel .1 0 0");
    // The pipe in one line, with the hash of the scene.
    assert!(recipe.starts_with(&format!("{command} # SHA-256 ")), "{recipe}");
    UGPHOTON.ends_at_a_closed_pipe("-sz 20 10 -qt", SCENE);
}

/// Viewers of 360° pictures are told of whole panoramas and their parts, and of no other picture.
#[test]
fn only_panoramas_are_stated_for_viewers() {
    let area = |options: &str| {
        ugimage::read_png_header(&UGPHOTON.output(options, SCENE)).unwrap().1.panorama
    };
    let part = |corner| Some(PanoramaArea { whole: [40, 20], corner });
    assert_eq!(area("-pan -sz 40 20"), part([0, 0]));
    assert_eq!(area("-pan -sz 40 20 -dt png16"), part([0, 0]));
    assert_eq!(area("-pan -sz 40 20 -ex 0 -crop 8 4 10 6"), part([8, 4]));
    // Degrees that are not square, two eyes, rows with text, other lenses.
    for options in
        ["-pan -sz 40 30", "-pan -sz 40 20 -stereo .1", "-pan -sz 80 40 -cap A", "-sz 40 20"]
    {
        assert_eq!(area(options), None, "{options}");
    }
    for options in ["-fish 180 -sz 40 20", "-cube -sz 60 10", "-stereo .1 -sz 40 20"] {
        assert_eq!(area(options), None, "{options}");
    }
    for format in ["ppm", "exr", "hdr", "svg"] {
        let file = UGPHOTON.output(&format!("-pan -sz 40 20 -dt {format}"), SCENE);
        assert!(file.len() > 100 && !file.windows(5).any(|bytes| bytes == b"GPano"), "{format}");
    }
}

/// The option of the manual page of 1988.
#[test]
fn cells_are_accepted_without_effect() {
    for cells in ["-1", "0", "20"] {
        UGPHOTON.same("-sz 20 10", &format!("-cn {cells} -sz 20 10"), SCENE);
    }
    let message = "ugphoton: error: `few` is not valid for `-cn`: must be a whole number\ntry `ugphoton -h`\n";
    UGPHOTON.refuses("-cn few", SCENE, 2, message);
}

#[test]
fn options_have_two_spellings() {
    UGPHOTON.same(
        "-sz 20 10 -vel .1 0 0 -cv 0 .1 0 -ti 1 -an center -in -rd 3 -rc .01 -sm -dt pfm -sp",
        "--size 20 10 --velocity .1 0 0 --camera-velocity 0 .1 0 --time 1 --anchor center --keep-in-view \
         --depth 3 --cut-off .01 --smooth --format pfm --spectral",
        SCENE,
    );
}

#[test]
fn mistakes_have_answers() {
    for (args, expected) in [
        ("-vel 1 0 0", "-vel"),
        ("-vell .1 0 0", "-vel"),
        ("-pan -gr", "are straight lines of pinhole cameras"),
        ("-pan -fish 180", "-fish"),
        ("-cube", "give -sz W H with W = 6 H, such as -sz 3072 512"),
        ("-cube -pan", "-pan"),
        ("-cube -stereo 1", "-stereo"),
        ("-stereo -1", "a distance is 0 or more"),
        ("-stereo .1 -lg", "or -cube and -stereo"),
        ("-fish 400", "at most 360 degrees"),
        ("-crop 0 0 9999 1", "is not in the picture of 1024 x 768 pixels"),
    ] {
        UGPHOTON.refuses(args, SCENE, 2, expected);
    }
    let seen = "(ugstage 1 geometry as-seen eye 0 0 0) v a 0 1 0; v b 1 1 0; v c 0 1 1; f (a b c);";
    let glowing =
        "c_bb hot 3000 1; v a 0 9 0; v b 1 9 0; v c 0 9 1; f (a b c) hot <.5 0 0>; cam -ep 0 0 0;";
    for (args, scene, expected) in [
        ("-og", SCENE, "leave out -og"),
        ("", "v a 0 0 0;", "no faces"),
        ("", "", "ugphoton: error: "),
        ("", "f (a b c);", "vertex `a` is not defined"),
        ("", seen, "give the scene at rest"),
        ("-look 1988", glowing, "give -sp"),
    ] {
        UGPHOTON.refuses(args, scene, 1, expected);
    }
}

#[test]
fn notes_say_what_is_missing() {
    let check = |scene: &str, expected: &str| {
        let notes = UGPHOTON.notes("-sz 20 10", scene);
        assert!(notes.contains(expected), "{notes}");
    };
    check(&SCENE.replace("l 1;", ""), "no lights in the scene");
    check(&SCENE.replace("l 1;", "l 0;"), "all that is in the picture is black");
    check(&format!("{SCENE} w (a c);"), "wires are left out");
}

/// The causes are those that `ugrainbow` names, with its words.
#[test]
fn notes_say_why_nothing_is_seen() {
    let check = |colour: &str, camera: &str, expected: &str| {
        let text = format!(
            "c one {colour}; v a -1 0 -1; v b 1 0 -1; v c 0 0 1; f (a b c) one; l 1; cam {camera};"
        );
        let notes = UGPHOTON.notes("-sz 32 24", &text);
        assert!(notes.contains(&format!("nothing is drawn: {expected}")), "{camera}: {notes}");
    };
    check("1", "-ep 0 -6 1 -vc 0 -12 1", "everything is behind the eye");
    check("1", "-ep 6 0 0 -vc 0 0 0", "everything is seen edge-on");
    check("1", "-ep 0 -9000 1 -vc 0 0 0", "everything is smaller than a sample");
    check("1", "-ep 0 -6 1 -vc 9 0 0", "everything is outside the picture");
    check("1 0 0 1", "-ep 0 -6 1 -vc 0 0 0", "all faces are fully transparent");
    let far = "sphere 0 0 0 .01; l 1; cam -ep 0 -900 1 -vc 0 0 0;";
    assert!(UGPHOTON.notes("-sz 32 24", far).contains("smaller than a sample"));
    let cloud = "v a 0 0 0; v b 1 0 0; v c 0 0 1;";
    UGPHOTON.refuses("", cloud, 1, "the scene has no faces and no wires, only 3 points");
    UGPHOTON.refuses("", format!("{cloud} w (a b);"), 1, "only wires, which rays do not meet");
}

/// Skies that cannot be one, and options that contradict them.
#[test]
fn wrong_skies_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let png = |size: [u32; 2]| {
        let frame =
            ugimage::Frame::new(size, true, vec![[9, 9, 9, 255]; (size[0] * size[1]) as usize]);
        ugimage::Format::Png.encode(&frame, &ugimage::Metadata::default())
    };
    let square = file("square.png", &png([64, 64]));
    let tiny = file("tiny.png", &png([1, 1]));
    let text = file("text.png", b"no picture");
    let huge = file("huge.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 120000\n");
    let list = file("list.csv", b"ra,dec,mag,kelvin\n1,2,three,5000\n");
    let good = file("good.png", &png([64, 32]));
    let missing = folder.path().join("missing.png");
    for (sky, expected) in [
        (
            square,
            "64 x 64 pixels are not the shape of a panorama, which is twice as wide as high; a sky is",
        ),
        (tiny, "the panorama has too few pixels"),
        (text, "text.png`: "),
        (huge, "huge.hdr`: "),
        (list, "`three` is not a number"),
        (missing.to_str().unwrap().to_owned(), "No such file"),
    ] {
        UGPHOTON.refuses(&format!("-sz 20 10 -sky {sky}"), SCENE, 1, expected);
    }
    UGPHOTON.refuses(&format!("-sky {good} --explain 1,1"), SCENE, 2, "leave out -sky");
    UGPHOTON.refuses("--sky-turn 0 0 9", SCENE, 2, "--sky");
    // Behind an empty scene there is the sky alone.
    let camera = "cam -ep 0 0 0 -vc 0 1 0;";
    assert!(!UGPHOTON.output(&format!("-sz 20 10 -sky {good}"), camera).is_empty());
    // A transparent picture has it in mirrors alone.
    let clear = UGPHOTON.output(&format!("-sz 20 10 -tb -sky {good}"), camera);
    let pixels = image_pixels(&clear);
    assert!(pixels.iter().all(|pixel| pixel[3] == 0), "{pixels:?}");
}

fn image_pixels(png: &[u8]) -> Vec<[u8; 4]> {
    let picture = ugimage::read_picture(png, &ugimage::PictureLimits::default()).unwrap();
    match picture.pixels {
        ugimage::Pixels::Srgb(pixels) => pixels,
        ugimage::Pixels::Light(_) => panic!("8 bits"),
    }
}
