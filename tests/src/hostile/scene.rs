//! Scenes: of random statements, and those of the repository, damaged.

use std::fmt::Write;

use ugtesting::Random;

use super::{Files, bytes, motion, words};
use crate::scenes;

/// A scene and files it names.
pub fn files(random: &mut Random) -> (Files, &'static str) {
    (named(text(random)), "scene")
}

/// The same files with this scene.
pub fn named(text: Vec<u8>) -> Files {
    let part = b"v part 0 0 1 ;\n".to_vec();
    vec![("scene.ug".to_owned(), text), ("part.ug".to_owned(), part)]
}

/// A scene.
pub fn text(random: &mut Random) -> Vec<u8> {
    let mut text = match random.below(6) {
        0 | 1 => known(random),
        2 => motion::wild(random).into_bytes(),
        _ => statements(random).into_bytes(),
    };
    if random.one_in(3) {
        bytes::damage(random, &mut text);
    }
    text
}

/// A scene of the repository that is not large.
pub fn known(random: &mut Random) -> Vec<u8> {
    const NAMES: [&str; 10] =
        ["ship", "cubes", "dice", "glass", "halves", "traffic", "lamp", "rainbow", "twins", "orbit"];
    let path = scenes::root().join("scenes").join(random.pick(&NAMES)).with_extension("ug");
    std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn statements(random: &mut Random) -> String {
    let mut text = String::new();
    let n_vertices = 3 + random.below(9);
    for idx in 0..n_vertices {
        let position = point(random);
        let color = if random.one_in(5) { format!(" red{}", random.below(3)) } else { String::new() };
        let normal = if random.one_in(8) { format!(" ({})", point(random)) } else { String::new() };
        let _ = writeln!(text, "v v{idx} {position}{color}{normal} ;");
    }
    for idx in 0..3 {
        let _ = writeln!(text, "{}", color(random, idx));
    }
    for _ in 0..1 + random.below(12) {
        statement(random, n_vertices, &mut text);
    }
    text
}

fn statement(random: &mut Random, n_vertices: usize, text: &mut String) {
    let color = if random.one_in(2) { format!(" red{}", random.below(3)) } else { String::new() };
    let velocity = if random.one_in(3) { format!(" <{}>", velocity(random)) } else { String::new() };
    let _ = match random.below(24) {
        0..=8 => {
            writeln!(text, "f{} {}{color}{velocity} ;", optional_name(random), contours(random, n_vertices))
        }
        9 => writeln!(text, "w {}{color} ;", contours(random, n_vertices)),
        10 => writeln!(text, "l {} {}{color}{velocity} ;", words::number(random), point(random)),
        11 => writeln!(
            text,
            "l {} {} {} {}{velocity} ;",
            words::number(random),
            point(random),
            words::number(random),
            if random.one_in(2) { words::number(random) } else { String::new() }
        ),
        12 => writeln!(text, "cam -ep {} -vc {}{velocity} ;", point(random), point(random)),
        13 => {
            let n_deep = 1 + random.below(4);
            let name = words::name(random);
            let _ = writeln!(text, "def {name} ; v q {} ; f (q v0 v1) ; end ;", point(random));
            writeln!(
                text,
                "a ({name}) {} -tx {} -rz {} ;",
                random.below(1 << (4 * n_deep)),
                words::number(random),
                words::number(random)
            )
        }
        14 => writeln!(text, "i {} (d) -sa {} ;", words::name(random), words::number(random)),
        15 => {
            let path = *random.pick(&["part.ug", "scene.ug", ".", "/dev/zero", "/dev/stdin", "missing", ""]);
            writeln!(text, "include {path} ;")
        }
        19 => {
            // None of them is a program.
            let path = *random.pick(&["part.ug", ".", "missing", "/dev/null"]);
            writeln!(text, "execute {path} ;")
        }
        16 => writeln!(text, "{{{}}}", " \n".repeat(random.below(3000))),
        17 => writeln!(text, "( ug {} )", words::name(random)),
        18 => writeln!(text, "# {} \"{}\"", random.below(1 << 20), words::name(random)),
        _ => writeln!(text, "{} {} ;", words::name(random), words::number(random)),
    };
}

fn optional_name(random: &mut Random) -> String {
    if random.one_in(3) { format!(" {}", words::name(random)) } else { String::new() }
}

/// Contours: mostly a triangle or a few corners; sometimes very many, repeated ones.
fn contours(random: &mut Random, n_vertices: usize) -> String {
    let n_contours = match random.below(30) {
        0 => random.below(300),
        1..=4 => 2,
        _ => 1,
    };
    let mut text = String::new();
    for _ in 0..n_contours {
        let n_corners = match random.below(40) {
            0 => random.below(3000),
            1..=8 => 4 + random.below(6),
            _ => 3,
        };
        let corners: Vec<String> = (0..n_corners).map(|_| format!("v{}", random.below(n_vertices))).collect();
        let _ = write!(text, "({}) ", corners.join(" "));
    }
    text
}

fn color(random: &mut Random, idx: usize) -> String {
    let numbers = [(); 3].map(|()| words::number(random)).join(" ");
    match random.below(8) {
        6 => {
            let times = [(); 2].map(|()| words::number(random));
            let option = ["", "-step", "-period 3"][random.below(3)];
            format!("c_time red{idx} {option} {} red0 {} red1 ;", times[0], times[1])
        }
        0 => format!("c_rgb red{idx} {numbers} ;"),
        1 => format!("c_xyz red{idx} {numbers} ;"),
        2 => format!("c_bb red{idx} {} ;", words::number(random)),
        3 => format!("c_spd red{idx} 400 1 500 {} 600 1 ;", words::number(random)),
        4 => format!("c red{idx} {numbers} {} ;", words::number(random)),
        5 => format!("c red{idx} {numbers} {} {} ;", words::number(random), words::number(random)),
        _ => {
            format!("c red{idx} 1 {} 1 ; c_mix red{idx} red0 {} ;", random.below(360), words::number(random))
        }
    }
}

fn point(random: &mut Random) -> String {
    [(); 3].map(|()| words::number(random)).join(" ")
}

fn velocity(random: &mut Random) -> String {
    words::velocity(random).join(" ")
}
