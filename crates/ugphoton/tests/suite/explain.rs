//! `--explain`: its bytes are those of the picture, and its numbers satisfy the equations.

use glam::DVec3;
use serde_json::Value;

use crate::cli::UGPHOTON;

/// A moving mirror, moving glass, a translucent pane, a coloured wall, and shadows.
const SCENE: &str = "\
c red 0.9 10 0.8; c green 0.8 120 0.7; c white 1; c pane 0.9 200 0.3 0.6; c tint 0.9 60 0.2;
surf mirror 0.2 0.7 0; surf glass 0 0.1 0.8 1.5;
v a -4 9 -3; v b 4 9 -3; v c 4 9 4; v d -4 9 4; f wall (a b c d) green;
v e -3 7 -2; v f -1 7 -2; v g -1 7 2; v h -3 7 2; f mirror (e f g h) white mirror <0 0.3 0.1>;
v i -5 -2 -4; v j -5 -2 4; v k 5 -2 4; v l 5 -2 -4; f back (i j k l) red;
v m 1 5 -1; v n 2.5 5 -1; v o 2.5 5 1; v p 1 5 1; v q 1 6 -1; v r 2.5 6 -1; v s 2.5 6 1; v t 1 6 1;
f near (m n o p) tint glass <0.4 0 0>; f far (q t s r) tint glass <0.4 0 0>;
f left (m p t q) tint glass <0.4 0 0>; f right (n r s o) tint glass <0.4 0 0>;
f low (m q r n) tint glass <0.4 0 0>; f high (p o s t) tint glass <0.4 0 0>;
v u -1 4 -3; v w 1.5 4 -3; v x 1.5 4 1; f pane (u w x) pane <0 0 0.5>;
l 0.3; l 0.6 0.5 -2 1; l 0.5 -2 3 4;
cam -ep 0 0 0 -vc 0 6 0 -va 60;
";

fn written(args: &str) -> Vec<u8> {
    UGPHOTON.output(&format!("-qt {args}"), SCENE)
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
    let mut seen = [0; 5];
    for options in [
        "-aa 3",
        "-aa 2 -ex auto -tc filmic -bg .2 200",
        "-aa 4 -ad .05 -tb",
        "-aa 2 -fl spline -stereo .3 -cv 0 .3 0",
        "-aa 2 -sp -pan",
        "-aa 2 --fresnel -rd 4 --film-shutter 2",
    ] {
        let options = &format!("-sz 30 22 {options}");
        let picture = pixels(&written(options));
        for idx in (7..30 * 22).step_by(61) {
            let place = format!("{},{}", idx % 30, idx / 30);
            let told = written(&format!("{options} --explain {place} --format json"));
            let told: Value = serde_json::from_slice(&told).unwrap();
            let bytes: Vec<u64> =
                told["bytes"].as_array().unwrap().iter().map(|x| x.as_u64().unwrap()).collect();
            assert_eq!(bytes, picture[idx].map(u64::from), "{options:?} at {place}");
            let is_film = options.contains("--film-shutter");
            let sample = &told["sample"];
            if sample.is_null() {
                seen[0] += 1;
                continue;
            }
            check_light(sample, options.contains("-sp"));
            for surface in sample["surfaces"].as_array().unwrap() {
                let by = surface["by"].as_u64().map(|by| &sample["surfaces"][by as usize]);
                check_surface(surface, by, is_film || options.contains("-stereo"));
                let kind = match (surface["way"].as_str().unwrap(), surface["medium"].is_null()) {
                    ("straight", _) => 1,
                    ("mirrored", _) => 2,
                    (_, true) => 3,
                    (_, false) => 4,
                };
                seen[kind] += 1;
            }
        }
    }
    assert!(
        seen.iter().all(|&count| count > 4),
        "background, seen, mirrored, behind and in glass: {seen:?}"
    );
}

/// The light of a sample is the sum over its surfaces.
fn check_light(sample: &Value, is_spectral: bool) {
    let surfaces = sample["surfaces"].as_array().unwrap();
    let sum: DVec3 =
        surfaces.iter().map(|surface| number(&surface["weight"]) * point(&surface["linear"])).sum();
    let light = point(&sample["linear"]);
    // Rounding; spectra are stored in single precision.
    let rounding = if is_spectral { 1e-6 } else { 1e-12 };
    assert!((sum - light).length() <= rounding * (1.0 + light.length()), "{sum} {light}");
    let tint = |lamp: &Value| point(&lamp["level"]) * number(&lamp["part"]);
    for surface in surfaces.iter().filter(|surface| !surface["color"]["light_level"].is_null()) {
        let sum: DVec3 = surface["lamps"].as_array().unwrap().iter().map(tint).sum();
        assert!((sum - point(&surface["color"]["light_level"])).length() < 1e-12, "{surface}");
    }
}

