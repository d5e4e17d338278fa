//! Translucent faces and depth cueing against blending by hand, laws, and rays.

use ugimage::Frame;
use ugphysics::{Hsv, srgb_encode};
use ugrainbow::{Background, ColorShift, Config, DepthCue, Note, render};
use ugtesting::Random;

use crate::common::{self, config, from_above, with};

#[track_caller]
fn draw(text: &str, config: &Config) -> Frame {
    common::draw(&format!("{text} {}", from_above()), config)
}

/// A square that fills the picture, at a height, of a pure colour.
fn pane(name: &str, z: f64, hue: f64, translucency: f64) -> String {
    format!(
        "c {name} 1 {hue} 1 {translucency};
         v {name}a -5 -5 {z}; v {name}b 5 -5 {z}; v {name}c 5 5 {z}; v {name}d -5 5 {z};
         f {name} ({name}a {name}b {name}c {name}d) {name};"
    )
}

/// Linear light as bytes.
fn bytes(light: [f64; 3]) -> [u8; 3] {
    light.map(|channel| (255.0 * srgb_encode(channel)).round() as u8)
}

#[track_caller]
fn assert_pixel(frame: &Frame, [x, y]: [u32; 2], light: [f64; 3]) {
    let [red, green, blue, _] = frame.pixel(x, y);
    for (ours, exact) in [red, green, blue].into_iter().zip(bytes(light)) {
        assert!(ours.abs_diff(exact) <= 1, "{:?} for {light:?}", [red, green, blue]);
    }
}

#[test]
fn layers_are_blended_from_behind_in_linear_light() {
    let [red, green, blue] = [("r", 0.0), ("g", 120.0), ("b", 240.0)];
    let of = |(name, hue): (&str, f64), z: f64, part: f64| pane(name, z, hue, part);
    let check = |panes: String, light: [f64; 3]| {
        let frame = draw(&format!("l 1; {panes}"), &config(2, 2));
        assert_pixel(&frame, [0, 1], light);
    };
    // Half of red, and half of it shows green.
    check(of(red, 2.0, 0.5) + &of(green, 1.0, 0.0), [0.5, 0.5, 0.0]);
    // Red lets a quarter through; of that green shows four tenths, and blue the rest.
    check(
        of(red, 2.0, 0.25) + &of(green, 1.0, 0.6) + &of(blue, 0.0, 0.0),
        [0.75, 0.25 * 0.4, 0.25 * 0.6],
    );
    // Nothing behind but the background, which is black.
    check(of(red, 2.0, 0.25) + &of(green, 1.0, 0.6), [0.75, 0.1, 0.0]);
    // What is hidden stays hidden.
    check(of(red, 2.0, 0.25) + &of(green, 1.0, 0.0) + &of(blue, 0.0, 0.5), [0.75, 0.25, 0.0]);
}

#[test]
fn what_passes_shows_the_background() {
    let panes = format!("l 1; {}{}", pane("r", 2.0, 0.0, 0.5), pane("g", 1.0, 120.0, 0.4));
    let blue = Background::Color(Hsv { hue: 240.0, saturation: 1.0, value: 1.0 });
    let frame = draw(&panes, &with(&config(2, 1), |picture| picture.background = blue));
    assert_pixel(&frame, [1, 1], [0.5, 0.5 * 0.6, 0.5 * 0.4]);
    // On nothing the covered part is what does not pass, and colour is that of this part.
    let frame =
        draw(&panes, &with(&config(2, 1), |picture| picture.background = Background::Transparent));
    assert_eq!(frame.pixel(0, 0)[3], (255.0f64 * 0.8).round() as u8);
    assert_pixel(&frame, [0, 0], [0.5 / 0.8, 0.3 / 0.8, 0.0]);
}

/// A triangle of one colour.
struct Triangle {
    corners: [[f64; 3]; 3],
    hue: f64,
    translucency: f64,
}

fn triangles(n: usize, seed: u64) -> Vec<Triangle> {
    let mut random = Random(seed);
    (0..n)
        .map(|k| Triangle {
            corners: [(); 3].map(|()| random.in_cube(4.0).to_array()),
            hue: (k % 3) as f64 * 120.0,
            translucency: [0.0, 0.3, 0.6, 0.9][k % 4],
        })
        .collect()
}

/// The statements of the triangles in this order.
fn text(triangles: &[Triangle], order: impl Iterator<Item = usize>) -> String {
    let mut text = "l 1;".to_owned();
    for k in order {
        let Triangle { corners, hue, translucency } = &triangles[k];
        text += &format!("c c{k} 1 {hue} 1 {translucency};");
        for (i, [x, y, z]) in corners.iter().enumerate() {
            text += &format!("v v{k}_{i} {x} {y} {z};");
        }
        text += &format!("f (v{k}_0 v{k}_1 v{k}_2) c{k};");
    }
    text
}

