//! Where faces of different colours meet, their colours are mixed or kept apart (`-vr`), however
//! faces are cut.

use glam::DVec3;
use uglorentz::Pieces;
use ugtests::picture::{assert_same, decode};
use ugtests::pipe::{Pipe, doppler, lorentz, rainbow};

/// The lights and the camera of the scenes.
const FRAME: &str = "l .35; l .65 -.4 -1 .6; cam -ep 1.5 -12 4 -vc 1.5 1 1.3 -ud 0 0 1 -va 32 24;";

/// The corners and triangles of a house: walls of the first colour, a roof of the second.
const CORNERS: [(&str, [f64; 3]); 10] = [
    ("a", [0.0, 0.0, 0.0]),
    ("b", [3.0, 0.0, 0.0]),
    ("c", [3.0, 2.0, 0.0]),
    ("d", [0.0, 2.0, 0.0]),
    ("e", [0.0, 0.0, 2.0]),
    ("f", [3.0, 0.0, 2.0]),
    ("g", [3.0, 2.0, 2.0]),
    ("h", [0.0, 2.0, 2.0]),
    ("i", [0.0, 1.0, 3.0]),
    ("j", [3.0, 1.0, 3.0]),
];
const FACES: [(&str, usize); 14] = [
    ("abf", 0),
    ("afe", 0),
    ("bcg", 0),
    ("bgf", 0),
    ("fgj", 0),
    ("cdh", 0),
    ("chg", 0),
    ("dae", 0),
    ("deh", 0),
    ("eih", 0),
    ("efj", 1),
    ("eji", 1),
    ("ghi", 1),
    ("gij", 1),
];

/// The house with statements for its colours `wall` and `roof`. `own`: the colour of a corner.
/// With `is_apart` the faces of a colour have vertices of their own.
fn house(colors: &str, own: Option<(&str, &str)>, is_apart: bool) -> String {
    let mut text = format!("{colors} {FRAME}\n");
    let sides = if is_apart { &["0", "1"][..] } else { &["0"] };
    for side in sides {
        for (name, [x, y, z]) in CORNERS {
            let color = own.filter(|(corner, _)| *corner == name).map_or("", |(_, color)| color);
            text += &format!("v {name}{side} {x} {y} {z} {color};\n");
        }
    }
    for (corners, color) in FACES {
        let side = if is_apart { color } else { 0 };
        let corners: Vec<String> =
            corners.chars().map(|corner| format!("{corner}{side}")).collect();
        text += &format!("f ({}) {};\n", corners.join(" "), ["wall", "roof"][color]);
    }
    text
}

const YELLOW_AND_RED: &str = "c wall 1 50 .6; c roof .9 0 .8;";

fn pipe(beta: f64, pieces: Pieces) -> Pipe {
    let mut pipe = Pipe::new(DVec3::X * beta, [200, 150]);
    pipe.lorentz.pieces = pieces;
    pipe.lorentz.in_place = true;
    pipe
}

#[test]
fn mixtures_do_not_depend_on_how_faces_are_cut() {
    let check = |name: &str, text: &str, levels: u8| {
        let pictures = [1, 2, 16].map(|n| {
            let pipe = pipe(0.0, Pieces::PerEdge(n));
            let seen = lorentz(text.as_bytes(), &pipe.lorentz);
            let alone = decode(&rainbow(&seen, &pipe.rainbow));
            let colored = decode(&rainbow(&doppler(&seen, &pipe.doppler), &pipe.rainbow));
            [alone, colored]
        });
        for (row, [alone, colored]) in pictures.iter().enumerate() {
            assert_same(&format!("mixed-{name}-{row}"), &pictures[0][0], alone, levels);
            assert_same(&format!("mixed-{name}-{row}-coloured"), &pictures[0][1], colored, levels);
        }
    };
    check("hues", &house(YELLOW_AND_RED, None, false), 1);
    // Between these the interpolated hue passes green.
    check("far-hues", &house("c wall 1 0 1; c roof .8 240 .7;", None, false), 2);
    check("greys", &house("c wall .4; c roof .9 120 .8;", None, false), 2);
    check("white", &house("c roof .9 0 .8;", None, false).replace(" wall;", ";"), 1);
    check("translucent", &house("c wall 1 50 .6 .5; c roof .9 0 .8;", None, false), 2);
    check("screen", &house("c_rgb wall .2 .8 .3; c_rgb roof .9 .2 .2;", None, false), 2);
    check("light", &house("c_xyz wall .3 .6 .2; c_xyz roof .5 .3 .9;", None, false), 2);
    check("spectra", &house("c_bb wall 3000 .5; c_bb roof 9000 .4;", None, false), 2);
    let own = "c own .9 200 .7;";
    check("own", &house(&format!("{YELLOW_AND_RED} {own}"), Some(("b", "own")), false), 2);
    check("own-mixed", &house(&format!("{YELLOW_AND_RED} {own}"), Some(("f", "own")), false), 2);
    check(
        "own-one-colour",
        &house(&format!("c wall 1 50 .6; {own}"), Some(("f", "own")), false)
            .replace(" roof;", " wall;"),
        2,
    );
    let wires = house(&format!("{YELLOW_AND_RED} {own}"), None, false)
        + "w (a0 e0 f0 j0) own; w (i0 j0) own;";
    check("wires", &wires, 2);
}

