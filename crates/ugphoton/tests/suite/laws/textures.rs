//! Textures: their light, their place, and their footprints.

use glam::{DVec2, DVec3};
use ugphoton::{ColorShift, Config, HueShift, PictureOptions};
use ugphysics::{Brightness, Velocity, seen_position, srgb_decode, srgb_encode};

use super::drawing::{HEAD, by_spectra, config, drawn, polygon, seen_with};

/// Shapes alone: nothing is shifted.
fn by_shape() -> Config {
    Config { shift: ColorShift::NONE, ..Config::default() }
}

/// A square at y = 3 with this colour, and texture coordinates over the whole picture.
fn square(color: &str, velocity: &str) -> String {
    format!(
        "v a -1 3 -1 (0 1); v b 1 3 -1 (1 1); v c 1 3 1 (1 0); v d -1 3 1 (0 0); f (a b c d) {color} 1 {velocity};"
    )
}

/// A texture of one colour is shifted as that colour: in motion, by hues exactly, and by spectra
/// within the error of the lattice; at rest it is the colour, whatever it is.
#[test]
fn a_texel_is_shifted_as_its_colour() {
    let colors = [
        [200, 40, 30],
        [12, 130, 60],
        [20, 30, 180],
        [230, 180, 40],
        [128, 128, 128],
        [250, 245, 252],
    ];
    let hues = Config {
        shift: ColorShift::Hues(HueShift { doppler: true, law: Brightness::Photon }),
        ..Config::default()
    };
    for [red, green, blue] in colors {
        let [r, g, b] = [red, green, blue].map(|byte| f64::from(byte) / 255.0);
        let head = format!(
            "{HEAD}c_rgb plain {r} {g} {b}; c 1; c_tex it rgb_{red}_{green}_{blue}; c_rgb it 1 1 1;"
        );
        for beta in [
            DVec3::ZERO,
            DVec3::X * 0.2,
            DVec3::Y * 0.4,
            DVec3::Y * -0.4,
            DVec3::new(-0.5, 0.3, 0.0),
        ] {
            let velocity = &format!("<{} {} {}>", beta.x, beta.y, beta.z);
            let toward =
                seen_position(DVec3::new(0.1, 3.0, -0.2), Velocity::from_beta(beta).unwrap());
            let at = |color: &str, base: &Config| {
                let text = head.clone() + &square(color, velocity);
                seen_with(&text, toward, base.clone())
            };
            for (base, tolerance) in [(&hues, 1e-5), (&by_shape(), 1e-5), (&by_spectra(), 0.02)] {
                let (found, expected) = (at("it", base), at("plain", base));
                let error = (found - expected).abs().max_element() / expected.abs().max_element();
                assert!(error < tolerance, "{red} {green} {blue} {velocity}: {found} {expected}");
            }
            // At rest and with grey the lattice is exact.
            if beta == DVec3::ZERO || (red == green && green == blue) {
                let (found, expected) = (at("it", &by_spectra()), at("plain", &by_spectra()));
                assert!((found / expected - 1.0).abs().max_element() < 1e-6, "{found} {expected}");
            }
        }
    }
}

/// Light is texel times factor times the colours of the vertices, interpolated as light.
#[test]
fn factors_multiply_light() {
    let head = format!(
        "{HEAD}c_rgb it 1 1 1; c_tex it rgb_255_128_0 -factor .5 .25 1; c_rgb half .5 1 .25;"
    );
    let light = |tint: &str| {
        let text = head.clone() + &square("it", "").replace(" (", &format!(" {tint} ("));
        // The parentheses of the face are no coordinates.
        seen_with(&text.replace(&format!("f {tint} ("), "f ("), DVec3::Y, by_shape())
    };
    let texel = DVec3::new(0.5, 0.25 * srgb_decode(128.0 / 255.0), 0.0);
    assert!(light("").distance(texel) < 1e-6, "{}", light(""));
    let tint = DVec3::new(srgb_decode(0.5), 1.0, srgb_decode(0.25));
    assert!(light("half").distance(texel * tint) < 1e-6, "{}", light("half"));
}

