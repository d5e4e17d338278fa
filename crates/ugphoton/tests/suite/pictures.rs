//! Pictures as a whole: parts, lenses, shutters, soft shadows, and scenes without an end.

use glam::DVec3;
use rayon::ThreadPoolBuilder;
use ugimage::{Format, LinearFrame, Samples};
use ugphoton::{
    Background, CameraOptions, Channel, Config, Exposure, Filter, Lens, Note, Output,
    PictureOptions, RayOptions, Shutter, light, render,
};
use ugphysics::{Hsv, Velocity, WaveVector};
use ugpipe::Words;

fn scene(text: &str) -> ugscene::Scene {
    let source = ugparse::Source::new("test.ug", text);
    ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene
}

/// A mirror, a pane of glass, a coloured box and its ground, under two lamps, one with a radius.
const ROOM: &str = "
    c red 0.9 10 0.8; c green 0.8 120 0.7; c white 1; c pane 0.9 200 0.3 0.5;
    surf mirror 0.2 0.7 0; surf glass 0 0.1 0.8 1.5;
    v a -4 4 -1; v b 4 4 -1; v c 4 9 -1; v d -4 9 -1; v e -4 9 3; v f 4 9 3;
    f (a b c d) green; f (d c f e) white mirror <0 0.3 0>;
    v g -1 6 -0.5; v h 0 6 -0.5; v i 0 6 1; v j -1 6 1; f (g h i j) red <0.5 0 0>;
    v k 0.5 5 -0.6; v l 1.5 5 -0.6; v m 1.5 5 0.8; v n 0.5 5 0.8; f (k l m n) pane <0 0 0.4>;
    l 0.3; l 0.7 0.5 -1 2; l 0.5 -2 3 4 1.5;
    cam -ep 0 0 0.5 -vc 0 6 0.3 -va 60;";

fn picture(size: [u32; 2]) -> Config {
    Config {
        picture: PictureOptions { size, samples: 2, ..PictureOptions::default() },
        ..Config::default()
    }
}

#[test]
fn parts_are_those_of_the_whole_picture() {
    for (filter, lens, stereo, adaptive) in [
        (Filter::Box, Lens::Pinhole, None, None),
        (Filter::Spline, Lens::Pinhole, None, None),
        (Filter::Spline, Lens::Pinhole, Some(0.5), None),
        (Filter::Triangle, Lens::Panorama, None, None),
        (Filter::Box, Lens::Pinhole, None, Some(0.05)),
        (Filter::Spline, Lens::Pinhole, Some(0.5), Some(0.05)),
    ] {
        let mut config = picture([50, 37]);
        config.picture.filter = filter;
        (config.lens, config.stereo, config.adaptive) = (lens, stereo, adaptive);
        config.picture.samples = if adaptive.is_some() { 4 } else { 2 };
        (config.picture.output, config.picture.channels) =
            (Output::Color(Format::Exr), Channel::NAMES.map(|(_, channel)| channel).to_vec());
        let planes = |frame: &LinearFrame| {
            ["D", "time", "Z", "id", "velocity.X"].map(|name| channel(frame, name))
        };
        let whole = light(scene(ROOM), &config).unwrap();
        let (mut joined, whole_planes) = (vec![None; 50 * 37], planes(&whole));
        for [left, top, width, height] in
            [[0, 0, 23, 19], [23, 0, 27, 19], [0, 19, 50, 1], [0, 20, 50, 17]]
        {
            let config = Config { crop: Some([left, top, width, height]), ..config.clone() };
            let part = light(scene(ROOM), &config).unwrap();
            assert_eq!([part.width(), part.height()], [width, height]);
            let part_planes = planes(&part);
            for (at, pixel) in part.pixels().iter().enumerate() {
                let (column, row) =
                    (left as usize + at % width as usize, top as usize + at / width as usize);
                joined[row * 50 + column] = Some(*pixel);
                for (plane, whole) in part_planes.iter().zip(&whole_planes) {
                    assert!(
                        plane[at].to_bits() == whole[row * 50 + column].to_bits(),
                        "{lens:?} {stereo:?}"
                    );
                }
            }
        }
        let joined: Option<Vec<_>> = joined.into_iter().collect();
        assert!(joined.unwrap() == whole.pixels(), "{filter:?} {lens:?} {stereo:?}");
    }
}

