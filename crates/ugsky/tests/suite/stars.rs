//! Stars: the width of their discs, the unit of their light, and their irradiance in motion.

use core::f64::consts::{LN_2, PI};

use glam::DVec3;
use ugphysics::luminance;
use ugsky::{Star, StarLight, StarOptions};

fn near(what: &str, got: f64, want: f64, tolerance: f64) {
    assert!((got / want - 1.0).abs() < tolerance, "{what}: {got}, not {want}");
}

/// A Gaussian has half its height at half its full width at half maximum, which is 2 √(2 ln 2) =
/// 2.3548 standard deviations.
#[test]
fn discs_have_half_their_height_at_half_their_width() {
    for width in [0.5, 1.7, 10.0, 50.0] {
        let options = StarOptions { width, ..StarOptions::default() };
        let deviation = options.deviation();
        near("width", width / deviation, 2.3548, 1e-5);
        near("width", width / deviation, 2.0 * (2.0 * LN_2).sqrt(), 1e-15);
        let at = |radius: f64| StarOptions::profile(radius * radius, deviation);
        assert_eq!(at(0.0), 1.0);
        near("half maximum", at(width / 2.0), 0.5, 1e-14);
        // (1/2)^(r²/(w/2)²)
        near("full width", at(width), 1.0 / 16.0, 1e-14);
        near("within its reach", at(3.99 * deviation), libm::exp(-0.5 * 3.99 * 3.99), 1e-12);
        assert_eq!(at(4.0 * deviation), 0.0);
    }
    // Its integral over the plane is 2 π σ² times its height, of which 4 σ have all but 1/3000.
    let (deviation, step) = (3.0, 0.05);
    let ring = |idx: i32| {
        let radius = (f64::from(idx) + 0.5) * step;
        2.0 * PI * radius * step * StarOptions::profile(radius * radius, deviation)
    };
    let all: f64 = (0..400).map(ring).sum();
    near("integral", all, 2.0 * PI * deviation * deviation, 5e-4);
}

/// (π/180)² = 3.0462e-4 steradians are a square degree: one star of the white magnitude in it has
/// the mean light 1. Five magnitudes are a factor of 100 (Pogson).
#[test]
fn one_white_star_in_a_square_degree_is_white() {
    const SQUARE_DEGREE: f64 = 3.046_174_197_867_086e-4;
    for white in [-2.0, 0.0, 6.5] {
        let options = StarOptions { white, ..StarOptions::default() };
        let star = Star { direction: DVec3::Y, magnitude: white, kelvin: 5800.0 };
        let light = StarLight::new(&[star], [true, true], 0.1);
        let irradiance = luminance(light.irradiance(&star, 1.0));
        near("mean light", options.scale() * irradiance / SQUARE_DEGREE, 1.0, 1e-4);
        // As a magnitude: light 1 of a square degree is a star of magnitude `white`.
        let magnitude = options.magnitude(SQUARE_DEGREE);
        assert!((magnitude - white).abs() < 1e-12, "{magnitude} {white}");
        assert!((options.magnitude(100.0 * SQUARE_DEGREE) - (white - 5.0)).abs() < 1e-12);
    }
    let options = StarOptions { white: 0.0, ..StarOptions::default() };
    near("square degree", options.scale(), SQUARE_DEGREE, 1e-12);
}

/// A black body is seen as one of D T whose disc has 1/D² of the solid angle: the irradiance per
/// wavelength is that of (D T) times D³/D⁵, so a star of T seen with D has the colour of one of
/// D T at rest. Eq. (P12), (P13)
#[test]
fn stars_in_motion_are_stars_of_another_temperature() {
    let star = |kelvin: f64| Star { direction: DVec3::Y, magnitude: 1.0, kelvin };
    let light = StarLight::new(&[star(3000.0), star(9000.0)], [true, true], 1.0);
    for doppler in [0.5, 0.8, 1.5, 2.0] {
        let seen = light.irradiance(&star(4000.0), doppler);
        let rest = light.irradiance(&star(4000.0 * doppler), 1.0);
        let of = |rgb: [f64; 3]| rgb.map(|part| part / luminance(rgb));
        for (one, other) in of(seen).into_iter().zip(of(rest)) {
            assert!((one - other).abs() < 2e-3, "{doppler}: {seen:?} {rest:?}");
        }
    }
    // Without flux only the solid angle changes the brightness, by 1/D²; magnitudes by Pogson.
    let plain = StarLight::new(&[star(5800.0)], [false, false], 1.0);
    let rest = luminance(plain.irradiance(&star(5800.0), 1.0));
    near("solid angle", luminance(plain.irradiance(&star(5800.0), 2.0)), rest / 4.0, 1e-12);
    let fainter = Star { magnitude: 3.5, ..star(5800.0) };
    near("2.5 magnitudes", luminance(plain.irradiance(&fainter, 1.0)), rest / 10.0, 1e-12);
    // With flux and no shift of wavelengths, by D⁵/D².
    let bright = StarLight::new(&[star(5800.0)], [false, true], 1.0);
    near("flux", luminance(bright.irradiance(&star(5800.0), 2.0)), rest * 8.0, 1e-12);
}
