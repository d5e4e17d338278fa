//! Scenes with motions: sane, extreme and malformed.

use std::fmt::Write;

use ugtesting::Random;

use super::words;

/// A scene of bodies that accelerate, spin, orbit and ride on each other, slow enough for most
/// programs to draw.
pub fn sane(random: &mut Random) -> String {
    let n_motions = 1 + random.below(5);
    let mut motions = Vec::new();
    for row in 0..n_motions {
        motions.push(sane_motion(random, row));
    }
    let names = Names { n_motions, malformed: false };
    scene(random, motions, names)
}

/// Scenes whose motions are extreme or wrong: speeds near that of light, numbers at the limits of
/// their ranges, overlapping pieces, motions that ride on each other in a circle or in long chains,
/// and malformed statements.
pub fn wild(random: &mut Random) -> String {
    let motions = match random.below(16) {
        0 => {
            // Motions that nobody names, or that few of a few faces name.
            let n = *random.pick(&[300, 1000, 3000]);
            (0..n).map(|row| wild_motion(random, row, n)).collect()
        }
        1 => chain(random),
        2 => pieces(random),
        3 | 4 => vec![rim(random)],
        _ => {
            let n = 1 + random.below(6);
            (0..n).map(|row| wild_motion(random, row, n)).collect()
        }
    };
    let names = Names { n_motions: motions.len(), malformed: true };
    scene(random, motions, names)
}

/// A motion of a body within 4 units.
fn sane_motion(random: &mut Random, row: usize) -> String {
    let point = |random: &mut Random, size: f64| {
        random.in_cube(size).to_array().map(|part| format!("{part:.3}")).join(" ")
    };
    let mut text = format!("motion m{row} -at {}", point(random, 1.0));
    let rate = *random.pick(&[0.02, 0.1, 0.18]);
    match random.below(4) {
        0 if row > 0 => {
            let _ = write!(text, " -on m{}", random.below(row));
        }
        1 => {
            // In a circle through A, whose radius is at most 4.
            let [center, axis] = [random.in_cube(1.0), random.direction()];
            let [x, y, z] = center.to_array();
            let [u, v, w] = axis.to_array();
            let _ = write!(text, " -orbit {x} {y} {z} {u} {v} {w} {}", random.between(-0.2, 0.2));
        }
        2 if random.one_in(2) => {
            let [x, y, z] = random.in_ball(0.4).to_array();
            let rows = (-3..4).map(|k| {
                let k = f64::from(k);
                let [u, v, w] = random.in_cube(0.1).to_array();
                format!("{} {} {} {}", 2.0 * k, k * x + u, k * y + v, k * z + w)
            });
            let rows: Vec<String> = rows.collect();
            let _ = write!(text, " -path ({})", rows.join(" "));
        }
        kind => {
            let speed = *random.pick(&[0.5, 0.9, 0.999_999]);
            let [x, y, z] = (random.in_ball(speed)).to_array();
            let _ = write!(text, " -vel {x} {y} {z}");
            if kind == 2 {
                stretches(random, &mut text, "acc", rate);
            }
        }
    }
    if random.one_in(2) {
        stretches(random, &mut text, "spin", rate);
    }
    if random.one_in(9) {
        let _ = write!(text, " -shift {} {}", random.between(-2.0, 2.0), point(random, 2.0));
    }
    text + " ;\n"
}

/// One piece for ever, or up to 5 in succession.
fn stretches(random: &mut Random, text: &mut String, option: &str, size: f64) {
    let n = random.below(6);
    let mut from = random.between(-20.0, 0.0);
    for _ in 0..n.max(1) {
        let [x, y, z] = random.in_ball(size).to_array();
        let _ = write!(text, " -{option} {x} {y} {z}");
        if n > 0 {
            let to = from + random.between(0.01, 9.0);
            let _ = write!(text, " {from} {to}");
            from = if random.one_in(2) { to } else { to + random.unit() };
        }
    }
}

