//! Surfaces, samples and tables, against physical laws and slow sums.

use proptest::prelude::*;
use ugphysics::spectrum::{
    DopplerGrid, LightSpectrum, Reflectance, SmoothCurve, Spectrum, daylight, integrate, observer,
    planck,
};
use ugphysics::{linear_srgb_to_xyz, srgb_decode, xyz_to_linear_srgb};

use crate::measured_colours::{difference, lab};

/// L(λ) = D⁵ L'(λD), (P12), summed every tenth of a nanometre; white under daylight has Y = 1.
fn slow(radiance: impl Fn(f64) -> f64, doppler: f64) -> [f64; 3] {
    let mut sums = [0.0; 3];
    let mut white = 0.0;
    for row in 3600..=8300 {
        let nm = f64::from(row) * 0.1;
        let weights = observer(nm);
        let fifth = doppler * doppler * doppler * doppler * doppler;
        let light = fifth * radiance(nm * doppler);
        sums.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += light * weight);
        white += daylight(nm) * weights[1];
    }
    sums.map(|sum| sum / white)
}

#[track_caller]
fn check(found: [f64; 3], expected: [f64; 3], tolerance: f64) {
    let is_near = |(a, b): (&f64, &f64)| (a - b).abs() <= tolerance * b.abs();
    assert!(found.iter().zip(&expected).all(is_near), "{found:?} is not {expected:?}");
}

/// All colours with `n_levels` levels of red, green and blue, evenly spaced in display encoding.
fn surfaces(n_levels: i32) -> Vec<[f64; 3]> {
    let level = |row: i32| srgb_decode(f64::from(row) / f64::from(n_levels - 1));
    let row = || 0..n_levels;
    row()
        .flat_map(|r| row().flat_map(move |g| row().map(move |b| [level(r), level(g), level(b)])))
        .collect()
}

#[test]
fn surfaces_have_their_colour_at_rest() {
    for rgb in surfaces(17) {
        let surface = Reflectance::from_linear_srgb(rgb).unwrap_or_else(|| panic!("{rgb:?}"));
        let most = (340..=2500).step_by(10).map(|nm| surface.at(f64::from(nm))).fold(0.0, f64::max);
        let brightest = rgb.into_iter().fold(0.0, f64::max);
        assert!(most <= (1.02 * brightest).max(1.0) + 1e-12, "{rgb:?} reflects {most}");
        let seen = xyz_to_linear_srgb(Spectrum::from_linear_srgb(rgb).seen(1.0));
        assert!(seen.iter().zip(rgb).all(|(a, b)| (a - b).abs() < 2e-9), "{rgb:?}: {seen:?}");
    }
}

#[test]
fn greys_are_fractions_of_white() {
    let white = Reflectance::from_linear_srgb([1.0; 3]).unwrap();
    assert_eq!([100.0, 380.0, 555.5, 5000.0].map(|nm| white.at(nm)), [1.0; 4]);
    for doppler in [0.2, 0.9, 1.0, 3.0] {
        let white = Spectrum::from_linear_srgb([1.0; 3]).seen(doppler);
        let grey = Spectrum::from_linear_srgb([0.18; 3]).seen(doppler);
        check(grey, white.map(|part| 0.18 * part), 1e-12);
        check(white, slow(daylight, doppler), 2e-4);
    }
    assert_eq!(Spectrum::from_linear_srgb([0.0; 3]).seen(1.5), [0.0; 3]);
}

#[test]
fn surfaces_in_motion_agree_with_a_slow_sum() {
    for rgb in [[0.8, 0.05, 0.02], [0.1, 0.6, 0.2], [0.02, 0.1, 0.9], [3.0, 2.0, 0.5]] {
        let surface = Reflectance::from_linear_srgb(rgb).unwrap();
        for doppler in [0.3, 0.7, 1.0, 1.3, 2.5] {
            let expected = slow(|nm| surface.at(nm) * daylight(nm), doppler);
            check(Spectrum::from_linear_srgb(rgb).seen(doppler), expected, 3e-4);
        }
    }
}