#[test]
fn colours_are_kept_apart_by_every_program_alike() {
    let shared = house(YELLOW_AND_RED, None, false);
    let apart = house(YELLOW_AND_RED, None, true);
    for (beta, pieces) in
        [(0.0, Pieces::PerEdge(3)), (0.9, Pieces::UpTo(1e-4)), (0.2, Pieces::PerEdge(1))]
    {
        let plain = pipe(beta, pieces);
        let mut repeating = plain.clone();
        repeating.rainbow.repeat = true;
        let expected = decode(&rainbow(&lorentz(apart.as_bytes(), &plain.lorentz), &plain.rainbow));
        let seen = lorentz(shared.as_bytes(), &plain.lorentz);
        assert!(decode(&rainbow(&seen, &plain.rainbow)) != expected, "colours are mixed at {beta}");
        let last = decode(&rainbow(&seen, &repeating.rainbow));
        assert_same("apart-last", &expected, &last, 0);
        repeating.lorentz.repeat = true;
        let first = lorentz(shared.as_bytes(), &repeating.lorentz);
        assert_same("apart-first", &expected, &decode(&rainbow(&first, &plain.rainbow)), 0);

        let colored =
            |text: &[u8], config| decode(&rainbow(&doppler(text, config), &plain.rainbow));
        let expected = colored(&lorentz(apart.as_bytes(), &plain.lorentz), &plain.doppler);
        repeating.doppler.repeat = true;
        assert_same("apart-coloured", &expected, &colored(&seen, &repeating.doppler), 0);
        assert_same("apart-first-coloured", &expected, &colored(&first, &plain.doppler), 0);
    }
}

#[test]
fn a_scene_without_mixtures_is_not_changed() {
    let apart = house(YELLOW_AND_RED, None, true);
    let plain = pipe(0.9, Pieces::PerEdge(4));
    let mut repeating = plain.clone();
    repeating.lorentz.repeat = true;
    let seen = lorentz(apart.as_bytes(), &plain.lorentz);
    assert!(seen == lorentz(apart.as_bytes(), &repeating.lorentz));
    let text = String::from_utf8(seen).unwrap();
    assert!(!text.contains("mixtures") && !text.contains("mix#"));
}

/// Cut twice, at rest.
#[test]
fn mixtures_are_continued() {
    let text = house(YELLOW_AND_RED, None, false);
    let once = pipe(0.0, Pieces::PerEdge(4));
    let half = pipe(0.0, Pieces::PerEdge(2));
    let twice = lorentz(&lorentz(text.as_bytes(), &half.lorentz), &half.lorentz);
    let expected = decode(&rainbow(&lorentz(text.as_bytes(), &once.lorentz), &once.rainbow));
    assert_same("mixed-twice", &expected, &decode(&rainbow(&twice, &once.rainbow)), 1);
    let mut repeating = once.clone();
    repeating.rainbow.repeat = true;
    let apart = house(YELLOW_AND_RED, None, true);
    let expected = decode(&rainbow(apart.as_bytes(), &once.rainbow));
    assert_same("apart-twice", &expected, &decode(&rainbow(&twice, &repeating.rainbow)), 0);
}