/// Events are joined by light: with the speed of light in vacuum, with c/n in the rest frame of
/// glass. `by`: the surface that mirrored or refracted the light. `is_elsewhere`: the light arrived
/// at another event than the origin.
fn check_surface(surface: &Value, by: Option<&Value>, is_elsewhere: bool) {
    let event =
        |surface: &Value| (number(&surface["emission"]["t"]), point(&surface["emission"]["x"]));
    let (t, x) = event(surface);
    let (to_t, to_x) = by.map_or((0.0, DVec3::ZERO), event);
    let (dt, dx) = (to_t - t, to_x - x);
    let interval = |dt: f64, dx: DVec3| (dt * dt, dx.length_squared());
    if let Some(medium) = surface["medium"].as_object() {
        let (velocity, index) = (point(&medium["velocity"]), number(&medium["index"]));
        let gamma = 1.0 / (1.0 - velocity.length_squared()).sqrt();
        let along = velocity.dot(dx);
        let there = gamma * (dt - along);
        let length = (dx.length_squared() - dt * dt + there * there).sqrt();
        assert!((there - index * length).abs() < 1e-9 * there, "{surface}");
    } else if !(is_elsewhere && by.is_none()) {
        let (time, length) = interval(dt, dx);
        assert!((time - length).abs() < 1e-9 * time, "{surface}");
    }
    let beta = point(&surface["velocity"]);
    let gamma = number(&surface["gamma"]);
    assert!((gamma * gamma * (1.0 - beta.length_squared()) - 1.0).abs() < 1e-12);
    let doppler = number(&surface["D"]);
    if by.is_none() {
        // (P10), and the same as angles of (P6).
        if !is_elsewhere {
            assert!((doppler * gamma * (1.0 + beta.dot(x) / x.length()) - 1.0).abs() < 1e-12);
        }
        if let (Some(camera), Some(rest)) =
            (surface["angle_deg"].as_f64(), surface["angle_at_rest_deg"].as_f64())
        {
            let ratio = ((1.0 - beta.length()) / (1.0 + beta.length())).sqrt();
            let [camera, rest] = [camera, rest].map(|angle| libm::tan(angle.to_radians() / 2.0));
            assert!((rest - ratio * camera).abs() < 1e-9 * camera);
        }
    }
    let color = &surface["color"];
    if let (Some(rest), Some(seen)) =
        (color["rest_wavelength_nm"].as_f64(), color["seen_wavelength_nm"].as_f64())
    {
        assert!((rest - seen * doppler).abs() < 1e-9 * rest);
    }
}

#[test]
fn people_are_told_the_same() {
    let told =
        |place: &str| String::from_utf8(written(&format!("-sz 60 44 --explain {place}"))).unwrap();
    let mirror = told("18,22");
    for part in [
        "surface 1, seen directly",
        "face `mirror`, id 2",
        "velocity 0 0.3 0.1, beta 0.316228",
        "mirrors       0.7 of the light",
        "surface 2, mirrored by surface 1",
        "face `back`, id 3",
        "along the whole path, P23",
        "directional 1: level ",
        "own light     ",
    ] {
        assert!(mirror.contains(part), "{part}:\n{mirror}");
    }
    let glass = told("29,22");
    for part in [
        "transmits     0.8 of the light",
        "in `glass`, index 1.5, velocity 0.4 0 0 (P35)",
        "face `wall`",
    ] {
        assert!(glass.contains(part), "{part}:\n{glass}");
    }
    assert!(told("0,30").contains("in shadow (P24)"));
}

#[test]
fn bad_usage_is_told() {
    let check = |args: &str, message: &str| {
        UGPHOTON.refuses(&format!("-sz 60 44 {args}"), SCENE, 2, message);
    };
    check("--explain 60,3", "pixel 60,3 is not in the picture of 60 x 44 pixels");
    check("--explain 20", "a pixel is its column and row, such as 320,240");
    check("--explain 2,3 -dt exr", "give --format json, or leave --format out");
    check("--explain 2,3 -crop 0 0 9 9", "-crop");
    check("--format json", "add --explain X,Y");
}

