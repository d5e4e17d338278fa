//! Colours of a scene under its lamps: sums of light, own times of lamps, and which faces are light.

use glam::DVec3;
use uglight::{
    Appearance, ColorShift, HueColor, HueShift, Illumination, Interpolation, Irradiance, LampPlace,
    Lamps, Palette, ScatteringTime, SurfaceColor, SurfaceElement, Swatch, light_names, mean_hue,
};
use ugphysics::{Brightness, Hsv, hue_to_wavelength, srgb_decode};
use ugscene::{ColorValue, RestFrames, Scene, Tint};

use crate::{near, scene};

fn appearance(scene: &Scene, shift: ColorShift) -> Appearance {
    Appearance::new(scene, DVec3::ZERO, Interpolation::Hue, shift, 2.0)
}

fn under(levels: &[f64]) -> Vec<Irradiance> {
    let rows = 0..;
    rows.zip(levels).map(|(lamp, &level)| Irradiance { lamp, level, doppler: 1.0 }).collect()
}

fn assert_near(got: DVec3, want: DVec3) {
    assert!((got - want).length() < 1e-12, "{got}, not {want}");
}

/// The sum over lamps of level times light, channel by channel, times the surface.
#[test]
fn light_of_lamps_adds_up() {
    let scene = scene(
        "c_xyz own .3 .4 .2; c red .5 0 1; c green 1 120 1;
         l .5 0 0 1 red; l .25 0 1 0 green; v a 0 0 0 own;",
    );
    let lamps = Lamps::new(&scene, DVec3::ZERO, false);
    let red = DVec3::X * srgb_decode(0.5);
    assert_near(lamps[0].linear, 0.5 * red);
    let colors = appearance(&scene, ColorShift::NONE);
    let own = scene.vertices[0].color.map(|id| colors.palette.get(id));
    let surface = SurfaceColor::even(own.expect("a colour"), 0);
    let light = |levels: &[f64]| {
        colors.light(&surface, 1.0, Illumination::Lamps(&under(levels), &lamps), &[])
    };
    let white = colors.light(&surface, 1.0, Illumination::Level(1.0), &[]);
    assert_near(white, colors.palette.light(&surface.swatch));
    for levels in [[1.0, 1.0], [0.5, 0.0], [0.0, 0.75], [0.2, 0.9]] {
        let sum = levels[0] * lamps[0].linear + levels[1] * lamps[1].linear;
        assert_near(light(&levels), white * sum);
    }
}

/// Light that is not shifted: red, green and blue of a display stay; they are shifted as a hue.
#[test]
fn unshifted_light_of_displays_stays() {
    let scene = scene("l .5 0 0 1; l .25 0 1 0;");
    let lamps = Lamps::new(&scene, DVec3::ZERO, false);
    let linear = DVec3::new(0.5, 0.25, 0.125);
    let base = HueColor::of_display(linear);
    for law in [Brightness::Report, Brightness::Photon] {
        let shift = HueShift { doppler: true, law };
        let lit = |doppler, parts: &[Irradiance]| {
            shift.display_lit((linear, base), doppler, parts, &lamps)
        };
        let parts = under(&[1.0, 2.0]);
        // 0.5 × 1 + 0.25 × 2.
        assert_near(lit(1.0, &parts).expect("unshifted"), linear);
        assert_eq!(lit(1.1, &parts), None);
        let moving = parts[1];
        let mixed = [parts[0], Irradiance { doppler: 1.2, ..moving }];
        let is_light = law.acts_on_light();
        assert_eq!(lit(1.0, &mixed).is_some(), is_light, "{law:?}");
        assert_eq!(lit(1.0, &mixed[1..]), None);
        if let Some(sum) = lit(1.0, &mixed) {
            let seen = shift.seen_lit(base, 1.0, &mixed[1..], &lamps).light();
            assert_near(sum, 0.5 * linear + seen);
        }
    }
}

