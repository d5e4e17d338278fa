//! Command lines of a pipe.

use ugrandom::Random;

use super::words;

/// The stages for an input of a kind.
pub fn stages(random: &mut Random, kind: &str, files: &[(String, Vec<u8>)]) -> Vec<Vec<String>> {
    let mut stages = match kind {
        "pictures" => return vec![sheet(random, files)],
        "mesh" => vec![mesh(random, files)],
        _ => Vec::new(),
    };
    if kind == "scene" && random.one_in(6) {
        return vec![parse(random)];
    }
    if random.one_in(6) && kind == "mesh" {
        return stages;
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

fn words(program: &str, options: &[&str]) -> Vec<String> {
    std::iter::once(program).chain(options.iter().copied()).map(str::to_owned).collect()
}

/// An option with some values, now and then.
fn maybe(random: &mut Random, one_in: usize, line: &mut Vec<String>, option: &str, values: Vec<String>) {
    if random.one_in(one_in) {
        line.push(option.to_owned());
        line.extend(values);
    }
}

fn numbers<const N: usize>(random: &mut Random) -> Vec<String> {
    [(); N].map(|()| words::number(random)).to_vec()
}

fn betas(random: &mut Random) -> Vec<String> {
    [(); 3].map(|()| words::beta(random)).to_vec()
}

fn flags(random: &mut Random, one_in: usize, line: &mut Vec<String>, options: &[&str]) {
    for option in options {
        maybe(random, one_in, line, option, Vec::new());
    }
}

fn sheet(random: &mut Random, files: &[(String, Vec<u8>)]) -> Vec<String> {
    let mut line = words("ugsheet", &[]);
    line.extend(files.iter().map(|(name, _)| name.clone()));
    let cols = vec![random.below(5).to_string()];
    maybe(random, 3, &mut line, "-cols", cols);
    let title = vec![words::name(random)];
    maybe(random, 3, &mut line, "-title", title);
    let gap = numbers::<1>(random);
    maybe(random, 5, &mut line, "-gap", gap);
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
    line
}

fn parse(random: &mut Random) -> Vec<String> {
    let command = *random.pick(&["check", "tidy", "flatten", "count"]);
    words("ugparse", &[command])
}

fn lorentz(random: &mut Random) -> Vec<String> {
    let mut line = words("uglorentz", &[]);
    let velocity = betas(random);
    maybe(random, 2, &mut line, "-vel", velocity);
    let camera = betas(random);
    maybe(random, 5, &mut line, "-cv", camera);
    let eye = numbers::<3>(random);
    maybe(random, 8, &mut line, "-ep", eye);
    let time = numbers::<1>(random);
    maybe(random, 6, &mut line, "-ti", time);
    let pieces = vec![(1 + random.below(100)).to_string()];
    maybe(random, 6, &mut line, "-se", pieces);
    flags(random, 5, &mut line, &["-in", "-sm", "-cull", "-nc", "--no-flight-time", "-vb"]);
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
    flags(random, 5, &mut line, &["-li", "-ir", "-vr", "--no-doppler", "--no-flux"]);
    let velocity = betas(random);
    maybe(random, 8, &mut line, "-vel", velocity);
    line
}

fn rainbow(random: &mut Random) -> Vec<String> {
    let side = |random: &mut Random| random.pick(&["1", "7", "40", "64"]).to_string();
    let size = [side(random), side(random)];
    let mut line = words("ugrainbow", &["-sz", &size[0], &size[1]]);
    let center = numbers::<3>(random);
    maybe(random, 6, &mut line, "-vc", center);
    let eye = numbers::<3>(random);
    maybe(random, 8, &mut line, "-ep", eye);
    let angle = numbers::<1>(random);
    maybe(random, 8, &mut line, "-va", angle);
    let format = vec![(*random.pick(&["ppm", "exr", "pfm", "hdr", "eps", "pdf", "svg"])).to_owned()];
    maybe(random, 4, &mut line, "-dt", format);
    let exposure = vec![if random.one_in(2) { "auto".to_owned() } else { words::number(random) }];
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
