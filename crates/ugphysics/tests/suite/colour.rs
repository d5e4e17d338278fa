//! The hue map, attenuation, and the sRGB transfer function.

use proptest::prelude::*;
use ugphysics::{
    CONTROL_POINTS, Hsv, attenuation, hue_to_wavelength, linear_srgb_to_xyz, luminance,
    srgb_decode, srgb_encode, wavelength_to_hue, xyz_to_linear_srgb,
};

use crate::near;

#[test]
fn hue_spot_values() {
    // 589 nm from exact rational arithmetic: 1059492486308/15325235175.
    for (wavelength_nm, hue) in
        [(589.0, 69.133_848_466_9), (500.0, 182.913_708_258_2), (450.0, 226.105_864_370_6)]
    {
        near("hue", wavelength_to_hue(wavelength_nm), hue, 1e-11);
        near("wavelength", hue_to_wavelength(hue), wavelength_nm, 1e-11);
    }
    for point in CONTROL_POINTS {
        assert_eq!(wavelength_to_hue(point.wavelength_nm), point.hue_deg);
        assert_eq!(hue_to_wavelength(point.hue_deg), point.wavelength_nm);
    }
}

#[test]
fn slopes_at_the_control_points() {
    // One-sided differences of second order on both sides, which would reveal a kink between
    // segments.
    for point in CONTROL_POINTS {
        let h = 1e-4;
        let hue = |steps: f64| wavelength_to_hue(point.wavelength_nm + steps * h);
        let slope = |h_sign: f64| {
            h_sign * (4.0 * hue(h_sign) - hue(2.0 * h_sign) - 3.0 * hue(0.0)) / (2.0 * h)
        };
        if point.wavelength_nm < 780.0 {
            near("slope to the red", slope(1.0), point.slope, 1e-7);
        }
        if point.wavelength_nm > 380.0 {
            near("slope to the violet", slope(-1.0), point.slope, 1e-7);
        }
    }
}

#[test]
fn hue_falls_strictly() {
    let step = 0.01;
    let hues: Vec<f64> =
        (0..=40_000).map(|i| wavelength_to_hue(380.0 + step * f64::from(i))).collect();
    let least_slope =
        hues.windows(2).map(|pair| (pair[0] - pair[1]) / step).fold(f64::INFINITY, f64::min);
    near("least slope", least_slope, 0.3899, 1e-4);
}

#[test]
fn hues_outside_wrap_and_wavelengths_outside_clamp() {
    for (hue, same) in [(330.0, -30.0), (359.0, -1.0), (360.0, 0.0), (-300.0, 60.0), (480.0, 120.0)]
    {
        assert_eq!(hue_to_wavelength(hue), hue_to_wavelength(same), "{hue}");
    }
    assert_eq!(hue_to_wavelength(300.0), 380.0);
    assert_eq!(hue_to_wavelength(-60.0), 780.0);
    assert_eq!(hue_to_wavelength(660.0), 380.0);
    near("just above 300", hue_to_wavelength(300.0_f64.next_up()), 780.0, 1e-12);
    assert_eq!(wavelength_to_hue(200.0), 300.0);
    assert_eq!(wavelength_to_hue(2000.0), -60.0);
    assert_eq!(wavelength_to_hue(0.0), 300.0);
    assert_eq!(wavelength_to_hue(f64::INFINITY), -60.0);
    assert!(hue_to_wavelength(f64::NAN).is_nan() && wavelength_to_hue(f64::NAN).is_nan());
}

#[test]
fn attenuation_values() {
    for (wavelength_nm, factor) in [
        (379.9, 0.0),
        (380.0, 0.0),
        (407.9, 0.5),
        (435.8, 1.0),
        (550.0, 1.0),
        (700.0, 1.0),
        (760.0, 0.25),
        (780.0, 0.0),
        (5000.0, 0.0),
    ] {
        near("attenuation", attenuation(wavelength_nm), factor, 1e-14);
    }
}

