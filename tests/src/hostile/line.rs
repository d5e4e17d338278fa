//! Options that several programs have, for command lines.

use ugtesting::Random;

use super::words as text;

/// A second output file.
pub const MEASURED: &str = "measured.csv";

/// A program and its options.
pub fn words(program: &str, options: &[&str]) -> Vec<String> {
    std::iter::once(program).chain(options.iter().copied()).map(str::to_owned).collect()
}

/// An option with some values, now and then.
pub fn maybe(random: &mut Random, one_in: usize, line: &mut Vec<String>, option: &str, values: Vec<String>) {
    if random.one_in(one_in) {
        line.push(option.to_owned());
        line.extend(values);
    }
}

/// Numbers as text.
pub fn numbers<const N: usize>(random: &mut Random) -> Vec<String> {
    [(); N].map(|()| text::number(random)).to_vec()
}

/// A velocity.
pub fn betas(random: &mut Random) -> Vec<String> {
    text::velocity(random).to_vec()
}

/// Some of these options without values, each now and then.
pub fn flags(random: &mut Random, one_in: usize, line: &mut Vec<String>, options: &[&str]) {
    for option in options {
        maybe(random, one_in, line, option, Vec::new());
    }
}

/// One of some words.
pub fn word(random: &mut Random, some: &[&str]) -> Vec<String> {
    vec![(*random.pick(some)).to_owned()]
}

/// Options of the camera.
pub fn camera(random: &mut Random, line: &mut Vec<String>) {
    let center = numbers::<3>(random);
    maybe(random, 6, line, "-vc", center);
    let eye = numbers::<3>(random);
    maybe(random, 8, line, "-ep", eye);
    let up = numbers::<3>(random);
    maybe(random, 10, line, "-ud", up);
    let angle = if random.one_in(3) { numbers::<2>(random) } else { numbers::<1>(random) };
    maybe(random, 8, line, "-va", angle);
    let name = vec![text::name(random)];
    maybe(random, 30, line, "-cam", name);
    flags(random, 8, line, &["-og"]);
}

/// Options of motion.
pub fn motion(random: &mut Random, line: &mut Vec<String>) {
    let velocity = betas(random);
    maybe(random, 2, line, "-vel", velocity);
    let camera = betas(random);
    maybe(random, 5, line, "-cv", camera);
    let time = numbers::<1>(random);
    maybe(random, 6, line, "-ti", time);
    let anchor = match random.below(3) {
        0 => numbers::<3>(random),
        _ => word(random, &["eye", "origin", "center", "middle"]),
    };
    maybe(random, 8, line, "-an", anchor);
    flags(random, 20, line, &["--keep-in-view"]);
}

/// The angle of a fisheye: mostly possible.
pub fn fisheye(random: &mut Random) -> Vec<String> {
    match random.below(3) {
        0 => numbers::<1>(random),
        _ => word(random, &["180", "360", "359.99999999999994", "1e-300", "5e-324", "361"]),
    }
}