/// Greys have no hue, and the others share it by their weights.
#[test]
fn hues_are_averaged_without_greys() {
    let color = |hue: f64, saturation: f64, value: f64| Hsv { hue, saturation, value };
    let (grey, blue) = (color(77.0, 0.0, 0.5), color(240.0, 1.0, 1.0));
    assert_eq!(mean_hue([(grey, 0.75), (blue, 0.25)].into_iter()), color(240.0, 0.25, 0.625));
    let (red, green) = (color(0.0, 1.0, 1.0), color(120.0, 1.0, 1.0));
    assert_eq!(mean_hue([(red, 0.25), (green, 0.75)].into_iter()), color(90.0, 1.0, 1.0));
    assert_eq!(mean_hue([(grey, 1.0)].into_iter()), color(0.0, 0.0, 0.5));
    // Beyond violet a hue is a red one: the wavelength decides, not the angle.
    let (purple, red) = (color(340.0, 1.0, 1.0), color(20.0, 1.0, 1.0));
    assert_eq!(mean_hue([(purple, 0.5), (red, 0.5)].into_iter()), color(0.0, 1.0, 1.0));
}

/// Which faces of a scene are hues, and which are light; colours given as light have no hue to
/// shift, so on moving bodies they need one.
#[test]
fn faces_are_hues_or_light() {
    let triangle = "v a 0 0 0; v b 1 0 0; v c 0 1 0;";
    let (hue, light) = ("c one 1 240 1;", "c_xyz other .3 .4 .2;");
    let [of_hue, of_light] = [" f (a b c) one;", " f (a b c) other;"];
    for (faces, kinds) in [
        ("", [false, false]),
        (of_hue, [true, false]),
        (of_light, [false, true]),
        (&[of_hue, of_light].concat(), [true, true]),
    ] {
        // Two faces of two colours do not meet.
        let other = "v d 5 0 0; v e 6 0 0; v g 5 1 0;";
        let faces = match faces.matches("f (").count() {
            2 => faces.replace("f (a b c) other", "f (d e g) other"),
            _ => faces.to_owned(),
        };
        let text = format!("{hue}{light}{triangle}{other}{faces}");
        let scene = scene(&text);
        for shift in [ColorShift::NONE, ColorShift::default()] {
            assert_eq!(appearance(&scene, shift).draws_light(&scene), kinds, "{faces} {shift:?}");
        }
    }
    let moving = scene(&format!("{light}{triangle} f (a b c) other <.5 0 0>;"));
    assert_eq!(appearance(&moving, ColorShift::NONE).draws_light(&moving), [false, true]);
    assert_eq!(appearance(&moving, ColorShift::default()).draws_light(&moving), [true, false]);
    assert_eq!(appearance(&moving, ColorShift::SPECTRA).draws_light(&moving), [false, true]);
    for (shift, keeps) in
        [(ColorShift::NONE, true), (ColorShift::default(), false), (ColorShift::SPECTRA, true)]
    {
        assert_eq!(appearance(&moving, shift).keeps_light(), keeps, "{shift:?}");
    }
}

/// A factor multiplies linear light; in scenes of 1988 it is part of the encoded value.
#[test]
fn factors_multiply_light() {
    let blue = HueColor::from(Hsv { hue: 240.0, saturation: 1.0, value: 0.5 });
    let twice = HueColor { factor: 2.0, ..blue };
    assert_near(blue.light(), DVec3::Z * srgb_decode(0.5));
    assert_near(twice.light(), 2.0 * blue.light());
    assert_eq!(twice.brightest(), 2.0 * blue.brightest());

    let scene = scene("c pale .5 240 .5; c_rgb other .5 .5 .5;");
    let palette = Palette::new(&scene, Interpolation::Wavelength, false, true);
    let [pale, grey] = [palette.swatches[0], palette.swatches[1]];
    assert_eq!((pale.tint, pale.saturation, pale.value), (hue_to_wavelength(240.0), 0.5, 0.5));
    assert!(grey.is_grey() && !pale.is_grey() && Swatch::WHITE.is_grey());
    near("grey", palette.light(&grey).x, srgb_decode(0.5), 1e-12);

    let mut brighter = scene.clone();
    brighter.colors[0].value =
        ColorValue::Hsv { value: 0.5, tint: Tint::Wavelength(900.0), saturation: 1.0, factor: 2.0 };
    let palette = Palette::new(&brighter, Interpolation::Wavelength, false, true);
    let infrared = palette.swatches[0];
    assert_eq!((infrared.tint, infrared.factor), (900.0, 1.0));
    near("factor", srgb_decode(infrared.value), 2.0 * srgb_decode(0.5), 1e-12);
}

