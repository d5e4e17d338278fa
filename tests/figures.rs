//! PDF, SVG and vector figures rendered by other programs show the same picture as the PNG.
//!
//! Without `gs`, `pdftoppm`, `rsvg-convert` and `chromium` on the path the tests are skipped,
//! unless `UG_CI=1`.

use std::path::{Path, PathBuf};
use std::process::Command;

use glam::DVec3;
use rayon::prelude::*;
use ugimage::Format;

use ugrainbow::{Output, TextForm};
use ugtests::picture::{Picture, assert_same, decode, read, svg_text};
use ugtests::pipe::{Pipe, rainbow};
use ugtests::{scenes, tools};

const TOOLS: [tools::Tool; 4] = [tools::GHOSTSCRIPT, tools::POPPLER, tools::RSVG, tools::CHROMIUM];

/// A program that renders a file.
#[derive(Clone, Copy, Debug)]
enum Tool {
    Ghostscript,
    Poppler,
    /// Extracts the picture from the page, because pdftoppm resamples pictures even at one pixel
    /// per point.
    PopplerImages,
    Rsvg,
    Chromium,
}

/// Renders the file at one pixel per point, with anti-aliasing.
fn drawn(tool: Tool, format: Format, file: &[u8]) -> Picture {
    let folder = tempfile::tempdir().unwrap();
    let input = folder.path().join(format!("in.{}", format.name()));
    let output = folder.path().join(if matches!(tool, Tool::PopplerImages) {
        "out-000.png"
    } else {
        "out.png"
    });
    std::fs::write(&input, file).unwrap();
    let mut run = command(tool, &input, &output).output().unwrap();
    for _ in 0..2 {
        if run.status.success() || !matches!(tool, Tool::Chromium) {
            break;
        }
        // Browsers sometimes hang at startup.
        run = command(tool, &input, &output).output().unwrap();
    }
    let messages = String::from_utf8_lossy(&run.stdout) + String::from_utf8_lossy(&run.stderr);
    // Browsers print warnings about the missing desktop.
    let is_content = messages.is_empty() || matches!(tool, Tool::Chromium);
    assert!(run.status.success() && is_content, "{tool:?}: {}: {messages}", run.status);
    read(&output)
}

fn command(tool: Tool, input: &Path, output: &PathBuf) -> Command {
    match tool {
        Tool::Ghostscript => {
            let mut gs = Command::new("gs");
            gs.args([
                "-q",
                "-dSAFER",
                "-dBATCH",
                "-dNOPAUSE",
                "-dEPSCrop",
                "-r72",
                "-dGraphicsAlphaBits=4",
            ]);
            gs.arg("-sDEVICE=png16m").arg("-o").arg(output).arg(input);
            gs
        }
        Tool::Poppler => {
            let mut poppler = Command::new("pdftoppm");
            poppler
                .args(["-r", "72", "-png", "-singlefile"])
                .arg(input)
                .arg(output.with_extension(""));
            poppler
        }
        Tool::PopplerImages => {
            let mut poppler = Command::new("pdfimages");
            poppler.arg("-png").arg(input).arg(output.with_file_name("out"));
            poppler
        }
        Tool::Rsvg => {
            let mut rsvg = Command::new("rsvg-convert");
            rsvg.args(["-d", "72", "-p", "72"]).arg(input).arg("-o").arg(output);
            rsvg
        }
        Tool::Chromium => {
            let mut chromium = Command::new("timeout");
            chromium.args(["60", "chromium"]);
            // Without a sandbox, so that it also runs as root; it opens only our file.
            chromium.args([
                "--headless",
                "--no-sandbox",
                "--disable-gpu",
                "--disable-dev-shm-usage",
            ]);
            chromium.args(["--hide-scrollbars", "--force-device-scale-factor=0.75"]);
            // A point is 4/3 of a pixel of CSS.
            let [width, height] = SIZE.map(|side| side * 4 / 3);
            chromium.arg(format!("--window-size={width},{height}"));
            chromium.arg(format!("--user-data-dir={}", output.with_file_name("profile").display()));
            chromium.arg(format!("--screenshot={}", output.display()));
            chromium.arg(format!("file://{}", input.display()));
            chromium
        }
    }
}

/// Vector formats, and the programs that render them.
const DRAWN_BY: [(Format, &[Tool]); 4] = [
    (Format::Eps, &[Tool::Ghostscript]),
    (Format::Ps, &[Tool::Ghostscript]),
    (Format::Pdf, &[Tool::Ghostscript, Tool::Poppler]),
    (Format::Svg, &[Tool::Rsvg, Tool::Chromium]),
];