/// Options in any order and number, most of them possible.
fn wild_motion(random: &mut Random, row: usize, n: usize) -> String {
    let name = if random.one_in(25) { words::name(random) } else { format!("m{row}") };
    let mut text = format!("motion {name}");
    for _ in 0..random.below(5) {
        let _ = match random.below(20) {
            0..=2 => write!(text, " -at {}", numbers(random, 3)),
            3 | 4 => write!(text, " -vel {}", words::velocity(random).join(" ")),
            5..=8 => write!(text, " -acc {} {}", numbers(random, 3), times(random)),
            9..=12 => write!(text, " -spin {} {}", numbers(random, 3), times(random)),
            13 | 14 => {
                write!(text, " -orbit {} {} {}", numbers(random, 3), numbers(random, 3), number(random))
            }
            15 => write!(text, " -on m{}", random.below(n + 1)),
            16 => {
                let n_numbers = *random.pick(&[0, 4, 7, 8, 12, 40]);
                write!(text, " -path ({})", numbers(random, n_numbers))
            }
            17 | 18 => write!(text, " -shift {}", numbers(random, 4)),
            _ => {
                let option =
                    random.pick(&["-at", "-acc", "-spin", "-orbit", "-path", "-on", "-rotate", "-", "<m0>"]);
                let n_numbers = random.below(9);
                write!(text, " {option} {}", numbers(random, n_numbers))
            }
        };
    }
    text + if random.one_in(60) { "\n" } else { " ;\n" }
}

/// Motions that ride on the one before: as deep as is allowed, deeper, or in a circle.
fn chain(random: &mut Random) -> Vec<String> {
    let n = *random.pick(&[2, 63, 64, 65, 66, 2000]);
    let first = match random.below(3) {
        0 => format!(" -on m{}", n - 1),
        1 => " -vel 0.5 0 0 -acc 0.01 0 0".to_owned(),
        _ => " -orbit 0 1 0 0 0 1 0.1".to_owned(),
    };
    let spin = random.between(0.0, 0.02);
    let statement = |row: usize| match row {
        0 => format!("motion m0{first} ;\n"),
        _ => format!("motion m{row} -on m{} -at 0 0 0.{row} -spin 0 {spin} 0 ;\n", row - 1),
    };
    let mut statements: Vec<String> = (0..n).map(statement).collect();
    if random.one_in(2) {
        statements.reverse();
    }
    statements
}

/// A motion of very many pieces, some shorter than rounding at their own time.
fn pieces(random: &mut Random) -> Vec<String> {
    let n = *random.pick(&[30, 1000, 20_000]);
    let option = *random.pick(&["acc", "spin"]);
    let step = *random.pick(&[1.0, 0.01, 1e-15, 1e-300, 1e4]);
    let start = *random.pick(&[0.0, -500.0, 1e6, -1e15]);
    let size = *random.pick(&[0.01, 0.2, 1e-9]);
    let mut text = "motion m0".to_owned();
    for idx in 0..n {
        let [x, y, z] = random.in_ball(size).to_array();
        let at = |idx: usize| start + step * idx as f64;
        let _ = write!(text, " -{option} {x:e} {y:e} {z:e} {} {}", at(idx), at(idx + 1));
    }
    vec![text + " ;\n"]
}

/// A motion in which points at the distance 1 are as fast as light, or slower by a rounding error.
fn rim(random: &mut Random) -> String {
    const NEAR_ONE: [&str; 7] = [
        "1",
        "0.9999999999999999",
        "0.99999999999",
        "0.999999",
        "0.99",
        "1.0000000000000002",
        "0.7071067811865475",
    ];
    let rate = random.pick(&NEAR_ONE);
    let path = match random.below(5) {
        0 => format!("-acc {rate} 0 0 {}", times(random)),
        1 => format!("-orbit 0 1 0 0 0 1 {rate}"),
        2 => format!("-vel {} -spin 0 0 {rate}", words::velocity(random).join(" ")),
        3 => format!("-vel 0 0 -{rate} -acc 0.01 0 0 0 1"),
        _ => format!("-spin 0 0 {rate} {}", times(random)),
    };
    format!("motion m0 {path} ;\n")
}

/// The own times of a piece, mostly possible and sometimes very long.
fn times(random: &mut Random) -> String {
    match random.below(12) {
        0..=3 => String::new(),
        4 => "0 1000000".to_owned(),
        5 => "-1e6 1e6".to_owned(),
        6 => (*random.pick(&["0 5e-324", "1 1.0000000000000002", "-1e300 1e300", "1e300 1.1e300", "2 1"]))
            .to_owned(),
        7 => numbers(random, 2),
        8 => number(random),
        _ => {
            let from = random.below(9) as f64 - 6.0;
            format!("{from} {}", from + 1.0 + random.below(4) as f64)
        }
    }
}

