//! Edges drawn as lines depend neither on the subdivision of faces nor on the drawing mode.

use glam::DVec3;
use ugphysics::Hsv;
use ugrainbow::{ColorShift, Config, Wireframe};
use ugtests::picture::{Picture, decode};
use ugtests::pipe::{lorentz, rainbow};

/// A cube about the origin; its faces are of three colours, so that some edges lie between two of
/// one colour.
fn cube() -> String {
    let mut text = "l 1; c a .9; c b .8; c c .7;".to_owned();
    for k in 0..8 {
        let at = |bit: usize| if k >> bit & 1 == 0 { -1 } else { 1 };
        text += &format!("v v{k} {} {} {};", at(0), at(1), at(2));
    }
    for (face, color) in [
        ("0 2 3 1", "a"),
        ("4 5 7 6", "a"),
        ("0 1 5 4", "b"),
        ("1 3 7 5", "b"),
        ("3 2 6 7", "c"),
        ("2 0 4 6", "c"),
    ] {
        text += &format!("f (v{}) {color};", face.replace(' ', " v"));
    }
    text + "cam -ep 1 -7 4 -vc 0 0 0 -va 40 40;"
}

/// Draws the cube at 0.9c, with edges cut into `n_pieces`.
fn drawn(n_pieces: u32, config: &Config) -> Picture {
    let cut = uglorentz::Config {
        velocity: Some(0.9 * DVec3::X),
        in_place: true,
        pieces: uglorentz::Pieces::PerEdge(n_pieces),
        ..uglorentz::Config::default()
    };
    decode(&rainbow(&lorentz(cube().as_bytes(), &cut), config))
}

/// The number of lit pixels in the first picture, and of those that differ much.
fn compared(one: &Picture, other: &Picture) -> (usize, usize) {
    let n_lit = one.pixels().filter(|pixel| pixel[0] > 128).count();
    let differs = |(a, b): &(&image::Rgba<u8>, &image::Rgba<u8>)| a[0].abs_diff(b[0]) > 90;
    (n_lit, one.pixels().zip(other.pixels()).filter(differs).count())
}

fn edges() -> Config {
    let white = Hsv { hue: 0.0, saturation: 0.0, value: 1.0 };
    Config {
        picture: ugrainbow::PictureOptions { size: [240, 180], ..ugrainbow::PictureOptions::default() },
        wireframe: Some(Wireframe { has_faces: false, color: Some(white), ..Wireframe::default() }),
        line_width: 2.0,
        ..Config::default()
    }
}

#[test]
fn the_edges_of_a_cut_face_are_those_it_had() {
    // Finer pieces are close to coarser ones; if cuts were drawn, they would light every pixel of
    // some rows.
    let (n_lit, n_different) = compared(&drawn(16, &edges()), &drawn(32, &edges()));
    assert!(n_lit > 400 && n_lit < 2400 && n_different * 50 < n_lit, "{n_different} of {n_lit}");
}

#[test]
fn edges_found_by_rays_are_those_of_fine_pieces() {
    let exact = Config { exact: Some(ColorShift::default()), ..edges() };
    let (n_lit, n_different) = compared(&drawn(1, &exact), &drawn(32, &edges()));
    assert!(n_lit > 400 && n_different * 50 < n_lit, "{n_different} of {n_lit}");
}
