//! Errors and notes about pictures that cannot be drawn or show nothing.

use ugphysics::Hsv;
use ugpipe::Words;
use ugrainbow::{Background, Config, HueScale, Wireframe, render};

use crate::common::{SQUARE, scene, with};
use crate::render::{BLACK, notes, plain};

#[test]
fn sizes_that_do_not_fit_are_refused() {
    #[track_caller]
    fn check(size: [u32; 2], samples: u32, message: &str) {
        let error = render(
            &scene("l 1;"),
            &with(&Config::default(), |picture| (picture.size, picture.samples) = (size, samples)),
        )
        .unwrap_err();
        assert!(error.is_usage());
        assert_eq!(error.words(), message);
    }
    for [width, height] in [[32_768, 16_384], [0, 7], [u32::MAX, 1]] {
        let message = format!(
            "a picture of {width} x {height} pixels cannot be made: the limit is 268435456 pixels in all and \
             16777216 along a side; give a smaller -sz"
        );
        check([width, height], 4, &message);
    }
    check(
        [8, 8],
        17,
        "17 x 17 samples a pixel cannot be taken, only 1 to 16 along a side: give another -aa",
    );
    check(
        [8, 8],
        0,
        "0 x 0 samples a pixel cannot be taken, only 1 to 16 along a side: give another -aa",
    );
}

#[test]
fn scenes_without_a_picture_are_errors() {
    #[track_caller]
    fn check(text: &str, message: &str) {
        assert_eq!(render(&scene(text), &plain(4, 4)).unwrap_err().words(), message);
    }
    check(
        "v a 0 0 0; v b 1 0 0; l 1;",
        "nothing is drawn: the scene has no faces and no wires, only 2 points; make a surface of a cloud of \
         points first",
    );
    check(
        "",
        "nothing is drawn: the scene has no faces and no wires; check that the program before in the pipe \
         wrote one",
    );
    for (camera, message) in [
        (
            "",
            "the eye point 0 0 0 is also the view centre, so there is no direction to look in; move the eye \
             with -ep or the centre with -vc",
        ),
        (
            "cam -ep 0 0 5 -va 180 40;",
            "a view angle of 180 degrees cannot be projected on a flat picture; give -va more than 0 and less \
             than 180",
        ),
        (
            "cam -ep 0 0 5 -fs 1 1 -fl 0;",
            "the film size and the focal length of the camera must be positive; correct -fs and -fl of the \
             `cam` statement, or give -va",
        ),
        (
            "cam -ep 0 0 5 -ph 0 0 0 1;",
            "the film rectangle of the camera has no area; give -ph of the `cam` statement as min x, min y, \
             max x, max y",
        ),
        (
            "cam -ep 0 0 5 -cl 3 2;",
            "nothing lies between the clipping distances 3 and 2; give -cl of the `cam` statement as hither \
             and a greater yon",
        ),
    ] {
        check(&format!("{SQUARE} f (a b c d); {camera}"), message);
    }
}