/// The automatic exposure of a large picture is estimated from some pixels, as the text says, and
/// that of a small one is exact.
#[test]
fn exposures_are_estimated_from_few_pixels() {
    let told = |options: &str| {
        let text = written(&format!("{options} --explain 20,15 --format json"));
        let told: Value = serde_json::from_slice(&text).unwrap();
        let steps = &told["development"];
        (number(&steps["stops"]), steps["estimated_from"].as_u64())
    };
    let options = "-aa 1 -ex auto -tc filmic -sz 320 240";
    let (estimate, n_pixels) = told(options);
    assert!(n_pixels.is_some_and(|count| (2000..=4096).contains(&count)), "{n_pixels:?}");
    let exact = UGPHOTON.notes(options, SCENE);
    let (_, exact) = exact.split_once("exposure is ").unwrap();
    let exact: f64 = exact.split_once(" stops").unwrap().0.parse().unwrap();
    assert!((estimate - exact).abs() < 0.1, "{estimate}, {exact}");
    assert_eq!(told("-aa 1 -ex auto -tc filmic -sz 60 45").1, None);
    assert_eq!(told("-aa 1 -ex .5 -tc filmic -sz 320 240"), (0.5, None));
}

/// Where only a colour is known, a shifted pixel depends on the reflectance assumed for it; a
/// measured reflectance, a black body and a surface at rest assume nothing.
#[test]
fn assumed_reflectances_are_named() {
    let told = |color: &str, args: &str| {
        let scene = format!(
            "c_rgb grey .5 .5 .5; c_rgb leaf .28 .32 .15; c_rgb red .8 .1 .1;
            c_refl tin 400 .5 700 .6; c_bb hot 3000; c_rgb own .2 .3 .4;
            v a -5 9 -5; v b 5 9 -5; v c 5 9 5; v d -5 9 5;
            v e -5 9 -5 own; v f 5 9 -5 own; v g 5 9 5 own; v h -5 9 5 own;
            f {color}; l 1; cam -ep 0 0 0 -vc 0 1 0 -va 30;"
        );
        let args = format!("-qt -sz 20 20 -aa 1 --explain 10,10 {args}");
        let json = UGPHOTON.output(&format!("{args} --format json"), &scene);
        let text = String::from_utf8(UGPHOTON.output(&args, &scene)).unwrap();
        let json: Value = serde_json::from_slice(&json).unwrap();
        (json["sample"]["surfaces"][0]["assumed"].clone(), text)
    };
    // Towards the eye with D = 1.3, about.
    let fast = "-vel 0 -.257 0 -in";
    let mut highest = [0.0; 3];
    let classes =
        [("(a b c d) grey", "grey"), ("(a b c d) leaf", "foliage"), ("(a b c d) red", "saturated")];
    for ((color, class), highest) in classes.into_iter().zip(&mut highest) {
        let (assumed, text) = told(color, fast);
        assert_eq!(assumed["class"], class, "{text}");
        let [low, high] = [0, 1].map(|end| number(&assumed["delta_e"][end]));
        let line = format!(
            "assumed       reflectance of surfaces of {class} colour (P20): 8 of 10 measured ones \
             are off by dE*ab {low:.1} to {high:.1} at this D"
        );
        assert!(text.contains(&line) && low > 0.5, "{line}:\n{text}");
        *highest = high;
    }
    assert!(highest[0] < highest[2] && highest[2] < highest[1], "{highest:?}");
    // Colours of vertices may be of any class; beyond infrared and ultraviolet nothing was
    // measured.
    let (assumed, text) = told("(e f g h)", fast);
    assert!(assumed["class"].is_null() && number(&assumed["delta_e"][1]) == highest[1], "{text}");
    assert!(text.contains("surfaces of any colour (P20)"), "{text}");
    let (assumed, text) = told("(a b c d) red", "-vel 0 .3 0 -in");
    assert!(assumed["delta_e"].is_null() && text.contains("none were measured"), "{text}");
    for (color, args) in [
        ("(a b c d) tin", fast),
        ("(a b c d) hot", fast),
        ("(a b c d) red", ""),
        ("(a b c d) red", "-vel 0 -.257 0 -in -look 1988"),
    ] {
        let (assumed, text) = told(color, args);
        assert!(assumed.is_null() && !text.contains("assumed"), "{color} {args}:\n{text}");
    }
}
