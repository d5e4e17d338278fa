//! PostScript rendered by Ghostscript has the same pixels as the PNG.
//!
//! Without `gs` on the path the test is skipped, unless `UG_CI=1`.

use std::process::Command;

use glam::DVec3;
use image::Rgba;
use ugimage::Format;
use ugphysics::{srgb_decode, srgb_encode};
use ugrainbow::{Background, Output};
use ugtests::picture::{Picture, assert_same, decode, read};
use ugtests::pipe::{Pipe, rainbow_as};
use ugtests::scenes;
use ugtests::tools::{self, GHOSTSCRIPT};

/// Renders PostScript at one pixel per point. EPS pages are cropped to their bounding box; others
/// set their size.
fn ghostscript(file: &[u8]) -> Picture {
    let folder = tempfile::tempdir().unwrap();
    let (input, output) = (folder.path().join("in.ps"), folder.path().join("out.png"));
    std::fs::write(&input, file).unwrap();
    let mut gs = Command::new("gs");
    gs.args(["-q", "-dSAFER", "-dBATCH", "-dNOPAUSE", "-dEPSCrop", "-r72", "-sDEVICE=png16m"]);
    gs.arg("-o").arg(&output).arg(&input);
    let run = gs.output().unwrap();
    let messages = String::from_utf8_lossy(&run.stdout) + String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success() && messages.is_empty(), "{}: {messages}", run.status);
    read(&output)
}

/// Composes pictures on white, in linear light.
fn on_white(picture: &Picture) -> Picture {
    let mut flat = picture.clone();
    for Rgba([r, g, b, alpha]) in flat.pixels_mut() {
        let part = f64::from(*alpha) / 255.0;
        for level in [r, g, b] {
            let light = part * srgb_decode(f64::from(*level) / 255.0) + 1.0 - part;
            *level = (255.0 * srgb_encode(light)).round() as u8;
        }
        *alpha = 255;
    }
    flat
}

#[test]
fn ghostscript_draws_the_pixels_of_the_png() {
    if !tools::has(&[GHOSTSCRIPT]) {
        return;
    }
    let mut ship = Pipe::new(0.9 * DVec3::X, [160, 120]).in_place().shape();
    let mut lattice = Pipe::new(-0.9 * DVec3::Y, [97, 61]).view_angle(120.0);
    lattice.rainbow.picture.samples = 2;
    let mut clear = ship.clone();
    clear.rainbow.picture.background = Background::Transparent;
    ship.rainbow_command_line = "ugrainbow (with) \\ brackets".to_string();
    for (name, scene, pipe) in
        [("ship", "ship", ship), ("lattice", "lattice", lattice), ("clear", "ship", clear)]
    {
        let colored = pipe.run(&scenes::text(scene)).colored;
        let draw = |output| {
            let picture = ugrainbow::PictureOptions { output, ..pipe.rainbow.picture.clone() };
            let config = ugrainbow::Config { picture, ..pipe.rainbow.clone() };
            rainbow_as(&colored, &config, &pipe.rainbow_command_line)
        };
        let png = on_white(&decode(&draw(Output::Color(Format::Png))));
        assert!(png.pixels().any(|pixel| pixel != png.get_pixel(0, 0)), "{name} shows something");
        for format in [Format::Eps, Format::Ps] {
            let drawn = ghostscript(&draw(Output::Color(format)));
            assert_same(&format!("postscript-{name}-{}", format.name()), &png, &drawn, 1);
        }
    }
}
