//! One face, one picture: colours inside faces, the triangles of bent ones, and coloured lamps are
//! the same by rays, in exact mode, and in the pipe within its tolerances.

use std::fmt::Write;

use glam::DVec3;
use uglight::ColorShift;
use ugrainbow::Channel;
use ugtesting::Random;
use ugtests::worlds::picture::{Drawn, Picture, Renderer};

const SIZE: [u32; 2] = [64, 48];

/// Exact pictures interpolate in single precision, and tabulate spectra over D: two thousandths of
/// a channel, relative to the brightest of the picture.
const EXACT: f64 = 2e-3;

/// The pipe interpolates D and light within its tolerances.
const PIPE: f64 = 1e-2;

/// Bodies of random faces: quads, slightly bent or flat, concave ones, and ones with holes and with
/// corners on straight sides; placed as they are and mirrored. Everything is in units of `unit`.
fn world(random: &mut Random, unit: f64, is_moving: bool) -> String {
    const SHAPES: [&[(f64, f64)]; 5] = [
        &[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)],
        &[(0.0, 0.0), (1.0, 0.1), (0.9, 0.8), (0.1, 1.0)],
        &[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.4, 0.4), (0.0, 0.9)],
        &[(0.0, 0.0), (0.5, 0.0), (1.0, 0.0), (1.0, 1.0), (0.5, 1.0), (0.0, 1.0)],
        &[(0.0, 0.0), (1.0, 0.0), (1.2, 0.6), (0.6, 1.1), (-0.2, 0.7)],
    ];
    const HOLE: [(f64, f64); 4] = [(0.4, 0.1), (0.6, 0.1), (0.6, 0.3), (0.4, 0.3)];
    let mut text = String::new();
    for color in 0..6 {
        let [hue, saturation] = [random.between(0.0, 240.0), random.between(0.2, 1.0)];
        writeln!(text, "c k{color} {} {hue} {saturation};", random.between(0.3, 1.0)).unwrap();
    }
    for body in 0..3 {
        writeln!(text, "def d{body};").unwrap();
        for face in 0..4 {
            let bend = if random.one_in(2) { 0.0 } else { random.between(-0.02, 0.02) };
            let (across, up) = random.direction().any_orthonormal_pair();
            let origin = random.in_cube(1.2);
            let mut contours = String::new();
            let shape = *random.pick(&SHAPES);
            let hole = if random.one_in(3) && shape.len() != 5 { &HOLE[..] } else { &[] };
            for (contour, points) in
                [shape, hole].into_iter().filter(|points| !points.is_empty()).enumerate()
            {
                let mut names = String::new();
                for (at, &(x, y)) in points.iter().enumerate() {
                    let height = if at % 2 == 0 { bend } else { -bend };
                    let place = origin + across * x + up * y + across.cross(up) * height;
                    let color = if random.one_in(3) {
                        format!("k{}", random.below(6))
                    } else {
                        String::new()
                    };
                    let [x, y, z] = (place * unit).to_array();
                    writeln!(text, "v p{face}_{contour}_{at} {x} {y} {z} {color};").unwrap();
                    write!(names, "p{face}_{contour}_{at} ").unwrap();
                }
                write!(contours, "({names})").unwrap();
            }
            writeln!(text, "f {contours} k{};", random.below(6)).unwrap();
        }
        writeln!(text, "end;").unwrap();
        let place = (random.in_cube(1.0) + DVec3::new(0.0, 0.0, 4.0)) * unit;
        let mirror = if random.one_in(2) { "-mx" } else { "" };
        let velocity = if is_moving { random.in_ball(0.6) } else { DVec3::ZERO };
        let ([x, y, z], [vx, vy, vz]) = (place.to_array(), velocity.to_array());
        writeln!(text, "i b{body} (d{body} {mirror} -tx {x} -ty {y} -tz {z}) < {vx} {vy} {vz} >;")
            .unwrap();
    }
    text
}