/// What a face emits is added to what it reflects, each shifted as its own colour; a texture of it
/// is not tinted by the colours of vertices, and has the coordinates of the face.
#[test]
fn emitted_light_is_added() {
    let hues = Config {
        shift: ColorShift::Hues(HueShift { doppler: true, law: Brightness::Photon }),
        ..Config::default()
    };
    let head = format!(
        "{HEAD}c_rgb tint .5 .5 .5; c_rgb wall .4 .3 .2; c_rgb lit .4 .3 .2; c_rgb glow .1 .2 .3;
         c_rgb picture 0 0 0; c_tex picture checks_2_1 -factor 3 2 1; c_rgb warm .3 .2 .1;
         c_emit lit glow; c_emit warm picture; c_rgb same 1 1 1; c_tex same checks_2_1 -factor 3 2 1;"
    );
    for beta in [DVec3::ZERO, DVec3::Y * 0.4, DVec3::new(-0.5, 0.3, 0.0)] {
        let velocity = &format!("<{} {} {}>", beta.x, beta.y, beta.z);
        let toward = seen_position(DVec3::new(0.5, 3.0, 0.5), Velocity::from_beta(beta).unwrap());
        for base in [&hues, &by_shape(), &by_spectra()] {
            let at = |color: &str, tint: &str| {
                let square = square(color, velocity).replace(" (", &format!(" {tint} ("));
                let text = head.clone() + &square.replace(&format!("f {tint} ("), "f (");
                seen_with(&text, toward, base.clone())
            };
            for (sum, parts, tint) in [
                ("lit", ["wall", "glow"], ""),
                ("warm", ["warm_alone", "same"], ""),
                ("warm", ["warm_alone", "same"], "tint"),
            ] {
                let plain = |color: &str, tint| match color {
                    "warm_alone" => {
                        let alone = head.replace("c_emit warm picture;", "");
                        let square = square("warm", velocity).replace(" (", &format!(" {tint} ("));
                        let text = alone + &square.replace(&format!("f {tint} ("), "f (");
                        seen_with(&text, toward, base.clone())
                    }
                    color => at(color, tint),
                };
                let (found, expected) =
                    (at(sum, tint), plain(parts[0], tint) + plain(parts[1], ""));
                let error = (found - expected).abs().max_element() / expected.max_element();
                assert!(error < 1e-5, "{sum} {tint} {velocity}: {found} {expected}");
            }
            let dark = toward * DVec3::new(-1.0, 1.0, 1.0);
            if beta == DVec3::ZERO {
                let text = head.clone() + &square("warm", "");
                let light = seen_with(&text, dark, by_shape());
                assert!(
                    light.distance(DVec3::new(0.3, 0.2, 0.1).map(srgb_decode)) < 1e-6,
                    "{light}"
                );
            }
        }
    }
}

/// Where a mask cuts, the light behind is seen, and shadows have its shape.
#[test]
fn alpha_masks_and_blends() {
    let behind = polygon(
        "w",
        &[[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0], [-9.0, 9.0]].map(|[x, z]| DVec3::new(x, 9.0, z)),
        "white 0.5",
    );
    let seen = |alpha: &str| {
        let text =
            format!("{HEAD}c it 1; c_tex it rgb_255_0_0 {alpha};{}{behind}", square("it", ""));
        seen_with(&text, DVec3::Y, by_shape())
    };
    let (red, wall) = (DVec3::X, DVec3::splat(srgb_decode(0.5)));
    for (alpha, expected) in [
        ("-factor 1 1 1 .4", red),
        ("-factor 1 1 1 .4 -mask .5", wall),
        ("-factor 1 1 1 .6 -mask .5", red),
        ("-factor 1 1 1 .25 -blend", 0.25 * red + 0.75 * wall),
    ] {
        assert!(seen(alpha).distance(expected) < 1e-6, "{alpha}: {} {expected}", seen(alpha));
    }
}

/// The edges of checks are seen where exact geometry has them (P3), to a tenth of a pixel of a
/// picture in which a side of the square is 200 pixels.
#[test]
fn checks_are_where_they_are_seen() {
    for beta in [DVec3::ZERO, DVec3::X * 0.99, DVec3::new(0.5, -0.6, 0.3), DVec3::Z * -0.99] {
        let velocity = format!("<{} {} {}>", beta.x, beta.y, beta.z);
        let text = format!("{HEAD}c it 1; c_tex it checks_8_8;{}", square("it", &velocity));
        let velocity = Velocity::from_beta(beta).unwrap();
        let light = |uv: DVec2| {
            let place = DVec3::new(2.0 * uv.x - 1.0, 3.0, 1.0 - 2.0 * uv.y);
            seen_with(&text, seen_position(place, velocity), by_shape()).y
        };
        for (column, row) in [(1, 2), (4, 4), (7, 0), (3, 7)] {
            let middle = DVec2::new(f64::from(column) / 8.0, (f64::from(row) + 0.5) / 8.0);
            let step = DVec2::X * (0.1 / 200.0);
            let (left, right) = (light(middle - step), light(middle + step));
            let is_black_left = (column - 1 + row) % 2 == 0;
            assert_eq!(left < 0.5, is_black_left, "{beta} {column} {row}: {left} {right}");
            assert_eq!(right > 0.5, is_black_left, "{beta} {column} {row}: {left} {right}");
        }
    }
}

