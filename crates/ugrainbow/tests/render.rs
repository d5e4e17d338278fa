//! Pictures of small scenes against geometry, closed forms and published numbers.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

mod common;

use common::{draw, scene};
use glam::DVec3;
use ugimage::{LinearFrame, Samples};
use ugphysics::{
    Hsv, Velocity, attenuation, hue_to_wavelength, seen_position, srgb_decode, srgb_encode, wavelength_to_hue,
};
use ugrainbow::{
    Background, CameraOptions, Channel, Config, Error, HueScale, Interpolation, PictureOptions, Wireframe,
    light, render,
};
use ugrandom::Random;

const BLACK: Hsv = Hsv { hue: 0.0, saturation: 0.0, value: 0.0 };

/// One sample at the centre of each pixel.
fn plain(width: u32, height: u32) -> Config {
    Config {
        picture: PictureOptions { size: [width, height], samples: 1, ..PictureOptions::default() },
        ..Config::default()
    }
}

#[track_caller]
fn notes(text: &str, config: &Config) -> Vec<String> {
    render(&scene(text), config).unwrap().notes
}

/// Eye ten units above the plane z = 0, +y up; orthographic, and 8 units of the plane across the
/// picture.
fn map(width: u32, height: u32) -> (String, Config) {
    let angle = 2.0 * libm::atan(4.0 / 10.0).to_degrees();
    (format!("cam -ep 0 0 10 -vc 0 0 0 -ud 0 1 0 -og -va {angle} {angle};"), plain(width, height))
}

const SQUARE: &str = "v a -4 -4 0; v b 4 -4 0; v c 4 4 0; v d -4 4 0;";

fn level(encoded: f64) -> u8 {
    (255.0 * encoded).round() as u8
}

#[track_caller]
fn assert_near(pixel: [u8; 4], expected: [f64; 3]) {
    for (ours, exact) in pixel.iter().zip(expected) {
        // Half a level for rounding, and a little for single precision.
        assert!((f64::from(*ours) - 255.0 * exact).abs() < 0.51, "{pixel:?} for {expected:?}");
    }
}

#[test]
fn a_fully_lit_colour_is_its_8_bit_self() {
    let (camera, config) = map(2, 2);
    for red in (0..=255).step_by(15) {
        for green in (0..=255).step_by(17) {
            for blue in [0, 1, 100, 254] {
                let [r, g, b] = [red, green, blue].map(|level| f64::from(level) / 255.0);
                let hue = Hsv::from_rgb([r, g, b]).hue;
                if (0.0..=240.0).contains(&hue) {
                    let text = format!("c_rgb k {r} {g} {b}; l 1; {SQUARE} f (a b c d) k; {camera}");
                    assert_eq!(draw(&text, &config).pixel(1, 0), [red, green, blue, 255]);
                }
            }
        }
    }
}

#[test]
fn orthographic_squares_are_where_they_should() {
    // 8 units over 16 pixels: x in −1…2 is columns 6…12, y in 0…3 is rows 2…8.
    let (camera, config) = map(16, 16);
    let frame =
        draw(&format!("l 1; v a -1 0 3; v b 2 0 3; v c 2 3 3; v d -1 3 3; f (a b c d); {camera}"), &config);
    for y in 0..16 {
        for x in 0..16 {
            let expected = if (6..12).contains(&x) && (2..8).contains(&y) { 255 } else { 0 };
            assert_eq!(frame.pixel(x, y), [expected, expected, expected, 255], "pixel {x} {y}");
        }
    }
}

