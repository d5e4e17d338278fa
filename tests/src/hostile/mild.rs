//! Valid inputs and options, so that pipes run to their end. Sizes, speeds and combinations of
//! options are unusual all the same.

use std::fmt::Write;

use ugtesting::Random;

use super::line::{MEASURED, flags, maybe, word, words};
use super::{Files, film, mesh, motion as motions, panorama, picture, scene};

/// Files, the first of which is the input, and the stages of a pipe.
pub fn pipe(random: &mut Random) -> (Files, Vec<Vec<String>>) {
    match random.below(13) {
        0 => {
            let files: Vec<_> =
                (0..1 + random.below(3)).map(|idx| (format!("{idx}.png"), picture::png(random))).collect();
            let line = sheet(random, &files);
            (files, vec![line])
        }
        1 | 2 => {
            let (name, content) = solid(random);
            let mut line = words("ugmesh", &[name]);
            flags(random, 3, &mut line, &["-center", "--stage"]);
            let fit = vec![size(random).to_string()];
            maybe(random, 3, &mut line, "-fit", fit);
            let mut stages = vec![line];
            stages.extend(drawing(random));
            (vec![(name.to_owned(), content)], stages)
        }
        3 => {
            let files = vec![("0.sky".to_owned(), panorama::valid(random))];
            let line =
                if random.one_in(4) { film::mild(random, "panorama") } else { film::mild_warp(random) };
            (files, vec![line])
        }
        _ => {
            let stages = stages(random);
            let text = match random.below(6) {
                0 | 1 => scene::known(random),
                2 => motions::sane(random).into_bytes(),
                _ => statements(random).into_bytes(),
            };
            (vec![("scene.ug".to_owned(), text)], stages)
        }
    }
}

/// The stages for a scene.
pub fn stages(random: &mut Random) -> Vec<Vec<String>> {
    if random.one_in(10) {
        return vec![words("ugparse", &[*random.pick(&["check", "tidy", "flatten", "count"])])];
    }
    drawing(random)
}

/// A length from tiny to huge, mostly about 1.
fn size(random: &mut Random) -> f64 {
    if random.one_in(3) { libm::exp10(random.between(-9.0, 9.0)) } else { 1.0 }
}

/// A velocity below that of light: its direction is random, and 1 − β may be as small as 1e-9.
fn velocity(random: &mut Random) -> [String; 3] {
    let speed = if random.one_in(5) { 1.0 - libm::exp10(random.between(-9.0, -1.0)) } else { random.unit() };
    (random.direction() * speed * 0.999_999_999_9).to_array().map(|part| part.to_string())
}

/// A scene of faces alone: one renderer draws no wires.
pub fn faces(random: &mut Random) -> String {
    let text = statements(random);
    text.lines().filter(|line| !line.starts_with("w ")).map(|line| format!("{line}\n")).collect()
}

/// Bodies of tetrahedra and polygons, with colours, lights and velocities.
fn statements(random: &mut Random) -> String {
    let mut text = String::new();
    let n_colors = 1 + random.below(4);
    for idx in 0..n_colors {
        let _ = writeln!(text, "{}", color(random, idx));
    }
    let size = size(random);
    let (mut n_vertices, mut n_names) = (0, 0);
    let mut body = |random: &mut Random, text: &mut String| {
        let center = random.in_cube(3.0 * size);
        let n = 4 + random.below(4);
        for idx in n_vertices..n_vertices + n {
            let [x, y, z] = (center + random.in_cube(size)).to_array();
            let _ = writeln!(text, "v v{idx} {x} {y} {z} ;");
        }
        for _ in 0..1 + random.below(5) {
            let n_corners = if random.one_in(4) { 4 } else { 3 };
            let first = random.below(n);
            let corners: Vec<String> =
                (0..n_corners).map(|corner| format!("v{}", n_vertices + (first + corner) % n)).collect();
            let kind = if random.one_in(9) { "w" } else { "f" };
            let _ = writeln!(text, "{kind} ({}) red{} ;", corners.join(" "), random.below(n_colors));
        }
        n_vertices += n;
    };
    for _ in 0..random.below(3) {
        body(random, &mut text);
    }
    for _ in 0..1 + random.below(3) {
        n_names += 1;
        let _ = writeln!(text, "def body{n_names} ;");
        body(random, &mut text);
        let _ = writeln!(text, "end ;");
        let [x, y, z] = random.in_cube(3.0 * size).to_array();
        let place = format!("-tx {x} -ty {y} -tz {z} -rz {}", random.below(360));
        let moving =
            if random.one_in(2) { format!("<{}>", velocity(random).join(" ")) } else { String::new() };
        let _ = if random.one_in(3) {
            writeln!(text, "a (body{n_names} {place}) {} {place} {moving} ;", 1 + random.below(5))
        } else {
            writeln!(text, "i (body{n_names} {place}) {moving} ;")
        };
    }
    if random.one_in(3) {
        let [x, y, z] = (random.direction() * size).to_array();
        let radius = *random.pick(&["", "0.1", "0", "0.1 2", "0 0.3"]);
        let moving =
            if random.one_in(3) { format!("<{}>", velocity(random).join(" ")) } else { String::new() };
        let _ = writeln!(text, "l 0.2 ;\nl lamp {} {x} {y} {z} {radius} {moving} ;", random.unit());
    }
    if random.one_in(2) {
        let [x, y, z] = (random.direction() * 9.0 * size).to_array();
        let moving =
            if random.one_in(3) { format!("<{}>", velocity(random).join(" ")) } else { String::new() };
        let _ = writeln!(text, "cam -ep {x} {y} {z} -vc 0 0 0 {moving} ;");
    }
    text
}

