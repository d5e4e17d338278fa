//! `--explain`: its bytes are those of the picture, and its numbers satisfy the equations.

use glam::DVec3;
use serde_json::Value;

use crate::cli::UGRAINBOW;

/// Faces of hues, greys and light, a hole, a wire, bodies at three velocities, a coloured light.
const SCENE: &str = "\
{ uglorentz 0.1.0: uglorentz -se .1 }
(ugstage 1 geometry as-seen eye 0 0 0 colors as-seen hues law photon)
c red 1.4 350 .8; c blue .7 250; c grey .6; c_xyz hot 6 5 1; c warm 1 30 .4;
l .2; l .6 -1 -2 3 warm; l 1 2 -3 4;
v a -4 5 -3; v b 4 5 -3 blue; v c 4 5 3; v d -4 5 3 red;
v e -1 5 -1; v f 1 5 -1; v g 1 5 1; v h -1 5 1;
f wall (a b c d) (e f g h) red <.5 .2 0>;
v i -3 4 -2; v j 0 3.5 2.5; v k 2 7 -1; f shard (i j k) hot <0 .8 .1>;
v m 1 3 -2; v n 3 3 -2; v o 2 3 1; f (m n o) grey;
v p -2 3 2 hot; v q 2 3 2 blue; w line (p q a) grey;
cam -ep 0 0 0 -vc 0 5 0 -va 70 50;
";

fn ugrainbow(scene: &str, args: &str) -> Vec<u8> {
    UGRAINBOW.output(&format!("-qt -sz 60 45 {args}"), scene)
}

fn told(scene: &str, args: &str) -> Value {
    serde_json::from_slice(&ugrainbow(scene, &format!("{args} --format json"))).unwrap()
}

fn text(scene: &str, args: &str) -> String {
    String::from_utf8(ugrainbow(scene, args)).unwrap()
}

#[track_caller]
fn has_all(text: &str, parts: &[&str]) {
    parts.iter().for_each(|part| assert!(text.contains(part), "{part}:\n{text}"));
}