/// Without a name, lights are counted by their kind.
#[test]
fn lights_are_counted_by_kind() {
    let scene = scene("l .1; l .5 0 0 1; l .5 0 1 0; l .2 1 2 3 .5; l .2 3 2 1 .5;");
    let names = ["ambient 1", "directional 1", "directional 2", "local 1", "local 2"];
    assert_eq!(light_names(&scene), names);
    assert_eq!(light_names(&Scene::default()), ["ambient 1", "directional 1"]);
}

/// A lamp that changes is seen on a surface as it was: earlier by the time of flight, which a
/// medium between them multiplies by its refractive index, and by that from the surface to the
/// eye.
#[test]
fn lamps_are_seen_as_they_were() {
    let scene = scene(
        "c white 1 0 0; c black 0 0 0; c_time blink -step -period 8 0 white 2 black;
         motion m -vel 0 0 0; l 1 3 0 0 .1 blink <m>;",
    );
    let lamps = Lamps::new(&scene, DVec3::ZERO, false).over_time(&scene, DVec3::ZERO, false);
    let table = lamps[0].table.as_ref().expect("a table");
    let [on, off] = [1, 2];
    for (time, row, step) in [(0.5, on, 0.0), (1.9, on, 0.0), (2.1, off, 1.0), (9.0, on, 2.0)] {
        assert_eq!((table.at(time)[0], table.step(time)), ((row, 1.0), step), "{time}");
    }
    let body = lamps[0].motion.body().expect("a body");
    let frames = RestFrames::new(&scene);
    let element = |point: DVec3, delay: f64| SurfaceElement {
        point,
        time: ScatteringTime::Delay(delay),
        normal: DVec3::X,
        body,
    };
    // Four from the eye and one from the lamp.
    let point = DVec3::new(4.0, 0.0, 0.0);
    let LampPlace::At(place) = lamps[0].place else { panic!("a place") };
    for delay in [0.0, 1.5] {
        let time = element(point, delay).lamp_time(&lamps[0], LampPlace::At(place), &frames);
        near("time", time.expect("a time"), delay - 4.0 - 1.0, 1e-12);
    }
    // At own time −5 + 3 + 1 of the period of 8, and through glass one distance earlier.
    for (delay, index, row) in [(6.0, 1.0, on), (7.5, 1.0, off), (7.5, 2.0, on)] {
        let towards = SurfaceElement { normal: DVec3::NEG_X, ..element(point, delay) };
        let mut rows = Vec::new();
        let at = |_: usize, _: &uglight::Lamp| (None, index);
        towards.for_each_incident(&lamps, &frames, at, |light| rows.push(light.irradiance.lamp));
        assert_eq!(rows, [row], "{delay} {index}");
    }
}

/// Radiances at wavelengths: λ D D_l of the lamp, λ D of the surface.
#[test]
fn sampled_light_is_that_of_shifted_wavelengths() {
    let scene = scene("c_bb warm 3000; l 1 0 0 1 warm;");
    let lamps = Lamps::new(&scene, DVec3::ZERO, true);
    let surface = ugphysics::spectrum::Spectrum::from_linear_srgb([0.5, 0.5, 0.5]);
    let shift = |nm: [u16; 3]| uglight::SpectralShift {
        doppler: true,
        sampled_nm: Some(nm),
        ..uglight::SpectralShift::NONE
    };
    let lit = |own: f64, of_lamp: f64, nm: u16| {
        let part = Irradiance { lamp: 0, level: 0.25, doppler: of_lamp };
        shift([nm; 3]).seen_lit(&surface, own, &[part], &lamps, &[]).x
    };
    for (own, of_lamp) in [(1.0, 1.0), (1.25, 1.0), (1.0, 1.25), (1.25, 1.5), (0.8, 0.5)] {
        for nm in [400_u16, 520, 640] {
            let lamp = lamps[0].spectrum().at(f64::from(nm) * own * of_lamp);
            let reflected = surface.transmittance(f64::from(nm) * own);
            near("radiance", lit(own, of_lamp, nm), 0.25 * lamp * reflected, 1e-12);
        }
    }
}