#[test]
fn the_order_of_statements_makes_no_difference() {
    let all = triangles(40, 7);
    let config = config(60, 3);
    let expected = draw(&text(&all, 0..40), &config);
    assert!(expected.pixels().iter().any(|pixel| *pixel != expected.pixel(0, 0)));
    for step in [3, 7, 11, 39] {
        // Prime to 40, so every triangle comes once.
        assert!(
            draw(&text(&all, (0..40).map(|k| k * step % 40)), &config) == expected,
            "step {step}"
        );
    }
}

#[test]
fn triangles_that_cut_each_other_are_what_rays_meet() {
    for seed in [1, 2, 3] {
        let all = triangles(24, seed);
        let side = 40;
        let frame = draw(&text(&all, 0..24), &config(side, 1));
        let mut n_compared = 0;
        for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (x, y))) {
            let at = |pixel: u32| (f64::from(pixel) + 0.5) / f64::from(side) * 8.0 - 4.0;
            if let Some(light) = ray(&all, [at(x), -at(y)]) {
                assert_pixel(&frame, [x, y], light);
                n_compared += 1;
            }
        }
        assert!(n_compared > 1000, "{n_compared}");
    }
}

/// The light along the view at a point; `None` near an edge, or where two triangles have nearly the
/// same depth.
fn ray(triangles: &[Triangle], [x, y]: [f64; 2]) -> Option<[f64; 3]> {
    const CLOSE: f64 = 1e-4;
    let mut met = Vec::new();
    for triangle in triangles {
        let [a, b, c] = triangle.corners;
        let area = |p: [f64; 3], q: [f64; 3]| (p[0] - x) * (q[1] - y) - (p[1] - y) * (q[0] - x);
        let parts = [area(b, c), area(c, a), area(a, b)];
        let sum: f64 = parts.iter().sum();
        let weights = parts.map(|part| part / sum);
        let least = weights.into_iter().fold(f64::INFINITY, f64::min);
        if least.abs() < CLOSE {
            return None;
        }
        if least > 0.0 {
            met.push((weights[0] * a[2] + weights[1] * b[2] + weights[2] * c[2], triangle));
        }
    }
    met.sort_by(|one, other| one.0.total_cmp(&other.0));
    if met.windows(2).any(|pair| pair[1].0 - pair[0].0 < CLOSE) {
        return None;
    }
    Some(met.into_iter().fold([0.0; 3], |behind, (_, triangle)| {
        let own = Hsv { hue: triangle.hue, saturation: 1.0, value: 1.0 }.to_rgb();
        let pass = triangle.translucency;
        std::array::from_fn(|i| (1.0 - pass) * own[i] + pass * behind[i])
    }))
}

#[test]
fn all_clear_is_not_there_and_none_clear_is_opaque() {
    let all = triangles(30, 5);
    let config = config(50, 4);
    let with = |translucency: f64| {
        let changed =
            |k: usize| if k.is_multiple_of(2) { translucency } else { all[k].translucency };
        let all: Vec<Triangle> = all
            .iter()
            .enumerate()
            .map(|(k, &Triangle { corners, hue, .. })| Triangle {
                corners,
                hue,
                translucency: changed(k),
            })
            .collect();
        draw(&text(&all, 0..30), &config)
    };
    assert!(with(1.0) == draw(&text(&all, (1..30).step_by(2)), &config));
    let opaque = text(&all, 0..30);
    let opaque = (0..30).step_by(2).fold(opaque, |text, k| {
        let Triangle { hue, translucency, .. } = all[k];
        text.replace(&format!("c c{k} 1 {hue} 1 {translucency};"), &format!("c c{k} 1 {hue};"))
    });
    assert!(with(0.0) == draw(&opaque, &config));
    assert!(with(0.0) != with(1.0));
}

/// A pane between two posts shares their corners; they stay opaque, and it is as clear everywhere.
#[test]
fn a_face_of_its_own_colour_is_as_clear_everywhere() {
    let text = "l 1; c glass 1 0 1 .5; c post 1 120;
                v a -4 -4 0; v b -2 -4 0; v c 2 -4 0; v d 4 -4 0; v e -4 4 0; v f -2 4 0; v g 2 4 0; v h 4 4 0;
                f (a b f e) post; f (b c g f) glass; f (c d h g) post;";
    let frame =
        draw(text, &with(&config(8, 1), |picture| picture.background = Background::Transparent));
    let alpha = |x: u32| frame.pixel(x, 4)[3];
    assert_eq!([0, 1, 2, 3, 4, 5, 6, 7].map(alpha), [255, 255, 128, 128, 128, 128, 255, 255]);
    // Without a colour of its own the face has those of its corners, here transparent at the left
    // and opaque at the right.
    let text = "l 1; c clear 1 0 1 1; c red 1 0;
                v a -4 -4 0 clear; v b 4 -4 0 red; v c 4 4 0 red; v d -4 4 0 clear; f (a b c d);";
    let frame =
        draw(text, &with(&config(8, 1), |picture| picture.background = Background::Transparent));
    for x in 0..8 {
        let expected = 255.0 * (f64::from(x) + 0.5) / 8.0;
        assert!((f64::from(frame.pixel(x, 3)[3]) - expected).abs() <= 1.0, "column {x}");
    }
}