#[test]
fn colours_outside_the_srgb_gamut() {
    // Between the sRGB gamut and the spectrum locus: dim smooth surfaces have these colours.
    for xyz in [[0.5, 0.4, 0.01], [0.1, 0.3, 0.05], [0.15, 0.05, 0.8]] {
        let (spectrum, is_exact) = Spectrum::from_xyz(xyz);
        assert!(is_exact, "{xyz:?}");
        check(spectrum.seen(1.0), xyz, 1e-7);
    }
    // Outside the spectrum locus, where no light has the colour: the luminance is kept.
    for xyz in [[0.0, 0.5, 0.0], [1.0, 0.1, 0.0]] {
        let (spectrum, is_exact) = Spectrum::from_xyz(xyz);
        assert!(!is_exact, "{xyz:?}");
        assert!((spectrum.seen(1.0)[1] - xyz[1]).abs() < 1e-3, "{:?}", spectrum.seen(1.0));
    }
    for xyz in [[0.0, -1.0, 0.0], [f64::MAX, 1.0, -f64::MAX], [f64::NAN; 3]] {
        assert!(Spectrum::from_xyz(xyz).0.seen(1.0).iter().all(|part| part.is_finite()), "{xyz:?}");
    }
}

/// (P13), through the general formula: the samples of a black body, seen with D, are those of one
/// at D·T.
#[test]
fn a_black_body_stays_a_black_body() {
    for kelvin in [1000.0, 3500.0, 5900.0, 40_000.0] {
        for doppler in [0.1, 0.5, 1.0, 1.7, 10.0] {
            let hot = Spectrum::blackbody(kelvin, 1.0).seen(doppler);
            let plain = integrate(|nm| planck(nm, kelvin * doppler));
            let rest = integrate(|nm| planck(nm, kelvin))[1];
            check(hot, plain.map(|part| part / rest), 1e-9);
        }
    }
    let samples: Vec<[f64; 2]> =
        (100..3000).map(f64::from).map(|nm| [nm, planck(nm, 5000.0)]).collect();
    let hot = Spectrum::samples(&samples).seen(1.6);
    check(hot, Spectrum::samples(&samples).shifted(1.6).map(|part| part * 10.48576), 1e-12);
    let body = Spectrum::blackbody(5000.0, integrate(|nm| planck(nm, 5000.0))[1]);
    check(hot, body.seen(1.6), 1e-5);
}

#[test]
fn a_narrow_line_gives_the_observers_response() {
    // Area 1 at 500 nm, a hundredth of a nanometre wide.
    let line = Spectrum::samples(&[[499.99, 0.0], [500.0, 100.0], [500.01, 0.0]]);
    for doppler in [0.7, 0.9, 1.0, 1.2] {
        // λ and the width of the line are both divided by D, which leaves D⁴.
        let expected = observer(500.0 / doppler)
            .map(|part| part * doppler * doppler * doppler * doppler / 106.856917);
        check(line.seen(doppler), expected, 2e-3);
    }
    assert_eq!(line.seen(2.0), [0.0; 3]);
    assert_eq!(Spectrum::samples(&[[500.0, 3.0]]).seen(1.0), [0.0; 3]);
}

