//! Compares exact pictures with those of the default (scanline) mode.

use glam::DVec3;
use ugrainbow::ColorShift;
use ugtesting::Random;
use ugtests::picture::decode;
use ugtests::pipe::{Pipe, lorentz, rainbow};
use ugtests::scenes;

use super::{SIZE, channels, exact};

/// Colours and normals of corners, and a hole, in triangles at rest. At rest both modes draw a
/// triangle equally.
#[test]
fn at_rest_triangles_are_those_of_the_scanline_mode() {
    const TRIANGLES: &str = "c red 1 0; c blue .8 220 .9; c grey .7; l .3; l .8 1 -2 .5;
        cam -ep 0 0 0 -vc 0 9 0 -va 60 50;
        v a -3 9 -2 red 0 -1 .3; v b 3 8 -2 blue; v c 0 10 3 grey .5 -1 0; f (a b c); v d 3 12 3; f (b d c);";
    let mut pipe = exact(None);
    let exact = decode(&rainbow(TRIANGLES.as_bytes(), &pipe.rainbow));
    pipe.rainbow.exact = None;
    let scanned = decode(&rainbow(TRIANGLES.as_bytes(), &pipe.rainbow));
    // Normals are interpolated before lighting, not after it.
    ugtests::picture::assert_same("exact-triangles", &scanned, &exact, 12);
}

/// The scanline mode draws a finely cut scene equally, except for samples at the edges of faces:
/// with hues, and with spectra.
#[test]
fn both_modes_show_the_same_colours() {
    let spectral = BOX.replace("c green 1 120;", "c_bb green 4000 .3;").into_bytes();
    let cases = [
        (scenes::text("cubes"), 0.9 * DVec3::X, None),
        (scenes::text("ship"), 0.3 * DVec3::NEG_Y, None),
        (BOX.as_bytes().to_vec(), 0.9 * DVec3::X, None),
        (scenes::text("tunnel"), 0.6 * DVec3::NEG_Y, Some(false)),
        (scenes::text("cubes"), 0.5 * DVec3::X, Some(true)),
        (spectral, 0.6 * DVec3::X, Some(true)),
    ];
    for (row, (text, beta, spectra)) in cases.into_iter().enumerate() {
        let mut pipe = exact(Some(beta));
        pipe.lorentz.in_place = spectra.unwrap_or(true);
        let shift = if spectra.is_some() { ColorShift::SPECTRA } else { ColorShift::default() };
        pipe.rainbow.exact = Some(shift);
        let drawn = decode(&rainbow(&lorentz(&text, &pipe.lorentz), &pipe.rainbow));
        pipe.lorentz.pieces = uglorentz::Config::default().pieces;
        pipe.rainbow.exact = None;
        pipe.doppler = ugdoppler::Config { shift, keep: true, ..ugdoppler::Config::default() };
        if spectra.is_some() {
            pipe.lorentz.color_error = 1e-3;
            (pipe.doppler.keep, pipe.doppler.repeat, pipe.doppler.tolerance) = (false, true, 0.01);
        }
        let scanned = pipe.draw(&text);
        let levels = if spectra.is_some() { 3 } else { 12 };
        let far = |(a, b): (&image::Rgba<u8>, &image::Rgba<u8>)| {
            a.0.iter().zip(b.0).any(|(&a, b)| a.abs_diff(b) > levels)
        };
        let n_far = drawn.pixels().zip(scanned.pixels()).filter(|&pair| far(pair)).count();
        let n_pixels = (SIZE[0] * SIZE[1]) as usize;
        assert!(n_far * 200 < n_pixels, "case {row}: {n_far} of {n_pixels}");
        // Else this would say nothing.
        let n_drawn = drawn.pixels().filter(|pixel| pixel.0[..3].iter().any(|&level| level > 20)).count();
        assert!(spectra.is_none() || n_drawn * 20 > n_pixels, "case {row}: {n_drawn}");
    }
}