#[test]
fn threads_do_not_matter() {
    let mut config = picture([40, 30]);
    (config.picture.samples, config.adaptive) = (3, Some(0.02));
    let on = |n_threads| {
        let pool = ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
        pool.install(|| light(scene(ROOM), &config).unwrap().pixels().to_vec())
    };
    let one = on(1);
    assert!(one == on(2) && one == on(5));
    let lit = one.iter().filter(|pixel| pixel[..3].iter().any(|&channel| channel > 0.0)).count();
    assert!(lit > 300, "{lit}");
}

/// The same without soft shadows, whose lamps are seen at another point at every sample.
fn hard_room() -> String {
    ROOM.replace("3 4 1.5", "3 4")
}

/// The pixels that differ by more than rounding.
fn n_different(found: &[[f32; 4]], expected: &[[f32; 4]]) -> usize {
    assert_eq!(found.len(), expected.len());
    let differs = |(a, b): &(&[f32; 4], &[f32; 4])| (0..4).any(|at| (a[at] - b[at]).abs() > 1e-5);
    found.iter().zip(expected).filter(differs).count()
}

/// Adaptive samples trace fewer rays, and draw nearly the same: boundaries as with all samples, and
/// what is smooth within the contrast.
#[test]
fn adaptive_samples_draw_boundaries() {
    let drawn = |adaptive: Option<f64>, samples: u32| {
        let mut config = picture([80, 60]);
        (config.picture.samples, config.adaptive) = (samples, adaptive);
        config.picture.output = Output::Color(Format::Pfm);
        let drawn = render(scene(&hard_room()), &config).unwrap();
        let percent =
            |note: &Note| if let Note::Adaptive(percent) = note { Some(*percent) } else { None };
        let part = drawn.notes.iter().find_map(percent).unwrap_or(100.0) / 100.0;
        let picture =
            ugimage::read_picture(&drawn.into_file(), &ugimage::PictureLimits::default()).unwrap();
        let ugimage::Pixels::Light(pixels) = picture.pixels else { panic!("light") };
        (pixels, part)
    };
    let difference = |one: &[[f32; 4]], other: &[[f32; 4]]| {
        let pairs = one.iter().flatten().zip(other.iter().flatten());
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
    };
    for samples in [4, 8] {
        let (full, _) = drawn(None, samples);
        for (contrast, most_samples, most_error) in
            [(0.0, 0.9, 1e-6), (0.05, 0.4, 0.1 / 255.0), (0.5, 0.4, 0.01)]
        {
            let (adaptive, part) = drawn(Some(contrast), samples);
            assert!(0.25 <= part && part < most_samples, "{samples} {contrast}: {part}");
            let error = difference(&full, &adaptive);
            assert!(error <= most_error, "{samples} {contrast}: {error}");
        }
        // The first samples alone do not draw boundaries.
        let (first, part) = drawn(Some(1.0), samples);
        assert!(part < 0.3 && difference(&full, &first) > 0.05, "{part}");
    }
}

/// The first samples of a pixel reach from side to side: what they show of an edge between two
/// columns of samples.
#[test]
fn the_first_samples_reach_from_side_to_side() {
    let rows: [(u32, &[u32]); 6] =
        [(1, &[0]), (2, &[0, 1]), (3, &[0, 2]), (4, &[0, 3]), (5, &[0, 2, 4]), (8, &[0, 2, 5, 7])];
    for (n, first) in rows {
        for column in 0..n {
            let x = 2.0 * f64::from(column) / f64::from(n) - 1.0;
            let text = format!(
                "c white 1; v a {x} -9 -1; v b 9 -9 -1; v c 9 9 -1; v d {x} 9 -1; f (a b c d) white 1;
                 cam -ep 0 0 0 -vc 0 0 -1 -ud 0 1 0 -va 90;"
            );
            let mut config = picture([1, 1]);
            (config.picture.samples, config.adaptive) = (n, Some(1.0));
            let found = light(scene(&text), &config).unwrap().pixels()[0][0];
            let n_lit = first.iter().filter(|&&at| at >= column).count();
            assert!(
                (found - n_lit as f32 / first.len() as f32).abs() < 1e-6,
                "{n} {column}: {found}"
            );
        }
    }
}

