//! Each teaching option disables one effect, and no other.

use std::collections::HashMap;

use glam::DVec3;
use uglight::ColorShift;
use ugphysics::Brightness;
use ugscene::{ColorValue, Scene};
use ugtesting::Random;
use ugtests::pipe;
use ugtests::scenes::parse;

use super::{color_of, named, triangles};

/// Colours dark enough that no brightness law clips them, by hue.
const COLORS: &str = "c red 0.002 10 0.9; c green 0.001 120 1; c blue 0.003 230 0.5; c grey 0.004 0 0;\n";
const NAMES: [&str; 4] = ["red", "green", "blue", "grey"];
const BETA: DVec3 = DVec3::new(0.6, -0.4, 0.2);
const EYE: DVec3 = DVec3::new(1.0, 2.0, -3.0);

/// A scene at rest: its text and its points.
fn still() -> (String, HashMap<String, DVec3>) {
    let (text, points) = triangles(&mut Random(2), 40, &NAMES);
    (format!("{COLORS}{text}"), points)
}

fn seen(text: &str, change: impl FnOnce(&mut uglorentz::Config)) -> Vec<u8> {
    // What is divided between the points is not looked at.
    let pieces = uglorentz::Pieces::PerEdge(1);
    let mut config = uglorentz::Config { velocity: Some(BETA), eye: Some(EYE), pieces, ..Default::default() };
    change(&mut config);
    pipe::lorentz(text.as_bytes(), &config)
}

/// The colours of a seen scene, one for each vertex.
fn colored(seen: &[u8], change: impl FnOnce(&mut ugdoppler::Config)) -> Scene {
    let mut config = ugdoppler::Config { tolerance: 0.0, ..Default::default() };
    change(&mut config);
    parse(&pipe::doppler(seen, &config))
}

/// Hue, saturation, value, and the factor of linear light.
fn hsv(scene: &Scene, vertex: &ugscene::Vertex) -> [f64; 4] {
    match color_of(scene, vertex).value {
        ColorValue::Hsv { value, tint, saturation, factor } => [tint.number(), saturation, value, factor],
        other => panic!("ugdoppler writes `c` only: {other:?}"),
    }
}

/// (P10), evaluated directly.
fn doppler(seen: DVec3) -> f64 {
    (1.0 - BETA.length_squared()).sqrt() / (1.0 + BETA.dot(seen) / seen.length())
}

fn near(got: f64, want: f64) -> bool {
    (got - want).abs() <= 1e-12 * want.abs()
}

/// Runs `ugdoppler` with default options and with a change, and compares the colours of every
/// vertex. `law` receives [hue, saturation, value, factor] at rest, by default and with the change,
/// and D.
fn check_colors(
    change: impl Fn(&mut ugdoppler::Config),
    law: impl Fn([f64; 4], [f64; 4], [f64; 4], f64) -> bool,
) {
    let (text, points) = still();
    let rest = parse(text.as_bytes());
    let seen = seen(&text, |_| {});
    let (full, changed) = (colored(&seen, |_| {}), colored(&seen, change));
    assert_eq!(full.vertices.len(), changed.vertices.len());
    let (at_rest, in_full, in_part) =
        (named(&rest, &points), named(&full, &points), named(&changed, &points));
    for name in points.keys() {
        let row: usize = name[1..].parse().unwrap();
        let face = &rest.faces[row];
        let vertex = ugscene::Vertex { color: face.color, ..*at_rest[name] };
        let (one, other) = (in_full[name], in_part[name]);
        assert_eq!(one.position, other.position, "{name}");
        let colors = (hsv(&rest, &vertex), hsv(&full, one), hsv(&changed, other));
        let factor = doppler(one.position - EYE);
        assert!(law(colors.0, colors.1, colors.2, factor), "{name}: {colors:?}, D = {factor}");
    }
}

#[test]
fn no_doppler_keeps_hues_and_nothing_else() {
    check_colors(
        |config| config.shift = ColorShift::hues(false, Brightness::Report),
        |[hue, saturation, value, _], full, changed, factor| {
            changed == [hue, saturation, full[2], 1.0] && near(full[2], value * factor)
        },
    );
}

#[test]
fn no_flux_keeps_values_and_nothing_else() {
    check_colors(
        |config| config.shift = ColorShift::hues(true, Brightness::None),
        |[_, saturation, value, _], full, changed, _| changed == [full[0], saturation, value, 1.0],
    );
}

#[test]
fn without_both_colours_are_as_at_rest() {
    check_colors(
        |config| config.shift = ColorShift::NONE,
        |rest, full, changed, factor| changed == rest && (full != rest || near(factor, 1.0)),
    );
}