#[test]
fn film_angles_and_size_agree() {
    #[track_caller]
    fn check(camera: &str, options: CameraOptions, size: [u32; 2], expected: [std::ops::Range<u32>; 2]) {
        let config = Config {
            picture: PictureOptions { camera: options, ..plain(size[0], size[1]).picture },
            ..plain(size[0], size[1])
        };
        // A square of side 2, four units ahead.
        let text = format!(
            "l 1; v a -1 4 -1; v b 1 4 -1; v c 1 4 1; v d -1 4 1; f (a b c d); cam -ep 0 0 0 -vc 0 4 0 {camera};"
        );
        let frame = draw(&text, &config);
        let [columns, rows] = expected;
        for y in 0..size[1] {
            for x in 0..size[0] {
                let level = if columns.contains(&x) && rows.contains(&y) { 255 } else { 0 };
                assert_eq!(frame.pixel(x, y)[0], level, "pixel {x} {y} of {camera}");
            }
        }
    }
    let none = CameraOptions::default;
    // At 90 degrees the picture is 8 units wide there: a quarter of it is the square.
    check("-va 90 90", none(), [32, 32], [12..20, 12..20]);
    check("-va 90 20", none(), [32, 16], [12..20, 4..12]);
    check("-fs 2 9 -fl 1", none(), [32, 32], [12..20, 12..20]);
    check("-fs 6 9 -fl 3", none(), [32, 32], [12..20, 12..20]);
    check("-va 90 90 -fl 7", none(), [32, 32], [12..20, 12..20]);
    check("-va 1 1", CameraOptions { view_angle: Some((90.0, None)), ..none() }, [32, 16], [12..20, 4..12]);
    // Both angles: pixels need not be square.
    check("", CameraOptions { view_angle: Some((90.0, Some(90.0))), ..none() }, [32, 16], [12..20, 6..10]);
    // The upper-right quarter of the film.
    check("-va 90 90 -ph .5 .5 1 1", none(), [32, 32], [0..8, 24..32]);
    check("-va 90 90 -ph 0 .5 1 1", none(), [32, 16], [12..20, 12..16]);
    // Options override the scene.
    check(
        "",
        CameraOptions { eye: Some(DVec3::ZERO), view_angle: Some((90.0, None)), ..none() },
        [32, 32],
        [12..20, 12..20],
    );
    check("-va 90 90", CameraOptions { is_orthographic: true, ..none() }, [32, 32], [12..20, 12..20]);
}

/// Mean squared differences hide a shift; a line of pixels does not.
#[test]
fn faces_cut_through_each_other_where_their_planes_meet() {
    // z = x and z = −x/2 + 1.2 meet at x = 0.8; seen from +z.
    let text = |camera: &str| {
        format!(
            "c red 1 0; c green 1 120; l 1;
             v a -3 -3 -3 red; v b 3 -3 3 red; v c 3 3 3 red; v d -3 3 -3 red; f (a b c d);
             v e -3 -3 2.7 green; v f 3 -3 -.3 green; v g 3 3 -.3 green; v h -3 3 2.7 green; f (e f g h); {camera}"
        )
    };
    let (camera, config) = map(80, 8);
    let frame = draw(&text(&camera), &config);
    for x in 10..70 {
        // Pixel centres are a tenth of a unit apart.
        let place = (f64::from(x) + 0.5) / 10.0 - 4.0;
        let expected = if place > 0.8 { [255, 0, 0, 255] } else { [0, 255, 0, 255] };
        assert_eq!(frame.pixel(x, 4), expected, "column {x}");
    }
    // In perspective from (0, 0, 10) the line x = 0.8, z = 0.8 is seen at x/(10 − z) = 0.8/9.2.
    let frame = draw(&text("cam -ep 0 0 10 -vc 0 0 0 -ud 0 1 0 -va 40 40;"), &config);
    let half = libm::tan(20.0_f64.to_radians());
    let meeting = 40.0 + 40.0 * (0.8 / 9.2) / half;
    for x in 20..58 {
        let expected = if f64::from(x) + 0.5 > meeting { [255, 0, 0, 255] } else { [0, 255, 0, 255] };
        assert_eq!(frame.pixel(x, 4), expected, "column {x}, line at {meeting}");
    }
}

/// A floor that passes under the eye and behind it, against a ray through each pixel.
#[test]
fn a_floor_under_the_eye_is_cut_and_stays_in_perspective() {
    let (width, height) = (64, 48);
    // Linear in the plane, from 0.19 to 0.86.
    let value = |x: f64, y: f64| 0.5 + 0.004 * x + 0.003 * y;
    let corner =
        |name: &str, x: f64, y: f64| format!("c k{name} {}; v {name} {x} {y} 0 k{name};", value(x, y));
    let text = format!(
        "l 1; {} {} {} {} f (a b c d); cam -ep 1 2 3 -vc 1 6 2 -va 90 90;",
        corner("a", -40.0, -50.0),
        corner("b", 45.0, -50.0),
        corner("c", 45.0, 60.0),
        corner("d", -40.0, 60.0),
    );
    let frame = draw(&text, &plain(width, height));
    let (eye, forward) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.0, 4.0, -1.0).normalize());
    let right = forward.cross(DVec3::Z).normalize();
    let up = right.cross(forward);
    let mut n_floor = 0;
    for y in 0..height {
        for x in 0..width {
            let across = (f64::from(x) + 0.5) / f64::from(width) * 2.0 - 1.0;
            let down = ((f64::from(y) + 0.5) * 2.0 - f64::from(height)) / f64::from(width);
            let ray = forward + across * right - down * up;
            let hit = eye - ray * (eye.z / ray.z);
            let is_floor = ray.z < 0.0 && (-40.0..45.0).contains(&hit.x) && (-50.0..60.0).contains(&hit.y);
            let expected = if is_floor { value(hit.x, hit.y) } else { 0.0 };
            n_floor += u32::from(is_floor);
            assert_near(frame.pixel(x, y), [expected; 3]);
        }
    }
    assert!(n_floor > width * height / 2);
}