/// Red, green, blue and alpha of every pixel of a PNG.
fn pixels(file: &[u8]) -> Vec<[u8; 4]> {
    ugimage::read_png(file, &ugimage::PictureLimits::default()).unwrap().0.into_pixels()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn point(value: &Value) -> DVec3 {
    DVec3::from_array(std::array::from_fn(|i| number(&value[i])))
}

#[test]
fn the_last_step_is_the_picture() {
    let hues = SCENE.replace("c_xyz hot 6 5 1;", "c hot 1.2 60;");
    let mut seen = [0; 3];
    for (scene, options) in [
        (SCENE, "-aa 4"),
        (SCENE, "-aa 3 -ex auto -tc filmic -bg .2 200"),
        (SCENE, "-aa 2 -tb -ex -1.5 -va 140"),
        (SCENE, "-aa 1 -og -va 60"),
        (SCENE, "-aa 3 -fl triangle -ex auto -bg .2 200"),
        (&hues, "-aa 2 -fl spline -tb"),
        (&hues, "-aa 4 -iw"),
        (&hues, "-aa 2 -ex -.5"),
    ] {
        let picture = pixels(&ugrainbow(scene, options));
        for idx in (7..60 * 45).step_by(131) {
            let place = format!("{},{}", idx % 60, idx / 60);
            let told = told(scene, &format!("{options} --explain {place}"));
            let bytes: Vec<u64> =
                told["bytes"].as_array().unwrap().iter().map(|x| x.as_u64().unwrap()).collect();
            assert_eq!(bytes, picture[idx].map(u64::from), "{options:?} at {place}");
            check_parts(&told);
            if told["sample"].is_null() {
                seen[0] += 1;
            } else {
                check_sample(&told);
                seen[if told["sample"]["item"]["kind"] == "face" { 1 } else { 2 }] += 1;
            }
        }
    }
    assert!(seen[0] > 5 && seen[1] > 30 && seen[2] > 1, "background, faces, wires: {seen:?}");
}

/// As `ugdoppler -sp` writes them: what a sampled spectrum emits, and paint.
#[test]
fn spectra_that_emit_are_not_lit() {
    for (color, is_lit) in [("bands", false), ("paint", true)] {
        let scene = format!(
            "(ugstage 1 colors as-seen spectra lights)
            c_spd bands 455 0 460 2 465 0; c_rgb paint .8 .7 .6; c_xyz seen .4 .4 .2;
            v a -5 10 -5 seen; v b 5 10 -5 seen; v c 5 10 5 seen; v d -5 10 5 seen;
            f (a b c d) {color}; l 1; cam -ep 0 0 0 -vc 0 1 0 -va 30;"
        );
        let told = told(&scene, "--explain 30,22");
        assert_eq!(told["sample"]["color"]["is_lit"], is_lit, "{told}");
        let [word, other] =
            if is_lit { [", lit", "emitted"] } else { ["emitted: no lamp lights it", "lit\n"] };
        let text = text(&scene, "--explain 30,22");
        assert!(text.contains(word) && !text.contains(other), "{text}");
    }
}

fn check_parts(told: &Value) {
    let covers = told["covers"].as_array().unwrap();
    let sum: u64 = covers.iter().map(|cover| cover["samples"].as_u64().unwrap()).sum();
    let [columns, rows] = [0, 1].map(|axis| told["samples"][axis].as_u64().unwrap());
    assert_eq!(sum + told["background_samples"].as_u64().unwrap(), columns * rows);
    assert_eq!(covers.is_empty(), told["sample"].is_null());
}

/// The event is on the light cone in both frames, D is the ratio of the distances (P10), and the
/// angles are those of (P6).
fn check_sample(told: &Value) {
    let sample = &told["sample"];
    let (event, rest) = (&sample["emission"], &sample["emission_at_rest"]);
    let (x, x_rest, beta) = (point(&event["x"]), point(&rest["x"]), point(&sample["velocity"]));
    assert!((number(&event["t"]) + x.length()).abs() < 1e-12 * x.length());
    assert!((number(&rest["t"]) + x_rest.length()).abs() < 1e-12 * x_rest.length());
    let doppler = number(&sample["D"]);
    assert!((doppler - x.length() / x_rest.length()).abs() < 1e-12 * doppler);
    // The interval to the observation event is null; the ratio of the phases is the Doppler factor.
    let gamma = 1.0 / (1.0 - beta.length_squared()).sqrt();
    assert!((number(&sample["gamma"]) - gamma).abs() < 1e-12 * gamma);
    assert!((doppler * gamma * (1.0 + beta.dot(x) / x.length()) - 1.0).abs() < 1e-12);
    if beta != DVec3::ZERO {
        let [camera, at_rest] =
            ["angle_deg", "angle_at_rest_deg"].map(|name| number(&sample[name]).to_radians());
        let speed = beta.length();
        let ratio = ((1.0 - speed) / (1.0 + speed)).sqrt();
        assert!((libm::tan(at_rest / 2.0) - ratio * libm::tan(camera / 2.0)).abs() < 1e-9);
    } else {
        assert!(sample["angle_deg"].is_null());
        assert_eq!(x, x_rest);
    }
    let expected = match sample["item"]["name"].as_str() {
        Some("wall") => DVec3::new(0.5, 0.2, 0.0),
        Some("shard") => DVec3::new(0.0, 0.8, 0.1),
        _ => DVec3::ZERO,
    };
    assert_eq!(beta, expected);
    let color = &sample["color"];
    if let Some(seen) = color["seen_wavelength_nm"].as_f64() {
        assert!((number(&color["rest_wavelength_nm"]) - seen * doppler).abs() < 1e-9 * seen);
        assert!((number(&color["attenuation"]) - ugphysics::attenuation(seen)).abs() < 1e-12);
    }
    for corner in sample["corners"].as_array().unwrap() {
        let lights = corner["lights"].as_array().unwrap();
        if !lights.is_empty() {
            let sum: DVec3 = lights.iter().map(|light| point(&light["level"])).sum();
            assert!((sum - point(&corner["light_level"])).length() < 1e-12);
        }
    }
    assert_eq!(told["brightness_law"], "photon");
}

#[test]
fn people_are_told_the_same() {
    has_all(
        &text(SCENE, "--explain 7,10"),
        &[
            "face `wall`, id 1, <stdin>:7",
            "beta 0.538516",
            "law `photon`",
            "nm at rest",
            "directional 1",
        ],
    );
    let still =
        "c green 1 120; l 1; v a -1 5 -1; v b 1 5 -1; v c 0 5 1; f (a b c) green; cam -vc 0 5 0;";
    has_all(
        &text(still, "--explain 30,22"),
        &[
            "everything is at rest",
            "colours       at rest",
            "D             1 (P10)",
            "bytes         0 255 0",
        ],
    );
}

#[test]
fn bad_usage_is_told() {
    let check = |args: &str, message: &str| UGRAINBOW.refuses(args, SCENE, 2, message);
    check("-sz 20 10 --explain 20,3", "pixel 20,3 is not in the picture of 20 x 10 pixels");
    check("--explain 20", "a pixel is its column and row, such as 320,240");
    check("--explain 2,3 -dt exr", "give --format json, or leave --format out");
    check("--format json", "add --explain X,Y");
}

/// A wall behind a pane behind half a pane, and a wire.
const PANES: &str = "\
c wall .8 30; c green .9 120 1 .3; c blue .9 240 1 .6; c white 1; l 1;
v a -5 9 -4; v b 5 9 -4; v c 5 9 4; v d -5 9 4; f wall (a b c d) wall;
v e -5 7 -4; v f 5 7 -4; v g 5 7 1; v h -5 7 1; f green (e f g h) green;
v i -2 5 -3; v j 2 5 -3; v k 2 6 3; v l -2 6 3; f blue (i j k l) blue;
v m -3 6.5 0; v n 3 6.5 0; w line (m n) white;
cam -ep 0 0 0 -vc 0 5 0 -va 60 45;
";

#[test]
fn layers_blend_to_the_pixel() {
    let shown = pixels(&ugrainbow(PANES, "-aa 1"));
    let mut seen = Vec::new();
    for (x, y) in (1..60).step_by(4).flat_map(|x| (2..45).step_by(5).map(move |y| (x, y))) {
        let at = format!("{x},{y}");
        let told = told(PANES, &format!("-aa 1 --explain {at}"));
        let layers = told["sample"]["layers"].as_array().unwrap();
        let blended = layers.iter().rev().fold([0.0; 3], |behind, layer| {
            let pass = number(&layer["translucency"]);
            std::array::from_fn(|i| (1.0 - pass) * number(&layer["linear"][i]) + pass * behind[i])
        });
        for i in 0..3 {
            if !layers.is_empty() {
                let mean = number(&told["mean_linear"][i]);
                assert!((mean - blended[i]).abs() < 1e-6, "{at}: {told}");
            }
            assert_eq!(number(&told["bytes"][i]), f64::from(shown[y * 60 + x][i]));
        }
        let names = layers.iter().map(|layer| layer["item"]["name"].as_str().unwrap_or_default());
        let names: Vec<&str> = names.collect();
        // The explained surface is the first that transmits less than half of the light.
        let subject = told["sample"]["item"]["name"].as_str();
        let first = layers.iter().position(|layer| number(&layer["translucency"]) < 0.5);
        assert!(first.is_none_or(|first| subject == Some(names[first])), "{told}");
        seen.push(names.join(" "));
    }
    for all in ["blue green wall", "green wall", "blue wall", "", "blue line"] {
        assert!(seen.iter().any(|one| one == all), "{all}: {seen:?}");
    }
    has_all(
        &text(PANES, "-dc 6 10 --explain 29,30"),
        &[
            "layers        face `blue`",
            "behind it     face `green`",
            "behind it     face `wall`",
            "depth cueing  leaves ",
        ],
    );
}

#[test]
fn lights_have_their_names() {
    let check = |lights: &str, expected: &[&str]| {
        let scene = SCENE.replace("l .2; l .6 -1 -2 3 warm; l 1 2 -3 4;", lights);
        assert!(scene.contains(lights));
        let told = told(&scene, "--explain 8,22");
        let found = told["sample"]["corners"][0]["lights"].as_array().unwrap();
        let names: Vec<&str> = found.iter().map(|light| light["light"].as_str().unwrap()).collect();
        assert_eq!(names, expected);
        has_all(&text(&scene, "--explain 8,22"), &names);
    };
    check(
        "l .2; l .6 -1 -2 3 warm; l 1 2 -3 4; l lamp .1 0 0 0 0;",
        &["ambient", "directional 1", "directional 2", "lamp"],
    );
    check(
        "l .1 0 0 9 0; l sky .2; l sun .6 -1 -2 3 warm; l 1 2 -3 4;",
        &["sky", "local 1", "sun", "directional 2"],
    );
    check("l sky .2; l glow .1; l lamp 1 2 -3 4 0;", &["ambient", "lamp"]);
    check("", &["ambient", "directional 1"]);
}

/// As `ugdoppler -sp` writes them: the colour of a face is that at rest, those of its vertices are
/// as seen.
#[test]
fn assumed_reflectances_are_named() {
    for (color, word, class) in
        [("leaf", "", "foliage"), ("tin", "", ""), ("leaf", "no-doppler", "")]
    {
        let scene = format!(
            "(ugstage 1 geometry as-seen eye 0 0 0 colors as-seen spectra lights {word})
            c_rgb leaf .28 .32 .15; c_refl tin 400 .5 700 .6; c_xyz seen .4 .4 .2;
            v a -5 10 -5 seen; v b 5 10 -5 seen; v c 5 10 5 seen; v d -5 10 5 seen;
            f (a b c d) {color} <0 -.257 0>; l 1; cam -ep 0 0 0 -vc 0 1 0 -va 30;"
        );
        let (told, text) = (told(&scene, "--explain 30,22"), text(&scene, "--explain 30,22"));
        let found = told["sample"]["assumed"]["class"].as_str().unwrap_or_default();
        assert_eq!(found, class, "{text}");
        assert_eq!(text.contains("(P20)"), !class.is_empty(), "{text}");
    }
}
