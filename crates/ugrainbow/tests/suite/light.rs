//! Colours given as light, brighter than white, and their development for a display.

use ugimage::{Development, Format, Quantizer};
use ugparse::Source;
use ugphysics::{Hsv, linear_srgb_to_xyz, luminance, srgb_decode, srgb_encode};
use ugpipe::Words;
use ugrainbow::{Background, Channel, Config, Exposure, Output, Tone, render, run};

use crate::common::{SQUARE, from_above, light, with};

fn map(width: u32, height: u32, samples: u32) -> (String, Config) {
    let size = [width, height];
    let config =
        with(&Config::default(), |picture| (picture.size, picture.samples) = (size, samples));
    (from_above(), config)
}

#[track_caller]
fn display(text: &str, config: &Config) -> (Vec<[u8; 4]>, Vec<String>) {
    let source = Source::new("test.ug", text);
    let scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
    let rendering = render(&scene, config).unwrap();
    let notes = rendering.notes.iter().map(Words::words).collect();
    (rendering.into_frame().unwrap().pixels().to_vec(), notes)
}

#[track_caller]
fn assert_near(light: [f32; 3], expected: [f64; 3]) {
    for (ours, exact) in light.iter().zip(expected) {
        // Single precision.
        assert!(
            (f64::from(*ours) - exact).abs() < 3e-7 * exact.abs().max(1.0),
            "{light:?} for {expected:?}"
        );
    }
}

/// The published white of IEC 61966-2-1 is 1 1 1 to its four digits.
#[test]
fn white_is_one() {
    let (camera, config) = map(2, 2, 2);
    let text = format!("c_xyz k .9505 1 1.0890; l 1; {SQUARE} f (a b c d) k; {camera}");
    for pixel in light(&text, &config) {
        assert!(pixel.iter().all(|channel| (channel - 1.0).abs() < 2e-4), "{pixel:?}");
    }
    assert_eq!(display(&text, &config).0, [[255; 4]; 4]);
}

#[test]
fn light_is_interpolated_in_xyz_and_lit() {
    let (camera, config) = map(16, 1, 1);
    // From a bright colour to one outside the gamut.
    let (from, to) = ([9.0, 5.0, 0.5], [0.1, 0.9, 0.1]);
    let colors = "c_xyz p 9 5 .5; c_xyz q .1 .9 .1;";
    let corners = "v a -4 -4 0 p; v b 4 -4 0 q; v c 4 4 0 q; v d -4 4 0 p; f (a b c d);";
    for (lights, level) in [("l 1;", [1.0; 3]), ("l .25; l .5 0 0 1;", [0.75; 3])] {
        let pixels = light(&format!("{colors} {lights} {corners} {camera}"), &config);
        for (idx, pixel) in pixels.iter().enumerate() {
            let part = (idx as f64 + 0.5) / 16.0;
            let xyz = linear_srgb_to_xyz(pixel.map(f64::from));
            for i in 0..3 {
                let expected = level[i] * (from[i] + part * (to[i] - from[i]));
                assert!((xyz[i] - expected).abs() < 1e-5, "{idx}: {xyz:?}");
            }
        }
        assert!(
            pixels[15][0] < 0.0,
            "a colour outside the gamut has negative parts: {:?}",
            pixels[15]
        );
    }
    // A coloured light, itself of the scale of displays: half red is srgb_decode(0.5) of it.
    let text = format!(
        "c_xyz w .950469 1 1.088822; c_rgb r 1 .5 0; l 2 r; {SQUARE} f (a b c d) w; {camera}"
    );
    for pixel in light(&text, &config) {
        for (ours, exact) in pixel.iter().zip([2.0, 2.0 * srgb_decode(0.5), 0.0]) {
            // White is given to six digits.
            assert!((f64::from(*ours) - exact).abs() < 1e-4, "{pixel:?}");
        }
    }
}