#[test]
fn clipping_distances_are_kept() {
    // A wall along the view: near x = 0 at the left, far at the right; hither 4, yon 6.
    let text = "l 1; v a 0 0 -9; v b 0 9 -9; v c 0 9 9; v d 0 0 9; f (a b c d);
                cam -ep -1 0 0 -vc -1 5 0 -cl 4 6 -va 60 60;";
    let frame = draw(text, &plain(200, 3));
    let half = libm::tan(30.0_f64.to_radians());
    for x in 0..200 {
        // The wall is one unit to the right: at depth z it is seen at 1/z.
        let depth = 1.0 / (((f64::from(x) + 0.5) / 100.0 - 1.0) * half);
        let expected = if (4.0..6.0).contains(&depth) { 255 } else { 0 };
        assert_eq!(frame.pixel(x, 1)[0], expected, "column {x}");
    }
}

/// The colour at part `part` of the way from a to b on an upright band.
fn band(colors: &str, a: &str, b: &str, config: &Config, part: f64) -> [u8; 4] {
    let (camera, _) = map(1, 1);
    let text = format!(
        "{colors} l 1; v a -4 -4 0 {a}; v b 4 -4 0 {b}; v c 4 4 0 {b}; v d -4 4 0 {a}; f (a b c d); {camera}"
    );
    let frame = draw(&text, config);
    frame.pixel((part * f64::from(frame.width())) as u32, frame.height() / 2)
}

#[test]
fn hues_and_wavelengths_are_interpolated_along_straight_lines() {
    let (_, config) = map(101, 5);
    let pure = |hue: f64| Hsv { hue, saturation: 1.0, value: 1.0 }.to_rgb();
    let wavelengths = Config { interpolation: Interpolation::Wavelength, ..config.clone() };
    // Half way from red to blue is green, not magenta.
    assert_near(band("c r 1 0; c b 1 240;", "r", "b", &config, 0.5), pure(120.0));
    let mid = wavelength_to_hue((700.0 + 435.8) / 2.0);
    assert_near(band("c r 1 0; c b 1 240;", "r", "b", &wavelengths, 0.5), pure(mid));
    let mid = wavelength_to_hue((hue_to_wavelength(30.0) + hue_to_wavelength(200.0)) / 2.0);
    assert_near(band("c r 1 30; c b 1 200;", "r", "b", &wavelengths, 0.5), pure(mid));
    // 340 is −20: through red to 60, never across 300. At the centre of the band's first column.
    let hue = -20.0 + 80.0 * 0.5 / 101.0;
    let fade = attenuation(hue_to_wavelength(hue));
    let dark = Hsv { hue, saturation: 1.0, value: fade }.to_rgb();
    assert_near(band("c p 1 340; c y 1 60;", "p", "y", &config, 0.0), dark);
    assert_near(band("c p 1 340; c y 1 60;", "p", "y", &config, 0.5), pure(20.0));
    // Wavelengths in the file, also invisible ones: 300 and 900 nm have the mean 600.
    let files = Config { hue_scale: HueScale::Wavelengths, ..config };
    assert_near(band("c u 1 300; c i 1 900;", "u", "i", &files, 0.5), pure(wavelength_to_hue(600.0)));
    assert_near(band("c u 1 300; c i 1 900;", "u", "i", &files, 0.0), [0.0; 3]);
    // Saturation and value are interpolated as they are.
    let mid = Hsv { hue: 100.0, saturation: 0.6, value: 0.7 }.to_rgb();
    assert_near(band("c a 1 100 .2; c b .4 100 1;", "a", "b", &Config::default(), 0.5), mid);
}

#[test]
fn grey_corners_take_the_hue_of_the_others() {
    let (_, config) = map(101, 5);
    let mid = Hsv { hue: 240.0, saturation: 0.5, value: 1.0 }.to_rgb();
    assert_near(band("c w 1; c b 1 240;", "w", "b", &config, 0.5), mid);
    let wavelengths = Config { interpolation: Interpolation::Wavelength, ..config };
    assert_near(band("c w 1; c b 1 240;", "w", "b", &wavelengths, 0.5), mid);
}

