//! Colours of vertices, faces and pixels, against closed forms and published numbers.

use ugphysics::{Hsv, attenuation, hue_to_wavelength, srgb_decode, srgb_encode, wavelength_to_hue};
use ugrainbow::{Background, Config, HueScale, Interpolation};

use crate::common::{SQUARE, draw, with};
use crate::render::{assert_near, level, map};

#[test]
fn a_fully_lit_colour_is_its_8_bit_self() {
    let (camera, config) = map(2, 2);
    for red in (0..=255).step_by(15) {
        for green in (0..=255).step_by(17) {
            for blue in [0, 1, 100, 254] {
                let [r, g, b] = [red, green, blue].map(|level| f64::from(level) / 255.0);
                let text = format!("c_rgb k {r} {g} {b}; l 1; {SQUARE} f (a b c d) k; {camera}");
                assert_eq!(draw(&text, &config).pixel(1, 0), [red, green, blue, 255]);
            }
        }
    }
}

/// The colour at part `part` of the way from a to b on an upright band.
fn band(colors: &str, a: &str, b: &str, config: &Config, part: f64) -> [u8; 4] {
    lit_band(1.0, colors, [a, b], config, part)
}

/// The same under ambient light of a level.
fn lit_band(level: f64, colors: &str, [a, b]: [&str; 2], config: &Config, part: f64) -> [u8; 4] {
    let (camera, _) = map(1, 1);
    // Rays are drawn in perspective, which is the same at the centre.
    let camera = if config.exact.is_some() { camera.replace(" -og", "") } else { camera };
    let text = format!(
        "{colors} l {level}; v a -4 -4 0 {a}; v b 4 -4 0 {b}; v c 4 4 0 {b}; v d -4 4 0 {a}; f (a b c d); {camera}"
    );
    let frame = draw(&text, config);
    frame.pixel((part * f64::from(frame.width())) as u32, frame.height() / 2)
}

/// Half way between two colours, one of them written as `c_rgb`, the linear light is the mean of
/// theirs. The level of a lamp multiplies the encoded values, as it does for hues.
#[test]
fn red_green_and_blue_mix_as_light() {
    let (_, config) = map(101, 5);
    let exact = Config { exact: Some(uglight::ColorShift::NONE), ..config.clone() };
    let half = srgb_encode(0.5);
    for (colors, expected) in [
        ("c_rgb r 1 0 0; c_rgb b 0 0 1;", [half, 0.0, half]),
        ("c_rgb r 1 0 0; c b 1 240;", [half, 0.0, half]),
        ("c r 1 0; c_rgb b 0 0 1;", [half, 0.0, half]),
        ("c_rgb r 1 1 0; c_rgb b 0 0 1;", [half; 3]),
        ("c r 1 0; c b 1 240;", [0.0, 1.0, 0.0]),
    ] {
        // Corners are lit by scanlines, every point by rays.
        let lit_corners =
            if expected.contains(&half) { srgb_encode(0.5 * srgb_decode(0.5)) / half } else { 0.5 };
        for (config, level) in [(&config, lit_corners), (&exact, 0.5)] {
            assert_near(band(colors, "r", "b", config, 0.5), expected);
            let dim = lit_band(0.5, colors, ["r", "b"], config, 0.5);
            assert_near(dim, expected.map(|channel| level * channel));
        }
    }
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
    assert_near(
        band("c u 1 300; c i 1 900;", "u", "i", &files, 0.5),
        pure(wavelength_to_hue(600.0)),
    );
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
    let text =
        |color: &str| format!("c g 1 120; c r 1 0; l 1; {SQUARE} f (a b c d) {color}; {camera}");
    assert_eq!(draw(&text("g"), &config).pixel(1, 1), [0, 255, 0, 255]);
    assert_eq!(draw(&text(""), &config).pixel(1, 1), [255; 4]);
    let own = text("g").replace("4 0;", "4 0 r;");
    assert_eq!(draw(&own, &config).pixel(1, 1), [255, 0, 0, 255]);
}

#[test]
fn pixels_are_averaged_in_linear_light() {
    // White over the left half of every pixel of a column: half the light is level 188.
    let (camera, config) = map(8, 8);
    let text =
        format!("l 1; v a -4 -4 0; v b .5 -4 0; v c .5 4 0; v d -4 4 0; f (a b c d); {camera}");
    for (samples, expected) in [(2, 188), (4, 188), (16, 188)] {
        let frame = draw(&text, &with(&config, |picture| picture.samples = samples));
        assert_eq!(frame.pixel(3, 3)[0], 255);
        assert_eq!(frame.pixel(4, 3)[0], expected);
        assert_eq!(frame.pixel(5, 3)[0], 0);
    }
    // Over a background that is not black: (1 + decode(0.5)) / 2.
    let background = Background::Color(Hsv { hue: 0.0, saturation: 0.0, value: 0.5 });
    let frame = draw(
        &text,
        &with(&config, |picture| (picture.samples, picture.background) = (4, background)),
    );
    let mean = srgb_encode(0.5 + 0.5 * srgb_decode(0.5));
    assert_eq!(frame.pixel(4, 3)[0], level(mean));
    assert_eq!(frame.pixel(7, 3)[0], 128);
    // Transparent: the colour of what is there, and how much of it.
    let frame = draw(
        &text,
        &with(&config, |picture| {
            (picture.samples, picture.background) = (4, Background::Transparent)
        }),
    );
    assert!(!frame.is_opaque());
    assert_eq!(frame.pixel(3, 3), [255; 4]);
    assert_eq!(frame.pixel(4, 3), [255, 255, 255, 128]);
    assert_eq!(frame.pixel(5, 3), [0; 4]);
}
