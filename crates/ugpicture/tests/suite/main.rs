//! What renderers share: backgrounds, levels and lines, by their laws.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

use glam::DVec3;
use ugimage::{LinearFrame, Tone};
use ugphysics::Hsv;
use ugpicture::{
    Backdrop, Background, Error, Exposure, Note, PictureOptions, clip_line, levels_note, spots,
};

/// A pixel is the mean of what covers it and of the background; on a transparent one, what covers
/// it, and how much.
#[test]
fn pixels_are_means() {
    let half = Backdrop::new(Background::Color(Hsv { hue: 0.0, saturation: 0.0, value: 1.0 }), 2);
    assert_eq!(half.pixel([0.5, 1.0, 0.0], 1.0), [3.5 / 4.0, 1.0, 0.75, 0.25]);
    assert_eq!(half.pixel([0.0; 3], 0.0), [1.0, 1.0, 1.0, 0.0]);
    let clear = Backdrop::new(Background::Transparent, 2);
    assert_eq!(clear.pixel([0.5, 1.0, 0.0], 2.0), [0.25, 0.5, 0.0, 0.5]);
    assert_eq!(clear.pixel([0.0; 3], 0.0), [0.0; 4]);
    assert!(half.is_opaque() && !clear.is_opaque());
}

/// Twice the light is one stop less exposure: the note on its levels is the same.
#[test]
fn levels_follow_the_exposure() {
    let note = |light: f32, stops: f64| {
        let frame = LinearFrame::new([40, 40], true, vec![[light, light, light, 1.0]; 1600]);
        let exposure = Some(Exposure::Stops(stops));
        levels_note(&frame, &PictureOptions { exposure, ..PictureOptions::default() })
    };
    for stops in [-3.0, 0.0, 5.0] {
        let gain = libm::exp2(-stops) as f32;
        assert!(matches!(note(1e-6 * gain, stops), Some(Note::NearlyBlack { .. })));
        assert_eq!(note(0.5 * gain, stops), None);
        assert!(matches!(note(100.0 * gain, stops), Some(Note::Overexposed)));
    }
}

#[test]
fn sizes_and_formats_that_cannot_be_are_refused() {
    let check = |options: PictureOptions| options.check();
    let plain = PictureOptions::default;
    assert_eq!(check(plain()), Ok(()));
    assert_eq!(check(PictureOptions { size: [0, 5], ..plain() }), Err(Error::Size([0, 5])));
    assert_eq!(check(PictureOptions { samples: 0, ..plain() }), Err(Error::Samples(0)));
    let exr = ugpicture::Output::Color(ugimage::Format::Exr);
    let developed = PictureOptions { output: exr, tone: Tone::Filmic, ..plain() };
    assert_eq!(check(developed), Err(Error::NotDeveloped));
    let channels = vec![ugpicture::Channel::Doppler];
    assert_eq!(check(PictureOptions { channels, ..plain() }), Err(Error::NotExr));
}

/// The ends of the part that is kept are where the functions are 0.
#[test]
fn clipped_lines_end_at_zeros() {
    for (first, last) in [(-1.0, 3.0), (2.0, -1.0), (-0.1, 5.0), (1.0, 2.0)] {
        let [start, end] = clip_line([[first, last]]).unwrap();
        let at = |part: f64| first + (last - first) * part;
        assert!(first >= 0.0 || at(start).abs() < 1e-15);
        assert!(last >= 0.0 || at(end).abs() < 1e-15);
        assert!(at(start) > -1e-15 && at(end) > -1e-15 && start <= end);
    }
    assert_eq!(clip_line([[-1.0, 1.0], [1.0, -3.0]]), None);
}

/// Places within a given distance of an earlier one count as that one, also across cells of the
/// grid that finds them.
#[test]
fn near_places_are_one() {
    let places: Vec<DVec3> =
        [0.0, 0.09, 1.0, -0.09, 1.05, 5.0].map(|x| DVec3::new(x, 2.0, -x)).into();
    assert_eq!(spots(&places, 0.1), [0, 0, 2, 0, 2, 5]);
    assert_eq!(spots(&places, 0.0), [0, 1, 2, 3, 4, 5]);
}
