//! Colours as seen by their spectra, through the text that comes out.

use glam::DVec3;
use ugdoppler::Config;
use uglight::ColorShift;
use ugphysics::spectrum::Spectrum;
use ugphysics::{
    Velocity, WHITE_XYZ, doppler_at, linear_srgb_to_xyz, srgb_decode, xyz_to_linear_srgb,
};
use ugscene::{ColorValue, Scene, Tint};

use crate::{colour, parsed};

fn moving(x: f64, y: f64, z: f64) -> Config {
    let velocity = Velocity::from_beta(DVec3::new(x, y, z)).expect("a speed below 1");
    Config { velocity, eye: Some(DVec3::ZERO), shift: ColorShift::SPECTRA, ..Config::default() }
}

fn xyz(scene: &Scene, vertex: usize) -> [f64; 3] {
    match scene.colors[scene.vertices[vertex].color.expect("a colour").index()].value {
        ColorValue::Xyz(xyz) => xyz,
        other => panic!("not X, Y, Z: {other:?}"),
    }
}

fn named(scene: &Scene, vertex: &str) -> [f64; 3] {
    let row = scene.vertices.iter().position(|v| scene.names.get(v.name) == vertex);
    xyz(scene, row.expect("a vertex of that name"))
}

#[track_caller]
fn check(found: [f64; 3], expected: [f64; 3], tolerance: f64) {
    let is_near = |(a, b): (&f64, &f64)| (a - b).abs() <= tolerance * b.abs().max(1e-12);
    assert!(found.iter().zip(&expected).all(is_near), "{found:?} is not {expected:?}");
}

/// A triangle straight ahead, one straight behind, nearly points.
fn ahead_and_behind(colors: &str, name: &str) -> String {
    format!(
        "{colors} v a 9 0 0; v b 9 1e-9 0; v c 9 0 1e-9; f (a b c) {name};
         v d -9 0 0; v e -9 1e-9 0; v f -9 0 1e-9; f (d e f) {name};"
    )
}

/// A ribbon of triangles past which D runs from ahead to behind: enough vertices for a table.
pub fn ribbon(colors: &str, name: &str) -> String {
    let mut text = colors.to_string();
    let n = 3000;
    for k in 0..n {
        let angle = std::f64::consts::PI * (f64::from(k) + 0.5) / f64::from(n);
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        text += &format!(
            "v a{k} {} {} 0; v b{k} {} {} 0;\n",
            9.0 * cos,
            9.0 * sin,
            10.0 * cos,
            10.0 * sin
        );
    }
    for k in 1..n {
        text += &format!("f (a{} a{k} b{k}) {name};\n", k - 1);
    }
    text
}

#[test]
fn at_rest_every_colour_is_itself() {
    let text =
        "c red 0.9 0 0.8; c violet 0.7 290; c_rgb rose 1 0.5 0.5; c_xyz own 0.3 0.4 0.2; c_bb sun 5800 0.7;
        v a 9 0 0; v b 9 1 0; v c 9 1 1; f (a b c);
        v d 9 0 0; v e 9 1 0; v f 9 1 1; f (d e f) red;
        v g 9 0 0; v h 9 1 0; v i 9 1 1; f (g h i) rose;
        v j 9 0 0; v k 9 1 0; v l 9 1 1; f (j k l) own;
        v m 9 0 0; v n 9 1 0; v o 9 1 1; f (m n o) sun;
        v p 9 0 0; v q 9 1 0; v r 9 1 1; f (p q r) violet;";
    let (scene, notes) = colour(text, &moving(0.0, 0.0, 0.0));
    assert_eq!(notes, Vec::<String>::new());
    let screen = |rgb: [f64; 3]| linear_srgb_to_xyz(rgb.map(srgb_decode));
    check(named(&scene, "a"), WHITE_XYZ, 1e-12);
    check(named(&scene, "d"), screen([0.9, 0.9 * 0.2, 0.9 * 0.2]), 1e-8);
    check(named(&scene, "g"), screen([1.0, 0.5, 0.5]), 1e-8);
    assert_eq!(named(&scene, "j"), [0.3, 0.4, 0.2]);
    assert!((named(&scene, "m")[1] - 0.7).abs() < 1e-12);
    check(named(&scene, "p"), screen([0.7 * 50.0 / 60.0, 0.0, 0.7]), 1e-8);
}

