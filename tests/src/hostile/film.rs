//! Command lines of `ugfilm` and `ugwarp`.

use ugtesting::Random;

use super::line::{camera, fisheye, flags, maybe, motion, numbers, word, words as line_of};
use super::words;

/// Numbered files that a film writes begin so.
pub const FRAMES: &str = "frame_";

/// A film of a few frames, with numbers that change.
pub fn film(random: &mut Random, kind: &str) -> Vec<String> {
    let [width, height] = [(); 2].map(|()| random.pick(&["1", "7", "16"]).to_string());
    let mut line = line_of("ugfilm", &["-sz", &width, &height]);
    match random.below(12) {
        // More frames are only printed or drawn in part.
        0 => line.extend(
            ["-frames", "10000000", "-only", *random.pick(&["3..4", "9999999,1,1", "10000001"])]
                .map(str::to_owned),
        ),
        1 => {
            line.extend(["-frames", "9", "--print", *random.pick(&["0", "9", "10", "-1"])].map(str::to_owned))
        }
        _ => line.extend(["-frames", *random.pick(&["1", "2", "3", "0"])].map(str::to_owned)),
    }
    let method = if kind == "panorama" { "-warp" } else { *random.pick(&["-rays", "-xc", "-vr"]) };
    flags(random, if kind == "panorama" { 1 } else { 3 }, &mut line, &[method]);
    if random.one_in(2) {
        motion(random, &mut line);
    } else {
        let to = words::velocity(random).join(" ");
        line.extend([(*random.pick(&["-vel", "-cv"])).to_owned(), format!("0 0 0 .. {to}")]);
    }
    camera(random, &mut line);
    for option in ["-ti", "-va", "-ex", "-ep", "-vc"] {
        let values = vec![range(random)];
        maybe(random, 8, &mut line, option, values);
    }
    let exposure = word(random, &["auto"]);
    maybe(random, 6, &mut line, "-ex", exposure);
    let ease = word(random, &["linear", "smooth"]);
    maybe(random, 4, &mut line, "-ease", ease);
    let list = word(random, &["1", "2..1", "1,1,1", "0", "2..3", "1..4294967296"]);
    maybe(random, 10, &mut line, "-only", list);
    let rate = numbers::<1>(random);
    maybe(random, 10, &mut line, "-fps", rate);
    let open = if random.one_in(2) { word(random, &["0.5"]) } else { numbers::<1>(random) };
    maybe(random, 10, &mut line, "-blur", open);
    let moments = word(random, &["1", "3", "0", "4294967295"]);
    maybe(random, 12, &mut line, "-moments", moments);
    let count = word(random, &["1", "2", "9", "0"]);
    maybe(random, 15, &mut line, "-sheet", count);
    let lens = word(random, &["-pan", "-cube", "-fish=360", "-fish=1e-300"]);
    if random.one_in(10) {
        line.extend(lens);
    }
    let caption = vec![words::name(random)];
    maybe(random, 10, &mut line, "-cap", caption);
    flags(random, 8, &mut line, &["-loop", "-sp", "-lg", "-tb"]);
    output(random, &mut line);
    line
}

/// A film that can be drawn.
pub fn mild(random: &mut Random, kind: &str) -> Vec<String> {
    let mut line = line_of("ugfilm", &["-sz", "16", "9", "-frames", *random.pick(&["1", "2", "3"])]);
    let method = if kind == "panorama" { "-warp" } else { *random.pick(&["-rays", "-xc", "-vr"]) };
    flags(random, if kind == "panorama" { 1 } else { 3 }, &mut line, &[method]);
    let to = (random.direction() * random.unit()).to_array().map(|part| part.to_string()).join(" ");
    line.extend([(*random.pick(&["-vel", "-cv"])).to_owned(), format!("0 0 0 .. {to}")]);
    let exposure = word(random, &["auto", "0..2"]);
    maybe(random, 4, &mut line, "-ex", exposure);
    maybe(random, 6, &mut line, "-blur", vec!["0.5".to_owned()]);
    flags(random, 4, &mut line, &["-loop", "-sp"]);
    output(random, &mut line);
    line
}

