//! The program itself: streams, exit codes, messages, metadata, hostile files.

use ugimage::{Format, Frame, LinearFrame, Metadata, PanoramaArea};
use ugtesting::run::{BuiltProgram, messages};

const UGWARP: BuiltProgram = BuiltProgram::new(env!("CARGO_BIN_EXE_ugwarp"));

/// A small panorama as PNG.
fn sky() -> Vec<u8> {
    let pixel = |idx: u32| [(idx % 64 * 4) as u8, (idx / 64 * 8) as u8, 90, 255];
    let frame = Frame::new([64, 32], true, (0..64 * 32).map(pixel).collect());
    Format::Png.encode(&frame, &Metadata::default())
}

#[test]
fn a_picture_says_how_it_was_made() {
    let output = UGWARP.run("-sz 20 10 -nt 2 -qt -cv 0 .1 0", sky());
    assert_eq!((output.status.code(), messages(&output).as_str()), (Some(0), ""));
    let (size, metadata) = ugimage::read_png_header(&output.stdout).unwrap();
    assert_eq!(size, [20, 10]);
    assert!(metadata.software.starts_with("ugwarp "));
    let (command, recipe) = metadata.comment.split_once('\n').unwrap();
    assert_eq!(command, "ugwarp -sz 20 10 -cv 0 .1 0");
    assert!(recipe.starts_with(&format!("{command} # SHA-256 ")), "{recipe}");
    UGWARP.ends_at_a_closed_pipe("-qt -sz 20 10", sky());
}

/// Viewers of 360° pictures are told of panoramas, whether they are written while they are drawn or
/// after it.
#[test]
fn only_panoramas_are_stated_for_viewers() {
    let area = |options: &str| {
        ugimage::read_png_header(&UGWARP.output(options, sky())).unwrap().1.panorama
    };
    let whole = Some(PanoramaArea { whole: [40, 20], corner: [0, 0] });
    for options in ["-pan -sz 40 20", "-pan -sz 40 20 -ex auto", "-pan -sz 40 20 -dt png16"] {
        assert_eq!(area(options), whole, "{options}");
    }
    for options in [
        "-pan -sz 40 30",
        "-pan -sz 400 200 -cap text",
        "-sz 40 20",
        "-fish 180",
        "-cube -sz 60 10",
    ] {
        assert_eq!(area(options), None, "{options}");
    }
}

#[test]
fn options_have_two_spellings() {
    let short = "-sz 20 10 -vel .1 0 0 -dt pfm -sp -pan -aa 2";
    let long = "--size 20 10 --velocity .1 0 0 --format pfm --spectral --panorama --samples 2";
    UGWARP.same(short, long, sky());
    // The surroundings that move by are those that a camera with the opposite velocity passes.
    UGWARP.same(short, "-sz 20 10 -cv -.1 0 0 -dt pfm -sp -pan -aa 2", sky());
}

#[test]
fn the_same_bytes_on_any_number_of_threads() {
    let on = |threads: u32| format!("-sz 80 60 -cv 0 .8 0 -va 120 -sp -qt -nt {threads}");
    UGWARP.same(&on(1), &on(2), sky());
    UGWARP.same(&on(1), &on(7), sky());
}

#[test]
fn mistakes_have_answers() {
    let check =
        |args: &str, status: i32, expected: &str| UGWARP.refuses(args, sky(), status, expected);
    check("-vel 1 0 0", 2, "it must be below 1");
    check("-vel .1 0 0 -cv .1 0 0", 2, "-cv");
    check("-og", 2, "leave out -og");
    check("-gr", 2, "are for scenes");
    check("-cube", 2, "give -sz W H with W = 6 H");
    check("-dt exr -ch time", 2, "the channels of a panorama are D, direction");
    check("--basis green", 2, "--basis takes mixture or three temperatures");
    check(
        "--basis 5000",
        2,
        "`5000` is no basis: --basis takes mixture or three temperatures, and 1 is given",
    );
    check("--basis 5000 6000 sky.png", 2, "three temperatures, and 2 are given");
    check("--basis 3500 5900 10000 20000 sky.png", 2, "three temperatures, and 4 are given");
    check("--basis 5000 5000 9000", 2, "are no basis of colours");
    check("-part 10 -10 0 20", 2, "must increase from west to east");
    check("-vc 0 0 0", 1, "no direction to look in");
    check("no-such-file.png", 1, "No such file");
}

