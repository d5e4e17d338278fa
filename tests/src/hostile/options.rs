//! Command lines of a pipe.

use ugtesting::Random;

use super::line::{MEASURED, betas, camera, fisheye, flags, maybe, motion, numbers, word, words};
use super::{film, words as text};

/// The stages for an input of a kind.
pub fn stages(random: &mut Random, kind: &str, files: &[(String, Vec<u8>)]) -> Vec<Vec<String>> {
    let mut stages = programs(random, kind, files);
    stages.iter_mut().for_each(|line| common(random, line));
    // What a program writes may exceed the limits of the next, so only the first has some.
    let limit = word(random, &LIMITS);
    maybe(random, 20, &mut stages[0], "--limit", limit);
    stages
}

fn programs(random: &mut Random, kind: &str, files: &[(String, Vec<u8>)]) -> Vec<Vec<String>> {
    let mut stages = match kind {
        "pictures" => return vec![sheet(random, files)],
        "panorama" if files.len() == 1 && random.one_in(4) => return vec![film::film(random, kind)],
        "panorama" => return vec![film::warp(random, files)],
        "mesh" => vec![mesh(random, files)],
        _ => Vec::new(),
    };
    if kind == "scene" && random.one_in(6) {
        return vec![parse(random)];
    }
    if random.one_in(6) && kind == "mesh" {
        return stages;
    }
    match random.below(12) {
        0 | 1 => {
            stages.push(photon(random));
            return stages;
        }
        2 => {
            stages.push(film::film(random, kind));
            return stages;
        }
        _ => {}
    }
    if !random.one_in(4) {
        stages.push(lorentz(random));
    }
    if !random.one_in(3) {
        stages.push(doppler(random));
    }
    match random.below(8) {
        0 => {
            let format = *random.pick(&["obj", "ply", "gltf", "glb"]);
            stages.push(words("ugmesh", &["-dt", format]));
        }
        _ => stages.push(rainbow(random)),
    }
    stages
}

/// Limits on the size of scenes, possible and not.
const LIMITS: [&str; 10] = [
    "text=100",
    "includes=0",
    "files=1",
    "nesting=1",
    "chain=0",
    "statements=5",
    "corners=3",
    "names=10",
    "statements=99999999999999999999",
    "\u{1b}[2J=1",
];

/// Options of every program.
fn common(random: &mut Random, line: &mut Vec<String>) {
    flags(random, 20, line, &["-lax"]);
    flags(random, 40, line, &["--allow-execute", "-qt"]);
    let threads = word(random, &["2", "7", "1024", "0"]);
    maybe(random, 60, line, "-nt", threads);
}

fn sheet(random: &mut Random, files: &[(String, Vec<u8>)]) -> Vec<String> {
    let mut line = words("ugsheet", &[]);
    line.extend(files.iter().map(|(name, _)| name.clone()));
    let cols = vec![random.below(5).to_string()];
    maybe(random, 3, &mut line, "-cols", cols);
    let title = vec![text::name(random)];
    maybe(random, 3, &mut line, "-title", title);
    let gap = if random.one_in(2) { numbers::<1>(random) } else { word(random, &["0", "3", "10000"]) };
    maybe(random, 5, &mut line, "-gap", gap);
    if random.one_in(4) {
        // Sometimes fewer than there are pictures.
        for _ in 0..files.len() - random.below(2) {
            line.extend(["-label".to_owned(), text::name(random)]);
        }
    }
    let kind = word(random, &["auto", "names", "none"]);
    maybe(random, 6, &mut line, "-lb", kind);
    let caption = vec![text::name(random)];
    maybe(random, 5, &mut line, "-cap", caption);
    let size = word(random, &["4", "11.5", "1000", "1e300"]);
    maybe(random, 6, &mut line, "-ts", size);
    let background = numbers::<3>(random);
    maybe(random, 8, &mut line, "-bg", background);
    let format = word(random, &["ppm", "eps", "ps", "pdf", "svg"]);
    maybe(random, 4, &mut line, "-dt", format);
    flags(random, 4, &mut line, &["-lt"]);
    line
}

fn mesh(random: &mut Random, files: &[(String, Vec<u8>)]) -> Vec<String> {
    let mut line = words("ugmesh", &[&files[0].0]);
    flags(random, 4, &mut line, &["-center"]);
    let fit = numbers::<1>(random);
    maybe(random, 4, &mut line, "-fit", fit);
    let scale = numbers::<1>(random);
    maybe(random, 6, &mut line, "-scale", scale);
    let name = vec![text::name(random)];
    maybe(random, 6, &mut line, "-name", name);
    let up = word(random, &["x", "y", "z"]);
    maybe(random, 6, &mut line, "-up", up);
    let format = word(random, &["ug", "obj", "ply", "stl", "off", "gltf", "glb"]);
    maybe(random, 15, &mut line, "-if", format);
    line
}

fn parse(random: &mut Random) -> Vec<String> {
    let command = *random.pick(&["check", "tidy", "flatten", "count"]);
    words("ugparse", &[command])
}

