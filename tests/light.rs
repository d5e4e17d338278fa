//! Checks pictures in linear light with another program: OpenImageIO, which uses the reference
//! implementation of OpenEXR.
//!
//! Without `oiiotool` on the path the tests are skipped, unless `UG_CI=1`.

use std::path::{Path, PathBuf};
use std::process::Command;

use glam::DVec3;
use ugimage::Format;
use ugparse::{Options, Source, parse};
use ugrainbow::{Background, Channel, Output, PictureOptions};
use ugtests::oracle::Pinhole;
use ugtests::pipe::{Pipe, rainbow};
use ugtests::tools::{self, OIIOTOOL};

const SIZE: [u32; 2] = [24, 18];

/// Bright, tiny and negative light, and hues.
const GLARE: &str =
    "c_xyz hot 900 400 1; c_xyz green .2 3 .1; c blue .7 220 .8; c dim .001 40; l 1;
    v a -4 9 -3 hot; v b 1 9 -3 green; v c 1 9 3 dim; v d -4 9 3 blue; f (a b c d);
    v e 0.3 8 -3; v g 3.7 8 -2; v h 2 7 3.1; f (e g h) blue; cam -ep 0 0 0 -vc 0 9 0 -va 60 50;";

/// Runs `oiiotool`, which must succeed without messages, and returns its output.
#[track_caller]
fn oiiotool(args: &[&str], files: &[&Path]) -> String {
    let output = Command::new("oiiotool").args(args).args(files).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        output.status.success() && output.stderr.is_empty() && !text.contains("ERROR"),
        "{text}"
    );
    text
}

/// The numbers of every pixel as printed by `oiiotool`: floats, or integer levels.
#[track_caller]
fn read(path: &Path) -> Vec<Vec<f64>> {
    let text = oiiotool(&["-v", "--dumpdata"], &[path]);
    let pixel = |line: &str| {
        let numbers = line.trim().strip_prefix("Pixel (")?.split_once("): ")?.1;
        let levels = numbers.split_once(" (").map_or(numbers, |(levels, _)| levels);
        Some(levels.split_whitespace().map(|number| number.parse().unwrap()).collect())
    };
    let pixels: Vec<Vec<f64>> = text.lines().filter_map(pixel).collect();
    assert_eq!(pixels.len(), (SIZE[0] * SIZE[1]) as usize, "{text}");
    pixels
}

#[track_caller]
fn write(folder: &Path, name: &str, bytes: &[u8]) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, bytes).unwrap();
    path
}

/// Draws a scene, with nine samples a pixel.
fn draw(text: &str, picture: PictureOptions) -> Vec<u8> {
    let picture = PictureOptions { size: SIZE, samples: 3, ..picture };
    rainbow(text.as_bytes(), &ugrainbow::Config { picture, ..ugrainbow::Config::default() })
}