/// (P13), from 1000 to 40 000 K and D from 0.1 to 10, as written.
#[test]
fn a_black_body_seen_with_d_is_one_at_d_times_t() {
    for kelvin in [1000.0, 3500.0, 10_000.0, 40_000.0] {
        let text = ribbon(&format!("c_bb body {kelvin};"), "body");
        for (tolerance, of_luminance, of_chromaticity) in [(0.1, 1e-3, 1e-4), (0.0, 1e-6, 1e-7)] {
            let config = Config { tolerance, ..moving(0.98, 0.0, 0.0) };
            let (scene, _) = colour(&text, &config);
            let (mut least, mut most) = (f64::MAX, 0.0_f64);
            for vertex in 0..scene.vertices.len() {
                let Some(_) = scene.vertices[vertex].color else { continue };
                let doppler = doppler_at(scene.vertices[vertex].position, config.velocity);
                (least, most) = (least.min(doppler), most.max(doppler));
                let expected = Spectrum::blackbody(kelvin * doppler, 1.0).seen(1.0);
                let luminance = Spectrum::blackbody(kelvin, 1.0).seen(doppler)[1];
                let found = xyz(&scene, vertex);
                assert!(
                    (found[1] / luminance - 1.0).abs() <= 1.01 * of_luminance,
                    "{kelvin} K, D = {doppler}"
                );
                let (sum, whole) = (found.iter().sum::<f64>(), expected.iter().sum::<f64>());
                for (a, b) in found.iter().zip(expected).take(2) {
                    assert!(
                        (a / sum - b / whole).abs() <= of_chromaticity,
                        "{kelvin} K, D = {doppler}"
                    );
                }
            }
            assert!(least < 0.102 && most > 9.8, "D from {least} to {most}");
        }
    }
}

#[test]
fn reuse_keeps_its_tolerance_and_saves_colours() {
    let text = ribbon("c_rgb brick 0.7 0.3 0.2;", "brick");
    let exact = colour(&text, &Config { tolerance: 0.0, ..moving(0.6, 0.0, 0.0) }).0;
    let mut n_before = exact.colors.len();
    for tolerance in [0.1, 1.0, 5.0] {
        let near = colour(&text, &Config { tolerance, ..moving(0.6, 0.0, 0.0) }).0;
        for vertex in
            (0..near.vertices.len()).filter(|&vertex| near.vertices[vertex].color.is_some())
        {
            // Between the points of the table the curve bends a little.
            check(xyz(&near, vertex), xyz(&exact, vertex), tolerance / 100.0 * 1.1 + 1e-5);
        }
        assert!(near.colors.len() < n_before, "{} of {n_before}", near.colors.len());
        n_before = near.colors.len();
    }
}

#[test]
fn teaching_switches_leave_out_one_factor_each() {
    let text = ahead_and_behind("c_rgb brick 0.7 0.3 0.2;", "brick");
    let seen = |doppler, flux| {
        let scene = colour(
            &text,
            &Config { shift: ColorShift::new(true, doppler, flux, None), ..moving(-0.6, 0.0, 0.0) },
        )
        .0;
        (named(&scene, "a"), named(&scene, "d"))
    };
    let rest = seen(false, false);
    let (both, shifted, dimmed) = (seen(true, true), seen(true, false), seen(false, true));
    check(rest.0, linear_srgb_to_xyz([0.7, 0.3, 0.2].map(srgb_decode)), 1e-8);
    // D = 2 ahead and 1/2 behind.
    check(both.0, shifted.0.map(|part| 32.0 * part), 1e-12);
    check(both.1, shifted.1.map(|part| part / 32.0), 1e-12);
    check(dimmed.0, rest.0.map(|part| 32.0 * part), 1e-12);
    check(dimmed.1, rest.1.map(|part| part / 32.0), 1e-12);
}

#[test]
fn colours_that_meet_are_added_by_angle() {
    // At `a` the red triangle has 90 degrees, the lamp 45.
    let text =
        "c_rgb red 0.8 0.1 0.1; c_bb lamp 3000 2; v a 9 0 0; v b 9 1 0; v c 9 0 1; v d 9 -1 1;
        f (a b c) red; f (a c d) lamp;";
    let (scene, _) = colour(text, &moving(-0.3, 0.0, 0.0));
    let doppler = doppler_at(DVec3::new(9.0, 0.0, 0.0), moving(-0.3, 0.0, 0.0).velocity);
    let red = Spectrum::from_linear_srgb([0.8, 0.1, 0.1].map(srgb_decode)).seen(doppler);
    let lamp = Spectrum::blackbody(3000.0, 2.0).seen(doppler);
    // Angles are those at rest, where the triangles stand askew by less than their size over the
    // distance.
    let rest = ugscene::RestFrames::with_default(&scene, moving(-0.3, 0.0, 0.0).velocity);
    let rest = ugscene::rest_positions(&scene, DVec3::ZERO, &rest);
    let angle = |from: usize, to: usize| (rest[from] - rest[0]).angle_between(rest[to] - rest[0]);
    let (first, second) = (angle(1, 2), angle(2, 3));
    let mean = |i: usize| (first * red[i] + second * lamp[i]) / (first + second);
    check(named(&scene, "a"), [mean(0), mean(1), mean(2)], 1e-3);

    let apart = colour(text, &Config { repeat: true, ..moving(-0.3, 0.0, 0.0) }).0;
    assert_eq!(apart.vertices.len(), 6);
}

