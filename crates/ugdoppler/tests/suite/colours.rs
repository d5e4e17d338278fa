//! Colours as seen, against the laws they follow.

use glam::DVec3;
use ugdoppler::{Config, apply};
use uglight::ColorShift;
use ugphysics::{Brightness, Velocity, hue_to_wavelength};
use ugpipe::Words;
use ugscene::{ColorValue, Scene};

use crate::spectra::ribbon;
use crate::{colour, parsed};

/// One green triangle, far away to the right, above and behind; and one grey.
const SCENE: &str = "c green 0.5 120; c grey 0.4; c_rgb rose 1 0.5 0.5;
    v a 9 0 0; v b 10 1 0; v c 9 1 1; f (a b c) green;
    v d 0 9 0; v e 1 10 0; v f 0 9 1; f (d e f) grey;
    v g -9 0 0; v h -9 1 0; v i -9 1 1; f (g h i) rose; v unused 1 1 1;";

fn moving(x: f64, y: f64, z: f64) -> Config {
    let velocity = Velocity::from_beta(DVec3::new(x, y, z));
    Config {
        velocity: velocity.expect("a speed below 1"),
        eye: Some(DVec3::ZERO),
        tolerance: 0.0,
        ..Config::default()
    }
}

/// Name, value, hue and saturation of a vertex's colour.
fn of(scene: &Scene, vertex: &str) -> (String, f64, f64, f64) {
    let vertex = scene.vertices.iter().find(|v| scene.names.get(v.name) == vertex);
    let vertex = vertex.expect("a vertex of that name");
    let color = &scene.colors[vertex.color.expect("a colour on every used vertex").index()];
    let name = scene.names.get(color.name).to_string();
    match color.value {
        ColorValue::Hsv { value, tint, saturation, .. } => (name, value, tint.number(), saturation),
        ColorValue::Rgb(rgb) => (name, rgb[0], rgb[1], rgb[2]),
        other => panic!("no colour of these scenes: {other:?}"),
    }
}

/// Between red and blue light is green, the mean hue, where motion shifts it, and purple elsewhere.
#[test]
fn mixtures_of_light_shift_as_the_mean_of_hues() {
    let text = "c_rgb r 1 0 0; c_rgb b 0 0 1; c_rgb m .7 0 .7; c_mix m r 0.5 b 0.5; c g 1 120;
        v a 9 0 0 m; v b 10 1 0 m; v c 9 1 1 m; f (a b c);
        v d 9 0 0 g; v e 10 1 0 g; v f 9 1 1 g; f (d e f);";
    let [still, moving] = [0.0, 0.1].map(|speed| colour(text, &moving(speed, 0.0, 0.0)).0);
    for (mixture, green) in [("a", "d"), ("b", "e"), ("c", "f")] {
        let [(_, value, hue, saturation), (_, v, h, s)] =
            [mixture, green].map(|name| of(&moving, name));
        assert!((value - v).abs() + (hue - h).abs() + (saturation - s).abs() < 1e-9, "{hue} {h}");
    }
    assert_eq!(of(&still, "a"), ("m".to_string(), 0.7, 0.0, 0.7));
}

/// The vertex is farther from the eye than the largest number.
#[test]
fn at_rest_the_farthest_colours_stay() {
    let far = SCENE.replace("v b 10 1 0", "v b 10 1.7e308 0");
    let config = Config { eye: Some(DVec3::new(0.0, -1e308, 0.0)), ..moving(0.0, 0.0, 0.0) };
    assert_eq!(of(&colour(&far, &config).0, "b").1, 0.5);
}

/// Time and memory of the light are lights times vertices, which has a limit.
#[test]
fn lights_times_vertices_are_limited() {
    let tiles =
        "def t; v a 0 0 0; v b 1 0 0; v c 1 1 0; v d 0 1 0; f (a b c d); end; a (t) 2000 -tx 1;";
    let text = |n_lights| format!("{tiles} {}", "l 0.1 0 0 1;".repeat(n_lights));
    let lit = |n_lights| {
        apply(parsed("t.ug", text(n_lights)), &Config { light: true, ..Config::default() })
            .map(drop)
    };
    assert!(lit(1).is_ok());
    let error = lit(20_000).unwrap_err().words();
    assert!(
        error.starts_with("-li computes 20000 lights at 8000 vertices, more than 134217728"),
        "{error}"
    );
}