/// The numbers of a channel.
fn channel(frame: &LinearFrame, name: &str) -> Vec<f64> {
    let plane = frame.planes().iter().find(|plane| plane.name == name).unwrap();
    match &plane.samples {
        Samples::Float(numbers) => numbers.iter().map(|&number| f64::from(number)).collect(),
        Samples::Whole(numbers) => numbers.iter().map(|&number| f64::from(number)).collect(),
    }
}

/// Channels of a wall that recedes, with every lens, against closed forms. Seen in a direction d at
/// time 0, the light of a wall at y = 5 + β t left at the distance r with r d_y = 5 − β r.
#[test]
fn channels_hold_with_every_lens() {
    let (beta, slant): (f64, f64) = (0.4, 90.0);
    // Coordinates of the wall are those at rest.
    let y = 5.0 / (1.0 - beta * beta).sqrt();
    let text = format!(
        "c white 1; v a -900 {y} -900; v b 900 {y} -900; v c 900 {y} 900; v d -900 {y} 900;
         f (a b c d) white 1 <0 {beta} 0>; cam -ep 0 0 0 -vc 0 1 0 -va {slant} {slant};"
    );
    let mut n_seen = 0;
    for (lens, stereo, size, film) in [
        (Lens::Pinhole, None, [20, 20], None),
        (Lens::Pinhole, None, [20, 20], Some(3.0)),
        (Lens::Pinhole, Some(0.5), [40, 20], Some(3.0)),
        (Lens::Panorama, None, [40, 20], None),
        (Lens::Fisheye { angle: 2.0 }, Some(0.5), [40, 20], None),
        (Lens::Cube, None, [120, 20], None),
    ] {
        let mut config = picture(size);
        (config.lens, config.stereo, config.picture.samples) = (lens, stereo, 1);
        (config.picture.output, config.picture.channels) =
            (Output::Color(Format::Exr), Channel::NAMES.map(|(_, channel)| channel).to_vec());
        config.rays.shutter = film.map_or(Shutter::Pinhole, |distance| Shutter::Film { distance });
        let frame = light(scene(&text), &config).unwrap();
        let [d, time, distance, depth, id, velocity] =
            ["D", "time", "distance", "Z", "id", "velocity.Y"].map(|name| channel(&frame, name));
        for at in 0..distance.len() {
            let (column, row) = (at % size[0] as usize, at / size[0] as usize);
            let place = [column % 20, row].map(|pixel| (pixel as f64 + 0.5) / 10.0 - 1.0);
            let radius = libm::hypot(place[0], place[1]);
            // The part of a unit vector in the direction of the motion, and depth by distance.
            let (ahead, flat) = match lens {
                Lens::Pinhole => (1.0 / (1.0 + radius * radius).sqrt(), true),
                Lens::Cube if (80..100).contains(&column) => {
                    (1.0 / (1.0 + radius * radius).sqrt(), false)
                }
                Lens::Panorama => {
                    let longitude = std::f64::consts::TAU * ((column as f64 + 0.5) / 40.0 - 0.5);
                    (
                        libm::cos(longitude) * libm::cos(std::f64::consts::FRAC_PI_2 * place[1]),
                        false,
                    )
                }
                Lens::Fisheye { angle } if radius < 1.0 => (libm::cos(0.5 * angle * radius), false),
                _ => continue,
            };
            let earlier = film.map_or(0.0, |distance| distance * (1.0 / ahead - 1.0));
            let far = (5.0 - beta * earlier) / (ahead + beta);
            if far < 0.0 || ahead < 0.1 - beta {
                continue;
            }
            if id[at] == 0.0 {
                // Beyond the end of the wall.
                assert!(far * (1.0 - ahead * ahead).sqrt() > 800.0 || ahead < 0.0, "{lens:?} {at}");
                continue;
            }
            n_seen += 1;
            let doppler = (1.0 - beta * beta).sqrt() / (1.0 + beta * ahead);
            for (found, expected) in [
                (distance[at], far),
                (time[at], -far - earlier),
                (d[at], doppler),
                (depth[at], if flat { far * ahead } else { far }),
                (velocity[at], beta),
            ] {
                assert!((found - expected).abs() < 1e-5 * far, "{lens:?} {at}: {found} {expected}");
            }
        }
    }
    assert!(n_seen > 2000, "{n_seen}");
}