#[test]
fn hsv_corners() {
    let check = |hue: f64, saturation: f64, value: f64, rgb: [f64; 3]| {
        assert_eq!(Hsv { hue, saturation, value }.to_rgb(), rgb, "{hue} {saturation} {value}");
        assert_eq!(Hsv::from_rgb(rgb), Hsv { hue, saturation, value }, "{rgb:?}");
    };
    check(0.0, 1.0, 1.0, [1.0, 0.0, 0.0]);
    check(60.0, 1.0, 1.0, [1.0, 1.0, 0.0]);
    check(120.0, 1.0, 1.0, [0.0, 1.0, 0.0]);
    check(180.0, 0.5, 1.0, [0.5, 1.0, 1.0]);
    check(240.0, 1.0, 0.5, [0.0, 0.0, 0.5]);
    check(300.0, 1.0, 1.0, [1.0, 0.0, 1.0]);
    check(-30.0, 1.0, 2.0, [2.0, 0.0, 1.0]);
    check(0.0, 0.0, 0.25, [0.25; 3]);
    check(0.0, 0.0, 0.0, [0.0; 3]);
    assert_eq!(Hsv { hue: 750.0, saturation: 1.0, value: 1.0 }.to_rgb(), [1.0, 0.5, 0.0]);
}

#[test]
fn srgb_published() {
    // IEC 61966-2-1: the two pieces meet at the stated thresholds, to the digits of the standard.
    near("decode 0", srgb_decode(0.0), 0.0, 0.0);
    near("decode 1", srgb_decode(1.0), 1.0, 1e-15);
    near("encode 1", srgb_encode(1.0), 1.0, 1e-15);
    near("mid grey, 128/255", srgb_decode(128.0 / 255.0), 0.215_860_500_1, 1e-10);
    near("18 % grey", srgb_encode(0.18), 0.461_356_129_5, 1e-10);
    let above = 0.04045_f64.next_up();
    assert!((srgb_decode(above) - srgb_decode(0.04045)).abs() < 1e-8);
    for level in 0..=255 {
        let encoded = f64::from(level) / 255.0;
        near("round trip", srgb_encode(srgb_decode(encoded)), encoded, 1e-15);
    }
    near("white", luminance([1.0; 3]), 1.0, 1e-15);
}

/// The chromaticities of IEC 61966-2-1; red, green and blue together are its white point.
#[test]
fn primaries_have_their_published_chromaticities() {
    let rows = [
        ([1.0, 0.0, 0.0], [0.64, 0.33], 1e-10),
        ([0.0, 1.0, 0.0], [0.30, 0.60], 1e-10),
        ([0.0, 0.0, 1.0], [0.15, 0.06], 1e-10),
        // The standard rounds the white it takes from D65 to four digits.
        ([1.0, 1.0, 1.0], [0.3127, 0.3290], 5e-5),
    ];
    for (rgb, [x, y], tolerance) in rows {
        let xyz = linear_srgb_to_xyz(rgb);
        let sum: f64 = xyz.iter().sum();
        near("x", xyz[0] / sum, x, tolerance);
        near("y", xyz[1] / sum, y, tolerance);
        for (back, channel) in xyz_to_linear_srgb(xyz).into_iter().zip(rgb) {
            assert!((back - channel).abs() < 1e-10);
        }
    }
    near("white", linear_srgb_to_xyz([1.0; 3])[1], 1.0, 1e-10);
}

proptest! {
    #[test]
    fn hue_and_wavelength_are_inverse(hue in -60.0..300.0_f64, wavelength_nm in 380.0..780.0_f64) {
        prop_assert!((wavelength_to_hue(hue_to_wavelength(hue)) - hue).abs() < 1e-11);
        prop_assert!((hue_to_wavelength(wavelength_to_hue(wavelength_nm)) - wavelength_nm).abs() < 1e-11);
    }

    #[test]
    fn hsv_and_rgb_are_inverse(hue in -59.999..300.0_f64, saturation in 0.01..1.0_f64, value in 0.01..5.0_f64) {
        let back = Hsv::from_rgb(Hsv { hue, saturation, value }.to_rgb());
        // The error of the hue grows as 1/saturation.
        prop_assert!((back.hue - hue).abs() * saturation < 1e-12, "{back:?}");
        prop_assert!((back.saturation - saturation).abs() < 1e-14, "{back:?}");
        prop_assert_eq!(back.value, value);
    }
}