/// In one scene, and in one face, where hues are converted to light at their corners.
#[test]
fn hues_and_light_stand_side_by_side() {
    let (camera, config) = map(16, 1, 1);
    let colors = "c red .8 20 .9; c_xyz hot 20 10 1;";
    let halves = "v a -4 -4 0; v b 0 -4 0; v c 4 -4 0; v d 4 4 0; v e 0 4 0; v f -4 4 0;
                  f (a b e f) red;";
    let alone = light(&format!("{colors} l .7; {halves} {camera}"), &config);
    let both = light(
        &format!("{colors} l .7; {halves} v b2 0 -4 0; v e2 0 4 0; f (b2 c d e2) hot; {camera}"),
        &config,
    );
    assert_eq!(both[..8], alone[..8], "a hue is not changed by its neighbour");
    let red = Hsv { hue: 20.0, saturation: 0.9, value: 0.7 * 0.8 };
    both[..8].iter().for_each(|pixel| {
        // Between the points of the table of the transfer function.
        let exact = red.to_rgb().map(srgb_decode);
        assert!(
            pixel.iter().zip(exact).all(|(ours, exact)| (f64::from(*ours) - exact).abs() < 1e-6)
        );
    });
    let hot = ugphysics::xyz_to_linear_srgb([20.0, 10.0, 1.0]).map(|channel| 0.7 * channel);
    both[8..].iter().for_each(|pixel| assert_near(*pixel, hot));

    let corners = "v a -4 -4 0 red; v b 4 -4 0 hot; v c 4 4 0 hot; v d -4 4 0 red; f (a b c d);";
    let mixed = light(&format!("{colors} l .7; {corners} {camera}"), &config);
    let red = Hsv { hue: 20.0, saturation: 0.9, value: 0.8 }
        .to_rgb()
        .map(|channel| 0.7 * srgb_decode(channel));
    for (idx, pixel) in mixed.iter().enumerate() {
        let part = (idx as f64 + 0.5) / 16.0;
        let expected: [f64; 3] = std::array::from_fn(|i| red[i] + part * (hot[i] - red[i]));
        assert!(
            pixel.iter().zip(expected).all(|(a, b)| (f64::from(*a) - b).abs() < 1e-5),
            "{pixel:?}"
        );
    }
    // Wires, too.
    let wire =
        light(&format!("{colors} l .7; {SQUARE} w (a b) hot; w (c d) red; {camera}"), &config);
    assert_eq!(wire.len(), 16);
}

/// Half a pixel of light 8 is light 4, not the mean of display levels.
#[test]
fn pixels_are_means_of_light_and_developed_after() {
    let (camera, config) = map(16, 1, 8);
    // The edge runs through the middle of pixel 8.
    let text = format!(
        "c_xyz k 7.603755 8 8.710577; l 1; v a -4 -4 0; v b .25 -4 0; v c .25 4 0; v d -4 4 0; f (a b c d) k; {camera}"
    );
    let pixels = light(&text, &config);
    for (idx, expected) in [(7, 8.0), (8, 4.0), (9, 0.0)] {
        assert!(
            pixels[idx].iter().all(|channel| (channel - expected).abs() < 1e-4),
            "{:?}",
            pixels[idx]
        );
    }
    let at = |stops| {
        display(&text, &with(&config, |picture| picture.exposure = Some(Exposure::Stops(stops)))).0
    };
    assert_eq!([7, 8, 9].map(|idx| at(0.0)[idx]), [[255; 4], [255; 4], [0, 0, 0, 255]]);
    let half = (255.0 * srgb_encode(0.5)).round() as u8;
    assert_eq!(
        [7, 8, 9].map(|idx| at(-3.0)[idx]),
        [[255; 4], [half, half, half, 255], [0, 0, 0, 255]]
    );
}

const GLARE: &str = "c_xyz hot 9 4 1; c_xyz green .2 3 .1; c blue 1.7 220 .8; c dim .3 40; l 1;
    v a -4 -4 0 hot; v b 1 -4 0 green; v c 1 4 0 dim; v d -4 4 0 blue; f (a b c d);
    v e 0.3 -3 1; v g 3.7 -2 1; v h 2 3.1 1; f (e g h) blue; w (a h g) hot;";