/// At rest both modes see the same planes; they differ only in which face a sample on an outline
/// belongs to.
#[test]
fn exact_pictures_blend_as_well() {
    let all = triangles(24, 9);
    let text =
        text(&all, 0..24).replace("cam ", "") + "cam -ep 0 0 14 -vc 0 0 0 -ud 0 1 0 -va 40 40;";
    let scene = common::scene(&text);
    let scanned = config(60, 2);
    let exact = Config { exact: Some(ColorShift::default()), ..scanned.clone() };
    let [one, other] =
        [scanned, exact].map(|config| render(&scene, &config).unwrap().into_frame().unwrap());
    let differs = |(a, b): (&[u8; 4], &[u8; 4])| (0..4).any(|i| a[i].abs_diff(b[i]) > 1);
    let pairs = one.pixels().iter().zip(other.pixels());
    let n_different = pairs.filter(|&pair| differs(pair)).count();
    assert!(n_different < 8, "{n_different} of 3600 pixels");
    assert!(one.pixels().iter().filter(|pixel| **pixel != [0, 0, 0, 255]).count() > 1000);
}

#[test]
fn light_falls_with_depth_towards_the_background() {
    // From depth 12 at the left to 8 at the right.
    let text = "l 1; c red 1 0; v a -4 -4 -2; v b 4 -4 2; v c 4 4 2; v d -4 4 -2; f (a b c d) red;";
    let blue = Background::Color(Hsv { hue: 240.0, saturation: 1.0, value: 1.0 });
    let cued = |range, least| Config {
        depth_cue: Some(DepthCue { range, least }),
        ..with(&config(8, 1), |picture| picture.background = blue)
    };
    let depth = |x: u32| 12.0 - 4.0 * (f64::from(x) + 0.5) / 8.0;
    let frame = draw(text, &cued(Some([9.0, 11.0]), 0.1));
    for x in 0..8 {
        let part = 1.0 - 0.9 * ((depth(x) - 9.0) / 2.0).clamp(0.0, 1.0);
        assert_pixel(&frame, [x, 5], [part, 0.0, 1.0 - part]);
    }
    // From the nearest to the farthest that is seen.
    let frame = draw(text, &cued(None, 0.0));
    for x in 0..8 {
        let part = 1.0 - (depth(x) - depth(7)) / (depth(0) - depth(7));
        assert_pixel(&frame, [x, 2], [part, 0.0, 1.0 - part]);
    }
}

/// Depths beyond single precision are all alike: nothing fades, and no note names them.
#[test]
fn infinite_depths_do_not_fade() {
    let text = "l 1; c red 1 0; v a -4e155 -4e155 -2; v b 4e155 -4e155 2; v c 4e155 4e155 2; f (a b c) red;
                cam -ep 0 0 1e155 -vc 0 0 0 -ud 0 1 0 -va 40 40;";
    let cue = DepthCue { range: None, least: 0.2 };
    let rendering =
        render(&common::scene(text), &Config { depth_cue: Some(cue), ..config(8, 1) }).unwrap();
    assert!(
        !rendering.notes.iter().any(|note| matches!(note, Note::DepthCue { .. })),
        "{:?}",
        rendering.notes
    );
    assert_pixel(&rendering.into_frame().unwrap(), [6, 6], [1.0, 0.0, 0.0]);
}

/// Each layer fades by its own depth, and what passes is not faded again.
#[test]
fn layers_fade_each_by_its_own_depth() {
    let panes = format!("l 1; {}{}", pane("r", 2.0, 0.0, 0.5), pane("g", 0.0, 120.0, 0.0));
    let cue = DepthCue { range: Some([6.0, 10.0]), least: 0.2 };
    let frame = draw(&panes, &Config { depth_cue: Some(cue), ..config(2, 1) });
    // Red at depth 8 keeps 0.6, and green at depth 10 keeps 0.2.
    assert_pixel(&frame, [0, 0], [0.5 * 0.6, 0.5 * 0.2, 0.0]);
}
