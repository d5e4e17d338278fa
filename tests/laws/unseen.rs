//! A body that is not seen changes no pixel, wherever it is and however it moves: not the light of
//! lamps, either, which rest with whatever they light or have a velocity of their own.

use glam::DVec3;
use ugimage::{Format, LinearFrame};
use ugphoton::MotionOptions;
use ugrainbow::{ColorShift, Output, PictureOptions};
use ugscene::Anchor;
use ugtesting::Random;
use ugtests::pipe::{doppler, lorentz};
use ugtests::scenes::parse;

const SIZE: [u32; 2] = [40, 30];

/// Bodies in view of the origin, in one motion or in several; two lamps that rest with whatever
/// they light, and one that has a velocity.
fn scene(random: &mut Random, is_one_body: bool) -> String {
    let velocity = |random: &mut Random| {
        let beta = random.in_ball(0.6);
        format!("<{:?} {:?} {:?}>", beta.x, beta.y, beta.z)
    };
    let point = |p: DVec3| format!("{:?} {:?} {:?}", p.x, p.y, p.z);
    let mut text = String::from("c red .9 10 .7; c blue .7 220 .6; cam -ep 0 0 0 -vc 0 9 0 -va 90 70;\n");
    let common = velocity(random);
    for (row, color) in ["red", "blue", "red"].into_iter().enumerate() {
        let (middle, a, b) = (DVec3::Y * 8.0 + random.in_cube(3.0), random.direction(), random.direction());
        for (name, side) in [("a", 5.0 * a), ("b", 5.0 * b), ("c", -5.0 * a - 5.0 * b)] {
            text += &format!("v {name}{row} {};", point(middle + side));
        }
        let own = match row {
            _ if is_one_body => common.clone(),
            2 => String::new(),
            _ => velocity(random),
        };
        text += &format!("f (a{row} b{row} c{row}) {color} {own};\n");
    }
    let at = |random: &mut Random| point(DVec3::Y * 5.0 + random.in_cube(4.0));
    text += &format!("l .1; l lamp .6 {} 0; l disc .5 {} .5;", at(random), at(random));
    text + &format!("l own .4 {} 0 {};\n", at(random), velocity(random))
}

/// A triangle between all samples.
fn unseen(random: &mut Random) -> String {
    let beta = random.in_ball(0.9);
    let corner = random.in_cube(20.0);
    let far = corner + DVec3::splat(1e-9);
    format!(
        "v hidden {:?} {:?} {:?}; v hidden2 {:?} {:?} {:?}; v hidden3 {:?} {:?} {:?};
         f (hidden hidden2 hidden3) <{:?} {:?} {:?}>;\n",
        corner.x,
        corner.y,
        corner.z,
        far.x,
        corner.y,
        corner.z,
        corner.x,
        far.y,
        far.z,
        beta.x,
        beta.y,
        beta.z
    )
}

/// The light of a scene, drawn in every way.
fn drawn(text: &str, motion: &MotionOptions) -> Vec<(&'static str, LinearFrame)> {
    let picture = PictureOptions {
        size: SIZE,
        samples: 1,
        output: Output::Color(Format::Exr),
        ..PictureOptions::default()
    };
    let config = uglorentz::Config {
        camera_velocity: motion.camera_velocity,
        time: motion.time,
        anchor: motion.anchor,
        in_place: motion.in_place,
        ..uglorentz::Config::default()
    };
    let whole = uglorentz::Config { pieces: uglorentz::Pieces::PerEdge(1), ..config.clone() };
    let whole = lorentz(text.as_bytes(), &whole);
    let near = uglorentz::Config { light_error: 0.05, ..config };
    let near = lorentz(text.as_bytes(), &near);
    let lit = |light| doppler(&near, &ugdoppler::Config { light, ..ugdoppler::Config::default() });
    let scanned = ugrainbow::Config { picture: picture.clone(), ..ugrainbow::Config::default() };
    let exact = ugrainbow::Config { exact: Some(ColorShift::default()), ..scanned.clone() };
    let rays = ugphoton::Config { motion: motion.clone(), picture, ..ugphoton::Config::default() };
    vec![
        ("pipe", ugrainbow::light(&parse(&lit(false)), &scanned).unwrap()),
        ("pipe with -li", ugrainbow::light(&parse(&lit(true)), &scanned).unwrap()),
        ("ugrainbow -xc", ugrainbow::light(&parse(&whole), &exact).unwrap()),
        ("ugphoton", ugphoton::light(parse(text.as_bytes()), &rays).unwrap()),
    ]
}

#[test]
fn an_unseen_body_changes_no_pixel() {
    let mut random = Random(2);
    let (mut n_lit, mut n_pixels) = (0, 0);
    for case in 0..24 {
        let text = scene(&mut random, case % 2 == 1);
        let motion = MotionOptions {
            camera_velocity: (case % 5 == 4).then(|| random.in_ball(0.5)),
            time: if case % 3 > 0 { random.between(-4.0, 4.0) } else { 0.0 },
            anchor: [None, Some(Anchor::Center), Some(Anchor::Point(random.in_cube(5.0)))][case / 4 % 3],
            in_place: case % 4 < 2,
            ..MotionOptions::default()
        };
        let alone = drawn(&text, &motion);
        let beside = drawn(&(text.clone() + &unseen(&mut random)), &motion);
        for ((program, alone), (_, beside)) in alone.into_iter().zip(beside) {
            n_pixels += alone.pixels().len();
            n_lit += alone.pixels().iter().filter(|pixel| pixel[0].max(pixel[2]) > 0.01).count();
            let off = alone
                .pixels()
                .iter()
                .zip(beside.pixels())
                .flat_map(|(a, b)| (0..4).map(|c| (a[c] - b[c]).abs()));
            let most = off.fold(0.0, f32::max);
            assert!(most < 1e-6, "case {case}, {program}: {most}\n{motion:?}\n{text}");
        }
    }
    assert!(n_lit * 4 > n_pixels, "{n_lit} of {n_pixels}");
}