#[test]
fn faces_without_vertex_colours_have_their_own() {
    let (camera, config) = map(4, 4);
    let text = |color: &str| format!("c g 1 120; c r 1 0; l 1; {SQUARE} f (a b c d) {color}; {camera}");
    assert_eq!(draw(&text("g"), &config).pixel(1, 1), [0, 255, 0, 255]);
    assert_eq!(draw(&text(""), &config).pixel(1, 1), [255; 4]);
    let own = text("g").replace("4 0;", "4 0 r;");
    assert_eq!(draw(&own, &config).pixel(1, 1), [255, 0, 0, 255]);
}

#[test]
fn pixels_are_averaged_in_linear_light() {
    // White over the left half of every pixel of a column: half the light is level 188.
    let (camera, config) = map(8, 8);
    let text = format!("l 1; v a -4 -4 0; v b .5 -4 0; v c .5 4 0; v d -4 4 0; f (a b c d); {camera}");
    for (samples, expected) in [(2, 188), (4, 188), (16, 188)] {
        let frame = draw(
            &text,
            &Config { picture: PictureOptions { samples, ..config.picture.clone() }, ..config.clone() },
        );
        assert_eq!(frame.pixel(3, 3)[0], 255);
        assert_eq!(frame.pixel(4, 3)[0], expected);
        assert_eq!(frame.pixel(5, 3)[0], 0);
    }
    // Over a background that is not black: (1 + decode(0.5)) / 2.
    let background = Background::Color(Hsv { hue: 0.0, saturation: 0.0, value: 0.5 });
    let frame = draw(
        &text,
        &Config {
            picture: PictureOptions { samples: 4, background, ..config.picture.clone() },
            ..config.clone()
        },
    );
    let mean = srgb_encode(0.5 + 0.5 * srgb_decode(0.5));
    assert_eq!(frame.pixel(4, 3)[0], level(mean));
    assert_eq!(frame.pixel(7, 3)[0], 128);
    // Transparent: the colour of what is there, and how much of it.
    let frame = draw(
        &text,
        &Config {
            picture: PictureOptions {
                samples: 4,
                background: Background::Transparent,
                ..config.picture.clone()
            },
            ..config
        },
    );
    assert!(!frame.is_opaque());
    assert_eq!(frame.pixel(3, 3), [255; 4]);
    assert_eq!(frame.pixel(4, 3), [255, 255, 255, 128]);
    assert_eq!(frame.pixel(5, 3), [0; 4]);
}

#[test]
fn lights_follow_the_cosine_law() {
    let (camera, config) = map(5, 5);
    #[track_caller]
    fn check(lights: &str, expected: [f64; 3]) {
        let (camera, config) = map(5, 5);
        let text = format!("c red 1 0; c half .5; {lights} {SQUARE} f (a b c d); {camera}");
        assert_near(draw(&text, &config).pixel(2, 2), expected);
    }
    let grey = |level: f64| [level; 3];
    check("l .25;", grey(0.25));
    check("l .25; l .5;", grey(0.75));
    check("l 1 0 0 7;", grey(1.0));
    check("l 1 0 3 4;", grey(0.8));
    check("l .3; l .5 0 3 4;", grey(0.7));
    check("l .3; l .5 0 3 -4;", grey(0.3));
    // The light comes from below, and only the visible side, above, is lit.
    check("l 1 0 0 -1; l .1;", grey(0.1));
    check("l 1 0 0 -1 0;", grey(0.0));
    // A coloured light multiplies red, green and blue.
    check("l .2; l .5 0 0 1 red;", [0.7, 0.2, 0.2]);
    check("l 1 half;", grey(0.5));
    // No light at all: 0.3 and 0.7 from the eye.
    check("", grey(1.0));
    // The square is seen from behind and lit from that side.
    let back = format!("l .8 0 0 1; {SQUARE} f (d c b a); {camera}");
    assert_near(draw(&back, &config).pixel(2, 2), grey(0.8));
    // A level stored in the face overrides the lights.
    let stored = format!("l .8 0 0 1; {SQUARE} f (a b c d) .4; {camera}");
    assert_near(draw(&stored, &config).pixel(2, 2), grey(0.4));
}

