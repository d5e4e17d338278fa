//! Compares the lighting by `ugdoppler -li` with that of `ugrainbow` and with known numbers.

use glam::DVec3;
use ugdoppler::Config;
use uglight::ColorShift;
use ugphysics::{Brightness, srgb_decode};
use ugscene::{ColorValue, Scene, Tint};
use ugtests::picture::{assert_same, decode};
use ugtests::pipe::{Pipe, doppler, lorentz, rainbow};
use ugtests::scenes;

fn lit() -> Config {
    Config { light: true, tolerance: 0.0, ..Config::default() }
}

/// Positions in the scene are as seen from the origin.
const SEEN: &str = "(ugstage 1 geometry as-seen eye 0 0 0)";

/// Flat and smooth walls, seen from both sides, a face with a light level, wires, and lights of all
/// kinds: ambient, directional, local, coloured.
const ROOM: &str = "c red 0.8 10 0.7; c blue 0.9 220 0.6; c warm 1 30 0.5; c cool 0.8 200;
    v a -2 6 -1; v b 0 7 -1; v c 0 7 1; v d -2 6 1; v e 2 6 -1; v f 2 6 1;
    v n -1 5 -2 0.1 -1 0.2; v o 1 5 -2 -0.1 -1 0.2; v p 1 5 -1 0.1 -1 0.6; v q -1 5 -1 0 1 -0.6;
    f (a b c d) red; f (b c f e) red; f (n o p q) blue;
    v s -0.5 4 1.2; v t 0.5 4 1.2; v u 0 4 1.6; f (s t u) red 0.5; w (s u t) blue;
    v r 0.4 4.6 0.2 red; f (b r c);
    cam -ep 0 0 0 -vc 0 6 0 -va 50 40;";

fn room(lights: &str) -> Vec<u8> {
    format!("{ROOM} {lights}").into_bytes()
}

const LIGHTS: &str =
    "l 0.2; l 0.3 warm; l 0.3 -1 -2 1; l 0.3 2 -1 0.5 cool; l 0.4 1 3 2 0.1 warm; l 0.3 -2 4 0;";

/// [`LIGHTS`], all with a velocity.
fn with_velocity(velocity: &str) -> String {
    LIGHTS.replace(';', &format!(" {velocity};"))
}

#[test]
fn lighting_at_rest_equals_that_of_ugrainbow() {
    let mut pipe = Pipe::default();
    pipe.rainbow.picture.size = [160, 120];
    let check = |name: &str, text: &[u8], levels: u8| {
        let expected = decode(&rainbow(text, &pipe.rainbow));
        let baked = doppler(text, &lit());
        assert_same(
            &format!("lights-{name}"),
            &expected,
            &decode(&rainbow(&baked, &pipe.rainbow)),
            levels,
        );
    };
    for name in ["cubes", "teapot", "ship", "street", "halves"] {
        check(name, &scenes::text(name), 1);
    }
    // With coloured light, `ugrainbow` interpolates levels of red, green and blue, and `ugdoppler`
    // hue and saturation.
    check("white-room", &room("l 0.2; l 0.3 -1 -2 1; l 0.4 1 3 2 0.1;"), 1);
    check("room", &room(LIGHTS), 12);
}

#[test]
fn light_at_rest_in_a_moving_body_moves_along() {
    for velocity in ["0.6 0.3 -0.2", "0 -0.99 0"] {
        let beta: Vec<f64> = velocity.split(' ').map(|part| part.parse().unwrap()).collect();
        let seen = |lights: &str| {
            let pieces = uglorentz::Pieces::PerEdge(4);
            let anchor = Some(uglorentz::Anchor::Eye);
            let mut config =
                uglorentz::Config { anchor, time: 0.3, pieces, ..uglorentz::Config::default() };
            config.velocity = Some(DVec3::from_slice(&beta));
            numbers(&doppler(&lorentz(&room(lights), &config), &lit()))
        };
        assert_eq!(seen(&with_velocity(&format!("<{velocity}>"))), seen(LIGHTS));
    }
}

/// A face that faces the light and the eye, all on one line: D and D_l are powers of 2.
#[test]
fn both_factors_shift_and_dim() {
    // β = 0.6 gives D = 2 approaching and 0.5 receding; for opposite motions (P15) gives 15/17, so
    // D_l = 4.
    let face = "c green 0.1 120; v a 9 0 -1e-9; v b 9 1e-9 0; v c 9 -1e-9 0; f (a b c) green";
    for (body, light, d, d_light) in [
        ("<0.6 0 0>", "<0 0 0>", 0.5, 0.5),
        ("<-0.6 0 0>", "<0 0 0>", 2.0, 2.0),
        ("<-0.6 0 0>", "<0.6 0 0>", 2.0, 4.0),
        ("<0.6 0 0>", "<-0.6 0 0>", 0.5, 0.25),
        ("<0 0 0>", "<0.6 0 0>", 1.0, 2.0),
        ("<0.6 0 0>", "<0.6 0 0>", 0.5, 1.0),
    ] {
        // From the direction of the eye, and from a lamp on the line of sight behind the eye.
        for place in ["-1 0 0", "-30 0 0 0"] {
            let text = format!("{SEEN} {face} {body}; l 0.5 {place} {light};");
            for (law, factor) in [
                (Brightness::Report, d * d_light),
                (Brightness::Photon, d * d * d * d_light),
                (Brightness::Bolometric, d * d * d * d * d_light * d_light),
                (Brightness::None, 1.0),
            ] {
                let shift = ColorShift::hues(true, law);
                let config = Config { wavelengths: true, shift, iris: true, ..lit() };
                let scene = scenes::parse(&doppler(text.as_bytes(), &config));
                let (wavelength, intensity) = wavelength_and_intensity(&scene, law);
                assert!((wavelength - 546.1 / (d * d_light)).abs() < 1e-5, "{text}: {wavelength}");
                // The iris scales the intensity to 1.
                assert!((intensity - 1.0).abs() < 1e-12);
                let dim = Config { iris: false, ..config };
                let found =
                    wavelength_and_intensity(&scenes::parse(&doppler(text.as_bytes(), &dim)), law)
                        .1;
                let own = if law.acts_on_light() { srgb_decode(0.1) } else { 0.1 };
                let expected = (0.5 * own * factor).min(1.0);
                assert!((found - expected).abs() < 1e-9, "{text} {law:?}: {found}, {expected}");
            }
        }
    }
}

