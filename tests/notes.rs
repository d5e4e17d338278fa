//! Notes on colours in real pipes: each is printed once, by the program where it happens.

use ugtests::programs;
use ugtests::shell::Shell;

/// Yellow walls and a red roof that share vertices.
const HOUSE: &str = "c yellow 1 50 .6; c red .9 0 .8;
v a 0 0 0; v b 3 0 0; v c 3 2 0; v d 0 2 0; v e 0 0 2; v f 3 0 2; v g 3 2 2; v h 0 2 2;
v i 0 1 3; v j 3 1 3;
f (a b f e) yellow; f (b c g j f) yellow; f (c d h g) yellow; f (d a e i h) yellow;
f (e f j i) red; f (g h i j) red;
l .35; l .65 -.4 -1 .6; cam -ep 1.5 -12 4 -vc 1.5 1 1.3 -va 32;
";

const MIXED: &str = "note: colours are mixed at 6 vertices where faces of different colours meet; -vr keeps them apart\n";

/// The error output of a pipe of these commands, which succeeds and writes a picture.
#[track_caller]
fn messages(pipe: &str, scene: &str) -> String {
    let mut text = scene.as_bytes().to_vec();
    let mut messages = String::new();
    for command in pipe.split('|') {
        let output = programs::fed(command, &text);
        messages += &ugtesting::run::messages(&output);
        assert!(output.status.success(), "{pipe}: {messages}");
        text = output.stdout;
    }
    assert!(text.starts_with(b"\x89PNG"), "{pipe}");
    messages
}

#[test]
fn mixed_colours_are_noted_once() {
    let check = |pipe: &str, expected: &str| {
        let pipe = pipe.replace("ugrainbow", "ugrainbow -sz 64 48 -aa 2");
        assert_eq!(messages(&pipe, HOUSE), expected, "{pipe}");
    };
    check("ugrainbow", &format!("ugrainbow: {MIXED}"));
    check("ugrainbow -vr", "");
    check("ugrainbow --repeat-vertices", "");
    check("ugrainbow -qt", "");
    check("uglorentz -vel .9 0 0 -in | ugrainbow", &format!("ugrainbow: {MIXED}"));
    check("uglorentz -vel .9 0 0 -in | ugrainbow -vr", "");
    check("uglorentz -vel .9 0 0 -in -vr | ugrainbow", "");
    check("uglorentz -sd 3 | ugrainbow -vr", "");
    check("uglorentz -sd 1 -vel .01 0 0 -in | ugrainbow -xc", &format!("ugrainbow: {MIXED}"));
    check("uglorentz -sd 1 -vel .01 0 0 -in | ugrainbow -xc -vr", "");
    check("uglorentz | ugdoppler | ugrainbow", &format!("ugdoppler: {MIXED}"));
    check("uglorentz | ugdoppler -sp | ugrainbow", &format!("ugdoppler: {MIXED}"));
    check("uglorentz | ugdoppler -vr | ugrainbow", "");
    check("uglorentz -vr | ugdoppler | ugrainbow", "");
    check(
        "ugdoppler | ugrainbow -vr",
        &format!(
            "ugdoppler: {MIXED}ugrainbow: note: -vr has no effect on colours as seen, which every vertex has: \
             give it to ugdoppler\n"
        ),
    );
}

/// A pure green square that moves across: D = 1 / γ where it is seen at right angles to the motion.
#[test]
fn a_picture_without_visible_wavelengths_says_so() {
    let scene = |saturation: f64| {
        format!(
            "c green .9 120 {saturation}; v a -1 9 -1; v b 1 9 -1; v c 1 9 1; v d -1 9 1; f (a b c d) green;
             l 1; cam -ep 0 0 0 -vc 0 9 0 -va 20;"
        )
    };
    let check = |saturation: f64, speed: &str, expected: &str| {
        let pipe =
            format!("uglorentz -in -vel {speed} 0 0 | ugdoppler | ugrainbow -sz 64 48 -aa 2");
        let found = messages(&pipe, &scene(saturation));
        let remedy = "its wavelengths are outside 380-780 nm; give ugdoppler and \
                      ugrainbow -look light, or -look shape to see the shape";
        let expected = match expected {
            "" => String::new(),
            share => format!("ugrainbow: note: {share}: {remedy}\n"),
        };
        assert_eq!(found, expected, "{saturation} {speed}");
    };
    // γ = 2.29: 546.1 nm is seen at 1253 nm.
    check(1.0, ".9", "all that is in the picture is black");
    check(0.5, ".9", "all that is in the picture is black or grey");
    // γ = 1.005.
    check(1.0, ".1", "");
}

#[test]
fn red_green_and_blue_that_are_read_as_lightness_and_hue_are_noted_once() {
    let scene = HOUSE.replace("c red .9 0 .8", "c red 1 0 0");
    let pipe = "uglorentz -vel .1 0 0 -in -vr | ugdoppler -hd | ugrainbow -sz 64 48";
    let found = messages(pipe, &scene);
    assert_eq!(
        found.matches("colour `red` is white, not red, green and blue").count(),
        1,
        "{found}"
    );
    assert!(found.contains("for red 1, green 0, blue 0 write `c_rgb red 1 0 0`"), "{found}");
}