#[test]
fn local_lights_and_normals_are_interpolated() {
    // Normals leaning left and right: level at the corners cos 45°, so in the middle too, for
    // levels are interpolated and normals are not.
    let (camera, config) = map(5, 5);
    let text = format!(
        "l 1 0 0 1; v a -4 -4 0 -1 0 1; v b 4 -4 0 1 0 1; v c 4 4 0 1 0 1; v d -4 4 0 -1 0 1; f (a b c d); {camera}"
    );
    let cos = std::f64::consts::FRAC_1_SQRT_2;
    assert_near(draw(&text, &config).pixel(2, 2), [cos; 3]);
    // A lamp 3 above the middle: each corner of the square of half side 4 sees it
    // under n·l = 3/√(9 + 32), and distance does not matter.
    let text = format!("l 1 0 0 3 0; {SQUARE} f (a b c d); {camera}");
    assert_near(draw(&text, &config).pixel(2, 2), [3.0 / f64::sqrt(41.0); 3]);
}

/// A tilted square moves; it is bent by (P3) as `uglorentz` does. It must be lit as at rest.
#[test]
fn moving_faces_are_lit_in_their_rest_frame() {
    let beta = DVec3::new(0.6, 0.3, -0.2);
    let v = Velocity::from_beta(beta).unwrap();
    let rest = [(-0.3, -0.3), (0.3, -0.3), (0.3, 0.3), (-0.3, 0.3)]
        .map(|(x, y)| DVec3::new(x, 7.0 + x, y - 0.5 * x));
    let normal = (rest[1] - rest[0]).cross(rest[3] - rest[0]).normalize();
    let light = DVec3::new(1.0, -3.0, 2.0).normalize();
    let expected = 0.2 + 0.8 * normal.dot(light).abs();
    assert!(normal.dot(light) * normal.dot(-rest[0]) > 0.0, "the light is on the side that is seen");
    let vertices = |points: &[DVec3; 4]| -> String {
        points
            .iter()
            .zip("abcd".chars())
            .map(|(p, name)| format!("v {name} {} {} {};", p.x, p.y, p.z))
            .collect()
    };
    let check = |points: [DVec3; 4], velocity: &str| {
        let center = points.iter().sum::<DVec3>() / 4.0;
        let text = format!(
            "(ugstage 1 geometry as-seen eye 0 0 0) l .2; l .8 1 -3 2; {} f (a b c d) {velocity}; cam -ep 0 0 0 -vc {} {} {} -va 1 1;",
            vertices(&points),
            center.x,
            center.y,
            center.z
        );
        assert_near(draw(&text, &plain(3, 3)).pixel(1, 1), [expected; 3]);
    };
    check(rest, "");
    check(rest.map(|p| seen_position(p, v)), "<0.6 0.3 -0.2>");
}

#[test]
fn wires_are_seen_in_front_and_hidden_behind() {
    let (camera, config) = map(16, 16);
    let text = |z: f64| {
        format!(
            "c red 1 0; c grey .5; l 1; v a -2 -2 0; v b 2 -2 0; v c 2 2 0; v d -2 2 0; f (a b c d) grey;
             v p -4 .25 {z}; v q 4 .25 {z}; w (p q) red; {camera}"
        )
    };
    let (red, grey) = ([255, 0, 0, 255], [128, 128, 128, 255]);
    // y = 0.25 is the middle of row 7; half a unit is a pixel.
    for (z, inside) in [(1.0, red), (0.0, red), (-1.0, grey)] {
        let frame = draw(&text(z), &config);
        assert_eq!(frame.pixel(1, 7), red, "outside the face, z = {z}");
        assert_eq!(frame.pixel(8, 7), inside, "z = {z}");
        assert_eq!(frame.pixel(8, 5), grey);
        assert_eq!(frame.pixel(1, 9), [0, 0, 0, 255]);
    }
    // In perspective, and past the eye.
    let text = "c red 1 0; l 1; v p 0 -5 -1; v q 0 50 -1; w (p q) red; cam -ep 0 0 0 -vc 0 5 -1 -va 60 60;";
    let frame = draw(text, &plain(21, 21));
    for y in 11..21 {
        assert_eq!(frame.pixel(10, y), red, "row {y}");
        assert_eq!(frame.pixel(8, y)[0], 0, "row {y}");
    }
}

#[test]
fn every_number_of_threads_draws_the_same() {
    let mut text = String::from("c a .9 20; c b .8 200 .5; l .2; l .8 1 -2 3;");
    for k in 0..400 {
        let angle = f64::from(k) * 2.4;
        let [x, y, z] = [libm::cos(angle), libm::sin(angle), libm::sin(1.7 * angle)].map(|u| 3.0 * u);
        text += &format!(
            "v p{k} {x} {y} {z}; v q{k} {} {} {} a; v r{k} {y} {z} {x}; f (p{k} q{k} r{k}) b; w (p{k} r{k});",
            -z, x, y
        );
    }
    text += "cam -ep 0 -12 1;";
    let scene = scene(&text);
    let config = Config {
        picture: PictureOptions { size: [320, 240], samples: 3, ..PictureOptions::default() },
        ..Config::default()
    };
    let with_threads = |n_threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
        let rendering = pool.install(|| render(&scene, &config).unwrap());
        (rendering.notes.clone(), rendering.into_frame().unwrap())
    };
    let (notes, frame) = with_threads(1);
    for n_threads in [2, 3, 7] {
        assert!(with_threads(n_threads) == (notes.clone(), frame.clone()), "{n_threads} threads");
    }
    assert!(frame.pixels().iter().filter(|pixel| pixel[0] > 0).count() > 10_000);
}