/// The fraction of pixels with a channel more than `LEVELS` outside the range of the PNG's pixel
/// and its eight neighbours. So an edge may be anti-aliased differently, but not displaced; and
/// where the PNG changes little, as within faces, only its colour passes.
fn fraction_different(png: &Picture, drawn: &Picture) -> f64 {
    const LEVELS: u8 = 8;
    assert_eq!(png.dimensions(), drawn.dimensions());
    let (width, height) = png.dimensions();
    let differs = |x: u32, y: u32| {
        let near = |at: u32, end: u32| at.saturating_sub(1)..(at + 2).min(end);
        (0..3).any(|channel| {
            let levels = near(y, height).flat_map(|y| near(x, width).map(move |x| (x, y)));
            let levels = levels.map(|(x, y)| png.get_pixel(x, y)[channel]);
            let (low, high) = levels
                .fold((255, 0), |(low, high): (u8, u8), level| (low.min(level), high.max(level)));
            let level = drawn.get_pixel(x, y)[channel];
            level < low.saturating_sub(LEVELS) || level > high.saturating_add(LEVELS)
        })
    };
    let n_different =
        (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).filter(|&(x, y)| differs(x, y));
    n_different.count() as f64 / f64::from(width * height)
}

/// Composes on white in display encoding, as viewers do.
fn on_paper(mut picture: Picture) -> Picture {
    for pixel in picture.pixels_mut() {
        let part = f64::from(pixel[3]) / 255.0;
        let level = |level: u8| (part * f64::from(level) + (1.0 - part) * 255.0).round() as u8;
        pixel.0 = [level(pixel[0]), level(pixel[1]), level(pixel[2]), 255];
    }
    picture
}

const SIZE: [u32; 2] = [432, 324];

fn ship() -> Pipe {
    Pipe::new(0.2 * DVec3::X, SIZE).in_place()
}

/// The colored scene drawn by the last program of the pipe, with another output.
fn drawn_as(pipe: &Pipe, colored: &[u8], output: Output) -> Vec<u8> {
    let picture = ugrainbow::PictureOptions { output, ..pipe.rainbow.picture.clone() };
    rainbow(colored, &ugrainbow::Config { picture, ..pipe.rainbow.clone() })
}

#[test]
fn embedded_pictures_are_the_png() {
    if !tools::has(&TOOLS) {
        return;
    }
    let pipe = ship();
    let colored = pipe.run(&scenes::text("ship")).colored;
    let draw = |output| drawn_as(&pipe, &colored, output);
    let png = decode(&draw(Output::Color(Format::Png)));
    for (format, tool) in [
        (Format::Pdf, Tool::Ghostscript),
        (Format::Pdf, Tool::PopplerImages),
        (Format::Svg, Tool::Rsvg),
        (Format::Svg, Tool::Chromium),
    ] {
        let file = draw(Output::Color(format));
        assert_same(
            &format!("embedded-{}-{tool:?}", format.name()),
            &png,
            &drawn(tool, format, &file),
            1,
        );
    }
}

#[test]
fn vector_figures_show_the_same_as_the_png() {
    if !tools::has(&TOOLS) {
        return;
    }
    let mut white = ship();
    white.rainbow.picture.background =
        ugrainbow::Background::Color(ugphysics::Hsv { hue: 0.0, saturation: 0.0, value: 1.0 });
    // Text and lines have the same outlines as areas and as pixels.
    let mut annotated = white.clone();
    annotated.rainbow.picture.annotations = ugrainbow::AnnotationOptions {
        caption:
            "A ship at β = 0.2, γ = 1.021: where it would be seen at rest, and the ground below it."
                .into(),
        legend: true,
        outline: true,
        grid: true,
        ..Default::default()
    };
    let mut searchable = annotated.clone();
    searchable.rainbow.picture.text = TextForm::Text;
    let cubes = Pipe::new(0.3 * DVec3::X, SIZE).in_place();
    let street = Pipe::new(-0.5 * DVec3::Y, SIZE);
    let lattice = Pipe::new(0.9 * DVec3::X, SIZE);
    let sphere = Pipe::new(0.95 * DVec3::X, SIZE).in_place().shape();
    let mut teapot = sphere.clone();
    teapot.lorentz.smooth = true;
    let mut cued = cubes.clone();
    cued.rainbow.depth_cue = Some(ugrainbow::DepthCue { range: None, least: 0.2 });
    let edges = |has_faces| {
        Some(ugrainbow::Wireframe { has_faces, color: None, ..ugrainbow::Wireframe::default() })
    };
    let mut wires = sphere.clone();
    wires.rainbow.wireframe = edges(false);
    let mut edged = ship();
    edged.rainbow.wireframe = edges(true);
    // Intersecting translucent faces, with edges in front and behind.
    let glass = Pipe::new(0.9 * DVec3::X, SIZE).in_place().shape();
    let mut glass_at_rest = Pipe::new(DVec3::ZERO, SIZE);
    glass_at_rest.rainbow.wireframe = edges(true);
    // On a transparent background, which all viewers show as white paper.
    let mut clear = annotated.clone();
    clear.rainbow.picture.background = ugrainbow::Background::Transparent;
    let figures = [
        ("ship", scenes::text("ship"), ship()),
        ("white", scenes::text("ship"), white),
        ("annotated", scenes::text("ship"), annotated),
        ("text", scenes::text("ship"), searchable),
        ("cubes", scenes::text("cubes"), cubes),
        ("street", scenes::text("street"), street),
        ("lattice", scenes::text("lattice"), lattice),
        ("sphere", scenes::text("sphere"), sphere),
        ("teapot", scenes::text("teapot"), teapot),
        ("depth cueing", scenes::text("cubes"), cued),
        ("wireframe", scenes::text("sphere"), wires),
        ("edges", scenes::text("ship"), edged),
        ("glass", scenes::text("glass"), glass),
        ("glass at rest", scenes::text("glass"), glass_at_rest),
        ("transparent", scenes::text("ship"), clear),
    ];
    figures.par_iter().for_each(|(name, text, pipe)| {
        let colored = pipe.run(text).colored;
        let draw = |output| drawn_as(pipe, &colored, output);
        let png = on_paper(decode(&draw(Output::Color(Format::Png))));
        assert!(png.pixels().any(|pixel| pixel != png.get_pixel(0, 0)), "{name} shows something");
        let is_clear = pipe.rainbow.picture.background == ugrainbow::Background::Transparent;
        // All tools draw the figures with text, smooth areas and transparency. Of the others EPS
        // would show the same page as PostScript, and a browser takes seconds to start.
        let is_for_all = ["text", "teapot", "transparent"].contains(name);
        let is_tried = |format: Format, tool: Tool| {
            (!is_clear || format.has_alpha())
                && (is_for_all
                    || matches!((format, tool), (Format::Ps, _) | (_, Tool::Poppler | Tool::Rsvg)))
        };
        for (format, tools) in DRAWN_BY {
            let tools: Vec<Tool> =
                tools.iter().copied().filter(|tool| is_tried(format, *tool)).collect();
            if tools.is_empty() {
                continue;
            }
            let file = draw(Output::Vector(format));
            for tool in tools {
                let part = fraction_different(&png, &on_paper(drawn(tool, format, &file)));
                println!(
                    "{name} {} {tool:?}: {:.3} % of the pixels differ",
                    format.name(),
                    100.0 * part
                );
                assert!(
                    part <= 0.02,
                    "{name} {} {tool:?}: {part} of the pixels differ",
                    format.name()
                );
            }
        }
    });
}