fn color(random: &mut Random, idx: usize) -> String {
    let numbers = [(); 3].map(|()| random.unit().to_string()).join(" ");
    match random.below(6) {
        0 => format!("c_rgb red{idx} {numbers} ;"),
        1 => format!("c_xyz red{idx} {numbers} ;"),
        2 => format!("c_bb red{idx} {} ;", libm::exp10(random.between(1.0, 6.0))),
        3 => format!("c_spd red{idx} 400 {} 500 1 600 0.5 ;", random.unit()),
        4 => {
            let factor =
                if random.one_in(3) { format!("{}", random.between(0.1, 4.0)) } else { String::new() };
            format!("c red{idx} {} {} 1 {} {factor} ;", random.unit(), random.below(360), random.unit())
        }
        _ => format!("c red{idx} 1 {} 1 ;", random.below(360)),
    }
}

/// A tetrahedron with random corners in a format of meshes.
fn solid(random: &mut Random) -> (&'static str, Vec<u8>) {
    let size = size(random);
    let points = [(); 4].map(|()| (random.in_cube(size)).to_array().map(|part| part.to_string()).join(" "));
    let faces = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]];
    let rows = |head: &str, base: usize| {
        let row = |face: [usize; 3]| face.map(|corner| (corner + base).to_string()).join(" ");
        faces.map(|face| format!("{head} {}\n", row(face))).concat()
    };
    let (name, text) = match random.below(4) {
        0 => ("mesh.obj", points.map(|point| format!("v {point}\n")).concat() + &rows("f", 1)),
        1 => ("mesh.off", format!("OFF\n4 4 0\n{}\n{}", points.join("\n"), rows("3", 0))),
        2 => {
            let header = mesh::ply_header("ascii", "4", 4);
            ("mesh.ply", format!("{header}{}\n{}", points.join("\n"), rows("3", 0)))
        }
        _ => {
            let facet = |face: [usize; 3]| {
                let corners = face.map(|corner| format!("vertex {}\n", points[corner])).concat();
                format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
            };
            ("mesh.stl", format!("solid a\n{}endsolid a\n", faces.map(facet).concat()))
        }
    };
    (name, text.into_bytes())
}

/// Stages that draw a scene, or make a mesh of it.
fn drawing(random: &mut Random) -> Vec<Vec<String>> {
    let mut stages = Vec::new();
    match random.below(15) {
        0..=2 => return vec![photon(random)],
        3 => return vec![film::mild(random, "scene")],
        _ => {}
    }
    if !random.one_in(9) {
        stages.push(lorentz(random));
        if !random.one_in(3) {
            stages.push(doppler(random));
        }
    }
    if random.one_in(9) {
        stages.push(words("ugmesh", &["-dt", *random.pick(&["obj", "ply", "gltf", "glb"])]));
    } else {
        stages.push(rainbow(random, stages.len()));
    }
    stages
}

/// Options of motion.
fn motion(random: &mut Random, line: &mut Vec<String>) {
    let beta = velocity(random).to_vec();
    maybe(random, 2, line, "-vel", beta);
    let beta = velocity(random).to_vec();
    maybe(random, 6, line, "-cv", beta);
    let time = vec![random.between(-9.0, 9.0).to_string()];
    maybe(random, 5, line, "-ti", time);
    let anchor = word(random, &["eye", "origin", "center"]);
    maybe(random, 5, line, "-an", anchor);
    flags(random, 12, line, &["--keep-in-view"]);
}