#[test]
fn sizes_that_do_not_fit_are_refused() {
    #[track_caller]
    fn check(size: [u32; 2], samples: u32, message: &str) {
        let error = render(
            &scene("l 1;"),
            &Config {
                picture: PictureOptions { size, samples, ..PictureOptions::default() },
                ..Config::default()
            },
        )
        .unwrap_err();
        assert!(error.is_usage());
        assert_eq!(error.to_string(), message);
    }
    check(
        [32_768, 16_384],
        4,
        "a picture of 32768 x 16384 pixels cannot be made: the limit is 268435456 pixels in all and 16777216 \
         along a side; give a smaller -sz",
    );
    check(
        [0, 7],
        4,
        "a picture of 0 x 7 pixels cannot be made: the limit is 268435456 pixels in all and 16777216 along a \
         side; give a smaller -sz",
    );
    check(
        [u32::MAX, 1],
        4,
        "a picture of 4294967295 x 1 pixels cannot be made: the limit is 268435456 pixels in all and 16777216 \
         along a side; give a smaller -sz",
    );
    check([8, 8], 17, "17 x 17 samples a pixel cannot be taken; give -aa 1 to 16");
    check([8, 8], 0, "0 x 0 samples a pixel cannot be taken; give -aa 1 to 16");
}

#[test]
fn scenes_without_a_picture_are_errors() {
    #[track_caller]
    fn check(text: &str, message: &str) {
        assert_eq!(render(&scene(text), &plain(4, 4)).unwrap_err().to_string(), message);
    }
    assert!(matches!(render(&scene("v a 0 0 0; l 1;"), &plain(4, 4)), Err(Error::Empty)));
    check(
        "",
        "the scene has no faces and no wires, so there is nothing to draw; check that the program before in \
         the pipe wrote one",
    );
    check(
        &format!("{SQUARE} f (a b c d);"),
        "the eye point 0 0 0 is also the view centre, so there is no direction to look in; move the eye with \
         -ep or the centre with -vc",
    );
    check(
        &format!("{SQUARE} f (a b c d); cam -ep 0 0 5 -va 180 40;"),
        "a view angle of 180 degrees cannot be projected on a flat picture; give -va more than 0 and less than \
         180",
    );
    check(
        &format!("{SQUARE} f (a b c d); cam -ep 0 0 5 -fs 1 1 -fl 0;"),
        "the film size and the focal length of the camera must be positive; correct -fs and -fl of the `cam` \
         statement, or give -va",
    );
    check(
        &format!("{SQUARE} f (a b c d); cam -ep 0 0 5 -ph 0 0 0 1;"),
        "the film rectangle of the camera has no area; give -ph of the `cam` statement as min x, min y, max x, \
         max y",
    );
    check(
        &format!("{SQUARE} f (a b c d); cam -ep 0 0 5 -cl 3 2;"),
        "nothing lies between the clipping distances 3 and 2; give -cl of the `cam` statement as hither and a \
         greater yon",
    );
}