#[test]
fn what_is_no_panorama_is_refused() {
    let check = |file: &[u8], expected: &str| UGWARP.refuses("", file, 1, expected);
    check(b"GIF89a", "it is a GIF picture; convert it to PNG, JPEG, HDR, EXR or PFM");
    check(
        b"v a 0 0 0 ;",
        "not a picture of a kind that is read: PNG, JPEG, HDR, EXR or PFM; scenes are drawn by",
    );
    check(b"\xff\xd8\xff\xe0", "not a readable JPEG file: the file is truncated");
    check(b"#?RADIANCE\n", "not a readable HDR file");
    check(b"\x76\x2f\x31\x01", "not a readable EXR file");
    let shaped = |size: [u32; 2]| {
        let pixels = vec![[9, 9, 9, 255]; (size[0] * size[1]) as usize];
        Format::Png.encode(&Frame::new(size, true, pixels), &Metadata::default())
    };
    check(&shaped([60, 40]), "60 x 40 pixels are not the shape of a panorama");
    check(&shaped([8, 4]), "has too few pixels");
    UGWARP.output("-sz 20 10 -part -60 60 -40 40", shaped([60, 40]));
    let file = sky();
    for length in (0..file.len() - 30).step_by(37) {
        UGWARP.refuses("-sz 8 8", &file[..length], 1, "ugwarp: error: ");
    }
}

/// Light that is not finite is counted, and drawn as a finite number.
#[test]
fn light_that_is_not_finite_is_bounded() {
    let mut frame = LinearFrame::new([64, 32], true, vec![[0.5, 0.5, 0.5, 1.0]; 64 * 32]);
    let file = |frame: &LinearFrame| {
        Format::Exr.encode_linear(frame, &Metadata::default(), ugimage::Compression::Fast)
    };
    let options = "-sz 8 8 -dt pfm --no-doppler --no-flux";
    assert_eq!(UGWARP.notes(options, file(&frame)), "");
    let middle = 16 * 64 + 32;
    frame.pixels_mut()[middle] = [f32::NAN, 0.5, f32::NAN, 1.0];
    frame.pixels_mut()[middle + 1] = [0.5, f32::INFINITY, f32::NEG_INFINITY, 1.0];
    let output = UGWARP.run(options, file(&frame));
    assert!(
        messages(&output).contains("2 pixels of the panorama are not finite"),
        "{}",
        messages(&output)
    );
    let numbers = output.stdout[output.stdout.len() - 4 * 3 * 64..].chunks_exact(4);
    for number in numbers {
        assert!(f32::from_le_bytes(number.try_into().unwrap()).is_finite());
    }
}

/// Negative light, of lossy compression, is counted and is 0.
#[test]
fn negative_light_is_black() {
    let draw = |light: f32| {
        let frame = LinearFrame::new([64, 32], true, vec![[light, 0.5, light, 1.0]; 64 * 32]);
        let file =
            Format::Exr.encode_linear(&frame, &Metadata::default(), ugimage::Compression::Fast);
        UGWARP.run("-sz 8 8 -dt pfm -cv 0 .5 0", file)
    };
    let (negative, black) = (draw(-0.25), draw(0.0));
    let expected = "2048 pixels of the panorama have negative light, which counts as 0";
    assert!(messages(&negative).contains(expected), "{}", messages(&negative));
    assert!(!messages(&black).contains("negative") && negative.stdout == black.stdout);
}

/// A list of stars is drawn in place of a panorama or in front of one, with the same bytes on any
/// number of threads.
#[test]
fn lists_of_stars_are_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let star = |idx: u32| {
        let [ra, dec] = [idx * 7 % 360, idx * 11 % 180].map(f64::from);
        format!("{ra},{},{},{}\n", dec - 90.0, idx % 5, 3000 + 50 * idx)
    };
    let list: String = (0..300).map(star).collect();
    let list = format!("ra,dec,mag,kelvin\n{list}");
    std::fs::write(folder.path().join("stars.csv"), &list).unwrap();
    let ugwarp = UGWARP.in_folder(&folder);
    for options in
        ["-fish 180 -sz 80 60", "-pan -sz 80 60", "-va 100 -sz 80 60", "-cube -sz 240 40"]
    {
        let drawn = |threads: u32, more: &str, input: &[u8]| {
            ugwarp.output(&format!("{options} -cv .4 .6 0 -qt -nt {threads} {more}"), input)
        };
        let one = drawn(1, "", list.as_bytes());
        assert_eq!(one, drawn(7, "", list.as_bytes()));
        let both = drawn(1, "--stars stars.csv -sp", &sky());
        assert_eq!(both, drawn(7, "--stars stars.csv -sp", &sky()));
        assert!(both != one && both != drawn(2, "-sp", &sky()));
    }
    ugwarp.refuses("--stars stars.csv --br photon", sky(), 2, "`-br`");
    ugwarp.refuses("-part -10 10 -5 5", &list, 2, "the input is a list of stars: leave out -from");
    ugwarp.refuses("--basis mixture", &list, 2, "leave out -br, --basis");
    ugwarp.refuses("--star-width 0", &list, 2, "0.5 to 50 pixels wide");
    ugwarp.refuses("", "ra,dec,mag,kelvin\n1,2,3,x\n", 1, "<stdin>:2:7");
    ugwarp.refuses("--stars no-such-list.csv", sky(), 1, "No such file");
}