/// The 8-bit picture is the light of the PFM file after development, to the byte; with and without
/// bright hues.
#[test]
fn a_picture_is_its_light_developed() {
    let (camera, mut config) = map(40, 30, 3);
    let hues =
        GLARE.replace("c_xyz hot 9 4 1; c_xyz green .2 3 .1;", "c hot 5 10; c green 3 110 .7;");
    for text in [format!("{GLARE} {camera}"), format!("{hues} {camera}")] {
        let light = light(&text, &config);
        assert!(light.iter().flatten().any(|channel| *channel > 2.0));
        for tone in Tone::ALL {
            for stops in [-4.0, -1.5, 0.0, 2.25] {
                (config.picture.exposure, config.picture.tone) =
                    (Some(Exposure::Stops(stops)), tone);
                let quantizer = Quantizer::new();
                let shown = |light: &[f32; 3]| {
                    let [r, g, b] = Development { stops, tone }
                        .apply(*light)
                        .map(|light| quantizer.level(light));
                    [r, g, b, 255]
                };
                let expected: Vec<[u8; 4]> = light.iter().map(shown).collect();
                assert_eq!(display(&text, &config).0, expected, "{stops} {tone:?}");
            }
        }
        (config.picture.exposure, config.picture.tone) = (None, Tone::Clip);
    }
}

/// `-ex auto` says its stops, and these give the same bytes.
#[test]
fn automatic_exposure_can_be_repeated() {
    let (camera, config) = map(40, 30, 2);
    let text = format!("{GLARE} {camera}");
    let (auto, notes) =
        display(&text, &with(&config, |picture| picture.exposure = Some(Exposure::Auto)));
    let note = notes.iter().find(|note| note.starts_with("exposure is")).unwrap();
    let stops: f64 = note.split(' ').nth(2).unwrap().parse().unwrap();
    assert!(stops < -1.0, "{note}");
    let again =
        display(&text, &with(&config, |picture| picture.exposure = Some(Exposure::Stops(stops))));
    assert_eq!(again.0, auto);
    let light = light(&text, &config);
    let covered: Vec<f64> = light
        .iter()
        .map(|rgb| luminance(rgb.map(f64::from)))
        .filter(|light| *light > 0.0)
        .collect();
    let white = covered.iter().filter(|light| **light * libm::exp2(stops) >= 1.01).count();
    assert!(white * 100 <= covered.len(), "{white} of {}", covered.len());
}

/// Without -ex values of hues are clipped sample by sample, as in 1988, and a message says so.
#[test]
fn bright_hues_are_clipped_unless_an_exposure_is_given() {
    let (camera, config) = map(2, 2, 1);
    let text = format!("c k 2 120 .5; l 1; {SQUARE} f (a b c d) k; {camera}");
    let (pixels, notes) = display(&text, &config);
    assert_eq!(pixels, [[128, 255, 128, 255]; 4]);
    assert_eq!(notes, ["max intensity is 2.0, clip to 1.0"]);
    // Twice the value is brighter than white by the transfer function: a little under five times.
    let stops = -libm::log2(srgb_decode(2.0));
    let (pixels, notes) =
        display(&text, &with(&config, |picture| picture.exposure = Some(Exposure::Stops(stops))));
    let red = (255.0 * srgb_encode(srgb_decode(1.0) / srgb_decode(2.0))).round() as u8;
    assert_eq!(pixels, [[red, 255, red, 255]; 4]);
    assert!(notes.is_empty());
    let text = text.replace("c k 2 120 .5", "c_xyz k 4 4 4");
    let (_, notes) = display(&text, &config);
    assert_eq!(notes, ["max intensity is 4.819, clip to 1.0; -ex auto brings it into range"]);
}

#[test]
fn what_a_format_has_no_place_for_is_refused() {
    #[track_caller]
    fn check(config: &Config, message: &str) {
        let (camera, _) = map(2, 2, 1);
        let error = run(config, &Source::new("t.ug", format!("{SQUARE} f (a b c d); {camera}")))
            .unwrap_err();
        assert!(error.is_usage());
        assert!(error.words().contains(message), "{error}");
    }
    let to = |format| with(&map(2, 2, 1).1, |picture| picture.output = Output::Color(format));
    for format in [Format::Exr, Format::Pfm, Format::Hdr] {
        check(
            &with(&to(format), |picture| picture.exposure = Some(Exposure::Auto)),
            "leave out -ex and -tc",
        );
        check(&with(&to(format), |picture| picture.tone = Tone::Filmic), "leave out -ex and -tc");
    }
    for format in [Format::Pfm, Format::Hdr] {
        check(
            &with(&to(format), |picture| picture.background = Background::Transparent),
            "write -dt exr",
        );
    }
    for format in [Format::Png, Format::Pfm, Format::Png16] {
        check(
            &with(&to(format), |picture| picture.channels = vec![Channel::Time]),
            "with -ch write -dt exr",
        );
    }
}