#[test]
fn pictures_in_which_nothing_is_seen_say_why() {
    #[track_caller]
    fn check(text: &str, config: &Config, expected: &[&str]) {
        let notes = notes(text, config);
        assert_eq!(notes, expected);
    }
    let square = format!("c green 1 120; c far 1 900; c black 0; l 1; {SQUARE} f (a b c d)");
    let config = plain(32, 32);
    check(&format!("{square}; cam -ep 1 0 20;"), &config, &[]);
    check(
        &format!("{square}; cam -ep 0 0 20 -vc 0 0 30 -ud 0 1 0;"),
        &config,
        &["nothing is drawn: everything is behind the eye or outside the clipping distances; try \
             `uglorentz --keep-in-view`, another -ep or -vc"],
    );
    check(
        &format!("{square}; cam -ep 0 0 20 -vc 90 0 0;"),
        &config,
        &["nothing is drawn: everything is outside the picture, where fast bodies often are; \
             try `uglorentz --keep-in-view`, another -vc or a wider -va"],
    );
    check(
        &format!("{square}; cam -ep 30 0 0 -vc 0 0 0;"),
        &config,
        &[
            "nothing is drawn: everything is seen edge-on or smaller than a sample; try another -ep or a narrower \
           -va",
        ],
    );
    check(
        &format!("{square} far; cam -ep 1 0 20;"),
        &Config { hue_scale: HueScale::Wavelengths, ..config.clone() },
        &[
            "all that is in the picture is black: its wavelengths are outside 380-780 nm; try a lower speed, or \
           `ugdoppler --no-doppler --no-flux` to see the shape",
        ],
    );
    // The white part of a pale colour stays visible.
    let moved = "c far .5 900 .8; v e 30 0 0; v f 31 0 0; v g 30 1 0; f (e f g) far";
    check(
        &format!("{moved}; l 1; cam -ep 30.2 .2 20 -vc 30.2 .2 0 -ud 0 1 0;"),
        &Config { hue_scale: HueScale::Wavelengths, ..config.clone() },
        &[
            "all that is in the picture is black or grey: its wavelengths are outside 380-780 nm; try a lower \
           speed, or `ugdoppler --no-doppler --no-flux` to see the shape",
        ],
    );
    // The picture is 40 tan 2.5° = 1.746 wide, so 1.373 / 1.746 of it is out of range, then 0.373.
    let parts = |near: f64| {
        format!(
            "c far 1 900; c green 1 546; l 1; v a -1 -1 0; v b 1 -1 0; v c 1 1 0; v d -1 1 0; v e {near} -1 0; \
             v f {near} 1 0; v g {near} -1 0; v h {near} 1 0; f (a e f d) far; f (g b c h) green; \
             cam -ep 0 0 20 -vc 0 0 0 -ud 0 1 0 -va 5;"
        )
    };
    let wavelengths = Config { hue_scale: HueScale::Wavelengths, ..config.clone() };
    check(
        &parts(0.5),
        &wavelengths,
        &["78 percent of what is in the picture is black or grey: its wavelengths are outside 380-780 nm; \
           try a lower speed, or `ugdoppler --no-doppler --no-flux` to see the shape"],
    );
    check(&parts(-0.5), &wavelengths, &[]);
    check(
        &format!("{square} black; cam -ep 1 0 20;"),
        &config,
        &[
            "all that is in the picture is black: its colours are, or no light falls on it; try `l 1;` in the \
           scene",
        ],
    );
    // Black lines, on black and on white.
    let lines =
        Config { wireframe: Some(Wireframe { has_faces: false, color: Some(BLACK) }), ..config.clone() };
    let text = format!("{square}; cam -ep 1 0 20;");
    check(&text, &lines, &["the lines are black on black: choose another colour with -lc or -bg"]);
    let mut on_white = lines;
    on_white.picture.background = Background::Color(Hsv { value: 1.0, ..BLACK });
    check(&text, &on_white, &[]);
    check(
        &format!("{square}; l .25; cam -ep 0 0 20;"),
        &config,
        &[
            "the up direction is zero or parallel to the view, so another axis is up; choose one with -ud",
            "max intensity is 1.25, clip to 1.0",
        ],
    );
    check(&format!("{square}; l 1; cam -ep 1 0 20;"), &config, &["max intensity is 2.0, clip to 1.0"]);
    check(
        &format!("c clear 1 0 1 .5; {SQUARE} f (a b c d) clear; cam -ep 1 0 20;"),
        &config,
        &["no lights in the scene: drawn with ambient light 0.3 and a light of 0.7 from the eye"],
    );
}

#[test]
fn no_scene_makes_it_panic() {
    // Coordinates near the ends of the number range, needles, points, folded faces.
    let corners =
        ["0 0 0", "1e308 0 0", "-1e308 1e308 0", "1e-308 0 1e-320", "0 5 0", "1e154 1e154 1e154", "3 4 5"];
    let mut vertices = String::new();
    for (idx, place) in corners.iter().enumerate() {
        vertices += &format!("v p{idx} {place};");
    }
    let mut n_drawn = 0;
    for a in 0..corners.len() {
        for b in 0..corners.len() {
            let text = format!(
                "{vertices} l 1; l 1 1 2 3 4; f (p{a} p{b} p4 p6) (p{b} p2 p5); w (p{a} p{b}); w (p{a} p{a});
                 cam -ep {} -vc {};",
                corners[a], corners[b]
            );
            let source = ugparse::Source::new("test.ug", text);
            let Ok(parsed) = ugparse::parse(&source, &ugparse::Options::default()) else { continue };
            for is_orthographic in [false, true] {
                let camera = CameraOptions { is_orthographic, ..CameraOptions::default() };
                let config =
                    Config { picture: PictureOptions { camera, ..plain(16, 16).picture }, ..plain(16, 16) };
                n_drawn += usize::from(render(&parsed.scene, &config).is_ok());
                let picture = PictureOptions { channels: Channel::ALL.to_vec(), ..config.picture.clone() };
                let Ok(frame) = light(&parsed.scene, &Config { picture, ..config }) else { continue };
                assert_finite(&frame);
            }
        }
    }
    assert!(n_drawn > 10, "{n_drawn}");
}