/// Peak signal to noise ratios of display-encoded pictures with few samples per pixel, in dB.
fn psnr<const N: usize>(text: &str, (toward, angle): (DVec3, f64), few: [u32; N]) -> [f64; N] {
    let drawn = |samples| {
        let picture = PictureOptions { samples, ..config([48, 36], toward, angle).picture };
        drawn(text, &Config { picture, ..by_shape() })
    };
    let exact = drawn(12);
    let n_bright = exact.pixels().iter().filter(|pixel| pixel[1] > 0.1).count();
    assert!(20 * n_bright > exact.pixels().len(), "{n_bright} pixels are seen");
    let encoded = |light: f32| srgb_encode(f64::from(light).clamp(0.0, 1.0));
    let error = |(a, b): (&[f32; 4], &[f32; 4])| encoded(a[1]) - encoded(b[1]);
    few.map(|samples| {
        let found = drawn(samples);
        let errors = found.pixels().iter().zip(exact.pixels()).map(error);
        -10.0
            * libm::log10(
                errors.map(|error| error * error).sum::<f64>() / exact.pixels().len() as f64,
            )
    })
}

/// A floor of 400 x 400 checks to the horizon, and a board: 8 x 8 samples differ from 12 x 12 by no
/// more than edges do, and footprints keep a floor free of moire with 2 x 2 samples.
#[test]
fn footprints_prevent_aliasing() {
    for beta in [DVec3::ZERO, DVec3::X * -0.99, DVec3::Y * -0.99] {
        let velocity = format!("<{} {} {}>", beta.x, beta.y, beta.z);
        let floor = format!(
            "v e -99 1 -1.5 (0 0); v g 99 1 -1.5 (50 0); v h 99 199 -1.5 (50 50); v i -99 199 -1.5 (0 50); \
             f (e g h i) it 1 {velocity};"
        );
        let seen = |place: DVec3| seen_position(place, Velocity::from_beta(beta).unwrap());
        for (scene, corners) in [
            (square("it", &velocity), [DVec3::new(-1.0, 3.0, -1.0), DVec3::new(1.0, 3.0, 1.0)]),
            (floor, [DVec3::new(-9.0, 1.0, -1.5), DVec3::new(9.0, 60.0, -1.5)]),
        ] {
            let text = format!("{HEAD}c it 1; c_tex it checks_8_8;{scene}");
            // Without the outline, where samples alias as on any face.
            let angle =
                0.6 * seen(corners[0]).angle_between(seen(corners[1])).to_degrees().min(100.0);
            let view = (seen(corners[0].midpoint(corners[1])), angle);
            let [fine, coarse] = psnr(&text, view, [8, 2]);
            assert!(fine > 38.0, "{velocity}: {fine} dB\n{scene}");
            assert!(coarse > 26.0, "{velocity}: {coarse} dB with 2 x 2 samples\n{scene}");
        }
    }
}

/// A mirror, at rest or sliding along itself, shows the footprints of the scene behind it; a plane
/// between two like media changes nothing; and a ball mirrors a floor without aliasing.
#[test]
fn footprints_are_mirrored_and_refracted() {
    let floor = |sign: f64| {
        let corners = [
            (-99.0, 3.0, "0 0"),
            (99.0, 3.0, "50 0"),
            (99.0, 199.0, "50 50"),
            (-99.0, 199.0, "0 50"),
        ];
        let vertex = |(name, (x, y, uv)): (char, (f64, f64, &str))| {
            format!("v {name} {x} {} -1.5 ({uv}); ", if sign < 0.0 { 4.0 - y } else { y })
        };
        let vertices: String = ('e'..='h').zip(corners).map(vertex).collect();
        format!("{HEAD}surf air 0 0 1 1; c it 1; c_tex it checks_8_8; {vertices} f (e f g h) it 1;")
    };
    let plane = |surface: &str, size: f64| {
        let corners = [[-size, -size], [size, -size], [size, size], [-size, size]];
        polygon("w", &corners.map(|[x, z]| DVec3::new(x, 2.0, z)), &format!("white {surface}"))
    };
    let picture = |text: &str, samples: u32| {
        let base = config([48, 36], DVec3::new(0.0, 3.0, -0.5), 50.0).picture;
        drawn(text, &Config { picture: PictureOptions { samples, ..base }, ..by_shape() })
    };
    let plain = picture(&floor(1.0), 2);
    for text in [
        floor(-1.0) + &plane("mirror", 9.0),
        floor(-1.0) + &plane("mirror <.6 0 -.3>", 9.0),
        floor(1.0) + &plane("air", 9.0),
    ] {
        let bent = picture(&text, 2);
        let error = |(a, b): (&[f32; 4], &[f32; 4])| (a[1] - b[1]).abs();
        let largest = bent.pixels().iter().zip(plain.pixels()).map(error).fold(0.0, f32::max);
        assert!(largest < 1e-4, "{largest}: {text}");
    }
    let ball = floor(-1.0) + "sphere 0 4 0 1.5 white mirror;";
    let [decibel] = psnr(&ball, (DVec3::new(0.0, 4.0, -0.6), 20.0), [2]);
    assert!(decibel > 24.0, "{decibel} dB");
}