/// A slab of absorbing glass with velocity `velocity`, 1 thick at rest, below z = `top`; its
/// coefficient is 0.7, its index 1.5.
fn absorbing_slab(top: f64, velocity: DVec3) -> String {
    let corner = |name: &str, x: f64, y: f64, z: f64| format!("v {name} {x} {y} {z};");
    let square = |name: &str, z: f64| {
        let corners = [(-500.0, -500.0), (500.0, -500.0), (500.0, 500.0), (-500.0, 500.0)];
        let corners = corners.iter().enumerate();
        corners.map(|(at, (x, y))| corner(&format!("{name}{at}"), *x, *y, z)).collect::<String>()
    };
    let motion = format!("<{} {} {}>", velocity.x, velocity.y, velocity.z);
    format!(
        "surf glass 0 0 1 1.5 20 0.7; {} {} f (n0 n1 n2 n3) white glass {motion};
         f (f3 f2 f1 f0) white glass {motion};",
        square("n", top),
        square("f", top - 1.0)
    )
}

/// The light left behind a moving slab is exp(−a L), with L the length of the path in the frame of
/// the slab: of the refracted ray, and of the straight shadow ray (P38).
#[test]
fn moving_glass_absorbs_light_along_its_path() {
    let seen = |text: &str, toward: DVec3| {
        let camera = CameraOptions {
            center: Some(toward),
            up: Some(DVec3::Y),
            view_angle: Some((1e-3, None)),
            ..CameraOptions::default()
        };
        let background = Background::Color(Hsv { hue: 0.0, saturation: 0.0, value: 1.0 });
        let picture = PictureOptions {
            size: [1, 1],
            samples: 1,
            camera,
            background,
            ..PictureOptions::default()
        };
        light(scene(text), &Config { picture, ..Config::default() }).unwrap().pixels()[0][0]
    };
    let wall = "v a -900 -900 -60; v b 900 -900 -60; v c 900 900 -60; v d -900 900 -60;";
    for velocity in [
        DVec3::ZERO,
        DVec3::new(0.0, 0.0, 0.5),
        DVec3::new(0.0, 0.0, -0.3),
        DVec3::new(0.6, 0.0, 0.0),
        DVec3::new(0.3, 0.2, -0.4),
    ] {
        let frame = Velocity::from_beta(velocity).unwrap();
        // The cosine to the normal of the slab, in its frame, of light that moves in a direction.
        let cosine = |direction: DVec3| {
            let wave = WaveVector::in_vacuum(1.0, direction.normalize()).in_frame(frame);
            wave.k.z.abs() / wave.frequency
        };
        let toward = DVec3::new(0.3, 0.1, -1.0);
        let glass = absorbing_slab(-2.0, velocity);
        let text = format!("c white 1; l 0; {wall} f (a b c d) white 1; {glass} cam -ep 0 0 0;");
        let sine_squared = (1.0 - cosine(-toward) * cosine(-toward)) / (1.5 * 1.5);
        let expected = libm::exp(-0.7 / (1.0 - sine_squared).sqrt());
        let found = f64::from(seen(&text, toward));
        assert!((found / expected - 1.0).abs() < 1e-5, "{velocity}: {found} {expected}");
        // The slab is above the eye, out of view; its shadow falls on the wall, below the middle.
        let lamp = DVec3::new(0.4, -0.2, 1.0);
        let glass = absorbing_slab(7.0, velocity);
        let text = format!(
            "c white 1; l 1 {} {} {} <0 0 0>; {wall} f (a b c d) white; {glass} cam -ep 0 0 0;",
            lamp.x, lamp.y, lamp.z
        );
        let level = ugphysics::srgb_decode(
            lamp.normalize().z * ugphysics::srgb_encode(libm::exp(-0.7 / cosine(-lamp))),
        );
        let found = f64::from(seen(&text, DVec3::NEG_Z));
        assert!((found / level - 1.0).abs() < 1e-5, "{velocity}: {found} {level}");
    }
    // Light from the background that never leaves the glass.
    let endless =
        "c white 1; l 0; surf glass 0 0 1 1.5 20 0.7; v a -9 -9 -2; v b 9 -9 -2; v c 0 9 -2;
        f (a b c) white glass; cam -ep 0 0 0;";
    assert_eq!(seen(endless, DVec3::NEG_Z), 0.0);
    assert_eq!(seen(&endless.replace(" 0.7;", ";"), DVec3::NEG_Z), 1.0);
}