/// Every number is finite where something is drawn.
#[track_caller]
fn assert_finite(frame: &LinearFrame) {
    let drawn: Vec<bool> = frame
        .planes()
        .iter()
        .find_map(|plane| match &plane.samples {
            Samples::Whole(ids) => Some(ids.iter().map(|&id| id > 0).collect()),
            Samples::Float(_) => None,
        })
        .unwrap();
    assert!(frame.pixels().iter().flatten().all(|number| number.is_finite()));
    for plane in frame.planes() {
        let Samples::Float(numbers) = &plane.samples else { continue };
        let is_finite = numbers.iter().zip(&drawn).all(|(number, drawn)| !drawn || number.is_finite());
        assert!(is_finite, "{}: {numbers:?}", plane.name);
    }
}

/// Triangles through each other, round the eye and behind it, against a ray through every pixel.
#[test]
fn triangles_are_where_rays_meet_them() {
    let mut random = Random(7);
    // Colours 0…119 as levels of red and green, so that a pixel names its triangle.
    let triangles: Vec<[DVec3; 3]> = (0..120)
        .map(|_| {
            let center = random.in_cube(6.0);
            [(); 3].map(|()| center + random.in_cube(4.0))
        })
        .collect();
    let mut text = String::from("l 1; cam -ep 0 0 0 -vc 1 2 .5 -va 80 80;");
    for (idx, triangle) in triangles.iter().enumerate() {
        let [red, green] = [idx % 11, idx / 11].map(|part| 0.1 + 0.08 * part as f64);
        text += &format!("c_rgb k{idx} {red} {green} 0;");
        for (corner, p) in triangle.iter().enumerate() {
            text += &format!("v p{idx}_{corner} {} {} {} k{idx};", p.x, p.y, p.z);
        }
        text += &format!("f (p{idx}_0 p{idx}_1 p{idx}_2);");
    }
    let (width, height) = (160, 120);
    let frame = draw(&text, &plain(width, height));
    let forward = DVec3::new(1.0, 2.0, 0.5).normalize();
    let right = forward.cross(DVec3::Z).normalize();
    let up = right.cross(forward);
    let half = libm::tan(40.0_f64.to_radians());
    let (mut n_hits, mut n_wrong) = (0, 0);
    for y in 0..height {
        for x in 0..width {
            let across = ((f64::from(x) + 0.5) / f64::from(width) * 2.0 - 1.0) * half;
            let down = ((f64::from(y) + 0.5) * 2.0 - f64::from(height)) / f64::from(width) * half;
            let ray = forward + across * right - down * up;
            let hits = triangles.iter().enumerate().filter_map(|(idx, t)| Some((hit(ray, t)?, idx)));
            let nearest = hits.min_by(|a, b| a.0.total_cmp(&b.0));
            let expected = nearest.map_or([0; 3], |(_, idx)| {
                [level(0.1 + 0.08 * (idx % 11) as f64), level(0.1 + 0.08 * (idx / 11) as f64), 0]
            });
            n_hits += u32::from(nearest.is_some());
            n_wrong += u32::from(frame.pixel(x, y)[..3] != expected);
        }
    }
    assert!(n_hits > 10_000, "{n_hits}");
    // Depth keys are in single precision: a pixel within 1e-7 of a line where faces meet may
    // go either way. Such are rarer than one in a picture.
    assert!(n_wrong <= 1, "{n_wrong} pixels of {n_hits}");
}

/// Distance along `ray` from the origin to a triangle (Möller and Trumbore 1997).
fn hit(ray: DVec3, [a, b, c]: &[DVec3; 3]) -> Option<f64> {
    let (ab, ac) = (b - a, c - a);
    let p = ray.cross(ac);
    let scale = 1.0 / ab.dot(p);
    let u = -a.dot(p) * scale;
    let q = (-a).cross(ab);
    let v = ray.dot(q) * scale;
    let distance = ac.dot(q) * scale;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0).then_some(distance)
}