/// Interpolation errors of X, Y and Z, and colour differences ΔE*ab; less for black bodies, which
/// are smoother.
#[test]
fn tables_approximate_the_spectra() {
    let surfaces = surfaces(5).into_iter().map(|rgb| (Spectrum::from_linear_srgb(rgb), 4e-4));
    let bodies = [1000.0, 6000.0, 40_000.0]
        .into_iter()
        .map(|kelvin| (Spectrum::blackbody(kelvin, 2.0), 3e-7));
    let grid = DopplerGrid::new(-2.4..=2.4);
    let white = Spectrum::from_linear_srgb([1.0; 3]);
    for (spectrum, tolerance) in surfaces.chain(bodies) {
        let (table, values) = (grid.table(), grid.table());
        for row in 0..480 {
            // At the middle of cells and away from it.
            let ln = -2.4 + 0.01 * (f64::from(row) + 0.5 - 0.3 * f64::from(row % 2));
            let exact = spectrum.shifted(libm::exp(ln));
            let largest = exact.into_iter().fold(0.0, f64::max);
            let mean = || values.mean(&grid.place(ln), |idx| grid.xyz_at(&spectrum, idx));
            let tabulated = table.xyz(ln, |idx| grid.ln_xyz(&spectrum, idx));
            let of_surface = spectrum.is_surface().then(mean);
            for found in of_surface.into_iter().chain([tabulated, grid.xyz(&spectrum, ln)]) {
                let is_near = |(a, b): (f64, f64)| (a - b).abs() <= tolerance * largest;
                assert!(found.into_iter().zip(exact).all(is_near), "{found:?} is not {exact:?}");
                let white = white.shifted(libm::exp(ln));
                let [a, b] =
                    [found, exact].map(|xyz| lab(std::array::from_fn(|i| xyz[i] / white[i])));
                assert!(!spectrum.is_surface() || difference(a, b) < 0.04, "{spectrum:?} {ln}");
            }
        }
    }
}

#[test]
fn extreme_factors_give_valid_colours() {
    let grid = DopplerGrid::new(-200.0..=7.0);
    let spectra = [
        Spectrum::from_linear_srgb([0.9, 0.1, 0.1]),
        Spectrum::blackbody(1e-300, 1.0),
        Spectrum::blackbody(30.0, 0.0),
        Spectrum::blackbody(1e300, 1e300),
        Spectrum::samples(&[[400.0, 0.0], [500.0, 1.0], [600.0, 0.0]]),
    ];
    for spectrum in &spectra {
        let table = grid.table();
        for doppler in [1e-300, 1e-3, 0.1, 1.0, 10.0, 1e3, 1e300] {
            let tabulated = table.xyz(libm::log(doppler), |idx| grid.ln_xyz(spectrum, idx));
            for part in spectrum.shifted(doppler).into_iter().chain(tabulated) {
                assert!(part >= 0.0, "{spectrum:?} at {doppler}: {part}");
            }
        }
    }
}

const COLORS: [[f64; 3]; 9] = [
    [1.0, 1.0, 1.0],
    [0.9, 0.1, 0.1],
    [0.1, 0.8, 0.1],
    [0.05, 0.1, 0.9],
    [0.9, 0.8, 0.05],
    [0.9, 0.1, 0.9],
    [0.02, 0.9, 0.9],
    [0.98, 0.0, 0.0],
    [0.0, 0.0, 0.98],
];

/// Against the sum over whole nanometres, whose own error at the corners of daylight is as
/// large.
#[test]
fn surfaces_under_lamps_are_summed() {
    let surfaces = COLORS.map(Spectrum::from_linear_srgb);
    let hot = [1500.0, 3000.0, 9000.0].map(|kelvin| Spectrum::blackbody(kelvin, 1.0));
    let line = Spectrum::samples(&[[588.0, 0.0], [589.0, 1.0], [590.0, 0.0]]);
    let filtered = surfaces.iter().map(|light| (light, 2e-4));
    let lights = filtered.chain(hot.iter().map(|light| (light, 1e-12))).chain([(&line, 1e-12)]);
    for (light, tolerance) in lights {
        let light = LightSpectrum::new(light);
        for surface in &surfaces {
            for (k, l) in (-12..=12).flat_map(|k| (-6..=6).map(move |l| (k, l))) {
                let doppler = libm::exp(0.1037 * f64::from(k));
                let light_doppler = libm::exp(0.2011 * f64::from(l));
                let reflected = |nm: f64| surface.transmittance(nm) * light.at(nm * light_doppler);
                let exact = integrate(|nm| reflected(nm * doppler));
                let seen = surface.under(&light, doppler, light_doppler).unwrap();
                let most = tolerance * exact[0].max(exact[1]).max(exact[2]);
                let is_near = seen.iter().zip(exact).all(|(a, b)| (a - b).abs() <= most);
                assert!(
                    is_near,
                    "{surface:?} {light:?} {doppler} {light_doppler}: {seen:?} {exact:?}"
                );
            }
        }
    }
}