/// Values over the film, mostly two.
fn range(random: &mut Random) -> String {
    let mut number = || words::number(random);
    let [first, last] = [number(), number()];
    match random.below(6) {
        0 => format!("{first}..{last}..{first}"),
        1 => (*random.pick(&["..", "1..", "..1", "1...2", "1 .. 2", "0 0 0 .. 1 1 1", "1..2 1..2..3 4"]))
            .to_owned(),
        _ => format!("{first}..{last}"),
    }
}

fn output(random: &mut Random, line: &mut Vec<String>) {
    if random.one_in(4) {
        let name = random.pick(&["%d.png", "%03d.exr", "%d.pdf", "%02d.png"]);
        line.extend(["-fo".to_owned(), format!("{FRAMES}{name}")]);
    } else {
        line.extend(["-dt".to_owned(), (*random.pick(&["apng", "apng", "gif", "y4m", "ppm"])).to_owned()]);
    }
}

/// A view of a panorama. `files`: their names and contents.
pub fn warp(random: &mut Random, files: &[(String, Vec<u8>)]) -> Vec<String> {
    let side = |random: &mut Random| random.pick(&["1", "6", "7", "16"]).to_string();
    let size = [side(random), side(random)];
    let mut line = line_of("ugwarp", &["-sz", &size[0], &size[1]]);
    let velocity = words::velocity(random).to_vec();
    let option = *random.pick(&["-vel", "-cv"]);
    maybe(random, 2, &mut line, option, velocity);
    camera(random, &mut line);
    if files.len() == 6 {
        line.extend(["-from", "sides"].map(str::to_owned));
        line.extend(files.iter().map(|(name, _)| name.clone()));
    } else {
        let arrangement = word(random, &["panorama", "strip", "cross", "sides"]);
        maybe(random, 6, &mut line, "-from", arrangement);
    }
    let angles = match random.below(4) {
        0 | 1 => ["-180", "180", "-90", "90"].map(str::to_owned).to_vec(),
        2 => ["-1e-9", "1e-9", "0", "1e-7"].map(str::to_owned).to_vec(),
        _ => numbers::<4>(random),
    };
    maybe(random, 5, &mut line, "-part", angles);
    let law = word(random, &["report", "photon", "bolometric", "none"]);
    maybe(random, 8, &mut line, "-br", law);
    let basis = match random.below(3) {
        0 => numbers::<3>(random),
        1 => ["3500", "5900", "10000"].map(str::to_owned).to_vec(),
        _ => word(random, &["mixture", "rough"]),
    };
    maybe(random, 4, &mut line, "--basis", basis);
    let format = word(random, &["ppm", "exr", "pfm", "hdr", "png16", "svg"]);
    maybe(random, 4, &mut line, "-dt", format);
    let angle = fisheye(random);
    maybe(random, 8, &mut line, "-fish", angle);
    let exposure = vec![if random.one_in(2) { "auto".to_owned() } else { words::number(random) }];
    maybe(random, 4, &mut line, "-ex", exposure);
    let samples = vec![(1 + random.below(4)).to_string()];
    maybe(random, 5, &mut line, "-aa", samples);
    let width = numbers::<1>(random);
    maybe(random, 12, &mut line, "--star-width", width);
    let magnitude = numbers::<1>(random);
    maybe(random, 12, &mut line, "--white", magnitude);
    for option in ["--stars", "--infrared", "--ultraviolet"] {
        maybe(random, 12, &mut line, option, vec![files[0].0.clone()]);
    }
    flags(random, 8, &mut line, &["-sp", "-vr", "-pan", "-cube", "--no-doppler", "--no-flux", "-lg", "-tb"]);
    line
}

/// A view of a valid panorama that can be drawn.
pub fn mild_warp(random: &mut Random) -> Vec<String> {
    let beta = (random.direction() * random.unit() * 0.999_999).to_array().map(|part| part.to_string());
    let mut line = line_of("ugwarp", &["-sz", *random.pick(&["2", "30"]), "10"]);
    line.push((*random.pick(&["-vel", "-cv"])).to_owned());
    line.extend(beta);
    maybe(random, 4, &mut line, "--basis", vec!["mixture".to_owned()]);
    let format = word(random, &["exr", "hdr", "png16", "pfm"]);
    maybe(random, 3, &mut line, "-dt", format);
    let lens = *random.pick(&["-pan", "-vr"]);
    flags(random, 3, &mut line, &["-sp", lens, "--no-flux"]);
    line
}