fn numbers(random: &mut Random, n: usize) -> String {
    (0..n).map(|_| number(random)).collect::<Vec<_>>().join(" ")
}

/// Mostly small numbers, because bodies reach a few units.
fn number(random: &mut Random) -> String {
    const EXTREME: [&str; 8] = ["1e6", "-1e6", "50", "1e-9", "0.9999999999999999", "5e-324", "1e308", "1e17"];
    match random.below(12) {
        0 => words::number(random),
        1 => (*random.pick(&EXTREME)).to_owned(),
        2..=6 => "0".to_owned(),
        _ => format!("{:.3}", random.between(-0.2, 0.2)),
    }
}

/// The names that a scene can use.
#[derive(Clone, Copy)]
struct Names {
    n_motions: usize,
    malformed: bool,
}

impl Names {
    /// The last part of a statement.
    fn motion(self, random: &mut Random) -> String {
        match random.below(if self.malformed { 12 } else { 10 }) {
            0 => String::new(),
            1 => format!("<{}>", (random.in_ball(0.9)).to_array().map(|part| part.to_string()).join(" ")),
            10 => format!("<{}>", words::name(random)),
            11 => {
                (*random.pick(&["<m0", "<m0 m1>", "<m0 0 0>", "<>", "<m0> <m0>", "<-m0>", "m0>"])).to_owned()
            }
            _ => format!("<m{}>", random.below(self.n_motions)),
        }
    }
}

/// Bodies, surfaces, lights and a camera that follow the motions. The order of statements varies.
fn scene(random: &mut Random, motions: Vec<String>, names: Names) -> String {
    let mut statements = motions;
    let distance = random.between(2.0, 12.0);
    let head = "c red 1 20 1 ;\nc_bb star 5000 ;\nc_rgb blue 0.1 0.2 0.9 ;\n\
        surf mirror 0.1 0.9 0 1 60 ;\nsurf glass 0 0.1 0.9 1.5 60 ;\n";
    let mut text = head.to_owned();
    // Corners at the distance 1 from the origin, in and across the usual axes.
    text += "v p 1 0 0 ; v q 0 1 0 ; v r -1 0 0 ; v s 0 0 1 ; v t 0.5 0.5 0.5 ;\n";
    text += "def body ; v a 1 0 0 ; v b 0 1 0 ; v c 0 0 1 ; v d 0 0 0 ;\n\
        f (a b c) red ; f (a d b) ; f (b d c) ; f (c d a) star ; end ;\n";
    for _ in 0..1 + random.below(6) {
        let motion = names.motion(random);
        let place = random.in_cube(1.5).to_array().map(|part| format!("{part:.3}"));
        let place =
            format!("-sa {:.2} -tx {} -ty {} -tz {}", random.between(0.1, 1.0), place[0], place[1], place[2]);
        let corners = *random.pick(&["p q s", "p q r", "s t r", "p t q s"]);
        let color = *random.pick(&["", "red", "star", "blue 0.7", "red mirror", "blue mirror", "red glass"]);
        statements.push(match random.below(9) {
            0..=2 => format!("i (body {place}) {motion} ;\n"),
            3 => format!("a (body {place}) {} -rz 20 -tx 0.1 {motion} ;\n", 1 + random.below(4)),
            4 => format!("w ({corners}) {motion} ;\n"),
            _ => format!("f ({corners}) {color} {motion} ;\n"),
        });
    }
    for _ in 0..random.below(3) {
        let radius = *random.pick(&["", "0", "0.1", "0.1 2"]);
        let [x, y, z] = random.in_cube(4.0).to_array();
        statements.push(format!("l 0.7 {x:.3} {y:.3} {z:.3} {radius} {} ;\n", names.motion(random)));
    }
    if random.one_in(2) {
        let [x, y, z] = (random.direction() * distance).to_array();
        let motion = if random.one_in(2) { names.motion(random) } else { String::new() };
        statements.push(format!("cam -ep {x:.3} {y:.3} {z:.3} -vc 0 0 0 {motion} ;\n"));
    }
    // A motion is stated before or after its name is used.
    let start = random.below(statements.len());
    statements.rotate_left(start);
    text + &statements.concat()
}
