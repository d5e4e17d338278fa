//! Exact pictures: independence of threads, refused input, notes, and channels.

use glam::DVec3;
use ugpipe::Words;
use ugrainbow::ColorShift;
use ugtests::pipe::{Pipe, lorentz, rainbow};
use ugtests::scenes;

use super::{SQUARE, channels, exact};

#[test]
fn threads_do_not_change_the_picture() {
    let text = scenes::text("street");
    let mut pipe = exact(Some(0.9 * DVec3::NEG_Y));
    pipe.rainbow.picture.samples = 3;
    let seen = lorentz(&text, &pipe.lorentz);
    let draw = |n_threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
        pool.install(|| rainbow(&seen, &pipe.rainbow))
    };
    assert_eq!(draw(1), draw(3));
}

#[test]
fn unsupported_scenes_are_refused() {
    let refusal = |pipe: &Pipe, text: &[u8]| {
        let source = ugparse::Source::new("test.ug", text);
        ugrainbow::run(&pipe.rainbow, &source).err().map(|error| error.words())
    };
    let mut pipe = exact(Some(0.5 * DVec3::X));
    let seen = lorentz(SQUARE.as_bytes(), &pipe.lorentz);
    assert_eq!(refusal(&pipe, &seen), None);
    let colored = ugtests::pipe::doppler(&seen, &pipe.doppler);
    assert!(refusal(&pipe, &colored).unwrap().contains("leave ugdoppler out"));
    let spectral = SQUARE.replace("c green .9 130 .8;", "c_bb green 5000;");
    let glowing = lorentz(spectral.as_bytes(), &pipe.lorentz);
    assert!(refusal(&pipe, &glowing).unwrap().contains("give -sp"));
    for shift in [ColorShift::NONE, ColorShift::SPECTRA] {
        let mut other = pipe.clone();
        other.rainbow.exact = Some(shift);
        assert_eq!(refusal(&other, &glowing), None);
    }
    let at_rest = spectral.replace("<.2 -.1 0>", "");
    assert_eq!(refusal(&pipe, at_rest.as_bytes()), None);
    pipe.lorentz.geometry.contraction = false;
    let bent = lorentz(SQUARE.as_bytes(), &pipe.lorentz);
    assert!(refusal(&pipe, &bent).unwrap().contains("leave out -xc"));
    pipe.rainbow.picture.camera.is_orthographic = true;
    assert!(refusal(&pipe, &seen).unwrap().contains("orthographic"));
}

/// Motion of lights is ignored, with a note that names the program that supports it.
#[test]
fn moving_lights_cause_a_note() {
    let notes = |text: &str| {
        let seen = format!("(ugstage 1 geometry as-seen eye 0 0 0) {text}");
        let scene = scenes::parse(seen.as_bytes());
        let notes = ugrainbow::render(&scene, &exact(None).rainbow).unwrap().notes;
        notes.iter().map(Words::words).collect::<Vec<_>>().join("; ")
    };
    assert_eq!(notes(SQUARE), "");
    let moving = notes(&SQUARE.replace("l .7 1 -2 .5;", "l .7 1 -2 .5 <0 .5 0>;"));
    assert!(moving.contains("leave out -xc") && moving.contains("ugdoppler -li"), "{moving}");
    // At rest a spectrum is not shifted, so there is no note.
    let glowing =
        SQUARE.replace("c green .9 130 .8;", "c_bb green 5000;").replace("<.2 -.1 0>", "");
    assert!(!notes(&glowing).contains("ugdoppler"), "{}", notes(&glowing));
}

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
            assert!(
                channels(&pipe, text.as_bytes())["id"].iter().all(|id| *id == first),
                "{translucency}"
            );
        }
    }
}