/// The scanline mode differs from the exact mode only within the error bound of subdivision.
#[test]
fn both_modes_agree_to_the_bound() {
    /// Samples of the exact picture along a side of a pixel.
    const FINE: u32 = 4;
    /// The largest allowed error of edges, pixels.
    const REACH: f64 = 1.0;
    const ACROSS_DEG: f64 = 60.0;
    let pixel = 2.0 * libm::tan(ACROSS_DEG.to_radians() / 2.0) / f64::from(SIZE[0]);
    // Pixels per angle increase with the distance from the centre; the corners, with an aspect
    // ratio of 4 : 3, are at 5/4 of half the width.
    let slant = 1.25 * pixel * f64::from(SIZE[0]) / 2.0;
    let bound = REACH * pixel / (1.0 + slant * slant);
    let mut random = Random(11);
    let mut n_other = 0;
    for case in 0..12 {
        let beta = [0.9, 0.99][case % 2] * random.direction();
        let (middle, a, b) = (DVec3::Y * 6.0, 3.0 * random.direction(), 3.0 * random.direction());
        let corners: Vec<String> = [("a", a), ("b", b), ("c", -a), ("d", -b)]
            .map(|(name, side)| (name, middle + side))
            .map(|(name, p)| format!("v {name} {} {} {};", p.x, p.y, p.z))
            .to_vec();
        let text = format!("{} f (a b c d); cam -ep 0 0 0 -vc 0 9 0 -va {ACROSS_DEG} 46;", corners.concat());
        let covered = |pipe: &Pipe| -> Vec<bool> {
            channels(pipe, text.as_bytes())["id"].iter().map(|&id| id > 0.0).collect()
        };
        let mut pipe = exact(Some(beta)).in_place();
        pipe.rainbow.picture.size = SIZE.map(|side| side * FINE);
        let exact = covered(&pipe);
        let fine = |x: u32, y: u32| exact[(y * SIZE[0] * FINE + x) as usize];
        pipe.lorentz.pieces = uglorentz::Pieces::UpTo(bound);
        pipe.lorentz.color_error = f64::INFINITY;
        pipe.rainbow.exact = None;
        pipe.rainbow.picture.size = SIZE;
        for (idx, is_covered) in covered(&pipe).into_iter().enumerate() {
            let [x, y] = [idx as u32 % SIZE[0], idx as u32 / SIZE[0]];
            if fine(x * FINE + FINE / 2, y * FINE + FINE / 2) == is_covered {
                continue;
            }
            n_other += 1;
            let reach = (REACH * f64::from(FINE)) as u32 + 1;
            let around = |at: u32, side: u32| {
                let middle = at * FINE + FINE / 2;
                middle.saturating_sub(reach)..(middle + reach).min(side * FINE)
            };
            let mut places = around(y, SIZE[1]).flat_map(|y| around(x, SIZE[0]).map(move |x| (x, y)));
            assert!(
                places.any(|(x, y)| fine(x, y) == is_covered),
                "{beta} at {x}, {y}: {is_covered}\n{text}"
            );
        }
    }
    // Otherwise the test would prove nothing.
    assert!(n_other > 20, "{n_other}");
}

/// A box of wires, which look bent.
const BOX: &str = "c green 1 120; cam -ep 0 -9 1 -vc 0 0 0 -va 70 50; l 1;
    v a -3 -3 -3; v b 3 -3 -3; v c 3 3 -3; v d -3 3 -3; v e -3 -3 3; v f 3 -3 3; v g 3 3 3; v h -3 3 3;
    w (a b c d a e f g h e) green; w (b f) (c g) (d h);";

/// In both modes, channels describe the nearest surface that transmits less than half of the light.
#[test]
fn channels_tell_of_what_hides_more_than_it_shows() {
    for (translucency, first) in [(0.0, 1.0), (0.4, 1.0), (0.6, 2.0), (1.0, 2.0)] {
        let text = format!(
            "c pane 1 0 1 {translucency}; c wall .8; l 1; cam -ep 0 0 0 -vc 0 1 0 -va 60 50;
             v a -9 4 -9; v b 9 4 -9; v c 9 4 9; v d -9 4 9; f (a b c d) pane;
             v e -9 8 -9; v f 9 8 -9; v g 9 8 9; v h -9 8 9; f (e f g h) wall;"
        );
        let exact = exact(None);
        let mut scanned = exact.clone();
        scanned.rainbow.exact = None;
        for pipe in [exact, scanned] {
            assert!(channels(&pipe, text.as_bytes())["id"].iter().all(|id| *id == first), "{translucency}");
        }
    }
}