/// Renderers refuse colours that depend on an eye other than that of the camera.
#[test]
fn the_eye_of_the_colours_is_that_of_the_camera() {
    for (camera, velocity, expected) in [
        ("", -0.6, Some(DVec3::ZERO)),
        ("cam -ep 0 0 1;", -0.6, Some(DVec3::ZERO)),
        ("cam -ep 0 0 1;", 0.0, Some(DVec3::Z)),
        ("", 0.0, None),
    ] {
        let (scene, _) = colour(&format!("{SCENE} {camera}"), &moving(velocity, 0.0, 0.0));
        assert_eq!(scene.camera().and_then(|camera| camera.eye), expected, "{camera} {velocity}");
        assert_eq!(
            scene.stage.seen_geometry().map(|seen| seen.eye),
            expected.filter(|_| velocity != 0.0)
        );
    }
}

#[test]
fn on_the_line_of_motion_d_is_known() {
    // β = 0.6: D = 2 ahead (the triangle comes at us), 0.5 behind, 0.8 abeam; conformance T19.
    let config = Config { wavelengths: true, ..moving(-0.6, 0.0, 0.0) };
    let (scene, notes) = colour(SCENE, &config);
    let check = |vertex: &str, base: &str, value: f64, wavelength: f64| {
        let (name, v, h, _) = of(&scene, vertex);
        assert!(name.starts_with(base), "{vertex}: {name}");
        assert!((v - value).abs() < 1e-12, "{vertex}: value {v}");
        assert!((h - wavelength).abs() < 1e-9, "{vertex}: wavelength {h}");
    };
    check("a", "green#", 1.0, 546.1 / 2.0);
    check("d", "grey#", 0.4 * 0.8, 0.0);
    check("g", "rose#", 0.5, 700.0 / 0.5);
    assert_eq!(notes, Vec::<String>::new());
    let unused = scene.vertices.iter().find(|v| scene.names.get(v.name) == "unused").unwrap();
    assert_eq!(unused.color, None);
}

/// Lights multiply what the iris scales, so their colours stay: else the picture would be darkened
/// twice.
#[test]
fn the_iris_leaves_lights_alone() {
    let text = format!(
        "{SCENE} c pale 0.8; f (a b c) grey <0 0 0>; l 0.3; l sun 0.7 0 0 1 0 pale; l sky 0.2 0 1 0 0 grey;"
    );
    let (scene, notes) =
        colour(&text, &Config { iris: true, keep: false, ..moving(-0.8, 0.0, 0.0) });
    assert_eq!(notes, ["max intensity is 1.50, scaled to 1.0"]);
    let value = |row: usize| match scene.colors[row].value {
        ColorValue::Hsv { value, .. } => value,
        other => panic!("{other:?}"),
    };
    let lights: Vec<f64> =
        scene.lights.iter().filter_map(|light| light.color).map(|id| value(id.index())).collect();
    assert_eq!(lights, [0.8, 0.4]);
    // Green and the resting grey, in which nothing else is changed.
    let of_vertices: Vec<f64> = scene
        .vertices
        .iter()
        .filter_map(|vertex| vertex.color)
        .map(|id| value(id.index()))
        .collect();
    assert!(of_vertices.iter().any(|value| (value - 1.0).abs() < 1e-12), "{of_vertices:?}");
    assert!(of_vertices.iter().any(|value| (value - 0.4 / 1.5).abs() < 1e-12), "{of_vertices:?}");
}

#[test]
fn the_laws_are_powers_of_d() {
    for (law, power) in [
        (Brightness::Report, 1),
        (Brightness::Photon, 3),
        (Brightness::Bolometric, 4),
        (Brightness::None, 0),
    ] {
        // D = 0.5 for the receding rose, so nothing is clipped.
        let (scene, _) =
            colour(SCENE, &Config { shift: ColorShift::hues(true, law), ..moving(-0.6, 0.0, 0.0) });
        let expected: f64 = std::iter::repeat_n(0.5, power).product();
        let vertex = scene.vertices.iter().find(|v| scene.names.get(v.name) == "g");
        let color = vertex.and_then(|vertex| vertex.color).expect("a colour on every used vertex");
        let ColorValue::Hsv { value, factor, .. } = scene.colors[color.index()].value else {
            panic!("{law:?}: {scene:?}")
        };
        // Of its value, which is 1 at rest, or of its linear light.
        let found = if law.acts_on_light() { [factor, value] } else { [value, factor] };
        assert!((found[0] - expected).abs() < 1e-12 && found[1] == 1.0, "{law:?}: {found:?}");
    }
}