/// On a coarse globe with the normals of a sphere, faces near the limit of the light are turned
/// away from the lamp. They cast no shadows with edges, since a globe hides no lamp above its
/// horizon; what another body hides is dark.
#[test]
fn shadows_end_as_smoothly_as_normals() {
    let mut text = String::from("c white 1; l 1 3 -1 1 <0 0 0>;");
    let (across, down) = (16, 8);
    for row in 0..=down {
        for column in 0..across {
            let (sin, cos) = libm::sincos(std::f64::consts::PI * f64::from(row) / f64::from(down));
            let (y, x) =
                libm::sincos(std::f64::consts::TAU * f64::from(column) / f64::from(across));
            let [x, y, z] = [sin * x, sin * y, cos];
            text += &format!("v g{row}_{column} {x} {y} {z} {x} {y} {z};");
        }
    }
    for (row, column) in (0..down).flat_map(|row| (0..across).map(move |column| (row, column))) {
        let (below, right) = (row + 1, (column + 1) % across);
        // At the poles one of the two triangles has no area.
        if row + 1 < down {
            text += &format!(
                "f (g{row}_{column} g{below}_{column} g{below}_{right}) white <0.3 0 0.2>;"
            );
        }
        if row > 0 {
            text +=
                &format!("f (g{row}_{column} g{below}_{right} g{row}_{right}) white <0.3 0 0.2>;");
        }
    }
    let drawn = |text: &str, shadows: bool| {
        let mut config = picture([60, 60]);
        config.rays.shadows = shadows;
        config.picture.samples = 1;
        config.motion.in_place = true;
        light(scene(&format!("{text} cam -ep 0 -6 0 -vc 0 0 0 -va 30;")), &config).unwrap()
    };
    let (with, without) = (drawn(&text, true), drawn(&text, false));
    let n_lit = without.pixels().iter().filter(|pixel| pixel[0] > 0.0).count();
    let n_shadowed = n_different(with.pixels(), without.pixels());
    assert!(n_lit > 200 && n_shadowed * 100 < n_lit, "{n_shadowed} of {n_lit}");
    let plate = "v p 3 -3 -2; v q 3 3 -2; v r 3 3 4; v s 3 -3 4; f (p q r s) white;";
    let hidden = drawn(&format!("{text} {plate}"), true);
    assert!(n_different(hidden.pixels(), without.pixels()) > n_lit / 2);
}

#[test]
fn lamps_with_a_radius_make_soft_shadows() {
    // A lamp at height 4. A plate over x < 0 shades the ground, unless it lies below the ground.
    let lit_below = |height: f64, radius: f64, x: f64| {
        let text = format!(
            "c white 1; v a -9 -9 0; v b 9 -9 0; v c 9 9 0; v d -9 9 0; f (a b c d) white;
             v e -9 -9 {height}; v f 0 -9 {height}; v g 0 9 {height}; v h -9 9 {height}; f (e f g h) white;
             l 1 0 0 4 {radius}; cam -ep 5 0 1 -vc {x} 0 0 -va .01;"
        );
        let mut config = picture([8, 8]);
        config.picture.samples = 4;
        let frame = light(scene(&text), &config).unwrap();
        frame.pixels().iter().map(|pixel| f64::from(pixel[0])).sum::<f64>() / 64.0
    };
    let lit = |radius: f64, x: f64| lit_below(2.0, radius, x);
    assert!(lit(0.0, 0.05) > 0.9 && lit(0.0, -0.05) == 0.0);
    // Of the disk the part beside a chord is seen; beyond x = ±1 all of it and nothing.
    assert!((lit(1.0, 1.3) - lit(0.0, 1.3)).abs() < 0.05 && lit(1.0, -1.3) == 0.0);
    for x in [-0.7_f64, -0.5, 0.0, 0.5, 0.7] {
        let part = 0.5 + (libm::asin(x) + x * (1.0 - x * x).sqrt()) / std::f64::consts::PI;
        let found = lit(1.0, x) / lit_below(-2.0, 1.0, x);
        assert!((found - part).abs() < 0.02, "{x}: {found} {part}");
    }
}