/// The wavelength of the first vertex, and what the law multiplies: its linear light or its value.
fn wavelength_and_intensity(scene: &Scene, law: Brightness) -> (f64, f64) {
    let color = scene.vertices[0].color.expect("a colour on every used vertex");
    match scene.colors[color.index()].value {
        ColorValue::Hsv { tint: Tint::Wavelength(wavelength_nm), value, factor, .. } => {
            (wavelength_nm, if law.acts_on_light() { factor * srgb_decode(value) } else { value })
        }
        other => panic!("{other:?}"),
    }
}

/// Without lights nothing changes, and the renderer uses its default lights.
#[test]
fn no_lights_no_change() {
    let text = room("");
    let config = lit();
    let (scene, notes) = ugdoppler::apply(scenes::parse(&text), &config).unwrap();
    assert!(notes.iter().any(|note| note.to_string().starts_with("no lights")), "{:?}", notes);
    assert!(scene.lights.is_empty());
    let plain = Config { light: false, ..config };
    assert_eq!(numbers(&ugparse::write(&scene)), numbers(&doppler(&text, &plain)));
}

/// Red, green and blue of every vertex, by name.
fn numbers(text: &[u8]) -> Vec<(String, [f64; 3])> {
    let scene = scenes::parse(text);
    let of = |vertex: &ugscene::Vertex| {
        let color = vertex.color.map(|color| &scene.colors[color.index()]);
        let rgb = color.map_or([1.0; 3], |color| uglight::hsv(&scene, color).to_rgb());
        (scene.names.get(vertex.name).to_string(), rgb)
    };
    scene.vertices.iter().map(of).collect()
}

/// A white surface lit by a black body: Planck's law at D_l D T, times D_l⁻² for the solid angle of
/// the lamp, (P13) and (P14).
#[test]
fn spectra_of_lights_pass_both_shifts() {
    let face = "v a 9 0 -1e-9; v b 9 1e-9 0; v c 9 -1e-9 0; f (a b c)";
    for (body, light, d, d_light) in [
        ("<0 0 0>", "<0 0 0>", 1.0, 1.0),
        ("<0.6 0 0>", "<0 0 0>", 0.5, 0.5),
        ("<-0.6 0 0>", "<0.6 0 0>", 2.0, 4.0),
        ("<0 0 0>", "<0.6 0 0>", 1.0, 2.0),
    ] {
        let text = format!("{SEEN} c_bb hot 5000 0.7; {face} {body}; l 0.5 -1 0 0 hot {light};");
        let config = Config { shift: ColorShift::SPECTRA, ..lit() };
        let scene = scenes::parse(&doppler(text.as_bytes(), &config));
        let color = scene.vertices[0].color.expect("a colour on every used vertex");
        let ColorValue::Xyz(xyz) = scene.colors[color.index()].value else { panic!("no X, Y, Z") };
        let expected = ugphysics::spectrum::Spectrum::blackbody(5000.0, 0.7).seen(d * d_light);
        for (found, expected) in xyz.into_iter().zip(expected) {
            let expected = 0.5 * expected / (d_light * d_light);
            assert!((found / expected - 1.0).abs() < 1e-6, "{text}: {xyz:?}, {expected}");
        }
    }
}

/// A lamp of daylight at rest, at normal incidence, does not change colours.
#[test]
fn full_daylight_shows_colours_as_they_are() {
    let text = "c_rgb brick 0.7 0.3 0.2; c_spd line 500 1 510 2 520 0; c_bb glow 3000 0.4;
        v a 9 0 -1e-9; v b 9 1e-9 0; v c 9 -1e-9 0; f (a b c) brick;
        v d 9 1 -1e-9; v e 9 1.0001 0; v f 9 1 0; f (d e f) line <-0.3 0 0>;
        v g 9 -1 -1e-9; v h 9 -1.0001 0; v i 9 -1 0; f (g h i) glow <0.4 0 0>;";
    let colors = |light: bool| -> Vec<[f64; 3]> {
        let config = Config { shift: ColorShift::SPECTRA, light, ..lit() };
        let scene =
            scenes::parse(&doppler(format!("{SEEN} {text} l 1 -1 0 0;").as_bytes(), &config));
        let of = |vertex: &ugscene::Vertex| match scene.colors
            [vertex.color.expect("a colour").index()]
        .value
        {
            ColorValue::Xyz(xyz) => xyz,
            other => panic!("{other:?}"),
        };
        scene.vertices.iter().map(of).collect()
    };
    for (lit, plain) in colors(true).into_iter().flatten().zip(colors(false).into_iter().flatten())
    {
        // Reflectances are interpolated between nodes.
        assert!((lit - plain).abs() < 3e-6 * plain, "{lit} {plain}");
    }
}