/// Options of `ugphoton`.
fn photon(random: &mut Random) -> Vec<String> {
    let [width, height] = [(); 2].map(|()| random.pick(&["2", "10", "16"]).to_string());
    let mut line = words("ugphoton", &["-sz", &width, &height, "-aa", "2"]);
    motion(random, &mut line);
    let format = word(random, &["ppm", "exr", "png16", "svg"]);
    maybe(random, 4, &mut line, "-dt", format);
    let depth = vec![random.below(12).to_string()];
    maybe(random, 4, &mut line, "-rd", depth);
    let lens = *random.pick(&["-pan", "--no-doppler"]);
    let distance = vec![random.between(0.0, 2.0).to_string()];
    maybe(random, 6, &mut line, "-stereo", distance);
    flags(random, 6, &mut line, &["-in", "-sp", "-sm", "-vr", "--fresnel", "--no-shadows", lens]);
    line
}

/// Options of `uglorentz`. Subdivision is coarse, since many pieces take long.
fn lorentz(random: &mut Random) -> Vec<String> {
    let mut line = words("uglorentz", &["-se", *random.pick(&["1", "10", "100"])]);
    motion(random, &mut line);
    let angle = vec![random.between(1.0, 120.0).to_string()];
    maybe(random, 5, &mut line, "-va", angle);
    let percent = word(random, &["off", "1", "20"]);
    maybe(random, 2, &mut line, "-sc", percent);
    maybe(random, 9, &mut line, "-sl", vec!["20".to_owned()]);
    maybe(random, 9, &mut line, "-at", vec![MEASURED.to_owned()]);
    flags(random, 5, &mut line, &["-in", "-sm", "-vr", "-cull", "-nc", "--no-flight-time", "-vb"]);
    line
}

fn doppler(random: &mut Random) -> Vec<String> {
    let mut line = words("ugdoppler", &[]);
    match random.below(4) {
        0 => flags(random, 1, &mut line, &["-sp"]),
        1 => flags(random, 1, &mut line, &["-gw"]),
        _ => {
            let law = word(random, &["report", "photon", "bolometric", "none"]);
            maybe(random, 2, &mut line, "-br", law);
        }
    }
    let tolerance = vec![random.unit().to_string()];
    maybe(random, 5, &mut line, "-ct", tolerance);
    flags(random, 5, &mut line, &["-li", "-ir", "-vr", "-hd", "--no-doppler", "--no-flux"]);
    line
}

/// Options of `ugrainbow`. `n_before`: number of stages before it.
fn rainbow(random: &mut Random, n_before: usize) -> Vec<String> {
    let [width, height] = [(); 2].map(|()| random.pick(&["1", "9", "40"]).to_string());
    let mut line = words("ugrainbow", &["-sz", &width, &height]);
    let filter = word(random, &["box", "triangle", "spline"]);
    maybe(random, 4, &mut line, "-fl", filter);
    match random.below(3) {
        0 => {
            // Linear light is written as it is.
            let format = word(random, &["exr", "pfm", "hdr"]);
            maybe(random, 1, &mut line, "-dt", format);
        }
        _ => {
            let format = word(random, &["ppm", "png16", "eps", "ps", "pdf", "svg"]);
            maybe(random, 3, &mut line, "-dt", format);
            let curve = word(random, &["clip", "filmic"]);
            maybe(random, 6, &mut line, "-tc", curve);
            let exposure = word(random, &["auto", "-3", "0", "2.5"]);
            maybe(random, 4, &mut line, "-ex", exposure);
        }
    }
    let samples = vec![(1 + random.below(3)).to_string()];
    maybe(random, 2, &mut line, "-aa", samples);
    if n_before < 2 {
        // Only colours at rest are shifted.
        flags(random, 9, &mut line, &["-xc"]);
    }
    let edges = *random.pick(&["-wf", "-ed"]);
    flags(random, 9, &mut line, &[edges, "-cb", "-dc", "-gr", "-vr", "-pz"]);
    line
}

fn sheet(random: &mut Random, files: &[(String, Vec<u8>)]) -> Vec<String> {
    let mut line = words("ugsheet", &[]);
    line.extend(files.iter().map(|(name, _)| name.clone()));
    let cols = vec![(1 + random.below(4)).to_string()];
    maybe(random, 3, &mut line, "-cols", cols);
    let gap = vec![random.below(30).to_string()];
    maybe(random, 3, &mut line, "-gap", gap);
    let format = word(random, &["ppm", "pdf", "svg"]);
    maybe(random, 4, &mut line, "-dt", format);
    line
}