/// The camera of a scene, by name and with a path from a table beside it, looks where it is told.
#[test]
fn cameras_come_from_scenes() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    file("flight.csv", "t,x,y,z\n0,0,0,0\n10,0,5,0\n20,0,10,0\n");
    file(
        "flight.ug",
        "motion ship -path flight.csv; cam -ep 0 0 0 -vc 1 0 0 <ship>;
         cam ahead -ep 0 0 0 -vc 0 1 0 -va 70 <ship>;",
    );
    file("bare.ug", "v a 0 0 0;");
    file("broken.ug", "v a 0 0;");
    let ugwarp = UGWARP.in_folder(&folder);
    let numbers = |args: &str| {
        let args = format!("-sz 40 30 -dt pfm -sp --allow-outside {args}");
        assert_eq!(ugwarp.notes(&args, sky()), "");
        let bytes = ugwarp.output(&args, sky());
        let words = bytes[bytes.len() - 40 * 30 * 12..].chunks(4);
        words.map(|word| f32::from_le_bytes(word.try_into().unwrap())).collect::<Vec<f32>>()
    };
    let check = |scene: &str, plain: &str| {
        let seen = numbers(&format!("--scene flight.ug --time 3 {scene}"));
        for (seen, expected) in seen.iter().zip(numbers(plain)) {
            let is_near = (seen - expected).abs() < 1e-4 * expected.abs().max(0.01);
            assert!(is_near, "{scene}: {seen} {expected}");
        }
    };
    check("", "-cv 0 .5 0 -vc 1 0 0");
    check("-cam ahead", "-cv 0 .5 0 -va 70");
    check("-cam ahead -vc 0 0 1 -ud 1 0 0 -va 30", "-cv 0 .5 0 -vc 0 0 1 -ud 1 0 0 -va 30");
    ugwarp.refuses("--scene flight.ug -cv 0 0 0", sky(), 2, "cannot be given together");
    ugwarp.refuses("-ti 2", sky(), 2, "--scene");
    ugwarp.refuses("-cam ahead", sky(), 2, "name the scene of the camera with --scene");
    ugwarp.refuses("--scene flight.ug --allow-outside -cam astern", sky(), 1, "astern");
    ugwarp.refuses("--scene flight.ug --allow-outside -og", sky(), 2, "leave out -og");
    ugwarp.refuses("--scene bare.ug", sky(), 1, "the scene has no camera: add a `cam` statement");
    ugwarp.refuses("--scene broken.ug", sky(), 1, "broken.ug:1");
}

/// Infrared light is a file of its own, and white infrared light brightens what is ahead.
#[test]
fn infrared_light_is_a_second_file() {
    let folder = tempfile::tempdir().unwrap();
    let white = Frame::new([64, 32], true, vec![[255; 4]; 64 * 32]);
    let file = Format::Png.encode(&white, &Metadata::default());
    std::fs::write(folder.path().join("infrared.png"), file).unwrap();
    let ugwarp = UGWARP.in_folder(&folder);
    let mean = |options: &str| {
        let args =
            format!("-sz 8 8 -va 30 -dt ppm -cv 0 .6 0 -ex -3 --infrared infrared.png {options}");
        let file = ugwarp.output(&args, sky());
        file[file.len() - 192..].iter().map(|&byte| f64::from(byte)).sum::<f64>() / 192.0
    };
    let (all, none) = (mean(""), mean("--infrared-to 831"));
    assert!(all > none + 30.0, "{all} {none}");
    ugwarp.refuses("--infrared infrared.png -br photon", sky(), 2, "-br");
    ugwarp.refuses("--infrared infrared.png --infrared-to 700", sky(), 2, "more than 830 nm");
    ugwarp.refuses("--ultraviolet no-such-file.png", sky(), 1, "no-such-file.png");
    ugwarp.refuses("--ultraviolet infrared.png", "ra,dec,mag,kelvin\n", 2, "leave out");
}