#[test]
fn another_program_reads_the_same_light() {
    if !tools::has(&[OIIOTOOL]) {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let black = PictureOptions::default().background;
    let draw = |format, background| {
        draw(
            GLARE,
            PictureOptions {
                output: Output::Color(format),
                background,
                ..PictureOptions::default()
            },
        )
    };
    // The numbers in the PFM file: three floats per pixel, rows from the bottom.
    let pfm = draw(Format::Pfm, black);
    let [width, height] = SIZE.map(|side| side as usize);
    let floats: Vec<f64> = pfm[pfm.len() - 12 * width * height..]
        .as_chunks::<4>()
        .0
        .iter()
        .map(|bytes| f64::from(f32::from_le_bytes(*bytes)))
        .collect();
    let light: Vec<&[f64]> = floats.chunks(3 * width).rev().flat_map(|row| row.chunks(3)).collect();
    assert!(floats.iter().any(|x| *x > 100.0) && floats.iter().any(|x| *x < 0.0));

    for (name, bytes) in [("a.pfm", pfm.clone()), ("a.exr", draw(Format::Exr, black))] {
        for (ours, light) in read(&write(folder.path(), name, &bytes)).iter().zip(&light) {
            // `oiiotool` prints nine decimals.
            let is_same =
                ours.iter().zip(*light).all(|(a, b)| (a - b).abs() < 1e-9 + 1e-8 * b.abs());
            assert!(ours.len() == 3 && is_same, "{name}: {ours:?} for {light:?}");
        }
    }
    for (ours, light) in
        read(&write(folder.path(), "a.hdr", &draw(Format::Hdr, black))).iter().zip(&light)
    {
        let brightest = light.iter().fold(0.0f64, |a, b| a.max(*b));
        let is_near =
            ours.iter().zip(*light).all(|(a, b)| (a - b.max(0.0)).abs() <= brightest / 128.0);
        assert!(is_near, "{ours:?} for {light:?}");
    }
    // With transparency, colours are premultiplied by alpha, which equals the light on black.
    let clear =
        read(&write(folder.path(), "clear.exr", &draw(Format::Exr, Background::Transparent)));
    for (ours, light) in clear.iter().zip(&light) {
        let is_same = ours.iter().zip(*light).all(|(a, b)| (a - b).abs() < 1e-6 * b.abs().max(1.0));
        assert!(ours.len() == 4 && is_same, "{ours:?} for {light:?}");
        assert!(
            (9.0 * ours[3] - (9.0 * ours[3]).round()).abs() < 1e-6,
            "alpha is a part of nine samples"
        );
    }
    assert!(clear.iter().any(|pixel| pixel[3] > 0.0 && pixel[3] < 1.0));
}

#[test]
fn another_program_reads_the_same_levels() {
    if !tools::has(&[OIIOTOOL]) {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let draw = |format| {
        draw(GLARE, PictureOptions { output: Output::Color(format), ..PictureOptions::default() })
    };
    let png = read(&write(folder.path(), "a.png", &draw(Format::Png)));
    assert_eq!(read(&write(folder.path(), "a.ppm", &draw(Format::Ppm))), png);
    let deep = read(&write(folder.path(), "deep.png", &draw(Format::Png16)));
    for (deep, level) in deep.iter().flatten().zip(png.iter().flatten()) {
        // 65535 is 257 times 255; both are rounded.
        assert!((deep / 257.0 - level).abs() <= 0.51, "{deep} for {level}");
    }
    assert!(deep.iter().flatten().any(|level| level % 257.0 != 0.0));
}

/// A moving plane y = 10: for each pixel's ray the emission event is known. With t = −r and x = r
/// d, the rest coordinates are r (d + (γ−1)(d·û)û + γv), and their y is 10.
#[test]
fn channels_describe_the_emission_event() {
    if !tools::has(&[OIIOTOOL]) {
        return;
    }
    let text =
        "c k 1; l 1; v a -400 10 -400; v b 400 10 -400; v c 400 10 400; v d -400 10 400; f (a b c d) k;
                cam -ep 0 0 0 -vc 0 10 0 -va 60 50;";
    let beta = DVec3::new(0.6, 0.3, -0.1);
    let mut pipe = Pipe::new(beta, SIZE);
    pipe.rainbow.picture.samples = 3;
    pipe.rainbow.picture.output = Output::Color(Format::Exr);
    pipe.rainbow.picture.channels =
        vec![Channel::Doppler, Channel::Time, Channel::Distance, Channel::Depth, Channel::Velocity];
    let folder = tempfile::tempdir().unwrap();
    let path = write(folder.path(), "plane.exr", &pipe.run(text.as_bytes()).file);
    let header = oiiotool(&["-v", "--info"], &[&path]);
    let list = header.lines().find_map(|line| line.trim().strip_prefix("channel list: "));
    let listed: Vec<&str> = list.unwrap().split(", ").collect();
    assert_eq!(listed.len(), 3 + 7, "{header}");
    assert!(header.contains("0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329"), "{header}");
    let row = |name: &str| {
        listed.iter().position(|listed| *listed == name).unwrap_or_else(|| panic!("{header}"))
    };

    let scene = parse(&Source::new("plane.ug", text), &Options::default()).unwrap().scene;
    let pinhole = Pinhole::new(scene.camera().unwrap(), DVec3::ZERO, SIZE);
    let gamma = 1.0 / (1.0 - beta.length_squared()).sqrt();
    let axis = beta.normalize();
    for (idx, pixel) in read(&path).iter().enumerate() {
        let [x, y] = [idx as u32 % SIZE[0], idx as u32 / SIZE[0]].map(f64::from);
        let d = pinhole.direction(x + 0.5, y + 0.5);
        let at_rest = d + (gamma - 1.0) * d.dot(axis) * axis + gamma * beta;
        let distance = 10.0 / at_rest.y;
        let expected = [
            ("D", 1.0 / (gamma * (1.0 + beta.dot(d)))),
            ("time", -distance),
            ("distance", distance),
            ("Z", distance * d.y),
            ("velocity.X", beta.x),
            ("velocity.Y", beta.y),
            ("velocity.Z", beta.z),
        ];
        for (name, expected) in expected {
            let ours = pixel[row(name)];
            // Subdivision has a relative error of a ten-thousandth as seen from the eye.
            let is_near = (ours - expected).abs() < 1e-3 * expected.abs();
            assert!(is_near, "{name} at {x} {y}: {ours} for {expected}");
        }
    }
}

#[test]
fn the_id_channel_numbers_faces() {
    if !tools::has(&[OIIOTOOL]) {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    // Columns side by side; the third is missing.
    let column = |k: usize| {
        let left = k as f64 - 2.0;
        format!(
            "v a{k} {left} 4 -9; v b{k} {} 4 -9; v c{k} {} 4 9; v d{k} {left} 4 9; f (a{k} b{k} c{k} d{k});",
            left + 1.0,
            left + 1.0
        )
    };
    let text = [0, 1, 3].map(column).concat() + "cam -ep 0 0 0 -vc 0 4 0 -va 53.1301023542 40;";
    let output = Output::Color(Format::Exr);
    let options =
        PictureOptions { output, channels: vec![Channel::Id], ..PictureOptions::default() };
    let path = write(folder.path(), "a.exr", &draw(&text, options));
    let counted = folder.path().join("id.exr");
    // `oiiotool` scales integers by the largest one.
    let [from, to] = [&path, &counted].map(|path| path.to_str().unwrap());
    oiiotool(&[from, "--ch", "id", "--mulc", "4294967295", "-d", "float", "-o", to], &[]);
    for (idx, pixel) in read(&counted).iter().enumerate() {
        let expected = [1.0, 2.0, 0.0, 3.0][idx % SIZE[0] as usize / 6];
        assert!((pixel[0] - expected).abs() < 1e-3, "pixel {idx}: {pixel:?}");
    }
}