/// Two boxes, one in the other, whose walls mirror and transmit: a path has two branches at every
/// wall between them.
#[test]
fn endless_mirrors_end() {
    let mut text = String::from("c white 1; surf both 0.1 0.9 0.9 1.5; l 1;");
    for (name, (normal, other)) in ["p", "q", "r"].into_iter().zip([
        (DVec3::X, DVec3::Y),
        (DVec3::Y, DVec3::Z),
        (DVec3::Z, DVec3::X),
    ]) {
        for side in [-2.0_f64, -1.0, 1.0, 2.0] {
            let third = normal.cross(other);
            let label = format!("{}{}", if side < 0.0 { "low" } else { "high" }, side.abs());
            for (at, [u, v]) in
                [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].into_iter().enumerate()
            {
                // Counterclockwise seen from outside.
                let u = u * side.signum();
                let corner = side * normal + side.abs() * (u * other + v * third);
                text += &format!("v {name}{label}{at} {} {} {};", corner.x, corner.y, corner.z);
            }
            text += &format!("f ({0}0 {0}1 {0}2 {0}3) white both;", format!("{name}{label}"));
        }
    }
    text += "cam -ep 0 0 0 -vc 0.3 1 0.2 -va 60;";
    let mut config = picture([8, 6]);
    config.picture.samples = 1;
    config.rays = RayOptions { depth: 64, cutoff: 0.0, ..RayOptions::default() };
    let notes = render(scene(&text), &config).unwrap().notes;
    assert!(notes.contains(&Note::CutShort), "{notes:?}");
    let is_open = |note: &Note| matches!(note, Note::OpenSolid(_) | Note::ReversedSolid(_));
    let of_open_solids = |notes: &[Note]| notes.iter().any(is_open);
    // The eye is inside both boxes, which are closed.
    assert!(!of_open_solids(&notes), "{notes:?}");
    config.rays = RayOptions { depth: 3, ..RayOptions::default() };
    let notes = render(scene(&text), &config).unwrap().notes;
    assert!(!notes.contains(&Note::CutShort), "{notes:?}");
    assert!(notes.iter().any(|note| matches!(note, Note::TooDeep { depth: 3, .. })), "{notes:?}");
    let without_a_wall = text.replacen("f (phigh20 phigh21 phigh22 phigh23) white both;", "", 1);
    assert_ne!(without_a_wall, text);
    let notes = render(scene(&without_a_wall), &config).unwrap().notes;
    assert!(of_open_solids(&notes), "{notes:?}");
}