/// Intensities of linear light are noted, scaled and clipped under laws that act on it.
#[test]
fn the_iris_scales_linear_light() {
    // D = 2 for the approaching rose: white, seen with 16.
    let config = |iris, keep| Config {
        shift: ColorShift::hues(true, Brightness::Bolometric),
        iris,
        keep,
        ..moving(0.6, 0.0, 0.0)
    };
    for (iris, keep, note, expected) in [
        (true, false, "scaled to 1.0", 1.0),
        (false, false, "clip to 1.0", 1.0),
        (false, true, "kept for the renderer; -ir scales it to 1.0", 16.0),
    ] {
        let (scene, notes) = colour(SCENE, &config(iris, keep));
        assert_eq!(notes, [format!("max intensity is 16, {note}")]);
        let brightest = scene.vertices.iter().filter_map(|vertex| vertex.color).map(|id| {
            let shown = uglight::hsv(&scene, &scene.colors[id.index()]);
            ugphysics::srgb_decode(shown.value)
        });
        let brightest = brightest.fold(0.0, f64::max);
        assert!((brightest - expected).abs() < 1e-9, "{brightest}, not {expected}");
    }
}

#[test]
fn teaching_switches_leave_the_other_alone() {
    let shifted =
        Config { shift: ColorShift::hues(true, Brightness::None), ..moving(-0.3, 0.0, 0.0) };
    let dimmed =
        Config { shift: ColorShift::hues(false, Brightness::Report), ..moving(-0.3, 0.0, 0.0) };
    let both = colour(SCENE, &moving(-0.3, 0.0, 0.0)).0;
    for vertex in ["a", "b", "d", "g", "i"] {
        let (_, value, hue, saturation) = of(&both, vertex);
        let (_, shift_value, shift_hue, _) = of(&colour(SCENE, &shifted).0, vertex);
        let (_, dim_value, dim_hue, dim_saturation) = of(&colour(SCENE, &dimmed).0, vertex);
        assert_eq!((shift_hue, dim_value, dim_saturation), (hue, value, saturation), "{vertex}");
        let (at_rest_value, at_rest_hue) = match vertex {
            "a" | "b" => (0.5, 120.0),
            "d" => (0.4, 0.0),
            _ => (1.0, 0.0),
        };
        assert_eq!(dim_hue, at_rest_hue, "{vertex}");
        if vertex != "d" {
            assert_eq!(shift_value, at_rest_value, "{vertex}");
        }
    }
}

#[test]
fn nothing_moves_nothing_changes() {
    let (scene, notes) = colour(SCENE, &Config::default());
    assert_eq!(scene.colors.len(), 3);
    assert_eq!(of(&scene, "a").0, "green");
    assert_eq!(of(&scene, "g").0, "rose");
    assert_eq!(notes, Vec::<String>::new());
}

#[test]
fn values_above_one_are_clipped_or_scaled() {
    let text = "c white 1; c half 0.5; v a 9 0 0; v b 9 0 1e-9; v c 9 1e-9 0; f (a b c) white;
        v d -9 0 0; v e -9 0 1e-9; v f -9 1e-9 0; f (d e f) half;";
    // D = 2 ahead and 0.5 behind.
    let clip = colour(text, &moving(-0.6, 0.0, 0.0));
    assert_eq!(clip.1, ["max intensity is 2.00, clip to 1.0"]);
    assert_eq!(of(&clip.0, "a").1, 1.0);
    assert!((of(&clip.0, "d").1 - 0.25).abs() < 1e-12);

    let iris = colour(text, &Config { iris: true, ..moving(-0.6, 0.0, 0.0) });
    assert_eq!(iris.1, ["max intensity is 2.00, scaled to 1.0"]);
    assert!((of(&iris.0, "a").1 - 1.0).abs() < 1e-12);
    assert!((of(&iris.0, "d").1 - 0.125).abs() < 1e-12);
}