#[test]
fn lights_translucency_and_what_is_not_used_stay() {
    let text = "c_rgb glass 0.2 0.5 0.9 0.25; c warm 1 40 0.3; c unused 0.5; l 1 0 0 1;
        v a 9 0 0; v b 9 1 0; v c 9 0 1; v lone 1 1 1 unused; f (a b c) glass;";
    let (scene, _) = colour(text, &Config { iris: true, ..moving(-0.5, 0.0, 0.0) });
    let before = parsed("t.ug", text);
    assert_eq!(scene.colors[..3], before.colors[..3]);
    assert_eq!(scene.lights, before.lights);
    assert!(scene.colors[3..].iter().all(|color| color.translucency == 0.25));
    assert_eq!(scene.vertices[3].color, before.vertices[3].color);
}

#[test]
fn intensities_above_one() {
    let text = ahead_and_behind("c_bb sun 5800;", "sun");
    let (kept, notes) = colour(&text, &moving(-0.5, 0.0, 0.0));
    assert!(notes[0].ends_with("kept for the renderer; -ir scales it to 1.0"), "{notes:?}");
    let (scaled, notes) = colour(&text, &Config { iris: true, ..moving(-0.5, 0.0, 0.0) });
    assert!(notes[0].ends_with("scaled to 1.0"), "{notes:?}");
    let brightest = xyz_to_linear_srgb(named(&scaled, "a")).into_iter().fold(0.0, f64::max);
    assert!((brightest - 1.0).abs() < 1e-12);
    let ratio = named(&kept, "a")[1] / named(&scaled, "a")[1];
    check(named(&scaled, "d").map(|part| part * ratio), named(&kept, "d"), 1e-12);

    // Hues keep their values, too, if asked.
    let text = ahead_and_behind("c white 1;", "white");
    let config = Config {
        keep: true,
        shift: ColorShift::default(),
        tolerance: 0.0,
        ..moving(-0.6, 0.0, 0.0)
    };
    let (scene, notes) = colour(&text, &config);
    assert_eq!(notes, ["max intensity is 2.00, kept for the renderer; -ir scales it to 1.0"]);
    let value = scene.colors[scene.vertices[0].color.unwrap().index()].value;
    assert!(
        matches!(value, ColorValue::Hsv { value, .. } if (value - 2.0).abs() < 1e-12),
        "{value:?}"
    );
}

#[test]
fn without_spectra_black_bodies_have_their_hue_at_rest() {
    let text = ahead_and_behind("c_bb glow 3000 0.3;", "glow");
    let (scene, notes) =
        colour(&text, &Config { shift: ColorShift::default(), ..moving(0.0, 0.0, 0.0) });
    assert!(notes[0].contains("(colour `glow`): `ugdoppler -sp` shifts them"), "{notes:?}");
    assert_eq!(
        scene.names.get(scene.colors[scene.vertices[0].color.unwrap().index()].name),
        "glow"
    );
    let (scene, _) =
        colour(&text, &Config { shift: ColorShift::default(), ..moving(-0.1, 0.0, 0.0) });
    let value = scene.colors[scene.vertices[0].color.unwrap().index()].value;
    // Orange turns yellow: its one wavelength is shifted, not its spectrum.
    let is_yellow = |tint| matches!(tint, Tint::Hue(hue) if (40.0..100.0).contains(&hue));
    assert!(matches!(value, ColorValue::Hsv { tint, .. } if is_yellow(tint)), "{value:?}");
}

#[test]
fn colours_no_surface_has_are_brought_toward_grey() {
    let text = ahead_and_behind("c_xyz laser 0 0.5 0;", "laser");
    let (scene, notes) = colour(&text, &moving(0.0, 0.0, 0.0));
    assert!((named(&scene, "a")[1] - 0.5).abs() < 1e-3);
    let expected = "colour `laser` is more saturated than a smooth spectrum can be, and is brought toward grey; \
                    give it by `c_spd`";
    assert_eq!(notes, [expected]);
}

#[test]
fn extreme_speeds_stay_finite() {
    let colors =
        "c_bb cold 3; c_bb hot 1e9 1e9; c_rgb red 0.9 0.1 0.1; c_spd line 588 0 589 1 590 0;";
    for name in ["cold", "hot", "red", "line"] {
        for beta in [0.999999, -0.9999999999] {
            let (scene, _) = colour(&ahead_and_behind(colors, name), &moving(beta, 0.0, 0.0));
            for vertex in ["a", "b", "d", "f"] {
                assert!(
                    named(&scene, vertex).iter().all(|part| *part >= 0.0 && part.is_finite()),
                    "{name}"
                );
            }
        }
    }
}