/// Options of `ugphoton`.
fn photon(random: &mut Random) -> Vec<String> {
    let side = |random: &mut Random| random.pick(&["1", "6", "7", "16"]).to_string();
    let size = [side(random), side(random)];
    let mut line = words("ugphoton", &["-sz", &size[0], &size[1], "-aa", *random.pick(&["2", "3"])]);
    motion(random, &mut line);
    camera(random, &mut line);
    let format = word(random, &["ppm", "exr", "pfm", "hdr", "png16", "svg"]);
    maybe(random, 4, &mut line, "-dt", format);
    let law = word(random, &["report", "photon", "bolometric", "none"]);
    maybe(random, 8, &mut line, "-br", law);
    let depth = word(random, &["0", "1", "64", "65"]);
    maybe(random, 6, &mut line, "-rd", depth);
    let part = word(random, &["0", "0.5", "1", "1e-300", "nan"]);
    maybe(random, 8, &mut line, "-rc", part);
    let distance = numbers::<1>(random);
    maybe(random, 10, &mut line, "--film-shutter", distance);
    let angle = fisheye(random);
    maybe(random, 10, &mut line, "-fish", angle);
    let distance = numbers::<1>(random);
    maybe(random, 6, &mut line, "-stereo", distance);
    let pixel = word(random, &["0,0", "3,3", "-1,0", "4294967296,0"]);
    maybe(random, 12, &mut line, "--explain", pixel);
    let contrast = word(random, &["0", "0.1", "1", "2", "nan"]);
    maybe(random, 6, &mut line, "-ad", contrast);
    let part = [(); 4].map(|()| random.pick(&["0", "1", "5", "7", "4294967295"]).to_string());
    maybe(random, 10, &mut line, "-crop", part.to_vec());
    let exposure = vec![if random.one_in(2) { "auto".to_owned() } else { text::number(random) }];
    maybe(random, 4, &mut line, "-ex", exposure);
    flags(
        random,
        8,
        &mut line,
        &["-in", "-sp", "-sm", "-vr", "-pan", "-cube", "--fresnel", "--no-shadows", "-lg", "-tb", "-pv"],
    );
    line
}

fn lorentz(random: &mut Random) -> Vec<String> {
    let mut line = words("uglorentz", &[]);
    motion(random, &mut line);
    camera(random, &mut line);
    let pieces = vec![(1 + random.below(100)).to_string()];
    maybe(random, 6, &mut line, "-se", pieces);
    let pieces = word(random, &["1", "2", "5", "0", "4294967295"]);
    maybe(random, 12, &mut line, "-sd", pieces);
    for option in ["-sc", "-sl"] {
        let percent = word(random, &["off", "0.5", "5", "100", "1e300", "0"]);
        maybe(random, 8, &mut line, option, percent);
    }
    let table = vec![MEASURED.to_owned()];
    maybe(random, 15, &mut line, "-at", table);
    flags(random, 5, &mut line, &["-in", "-sm", "-vr", "-cull", "-nc", "--no-flight-time", "-vb"]);
    line
}

fn doppler(random: &mut Random) -> Vec<String> {
    let mut line = words("ugdoppler", &[]);
    let law = vec![(*random.pick(&["report", "photon", "bolometric", "none"])).to_owned()];
    match random.below(4) {
        0 => flags(random, 1, &mut line, &["-sp"]),
        1 => flags(random, 1, &mut line, &["-gw"]),
        _ => maybe(random, 2, &mut line, "-br", law),
    }
    flags(random, 5, &mut line, &["-li", "-ir", "-vr", "-hd", "--no-doppler", "--no-flux"]);
    let tolerance = numbers::<1>(random);
    maybe(random, 8, &mut line, "-ct", tolerance);
    let eye = numbers::<3>(random);
    maybe(random, 12, &mut line, "-ep", eye);
    let velocity = betas(random);
    maybe(random, 8, &mut line, "-vel", velocity);
    line
}

fn rainbow(random: &mut Random) -> Vec<String> {
    let side = |random: &mut Random| random.pick(&["1", "7", "40", "64"]).to_string();
    let size = [side(random), side(random)];
    let mut line = words("ugrainbow", &["-sz", &size[0], &size[1]]);
    camera(random, &mut line);
    let format = word(random, &["ppm", "exr", "pfm", "hdr", "png16", "eps", "ps", "pdf", "svg"]);
    if random.one_in(12) {
        line.extend(["-dt", "exr", "-ch", "D,time,distance,Z,id,velocity"].map(str::to_owned));
    } else {
        maybe(random, 4, &mut line, "-dt", format);
    }
    let filter = word(random, &["box", "triangle", "spline"]);
    maybe(random, 4, &mut line, "-fl", filter);
    let background = if random.one_in(3) { numbers::<3>(random) } else { word(random, &["0", "1", "0.5"]) };
    maybe(random, 8, &mut line, "-bg", background);
    let curve = word(random, &["clip", "filmic"]);
    maybe(random, 8, &mut line, "-tc", curve);
    let caption = vec![text::name(random)];
    maybe(random, 10, &mut line, "-cap", caption);
    let width = numbers::<1>(random);
    maybe(random, 12, &mut line, "-lw", width);
    let color = numbers::<3>(random);
    maybe(random, 20, &mut line, "-lc", color);
    let fade = numbers::<2>(random);
    maybe(random, 15, &mut line, "-dc", fade);
    let pixel = word(random, &["0,0", "3,3", "63,63", "-1,0", "4294967296,0"]);
    maybe(random, 15, &mut line, "--explain", pixel);
    let law = word(random, &["report", "photon", "bolometric", "none"]);
    maybe(random, 15, &mut line, "-br", law);
    flags(random, 20, &mut line, &["-pz", "-vr", "-sp", "--no-doppler", "--no-flux"]);
    let exposure = vec![if random.one_in(2) { "auto".to_owned() } else { text::number(random) }];
    maybe(random, 4, &mut line, "-ex", exposure);
    let samples = vec![(1 + random.below(3)).to_string()];
    maybe(random, 4, &mut line, "-aa", samples);
    flags(
        random,
        7,
        &mut line,
        &["-xc", "-wf", "-ed", "-cb", "-og", "-iw", "-wi", "-dc", "-dl", "-gr", "-lg", "-tb", "-vec"],
    );
    line
}
