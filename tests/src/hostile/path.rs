//! Paths from tables, skies as a moving camera sees them, and text in vector output.

use std::fmt::Write;

use ugtesting::Random;

use super::line::{flags, maybe, word, words as line_of};
use super::{Files, film, mild, motion, options, panorama, words};

/// A body, a light and a camera on a path from a table.
pub fn path(random: &mut Random) -> (Files, Vec<Vec<String>>) {
    let mut text = "motion p -path path.csv".to_owned();
    if random.one_in(4) {
        let _ = write!(text, " -spin 0 0 {}", words::number(random));
    }
    text += " ;\nmotion q -on p -at 0 .1 0 -spin 0 .1 0 ;\nv a 0 0 0 ; v b .5 0 0 ; v c 0 .5 0 ;\n\
             c_rgb u 1 0 0 ;\nc_time t -step -period 2 0 u 1 red ;\nc red 1 0 1 ;\nf (a b c) t <p> ;\nf (a c b) <q> ;\n";
    if random.one_in(3) {
        text += "l 0.7 1 1 1 <p> ;\n";
    }
    if random.one_in(3) {
        text += "cam -ep 0 0 5 -vc 0 0 0 <q> ;\n";
    }
    let mut table = table(random).into_bytes();
    if random.one_in(8) {
        super::damage(random, &mut table);
    }
    let files = vec![("scene.ug".to_owned(), text.into_bytes()), ("path.csv".to_owned(), table)];
    let stages =
        if random.one_in(2) { options::stages(random, "scene", &files) } else { mild::stages(random) };
    (files, stages)
}

/// Events: mostly possible, sometimes very many, too fast or back in time.
fn table(random: &mut Random) -> String {
    let head =
        *random.pick(&["t,x,y,z", "t,x,y,z", "z,y,x,t,name", "t x y z", "t;x;y;z", "x,y,z", "t,t,x,y,z"]);
    let n = match random.below(40) {
        0 => 100_000,
        1 => 1_000_001,
        2 => random.below(3),
        _ => 2 + random.below(30),
    };
    let speed = *random.pick(&[0.1, 0.5, 0.9, 0.999, 0.999_999_999_999, 1.0, 3.0]);
    let step = *random.pick(&[1.0, 1.0, 1.0, 1e-9, 1e-300, 1e9, 1e300]);
    let bad_row = if random.one_in(3) { random.below(n.max(1)) } else { usize::MAX };
    let turns = random.one_in(2);
    let separator = if head.contains(',') { "," } else { " " };
    let columns: Vec<&str> = head.split([',', ' ', ';']).collect();
    let mut text = format!("{head}\n");
    for row in 0..n {
        let t = step * row as f64;
        let [x, y] = if turns {
            [libm::sin(speed * row as f64), libm::cos(speed * row as f64)]
        } else {
            [speed * row as f64, 0.0]
        };
        let fields = columns.iter().map(|column| match *column {
            _ if row == bad_row && random.one_in(2) => random
                .pick(&[
                    "nan",
                    "inf",
                    "",
                    "-1e9",
                    "1e308",
                    "\u{1b}[2J",
                    "a",
                    "1 2",
                    "\"1",
                    "1e999",
                    "\u{202e}",
                ])
                .to_string(),
            "t" => format!("{t:e}"),
            "x" => format!("{:e}", step * x),
            "y" => format!("{:e}", step * y),
            _ => "0".to_owned(),
        });
        let fields: Vec<String> = fields.collect();
        text += &fields.join(separator);
        text.push('\n');
    }
    text
}

/// A panorama or stars as the moving camera of a scene sees them, as a picture or a film.
pub fn warp(random: &mut Random) -> (Files, Vec<Vec<String>>) {
    let scene = if random.one_in(2) { motion::sane(random) } else { motion::wild(random) };
    let mut scene = scene.replace("cam -ep", "cam eye -ep");
    if !scene.contains("cam eye") {
        scene += "cam eye -ep 0 0 5 -vc 0 0 0 <m0> ;\n";
    }
    let sky = match random.below(4) {
        0 => panorama::file(random),
        1 | 2 => panorama::stars(random).into_bytes(),
        _ => panorama::valid(random),
    };
    let mut files = vec![("0.sky".to_owned(), sky), ("eye.ug".to_owned(), scene.into_bytes())];
    if random.one_in(20) {
        super::damage(random, &mut files[1].1);
    }
    let is_film = random.one_in(3);
    let mut line = if is_film { film::mild(random, "panorama") } else { film::mild_warp(random) };
    // The velocity is that of the scene.
    if !random.one_in(20) {
        let at = line.iter().position(|word| word == "-vel" || word == "-cv");
        if let Some(at) = at {
            line.drain(at..at + if is_film { 2 } else { 4 });
        }
    }
    line.extend(["--scene", "eye.ug"].map(str::to_owned));
    let name = if random.one_in(12) { words::name(random) } else { "eye".to_owned() };
    maybe(random, 2, &mut line, "-cam", vec![name]);
    let time = if is_film && random.one_in(2) {
        format!("{}..{}", words::number(random), words::number(random))
    } else {
        words::number(random)
    };
    maybe(random, 2, &mut line, "-ti", vec![time]);
    let center = ["1", "0", "0"].map(str::to_owned).to_vec();
    maybe(random, 8, &mut line, "-vc", center);
    (files, vec![line])
}

/// A vector picture with text.
pub fn vector(random: &mut Random) -> (Files, Vec<Vec<String>>) {
    let text = mild::faces(random);
    let side = |random: &mut Random| random.pick(&["1", "7", "64", "300"]).to_string();
    let format = *random.pick(&["svg", "pdf", "eps", "ps"]);
    let mut line = line_of("ugrainbow", &["-vec", "-sz", &side(random), &side(random), "-dt", format]);
    if !random.one_in(8) {
        line.push("-txt".to_owned());
    }
    let caption = match random.below(4) {
        0 => words::name(random),
        1 => (*random.pick(&[
            "]]> & <script>",
            "\\) Tj ET (",
            "%%EOF\nendstream",
            "β = 0.9\u{301}",
            "a\u{0}b",
            "\u{10ffff}",
            "(((((",
            "' \" `",
            "\\377\\000\\",
            "\u{5d0}\u{5d1} ab",
        ]))
        .replace('\0', "?"),
        2 => "β ".repeat(random.below(2000)),
        _ => format!("a{}\nγ", words::number(random)),
    };
    maybe(random, 2, &mut line, "-cap", vec![caption]);
    let size = word(random, &["4", "11.5", "1000", "1e300", "nan"]);
    maybe(random, 20, &mut line, "-lw", size);
    flags(random, 4, &mut line, &["-lg", "-gr", "-tb", "-wf", "-ed", "-iw"]);
    let scene = vec![("scene.ug".to_owned(), text.into_bytes())];
    (scene, vec![line])
}