#[test]
fn brightness_laws_are_powers_of_d() {
    let laws = [
        (Brightness::Report, 1.0),
        (Brightness::Photon, 3.0),
        (Brightness::Bolometric, 4.0),
        (Brightness::None, 0.0),
    ];
    for (law, power) in laws {
        check_colors(
            |config| config.shift = ColorShift::hues(true, law),
            |[_, saturation, value, _], full, changed, doppler| {
                let power = libm::pow(doppler, power);
                // Linear light, or display-encoded values.
                let [value, factor] = if law.acts_on_light() { [value, power] } else { [value * power, 1.0] };
                let is_bright = near(changed[2], value) && near(changed[3], factor);
                changed[..2] == [full[0], saturation] && is_bright
            },
        );
    }
}

#[test]
fn wavelengths_are_divided_by_d() {
    check_colors(
        |config| config.wavelengths = true,
        |[hue, saturation, _, _], full, changed, factor| {
            let wavelength_nm = ugphysics::hue_to_wavelength(hue) / factor;
            let is_grey = saturation == 0.0 && changed[0] == 0.0;
            changed[1..] == full[1..] && (is_grey || near(changed[0], wavelength_nm))
        },
    );
}

#[test]
fn a_colour_depends_on_the_direction_it_is_seen_in_only() {
    let (text, points) = still();
    let near_by = seen(&text, |_| {});
    // Every vertex is moved along its ray.
    let mut random = Random(3);
    let mut scene = parse(&near_by);
    for vertex in &mut scene.vertices {
        vertex.position = EYE + (vertex.position - EYE) * random.between(0.1, 20.0);
    }
    let elsewhere = ugparse::write(&scene);
    let (a, b) = (colored(&near_by, |_| {}), colored(&elsewhere, |_| {}));
    let (a_points, b_points) = (named(&a, &points), named(&b, &points));
    for name in points.keys() {
        let pair = (hsv(&a, a_points[name]), hsv(&b, b_points[name]));
        // Hue changes by up to 1.6 degrees per nanometre, and may be near 0.
        let is_same = pair.0.iter().zip(pair.1).all(|(a, b)| (a - b).abs() <= 1e-11 * (1.0 + a.abs()));
        assert!(is_same, "{name}: {pair:?}");
    }
}

/// Runs `uglorentz` with a change and compares the position of every vertex with `law`, a function
/// of its rest position, both relative to the eye. Everything but positions must be the same as
/// without the change.
fn check_positions(change: impl Fn(&mut uglorentz::Config), law: impl Fn(DVec3) -> DVec3) {
    let (text, points) = still();
    let pieces = uglorentz::Pieces::PerEdge(2);
    let full = parse(&seen(&text, |config| config.pieces = pieces));
    let mut changed = parse(&seen(&text, |config| {
        config.pieces = pieces;
        change(config);
    }));
    let places = named(&changed, &points);
    for (name, rest) in &points {
        let (got, want) = (places[name].position - EYE, law(*rest - EYE));
        assert!((got - want).length() <= 1e-13 * want.length(), "{name}: {got} for {want}");
    }
    for (vertex, other) in changed.vertices.iter_mut().zip(&full.vertices) {
        vertex.position = other.position;
    }
    changed.stage = full.stage;
    changed.remarks.head.clone_from(&full.remarks.head);
    assert!(ugparse::write(&changed) == ugparse::write(&full));
}

fn retarded(p: DVec3) -> DVec3 {
    let (approach, rest) = (p.dot(BETA), 1.0 - BETA.length_squared());
    p + (approach - (approach * approach + rest * p.length_squared()).sqrt()) / rest * BETA
}

fn contracted(p: DVec3) -> DVec3 {
    let along = p.dot(BETA) / BETA.length_squared() * BETA;
    p - (1.0 - (1.0 - BETA.length_squared()).sqrt()) * along
}

#[test]
fn without_contraction_positions_are_p2_of_rest() {
    check_positions(|config| config.geometry.contraction = false, retarded);
}

#[test]
fn without_flight_time_positions_are_p1() {
    check_positions(|config| config.geometry.flight_time = false, contracted);
}

#[test]
fn with_both_positions_are_p1_and_then_p2() {
    check_positions(|_| {}, |p| retarded(contracted(p)));
}

#[test]
fn without_both_positions_are_as_at_rest() {
    check_positions(
        |config| config.geometry = ugscene::ShownEffects { contraction: false, flight_time: false },
        |p| p,
    );
}