/// A solid is open if light passes around an edge of it. Opaque faces close it, too.
#[test]
fn open_solids_are_named() {
    let pane = "v a -1 5 -1; v b 1 5 -1; v c 1 5 1; v d -1 5 1;";
    let box_behind = "v e -1 6 -1; v f 1 6 -1; v g 1 6 1; v h -1 6 1;";
    let check = |faces: &str, expected: Option<&str>| {
        let text = format!(
            "surf s 0 0 1 1.5; surf thin 0 0 1; c w 1; {pane} {box_behind} {faces}
             v p -9 9 -9; v q 9 9 -9; v r 9 9 9; v t -9 9 9; f (p q r t) w; l 1; cam -ep 0 0 0 -vc 0 1 0;"
        );
        let notes = render(scene(&text), &picture([8, 6])).unwrap().notes;
        let open = notes.iter().find_map(|note| match note {
            Note::OpenSolid(face) => Some(face.as_str()),
            _ => None,
        });
        assert_eq!(open, expected, "{faces}");
    };
    check("f pane (a b c d) w s;", Some("face 1 (`pane`)"));
    check("f (d c b a) w s;", Some("face 1"));
    check("f (a b c d) w thin;", None);
    let sides = "f (f e h g) w S; f (a e f b) w S; f (b f g c) w S; f (c g h d) w S;";
    let last = "f (d h e a) w S;";
    let glass = |sides: &str| sides.replace('S', "s");
    check(&format!("f (a b c d) w s; {}", glass(&format!("{sides}{last}"))), None);
    check(&format!("f (a b c d) w s; {}", glass(sides)), Some("face 1"));
    // Water in a basin.
    check(&format!("f (a b c d) w s; {}", format!("{sides}{last}").replace('S', "1")), None);
}

#[test]
fn messages() {
    let check = |config: Config, expected: &str| {
        let found =
            render(scene(ROOM), &config).err().map(|error| error.words()).unwrap_or_default();
        assert!(found.contains(expected), "{found}");
    };
    let config = picture([40, 30]);
    check(
        Config { crop: Some([30, 0, 11, 30]), ..config.clone() },
        "-crop 30 0 11 30 is not in the picture of 40 x 30",
    );
    check(Config { crop: Some([0, 0, 0, 30]), ..config.clone() }, "is not in the picture");
    check(Config { crop: Some([u32::MAX, 0, 2, 30]), ..config.clone() }, "is not in the picture");
    let mut auto = Config { crop: Some([0, 0, 4, 3]), ..config.clone() };
    auto.picture.exposure = Some(Exposure::Auto);
    // Light is not exposed; the picture is.
    assert!(light(scene(ROOM), &auto).is_ok());
    let found = render(scene(ROOM), &auto).unwrap_err().words();
    assert!(found.contains("with -crop give the exposure"), "{found}");
    let shutter = Shutter::Film { distance: 1.0 };
    let rays = RayOptions { shutter, ..RayOptions::default() };
    check(Config { lens: Lens::Panorama, rays, ..config.clone() }, "is for pinhole cameras");
    check(Config { lens: Lens::Cube, ..config.clone() }, "such as -sz 3072 512");
    let both = Config { lens: Lens::Cube, stereo: Some(0.1), ..picture([60, 10]) };
    check(both, "leave out -stereo, or give -pan instead of -cube");
    check(Config { stereo: Some(0.1), ..picture([41, 30]) }, "give an even width");
    let annotated = |config: Config| {
        let mut config = config;
        config.picture.annotations.caption = "Caption".to_owned();
        config
    };
    let single = "annotations are for pictures of a single view: leave out -cap, -lg";
    check(annotated(Config { stereo: Some(0.1), ..config.clone() }), single);
    check(annotated(Config { lens: Lens::Cube, ..picture([60, 10]) }), single);
    // Captions and legends are below a picture of any lens; lines over it are straight.
    let mut legend = annotated(Config { lens: Lens::Panorama, ..picture([400, 150]) });
    legend.picture.annotations.legend = true;
    assert!(render(scene(ROOM), &legend).is_ok());
    legend.picture.annotations.grid = true;
    check(legend, "outline and grid are straight lines of pinhole cameras: leave out -dl");
    let mut orthographic = config.clone();
    orthographic.picture.camera.is_orthographic = true;
    check(orthographic, "leave out -og");
    let empty = light(scene("v a 0 0 0; cam -ep 0 -5 0;"), &config).unwrap_err().words();
    assert!(empty.contains("no faces"), "{empty}");
    let seen = "(ugstage 1 geometry as-seen eye 0 0 0) v a 0 1 0; v b 1 1 0; v c 0 1 1; f (a b c);";
    let seen = light(scene(seen), &config).unwrap_err().words();
    assert!(seen.contains("give the scene at rest"), "{seen}");
    let mut large = picture([16384, 16384]);
    large.picture.samples = 16;
    large.crop = Some([0, 0, 16384, 4096]);
    check(large, "lights at each of");
}
