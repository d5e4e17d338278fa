//! One face, one picture: colours inside faces, the triangles of bent ones, and coloured lamps are
//! the same by rays, in exact mode, and in the pipe within its tolerances.

use std::fmt::Write;

use glam::DVec3;
use uglight::ColorShift;
use ugrainbow::Channel;
use ugtesting::Random;
use ugtests::worlds::picture::{Drawn, Picture, Renderer, UNSHIFTED};

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
            for (contour, points) in [shape, hole].into_iter().filter(|points| !points.is_empty()).enumerate()
            {
                let mut names = String::new();
                for (at, &(x, y)) in points.iter().enumerate() {
                    let height = if at % 2 == 0 { bend } else { -bend };
                    let place = origin + across * x + up * y + across.cross(up) * height;
                    let color =
                        if random.one_in(3) { format!("k{}", random.below(6)) } else { String::new() };
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
        writeln!(text, "i b{body} (d{body} {mirror} -tx {x} -ty {y} -tz {z}) < {vx} {vy} {vz} >;").unwrap();
    }
    text
}

/// A camera in front of the bodies, or among them, and lamps: with spectra, of several colours.
/// (With hues, only `ugdoppler -li` and rays shift the colours of lamps.)
fn lights(random: &mut Random, unit: f64, shift: ColorShift) -> String {
    let toward = random.direction();
    let depth = if random.one_in(3) { 3.7 } else { 0.0 };
    let [ex, ey, ez] = (DVec3::new(0.013, 0.027, depth) * unit).to_array();
    let [first, second] = if matches!(shift, ColorShift::Spectra(_)) { ["k0", "k1"] } else { [""; 2] };
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
    for (row, column) in (1..SIZE[1] as usize - 1).flat_map(|row| (1..width - 1).map(move |x| (row, x))) {
        let at = row * width + column;
        let around = [at - width - 1, at - width, at - width + 1, at - 1, at + 1, at + width - 1, at + width];
        let is_off_edge = around.iter().chain([&(at + width + 1)]).all(|&near| ids[near] == ids[at]);
        if ids[at] == 0 || !is_off_edge {
            continue;
        }
        let pair = light[at].iter().zip(other[at]);
        let difference = pair.map(|(a, b)| f64::from((a - b).abs())).fold(0.0, f64::max) / brightest;
        (n, n_wrong, most) = (n + 1, n_wrong + usize::from(difference > tolerance), most.max(difference));
    }
    (n, n_wrong, most)
}

fn shifts() -> [ColorShift; 2] {
    [ColorShift::default(), ColorShift::SPECTRA]
}

/// Worlds at rest and in motion, in several units, with the eye before the bodies and among them.
#[test]
fn exact_pictures_are_those_of_rays() {
    let mut n_all = 0;
    for seed in 0..24 {
        let mut random = Random(seed);
        let unit = [1.0, 1e-6, 1e6][seed as usize % 3];
        let world = world(&mut random, unit, seed % 2 == 1);
        for shift in shifts() {
            let text = world.clone() + &lights(&mut random.clone(), unit, shift);
            let of = |renderer| drawn(&text, renderer, shift);
            let (n, n_wrong, most) = compare(&of(Renderer::Rays), &of(Renderer::Exact), EXACT);
            assert_eq!(n_wrong, 0, "world {seed}, {shift:?}: of {n} pixels, by {most:.1e}\n{text}");
            n_all += n;
        }
    }
    assert!(n_all > 20_000, "{n_all}");
}

/// At rest nothing is cut, and the pipe has only its own precision.
#[test]
fn pictures_of_the_pipe_at_rest_are_those_of_rays() {
    let mut n_all = 0;
    for seed in (0..24).step_by(2) {
        let mut random = Random(seed);
        let unit = [1.0, 1e-6, 1e6][seed as usize / 2 % 3];
        let world = world(&mut random, unit, false);
        for shift in shifts() {
            let text = world.clone() + &lights(&mut random.clone(), unit, shift);
            let of = |renderer| drawn(&text, renderer, shift);
            let (n, n_wrong, most) = compare(&of(Renderer::Rays), &of(Renderer::Pipe), PIPE);
            assert_eq!(n_wrong, 0, "world {seed}, {shift:?}: of {n} pixels, by {most:.1e}\n{text}");
            n_all += n;
        }
    }
    assert!(n_all > 10_000, "{n_all}");
}

/// A sticker in the plane of a face: before it in the scene all of it is seen, behind it nothing, by
/// every renderer, at rest and in motion, opaque and translucent.
#[test]
fn of_faces_in_one_plane_the_first_is_seen() {
    let definitions = "c_rgb grey .5 .5 .5; c_rgb red .9 .1 .1; c_rgb glass .9 .1 .1 .3;
        def big; v a -20 -20 0; v b 20 -20 0; v c 20 20 0; v d -20 20 0; f (a b c d); end;
        def dec; v e -1.3 -1.1 0; v g 1.7 -1.1 0; v h 1.7 1.2 0; v k -1.3 1.2 0; f (e g h k); end;
        cam -ep 0 -9 4 -vc 0 0 0 -va 40;";
    let n_red = |parts: [&str; 2], velocity: Option<DVec3>, renderer: Renderer| {
        let text = format!("{definitions}{}{}", parts[0], parts[1]);
        let mut picture = Picture { size: [100, 75], ..Picture::of_scene(text, UNSHIFTED) }.by(renderer);
        (picture.motion.velocity, picture.motion.in_place) = (velocity, true);
        let light = picture.draw().unwrap().light();
        light.iter().filter(|[red, green, _]| *red > 1.5 * green).count()
    };
    let mut n_seen = 0;
    for (turn, color) in
        [("-rx 17 -ry 31 -rz 11", "red"), ("-rx -40 -rz 50", "red"), ("-rx 17 -ry 31", "glass")]
    {
        let sticker = format!("i e (dec {color} {turn});");
        let face = format!("i b (big grey {turn});");
        for velocity in [None, Some(DVec3::new(0.9, 0.0, 0.0)), Some(DVec3::new(-0.3, 0.6, 0.7))] {
            let mut counts = Vec::new();
            for renderer in [Renderer::Rays, Renderer::Exact, Renderer::Pipe] {
                counts.push(n_red([&sticker, &face], velocity, renderer));
                let hidden = n_red([&face, &sticker], velocity, renderer);
                assert_eq!(hidden, 0, "{turn} {velocity:?} {renderer:?}");
            }
            n_seen += counts[0];
            let (least, most) = (counts.iter().min().unwrap(), counts.iter().max().unwrap());
            assert!(most - least <= 6, "{turn} {velocity:?} {counts:?}");
        }
    }
    assert!(n_seen > 1000, "{n_seen}");
}
