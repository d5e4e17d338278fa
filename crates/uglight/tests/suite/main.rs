//! Lamps and colours: fall-off, cosine, beams, and what motion changes in hues.

mod colors;

use glam::DVec3;
use uglight::{FallOff, HueColor, HueShift, Lamp, LampPlace, Lamps};
use ugphysics::{Brightness, Hsv};
use ugscene::{Beam, Scene};

fn near(what: &str, got: f64, want: f64, tolerance: f64) {
    assert!((got - want).abs() <= tolerance * want.abs().max(1.0), "{what}: {got}, not {want}");
}

fn at(beam: Beam, fall_off: Option<FallOff>) -> Lamp {
    let mut lamp = Lamp::white(LampPlace::At(DVec3::new(0.0, 0.0, 5.0)), 2.0);
    (lamp.beam, lamp.fall_off) = (beam, fall_off);
    lamp
}

/// r₀²/r², which is 1 at the reference distance; no nearer than the surface of the lamp.
#[test]
fn light_falls_off_with_the_square_of_the_distance() {
    let lamp = FallOff::new(2.0, 0.5);
    for (distance, part) in [(2.0, 1.0), (1.0, 4.0), (4.0, 0.25), (20.0, 0.01), (0.5, 16.0)] {
        near("part", lamp.at(distance), part, 1e-15);
    }
    assert_eq!(lamp.at(0.1), lamp.at(0.5));
    assert!(lamp.is_outside(0.6) && !lamp.is_outside(0.4));
    // A point has a limit, too: 10¹² times the intensity.
    assert_eq!(FallOff::new(1.0, 0.0).at(0.0), 1e12);
}

/// Lambert: the level is the cosine of the angle of incidence, and 0 behind the surface.
#[test]
fn levels_are_cosines() {
    let lamp = at(Beam::Even, Some(FallOff::new(5.0, 0.0)));
    for degrees in [0.0_f64, 30.0, 60.0, 89.0, 91.0, 180.0] {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        let level = lamp.level_at_rest(DVec3::ZERO, DVec3::new(sin, 0.0, cos), DVec3::ZERO);
        near("cosine", level, cos.max(0.0), 1e-15);
        // Twice as near, four times as much; in a frame shifted by `shift`, too.
        for (point, shift) in [(DVec3::Z * 2.5, DVec3::ZERO), (DVec3::ZERO, DVec3::Z * -2.5)] {
            let level = lamp.level_at_rest(point, DVec3::new(sin, 0.0, cos), shift);
            near("near by", level, 4.0 * cos.max(0.0), 1e-14);
        }
    }
    // A surface without a side gets no light of a lamp, and all ambient light.
    assert_eq!(lamp.level_at_rest(DVec3::ZERO, DVec3::ZERO, DVec3::ZERO), 0.0);
    let ambient = Lamp::white(LampPlace::Everywhere, 1.0);
    assert_eq!(ambient.level_at_rest(DVec3::ZERO, DVec3::NEG_Z, DVec3::ZERO), 1.0);
    let afar = Lamp::white(LampPlace::Afar(DVec3::X), 1.0);
    let normal = DVec3::new(0.6, 0.8, 0.0);
    near("afar", afar.level_at_rest(DVec3::splat(1e9), normal, DVec3::ZERO), 0.6, 1e-15);
}