/// A lamp in a closed box of its own motion lights nothing outside. In a room with the eye, above
/// an open box, in a box of glass, and without shadows it does.
#[test]
fn a_lamp_in_a_closed_body_is_named() {
    let cube = |half: f64, motion: &str, faces: &[&str], color: &str| {
        let corner = |name: &str| {
            let at = |letter: char| if name.contains(letter) { half } else { -half };
            format!("v {name} {} {} {};", at('x'), at('y'), at('z'))
        };
        let corners: String = ["o", "x", "xy", "y", "z", "xz", "xyz", "yz"].map(corner).concat();
        let faces: String =
            faces.iter().map(|face| format!("f ({face}) {color} {motion};")).collect();
        format!("{corners} {faces}")
    };
    let closed = ["o y xy x", "z xz xyz yz", "o x xz z", "x xy xyz xz", "xy y yz xyz", "y o z yz"];
    let inside = ["x xy y o", "yz xyz xz z", "z xz x o", "xz xyz xy x", "xyz yz y xy", "yz z o y"];
    let stage = "c grey 0.5; c glass 0.5 0 0 0.5; cam -ep 0 -6 0 -vc 0 0 0 -va 40;";
    let motion = "<.3 0 0>";
    let check = |options: &str, body: &str, lamp: &str, is_named: bool| {
        let text = format!("{stage} l .2; l bulb 1 0 0 0 0 {lamp}; {body}");
        let found = messages(&format!("ugphoton -sz 16 12 {options}"), &text);
        let named = "ugphoton: note: the light of lamp `bulb` does not leave the closed body that it is in: move \
                     it out, or give --no-shadows\n";
        assert_eq!(found.contains(named), is_named, "{options} {body}: {found}");
    };
    check("", &cube(1.0, motion, &closed, "grey"), motion, true);
    check("", &cube(1.0, "", &closed, "grey"), "", true);
    check("--no-shadows", &cube(1.0, motion, &closed, "grey"), motion, false);
    check("", &cube(1.0, motion, &closed[1..], "grey"), motion, false);
    check("", &cube(1.0, motion, &closed, "glass"), motion, false);
    check("", &cube(9.0, "", &inside, "grey"), "", false);
}

/// At every time that a note names, something that moves is in the picture.
#[test]
fn times_that_are_named_show_what_moves() {
    let shell = Shell::new(&[]);
    let ball = "def ball; v a -.3 -.3 0; v b .3 -.3 0; v c .3 .3 0; v e -.3 .3 0; v t 0 0 .4;
                f (a b t); f (b c t); f (c e t); f (e a t); end; l 1;";
    let mut n_notes = 0;
    let mut check = |scene: &str, has_time: bool| {
        shell.write("a.ug", format!("{ball} {scene}"));
        let picture =
            |time: f64| format!("uglorentz -ti {time} a.ug | ugrainbow -sz 64 48 -aa 4 -fo a.png");
        for time in [0.0, 7.0] {
            let [_, messages] = shell.run(&picture(time));
            let Some(note) = messages.split("nothing that moves is in the picture").nth(1) else {
                continue;
            };
            n_notes += 1;
            let named = note.split("it is with -ti ").nth(1);
            assert_eq!(named.is_some(), has_time, "{scene}: {messages}");
            let words = named.unwrap_or_default().lines().next().unwrap_or_default();
            let mut times: Vec<f64> =
                words.split([' ', ',']).filter_map(|word| word.parse().ok()).collect();
            if let [first, last, _] = times[..] {
                times.extend([0.2, 0.4, 0.6, 0.8].map(|part| first + part * (last - first)));
            }
            for named in times {
                shell.run(&picture(named));
                let is_lit = shell.pixels("a.png").iter().any(|pixel| pixel[0] > 0);
                assert!(is_lit, "{scene}: {time}: {named}: {messages}");
            }
        }
    };
    // On a rim, 53 degrees from what the camera sees up to 45 degrees away, always.
    let rim = "motion d -spin 0 0 .4; i (ball); cam -ep 2 0 0 -vc 0 0 0 -va 90 <d>;";
    check(rim, false);
    for eye in [2.0, -3.0, 5.0] {
        let rate = 0.8 / libm::fabs(eye);
        let spin = format!("motion d -spin 0 0 {rate}; i (ball -tx -9 -ty 3);");
        check(&format!("{spin} cam -ep {eye} 0 0 -vc {eye} 9 0 -va 30 <d>;"), true);
        let orbit = format!("motion d -at {eye} 0 0 -orbit 0 0 0 0 0 1 {rate};");
        check(&format!("{orbit} i (ball -tx {eye}) <d>; cam -ep 0 -9 1 -vc 40 30 1 -va 8;"), false);
        check(&format!("{orbit} i (ball -tx {eye}) <d>; cam -ep 0 -9 1 -vc 0 0 0 -va 12;"), true);
    }
    assert!(n_notes >= 7, "{n_notes}");
}