/// A camera in front of the bodies, or among them, and lamps: with spectra, of several colours.
/// (With hues, only `ugdoppler -li` and rays shift the colours of lamps.)
fn lights(random: &mut Random, unit: f64, shift: ColorShift) -> String {
    let toward = random.direction();
    let depth = if random.one_in(3) { 3.7 } else { 0.0 };
    let [ex, ey, ez] = (DVec3::new(0.013, 0.027, depth) * unit).to_array();
    let [first, second] =
        if matches!(shift, ColorShift::Spectra(_)) { ["k0", "k1"] } else { [""; 2] };
    format!(
        "l .3; l .5 {} {} {} {first}; l .4 .3 .5 -1 {second}; cam -ep {ex} {ey} {ez} -vc {ex} {ey} {} -ud 0 1 0 -va 60;",
        toward.x,
        toward.y,
        toward.z,
        ez + unit,
    )
}

fn drawn(text: &str, renderer: Renderer, shift: ColorShift) -> Drawn {
    let picture = Picture::of_scene(text.to_owned(), shift).like_pipe().by(renderer);
    let picture = Picture { size: SIZE, channels: vec![Channel::Id], ..picture };
    picture.draw().unwrap_or_else(|error| panic!("{error}"))
}

/// The pixels off an edge in the ray tracer's picture, and how many of them differ by more than
/// `tolerance` of the brightest channel, and the largest difference.
fn compare(rays: &Drawn, other: &Drawn, tolerance: f64) -> (usize, usize, f64) {
    let (width, ids) = (SIZE[0] as usize, rays.ids());
    let (light, other) = (rays.light(), other.light());
    let brightest = light.iter().flatten().fold(0.0_f64, |most, &part| most.max(part.into()));
    let (mut n, mut n_wrong, mut most) = (0, 0, 0.0_f64);
    for (row, column) in
        (1..SIZE[1] as usize - 1).flat_map(|row| (1..width - 1).map(move |x| (row, x)))
    {
        let at = row * width + column;
        let around = [
            at - width - 1,
            at - width,
            at - width + 1,
            at - 1,
            at + 1,
            at + width - 1,
            at + width,
        ];
        let is_off_edge =
            around.iter().chain([&(at + width + 1)]).all(|&near| ids[near] == ids[at]);
        if ids[at] == 0 || !is_off_edge {
            continue;
        }
        let pair = light[at].iter().zip(other[at]);
        let difference =
            pair.map(|(a, b)| f64::from((a - b).abs())).fold(0.0, f64::max) / brightest;
        (n, n_wrong, most) =
            (n + 1, n_wrong + usize::from(difference > tolerance), most.max(difference));
    }
    (n, n_wrong, most)
}

/// Worlds at rest and in motion, in several units, with the eye before the bodies and among them.
/// At rest nothing is cut, so there the pipe has only its own precision.
#[test]
fn pictures_are_those_of_rays() {
    let mut n_all = [0; 2];
    for seed in 0..24 {
        let mut random = Random(seed);
        let unit = [1.0, 1e-6, 1e6][seed as usize % 3];
        let is_moving = seed % 2 == 1;
        let world = world(&mut random, unit, is_moving);
        for shift in [ColorShift::default(), ColorShift::SPECTRA] {
            let text = world.clone() + &lights(&mut random.clone(), unit, shift);
            let of = |renderer| drawn(&text, renderer, shift);
            let rays = of(Renderer::Rays);
            let others = [(Renderer::Exact, EXACT), (Renderer::Pipe, PIPE)];
            for (row, (renderer, tolerance)) in
                others.into_iter().enumerate().take(2 - usize::from(is_moving))
            {
                let (n, n_wrong, most) = compare(&rays, &of(renderer), tolerance);
                assert_eq!(
                    n_wrong, 0,
                    "world {seed}, {shift:?}: of {n} pixels, by {most:.1e}\n{text}"
                );
                n_all[row] += n;
            }
        }
    }
    assert!(n_all[0] > 20_000 && n_all[1] > 10_000, "{n_all:?}");
}
