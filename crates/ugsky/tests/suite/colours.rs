//! Colours as hues, and highlights.

use ugphysics::{
    Brightness, Hsv, Velocity, attenuation, hue_to_wavelength, srgb_decode, srgb_encode,
    wavelength_to_hue,
};
use ugsky::{ALL_NM, Seen, Shade, SkyColors};

/// Linear red, green and blue at rest as seen with a Doppler factor.
fn seen(shade: &Shade, [red, green, blue]: [f32; 3], doppler: f32) -> [f32; 3] {
    let mut light = [red, green, blue, 1.0].map(|part| [part; Seen::N]);
    shade.see(&mut light, &[doppler; Seen::N]);
    [light[0][3], light[1][3], light[2][3]]
}

fn shade(law: Brightness) -> Shade {
    let colors = SkyColors::Hues { doppler: true, law };
    Shade::new(colors, Velocity::ZERO, &ALL_NM, false).unwrap()
}

/// At rest nothing changes, hues at the ends of the visible range among them.
#[test]
fn colours_at_rest_are_kept() {
    let shade = shade(Brightness::Report);
    for rgb in
        [[0.5, 0.2, 0.1], [0.1, 0.9, 0.9], [0.4, 0.0, 0.4], [0.3, 0.02, 0.6], [0.7, 0.7, 0.7]]
    {
        let seen = seen(&shade, rgb, 1.0);
        assert!((0..3).all(|i| (seen[i] - rgb[i]).abs() < 1e-5), "{rgb:?} {seen:?}");
    }
}

/// Only light whose least channel is near white is brightened, and keeps its colour.
#[test]
fn clipped_highlights_are_brightened() {
    let colors = SkyColors::Hues { doppler: false, law: Brightness::None };
    let mut shade = Shade::new(colors, Velocity::ZERO, &ALL_NM, true).unwrap();
    shade.set_highlights(64.0);
    for rgb in [[0.0; 3], [0.87; 3], [1.0, 1.0, 0.86], [0.2, 0.4, 1.0]] {
        assert_eq!(seen(&shade, rgb, 1.0), rgb);
    }
    // Interpolation may exceed white by a little.
    assert_eq!(seen(&shade, [1.0; 3], 1.0), [64.0; 3]);
    assert_eq!(seen(&shade, [1.01; 3], 1.0), [64.64; 3]);
    // Half of the way: 1 + 63/4.
    let half = seen(&shade, [1.0, 0.935, 1.0], 1.0);
    assert!((half[1] / 0.935 - 16.75).abs() < 1e-3 && (half[0] - 16.75).abs() < 1e-3, "{half:?}");
}

/// Values are multiplied by D in display encoding; wavelengths are divided by it, and fade at the
/// ends of the visible range.
#[test]
fn hues_are_shifted_as_in_1988() {
    let shade = shade(Brightness::Report);
    for step in 0..2000 {
        let part = |by: f64| (f64::from(step) * by).fract();
        let (hue, doppler) =
            (-60.0 + 360.0 * part(0.618_034), libm::exp(0.6 * part(0.754_878) - 0.3));
        let rest = hue_to_wavelength(hue);
        let nm = rest / doppler;
        // At the ends colours at rest are dark.
        if attenuation(rest) < 0.05 {
            continue;
        }
        let light = |hue, value: f64| {
            Hsv { hue, saturation: 1.0, value: 1.0 }.to_rgb().map(|part| srgb_decode(value * part))
        };
        let found = seen(
            &shade,
            light(hue, 0.4 * attenuation(rest)).map(|part| part as f32),
            doppler as f32,
        );
        let expected = light(wavelength_to_hue(nm), 0.4 * doppler * attenuation(nm));
        for (found, expected) in found.into_iter().zip(expected) {
            assert!(
                (f64::from(found) - expected).abs() < 2e-5,
                "{hue} {doppler}: {found} {expected}"
            );
        }
    }
}

/// Grey of every brightness is multiplied in display encoding, too. NaN and negative light are
/// black, and there is a largest light.
#[test]
fn grey_light_follows_the_curve_of_srgb() {
    let colors = SkyColors::Hues { doppler: true, law: Brightness::Report };
    let shade = Shade::new(colors, Velocity::ZERO, &ALL_NM, true).unwrap();
    for step in 0..2780 {
        let light = libm::exp(f64::from(step - 1400) * 1e-2) as f32;
        let [red, green, blue] = seen(&shade, [light; 3], 1.5);
        let expected = srgb_decode(1.5 * srgb_encode(f64::from(light)));
        assert!((f64::from(green) / expected - 1.0).abs() < 2e-5, "{light}: {green} {expected}");
        assert!(red == green && green == blue);
    }
    for dark in [0.0, -1.0, -0.0, f32::NAN] {
        assert_eq!(seen(&shade, [dark; 3], 1.5), [0.0; 3], "{dark}");
    }
    assert!(seen(&shade, [f32::MAX; 3], 1.5)[1].is_finite());
}