/// Beyond the table of daylight, and where nothing is left of it.
#[test]
fn far_shifts_are_summed() {
    let white = Spectrum::from_linear_srgb([1.0; 3]);
    let light = LightSpectrum::new(&white);
    for ln_doppler in [-90.0, -20.0, -6.01, -5.99, 2.0, 5.99, 6.01, 20.0, 90.0] {
        let doppler = libm::exp(ln_doppler);
        let exact = integrate(|nm| light.at(nm * doppler));
        let seen = white.under(&light, doppler, 1.0).unwrap();
        let is_near = seen.iter().zip(exact).all(|(a, b)| (a - b).abs() <= 1e-4 * b);
        assert!(is_near, "{ln_doppler}: {seen:?} {exact:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn srgb_colours_round_trip(rgb in prop::array::uniform3(0.0..1.0_f64), power in -9..4_i32) {
        let scale = libm::pow(10.0, f64::from(power));
        let rgb = rgb.map(|channel| channel * scale);
        let (spectrum, is_exact) = Spectrum::from_xyz(linear_srgb_to_xyz(rgb));
        prop_assert!(is_exact);
        let seen = xyz_to_linear_srgb(spectrum.seen(1.0));
        prop_assert!(seen.iter().zip(rgb).all(|(a, b)| (a - b).abs() < 2e-9 * scale), "{:?} {:?}", seen, rgb);
    }

    /// X, Y, Z of a surface of constant reflectance increase with D.
    #[test]
    fn approaching_surfaces_are_brighter(doppler in 0.1..9.0_f64) {
        let white = Spectrum::from_linear_srgb([1.0; 3]);
        let (before, behind) = (white.seen(doppler), white.seen(doppler * 1.05));
        prop_assert!(before.iter().zip(behind).all(|(a, b)| *a < b));
    }
}

/// A cold body in fast motion is brighter than any number: it keeps the hue of D·T, in tables as
/// well.  Eq. (P13)
#[test]
fn light_beyond_the_range_of_numbers_keeps_its_hue() {
    let grid = DopplerGrid::new(-8.0..=8.0);
    for (kelvin, doppler) in [(2.725, 447.212_4), (0.5, 2437.4), (20.0, 60.9), (1.0, 900.0)] {
        let chromaticity = |[x, y, z]: [f64; 3]| [x / (x + y + z), y / (x + y + z)];
        let cold = Spectrum::blackbody(kelvin, 1.0);
        let same = chromaticity(Spectrum::blackbody(kelvin * doppler, 1.0).seen(1.0));
        let gain = libm::pow(doppler, 5.0);
        let table = grid
            .table()
            .xyz(libm::log(doppler), |idx| grid.ln_xyz(&cold, idx))
            .map(|part| part * gain);
        // As a lamp on white.
        let (lamp, white) = (LightSpectrum::new(&cold), SmoothCurve::new(|_| 1.0));
        assert!((lamp.seen_through(&white, 1.0)[1] - 1.0).abs() < 1e-9, "{kelvin}");
        let lit = lamp.seen_through(&white, doppler);
        for (seen, tolerance) in [(cold.seen(doppler), 1e-12), (table, 1e-4), (lit, 1e-9)] {
            assert!(seen.iter().all(|part| *part < f64::from(f32::MAX) / 100.0), "{seen:?}");
            let off = [0, 1].map(|k| (chromaticity(seen)[k] - same[k]).abs());
            assert!(
                off[0] < tolerance && off[1] < tolerance,
                "{kelvin} {doppler}: {seen:?} {same:?}"
            );
        }
    }
    let [x, y, z] = Spectrum::blackbody(2.725, 1.0).seen(1218.7 / 2.725);
    assert!((x / (x + y + z) - 0.6225).abs() < 5e-5 && (y / (x + y + z) - 0.3694).abs() < 5e-5);
}