#[test]
fn reuse_keeps_its_tolerance_and_saves_colours() {
    let text = ribbon("c green 0.3 120;", "green");
    let exact = colour(&text, &Config { wavelengths: true, ..moving(-0.3, 0.0, 0.0) }).0;
    let mut n_before = exact.colors.len();
    for tolerance in [0.1, 1.0, 5.0] {
        let config = Config { wavelengths: true, tolerance, ..moving(-0.3, 0.0, 0.0) };
        let near = colour(&text, &config).0;
        for (a, b) in exact.vertices.iter().zip(&near.vertices) {
            let name = exact.names.get(a.name);
            let (Some(_), Some(_)) = (a.color, b.color) else { continue };
            let ((_, v0, l0, _), (_, v1, l1, _)) = (of(&exact, name), of(&near, name));
            // A step of ln D is taken at its middle; (δ/2)² is what the bound leaves out.
            assert!((l0 - l1).abs() <= tolerance * 1.01, "{name}: {l0} {l1}");
            assert!((v0 - v1).abs() * 100.0 <= tolerance, "{name}: {v0} {v1}");
        }
        assert!(near.colors.len() < n_before, "{} of {n_before}", near.colors.len());
        n_before = near.colors.len();
    }
}

#[test]
fn colours_mix_or_stay_apart() {
    let text = "c red 1 0; c green 1 120; v a 0 9 0; v b 1 9 0; v c 0 9 1; v d -1 9 0;
        f x (a b c) red; f y (a c d) green;";
    let mixed = colour(text, &moving(0.1, 0.0, 0.0)).0;
    assert!(of(&mixed, "a").0.starts_with("mixed"));
    assert_eq!(mixed.vertices.len(), 4);

    let apart = colour(text, &Config { repeat: true, ..moving(0.1, 0.0, 0.0) }).0;
    assert_eq!(apart.vertices.len(), 6);
    for (face, base) in apart.faces.iter().zip(["red", "green"]) {
        for corner in apart.contours.corners(face.contours.clone()) {
            let name = apart.names.get(apart.vertices[corner.index()].name).to_string();
            assert!(of(&apart, &name).0.starts_with(base), "{name}");
        }
    }
}

#[test]
fn wires_keep_their_colour_beside_faces() {
    let text =
        "c pale 0.7 200 0.3; c line 1 55 0.9; c edge 1 10; v a -1 7 -1; v b 1 7 -1; v c 1 7 1;
        f (a b c) pale; w (a b c) line; w (a c) edge;";
    let scene = colour(text, &moving(0.1, 0.0, 0.0)).0;
    for (wire, base) in scene.wires.iter().zip(["line#", "edge#"]) {
        for corner in scene.contours.corners(wire.contours.clone()) {
            let name = scene.names.get(scene.vertices[corner.index()].name).to_string();
            assert!(of(&scene, &name).0.starts_with(base), "{name}");
        }
    }
    assert!(of(&scene, "a").0.starts_with("pale#"));
}

#[test]
fn a_hue_outside_the_visible_stops_at_the_end() {
    // Green is seen at 1092 nm and 273 nm.
    for (beta, hue) in [(0.6, -60.0), (-0.6, 300.0)] {
        let (scene, _) = colour(SCENE, &moving(beta, 0.0, 0.0));
        let (name, _, seen, _) = of(&scene, "a");
        assert!(name.starts_with("green#"));
        assert_eq!(seen, hue);
    }
    assert_eq!(hue_to_wavelength(300.0), 380.0);
}

#[test]
fn a_vertex_at_the_eye_is_refused() {
    let text = "(ugstage 1 geometry as-seen eye 0 0 0) v a 0 0 0; v b 1 0 0; v c 0 1 0; f (a b c) <0.5 0 0>;";
    let error = apply(parsed("t.ug", text), &Config::default()).unwrap_err().to_string();
    assert_eq!(error, "vertex `a` lies at the eye, where no direction to it exists");
    // At rest it has a place and a colour like any other.
    assert!(apply(parsed("t.ug", text.replace("<0.5 0 0>", "")), &Config::default()).is_ok());
}