#[test]
fn pictures_in_which_nothing_is_seen_say_why() {
    #[track_caller]
    fn check(text: &str, config: &Config, expected: &[&str]) {
        let notes = notes(text, config);
        assert_eq!(notes, expected);
    }
    let square = format!("c green 1 120; c far 1 900; c black 0; l 1; {SQUARE} f (a b c d)");
    let config = plain(32, 32);
    check(&format!("{square}; cam -ep 1 0 20;"), &config, &[]);
    for (camera, note) in [
        (
            "-ep 0 0 20 -vc 0 0 30 -ud 0 1 0",
            "everything is behind the eye or outside the clipping distances; try --keep-in-view \
             (uglorentz, ugphoton), another -ep or -vc",
        ),
        (
            "-ep 0 0 20 -vc 90 0 0",
            "everything is outside the picture, where fast bodies often are; try --keep-in-view \
             (uglorentz, ugphoton), another -vc or a wider -va",
        ),
        (
            "-ep 30 0 0 -vc 0 0 0",
            "everything is seen edge-on, thinner than a sample; try another -ep",
        ),
        (
            "-ep 0 0 90000 -vc 0 0 0 -ud 0 1 0",
            "everything is smaller than a sample; try a nearer -ep, a narrower -va or a larger -sz",
        ),
    ] {
        check(
            &format!("{square}; cam {camera};"),
            &config,
            &[&format!("nothing is drawn: {note}")],
        );
    }
    let clear = square.replace("c green 1 120;", "c green 1 120 1 1;") + " green";
    let clear_note = "nothing is drawn: all faces are fully transparent; give their colours a translucency \
                      below 1";
    check(&format!("{clear}; cam -ep 1 0 20;"), &config, &[clear_note]);
    let culled = Config { cull: true, ..config.clone() };
    let behind =
        "nothing is drawn: everything is seen from behind; leave out -cb, or turn the faces round";
    check(&format!("{square}; cam -ep 1 0 -20 -vc 0 0 0;"), &culled, &[behind]);
    let wavelengths = Config { hue_scale: HueScale::Wavelengths, ..config.clone() };
    let out_of_sight = |what: &str| {
        format!(
            "{what}: its wavelengths are outside 380-780 nm; give ugdoppler and ugrainbow -look light, or \
             -look shape to see the shape"
        )
    };
    let black = out_of_sight("all that is in the picture is black");
    check(&format!("{square} far; cam -ep 1 0 20;"), &wavelengths, &[&black]);
    // The white part of a pale colour stays visible.
    let moved = "c far .5 900 .8; v e 30 0 0; v f 31 0 0; v g 30 1 0; f (e f g) far";
    let grey = out_of_sight("all that is in the picture is black or grey");
    check(
        &format!("{moved}; l 1; cam -ep 30.2 .2 20 -vc 30.2 .2 0 -ud 0 1 0;"),
        &wavelengths,
        &[&grey],
    );
    // The picture is 40 tan 2.5° = 1.746 wide, so 1.373 / 1.746 of it is out of range, then 0.373.
    let parts = |near: f64| {
        format!(
            "c far 1 900; c green 1 546; l 1; v a -1 -1 0; v b 1 -1 0; v c 1 1 0; v d -1 1 0; v e {near} -1 0; \
             v f {near} 1 0; v g {near} -1 0; v h {near} 1 0; f (a e f d) far; f (g b c h) green; \
             cam -ep 0 0 20 -vc 0 0 0 -ud 0 1 0 -va 5;"
        )
    };
    let most = out_of_sight("78 percent of what is in the picture is black or grey");
    check(&parts(0.5), &wavelengths, &[&most]);
    check(&parts(-0.5), &wavelengths, &[]);
    let dark = "all that is in the picture is black: its colours are, or the light of its lamps does not reach it \
                at this time, or falls between the vertices";
    check(&format!("{square} black; cam -ep 1 0 20;"), &config, &[dark]);
    // Black lines, on black and on white.
    let lines = Config {
        wireframe: Some(Wireframe { has_faces: false, color: Some(BLACK), ..Wireframe::default() }),
        ..config.clone()
    };
    let text = format!("{square}; cam -ep 1 0 20;");
    check(&text, &lines, &["the lines are black on black: choose another colour with -lc or -bg"]);
    let mut on_white = lines;
    on_white.picture.background = Background::Color(Hsv { value: 1.0, ..BLACK });
    check(&text, &on_white, &[]);
    check(
        &format!("{square}; l .25; cam -ep 0 0 20;"),
        &config,
        &[
            "the up direction is zero or parallel to the view, so another axis is up; choose one with -ud",
            "max intensity is 1.25, clip to 1.0",
        ],
    );
    check(
        &format!("{square}; l 1; cam -ep 1 0 20;"),
        &config,
        &["max intensity is 2.0, clip to 1.0"],
    );
    check(
        &format!("c clear 1 0 1 .5; {SQUARE} f (a b c d) clear; cam -ep 1 0 20;"),
        &config,
        &["no lights in the scene: drawn with ambient light 0.3 and a light of 0.7 from the eye"],
    );
}