/// A spot is whole within its edge, half in the middle of it, symmetrically, and dark outside; an
/// area lamp emits in proportion to the cosine of the angle to u × v, and nothing behind it.
#[test]
fn beams_have_their_shapes() {
    let spot = |degrees| Beam::Spot { axis: DVec3::new(0.0, 0.0, -3.0), degrees };
    let leaving = |degrees: f64| {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        DVec3::new(0.6 * sin, 0.8 * sin, -cos)
    };
    let part = |beam, degrees| at(beam, None).part_at(7.0, leaving(degrees), beam);
    for (angle, expected) in [(0.0, 1.0), (20.0, 1.0), (25.0, 0.5), (30.0, 0.0), (90.0, 0.0)] {
        near("soft", part(spot([30.0, 10.0]), angle), expected, 1e-12);
    }
    for off in [1.0, 2.0, 4.9] {
        let both = part(spot([30.0, 10.0]), 25.0 - off) + part(spot([30.0, 10.0]), 25.0 + off);
        near("symmetrical", both, 1.0, 1e-12);
    }
    assert!(part(spot([30.0, 10.0]), 22.0) > part(spot([30.0, 10.0]), 24.0));
    assert_eq!([29.9, 30.1].map(|angle| part(spot([30.0, 0.0]), angle)), [1.0, 0.0]);
    // u × v = −z.
    let area = Beam::Area([DVec3::Y * 2.0, DVec3::X]);
    for degrees in [0.0_f64, 45.0, 80.0, 120.0] {
        let cos = libm::cos(degrees.to_radians()).max(0.0);
        near("area", part(area, degrees), cos, 1e-15);
    }
    // Its places are within the parallelogram and their shares add up to one.
    let lamp = at(area, None);
    let (mut sum, mut mean) = (0.0, DVec3::ZERO);
    for (place, share) in lamp.places() {
        let LampPlace::At(place) = place else { panic!("a place") };
        assert!(place.x.abs() <= 0.5 && place.y.abs() <= 1.0 && place.z == 5.0, "{place}");
        (sum, mean) = (sum + share, mean + share * place);
    }
    near("shares", sum, 1.0, 1e-14);
    assert!((mean - DVec3::Z * 5.0).length() < 1e-14, "{mean}");
    assert_eq!(lamp.place_on([0.5, 0.5]), LampPlace::At(DVec3::Z * 5.0));
    assert_eq!(lamp.place_on([1.0, 0.0]), LampPlace::At(DVec3::new(-0.5, 1.0, 5.0)));
}

/// λ/D, and the value times a power of D; greys have no wavelength.
#[test]
fn hues_shift_by_the_doppler_factor() {
    let green = HueColor::from(Hsv { hue: 120.0, saturation: 0.5, value: 0.25 });
    let nm = green.wavelength_nm;
    for (law, power) in [
        (Brightness::Report, 1),
        (Brightness::Photon, 3),
        (Brightness::Bolometric, 4),
        (Brightness::None, 0),
    ] {
        for doppler in [0.9_f64, 1.0, 1.2] {
            let seen = HueShift { doppler: true, law }.seen(green, doppler);
            near("wavelength", seen.wavelength_nm, nm / doppler, 1e-14);
            assert_eq!(seen.saturation, 0.5);
            let gain = (0..power).fold(1.0, |gain, _| gain * doppler);
            near("brightness", seen.value * seen.factor, 0.25 * green.factor * gain, 1e-12);
            let kept = HueShift { doppler: false, law }.seen(green, doppler);
            assert_eq!(kept.wavelength_nm, nm);
        }
    }
    assert_eq!(HueShift::NONE.seen(green, 3.0), green);
    assert!(HueShift { doppler: true, law: Brightness::None }.keeps_wavelength(0.0, 2.0));
    // D twice is D² once.
    let shift = HueShift { doppler: true, law: Brightness::Photon };
    let (twice, once) = (shift.seen(shift.seen(green, 1.1), 1.1), shift.seen(green, 1.21));
    near("twice", twice.wavelength_nm, once.wavelength_nm, 1e-13);
    near("twice", twice.value * twice.factor, once.value * once.factor, 1e-13);
}

fn scene(text: &str) -> Scene {
    let source = ugparse::Source::new("lamps.ug", text);
    match ugparse::parse(&source, &ugparse::Options::default()) {
        Ok(parsed) => parsed.scene,
        Err(errors) => panic!("{errors}"),
    }
}

/// Lamps of a scene: their intensity multiplies their colour, directions are unit vectors, places
/// are relative to the eye.
#[test]
fn lamps_are_those_of_the_scene() {
    let scene = scene("c red 1 0 1; l 0.25; l 0.5 0 0 2 red; l 0.75 1 2 3 0.5;");
    let eye = DVec3::new(1.0, 1.0, 1.0);
    let lamps = Lamps::new(&scene, eye, false);
    assert_eq!(lamps.len(), 3);
    assert_eq!([0, 1, 2].map(|row| lamps[row].intensity), [0.25, 0.5, 0.75]);
    assert_eq!(lamps[0].place, LampPlace::Everywhere);
    assert_eq!(lamps[1].place, LampPlace::Afar(DVec3::Z));
    assert_eq!(lamps[2].place, LampPlace::At(DVec3::new(0.0, 1.0, 2.0)));
    assert_eq!(lamps[1].color, DVec3::X * 0.5);
    assert!(lamps[1].is_colored && !lamps[0].is_colored);
    // The sum of two sets of lamps is both.
    let both = Lamps::new(&scene, eye, false).and(vec![Lamp::white(LampPlace::Everywhere, 1.0)]);
    assert_eq!((both.len(), both[3].intensity), (4, 1.0));
}