/// Each word is found in the file, at the place where its outline is.
#[test]
fn text_in_figures_can_be_searched() {
    if !tools::has(&TOOLS) {
        return;
    }
    const CAPTION: &str = "AVE: β = 0.2, γ < 1.021 & D → λ";
    let mut pipe = ship();
    pipe.rainbow.picture.annotations = ugrainbow::AnnotationOptions {
        caption: CAPTION.into(),
        legend: true,
        grid: true,
        ..ugrainbow::AnnotationOptions::default()
    };
    let colored = pipe.run(&scenes::text("ship")).colored;
    let draw = |format, text| {
        let output = Output::Vector(format);
        let picture = ugrainbow::PictureOptions { output, text, ..pipe.rainbow.picture.clone() };
        rainbow(&colored, &ugrainbow::Config { picture, ..pipe.rainbow.clone() })
    };
    let words = |file: &[u8]| {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("in.pdf");
        std::fs::write(&path, file).unwrap();
        let run = Command::new("pdftotext").arg(path).arg("-").output().unwrap();
        assert!(run.status.success() && run.stderr.is_empty(), "{run:?}");
        String::from_utf8(run.stdout).unwrap()
    };
    let found = words(&draw(Format::Pdf, TextForm::Text));
    assert!(
        [CAPTION, "γ = 1.021", "700 nm", "x = −10"].iter().all(|text| found.contains(text)),
        "{found}"
    );
    assert_eq!(words(&draw(Format::Pdf, TextForm::Outlines)).trim(), "");
    let svg = String::from_utf8(draw(Format::Svg, TextForm::Text)).unwrap();
    let text = svg_text(&svg);
    assert!(text.contains("AVE: β = 0.2, γ &lt; 1.021 &amp; D → λ"), "{svg}");
}

/// A vector figure must be smaller than a picture at print resolution.
#[test]
fn vector_figures_are_smaller_than_pictures_for_print() {
    let pipe = ship();
    let colored = pipe.run(&scenes::text("ship")).colored;
    // 6 x 4.5 inches on paper: in points, and in pixels at 600 dpi.
    let print = ugrainbow::Config {
        picture: ugrainbow::PictureOptions {
            size: [3600, 2700],
            samples: 1,
            ..pipe.rainbow.picture.clone()
        },
        ..pipe.rainbow.clone()
    };
    let png = rainbow(&colored, &print).len();
    for format in [Format::Eps, Format::Ps, Format::Pdf, Format::Svg] {
        let figure = drawn_as(&pipe, &colored, Output::Vector(format)).len();
        println!("{}: {figure} bytes, PNG {png}", format.name());
        assert!(figure < png, "{}: {figure} bytes, PNG {png}", format.name());
    }
}
