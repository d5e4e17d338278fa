//! The observer, the illuminant and black bodies, against published numbers.

use ugphysics::WHITE_XYZ;
use ugphysics::spectrum::{Spectrum, daylight, integrate, observer, planck};

#[track_caller]
fn check(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} is not {expected}");
}

pub fn chromaticity([x, y, z]: [f64; 3]) -> [f64; 2] {
    [x / (x + y + z), y / (x + y + z)]
}

#[track_caller]
fn check_xy(xyz: [f64; 3], expected: [f64; 2], tolerance: f64) {
    let found = chromaticity(xyz);
    assert!(
        found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= tolerance),
        "{found:?} is not {expected:?}"
    );
}

/// The sums of the three columns as published by the CIE with its table: an error in any row
/// changes one of them.
#[test]
fn the_observer_is_that_of_the_cie() {
    let sums = (360..=830)
        .map(|nm| observer(f64::from(nm)))
        .fold([0.0; 3], |sums: [f64; 3], row| std::array::from_fn(|i| sums[i] + row[i]));
    for (sum, expected) in sums.into_iter().zip([106.865469, 106.856917, 106.892251]) {
        check(sum, expected, 1e-6);
    }
    // The spectrum locus, CIE 15 table T.5.
    for (nm, xy) in
        [(460.0, [0.14396, 0.02970]), (520.0, [0.07430, 0.83380]), (600.0, [0.62704, 0.37249])]
    {
        check_xy(observer(nm), xy, 6e-6);
    }
    assert_eq!(
        (observer(555.0)[1], observer(359.9), observer(f64::NAN)),
        (1.0, [0.0; 3], [0.0; 3])
    );
    check(observer(555.25)[0], 0.75 * observer(555.0)[0] + 0.25 * observer(556.0)[0], 1e-15);
}

#[test]
fn daylight_is_the_srgb_white_point() {
    let white = integrate(daylight);
    check_xy(white, [0.31272, 0.32903], 1e-5);
    for (part, expected) in white.map(|part| part / white[1]).into_iter().zip(WHITE_XYZ) {
        check(part, expected, 1e-14);
    }
    // Continuous at the joints, and in the infrared close to a black body of the same temperature.
    for joint in [380.0, 780.0] {
        check(daylight(joint - 1e-6), daylight(joint + 1e-6), 1e-6);
    }
    let planckian = planck(1000.0, 6504.0) / planck(560.0, 6504.0);
    check(daylight(1000.0) / planckian, 1.0, 0.1);
}

#[test]
fn the_equal_energy_spectrum_is_in_the_middle() {
    check_xy(integrate(|_| 1.0), [0.33331, 0.33329], 3e-5);
    let flat = Spectrum::samples(&[[100.0, 1.0], [3000.0, 1.0]]);
    check(flat.seen(1.0)[1], 1.0, 1e-7);
    check_xy(flat.seen(1.0), [0.33331, 0.33329], 3e-5);
    // A flat spectrum stays flat and is D⁵ times as bright.
    check(flat.seen(2.0)[1], 32.0, 1e-5);
}

/// Colours of black bodies by direct summation over the 1 nm table.
#[test]
fn black_bodies_have_the_colours_of_their_spectra() {
    for kelvin in [1273.15, 2000.0, 5800.0, 10045.89, 25281.6] {
        let xyz = Spectrum::blackbody(kelvin, 3.0).seen(1.0);
        check_xy(xyz, chromaticity(integrate(|nm| planck(nm, kelvin))), 1e-7);
        check(xyz[1], 3.0, 1e-12);
    }
}

/// Where a black body is brightest, and all its light.
#[test]
fn plancks_law() {
    let step = 1e-3;
    let slope = |nm: f64| planck(nm + step, 5800.0) - planck(nm - step, 5800.0);
    assert!(slope(499.6158543 - 0.01) > 0.0 && slope(499.6158543 + 0.01) < 0.0);
    // The integral is σT⁴/π (Stefan–Boltzmann law).
    let whole: f64 = (1..200_000).map(|row| planck(f64::from(row) * 0.5, 5800.0) * 0.5).sum();
    check(
        whole / (5.670374419e-8 * 5800.0_f64 * 5800.0 * 5800.0 * 5800.0 / std::f64::consts::PI),
        1.0,
        1e-4,
    );
}

/// CIE illuminant A, which is a black body.
#[test]
fn illuminant_a() {
    check_xy(Spectrum::blackbody(2855.5, 1.0).seen(1.0), [0.44758, 0.40745], 2e-5);
}
